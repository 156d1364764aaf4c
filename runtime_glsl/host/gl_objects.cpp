// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/gl_objects.h"

#include <array>
#include <cstdio>

#include "formats/fbt_mip.h"

namespace fetex {
namespace {

using Log = std::array<char, 4096>;

constexpr GLuint kTargetUnit = 15; ///< no sampler uses it; every GL has so many

Outcome<GLuint> compile(const GladGLContext& gl, GLenum stage, const std::string& source) {
    const GLuint shader = gl.CreateShader(stage);
    const char* text = source.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    Log log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteShader(shader);
    return RuntimeError{RuntimeErrc::ShaderFailed, std::string("a shader doesn't compile: ") + log.data()};
}

Outcome<GLuint> link(const GladGLContext& gl, GLuint vertex, GLuint fragment) {
    const GLuint program = gl.CreateProgram();
    gl.AttachShader(program, vertex);
    gl.AttachShader(program, fragment);
    gl.LinkProgram(program);
    GLint good = 0;
    gl.GetProgramiv(program, GL_LINK_STATUS, &good);
    if (good) return program;
    Log log{};
    gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    gl.DeleteProgram(program);
    return RuntimeError{RuntimeErrc::ShaderFailed, std::string("a program doesn't link: ") + log.data()};
}

} // namespace

Outcome<Program> build_program(const GladGLContext& gl, const std::string& vertex, const std::string& fragment,
                               std::initializer_list<const char*> samplers) {
    const auto vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex);
    if (!vertex_shader) return vertex_shader.error();
    const auto fragment_shader = compile(gl, GL_FRAGMENT_SHADER, fragment);
    if (!fragment_shader) {
        gl.DeleteShader(vertex_shader.value());
        return fragment_shader.error();
    }
    const auto linked = link(gl, vertex_shader.value(), fragment_shader.value());
    gl.DeleteShader(vertex_shader.value());
    gl.DeleteShader(fragment_shader.value());
    if (!linked) return linked.error();
    Program program;
    program.id = linked.value();
    gl.UseProgram(program.id);
    program.origin = gl.GetUniformLocation(program.id, "fetexOrigin");
    program.step = gl.GetUniformLocation(program.id, "fetexStep");
    program.supersample = gl.GetUniformLocation(program.id, "fetexSupersample");
    program.pixel_sides = gl.GetUniformLocation(program.id, "fetexPixelSides");
    GLint unit = 0;
    for (const char* sampler : samplers)
        gl.Uniform1i(gl.GetUniformLocation(program.id, sampler), unit++);
    return program;
}

GLuint make_texture(const GladGLContext& gl, GLuint unit, GLenum internal_format, std::uint32_t width,
                    std::uint32_t height, GLenum format, GLenum type, const void* data) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internal_format), static_cast<GLsizei>(width),
                  static_cast<GLsizei>(height), 0, format, type, data);
    return texture;
}

GLuint make_mip_texture(const GladGLContext& gl, GLuint unit, GLenum internal_format, std::uint32_t width,
                        std::uint32_t height, GLenum format, std::span<const std::uint8_t> levels) {
    const std::uint32_t n = fbt_mip_levels(width, height);
    const std::size_t sample_bytes = levels.size() / fbt_mip_samples(width, height);
    GLuint texture = 0;
    for (std::uint32_t k = 1; k <= n; ++k) {
        const FbtMipLevel level = fbt_mip_level(width, height, k);
        const std::uint8_t* samples = levels.data() + level.first * sample_bytes;
        if (k == 1)
            texture =
                make_texture(gl, unit, internal_format, level.width, level.height, format, GL_UNSIGNED_BYTE, samples);
        else
            gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(k - 1), static_cast<GLint>(internal_format),
                          static_cast<GLsizei>(level.width), static_cast<GLsizei>(level.height), 0, format,
                          GL_UNSIGNED_BYTE, samples);
    }
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(n - 1));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST); // else level 0 is all there is
    return texture;
}

std::vector<std::uint16_t> halves_of(std::span<const std::uint32_t> words) {
    std::vector<std::uint16_t> halves;
    halves.reserve(2 * words.size());
    for (const std::uint32_t word : words) {
        halves.push_back(static_cast<std::uint16_t>(word));
        halves.push_back(static_cast<std::uint16_t>(word >> 16));
    }
    return halves;
}

GLuint make_sample_texture(const GladGLContext& gl, GLuint unit, SilmapSampleFormat sample_format, std::uint32_t width,
                           std::uint32_t height, std::span<const std::uint32_t> samples) {
    const auto make = [&](GLenum internal_format, GLenum format, GLenum type, const void* data) {
        return make_texture(gl, unit, internal_format, width, height, format, type, data);
    };
    switch (sample_format) {
    case SilmapSampleFormat::Rgba8:
    case SilmapSampleFormat::Rgb8: // as drivers would widen it anyway
        break;
    case SilmapSampleFormat::Rgba16:
        return make(GL_RGBA16UI, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, halves_of(samples).data());
    case SilmapSampleFormat::Rgba16F:
        return make(GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, halves_of(samples).data());
    }
    return make(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
}

void set_filter(const GladGLContext& gl, GLint filter) { set_filters(gl, filter, filter); }

void set_filters(const GladGLContext& gl, GLint magnify, GLint minify) {
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
}

Outcome<Target> make_target(const GladGLContext& gl, GLenum internal_format, std::uint32_t side) {
    Target target;
    const GLenum type = internal_format == GL_RGBA32F ? GL_FLOAT : GL_UNSIGNED_BYTE;
    target.texture = make_texture(gl, kTargetUnit, internal_format, side, side, GL_RGBA, type, nullptr);
    gl.GenFramebuffers(1, &target.framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture, 0);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return target;
    delete_target(gl, target);
    return RuntimeError{RuntimeErrc::GlTooOld, "this context can't draw into a texture of 32-bit floats"};
}

void delete_target(const GladGLContext& gl, Target& target) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.DeleteFramebuffers(1, &target.framebuffer);
    gl.DeleteTextures(1, &target.texture);
    target = {};
}

void set_grid(const GladGLContext& gl, const Program& program, const AxisGrid& x, const AxisGrid& y,
              std::uint32_t supersample) {
    const auto whole = [](std::int64_t v) { return static_cast<GLint>(v >> 32); };
    const auto fraction = [](std::int64_t v) { return static_cast<GLint>(static_cast<std::uint32_t>(v)); };
    gl.UseProgram(program.id);
    gl.Uniform4i(program.origin, whole(x.origin), whole(y.origin), fraction(x.origin), fraction(y.origin));
    gl.Uniform4i(program.step, whole(x.step), whole(y.step), fraction(x.step), fraction(y.step));
    gl.Uniform1i(program.supersample, static_cast<GLint>(supersample));
}

RuntimeStatus gl_error(const GladGLContext& gl, const char* while_doing) {
    const GLenum first = gl.GetError();
    if (first == GL_NO_ERROR) return std::nullopt;
    // A lost context may report errors for ever.
    for (int k = 0; k < 16 && gl.GetError() != GL_NO_ERROR; ++k) {
    }
    char text[96];
    std::snprintf(text, sizeof text, "GL error 0x%04x while %s", first, while_doing);
    return RuntimeError{RuntimeErrc::OutOfMemoryOrLost, text};
}

} // namespace fetex
