// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>

#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

constexpr std::uint64_t kBelowOffset = 12, kAboveOffset = 16; ///< in BLVH

bool side(std::uint32_t v) { return v >= 1 && v <= kBilevelMaxSide; }

/// What is wrong with the sizes; nullptr: nothing. Precondition: the rule is known.
const char* wrong_size(const BilevelTexture& t) {
    if (!side(t.width) || !side(t.height)) return "width or height outside 1 … 16384";
    if (t.texels.size() != std::uint64_t{t.width} * t.height * t.channels)
        return "the texel array hasn't width·height texels";
    if (!t.mips.empty() && t.mips.size() != fbt_mip_samples(t.width, t.height))
        return "the mips are neither empty nor all levels";
    if (t.image.empty() && t.image_width == 0 && t.image_height == 0) return nullptr;
    if (!side(t.image_width) || !side(t.image_height)) return "sides of the image outside 1 … 16384";
    if (t.image.size() != std::uint64_t{t.image_width} * t.image_height)
        return "the image hasn't as many samples as its sides ask for";
    return nullptr;
}

bool premultiplied(std::uint32_t rgba8) {
    return std::max({rgba8 & 0xffu, rgba8 >> 8 & 0xffu, rgba8 >> 16 & 0xffu}) <= rgba8 >> 24;
}

} // namespace

std::vector<Finding> validate_bilevel(const BilevelTexture& texture, std::size_t limit) {
    limit = std::max<std::size_t>(limit, 1);
    if (texture.rule > BilevelRule::Median || texture.channels != bilevel_channels(texture.rule))
        return {{FindingCode::BilevelRuleChannels, 0, "header: the rule is unknown or combines other channels"}};
    if (const char* wrong = wrong_size(texture))
        return {{FindingCode::BilevelDimensions, 0, std::string("header: ") + wrong}};
    std::vector<Finding> findings;
    const auto check = [&](std::uint32_t color, std::uint64_t offset, const char* what) {
        if (!premultiplied(color) && findings.size() < limit)
            findings.push_back(
                {FindingCode::BilevelNotPremultiplied, offset, std::string(what) + ": a colour channel exceeds alpha"});
    };
    check(texture.below, kBelowOffset, "header: below");
    check(texture.above, kAboveOffset, "header: above");
    for (std::size_t k = 0; k < texture.image.size(); ++k)
        check(texture.image[k], 4 * std::uint64_t{k}, "image");
    return findings;
}

} // namespace fetex
