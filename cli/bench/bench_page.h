// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of `bench` as one HTML page for people who know nothing of this project: no script, nothing loaded.
#pragma once

#include <string>
#include <vector>

#include "cli/bench/bench_point.h"

namespace fetexc::cli {

struct BenchPageFacts {
    std::string version;                ///< of fetexc
    std::vector<std::uint32_t> sizes;   ///< texels
    std::vector<std::uint32_t> outputs; ///< pixels
    bool timed = false;
    std::string renderer; ///< that drew for the sampler costs; empty: none, see why_no_renderer
    std::string why_no_renderer;
    std::uint32_t sampler_rounds = 0, compile_rounds = 0;
};

std::string bench_page(const std::vector<BenchFile>& files, const BenchPageFacts& facts);

/// Error against bytes as an SVG file: over all drawings if they are of one kind, else over those of two colours.
std::string bench_plot(const std::vector<BenchFile>& files);

} // namespace fetexc::cli
