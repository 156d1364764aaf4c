// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/renderer.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "runtime_glsl/host/renderer_state.h"

namespace fetex {
namespace {

constexpr double kBitmapShift = 0.5; ///< texels; a bitmap's sample stands in the middle of its texel
constexpr GLuint kBitmapUnit = 0, kFieldUnit = 0;

double process_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// The GPU's time of what `draw` submits, in seconds.
template <class Draw> double gpu_seconds(const GladGLContext& gl, const Draw& draw) {
    GLuint query = 0;
    GLuint64 nanoseconds = 0;
    gl.GenQueries(1, &query);
    gl.BeginQuery(GL_TIME_ELAPSED, query);
    draw();
    gl.EndQuery(GL_TIME_ELAPSED);
    gl.GetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds); // waits
    gl.DeleteQueries(1, &query);
    return static_cast<double>(nanoseconds) * 1e-9;
}

template <class Draw> double cpu_seconds(const GladGLContext& gl, const Draw& draw) {
    const double start = process_cpu_seconds();
    draw();
    gl.Finish();
    return process_cpu_seconds() - start;
}

} // namespace

RuntimeStatus Renderer::State::set_up() {
    gl().GetIntegerv(GL_MAX_TEXTURE_SIZE, &max_texture_side);
    if (!context->es) gl().GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &max_buffer_texels);
    gl().GenVertexArrays(1, &vertex_array);
    gl().BindVertexArray(vertex_array);
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl().PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl().Disable(GL_DITHER);
    const auto made = make_target(gl(), GL_RGBA32F, kTileSide);
    if (!made) return made.error();
    target = made.value();
    return gl_error(gl(), "making the render target");
}

RuntimeStatus Renderer::State::check_bitmap(std::size_t values, std::uint32_t channels, std::uint32_t width,
                                            std::uint32_t height) const {
    const auto side = static_cast<std::uint32_t>(max_texture_side);
    if (width == 0 || height == 0 || values != std::size_t{width} * height * channels)
        return RuntimeError{RuntimeErrc::NothingUploaded, "the bitmap is empty or not of the stated size"};
    if (width > side || height > side)
        return RuntimeError{RuntimeErrc::TextureTooLarge, "the bitmap is beyond " + std::to_string(side) + " a side"};
    return std::nullopt;
}

RuntimeStatus Renderer::State::need_bitmap_programs() {
    for (const bool filtered : {false, true}) {
        Program& program = filtered ? filtered_program : bitmap_program;
        if (program.id != 0) continue;
        auto built = build_program(gl(), view_vertex_source(options.dialect),
                                   filtered ? filtered_bitmap_fragment_source(options.dialect)
                                            : bitmap_fragment_source(options.dialect),
                                   {"fetexBitmap"});
        if (!built) return built.error();
        program = built.value();
    }
    return std::nullopt;
}

RuntimeStatus Renderer::State::upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width,
                                             std::uint32_t height) {
    if (auto bad = check_bitmap(rgba8.size(), 4, width, height)) return bad;
    if (auto bad = need_bitmap_programs()) return bad;
    gl().DeleteTextures(1, &bitmap_texture);
    bitmap_texture = make_texture(gl(), kBitmapUnit, GL_RGBA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba8.data());
    bitmap_width = width;
    bitmap_height = height;
    return gl_error(gl(), "uploading a bitmap");
}

RuntimeStatus Renderer::State::upload_field(const Field& field) {
    if (auto bad = check_bitmap(field.values.size(), 1, field.width, field.height)) return bad;
    auto program = build_program(gl(), view_vertex_source(options.dialect),
                                 field_fragment_source(options.dialect, field), {"fetexField"});
    if (!program) return program.error();
    if (field_program.id != 0) gl().DeleteProgram(field_program.id);
    gl().DeleteTextures(1, &field_texture);
    field_program = program.value();
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    field_texture =
        make_texture(gl(), kFieldUnit, GL_R8, field.width, field.height, GL_RED, GL_UNSIGNED_BYTE, field.values.data());
    gl().PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    field_width = field.width;
    field_height = field.height;
    return gl_error(gl(), "uploading a field");
}

void Renderer::State::bind_bitmap(GLint filter) const {
    gl().ActiveTexture(GL_TEXTURE0 + kBitmapUnit);
    gl().BindTexture(GL_TEXTURE_2D, bitmap_texture);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
}

void Renderer::State::bind_field() const {
    gl().ActiveTexture(GL_TEXTURE0 + kFieldUnit);
    gl().BindTexture(GL_TEXTURE_2D, field_texture);
}

/// What time_draws draws, bound, its program compiled; a program of 0 if nothing was uploaded.
Outcome<Layer> Renderer::State::bind(Sampler sampler) {
    switch (sampler) {
    case Sampler::Bilinear:
        bind_bitmap(GL_LINEAR);
        return Layer{&filtered_program, bitmap_width, bitmap_height, kBitmapShift};
    case Sampler::Field:
        bind_field();
        return Layer{&field_program, field_width, field_height, kBitmapShift};
    case Sampler::Fbt:
    case Sampler::FbtArea:
    case Sampler::FbtMips: {
        const bool mips = sampler == Sampler::FbtMips;
        const Filter filter = sampler == Sampler::FbtArea ? Filter::Area : Filter::Point;
        if (auto bad = need_fbt_program(filter, mips)) return *bad;
        bind_fbt();
        return Layer{&fbt_program(filter, mips), fbt_width, fbt_height, 0};
    }
    case Sampler::Bilevel:
    case Sampler::BilevelArea:
    case Sampler::BilevelMips:
        break;
    case Sampler::Silmap:
    case Sampler::SilmapArea:
    case Sampler::SilmapMips:
        return bind_silmap(sampler);
    case Sampler::Pinchmap:
    case Sampler::PinchmapArea:
    case Sampler::PinchmapMips:
        return bind_pinchmap(sampler);
    case Sampler::FeatureCurves:
    case Sampler::FeatureCurvesArea:
    case Sampler::FeatureCurvesMips:
        return bind_feature_curves(sampler);
    }
    const BilevelProgram kind = sampler == Sampler::Bilevel       ? BilevelProgram::Hard
                                : sampler == Sampler::BilevelArea ? BilevelProgram::Soft
                                                                  : BilevelProgram::Mips;
    if (auto bad = need_bilevel_program(kind)) return *bad;
    bind_bilevel();
    return Layer{&bilevel_program(kind), bilevel.traits.width, bilevel.traits.height, 0};
}

void Renderer::State::draw_tile(const Program& program, const View& view, const RenderSize& size, std::uint32_t width,
                                std::uint32_t height, double shift, std::uint32_t first_x,
                                std::uint32_t first_y) const {
    set_grid(gl(), program, axis_grid(view.x, view.w, width, size.width, size.supersample, first_x, shift),
             axis_grid(view.y, view.h, height, size.height, size.supersample, first_y, shift), size.supersample);
    if (program.pixel_sides >= 0) {
        const PixelSides sides = pixel_sides(view, size, width, height);
        gl().Uniform2f(program.pixel_sides, static_cast<float>(sides.x), static_cast<float>(sides.y));
    }
    gl().DrawArrays(GL_TRIANGLES, 0, 3);
}

/// Row 0 of a target is the top row of its tile: no flip anywhere.
Outcome<Image> Renderer::State::render(const Program& program, const View& view, const RenderSize& size,
                                       std::uint32_t width, std::uint32_t height, double shift) {
    Image image{size.width, size.height, std::vector<float>(std::size_t{size.width} * size.height * 4)};
    std::vector<float> tile(std::size_t{kTileSide} * kTileSide * 4);
    gl().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    for (std::uint32_t y = 0; y < size.height; y += kTileSide) {
        for (std::uint32_t x = 0; x < size.width; x += kTileSide) {
            const std::uint32_t w = std::min(kTileSide, size.width - x), h = std::min(kTileSide, size.height - y);
            gl().Viewport(0, 0, static_cast<GLsizei>(w), static_cast<GLsizei>(h));
            draw_tile(program, view, size, width, height, shift, x, y);
            gl().ReadPixels(0, 0, static_cast<GLsizei>(w), static_cast<GLsizei>(h), GL_RGBA, GL_FLOAT, tile.data());
            for (std::uint32_t row = 0; row < h; ++row)
                std::copy_n(tile.begin() + static_cast<std::ptrdiff_t>(std::size_t{row} * w * 4), std::size_t{w} * 4,
                            image.rgba.begin() +
                                static_cast<std::ptrdiff_t>((std::size_t{y + row} * size.width + x) * 4));
        }
    }
    if (auto bad = gl_error(gl(), "drawing")) return *bad;
    return image;
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Outcome<Renderer> Renderer::open(const RendererOptions& options) {
    if (options.dialect == Dialect::Vulkan450 || (options.texture_buffer && options.dialect == Dialect::Essl300))
        return RuntimeError{RuntimeErrc::GlTooOld, "this dialect or texture buffers in it can't run in an OpenGL host"};
    auto context = open_context(options);
    if (!context) return context.error();
    auto state = std::make_unique<State>();
    state->context = std::move(context.value());
    state->options = options;
    const CurrentContext current(*state->context);
    if (!current.ok()) return kNotCurrent;
    if (auto bad = state->set_up()) return *bad;
    return Renderer(std::move(state));
}

const std::string& Renderer::description() const { return state_->context->description; }

RuntimeStatus Renderer::upload(const FbtTexture& texture) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_fbt(texture) : kNotCurrent;
}

RuntimeStatus Renderer::upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width, std::uint32_t height) {
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_bitmap(rgba8, width, height) : kNotCurrent;
}

Outcome<Image> Renderer::render(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    if (state_->fbt_program(Filter::Point, false).id == 0)
        return RuntimeError{RuntimeErrc::NothingUploaded, "no texture was uploaded"};
    const CurrentContext current(*state_->context);
    if (!current.ok()) return kNotCurrent;
    const bool mips = !state_->fbt_traits.mips.empty() && wants_mips(view, size, state_->fbt_width, state_->fbt_height);
    if (auto bad = state_->need_fbt_program(size.filter, mips)) return *bad;
    const Program& program = state_->fbt_program(size.filter, mips);
    state_->bind_fbt();
    if (mips)
        return state_->render(program, view, {size.width, size.height, 1}, state_->fbt_width, state_->fbt_height, 0);
    return state_->render(program, view, size, state_->fbt_width, state_->fbt_height, 0);
}

bool Renderer::has_bitmap() const { return state_->bitmap_texture != 0; }

Outcome<Image> Renderer::render_bitmap(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    if (state_->bitmap_texture == 0) return RuntimeError{RuntimeErrc::NothingUploaded, "no bitmap was uploaded"};
    const CurrentContext current(*state_->context);
    if (!current.ok()) return kNotCurrent;
    state_->bind_bitmap(GL_NEAREST);
    return state_->render(state_->bitmap_program, view, size, state_->bitmap_width, state_->bitmap_height,
                          kBitmapShift);
}

RuntimeStatus Renderer::upload_field(const Field& field) {
    if (!(field.range >= 0) || !std::isfinite(field.range))
        return RuntimeError{RuntimeErrc::NothingUploaded, "the field's range is negative or not finite"};
    const CurrentContext current(*state_->context);
    return current.ok() ? state_->upload_field(field) : kNotCurrent;
}

Outcome<Image> Renderer::render_field(const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    if (state_->field_program.id == 0) return RuntimeError{RuntimeErrc::NothingUploaded, "no field was uploaded"};
    const CurrentContext current(*state_->context);
    if (!current.ok()) return kNotCurrent;
    state_->bind_field();
    return state_->render(state_->field_program, view, size, state_->field_width, state_->field_height, kBitmapShift);
}

bool Renderer::is_software() const {
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer"})
        if (description().find(name) != std::string::npos) return true;
    return false;
}

Outcome<double> Renderer::time_draws(Sampler sampler, const View& view, std::uint32_t side, std::uint32_t draws) {
    State& state = *state_;
    const RenderSize size{side, side, 1};
    if (auto bad = check_view(view, size)) return *bad;
    if (!is_software() && (state.context->es || !state.gl().GetQueryObjectui64v))
        return RuntimeError{RuntimeErrc::GlTooOld, "this context has no timer queries"};
    const CurrentContext current(*state.context);
    if (!current.ok()) return kNotCurrent;
    const auto layer = state.bind(sampler);
    if (!layer) return layer.error();
    if (layer.value().program->id == 0 || side > kTileSide)
        return RuntimeError{RuntimeErrc::NothingUploaded, "nothing was uploaded, or the side is beyond one tile"};
    auto target = make_target(state.gl(), GL_RGBA8, side);
    if (!target) return target.error();
    state.gl().Viewport(0, 0, static_cast<GLsizei>(side), static_cast<GLsizei>(side));
    const auto draw = [&, drawn = layer.value()] {
        for (std::uint32_t k = 0; k < draws; ++k)
            state.draw_tile(*drawn.program, view, size, drawn.width, drawn.height, drawn.shift, 0, 0);
    };
    const double seconds = is_software() ? cpu_seconds(state.gl(), draw) : gpu_seconds(state.gl(), draw);
    delete_target(state.gl(), target.value());
    if (auto bad = gl_error(state.gl(), "timing")) return *bad;
    return seconds;
}

} // namespace fetex
