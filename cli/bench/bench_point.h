// SPDX-License-Identifier: GPL-3.0-or-later
/// What `bench` finds out about one texture. What depends on the clock is kept apart from what doesn't.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/measure/curve_errors.h"
#include "compiler/measure/equal_error.h"
#include "compiler/measure/errors.h"
#include "runtime_glsl/host/sampler_cost.h"

namespace fetexc::cli {

/// Names of methods in tables and plots; the alternatives' are measure::alternative_name's.
inline constexpr const char* kFbtMethod = "feature-based texture";
inline constexpr const char* kBilevelOneMethod = "bi-level R8";
inline constexpr const char* kBilevelMethod = "bi-level of 1 to 3 channels";
inline constexpr const char* kSilmapMethod = "silhouette map";
inline constexpr const char* kSilmapWideMethod = "silhouette map, 16-bit cells";
inline constexpr const char* kPinchmapMethod = "pinchmap";
/// Of curves (curve_sweep.h).
inline constexpr const char* kCurvesMethod = "feature curves";
inline constexpr const char* kStraightCurvesMethod = "straight feature curves";
inline constexpr const char* kNormalMapMethod = "bilinear normal map";

/// By the clock, in one run on one machine.
struct BenchTimes {
    double compile_seconds = 0; ///< processor time, one thread
    double compile_ratio = 0;   ///< median of the ratios to the yardstick (compile_time.h)
    std::optional<fetex::SamplerCost> sampler;
    std::string why_no_sampler;                          ///< if there is none
    std::optional<fetex::SamplerCost> area_sampler = {}; ///< of means over pixels, where the sampler has them
};

struct BenchPoint {
    std::string file;
    std::string method;
    std::string options;    ///< "size=64"
    std::uint32_t size = 0; ///< of the sweep: texels on the longer side of the FBT, or of the texture with feature
                            ///< curves; the others have its bytes
    GridSize texels;
    std::uint64_t bytes = 0;                             ///< on a GPU
    std::string note;                                    ///< why there are no figures, e.g. "not applicable: 5 colours"
    double texel_side = 0;                               ///< width units
    std::vector<measure::SizeErrors> errors;             ///< one entry for each output size
    std::vector<measure::CurveErrors> curve_errors = {}; ///< instead, of what is made of curves
    std::optional<measure::EqualErrorBitmap> equal_bitmap; ///< for FBTs: at the last output size
    std::optional<BenchTimes> times;
};

/// A drawing and everything made of it.
struct BenchFile {
    std::string path;
    bool two_colors = false;                   ///< textures of one channel apply
    std::vector<BenchPoint> points = {};       ///< none of a network
    std::vector<BenchPoint> curve_points = {}; ///< held against what its curves should show
};

} // namespace fetexc::cli
