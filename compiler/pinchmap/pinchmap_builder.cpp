// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/pinchmap_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/pinchmap/feature_zones.h"
#include "compiler/pinchmap/map_fit.h"
#include "compiler/pinchmap/pinchmap_sizes.h"
#include "compiler/pinchmap/two_zones.h"
#include "formats/validate.h"

namespace fetexc {
namespace {

using fetex::PinchmapTexel;
using fetex::PinchmapTexture;

bool out_of_range(const PinchmapOptions& o) {
    return o.size.width < 1 || o.size.height < 1 || o.scale > fetex::kPinchmapMaxScale ||
           (std::uint64_t{std::max(o.size.width, o.size.height)} << o.scale) > fetex::kPinchmapMaxSide;
}

std::string place_text(double u, double v) {
    char text[64];
    std::snprintf(text, sizeof text, "u,v %.4f,%.4f", u, v);
    return text;
}

std::string number_text(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", v);
    return text;
}

void warn(PinchmapBuild& build, int code, const std::string& message) {
    build.diagnostics.push_back({Severity::Warning, code, message, ""});
}

void warn_of_losses(const SignalFit& signal, PinchmapBuild& build) {
    if (signal.lost == 0) return;
    warn(build, diag::kPinchmapPartsLost,
         number_text(signal.lost * 1e6) +
             " ppm of the drawing are too thin or too crowded for the map, and blurred; some are at " +
             place_text(signal.lost_u, signal.lost_v));
}

void warn_of_lost_edges(PinchmapBuild& build) {
    const LostEdges& lost = build.stats.lost_edges;
    if (lost.texels == 0) return;
    char worst[32];
    std::snprintf(worst, sizeof worst, "%.2f", lost.worst);
    warn(build, diag::kPinchmapPartsLost,
         "edges are blurred at " + std::to_string(lost.texels) +
             " places where the map can't follow them; at the worst, " + place_text(lost.u, lost.v) + ", " + worst +
             " of a cluster would be wrong");
}

void warn_of_crosses(const std::vector<PinchmapTexel>& map, const PinchmapOptions& options, PinchmapBuild& build) {
    const std::size_t columns = std::size_t{options.size.width} + 1;
    std::size_t first = 0;
    for (std::size_t k = 0; k < map.size(); ++k) {
        if (map[k].k != 0) continue;
        ++build.stats.active;
        if (map[k].du == 0 && map[k].dv == 0 && build.stats.crosses++ == 0) first = k;
    }
    if (build.stats.crosses == 0) return;
    const double clusters = static_cast<double>(options.size.width) * options.size.height;
    warn(build, diag::kPinchmapCrosses,
         std::to_string(build.stats.crosses) + " crossings of edges are blurred, about " +
             number_text(static_cast<double>(build.stats.crosses) * budget::kPinchmapCross / clusters * 1e6) +
             " ppm of the drawing; one is at " +
             place_text(static_cast<double>(first % columns) / options.size.width,
                        static_cast<double>(first / columns) / options.size.height));
}

void warn_of_blurred_edges(const TwoZones& zones, PinchmapBuild& build) {
    if (zones.blurred == 0) return;
    warn(build, diag::kPinchmapEdgesBlurred,
         std::to_string(zones.blurred) + " edges lie between colours of one zone and are blurred, " +
             number_text(zones.blurred_part * 100) +
             " % of all by length and contrast; the one that shows most is at " +
             place_text(zones.blurred_u, zones.blurred_v));
}

void warn_of_soft_edges(const SoftEdges& soft, PinchmapBuild& build) {
    if (soft.texels == 0) return;
    warn(build, diag::kPinchmapEdgesBlurred,
         "edges are blurred at " + std::to_string(soft.texels) + " of " + std::to_string(build.stats.active) +
             " places, where the image is soft across them; the softest, at " + place_text(soft.u, soft.v) +
             ", takes " + number_text(soft.widest) + " pixels or more");
}

std::vector<PinchmapTexel> map_of(const Solver& solver, const Silhouette& silhouette, const PinchmapOptions& options,
                                  PinchmapBuild& build) {
    const GammaProblem problem{silhouette, options.size.width, options.size.height, options.map_format,
                               options.threads};
    MapFit fit = fit_map(solver, problem);
    build.stats.zones = fit.zones, build.stats.gamma = std::move(fit.gamma);
    build.stats.wrong_area = build.stats.gamma.wrong, build.stats.unmendable = fit.unmendable;
    warn_of_crosses(fit.map, options, build);
    build.stats.lost_edges = blur_lost_edges(problem, fit.map);
    warn_of_lost_edges(build);
    return std::move(fit.map);
}

PinchmapTexture texture_of(const std::vector<PinchmapTexel>& map, const PinchmapOptions& options) {
    PinchmapTexture t;
    t.width = options.size.width, t.height = options.size.height, t.scale = options.scale;
    t.map_format = options.map_format, t.sample_format = options.sample_format;
    // Of a turn both components are equal, so halves of a step are rounded alike whatever the sign.
    const double steps = fetex::pinchmap_zero(t.map_format);
    const auto rounded = [&](double v) { return std::round(v * steps) / steps; };
    for (PinchmapTexel texel : map) {
        texel.du = rounded(texel.du), texel.dv = rounded(texel.dv);
        const auto words = fetex::pinchmap_pack(t.map_format, texel);
        t.map.insert(t.map.end(), words.begin(), words.begin() + fetex::pinchmap_words(t.map_format));
    }
    return t;
}

PointGrid grid_of(const PinchmapOptions& o) {
    return {o.size.width * signal_points(o.scale), o.size.height * signal_points(o.scale)};
}

void finish(const Silhouette& silhouette, const RowPainter& paint, const PinchmapOptions& options,
            const ProgressSink& progress, PinchmapBuild& build) {
    if (progress) progress("signal", 0.5);
    build.stats.signal = fit_signal(build.texture, silhouette, paint, options.threads);
    if (options.mips) build.texture.mips = fetex::pinchmap_make_mips(build.texture);
    build.stats.edges = silhouette.edges.size();
    build.stats.gpu_bytes = fetex::pinchmap_gpu_bytes(build.texture);
    warn_of_losses(build.stats.signal, build);
}

/// The edges that a scene's discontinuities follow.
Result<TwoZones> outline_of(const Scene& scene, const PinchmapOptions& options) {
    if (!options.silhouette) return two_zones_of(scene, options.threads);
    auto silhouette = silhouette_of(scene, *options.silhouette, options.threads);
    if (!silhouette) return silhouette.error();
    TwoZones out;
    out.silhouette = std::move(silhouette).value();
    return out;
}

Result<FeatureZones> zones_of(const PinchedImage& image, const PinchmapOptions& options) {
    if (!image.features.runs.empty())
        return feature_zones(image.features, options.size.width, options.size.height, options.threads);
    auto silhouette = silhouette_of(image.image, options.silhouette.value_or(SilhouetteRule{}));
    if (!silhouette) return silhouette.error();
    return FeatureZones{std::move(silhouette).value(), {}};
}

Error size_error() {
    return {ErrorClass::Usage, diag::kSizeOutOfRange, "the size must be 1 to 16384 samples on each side", ""};
}

} // namespace

Result<PinchmapBuild> compile_pinchmap(const Scene& scene, const PinchmapOptions& options,
                                       const ProgressSink& progress) {
    if (out_of_range(options)) return size_error();
    const Result<const Solver*> solver = load_solver();
    if (!solver) return solver.error();
    if (progress) progress("map", 0);
    const Result<TwoZones> zones = outline_of(scene, options);
    if (!zones) return zones.error();
    const Result<RowPainter> paint = scene_painter(scene, grid_of(options), options.threads);
    if (!paint) return paint.error();
    PinchmapBuild out;
    const Silhouette& silhouette = zones.value().silhouette;
    out.texture = texture_of(map_of(*solver.value(), silhouette, options, out), options);
    out.stats.edges_blurred = zones.value().blurred;
    warn_of_blurred_edges(zones.value(), out);
    finish(silhouette, paint.value(), options, progress, out);
    return out;
}

Result<PinchmapBuild> compile_pinchmap(const PinchedImage& image, const PinchmapOptions& options,
                                       const ProgressSink& progress) {
    if (out_of_range(options)) return size_error();
    const Result<const Solver*> solver = load_solver();
    if (!solver) return solver.error();
    if (progress) progress("map", 0);
    const auto [width, height] = options.size;
    const Result<FeatureZones> zones = zones_of(image, options);
    if (!zones) return zones.error();
    const Silhouette& silhouette = zones.value().silhouette;
    PinchmapBuild out;
    std::vector<PinchmapTexel> map = map_of(*solver.value(), silhouette, options, out);
    const std::vector<PinchmapTexel> sharp = map;
    out.stats.soft_edges = soften(image.image, silhouette, width, height, map);
    warn_of_soft_edges(out.stats.soft_edges, out);
    if (!image.features.runs.empty()) taper(zones.value().closing, image.features, width, height, map);
    for (std::size_t k = 0; k < map.size(); ++k)
        out.stats.soft_texels += map[k] == sharp[k] ? 0 : 1;
    out.texture = texture_of(map, options);
    finish(silhouette, image_painter(image.image, silhouette, grid_of(options)), options, progress, out);
    return out;
}

Result<PinchmapBuild> compile_pinchmap_at_chosen_size(const Scene& scene, const PinchmapOptions& options,
                                                      std::uint64_t max_bytes, double max_wrong_area,
                                                      const ProgressSink& progress) {
    return choose_pinchmap_size(options, scene.extent, {max_bytes, max_wrong_area},
                                [&](const PinchmapOptions& o) { return compile_pinchmap(scene, o, progress); });
}

Result<PinchmapBuild> compile_pinchmap_at_chosen_size(const PinchedImage& image, const PinchmapOptions& options,
                                                      std::uint64_t max_bytes, double max_wrong_area,
                                                      const ProgressSink& progress) {
    const Extent extent{static_cast<double>(image.image.width), static_cast<double>(image.image.height)};
    return choose_pinchmap_size(options, extent, {max_bytes, max_wrong_area},
                                [&](const PinchmapOptions& o) { return compile_pinchmap(image, o, progress); });
}

} // namespace fetexc
