// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/culling.h"

#include <algorithm>

#include "compiler/scene/paint.h"

namespace fetexc {
namespace {

/// Covers remembered at a time; a drawing has few large opaque rectangles, and the largest hide most.
constexpr std::size_t kMaxCovers = 64;

LatticeBox canvas_box(const Scene& scene) { return {0, 0, scene.extent.lattice_w, scene.extent.lattice_h}; }

/// Touching the canvas border only is outside: no area of the canvas is covered.
bool has_area(const LatticeBox& box) { return box.x0 < box.x1 && box.y0 < box.y1; }

/// Per node: what clips above and on it leave of the canvas, and whether a group above has opacity 0.
struct Context {
    LatticeBox box;
    bool transparent = false;
};

Context child_context(const Scene& scene, const Node& node, Context context, ClipBoxes& clips) {
    if (node.clip != kNone) context.box = intersection(context.box, clips.box(node.clip));
    context.transparent = context.transparent || node.opacity <= 0;
    if (node.kind == Node::Kind::Fill)
        context.transparent = context.transparent || paint_is_invisible(scene.paints[node.paint]);
    return context;
}

bool classify_fill(Scene& scene, const LatticeBox& shape, const Context& context) {
    SceneStats& stats = scene.stats;
    std::uint64_t* counter = nullptr;
    if (shape.empty())
        counter = &stats.layers_empty;
    else if (context.transparent)
        counter = &stats.layers_transparent;
    else if (!has_area(intersection(shape, context.box)))
        counter = &stats.layers_outside;
    if (counter != nullptr) ++*counter;
    return counter != nullptr;
}

/// Four lines round an axis-aligned rectangle, either way.
bool is_rectangle(const Scene& scene, const Shape& shape) {
    if (shape.count != 4) return false;
    const Segment* s = &scene.segments[shape.first];
    for (int i = 0; i < 4; ++i) {
        const Segment& next = s[(i + 1) % 4];
        if (s[i].degree != 1 || s[i].p[1] != next.p[0]) return false;
        const bool horizontal = s[i].p[0].y == s[i].p[1].y, next_horizontal = next.p[0].y == next.p[1].y;
        const bool vertical = s[i].p[0].x == s[i].p[1].x;
        if (horizontal == vertical || horizontal == next_horizontal) return false;
    }
    return s[0].p[0] != s[1].p[1] && s[1].p[0] != s[2].p[1];
}

bool is_cover(const Scene& scene, const Node& node) {
    return node.kind == Node::Kind::Fill && node.clip == kNone && node.opacity >= 1 &&
           paint_is_opaque(scene.paints[node.paint]) && is_rectangle(scene, scene.shapes[node.shape]);
}

bool covers(const LatticeBox& cover, const LatticeBox& box) {
    return cover.x0 <= box.x0 && cover.y0 <= box.y0 && cover.x1 >= box.x1 && cover.y1 >= box.y1;
}

double area(const LatticeBox& box) {
    return static_cast<double>(box.x1 - box.x0) * static_cast<double>(box.y1 - box.y0);
}

void remember(std::vector<LatticeBox>& known, const LatticeBox& box) {
    if (known.size() < kMaxCovers) {
        known.push_back(box);
        return;
    }
    const auto smallest =
        std::min_element(known.begin(), known.end(), [](const auto& a, const auto& b) { return area(a) < area(b); });
    if (area(*smallest) < area(box)) *smallest = box;
}

/// One tree (the picture, or a mask's content), from the top down. Only direct children of the range can be covers:
/// inside a group the cover's colour still meets opacity, blending or masks.
void mark_hidden(Scene& scene, const std::vector<LatticeBox>& shapes, std::uint32_t first, std::uint32_t end,
                 std::vector<bool>& hidden) {
    std::vector<std::uint32_t> top_level;
    for (std::uint32_t i = first; i < end; i = scene.nodes[i].end)
        top_level.push_back(i);
    std::vector<LatticeBox> known;
    for (std::size_t k = top_level.size(); k-- > 0;) {
        for (std::uint32_t i = top_level[k]; i < scene.nodes[top_level[k]].end; ++i) {
            if (scene.nodes[i].kind != Node::Kind::Fill) continue;
            const LatticeBox box = intersection(shapes[scene.nodes[i].shape], canvas_box(scene));
            hidden[i] = std::any_of(known.begin(), known.end(), [&](const auto& cover) { return covers(cover, box); });
            if (hidden[i]) ++scene.stats.layers_hidden;
        }
        const Node& node = scene.nodes[top_level[k]];
        if (is_cover(scene, node)) remember(known, intersection(shapes[node.shape], canvas_box(scene)));
    }
}

} // namespace

std::vector<bool> find_invisible_fills(Scene& scene, const std::vector<LatticeBox>& shapes) {
    ClipBoxes clips(scene, shapes);
    std::vector<bool> drop(scene.nodes.size(), false);
    std::vector<std::pair<std::uint32_t, Context>> open; // group end, context of its children
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
        while (!open.empty() && open.back().first <= i)
            open.pop_back();
        const Context outer = open.empty() ? Context{canvas_box(scene), false} : open.back().second;
        const Node& node = scene.nodes[i];
        const Context context = child_context(scene, node, outer, clips);
        if (node.kind == Node::Kind::Group)
            open.emplace_back(node.end, context);
        else
            drop[i] = classify_fill(scene, shapes[node.shape], context);
    }
    return drop;
}

std::vector<bool> find_hidden_fills(Scene& scene, const std::vector<LatticeBox>& shapes) {
    std::vector<bool> hidden(scene.nodes.size(), false);
    mark_hidden(scene, shapes, 0, scene.root_end, hidden);
    for (const Mask& mask : scene.masks)
        mark_hidden(scene, shapes, mask.first, mask.end, hidden);
    return hidden;
}

} // namespace fetexc
