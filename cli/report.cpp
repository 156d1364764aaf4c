// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/compile_bilevel.h"
#include "cli/messages.h"
#include "cli/report_planar.h"
#include "cli/report_traces.h"
#include "cli/version.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string scene_text(const SceneStats& s) {
    const std::uint64_t culled = s.layers_empty + s.layers_outside + s.layers_hidden + s.layers_transparent;
    std::string text =
        fmt::format("  layers     {} in, {} culled: {} empty, {} outside, {} hidden, {} transparent\n", s.layers_in,
                    culled, s.layers_empty, s.layers_outside, s.layers_hidden, s.layers_transparent);
    if (s.raster_layers > 0) text += fmt::format("             {} as raster layers\n", s.raster_layers);
    text += fmt::format("  geometry   {} segments, {} null ones dropped; {} of {} vertices merged; moved at most "
                        "{:.2f} steps of 2^-26\n",
                        s.segments_in, s.segments_zero, s.vertices_merged, s.vertices_in, s.max_displacement);
    return text;
}

std::string fbt_text(const FbtStats& f) {
    std::string text = fmt::format("  regions    {}; texels with one {}, two {}, more {}\n", f.regions, f.texels_empty,
                                   f.texels_two_regions, f.texels_more_regions);
    text += fmt::format("  bands      {} in {} texels; avoided in {}\n", f.bands, f.texels_banded, f.bands_avoided);
    text += fmt::format("  features   {} of {} pieces; {} regions interpolated, {} constant\n", f.features, f.pieces,
                        f.regions_interpolated, f.regions - std::min(f.regions, f.regions_interpolated));
    if (f.slivers_collapsed > 0)
        text += fmt::format("  slivers    {} thinner than the output grid collapsed\n", f.slivers_collapsed);
    return text;
}

std::string mips_text(const MipStats& m) {
    if (m.levels == 0) return "";
    return fmt::format("  mip chain  {} levels, {} bytes; of {} texels {} solid, {} trapezoids; {} areas sampled at {} "
                       "points; {} more planar maps\n",
                       m.levels, m.gpu_bytes, m.texels, m.texels_solid, m.trapezoids, m.areas_sampled, m.paint_samples,
                       m.own_maps);
}

std::string image_text(const ImageStats& i, bool features) {
    if (!features) return fmt::format("  image      {} x {} pixels\n", i.width, i.height);
    return fmt::format(
        "  image      {} x {} pixels, {} too near to a feature; {} holes filled, {} parts without a sample; {} "
        "floating parts of features ignored; {} steps of the fit\n",
        i.width, i.height, i.pixels_invalid, i.holes_filled, i.parts_unsampled, i.floating, i.fit_steps);
}

std::string fit_text(const BilevelFit& f) {
    const double texels = static_cast<double>(f.width) * f.height;
    const std::uint32_t channels = fetex::bilevel_channels(f.rule);
    std::string text =
        fmt::format("  {:<10} {} x {} texels, {} channel{}: {:.0f} ppm wrong; {:.1f}% of texels fitted\n",
                    rule_name(f.rule), f.width, f.height, channels, channels == 1 ? "" : "s", 1e6 * f.wrong,
                    100 * static_cast<double>(f.texels_fitted) / texels);
    text += fmt::format("             {} steps of the contour{}, then {} values tried, {} islands mended; ppm after "
                        "steps 1, 2, 4 … {}: {}\n",
                        f.contour_steps, f.paper_start ? " from the paper's equations" : "", f.bytes_tried,
                        f.parts_mended, f.trace.size(), trace_text(f.trace));
    return text;
}

std::string bilevel_text(const BilevelOutcome& b) {
    const BilevelStats& s = b.stats;
    std::string text = fmt::format(
        "  bi-level   {} x {} texels, {} ({} bytes a texel); {} bytes on the GPU{}{}\n", b.width, b.height,
        rule_name(b.rule), fetex::bilevel_channels(b.rule), b.gpu_bytes,
        b.mip_levels > 0 ? fmt::format(", {} mip levels", b.mip_levels) : "",
        b.image_width > 0 ? fmt::format(", an image of {} x {} pixels", b.image_width, b.image_height) : "");
    text += fmt::format("  silhouette {} edges in {} parts; {} parts lost, {} false, {} cells crossed twice\n", s.edges,
                        s.parts.parts, s.parts.lost, s.parts.invented, s.thin_cells);
    for (const BilevelFit& fit : s.fits)
        text += fit_text(fit);
    return text;
}

std::string joined(const std::vector<std::string>& words) {
    if (words.empty()) return "nothing";
    return fmt::format("{}", fmt::join(words, ", "));
}

Json scene_json(const SceneStats& s) {
    return {{"layersIn", s.layers_in},
            {"layersCulled",
             {{"empty", s.layers_empty},
              {"outside", s.layers_outside},
              {"hidden", s.layers_hidden},
              {"transparent", s.layers_transparent}}},
            {"rasterLayers", s.raster_layers},
            {"segmentsIn", s.segments_in},
            {"segmentsNull", s.segments_zero},
            {"verticesIn", s.vertices_in},
            {"verticesMerged", s.vertices_merged},
            {"maxDisplacementSteps", s.max_displacement}};
}

Json fbt_json(const FbtStats& f) {
    return {{"texelsOneRegion", f.texels_empty},
            {"texelsTwoRegions", f.texels_two_regions},
            {"texelsMoreRegions", f.texels_more_regions},
            {"texelsBanded", f.texels_banded},
            {"bands", f.bands},
            {"bandsAvoided", f.bands_avoided},
            {"features", f.features},
            {"pieces", f.pieces},
            {"regions", f.regions},
            {"regionsInterpolated", f.regions_interpolated},
            {"sliversCollapsed", f.slivers_collapsed},
            {"partsLost", f.parts_lost}};
}

Json mips_json(const MipStats& m) {
    return {{"levels", m.levels},
            {"gpuBytes", m.gpu_bytes},
            {"texels", m.texels},
            {"texelsSolid", m.texels_solid},
            {"trapezoids", m.trapezoids},
            {"areasSampled", m.areas_sampled},
            {"paintSamples", m.paint_samples},
            {"ownMaps", m.own_maps}};
}

Json image_json(const ImageStats& i) {
    return {{"width", i.width},
            {"height", i.height},
            {"pixelsInvalid", i.pixels_invalid},
            {"holesFilled", i.holes_filled},
            {"partsUnsampled", i.parts_unsampled},
            {"floatingParts", i.floating},
            {"fitSteps", i.fit_steps}};
}

Json fit_json(const BilevelFit& f) {
    return {{"rule", rule_name(f.rule)},
            {"width", f.width},
            {"height", f.height},
            {"wrongPpm", 1e6 * f.wrong},
            {"cells", f.cells},
            {"texelsFitted", f.texels_fitted},
            {"paperStart", f.paper_start},
            {"contourSteps", f.contour_steps},
            {"bytesTried", f.bytes_tried},
            {"partsMended", f.parts_mended},
            {"tracePpm", trace_ppm(f.trace)}};
}

Json bilevel_json(const BilevelOutcome& b) {
    const BilevelStats& s = b.stats;
    Json fits = Json::array();
    for (const BilevelFit& fit : s.fits)
        fits.push_back(fit_json(fit));
    return {{"width", b.width},
            {"height", b.height},
            {"channels", fetex::bilevel_channels(b.rule)},
            {"rule", rule_name(b.rule)},
            {"mipLevels", b.mip_levels},
            {"imageWidth", b.image_width},
            {"imageHeight", b.image_height},
            {"gpuBytes", b.gpu_bytes},
            {"edges", s.edges},
            {"edgesVarying", s.edges_varying},
            {"parts", s.parts.parts},
            {"partsLost", s.parts.lost},
            {"partsFalse", s.parts.invented},
            {"thinCells", s.thin_cells},
            {"fits", fits}};
}

Json diagnostics_json(const std::vector<Diagnostic>& diagnostics) {
    Json list = Json::array();
    for (const Diagnostic& d : diagnostics) {
        list.push_back({{"code", code_name(d.severity, d.code)},
                        {"place", fetex::to_valid_utf8(d.place)},
                        {"message", fetex::to_valid_utf8(d.message)}});
    }
    return list;
}

/// Of the first that was made.
struct FirstTexture {
    std::uint32_t width = 0, height = 0;
    std::uint64_t gpu_bytes = 0;
};
FirstTexture first_texture(const CompileOutcome& o) {
    if (o.has_fbt) return {o.width, o.height, o.gpu_bytes};
    if (o.bilevel) return {o.bilevel->width, o.bilevel->height, o.bilevel->gpu_bytes};
    if (o.silmap) return {o.silmap->width, o.silmap->height, o.silmap->stats.gpu_bytes};
    if (o.pinchmap) return {o.pinchmap->width, o.pinchmap->height, o.pinchmap->stats.gpu_bytes};
    return {o.curves->width, o.curves->height, o.curves->stats.gpu_bytes};
}

std::string representations(const CompileOutcome& o) {
    std::vector<std::string> names;
    if (o.has_fbt) names.emplace_back("fbt");
    if (o.bilevel) names.emplace_back("bilevel");
    if (o.silmap) names.emplace_back("silmap");
    if (o.pinchmap) names.emplace_back("pinchmap");
    if (o.curves) names.emplace_back("curves");
    return fmt::format("{}", fmt::join(names, ","));
}

Json outcome_json(const CompileOutcome& o) {
    const FirstTexture first = first_texture(o);
    Json json = {{"input", fetex::to_valid_utf8(o.input)},
                 {"output", fetex::to_valid_utf8(o.output)},
                 {"representation", representations(o)},
                 {"width", first.width},
                 {"height", first.height},
                 {"fileBytes", o.file_bytes},
                 {"gpuBytes", first.gpu_bytes},
                 {"milliseconds", o.milliseconds},
                 {"scene", scene_json(o.report.scene)}};
    if (o.has_fbt) {
        json["samples"] = sample_format_name(o.samples);
        json["planar"] = planar_json(o.report.planar);
        json["fbt"] = fbt_json(o.report.fbt);
        json["mips"] = mips_json(o.report.mips);
        json["shaderPartsLeftOut"] = shader_parts_left_out(o.traits);
    }
    if (o.bilevel) json["bilevel"] = bilevel_json(*o.bilevel);
    if (o.silmap) json["silmap"] = silmap_json(*o.silmap);
    if (o.pinchmap) json["pinchmap"] = pinchmap_json(*o.pinchmap);
    if (o.curves) json["curves"] = curves_json(*o.curves);
    json["diagnostics"] = diagnostics_json(o.report.diagnostics);
    if (o.report.image.width != 0) json["image"] = image_json(o.report.image);
    return json;
}

std::string fbt_report_text(const CompileOutcome& o) {
    const double texels = static_cast<double>(o.width) * o.height;
    std::string text = fmt::format("  texture    {} x {} texels; {} bytes on the GPU ({:.1f} a texel)\n", o.width,
                                   o.height, o.gpu_bytes, static_cast<double>(o.gpu_bytes) / texels);
    text += fmt::format("  samples    {}\n", o.samples == fetex::FbtSampleFormat::Rgba16F
                                                 ? "16-bit floats"
                                                 : fmt::format("{} bits a channel", sample_format_name(o.samples)));
    text += planar_text(o.report.planar) + fbt_text(o.report.fbt) + mips_text(o.report.mips);
    text += fmt::format("  shader     left out: {}\n", joined(shader_parts_left_out(o.traits)));
    return text;
}

} // namespace

const char* sample_format_name(fetex::FbtSampleFormat format) {
    switch (format) {
    case fetex::FbtSampleFormat::Rgba8:
        return "8";
    case fetex::FbtSampleFormat::Rgba16:
        return "16";
    case fetex::FbtSampleFormat::Rgba16F:
        return "float";
    }
    return "";
}

std::vector<std::string> shader_parts_left_out(const fetex::FbtTraits& traits) {
    std::vector<std::string> parts;
    const auto leave_out = [&](bool needed, const char* name) {
        if (!needed) parts.emplace_back(name);
    };
    leave_out((traits.degrees & 2) != 0, "lines");
    leave_out((traits.degrees & 4) != 0, "quadratics");
    leave_out((traits.degrees & 8) != 0, "cubics");
    leave_out(traits.bands, "bands");
    leave_out(traits.corners, "interpolated corners");
    leave_out(traits.patches, "patches");
    leave_out(traits.shared, "shared points");
    leave_out(traits.translucent, "translucency");
    leave_out((traits.directions & 1) != 0, "rays +x");
    leave_out((traits.directions & 2) != 0, "rays -x");
    leave_out((traits.directions & 4) != 0, "rays +y");
    leave_out((traits.directions & 8) != 0, "rays -y");
    return parts;
}

std::string report_text(const CompileOutcome& o) {
    std::string text = fmt::format("{} -> {}\n", printable(o.input), printable(o.output));
    text += fmt::format("  file       {} bytes; {:.0f} ms\n", o.file_bytes, o.milliseconds);
    if (o.report.image.width != 0) text += image_text(o.report.image, o.has_fbt);
    if (o.report.scene.layers_in > 0) text += scene_text(o.report.scene);
    if (o.has_fbt) text += fbt_report_text(o);
    if (o.bilevel) text += bilevel_text(*o.bilevel);
    if (o.silmap) text += silmap_text(*o.silmap);
    if (o.pinchmap) text += pinchmap_text(*o.pinchmap);
    if (o.curves) text += curves_text(*o.curves);
    return text;
}

std::string report_json(const std::vector<CompileOutcome>& outcomes) {
    Json results = Json::array();
    for (const CompileOutcome& outcome : outcomes)
        results.push_back(outcome_json(outcome));
    const Json document = {{"schema", "fetexc-compile-report/1"}, {"version", version_number()}, {"results", results}};
    return document.dump(2) + "\n";
}

} // namespace fetexc::cli
