// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/pixel_means.h"

#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/classifier.h"

namespace fetexc::measure {
namespace {

void add(Rgba& sum, const Rgba& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

/// Part of the way from a to b over which the line has a's colour; a half where it changes without a jump.
template <class At> double jump_between(const At& at, double from, const Rgba& a, double to, const Rgba& b) {
    const double whole = contrast(a, b), length = to - from;
    if (whole < budget::kJump) return 0.5;
    const double start = from;
    Rgba left = a, right = b;
    for (int step = 0; step < budget::kJumpHalvings; ++step) {
        const double middle = (from + to) / 2;
        const Rgba c = at(middle);
        const double before = contrast(left, c), behind = contrast(c, right);
        if (std::max(before, behind) < budget::kJumpShare * whole) return 0.5;
        if (before > behind)
            to = middle, right = c;
        else
            from = middle, left = c;
    }
    return ((from + to) / 2 - start) / length;
}

} // namespace

bool is_linear(const PixelCorners& corners, const Rgba& center) {
    Rgba mean;
    for (const Rgba& c : corners)
        add(mean, c, 0.25);
    return contrast(mean, center) < budget::kLinearPixel;
}

namespace {

/// The picture changes more along u than along v.
bool changes_across(const Picture& picture, const PixelArea& area) {
    std::array<std::array<Rgba, 3>, 3> c;
    for (std::size_t y = 0; y < 3; ++y) {
        for (std::size_t x = 0; x < 3; ++x)
            c[y][x] = picture.at({area.u + 0.5 * static_cast<double>(x) * area.width,
                                  area.v + 0.5 * static_cast<double>(y) * area.height});
    }
    double across = 0, down = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t n = 0; n < 2; ++n)
            across += color_distance(c[k][n], c[k][n + 1]), down += color_distance(c[n][k], c[n + 1][k]);
    }
    return across >= down;
}

} // namespace

Rgba supersampled(const Picture& picture, const PixelArea& area, unsigned intervals) {
    const bool level = changes_across(picture, area);
    const unsigned lines = 2 * intervals;
    Rgba sum;
    for (unsigned l = 0; l < lines; ++l) {
        const double side = (l + 0.5) / lines;
        const auto at = [&](double t) {
            return picture.at({area.u + (level ? t : side) * area.width, area.v + (level ? side : t) * area.height});
        };
        Rgba last = at(0);
        for (unsigned k = 1; k <= intervals; ++k) {
            const double from = (k - 1.0) / intervals, to = static_cast<double>(k) / intervals;
            const Rgba next = at(to);
            const double share = jump_between(at, from, last, to, next);
            add(sum, last, share), add(sum, next, 1 - share);
            last = next;
        }
    }
    const double weight = 1.0 / (static_cast<double>(lines) * intervals);
    return {sum.r * weight, sum.g * weight, sum.b * weight, sum.a * weight};
}

} // namespace fetexc::measure
