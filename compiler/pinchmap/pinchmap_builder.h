// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps with their signals (M. Tarini and P. Cignoni 2005, §7; formats/pinchmap.h) from scenes and images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/bilevel/silhouette.h"
#include "compiler/compile.h"
#include "compiler/pinchmap/gamma_fit.h"
#include "compiler/pinchmap/lost_edges.h"
#include "compiler/pinchmap/signal_fit.h"
#include "compiler/pinchmap/soft_edges.h"
#include "compiler/pinchmap/zone_mask.h"
#include "compiler/raster/feature_scene.h"
#include "formats/pinchmap.h"

namespace fetexc {

struct PinchmapOptions {
    GridSize size;           ///< clusters
    std::uint32_t scale = 0; ///< K: the signal has 2^K samples along a cluster's sides
    fetex::PinchmapFormat map_format = fetex::PinchmapFormat::Bits8;
    fetex::PinchmapSampleFormat sample_format = fetex::PinchmapSampleFormat::Rgba8; ///< Rgb8: alpha counts as 1
    /// Where the discontinuities are. None: of a scene all edges that lie between two zones (two_zones.h), of an image
    /// as of TwoColors.
    std::optional<SilhouetteRule> silhouette;
    bool mips = false;    ///< of the signal
    unsigned threads = 1; ///< 0: all; never changes a byte
};

/// Deterministic: no times in here.
struct PinchmapStats {
    std::uint64_t edges = 0;         ///< of the outline
    std::uint64_t edges_blurred = 0; ///< visible, between colours of one zone (W5133)
    MaskMoves zones;
    std::uint64_t active = 0;      ///< map texels where a discontinuity passes
    std::uint64_t crosses = 0;     ///< of them, where two cross: nothing is pinched (W5132)
    LostEdges lost_edges;          ///< where edges are blurred for want of clusters (W5131)
    SoftEdges soft_edges;          ///< where the image's transition is soft (W5133)
    std::uint64_t soft_texels = 0; ///< of the active ones, those and where a feature ends: strength below 1
    GammaFit gamma;
    SignalFit signal;
    double unmendable = 0; ///< square clusters, about, that are wrong because of the zones
    double wrong_area = 0; ///< part of the drawing on the wrong side of the discontinuities
    std::uint64_t gpu_bytes = 0;
};

struct PinchmapBuild {
    fetex::PinchmapTexture texture;
    PinchmapStats stats;
    std::vector<Diagnostic> diagnostics;
};

/// An image, and features over it: without any (no runs) its own transition says where the discontinuities are
/// (options.silhouette), else the features alone (feature_zones.h).
struct PinchedImage {
    const RasterImage& image;
    const FeatureCurves& features;
};

/// Errors: kSizeOutOfRange; those of silhouette_of, visible_edges, feature_zones and load_solver.
Result<PinchmapBuild> compile_pinchmap(const Scene& scene, const PinchmapOptions& options,
                                       const ProgressSink& progress = {});
Result<PinchmapBuild> compile_pinchmap(const PinchedImage& image, const PinchmapOptions& options,
                                       const ProgressSink& progress = {});

/// At a size of its own choice; options.size is ignored.
/// - max_wrong_area > 0 (part of the drawing): the smallest size, to 1/16, that has no more and fits in max_bytes (0:
/// no
///   limit). Error kPinchmapErrorUnmet: none does.
/// - else the largest size of at most max_bytes on the GPU. Error kPinchmapBudget: none fits.
/// - neither: up to budget::kPinchmapChosenError of wrong area, or the best that a size of up to 1024 clusters does.
Result<PinchmapBuild> compile_pinchmap_at_chosen_size(const Scene& scene, const PinchmapOptions& options,
                                                      std::uint64_t max_bytes, double max_wrong_area,
                                                      const ProgressSink& progress = {});
Result<PinchmapBuild> compile_pinchmap_at_chosen_size(const PinchedImage& image, const PinchmapOptions& options,
                                                      std::uint64_t max_bytes, double max_wrong_area,
                                                      const ProgressSink& progress = {});

} // namespace fetexc
