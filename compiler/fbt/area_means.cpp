// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/area_means.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/fbt/samples.h"
#include "compiler/gauss.h"
#include "compiler/parallel.h"
#include "compiler/planar/texel_map.h"
#include "compiler/planar/trapezoid_area.h"
#include "compiler/planar/trapezoid_sides.h"

namespace fetexc {
namespace {

void add(Rgba& sum, const Rgba& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

Rgba scaled(const Rgba& c, double factor) { return {c.r * factor, c.g * factor, c.b * factor, c.a * factor}; }

double difference(const Rgba& a, const Rgba& b) {
    return std::max({std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b), std::fabs(a.a - b.a)});
}

/// Between two edges or sides of a texel, and two levels; planar space.
struct Strip {
    std::uint32_t left = kNone, right = kNone; ///< sweep edges
    double y0 = 0, y1 = 0;
    double u0 = 0, u1 = 1; ///< part of the way from left to right
};

/// A sum of colours, of weights, the range that the colours have, and how far they are from changing evenly along the
/// lines of points.
struct Estimate {
    Rgba sum;
    double weight = 0, bend = 0;
    Rgba least{INFINITY, INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY, -INFINITY};

    void add_sample(const Rgba& c, double w) {
        add(sum, c, w), weight += w;
        least = {std::min(least.r, c.r), std::min(least.g, c.g), std::min(least.b, c.b), std::min(least.a, c.a)};
        most = {std::max(most.r, c.r), std::max(most.g, c.g), std::max(most.b, c.b), std::max(most.a, c.a)};
    }
    void add_part(const Estimate& part) { add(sum, part.sum, 1), weight += part.weight; }
    [[nodiscard]] Rgba mean() const { return scaled(sum, 1 / weight); }
    [[nodiscard]] double span() const { return difference(least, most); }
};

/// Integrates one texel after another of a row.
class TexelMeans {
  public:
    TexelMeans(const PlanarMap& map, const Scene& scene, const Compositor& compositor, MipStats& stats)
        : map_(map), grid_(map.grid()), scene_(scene), compositor_(compositor), stats_(stats), sides_(map, 0, 0) {}

    Rgba whole(std::uint32_t i, std::uint32_t j, ResultId result) {
        ++stats_.texels;
        if (compositor_.is_solid(result)) {
            ++stats_.texels_solid;
            return compositor_.color(result, {});
        }
        sides_ = TrapezoidSides(map_, i, j);
        return mean({kNone, kNone, sides_.rows().low, sides_.rows().high}, result);
    }

    Rgba parts(const TexelMap& texel) {
        ++stats_.texels;
        sides_ = TrapezoidSides(map_, texel);
        const double texel_area = static_cast<double>(grid_.px) * static_cast<double>(grid_.py);
        TrapezoidAreas areas(map_, texel);
        Rgba sum;
        for (const Trapezoid& t : texel.sweep.trapezoids) {
            const double share = areas.of(t).area / texel_area;
            if (!(share > 0)) continue;
            const ResultId result = texel.results[t.face];
            ++stats_.trapezoids;
            add(sum, compositor_.is_solid(result) ? compositor_.color(result, {}) : mean(strip_of(t), result), share);
        }
        return sum;
    }

  private:
    static constexpr int kHalvings = 5; ///< of a texel or trapezoid, in each direction: 1/32 of it

    [[nodiscard]] Strip strip_of(const Trapezoid& t) const {
        const Extent1 y = sides_.levels(t);
        return {t.left, t.right, y.low, y.high};
    }

    [[nodiscard]] Rgba paint_at(ResultId result, double x, double y) {
        ++stats_.paint_samples;
        return compositor_.color(result, to_canvas(scene_, grid_, x, y));
    }

    /// Three levels, three points on each, weighted by their lengths.
    [[nodiscard]] Estimate gauss(const Strip& s, ResultId result) {
        Estimate e;
        std::array<std::array<Rgba, 3>, 3> colors;
        for (std::size_t row = 0; row < 3; ++row) {
            const GaussPoint& v = kGauss[row];
            const double y = s.y0 + v.at * (s.y1 - s.y0);
            const Extent1 x = sides_.at(s.left, s.right, y);
            const double w = v.weight * (s.y1 - s.y0) * (s.u1 - s.u0) * std::max(x.size(), 0.0);
            if (!(w > 0)) {
                e.bend = INFINITY;
                continue;
            }
            for (std::size_t column = 0; column < 3; ++column) {
                const GaussPoint& u = kGauss[column];
                colors[row][column] = paint_at(result, x.at(s.u0 + u.at * (s.u1 - s.u0)), y);
                e.add_sample(colors[row][column], w * u.weight);
            }
        }
        for (std::size_t k = 0; k < 3; ++k)
            e.bend = std::max({e.bend, bend(colors[k]), bend({colors[0][k], colors[1][k], colors[2][k]})});
        return e;
    }

    static double bend(const std::array<Rgba, 3>& c) {
        return difference(
            c[1], {0.5 * (c[0].r + c[2].r), 0.5 * (c[0].g + c[2].g), 0.5 * (c[0].b + c[2].b), 0.5 * (c[0].a + c[2].a)});
    }

    static std::array<Strip, 4> quarters(const Strip& s) {
        const double y = 0.5 * (s.y0 + s.y1), u = 0.5 * (s.u0 + s.u1);
        return {{{s.left, s.right, s.y0, y, s.u0, u},
                 {s.left, s.right, s.y0, y, u, s.u1},
                 {s.left, s.right, y, s.y1, s.u0, u},
                 {s.left, s.right, y, s.y1, u, s.u1}}};
    }

    /// Quarters, until the paint changes evenly, or they say the same as the whole (budget::kMeanTolerance); and it
    /// changes little enough for a kink that the points don't see (budget::kMeanSpan).
    [[nodiscard]] Estimate refined(const Strip& s, const Estimate& whole, ResultId result, int halvings) {
        if (!(whole.weight > 0) || halvings == 0) return whole;
        const bool little = whole.span() <= budget::kMeanSpan;
        if (little && whole.bend <= budget::kMeanTolerance) return whole;
        const std::array<Strip, 4> parts = quarters(s);
        std::array<Estimate, 4> estimates;
        Estimate sum;
        for (std::size_t k = 0; k < 4; ++k)
            sum.add_part(estimates[k] = gauss(parts[k], result));
        if (!(sum.weight > 0)) return whole;
        if (little && difference(sum.mean(), whole.mean()) <= budget::kMeanTolerance) return sum;
        Estimate better;
        for (std::size_t k = 0; k < 4; ++k)
            better.add_part(refined(parts[k], estimates[k], result, halvings - 1));
        return better;
    }

    [[nodiscard]] Rgba mean(const Strip& s, ResultId result) {
        ++stats_.areas_sampled;
        const Estimate e = refined(s, gauss(s, result), result, kHalvings);
        if (e.weight > 0) return e.mean();
        return paint_at(result, sides_.columns().at(0.5), 0.5 * (s.y0 + s.y1)); // no area to speak of
    }

    const PlanarMap& map_;
    const Grid& grid_;
    const Scene& scene_;
    const Compositor& compositor_;
    MipStats& stats_;
    TrapezoidSides sides_; ///< of the texel
};

/// Sums of one row of blocks: its rows of texels from top to bottom, each from left to right.
class BlockRow {
  public:
    BlockRow(const PlanarMap& map, const Scene& scene, Compositor& compositor, std::uint32_t columns, Rgba* sums)
        : map_(map), mapper_(map, scene, compositor, planar_stats_), means_(map, scene, compositor, stats),
          columns_(columns), sums_(sums) {}

    bool add_row(std::uint32_t j) {
        bool good = true;
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i == map_.grid().width || !good) return;
            if (map_.sub_edges(i, j).empty()) {
                add(sums_[i / columns_], means_.whole(i, j, mapper_.lookup()(corner)), 1);
            } else if (mapper_.analyse(i, j, corner, texel_)) {
                add(sums_[i / columns_], means_.parts(texel_), 1);
            } else {
                good = false;
            }
        });
        return good;
    }

    MipStats stats;

  private:
    const PlanarMap& map_;
    PlanarStats planar_stats_;
    TexelMapper mapper_;
    TexelMeans means_;
    TexelMap texel_;
    std::uint32_t columns_;
    Rgba* sums_;
};

} // namespace

bool block_means(const PlanarMap& map, const Scene& scene, Compositor& compositor, std::uint32_t columns,
                 std::uint32_t rows, unsigned threads, MeanPicture& out, MipStats& stats) {
    out.width = map.grid().width / columns, out.height = map.grid().height / rows;
    out.colors.assign(static_cast<std::size_t>(out.width) * out.height, {});
    std::vector<char> good(out.height, 1);
    std::vector<MipStats> row_stats(out.height);
    parallel_for(out.height, threads, [&](std::size_t r) {
        Rgba* sums = out.colors.data() + r * out.width;
        BlockRow block(map, scene, compositor, columns, sums);
        for (std::uint32_t j = 0; j < rows && good[r] != 0; ++j)
            good[r] = block.add_row(static_cast<std::uint32_t>(r) * rows + j) ? 1 : 0;
        std::for_each(sums, sums + out.width, [&](Rgba& c) { c = scaled(c, 1.0 / columns / rows); });
        row_stats[r] = block.stats;
    });
    for (const MipStats& s : row_stats) {
        stats.texels += s.texels, stats.texels_solid += s.texels_solid, stats.trapezoids += s.trapezoids;
        stats.areas_sampled += s.areas_sampled, stats.paint_samples += s.paint_samples;
    }
    return std::find(good.begin(), good.end(), 0) == good.end();
}

MeanPicture block_means(const MeanPicture& fine, std::uint32_t columns, std::uint32_t rows, unsigned threads) {
    MeanPicture out{fine.width / columns, fine.height / rows, {}};
    out.colors.resize(static_cast<std::size_t>(out.width) * out.height);
    parallel_for(out.height, threads, [&](std::size_t r) {
        for (std::uint32_t i = 0; i < out.width; ++i) {
            Rgba sum;
            for (std::size_t j = r * rows; j < (r + 1) * rows; ++j) {
                for (std::size_t k = 0; k < columns; ++k)
                    add(sum, fine.colors[j * fine.width + std::size_t{i} * columns + k], 1);
            }
            out.colors[r * out.width + i] = scaled(sum, 1.0 / columns / rows);
        }
    });
    return out;
}

} // namespace fetexc
