// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "cli/bench/bench_csv.h"
#include "cli/bench/bench_plots.h"
#include "cli/bench/compile_time.h"
#include "cli/bench/label_layout.h"
#include "cli/bench/log_scale.h"
#include "cli/bench/plot.h"

namespace fetexc::cli {
namespace {

TEST(LogScale, multipliesAlongTheAxis) {
    const LogScale scale(10, 1000, 0, 100);
    EXPECT_NEAR(scale.pixel(100), 50, 1e-9);
    EXPECT_NEAR(scale.pixel(100) - scale.pixel(10), scale.pixel(1000) - scale.pixel(100), 1e-9);
    EXPECT_GT(scale.pixel(10), 0);
    EXPECT_LT(scale.pixel(1000), 100);
}

TEST(LogScale, runsUpwardsWhenAsked) {
    const LogScale scale(1, 10, 100, 0);
    EXPECT_GT(scale.pixel(1), scale.pixel(10));
}

struct TickCase {
    double lo, hi;
    std::size_t most;
    std::vector<double> ticks;
};

TEST(LogScale, hasTicksWorthReading) {
    const TickCase cases[] = {{1, 1e4, 8, {1, 10, 100, 1e3, 1e4}},
                              {1, 1e8, 5, {1, 100, 1e4, 1e6, 1e8}},
                              {16e3, 900e3, 8, {20e3, 50e3, 100e3, 200e3, 500e3, 1e6}},
                              {20, 60, 8, {20, 30, 50}},
                              {1, 1, 8, {0.7, 1}}};
    for (const TickCase& c : cases) {
        const std::vector<double> found = LogScale(c.lo, c.hi, 0, 100).ticks(c.most);
        ASSERT_GE(found.size(), 2u) << c.lo << " … " << c.hi;
        if (c.lo == c.hi) continue;
        ASSERT_EQ(found.size(), c.ticks.size()) << c.lo << " … " << c.hi;
        for (std::size_t k = 0; k < found.size(); ++k)
            EXPECT_NEAR(found[k], c.ticks[k], 1e-9 * c.ticks[k]);
    }
}

TEST(LogScale, keepsTicksInsideAndFew) {
    for (double lo = 1e-3; lo < 1e3; lo *= 1.37) {
        for (double ratio = 1; ratio < 1e9; ratio *= 2.9) {
            const LogScale scale(lo, lo * ratio, 0, 300);
            const std::vector<double> ticks = scale.ticks(8);
            ASSERT_GE(ticks.size(), 2u) << lo << " … " << lo * ratio;
            ASSERT_LE(ticks.size(), 8u) << lo << " … " << lo * ratio;
            EXPECT_GE(scale.pixel(ticks.front()), -1e-6);
            EXPECT_LE(scale.pixel(ticks.back()), 300 + 1e-6);
        }
    }
}

TEST(Labels, readLikePeopleWriteNumbers) {
    EXPECT_EQ(count_label(0.002), "0.002");
    EXPECT_EQ(count_label(1.5), "1.5");
    EXPECT_EQ(count_label(1000), "1,000");
    EXPECT_EQ(count_label(1234567), "1,234,567");
    EXPECT_EQ(bytes_label(999), "999 B");
    EXPECT_EQ(bytes_label(20000), "20 kB");
    EXPECT_EQ(bytes_label(1.5e6), "1.5 MB");
    EXPECT_EQ(bytes_label(1073741824), "1.07 GB");
}

TEST(Labels, dontCoverEachOther) {
    std::vector<NamedLine> lines;
    for (const double y : {100.0, 101.0, 103.0, 99.0})
        lines.push_back({"a rather long name", {{50, 300 - y}, {200, y}}});
    const PixelBox room{0, 0, 400, 300};
    const std::vector<PlacedLabel> placed = place_labels(lines, room, 12);
    ASSERT_EQ(placed.size(), lines.size());
    for (std::size_t a = 0; a < placed.size(); ++a) {
        EXPECT_GE(placed[a].box.x0, room.x0);
        EXPECT_LE(placed[a].box.x1, room.x1);
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_FALSE(placed[a].box.overlaps(placed[b].box)) << a << " and " << b;
    }
}

/// Two lines end close to each other below a third: their labels leave room for its.
TEST(Labels, standBesideTheirOwnEnds) {
    const std::vector<NamedLine> lines{{"the lowest", {{383, 290}, {500, 326}}},
                                       {"one of a long name", {{383, 291}, {500, 328}}},
                                       {"the one above, with a name", {{382, 252}, {500, 298}}},
                                       {"the highest", {{383, 244}, {500, 281}}}};
    for (const PlacedLabel& label : place_labels(lines, {80, 50, 718, 384}, 12)) {
        EXPECT_FALSE(label.right_aligned);
        EXPECT_GT(label.box.x0, 500);
    }
}

TEST(Labels, stayInTheRoomAtItsRightEdge) {
    const std::vector<PlacedLabel> placed = place_labels({{"name", {{10, 50}, {398, 50}}}}, {0, 0, 400, 100}, 12);
    EXPECT_LE(placed[0].box.x1, 400);
}

TEST(Csv, quotesOnlyWhatHasToBe) {
    EXPECT_EQ(csv_field("plain text"), "plain text");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("say \"so\""), "\"say \"\"so\"\"\"");
    EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

/// Commas outside quotes.
std::size_t columns(const std::string& line) {
    std::size_t count = 1;
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++count;
    }
    return count;
}

BenchPoint point_of(const std::string& method, std::uint32_t size, std::uint64_t bytes, double ppm) {
    BenchPoint p;
    p.method = method, p.size = size, p.bytes = bytes, p.texel_side = 0.1;
    measure::SizeErrors e;
    e.pixels = {100, 100}, e.misclassified_ppm = ppm, e.psnr = 40;
    p.errors = {e};
    return p;
}

TEST(Csv, hasAllColumnsInEveryLine) {
    BenchFile file{"a,b.svg", true, {point_of(kFbtMethod, 8, 100, 5)}};
    file.points.push_back({});
    file.points.back().note = "not applicable: 5 colours";
    file.points.front().times = BenchTimes{1.5, 2.5, {}, "no GL: \"none\", here"};
    for (const bool timed : {false, true}) {
        std::string text = bench_csv({file}, timed);
        std::vector<std::size_t> found;
        for (std::size_t at; (at = text.find('\n')) != std::string::npos; text.erase(0, at + 1))
            found.push_back(columns(text.substr(0, at)));
        ASSERT_EQ(found.size(), 3u);
        EXPECT_EQ(found[1], found[0]);
        EXPECT_EQ(found[2], found[0]);
    }
}

TEST(Means, areGeometric) {
    const BenchFile a{"a", false, {point_of(kFbtMethod, 8, 100, 10)}},
        b{"b", false, {point_of(kFbtMethod, 8, 400, 1000)}};
    const Plot plot = mean_plot({&a, &b}, ErrorAxis::WrongArea, CostAxis::Bytes);
    ASSERT_EQ(plot.lines.size(), 1u);
    ASSERT_EQ(plot.lines[0].points.size(), 1u);
    EXPECT_NEAR(plot.lines[0].points[0].x, 200, 1e-9);
    EXPECT_NEAR(plot.lines[0].points[0].y, 100, 1e-9);
    EXPECT_FALSE(plot.lines[0].points[0].at_most);
}

TEST(Means, countHalfAPointWhereNoneIsWrong) {
    const BenchFile a{"a", false, {point_of(kFbtMethod, 8, 100, 0)}};
    const Plot plot = mean_plot({&a}, ErrorAxis::WrongArea, CostAxis::Bytes);
    EXPECT_NEAR(plot.lines[0].points[0].y, 50, 1e-9);
    EXPECT_TRUE(plot.lines[0].points[0].at_most);
}

TEST(Means, countTheBestPsnrWhereErrorsAreTooSmallToTell) {
    BenchFile a{"a", false, {point_of(kFbtMethod, 8, 100, 1)}};
    a.points[0].errors[0].psnr = std::numeric_limits<double>::infinity();
    const Plot plot = mean_plot({&a}, ErrorAxis::ColorError, CostAxis::Bytes);
    EXPECT_NEAR(plot.lines[0].points[0].y, 0.001, 1e-12);
    EXPECT_TRUE(plot.lines[0].points[0].at_most);
    EXPECT_NE(plot.note.find("too small to tell; 0.001%"), std::string::npos) << plot.note;
    a.points[0].errors[0].psnr = 40;
    EXPECT_EQ(mean_plot({&a}, ErrorAxis::ColorError, CostAxis::Bytes).note, "");
}

TEST(Means, leaveOutWhatSomeDrawingLacks) {
    const BenchFile a{"a", true, {point_of(kFbtMethod, 8, 100, 1), point_of(bench_methods()[3], 8, 90, 1)}},
        b{"b", false, {point_of(kFbtMethod, 8, 100, 1)}};
    EXPECT_EQ(methods_of({&a}).size(), 2u);
    EXPECT_EQ(methods_of({&a, &b}).size(), 1u);
    EXPECT_TRUE(mean_plot({&a}, ErrorAxis::WrongArea, CostAxis::CompileTime).lines.empty());
}

TEST(Timing, takesTheMedian) {
    EXPECT_EQ(median({3}), 3);
    EXPECT_EQ(median({9, 1, 5}), 5);
    EXPECT_EQ(median({4, 1, 9, 2}), 3);
}

TEST(Timing, runsEveryWorkInEveryRoundAndStopsAtAnError) {
    int a = 0, b = 0;
    const auto times = time_works({[&] { return ++a, Status(); }, [&] { return ++b, Status(); }}, 3);
    ASSERT_TRUE(times.ok());
    EXPECT_EQ(a, 3);
    EXPECT_EQ(b, 3);
    EXPECT_EQ(times.value().size(), 2u);
    EXPECT_LT(times.value()[0].ratio, 0.1);
    const auto failed = time_works({[]() -> Status { return Error{ErrorClass::Runtime, 1, "no", {}}; }}, 3);
    EXPECT_FALSE(failed.ok());
}

TEST(PlotText, isEscaped) { EXPECT_EQ(escaped("<a & \"b\">\x01"), "&lt;a &amp; &quot;b&quot;&gt;"); }

} // namespace
} // namespace fetexc::cli
