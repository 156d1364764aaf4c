// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures (P. Sen, Graphics Hardware 2004; formats/silmap.h) from scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/compile.h"
#include "formats/silmap.h"

namespace fetexc {

/// Auto: thorough up to kSilmapThoroughCells cells with edges. Of crowded pictures, quick leaves half as much wrong
/// area again, and thorough takes ten times as long with cells of 8 bits, 25 times with 16 (compiler/silmap/README.md).
enum class SilmapEffort : std::uint8_t { Auto, Quick, Thorough };
inline constexpr std::uint64_t kSilmapThoroughCells = 4096;

struct SilmapOptions {
    GridSize size; ///< texels; either side 0: by aspect
    fetex::SilmapCellFormat cell_format = fetex::SilmapCellFormat::Bits8;
    fetex::SilmapSampleFormat sample_format = fetex::SilmapSampleFormat::Rgba8; ///< Rgb8: what shows through is black
    bool mips = false;
    unsigned threads = 1; ///< 0: all; never changes a byte of the output
    SkipRules skip = {};  ///< nor do these
    SilmapEffort effort = SilmapEffort::Auto;
    bool lend =
        true; ///< thorough: a texel may have the colour of a region beside its middle, for features thinner than it
};

/// Deterministic: no times in here.
struct SilmapStats {
    std::uint64_t cells = 0;         ///< (width + 1) · (height + 1)
    std::uint64_t cells_empty = 0;   ///< of one colour, no edge inside: they cost nothing
    std::uint64_t cells_edge = 0;    ///< with a boundary between two of their corners
    std::uint64_t cells_corner = 0;  ///< of those, with a corner or a junction of the drawing inside
    std::uint64_t cells_crowded = 0; ///< more inside than a point and its links can show, and it shows (W5121)
    std::uint64_t parts_lost = 0;    ///< parts of the picture of which no texel has the colour (W5122)
    std::uint64_t texels_lent = 0;   ///< texels with the colour of a region beside their middle
    std::uint64_t fit_rounds = 0;    ///< over the cells whose surroundings changed
    std::uint64_t positions_tried = 0;
    double wrong_area_seed = 0; ///< as wrong_area, before the fit
    double wrong_area = 0;      ///< part of the canvas (0 … 1) that shows another region than the drawing has there
    std::uint64_t gpu_bytes = 0;
};

struct SilmapReport {
    SceneStats scene;
    PlanarStats planar;
    std::vector<Diagnostic> diagnostics;
};

struct SilmapBuild {
    fetex::SilmapTexture texture;
    SilmapStats stats;
    SilmapReport report;
};

/// The texture of a scene: each texel has the colour of a region, never a mixture; the points are where the least area
/// shows another region than the drawing has. Errors: kSizeOutOfRange; those of PlanarMap::build.
Result<SilmapBuild> compile_silmap(const Scene& scene, const SilmapOptions& options, const ProgressSink& progress = {});

/// Of an image with features over it (the paper's Fig. 6): each texel has the colour that the image's FBT of as many
/// texels has in its middle, filtered without crossing a feature; cells are fitted to the features. Errors: those of
/// compile_fbt too.
Result<SilmapBuild> compile_silmap(const FeaturedImage& picture, const SilmapOptions& options,
                                   const ProgressSink& progress = {});

/// At a size of its own choice; options.size is ignored.
/// - max_wrong_area > 0 (part of the canvas): the smallest size, to 1/16, that has no more wrong area and fits in
///   max_bytes (0: no limit). Error kSilmapErrorUnmet: none does.
/// - else: the largest size of at most max_bytes on the GPU. Error kSilmapBudget: none fits.
/// - neither: up to budget::kSilmapChosenError of wrong area, or the best that a size of up to 1024 texels does.
/// Errors of compile_silmap as well.
Result<SilmapBuild> compile_silmap_at_chosen_size(const Scene& scene, const SilmapOptions& options,
                                                  std::uint64_t max_bytes, double max_wrong_area,
                                                  const ProgressSink& progress = {});

/// The same of an image, at most as many texels as pixels.
Result<SilmapBuild> compile_silmap_at_chosen_size(const FeaturedImage& picture, const SilmapOptions& options,
                                                  std::uint64_t max_bytes, double max_wrong_area,
                                                  const ProgressSink& progress = {});

} // namespace fetexc
