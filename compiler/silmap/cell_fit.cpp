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
        SilmapPoint point;
        std::array<double, 4> exit{}, right{};                     ///< own, by link
        std::array<double, 4> neighbour_exit{}, neighbour_right{}; ///< of the opposite link of the neighbour there
        double gain = 0;                                           ///< own and neighbours', square cells
        std::int64_t x = -1, y = -1;
    };

    [[nodiscard]] SilmapPoint position(std::int64_t x, std::int64_t y) const {
        return {fetex::silmap_position(format_, static_cast<std::uint32_t>(x)),
                fetex::silmap_position(format_, static_cast<std::uint32_t>(y))};
    }

    /// What the point at another place takes away.
    void evaluate(const SilmapCellData& c, Trial& t) const {
        constexpr std::array<SilmapPoint, 4> from_neighbour{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        t.gain = 0;
        const CellTruth truth = cells_.truth_of(c);
        for (std::uint32_t link = 0; link < 4; ++link) {
            const std::uint32_t neighbour = c.neighbours[link];
            if (neighbour == kNone) continue;
            t.exit[link] = ShownCell::exit_of(t.point, link, point_across(cells_, c, t.point, link));
            t.right[link] = link_area(truth, t.point, link, t.exit[link], c.shown.corners);
            t.gain += t.right[link] - c.right[link];
            if (neighbour == kOwnPoint) continue;
            const SilmapCellData& n = cells_.cells[neighbour];
            const std::uint32_t back = opposite(link);
            const SilmapPoint across{t.point.x + from_neighbour[link].x, t.point.y + from_neighbour[link].y};
            t.neighbour_exit[link] = ShownCell::exit_of(n.shown.point, back, across);
            t.neighbour_right[link] =
                link_area(cells_.truth_of(n), n.shown.point, back, t.neighbour_exit[link], n.shown.corners);
            t.gain += t.neighbour_right[link] - n.right[back];
        }
    }

    bool improve(std::uint32_t index, std::int64_t stride, std::uint64_t& tried) {
        SilmapCellData& c = cells_.cells[index];
        bool moved = false;
        for (;;) {
            Trial best, trial;
            best.gain = budget::kSilmapWorthAMove;
            for (std::int64_t dy = -stride; dy <= stride; dy += stride) {
                for (std::int64_t dx = -stride; dx <= stride; dx += stride) {
                    trial.x = c.x + dx, trial.y = c.y + dy;
                    if ((dx == 0 && dy == 0) || trial.x < 0 || trial.y < 0 || trial.x >= steps_ || trial.y >= steps_)
                        continue;
                    ++tried;
                    trial.point = position(trial.x, trial.y);
                    evaluate(c, trial);
                    if (trial.gain > best.gain) best = trial;
                }
            }
            if (best.x < 0) break;
            moved = true;
            accept(c, best);
        }
        if (moved) mark_around(c);
        return moved;
    }

    void accept(SilmapCellData& c, const Trial& t) {
        c.x = static_cast<std::uint32_t>(t.x), c.y = static_cast<std::uint32_t>(t.y);
        c.shown.point = t.point;
        for (std::uint32_t link = 0; link < 4; ++link) {
            if (c.neighbours[link] == kNone) continue;
            c.wrong -= t.right[link] - c.right[link];
            c.shown.exit[link] = t.exit[link], c.right[link] = t.right[link];
            if (c.neighbours[link] == kOwnPoint) continue;
            SilmapCellData& n = cells_.cells[c.neighbours[link]];
            const std::uint32_t back = opposite(link);
            n.wrong -= t.neighbour_right[link] - n.right[back];
            n.shown.exit[back] = t.neighbour_exit[link], n.right[back] = t.neighbour_right[link];
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
