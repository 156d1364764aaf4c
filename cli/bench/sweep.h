// SPDX-License-Identifier: GPL-3.0-or-later
/// One drawing, or a network's curves, at every size: the texture, and what a user would pick instead, in as many
/// bytes.
#pragma once

#include <string>
#include <vector>

#include "cli/bench/bench_point.h"
#include "cli/bench/sampler_timer.h"
#include "cli/load_scene.h"

namespace fetexc::cli {

struct SweepOptions {
    std::vector<std::uint32_t> sizes;   ///< texels on the longer side of the FBT
    std::vector<std::uint32_t> outputs; ///< pixels on the longer side, where errors are measured
    SceneOptions scene;                 ///< raster_size 0: two pixels a texel of the largest size, at every size
    unsigned threads = 0;
    unsigned compile_rounds = 3;
    bool timing = true;
    bool equal_bitmap = true;
    /// Among what has the FBT's bytes: bi-level, silhouette-map textures, pinchmaps.
    bool bilevel = true, silmap = true, pinchmap = true;
    bool fbt = true;    ///< false: of drawings, too, curves alone
    bool curves = true; ///< what is made of curves, too
};

/// Diagnostics of the front end are appended. timer: null when nothing is timed. Errors of load_scene, compile_fbt,
/// compile_bilevel, compile_silmap, compile_pinchmap, measure and sweep_curves.
Result<BenchFile> sweep_file(const std::string& path, const SweepOptions& options, SamplerTimer* timer,
                             const ProgressSink& progress, std::vector<Diagnostic>& diagnostics);

} // namespace fetexc::cli
