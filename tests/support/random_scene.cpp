// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace fetexc::test {
namespace {

constexpr int kMaxGroupDepth = 4;

class SceneMaker {
  public:
    SceneMaker(std::uint64_t seed, const RandomSceneOptions& options)
        : random_(seed), options_(options), builder_(options.space.width, options.space.height) {}

    SceneBuilder run() {
        std::vector<Node> picture;
        add_layers(options_.layers, 0, picture);
        append(picture);
        // mask contents lie behind the picture; a content may ask for further masks
        for (std::size_t i = 0; i < contents_.size(); ++i) {
            Mask& mask = builder_.scene().masks[i];
            mask.first = static_cast<std::uint32_t>(builder_.scene().nodes.size());
            append(contents_[i]);
            mask.end = static_cast<std::uint32_t>(builder_.scene().nodes.size());
        }
        return std::move(builder_);
    }

  private:
    void append(const std::vector<Node>& nodes) {
        std::vector<Node>& all = builder_.scene().nodes;
        const auto offset = static_cast<std::uint32_t>(all.size());
        for (Node node : nodes) {
            node.end += offset;
            all.push_back(node);
        }
    }

    void add_layers(int count, int depth, std::vector<Node>& out) {
        while (count > 0) {
            if (depth < kMaxGroupDepth && random_.chance(options_.group)) {
                const int inner = random_.integer(0, count);
                add_group(inner, depth, out);
                count -= inner;
            } else {
                count -= add_fills(out);
            }
        }
    }

    void add_group(int count, int depth, std::vector<Node>& out) {
        const std::size_t at = out.size();
        Node group;
        group.kind = Node::Kind::Group;
        if (random_.chance(options_.group_opacity)) group.opacity = random_.between(0.2, 0.9);
        if (random_.chance(0.05)) group.opacity = 0;
        if (random_.chance(options_.group_clip)) group.clip = new_clip(0);
        if (random_.chance(options_.group_blend)) group.blend = static_cast<Blend>(random_.integer(0, 15));
        if (random_.chance(options_.group_mask)) group.mask = new_mask(depth);
        group.isolated = random_.chance(options_.group_isolated);
        out.push_back(group);
        add_layers(count, depth + 1, out);
        out[at].end = static_cast<std::uint32_t>(out.size());
    }

    /// Returns how many fills were added: a partition gives several.
    int add_fills(std::vector<Node>& out) {
        const std::vector<std::uint32_t> shapes = next_shapes();
        for (std::uint32_t shape : shapes) {
            Node fill;
            fill.shape = shape;
            fill.paint = new_paint_index();
            if (random_.chance(options_.translucent / 2)) fill.opacity = random_.between(0, 1);
            if (random_.chance(options_.clip)) fill.clip = new_clip(0);
            fill.end = static_cast<std::uint32_t>(out.size()) + 1;
            out.push_back(fill);
        }
        return static_cast<int>(shapes.size());
    }

    std::vector<std::uint32_t> next_shapes() {
        if (!known_.empty() && random_.chance(options_.copied)) {
            const std::uint32_t shape = known_shape();
            return {random_.chance(0.5) ? shape : add(known_[shape])};
        }
        if (!known_.empty() && random_.chance(options_.reversed)) return {add(reversed(known_[known_shape()]))};
        if (random_.chance(options_.cover)) {
            const double half = random_.chance(0.5) ? 0.5 : 1.0;
            return {add({rectangle(0, 0, options_.space.width * half, options_.space.height)})};
        }
        std::vector<std::uint32_t> out;
        for (const Contours& contours : random_shapes(random_, options_.mix, options_.space))
            out.push_back(add(contours));
        return out;
    }

    std::uint32_t add(Contours contours) { // a copy: the argument may lie in known_
        const FillRule rule = random_.chance(options_.even_odd) ? FillRule::EvenOdd : FillRule::NonZero;
        const std::uint32_t shape = builder_.add_shape(contours, rule, kNone);
        known_.push_back(std::move(contours));
        return shape;
    }

    std::uint32_t known_shape() {
        return static_cast<std::uint32_t>(random_.integer(0, static_cast<int>(known_.size()) - 1));
    }

    std::uint32_t some_shape() {
        if (known_.empty() || random_.chance(0.5)) return next_shapes().front();
        return known_shape();
    }

    Rgba new_color() {
        // few levels, so that different stacks often give the same colour
        Rgba c{random_.integer(0, 5) / 5.0, random_.integer(0, 5) / 5.0, random_.integer(0, 5) / 5.0, 1};
        if (random_.chance(options_.translucent)) c.a = random_.integer(0, 4) / 4.0;
        return c;
    }

    std::vector<GradientStop> new_stops() {
        std::vector<GradientStop> out;
        double offset = random_.integer(0, 1) * 0.2;
        for (int i = random_.integer(1, 4); i > 0; --i) {
            out.push_back({offset, new_color()});
            offset = std::min(1.0, offset + random_.integer(0, 3) * 0.2);
        }
        return out;
    }

    Affine new_affine(double scale) {
        const double angle = random_.between(0, 6.28), size = scale * std::exp2(random_.between(-1, 1));
        const double c = std::cos(angle) * size, s = std::sin(angle) * size;
        const double e = random_.between(-1, 1), f = random_.between(-1, 1);
        return {c, s, -s, c, e, f};
    }

    Paint new_paint() {
        const double unit = 1 / std::max(options_.space.width, options_.space.height);
        const auto spread = static_cast<Spread>(random_.integer(0, 2));
        if (random_.chance(options_.raster)) return new_raster(4 * unit);
        if (!random_.chance(options_.gradient)) return SolidPaint{new_color()};
        if (random_.chance(0.5)) {
            const Affine frame = new_affine(unit);
            return LinearPaint{frame, new_stops(), spread};
        }
        RadialPaint paint;
        paint.canvas_to_gradient = new_affine(2 * unit);
        paint.r = random_.between(0.2, 1);
        paint.fx = random_.between(-0.9, 0.9) * paint.r;
        paint.fr = random_.chance(0.3) ? random_.between(0, 0.5) : 0;
        paint.stops = new_stops();
        paint.spread = spread;
        return paint;
    }

    Paint new_raster(double scale) {
        RasterPaint paint;
        paint.width = static_cast<std::uint32_t>(random_.integer(1, 5));
        paint.height = static_cast<std::uint32_t>(random_.integer(1, 5));
        for (std::uint32_t i = 0; i < paint.width * paint.height; ++i) {
            const int alpha = random_.chance(0.5) ? 255 : random_.integer(0, 255);
            for (int c = 0; c < 3; ++c)
                paint.rgba.push_back(static_cast<std::uint8_t>(random_.integer(0, alpha)));
            paint.rgba.push_back(static_cast<std::uint8_t>(alpha));
        }
        paint.canvas_to_pixel = new_affine(scale);
        paint.smooth = random_.chance(0.5);
        return paint;
    }

    std::uint32_t new_paint_index() {
        builder_.scene().paints.push_back(new_paint());
        return static_cast<std::uint32_t>(builder_.scene().paints.size() - 1);
    }

    std::uint32_t new_clip(int depth) {
        Clip clip;
        for (int i = random_.integer(random_.chance(0.05) ? 0 : 1, 2); i > 0; --i) {
            ClipMember member{some_shape(), kNone};
            if (depth < 2 && random_.chance(0.2)) member.clip = new_clip(depth + 1);
            clip.members.push_back(member);
        }
        if (depth < 2 && random_.chance(0.2)) clip.parent = new_clip(depth + 1);
        builder_.scene().clips.push_back(clip);
        return static_cast<std::uint32_t>(builder_.scene().clips.size() - 1);
    }

    std::uint32_t new_mask(int depth) {
        Mask mask;
        mask.luminance = random_.chance(0.6);
        mask.linear_rgb = random_.chance(0.3);
        if (random_.chance(0.3)) mask.region_shape = some_shape();
        if (depth < 2 && random_.chance(0.2)) mask.parent = new_mask(depth + 1);
        std::vector<Node> content;
        add_layers(random_.integer(0, 3), std::max(depth + 1, kMaxGroupDepth - 1), content);
        const auto index = static_cast<std::uint32_t>(contents_.size());
        builder_.scene().masks.push_back(mask);
        contents_.push_back(std::move(content));
        return index;
    }

    Random random_;
    const RandomSceneOptions& options_;
    SceneBuilder builder_;
    std::vector<Contours> known_;             ///< by shape index
    std::vector<std::vector<Node>> contents_; ///< per mask
};

} // namespace

RandomSceneOptions everything(int layers) {
    RandomSceneOptions options;
    options.layers = layers;
    options.group = 0.35;
    options.clip = 0.15;
    options.raster = 0.05;
    return options;
}

RandomSceneOptions opaque_solids(int layers) {
    RandomSceneOptions options;
    options.layers = layers;
    options.translucent = 0;
    options.gradient = 0;
    return options;
}

SceneBuilder random_scene_builder(std::uint64_t seed, const RandomSceneOptions& options) {
    return SceneMaker(seed, options).run();
}

Scene random_scene(std::uint64_t seed, const RandomSceneOptions& options) {
    SceneBuilderOptions finish;
    finish.cull = options.cull;
    Result<Scene> scene = random_scene_builder(seed, options).finish(finish);
    if (scene) return std::move(scene).value();
    std::fprintf(stderr, "random scene %llu: %s\n", static_cast<unsigned long long>(seed),
                 scene.error().message.c_str());
    std::abort();
}

} // namespace fetexc::test
