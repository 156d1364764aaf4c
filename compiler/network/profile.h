// SPDX-License-Identifier: GPL-3.0-or-later
/// What is done near feature curves, as functions of the distance (Parilov and Zorin 2008, §3.1): the height h(d) of
/// the surface, the blending function b(d), and a colour. Distances, heights and widths are user units; h has no unit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

/// With t = d/width and H = height. All of them end flat, at 0.
enum class ProfileShape {
    Crease, ///< −H·(1−t)²: a valley with a sharp bottom
    Groove, ///< −H·(1−t²)²: a valley with a round bottom
    Ridge,  ///< H·(1−t)²: a sharp crest
    Seam,   ///< H·27/4·t·(1−t)²: a sharp valley between two swellings of height H, whose tops are at a third
    Table,  ///< FeatureProfile::heights
};
inline constexpr std::array<std::string_view, 4> kProfilePresets = {"crease", "groove", "ridge", "seam"};

struct ProfilePoint {
    double distance = 0, value = 0;
};
struct ProfileColor {
    double distance = 0;
    Rgba color; ///< sRGB-encoded, straight alpha
};

struct FeatureProfile {
    std::string name;
    ProfileShape shape = ProfileShape::Crease;
    double width = 0;  ///< the paper's w, > 0: farther away nothing is done
    double inner = 0;  ///< the paper's w0, 0 … width: as near as this only the profile counts
    double height = 0; ///< of presets
    /// Tables: distances strictly increase, the first is 0. Empty but for heights: the default.
    std::vector<ProfilePoint> heights; ///< at least two; between them a monotone cubic, beyond the last it is flat
    std::vector<ProfilePoint> blends;  ///< 0 … 1, linear between; default: a smooth step from inner to width
    std::vector<ProfileColor> colors;  ///< linear between; default: none
};

/// Precondition of all: distance ≥ 0.
double profile_height(const FeatureProfile& p, double distance);
/// The largest |h| at any distance.
double largest_height(const FeatureProfile& p);
/// dh/dd.
double profile_slope(const FeatureProfile& p, double distance);
/// 0: profile alone; 1, from width on: base map alone.
double profile_blend(const FeatureProfile& p, double distance);
std::optional<Rgba> profile_color(const FeatureProfile& p, double distance);

/// Of kProfilePresets; the height is a part of the width, so that slopes are moderate (kPresetSlope).
std::optional<FeatureProfile> preset_profile(std::string_view name, double width);
inline constexpr double kPresetSlope = 0.5; ///< height / width

} // namespace fetexc
