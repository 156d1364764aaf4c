// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <vector>

#include "compiler/scene/blend.h"
#include "compiler/scene/compositor.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/paint.h"
#include "compiler/scene/stack.h"
#include "tests/support/random_scene.h"

namespace fetexc {
namespace {

using test::Random;
using test::random_scene;
using test::random_scene_builder;
using test::RandomSceneOptions;

constexpr double kHalfStep = 0.5 / 255 + 1e-9;

double difference(const Rgba& a, const Rgba& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

// ---- a plain recursive evaluation of the tree as the front end gave it ----

/// No reduction, no flattening, no index: what scene.h says, word by word. Picture first, mask contents behind it.
class Naive {
  public:
    Naive(const Scene& input, std::set<std::uint32_t> inside, CanvasPoint p)
        : scene_(input), inside_(std::move(inside)), p_(p) {}

    [[nodiscard]] Rgba picture() const {
        std::uint32_t end = static_cast<std::uint32_t>(scene_.nodes.size());
        for (const Mask& mask : scene_.masks)
            end = std::min(end, mask.first);
        Rgba out;
        paint_range(0, end, true, out);
        return out;
    }

  private:
    [[nodiscard]] bool in_clip(std::uint32_t i) const {
        if (i == kNone) return true;
        const Clip& clip = scene_.clips[i];
        bool any = false;
        for (const ClipMember& member : clip.members)
            any = any || (inside_.count(member.shape) != 0 && in_clip(member.clip));
        return any && in_clip(clip.parent);
    }

    [[nodiscard]] double mask_at(std::uint32_t i) const {
        if (i == kNone) return 1;
        const Mask& mask = scene_.masks[i];
        Rgba color;
        if (mask.region_shape == kNone || inside_.count(mask.region_shape) != 0)
            paint_range(mask.first, mask.end, true, color);
        return mask_value(mask.luminance, mask.linear_rgb, color) * mask_at(mask.parent);
    }

    void paint_range(std::uint32_t first, std::uint32_t end, bool clipped_in, Rgba& below) const {
        for (std::uint32_t i = first; i < end; i = scene_.nodes[i].end)
            paint_node(i, clipped_in && in_clip(scene_.nodes[i].clip), below);
    }

    void paint_node(std::uint32_t i, bool visible, Rgba& below) const {
        const Node& node = scene_.nodes[i];
        if (node.kind == Node::Kind::Fill) {
            if (!visible || inside_.count(node.shape) == 0) return;
            below = over(below, scaled(paint_color(scene_.paints[node.paint], p_), node.opacity));
            return;
        }
        const bool composited = node.opacity < 1 || node.blend != Blend::Normal || node.mask != kNone || node.isolated;
        if (!composited) return paint_range(i + 1, node.end, visible, below);
        Rgba content;
        paint_range(i + 1, node.end, visible, content);
        below = blend_over(below, scaled(content, node.opacity * mask_at(node.mask)), node.blend);
    }

    const Scene& scene_;
    std::set<std::uint32_t> inside_;
    CanvasPoint p_;
};

/// The builder's shapes, each filled plainly, so that GroundTruth::inside speaks of the builder's shape indices.
Scene shapes_only(SceneBuilder builder) {
    Scene& scene = builder.scene();
    scene.nodes.clear();
    scene.masks.clear();
    scene.clips.clear();
    scene.paints = {SolidPaint{{1, 1, 1, 1}}};
    for (std::uint32_t i = 0; i < builder.shape_count(); ++i) {
        Node node;
        node.shape = i;
        node.paint = 0;
        scene.nodes.push_back(node);
    }
    Result<Scene> out = builder.finish({false});
    EXPECT_TRUE(out.ok());
    return std::move(out).value();
}

struct Comparison {
    int points = 0, visible = 0, varying = 0;
};

void compare_with_naive(std::uint64_t seed, const RandomSceneOptions& options, Comparison& result) {
    SceneBuilder builder = random_scene_builder(seed, options);
    const Scene plain = shapes_only(builder);
    const Scene input = builder.scene();
    const Result<Scene> finished = builder.finish({options.cull});
    ASSERT_TRUE(finished.ok());
    const GroundTruth shapes(plain), truth(finished.value());
    Compositor compositor(finished.value());
    Random random(seed + 1000);
    for (int i = 0; i < 60; ++i) {
        const double x = random.unit() * double(plain.extent.lattice_w),
                     y = random.unit() * double(plain.extent.lattice_h);
        const CanvasPoint p = to_canvas(plain.extent, x, y);
        const std::vector<std::uint32_t> inside = shapes.inside(x, y);
        const Rgba expected = Naive(input, {inside.begin(), inside.end()}, p).picture();
        const ResultId id = truth.result_at(compositor, x, y);
        const double error = difference(compositor.color(id, p), expected);
        EXPECT_LE(error, compositor.is_solid(id) ? kHalfStep : 1e-9) << "seed " << seed << " at " << p.x << "," << p.y;
        EXPECT_EQ(difference(truth.color_at(x, y), compositor.color(id, p)), 0);
        ++result.points;
        result.visible += expected.a > 0 ? 1 : 0;
        result.varying += compositor.is_solid(id) ? 0 : 1;
    }
}

TEST(Compositor, equalsTheNaiveEvaluationOnEverything) {
    for (const bool cull : {true, false}) {
        Comparison result;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            RandomSceneOptions options = test::everything(10 + static_cast<int>(seed % 30));
            options.cull = cull;
            compare_with_naive(seed, options, result);
        }
        EXPECT_GT(result.visible, result.points / 2);
        EXPECT_GT(result.varying, result.points / 20);
    }
}

TEST(Compositor, equalsTheNaiveEvaluationOnFlatScenes) {
    Comparison result;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        RandomSceneOptions options;
        options.space.height = 40;
        options.layers = 30;
        options.cover = 0.1;
        compare_with_naive(seed, options, result);
    }
    EXPECT_GT(result.visible, result.points / 2);
}

TEST(Culling, doesNotChangeWhatIsSeen) {
    std::uint64_t culled = 0, hidden = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        RandomSceneOptions options = seed % 2 == 0 ? test::everything(25) : RandomSceneOptions{};
        options.cover = 0.1;
        const Scene with = random_scene(seed, options);
        options.cull = false;
        const Scene without = random_scene(seed, options);
        const GroundTruth truth_with(with), truth_without(without);
        culled += without.nodes.size() - with.nodes.size();
        hidden += with.stats.layers_hidden;
        Random random(seed);
        for (int i = 0; i < 50; ++i) {
            const double x = random.unit() * double(kLatticeSteps), y = random.unit() * double(kLatticeSteps);
            EXPECT_LE(difference(truth_with.color_at(x, y), truth_without.color_at(x, y)), 1.0 / 255 + 1e-9)
                << "seed " << seed;
        }
    }
    EXPECT_GT(culled, 200u);
    EXPECT_GT(hidden, 100u);
}

// ---- identities ----

/// Fills over the whole canvas, so that every subset of shapes can be asked for by hand.
struct Stacked {
    Scene scene;
    std::uint32_t add(const Paint& paint, double opacity = 1) {
        const auto i = static_cast<std::uint32_t>(scene.shapes.size());
        scene.shapes.push_back({});
        scene.paints.push_back(paint);
        Node node;
        node.shape = node.paint = i;
        node.opacity = opacity;
        node.end = i + 1;
        scene.nodes.push_back(node);
        scene.root_end = i + 1;
        return i;
    }
};

LinearPaint gradient(double alpha) {
    LinearPaint paint;
    paint.canvas_to_unit = {0.01, 0, 0, 0.01, 0, 0};
    paint.stops = {{0, {1, 0, 0, alpha}}, {1, {0, 0, 1, alpha}}};
    return paint;
}

TEST(Identity, equalSolidColoursAreOneResult) {
    Stacked s;
    s.add(SolidPaint{{1, 0, 0, 1}});
    s.add(SolidPaint{{1, 0, 0, 1}});
    s.add(SolidPaint{{0, 1, 0, 1}});
    s.add(SolidPaint{{1, 0, 0, 0.5}});
    Compositor c(s.scene);
    const auto id = [&c](std::vector<std::uint32_t> inside) { return c.resolve(inside); };
    EXPECT_EQ(id({0}), id({1}));
    EXPECT_EQ(id({0}), id({0, 3}));
    EXPECT_EQ(id({0, 2}), id({2}));
    EXPECT_NE(id({0}), id({2}));
    EXPECT_NE(id({0}), id({}));
    EXPECT_NE(id({2, 3}), id({2}));
    EXPECT_TRUE(c.is_solid(id({})));
    EXPECT_EQ(c.color(id({}), {}), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(c.color(id({3}), {}), (Rgba{128 / 255.0, 0, 0, 128 / 255.0}));
}

/// 1 − (1−a)(1−b) is 1/2 for each pair, and 127.5 rounds the same way however it was reached.
TEST(Identity, tiesRoundTheSameWay) {
    int below = 0;
    for (const double a : {0.2, 0.25, 0.3, 0.4, 0.1, 0.15, 0.35, 0.45, 0.05, 0.12}) {
        const double b = 1 - 0.5 / (1 - a);
        below += over({0, 0, 0, a}, {0, 0, 0, b}).a < 0.5 ? 1 : 0;
        Stacked s;
        s.add(SolidPaint{{0, 0, 0, 0.5}});
        s.add(SolidPaint{{0, 0, 0, a}});
        s.add(SolidPaint{{0, 0, 0, b}});
        Compositor c(s.scene);
        EXPECT_EQ(c.resolve(std::vector<std::uint32_t>{0}), c.resolve(std::vector<std::uint32_t>{1, 2})) << a;
    }
    EXPECT_GT(below, 0) << "no case reaches the tie from below: the test shows nothing";
}

TEST(Identity, whatLiesUnderAnOpaqueGradientDoesNotMatter) {
    Stacked s;
    s.add(SolidPaint{{1, 0, 0, 1}});
    s.add(gradient(1));
    s.add(SolidPaint{{0, 1, 0, 0.5}});
    s.add(gradient(0.5));
    Compositor c(s.scene);
    const auto id = [&c](std::vector<std::uint32_t> inside) { return c.resolve(inside); };
    EXPECT_EQ(id({0, 1}), id({1}));
    EXPECT_EQ(id({0, 1, 2}), id({1, 2}));
    EXPECT_NE(id({1, 2}), id({1}));
    EXPECT_NE(id({0, 3}), id({3})); // translucent: the red shines through
    EXPECT_FALSE(c.is_solid(id({1})));
    const Rgba middle = c.color(id({1, 2}), {50, 0});
    EXPECT_LE(difference(middle, {0.25, 0.5, 0.25, 1}), 1e-12);
}

TEST(Identity, samePaintAndOpacityThroughDifferentFillsIsOneResult) {
    Stacked s;
    s.add(gradient(1));
    s.add(gradient(1));
    s.scene.nodes[1].paint = 0;
    Compositor c(s.scene);
    EXPECT_EQ(c.resolve(std::vector<std::uint32_t>{0}), c.resolve(std::vector<std::uint32_t>{1}));
    s.scene.nodes[1].opacity = 0.5;
    Compositor other(s.scene);
    EXPECT_NE(other.resolve(std::vector<std::uint32_t>{0}), other.resolve(std::vector<std::uint32_t>{1}));
}

/// Over many random scenes: equal ids show equal colours everywhere, different solid ids differ.
TEST(Identity, idsAgreeWithColours) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Scene scene = random_scene(seed, test::everything(20));
        const GroundTruth truth(scene);
        Compositor c(scene);
        std::map<ResultId, Rgba> at_origin;
        std::map<std::array<double, 4>, ResultId> solids;
        Random random(seed);
        for (int i = 0; i < 100; ++i) {
            const ResultId id =
                truth.result_at(c, random.unit() * double(kLatticeSteps), random.unit() * double(kLatticeSteps));
            const Rgba color = c.color(id, {3, 5});
            EXPECT_EQ(at_origin.try_emplace(id, color).first->second, color);
            if (!c.is_solid(id)) continue;
            EXPECT_EQ(solids.try_emplace({color.r, color.g, color.b, color.a}, id).first->second, id);
        }
    }
}

// ---- threads ----

TEST(Compositor, isThreadSafeAndItsColoursDoNotDependOnTheOrderOfCalls) {
    const Scene scene = random_scene(5, test::everything(40));
    const GroundTruth truth(scene);
    Random random(1);
    std::vector<CanvasPoint> points;
    for (int i = 0; i < 2000; ++i)
        points.push_back({random.unit() * double(kLatticeSteps), random.unit() * double(kLatticeSteps)});
    Compositor reference(scene), shared(scene);
    const auto colors = [&](Compositor& c, bool backwards, std::vector<Rgba>& out) {
        out.resize(points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::size_t i = backwards ? points.size() - 1 - k : k;
            out[i] = c.color(truth.result_at(c, points[i].x, points[i].y),
                             to_canvas(scene.extent, points[i].x, points[i].y));
        }
    };
    std::vector<Rgba> expected, first, second;
    colors(reference, false, expected);
    std::thread a([&] { colors(shared, false, first); }), b([&] { colors(shared, true, second); });
    a.join();
    b.join();
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(first[i], expected[i]);
        EXPECT_EQ(second[i], expected[i]);
    }
}

TEST(RandomScene, isTheSameForTheSameSeed) {
    const Scene a = random_scene(17, test::everything(30)), b = random_scene(17, test::everything(30));
    const Scene other = random_scene(18, test::everything(30));
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t i = 0; i < a.segments.size(); ++i)
        EXPECT_EQ(a.segments[i].p, b.segments[i].p);
    EXPECT_NE(a.segments.size(), other.segments.size());
}

} // namespace
} // namespace fetexc
