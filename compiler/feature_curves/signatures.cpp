// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/signatures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/plane.h"

namespace fetexc {
namespace {

using fetex::FeaturePoint;

bool inside(FeaturePoint p, double by) { return p.x > by && p.x < 1 - by && p.y > by && p.y < 1 - by; }

/// One coordinate over the parameter: first + 2·half·t + bend·t².
struct Parabola {
    double first = 0, half = 0, bend = 0;
    [[nodiscard]] double at(double t) const { return first + t * (2 * half + t * bend); }
};

/// Parameters beyond the segment where the coordinate is `level`.
void add_levels(const Parabola& p, double level, std::array<double, 10>& t, std::size_t& count) {
    const auto add = [&](double root) {
        if (std::isfinite(root) && (root < 0 || root > 1)) t[count++] = root;
    };
    const double base = p.first - level, square = p.half * p.half - p.bend * base;
    if (square < 0) return;
    const double far = p.half + std::copysign(std::sqrt(square), p.half);
    if (far != 0) add(-base / far);
    if (p.bend != 0) add(-far / p.bend);
}

} // namespace

std::optional<FeaturePoint> middle_point(FeaturePoint a, double angle_a, FeaturePoint b, double angle_b) {
    const double ax = std::cos(angle_a), ay = std::sin(angle_a), bx = std::cos(angle_b), by = std::sin(angle_b);
    const double turn = ax * by - ay * bx;
    if (std::abs(turn) < budget::kFeatureParallel) return {};
    const double along = ((b.x - a.x) * by - (b.y - a.y) * bx) / turn;
    return FeaturePoint{a.x + along * ax, a.y + along * ay};
}

bool comes_back(const SegmentCurve& c) {
    const Parabola x{c[0].x, c[1].x - c[0].x, c[0].x - 2 * c[1].x + c[2].x},
        y{c[0].y, c[1].y - c[0].y, c[0].y - 2 * c[1].y + c[2].y};
    std::array<double, 10> t{0, 1};
    std::size_t count = 2;
    for (const double level : {0.0, 1.0})
        add_levels(x, level, t, count), add_levels(y, level, t, count);
    std::sort(t.begin(), t.begin() + count);
    for (std::size_t k = 0; k + 1 < count; ++k) {
        if (t[k] >= 0 && t[k + 1] <= 1) continue;
        const double between = (t[k] + t[k + 1]) / 2;
        if (inside({x.at(between), y.at(between)}, budget::kFeatureParallel)) return true;
    }
    return false;
}

SignatureFault fault_of(const SegmentCurve& curve) {
    if (distance(curve[0], curve[2]) == 0) return SignatureFault::NoMiddle;
    if (!inside(curve[1], budget::kFeatureLeastHandle)) return SignatureFault::Outside;
    return comes_back(curve) ? SignatureFault::SideTest : SignatureFault::None;
}

ShownSegment shown_segment(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, std::uint32_t segment) {
    const fetex::FeatureSegment s = fetex::kFeatureSegments[segment];
    const FeaturePoint a = fetex::feature_point(s.first, curves.position(i, j, s.first)),
                       b = fetex::feature_point(s.second, curves.position(i, j, s.second));
    const FeaturePoint half{(a.x + b.x) / 2, (a.y + b.y) / 2};
    if ((curves.texel(i, j).curved >> segment & 1u) == 0) return {{a, half, b}, SignatureFault::None};
    const auto middle = middle_point(a, curves.angle(i, j, s.first), b, curves.angle(i, j, s.second));
    const SegmentCurve curve{a, middle.value_or(half), b};
    return {curve, middle ? fault_of(curve) : SignatureFault::NoMiddle};
}

bool is_aligned(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, std::uint32_t segment) {
    const fetex::FeatureSegment s = fetex::kFeatureSegments[segment];
    const FeaturePoint a = fetex::feature_point(s.first, curves.position(i, j, s.first)),
                       b = fetex::feature_point(s.second, curves.position(i, j, s.second));
    const double length = distance(a, b);
    const auto along = [&](fetex::FeatureEdge e) {
        const double angle = curves.angle(i, j, e);
        return std::abs((b.x - a.x) * std::sin(angle) - (b.y - a.y) * std::cos(angle)) <=
               budget::kFeatureParallel * length;
    };
    return along(s.first) && along(s.second);
}

bool has_fault(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j) {
    const SegmentSet curved = curves.texel(i, j).curved;
    for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
        if (curved >> k & 1u && shown_segment(curves, i, j, k).fault != SignatureFault::None) return true;
    return false;
}

} // namespace fetexc
