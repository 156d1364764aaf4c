// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_fit.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Cells of one class are three cells apart, counted along the axes, or more: what one's move changes, none of the
/// others reads.
constexpr std::uint32_t kClasses = 5;
std::uint32_t class_of(const SilmapCellData& c) { return (c.i + 2 * c.j) % kClasses; }

constexpr std::uint32_t opposite(std::uint32_t link) { return link ^ 2u; }

class PointFit {
  public:
    PointFit(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads)
        : cells_(cells), format_(format), steps_(static_cast<std::int64_t>(fetex::silmap_steps(format))),
          threads_(threads), dirty_(cells.cells.size()) {
        for (std::uint32_t k = 0; k < cells.cells.size(); ++k) {
            const SilmapCellData& c = cells.cells[k];
            if (c.boundaries != 0) classes_[class_of(c)].push_back(k);
        }
    }

    FitCounts run() {
        for (std::int64_t stride = steps_ / 16 > 0 ? steps_ / 16 : 1; stride > 0; stride /= 2) {
            for (auto& d : dirty_)
                d = 1;
            for (int round = 0; round < 30 && sweep(stride); ++round)
                ++counts_.rounds;
        }
        return counts_;
    }

  private:
    bool sweep(std::int64_t stride) {
        bool moved = false;
        constexpr std::size_t chunk = 64;
        for (const std::vector<std::uint32_t>& members : classes_) {
            const std::size_t chunks = (members.size() + chunk - 1) / chunk;
            std::vector<std::uint64_t> tried(chunks), moves(chunks);
            parallel_for(chunks, threads_, [&](std::size_t n) {
                for (std::size_t k = n * chunk; k < std::min(members.size(), (n + 1) * chunk); ++k) {
                    if (std::atomic_ref(dirty_[members[k]]).exchange(0, std::memory_order_relaxed) == 0) continue;
                    moves[n] += improve(members[k], stride, tried[n]) ? 1 : 0;
                }
            });
            for (std::size_t n = 0; n < chunks; ++n)
                counts_.positions += tried[n], moved = moved || moves[n] > 0;
        }
        return moved;
    }

    struct Trial {
        ShownCell own;
        std::array<double, 4> exit{}; ///< of neighbours, by link
        std::array<double, 4> wrong{};
        double own_wrong = 0, sum = 0;
    };

    [[nodiscard]] SilmapPoint position(std::int64_t x, std::int64_t y) const {
        return {fetex::silmap_position(format_, static_cast<std::uint32_t>(x)),
                fetex::silmap_position(format_, static_cast<std::uint32_t>(y))};
    }

    [[nodiscard]] double sum_now(const SilmapCellData& c) const {
        double sum = c.wrong;
        for (const std::uint32_t n : c.neighbours) {
            if (n < kOwnPoint) sum += cells_.cells[n].wrong;
        }
        return sum;
    }

    /// False: not less than `bar`.
    bool evaluate(const SilmapCellData& c, const SilmapPoint& p, double bar, Trial& t) const {
        t.own = shown_with(cells_, c, p);
        t.own_wrong = cells_.wrong(c, t.own);
        t.sum = t.own_wrong;
        constexpr std::array<SilmapPoint, 4> from_neighbour{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        for (std::uint32_t link = 0; link < 4 && t.sum < bar; ++link) {
            if (c.neighbours[link] >= kOwnPoint) continue;
            const SilmapCellData& n = cells_.cells[c.neighbours[link]];
            ShownCell shown = n.shown;
            shown.link(opposite(link), {p.x + from_neighbour[link].x, p.y + from_neighbour[link].y});
            t.exit[link] = shown.exit[opposite(link)];
            t.wrong[link] = cells_.wrong(n, shown);
            t.sum += t.wrong[link];
        }
        return t.sum < bar;
    }

    bool improve(std::uint32_t index, std::int64_t stride, std::uint64_t& tried) {
        SilmapCellData& c = cells_.cells[index];
        bool moved = false;
        double bar = sum_now(c) - budget::kSilmapWorthAMove;
        for (;;) {
            Trial best, trial;
            std::int64_t best_x = -1, best_y = -1;
            if (!(bar > 0)) break;
            for (std::int64_t dy = -stride; dy <= stride; dy += stride) {
                for (std::int64_t dx = -stride; dx <= stride; dx += stride) {
                    const std::int64_t x = c.x + dx, y = c.y + dy;
                    if ((dx == 0 && dy == 0) || x < 0 || y < 0 || x >= steps_ || y >= steps_) continue;
                    ++tried;
                    if (!evaluate(c, position(x, y), bar, trial)) continue;
                    best = trial, bar = trial.sum, best_x = x, best_y = y;
                }
            }
            if (best_x < 0) break;
            moved = true;
            accept(c, best, best_x, best_y);
            bar = best.sum - budget::kSilmapWorthAMove;
        }
        if (moved) mark_around(c);
        return moved;
    }

    void accept(SilmapCellData& c, const Trial& t, std::int64_t x, std::int64_t y) {
        c.x = static_cast<std::uint32_t>(x), c.y = static_cast<std::uint32_t>(y);
        c.shown = t.own, c.wrong = t.own_wrong;
        for (std::uint32_t link = 0; link < 4; ++link) {
            if (c.neighbours[link] >= kOwnPoint) continue;
            SilmapCellData& n = cells_.cells[c.neighbours[link]];
            n.shown.exit[opposite(link)] = t.exit[link], n.wrong = t.wrong[link];
        }
    }

    void mark_around(const SilmapCellData& c) {
        for (const std::uint32_t n : c.neighbours) {
            if (n >= kOwnPoint) continue;
            mark(n);
            for (const std::uint32_t m : cells_.cells[n].neighbours) {
                if (m < kOwnPoint && &cells_.cells[m] != &c) mark(m);
            }
        }
    }
    void mark(std::uint32_t k) { std::atomic_ref(dirty_[k]).store(1, std::memory_order_relaxed); }

    SilmapCells& cells_;
    fetex::SilmapCellFormat format_;
    std::int64_t steps_;
    unsigned threads_;
    std::vector<std::uint8_t> dirty_;
    std::array<std::vector<std::uint32_t>, kClasses> classes_;
    FitCounts counts_;
};

} // namespace

void place_seeds(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads) {
    for (SilmapCellData& c : cells.cells) {
        c.x = fetex::silmap_step(format, c.seed.x), c.y = fetex::silmap_step(format, c.seed.y);
        c.shown.point = {fetex::silmap_position(format, c.x), fetex::silmap_position(format, c.y)};
    }
    link_cells(cells, threads);
}

FitCounts fit_points(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads) {
    return PointFit(cells, format, threads).run();
}

double wrong_area_of(const SilmapCells& cells) {
    double sum = 0;
    for (const SilmapCellData& c : cells.cells)
        sum += c.wrong;
    return sum;
}

} // namespace fetexc
