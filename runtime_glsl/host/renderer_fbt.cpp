// SPDX-License-Identifier: Apache-2.0 OR MIT
/// FBTs on the GPU: their textures, and the shaders that they need.
#include <algorithm>

#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

constexpr std::uint32_t kRecordColumns = 2048; ///< as fetex_fbt.glsl reads them

// Texture units, as the shaders' bindings have them.
constexpr GLuint kTexelUnit = 0, kRecordUnit = 1, kCornerUnit = 2, kMipUnit = 3;
constexpr std::initializer_list<const char*> kFbtSamplers = {"fetexFbtTexels", "fetexFbtRecords", "fetexFbtCorners",
                                                             "fetexFbtMips"};

} // namespace

RuntimeStatus Renderer::State::check_limits(const FbtTexture& texture) const {
    const auto side = static_cast<std::uint32_t>(max_texture_side);
    const std::size_t records = texture.records.size() / 4;
    const std::size_t most =
        options.texture_buffer ? static_cast<std::size_t>(max_buffer_texels) : std::size_t{kRecordColumns} * side;
    const std::uint32_t corners = texture.corners.empty() ? 0 : 1;
    if (texture.width + corners <= side && texture.height + corners <= side && records <= most) return std::nullopt;
    return RuntimeError{RuntimeErrc::TextureTooLarge,
                        "this device takes textures of " + std::to_string(side) + " texels a side and " +
                            std::to_string(most) + " records; this one needs " +
                            std::to_string(texture.width + corners) + "x" + std::to_string(texture.height + corners) +
                            " and " + std::to_string(records)};
}

void Renderer::State::delete_fbt() {
    gl().DeleteTextures(1, &texel_texture);
    gl().DeleteTextures(1, &corner_texture);
    gl().DeleteTextures(1, &record_texture);
    gl().DeleteTextures(1, &mip_texture);
    gl().DeleteBuffers(1, &record_buffer);
    for (auto* programs : {&fbt_programs, &mip_programs}) {
        for (Program& program : *programs) {
            if (program.id != 0) gl().DeleteProgram(program.id);
            program = {};
        }
    }
    texel_texture = corner_texture = record_texture = record_buffer = mip_texture = 0;
}

/// Whole rows, then the rest of the last; a texture of one row is only as wide as it must be.
void Renderer::State::upload_records(const FbtTexture& texture) {
    const auto records = static_cast<std::uint32_t>(texture.records.size() / 4);
    const std::uint32_t columns = std::clamp(records, 1u, kRecordColumns);
    const std::uint32_t rows = records / kRecordColumns, rest = records % kRecordColumns;
    record_texture = make_texture(gl(), kRecordUnit, GL_RGBA32UI, columns, std::max(rows + (rest != 0), 1u),
                                  GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
    const auto put = [&](std::uint32_t row, std::uint32_t width, std::uint32_t height) {
        gl().TexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(row), static_cast<GLsizei>(width),
                           static_cast<GLsizei>(height), GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                           texture.records.data() + std::size_t{row} * kRecordColumns * 4);
    };
    if (rows > 0) put(0, kRecordColumns, rows);
    if (rest > 0) put(rows, rest, 1);
}

void Renderer::State::upload_record_buffer(const FbtTexture& texture) {
    gl().GenBuffers(1, &record_buffer);
    gl().BindBuffer(GL_TEXTURE_BUFFER, record_buffer);
    const std::size_t bytes = std::max<std::size_t>(texture.records.size() * 4, 16);
    gl().BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
    gl().BufferSubData(GL_TEXTURE_BUFFER, 0, static_cast<GLsizeiptr>(texture.records.size() * 4),
                       texture.records.data());
    gl().GenTextures(1, &record_texture);
    gl().ActiveTexture(GL_TEXTURE0 + kRecordUnit);
    gl().BindTexture(GL_TEXTURE_BUFFER, record_texture);
    gl().TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32UI, record_buffer);
}

RuntimeStatus Renderer::State::upload_fbt(const FbtTexture& texture) {
    if (auto bad = check_limits(texture)) return bad;
    FbtTexture traits;
    traits.traits = texture.traits, traits.sample_format = texture.sample_format;
    if (!texture.mips.empty()) traits.mips = {0};
    const auto plain = build_fbt(traits, Filter::Point, false);
    if (!plain) return plain.error(); // what was uploaded before stays
    delete_fbt();
    fbt_traits = traits;
    fbt_programs[0] = plain.value();
    fbt_width = texture.width;
    fbt_height = texture.height;
    texel_texture = make_texture(gl(), kTexelUnit, GL_R32UI, texture.width, texture.height, GL_RED_INTEGER,
                                 GL_UNSIGNED_INT, texture.texels.data());
    if (!texture.corners.empty()) {
        const bool wide = texture.sample_format != FbtSampleFormat::Rgba8;
        corner_texture =
            make_texture(gl(), kCornerUnit, wide ? GL_RG32UI : GL_R32UI, texture.width + 1, texture.height + 1,
                         wide ? GL_RG_INTEGER : GL_RED_INTEGER, GL_UNSIGNED_INT, texture.corners.data());
    }
    if (options.texture_buffer) {
        upload_record_buffer(texture);
    } else {
        upload_records(texture);
    }
    if (!texture.mips.empty()) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(texture.mips.data());
        mip_texture = make_mip_texture(gl(), kMipUnit, GL_RGBA8, texture.width, texture.height, GL_RGBA,
                                       {bytes, texture.mips.size() * 4});
    }
    return gl_error(gl(), "uploading a texture");
}

Outcome<Program> Renderer::State::build_fbt(const FbtTexture& traits, Filter filter, bool mips) const {
    const auto source = mips ? fbt_mip_fragment_source : fbt_fragment_source;
    return build_program(gl(), view_vertex_source(options.dialect),
                         source(options.dialect, traits, options.texture_buffer, filter), kFbtSamplers);
}

/// Of the texture uploaded last; compiled when it is first wanted.
RuntimeStatus Renderer::State::need_fbt_program(Filter filter, bool mips) {
    Program& program = (mips ? mip_programs : fbt_programs)[static_cast<std::size_t>(filter)];
    if (program.id != 0 || fbt_programs[0].id == 0 || (mips && fbt_traits.mips.empty())) return std::nullopt;
    const auto built = build_fbt(fbt_traits, filter, mips);
    if (!built) return built.error();
    program = built.value();
    return std::nullopt;
}

void Renderer::State::bind_fbt() const {
    gl().ActiveTexture(GL_TEXTURE0 + kTexelUnit);
    gl().BindTexture(GL_TEXTURE_2D, texel_texture);
    gl().ActiveTexture(GL_TEXTURE0 + kCornerUnit);
    gl().BindTexture(GL_TEXTURE_2D, corner_texture);
    gl().ActiveTexture(GL_TEXTURE0 + kMipUnit);
    gl().BindTexture(GL_TEXTURE_2D, mip_texture);
    gl().ActiveTexture(GL_TEXTURE0 + kRecordUnit);
    gl().BindTexture(options.texture_buffer ? GL_TEXTURE_BUFFER : GL_TEXTURE_2D, record_texture);
}

} // namespace fetex
