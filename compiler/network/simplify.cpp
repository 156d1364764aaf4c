// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/simplify.h"

#include <algorithm>
#include <cmath>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/network/network_reader.h"
#include "compiler/scene/bezier.h"
#include "compiler/scene/scene.h"

namespace fetexc {
namespace {

/// Length of Σ weights[k]·p[k].
template <std::size_t N> double length_of(const CanvasSegment& s, const std::array<double, N>& weights) {
    double x = 0, y = 0;
    for (std::size_t k = 0; k < N; ++k)
        x += weights[k] * s.p[k].x, y += weights[k] * s.p[k].y;
    return std::hypot(x, y);
}

/// Equal parameter steps so that error/steps^power ≤ tolerance.
std::uint64_t steps_for(double error, double tolerance, double power) {
    const double steps = std::ceil(std::pow(error / tolerance, 1 / power));
    return steps > 1 ? static_cast<std::uint64_t>(std::min(steps, double{kNetworkMaxSegments} + 1)) : 1;
}

/// A cubic and the quadratic of the same ends and the mean of the two middle points that its halves suggest, (3 c1 −
/// p0) / 2 and (3 c2 − p3) / 2, differ by |p3 − 3 c2 + 3 c1 − p0| · t (1 − t) |1 − 2t| / 2, at most √3/36 of it.
std::uint64_t quadratics_for(const CanvasSegment& s, double tolerance) {
    if (s.degree < 3) return 1;
    return steps_for(std::sqrt(3.0) / 36 * length_of<4>(s, {-1, 3, -3, 1}), tolerance, 3);
}

CanvasSegment quadratic_of(const CanvasSegment& c) {
    const auto middle = [](double p0, double c1, double c2, double p3) { return (3 * (c1 + c2) - (p0 + p3)) / 4; };
    return {2,
            {c.p[0],
             {middle(c.p[0].x, c.p[1].x, c.p[2].x, c.p[3].x), middle(c.p[0].y, c.p[1].y, c.p[2].y, c.p[3].y)},
             c.p[3]}};
}

CanvasSegment without_equal_points(const CanvasSegment& s) {
    const auto same = [&](std::size_t a, std::size_t b) { return s.p[a].x == s.p[b].x && s.p[a].y == s.p[b].y; };
    if (s.degree != 2 || !(same(0, 1) || same(1, 2))) return s;
    return {1, {s.p[0], s.p[2]}};
}

/// A chord is off by at most an eighth of the largest second derivative, which is at most 2 (quadratics) or 6 times the
/// largest second difference of the control points.
std::uint64_t chords_for(const CanvasSegment& s, double tolerance) {
    if (s.degree == 1) return 1;
    const double first = length_of<3>(s, {1, -2, 1});
    if (s.degree == 2) return steps_for(2 * first / 8, tolerance, 2);
    return steps_for(6 * std::max(first, length_of<4>(s, {0, 1, -2, 1})) / 8, tolerance, 2);
}

template <class CountOf, class PieceOf>
Result<Network> cut(const Network& network, const CountOf& count_of, const PieceOf& piece_of) {
    Network out{network.width, network.height, {}, network.profiles, network.profile};
    std::uint64_t total = 0;
    for (const NetworkCurve& from : network.curves) {
        NetworkCurve curve = from;
        curve.segments.clear();
        for (const CanvasSegment& s : from.segments) {
            const std::uint64_t n = count_of(s);
            total += n;
            if (total > kNetworkMaxSegments)
                return Error{ErrorClass::InvalidInput, diag::kNetworkTooLarge,
                             "the network's curves become more than 2^24 segments", from.name};
            for (std::uint64_t k = 0; k < n; ++k) {
                const auto at = [&](std::uint64_t step) { return static_cast<double>(step) / static_cast<double>(n); };
                const CanvasSegment piece = piece_of(n == 1 ? s : bezier::part(s, at(k), at(k + 1)));
                if (!is_point(piece)) curve.segments.push_back(piece);
            }
        }
        if (!curve.segments.empty()) out.curves.push_back(std::move(curve));
    }
    return out;
}

} // namespace

Result<Network> to_quadratics(const Network& network, double tolerance) {
    return cut(
        network, [&](const CanvasSegment& s) { return quadratics_for(s, tolerance); },
        [](const CanvasSegment& s) { return without_equal_points(s.degree == 3 ? quadratic_of(s) : s); });
}

Result<Network> to_lines(const Network& network, double tolerance) {
    return cut(
        network, [&](const CanvasSegment& s) { return chords_for(s, tolerance); },
        [](const CanvasSegment& s) -> CanvasSegment {
            return {1, {s.p[0], s.p[static_cast<std::size_t>(s.degree)]}};
        });
}

double quadratic_tolerance(const Network& network) {
    return budget::kQuadraticTolerance * std::max(network.width, network.height) / static_cast<double>(kLatticeSteps);
}

} // namespace fetexc
