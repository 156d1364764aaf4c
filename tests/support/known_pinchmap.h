// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps by construction (Tarini and Cignoni 2005, §4.4, §5.1, §7.2 step 3): a mask says on which side each cluster
/// lies, and the map follows from it. Every one passes validate_pinchmap. Signals make no pictorial sense.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/pinchmap.h"

namespace fetexc::test {

/// Sides of clusters, +1 or −1, row by row; beyond the border they repeat.
struct PinchmapMask {
    std::uint32_t width = 0, height = 0;
    std::vector<int> sides;
    [[nodiscard]] int at(int i, int j) const;
};

/// Rows of one length: '#' is +1, all else −1.
PinchmapMask mask_of(const std::vector<std::string>& rows);

/// Whether some corner is a cross: the clusters around it lie on the two sides by turns.
bool has_cross(const PinchmapMask& mask);
/// SPEC 8.1: no cluster with four active corners or with two across, and where two neighbouring corners are active, a
/// line between them.
bool is_valid(const PinchmapMask& mask);

/// All valid masks of side × side clusters without crosses; of two that differ only in the sides' names one.
std::vector<PinchmapMask> all_valid_masks(std::uint32_t side);
/// Valid, without crosses; blobs of a few clusters.
PinchmapMask random_mask(std::uint64_t seed, std::uint32_t width, std::uint32_t height);

enum class KnownSignal {
    TwoColors, ///< of each side its own: what mixes them shows
    Random,    ///< each sample its own
};

struct KnownPinchmapOptions {
    std::uint32_t scale = 0;
    fetex::PinchmapFormat map_format = fetex::PinchmapFormat::Bits16;
    fetex::PinchmapSampleFormat sample_format = fetex::PinchmapSampleFormat::Rgba8;
    KnownSignal signal = KnownSignal::TwoColors;
    double gamma_from = 0, gamma_to = 0; ///< random, between these
    bool turns_round = false;            ///< SPEC 8.5: gamma bends no turn inwards
    double least_strength = 1;           ///< of active texels random, from this to 1
    bool mips = false;
    std::uint64_t seed = 1;
};
inline constexpr std::uint32_t kAboveColor = 0xff0000ff, kBelowColor = 0xffff0000; ///< of the sides +1 and −1

/// Precondition: the mask is valid. At crosses the strength is 0.
fetex::PinchmapTexture pinchmap_of(const PinchmapMask& mask, const KnownPinchmapOptions& options = {});

inline constexpr fetex::PinchmapFormat kPinchmapFormats[] = {fetex::PinchmapFormat::Bits8,
                                                             fetex::PinchmapFormat::Bits16};
inline constexpr fetex::PinchmapSampleFormat kPinchmapSampleFormats[] = {
    fetex::PinchmapSampleFormat::Rgba8, fetex::PinchmapSampleFormat::Rgba16, fetex::PinchmapSampleFormat::Rgba16F,
    fetex::PinchmapSampleFormat::Rgb8};

} // namespace fetexc::test
