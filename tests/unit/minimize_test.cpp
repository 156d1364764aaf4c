// SPDX-License-Identifier: GPL-3.0-or-later
/// The minimiser: what it leaves of a drawing, and that crashes and hangs are answers. Drawings as text.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "tests/support/shrink.h"
#include "tests/support/stress_drawings.h"

namespace fetexc::test {
namespace {

std::string text_of(const Drawing& d) {
    std::ostringstream out;
    write_drawing(d, out);
    return out.str();
}

Result<Drawing> parsed(const std::string& text) {
    std::istringstream in(text);
    return read_drawing(in);
}

bool has_zero_handle(const Drawing& d) {
    for (const Path& path : d.paths) {
        for (const auto& curve : path) {
            if (curve.size() == 4 && curve[0] == curve[1] && curve[1] != curve[3]) return true;
        }
    }
    return false;
}

TEST(Shrink, LeavesOneCurveWithTheTrap) {
    Drawing d = stress_drawing(*find_generator("anything"), 3);
    d.paths[1].push_back({{12345, 678}, {12345, 678}, {99999, 1234567}, {7777777, 8888888}});
    ASSERT_TRUE(has_zero_handle(d));
    ShrinkCounts counts;
    const Drawing small = shrink(d, has_zero_handle, &counts);
    EXPECT_EQ(curve_count(small), 1u);
    EXPECT_TRUE(has_zero_handle(small));
    EXPECT_EQ(text_of(small), "unit 16777216\npath\n3 0 0 0 0 0 0 0 1\n"); // nothing else can go
    EXPECT_GT(counts.tried, counts.kept);
}

TEST(Shrink, KeepsWhatThePredicateNeeds) {
    // Three paths, one of them with two curves.
    const StillFails needs = [](const Drawing& d) { return d.paths.size() >= 3 && curve_count(d) >= 4; };
    const Drawing small = shrink(stress_drawing(*find_generator("bundles"), 5), needs);
    EXPECT_EQ(small.paths.size(), 3u);
    EXPECT_EQ(curve_count(small), 4u);
}

TEST(Shrink, TheSameAgainFindsNothingMore) {
    const StillFails needs = [](const Drawing& d) { return curve_count(d) > 0 && d.paths[0][0].back().x > 1000; };
    const Drawing small = shrink(stress_drawing(*find_generator("odd_curves"), 2), needs);
    ShrinkCounts counts;
    EXPECT_EQ(text_of(shrink(small, needs, &counts)), text_of(small));
    EXPECT_EQ(counts.kept, 0u);
}

TEST(AskInChild, FailuresCrashesAndHangsAreAnswers) {
    EXPECT_EQ(ask_in_child([] { return Failure{}; }, 5).kind, Outcome::Kind::Fine);
    const Outcome failure = ask_in_child([] { return Failure{"map: " + std::string(100000, 'x')}; }, 5);
    EXPECT_EQ(failure.kind, Outcome::Kind::Fails);
    EXPECT_EQ(failure.message.size(), 100005u);
    EXPECT_EQ(ask_in_child([]() -> Failure { std::abort(); }, 5).kind, Outcome::Kind::Crashes);
    EXPECT_EQ(ask_in_child([]() -> Failure { std::_Exit(9); }, 5).kind, Outcome::Kind::Crashes);
    const auto forever = []() -> Failure {
        volatile bool on = true;
        while (on) {
        }
        return {};
    };
    EXPECT_EQ(ask_in_child(forever, 1).kind, Outcome::Kind::Hangs);
}

TEST(Crv, ReadsWhatItWrites) {
    for (const StressGenerator& generator : stress_generators()) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const Drawing d = stress_drawing(generator, seed);
            const Result<Drawing> again = parsed(text_of(d));
            ASSERT_TRUE(again.ok()) << generator.name << " " << again.error().place << again.error().message;
            EXPECT_TRUE(again.value().rule == d.rule && again.value().paths == d.paths) << generator.name << seed;
        }
    }
}

TEST(Crv, RefusesWhatItIsNot) {
    for (const char* text :
         {"1 0 0 1 1\n", "path\n4 0 0 1 1\n", "path\n1 0 0 1\n", "path\n1 0 0 1 1 2\n", "curve\n", "unit 0\n",
          "rule winding\n", "path\n1 0 0 1 999999999999\n", "unit 1024\npath\n1 0 0 1 999999\n"})
        EXPECT_FALSE(parsed(text).ok()) << text;
    EXPECT_TRUE(parsed("# nothing\n\nunit 2 # steps\npath\n1 0 0 1 1 # a line\n").ok());
}

} // namespace
} // namespace fetexc::test
