// SPDX-License-Identifier: GPL-3.0-or-later
/// Several profiles in a texture with feature curves: which curves, edges and corners have which, and what is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compiler/diagnostics.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/scene/bezier.h"
#include "formats/feature_sampler.h"
#include "formats/validate.h"

namespace fetexc {
namespace {

using fetex::FeatureKind;

NetworkCurve line(CanvasPoint a, CanvasPoint b, std::string profile = "") {
    return {"", {{1, {a, b}}}, false, std::move(profile), {}, {}};
}

FeatureCurvesOptions options_at(std::uint32_t width, std::uint32_t height) {
    FeatureCurvesOptions options;
    options.size = {width, height};
    return options;
}

FeatureCurvesBuild built(const Network& network, const FeatureCurvesOptions& options) {
    auto build = compile_feature_curves(network, options);
    EXPECT_TRUE(build.ok()) << build.error().message;
    return std::move(build).value();
}

auto told_of_profiles(const FeatureCurvesBuild& build) {
    return std::ranges::count(build.diagnostics, diag::kFeatureProfiles, &Diagnostic::code);
}

std::vector<ProfileShape> shapes(const FeatureCurvesBuild& build) {
    std::vector<ProfileShape> out;
    for (const FeatureProfile& p : build.profiles)
        out.push_back(p.shape);
    return out;
}

TEST(FeatureProfiles, areWhatCurvesAskForTheFirstWhatMostDo) {
    using Shapes = std::vector<ProfileShape>;
    using enum ProfileShape;
    Network network{40,
                    20,
                    {line({1, 1}, {9, 9}, "ridge"), line({12, 9}, {20, 1}, "seam"), line({21, 1}, {29, 9}, "seam"),
                     line({31, 1}, {39, 9})}};
    const FeatureCurvesBuild most = built(network, options_at(40, 20));
    EXPECT_EQ(shapes(most), (Shapes{Seam, Ridge}));
    EXPECT_EQ(most.texture.profiles, 2u);
    EXPECT_EQ(told_of_profiles(most), 0);

    network.profile = "ridge"; // of the last curve too: the first of two equals
    EXPECT_EQ(shapes(built(network, options_at(40, 20))), (Shapes{Ridge, Seam}));

    FeatureCurvesOptions own = options_at(40, 20);
    own.profile = preset_profile("groove", 1);
    const FeatureCurvesBuild one = built(network, own);
    EXPECT_EQ(shapes(one), Shapes{Groove});
    EXPECT_EQ(one.texture.profiles, 1u);
    EXPECT_TRUE(one.texture.profile_map.empty());
    EXPECT_EQ(shapes(built({40, 20, {line({3, 2}, {35, 17})}}, options_at(40, 20))), Shapes{Crease});
}

/// Then there is no map.
TEST(FeatureProfiles, areOneWhereOthersAreNotOnTheCanvas) {
    const Network network{40, 20, {line({1, 1}, {9, 9}, "ridge"), line({-50, 9}, {-20, 12}, "seam")}};
    const FeatureCurvesBuild b = built(network, options_at(40, 20));
    EXPECT_EQ(b.texture.profiles, 1u);
    ASSERT_EQ(b.profiles.size(), 1u);
    EXPECT_EQ(b.profiles[0].shape, ProfileShape::Ridge);
}

/// A colour each, the base black; n curves.
Network colored_network(const std::vector<NetworkCurve>& curves, double width = 1) {
    Network network{20, 20, curves};
    for (std::size_t k = 0; k < curves.size(); ++k) {
        FeatureProfile p = *preset_profile("ridge", width);
        p.name = std::to_string(k), p.inner = width / 2;
        p.colors = {{0, {std::min((k + 1) / 16.0, 1.0), k % 2 == 0 ? 1.0 : 0.0, 0.5, 1}}};
        network.curves[k].profile = p.name;
        network.profiles.push_back(p);
    }
    return network;
}

double red_at(const FeatureCurvesBuild& b, CanvasPoint p) {
    return fetex::feature_sample(b.texture, p.x / 20 * b.texture.width, p.y / 20 * b.texture.height).r;
}

/// Of the curve's colour, from a part of it to another.
void expect_own_color(const FeatureCurvesBuild& b, const CanvasSegment& s, std::size_t k, double from, double to) {
    for (double u = from; u <= to; u += 1.0 / 128)
        EXPECT_NEAR(red_at(b, bezier::point_at(s, u)), (k + 1) / 16.0, 0.01) << k << " at " << u;
}

TEST(FeatureProfiles, parallelCurvesHaveTheirOwn) {
    for (const std::size_t count : {2u, 3u, 5u, 8u, 16u}) {
        std::vector<NetworkCurve> curves;
        for (std::size_t k = 0; k < count; ++k) {
            const double y = 1 + 18.0 * static_cast<double>(k) / static_cast<double>(count);
            curves.push_back(line({0.5, y}, {19.5, y + 0.8}));
        }
        const Network network = colored_network(curves, 0.4);
        for (const double texels : {40.0, 80.0}) {
            FeatureCurvesOptions options = options_at(static_cast<std::uint32_t>(texels), 53);
            options.kind = FeatureKind::Color, options.base_color = {0, 0, 0, 1};
            const FeatureCurvesBuild b = built(network, options);
            EXPECT_EQ(b.texture.profiles, count);
            EXPECT_EQ(told_of_profiles(b), 0);
            EXPECT_TRUE(fetex::validate_feature_curves(b.texture).empty());
            for (std::size_t k = 0; k < count; ++k) {
                expect_own_color(b, network.curves[k].segments[0], k, 0.1, 0.9);
                const CanvasPoint beside = bezier::point_at(network.curves[k].segments[0], 0.5);
                EXPECT_NEAR(red_at(b, {beside.x, beside.y + 0.15}), (k + 1) / 16.0, 0.01); // within what is inner
            }
        }
    }
}

TEST(FeatureProfiles, crossingCurvesHaveTheirOwn) {
    const Network network = colored_network({line({1, 4}, {19, 15}),
                                             line({3, 18}, {16, 2}),
                                             {"", {{2, {{{1, 16}, {10, 20}, {19, 6}, {}}}}}, false, "", {}, {}}});
    for (const bool linear : {false, true}) {
        FeatureCurvesOptions options = options_at(60, 60);
        options.kind = FeatureKind::Color, options.base_color = {0, 0, 0, 1}, options.linear = linear;
        const FeatureCurvesBuild b = built(network, options);
        EXPECT_EQ(b.texture.profiles, 3u);
        EXPECT_TRUE(fetex::validate_feature_curves(b.texture).empty());
        expect_own_color(b, network.curves[0].segments[0], 0, 0.1, 0.4); // before they cross
        expect_own_color(b, network.curves[1].segments[0], 1, 0.75, 0.9);
        if (!linear) expect_own_color(b, network.curves[2].segments[0], 2, 0.3, 0.5);
        options.threads = 0;
        const FeatureCurvesBuild more = built(network, options);
        EXPECT_EQ(b.texture.profile_map, more.texture.profile_map);
    }
}

/// A curve goes on with another profile: from the one to the other within a texel.
TEST(FeatureProfiles, changeAlongACurve) {
    const Network network = colored_network({line({1, 10.3}, {10.2, 10.1}), line({10.2, 10.1}, {19, 10.4})});
    FeatureCurvesOptions options = options_at(40, 40);
    options.kind = FeatureKind::Color, options.base_color = {0, 0, 0, 1};
    const FeatureCurvesBuild b = built(network, options);
    EXPECT_EQ(told_of_profiles(b), 0);
    expect_own_color(b, network.curves[0].segments[0], 0, 0.1, 0.9);
    expect_own_color(b, network.curves[1].segments[0], 1, 0.1, 0.9);
    double before = red_at(b, bezier::point_at(network.curves[0].segments[0], 0.9));
    for (double u = 0.9; u <= 1; u += 1e-3) {
        const double red = red_at(b, bezier::point_at(network.curves[0].segments[0], u));
        EXPECT_NEAR(red, before, 0.01);
        before = red;
    }
}

TEST(FeatureProfiles, whatCantBeHeldIsTold) {
    std::vector<NetworkCurve> many;
    for (int k = 0; k < 18; ++k)
        many.push_back(line({1, k + 1.3}, {19, k + 1.3}));
    const FeatureCurvesBuild beyond = built(colored_network(many, 0.2), options_at(40, 40));
    EXPECT_EQ(beyond.texture.profiles, 16u);
    EXPECT_EQ(beyond.stats.curves_other_profile, 2u);
    EXPECT_EQ(told_of_profiles(beyond), 1);

    const Network same = colored_network({line({1, 3}, {19, 7}), line({19, 7}, {1, 3}), line({1, 9}, {9, 9})});
    for (const bool quadratic : {false, true}) {
        Network network = same;
        if (quadratic) network.curves[2].segments[0] = {2, {{{1, 9}, {5, 15}, {9, 9}, {}}}};
        const FeatureCurvesBuild lies = built(network, options_at(40, 40));
        EXPECT_EQ(lies.stats.curves_other_profile, 1u);
        EXPECT_EQ(told_of_profiles(lies), 1);
    }
    // Both through the same vertical edges, from x = 1 to x = 19.
    const Network close = colored_network({line({1, 10.2}, {19, 10.2}), line({1, 10.3}, {19, 10.3})});
    const FeatureCurvesBuild merged = built(close, options_at(20, 20));
    EXPECT_EQ(merged.stats.snapping.edges_of_profiles, 19u);
    EXPECT_EQ(told_of_profiles(merged), 1);
    EXPECT_EQ(built(close, options_at(20, 200)).stats.snapping.edges_of_profiles, 0u);
}

/// Every corner has that of the curve that is nearest, those beyond the limit that of a corner beside.
TEST(FeatureProfiles, ofCornersAreThoseOfTheNearestCurve) {
    const Network network = colored_network({line({1, 4.3}, {19, 4.3}), line({1, 12.1}, {19, 12.1})});
    const FeatureCurvesBuild b = built(network, options_at(20, 20));
    for (std::uint32_t j = 1; j < 20; ++j) {
        const double first = std::abs(j - 4.3), second = std::abs(j - 12.1), nearest = std::min(first, second);
        const unsigned corner = b.texture.profile_map[j * 21 + 10] & 15u;
        if (nearest > b.texture.distance_limit + 1) continue; // and no corner beside is nearer
        EXPECT_EQ(corner, first < second ? 0u : 1u) << j;
    }
}

/// As many entries where the narrowest is as it had alone, but for the limit's diagonal.
TEST(FeatureProfiles, ofSeveralWidthsHaveMoreEntries) {
    Network network = colored_network({line({1, 4}, {19, 4}), line({1, 12}, {19, 12})});
    EXPECT_EQ(fetex::feature_profile_entries(built(network, options_at(20, 20)).texture), kFeatureProfileEntries);
    network.profiles[0].width = 2.5 * network.profiles[1].width;
    const FeatureCurvesBuild b = built(network, options_at(20, 20));
    EXPECT_EQ(fetex::feature_profile_entries(b.texture), 3 * kFeatureProfileEntries);
    EXPECT_EQ(b.stats.gpu_bytes, fetex::feature_gpu_bytes(b.texture));
    network.profiles[0].width = 1000;
    EXPECT_EQ(fetex::feature_profile_entries(built(network, options_at(20, 20)).texture), fetex::kFeatureProfileMost);
}

TEST(FeatureProfiles, countForWhatTheBytesAllow) {
    const Network network = colored_network({line({1, 4}, {19, 4}), line({1, 12}, {19, 12}), line({3, 1}, {4, 19})});
    for (const std::uint64_t bytes : {std::uint64_t{20000}, std::uint64_t{100000}}) {
        auto within = compile_feature_curves_within(network, {}, bytes);
        ASSERT_TRUE(within.ok());
        EXPECT_LE(within.value().stats.gpu_bytes, bytes);
        const std::uint32_t more = within.value().texture.width + 1;
        EXPECT_GT(built(network, options_at(more, more)).stats.gpu_bytes, bytes);
    }
}

} // namespace
} // namespace fetexc
