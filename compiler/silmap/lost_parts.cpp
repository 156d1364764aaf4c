// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/lost_parts.h"

#include <algorithm>
#include <map>

#include "compiler/error_budget.h"

namespace fetexc {

void PartsRow::add_empty(ResultId result, bool middle) {
    const std::uint32_t vertex = reach_.add_empty(result);
    if (middle) see(vertex);
}

/// Regions: faces joined over edges that can't be seen.
void PartsRow::add_cell(const TexelMap& cell, bool middle) {
    const SweepResult& s = cell.sweep;
    joined_.reset(s.faces.size());
    for (std::uint32_t f = 0; f < s.faces.size(); ++f)
        joined_.unite(f, s.face(f));
    for (const Portion& p : s.portions) {
        if (cell.left_result(p) == cell.right_result(p)) joined_.unite(p.left, p.right);
    }
    number_.assign(s.faces.size(), kNone);
    region_of_face_.resize(s.faces.size()), region_result_.clear();
    for (std::uint32_t f = 0; f < s.faces.size(); ++f) {
        const std::uint32_t r = joined_.find(f);
        if (number_[r] == kNone) {
            number_[r] = static_cast<std::uint32_t>(region_result_.size());
            region_result_.push_back(cell.results[r]);
        }
        region_of_face_[f] = number_[r];
    }
    const std::uint32_t first = reach_.add_texel(cell, region_of_face_, region_result_);
    if (middle) see(first + region_of_face_[s.first_face]);
}

class PartsFinder {
  public:
    static std::optional<LostParts> run(const PlanarMap& map, std::vector<PartsRow>& rows, const SilmapCells& cells,
                                        std::span<const std::uint32_t> lent, unsigned threads) {
        std::vector<ReachabilityRow> reach;
        for (PartsRow& row : rows)
            reach.push_back(std::move(row.reach_));
        const ReachabilityGraph graph(map, reach, threads);
        if (graph.conflict()) return std::nullopt;
        const std::vector<std::uint32_t>& part = graph.components();
        std::vector<bool> seen(part.size(), false);
        for (std::uint32_t j = 0; j < rows.size(); ++j) {
            for (std::uint32_t v = 0; v < rows[j].seen_.size(); ++v) {
                if (rows[j].seen_[v]) seen[part[graph.row_start(j) + v]] = true;
            }
        }
        for (const std::uint32_t texel : lent) {
            const std::uint32_t i = texel % cells.width, j = texel / cells.width;
            for (const auto& [di, dj] : {std::pair(0u, 0u), {1u, 0u}, {0u, 1u}, {1u, 1u}}) {
                for (std::uint32_t v = graph.first_vertex(i + di, j + dj);
                     v < graph.row_start(j + dj + 1) && graph.column(v) <= i + di; ++v) {
                    if (graph.result(v) == cells.results[texel]) seen[part[v]] = true;
                }
            }
        }
        std::map<std::uint32_t, double> areas; // of lost parts
        for (std::uint32_t j = 0; j < rows.size(); ++j) {
            for (std::uint32_t v = graph.row_start(j); v < graph.row_start(j + 1); ++v) {
                if (!seen[part[v]]) areas[part[v]] += area_in(cells, graph.column(v), j, graph.result(v));
            }
        }
        LostParts out;
        for (const auto& [v, area] : areas) {
            if (area < budget::kSilmapLostPart) continue;
            ++out.count;
            if (area > out.largest) out.largest = area, out.i = graph.column(v), out.j = graph.row(v);
        }
        return out;
    }

  private:
    /// Of all that has the result in the cell: parts that are near each other may be taken for larger than they are.
    static double area_in(const SilmapCells& cells, std::uint32_t i, std::uint32_t j, ResultId result) {
        const SilmapCellData* c = cells.find(i, j);
        return c != nullptr ? area_of(cells.truth_of(*c), result) : 0;
    }
};

std::optional<LostParts> lost_parts(const PlanarMap& map, std::vector<PartsRow>& rows, const SilmapCells& cells,
                                    std::span<const std::uint32_t> lent, unsigned threads) {
    return PartsFinder::run(map, rows, cells, lent, threads);
}

} // namespace fetexc
