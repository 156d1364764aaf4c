// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What a renderer holds. Internal to the host library; one file defines the part of each representation
/// (renderer_fbt.cpp, renderer_bilevel.cpp, renderer_silmap.cpp, renderer_pinchmap.cpp, renderer_feature_curves.cpp),
/// renderer.cpp the rest. A
/// context is current in every function.
#pragma once

#include <array>

#include "runtime_glsl/host/gl_objects.h"
#include "runtime_glsl/host/renderer.h"

namespace fetex {

inline const RuntimeError kNotCurrent = {RuntimeErrc::OutOfMemoryOrLost, "the context can't be made current"};

/// A sampler's program, and the texture that its grid is laid over.
struct Layer {
    const Program* program = nullptr;
    std::uint32_t width = 0, height = 0;
    double shift = 0;
};

/// A bi-level texture as it was uploaded.
struct BilevelLayer {
    std::array<Program, 3> programs; ///< by BilevelProgram; compiled when they are first wanted
    GLuint texels = 0, mips = 0, image = 0;
    BilevelTexture traits; ///< dimensions and what shaders depend on; of mips and image one element, if there are any
    BilevelFetch fetch = BilevelFetch::Interpolated;
};
enum class BilevelProgram : std::uint8_t { Hard, Soft, Mips };

/// A silhouette-map texture as it was uploaded.
struct SilmapLayer {
    std::array<Program, 3> programs; ///< by SilmapProgram; compiled when they are first wanted
    GLuint cells = 0, colors = 0, mips = 0;
    SilmapTexture traits; ///< dimensions and what shaders depend on; of mips one element, if there are any
    SilmapFilter filter = SilmapFilter::Filtered;
};
enum class SilmapProgram : std::uint8_t { Point, Area, Mips };

/// A pinchmap as it was uploaded.
struct PinchmapLayer {
    std::array<Program, 3> programs; ///< by PinchmapProgram; compiled when they are first wanted
    GLuint map = 0, signal = 0, mips = 0;
    PinchmapTexture traits; ///< dimensions and what shaders depend on; of mips one element, if there are any
    PinchmapFetch fetch = PinchmapFetch::Interpolated;
};
enum class PinchmapProgram : std::uint8_t { Point, Area, Mips };

/// A texture with feature curves as it was uploaded.
struct FeatureCurvesLayer {
    std::array<Program, 3> programs;  ///< by FeatureCurvesProgram; compiled when they are first wanted
    std::array<GLuint, 6> textures{}; ///< by unit
    FeatureCurvesTraits traits;
    std::uint32_t width = 0, height = 0;
};
enum class FeatureCurvesProgram : std::uint8_t { Point, Area, Mips };

struct Renderer::State {
    std::unique_ptr<GlContext> context;
    RendererOptions options;
    GLint max_texture_side = 0, max_buffer_texels = 0;
    GLuint vertex_array = 0;
    Target target;
    std::array<Program, 3> fbt_programs, mip_programs; ///< by Filter
    Program bitmap_program, filtered_program, field_program;
    GLuint texel_texture = 0, corner_texture = 0, record_texture = 0, record_buffer = 0, mip_texture = 0;
    GLuint bitmap_texture = 0, field_texture = 0;
    FbtTexture fbt_traits; ///< what shaders depend on of the texture uploaded last; mips: one word, if it has any
    std::uint32_t fbt_width = 0, fbt_height = 0, bitmap_width = 0, bitmap_height = 0, field_width = 0, field_height = 0;

    BilevelLayer bilevel;
    SilmapLayer silmap;
    PinchmapLayer pinchmap;
    FeatureCurvesLayer feature_curves;

    [[nodiscard]] const GladGLContext& gl() const { return context->gl; }
    RuntimeStatus set_up();
    RuntimeStatus check_limits(const FbtTexture& texture) const;
    void delete_fbt();
    Outcome<Program> build_fbt(const FbtTexture& traits, Filter filter, bool mips) const;
    RuntimeStatus need_fbt_program(Filter filter, bool mips);
    [[nodiscard]] const Program& fbt_program(Filter filter, bool mips) const {
        return (mips ? mip_programs : fbt_programs)[static_cast<std::size_t>(filter)];
    }
    void upload_records(const FbtTexture& texture);
    void upload_record_buffer(const FbtTexture& texture);
    RuntimeStatus upload_fbt(const FbtTexture& texture);
    RuntimeStatus check_bilevel(const BilevelTexture& texture) const;
    void delete_bilevel();
    Outcome<Program> build_bilevel(const BilevelTexture& traits, BilevelFetch fetch, BilevelProgram kind) const;
    RuntimeStatus need_bilevel_program(BilevelProgram kind);
    [[nodiscard]] const Program& bilevel_program(BilevelProgram kind) const {
        return bilevel.programs[static_cast<std::size_t>(kind)];
    }
    RuntimeStatus upload_bilevel(const BilevelTexture& texture, BilevelFetch fetch);
    void bind_bilevel() const;
    Outcome<double> linear_filter_error();
    RuntimeStatus check_silmap(const SilmapTexture& texture) const;
    void delete_silmap();
    Outcome<Program> build_silmap(const SilmapTexture& traits, SilmapFilter filter, SilmapProgram kind) const;
    RuntimeStatus need_silmap_program(SilmapProgram kind);
    [[nodiscard]] const Program& silmap_program(SilmapProgram kind) const {
        return silmap.programs[static_cast<std::size_t>(kind)];
    }
    void upload_silmap_cells(const SilmapTexture& texture);
    RuntimeStatus upload_silmap(const SilmapTexture& texture, SilmapFilter filter);
    void bind_silmap() const;
    Outcome<Layer> bind_silmap(Sampler sampler);
    RuntimeStatus check_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch) const;
    void delete_pinchmap();
    Outcome<Program> build_pinchmap(const PinchmapTexture& traits, PinchmapFetch fetch, PinchmapProgram kind) const;
    RuntimeStatus need_pinchmap_program(PinchmapProgram kind);
    [[nodiscard]] const Program& pinchmap_program(PinchmapProgram kind) const {
        return pinchmap.programs[static_cast<std::size_t>(kind)];
    }
    void upload_pinchmap_map(const PinchmapTexture& texture, PinchmapFetch fetch);
    RuntimeStatus upload_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch);
    void bind_pinchmap() const;
    Outcome<Layer> bind_pinchmap(Sampler sampler);
    RuntimeStatus check_feature_curves(const FeatureCurvesTexture& texture) const;
    void delete_feature_curves();
    Outcome<Program> build_feature_curves(const FeatureCurvesTraits& traits, FeatureCurvesProgram kind) const;
    RuntimeStatus need_feature_curves_program(FeatureCurvesProgram kind);
    [[nodiscard]] const Program& feature_curves_program(FeatureCurvesProgram kind) const {
        return feature_curves.programs[static_cast<std::size_t>(kind)];
    }
    void upload_feature_numbers(const FeatureCurvesTexture& texture);
    RuntimeStatus upload_feature_curves(const FeatureCurvesTexture& texture);
    void bind_feature_curves() const;
    Outcome<Layer> bind_feature_curves(Sampler sampler);
    RuntimeStatus need_bitmap_programs();
    RuntimeStatus upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width, std::uint32_t height);
    RuntimeStatus check_bitmap(std::size_t values, std::uint32_t channels, std::uint32_t width,
                               std::uint32_t height) const;
    RuntimeStatus upload_field(const Field& field);
    Outcome<Layer> bind(Sampler sampler);
    void bind_fbt() const;
    void bind_field() const;
    void bind_bitmap(GLint filter) const;
    void draw_tile(const Program& program, const View& view, const RenderSize& size, std::uint32_t width,
                   std::uint32_t height, double shift, std::uint32_t first_x, std::uint32_t first_y) const;
    Outcome<Image> render(const Program& program, const View& view, const RenderSize& size, std::uint32_t width,
                          std::uint32_t height, double shift);
};

} // namespace fetex
