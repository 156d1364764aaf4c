// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "formats/fbt_mip.h"
#include "runtime_glsl/host/gl_objects.h"

namespace fetex {
namespace {

constexpr std::uint32_t kRecordColumns = 2048; ///< as fetex_fbt.glsl reads them
constexpr double kBitmapShift = 0.5;           ///< texels; a bitmap's sample stands in the middle of its texel

// Texture units, as the shaders' bindings have them.
constexpr GLuint kTexelUnit = 0, kRecordUnit = 1, kCornerUnit = 2, kMipUnit = 3, kBitmapUnit = 0, kFieldUnit = 0;
constexpr std::initializer_list<const char*> kFbtSamplers = {"fetexFbtTexels", "fetexFbtRecords", "fetexFbtCorners",
                                                             "fetexFbtMips"};

/// A sampler's program, and the texture that its grid is laid over.
struct Layer {
    const Program& program;
    std::uint32_t width = 0, height = 0;
    double shift = 0;
};

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
    void upload_mips(const FbtTexture& texture);
    RuntimeStatus upload_fbt(const FbtTexture& texture);
    RuntimeStatus upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width, std::uint32_t height);
    RuntimeStatus check_bitmap(std::size_t values, std::uint32_t channels, std::uint32_t width,
                               std::uint32_t height) const;
    RuntimeStatus upload_field(const Field& field);
    Layer bind(Sampler sampler) const;
    void bind_fbt() const;
    void bind_field() const;
    void bind_bitmap(GLint filter) const;
    void draw_tile(const Program& program, const View& view, const RenderSize& size, std::uint32_t width,
                   std::uint32_t height, double shift, std::uint32_t first_x, std::uint32_t first_y) const;
    Outcome<Image> render(const Program& program, const View& view, const RenderSize& size, std::uint32_t width,
                          std::uint32_t height, double shift);
};

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

/// Level 1 of the chain is GL's level 0.
void Renderer::State::upload_mips(const FbtTexture& texture) {
    const std::uint32_t levels = fbt_mip_levels(texture.width, texture.height);
    for (std::uint32_t k = 1; k <= levels; ++k) {
        const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
        const std::uint32_t* samples = texture.mips.data() + level.first;
        if (k == 1)
            mip_texture =
                make_texture(gl(), kMipUnit, GL_RGBA8, level.width, level.height, GL_RGBA, GL_UNSIGNED_BYTE, samples);
        else
            gl().TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(k - 1), GL_RGBA8, static_cast<GLsizei>(level.width),
                            static_cast<GLsizei>(level.height), 0, GL_RGBA, GL_UNSIGNED_BYTE, samples);
    }
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels - 1));
    gl().TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST); // else level 0 is all there is
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
    if (!texture.mips.empty()) upload_mips(texture);
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

RuntimeStatus Renderer::State::check_bitmap(std::size_t values, std::uint32_t channels, std::uint32_t width,
                                            std::uint32_t height) const {
    const auto side = static_cast<std::uint32_t>(max_texture_side);
    if (width == 0 || height == 0 || values != std::size_t{width} * height * channels)
        return RuntimeError{RuntimeErrc::NothingUploaded, "the bitmap is empty or not of the stated size"};
    if (width > side || height > side)
        return RuntimeError{RuntimeErrc::TextureTooLarge, "the bitmap is beyond " + std::to_string(side) + " a side"};
    return std::nullopt;
}

RuntimeStatus Renderer::State::upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width,
                                             std::uint32_t height) {
    if (auto bad = check_bitmap(rgba8.size(), 4, width, height)) return bad;
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

/// What time_draws draws; a program of 0 if nothing was uploaded.
Layer Renderer::State::bind(Sampler sampler) const {
    switch (sampler) {
    case Sampler::Bilinear:
        bind_bitmap(GL_LINEAR);
        return {filtered_program, bitmap_width, bitmap_height, kBitmapShift};
    case Sampler::Field:
        bind_field();
        return {field_program, field_width, field_height, kBitmapShift};
    case Sampler::Fbt:
    case Sampler::FbtArea:
    case Sampler::FbtMips:
        break;
    }
    bind_fbt();
    if (sampler == Sampler::FbtMips) return {fbt_program(Filter::Point, true), fbt_width, fbt_height, 0};
    return {fbt_program(sampler == Sampler::FbtArea ? Filter::Area : Filter::Point, false), fbt_width, fbt_height, 0};
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

namespace {

const RuntimeError kNotCurrent = {RuntimeErrc::OutOfMemoryOrLost, "the context can't be made current"};

} // namespace

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
    if (sampler == Sampler::FbtArea || sampler == Sampler::FbtMips) {
        const bool mips = sampler == Sampler::FbtMips;
        if (auto bad = state.need_fbt_program(mips ? Filter::Point : Filter::Area, mips)) return *bad;
    }
    const Layer layer = state.bind(sampler);
    if (layer.program.id == 0 || side > kTileSide)
        return RuntimeError{RuntimeErrc::NothingUploaded, "nothing was uploaded, or the side is beyond one tile"};
    auto target = make_target(state.gl(), GL_RGBA8, side);
    if (!target) return target.error();
    state.gl().Viewport(0, 0, static_cast<GLsizei>(side), static_cast<GLsizei>(side));
    const auto draw = [&] {
        for (std::uint32_t k = 0; k < draws; ++k)
            state.draw_tile(layer.program, view, size, layer.width, layer.height, layer.shift, 0, 0);
    };
    const double seconds = is_software() ? cpu_seconds(state.gl(), draw) : gpu_seconds(state.gl(), draw);
    delete_target(state.gl(), target.value());
    if (auto bad = gl_error(state.gl(), "timing")) return *bad;
    return seconds;
}

} // namespace fetex
