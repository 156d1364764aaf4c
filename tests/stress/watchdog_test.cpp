// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stress/watchdog.h"

#include <gtest/gtest.h>

#include <ctime>

namespace fetexc::test {
namespace {

/// Busy for so many seconds of processor time.
void work(double seconds) {
    const std::clock_t end = std::clock() + static_cast<std::clock_t>(seconds * CLOCKS_PER_SEC);
    while (std::clock() < end) {
    }
}

TEST(WatchdogDeathTest, NamesTheCaseThatHangs) {
    EXPECT_DEATH(
        {
            const Watchdog watchdog("endless", 7, 1);
            work(20);
        },
        "watchdog: endless, seed 7 takes longer than 1 s");
}

TEST(Watchdog, LetsCasesEndAndStartsAnewForEach) {
    for (unsigned long long seed = 0; seed < 3; ++seed) {
        const Watchdog watchdog("short", seed, 1);
        work(0.5);
    }
    work(0.6);
}

} // namespace
} // namespace fetexc::test
