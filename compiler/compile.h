// SPDX-License-Identifier: GPL-3.0-or-later
/// The one entry of the compiler: a scene goes in, an asset comes out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compiler/raster/image.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"
#include "compiler/skip_rules.h"
#include "formats/fbt.h"

namespace fetexc {

/// --size: texels. Either a side is 0: it follows from the other by aspect.
struct GridSize {
    std::uint32_t width = 0, height = 0;
};

/// N texels on the longer side, the other by aspect (rounded, at least 1).
GridSize grid_for(const Extent& extent, std::uint32_t longer_side);

struct CompileOptions {
    GridSize size;
    unsigned threads = 1; ///< 0: all; never changes a byte of the output
    SkipRules skip = {};  ///< nor do these
    bool mips = false;    ///< a mip chain too (formats/fbt_mip.h), for views of more than a texel a pixel
    /// Of gradients' samples. More bits round them more finely, and colours of which 8 bits aren't enough; what a
    /// gradient is between its samples they don't change.
    fetex::FbtSampleFormat sample_format = fetex::FbtSampleFormat::Rgba8;
};

/// Called from one thread at a time; fraction in [0,1].
using ProgressSink = std::function<void(const char* stage, double fraction)>;

/// Everything a stage did and avoided (DESIGN §8). Deterministic: no times in here.
struct PlanarStats {
    std::uint64_t segments = 0, segments_null = 0, degree_reduced = 0, pieces = 0, pieces_shared = 0;
    std::uint64_t near_cusps = 0; ///< extrema of x and of y merged into one vertex (geometry/monotone.h)
    std::uint64_t box_pairs = 0, pairs_certified = 0, pairs_exact = 0, overlaps = 0;
    std::uint64_t vertices = 0, edges = 0, crossings = 0, grid_crossings = 0;
    std::uint64_t exact_comparisons = 0; ///< order or side decisions that intervals couldn't make
    std::uint64_t texels = 0, texels_empty = 0, texels_simple = 0, texels_arranged = 0;
    std::uint64_t trapezoids = 0, regions = 0, edges_invisible = 0, edges_visible = 0;
    std::uint64_t reach_vertices = 0, reach_links = 0; ///< reachability graph (FBT §4.4)
    std::uint64_t regions_connected = 0;               ///< of the whole texture: what visible edges separate
};
struct FbtStats {
    std::uint64_t texels_empty = 0, texels_two_regions = 0, texels_more_regions = 0, texels_banded = 0;
    std::uint64_t bands = 0;         ///< in banded texels
    std::uint64_t bands_avoided = 0; ///< horizontal lines of the trapezoid decomposition that became no band line
    std::uint64_t features = 0, pieces = 0, regions = 0, regions_interpolated = 0;
    std::uint64_t runs_shared = 0, pieces_demoted = 0;
    std::uint64_t slivers_collapsed = 0; ///< regions of texels of which quantisation left nothing
    std::uint64_t parts_lost = 0;        ///< parts of the picture all of whose regions collapsed (W4101)
    std::uint64_t gpu_bytes = 0;
};
/// Of the mip chain. Texels: those of the grids that were integrated.
struct MipStats {
    std::uint64_t levels = 0;
    std::uint64_t own_maps = 0; ///< levels whose samples aren't whole blocks of texels or of a finer level's samples
    std::uint64_t texels = 0, texels_solid = 0; ///< solid: nothing to integrate
    std::uint64_t trapezoids = 0;               ///< exact areas, in the texels with edges
    std::uint64_t areas_sampled = 0;            ///< texels and trapezoids of a gradient
    std::uint64_t paint_samples = 0;
    std::uint64_t gpu_bytes = 0; ///< FbtStats::gpu_bytes has them too
};
/// Of a texture made from an image (FBT §4.1–4.4).
struct ImageStats {
    std::uint32_t width = 0, height = 0; ///< pixels; 0: not made from an image
    std::uint64_t pixels_invalid = 0;    ///< near a feature
    std::uint64_t holes_filled = 0;      ///< regions without a valid pixel, filled from the closest reachable one
    std::uint64_t parts_unsampled = 0;   ///< parts without one to reach: prefiltered pixels (W2055)
    std::uint64_t floating = 0;  ///< parts of features that split nothing in their texel: ignored (FBT §4.5, N2151)
    std::uint64_t fit_steps = 0; ///< of the least-squares fit
};
struct CompileReport {
    SceneStats scene;
    PlanarStats planar;
    FbtStats fbt;
    MipStats mips;
    ImageStats image;
    std::vector<Diagnostic> diagnostics;
};

struct FbtBuild {
    fetex::FbtTexture texture;
    CompileReport report;
};

/// Builds the FBT of a scene. Errors: size out of range, arrangement limits, internal inconsistency (never a wrong
/// result).
Result<FbtBuild> compile_fbt(const Scene& scene, const CompileOptions& options, const ProgressSink& progress = {});

/// An image with features over it (FBT §4.1): `features` of feature_scene, for this image.
struct FeaturedImage {
    RasterImage image;
    Scene features;
    double invalidate = 1; ///< pixels, ≥ 0: in the infinity norm; nearer to a feature a pixel is no sample (FBT §4.3)
};

/// Bytes of memory that the FBT of an image may take on the way, about: what a pixel needs, and a region of a texel (a
/// texel without features is one), where pixels and texels are in no simple ratio (compiler/fbt/README.md).
std::uint64_t image_memory(std::uint64_t pixels, std::uint64_t regions);

/// More is refused: with it, the largest image at a texel a pixel can be made on a machine with 24 GiB.
inline constexpr std::uint64_t kMostImageMemory = std::uint64_t{20} << 30;

/// Builds the FBT of an image. Errors: as above; kImageMemory.
Result<FbtBuild> compile_fbt(const FeaturedImage& picture, const CompileOptions& options,
                             const ProgressSink& progress = {});

/// The FBT at the size, in texels on the longer side, with the cheapest lookup in at most `max_bytes` on the GPU: the
/// largest that fits, to 1/64. Without a limit (0) the smallest power of two of which twice as many texels make lookups
/// cheaper by less than a quarter. options.size is ignored. A larger size that can't be built, for want of memory too,
/// ends the search. Errors: those of compile_fbt; kFbtBudget if no size fits.
Result<FbtBuild> compile_fbt_at_chosen_size(const Scene& scene, const CompileOptions& options, std::uint64_t max_bytes,
                                            const ProgressSink& progress = {});

/// The same of an image, with a limit up to as many texels as pixels: more show nothing more. Without, from there on
/// twice or four times as many along a side while lookups get cheaper by a quarter: fewer would show less of the image.
Result<FbtBuild> compile_fbt_at_chosen_size(const FeaturedImage& picture, const CompileOptions& options,
                                            std::uint64_t max_bytes, const ProgressSink& progress = {});

} // namespace fetexc
