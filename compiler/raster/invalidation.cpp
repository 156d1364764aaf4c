// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/invalidation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

/// A curve in pixels.
struct PixelCurve {
    int degree = 1;
    std::array<CanvasPoint, 4> p{};
};

class PixelMask {
  public:
    PixelMask(std::uint32_t width, std::uint32_t height, double distance)
        : width_(width), height_(height), reach_(distance + budget::kInvalidationSlack),
          mask_(std::size_t{width} * height, 0) {}

    /// Lines in place of curves err by at most half the slack.
    void mark(const PixelCurve& curve, int depth = 0) {
        constexpr int deepest = 24;
        if (outside(curve)) return;
        if (depth < deepest && !flat(curve)) {
            const auto [a, b] = halves(curve);
            mark(a, depth + 1);
            mark(b, depth + 1);
        } else {
            mark_line(curve.p[0], curve.p[static_cast<std::size_t>(curve.degree)]);
        }
    }

    std::vector<std::uint8_t> take() { return std::move(mask_); }

  private:
    [[nodiscard]] bool outside(const PixelCurve& c) const {
        const auto all = [&](auto&& beyond) { return std::all_of(c.p.begin(), c.p.begin() + c.degree + 1, beyond); };
        return all([&](CanvasPoint p) { return p.x < -reach_; }) || all([&](CanvasPoint p) { return p.y < -reach_; }) ||
               all([&](CanvasPoint p) { return p.x > width_ + reach_; }) ||
               all([&](CanvasPoint p) { return p.y > height_ + reach_; });
    }

    /// The curve is as far from its chord as its handles are from the points that share the chord evenly, at most.
    [[nodiscard]] static bool flat(const PixelCurve& c) {
        const CanvasPoint a = c.p[0], b = c.p[static_cast<std::size_t>(c.degree)];
        for (int k = 1; k < c.degree; ++k) {
            const double t = static_cast<double>(k) / c.degree;
            const CanvasPoint p = c.p[static_cast<std::size_t>(k)];
            const double dx = p.x - (a.x + t * (b.x - a.x)), dy = p.y - (a.y + t * (b.y - a.y));
            if (std::max(std::fabs(dx), std::fabs(dy)) > 0.5 * budget::kInvalidationSlack) return false;
        }
        return true;
    }

    static std::pair<PixelCurve, PixelCurve> halves(const PixelCurve& c) {
        PixelCurve a = c, b = c;
        std::array<CanvasPoint, 4> p = c.p;
        for (int level = 0; level <= c.degree; ++level) {
            a.p[static_cast<std::size_t>(level)] = p[0];
            b.p[static_cast<std::size_t>(c.degree - level)] = p[static_cast<std::size_t>(c.degree - level)];
            for (int k = 0; k < c.degree - level; ++k) {
                const auto at = static_cast<std::size_t>(k);
                p[at] = {0.5 * (p[at].x + p[at + 1].x), 0.5 * (p[at].y + p[at + 1].y)};
            }
        }
        return {a, b};
    }

    /// First and last pixel whose centre lies in [lo, hi]; none if first > last.
    static std::pair<std::int64_t, std::int64_t> centres(double lo, double hi, std::uint32_t n) {
        const auto bounded = [&](double v) { return std::clamp(v - 0.5, -1.0, n + 1.0); };
        return {std::max(std::int64_t{0}, static_cast<std::int64_t>(std::ceil(bounded(lo)))),
                std::min(std::int64_t{n} - 1, static_cast<std::int64_t>(std::floor(bounded(hi))))};
    }

    /// A line comes as near as `reach_` to a centre in the infinity norm when its part between the levels cy ± reach
    /// does in x.
    void mark_line(CanvasPoint a, CanvasPoint b) {
        if (b.y < a.y) std::swap(a, b);
        const auto [first, last] = centres(a.y - reach_, b.y + reach_, height_);
        for (std::int64_t row = first; row <= last; ++row) {
            const double centre = static_cast<double>(row) + 0.5;
            const double x0 = x_at(a, b, centre - reach_), x1 = x_at(a, b, centre + reach_);
            double lo = std::min(x0, x1), hi = std::max(x0, x1);
            if (a.y == b.y) lo = std::min(a.x, b.x), hi = std::max(a.x, b.x);
            const auto [from, to] = centres(lo - reach_, hi + reach_, width_);
            for (std::int64_t x = from; x <= to; ++x)
                mask_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(x)] = 1;
        }
    }

    /// On the line a, b, from its end where y is beyond it.
    static double x_at(CanvasPoint a, CanvasPoint b, double y) {
        if (y <= a.y) return a.x;
        if (y >= b.y) return b.x;
        return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    }

    std::uint32_t width_, height_;
    double reach_;
    std::vector<std::uint8_t> mask_;
};

} // namespace

std::vector<std::uint8_t> invalid_pixels(const Scene& features, std::uint32_t width, std::uint32_t height,
                                         double distance) {
    PixelMask mask(width, height, distance);
    const double sx = static_cast<double>(width) / static_cast<double>(features.extent.lattice_w),
                 sy = static_cast<double>(height) / static_cast<double>(features.extent.lattice_h);
    for (const Segment& s : features.segments) {
        PixelCurve curve{s.degree, {}};
        for (std::size_t k = 0; k <= static_cast<std::size_t>(s.degree); ++k)
            curve.p[k] = {static_cast<double>(s.p[k].x) * sx, static_cast<double>(s.p[k].y) * sy};
        mask.mark(curve);
    }
    return mask.take();
}

} // namespace fetexc
