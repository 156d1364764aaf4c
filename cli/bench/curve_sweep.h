// SPDX-License-Identifier: GPL-3.0-or-later
/// The curves of one drawing, or a network's, at every size: as textures with feature curves, and as an ordinary normal
/// map in as many bytes. The truth is the surface that the curves' profiles make of a plane (measure/curve_truth.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/bench/bench_point.h"
#include "cli/bench/sampler_timer.h"
#include "cli/bench/sweep.h"

namespace fetexc::cli {

/// Fills in out.curve_points. bytes: of the file at out.path. Diagnostics are those of network_of_bytes, and errors
/// too, and those of compile_feature_curves. timer: null when nothing is timed.
Status sweep_curves(const std::vector<std::uint8_t>& bytes, const SweepOptions& options, SamplerTimer* timer,
                    const ProgressSink& progress, std::vector<Diagnostic>& diagnostics, BenchFile& out);

} // namespace fetexc::cli
