// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/shader_source.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>

#include "formats/fbt_samples.h"
#include "formats/feature_sampler.h"
#include "runtime_glsl/host/embedded_shaders.h"
#include "runtime_glsl/host/renderer.h"

namespace fetex {
namespace {

std::string file_text(const std::string& name) {
    for (const EmbeddedShader* shader = kEmbeddedShaders; shader->name; ++shader)
        if (name == shader->name) return shader->text;
    assert(!"a shader file that the build doesn't embed");
    return {};
}

std::string define(const char* name, const std::string& value) {
    return std::string("#define ") + name + " " + value + "\n";
}

std::string define(const char* name, std::uint32_t value) { return define(name, std::to_string(value)); }

/// With a point whatever the locale; ten digits hold any float.
std::string real(double value) {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 9).ptr;
    return {text, end};
}

/// The sampler of the features alone.
std::string features_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer, Filter filter) {
    return shader_prelude(dialect, texture_buffer) + fbt_specialisation(texture.traits, texture.sample_format) +
           file_text("fetex_fbt.glsl") +
           (filter == Filter::Point
                ? ""
                : define("FETEX_FBT_AREA_EXACT", filter == Filter::ExactArea) + file_text("fetex_fbt_area.glsl"));
}

/// With the mip chain, which needs area sampling.
std::string mip_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer, Filter filter) {
    const Filter fine = filter == Filter::Area ? Filter::Area : Filter::ExactArea;
    return features_source(dialect, texture, texture_buffer, fine) + file_text("fetex_levels.glsl") +
           file_text("fetex_fbt_mip.glsl");
}

std::string vec4_of(double r, double g, double b, double a) {
    return "vec4(" + real(r) + ", " + real(g) + ", " + real(b) + ", " + real(a) + ")";
}

std::string color(const float (&c)[4]) { return vec4_of(c[0], c[1], c[2], c[3]); }

std::string color(std::uint32_t rgba8) {
    const auto channel = [&](unsigned shift) { return static_cast<double>(rgba8 >> shift & 0xffu) / 255; };
    return vec4_of(channel(0), channel(8), channel(16), channel(24));
}

} // namespace

const char* dialect_name(Dialect dialect) {
    switch (dialect) {
    case Dialect::Glsl330:
        return "330";
    case Dialect::Glsl430:
        return "430";
    case Dialect::Essl300:
        return "300es";
    case Dialect::Vulkan450:
        return "vulkan450";
    }
    return "";
}

std::string shader_prelude(Dialect dialect, bool texture_buffer) {
    std::string text = file_text(std::string("fetex_prelude_") + dialect_name(dialect) + ".glsl");
    if (texture_buffer) text += "#define FETEX_TEXTURE_BUFFER 1\n";
    return text;
}

std::string fbt_specialisation(const FbtTraits& traits, FbtSampleFormat format) {
    return define("FETEX_FBT_SAMPLES", static_cast<std::uint32_t>(format)) +
           define("FETEX_FBT_FEATURES", traits.max_entries > 0) + define("FETEX_FBT_DEGREES", traits.degrees) +
           define("FETEX_FBT_BANDS", traits.bands) + define("FETEX_FBT_CORNERS", traits.corners) +
           define("FETEX_FBT_PATCHES", traits.patches) + define("FETEX_FBT_SHARED", traits.shared) +
           define("FETEX_FBT_TRANSLUCENT", traits.translucent) + define("FETEX_FBT_DIRECTIONS", traits.directions) +
           define("FETEX_FBT_MAX_DEPTH", traits.max_depth) +
           (traits.max_entries == 1 ? define("FETEX_FBT_MAX_ENTRIES", 1) : ""); // no loop; else assets share a shader
}

std::string fbt_library_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer, Filter filter) {
    if (!texture.mips.empty()) return mip_source(dialect, texture, texture_buffer, filter);
    return features_source(dialect, texture, texture_buffer, filter);
}

std::string view_vertex_source(Dialect dialect) { return shader_prelude(dialect) + file_text("view.vert.glsl"); }

std::string fbt_fragment_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer, Filter filter) {
    return features_source(dialect, texture, texture_buffer, filter) + file_text("view.glsl") +
           file_text(filter == Filter::Point ? "fbt.frag.glsl" : "fbt_area.frag.glsl");
}

std::string fbt_mip_fragment_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer, Filter filter) {
    return mip_source(dialect, texture, texture_buffer, filter) + define("FETEX_VIEW_FOOTPRINT", 1) +
           file_text("view.glsl") + file_text("fbt_mip.frag.glsl");
}

std::string bilevel_specialisation(const BilevelTexture& texture, bool filtered) {
    return define("FETEX_BILEVEL_RULE", static_cast<std::uint32_t>(texture.rule)) +
           define("FETEX_BILEVEL_BELOW", color(texture.below)) + define("FETEX_BILEVEL_ABOVE", color(texture.above)) +
           define("FETEX_BILEVEL_IMAGE", !texture.image.empty()) + define("FETEX_BILEVEL_MIPS", !texture.mips.empty()) +
           define("FETEX_BILEVEL_FILTERED", filtered);
}

std::string bilevel_library_source(Dialect dialect, const BilevelTexture& texture, bool filtered) {
    return shader_prelude(dialect) + bilevel_specialisation(texture, filtered) + file_text("fetex_levels.glsl") +
           file_text("fetex_bilevel.glsl");
}

namespace {

/// The view goes ahead: derivatives of the screen are of a pixel, and a sample is only a part of it.
std::string bilevel_source(Dialect dialect, const BilevelTexture& texture, bool filtered, bool footprint) {
    return shader_prelude(dialect) + bilevel_specialisation(texture, filtered) +
           define("FETEX_BILEVEL_DERIVATIVES(t)", "(vec2(dFdx(t), dFdy(t)) / float(fetexSupersample))") +
           (footprint ? define("FETEX_VIEW_FOOTPRINT", 1) : "") + file_text("view.glsl") +
           file_text("fetex_levels.glsl") + file_text("fetex_bilevel.glsl");
}

} // namespace

std::string bilevel_fragment_source(Dialect dialect, const BilevelTexture& texture, Filter filter, bool filtered) {
    return bilevel_source(dialect, texture, filtered, false) +
           file_text(filter == Filter::Point ? "bilevel.frag.glsl" : "bilevel_area.frag.glsl");
}

std::string bilevel_mip_fragment_source(Dialect dialect, const BilevelTexture& texture, bool filtered) {
    return bilevel_source(dialect, texture, filtered, true) + file_text("bilevel_mip.frag.glsl");
}

std::string silmap_specialisation(const SilmapTexture& texture, SilmapFilter filter) {
    return define("FETEX_SILMAP_BITS", texture.cell_format == SilmapCellFormat::Bits8 ? 3 : 7) +
           define("FETEX_SILMAP_SAMPLES", texture.sample_format == SilmapSampleFormat::Rgba16) +
           define("FETEX_SILMAP_FILTERED", filter == SilmapFilter::Filtered) +
           define("FETEX_SILMAP_MIPS", !texture.mips.empty());
}

std::string silmap_library_source(Dialect dialect, const SilmapTexture& texture, SilmapFilter filter) {
    return shader_prelude(dialect) + silmap_specialisation(texture, filter) +
           (texture.mips.empty() ? "" : file_text("fetex_levels.glsl")) + file_text("fetex_silmap.glsl");
}

std::string silmap_fragment_source(Dialect dialect, const SilmapTexture& texture, Filter filter,
                                   SilmapFilter silmap_filter) {
    return silmap_library_source(dialect, texture, silmap_filter) + file_text("view.glsl") +
           file_text(filter == Filter::Point ? "silmap.frag.glsl" : "silmap_area.frag.glsl");
}

std::string silmap_mip_fragment_source(Dialect dialect, const SilmapTexture& texture, SilmapFilter silmap_filter) {
    return silmap_library_source(dialect, texture, silmap_filter) + define("FETEX_VIEW_FOOTPRINT", 1) +
           file_text("view.glsl") + file_text("silmap_mip.frag.glsl");
}

std::string pinchmap_specialisation(const PinchmapTexture& texture, bool filtered) {
    return define("FETEX_PINCHMAP_SCALE", texture.scale) +
           define("FETEX_PINCHMAP_BITS", texture.map_format == PinchmapFormat::Bits8 ? 8 : 16) +
           define("FETEX_PINCHMAP_SAMPLES", texture.sample_format == PinchmapSampleFormat::Rgba16) +
           define("FETEX_PINCHMAP_MIPS", !texture.mips.empty()) +
           define("FETEX_PINCHMAP_LINE_WIDTH", real(texture.line_width / kPinchmapLineUnit)) +
           define("FETEX_PINCHMAP_LINE_COLOR", color(texture.line_color)) + define("FETEX_PINCHMAP_FILTERED", filtered);
}

std::string pinchmap_library_source(Dialect dialect, const PinchmapTexture& texture, bool filtered) {
    return shader_prelude(dialect) + pinchmap_specialisation(texture, filtered) + file_text("fetex_levels.glsl") +
           file_text("fetex_pinchmap.glsl");
}

std::string pinchmap_fragment_source(Dialect dialect, const PinchmapTexture& texture, Filter filter, bool filtered) {
    return pinchmap_library_source(dialect, texture, filtered) + file_text("view.glsl") +
           file_text(filter == Filter::Point ? "pinchmap.frag.glsl" : "pinchmap_area.frag.glsl");
}

std::string pinchmap_mip_fragment_source(Dialect dialect, const PinchmapTexture& texture, bool filtered) {
    return pinchmap_library_source(dialect, texture, filtered) + define("FETEX_VIEW_FOOTPRINT", 1) +
           file_text("view.glsl") + file_text("pinchmap_mip.frag.glsl");
}

FeatureCurvesTraits feature_curves_traits(const FeatureCurvesTexture& t) {
    FeatureCurvesTraits traits;
    traits.kind = t.kind, traits.base_format = t.base_format;
    traits.distance_limit = t.distance_limit, traits.height_scale = t.height_scale;
    traits.linear = t.linear, traits.bits16 = t.format == FeatureNumberFormat::Bits16;
    traits.gradients = !t.gradients.empty(), traits.mips = !t.mips.empty(), traits.profiles = t.profiles;
    traits.one_sample = t.base.size() == fbt_sample_words(silmap_fbt_format(t.base_format));
    for (std::uint32_t j = 0; j < t.height; ++j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            const FeatureSegmentList list = feature_unpack(t.configurations[std::size_t{j} * t.width + i]);
            traits.segments = std::max(traits.segments, list.count);
            for (std::uint32_t k = 0; k < list.count; ++k)
                traits.curves |= !t.linear && !list.straight[k];
            traits.open |= feature_open_edges(t, i, j) != 0;
        }
    }
    return traits;
}

std::string feature_curves_specialisation(const FeatureCurvesTraits& t) {
    return define("FETEX_FEATURE_KIND", static_cast<std::uint32_t>(t.kind)) +
           define("FETEX_FEATURE_LIMIT", real(t.distance_limit)) + define("FETEX_FEATURE_LINEAR", t.linear) +
           define("FETEX_FEATURE_BITS16", t.bits16) + define("FETEX_FEATURE_GRADIENTS", t.gradients) +
           define("FETEX_FEATURE_SEGMENTS", t.segments) + define("FETEX_FEATURE_CURVES", t.curves) +
           define("FETEX_FEATURE_OPEN", t.open) + define("FETEX_FEATURE_PROFILES", t.profiles) +
           define("FETEX_FEATURE_SAMPLES", t.base_format == FeatureSampleFormat::Rgba16) +
           define("FETEX_FEATURE_ONE_SAMPLE", t.one_sample) +
           define("FETEX_FEATURE_NORMAL_FACTOR", real(feature_normal_factor(t.base_format))) +
           define("FETEX_FEATURE_HEIGHT_SCALE", real(t.height_scale)) + define("FETEX_FEATURE_MIPS", t.mips);
}

std::string feature_curves_library_source(Dialect dialect, const FeatureCurvesTraits& traits) {
    return shader_prelude(dialect) + feature_curves_specialisation(traits) +
           (traits.mips ? file_text("fetex_levels.glsl") : "") + file_text("fetex_feature_curves.glsl");
}

std::string feature_curves_fragment_source(Dialect dialect, const FeatureCurvesTraits& traits, Filter filter) {
    return feature_curves_library_source(dialect, traits) + file_text("view.glsl") +
           file_text(filter == Filter::Point ? "feature_curves.frag.glsl" : "feature_curves_area.frag.glsl");
}

std::string feature_curves_mip_fragment_source(Dialect dialect, const FeatureCurvesTraits& traits) {
    return feature_curves_library_source(dialect, traits) + define("FETEX_VIEW_FOOTPRINT", 1) + file_text("view.glsl") +
           file_text("feature_curves_mip.frag.glsl");
}

std::string bitmap_fragment_source(Dialect dialect) {
    return shader_prelude(dialect) + file_text("view.glsl") + file_text("bitmap.frag.glsl");
}

std::string filtered_bitmap_fragment_source(Dialect dialect) {
    return shader_prelude(dialect) + file_text("view.glsl") + file_text("filtered_bitmap.frag.glsl");
}

std::string field_fragment_source(Dialect dialect, const Field& field) {
    return shader_prelude(dialect) + define("FETEX_FIELD_BELOW", color(field.below)) +
           define("FETEX_FIELD_ABOVE", color(field.above)) +
           (field.range > 0 ? define("FETEX_FIELD_RANGE", real(field.range)) : "") + file_text("view.glsl") +
           file_text("field.frag.glsl");
}

} // namespace fetex
