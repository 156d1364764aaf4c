// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/lend.h"

#include <algorithm>
#include <map>

#include "compiler/error_budget.h"
#include "compiler/silmap/point_moves.h"

namespace fetexc {
namespace {

constexpr int kRounds = 3;
constexpr std::size_t kTangle = 96; ///< slabs in the cells around a texel

/// Strides of a search for a point, 4 × 4 places first.
std::span<const std::int64_t> strides_of(fetex::SilmapCellFormat format) {
    static constexpr std::int64_t all[] = {32, 8, 2, 1};
    return std::span(all).subspan(format == fetex::SilmapCellFormat::Bits8 ? 2 : 0);
}

class Lender {
  public:
    Lender(SilmapCells& cells, fetex::SilmapCellFormat format)
        : cells_(cells), format_(format), moves_(cells, format), changed_(cells.cells.size(), 1) {}

    std::vector<std::uint32_t> run() {
        for (int round = 0; round < kRounds; ++round) {
            for (std::uint32_t k = 0; k < changed_.size(); ++k) {
                const SilmapCellData& c = cells_.cells[k];
                if (c.i == cells_.width || c.j == cells_.height || std::exchange(changed_[k], std::uint8_t{0}) == 0)
                    continue;
                if (try_texel(c.i, c.j)) mark_around(c.i, c.j);
            }
        }
        std::vector<std::uint32_t> out;
        for (const auto& [texel, had] : had_) {
            if (cells_.results[texel] != had) out.push_back(texel);
        }
        return out;
    }
    [[nodiscard]] std::uint64_t tried() const { return moves_.tried(); }

  private:
    /// Texels whose cells, or what those are linked to, have changed.
    void mark_around(std::uint32_t i, std::uint32_t j) {
        constexpr std::uint32_t reach = 2;
        for (std::uint32_t y = j - std::min(j, reach); y <= std::min(j + reach, cells_.height); ++y) {
            for (std::uint32_t x = i - std::min(i, reach); x <= std::min(i + reach, cells_.width); ++x) {
                if (const SilmapCellData* c = cells_.find(x, y)) changed_[index_of(*c)] = 1;
            }
        }
    }
    [[nodiscard]] std::uint32_t index_of(const SilmapCellData& c) const {
        return static_cast<std::uint32_t>(&c - cells_.cells.data());
    }

    /// Its four cells, and what they are linked to.
    bool gather(std::uint32_t i, std::uint32_t j) {
        ring_.clear(), around_.clear();
        for (const auto& [di, dj] : {std::pair(0u, 0u), {1u, 0u}, {0u, 1u}, {1u, 1u}}) {
            const SilmapCellData* c = cells_.find(i + di, j + dj);
            if (c == nullptr) return false;
            ring_.push_back(index_of(*c));
        }
        around_ = ring_;
        for (const std::uint32_t k : ring_) {
            for (const std::uint32_t n : cells_.cells[k].neighbours) {
                if (n < kOwnPoint && std::ranges::find(around_, n) == around_.end()) around_.push_back(n);
            }
        }
        return true;
    }

    [[nodiscard]] double wrong_in(const std::vector<std::uint32_t>& set) const {
        double sum = 0;
        for (const std::uint32_t k : set)
            sum += cells_.cells[k].wrong;
        return sum;
    }

    /// So much inside that no texel's colour could make it right, and every place of a point takes long to try.
    [[nodiscard]] bool is_tangle() const {
        std::size_t slabs = 0;
        for (const std::uint32_t k : ring_)
            slabs += cells_.cells[k].slabs;
        return slabs > kTangle;
    }

    bool try_texel(std::uint32_t i, std::uint32_t j) {
        if (!gather(i, j) || wrong_in(ring_) < budget::kSilmapLend || is_tangle()) return false;
        const std::size_t texel = std::size_t{j} * cells_.width + i;
        const ResultId had = cells_.results[texel];
        candidates_.clear();
        const auto candidate = [&](std::size_t k) {
            const ResultId r = cells_.results[k];
            if (r != had && std::ranges::find(candidates_, r) == candidates_.end()) candidates_.push_back(r);
        };
        if (i > 0) candidate(texel - 1);
        if (i + 1 < cells_.width) candidate(texel + 1);
        if (j > 0) candidate(texel - cells_.width);
        if (j + 1 < cells_.height) candidate(texel + cells_.width);
        add_thin_candidates(had);
        return std::ranges::any_of(candidates_, [&](ResultId r) { return try_result(texel, r); });
    }

    /// What no texel here has.
    void add_thin_candidates(ResultId had) {
        for (const std::uint32_t k : ring_) {
            const CellTruth truth = cells_.truth_of(cells_.cells[k]);
            for (const TruthSlab& slab : truth.slabs) {
                const auto add = [&](ResultId r) {
                    if (r != had && std::ranges::find(candidates_, r) == candidates_.end() &&
                        area_of(truth, r) > budget::kSilmapLendPart)
                        candidates_.push_back(r);
                };
                add(slab.left);
                for (const TruthLine& line : truth.all.lines_of(slab))
                    add(line.right);
            }
        }
    }

    bool try_result(std::size_t texel, ResultId result) {
        const double before = wrong_in(around_);
        saved_.clear();
        for (const std::uint32_t k : around_)
            saved_.push_back(cells_.cells[k]);
        const ResultId had = std::exchange(cells_.results[texel], result);
        for (const std::uint32_t k : ring_)
            relink_cell(cells_, cells_.cells[k]);
        for (int pass = 0; pass < 2; ++pass) {
            for (const std::uint32_t k : ring_) {
                if (cells_.cells[k].boundaries == 0) continue;
                if (pass == 0)
                    moves_.search(k, strides_of(format_));
                else
                    moves_.walk(k, 1);
            }
        }
        if (wrong_in(around_) < before - budget::kSilmapLent) {
            had_.emplace(static_cast<std::uint32_t>(texel), had); // the first time: its own
            return true;
        }
        cells_.results[texel] = had;
        for (std::size_t k = 0; k < around_.size(); ++k)
            cells_.cells[around_[k]] = saved_[k];
        return false;
    }

    SilmapCells& cells_;
    fetex::SilmapCellFormat format_;
    PointMoves moves_;
    std::vector<ResultId> candidates_;
    std::vector<std::uint8_t> changed_;     ///< by a texel's first cell, since it was tried
    std::map<std::uint32_t, ResultId> had_; ///< of texels: what is in their middle
    std::vector<std::uint32_t> ring_, around_;
    std::vector<SilmapCellData> saved_;
};

} // namespace

std::vector<std::uint32_t> lend_results(SilmapCells& cells, fetex::SilmapCellFormat format, std::uint64_t& tried) {
    Lender lender(cells, format);
    std::vector<std::uint32_t> out = lender.run();
    tried += lender.tried();
    return out;
}

} // namespace fetexc
