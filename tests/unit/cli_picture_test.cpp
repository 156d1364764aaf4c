// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/image_file.h"

#include <gtest/gtest.h>

namespace fetexc::cli {
namespace {

TEST(Picture, dividesColoursByAlphaAndRoundsOnce) {
    const fetex::Image image{3, 1, {0.2f, 0.1f, 0.05f, 0.4f, 0, 0, 0, 0, 1, 0.5f, 0, 1}};
    const std::vector<std::uint8_t> expected = {128, 64, 32, 102, 0, 0, 0, 0, 255, 128, 0, 255};
    EXPECT_EQ(to_straight_rgba8(image), expected);
}

TEST(Picture, keepsEveryStraightColourThroughEveryAlpha) {
    for (int alpha = 1; alpha <= 255; ++alpha) {
        for (int value = 0; value <= 255; value += 5) {
            const float a = static_cast<float>(alpha) / 255, v = static_cast<float>(value) / 255 * a;
            const auto bytes = to_straight_rgba8({1, 1, {v, v, v, a}});
            ASSERT_EQ(bytes[0], value) << "alpha " << alpha;
            ASSERT_EQ(bytes[3], alpha);
        }
    }
}

TEST(Picture, clampsWhatIsOutOfRange) {
    const std::vector<std::uint8_t> expected = {255, 0, 255, 128};
    EXPECT_EQ(to_straight_rgba8({1, 1, {0.7f, -0.1f, 0.50001f, 0.5f}}), expected);
}

TEST(Picture, encodesTheSameBytesEveryTime) {
    const fetex::Image image{2, 2, std::vector<float>(16, 0.5f)};
    const auto a = encode_png(image), b = encode_png(image);
    ASSERT_TRUE(a.ok() && b.ok());
    EXPECT_EQ(a.value(), b.value());
    ASSERT_GT(a.value().size(), 8u);
    EXPECT_EQ(a.value()[1], 'P');
}

TEST(Picture, standsBesideAnother) {
    const fetex::Image left{1, 2, {1, 1, 1, 1, 0, 0, 0, 0}}, right{2, 2, std::vector<float>(16, 0.25f)};
    const fetex::Image both = side_by_side(left, right, 3);
    ASSERT_EQ(both.width, 6u);
    ASSERT_EQ(both.rgba.size(), 48u);
    EXPECT_EQ(both.rgba[0], 1);
    EXPECT_EQ(both.rgba[4 * 3 + 3], 1);
    EXPECT_EQ(both.rgba[4 * 4], 0.25f);
    EXPECT_EQ(both.rgba[24], 0);
}

} // namespace
} // namespace fetexc::cli
