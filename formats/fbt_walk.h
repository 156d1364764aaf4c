// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What the reference samplers share. Not for users of the library.
#pragma once

#include "formats/fbt.h"

namespace fetex {

/// The word of texel (i,j), which is in the texture.
inline std::uint32_t fbt_texel(const FbtTexture& t, std::uint32_t i, std::uint32_t j) {
    return t.texels[std::size_t{j} * t.width + i];
}
inline bool fbt_has_features(std::uint32_t texel) {
    return texel >> 30 == kFbtKindSingle || texel >> 30 == kFbtKindBanded;
}

/// The region of a texel without features.
FbtRegion fbt_whole_region(std::uint32_t texel, std::uint32_t i, std::uint32_t j);

/// The bands of a texel with features; a single list is one band.
class FbtBands {
  public:
    FbtBands(const FbtTexture& texture, std::uint32_t texel)
        : words_(texture.records.data() + std::size_t{texel & kFbtAddressMask} * 4), address_(texel & kFbtAddressMask),
          count_(texel >> 30 == kFbtKindBanded ? words_[0] : 1), banded_(texel >> 30 == kFbtKindBanded) {}

    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// Where the band ends; only of a banded texel.
    [[nodiscard]] double end(std::uint32_t band) const { return fbt_dequantise(fbt_band_end(words_, band)); }
    /// The record of the band's entry list.
    [[nodiscard]] std::uint32_t list(std::uint32_t band) const {
        return banded_ ? words_[1 + (count_ + 1) / 2 + band] : address_;
    }
    /// The band that holds a local y; steps: of the binary search, may be null.
    [[nodiscard]] std::uint32_t find(double y, std::uint64_t* steps = nullptr) const {
        std::uint32_t low = 0, high = count_ - 1; // the answer is in [low, high]
        while (low < high) {
            if (steps) ++*steps;
            const std::uint32_t middle = (low + high) / 2;
            if (y < end(middle)) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        return low;
    }

  private:
    const std::uint32_t* words_;
    std::uint32_t address_, count_;
    bool banded_;
};

/// A coordinate clamped to the texture; NaN becomes 0.
inline double fbt_clamp_coordinate(double v, std::uint32_t size) {
    return v > 0 ? (v < static_cast<double>(size) ? v : static_cast<double>(size)) : 0.0;
}

} // namespace fetex
