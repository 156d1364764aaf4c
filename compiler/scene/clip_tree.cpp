// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/clip_tree.h"

#include <algorithm>

#include "compiler/scene/validate.h"

namespace fetexc {
namespace {

/// Memory guard for composed clips: 2^22 copied members are 32 MiB.
constexpr std::size_t kMaxCopiedMembers = std::size_t{1} << 22;

LatticeBox point_box(LatticePoint p) { return {p.x, p.y, p.x, p.y}; }

} // namespace

LatticeBox intersection(const LatticeBox& a, const LatticeBox& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

LatticeBox hull(const LatticeBox& a, const LatticeBox& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

std::vector<LatticeBox> shape_boxes(const Scene& scene) {
    std::vector<LatticeBox> boxes(scene.shapes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Shape& shape = scene.shapes[i];
        for (std::uint32_t k = shape.first; k < shape.first + shape.count; ++k)
            for (int c = 0; c < scene.segments[k].degree; ++c) // contours are closed: each end is also a start
                boxes[i] = hull(boxes[i], point_box(scene.segments[k].p[c]));
    }
    return boxes;
}

LatticeBox ClipBoxes::box(std::uint32_t clip) {
    if (memo_.size() < scene_.clips.size()) memo_.resize(scene_.clips.size());
    if (memo_[clip].known) return memo_[clip].box;
    LatticeBox box;
    for (const ClipMember& member : scene_.clips[clip].members) {
        LatticeBox part = shapes_[member.shape];
        if (member.clip != kNone) part = intersection(part, this->box(member.clip));
        box = hull(box, part.empty() ? LatticeBox{} : part);
    }
    if (const std::uint32_t parent = scene_.clips[clip].parent; parent != kNone)
        box = intersection(box, this->box(parent));
    memo_[clip] = {true, box.empty() ? LatticeBox{} : box};
    return memo_[clip].box;
}

void ClipEvaluator::reset(std::span<const std::uint32_t> inside) {
    inside_ = inside;
    ++epoch_;
}

bool ClipEvaluator::shape_inside(std::uint32_t shape) const {
    return std::binary_search(inside_.begin(), inside_.end(), shape);
}

bool ClipEvaluator::evaluate(const Clip& clip) {
    if (clip.parent != kNone && !inside(clip.parent)) return false;
    return std::any_of(clip.members.begin(), clip.members.end(), [this](const ClipMember& member) {
        return shape_inside(member.shape) && (member.clip == kNone || inside(member.clip));
    });
}

bool ClipEvaluator::inside(std::uint32_t clip) {
    if (memo_[clip] >> 1 == epoch_) return (memo_[clip] & 1) != 0;
    const bool answer = evaluate(scene_.clips[clip]);
    memo_[clip] = epoch_ << 1 | (answer ? 1 : 0);
    return answer;
}

std::size_t ClipComposer::chain_length(std::uint32_t clip) const {
    std::size_t length = 0;
    for (; clip != kNone; clip = scene_.clips[clip].parent)
        ++length;
    return length;
}

bool ClipComposer::can_compose(std::uint32_t inner, std::uint32_t outer) const {
    return copied_members_ < kMaxCopiedMembers && chain_length(inner) + chain_length(outer) <= kMaxNesting;
}

bool ClipComposer::chain_contains(std::uint32_t chain, std::uint32_t clip) const {
    for (; chain != kNone; chain = scene_.clips[chain].parent)
        if (chain == clip) return true;
    return false;
}

std::uint32_t ClipComposer::compose(std::uint32_t inner, std::uint32_t outer) {
    if (outer == kNone || chain_contains(inner, outer)) return inner;
    if (inner == kNone || chain_contains(outer, inner)) return outer;
    if (const auto found = memo_.find({inner, outer}); found != memo_.end()) return found->second;
    // the inner chain is copied from its root down, the root's copy hanging below `outer`
    std::vector<std::uint32_t> chain;
    for (std::uint32_t clip = inner; clip != kNone; clip = scene_.clips[clip].parent)
        chain.push_back(clip);
    std::uint32_t parent = outer;
    for (auto it = chain.rbegin(); it != chain.rend(); ++it) {
        Clip copy{scene_.clips[*it].members, parent};
        copied_members_ += copy.members.size() + 1;
        parent = static_cast<std::uint32_t>(scene_.clips.size());
        scene_.clips.push_back(std::move(copy));
    }
    memo_[{inner, outer}] = parent;
    return parent;
}

} // namespace fetexc
