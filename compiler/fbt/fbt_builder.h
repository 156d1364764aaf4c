// SPDX-License-Identifier: GPL-3.0-or-later
/// Feature-based textures (FBT, Ramanarayanan et al. 2004) from the planar map.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/fbt/row_writer.h"
#include "compiler/planar/reachability.h"
#include "compiler/scene/compositor.h"

namespace fetexc {

/// For tests: which visible result each region of the texture stands for, in a compositor of the same scene.
struct FbtRegions {
    std::unique_ptr<Compositor> compositor;
    std::vector<RegionEntry> entries; ///< ascending records
    std::vector<ResultId> corners;    ///< (width+1)×(height+1): result of the corner region of each texel
    std::optional<ReachabilityGraph> reachability;

    /// Result at a located region (fetex::fbt_locate).
    [[nodiscard]] ResultId result_of(const fetex::FbtRegion& region, std::uint32_t width) const;
    /// Its vertex in the reachability graph.
    [[nodiscard]] std::uint32_t vertex_of(const fetex::FbtRegion& region) const;
};

/// Same bytes for any thread count. The scene must outlive `regions`.
Result<FbtBuild> build_fbt(const Scene& scene, const CompileOptions& options, const ProgressSink& progress,
                           FbtRegions* regions);

/// Both sides of the texture, one of them by aspect where it isn't given. Error kSizeOutOfRange.
Result<GridSize> texels_for(const Extent& extent, GridSize size);

/// The texture of a map whose edges are features whatever lies beside them (Separation::Edges), with samples from
/// elsewhere. graph: of the map. The report is added to.
Result<FbtBuild> build_fbt_of_features(const Scene& features, const PlanarMap& map, const ReachabilityGraph& graph,
                                       const SampleSource& samples, CompileReport report, const CompileOptions& options,
                                       const ProgressSink& progress);

} // namespace fetexc
