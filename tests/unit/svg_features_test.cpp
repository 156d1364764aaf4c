// SPDX-License-Identifier: GPL-3.0-or-later
/// An SVG as features over an image: what becomes an edge.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "compiler/diagnostics.h"
#include "compiler/svg/svg.h"

namespace fetexc {
namespace {

std::vector<Diagnostic> diagnostics;

FeatureCurves features_of(const std::string& content, SvgCurves which = SvgCurves::Features) {
    diagnostics.clear();
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 40 20'>" + content + "</svg>";
    const std::vector<std::uint8_t> bytes(svg.begin(), svg.end());
    auto features = load_svg_features(bytes, {}, diagnostics, which);
    if (!features.ok()) throw std::runtime_error(features.error().message);
    return std::move(features).value();
}

void expect_point(const CanvasPoint& p, double x, double y) {
    EXPECT_NEAR(p.x, x, 1e-9);
    EXPECT_NEAR(p.y, y, 1e-9);
}

TEST(SvgFeatures, strokesWithoutFillAreTheirMiddle) {
    const FeatureCurves f = features_of("<path d='M1,2 L9,2 Q12,2 12,6' fill='none' stroke='red' stroke-width='3'/>");
    EXPECT_EQ(f.width, 40);
    EXPECT_EQ(f.height, 20);
    ASSERT_EQ(f.runs.size(), 1u);
    ASSERT_EQ(f.runs[0].size(), 2u); // open: nothing leads back
    EXPECT_EQ(f.runs[0][1].degree, 2);
    expect_point(f.runs[0][0].p[0], 1, 2);
    expect_point(f.runs[0][1].p[2], 12, 6);
}

TEST(SvgFeatures, closedPathsAndShapesStayClosed) {
    const FeatureCurves f =
        features_of("<g transform='translate(10 0)' fill='none' stroke='#000'><path d='M1,1 L5,1 L5,5 Z'/>"
                    "<rect x='8' y='2' width='3' height='4'/></g>");
    ASSERT_EQ(f.runs.size(), 2u);
    ASSERT_EQ(f.runs[0].size(), 3u);
    expect_point(f.runs[0][2].p[1], 11, 1);
    EXPECT_EQ(f.runs[1].size(), 4u);
}

TEST(SvgFeatures, fillsHaveEdgesAndClose) {
    const FeatureCurves f = features_of("<path d='M1,1 L5,1 L5,5'/>");
    ASSERT_EQ(f.runs.size(), 1u);
    EXPECT_EQ(f.runs[0].size(), 3u);
}

/// A stroke around a fill has a width: both of its edges are seen.
TEST(SvgFeatures, strokesOfFilledShapesAreOutlined) {
    const FeatureCurves f = features_of("<path d='M2,2 H12 V12 H2 Z' fill='red' stroke='blue' stroke-width='2'/>");
    ASSERT_EQ(f.runs.size(), 3u);
    double least = 40;
    for (const CanvasContour& run : f.runs) {
        for (const CanvasSegment& s : run)
            least = std::min(least, s.p[0].x);
    }
    EXPECT_NEAR(least, 1, 1e-9);
}

TEST(SvgFeatures, whatIsntDrawnIsNoFeature) {
    EXPECT_TRUE(features_of("<path d='M1,1 L5,5' fill='none'/><path d='M1,1 H5 V9 Z' display='none'/>").runs.empty());
}

TEST(SvgFeatures, bitmapsHaveNoEdges) {
    const std::string pixel =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNgAAAAAgABSK+kcQAAAABJRU5ErkJggg==";
    const FeatureCurves f = features_of("<image width='40' height='20' href='data:image/png;base64," + pixel +
                                        "'/><path d='M1,1 L5,5' fill='none' stroke='red'/>");
    EXPECT_EQ(f.runs.size(), 1u);
}

TEST(SvgFeatures, clipsAreSaidToBeIgnored) {
    const FeatureCurves f = features_of("<clipPath id='c'><path d='M0,0 H9 V9 Z'/></clipPath>"
                                        "<path clip-path='url(#c)' d='M1,1 L15,1 L15,5 Z'/>");
    EXPECT_EQ(f.runs.size(), 1u);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, diag::kFeaturesUnclipped);
}

TEST(SvgFeatures, strokesAndEdgesCanBeTakenAlone) {
    const std::string drawing = "<path d='M1,1 L5,1 L5,5 Z' fill='red' stroke='blue' stroke-width='1'/>"
                                "<path d='M8,2 L12,6' fill='none' stroke='blue' stroke-width='1'/>"
                                "<path d='M20,2 L25,6 L20,9 Z'/>";
    const FeatureCurves strokes = features_of(drawing, SvgCurves::Strokes);
    ASSERT_EQ(strokes.runs.size(), 2u);
    EXPECT_EQ(strokes.runs[0].size(), 3u);
    ASSERT_EQ(strokes.runs[1].size(), 1u); // open
    expect_point(strokes.runs[1][0].p[1], 12, 6);
    const FeatureCurves all = features_of(drawing, SvgCurves::All);
    ASSERT_EQ(all.runs.size(), 4u); // and the edges of two fills
    expect_point(all.runs[3][0].p[0], 20, 2);
    const FeatureCurves edges = features_of(drawing, SvgCurves::Edges);
    ASSERT_EQ(edges.runs.size(), 5u); // two fills, the outlines of a ring and of a line
    EXPECT_GE(edges.runs[3].size(), 4u);
}

} // namespace
} // namespace fetexc
