// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Pinchmaps on the GPU: their textures and shaders.
#include <algorithm>

#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

// Texture units, as the shaders' bindings have them.
constexpr GLuint kMapUnit = 0, kSignalUnit = 1, kMipUnit = 2;
constexpr std::initializer_list<const char*> kSamplers = {"fetexPinchmapMap", "fetexPinchmapSignal",
                                                          "fetexPinchmapMips"};

/// What shaders depend on.
PinchmapTexture traits_of(const PinchmapTexture& texture) {
    PinchmapTexture traits;
    traits.width = texture.width, traits.height = texture.height, traits.scale = texture.scale;
    traits.map_format = texture.map_format, traits.sample_format = texture.sample_format;
    traits.line_color = texture.line_color, traits.line_width = texture.line_width;
    if (!texture.mips.empty()) traits.mips = {0};
    return traits;
}

/// Stored integers less what stands for 0, as signed ones of as many bits.
template <class To, class From> std::vector<To> centred(std::span<const From> stored, std::uint32_t zero) {
    std::vector<To> out(stored.size());
    std::ranges::transform(stored, out.begin(),
                           [&](From v) { return static_cast<To>(static_cast<int>(v) - static_cast<int>(zero)); });
    return out;
}

} // namespace

RuntimeStatus Renderer::State::check_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch) const {
    const auto side = static_cast<std::uint64_t>(max_texture_side);
    const std::uint64_t longer = std::max(texture.width, texture.height);
    if (std::max(longer + 1, longer << texture.scale) > side)
        return RuntimeError{RuntimeErrc::TextureTooLarge,
                            "this device takes textures of " + std::to_string(side) + " texels a side; this one has " +
                                std::to_string(texture.width) + "x" + std::to_string(texture.height) +
                                " clusters, and its signal 2^" + std::to_string(texture.scale) + " times as many"};
    if (fetch == PinchmapFetch::Filtered && context->es && texture.map_format == PinchmapFormat::Bits16)
        return RuntimeError{RuntimeErrc::GlTooOld, "ES has no filter for pinchmaps of 16 bits"};
    return std::nullopt;
}

void Renderer::State::delete_pinchmap() {
    for (GLuint* texture : {&pinchmap.map, &pinchmap.signal, &pinchmap.mips})
        gl().DeleteTextures(1, texture);
    for (const Program& program : pinchmap.programs)
        if (program.id != 0) gl().DeleteProgram(program.id);
    pinchmap = {};
}

Outcome<Program> Renderer::State::build_pinchmap(const PinchmapTexture& traits, PinchmapFetch fetch,
                                                 PinchmapProgram kind) const {
    const bool filtered = fetch == PinchmapFetch::Filtered;
    const std::string fragment =
        kind == PinchmapProgram::Mips
            ? pinchmap_mip_fragment_source(options.dialect, traits, filtered)
            : pinchmap_fragment_source(options.dialect, traits,
                                       kind == PinchmapProgram::Point ? Filter::Point : Filter::Area, filtered);
    return build_program(gl(), view_vertex_source(options.dialect), fragment, kSamplers);
}

/// Of the texture uploaded last.
RuntimeStatus Renderer::State::need_pinchmap_program(PinchmapProgram kind) {
    Program& program = pinchmap.programs[static_cast<std::size_t>(kind)];
    if (program.id != 0 || pinchmap.map == 0) return std::nullopt;
    if (kind == PinchmapProgram::Mips && pinchmap.traits.mips.empty()) return std::nullopt;
    const auto built = build_pinchmap(pinchmap.traits, pinchmap.fetch, kind);
    if (!built) return built.error();
    program = built.value();
    return std::nullopt;
}

/// Zero is exact in signed formats, and directions of 0 must stay so.
void Renderer::State::upload_pinchmap_map(const PinchmapTexture& texture, PinchmapFetch fetch) {
    const std::uint32_t columns = pinchmap_columns(texture), rows = pinchmap_rows(texture),
                        zero = pinchmap_zero(texture.map_format);
    const bool filtered = fetch == PinchmapFetch::Filtered;
    const auto make = [&](GLenum internal_format, GLenum format, GLenum type, const void* data) {
        pinchmap.map = make_texture(gl(), kMapUnit, internal_format, columns, rows, format, type, data);
    };
    if (texture.map_format == PinchmapFormat::Bits8) {
        std::vector<std::uint8_t> stored;
        for (const std::uint32_t word : texture.map)
            for (unsigned shift = 0; shift < 32; shift += 8)
                stored.push_back(static_cast<std::uint8_t>(word >> shift));
        make(GL_RGBA8_SNORM, GL_RGBA, GL_BYTE,
             centred<std::int8_t>(std::span<const std::uint8_t>(stored), zero).data());
    } else {
        const std::vector<std::uint16_t> stored = halves_of(texture.map);
        const auto values = centred<std::int16_t>(std::span<const std::uint16_t>(stored), zero);
        make(filtered ? GL_RGBA16_SNORM : GL_RGBA16I, filtered ? GL_RGBA : GL_RGBA_INTEGER, GL_SHORT, values.data());
    }
    if (filtered) set_filter(gl(), GL_LINEAR);
}

RuntimeStatus Renderer::State::upload_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch) {
    if (auto bad = check_pinchmap(texture, fetch)) return bad;
    const PinchmapTexture traits = traits_of(texture);
    const auto point = build_pinchmap(traits, fetch, PinchmapProgram::Point);
    if (!point) return point.error(); // what was uploaded before stays
    delete_pinchmap();
    pinchmap.traits = traits;
    pinchmap.fetch = fetch;
    pinchmap.programs[static_cast<std::size_t>(PinchmapProgram::Point)] = point.value();
    const bool filtered = fetch == PinchmapFetch::Filtered;
    const std::uint32_t width = pinchmap_signal_width(texture), height = pinchmap_signal_height(texture);
    const TightRows tight(gl());
    upload_pinchmap_map(texture, fetch);
    pinchmap.signal = make_sample_texture(gl(), kSignalUnit, texture.sample_format, width, height, texture.signal);
    if (filtered && texture.sample_format != PinchmapSampleFormat::Rgba16) set_filter(gl(), GL_LINEAR);
    if (!texture.mips.empty()) {
        pinchmap.mips =
            make_mip_texture(gl(), kMipUnit, GL_RGBA8, width, height, GL_RGBA,
                             {reinterpret_cast<const std::uint8_t*>(texture.mips.data()), texture.mips.size() * 4});
        if (filtered) set_filters(gl(), GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR);
    }
    return gl_error(gl(), "uploading a pinchmap");
}

void Renderer::State::bind_pinchmap() const {
    const GLuint textures[] = {pinchmap.map, pinchmap.signal, pinchmap.mips};
    for (const GLuint unit : {kMapUnit, kSignalUnit, kMipUnit}) {
        gl().ActiveTexture(GL_TEXTURE0 + unit);
        gl().BindTexture(GL_TEXTURE_2D, textures[unit]);
    }
}

/// For time_draws.
Outcome<Layer> Renderer::State::bind_pinchmap(Sampler sampler) {
    const PinchmapProgram kind = sampler == Sampler::Pinchmap       ? PinchmapProgram::Point
                                 : sampler == Sampler::PinchmapArea ? PinchmapProgram::Area
                                                                    : PinchmapProgram::Mips;
    if (auto bad = need_pinchmap_program(kind)) return *bad;
    bind_pinchmap();
    return Layer{&pinchmap_program(kind), pinchmap.traits.width, pinchmap.traits.height, 0};
}

RuntimeStatus Renderer::upload_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_pinchmap(texture, fetch) : kNotCurrent;
}

Outcome<Image> Renderer::render_pinchmap(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    State& state = *state_;
    const PinchmapTexture& traits = state.pinchmap.traits;
    if (state.pinchmap.map == 0) return RuntimeError{RuntimeErrc::NothingUploaded, "no pinchmap was uploaded"};
    const CurrentContext current(*state.context);
    if (!current.ok()) return kNotCurrent;
    const bool mips =
        !traits.mips.empty() && wants_mips(view, size, pinchmap_signal_width(traits), pinchmap_signal_height(traits));
    const PinchmapProgram kind = mips                           ? PinchmapProgram::Mips
                                 : size.filter == Filter::Point ? PinchmapProgram::Point
                                                                : PinchmapProgram::Area;
    if (auto bad = state.need_pinchmap_program(kind)) return *bad;
    state.bind_pinchmap();
    const RenderSize drawn = mips ? RenderSize{size.width, size.height, 1} : size;
    return state.render(state.pinchmap_program(kind), view, drawn, traits.width, traits.height, 0);
}

} // namespace fetex
