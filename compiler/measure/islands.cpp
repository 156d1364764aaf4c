// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/islands.h"

#include <algorithm>

#include "compiler/union_find.h"

namespace fetexc::measure {
namespace {

/// The label at a sample point: the truth's result, or the picture's class.
using Label = ResultId (SampleGrid::*)(std::size_t) const;

class IslandSearch {
  public:
    IslandSearch(const SampleGrid& grid, Label own, Label other)
        : grid_(grid), own_(own), other_(other), sets_(grid.size()) {}

    /// Counts islands that the other labels don't have; notes the largest.
    std::uint64_t run(Islands& out) {
        join();
        std::vector<std::uint32_t> points(grid_.size(), 0);
        std::vector<char> met(grid_.size(), 0);
        for (std::size_t k = 0; k < grid_.size(); ++k) {
            const std::uint32_t root = sets_.find(static_cast<std::uint32_t>(k));
            ++points[root];
            if (met[root] == 0 && is_met(k)) met[root] = 1;
        }
        std::uint64_t missing = 0;
        for (std::uint32_t k = 0; k < grid_.size(); ++k) {
            if (points[k] == 0 || met[k] != 0) continue;
            ++missing;
            const double ppm = 1e6 * points[k] / static_cast<double>(grid_.size());
            if (ppm > out.largest_ppm) out.largest_ppm = ppm, out.place = grid_.point(std::size_t{k});
        }
        return missing;
    }

  private:
    void join() {
        const GridSize n = grid_.pixels();
        for (std::uint32_t j = 0; j < n.height; ++j) {
            for (std::uint32_t i = 0; i < n.width; ++i) {
                const std::size_t k = grid_.index(i, j);
                for (const std::size_t next : {k + (i + 1 < n.width ? 1 : 0), k + (j + 1 < n.height ? n.width : 0)}) {
                    if (next != k && (grid_.*own_)(next) == (grid_.*own_)(k))
                        sets_.unite(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(next));
                }
            }
        }
    }

    /// The other labels have this one at the point or at one of its eight neighbours.
    [[nodiscard]] bool is_met(std::size_t k) const {
        const GridSize n = grid_.pixels();
        const auto i = static_cast<std::uint32_t>(k % n.width), j = static_cast<std::uint32_t>(k / n.width);
        for (std::uint32_t y = j - std::min(j, 1u); y <= std::min(j + 1, n.height - 1); ++y) {
            for (std::uint32_t x = i - std::min(i, 1u); x <= std::min(i + 1, n.width - 1); ++x) {
                if ((grid_.*other_)(grid_.index(x, y)) == (grid_.*own_)(k)) return true;
            }
        }
        return false;
    }

    const SampleGrid& grid_;
    Label own_, other_;
    UnionFind sets_;
};

} // namespace

Islands find_islands(const SampleGrid& grid) {
    Islands out;
    out.lost = IslandSearch(grid, &SampleGrid::truth, &SampleGrid::picture).run(out);
    out.invented = IslandSearch(grid, &SampleGrid::picture, &SampleGrid::truth).run(out);
    return out;
}

} // namespace fetexc::measure
