// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/feature_samples.h"

#include <algorithm>
#include <cmath>

#include "formats/fbt_samples.h"

namespace fetexc {
namespace {

using fetex::FbtColor;
using fetex::FeatureCurvesTexture;
using fetex::FeatureKind;
using fetex::FeatureSampleFormat;

constexpr Rgba kBlack{0, 0, 0, 1};

FbtColor premultiplied_color(const Rgba& straight) {
    return {straight.r * straight.a, straight.g * straight.a, straight.b * straight.a, straight.a};
}

void push(FeatureCurvesTexture& t, const FbtColor& color) {
    const fetex::FbtSampleFormat format = fetex::silmap_fbt_format(t.base_format);
    const auto words = fetex::fbt_pack_sample(color, format);
    t.base.insert(t.base.end(), words.begin(), words.begin() + fetex::fbt_sample_words(format));
}

FbtColor color_of_normal(const NormalVector& n, FeatureSampleFormat format) {
    const double factor = fetex::feature_normal_factor(format);
    return {(n.x + 1) / factor, (n.y + 1) / factor, (n.z + 1) / factor, 1};
}

FbtColor grey(double v) { return {v, v, v, 1}; }

/// Heights without an image: so that the profiles' and this, 0, are in the middle of what grey can show.
void centre_heights(FeatureCurvesTexture& t) {
    float most = 0;
    for (const fetex::FeatureProfileEntry& e : t.profile)
        most = std::max(most, std::abs(e.height));
    t.height_scale = most > 0 ? 2 * most : 1;
    for (fetex::FeatureProfileEntry& e : t.profile)
        e.height += t.height_scale / 2;
    push(t, grey(0.5));
}

void add_one_sample(const FeatureCurvesOptions& options, FeatureCurvesTexture& t) {
    if (t.kind == FeatureKind::Normal) push(t, color_of_normal({}, t.base_format));
    if (t.kind == FeatureKind::Color) push(t, premultiplied_color(options.base_color));
    if (t.kind == FeatureKind::Height) centre_heights(t);
}

void add_table(const FeatureProfile& profile, double scale, std::uint32_t entries, FeatureCurvesTexture& texture) {
    for (std::uint32_t k = 0; k < entries; ++k) {
        const double d = k * static_cast<double>(texture.distance_limit) / (entries - 1) / scale;
        const Rgba color = profile_color(profile, d).value_or(kBlack);
        texture.profile.push_back(
            {static_cast<float>(scale * profile_height(profile, d)), static_cast<float>(profile_slope(profile, d)),
             static_cast<float>(profile_blend(profile, d)),
             fetex::fbt_pack_sample(premultiplied_color(color), fetex::FbtSampleFormat::Rgba8)[0]});
    }
}

} // namespace

std::uint32_t profile_entries(const std::vector<FeatureProfile>& profiles) {
    const auto [narrowest, widest] = std::ranges::minmax(profiles, {}, &FeatureProfile::width);
    const double entries = kFeatureProfileEntries * std::ceil(widest.width / narrowest.width);
    return static_cast<std::uint32_t>(std::min(entries, double{fetex::kFeatureProfileMost}));
}

void add_profiles(const std::vector<FeatureProfile>& profiles, double scale, FeatureCurvesTexture& texture) {
    texture.profile.clear();
    for (const FeatureProfile& profile : profiles)
        add_table(profile, scale, profile_entries(profiles), texture);
}

void add_base(const FeatureCurvesOptions& options, double scale, FeatureCurvesTexture& texture) {
    texture.base_format = options.sample_format;
    texture.base.clear();
    if (options.base.image == nullptr) return add_one_sample(options, texture);
    if (texture.kind == FeatureKind::Normal) {
        BaseImage base = options.base;
        base.height_scale *= scale;
        for (const NormalVector& n : corner_normals(base, texture.width, texture.height, options.threads))
            push(texture, color_of_normal(n, texture.base_format));
        return;
    }
    const bool opaque = options.sample_format == FeatureSampleFormat::Rgb8 || texture.kind == FeatureKind::Height;
    if (texture.kind == FeatureKind::Height)
        texture.height_scale = static_cast<float>(options.base.height_scale * scale);
    for (const Rgba& c : corner_colors(*options.base.image, texture.width, texture.height, options.threads))
        push(texture, {c.r, c.g, c.b, opaque ? 1 : c.a});
}

} // namespace fetexc
