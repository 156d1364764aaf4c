// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/stack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "compiler/scene/blend.h"
#include "compiler/scene/paint.h"

namespace fetexc {
namespace {

using Kind = StackItem::Kind;

bool is_opaque(const Scene& scene, const StackItem& item) {
    if (item.kind == Kind::Solid) return item.color.a >= 1;
    return item.kind == Kind::Painted && item.opacity >= 1 && paint_is_opaque(scene.paints[item.paint]);
}

bool is_invisible(const StackItem& item) {
    switch (item.kind) {
    case Kind::Solid:
        return item.color.a <= 0;
    case Kind::Painted:
        return item.opacity <= 0;
    case Kind::Group:
        return item.opacity <= 0 || item.content.empty();
    }
    return false;
}

/// A solid merges with a solid below it: blending needs the whole backdrop, source-over is associative.
bool folds_into_top(const Stack& stack, const StackItem& item) {
    if (stack.empty() || item.kind != Kind::Solid) return false;
    const StackItem& top = stack.back();
    if (top.kind != Kind::Solid || top.blend != Blend::Normal) return false;
    return item.blend == Blend::Normal || stack.size() == 1;
}

/// What an item without varying masks and with a single plain child is by itself.
std::optional<StackItem> as_single_item(const StackItem& group) {
    if (!group.masks.empty() || group.content.size() != 1) return {};
    StackItem item = group.content.front();
    if (item.kind == Kind::Solid)
        item.color = scaled(item.color, group.opacity);
    else
        item.opacity *= group.opacity;
    item.blend = group.blend;
    return item;
}

/// The bottom item of an isolated group is Normal by construction; above it blending would see a different backdrop.
bool dissolves(const StackItem& group) {
    const auto is_normal = [](const StackItem& item) { return item.blend == Blend::Normal; };
    return group.masks.empty() && group.opacity >= 1 && group.blend == Blend::Normal &&
           std::all_of(group.content.begin(), group.content.end(), is_normal);
}

double to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

Rgba item_color(const Scene& scene, const StackItem& item, CanvasPoint p) {
    if (item.kind == Kind::Solid) return item.color;
    if (item.kind == Kind::Painted) return scaled(paint_color(scene.paints[item.paint], p), item.opacity);
    double factor = item.opacity;
    for (const MaskFactor& mask : item.masks)
        factor *= mask_value(mask.luminance, mask.linear_rgb, stack_color(scene, mask.content, p));
    return factor > 0 ? scaled(stack_color(scene, item.content, p), factor) : Rgba{};
}

void append_item_key(const StackItem& item, std::vector<std::uint64_t>& key) {
    key.push_back(static_cast<std::uint64_t>(item.kind) | static_cast<std::uint64_t>(item.blend) << 8 |
                  static_cast<std::uint64_t>(item.masks.size()) << 16);
    switch (item.kind) {
    case Kind::Solid:
        for (double v : {item.color.r, item.color.g, item.color.b, item.color.a})
            key.push_back(std::bit_cast<std::uint64_t>(v));
        break;
    case Kind::Painted:
        key.push_back(item.paint);
        key.push_back(std::bit_cast<std::uint64_t>(item.opacity));
        break;
    case Kind::Group:
        key.push_back(std::bit_cast<std::uint64_t>(item.opacity));
        append_key(item.content, key);
        for (const MaskFactor& mask : item.masks) {
            key.push_back((mask.luminance ? 1u : 0u) | (mask.linear_rgb ? 2u : 0u));
            append_key(mask.content, key);
        }
        break;
    }
}

} // namespace

StackItem solid_item(const Rgba& color) {
    StackItem item;
    item.color = color;
    return item;
}

StackItem paint_item(const Scene& scene, std::uint32_t paint, double opacity) {
    if (const std::optional<Rgba> color = constant_color(scene.paints[paint]))
        return solid_item(scaled(*color, opacity));
    StackItem item;
    item.kind = Kind::Painted;
    item.paint = paint;
    item.opacity = opacity;
    return item;
}

void push_item(const Scene& scene, Stack& stack, StackItem item) {
    if (is_invisible(item)) return;
    if (stack.empty()) item.blend = Blend::Normal; // over transparent black every mode gives the source
    if (item.blend == Blend::Normal && is_opaque(scene, item)) stack.clear();
    if (!folds_into_top(stack, item)) {
        stack.push_back(std::move(item));
        return;
    }
    stack.back().color = blend_over(stack.back().color, item.color, item.blend);
}

void push_group(const Scene& scene, Stack& stack, StackItem group) {
    if (is_invisible(group)) return;
    if (std::optional<StackItem> single = as_single_item(group)) return push_item(scene, stack, std::move(*single));
    if (!dissolves(group)) return push_item(scene, stack, std::move(group));
    for (StackItem& item : group.content)
        push_item(scene, stack, std::move(item));
}

std::optional<Rgba> solid_color(const Stack& stack) {
    if (stack.empty()) return Rgba{};
    if (stack.size() == 1 && stack.front().kind == Kind::Solid) return stack.front().color;
    return {};
}

Rgba stack_color(const Scene& scene, const Stack& stack, CanvasPoint p) {
    Rgba color;
    for (const StackItem& item : stack)
        color = blend_over(color, item_color(scene, item, p), item.blend);
    return color;
}

double mask_value(bool luminance, bool linear_rgb, const Rgba& c) {
    if (!luminance || c.a <= 0) return std::clamp(c.a, 0.0, 1.0);
    Rgba s{c.r / c.a, c.g / c.a, c.b / c.a, c.a};
    if (linear_rgb) s = {to_linear(s.r), to_linear(s.g), to_linear(s.b), s.a};
    return std::clamp((0.2126 * s.r + 0.7152 * s.g + 0.0722 * s.b) * s.a, 0.0, 1.0);
}

void append_key(const Stack& stack, std::vector<std::uint64_t>& key) {
    key.push_back(stack.size());
    for (const StackItem& item : stack)
        append_item_key(item, key);
}

} // namespace fetexc
