// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Textures with feature curves on the GPU: their textures and shaders.
#include <algorithm>
#include <array>

#include "formats/fbt_samples.h"
#include "formats/feature_sampler.h"
#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

// Texture units, as the shaders' bindings have them.
constexpr GLuint kTexelUnit = 0, kSignatureUnit = 1, kCornerUnit = 2, kBaseUnit = 3, kProfileUnit = 4, kMipUnit = 5;
constexpr std::initializer_list<const char*> kSamplers = {"fetexFeatureTexels",  "fetexFeatureSignatures",
                                                          "fetexFeatureCorners", "fetexFeatureBase",
                                                          "fetexFeatureProfile", "fetexFeatureMips"};

/// A number that fetexFeatureTexels has of a segment, four bits.
std::uint32_t segment_bits(FeatureSegment segment, bool straight) {
    const auto k = static_cast<std::uint32_t>(std::ranges::find(kFeatureSegments, segment) - kFeatureSegments.begin());
    return (k + 1) | (straight ? 8u : 0u);
}

/// Four bits each: corners, edges.
std::uint32_t profile_bits(const FeatureTexelProfiles& profiles) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
        word |= std::uint32_t{profiles.corners[k]} << (4 * k) | std::uint32_t{profiles.edges[k]} << (4 * k + 16);
    return word;
}

/// With several profiles two words a texel.
std::vector<std::uint32_t> texels_of(const FeatureCurvesTexture& t) {
    std::vector<std::uint32_t> texels;
    texels.reserve(t.configurations.size() * (t.profiles > 1 ? 2 : 1));
    for (std::uint32_t j = 0; j < t.height; ++j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            const FeatureSegmentList list = feature_unpack(t.configurations[std::size_t{j} * t.width + i]);
            std::uint32_t word = feature_open_edges(t, i, j) << 8;
            for (std::uint32_t k = 0; k < list.count; ++k)
                word |= segment_bits(list.segment[k], list.straight[k]) << (4 * k);
            texels.push_back(word);
            if (t.profiles > 1) texels.push_back(profile_bits(feature_texel_profiles(t, i, j)));
        }
    }
    return texels;
}

GLuint make_texels(const GladGLContext& gl, const FeatureCurvesTexture& t) {
    const std::vector<std::uint32_t> words = texels_of(t);
    if (t.profiles > 1)
        return make_texture(gl, kTexelUnit, GL_RG32UI, t.width, t.height, GL_RG_INTEGER, GL_UNSIGNED_INT, words.data());
    const std::vector<std::uint16_t> narrow(words.begin(), words.end());
    return make_texture(gl, kTexelUnit, GL_R16UI, t.width, t.height, GL_RED_INTEGER, GL_UNSIGNED_SHORT, narrow.data());
}

/// Distance, gradient and a 0, as the file has them.
std::vector<std::uint8_t> corners_with_gradients(const FeatureCurvesTexture& t) {
    const std::size_t size = feature_number_bytes(t.format);
    std::vector<std::uint8_t> out(4 * size * feature_corner_count(t));
    for (std::size_t k = 0; k < feature_corner_count(t); ++k) {
        std::copy_n(&t.distances[k * size], size, &out[4 * k * size]);
        std::copy_n(&t.gradients[2 * k * size], 2 * size, &out[(4 * k + 1) * size]);
    }
    return out;
}

/// Rows of products and of their integrals from 0, in entries, of a profile, at the end of `rows`.
void add_profile_rows(const FeatureCurvesTexture& t, std::uint32_t profile, std::vector<float>& rows) {
    const std::size_t n = feature_profile_entries(t), first = rows.size();
    rows.resize(first + n * 16);
    std::array<double, 8> sum{}, before{};
    for (std::size_t k = 0; k < n; ++k) {
        const double distance = static_cast<double>(k) * t.distance_limit / static_cast<double>(n - 1);
        const FeatureProducts p = feature_profile_mean(t, distance, 0, profile);
        const std::array<double, 8> values = {p.slope,   p.base_slope, p.blend,   p.height,
                                              p.color.r, p.color.g,    p.color.b, p.color.a};
        for (std::size_t c = 0; c < 8; ++c) {
            if (k > 0) sum[c] += (before[c] + values[c]) / 2;
            const std::size_t at = first + (c / 4 * n + k) * 4 + c % 4;
            rows[at] = static_cast<float>(values[c]), rows[at + 8 * n] = static_cast<float>(sum[c]);
        }
        before = values;
    }
}

std::vector<float> profile_rows(const FeatureCurvesTexture& t) {
    std::vector<float> rows;
    for (std::uint32_t profile = 0; profile < t.profiles; ++profile)
        add_profile_rows(t, profile, rows);
    return rows;
}

/// Of numbers in the file's format, 1, 2 or 4 to a texel.
struct NumberFormat {
    GLenum internal_format = 0, format = 0, type = 0;
};
NumberFormat number_format(FeatureNumberFormat format, std::uint32_t channels) {
    const std::size_t k = channels == 1 ? 0 : channels == 2 ? 1 : 2;
    constexpr GLenum plain[] = {GL_RED, GL_RG, GL_RGBA}, integer[] = {GL_RED_INTEGER, GL_RG_INTEGER, GL_RGBA_INTEGER},
                     floats[] = {GL_R32F, GL_RG32F, GL_RGBA32F}, halves[] = {GL_R16F, GL_RG16F, GL_RGBA16F},
                     integers[] = {GL_R16UI, GL_RG16UI, GL_RGBA16UI};
    switch (format) {
    case FeatureNumberFormat::Float:
        return {floats[k], plain[k], GL_FLOAT};
    case FeatureNumberFormat::Half:
        return {halves[k], plain[k], GL_HALF_FLOAT};
    default:
        return {integers[k], integer[k], GL_UNSIGNED_SHORT};
    }
}

} // namespace

RuntimeStatus Renderer::State::check_feature_curves(const FeatureCurvesTexture& texture) const {
    const auto side = static_cast<std::uint64_t>(max_texture_side);
    if (std::max<std::uint64_t>({texture.width + 1, texture.height + 1, feature_profile_entries(texture)}) > side)
        return RuntimeError{RuntimeErrc::TextureTooLarge, "this device takes textures of " + std::to_string(side) +
                                                              " texels a side; this one has " +
                                                              std::to_string(texture.width) + "x" +
                                                              std::to_string(texture.height) + ", and corners around"};
    return std::nullopt;
}

void Renderer::State::delete_feature_curves() {
    gl().DeleteTextures(static_cast<GLsizei>(feature_curves.textures.size()), feature_curves.textures.data());
    for (const Program& program : feature_curves.programs)
        if (program.id != 0) gl().DeleteProgram(program.id);
    feature_curves = {};
}

Outcome<Program> Renderer::State::build_feature_curves(const FeatureCurvesTraits& traits,
                                                       FeatureCurvesProgram kind) const {
    const std::string fragment =
        kind == FeatureCurvesProgram::Mips
            ? feature_curves_mip_fragment_source(options.dialect, traits)
            : feature_curves_fragment_source(options.dialect, traits,
                                             kind == FeatureCurvesProgram::Point ? Filter::Point : Filter::Area);
    return build_program(gl(), view_vertex_source(options.dialect), fragment, kSamplers);
}

/// Of the texture uploaded last.
RuntimeStatus Renderer::State::need_feature_curves_program(FeatureCurvesProgram kind) {
    Program& program = feature_curves.programs[static_cast<std::size_t>(kind)];
    if (program.id != 0 || feature_curves.textures[0] == 0) return std::nullopt;
    if (kind == FeatureCurvesProgram::Mips && !feature_curves.traits.mips) return std::nullopt;
    const auto built = build_feature_curves(feature_curves.traits, kind);
    if (!built) return built.error();
    program = built.value();
    return std::nullopt;
}

void Renderer::State::upload_feature_numbers(const FeatureCurvesTexture& t) {
    const auto make = [&](GLuint unit, std::uint32_t channels, const std::vector<std::uint8_t>& data) {
        const NumberFormat f = number_format(t.format, channels);
        feature_curves.textures[unit] =
            make_texture(gl(), unit, f.internal_format, t.width + 1, t.height + 1, f.format, f.type, data.data());
    };
    make(kSignatureUnit, feature_signature_numbers(t.linear), t.signatures);
    if (t.gradients.empty())
        make(kCornerUnit, 1, t.distances);
    else
        make(kCornerUnit, 4, corners_with_gradients(t));
}

RuntimeStatus Renderer::State::upload_feature_curves(const FeatureCurvesTexture& t) {
    if (auto bad = check_feature_curves(t)) return bad;
    const FeatureCurvesTraits traits = feature_curves_traits(t);
    const auto point = build_feature_curves(traits, FeatureCurvesProgram::Point);
    if (!point) return point.error(); // what was uploaded before stays
    delete_feature_curves();
    feature_curves.traits = traits, feature_curves.width = t.width, feature_curves.height = t.height;
    feature_curves.programs[static_cast<std::size_t>(FeatureCurvesProgram::Point)] = point.value();
    const TightRows tight(gl());
    auto& textures = feature_curves.textures;
    textures[kTexelUnit] = make_texels(gl(), t);
    upload_feature_numbers(t);
    textures[kBaseUnit] = make_sample_texture(gl(), kBaseUnit, t.base_format, traits.one_sample ? 1 : t.width + 1,
                                              traits.one_sample ? 1 : t.height + 1, t.base);
    textures[kProfileUnit] =
        make_texture(gl(), kProfileUnit, GL_RGBA32F, static_cast<std::uint32_t>(feature_profile_entries(t)),
                     4 * t.profiles, GL_RGBA, GL_FLOAT, profile_rows(t).data());
    if (!t.mips.empty())
        textures[kMipUnit] =
            make_mip_texture(gl(), kMipUnit, GL_RGBA8, t.width, t.height, GL_RGBA,
                             {reinterpret_cast<const std::uint8_t*>(t.mips.data()), t.mips.size() * 4});
    return gl_error(gl(), "uploading a texture with feature curves");
}

void Renderer::State::bind_feature_curves() const {
    for (GLuint unit = 0; unit < feature_curves.textures.size(); ++unit) {
        gl().ActiveTexture(GL_TEXTURE0 + unit);
        gl().BindTexture(GL_TEXTURE_2D, feature_curves.textures[unit]);
    }
}

/// For time_draws.
Outcome<Layer> Renderer::State::bind_feature_curves(Sampler sampler) {
    const FeatureCurvesProgram kind = sampler == Sampler::FeatureCurves       ? FeatureCurvesProgram::Point
                                      : sampler == Sampler::FeatureCurvesArea ? FeatureCurvesProgram::Area
                                                                              : FeatureCurvesProgram::Mips;
    if (auto bad = need_feature_curves_program(kind)) return *bad;
    bind_feature_curves();
    return Layer{&feature_curves_program(kind), feature_curves.width, feature_curves.height, 0};
}

RuntimeStatus Renderer::upload_feature_curves(const FeatureCurvesTexture& texture) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_feature_curves(texture) : kNotCurrent;
}

Outcome<Image> Renderer::render_feature_curves(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    State& state = *state_;
    const FeatureCurvesLayer& layer = state.feature_curves;
    if (layer.textures[0] == 0)
        return RuntimeError{RuntimeErrc::NothingUploaded, "no texture with feature curves was uploaded"};
    const CurrentContext current(*state.context);
    if (!current.ok()) return kNotCurrent;
    const bool mips = layer.traits.mips && wants_mips(view, size, layer.width, layer.height);
    const FeatureCurvesProgram kind = mips                           ? FeatureCurvesProgram::Mips
                                      : size.filter == Filter::Point ? FeatureCurvesProgram::Point
                                                                     : FeatureCurvesProgram::Area;
    if (auto bad = state.need_feature_curves_program(kind)) return *bad;
    state.bind_feature_curves();
    const RenderSize drawn = mips ? RenderSize{size.width, size.height, 1} : size;
    return state.render(state.feature_curves_program(kind), view, drawn, layer.width, layer.height, 0);
}

} // namespace fetex
