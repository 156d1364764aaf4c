// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report_silmap.h"

#include <fmt/format.h>

#include "cli/compile_silmap.h"
#include "cli/report_planar.h"
#include "formats/fbt_mip.h"

namespace fetexc::cli {

SilmapOutcome silmap_outcome(const SilmapBuild& build) {
    const fetex::SilmapTexture& t = build.texture;
    return {t.width,
            t.height,
            cell_bits(t),
            t.sample_format,
            t.mips.empty() ? 0 : fetex::fbt_mip_levels(t.width, t.height),
            build.stats,
            build.report.planar};
}

std::string silmap_text(const SilmapOutcome& o) {
    const SilmapStats& s = o.stats;
    std::string text = fmt::format("  silmap     {} x {} texels, {}-bit cells, samples {}; {} bytes on the GPU{}\n",
                                   o.width, o.height, o.cell_bits, silmap_samples_name(o.samples), s.gpu_bytes,
                                   o.mip_levels > 0 ? fmt::format(", {} mip levels", o.mip_levels) : "");
    text += planar_text(o.planar);
    text += fmt::format("  cells      {:.1f}% empty, {:.1f}% with a boundary (of {}); {} with a corner or junction, {} "
                        "hold more than they can show\n",
                        share(s.cells_empty, s.cells), share(s.cells_edge, s.cells), s.cells, s.cells_corner,
                        s.cells_crowded);
    text += fmt::format("  parts      {} lost; {} texels have the colour of a part beside them\n", s.parts_lost,
                        s.texels_lent);
    text += fmt::format("  fit        {:.0f} ppm wrong at first, {:.0f} after {} rounds and {} positions\n",
                        1e6 * s.wrong_area_seed, 1e6 * s.wrong_area, s.fit_rounds, s.positions_tried);
    return text;
}

nlohmann::ordered_json silmap_json(const SilmapOutcome& o) {
    const SilmapStats& s = o.stats;
    return {{"width", o.width},
            {"height", o.height},
            {"cellBits", o.cell_bits},
            {"samples", silmap_samples_name(o.samples)},
            {"mipLevels", o.mip_levels},
            {"gpuBytes", s.gpu_bytes},
            {"cells",
             {{"total", s.cells},
              {"empty", s.cells_empty},
              {"edge", s.cells_edge},
              {"corner", s.cells_corner},
              {"crowded", s.cells_crowded}}},
            {"partsLost", s.parts_lost},
            {"texelsLent", s.texels_lent},
            {"fitRounds", s.fit_rounds},
            {"positionsTried", s.positions_tried},
            {"wrongPpmSeed", 1e6 * s.wrong_area_seed},
            {"wrongPpm", 1e6 * s.wrong_area},
            {"planar", planar_json(o.planar)}};
}

} // namespace fetexc::cli
