// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/coverage.h"

#include <algorithm>
#include <cmath>

#include "compiler/parallel.h"
#include "formats/fbt_mip.h"

namespace fetexc {
namespace {

/// Sums of signed areas to the right of segments: those that run down have above on that side.
class AreaSums {
  public:
    AreaSums(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), sums_((std::size_t{width} + 1) * height, 0.0) {}

    void add(const OutlineSegment& s) {
        const double top = std::max(std::min(s.y0, s.y1), 0.0),
                     bottom = std::min<double>(std::max(s.y0, s.y1), height_);
        if (!(top < bottom)) return;
        const double slope = (s.x1 - s.x0) / (s.y1 - s.y0), sign = s.y1 > s.y0 ? 1 : -1;
        const auto x_at = [&](double y) { return s.x0 + (y - s.y0) * slope; };
        for (auto row = static_cast<std::uint32_t>(top); row < height_ && row < bottom; ++row) {
            const double y0 = std::max<double>(top, row), y1 = std::min<double>(bottom, row + 1.0);
            if (y0 < y1) add_in_row(row, x_at(y0), x_at(y1), sign * (y1 - y0));
        }
    }

    [[nodiscard]] std::vector<double> running() const {
        std::vector<double> out(std::size_t{width_} * height_);
        for (std::uint32_t row = 0; row < height_; ++row) {
            double sum = 0;
            for (std::uint32_t column = 0; column < width_; ++column) {
                sum += sums_[std::size_t{row} * (width_ + 1) + column];
                out[std::size_t{row} * width_ + column] = std::clamp(sum, 0.0, 1.0);
            }
        }
        return out;
    }

  private:
    /// From x0 to x1 within the row; height: signed.
    void add_in_row(std::uint32_t row, double x0, double x1, double height) {
        double* sums = sums_.data() + std::size_t{row} * (width_ + 1);
        const double left = std::clamp<double>(std::min(x0, x1), 0, width_),
                     right = std::clamp<double>(std::max(x0, x1), 0, width_);
        const auto first = static_cast<std::uint32_t>(left);
        if (!(left < right)) return add_in_cell(sums, first, left - first, height);
        const double per_x = height / (right - left);
        for (std::uint32_t column = first; column < width_ && column < right; ++column) {
            const double a = std::max<double>(left, column), b = std::min<double>(right, column + 1.0);
            if (a < b) add_in_cell(sums, column, 0.5 * (a + b) - column, per_x * (b - a));
        }
    }

    /// A piece whose middle is `middle` right of the cell's left side: the rest of the cell, and all cells beyond.
    void add_in_cell(double* sums, std::uint32_t column, double middle, double height) const {
        if (column >= width_) return;
        sums[column] += height * (1 - middle), sums[column + 1] += height * middle;
    }

    std::uint32_t width_, height_;
    std::vector<double> sums_;
};

/// Where what is above touches the canvas's left side, as segments along it.
void close_on_the_left(std::vector<OutlineSegment>& outline, bool above_everywhere, double height) {
    struct End {
        double y;
        bool enters; ///< going down the side
    };
    std::vector<End> ends;
    for (const OutlineSegment& s : outline) {
        if (s.x0 == 0 && s.x1 != 0) ends.push_back({s.y0, false});
        if (s.x1 == 0 && s.x0 != 0) ends.push_back({s.y1, true});
    }
    // Those that meet in a point: what ends below the point first, so that nothing is entered twice.
    std::ranges::stable_sort(ends, [](const End& a, const End& b) { return a.y < b.y; });
    bool above = above_everywhere;
    if (!ends.empty()) {
        int sum = 0, least = 0;
        for (const End& e : ends)
            sum += e.enters ? 1 : -1, least = std::min(least, sum);
        above = least < 0;
    }
    double from = 0;
    int depth = above ? 1 : 0;
    for (const End& e : ends) {
        if (depth > 0 && e.y > from) outline.push_back({0, from, 0, e.y});
        depth += e.enters ? 1 : -1, from = e.y;
    }
    if (depth > 0) outline.push_back({0, from, 0, height});
}

/// At the left side, of an outline that doesn't touch it: what the nearest edge to the right of it in some row says.
bool above_at_left(const Silhouette& silhouette, const std::vector<OutlineSegment>& outline) {
    const OutlineSegment* nearest = nullptr;
    double level = 0, at = 0;
    for (const OutlineSegment& s : outline) {
        if (s.y0 == s.y1) continue;
        if (nearest == nullptr) level = 0.5 * (s.y0 + s.y1);
        if ((s.y0 <= level) == (s.y1 <= level)) continue;
        const double x = s.x0 + (s.x1 - s.x0) * ((level - s.y0) / (s.y1 - s.y0));
        if (nearest == nullptr || x < at) nearest = &s, at = x;
    }
    return nearest == nullptr ? silhouette.above_everywhere : nearest->y1 < nearest->y0;
}

} // namespace

std::vector<double> coverage(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height) {
    std::vector<OutlineSegment> outline = outline_in_texels(silhouette, width, height);
    close_on_the_left(outline, above_at_left(silhouette, outline), height);
    AreaSums sums(width, height);
    for (const OutlineSegment& s : outline)
        sums.add(s);
    return sums.running();
}

std::vector<std::uint8_t> coverage_levels(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                                          unsigned threads) {
    const std::uint32_t levels = fetex::fbt_mip_levels(width, height);
    std::vector<std::uint8_t> out(fetex::fbt_mip_samples(width, height));
    parallel_for(levels, threads, [&](std::size_t k) {
        const fetex::FbtMipLevel level = fetex::fbt_mip_level(width, height, static_cast<std::uint32_t>(k) + 1);
        const std::vector<double> parts = coverage(silhouette, level.width, level.height);
        std::ranges::transform(parts, out.begin() + static_cast<std::ptrdiff_t>(level.first),
                               [](double v) { return static_cast<std::uint8_t>(std::lround(v * 255)); });
    });
    return out;
}

} // namespace fetexc
