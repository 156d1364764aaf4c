// SPDX-License-Identifier: GPL-3.0-or-later
/// Bezier networks: reading them, what is refused and why, lower degrees, drawings as networks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/network/network_reader.h"
#include "compiler/network/simplify.h"
#include "compiler/scene/bezier.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using test::Random;

std::vector<Diagnostic> diagnostics;

Result<Network> read(const std::string& text) {
    diagnostics.clear();
    return read_network(std::vector<std::uint8_t>(text.begin(), text.end()), diagnostics);
}

std::string network_with(const std::string& curves) {
    return R"({"schema": "fetexc-network/1", "width": 40, "height": 20, "curves": [)" + curves + "]}";
}

/// Number and place of what is refused; "" if nothing is.
std::string refusal(const std::string& text) {
    const Result<Network> network = read(text);
    if (network) return "";
    EXPECT_EQ(network.error().cls, ErrorClass::InvalidInput);
    EXPECT_FALSE(network.error().message.empty());
    return std::to_string(network.error().code) + " " + network.error().place;
}

TEST(NetworkReader, readsEveryKindOfSegment) {
    std::ifstream file(std::string(FETEXC_ART_DIR) + "/network/star.json");
    const Result<Network> network = read({std::istreambuf_iterator<char>(file), {}});
    ASSERT_TRUE(network.ok()) << network.error().message;
    const Network& n = network.value();
    EXPECT_EQ(n.width, 40);
    EXPECT_EQ(n.height, 20);
    ASSERT_EQ(n.curves.size(), 5u);
    EXPECT_EQ(n.curves[0].name, "rim");
    EXPECT_EQ(n.curves[0].profile, "crease");
    EXPECT_TRUE(n.curves[0].closed);
    ASSERT_EQ(n.curves[0].segments.size(), 4u); // it ends at its start: no line is added
    EXPECT_EQ(n.curves[0].segments[0].degree, 3);
    EXPECT_EQ(n.curves[0].segments[1].degree, 2);
    EXPECT_EQ(n.curves[0].segments[1].p[0].x, 20);
    EXPECT_EQ(n.curves[1].segments[0].degree, 1);
    EXPECT_EQ(n.curves[1].left, (Rgba{0.1, 0.2, 0.3, 1}));
    EXPECT_EQ(n.curves[1].right, (Rgba{1, 1, 1, 0.5}));
    EXPECT_FALSE(n.curves[2].left.has_value());
    EXPECT_TRUE(diagnostics.empty());
}

TEST(NetworkReader, closesClosedCurves) {
    const auto n = read(network_with(R"({"closed": true, "start": [1, 1], "segments": [[5, 1], [5, 5]]})"));
    ASSERT_TRUE(n.ok());
    ASSERT_EQ(n.value().curves[0].segments.size(), 3u);
    EXPECT_EQ(n.value().curves[0].segments[2].p[1].x, 1);
}

TEST(NetworkReader, leavesOutPointsAndSaysSo) {
    const auto n = read(network_with(R"({"start": [1, 1], "segments": [[1, 1], [1, 1, 1, 1]]},
                                        {"start": [1, 1], "segments": [[1, 1], [2, 2]]})"));
    ASSERT_TRUE(n.ok());
    ASSERT_EQ(n.value().curves.size(), 1u);
    EXPECT_EQ(n.value().curves[0].segments.size(), 1u);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, diag::kNetworkPointSegments);
    EXPECT_NE(diagnostics[0].message.find('3'), std::string::npos);
    ASSERT_TRUE(read(network_with("")).ok());
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, diag::kNetworkEmpty);
}

TEST(NetworkReader, saysWhatIsWrongAndWhere) {
    EXPECT_EQ(refusal("{\n \"schema\": ?"), "1501 line 2, column 12");
    EXPECT_EQ(refusal(""), "1501 line 1, column 1");
    EXPECT_EQ(refusal("[]"), "1502 network");
    EXPECT_EQ(refusal(R"({"schema": "fetexc-network/2"})"), "1501 network");
    EXPECT_EQ(refusal(R"({"schema": "fetexc-network/1", "width": 0, "height": 1, "curves": []})"), "1503 network");
    EXPECT_EQ(refusal(R"({"schema": "fetexc-network/1", "width": "3", "height": 1, "curves": []})"), "1502 network");
    EXPECT_EQ(refusal(R"({"schema": "fetexc-network/1", "width": 1, "height": 1})"), "1502 network");
    EXPECT_EQ(refusal(network_with("3")), "1502 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0]})")), "1502 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0], "segments": []})")), "1502 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"name": "rim", "start": [0, 0], "segments": [[1, 1], [1, 2, 3]]})")),
              "1505 curve 1 \"rim\", segment 2");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [[1, "1"]]})")), "1502 curve 1, segment 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [[1, 40001]]})")), "1503 curve 1, segment 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [[1, 1e999]]})")), "1503 ");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [], "width": 3})")), "1502 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [], "left": [0, 0, 2]})")), "1503 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [], "closed": 1})")), "1502 curve 1");
    EXPECT_EQ(refusal(network_with(R"({"start": [0, 0], "segments": [], "name": 1})")), "1502 curve 1");
}

/// Cut anywhere, or with any byte changed, a network is read or refused; nothing else happens.
TEST(NetworkReader, takesAnyBytes) {
    std::ifstream file(std::string(FETEXC_ART_DIR) + "/network/star.json");
    const std::string text = {std::istreambuf_iterator<char>(file), {}};
    for (std::size_t n = 0; n + 2 < text.size(); ++n)
        EXPECT_NE(refusal(text.substr(0, n)), "") << n;
    Random random(1);
    std::size_t refused = 0;
    for (int n = 0; n < 3000; ++n) {
        std::string other = text;
        other[static_cast<std::size_t>(random.between(0, static_cast<double>(text.size())))] =
            static_cast<char>(random.between(0, 256));
        refused += refusal(other).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_NE(refusal(std::string(200000, '[')), ""); // nesting takes no stack
}

CanvasSegment random_segment(Random& random, int degree) {
    CanvasSegment s;
    s.degree = degree;
    for (int k = 0; k <= degree; ++k)
        s.p[static_cast<std::size_t>(k)] = {random.between(0, 40), random.between(0, 20)};
    return s;
}

Network network_of_segment(const CanvasSegment& s) { return {40, 20, {{"", {s}, false, "", {}, {}}}}; }

/// Largest distance between a curve and pieces of it at the same parameter; pieces are equal steps.
double deviation(const CanvasSegment& s, const std::vector<CanvasSegment>& pieces) {
    double most = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        for (int n = 0; n <= 16; ++n) {
            const CanvasPoint a = bezier::point_at(s, (static_cast<double>(k) + n / 16.0) / pieces.size()),
                              b = bezier::point_at(pieces[k], n / 16.0);
            most = std::max(most, std::hypot(a.x - b.x, a.y - b.y));
        }
    }
    return most;
}

TEST(NetworkSimplify, staysWithinTheToleranceAndNotFarBelow) {
    Random random(7);
    for (const double tolerance : {1.0, 1e-2, 1e-4, 1e-6}) {
        double worst_quadratic = 0, worst_line = 0;
        for (int n = 0; n < 200; ++n) {
            const CanvasSegment s = random_segment(random, 3);
            const auto quadratics = to_quadratics(network_of_segment(s), tolerance),
                       lines = to_lines(network_of_segment(s), std::max(tolerance, 1e-4));
            ASSERT_TRUE(quadratics.ok() && lines.ok());
            worst_quadratic = std::max(worst_quadratic, deviation(s, quadratics.value().curves[0].segments));
            worst_line = std::max(worst_line, deviation(s, lines.value().curves[0].segments));
            for (const CanvasSegment& q : quadratics.value().curves[0].segments)
                EXPECT_LE(q.degree, 2);
        }
        EXPECT_LE(worst_quadratic, tolerance * (1 + 1e-9));
        EXPECT_GE(worst_quadratic, tolerance / 2); // the bound is attained but for sampling
        EXPECT_LE(worst_line, std::max(tolerance, 1e-4));
    }
}

TEST(NetworkSimplify, keepsEndsAndJointsExactly) {
    Random random(8);
    for (int n = 0; n < 200; ++n) {
        const CanvasSegment s = random_segment(random, 3);
        for (const auto& result : {to_quadratics(network_of_segment(s), 1e-3), to_lines(network_of_segment(s), 1e-3)}) {
            const auto& pieces = result.value().curves[0].segments;
            EXPECT_EQ(pieces.front().p[0].x, s.p[0].x);
            EXPECT_EQ(pieces.back().p[static_cast<std::size_t>(pieces.back().degree)].y, s.p[3].y);
            for (std::size_t k = 1; k < pieces.size(); ++k) {
                const CanvasPoint end = pieces[k - 1].p[static_cast<std::size_t>(pieces[k - 1].degree)];
                EXPECT_EQ(end.x, pieces[k].p[0].x);
                EXPECT_EQ(end.y, pieces[k].p[0].y);
            }
        }
    }
}

TEST(NetworkSimplify, linesAndProperQuadraticsStay) {
    Random random(9);
    const CanvasSegment line = random_segment(random, 1), quadratic = random_segment(random, 2);
    EXPECT_EQ(to_quadratics(network_of_segment(line), 1e-9).value().curves[0].segments.size(), 1u);
    EXPECT_EQ(to_quadratics(network_of_segment(quadratic), 1e-9).value().curves[0].segments[0].degree, 2);
    CanvasSegment folded = quadratic;
    folded.p[1] = folded.p[0];
    EXPECT_EQ(to_quadratics(network_of_segment(folded), 1e-9).value().curves[0].segments[0].degree, 1);
}

TEST(NetworkSimplify, refusesTooManyPieces) {
    const Network n = network_of_segment({3, {{{0, 0}, {1e4, 0}, {-1e4, 9}, {5, 5}}}});
    EXPECT_EQ(to_lines(n, 1e-14).error().code, diag::kNetworkTooLarge);
}

TEST(NetworkOfFeatures, tellsClosedFromOpen) {
    const CanvasSegment a{1, {{{0, 0}, {1, 0}}}}, b{2, {{{1, 0}, {2, 2}, {0, 0}}}}, point{1, {{{0, 0}, {0, 0}}}};
    const Network n = network_of(FeatureCurves{4, 3, {{a, b}, {a}, {point}, {a, point}}});
    ASSERT_EQ(n.curves.size(), 3u);
    EXPECT_TRUE(n.curves[0].closed);
    EXPECT_FALSE(n.curves[1].closed);
    EXPECT_EQ(n.curves[2].segments.size(), 1u);
    EXPECT_EQ(n.width, 4);
}

} // namespace
} // namespace fetexc
