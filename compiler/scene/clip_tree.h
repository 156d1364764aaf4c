// SPDX-License-Identifier: GPL-3.0-or-later
/// Clips as a graph: evaluation for a set of shapes, bounding boxes, composition of a group's clip with a child's.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

/// Closed lattice box; empty when x0 > x1.
struct LatticeBox {
    std::int64_t x0 = 0, y0 = 0, x1 = -1, y1 = -1;
    [[nodiscard]] bool empty() const { return x0 > x1 || y0 > y1; }
};
[[nodiscard]] LatticeBox intersection(const LatticeBox& a, const LatticeBox& b);
[[nodiscard]] LatticeBox hull(const LatticeBox& a, const LatticeBox& b);

/// Control-point box of every shape; empty for a shape without segments.
[[nodiscard]] std::vector<LatticeBox> shape_boxes(const Scene& scene);

/// Bounding boxes of clips, computed on demand. The scene must be validated (no cycles) and outlive this.
class ClipBoxes {
  public:
    ClipBoxes(const Scene& scene, const std::vector<LatticeBox>& shapes) : scene_(scene), shapes_(shapes) {}
    [[nodiscard]] LatticeBox box(std::uint32_t clip);

  private:
    struct Entry {
        bool known = false;
        LatticeBox box;
    };
    const Scene& scene_;
    const std::vector<LatticeBox>& shapes_;
    std::vector<Entry> memo_;
};

/// inside(clip) for one set of inside shapes; remembers clips within one set, so shared sub-clips cost once.
class ClipEvaluator {
  public:
    explicit ClipEvaluator(const Scene& scene) : scene_(scene), memo_(scene.clips.size()) {}
    /// Starts a new set (strictly ascending shape indices, must stay alive).
    void reset(std::span<const std::uint32_t> inside);
    [[nodiscard]] bool shape_inside(std::uint32_t shape) const;
    [[nodiscard]] bool inside(std::uint32_t clip);

  private:
    bool evaluate(const Clip& clip);
    const Scene& scene_;
    std::span<const std::uint32_t> inside_;
    std::vector<std::uint64_t> memo_; ///< epoch·2 + answer
    std::uint64_t epoch_ = 0;
};

/// Composes clips by chaining copies of the inner clip's parents to the outer clip.
class ClipComposer {
  public:
    explicit ClipComposer(Scene& scene) : scene_(scene) {}
    /// A clip with inside = inside(inner) and inside(outer); either may be kNone.
    [[nodiscard]] std::uint32_t compose(std::uint32_t inner, std::uint32_t outer);
    /// False where composing would copy too much or chain too deep; then the group keeps its clip.
    [[nodiscard]] bool can_compose(std::uint32_t inner, std::uint32_t outer) const;

  private:
    [[nodiscard]] std::size_t chain_length(std::uint32_t clip) const;
    [[nodiscard]] bool chain_contains(std::uint32_t chain, std::uint32_t clip) const;
    Scene& scene_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> memo_;
    std::size_t copied_members_ = 0;
};

} // namespace fetexc
