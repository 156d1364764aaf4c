// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc render`: a .fetex file drawn into a PNG.
#include <memory>

#include <fmt/format.h>

#include "cli/canvas.h"
#include "cli/fetex_input.h"
#include "cli/image_file.h"
#include "cli/io.h"
#include "cli/lighting.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/overlay.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kDefaultPixels = 1024, kDefaultSupersample = 4;

struct RenderOptions {
    std::string input, output, beside;
    std::string backend = "cpu";
    std::string representation; ///< empty: what the file holds
    ViewValue view;
    SizeValue size{0, 0, kDefaultPixels};
    std::uint32_t supersample = 0; ///< 0: by filter
    std::string filter = "auto";
    bool nearest = false, overlay = false;
    std::optional<LightDirection> light; ///< none: colours as they are
    std::string normal_y;                ///< empty: as the representation has it
    bool quiet = false;
};

std::uint64_t gpu_bytes(const fetex::FbtTexture& texture) { return fetex::fbt_gpu_bytes(texture); }
std::uint64_t gpu_bytes(const fetex::BilevelTexture& texture) { return fetex::bilevel_gpu_bytes(texture); }
std::uint64_t gpu_bytes(const fetex::SilmapTexture& texture) { return fetex::silmap_gpu_bytes(texture); }
std::uint64_t gpu_bytes(const fetex::PinchmapTexture& texture) { return fetex::pinchmap_gpu_bytes(texture); }
std::uint64_t gpu_bytes(const fetex::FeatureCurvesTexture& texture) { return fetex::feature_gpu_bytes(texture); }

const char* texels_name(const fetex::FbtTexture&) { return "of features"; }
const char* texels_name(const fetex::BilevelTexture&) { return "cut at one half"; }
const char* texels_name(const fetex::SilmapTexture&) { return "and a silhouette map"; }
const char* texels_name(const fetex::PinchmapTexture&) { return "of a pinchmap and its signal"; }
const char* texels_name(const fetex::FeatureCurvesTexture&) { return "with feature curves"; }

/// Feature curves have the texture's frame; pictures of normals, as other textures hold them, have y up.
template <class Texture> bool normals_y_up(const Texture&) { return true; }
bool normals_y_up(const fetex::FeatureCurvesTexture&) { return false; }

/// A bi-level texture is cut softly unless told otherwise.
template <class Texture> fetex::Filter filter_of(const std::string& name, const Texture&) {
    return name == "area" ? fetex::Filter::Area : name == "exact" ? fetex::Filter::ExactArea : fetex::Filter::Point;
}
fetex::Filter filter_of(const std::string& name, const fetex::BilevelTexture&) {
    return name == "point" ? fetex::Filter::Point : fetex::Filter::Area;
}

template <class Texture> fetex::RenderSize pixels_for(const RenderOptions& options, const Texture& texture) {
    const double aspect = options.view.w * texture.width / (options.view.h * texture.height);
    const PixelSize size = resolve_size(options.size, aspect);
    const bool means = options.filter == "area" || options.filter == "exact";
    const std::uint32_t supersample = options.supersample != 0 ? options.supersample : means ? 1 : kDefaultSupersample;
    const auto minification = options.filter == "point" ? fetex::Minification::Supersample : fetex::Minification::Mips;
    return {size.width, size.height, supersample, filter_of(options.filter, texture), minification};
}

/// What the ordinary texture that the same bytes buy shows.
template <class Texture>
Result<fetex::Image> draw_bilinear(const RenderOptions& options, Canvas& canvas, const Texture& texture,
                                   const fetex::View& view, const fetex::RenderSize& size) {
    const std::uint64_t bytes = gpu_bytes(texture);
    const auto bitmap = bitmap_of_equal_bytes(texture, bytes);
    if (!bitmap) return bitmap.error();
    auto image = canvas.draw(bitmap.value(), view, size);
    if (image && !options.quiet) {
        print_message(
            fmt::format("note: left, {} x {} texels {} in {} bytes; right, an ordinary {} x {} texture in {} bytes",
                        texture.width, texture.height, texels_name(texture), bytes, bitmap.value().width,
                        bitmap.value().height, bitmap.value().rgba.size()));
    }
    return image;
}

template <class Texture>
Result<fetex::Image> draw_on(Canvas& canvas, const RenderOptions&, const Texture& texture, const fetex::View& view,
                             const fetex::RenderSize& size) {
    return canvas.draw(texture, view, size);
}
Result<fetex::Image> draw_on(Canvas& canvas, const RenderOptions& options, const fetex::SilmapTexture& texture,
                             const fetex::View& view, const fetex::RenderSize& size) {
    return canvas.draw(texture, view, size,
                       options.nearest ? fetex::SilmapFilter::Nearest : fetex::SilmapFilter::Filtered);
}

template <class Texture>
constexpr bool kHasOverlay = requires(const Texture& t, const fetex::View& v, fetex::Image& i) {
    draw_overlay(t, v, i);
};

template <class Texture> Result<fetex::Image> draw(const RenderOptions& options, const Texture& texture) {
    auto canvas = Canvas::open(options.backend);
    if (!canvas) return canvas.error();
    const fetex::View view{options.view.x, options.view.y, options.view.w, options.view.h};
    const fetex::RenderSize size = pixels_for(options, texture);
    auto image = draw_on(canvas.value(), options, texture, view, size);
    if (!image) return image;
    const auto light = [&](fetex::Image& picture) {
        if (!options.light) return;
        const bool up = options.normal_y.empty() ? normals_y_up(texture) : options.normal_y == "up";
        light_normals(picture, *options.light, up);
    };
    light(image.value());
    if constexpr (kHasOverlay<Texture>)
        if (options.overlay) draw_overlay(texture, view, image.value());
    if (options.beside.empty()) return image;
    auto beside = draw_bilinear(options, canvas.value(), texture, view, size);
    if (!beside) return beside;
    light(beside.value());
    return side_by_side(image.value(), beside.value(), std::max(2u, size.width / 128));
}

int run_render(const RenderOptions& options) {
    if (same_file(options.input, options.output))
        return report_error(
            {ErrorClass::Usage, diag::kWouldOverwriteInput, "the output would overwrite the input", options.output});
    auto input = load_fetex(options.input);
    if (!input) return report_error(input.error());
    fetex::FetexFile& file = input.value().file;
    if (const Status s = choose_representation(file, options.representation, options.input); !s)
        return report_error(s.error());
    if (options.nearest && !file.silmap)
        return report_error(
            {ErrorClass::Usage, diag::kBadUsage, "--nearest is for silhouette-map textures", options.input});
    if (!options.normal_y.empty() && !options.light)
        return report_error({ErrorClass::Usage, diag::kBadUsage, "--normal-y goes with --light", ""});
    if (options.light && file.feature_curves && file.feature_curves->kind == fetex::FeatureKind::Height)
        return report_error(
            {ErrorClass::Usage, diag::kBadUsage, "--light is for normals; this shows heights", options.input});
    if (options.overlay && !file.silmap && !file.pinchmap && !file.feature_curves)
        return report_error({ErrorClass::Usage, diag::kBadUsage,
                             "--overlay is for silhouette-map textures, pinchmaps and feature curves", options.input});
    const auto image = with_texture(file, [&](const auto& texture) { return draw(options, texture); });
    if (!image) return report_error(image.error(), options.input);
    const auto png = encode_png(image.value());
    if (!png) return report_error(png.error(), options.output);
    if (const Status status = write_output(options.output, png.value()); !status) return report_error(status.error());
    return kExitOk;
}

} // namespace

Command add_render_command(CLI::App& parent) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* app = parent.add_subcommand("render", "Draw a .fetex texture, or a part of it, into a PNG");
    app->add_option("input", options->input, "A .fetex file, or - for stdin")->required()->type_name("FILE");
    app->add_option("-o,--output", options->output, "The PNG to write, or - for stdout")->required()->type_name("FILE");
    app->add_option("--repr", options->representation,
                    "Representation to draw: fbt, bilevel, silmap, pinchmap or curves; default: the first of these "
                    "that the file "
                    "holds")
        ->check(CLI::IsMember(representation_names()))
        ->type_name("NAME");
    add_view_option(*app, options->view);
    add_size_option(*app, options->size, "Pixels: both sides, or the longer one (default 1024)");
    app->add_option("--backend", options->backend,
                    "What draws: cpu (default), osmesa, egl (surfaceless, else device) or glfw (needs a display)")
        ->check(CLI::IsMember(canvas_names()))
        ->type_name("NAME");
    app->add_option("--supersample", options->supersample,
                    "N x N samples a pixel, 1 to 16 (default 4; 1 with a filter that isn't point)")
        ->check(CLI::Range(1u, fetex::kMaxSupersample))
        ->type_name("N");
    app->add_option("--filter", options->filter,
                    "auto (default): colours at points (bilevel: soft edges), and the mip chain, if there is one, for "
                    "more than a texel a pixel; point: no chain (bilevel: hard edges); area, exact: means over pixels, "
                    "from one texel or from all (bilevel: soft edges, both), and the chain")
        ->check(CLI::IsMember({"auto", "point", "area", "exact"}))
        ->type_name("NAME");
    app->add_flag("--nearest", options->nearest,
                  "A silhouette-map texture without interpolation between its colours: each quadrant has one");
    app->add_flag("--overlay", options->overlay,
                  "Draw what a silhouette-map texture is made of over it: boundaries and points, and magnified enough "
                  "the cells and the texels' colours; of a pinchmap the discontinuities, the active texels and which "
                  "way they pinch; the feature curves, their points on the texels' edges, and the texels");
    add_light_option(*app, options->light);
    app->add_option("--normal-y", options->normal_y,
                    "Of --light: green is up or down; default down for curves, whose frame it is, else up")
        ->check(CLI::IsMember({"up", "down"}))
        ->type_name("WAY");
    app->add_option("--beside", options->beside,
                    "bilinear: draw to the right what an ordinary texture of the same bytes shows")
        ->check(CLI::IsMember({"bilinear"}))
        ->type_name("WHAT");
    add_quiet_option(*app, options->quiet);
    return {app, [options] { return run_render(*options); }};
}

} // namespace fetexc::cli
