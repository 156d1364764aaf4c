// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Draws an FBT, a bi-level texture, a silhouette-map texture, a pinchmap, a texture with feature curves, or a plain
/// bitmap to compare them with, off screen. No GL library is linked: a back end is opened with dlopen when it is asked
/// for. Every pixel centre is computed in 32.32 fixed point (sample_grid.h), on the GPU and on the CPU alike: a view
/// may be as deep as wanted.
#pragma once

#include <memory>
#include <span>

#include "formats/bilevel.h"
#include "formats/fbt.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"
#include "runtime_glsl/host/image.h"
#include "runtime_glsl/host/shader_source.h"

namespace fetex {

enum class Backend : std::uint8_t { OSMesa, EglSurfaceless, EglDevice, Glfw };
inline constexpr Backend kBackends[] = {Backend::OSMesa, Backend::EglSurfaceless, Backend::EglDevice, Backend::Glfw};

/// "osmesa", "egl-surfaceless", "egl-device", "glfw".
const char* backend_name(Backend backend);

/// Whether a back end can draw here: opens and closes a context.
struct BackendStatus {
    bool available = false;
    std::string detail; ///< GL version and renderer, or why not
};
BackendStatus probe_backend(Backend backend);

struct RendererOptions {
    Backend backend = Backend::OSMesa;
    Dialect dialect = Dialect::Glsl330; ///< of the shaders; EGL gives an ES context for Essl300
    bool texture_buffer = false;        ///< records in a texture buffer; not with Essl300
};

/// What a draw looks up.
enum class Sampler : std::uint8_t {
    Fbt,
    FbtArea,  ///< area sampling of the FBT
    FbtMips,  ///< the FBT's mip chain, whatever the view
    Bilinear, ///< the bitmap through the hardware's LINEAR filter: the plain lookup that costs are compared with
    Field,
    Bilevel,           ///< the bi-level texture, cut hard
    BilevelArea,       ///< cut softly
    BilevelMips,       ///< its levels, whatever the view
    Silmap,            ///< the silhouette-map texture at points
    SilmapArea,        ///< over pixels
    SilmapMips,        ///< its levels, whatever the view
    Pinchmap,          ///< the pinchmap at points
    PinchmapArea,      ///< over pixels
    PinchmapMips,      ///< its levels, whatever the view
    FeatureCurves,     ///< the texture with feature curves at points
    FeatureCurvesArea, ///< over pixels
    FeatureCurvesMips, ///< its levels, whatever the view
};

/// How a bi-level texture is interpolated.
enum class BilevelFetch : std::uint8_t {
    Interpolated, ///< in the shader, in full precision
    Filtered,     ///< one fetch through the hardware's LINEAR filter; right where linear_filter_error() is small enough
};
/// How a pinchmap and its signal are interpolated.
enum class PinchmapFetch : std::uint8_t {
    Interpolated, ///< in the shader, in full precision
    Filtered,     ///< one fetch of each through the hardware's LINEAR filter; a map of 16 bits not in ES
};
/// Of linear_filter_error(): edges stay within 2^-12 of the way between the least and the greatest byte.
inline constexpr double kGoodFilterError = 0x1p-12;

/// One channel, interpolated and cut at one half between two colours: a threshold texture or a distance field.
struct Field {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> values; ///< row-major, top row first; texel centres at (i+1/2, j+1/2); 255 is 1
    /// Texels of distance between the values 0 and 1: edges are one sample soft. 0: not a distance, edges are hard.
    double range = 0;
    float below[4] = {}, above[4] = {1, 1, 1, 1}; ///< premultiplied
};

/// One context and what is uploaded to it. Not for several threads at once. The context is current only inside a call,
/// so renderers of different back ends can live side by side (GLX dies if another API's context is still current).
class Renderer {
  public:
    static Outcome<Renderer> open(const RendererOptions& options);
    static Outcome<Renderer> open(Backend backend) { return open(RendererOptions{.backend = backend}); }
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// GL version and renderer, for reports.
    [[nodiscard]] const std::string& description() const;

    /// Uploads the texture and builds the shader that it needs. Precondition: the texture passes validate_fbt.
    RuntimeStatus upload(const FbtTexture& texture);
    Outcome<Image> render(const View& view, const RenderSize& size);

    /// Uploads the texture and builds the shader that it needs. Precondition: the texture passes validate_bilevel.
    RuntimeStatus upload_bilevel(const BilevelTexture& texture, BilevelFetch fetch = BilevelFetch::Interpolated);
    /// Filter::Point is the hard cut, Area and ExactArea the soft one, which is one and the same.
    Outcome<Image> render_bilevel(const View& view, const RenderSize& size);
    /// The largest error of the hardware's LINEAR filter at 2^12 places between a black and a white texel of R8.
    Outcome<double> linear_filter_error();

    /// Uploads the texture and builds the shader that it needs. Precondition: the texture passes validate_silmap.
    RuntimeStatus upload_silmap(const SilmapTexture& texture, SilmapFilter filter = SilmapFilter::Filtered);
    /// Filter::Point samples points, Area and ExactArea, which is one and the same, pixels.
    Outcome<Image> render_silmap(const View& view, const RenderSize& size);

    /// Uploads the texture and builds the shader that it needs. Precondition: the texture passes validate_pinchmap.
    RuntimeStatus upload_pinchmap(const PinchmapTexture& texture, PinchmapFetch fetch = PinchmapFetch::Interpolated);
    /// Filter::Point samples points, Area and ExactArea, which is one and the same, pixels.
    Outcome<Image> render_pinchmap(const View& view, const RenderSize& size);

    /// Uploads the texture and builds the shader that it needs. Precondition: the texture passes
    /// validate_feature_curves.
    RuntimeStatus upload_feature_curves(const FeatureCurvesTexture& texture);
    /// Filter::Point samples points, Area and ExactArea, which is one and the same, pixels.
    Outcome<Image> render_feature_curves(const View& view, const RenderSize& size);

    /// A bitmap, premultiplied RGBA8, row-major, top row first; texel centres at (i+1/2, j+1/2), as GL has them.
    RuntimeStatus upload_bitmap(std::span<const std::uint8_t> rgba8, std::uint32_t width, std::uint32_t height);
    [[nodiscard]] bool has_bitmap() const;
    /// Bilinear interpolation in full precision, edges repeated.
    Outcome<Image> render_bitmap(const View& view, const RenderSize& size);

    RuntimeStatus upload_field(const Field& field);
    /// Interpolated in the shader in full precision, edges repeated.
    Outcome<Image> render_field(const View& view, const RenderSize& size);

    /// Whether the processor draws (llvmpipe, SwiftShader …).
    [[nodiscard]] bool is_software() const;
    /// Draws the same frame `draws` times without reading it back; seconds for all of them. Software: CPU time of the
    /// process, all threads. Else the GPU's (GL_TIME_ELAPSED), which ES contexts don't tell: E7004. `side` is at most
    /// kTileSide.
    Outcome<double> time_draws(Sampler sampler, const View& view, std::uint32_t side, std::uint32_t draws);

  private:
    struct State;
    explicit Renderer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

/// The reference: the same pixel centres through fbt_sample_local, fbt_sample_area_local or fbt_sample_mip_aniso, in
/// double. threads 0: all. Never depends on it.
Outcome<Image> render_cpu(const FbtTexture& texture, const View& view, const RenderSize& size, unsigned threads = 0);
/// The same through bilevel_sample_local, bilevel_sample_area_local or bilevel_sample_mip.
Outcome<Image> render_cpu(const BilevelTexture& texture, const View& view, const RenderSize& size,
                          unsigned threads = 0);
/// The same through silmap_sample_local, silmap_sample_area_local or silmap_sample_mip.
Outcome<Image> render_cpu(const SilmapTexture& texture, const View& view, const RenderSize& size,
                          SilmapFilter filter = SilmapFilter::Filtered, unsigned threads = 0);
/// The same through pinchmap_sample_local, pinchmap_sample_area_local or pinchmap_sample_mip.
Outcome<Image> render_cpu(const PinchmapTexture& texture, const View& view, const RenderSize& size,
                          unsigned threads = 0);
/// The same through feature_sample_local, feature_sample_area_local or feature_sample_mip.
Outcome<Image> render_cpu(const FeatureCurvesTexture& texture, const View& view, const RenderSize& size,
                          unsigned threads = 0);
/// As Renderer::render_bitmap, on the CPU.
Outcome<Image> render_bitmap_cpu(std::span<const std::uint8_t> rgba8, std::uint32_t bitmap_width,
                                 std::uint32_t bitmap_height, const View& view, const RenderSize& size);

} // namespace fetex
