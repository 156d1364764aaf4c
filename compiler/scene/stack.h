// SPDX-License-Identifier: GPL-3.0-or-later
/// Reduced paint stacks: what is left to see in a region, bottom first, as a value that can be evaluated and compared.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

struct StackItem;
using Stack = std::vector<StackItem>;

/// A factor that varies over the region: the mask content's colour turned into a number.
struct MaskFactor;

/// One thing composited onto what lies below it in the same stack.
struct StackItem {
    enum class Kind : std::uint8_t { Solid, Painted, Group };
    Kind kind = Kind::Solid;
    Blend blend = Blend::Normal;
    Rgba color;                    ///< Solid: premultiplied
    std::uint32_t paint = kNone;   ///< Painted: index into Scene::paints
    double opacity = 1;            ///< Painted, Group
    Stack content;                 ///< Group: composited in isolation
    std::vector<MaskFactor> masks; ///< Group: all multiply the content
};

struct MaskFactor {
    bool luminance = true, linear_rgb = false;
    Stack content;
};

[[nodiscard]] StackItem solid_item(const Rgba& premultiplied_color);
[[nodiscard]] StackItem paint_item(const Scene& scene, std::uint32_t paint, double opacity);

/// Puts an item on top and reduces: invisible items vanish, opaque ones clear what they hide, solids fold together.
void push_item(const Scene& scene, Stack& stack, StackItem item);

/// Puts a group on top, dissolving it where that changes nothing.
void push_group(const Scene& scene, Stack& stack, StackItem group);

/// The colour when it is the same everywhere: an empty stack is transparent black.
[[nodiscard]] std::optional<Rgba> solid_color(const Stack& stack);

/// Premultiplied colour at a canvas point.
[[nodiscard]] Rgba stack_color(const Scene& scene, const Stack& stack, CanvasPoint p);

/// Mask value of a premultiplied colour of the mask's content: alpha, or luminance·alpha (CSS Masking 1 §6.2).
[[nodiscard]] double mask_value(bool luminance, bool linear_rgb, const Rgba& color);

/// Serialises the stack: equal keys if and only if equal stacks.
void append_key(const Stack& stack, std::vector<std::uint64_t>& key);

} // namespace fetexc
