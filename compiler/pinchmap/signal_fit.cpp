// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/signal_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "compiler/bilevel/scan_lines.h"
#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/pinchmap/sample_equations.h"
#include "formats/fbt_samples.h"
#include "formats/silmap.h"

namespace fetexc {
namespace {

/// Along each side of a sample, and at least of a cluster.
constexpr std::uint32_t kPointsOfSample = 8, kLeastPoints = 16;
/// Cluster rows at a time, each with its own sums.
constexpr std::uint32_t kRowsAtOnce = 32;

std::array<double, 4> channels_of(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

/// What a row of clusters adds.
struct RowSums {
    SampleEquations equations;
    std::uint64_t lost = 0, first_x = 0, first_y = 0; ///< points
};

class SignalFitter {
  public:
    SignalFitter(const fetex::PinchmapTexture& t, const Silhouette& silhouette, const RowPainter& paint)
        : t_(t), paint_(paint), n_(signal_points(t.scale)), columns_(t.width * n_), rows_(t.height * n_),
          outline_(outline_in_texels(silhouette, columns_, rows_)), sides_(silhouette, outline_, columns_, rows_, 1),
          active_(std::size_t{t.width} * t.height), holds_outline_(active_.size(), 0) {
        mark_outline(sides_.rows(), true), mark_outline(sides_.columns(), false);
        for (std::uint32_t j = 0; j < t.height; ++j) {
            for (std::uint32_t i = 0; i < t.width; ++i)
                active_[std::size_t{j} * t.width + i] = has_active(i, j) ? 1 : 0;
        }
    }

    /// Of the points of a cluster row.
    void add(std::uint32_t j, RowSums& sums) const {
        std::vector<PaintedPoint> points(columns_);
        for (std::uint32_t y = 0; y < n_; ++y) {
            const std::uint32_t row = j * n_ + y;
            paint_(row, points);
            add_row(j, row, points, sums);
        }
    }

    [[nodiscard]] SampleEquations equations(std::uint32_t j) const {
        const std::int64_t scale = std::int64_t{1} << t_.scale, samples = fetex::pinchmap_signal_height(t_);
        // What a point of the row reads lies less than two clusters beyond it.
        const std::int64_t first = std::max<std::int64_t>((std::int64_t{j} - 2) * scale - 1, 0),
                           last = std::min((std::int64_t{j} + 3) * scale + 1, samples);
        return {fetex::pinchmap_signal_width(t_), static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)};
    }
    [[nodiscard]] double points() const { return static_cast<double>(columns_) * rows_; }
    [[nodiscard]] double u(std::uint64_t x) const { return (static_cast<double>(x) + 0.5) / columns_; }
    [[nodiscard]] double v(std::uint64_t y) const { return (static_cast<double>(y) + 0.5) / rows_; }

    /// Of a sample: that of its cluster.
    [[nodiscard]] int side(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t i = a >> t_.scale, j = b >> t_.scale;
        for (const auto& [x, y] : {std::pair{0U, 0U}, {1U, 0U}, {0U, 1U}, {1U, 1U}}) {
            const double k = fetex::pinchmap_texel(t_, i + x, j + y).k;
            if (k != 0) return k > 0 ? 1 : -1;
        }
        return 0;
    }

  private:
    /// Clusters that the outline passes.
    void mark_outline(const ScanLines& lines, bool level) {
        for (std::uint32_t n = 0; n < lines.size(); ++n) {
            for (const Crossing& c : lines.crossings(n)) {
                if (!(c.at >= 0 && c.at < (level ? columns_ : rows_))) continue;
                const std::uint32_t along = static_cast<std::uint32_t>(c.at) / n_, across = n / n_;
                holds_outline_[level ? std::size_t{across} * t_.width + along
                                     : std::size_t{along} * t_.width + across] = 1;
            }
        }
    }

    [[nodiscard]] bool has_active(std::uint32_t i, std::uint32_t j) const {
        return fetex::pinchmap_texel(t_, i, j).k == 0 || fetex::pinchmap_texel(t_, i + 1, j).k == 0 ||
               fetex::pinchmap_texel(t_, i, j + 1).k == 0 || fetex::pinchmap_texel(t_, i + 1, j + 1).k == 0;
    }

    void add_row(std::uint32_t j, std::uint32_t row, std::span<const PaintedPoint> points, RowSums& sums) const {
        const std::span<const Crossing> crossings = sides_.rows().crossings(row);
        bool above = sides_.above_at_start(true, row);
        std::size_t next = 0;
        for (std::uint32_t x = 0; x < columns_; ++x) {
            for (; next < crossings.size() && crossings[next].at <= x + 0.5; ++next)
                above = crossings[next].enters;
            add_point(j, x, row, above, points[x], sums);
        }
    }

    void add_point(std::uint32_t j, std::uint32_t x, std::uint32_t row, bool above, const PaintedPoint& point,
                   RowSums& sums) const {
        const std::uint32_t i = x / n_;
        const double fx = (x % n_ + 0.5) / n_, fy = (row % n_ + 0.5) / n_;
        fetex::PinchmapPlace place;
        place.i = i, place.j = j, place.x = fx, place.y = fy;
        bool blurred = false;
        if (active_[std::size_t{j} * t_.width + i] != 0) {
            place = fetex::pinchmap_place_local(t_, i, j, fx, fy);
            blurred = std::max(std::abs(place.direction.x), std::abs(place.direction.y)) < 1 - budget::kSignalMixed;
        } else {
            place.k = fetex::pinchmap_texel(t_, i, j).k;
        }
        const double side = place.k - place.gamma;
        const bool right = (side > 0) == above, far = !right && std::abs(side) >= budget::kPinchmapFarInside;
        if (far && sums.lost++ == 0) sums.first_x = x, sums.first_y = row;
        if (!blurred && !far && std::abs(side) < budget::kPinchmapOnTheLine) return;
        double weight = point.clean || blurred ? 1 : budget::kSignalMixed;
        if (!right && !far && !blurred) {
            if (holds_outline_[std::size_t{j} * t_.width + i] != 0) return;
            weight *= budget::kSignalWrong;
        }
        const double scale = std::ldexp(1.0, static_cast<int>(t_.scale));
        sums.equations.add((place.i + place.x) * scale, (place.j + place.y) * scale, channels_of(point.color), weight);
    }

    const fetex::PinchmapTexture& t_;
    const RowPainter& paint_;
    std::uint32_t n_, columns_, rows_;
    std::vector<OutlineSegment> outline_;
    ScannedOutline sides_;
    std::vector<std::uint8_t> active_, holds_outline_; ///< clusters
};

} // namespace

std::uint32_t signal_points(std::uint32_t scale) { return std::max(kLeastPoints, kPointsOfSample << scale); }

SignalFit fit_signal(fetex::PinchmapTexture& texture, const Silhouette& silhouette, const RowPainter& paint,
                     unsigned threads) {
    const SignalFitter fitter(texture, silhouette, paint);
    const std::uint32_t width = fetex::pinchmap_signal_width(texture), height = fetex::pinchmap_signal_height(texture);
    SampleEquations all(width, 0, height);
    SignalFit out;
    std::uint64_t lost = 0;
    for (std::uint32_t first = 0; first < texture.height; first += kRowsAtOnce) {
        std::vector<RowSums> sums;
        for (std::uint32_t j = first; j < std::min(first + kRowsAtOnce, texture.height); ++j)
            sums.push_back({fitter.equations(j)});
        parallel_for(sums.size(), threads,
                     [&](std::size_t k) { fitter.add(first + static_cast<std::uint32_t>(k), sums[k]); });
        for (const RowSums& row : sums) {
            all.add(row.equations);
            if (lost == 0 && row.lost > 0) out.lost_u = fitter.u(row.first_x), out.lost_v = fitter.v(row.first_y);
            lost += row.lost;
        }
    }
    out.lost = static_cast<double>(lost) / fitter.points();
    const SolvedSamples solved =
        all.solve([&](std::uint32_t a, std::uint32_t b) { return fitter.side(a, b); }, threads);
    out.rounds = solved.rounds, out.unseen = solved.unseen;
    const fetex::FbtSampleFormat format = fetex::silmap_fbt_format(texture.sample_format);
    const bool opaque = texture.sample_format == fetex::PinchmapSampleFormat::Rgb8;
    texture.signal.clear();
    for (const std::array<double, 4>& c : solved.colors) {
        const auto words = fetex::fbt_pack_sample({c[0], c[1], c[2], opaque ? 1 : c[3]}, format);
        texture.signal.insert(texture.signal.end(), words.begin(), words.begin() + fetex::fbt_sample_words(format));
    }
    return out;
}

} // namespace fetexc
