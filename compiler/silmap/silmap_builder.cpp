// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/silmap_builder.h"

#include <algorithm>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/fbt/fbt_builder.h"
#include "compiler/parallel.h"
#include "compiler/silmap/cell_fit.h"
#include "compiler/silmap/cell_reader.h"
#include "compiler/silmap/lend.h"
#include "compiler/silmap/misfits.h"
#include "formats/fbt_samples.h"

namespace fetexc {
namespace {

using fetex::SilmapSampleFormat;

Error inconsistent() {
    return {ErrorClass::Runtime, diag::kPlanarInconsistent,
            "the planar map contradicts itself; please report this file", ""};
}

/// In the middles of texels.
std::vector<std::uint32_t> colors_of(const Scene& scene, const Compositor& compositor, const SilmapCells& cells,
                                     const SilmapOptions& options) {
    const fetex::FbtSampleFormat format = silmap_fbt_format(options.sample_format);
    const std::size_t words = fetex::fbt_sample_words(format);
    std::vector<std::uint32_t> out(words * cells.results.size());
    parallel_for(cells.height, options.threads, [&](std::size_t j) {
        const double y = (static_cast<double>(j) + 0.5) / cells.height * scene.extent.height;
        for (std::uint32_t i = 0; i < cells.width; ++i) {
            const std::size_t k = j * cells.width + i;
            const auto at = out.begin() + static_cast<std::ptrdiff_t>(words * k);
            if (i > 0 && cells.results[k] == cells.results[k - 1] && compositor.is_solid(cells.results[k])) {
                std::copy_n(at - static_cast<std::ptrdiff_t>(words), words, at);
                continue;
            }
            const Rgba c = compositor.color(cells.results[k], {(i + 0.5) / cells.width * scene.extent.width, y});
            const bool opaque = options.sample_format == SilmapSampleFormat::Rgb8;
            const auto packed = fetex::fbt_pack_sample({c.r, c.g, c.b, opaque ? 1 : c.a}, format);
            std::copy_n(packed.begin(), words, at);
        }
    });
    return out;
}

/// Points in the middle but where there is a boundary.
std::vector<std::uint16_t> packed_cells(const SilmapCells& cells, fetex::SilmapCellFormat format) {
    fetex::SilmapCell none;
    none.x = none.y = fetex::silmap_step(format, 0.5);
    const std::size_t columns = std::size_t{cells.width} + 1;
    std::vector<std::uint16_t> out(columns * (std::size_t{cells.height} + 1), fetex::silmap_pack_cell(format, none));
    for (const SilmapCellData& c : cells.cells) {
        if (c.boundaries == 0) continue;
        out[c.j * columns + c.i] =
            fetex::silmap_pack_cell(format, {c.x, c.y, (c.boundaries >> fetex::kSilmapEast & 1) != 0,
                                             (c.boundaries >> fetex::kSilmapSouth & 1) != 0});
    }
    return out;
}

void count_cells(const SilmapCells& cells, SilmapStats& stats) {
    stats.cells = (std::uint64_t{cells.width} + 1) * (std::uint64_t{cells.height} + 1);
    stats.cells_empty = stats.cells - cells.cells.size();
    for (const SilmapCellData& c : cells.cells) {
        if (c.boundaries == 0) {
            stats.cells_empty += c.plain ? 1 : 0;
            continue;
        }
        ++stats.cells_edge;
        stats.cells_corner += c.corners > 0 ? 1 : 0;
    }
}

/// What chords may miss edges by: as with cells of 8 bits where points are only settled.
double chord_of(fetex::SilmapCellFormat format, bool thorough) {
    return budget::kSilmapChord / fetex::silmap_steps(thorough ? format : fetex::SilmapCellFormat::Bits8);
}

} // namespace

Result<SilmapBuild> compile_silmap(const Scene& scene, const SilmapOptions& options, const ProgressSink& progress) {
    const Result<GridSize> size = texels_for(scene.extent, options.size);
    if (!size) return size.error();
    SilmapBuild build;
    build.report.scene = scene.stats;
    if (progress) progress("planar map", 0);
    const Grid grid = make_cell_grid(scene.extent, size.value().width, size.value().height);
    const Result<PlanarMap> map = PlanarMap::build(scene, grid, options.threads, build.report.planar, options.skip);
    if (!map) return map.error();
    const bool eight_bits = silmap_fbt_format(options.sample_format) == fetex::FbtSampleFormat::Rgba8;
    Compositor compositor(scene, options.skip, eight_bits ? ColorSteps::Rgba8 : ColorSteps::Rgba16);
    if (progress) progress("silmap", 0);
    const bool thorough =
        options.effort == SilmapEffort::Thorough ||
        (options.effort == SilmapEffort::Auto && cells_with_edges(map.value()) <= kSilmapThoroughCells);
    std::optional<ReadCells> drawing =
        read_cells(map.value(), scene, compositor, options.cell_format, chord_of(options.cell_format, thorough),
                   thorough && options.lend, options.threads, options.skip, build.report.planar);
    if (!drawing) return inconsistent();
    SilmapCells& cells = drawing->cells;
    link_cells(cells, options.threads);
    const double area = static_cast<double>(cells.width) * cells.height;
    build.stats.wrong_area_seed = wrong_area_of(cells) / area;
    if (progress) progress("silmap", 0.5);
    const FitCounts counts = fit_points(cells, options.cell_format, thorough, options.threads);
    build.stats.fit_rounds = counts.rounds, build.stats.positions_tried = counts.positions;
    std::vector<std::uint32_t> lent;
    if (thorough && options.lend) {
        lent = lend_results(cells, options.cell_format, build.stats.positions_tried);
        build.stats.positions_tried += fit_points(cells, options.cell_format, thorough, options.threads).positions;
    }
    build.stats.texels_lent = lent.size();
    const std::optional<LostParts> lost = lost_parts(map.value(), drawing->parts, cells, lent, options.threads);
    if (!lost) return inconsistent();
    build.stats.wrong_area = wrong_area_of(cells) / area;
    count_cells(cells, build.stats);
    report_misfits(cells, *lost, build.stats, build.report.diagnostics);
    fetex::SilmapTexture& t = build.texture;
    t.width = cells.width, t.height = cells.height;
    t.cell_format = options.cell_format, t.sample_format = options.sample_format;
    t.cells = packed_cells(cells, options.cell_format);
    t.colors = colors_of(scene, compositor, cells, options);
    if (options.mips) t.mips = fetex::silmap_make_mips(t);
    build.stats.gpu_bytes = fetex::silmap_gpu_bytes(t);
    return build;
}

} // namespace fetexc
