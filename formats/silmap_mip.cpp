// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The mip chain of a silhouette-map texture, from its coverage-weighted colours (Sen 2004, §2.2).
#include "formats/mip_chain.h"
#include "formats/silmap.h"

namespace fetex {

std::vector<std::uint32_t> silmap_make_mips(const SilmapTexture& texture) {
    return make_mip_chain(texture.width, texture.height, [&](std::uint32_t j, std::span<FbtColor> row) {
        for (std::uint32_t i = 0; i < texture.width; ++i)
            row[i] = silmap_sample_area_local(texture, i, j, 0.5, 0.5, {1, 1});
    });
}

} // namespace fetex
