// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report_pinchmap.h"

#include <fmt/format.h>

#include "cli/compile_pinchmap.h"
#include "cli/compile_silmap.h"
#include "cli/report_traces.h"
#include "formats/fbt_mip.h"

namespace fetexc::cli {

PinchmapOutcome pinchmap_outcome(const PinchmapBuild& build) {
    const fetex::PinchmapTexture& t = build.texture;
    const std::uint32_t levels =
        t.mips.empty() ? 0 : fetex::fbt_mip_levels(fetex::pinchmap_signal_width(t), fetex::pinchmap_signal_height(t));
    return {t.width, t.height, t.scale, map_bits(t), t.sample_format, levels, build.stats};
}

std::string pinchmap_text(const PinchmapOutcome& o) {
    const PinchmapStats& s = o.stats;
    std::string text =
        fmt::format("  pinchmap   {} x {} clusters of {} x {} samples, {}-bit map, samples {}; {} bytes on the GPU{}\n",
                    o.width, o.height, 1U << o.scale, 1U << o.scale, o.map_bits, silmap_samples_name(o.samples),
                    s.gpu_bytes, o.mip_levels > 0 ? fmt::format(", {} mip levels", o.mip_levels) : "");
    text +=
        fmt::format("  zones      {} edges between them, {} blurred inside them; {} clusters broke a rule, {} squares "
                    "changed for it\n",
                    s.edges, s.edges_blurred, s.zones.broken, s.zones.moves);
    text += fmt::format("  map        {} texels with a discontinuity, {} crossings, {} soft\n", s.active, s.crosses,
                        s.soft_texels);
    text +=
        fmt::format("  gamma      {} texels fitted: {} steps of the contour, then {} values tried; {:.0f} ppm wrong; "
                    "ppm after steps 1, 2, 4 … {}: {}\n",
                    s.gamma.texels_fitted, s.gamma.contour_steps, s.gamma.tried, 1e6 * s.wrong_area,
                    s.gamma.trace.size(), trace_text(s.gamma.trace));
    text += fmt::format("  signal     {} rounds; {} samples unseen; {:.0f} ppm of the drawing lost\n", s.signal.rounds,
                        s.signal.unseen, 1e6 * s.signal.lost);
    return text;
}

nlohmann::ordered_json pinchmap_json(const PinchmapOutcome& o) {
    const PinchmapStats& s = o.stats;
    return {{"width", o.width},
            {"height", o.height},
            {"scale", o.scale},
            {"mapBits", o.map_bits},
            {"samples", silmap_samples_name(o.samples)},
            {"mipLevels", o.mip_levels},
            {"gpuBytes", s.gpu_bytes},
            {"edges", s.edges},
            {"edgesBlurred", s.edges_blurred},
            {"zones", {{"broken", s.zones.broken}, {"moves", s.zones.moves}, {"lostClusters", s.zones.lost}}},
            {"texels", {{"active", s.active}, {"crosses", s.crosses}, {"soft", s.soft_texels}}},
            {"gamma",
             {{"texelsFitted", s.gamma.texels_fitted},
              {"contourSteps", s.gamma.contour_steps},
              {"valuesTried", s.gamma.tried},
              {"thinClusters", s.gamma.thin_cells},
              {"tracePpm", trace_ppm(s.gamma.trace)}}},
            {"signal", {{"rounds", s.signal.rounds}, {"unseen", s.signal.unseen}, {"lostPpm", 1e6 * s.signal.lost}}},
            {"wrongPpm", 1e6 * s.wrong_area}};
}

} // namespace fetexc::cli
