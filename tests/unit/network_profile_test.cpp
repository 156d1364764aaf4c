// SPDX-License-Identifier: GPL-3.0-or-later
/// Profiles (Parilov and Zorin 2008, §3.1): presets, tables, and what their JSON may say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/network/curve_profiles.h"
#include "compiler/network/network_reader.h"
#include "compiler/network/profile_reader.h"

namespace fetexc {
namespace {

constexpr double kStep = 1e-6;          // of difference quotients
constexpr double kQuotientError = 1e-4; // of curves whose third derivative is below 10^4

Result<FeatureProfile> profile(const std::string& json) {
    return read_profile(std::vector<std::uint8_t>(json.begin(), json.end()));
}

FeatureProfile read(const std::string& json) {
    auto p = profile(json);
    EXPECT_TRUE(p.ok()) << p.error().message;
    return std::move(p).value();
}

int refusal(const std::string& json) {
    const auto p = profile(json);
    return p ? 0 : p.error().code;
}

std::vector<FeatureProfile> some_profiles() {
    std::vector<FeatureProfile> all;
    for (const std::string_view name : kProfilePresets)
        all.push_back(*preset_profile(name, 3));
    all.push_back(read(R"({"heights": [[0, 2], [0.5, 1], [1, 0.75], [2, 0.75], [3, 1], [4, 0]], "inner": 1})"));
    all.push_back(read(R"({"preset": "seam", "width": 2, "height": 7, "blends": [[0, 0], [1, 0.25], [1.5, 1]]})"));
    return all;
}

TEST(Profile, slopesAreDerivativesOfHeights) {
    for (const FeatureProfile& p : some_profiles()) {
        for (double d = 0.01; d < 1.2 * p.width; d += 0.0537) {
            const double quotient = (profile_height(p, d + kStep) - profile_height(p, d - kStep)) / (2 * kStep);
            EXPECT_NEAR(profile_slope(p, d), quotient, kQuotientError) << p.name << ' ' << d;
        }
    }
}

TEST(Profile, knowTheirLargestHeight) {
    for (const FeatureProfile& p : some_profiles()) {
        double most = 0;
        for (double d = 0; d < 1.1 * p.width; d += p.width / 3000) // thirds: a seam's top
            most = std::max(most, std::abs(profile_height(p, d)));
        EXPECT_NEAR(largest_height(p), most, 1e-6 * most) << p.name;
    }
}

TEST(Profile, ofCurvesAreTheirOwnOrTheCommonest) {
    const NetworkCurve one{"", {{1, {CanvasPoint{0, 0}, {1, 1}}}}, false, "", {}, {}};
    NetworkCurve ridge = one, own = one;
    ridge.profile = "ridge", own.profile = "own";
    FeatureProfile p = *preset_profile("groove", 5);
    p.name = "own";
    const Network network{9, 9, {one, own, ridge, ridge}, {p}};
    const CurveProfiles found = curve_profiles(network, std::nullopt);
    ASSERT_EQ(found.profiles.size(), 2u);
    EXPECT_EQ(found.profiles[0].name, "ridge");
    EXPECT_EQ(found.profiles[1].width, 5);
    EXPECT_EQ(found.of_curve, (std::vector<std::uint32_t>{0, 1, 0, 0}));
    EXPECT_EQ(profile_reach(found), 5);
    const CurveProfiles all = curve_profiles(network, p);
    EXPECT_EQ(all.profiles.size(), 1u);
    EXPECT_EQ(all.of_curve, (std::vector<std::uint32_t>(4, 0)));
    EXPECT_EQ(curve_profiles({9, 9, {}}, std::nullopt).profiles.front().name, "crease");
}

TEST(Profile, blendsGoFromTheProfileToTheBaseMap) {
    for (const FeatureProfile& p : some_profiles()) {
        EXPECT_EQ(profile_blend(p, 0), 0);
        EXPECT_EQ(profile_blend(p, p.width), 1);
        double last = 0;
        for (double d = 0; d < 2 * p.width; d += 0.01) {
            const double b = profile_blend(p, d);
            EXPECT_GE(b, last) << p.name << ' ' << d;
            last = b;
        }
        EXPECT_EQ(last, 1);
    }
    EXPECT_EQ(profile_blend(some_profiles()[4], 1), 0); // inner
    EXPECT_EQ(profile_blend(some_profiles()[5], 0.5), 0.125);
}

TEST(Profile, presetsAreSharpOrRoundAtTheCurveAndEndFlat) {
    const auto slope = [](const char* name, double d) { return profile_slope(*preset_profile(name, 1), d); };
    EXPECT_EQ(slope("crease", 0), 2 * kPresetSlope);
    EXPECT_EQ(slope("groove", 0), 0);
    EXPECT_EQ(slope("ridge", 0), -2 * kPresetSlope);
    EXPECT_EQ(slope("seam", 0), 6.75 * kPresetSlope);
    EXPECT_DOUBLE_EQ(profile_height(*preset_profile("seam", 3), 1), 3 * kPresetSlope);
    for (const char* name : {"crease", "groove", "ridge", "seam"})
        for (const double d : {1.0, 1.5}) {
            EXPECT_EQ(slope(name, d), 0) << name;
            EXPECT_EQ(profile_height(*preset_profile(name, 1), d), 0) << name;
        }
    EXPECT_FALSE(preset_profile("hill", 1).has_value());
}

TEST(Profile, tablesGoThroughTheirPointsWithoutOvershooting) {
    const FeatureProfile p = read(R"({"heights": [[0, 0], [1, 10], [2, 10], [4, -1]]})");
    for (const ProfilePoint& at : p.heights)
        EXPECT_DOUBLE_EQ(profile_height(p, at.distance), at.value);
    EXPECT_EQ(p.width, 4);
    double last = 0;
    for (double d = 0; d <= 1; d += 1.0 / 64) {
        EXPECT_GE(profile_height(p, d), last);
        last = profile_height(p, d);
    }
    for (double d = 1; d <= 2; d += 1.0 / 64)
        EXPECT_EQ(profile_height(p, d), 10);
    EXPECT_EQ(profile_slope(p, 5), 0);
}

TEST(Profile, colorsAreLinearBetweenPoints) {
    const FeatureProfile p = read(R"({"preset": "ridge", "width": 2, "colors": [[0, 1, 0, 0], [1, 0, 1, 0, 0.5]]})");
    EXPECT_EQ(profile_color(p, 0), (Rgba{1, 0, 0, 1}));
    EXPECT_EQ(profile_color(p, 0.5), (Rgba{0.5, 0.5, 0, 0.75}));
    EXPECT_EQ(profile_color(p, 7), (Rgba{0, 1, 0, 0.5}));
    EXPECT_EQ(profile_color(read(R"({"preset": "ridge", "width": 2, "color": [0, 0, 1]})"), 1), (Rgba{0, 0, 1, 1}));
    EXPECT_FALSE(profile_color(*preset_profile("ridge", 1), 0).has_value());
}

TEST(ProfileReader, refusesWhatMakesNoProfile) {
    EXPECT_EQ(refusal("{"), diag::kNetworkMalformed);
    EXPECT_EQ(refusal("[]"), diag::kNetworkMember);
    EXPECT_EQ(refusal("{}"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"preset": "crease"})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"preset": "hill", "width": 1})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": 0})"), diag::kNetworkNumber);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": -1})"), diag::kNetworkNumber);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": "1"})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": 1, "inner": 2})"), diag::kNetworkNumber);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": 1, "deep": 2})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"preset": "crease", "width": 1, "heights": [[0, 0], [1, 1]]})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [1, 1]], "height": 2})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0]]})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[1, 0], [2, 0]]})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 0], [2, 1]]})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2]]})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], 2]})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], []]})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "width": 0})"), diag::kNetworkNumber);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "blends": [[0, 2]]})"), diag::kNetworkNumber);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "blends": []})"), diag::kNetworkProfile);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "color": [1, 1]})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "colors": [[0, 1, 1]]})"), diag::kNetworkMember);
    EXPECT_EQ(refusal(R"({"heights": [[0, 0], [2, 1]], "colors": [[0, 1, 1, 1]], "color": [1, 1, 1]})"),
              diag::kNetworkProfile);
}

std::string network_with(const std::string& members, const std::string& curve_profile) {
    return R"({"schema": "fetexc-network/1", "width": 64, "height": 32, )" + members +
           R"("curves": [{"start": [0, 0], "profile": ")" + curve_profile + R"(", "segments": [[1, 1]]}]})";
}

Result<Network> network(const std::string& members, const std::string& curve_profile) {
    const std::string text = network_with(members, curve_profile);
    std::vector<Diagnostic> diagnostics;
    return read_network(std::vector<std::uint8_t>(text.begin(), text.end()), diagnostics);
}

TEST(ProfileReader, networksNameTheirProfilesOrPresets) {
    const auto n = network(R"("profiles": {"vein": {"preset": "ridge", "width": 5}}, "profile": "vein", )", "crease");
    ASSERT_TRUE(n.ok()) << n.error().message;
    EXPECT_EQ(n.value().profile, "vein");
    EXPECT_EQ(find_profile(n.value(), "vein")->width, 5);
    EXPECT_EQ(find_profile(n.value(), "vein")->shape, ProfileShape::Ridge);
    EXPECT_EQ(find_profile(n.value(), "crease")->width, 1); // a 64th of the larger side
    const auto own = network(R"("profiles": {"crease": {"preset": "seam", "width": 5}}, )", "crease");
    EXPECT_EQ(find_profile(own.value(), "crease")->shape, ProfileShape::Seam);
}

TEST(ProfileReader, refusesNamesWithoutAProfile) {
    EXPECT_EQ(network("", "hill").error().code, diag::kNetworkProfile);
    EXPECT_EQ(network("", "hill").error().place, "curve 1");
    EXPECT_EQ(network(R"("profile": "hill", )", "").error().code, diag::kNetworkProfile);
    EXPECT_EQ(network(R"("profiles": {"hill": {}}, )", "hill").error().place, "profile \"hill\"");
    EXPECT_EQ(network(R"("profiles": [], )", "").error().code, diag::kNetworkMember);
}

} // namespace
} // namespace fetexc
