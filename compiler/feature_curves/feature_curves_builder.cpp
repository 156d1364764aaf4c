// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/feature_curves_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/feature_curves/curve_texture.h"
#include "compiler/feature_curves/feature_samples.h"
#include "compiler/feature_curves/texture_profiles.h"
#include "compiler/parallel.h"
#include "compiler/scene/lattice.h"
#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/feature_sampler.h"

namespace fetexc {
namespace {

using fetex::FeatureCurvesTexture;
using fetex::FeatureKind;

constexpr std::uint32_t kMaxSide = 16384;
constexpr std::size_t kRows = 16;       ///< of corners, for a thread at a time
constexpr double kMostDistance = 65504; ///< texels: what the format takes

TextureProfiles profiles_for(const Network& network, const FeatureCurvesOptions& options) {
    return options.profile ? TextureProfiles(*options.profile) : TextureProfiles(network);
}

/// What curves of several profiles lose.
void tell_profiles(const TextureProfiles& profiles, std::uint64_t overlaid, FeatureCurvesBuild& build) {
    const auto warn = [&](std::uint64_t count, const std::string& text) {
        if (count > 0)
            build.diagnostics.push_back(
                {Severity::Warning, diag::kFeatureProfiles, std::to_string(count) + text, std::string()});
    };
    const std::string first = "\"" + profiles.profiles().front().name + "\"";
    warn(profiles.curves_beyond(), " curves have the profile " + first + " instead of \"" + profiles.name_beyond() +
                                       "\" and others: a texture has " + std::to_string(fetex::kFeatureProfilesMost));
    warn(overlaid, " lines or curves lie on others of another profile, and have theirs");
    warn(build.stats.snapping.edges_of_profiles,
         " edges of texels are crossed by curves of several profiles: the first one's counts there");
    build.stats.curves_other_profile = profiles.curves_beyond() + overlaid;
}

/// A texture's colours depend on the distance alone.
void tell_sides(const Network& network, FeatureCurvesBuild& build) {
    const auto count = std::ranges::count_if(
        network.curves, [](const NetworkCurve& c) { return c.left.has_value() || c.right.has_value(); });
    if (count > 0)
        build.diagnostics.push_back({Severity::Warning, diag::kFeatureSides,
                                     std::to_string(count) + " curves have colours for their sides (left, right); "
                                                             "both sides show the profile's",
                                     std::string()});
}

/// Whatever distance a point of a texel has within a profile's width, its texel's corners are at most a diagonal
/// farther.
double limit_for(const std::vector<FeatureProfile>& profiles, double scale) {
    return std::ranges::max(profiles, {}, &FeatureProfile::width).width * scale + std::numbers::sqrt2;
}

bool makes_linear(const Network& network, const FeatureCurvesOptions& options) {
    return options.linear || std::ranges::all_of(network.curves, [](const NetworkCurve& c) {
               return std::ranges::all_of(c.segments, [](const CanvasSegment& s) { return s.degree == 1; });
           });
}

Result<SnappedCurves> snapped(const Network& network, const FeatureCurvesOptions& options,
                              const TextureProfiles& profiles, std::uint64_t& overlaid) {
    const GridSize size = options.size;
    if (makes_linear(network, options)) {
        auto lines = lattice_lines(network, size.width, size.height, &profiles);
        if (!lines) return lines.error();
        overlaid = lines.value().overlaid;
        return snap_lines(lines.value(), size.width, size.height, options.threads);
    }
    auto curves = lattice_curves(network, &profiles);
    if (!curves) return curves.error();
    overlaid = curves.value().overlaid;
    return snap_quadratics(curves.value(), size.width, size.height, options.threads);
}

/// Configurations and signatures.
FeatureCurvesTexture write_curves(const SnappedCurves& curves, bool linear, const FeatureCurvesOptions& options,
                                  double limit, FeatureCurvesBuild& build) {
    const auto most = static_cast<float>(std::min(limit, kMostDistance));
    if (linear) return linear_texture(curves, options.numbers, most, options.threads);
    QuadraticTexture written = quadratic_texture(curves, options.numbers, most);
    build.stats.flat = written.flat, build.stats.straightened_by_rounding = written.straightened;
    for (Diagnostic& d : rounding_diagnostics(written))
        build.diagnostics.push_back(std::move(d));
    return std::move(written.texture);
}

/// Of the edges' points, for now.
void add_profile_map(const SnappedCurves& curves, std::size_t profiles, FeatureCurvesTexture& t) {
    t.profiles = static_cast<std::uint32_t>(profiles);
    if (profiles == 1) return;
    t.profile_map.resize(fetex::feature_corner_count(t));
    for (std::size_t k = 0; k < curves.north_profile.size(); ++k)
        t.profile_map[k] = fetex::feature_profile_word(0, curves.north_profile[k], curves.west_profile[k]);
}

void count(const SnappedCurves& curves, const DistanceMap& map, FeatureCurvesBuild& build) {
    FeatureCurvesStats& s = build.stats;
    s.snapping = curves.stats, s.moved = curves.moves.size();
    for (const FeatureMove& m : curves.moves)
        s.farthest = std::max(s.farthest, m.distance);
    for (const fetex::FeatureConfiguration c : build.texture.configurations) {
        const std::uint32_t segments = fetex::feature_unpack(c).count;
        s.texels_one += segments == 1, s.texels_two += segments == 2;
    }
    s.corners_near =
        static_cast<std::uint64_t>(std::ranges::count_if(map.distances, [&](double d) { return d < map.limit; }));
    s.gpu_bytes = fetex::feature_gpu_bytes(build.texture);
}

/// The distances are those of the curves as the texture has them.
DistanceMap add_distances(const FeatureCurvesOptions& options, FeatureCurvesTexture& t) {
    const unsigned threads = options.threads;
    DistanceMap map = distance_map(TextureSegments(t, threads), static_cast<double>(t.distance_limit), threads);
    const bool gradients = t.kind == FeatureKind::Normal;
    if (gradients) {
        smooth_gradients(map, t, options.smooth, threads);
        fetex::feature_set_gradient(t, 0, 0, {}); // makes room
    }
    parallel_for_chunks(std::size_t{t.height} + 1, kRows, threads, [&](std::size_t begin, std::size_t end) {
        std::size_t at = begin * (std::size_t{t.width} + 1);
        for (std::size_t j = begin; j < end; ++j) {
            for (std::uint32_t i = 0; i <= t.width; ++i, ++at) {
                const auto row = static_cast<std::uint32_t>(j);
                fetex::feature_set_distance(t, i, row, map.distances[at]);
                if (!map.profiles.empty()) t.profile_map[at] |= fetex::feature_profile_word(map.profiles[at], 0, 0);
                if (gradients) fetex::feature_set_gradient(t, i, row, {map.gradients[at].x, map.gradients[at].y});
            }
        }
    });
    return map;
}

bool out_of_range(GridSize size) {
    return size.width < 1 || size.height < 1 || size.width > kMaxSide || size.height > kMaxSide;
}

/// On the GPU.
std::uint64_t bytes_at(GridSize size, const FeatureCurvesOptions& options, bool linear,
                       const std::vector<FeatureProfile>& profiles) {
    const std::uint64_t corners = (std::uint64_t{size.width} + 1) * (std::uint64_t{size.height} + 1);
    const std::uint64_t numbers =
        fetex::feature_signature_numbers(linear) + 1 + (options.kind == FeatureKind::Normal ? 2 : 0);
    const std::uint64_t samples = options.base.image != nullptr ? corners : 1;
    return 2 * std::uint64_t{size.width} * size.height +
           corners * numbers * fetex::feature_number_bytes(options.numbers) +
           samples * fetex::bitmap_sample_bytes(options.sample_format) +
           std::uint64_t{profile_entries(profiles)} * profiles.size() * sizeof(fetex::FeatureProfileEntry) +
           (profiles.size() > 1 ? 2 * corners : 0) +
           (options.mips ? 4 * fetex::fbt_mip_samples(size.width, size.height) : 0);
}

} // namespace

double texels_per_unit(const Network& network, GridSize size) {
    return (size.width / network.width + size.height / network.height) / 2;
}

Result<FeatureCurvesBuild> compile_feature_curves(const Network& network, const FeatureCurvesOptions& options,
                                                  const ProgressSink& progress) {
    if (out_of_range(options.size))
        return Error{ErrorClass::Usage, diag::kSizeOutOfRange, "the size must be 1 to 16384 texels on each side", ""};
    FeatureCurvesBuild build;
    build.stats.curves = network.curves.size(), build.stats.segments = segment_count(network);
    const TextureProfiles profiles = profiles_for(network, options);
    build.profiles = profiles.profiles();
    std::uint64_t overlaid = 0;
    if (progress) progress("curves", 0);
    auto curves = snapped(network, options, profiles, overlaid);
    if (!curves) return curves.error();
    if (curves.value().north_profile.empty()) build.profiles.resize(1);
    const double scale = texels_per_unit(network, options.size);
    const double limit = options.limit > 0 ? options.limit : limit_for(build.profiles, scale);
    build.texture = write_curves(curves.value(), makes_linear(network, options), options, limit, build);
    build.texture.kind = options.kind;
    add_profile_map(curves.value(), build.profiles.size(), build.texture);
    if (progress) progress("distances", 0.5);
    const DistanceMap map = add_distances(options, build.texture);
    add_profiles(build.profiles, scale, build.texture);
    add_base(options, scale, build.texture);
    if (options.mips) build.texture.mips = fetex::feature_make_mips(build.texture);
    count(curves.value(), map, build);
    tell_profiles(profiles, overlaid, build);
    if (options.kind == FeatureKind::Color) tell_sides(network, build);
    for (Diagnostic& d : snap_diagnostics(curves.value()))
        build.diagnostics.push_back(std::move(d));
    build.moves = std::move(curves.value().moves);
    return build;
}

Result<FeatureCurvesBuild> compile_feature_curves_within(const Network& network, const FeatureCurvesOptions& options,
                                                         std::uint64_t max_bytes, const ProgressSink& progress) {
    const Result<Extent> extent = make_extent(network.width, network.height);
    if (!extent) return extent.error();
    const bool linear = makes_linear(network, options);
    const std::vector<FeatureProfile> profiles = profiles_for(network, options).profiles();
    const auto fits = [&](std::uint32_t side) {
        return bytes_at(grid_for(extent.value(), side), options, linear, profiles) <= max_bytes;
    };
    if (!fits(1))
        return Error{ErrorClass::Unsupported, diag::kFeatureBudget,
                     "no size of a texture with feature curves fits in " + std::to_string(max_bytes) + " bytes", ""};
    std::uint32_t least = 1, most = kMaxSide + 1; // the first fits, the last doesn't
    while (most - least > 1) {
        const std::uint32_t middle = least + (most - least) / 2;
        (fits(middle) ? least : most) = middle;
    }
    FeatureCurvesOptions chosen = options;
    chosen.size = grid_for(extent.value(), least);
    return compile_feature_curves(network, chosen, progress);
}

Result<double> feature_curves_move(const Network& network, const FeatureCurvesOptions& options) {
    std::uint64_t overlaid = 0;
    const auto curves = snapped(network, options, profiles_for(network, options), overlaid);
    if (!curves) return curves.error();
    double farthest = 0;
    for (const FeatureMove& m : curves.value().moves)
        farthest = std::max({farthest, m.distance, (m.kinds & kLostInside) != 0 ? std::numbers::sqrt2 : 0});
    return farthest / texels_per_unit(network, options.size);
}

std::uint64_t feature_curves_bytes(const Network& network, const FeatureCurvesOptions& options) {
    const TextureProfiles profiles = profiles_for(network, options);
    return bytes_at(options.size, options, makes_linear(network, options), profiles.profiles());
}

} // namespace fetexc
