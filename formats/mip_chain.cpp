// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/mip_chain.h"

#include <algorithm>
#include <array>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"

namespace fetex {
namespace {

/// A sample of a level along one axis, and how much of it a texel is.
struct Share {
    std::uint32_t sample = 0;
    double part = 0; ///< of the sample
};

/// The one or two samples that a texel lies in: a sample is never shorter than a texel.
std::array<Share, 2> shares(std::uint32_t texel, std::uint32_t texels, std::uint32_t samples) {
    const auto first = static_cast<std::uint32_t>(std::uint64_t{texel} * samples / texels);
    const std::uint64_t border = (std::uint64_t{first} + 1) * texels; // of the first sample, in 1/samples of a texel
    const std::uint64_t end = (std::uint64_t{texel} + 1) * samples;
    const double before = static_cast<double>(std::min(end, border) - std::uint64_t{texel} * samples) / texels;
    const double after = end > border ? static_cast<double>(end - border) / texels : 0.0;
    return {{{first, before}, {first + 1, after}}};
}

void add(FbtColor& sum, const FbtColor& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

/// One level, filled from the rows of texels from the first to the last.
class Level {
  public:
    Level(std::uint32_t width, std::uint32_t height, std::uint32_t k)
        : texels_wide_(width), texels_high_(height), level_(fbt_mip_level(width, height, k)), sums_(level_.width),
          next_(level_.width) {}

    /// Samples that the row finishes go to their place in `out`.
    void add_row(std::uint32_t j, std::span<const FbtColor> texels, std::span<std::uint32_t> out) {
        const auto rows = shares(j, texels_high_, level_.height);
        for (std::uint32_t i = 0; i < texels_wide_; ++i) {
            for (const Share& column : shares(i, texels_wide_, level_.width)) {
                if (column.part == 0) continue;
                add(sums_[column.sample], texels[i], column.part * rows[0].part);
                add(next_[column.sample], texels[i], column.part * rows[1].part);
            }
        }
        const bool finished =
            (std::uint64_t{j} + 1) * level_.height >= (std::uint64_t{rows[0].sample} + 1) * texels_high_;
        if (finished) finish_row(rows[0].sample, out);
    }

  private:
    void finish_row(std::uint32_t row, std::span<std::uint32_t> out) {
        for (std::uint32_t i = 0; i < level_.width; ++i)
            out[level_.first + std::uint64_t{row} * level_.width + i] =
                fbt_pack_sample(sums_[i], FbtSampleFormat::Rgba8)[0];
        sums_.swap(next_);
        std::ranges::fill(next_, FbtColor{});
    }

    std::uint32_t texels_wide_, texels_high_;
    FbtMipLevel level_;
    std::vector<FbtColor> sums_, next_; ///< the row of samples in work, and the one after
};

} // namespace

std::vector<std::uint32_t> make_mip_chain(std::uint32_t width, std::uint32_t height, const MipRow& colors) {
    std::vector<Level> levels;
    for (std::uint32_t k = 1; k <= fbt_mip_levels(width, height); ++k)
        levels.emplace_back(width, height, k);
    std::vector<std::uint32_t> out(fbt_mip_samples(width, height));
    std::vector<FbtColor> row(width);
    for (std::uint32_t j = 0; j < height; ++j) {
        colors(j, row);
        for (Level& level : levels)
            level.add_row(j, row, out);
    }
    return out;
}

} // namespace fetex
