// SPDX-License-Identifier: GPL-3.0-or-later
/// What the generators of stress drawings are made of. Lattice steps; the canvas has kLatticeSteps on a side.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace fetexc::test {

using ControlPoints = std::vector<LatticePoint>;

inline constexpr std::int64_t kSide = kLatticeSteps;

inline LatticePoint operator+(LatticePoint a, LatticePoint b) { return {a.x + b.x, a.y + b.y}; }
inline LatticePoint operator-(LatticePoint a, LatticePoint b) { return {a.x - b.x, a.y - b.y}; }
inline LatticePoint operator*(std::int64_t k, LatticePoint p) { return {k * p.x, k * p.y}; }

inline std::int64_t random_between(Random& random, std::int64_t low, std::int64_t high) {
    return random.integer(static_cast<int>(low), static_cast<int>(high));
}

/// Both coordinates in −reach … reach.
inline LatticePoint random_offset(Random& random, std::int64_t reach) {
    const std::int64_t x = random_between(random, -reach, reach);
    return {x, random_between(random, -reach, reach)};
}

/// Anywhere on the canvas, off its border.
inline LatticePoint random_point(Random& random) {
    const std::int64_t x = random_between(random, kSide / 16, 15 * kSide / 16);
    return {x, random_between(random, kSide / 16, 15 * kSide / 16)};
}

/// In the middle part of the canvas.
inline LatticePoint random_centre(Random& random) {
    return LatticePoint{kSide / 2, kSide / 2} + random_offset(random, kSide / 8);
}

inline ControlPoints random_curve(Random& random, int degree) {
    ControlPoints out;
    for (int i = 0; i <= degree; ++i)
        out.push_back(random_point(random));
    return out;
}

/// 2 to 4 connected curves of any degree.
inline Path random_path(Random& random) {
    Path path;
    LatticePoint at = random_point(random);
    for (int n = random.integer(2, 4); n > 0; --n) {
        ControlPoints curve = random_curve(random, random.integer(1, 3));
        curve.front() = at;
        at = curve.back();
        path.push_back(curve);
    }
    return path;
}

/// Values of the blossom at k arguments in quarters: exact for control points that are multiples of 4^degree.
inline LatticePoint blossom(ControlPoints p, const std::vector<int>& quarters) {
    for (std::size_t n = p.size() - 1; n > 0; --n) {
        const int q = quarters[n - 1];
        for (std::size_t i = 0; i < n; ++i) {
            const LatticePoint sum = (4 - q) * p[i] + q * p[i + 1];
            p[i] = {sum.x / 4, sum.y / 4};
        }
    }
    return p[0];
}

/// The stretch [from/4, to/4] of the curve, which may lie beyond its ends or run backwards.
inline ControlPoints stretch_of(const ControlPoints& curve, int from, int to) {
    const int degree = static_cast<int>(curve.size()) - 1;
    ControlPoints out;
    for (int k = 0; k <= degree; ++k) {
        std::vector<int> arguments(static_cast<std::size_t>(degree), from);
        std::fill(arguments.begin(), arguments.begin() + k, to);
        out.push_back(blossom(curve, arguments));
    }
    return out;
}

/// A curve whose stretches have exact control points.
inline ControlPoints divisible_curve(Random& random, int degree) {
    ControlPoints out = random_curve(random, degree);
    for (LatticePoint& p : out)
        p = {p.x & ~std::int64_t{63}, p.y & ~std::int64_t{63}};
    return out;
}

inline ControlPoints backwards(ControlPoints curve) {
    std::reverse(curve.begin(), curve.end());
    return curve;
}

// The generators that have a file of their own (stress_tangents.cpp).
Drawing near_tangents(Random& random);
Drawing exact_tangents(Random& random);
Drawing shared_tangent_ends(Random& random);

} // namespace fetexc::test
