// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/silmap_builder.h"

#include <algorithm>
#include <iterator>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/fbt/fbt_builder.h"
#include "compiler/parallel.h"
#include "compiler/silmap/cell_fit.h"
#include "compiler/silmap/cell_reader.h"
#include "compiler/silmap/cell_samples.h"
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

/// Words of a sample.
std::size_t words_of(const SilmapOptions& options) {
    return fetex::fbt_sample_words(silmap_fbt_format(options.sample_format));
}

void pack(const Rgba& c, const SilmapOptions& options, std::uint32_t* words) {
    const bool opaque = options.sample_format == SilmapSampleFormat::Rgb8;
    const auto packed =
        fetex::fbt_pack_sample({c.r, c.g, c.b, opaque ? 1 : c.a}, silmap_fbt_format(options.sample_format));
    std::copy_n(packed.begin(), words_of(options), words);
}

/// In the middles of texels.
std::vector<std::uint32_t> colors_of(const Scene& scene, const Compositor& compositor, const SilmapCells& cells,
                                     const SilmapOptions& options) {
    const std::size_t words = words_of(options);
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
            pack(c, options, &out[words * k]);
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

Result<PlanarMap> map_of_cells(const Scene& scene, const SilmapOptions& options, SilmapReport& report) {
    const Result<GridSize> size = texels_for(scene.extent, options.size);
    if (!size) return size.error();
    report.scene = scene.stats;
    const Grid grid = make_cell_grid(scene.extent, size.value().width, size.value().height);
    return PlanarMap::build(scene, grid, options.threads, report.planar, options.skip);
}

/// How points are fitted: Quick by exact areas, or by samples where cells are many.
enum class Fit : std::uint8_t { Thorough, Quick, Sampled };

Fit fit_of(const SilmapOptions& options, const PlanarMap& map) {
    if (options.effort == SilmapEffort::Thorough) return Fit::Thorough;
    if (cells_with_edges(map) > kSilmapThoroughCells) return Fit::Sampled;
    return options.effort == SilmapEffort::Auto ? Fit::Thorough : Fit::Quick;
}

void fit(SilmapCells& cells, const SilmapOptions& options, Fit how, SilmapStats& stats) {
    double seed = 0;
    FitCounts counts;
    if (how == Fit::Sampled) {
        join_cells(cells, options.threads);
        counts = fit_points_by_samples(cells, options.cell_format, options.threads, seed);
    } else {
        link_cells(cells, options.threads);
        seed = wrong_area_of(cells);
        counts = fit_points(cells, options.cell_format, how == Fit::Thorough, options.threads);
    }
    stats.wrong_area_seed = seed / (static_cast<double>(cells.width) * cells.height);
    stats.fit_rounds = counts.rounds, stats.positions_tried = counts.positions;
}

/// Texels that lent their colour to thin parts beside them.
std::vector<std::uint32_t> lend(SilmapCells& cells, const SilmapOptions& options, SilmapStats& stats) {
    std::vector<std::uint32_t> lent = lend_results(cells, options.cell_format, stats.positions_tried);
    stats.positions_tried += fit_points(cells, options.cell_format, true, options.threads).positions;
    stats.texels_lent = lent.size();
    return lent;
}

/// Everything but colours.
void write_cells(const SilmapCells& cells, const LostParts& lost, const SilmapOptions& options, SilmapBuild& build) {
    build.stats.wrong_area = wrong_area_of(cells) / (static_cast<double>(cells.width) * cells.height);
    count_cells(cells, build.stats);
    report_misfits(cells, lost, build.stats, build.report.diagnostics);
    fetex::SilmapTexture& t = build.texture;
    t.width = cells.width, t.height = cells.height;
    t.cell_format = options.cell_format, t.sample_format = options.sample_format;
    t.cells = packed_cells(cells, options.cell_format);
}

void finish(const SilmapOptions& options, SilmapBuild& build) {
    if (options.mips) build.texture.mips = fetex::silmap_make_mips(build.texture);
    build.stats.gpu_bytes = fetex::silmap_gpu_bytes(build.texture);
}

/// Where points are only settled, chords are as with cells of 8 bits; by samples: a quarter of the way from one to the
/// next, and seeds of 16 bits aren't sought for long.
CellReading reading_of(fetex::SilmapCellFormat format, Fit how) {
    constexpr double near_enough = 1.0 / 4;
    if (how == Fit::Sampled) {
        return {format, 1.0 / (4 * CellSamples::kColumns), format == fetex::SilmapCellFormat::Bits16 ? near_enough : 0};
    }
    const auto chords = how == Fit::Thorough ? format : fetex::SilmapCellFormat::Bits8;
    return {format, budget::kSilmapChord / fetex::silmap_steps(chords), 0};
}

} // namespace

Result<SilmapBuild> compile_silmap(const Scene& scene, const SilmapOptions& options, const ProgressSink& progress) {
    SilmapBuild build;
    if (progress) progress("planar map", 0);
    const Result<PlanarMap> map = map_of_cells(scene, options, build.report);
    if (!map) return map.error();
    const bool eight_bits = silmap_fbt_format(options.sample_format) == fetex::FbtSampleFormat::Rgba8;
    Compositor compositor(scene, options.skip, eight_bits ? ColorSteps::Rgba8 : ColorSteps::Rgba16);
    if (progress) progress("silmap", 0);
    const Fit how = fit_of(options, map.value());
    const bool lends = how == Fit::Thorough && options.lend;
    std::optional<ReadCells> drawing = read_cells(map.value(), scene, compositor, reading_of(options.cell_format, how),
                                                  lends, options.threads, options.skip, build.report.planar);
    if (!drawing) return inconsistent();
    SilmapCells& cells = drawing->cells;
    if (progress) progress("silmap", 0.5);
    fit(cells, options, how, build.stats);
    std::vector<std::uint32_t> lent;
    if (lends) lent = lend(cells, options, build.stats);
    const std::optional<LostParts> lost = lost_parts(map.value(), drawing->parts, cells, lent, options.threads);
    if (!lost) return inconsistent();
    write_cells(cells, *lost, options, build);
    build.texture.colors = colors_of(scene, compositor, cells, options);
    finish(options, build);
    return build;
}

Result<SilmapBuild> compile_silmap(const FeaturedImage& picture, const SilmapOptions& options,
                                   const ProgressSink& progress) {
    SilmapBuild build;
    CompileOptions how;
    how.size = options.size, how.threads = options.threads, how.skip = options.skip;
    how.sample_format = silmap_fbt_format(options.sample_format);
    const Result<FbtBuild> fbt = compile_fbt(picture, how, progress);
    if (!fbt) return fbt.error();
    if (progress) progress("silmap", 0);
    const Result<PlanarMap> map = map_of_cells(picture.features, options, build.report);
    if (!map) return map.error();
    const Fit fitting = fit_of(options, map.value());
    std::optional<SilmapCells> cells =
        read_feature_cells(map.value(), picture.features, reading_of(options.cell_format, fitting), options.threads,
                           options.skip, build.report.planar);
    if (!cells) return inconsistent();
    fit(*cells, options, fitting, build.stats);
    write_cells(*cells, {}, options, build);
    const std::size_t words = words_of(options);
    build.texture.colors.resize(words * cells->results.size());
    for (std::uint32_t j = 0; j < cells->height; ++j) {
        for (std::uint32_t i = 0; i < cells->width; ++i) {
            const fetex::FbtColor c = fetex::fbt_sample_local(fbt.value().texture, i, j, 0.5, 0.5);
            pack({c.r, c.g, c.b, c.a}, options, &build.texture.colors[words * (std::size_t{j} * cells->width + i)]);
        }
    }
    finish(options, build);
    // What it has to say of the image; parts that its texels lose these may have.
    std::ranges::copy_if(fbt.value().report.diagnostics, std::back_inserter(build.report.diagnostics),
                         [](const Diagnostic& d) { return d.code < diag::kFeaturesFloating; });
    return build;
}

} // namespace fetexc
