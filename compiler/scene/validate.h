// SPDX-License-Identifier: GPL-3.0-or-later
/// Structural checks of a scene's tree, clips, masks and paints. Everything after them may follow indices blindly.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Depth limit for groups, clip chains and nested masks: recursion over them stays within any thread's stack.
inline constexpr std::uint32_t kMaxNesting = 512;
/// Limit on nodes with every use of a mask expanded; nested masks would otherwise grow exponentially.
inline constexpr std::uint64_t kMaxExpandedNodes = std::uint64_t{1} << 24;

/// Needs shapes in place (indices are checked against their count). Mask ranges may lie anywhere among the nodes; the
/// picture is every node outside of them. Errors: kSceneReferenceInvalid, kSceneTooLarge, kScenePaintInvalid.
Status validate_scene(const Scene& scene);

/// Walks siblings in [first,end) as the builder's input has them: mask contents may be interleaved and are stepped
/// over.
class SiblingWalk {
  public:
    explicit SiblingWalk(const Scene& scene);
    /// First node at or after `at` that belongs to the sibling list of a range [first,end); `end` when there is none.
    /// The range itself may be a mask's.
    [[nodiscard]] std::uint32_t settle(std::uint32_t at, std::uint32_t first, std::uint32_t end) const;

  private:
    std::vector<std::vector<std::uint32_t>> mask_ends_; ///< by first node, ascending
};

} // namespace fetexc
