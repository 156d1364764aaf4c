// SPDX-License-Identifier: GPL-3.0-or-later
/// Sampler cost with a clock made up: the statistics must be right whatever the machine does. And one-channel fields,
/// drawn by OSMesa, against the same interpolation in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime_glsl/host/sampler_cost.h"

namespace fetex {
namespace {

/// A plain draw takes `plain` seconds times the drift of its round; the other one 1, 2, 3 … times that, round by round.
struct FakeClock {
    double plain = 0.25;
    int calls = 0;
    std::vector<bool> order; ///< of the counted calls: plain or not
    std::vector<std::uint32_t> draws;

    Outcome<double> operator()(bool is_plain, std::uint32_t count) {
        constexpr int kWarmUp = 3;
        const int round = (calls++ - kWarmUp) / 2;
        if (calls <= kWarmUp) return is_plain ? plain : 99.0;
        order.push_back(is_plain);
        draws.push_back(count);
        const double drift = 1 + 0.7 * (round % 3);
        return plain * drift * count * (is_plain ? 1 : round + 1);
    }
};

TEST(PairedCost, isTheMedianOfRatiosWhateverTheDrift) {
    FakeClock clock;
    const auto cost = paired_cost(std::ref(clock), 11);
    ASSERT_TRUE(cost.ok());
    EXPECT_DOUBLE_EQ(cost.value().median, 6);
    EXPECT_DOUBLE_EQ(cost.value().lower_quartile, 3.5);
    EXPECT_DOUBLE_EQ(cost.value().upper_quartile, 8.5);
    EXPECT_EQ(cost.value().rounds, 11u);
    ASSERT_EQ(clock.order.size(), 22u);
    for (std::size_t k = 0; k < 22; k += 2)
        EXPECT_NE(clock.order[k], clock.order[k + 1]) << "each round has one of both";
    EXPECT_NE(clock.order[0], clock.order[2]) << "and they take turns in being first";
}

TEST(PairedCost, repeatsWhatIsTooShortForAClock) {
    FakeClock slow, fast, stopped;
    fast.plain = 1e-5;
    stopped.plain = 0;
    ASSERT_TRUE(paired_cost(std::ref(slow), 3).ok());
    EXPECT_EQ(slow.draws.front(), 1u);
    ASSERT_TRUE(paired_cost(std::ref(fast), 3).ok());
    EXPECT_NEAR(fast.draws.front(), 100, 1);
    EXPECT_FALSE(paired_cost(std::ref(stopped), 3).ok()) << "no ratio of nothing";
}

TEST(PairedCost, hasOneRoundAtLeast) {
    FakeClock clock;
    EXPECT_FALSE(paired_cost(std::ref(clock), 0).ok());
    const auto one = paired_cost(std::ref(clock), 1);
    ASSERT_TRUE(one.ok());
    EXPECT_DOUBLE_EQ(one.value().median, one.value().upper_quartile);
}

TEST(PairedCost, handsOnErrors) {
    const auto cost = paired_cost(
        [](bool plain, std::uint32_t) -> Outcome<double> {
            if (plain) return 1.0;
            return RuntimeError{RuntimeErrc::GlTooOld, "no"};
        },
        11);
    ASSERT_FALSE(cost.ok());
    EXPECT_EQ(cost.error().code, RuntimeErrc::GlTooOld);
}

class Fields : public testing::Test {
  protected:
    void SetUp() override {
        auto opened = Renderer::open(Backend::OSMesa);
        if (!opened && opened.error().code == RuntimeErrc::BackendMissing) GTEST_SKIP() << opened.error().message;
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        renderer_.emplace(std::move(opened.value()));
        field_ = {.width = 5,
                  .height = 3,
                  .values = {9, 250, 0, 128, 77,   //
                             200, 40, 255, 3, 130, //
                             127, 128, 60, 90, 222}};
        const float below[4] = {0.25F, 0, 0, 0.5F}, above[4] = {0, 1, 0.75F, 1};
        std::copy_n(below, 4, field_.below);
        std::copy_n(above, 4, field_.above);
    }
    [[nodiscard]] double texel(int i, int j) const {
        i = std::clamp(i, 0, 4), j = std::clamp(j, 0, 2);
        return field_.values[static_cast<std::size_t>(j * 5 + i)] / 255.0;
    }
    [[nodiscard]] double value_at(double x, double y) const {
        const double i = std::floor(x - 0.5), j = std::floor(y - 0.5), s = x - 0.5 - i, t = y - 0.5 - j;
        const int a = static_cast<int>(i), b = static_cast<int>(j);
        return std::lerp(std::lerp(texel(a, b), texel(a + 1, b), s), std::lerp(texel(a, b + 1), texel(a + 1, b + 1), s),
                         t);
    }
    /// Compares every pixel of a draw; coverage(value) is of `above`. Pixels nearer than a hair to a jump are left out.
    template <class Coverage> void expect_drawn(const Coverage& coverage) {
        constexpr std::uint32_t kWidth = 700, kHeight = 500; // more than a tile
        ASSERT_FALSE(renderer_->upload_field(field_).has_value());
        const auto image = renderer_->render_field({}, {kWidth, kHeight, 1});
        ASSERT_TRUE(image.ok()) << image.error().message;
        std::uint32_t compared = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                const double value = value_at((x + 0.5) * 5 / kWidth, (y + 0.5) * 3 / kHeight);
                const double c = coverage(value);
                if (std::abs(coverage(value + 1e-5) - coverage(value - 1e-5)) > 0.5) continue;
                const float* pixel = &image.value().rgba[(std::size_t{y} * kWidth + x) * 4];
                for (int k = 0; k < 4; ++k)
                    ASSERT_NEAR(pixel[k], std::lerp(field_.below[k], field_.above[k], c), 2e-3) << x << ' ' << y;
                ++compared;
            }
        EXPECT_GT(compared, kWidth * kHeight * 99 / 100);
    }

    std::optional<Renderer> renderer_;
    Field field_;
};

TEST_F(Fields, thresholdIsSharpBetweenTexels) {
    expect_drawn([](double value) { return value >= 0.5 ? 1.0 : 0.0; });
}

TEST_F(Fields, distanceFieldIsSoftOverOneSample) {
    field_.range = 0.125; // in texels: soft over a good part of the picture
    expect_drawn([](double value) { return std::clamp((value - 0.5) * 0.125 * 700 / 5 + 0.5, 0.0, 1.0); });
}

TEST_F(Fields, refuseWhatIsNotOne) {
    EXPECT_FALSE(renderer_->render_field({}, {8, 8, 1}).ok());
    field_.values.pop_back();
    EXPECT_TRUE(renderer_->upload_field(field_).has_value());
    field_.values.push_back(0);
    field_.range = NAN;
    EXPECT_TRUE(renderer_->upload_field(field_).has_value());
}

} // namespace
} // namespace fetex
