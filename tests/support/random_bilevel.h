// SPDX-License-Identifier: GPL-3.0-or-later
/// Valid random bi-level textures: every one passes validate_bilevel, and no two seeds are alike. They make no
/// pictorial sense: any byte may stand beside any other.
#pragma once

#include <cstdint>

#include "formats/bilevel.h"

namespace fetexc::test {

struct RandomBilevelOptions {
    std::uint32_t width = 8, height = 8;
    fetex::BilevelRule rule = fetex::BilevelRule::Single;
    bool mips = false;
    std::uint32_t image_width = 0, image_height = 0; ///< 0: no image
};

fetex::BilevelTexture random_bilevel(std::uint64_t seed, const RandomBilevelOptions& options = {});

inline constexpr fetex::BilevelRule kBilevelRules[] = {fetex::BilevelRule::Single, fetex::BilevelRule::Min,
                                                       fetex::BilevelRule::Max, fetex::BilevelRule::Median};

} // namespace fetexc::test
