// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/misfits.h"

#include <iomanip>
#include <sstream>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"

namespace fetexc {
namespace {

/// In the canvas, 0 … 1.
std::string place_of(const SilmapCells& cells, std::uint32_t i, std::uint32_t j, const fetex::SilmapPoint& p) {
    std::ostringstream out;
    out << std::setprecision(4) << "u " << (i + p.x - 0.5) / cells.width << ", v " << (j + p.y - 0.5) / cells.height;
    return out.str();
}

std::string count_of(std::uint64_t n, const char* one, const char* several) {
    return std::to_string(n) + (n == 1 ? one : several);
}

std::string with_area(const std::string& text, double area) {
    std::ostringstream out;
    out << text << std::setprecision(2) << area << " square texels";
    return out.str();
}

} // namespace

bool holds_too_much(const SilmapCellData& c) {
    if (c.corners > 1) return true;
    for (std::uint32_t link = 0; link < 4; ++link) {
        if ((c.edges_across >> 8 * link & 255) != (c.boundaries >> link & 1)) return true;
    }
    return false;
}

void report_misfits(const SilmapCells& cells, const LostParts& lost, SilmapStats& stats,
                    std::vector<Diagnostic>& diagnostics) {
    const SilmapCellData* worst = nullptr;
    for (const SilmapCellData& c : cells.cells) {
        if (c.joined || c.wrong < budget::kSilmapCrowded || !holds_too_much(c)) continue;
        ++stats.cells_crowded;
        if (worst == nullptr || c.wrong > worst->wrong) worst = &c;
    }
    if (worst != nullptr) {
        diagnostics.push_back({Severity::Warning, diag::kSilmapCellsCrowded,
                               with_area(count_of(stats.cells_crowded, " cell holds", " cells hold") +
                                             " more than a point and its four links can show; wrong in the worst: ",
                                         worst->wrong),
                               place_of(cells, worst->i, worst->j, {0.5, 0.5})});
    }
    stats.parts_lost = lost.count;
    if (lost.count == 0) return;
    diagnostics.push_back({Severity::Warning, diag::kSilmapPartsLost,
                           with_area(count_of(lost.count, " part", " parts") +
                                         " of the picture have no texel's middle, and are not shown; the largest: ",
                                     lost.largest),
                           place_of(cells, lost.i, lost.j, {0.5, 0.5})});
}

} // namespace fetexc
