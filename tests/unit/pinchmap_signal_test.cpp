// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of pinchmaps' signals: as points say where they say enough, and within reason where they don't.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/pinchmap/sample_equations.h"

namespace fetexc {
namespace {

using Colors = std::array<double, 4>;

Colors grey(double v) { return {v, v, v, 1}; }

int one_side(std::uint32_t /*a*/, std::uint32_t /*b*/) { return 0; }

/// Many points say what sample 0 is. A few, which read a tenth of sample 1, are lighter than it: for them alone sample
/// 1 would have to be 3.5.
TEST(PinchmapSignal, samplesOfWhichLittleIsReadDontSwing) {
    SampleEquations equations(3, 0, 1);
    for (int n = 0; n < 200; ++n)
        equations.add(0.5, 0.5, grey(0.5), 1), equations.add(2.5, 0.5, grey(0.5), 1);
    for (int n = 0; n < 20; ++n)
        equations.add(0.6, 0.5, grey(0.8), 1);
    const SolvedSamples s = equations.solve(one_side, 1);
    EXPECT_NEAR(s.colors[0][0], 0.5, 0.03);
    EXPECT_GE(s.colors[1][0], 0.75);
    EXPECT_LE(s.colors[1][0], 0.87);
}

/// Those that points tell enough about are as they say: a gradient stays one, to steps of 16 bits.
TEST(PinchmapSignal, samplesThatAreReadEnoughAreAsThePointsSay) {
    SampleEquations equations(4, 0, 4);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const double at_x = 0.5 + (x + 0.5) / 32 * 3, at_y = 0.5 + (y + 0.5) / 32 * 3;
            equations.add(at_x, at_y, grey(0.1 + 0.2 * at_x), 1);
        }
    }
    const SolvedSamples s = equations.solve(one_side, 1);
    for (std::uint32_t k = 0; k < 16; ++k)
        EXPECT_NEAR(s.colors[k][0], 0.1 + 0.2 * (k % 4 + 0.5), 0x1p-16) << k;
    EXPECT_EQ(s.unseen, 0u);
}

/// What nothing reads is like what lies beside it on its side.
TEST(PinchmapSignal, samplesThatNothingReadsAreLikeTheirSide) {
    SampleEquations equations(4, 0, 1);
    equations.add(0.5, 0.5, grey(0.2), 1), equations.add(3.5, 0.5, grey(0.9), 1);
    const SolvedSamples s = equations.solve([](std::uint32_t a, std::uint32_t) { return a < 2 ? -1 : 1; }, 1);
    EXPECT_NEAR(s.colors[1][0], 0.2, 1e-3);
    EXPECT_NEAR(s.colors[2][0], 0.9, 1e-3);
    EXPECT_EQ(s.unseen, 2u);
}

} // namespace
} // namespace fetexc
