// SPDX-License-Identifier: GPL-3.0-or-later
/// Valid random silhouette-map textures: every one passes validate_silmap, and no two seeds are alike. They make no
/// pictorial sense: any cell may stand beside any other.
#pragma once

#include <cstdint>

#include "formats/silmap.h"

namespace fetexc::test {

struct RandomSilmapOptions {
    std::uint32_t width = 8, height = 8;
    fetex::SilmapCellFormat cell_format = fetex::SilmapCellFormat::Bits8;
    fetex::SilmapSampleFormat sample_format = fetex::SilmapSampleFormat::Rgba8;
    bool mips = false;        ///< its own, as silmap_make_mips has them
    double boundaries = 0.5;  ///< how often a link is one
    std::uint32_t colors = 0; ///< so many only; 0: each sample its own
};

fetex::SilmapTexture random_silmap(std::uint64_t seed, const RandomSilmapOptions& options = {});

inline constexpr fetex::SilmapCellFormat kSilmapCellFormats[] = {fetex::SilmapCellFormat::Bits8,
                                                                 fetex::SilmapCellFormat::Bits16};
inline constexpr fetex::SilmapSampleFormat kSilmapSampleFormats[] = {
    fetex::SilmapSampleFormat::Rgba8, fetex::SilmapSampleFormat::Rgba16, fetex::SilmapSampleFormat::Rgba16F,
    fetex::SilmapSampleFormat::Rgb8};

} // namespace fetexc::test
