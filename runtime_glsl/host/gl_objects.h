// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Programs, textures and the render target. Internal to the host library; a context is current in every function.
#pragma once

#include <span>
#include <string>

#include "formats/silmap.h"
#include "runtime_glsl/host/gl_context.h"
#include "runtime_glsl/host/sample_grid.h"

namespace fetex {

/// A linked program with the uniforms of host/shaders/view.glsl. 0: not made yet.
struct Program {
    GLuint id = 0;
    GLint origin = -1, step = -1, supersample = -1, pixel_sides = -1;
};

/// Samplers of units 0, 1 … are the named uniforms; a name the shader doesn't use may be given.
Outcome<Program> build_program(const GladGLContext& gl, const std::string& vertex, const std::string& fragment,
                               std::initializer_list<const char*> samplers);

/// A framebuffer object with one colour texture, of kTileSide unless said otherwise.
struct Target {
    GLuint framebuffer = 0, texture = 0;
};
Outcome<Target> make_target(const GladGLContext& gl, GLenum internal_format, std::uint32_t side);
void delete_target(const GladGLContext& gl, Target& target);

/// A 2D texture, NEAREST, clamped to its edges, without data; bound to the unit.
GLuint make_texture(const GladGLContext& gl, GLuint unit, GLenum internal_format, std::uint32_t width,
                    std::uint32_t height, GLenum format, GLenum type, const void* data);

/// What a file has of levels 1 … n of a texture of width×height texels (formats/fbt_mip.h), as GL's levels 0 … n − 1;
/// bytes for channels. NEAREST, clamped to its edges; bound to the unit.
GLuint make_mip_texture(const GladGLContext& gl, GLuint unit, GLenum internal_format, std::uint32_t width,
                        std::uint32_t height, GLenum format, std::span<const std::uint8_t> levels);

/// Words of two 16-bit integers each, the low ones first.
std::vector<std::uint16_t> halves_of(std::span<const std::uint32_t> words);

/// Samples of a bitmap, packed as a file's are in memory; RGB8 as RGBA8, 16 bits as integers. NEAREST, clamped to its
/// edges; bound to the unit.
GLuint make_sample_texture(const GladGLContext& gl, GLuint unit, SilmapSampleFormat format, std::uint32_t width,
                           std::uint32_t height, std::span<const std::uint32_t> samples);

/// Both filters of the texture that is bound: GL_NEAREST, GL_LINEAR; the second for less than a texel a pixel.
void set_filter(const GladGLContext& gl, GLint filter);
void set_filters(const GladGLContext& gl, GLint magnify, GLint minify);

/// What is uploaded has rows without padding, for as long as it lives.
class TightRows {
  public:
    explicit TightRows(const GladGLContext& gl) : gl_(gl) { gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1); }
    ~TightRows() { gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4); }
    TightRows(const TightRows&) = delete;
    TightRows& operator=(const TightRows&) = delete;

  private:
    const GladGLContext& gl_;
};

/// The program's grid for a tile.
void set_grid(const GladGLContext& gl, const Program& program, const AxisGrid& x, const AxisGrid& y,
              std::uint32_t supersample);

/// The error GL has recorded, if any; empties its queue.
RuntimeStatus gl_error(const GladGLContext& gl, const char* while_doing);

} // namespace fetex
