// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compiler/bilevel/edge_lines.h"
#include "compiler/bilevel/silhouette.h"

namespace fetexc {
namespace {

/// Of some pixels.
struct MeanColor {
    void add(const Rgba& c) { sum = {sum.r + c.r, sum.g + c.g, sum.b + c.b, sum.a + c.a}, ++count; }
    [[nodiscard]] Rgba color() const {
        const double n = count > 0 ? static_cast<double>(count) : 1;
        return {sum.r / n, sum.g / n, sum.b / n, sum.a / n};
    }

    Rgba sum;
    std::size_t count = 0;
};

/// How far a picture is above, 0…1 where it has two levels only; one half is the edge. Pixels beyond the border repeat
/// it.
class Field {
  public:
    Field(const RasterImage& image, bool alpha) : image_(image), alpha_(alpha) {}

    /// 0 and 1 become the two levels around which the values lie.
    void find_levels() {
        auto [low, high] = range();
        for (int round = 0; round < 8; ++round) {
            double sum[2] = {0, 0};
            std::size_t count[2] = {0, 0};
            for (std::uint32_t y = 0; y < image_.height; ++y) {
                for (std::uint32_t x = 0; x < image_.width; ++x) {
                    const double v = raw(x, y);
                    const std::size_t side = v > 0.5 * (low + high) ? 1 : 0;
                    sum[side] += v, ++count[side];
                }
            }
            if (count[0] == 0 || count[1] == 0) return;
            const double next_low = sum[0] / static_cast<double>(count[0]),
                         next_high = sum[1] / static_cast<double>(count[1]);
            if (next_low == low && next_high == high) break;
            low = next_low, high = next_high;
        }
        // The means are drawn together by the pixels of the edges: the flat ones' say what the levels are.
        const double half = 0.5 * (low + high), reach = 0.25 * (high - low);
        const double low_most = low + reach, high_least = high - reach;
        low_ = mean_of([&](double v) { return v <= half && v <= low_most; }, low);
        high_ = mean_of([&](double v) { return v > half && v >= high_least; }, high);
    }

    [[nodiscard]] double at(std::int64_t x, std::int64_t y) const {
        const double v = raw(static_cast<std::uint32_t>(std::clamp<std::int64_t>(x, 0, image_.width - 1)),
                             static_cast<std::uint32_t>(std::clamp<std::int64_t>(y, 0, image_.height - 1)));
        return std::clamp((v - low_) / (high_ - low_), 0.0, 1.0);
    }

  private:
    [[nodiscard]] double raw(std::uint32_t x, std::uint32_t y) const {
        const Rgba c = image_.at(x, y);
        return alpha_ ? c.a : 1 - luma_over_white(c); // darkness
    }
    /// Least and most.
    [[nodiscard]] std::pair<double, double> range() const {
        double low = raw(0, 0), high = low;
        for (std::uint32_t y = 0; y < image_.height; ++y) {
            for (std::uint32_t x = 0; x < image_.width; ++x)
                low = std::min(low, raw(x, y)), high = std::max(high, raw(x, y));
        }
        return {low, high};
    }
    template <class Takes> [[nodiscard]] double mean_of(const Takes& takes, double otherwise) const {
        double sum = 0;
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < image_.height; ++y) {
            for (std::uint32_t x = 0; x < image_.width; ++x) {
                const double v = raw(x, y);
                if (takes(v)) sum += v, ++count;
            }
        }
        return count > 0 ? sum / static_cast<double>(count) : otherwise;
    }

    const RasterImage& image_;
    bool alpha_;
    double low_ = 0, high_ = 1;
};

/// The line at one half in the squares between pixel centres; at the border the half squares up to it. Where it crosses
/// between two centres the straight edges under the two pixels say, if there are any, else linear interpolation: which
/// is off by up to a twentieth of a pixel for edges that aren't level, upright or diagonal.
class MarchingSquares {
  public:
    MarchingSquares(const Field& field, std::uint32_t width, std::uint32_t height)
        : field_(field), width_(width), height_(height), rows_{row(-2), row(-1), row(0), row(1)},
          upper_lines_(lines(1)), lower_lines_(lines(2)) {}

    /// All squares, from top to bottom.
    void run(std::vector<VisibleEdge>& out) {
        for (std::int64_t y = 0; y <= height_; ++y) {
            for (std::size_t k = 1; k <= std::size_t{width_} + 1; ++k)
                add_square(k, static_cast<double>(y) - 0.5, out);
            std::rotate(rows_.begin(), rows_.begin() + 1, rows_.end());
            rows_[3] = row(y + 2);
            upper_lines_ = std::move(lower_lines_), lower_lines_ = lines(2);
        }
    }

  private:
    using Row = std::vector<double>;
    using Lines = std::vector<std::optional<EdgeLine>>;

    /// Pixel x is element x + 2.
    [[nodiscard]] Row row(std::int64_t y) const {
        Row out(std::size_t{width_} + 4);
        for (std::size_t k = 0; k < out.size(); ++k)
            out[k] = field_.at(static_cast<std::int64_t>(k) - 2, y);
        return out;
    }

    /// Under the pixels of one of the rows.
    [[nodiscard]] Lines lines(std::size_t r) const {
        Lines out(rows_[r].size());
        for (std::size_t k = 1; k + 1 < out.size(); ++k) {
            const double v = rows_[r][k];
            if (v <= 0 || v >= 1) continue;
            std::array<double, 9> around{};
            for (std::size_t n = 0; n < 9; ++n)
                around[n] = rows_[r + n / 3 - 1][k + n % 3 - 1];
            out[k] = fit_edge_line(around);
        }
        return out;
    }

    /// From a centre to the next one along an axis, 0…1, where the edge crosses.
    [[nodiscard]] static double crossing(double a, double b, const std::optional<EdgeLine>& line_a,
                                         const std::optional<EdgeLine>& line_b, bool along_x) {
        double sum = 0;
        int count = 0;
        const auto take = [&](const std::optional<EdgeLine>& line, double from) {
            if (!line) return;
            const double n = along_x ? line->nx : line->ny;
            const double t = from + line->offset / n;
            if (!(t >= 0 && t <= 1) || (n > 0) != (b > a)) return; // another edge
            sum += t, ++count;
        };
        take(line_a, 0), take(line_b, 1);
        return count > 0 ? sum / count : (0.5 - a) / (b - a);
    }

    /// Between elements k and k + 1 of the two rows in the middle, whose centres are at y and y + 1.
    void add_square(std::size_t k, double y, std::vector<VisibleEdge>& out) const {
        const Row &upper = rows_[1], &lower = rows_[2];
        const double v00 = upper[k], v10 = upper[k + 1], v01 = lower[k], v11 = lower[k + 1];
        const unsigned set =
            (v00 > 0.5 ? 1U : 0U) | (v10 > 0.5 ? 2U : 0U) | (v01 > 0.5 ? 4U : 0U) | (v11 > 0.5 ? 8U : 0U);
        if (set == 0 || set == 15) return;
        const double x = static_cast<double>(k) - 1.5;
        const auto &l00 = upper_lines_[k], &l10 = upper_lines_[k + 1], &l01 = lower_lines_[k],
                   &l11 = lower_lines_[k + 1];
        const auto top = [&] { return place(x + crossing(v00, v10, l00, l10, true), y); };
        const auto bottom = [&] { return place(x + crossing(v01, v11, l01, l11, true), y + 1); };
        const auto left = [&] { return place(x, y + crossing(v00, v01, l00, l01, false)); };
        const auto right = [&] { return place(x + 1, y + crossing(v10, v11, l10, l11, false)); };
        // Above on the left of from → to.
        const auto add = [&](WidthPoint from, WidthPoint to) {
            if (from.x != to.x || from.y != to.y) out.push_back({1, {from, to}, 1, 0});
        };
        switch (set) {
        case 1:
            return add(left(), top());
        case 2:
            return add(top(), right());
        case 3:
            return add(left(), right());
        case 4:
            return add(bottom(), left());
        case 5:
            return add(bottom(), top());
        case 7:
            return add(bottom(), right());
        case 8:
            return add(right(), bottom());
        case 10:
            return add(top(), bottom());
        case 11:
            return add(left(), bottom());
        case 12:
            return add(right(), left());
        case 13:
            return add(right(), top());
        case 14:
            return add(top(), left());
        default:
            break;
        }
        const bool middle = v00 + v10 + v01 + v11 > 2; // 6 and 9: two opposite corners
        if (set == 9) {
            middle ? (add(left(), bottom()), add(right(), top())) : (add(left(), top()), add(right(), bottom()));
        } else {
            middle ? (add(top(), left()), add(bottom(), right())) : (add(top(), right()), add(bottom(), left()));
        }
    }

  private:
    /// In pixels, to width units; what is beyond the canvas lies on its border.
    [[nodiscard]] WidthPoint place(double x, double y) const {
        return {std::clamp<double>(x, 0, width_) / width_, std::clamp<double>(y, 0, height_) / width_};
    }

    const Field& field_;
    std::uint32_t width_, height_;
    std::array<Row, 4> rows_; ///< above the squares' upper pixels, those, the lower ones, and below
    Lines upper_lines_, lower_lines_;
};

} // namespace

Result<Silhouette> silhouette_of(const RasterImage& image, const SilhouetteRule& rule) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    bool alpha = rule.kind == SilhouetteRule::Kind::Alpha;
    if (rule.kind == SilhouetteRule::Kind::TwoColors) {
        for (std::size_t k = 0; k < pixels && !alpha; ++k)
            alpha = image.rgba[4 * k + 3] != image.rgba[3];
    }
    Field field(image, alpha);
    if (rule.kind == SilhouetteRule::Kind::TwoColors) field.find_levels();
    Silhouette out;
    out.height = static_cast<double>(image.height) / image.width;
    out.pixelated = 1.0 / image.width;
    MarchingSquares(field, image.width, image.height).run(out.edges);
    // Pixels that edges cut say what colour a side has where there are no others.
    MeanColor flat[2], cut[2];
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const double v = field.at(x, y);
            const std::size_t side = v > 0.5 ? 1 : 0;
            (v == static_cast<double>(side) ? flat : cut)[side].add(image.at(x, y));
        }
    }
    const auto color = [&](std::size_t side) { return (flat[side].count > 0 ? flat : cut)[side].color(); };
    out.below = color(0), out.above = color(1);
    out.above_everywhere = flat[0].count + cut[0].count == 0;
    return out;
}

} // namespace fetexc
