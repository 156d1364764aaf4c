// SPDX-License-Identifier: GPL-3.0-or-later
/// Valid random FBTs: every texture passes validate_fbt, and no two seeds are alike. They make no pictorial sense (open
/// chains, crossing features, any model), so that samplers meet every case of the format and not only what our builder
/// writes.
#pragma once

#include <cstdint>

#include "formats/fbt.h"

namespace fetexc::test {

struct RandomFbtOptions {
    std::uint32_t width = 8, height = 8;
    std::uint32_t degrees = 0b1110;    ///< bit d: pieces of degree d may occur
    std::uint32_t directions = 0b1111; ///< bit d: ray direction d may occur
    bool bands = true, corners = true, patches = true, translucent = true;
    std::uint32_t max_features = 4; ///< in a band
    std::uint32_t max_pieces = 6;   ///< in a run
    bool mips = false;              ///< a chain of random samples
    /// Of corners and patches; halves are colours up to 4.
    fetex::FbtSampleFormat sample_format = fetex::FbtSampleFormat::Rgba8;
};

fetex::FbtTexture random_fbt(std::uint64_t seed, const RandomFbtOptions& options = {});

} // namespace fetexc::test
