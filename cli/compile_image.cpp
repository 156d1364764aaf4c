// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compile_image.h"

#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "cli/image_file.h"
#include "cli/io.h"
#include "cli/options.h"
#include "cli/png_module.h"
#include "compiler/diagnostics.h"
#include "compiler/svg/svg.h"
#include "formats/fbt_samples.h"

namespace fetexc::cli {
namespace {

struct Received {
    RasterImage image;
    ImageNotes notes;
    std::string failure;
};

void receive(void* context, const void* bytes, std::uint32_t width, std::uint32_t height, const ImageNotes& notes) {
    auto& to = *static_cast<Received*>(context);
    if (height == 0) {
        to.failure.assign(static_cast<const char*>(bytes), width);
        return;
    }
    to.image.width = width, to.image.height = height, to.notes = notes;
    to.image.rgba.resize(std::size_t{4} * width * height);
    std::memcpy(to.image.rgba.data(), bytes, to.image.rgba.size() * sizeof(float));
}

Error failed(ImageOutcome outcome, const std::string& why) {
    switch (outcome) {
    case ImageOutcome::TooLarge:
        return {ErrorClass::InvalidInput, diag::kImageTooLarge, why, ""};
    case ImageOutcome::Unsupported:
        return {ErrorClass::Unsupported, diag::kImageUnsupported, why, ""};
    default:
        return {ErrorClass::InvalidInput, diag::kImageUnreadable, "can't read the image: " + why, ""};
    }
}

/// The drawing must have the image's aspect, to half a pixel.
void check_aspect(const FeatureCurves& features, const RasterImage& image, std::vector<Diagnostic>& diagnostics) {
    const double width = features.width * image.height / features.height;
    const double height = features.height * image.width / features.width;
    if (std::fabs(width - image.width) <= 0.5 || std::fabs(height - image.height) <= 0.5) return;
    diagnostics.push_back({Severity::Warning, diag::kFeaturesAspect,
                           fmt::format("the features' drawing is {:g} x {:g}, the image {} x {} pixels: stretched",
                                       features.width, features.height, image.width, image.height),
                           ""});
}

Result<FeatureCurves> drawn_features(const ImageOptions& options, const SceneOptions& scene, unsigned threads,
                                     std::string& hash, std::vector<Diagnostic>& diagnostics) {
    const auto bytes = read_input(options.features, SvgLimits{}.bytes);
    if (!bytes) return bytes.error();
    hash = hash_of(bytes.value());
    return load_svg_features(bytes.value(), svg_options(scene, kMaxImageSide, threads), diagnostics);
}

/// One frame: the image's.
void append(FeatureCurves& to, const FeatureCurves& from) {
    const double sx = to.width / from.width, sy = to.height / from.height;
    for (CanvasContour run : from.runs) {
        for (CanvasSegment& s : run) {
            for (CanvasPoint& p : s.p)
                p = {p.x * sx, p.y * sy};
        }
        to.runs.push_back(std::move(run));
    }
}

} // namespace

Result<RasterImage> read_image(const std::string& path, ImageValues values, std::vector<Diagnostic>& diagnostics) {
    const auto decode = module_symbol(kDecodeImage);
    if (!decode) return decode.error();
    Received received;
    const double most = values.bright ? fetex::kFbtMaxHalf : 1;
    const ImageOutcome outcome = reinterpret_cast<DecodeImage>(decode.value())(
        path.c_str(), kMaxImageSide, kMaxImagePixels, most, values.data, receive, &received);
    if (outcome != ImageOutcome::Read) return failed(outcome, received.failure);
    if (received.notes.clipped > 0)
        diagnostics.push_back({Severity::Warning, diag::kImageClipped,
                               fmt::format("{} pixels beyond 0 to {} clipped", received.notes.clipped, most), ""});
    if (received.notes.more_images)
        diagnostics.push_back({Severity::Warning, diag::kMoreImages,
                               "the file holds more than one image (pages, parts, layers): the first was taken", ""});
    return std::move(received.image);
}

Result<LoadedImage> load_image(const ImageOptions& options, const SceneOptions& scene, unsigned threads,
                               std::vector<Diagnostic>& diagnostics) {
    LoadedImage out;
    {
        const auto bytes = read_input(options.image, kMaxImageBytes);
        if (!bytes) return bytes.error();
        out.source_hash = hash_of(bytes.value());
    }
    auto image = read_image(options.image, options.values, diagnostics);
    if (!image) return image.error();
    RasterImage& pixels = out.picture.image = std::move(image).value();
    FeatureCurves& features = out.features;
    features = {static_cast<double>(pixels.width), static_cast<double>(pixels.height), {}};
    if (!options.features.empty()) {
        const auto drawn = drawn_features(options, scene, threads, out.features_hash, diagnostics);
        if (!drawn) {
            Error error = drawn.error();
            if (error.place.empty())
                error.place = options.features;
            else if (error.place != options.features)
                error.place = options.features + ": " + error.place;
            return error;
        }
        check_aspect(drawn.value(), pixels, diagnostics);
        append(features, drawn.value());
    }
    if (options.trace) {
        const auto traced = trace_features(pixels, options.tracing);
        if (!traced) return traced.error();
        append(features, traced.value());
    }
    auto feature_map = feature_scene(features, pixels.width, pixels.height);
    if (!feature_map) return feature_map.error();
    out.picture.features = std::move(feature_map).value();
    out.picture.invalidate = options.invalidate;
    return out;
}

CLI::Option* add_image_options(CLI::App& app, ImageOptions& options) {
    CLI::Option* image =
        app.add_option(
               "--image", options.image,
               "Instead of SVG files: an image (whatever OpenImageIO reads), with features; default size: its own")
            ->type_name("FILE");
    app.add_flag("--data", options.values.data,
                 "The image's numbers are no colours but data, such as normals: none is sRGB-encoded")
        ->needs(image);
    app.add_option("--features", options.features,
                   "The image's features: an SVG over it. Edges of what is filled, and middles of strokes without fill")
        ->needs(image)
        ->type_name("FILE");
    CLI::Option* trace = app.add_flag("--trace", options.trace, "Find features in the image itself")->needs(image);
    app.add_option("--trace-contrast", options.tracing.contrast,
                   "Least difference of a channel across a traced feature, 0.01 to 1; default 0.1")
        ->check(number_range(0.01, 1))
        ->needs(trace)
        ->type_name("N");
    app.add_option("--trace-speck", options.tracing.speck, "Smallest area to be traced around, in pixels; default 4")
        ->check(CLI::Range(0u, 1u << 20))
        ->needs(trace)
        ->type_name("N");
    app.add_option("--invalidate", options.invalidate,
                   "Pixels of the image this near to a feature are no samples, 0 to 64; default 1")
        ->check(number_range(0, 64))
        ->needs(image)
        ->type_name("PIXELS");
    return image;
}

} // namespace fetexc::cli
