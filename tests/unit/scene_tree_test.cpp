// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "compiler/diagnostics.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/scene/scene_builder.h"
#include "tests/support/random_shapes.h"

namespace fetexc {
namespace {

using test::rectangle;

/// A 100×100 canvas to which nodes are added by hand.
struct Drawing {
    SceneBuilder builder{100, 100};

    std::uint32_t shape(double x0, double y0, double x1, double y1) {
        return builder.add_shape({rectangle(x0, y0, x1, y1)}, FillRule::NonZero, kNone);
    }
    std::uint32_t solid(const Rgba& color) {
        builder.scene().paints.emplace_back(SolidPaint{color});
        return static_cast<std::uint32_t>(builder.scene().paints.size() - 1);
    }
    Node& fill(std::uint32_t shape_index, const Rgba& color = {1, 0, 0, 1}) {
        Node node;
        node.shape = shape_index;
        node.paint = solid(color);
        nodes().push_back(node);
        nodes().back().end = size();
        return nodes().back();
    }
    /// The group holds whatever `inside` adds.
    Node& group(const std::function<void()>& inside) {
        Node node;
        node.kind = Node::Kind::Group;
        const std::uint32_t at = size();
        nodes().push_back(node);
        inside();
        nodes()[at].end = size();
        return nodes()[at];
    }
    std::uint32_t clip(std::uint32_t shape_index, std::uint32_t parent = kNone) {
        builder.scene().clips.push_back({{{shape_index, kNone}}, parent});
        return static_cast<std::uint32_t>(builder.scene().clips.size() - 1);
    }
    /// The mask's content is whatever `inside` adds, right here among the nodes.
    std::uint32_t mask(const std::function<void()>& inside) {
        Mask mask;
        mask.first = size();
        inside();
        mask.end = size();
        builder.scene().masks.push_back(mask);
        return static_cast<std::uint32_t>(builder.scene().masks.size() - 1);
    }
    std::vector<Node>& nodes() { return builder.scene().nodes; }
    std::uint32_t size() { return static_cast<std::uint32_t>(nodes().size()); }
    Scene finish(bool cull = true) {
        Result<Scene> scene = builder.finish({cull});
        EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
        return scene.ok() ? std::move(scene).value() : Scene{};
    }
};

Rgba color_at(const Scene& scene, double x, double y) {
    const double unit = static_cast<double>(kLatticeSteps) / 100;
    return GroundTruth(scene).color_at(x * unit, y * unit);
}

void expect_color(const Rgba& actual, const Rgba& expected) {
    const double half_step = 0.5 / 255 + 1e-9;
    EXPECT_NEAR(actual.r, expected.r, half_step);
    EXPECT_NEAR(actual.g, expected.g, half_step);
    EXPECT_NEAR(actual.b, expected.b, half_step);
    EXPECT_NEAR(actual.a, expected.a, half_step);
}

// ---- flattening ----

TEST(Flatten, groupsWithoutEffectDisappear) {
    Drawing d;
    d.group([&] {
        d.group([&] { d.fill(d.shape(10, 10, 20, 20)); });
        d.group([&] {}).opacity = 0.5;
        d.fill(d.shape(30, 30, 40, 40));
    });
    const Scene scene = d.finish();
    ASSERT_EQ(scene.nodes.size(), 2u);
    for (std::uint32_t i = 0; i < 2; ++i) {
        EXPECT_EQ(scene.nodes[i].kind, Node::Kind::Fill);
        EXPECT_EQ(scene.nodes[i].end, i + 1);
    }
    EXPECT_EQ(scene.root_end, 2u);
}

TEST(Flatten, pureClipGroupsHandTheirClipDown) {
    Drawing d;
    const std::uint32_t outer = d.clip(d.shape(0, 0, 50, 100)), inner = d.clip(d.shape(0, 0, 100, 50));
    d.group([&] {
         d.group([&] {
              d.fill(d.shape(10, 10, 90, 90));
              d.fill(d.shape(10, 10, 90, 90), {0, 1, 0, 1}).clip = d.clip(d.shape(20, 20, 30, 30));
          }).clip = inner;
     }).clip = outer;
    const Scene scene = d.finish();
    ASSERT_EQ(scene.nodes.size(), 2u);
    expect_color(color_at(scene, 15, 15), {1, 0, 0, 1});
    expect_color(color_at(scene, 25, 25), {0, 1, 0, 1});
    expect_color(color_at(scene, 60, 25), {});
    expect_color(color_at(scene, 25, 60), {});
}

TEST(Flatten, opacityOverOneFillMovesIntoTheFill) {
    Drawing d;
    Node& group = d.group([&] { d.fill(d.shape(10, 10, 90, 90)).opacity = 0.5; });
    group.opacity = 0.5;
    group.clip = d.clip(d.shape(0, 0, 50, 50));
    const Scene scene = d.finish();
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].opacity, 0.25);
    expect_color(color_at(scene, 20, 20), {0.25, 0, 0, 0.25});
    expect_color(color_at(scene, 60, 60), {});
}

TEST(Flatten, opacityOverSeveralFillsStaysAGroup) {
    Drawing d;
    d.group([&] {
         d.fill(d.shape(10, 10, 60, 60));
         d.fill(d.shape(40, 40, 90, 90), {0, 0, 1, 1});
     }).opacity = 0.5;
    const Scene scene = d.finish();
    ASSERT_EQ(scene.nodes.size(), 3u);
    expect_color(color_at(scene, 50, 50), {0, 0, 0.5, 0.5}); // the red does not shine through the blue
}

TEST(Flatten, isolationIsKeptOnlyWhereSomethingBlends) {
    for (const bool blends : {false, true}) {
        Drawing d;
        d.fill(d.shape(0, 0, 100, 100), {0.5, 0.5, 0.5, 1});
        d.group([&] {
             d.group([&] {
                  d.fill(d.shape(10, 10, 90, 90), {0.5, 0.5, 0.5, 1});
                  d.fill(d.shape(10, 10, 20, 20), {0.5, 0.5, 0.5, 1});
              }).blend = blends ? Blend::Multiply : Blend::Normal;
         }).isolated = true;
        const Scene scene = d.finish();
        EXPECT_EQ(scene.nodes.size(), blends ? 5u : 3u);
        expect_color(color_at(scene, 50, 50), {0.5, 0.5, 0.5, 1});
    }
}

// ---- culling, with counts ----

TEST(Cull, emptyOutsideAndTransparentFillsGo) {
    Drawing d;
    const std::uint32_t visible = d.shape(10, 10, 20, 20);
    d.fill(d.builder.add_shape({}, FillRule::NonZero, kNone));
    d.fill(d.shape(-50, 10, 0, 20)); // touches the canvas border only
    d.fill(d.shape(10, 100, 20, 120));
    d.fill(visible, {1, 1, 1, 0});
    d.fill(visible).opacity = 0;
    d.group([&] { d.fill(visible); }).opacity = 0;
    d.fill(visible).clip = d.clip(d.shape(60, 60, 90, 90)); // nothing is left by the clip
    d.fill(visible);
    const Scene scene = d.finish();
    EXPECT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.shapes.size(), 1u);
    EXPECT_EQ(scene.paints.size(), 1u);
    EXPECT_TRUE(scene.clips.empty());
    EXPECT_EQ(scene.stats.layers_in, 8u);
    EXPECT_EQ(scene.stats.layers_empty, 1u);
    EXPECT_EQ(scene.stats.layers_outside, 3u);
    EXPECT_EQ(scene.stats.layers_transparent, 3u);
    EXPECT_EQ(scene.stats.layers_hidden, 0u);
}

TEST(Cull, opaqueRectanglesHideWhatLiesUnderThem) {
    Drawing d;
    d.fill(d.shape(10, 10, 20, 20)); // hidden
    d.group([&] { d.fill(d.shape(10, 10, 20, 20)), d.fill(d.shape(12, 12, 30, 30)); }).opacity =
        0.5;                                     // one of two hidden
    d.fill(d.shape(-20, 5, 25, 25));             // hidden: inside on the canvas
    d.fill(d.shape(0, 0, 26, 26), {0, 1, 0, 1}); // the cover
    d.fill(d.shape(10, 10, 20, 20));             // above
    const Scene scene = d.finish();
    EXPECT_EQ(scene.stats.layers_hidden, 3u);
    EXPECT_EQ(scene.nodes.size(), 3u);
    expect_color(color_at(scene, 28, 28), {0.5, 0, 0, 0.5});
}

TEST(Cull, coversMustBeOpaqueRectanglesAtRootLevel) {
    const auto hidden_under = [](const std::function<void(Drawing&)>& cover) {
        Drawing d;
        d.fill(d.shape(10, 10, 20, 20));
        cover(d);
        return d.finish().stats.layers_hidden;
    };
    const Rgba green{0, 1, 0, 1};
    EXPECT_EQ(hidden_under([&](Drawing& d) { d.fill(d.shape(0, 0, 30, 30), green); }), 1u);
    EXPECT_EQ(hidden_under([&](Drawing& d) { d.fill(d.shape(0, 0, 30, 30), {0, 1, 0, 0.99}); }), 0u);
    EXPECT_EQ(hidden_under([&](Drawing& d) { d.fill(d.shape(0, 0, 30, 30), green).opacity = 0.99; }), 0u);
    EXPECT_EQ(hidden_under([&](Drawing& d) { d.fill(d.shape(11, 0, 30, 30), green); }), 0u);
    EXPECT_EQ(
        hidden_under([&](Drawing& d) { d.fill(d.shape(0, 0, 30, 30), green).clip = d.clip(d.shape(0, 0, 15, 15)); }),
        0u);
    EXPECT_EQ(
        hidden_under([&](Drawing& d) {
            d.fill(d.builder.add_shape({test::polygon({{0, 0}, {40, 0}, {40, 1}, {0, 40}})}, FillRule::NonZero, kNone),
                   green);
        }),
        0u);
    EXPECT_EQ(hidden_under([&](Drawing& d) {
                  d.group([&] { d.fill(d.shape(0, 0, 30, 30), green), d.fill(d.shape(0, 0, 5, 5), green); }).blend =
                      Blend::Screen;
              }),
              0u);
}

TEST(Cull, switchedOffKeepsEveryLayer) {
    Drawing d;
    d.fill(d.shape(10, 10, 20, 20));
    d.fill(d.shape(-50, 10, -1, 20));
    d.fill(d.shape(0, 0, 100, 100));
    EXPECT_EQ(d.finish(false).nodes.size(), 3u);
}

// ---- masks and renumbering ----

TEST(Masks, contentMayLieAnywhereAmongTheNodes) {
    Drawing d;
    d.fill(d.shape(0, 0, 100, 100), {0, 1, 0, 1});
    std::uint32_t mask = kNone;
    Node& group = d.group([&] {
        mask = d.mask([&] { d.fill(d.shape(20, 20, 40, 40), {1, 1, 1, 1}); });
        d.fill(d.shape(10, 10, 90, 90), {0, 0, 1, 1});
    });
    group.mask = mask;
    const Scene scene = d.finish();
    EXPECT_EQ(scene.root_end, 3u);
    ASSERT_EQ(scene.masks.size(), 1u);
    EXPECT_EQ(scene.masks[0].first, 3u);
    EXPECT_EQ(scene.masks[0].end, 4u);
    expect_color(color_at(scene, 30, 30), {0, 0, 1, 1});
    expect_color(color_at(scene, 50, 50), {0, 1, 0, 1});
}

TEST(Masks, emptyMaskHidesItsGroup) {
    Drawing d;
    const std::uint32_t mask = d.mask([&] { d.fill(d.shape(200, 200, 300, 300), {1, 1, 1, 1}); });
    d.group([&] { d.fill(d.shape(10, 10, 90, 90)); }).mask = mask;
    const Scene scene = d.finish();
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_TRUE(scene.masks.empty());
    EXPECT_TRUE(scene.segments.empty());
}

TEST(Masks, constantValueIsOpacityAndParentsMultiply) {
    Drawing d;
    const std::uint32_t half = d.mask([&] { d.fill(d.shape(0, 0, 100, 100), {1, 1, 1, 0.5}); });
    const std::uint32_t green = d.mask([&] { d.fill(d.shape(0, 0, 100, 50), {0, 1, 0, 1}); });
    d.builder.scene().masks[green].parent = half;
    d.builder.scene().masks[green].region_shape = d.shape(0, 0, 50, 100);
    d.group([&] { d.fill(d.shape(10, 10, 90, 90)); }).mask = green;
    const Scene scene = d.finish();
    expect_color(color_at(scene, 30, 30), {0.3576, 0, 0, 0.3576});
    expect_color(color_at(scene, 30, 60), {});
    expect_color(color_at(scene, 60, 30), {}); // outside the mask's region
}

TEST(Renumber, unreferencedThingsGoAndTheRestIsFound) {
    Drawing d;
    for (int i = 0; i < 3; ++i)
        d.shape(1, 1, 2, 2), d.solid({0, 0, 0, 1});
    const std::uint32_t member = d.shape(0, 0, 50, 50);
    d.clip(d.shape(5, 5, 6, 6)); // not used
    const std::uint32_t used = d.clip(member);
    d.fill(d.shape(10, 10, 90, 90)).clip = used;
    const Scene scene = d.finish();
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.paints.size(), 1u);
    ASSERT_EQ(scene.clips.size(), 1u);
    EXPECT_EQ(scene.nodes[0].clip, 0u);
    EXPECT_EQ(scene.clips[0].members[0].shape, 0u);
    EXPECT_EQ(scene.nodes[0].shape, 1u);
    EXPECT_EQ(scene.segments.size(), 8u);
    EXPECT_EQ(scene.shapes[1].first, 4u);
}

// ---- invalid trees ----

struct InvalidCase {
    std::string name;
    int code;
    std::function<void(Drawing&)> spoil;
};

std::vector<InvalidCase> invalid_cases() {
    const double nan = std::nan("");
    return {
        {"shape index", diag::kSceneReferenceInvalid, [](Drawing& d) { d.fill(77); }},
        {"paint index", diag::kSceneReferenceInvalid, [](Drawing& d) { d.fill(0).paint = 77; }},
        {"no paint", diag::kSceneReferenceInvalid, [](Drawing& d) { d.fill(0).paint = kNone; }},
        {"clip index", diag::kSceneReferenceInvalid, [](Drawing& d) { d.fill(0).clip = 77; }},
        {"opacity", diag::kSceneReferenceInvalid, [nan](Drawing& d) { d.fill(0).opacity = nan; }},
        {"mask index", diag::kSceneReferenceInvalid, [](Drawing& d) { d.group([&] { d.fill(0); }).mask = 7; }},
        {"group end", diag::kSceneReferenceInvalid, [](Drawing& d) { d.group([&] { d.fill(0); }).end = 99; }},
        {"group end before itself", diag::kSceneReferenceInvalid, [](Drawing& d) { d.group([&] {}).end = 0; }},
        {"overlapping groups", diag::kSceneReferenceInvalid,
         [](Drawing& d) {
             d.group([&] { d.group([&] { d.fill(0); }); });
             d.fill(0);
             d.nodes()[d.size() - 3].end = d.size();
         }},
        {"clip member", diag::kSceneReferenceInvalid, [](Drawing& d) { d.clip(77); }},
        {"clip cycle", diag::kSceneTooLarge, [](Drawing& d) { d.clip(0, 0); }},
        {"mask range", diag::kSceneReferenceInvalid,
         [](Drawing& d) {
             d.builder.scene().masks.push_back({5, 3, true, false, kNone, kNone});
         }},
        {"mask in itself", diag::kSceneTooLarge,
         [](Drawing& d) { d.mask([&] { d.group([&] { d.fill(0); }).mask = 0; }); }},
        {"deep groups", diag::kSceneTooLarge,
         [](Drawing& d) {
             for (std::uint32_t i = 0; i < 1000; ++i) {
                 Node node;
                 node.kind = Node::Kind::Group;
                 node.end = 1001;
                 d.nodes().push_back(node);
             }
             d.fill(0);
             d.nodes().back().end = 1001;
             for (Node& node : d.nodes())
                 node.end = d.size();
         }},
        {"exploding masks", diag::kSceneTooLarge,
         [](Drawing& d) {
             for (std::uint32_t i = 0; i < 40; ++i)
                 d.mask([&] {
                     for (int k = 0; k < 2; ++k)
                         d.group([&] { d.fill(0); }).mask = i == 0 ? kNone : i - 1;
                 });
         }},
        {"colour", diag::kScenePaintInvalid,
         [nan](Drawing& d) {
             d.solid({nan, 0, 0, 1});
         }},
        {"no stops", diag::kScenePaintInvalid,
         [](Drawing& d) { d.builder.scene().paints.emplace_back(LinearPaint{}); }},
        {"unordered stops", diag::kScenePaintInvalid,
         [](Drawing& d) {
             LinearPaint paint;
             paint.stops = {{0.5, {}}, {0.4, {}}};
             d.builder.scene().paints.emplace_back(paint);
         }},
        {"short bitmap", diag::kScenePaintInvalid,
         [](Drawing& d) {
             RasterPaint paint;
             paint.width = paint.height = 2;
             paint.rgba.resize(15);
             d.builder.scene().paints.emplace_back(paint);
         }},
        {"bitmap size that overflows", diag::kScenePaintInvalid,
         [](Drawing& d) {
             RasterPaint paint;
             paint.width = paint.height = 1u << 31;
             d.builder.scene().paints.emplace_back(paint);
         }},
    };
}

TEST(Validate, refusesInconsistentTrees) {
    for (const InvalidCase& c : invalid_cases()) {
        SCOPED_TRACE(c.name);
        Drawing d;
        d.fill(d.shape(10, 10, 20, 20));
        c.spoil(d);
        const Result<Scene> scene = d.builder.finish();
        ASSERT_FALSE(scene.ok());
        EXPECT_EQ(scene.error().code, c.code) << scene.error().message;
    }
}

/// Exponentially many paths through shared sub-clips must not cost exponential time.
TEST(Clips, sharedSubClipsAreEvaluatedOnce) {
    Drawing d;
    const std::uint32_t shape = d.shape(0, 0, 100, 100);
    std::uint32_t clip = d.clip(d.shape(0, 0, 1, 1));
    for (int i = 0; i < 60; ++i) {
        d.builder.scene().clips.push_back({{{shape, clip}, {shape, clip}}, kNone});
        clip = static_cast<std::uint32_t>(d.builder.scene().clips.size() - 1);
    }
    d.fill(shape).clip = clip;
    const Scene scene = d.finish();
    expect_color(color_at(scene, 50, 50), {});
    expect_color(color_at(scene, 0.5, 0.5), {1, 0, 0, 1});
}

TEST(Clips, deepNestingOfClipGroupsKeepsItsMeaning) {
    Drawing d;
    const std::uint32_t half = d.shape(0, 0, 50, 100), all = d.shape(0, 0, 100, 100);
    std::function<void(int)> nest = [&](int depth) {
        const std::uint32_t chain = d.clip(all, d.clip(depth == 0 ? half : all, d.clip(all)));
        if (depth == 0)
            d.fill(d.shape(10, 10, 90, 90)).clip = chain;
        else
            d.group([&] { nest(depth - 1); }).clip = chain;
    };
    nest(400); // 1,200 clips in a row: more than one chain may hold
    const Scene scene = d.finish();
    expect_color(color_at(scene, 30, 30), {1, 0, 0, 1});
    expect_color(color_at(scene, 70, 30), {});
}

} // namespace
} // namespace fetexc
