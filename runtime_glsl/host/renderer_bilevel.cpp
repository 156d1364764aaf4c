// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Bi-level textures on the GPU: their textures and shaders, and whether the hardware's filter would do.
#include <algorithm>
#include <cmath>

#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

// Texture units, as the shaders' bindings have them.
constexpr GLuint kTexelUnit = 0, kMipUnit = 1, kImageUnit = 2, kProbeUnit = 0;
constexpr std::initializer_list<const char*> kSamplers = {"fetexBilevelTexels", "fetexBilevelMips",
                                                          "fetexBilevelImage"};

/// Internal and external format of one to three bytes a texel.
struct ByteFormat {
    GLenum internal_format = 0, format = 0;
};
constexpr ByteFormat kByteFormats[] = {{GL_R8, GL_RED}, {GL_RG8, GL_RG}, {GL_RGB8, GL_RGB}};

/// What shaders depend on.
BilevelTexture traits_of(const BilevelTexture& texture) {
    BilevelTexture traits;
    traits.width = texture.width, traits.height = texture.height;
    traits.channels = texture.channels, traits.rule = texture.rule;
    traits.below = texture.below, traits.above = texture.above;
    if (!texture.mips.empty()) traits.mips = {0};
    if (!texture.image.empty()) traits.image = {0};
    return traits;
}

} // namespace

RuntimeStatus Renderer::State::check_bilevel(const BilevelTexture& texture) const {
    const auto side = static_cast<std::uint32_t>(max_texture_side);
    if (std::max({texture.width, texture.height, texture.image_width, texture.image_height}) <= side)
        return std::nullopt;
    return RuntimeError{RuntimeErrc::TextureTooLarge,
                        "this device takes textures of " + std::to_string(side) + " texels a side; this one has " +
                            std::to_string(texture.width) + "x" + std::to_string(texture.height) + ", its image " +
                            std::to_string(texture.image_width) + "x" + std::to_string(texture.image_height)};
}

void Renderer::State::delete_bilevel() {
    for (GLuint* texture : {&bilevel.texels, &bilevel.mips, &bilevel.image})
        gl().DeleteTextures(1, texture);
    for (const Program& program : bilevel.programs)
        if (program.id != 0) gl().DeleteProgram(program.id);
    bilevel = {};
}

Outcome<Program> Renderer::State::build_bilevel(const BilevelTexture& traits, BilevelFetch fetch,
                                                BilevelProgram kind) const {
    const bool filtered = fetch == BilevelFetch::Filtered;
    const std::string fragment =
        kind == BilevelProgram::Mips
            ? bilevel_mip_fragment_source(options.dialect, traits, filtered)
            : bilevel_fragment_source(options.dialect, traits,
                                      kind == BilevelProgram::Hard ? Filter::Point : Filter::Area, filtered);
    return build_program(gl(), view_vertex_source(options.dialect), fragment, kSamplers);
}

/// Of the texture uploaded last.
RuntimeStatus Renderer::State::need_bilevel_program(BilevelProgram kind) {
    Program& program = bilevel.programs[static_cast<std::size_t>(kind)];
    if (program.id != 0 || bilevel.texels == 0) return std::nullopt;
    if (kind == BilevelProgram::Mips && bilevel.traits.mips.empty()) return std::nullopt;
    const auto built = build_bilevel(bilevel.traits, bilevel.fetch, kind);
    if (!built) return built.error();
    program = built.value();
    return std::nullopt;
}

RuntimeStatus Renderer::State::upload_bilevel(const BilevelTexture& texture, BilevelFetch fetch) {
    if (auto bad = check_bilevel(texture)) return bad;
    const BilevelTexture traits = traits_of(texture);
    const auto hard = build_bilevel(traits, fetch, BilevelProgram::Hard);
    if (!hard) return hard.error(); // what was uploaded before stays
    delete_bilevel();
    bilevel.traits = traits;
    bilevel.fetch = fetch;
    bilevel.programs[static_cast<std::size_t>(BilevelProgram::Hard)] = hard.value();
    const TightRows tight(gl());
    const GLint filter = fetch == BilevelFetch::Filtered ? GL_LINEAR : GL_NEAREST;
    const ByteFormat format = kByteFormats[texture.channels - 1];
    bilevel.texels = make_texture(gl(), kTexelUnit, format.internal_format, texture.width, texture.height,
                                  format.format, GL_UNSIGNED_BYTE, texture.texels.data());
    set_filter(gl(), filter);
    if (!texture.mips.empty())
        bilevel.mips = make_mip_texture(gl(), kMipUnit, GL_R8, texture.width, texture.height, GL_RED, texture.mips);
    if (!texture.image.empty()) {
        bilevel.image = make_texture(gl(), kImageUnit, GL_RGBA8, texture.image_width, texture.image_height, GL_RGBA,
                                     GL_UNSIGNED_BYTE, texture.image.data());
        set_filter(gl(), filter);
    }
    return gl_error(gl(), "uploading a bi-level texture");
}

void Renderer::State::bind_bilevel() const {
    const GLuint textures[] = {bilevel.texels, bilevel.mips, bilevel.image};
    for (const GLuint unit : {kTexelUnit, kMipUnit, kImageUnit}) {
        gl().ActiveTexture(GL_TEXTURE0 + unit);
        gl().BindTexture(GL_TEXTURE_2D, textures[unit]);
    }
}

/// From a black texel's middle to a white one's in steps of 2^-12: what comes out should be the way there.
Outcome<double> Renderer::State::linear_filter_error() {
    constexpr std::uint32_t kPositions = 1u << 12;
    constexpr std::int64_t kStep = (std::int64_t{1} << 32) / kPositions;
    if (auto bad = need_bitmap_programs()) return *bad;
    const std::uint8_t black_and_white[2] = {0, 255};
    const TightRows tight(gl());
    GLuint texture = make_texture(gl(), kProbeUnit, GL_R8, 2, 1, GL_RED, GL_UNSIGNED_BYTE, black_and_white);
    set_filter(gl(), GL_LINEAR);
    gl().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl().Viewport(0, 0, kTileSide, 1);
    std::vector<float> row(std::size_t{kTileSide} * 4);
    double worst = 0;
    for (std::uint32_t first = 0; first < kPositions; first += kTileSide) {
        set_grid(gl(), filtered_program, {first * kStep, kStep}, {}, 1);
        gl().DrawArrays(GL_TRIANGLES, 0, 3);
        gl().ReadPixels(0, 0, kTileSide, 1, GL_RGBA, GL_FLOAT, row.data());
        for (std::uint32_t k = 0; k < kTileSide; ++k) {
            const double wanted = static_cast<double>(first + k) / kPositions;
            worst = std::max(worst, std::abs(row[std::size_t{k} * 4] - wanted));
        }
    }
    gl().DeleteTextures(1, &texture);
    if (auto bad = gl_error(gl(), "probing the filter")) return *bad;
    return worst;
}

RuntimeStatus Renderer::upload_bilevel(const BilevelTexture& texture, BilevelFetch fetch) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_bilevel(texture, fetch) : kNotCurrent;
}

Outcome<Image> Renderer::render_bilevel(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    State& state = *state_;
    const BilevelTexture& traits = state.bilevel.traits;
    if (state.bilevel.texels == 0)
        return RuntimeError{RuntimeErrc::NothingUploaded, "no bi-level texture was uploaded"};
    const CurrentContext current(*state.context);
    if (!current.ok()) return kNotCurrent;
    const bool mips = !traits.mips.empty() && wants_mips(view, size, traits.width, traits.height);
    const BilevelProgram kind = mips                           ? BilevelProgram::Mips
                                : size.filter == Filter::Point ? BilevelProgram::Hard
                                                               : BilevelProgram::Soft;
    if (auto bad = state.need_bilevel_program(kind)) return *bad;
    state.bind_bilevel();
    const RenderSize drawn = mips ? RenderSize{size.width, size.height, 1} : size;
    return state.render(state.bilevel_program(kind), view, drawn, traits.width, traits.height, 0);
}

Outcome<double> Renderer::linear_filter_error() {
    const CurrentContext current(*state_->context);
    if (!current.ok()) return kNotCurrent;
    return state_->linear_filter_error();
}

} // namespace fetex
