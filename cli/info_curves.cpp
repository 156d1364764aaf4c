// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "cli/compile_curves.h"
#include "cli/compile_silmap.h"
#include "cli/texture_info.h"
#include "formats/bitmap_samples.h"
#include "formats/fbt_samples.h"

namespace fetexc::cli {
namespace {

/// Texels by how many segments they have, and segments that are straight.
struct Counts {
    std::array<std::uint64_t, 3> texels{};
    std::uint64_t segments = 0, straight = 0, corners_near = 0;
};
Counts count_texels(const fetex::FeatureCurvesTexture& t) {
    Counts out;
    for (const fetex::FeatureConfiguration c : t.configurations) {
        const fetex::FeatureSegmentList list = fetex::feature_unpack(c);
        ++out.texels[list.count], out.segments += list.count;
        for (std::uint32_t k = 0; k < list.count; ++k)
            out.straight += t.linear || list.straight[k];
    }
    for (std::uint32_t j = 0; j <= t.height; ++j)
        for (std::uint32_t i = 0; i <= t.width; ++i)
            out.corners_near += fetex::feature_distance(t, i, j) < static_cast<double>(t.distance_limit);
    return out;
}

std::uint64_t base_samples(const fetex::FeatureCurvesTexture& t) {
    return t.base.size() / fetex::fbt_sample_words(fetex::silmap_fbt_format(t.base_format));
}

double coverage(const fetex::FeatureCurvesTexture& t, const Counts& counts) {
    return 1 - static_cast<double>(counts.texels[0]) / static_cast<double>(t.configurations.size());
}

} // namespace

Json info_json(const fetex::FeatureCurvesTexture& t) {
    const Counts counts = count_texels(t);
    return {
        {"width", t.width},
        {"height", t.height},
        {"kind", kind_name(t.kind)},
        {"numbers", numbers_name(t.format)},
        {"linear", t.linear},
        {"limit", t.distance_limit},
        {"samples", silmap_samples_name(t.base_format)},
        {"heightScale", t.height_scale},
        {"gpuBytes", fetex::feature_gpu_bytes(t)},
        {"configurationBytes", 2 * t.configurations.size()},
        {"signatureBytes", t.signatures.size()},
        {"distanceBytes", t.distances.size()},
        {"gradientBytes", t.gradients.size()},
        {"baseBytes", base_samples(t) * fetex::bitmap_sample_bytes(t.base_format)},
        {"profileEntries", fetex::feature_profile_entries(t)},
        {"profiles", t.profiles},
        {"profileMapBytes", 2 * t.profile_map.size()},
        {"mipBytes", 4 * t.mips.size()},
        {"mipLevels", mip_levels_of(t)},
        {"texels", {{"empty", counts.texels[0]}, {"oneSegment", counts.texels[1]}, {"twoSegments", counts.texels[2]}}},
        {"segments", counts.segments},
        {"straightSegments", counts.straight},
        {"cornersNear", counts.corners_near},
        {"coverage", coverage(t, counts)}};
}

void print_info(const fetex::FeatureCurvesTexture& t) {
    const Counts counts = count_texels(t);
    fmt::print("curves        {} x {} texels with feature curves, of {}s; numbers {}, samples {}\n", t.width, t.height,
               kind_name(t.kind), numbers_name(t.format), silmap_samples_name(t.base_format));
    fmt::print(
        "  on the GPU  {} bytes: {} in configurations, {} in signatures, {} in distances, {} in gradients, {} in "
        "the base map, {} entries of {}\n",
        fetex::feature_gpu_bytes(t), 2 * t.configurations.size(), t.signatures.size(), t.distances.size(),
        t.gradients.size(), base_samples(t) * fetex::bitmap_sample_bytes(t.base_format),
        fetex::feature_profile_entries(t),
        t.profiles == 1 ? "a profile"
                        : fmt::format("each of {} profiles, {} in their map", t.profiles, 2 * t.profile_map.size()));
    fmt::print("  texels      {} with a segment, {} with two: {:.1f} %; {} segments, {} of them straight{}\n",
               counts.texels[1], counts.texels[2], 100 * coverage(t, counts), counts.segments, counts.straight,
               t.linear ? " (linear)" : "");
    fmt::print("  distances   up to {:g} texels, at {} corners\n", t.distance_limit, counts.corners_near);
}

} // namespace fetexc::cli
