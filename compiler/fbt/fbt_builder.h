// SPDX-License-Identifier: GPL-3.0-or-later
/// Feature-based textures (FBT, Ramanarayanan et al. 2004) from the planar map.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/scene/compositor.h"

namespace fetexc {

/// For tests: which visible result each region of the texture stands for, in a compositor of the same scene.
struct FbtRegions {
    std::unique_ptr<Compositor> compositor;
    std::vector<std::pair<std::uint32_t, ResultId>>
        entries;                   ///< record index of an entry (last run or terminator), ascending
    std::vector<ResultId> corners; ///< (width+1)×(height+1): result of the corner region of each texel

    /// Result at a located region (fetex::fbt_locate).
    [[nodiscard]] ResultId result_of(const fetex::FbtRegion& region, std::uint32_t width) const;
};

/// Same bytes for any thread count. The scene must outlive `regions`.
Result<FbtBuild> build_fbt(const Scene& scene, const CompileOptions& options, const ProgressSink& progress,
                           FbtRegions* regions);

} // namespace fetexc
