// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_fit.h"

#include <algorithm>
#include <atomic>

#include "compiler/error_budget.h"
#include "compiler/silmap/point_moves.h"

namespace fetexc {
namespace {

/// Cells of one class are three cells apart, counted along the axes, or more: what one's move changes, none of the
/// others reads.
constexpr std::uint32_t kClasses = 5;
std::uint32_t class_of(const SilmapCellData& c) { return (c.i + 2 * c.j) % kClasses; }

constexpr int kSettleRounds = 2, kMostRounds = 32, kHeavyRounds = 4;

/// Steps of a walk's strides, from the first on.
std::span<const std::int64_t> strides_of(fetex::SilmapCellFormat format) {
    static constexpr std::int64_t all[] = {8, 2, 1};
    return std::span(all).subspan(format == fetex::SilmapCellFormat::Bits8 ? 2 : 0);
}

/// Of settling.
std::span<const std::int64_t> settling_strides_of(fetex::SilmapCellFormat format) {
    return strides_of(format).first(format == fetex::SilmapCellFormat::Bits8 ? 1 : 2);
}

/// Of settling by samples, which tell no finer.
std::span<const std::int64_t> sampled_strides_of(fetex::SilmapCellFormat format) {
    static constexpr std::int64_t all[] = {16, 8, 4, 1};
    return format == fetex::SilmapCellFormat::Bits8 ? std::span(all).last(1) : std::span(all).first(3);
}

/// Of samples: an 8-bit point goes an eighth of a cell or not at all, and must not be led astray.
std::uint32_t lines_of(fetex::SilmapCellFormat format) { return format == fetex::SilmapCellFormat::Bits8 ? 16 : 8; }

class PointFit {
  public:
    PointFit(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads,
             std::span<const CellSamples> samples = {})
        : cells_(cells), format_(format), threads_(threads), samples_(samples), dirty_(cells.cells.size(), 1) {
        for (std::uint32_t k = 0; k < cells.cells.size(); ++k) {
            const SilmapCellData& c = cells.cells[k];
            if (c.boundaries != 0) classes_[class_of(c)].push_back(k);
        }
    }

    /// Only the cells that have much wrong area, with their neighbours, and those around what moves.
    void pick_worth_settling() {
        constexpr std::size_t chunk = 256;
        parallel_for_chunks(dirty_.size(), chunk, threads_, [&](std::size_t first, std::size_t end) {
            const PointMoves moves(cells_, format_);
            for (auto k = static_cast<std::uint32_t>(first); k < end; ++k)
                dirty_[k] = moves.is_worth_settling(k) ? 1 : 0;
        });
    }

    FitCounts settle() {
        const auto strides = samples_.empty() ? settling_strides_of(format_) : sampled_strides_of(format_);
        const auto settle = [&](PointMoves& m, std::uint32_t k) {
            return m.settle(k, strides) - budget::kSilmapSettleAround;
        };
        for (int round = 0; round < kSettleRounds && sweep(settle); ++round)
            ;
        return counts_;
    }

    FitCounts run(bool thorough) {
        settle();
        if (!thorough) return counts_;
        const auto strides = strides_of(format_);
        std::ranges::fill(dirty_, std::uint8_t{1});
        bool moved = sweep([&](PointMoves& m, std::uint32_t k) {
            double won = 0;
            for (const std::int64_t stride : strides)
                won += m.walk(k, stride);
            return won;
        });
        for (int round = 1; round < kMostRounds && moved; ++round)
            moved = sweep(kWalk);
        for (int round = 0; round < kHeavyRounds && search_heavy(); ++round)
            ;
        return counts_;
    }

  private:
    static constexpr auto kWalk = [](PointMoves& m, std::uint32_t k) { return m.walk(k, 1); };

    /// The points of cells whose surroundings have changed. move: what it has won.
    template <class Move> bool sweep(const Move& move) {
        constexpr std::size_t chunk = 64;
        bool moved = false;
        ++counts_.rounds;
        for (const std::vector<std::uint32_t>& members : classes_) {
            const std::size_t chunks = (members.size() + chunk - 1) / chunk;
            std::vector<std::uint64_t> tried(chunks), moves(chunks);
            parallel_for(chunks, threads_, [&](std::size_t n) {
                PointMoves mover(cells_, format_, samples_);
                for (std::size_t k = n * chunk; k < std::min(members.size(), (n + 1) * chunk); ++k) {
                    if (std::atomic_ref(dirty_[members[k]]).exchange(0, std::memory_order_relaxed) == 0) continue;
                    if (move(mover, members[k]) > 0) mark_around(members[k]), ++moves[n];
                }
                tried[n] = mover.tried();
            });
            for (std::size_t n = 0; n < chunks; ++n)
                counts_.positions += tried[n], moved = moved || moves[n] > 0;
        }
        return moved;
    }

    /// Of the cells that matter in the whole, all positions. Few of a large picture, many of a small one.
    bool search_heavy() {
        const double bar = budget::kSilmapHeavy * wrong_area_of(cells_);
        PointMoves searcher(cells_, format_);
        bool moved = false;
        for (const std::vector<std::uint32_t>& members : classes_) {
            for (const std::uint32_t k : members) {
                if (searcher.wrong_around(k) > bar && searcher.search(k, strides_of(format_)) > 0)
                    mark_around(k), moved = true;
            }
        }
        counts_.positions += searcher.tried();
        for (int round = 0; round < kMostRounds && moved && sweep(kWalk); ++round)
            ;
        return moved;
    }

    void mark_around(std::uint32_t k) {
        for (const std::uint32_t n : cells_.cells[k].neighbours) {
            if (n >= kOwnPoint) continue;
            mark(n);
            for (const std::uint32_t m : cells_.cells[n].neighbours) {
                if (m < kOwnPoint && m != k) mark(m);
            }
        }
    }
    void mark(std::uint32_t k) { std::atomic_ref(dirty_[k]).store(1, std::memory_order_relaxed); }

    SilmapCells& cells_;
    fetex::SilmapCellFormat format_;
    unsigned threads_;
    std::span<const CellSamples> samples_;
    std::vector<std::uint8_t> dirty_;
    std::array<std::vector<std::uint32_t>, kClasses> classes_;
    FitCounts counts_;
};

} // namespace

FitCounts fit_points(SilmapCells& cells, fetex::SilmapCellFormat format, bool thorough, unsigned threads) {
    return PointFit(cells, format, threads).run(thorough);
}

FitCounts fit_points_by_samples(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads,
                                double& wrong_area_seed) {
    constexpr std::size_t chunk = 256;
    const std::uint32_t lines = lines_of(format);
    UnwrittenVector<CellSamples> samples(cells.cells.size());
    parallel_for_chunks(samples.size(), chunk, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k) {
            SilmapCellData& c = cells.cells[k];
            if (c.boundaries == 0) { // nothing moves here
                cells.measure(c);
                continue;
            }
            samples[k] = CellSamples(cells.truth_of(c), c.shown.corners, lines);
            c.shown.exit = exits_of(cells, c, c.shown.point);
            c.wrong = samples[k].all_but_last();
            for (std::uint32_t link = 0; link < 4; ++link) {
                c.right[link] = samples[k].link_area(c.shown.point, link, c.shown.exit[link], c.shown.corners);
                c.wrong -= c.right[link];
            }
        }
    });
    wrong_area_seed = wrong_area_of(cells);
    PointFit fit(cells, format, threads, samples);
    fit.pick_worth_settling();
    const FitCounts out = fit.settle();
    parallel_for_chunks(samples.size(), chunk, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k) {
            if (cells.cells[k].boundaries != 0) cells.measure(cells.cells[k]);
        }
    });
    return out;
}

double wrong_area_of(const SilmapCells& cells) {
    double sum = 0;
    for (const SilmapCellData& c : cells.cells)
        sum += c.joined ? 0 : c.wrong;
    return sum;
}

} // namespace fetexc
