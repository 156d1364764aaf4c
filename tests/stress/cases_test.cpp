// SPDX-License-Identifier: GPL-3.0-or-later
/// The named corpus: every drawing in cases/ holds every invariant, as drawn and moved about.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/stress/watchdog.h"
#include "tests/support/stress_case.h"

namespace fetexc::test {
namespace {

std::vector<std::string> files() {
    std::vector<std::string> out;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(FETEXC_ART_DIR) / "../stress/cases")) {
        if (entry.path().extension() == ".crv") out.push_back(entry.path().string());
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::string name_of(const std::string& file) { return std::filesystem::path(file).stem().string(); }

class Cases : public testing::TestWithParam<std::string> {};

TEST_P(Cases, HoldEveryInvariant) {
    const Result<Drawing> drawing = read_drawing(GetParam());
    ASSERT_TRUE(drawing.ok()) << drawing.error().message << ", " << drawing.error().place;
    ASSERT_GT(curve_count(drawing.value()), 0u);
    for (std::uint64_t seed = 0; seed < 6; ++seed) { // six is what the choice of grids repeats after
        for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
            const Watchdog watchdog(name_of(GetParam()).c_str(), seed);
            Drawing d = drawing.value();
            d.rule = rule;
            const Failure failure = first_failure(d, seed);
            EXPECT_FALSE(failure) << "seed " << seed << ": " << *failure << "\nshrink it: minimize " << GetParam()
                                  << " --seed " << seed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stress, Cases, testing::ValuesIn(files()),
                         [](const auto& file) { return name_of(file.param); });

} // namespace
} // namespace fetexc::test
