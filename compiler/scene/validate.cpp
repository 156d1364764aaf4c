// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "compiler/diagnostics.h"

namespace fetexc {
namespace {

Error bad_reference(const std::string& what, std::size_t index) {
    return {ErrorClass::InvalidInput, diag::kSceneReferenceInvalid, what, "index " + std::to_string(index)};
}

Error too_deep(const std::string& what) {
    return {ErrorClass::InvalidInput, diag::kSceneTooLarge,
            what + " nested deeper than " + std::to_string(kMaxNesting) + " levels", ""};
}

bool valid_or_none(std::uint32_t index, std::size_t count) { return index == kNone || index < count; }

// ---- clips ----

Status check_clip_indices(const Scene& scene) {
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        const Clip& clip = scene.clips[i];
        if (!valid_or_none(clip.parent, scene.clips.size())) return bad_reference("clip parent out of range", i);
        for (const ClipMember& member : clip.members)
            if (member.shape >= scene.shapes.size() || !valid_or_none(member.clip, scene.clips.size()))
                return bad_reference("clip member out of range", i);
    }
    return {};
}

/// Heights of a reference graph, found depth first. A height beyond kMaxNesting (a cycle included) is an error.
template <class Children> class Heights {
  public:
    Heights(std::size_t count, Children children) : height_(count, 0), children_(children) {}
    /// Height of a node, or nothing when too deep or cyclic.
    std::optional<std::uint32_t> height(std::uint32_t node, std::uint32_t depth = 0) {
        if (depth > kMaxNesting) return {};
        if (height_[node] != 0) return height_[node];
        std::uint32_t best = 0;
        for (std::uint32_t child : children_(node)) {
            const auto below = height(child, depth + 1);
            if (!below) return {};
            best = std::max(best, *below);
        }
        if (best + 1 > kMaxNesting) return {};
        return height_[node] = best + 1;
    }

  private:
    std::vector<std::uint32_t> height_;
    Children children_;
};

Status check_clip_graph(const Scene& scene) {
    const auto children = [&scene](std::uint32_t i) {
        std::vector<std::uint32_t> out;
        if (scene.clips[i].parent != kNone) out.push_back(scene.clips[i].parent);
        for (const ClipMember& member : scene.clips[i].members)
            if (member.clip != kNone) out.push_back(member.clip);
        return out;
    };
    Heights heights(scene.clips.size(), children);
    for (std::uint32_t i = 0; i < scene.clips.size(); ++i)
        if (!heights.height(i)) return too_deep("clips cyclic or");
    return {};
}

// ---- nodes and masks ----

Status check_node(const Scene& scene, std::uint32_t i) {
    const Node& node = scene.nodes[i];
    if (!valid_or_none(node.clip, scene.clips.size())) return bad_reference("node clip out of range", i);
    if (!std::isfinite(node.opacity)) return bad_reference("node opacity is not a finite number", i);
    if (node.kind == Node::Kind::Fill) {
        const bool ok = node.shape < scene.shapes.size() && node.paint < scene.paints.size();
        return ok ? Status{} : Status{bad_reference("fill refers to a missing shape or paint", i)};
    }
    if (node.end <= i || node.end > scene.nodes.size()) return bad_reference("group end out of range", i);
    if (!valid_or_none(node.mask, scene.masks.size())) return bad_reference("group mask out of range", i);
    return {};
}

/// Group ranges must nest properly, and stay below the depth limit.
Status check_group_nesting(const Scene& scene) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
        if (Status status = check_node(scene, i); !status) return status;
        while (!open.empty() && open.back() <= i)
            open.pop_back();
        if (scene.nodes[i].kind != Node::Kind::Group) continue;
        if (!open.empty() && scene.nodes[i].end > open.back()) return bad_reference("groups overlap", i);
        open.push_back(scene.nodes[i].end);
        if (open.size() > kMaxNesting) return too_deep("groups");
    }
    return {};
}

/// A mask's content must be whole subtrees: no group may straddle its borders.
Status check_mask_ranges(const Scene& scene) {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < scene.masks.size(); ++i) {
        const Mask& mask = scene.masks[i];
        if (mask.first > mask.end || mask.end > scene.nodes.size()) return bad_reference("mask range out of range", i);
        if (!valid_or_none(mask.parent, scene.masks.size()) || !valid_or_none(mask.region_shape, scene.shapes.size()))
            return bad_reference("mask refers to a missing mask or shape", i);
        if ((total += mask.end - mask.first) > kMaxExpandedNodes)
            return Error{ErrorClass::InvalidInput, diag::kSceneTooLarge, "masks hold too many nodes", ""};
        for (std::uint32_t k = mask.first; k < mask.end; ++k)
            if (scene.nodes[k].kind == Node::Kind::Group && scene.nodes[k].end > mask.end)
                return bad_reference("a group crosses the end of a mask", i);
    }
    return {};
}

std::vector<std::uint32_t> masks_used_by(const Scene& scene, std::uint32_t i) {
    std::vector<std::uint32_t> out;
    const Mask& mask = scene.masks[i];
    if (mask.parent != kNone) out.push_back(mask.parent);
    for (std::uint32_t k = mask.first; k < mask.end; ++k)
        if (scene.nodes[k].kind == Node::Kind::Group && scene.nodes[k].mask != kNone)
            out.push_back(scene.nodes[k].mask);
    return out;
}

std::uint64_t expanded_range(const Scene& scene, const std::vector<std::uint64_t>& cost, std::uint32_t first,
                             std::uint32_t end) {
    std::uint64_t sum = 0;
    for (std::uint32_t k = first; k < end; ++k) {
        const Node& node = scene.nodes[k];
        sum += 1 + (node.kind == Node::Kind::Group && node.mask != kNone ? cost[node.mask] : 0);
    }
    return std::min(sum, kMaxExpandedNodes + 1);
}

Status check_mask_graph(const Scene& scene) {
    Heights heights(scene.masks.size(), [&scene](std::uint32_t i) { return masks_used_by(scene, i); });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_height;
    for (std::uint32_t i = 0; i < scene.masks.size(); ++i) {
        const auto height = heights.height(i);
        if (!height) return too_deep("masks cyclic or");
        by_height.emplace_back(*height, i);
    }
    std::sort(by_height.begin(), by_height.end());
    std::vector<std::uint64_t> cost(scene.masks.size(), 0);
    for (const auto& [height, i] : by_height) {
        const Mask& mask = scene.masks[i];
        cost[i] = expanded_range(scene, cost, mask.first, mask.end) + (mask.parent != kNone ? cost[mask.parent] : 0);
        cost[i] = std::min(cost[i], kMaxExpandedNodes + 1);
    }
    if (expanded_range(scene, cost, 0, static_cast<std::uint32_t>(scene.nodes.size())) <= kMaxExpandedNodes) return {};
    return Error{ErrorClass::InvalidInput, diag::kSceneTooLarge, "nested masks expand to too many nodes", ""};
}

// ---- paints ----

bool finite(const Rgba& c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) && std::isfinite(c.a);
}

bool finite(const Affine& m) {
    return std::isfinite(m.a) && std::isfinite(m.b) && std::isfinite(m.c) && std::isfinite(m.d) && std::isfinite(m.e) &&
           std::isfinite(m.f);
}

bool valid(const std::vector<GradientStop>& stops) {
    for (std::size_t i = 0; i < stops.size(); ++i) {
        if (!std::isfinite(stops[i].offset) || !finite(stops[i].color)) return false;
        if (i > 0 && stops[i].offset < stops[i - 1].offset) return false;
    }
    return !stops.empty();
}

bool valid(const SolidPaint& p) { return finite(p.color); }
bool valid(const LinearPaint& p) { return finite(p.canvas_to_unit) && valid(p.stops); }
bool valid(const RadialPaint& p) {
    const bool circles = std::isfinite(p.cx) && std::isfinite(p.cy) && std::isfinite(p.r) && std::isfinite(p.fx) &&
                         std::isfinite(p.fy) && std::isfinite(p.fr);
    return circles && finite(p.canvas_to_gradient) && valid(p.stops);
}
bool valid(const RasterPaint& p) {
    const std::uint64_t row = std::uint64_t{4} * p.width; // dividing, since row · height may overflow
    return finite(p.canvas_to_pixel) && row > 0 && p.rgba.size() % row == 0 && p.rgba.size() / row == p.height;
}

Status check_paints(const Scene& scene) {
    for (std::size_t i = 0; i < scene.paints.size(); ++i)
        if (!std::visit([](const auto& paint) { return valid(paint); }, scene.paints[i]))
            return Error{ErrorClass::InvalidInput, diag::kScenePaintInvalid,
                         "paint with a non-finite number, unordered or missing stops, or a bitmap of the wrong length",
                         "paint " + std::to_string(i)};
    return {};
}

} // namespace

Status validate_scene(const Scene& scene) {
    for (const auto check :
         {check_clip_indices, check_clip_graph, check_group_nesting, check_mask_ranges, check_mask_graph, check_paints})
        if (Status status = check(scene); !status) return status;
    return {};
}

SiblingWalk::SiblingWalk(const Scene& scene) : mask_ends_(scene.nodes.size() + 1) {
    for (const Mask& mask : scene.masks)
        if (mask.first < mask.end) mask_ends_[mask.first].push_back(mask.end);
    for (std::vector<std::uint32_t>& ends : mask_ends_)
        std::sort(ends.begin(), ends.end());
}

std::uint32_t SiblingWalk::settle(std::uint32_t at, std::uint32_t first, std::uint32_t end) const {
    while (at < end) {
        // at the range's own start only a smaller mask range can be a foreign one
        const std::uint32_t limit = at == first ? end - 1 : end;
        const std::vector<std::uint32_t>& ends = mask_ends_[at];
        const auto past = std::upper_bound(ends.begin(), ends.end(), limit);
        if (past == ends.begin()) return at;
        at = *(past - 1);
    }
    return end;
}

} // namespace fetexc
