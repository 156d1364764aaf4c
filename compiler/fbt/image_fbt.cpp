// SPDX-License-Identifier: GPL-3.0-or-later
/// The texture of an image with features over it (FBT §4.1–4.4).
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "compiler/compile.h"
#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/fbt/fbt_builder.h"
#include "compiler/fbt/image_regions.h"
#include "compiler/fbt/image_samples.h"
#include "compiler/raster/feature_scene.h"
#include "compiler/raster/invalidation.h"
#include "compiler/release.h"

namespace fetexc {
namespace {

/// Measured (README.md), with some room.
constexpr std::uint64_t kBytesPerPixel = 24, kBytesPerRegion = 272;
constexpr std::uint64_t kGibibyte = std::uint64_t{1} << 30;

/// Rounded up to a tenth.
std::string gibibytes(std::uint64_t bytes) {
    const std::uint64_t tenths = (10 * bytes + kGibibyte - 1) / kGibibyte;
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GiB";
}

/// Texels a pixel, in area.
double texels_per_pixel(const FeaturedImage& picture, const Grid& grid) {
    return static_cast<double>(grid.width) / picture.image.width * grid.height / picture.image.height;
}

double fit_step(fetex::FbtSampleFormat format) {
    switch (format) {
    case fetex::FbtSampleFormat::Rgba8:
        return budget::kImageFitStep;
    case fetex::FbtSampleFormat::Rgba16:
        return budget::kImageFitStep16;
    case fetex::FbtSampleFormat::Rgba16F:
        return budget::kImageFitStepHalf;
    }
    return budget::kImageFitStep;
}

/// Every valid pixel is a sample of its region, at its place, and those of a texel count together as one; every hole's
/// mean is wanted to be the copied colour.
void add_samples(const FeaturedImage& picture, const ImageRegions& regions, const RegionColors& colors,
                 const std::vector<std::uint8_t>& valid, const Grid& grid, CornerFit& fit) {
    const RasterImage& image = picture.image;
    const double area = texels_per_pixel(picture, grid), weight = std::min(1.0, area),
                 anchor = budget::kImageAnchor / std::max(1.0, area);
    for (std::uint32_t j = 0; j < grid.height; ++j) {
        fit.begin_row(j);
        for (std::uint32_t y = first_pixel(j, image.height, grid.height);
             y < first_pixel(j + 1, image.height, grid.height); ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const std::size_t k = std::size_t{y} * image.width + x;
                if (valid[k] == 0) continue;
                const double u = pixel_centre(x, image.width, grid.width),
                             v = pixel_centre(y, image.height, grid.height);
                const Rgba c = image.at(x, y);
                fit.add_sample(regions.region_of_pixel[k], u - std::floor(u), v - std::floor(v), weight,
                               {c.r, c.g, c.b, c.a});
            }
        }
        for (std::uint32_t region = regions.graph.row_start(j); region < regions.graph.row_start(j + 1); ++region) {
            if (colors.origin[region] != RegionColors::Origin::Pixels)
                fit.add_sample(region, 0.5, 0.5, anchor, colors.color[region]);
        }
    }
    fit.finish();
}

/// Between four valid pixels around a place in texels; none where one of them isn't.
std::optional<Channels> between_pixels(const RasterImage& image, const std::vector<std::uint8_t>& valid,
                                       const Grid& grid, double x, double y) {
    const double u = x * image.width / grid.width - 0.5, v = y * image.height / grid.height - 0.5;
    if (!(u >= 0 && v >= 0 && u < image.width - 1 && v < image.height - 1)) return {};
    const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
    Channels sum{};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t px = i + k % 2, py = j + k / 2;
        if (valid[std::size_t{py} * image.width + px] == 0) return {};
        const double w = (k % 2 == 1 ? u - i : 1 - (u - i)) * (k / 2 == 1 ? v - j : 1 - (v - j));
        const Rgba c = image.at(px, py);
        sum = {sum[0] + w * c.r, sum[1] + w * c.g, sum[2] + w * c.b, sum[3] + w * c.a};
    }
    return sum;
}

/// Where texels are at most half a pixel, far from pixel centres, plain interpolation is a better guess: if no feature
/// comes within a pixel of the four around a corner, none is in the texels that meet there.
void guess_between_pixels(const FeaturedImage& picture, const ReachabilityGraph& graph, const CornerFit& fit,
                          const std::vector<std::uint8_t>& valid, const Grid& grid, std::vector<Channels>& values) {
    if (picture.invalidate < 1 || 2 * picture.image.width > grid.width || 2 * picture.image.height > grid.height)
        return;
    for (std::uint32_t j = 0; j < grid.height; ++j) {
        for (std::uint32_t region = graph.row_start(j); region < graph.row_start(j + 1); ++region) {
            for (std::uint32_t k = 0; k < 4; ++k) {
                const double x = graph.column(region) + k % 2, y = j + k / 2;
                if (const auto c = between_pixels(picture.image, valid, grid, x, y))
                    values[fit.unknown(region, k)] = *c;
            }
        }
    }
}

/// For each unknown the mean of the colours of its regions.
std::vector<Channels> first_guess(const CornerFit& fit, const RegionColors& colors) {
    std::vector<Channels> values(fit.unknowns(), Channels{});
    std::vector<double> uses(fit.unknowns(), 0);
    for (std::uint32_t region = 0; region < colors.color.size(); ++region) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t u = fit.unknown(region, k);
            for (std::size_t c = 0; c < 4; ++c)
                values[u][c] += colors.color[region][c];
            ++uses[u];
        }
    }
    for (std::size_t u = 0; u < values.size(); ++u) {
        for (double& c : values[u])
            c /= uses[u];
    }
    return values;
}

/// Before anything of the size is begun, and again when the regions are known: features add to the texels.
Status check_memory(std::uint64_t pixels, std::uint64_t regions) {
    const std::uint64_t bytes = image_memory(pixels, regions);
    if (bytes <= kMostImageMemory) return {};
    return Error{ErrorClass::InvalidInput, diag::kImageMemory,
                 std::to_string(pixels) + " pixels and " + std::to_string(regions) +
                     " texels and parts of texels take " + gibibytes(bytes) + " of memory; " +
                     gibibytes(kMostImageMemory) + " are the most",
                 ""};
}

std::string place_of(const FeaturedImage& picture, const Grid& grid, const TexelPoint& p) {
    return "pixel (" + std::to_string(static_cast<std::uint32_t>(p.x * picture.image.width / grid.width)) + ", " +
           std::to_string(static_cast<std::uint32_t>(p.y * picture.image.height / grid.height)) + ")";
}

void report_findings(const FeaturedImage& picture, const Grid& grid, const RegionColors& colors,
                     CompileReport& report) {
    const auto count = [](std::uint64_t n, const char* what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    if (!has_features(picture.features))
        report.diagnostics.push_back({Severity::Warning, diag::kNoFeatures, "no feature lies on the image", ""});
    constexpr std::uint32_t most_texels = 4; // a pixel; the steps that the fit needs grow with their square
    if (grid.width > most_texels * picture.image.width || grid.height > most_texels * picture.image.height)
        report.diagnostics.push_back({Severity::Warning, diag::kTexelsTooSmall,
                                      "more than four texels a pixel: gradients may stop before they reach a feature",
                                      ""});
    if (colors.parts_unsampled > 0)
        report.diagnostics.push_back({Severity::Warning, diag::kRegionsUnsampled,
                                      count(colors.parts_unsampled, "part") +
                                          " of the picture without a valid pixel: prefiltered ones were taken",
                                      place_of(picture, grid, colors.first_unsampled)});
    if (report.image.floating > 0)
        report.diagnostics.push_back(
            {Severity::Note, diag::kFeaturesFloating,
             count(report.image.floating, "part") + " of features that split nothing in their texel ignored", ""});
}

} // namespace

std::uint64_t image_memory(std::uint64_t pixels, std::uint64_t regions) {
    return kBytesPerPixel * pixels + kBytesPerRegion * regions;
}

Result<FbtBuild> compile_fbt(const FeaturedImage& picture, const CompileOptions& options,
                             const ProgressSink& progress) {
    const Result<GridSize> size = texels_for(picture.features.extent, options.size);
    if (!size) return size.error();
    const RasterImage& image = picture.image;
    const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
    if (Status fits = check_memory(pixels, std::uint64_t{size.value().width} * size.value().height); !fits)
        return fits.error();
    CompileReport report;
    report.scene = picture.features.stats;
    if (progress) progress("planar map", 0);
    const Grid grid = make_grid(picture.features.extent, size.value().width, size.value().height);
    Result<PlanarMap> map = PlanarMap::build(picture.features, grid, options.threads, report.planar, options.skip);
    if (!map) return map.error();
    Result<ImageRegions> found = find_image_regions(picture, map.value(), options);
    if (!found) return found.error();
    ImageRegions regions = std::move(found).value();
    if (Status fits = check_memory(pixels, regions.graph.vertices()); !fits) return fits.error();

    std::vector<std::uint8_t> valid = invalid_pixels(picture.features, image.width, image.height, picture.invalidate);
    for (std::uint8_t& v : valid)
        v ^= 1;
    report.image.pixels_invalid = static_cast<std::uint64_t>(std::ranges::count(valid, 0));
    RegionColors colors = region_colors(image, regions, valid, grid);
    release(regions.inside);
    release_free_pages();
    report.image.width = image.width, report.image.height = image.height;
    report.image.holes_filled = colors.holes;
    report.image.parts_unsampled = colors.parts_unsampled;
    report.image.floating = regions.floating;
    report_findings(picture, grid, colors, report);
    if (progress) progress("samples", 0);
    const double area = std::max(1.0, texels_per_pixel(picture, grid));
    CornerFit fit(regions.graph, grid.height, budget::kImageBending * area);
    add_samples(picture, regions, colors, valid, grid, fit);
    release(regions.region_of_pixel);
    std::vector<Channels> values = first_guess(fit, colors);
    release(colors.color), release(colors.origin);
    guess_between_pixels(picture, regions.graph, fit, valid, grid, values);
    release(valid);
    release_free_pages();
    report.image.fit_steps = fit.solve(values, fit_step(options.sample_format) / area, options.threads);
    const ImageSamples samples(regions.graph, fit, values, grid, options.sample_format);
    return build_fbt_of_features(picture.features, map.value(), regions.graph, samples, std::move(report), options,
                                 progress);
}

} // namespace fetexc
