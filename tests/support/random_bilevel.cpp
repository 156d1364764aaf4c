// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_bilevel.h"

#include "formats/fbt_mip.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

std::uint32_t random_color(Random& random) {
    const int alpha = random.chance(0.5) ? 255 : random.integer(0, 255);
    std::uint32_t color = static_cast<std::uint32_t>(alpha) << 24;
    for (unsigned shift = 0; shift < 24; shift += 8)
        color |= static_cast<std::uint32_t>(random.integer(0, alpha)) << shift;
    return color;
}

} // namespace

fetex::BilevelTexture random_bilevel(std::uint64_t seed, const RandomBilevelOptions& options) {
    Random random(seed);
    fetex::BilevelTexture t;
    t.width = options.width, t.height = options.height;
    t.rule = options.rule;
    t.channels = fetex::bilevel_channels(t.rule);
    t.texels.resize(std::size_t{t.width} * t.height * t.channels);
    if (options.mips) t.mips.resize(fetex::fbt_mip_samples(t.width, t.height));
    for (auto* bytes : {&t.texels, &t.mips})
        for (std::uint8_t& byte : *bytes)
            byte = static_cast<std::uint8_t>(random.integer(0, 255));
    t.below = random_color(random), t.above = random_color(random);
    t.image_width = options.image_width, t.image_height = options.image_height;
    t.image.resize(std::size_t{t.image_width} * t.image_height);
    for (std::uint32_t& sample : t.image)
        sample = random_color(random);
    return t;
}

} // namespace fetexc::test
