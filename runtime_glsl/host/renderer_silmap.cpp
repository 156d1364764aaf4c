// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Silhouette-map textures on the GPU: their textures and shaders.
#include <algorithm>

#include "formats/fbt_mip.h"
#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

// Texture units, as the shaders' bindings have them.
constexpr GLuint kCellUnit = 0, kColorUnit = 1, kMipUnit = 2;
constexpr std::initializer_list<const char*> kSamplers = {"fetexSilmapCells", "fetexSilmapColors", "fetexSilmapMips"};

/// What shaders depend on.
SilmapTexture traits_of(const SilmapTexture& texture) {
    SilmapTexture traits;
    traits.width = texture.width, traits.height = texture.height;
    traits.cell_format = texture.cell_format, traits.sample_format = texture.sample_format;
    if (!texture.mips.empty()) traits.mips = {0};
    return traits;
}

} // namespace

RuntimeStatus Renderer::State::check_silmap(const SilmapTexture& texture) const {
    const auto side = static_cast<std::uint32_t>(max_texture_side);
    if (std::max(silmap_columns(texture), silmap_rows(texture)) <= side) return std::nullopt;
    return RuntimeError{RuntimeErrc::TextureTooLarge,
                        "this device takes textures of " + std::to_string(side) + " texels a side; this one has " +
                            std::to_string(texture.width) + "x" + std::to_string(texture.height) +
                            ", and one cell more each way"};
}

void Renderer::State::delete_silmap() {
    for (GLuint* texture : {&silmap.cells, &silmap.colors, &silmap.mips})
        gl().DeleteTextures(1, texture);
    for (const Program& program : silmap.programs)
        if (program.id != 0) gl().DeleteProgram(program.id);
    silmap = {};
}

Outcome<Program> Renderer::State::build_silmap(const SilmapTexture& traits, SilmapFilter filter,
                                               SilmapProgram kind) const {
    const std::string fragment =
        kind == SilmapProgram::Mips
            ? silmap_mip_fragment_source(options.dialect, traits, filter)
            : silmap_fragment_source(options.dialect, traits,
                                     kind == SilmapProgram::Point ? Filter::Point : Filter::Area, filter);
    return build_program(gl(), view_vertex_source(options.dialect), fragment, kSamplers);
}

/// Of the texture uploaded last.
RuntimeStatus Renderer::State::need_silmap_program(SilmapProgram kind) {
    Program& program = silmap.programs[static_cast<std::size_t>(kind)];
    if (program.id != 0 || silmap.cells == 0) return std::nullopt;
    if (kind == SilmapProgram::Mips && silmap.traits.mips.empty()) return std::nullopt;
    const auto built = build_silmap(silmap.traits, silmap.filter, kind);
    if (!built) return built.error();
    program = built.value();
    return std::nullopt;
}

void Renderer::State::upload_silmap_cells(const SilmapTexture& texture) {
    const std::uint32_t columns = silmap_columns(texture), rows = silmap_rows(texture);
    if (texture.cell_format == SilmapCellFormat::Bits16) {
        silmap.cells = make_texture(gl(), kCellUnit, GL_R16UI, columns, rows, GL_RED_INTEGER, GL_UNSIGNED_SHORT,
                                    texture.cells.data());
        return;
    }
    const std::vector<std::uint8_t> bytes(texture.cells.begin(), texture.cells.end());
    silmap.cells =
        make_texture(gl(), kCellUnit, GL_R8UI, columns, rows, GL_RED_INTEGER, GL_UNSIGNED_BYTE, bytes.data());
}

RuntimeStatus Renderer::State::upload_silmap(const SilmapTexture& texture, SilmapFilter filter) {
    if (auto bad = check_silmap(texture)) return bad;
    const SilmapTexture traits = traits_of(texture);
    const auto point = build_silmap(traits, filter, SilmapProgram::Point);
    if (!point) return point.error(); // what was uploaded before stays
    delete_silmap();
    silmap.traits = traits;
    silmap.filter = filter;
    silmap.programs[static_cast<std::size_t>(SilmapProgram::Point)] = point.value();
    const TightRows tight(gl());
    upload_silmap_cells(texture);
    silmap.colors =
        make_sample_texture(gl(), kColorUnit, texture.sample_format, texture.width, texture.height, texture.colors);
    if (!texture.mips.empty())
        silmap.mips =
            make_mip_texture(gl(), kMipUnit, GL_RGBA8, texture.width, texture.height, GL_RGBA,
                             {reinterpret_cast<const std::uint8_t*>(texture.mips.data()), texture.mips.size() * 4});
    return gl_error(gl(), "uploading a silhouette-map texture");
}

void Renderer::State::bind_silmap() const {
    const GLuint textures[] = {silmap.cells, silmap.colors, silmap.mips};
    for (const GLuint unit : {kCellUnit, kColorUnit, kMipUnit}) {
        gl().ActiveTexture(GL_TEXTURE0 + unit);
        gl().BindTexture(GL_TEXTURE_2D, textures[unit]);
    }
}

/// For time_draws.
Outcome<Layer> Renderer::State::bind_silmap(Sampler sampler) {
    const SilmapProgram kind = sampler == Sampler::Silmap       ? SilmapProgram::Point
                               : sampler == Sampler::SilmapArea ? SilmapProgram::Area
                                                                : SilmapProgram::Mips;
    if (auto bad = need_silmap_program(kind)) return *bad;
    bind_silmap();
    return Layer{&silmap_program(kind), silmap.traits.width, silmap.traits.height, 0};
}

RuntimeStatus Renderer::upload_silmap(const SilmapTexture& texture, SilmapFilter filter) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_silmap(texture, filter) : kNotCurrent;
}

Outcome<Image> Renderer::render_silmap(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    State& state = *state_;
    const SilmapTexture& traits = state.silmap.traits;
    if (state.silmap.cells == 0)
        return RuntimeError{RuntimeErrc::NothingUploaded, "no silhouette-map texture was uploaded"};
    const CurrentContext current(*state.context);
    if (!current.ok()) return kNotCurrent;
    const bool mips = !traits.mips.empty() && wants_mips(view, size, traits.width, traits.height);
    const SilmapProgram kind = mips                           ? SilmapProgram::Mips
                               : size.filter == Filter::Point ? SilmapProgram::Point
                                                              : SilmapProgram::Area;
    if (auto bad = state.need_silmap_program(kind)) return *bad;
    state.bind_silmap();
    const RenderSize drawn = mips ? RenderSize{size.width, size.height, 1} : size;
    return state.render(state.silmap_program(kind), view, drawn, traits.width, traits.height, 0);
}

} // namespace fetex
