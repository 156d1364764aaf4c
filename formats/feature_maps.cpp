// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The base map of a texture with feature curves, which profiles its texels have, and the bytes of all its arrays.
#include "formats/bitmap_samples.h"
#include "formats/fbt_samples.h"
#include "formats/feature_curves.h"

namespace fetex {

std::uint64_t feature_gpu_bytes(const FeatureCurvesTexture& t) {
    const std::uint64_t samples = t.base.size() / fbt_sample_words(silmap_fbt_format(t.base_format));
    return 2 * std::uint64_t{t.configurations.size()} + t.signatures.size() + t.distances.size() + t.gradients.size() +
           samples * bitmap_sample_bytes(t.base_format) + t.profile.size() * sizeof(FeatureProfileEntry) +
           2 * std::uint64_t{t.profile_map.size()} + 4 * std::uint64_t{t.mips.size()};
}

FeatureTexelProfiles feature_texel_profiles(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    if (t.profile_map.empty()) return {};
    const auto number = [&](std::uint32_t column, std::uint32_t row, unsigned shift) {
        const std::uint64_t corner = std::uint64_t{row} * (std::uint64_t{t.width} + 1) + column;
        return static_cast<std::uint8_t>(t.profile_map[corner] >> shift & 15u);
    };
    return {{number(i, j, 0), number(i + 1, j, 0), number(i, j + 1, 0), number(i + 1, j + 1, 0)},
            {number(i, j, 4), number(i + 1, j, 8), number(i, j + 1, 4), number(i, j, 8)}};
}

FbtColor feature_base(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    const FbtSampleFormat format = silmap_fbt_format(t.base_format);
    const std::uint32_t words = fbt_sample_words(format);
    const std::uint64_t n = t.base.size() == words ? 0 : std::uint64_t{j} * (std::uint64_t{t.width} + 1) + i;
    const auto c = fbt_sample_channels(&t.base[n * words], format);
    const double unit = fbt_sample_unit(format);
    return {c[0] / unit, c[1] / unit, c[2] / unit, c[3] / unit};
}

double feature_normal_factor(FeatureSampleFormat format) {
    switch (format) {
    case FeatureSampleFormat::Rgba16:
        return 65535.0 / 32767;
    case FeatureSampleFormat::Rgba16F:
        return 2;
    default:
        return 255.0 / 127;
    }
}

} // namespace fetex
