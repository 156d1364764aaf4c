// SPDX-License-Identifier: GPL-3.0-or-later
/// Which parts of a silhouette a texture shows, and which it invents.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/silhouette_parts.h"

namespace fetexc {

/// Of a texture, in a window.
struct Shown {
    std::vector<PartExtent> invented; ///< inside the window, wrong everywhere
    std::vector<std::uint32_t> alive; ///< parts of the silhouette that show, ascending
};

/// Parts are judged along the rows of `scanned`; what shows in one alone along more of them.
class PartJudge {
  public:
    PartJudge(const ScannedOutline& scanned, std::span<const OutlineSegment> outline, std::uint32_t height);

    [[nodiscard]] const SilhouetteParts& wanted() const { return wanted_; }
    [[nodiscard]] std::uint32_t per_texel() const { return per_texel_; }
    [[nodiscard]] Shown shown(const TextureValues& t, const Window& w) const;
    /// Everywhere.
    [[nodiscard]] Shown shown(const TextureValues& t, unsigned threads) const;
    /// Parts of the silhouette that rows meet and that don't show.
    [[nodiscard]] std::vector<PartExtent> lost(const Shown& shown) const;

  private:
    [[nodiscard]] Shown judge(const TextureValues& t, const Window& w, const Rows& rows) const;
    [[nodiscard]] bool is_island(const PartExtent& e, bool above, const TextureValues& t) const;
    [[nodiscard]] bool meets_outline(const PartExtent& e) const;

    std::uint32_t per_texel_;
    SilhouetteParts wanted_;
    std::span<const OutlineSegment> outline_;
    std::vector<std::vector<std::uint32_t>> beside_; ///< segments of a row of texels
};

} // namespace fetexc
