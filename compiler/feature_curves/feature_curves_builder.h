// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves (Parilov and Zorin 2008; formats/feature_curves.h) from networks.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/compile.h"
#include "compiler/feature_curves/base_map.h"
#include "compiler/feature_curves/distance_map.h"
#include "compiler/feature_curves/snapping.h"
#include "compiler/network/network.h"
#include "formats/feature_curves.h"

namespace fetexc {

struct FeatureCurvesOptions {
    GridSize size; ///< texels
    fetex::FeatureNumberFormat numbers = fetex::FeatureNumberFormat::Bits16;
    bool linear = false; ///< chords for curves; networks of lines always have linear textures
    fetex::FeatureKind kind = fetex::FeatureKind::Normal;
    fetex::FeatureSampleFormat sample_format = fetex::FeatureSampleFormat::Rgba8; ///< of the base map
    /// Texels; 0: as far as the profile reaches, and so much more that in texels where it begins the corners' distances
    /// are known.
    double limit = 0;
    std::uint32_t smooth = kGradientIterations; ///< iterations
    std::optional<FeatureProfile> profile;      ///< for all curves; none: as they and the network say
    /// Without an image: one sample. Heights are in user units here.
    BaseImage base;
    Rgba base_color;      ///< straight; of colours without an image
    bool mips = false;    ///< of what is shown
    unsigned threads = 1; ///< 0: all; never changes a byte
};

/// Deterministic: no times in here.
struct FeatureCurvesStats {
    std::uint64_t curves = 0, segments = 0; ///< of the network
    SnapStats snapping;
    std::uint64_t flat = 0;                       ///< segments so little bent that they are straight
    std::uint64_t straightened_by_rounding = 0;   ///< segments not valid with the numbers that the texture has
    std::uint64_t moved = 0;                      ///< texels that aren't as the network has them
    double farthest = 0;                          ///< of them: texels
    std::uint64_t texels_one = 0, texels_two = 0; ///< with one segment, two
    std::uint64_t corners_near = 0;               ///< nearer than the limit
    std::uint64_t curves_other_profile = 0;       ///< that ask for another than the texture's, or lie on others (W5148)
    std::uint64_t gpu_bytes = 0;
};

struct FeatureCurvesBuild {
    fetex::FeatureCurvesTexture texture;
    std::vector<FeatureProfile> profiles; ///< what the texture has, by number
    FeatureCurvesStats stats;
    std::vector<FeatureMove> moves; ///< of snapping
    std::vector<Diagnostic> diagnostics;
};

/// Errors: kSizeOutOfRange; those of lattice_lines and lattice_curves.
Result<FeatureCurvesBuild> compile_feature_curves(const Network& network, const FeatureCurvesOptions& options,
                                                  const ProgressSink& progress = {});

/// The largest size, by the longer side, of at most max_bytes on the GPU; options.size is ignored. Error
/// kFeatureBudget: none fits.
Result<FeatureCurvesBuild> compile_feature_curves_within(const Network& network, const FeatureCurvesOptions& options,
                                                         std::uint64_t max_bytes, const ProgressSink& progress = {});

/// Of a texture whose size is chosen by what curves may move.
struct FeatureLimits {
    double max_move = 0;         ///< user units: how far curves may be from where they belong; 0: none is asked for
    std::uint64_t max_bytes = 0; ///< on the GPU; 0: any
};

/// The smallest size, by the longer side, in which no curve moves farther (SnappedCurves::moves, so ends that are cut
/// count), to 1/16 and up to 4096 texels; options.size is ignored. With a base map at least its pixels. Nothing asked
/// for: a quarter of the narrowest profile's width (budget::kFeatureChosenMove), or the best of up to 1024 texels.
/// Errors kFeatureBudget; kFeatureErrorUnmet: none is as good.
Result<FeatureCurvesBuild> compile_feature_curves_at_chosen_size(const Network& network,
                                                                 const FeatureCurvesOptions& options,
                                                                 FeatureLimits limits,
                                                                 const ProgressSink& progress = {});

/// How far curves are from where they belong at options.size, user units; what lies inside a texel and is lost, by a
/// texel's diagonal. Errors: those of lattice_lines and lattice_curves.
Result<double> feature_curves_move(const Network& network, const FeatureCurvesOptions& options);

/// On the GPU, at options.size.
std::uint64_t feature_curves_bytes(const Network& network, const FeatureCurvesOptions& options);

/// Texels that a user unit has: the mean of both sides'.
double texels_per_unit(const Network& network, GridSize size);

/// Entries of a profile.
inline constexpr std::uint32_t kFeatureProfileEntries = 256;

} // namespace fetexc
