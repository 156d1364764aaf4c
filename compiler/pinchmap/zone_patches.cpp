// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/zone_patches.h"

#include <algorithm>

#include "compiler/union_find.h"

namespace fetexc {
namespace {

/// Clusters: differences so near each other are in one 3 × 3.
constexpr std::int64_t kTogether = 2;

} // namespace

ZonePatches patches_between(const ZoneMask& a, const ZoneMask& b) {
    const std::int64_t width = a.width, height = a.height;
    const auto differs = [&](std::size_t k) { return a.above[k] != b.above[k]; };
    UnionFind sets(a.above.size());
    for (std::int64_t j = 0; j < height; ++j) {
        for (std::int64_t i = 0; i < width; ++i) {
            const auto k = static_cast<std::size_t>(j * width + i);
            if (!differs(k)) continue;
            for (std::int64_t y = j; y <= std::min(j + kTogether, height - 1); ++y) {
                for (std::int64_t x = std::max<std::int64_t>(i - kTogether, 0); x <= std::min(i + kTogether, width - 1);
                     ++x) {
                    const auto other = static_cast<std::size_t>(y * width + x);
                    if (differs(other)) sets.unite(static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(other));
                }
            }
        }
    }
    ZonePatches out;
    out.of.assign(a.above.size(), ZonePatches::kNone);
    for (std::uint32_t k = 0; k < out.of.size(); ++k) {
        if (!differs(k)) continue;
        const std::uint32_t first = sets.find(k); // the least of the set
        out.of[k] = first == k ? out.count++ : out.of[first];
    }
    return out;
}

} // namespace fetexc
