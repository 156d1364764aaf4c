// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/islands.h"

#include <algorithm>

#include "compiler/union_find.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kPlaces = 32;       ///< asked on a side of two pixels around a point
constexpr std::uint32_t kPointsAsked = 256; ///< of an island: a larger one that hides from all of them is none

/// Islands of the truth that the picture lacks, or the other way round.
class IslandSearch {
  public:
    enum class Of { Truth, Picture };
    IslandSearch(const Subject& subject, const SampleGrid& grid, Of of)
        : subject_(subject), grid_(grid), of_(of), sets_(grid.size()) {}

    /// Counts them; notes the largest.
    std::uint64_t run(Islands& out) {
        join();
        std::vector<std::uint32_t> points(grid_.size(), 0);
        std::vector<char> met(grid_.size(), 0);
        for (std::size_t k = 0; k < grid_.size(); ++k) {
            const std::uint32_t root = root_of(k);
            ++points[root];
            if (grid_.truth(k) == grid_.picture(k)) met[root] = 1;
        }
        look_around(met);
        std::uint64_t missing = 0;
        for (std::size_t k = 0; k < grid_.size(); ++k) {
            if (points[k] == 0 || met[k] != 0) continue;
            ++missing;
            const double ppm = 1e6 * points[k] / static_cast<double>(grid_.size());
            if (ppm > out.largest_ppm) out.largest_ppm = ppm, out.place = grid_.point(k);
        }
        return missing;
    }

  private:
    [[nodiscard]] ResultId label(std::size_t k) const { return of_ == Of::Truth ? grid_.truth(k) : grid_.picture(k); }
    std::uint32_t root_of(std::size_t k) { return sets_.find(static_cast<std::uint32_t>(k)); }

    void join() {
        const GridSize n = grid_.pixels();
        for (std::uint32_t j = 0; j < n.height; ++j) {
            for (std::uint32_t i = 0; i < n.width; ++i) {
                const std::size_t k = grid_.index(i, j);
                for (const std::size_t next : {k + (i + 1 < n.width ? 1 : 0), k + (j + 1 < n.height ? n.width : 0)}) {
                    if (next != k && label(next) == label(k))
                        sets_.unite(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(next));
                }
            }
        }
    }

    /// Of what is thinner than a pixel, truth and picture may show different points.
    void look_around(std::vector<char>& met) {
        std::vector<std::uint32_t> asked(grid_.size(), 0);
        for (std::size_t k = 0; k < grid_.size(); ++k) {
            const std::uint32_t root = root_of(k);
            if (met[root] == 0 && ++asked[root] <= kPointsAsked && is_near(k)) met[root] = 1;
        }
    }

    [[nodiscard]] bool is_near(std::size_t k) const {
        const TexturePoint p = grid_.point(k);
        const double du = 2.0 / grid_.pixels().width / kPlaces, dv = 2.0 / grid_.pixels().height / kPlaces;
        for (std::uint32_t y = 0; y < kPlaces; ++y) {
            for (std::uint32_t x = 0; x < kPlaces; ++x) {
                const TexturePoint q{p.u + (x + 0.5 - kPlaces / 2.0) * du, p.v + (y + 0.5 - kPlaces / 2.0) * dv};
                if (q.u < 0 || q.u > 1 || q.v < 0 || q.v > 1) continue;
                if (of_ == Of::Truth ? picture_shows(q, k) : subject_.truth.result_at(q) == grid_.picture(k))
                    return true;
            }
        }
        return false;
    }

    /// The truth's result at point k rather than what the picture has there.
    [[nodiscard]] bool picture_shows(TexturePoint q, std::size_t k) const {
        const Rgba color = subject_.picture.at(q);
        return color_distance(color, subject_.truth.color(grid_.truth(k), q)) <
               color_distance(color, subject_.truth.color(grid_.picture(k), q));
    }

    const Subject& subject_;
    const SampleGrid& grid_;
    Of of_;
    UnionFind sets_;
};

} // namespace

Islands find_islands(const Subject& subject, const SampleGrid& grid) {
    Islands out;
    out.lost = IslandSearch(subject, grid, IslandSearch::Of::Truth).run(out);
    out.invented = IslandSearch(subject, grid, IslandSearch::Of::Picture).run(out);
    return out;
}

} // namespace fetexc::measure
