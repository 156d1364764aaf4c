// SPDX-License-Identifier: GPL-3.0-or-later
/// Bezier networks: feature curves, open or closed, that may meet and cross anywhere (DESIGN §4; Parilov and Zorin
/// 2008, §3). Frame: canvas space, x right, y down, the picture is [0,width]×[0,height]; curves may go beyond.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/network/profile.h"
#include "compiler/raster/feature_scene.h"
#include "compiler/scene/scene_builder.h"

namespace fetexc {

struct NetworkCurve {
    std::string name;
    /// Lines, quadratics and cubics; each begins where the one before ends, and none is a single point. Not empty.
    std::vector<CanvasSegment> segments;
    bool closed = false; ///< the last segment ends where the first begins, and the curve goes on there
    std::string profile; ///< name of what is done near the curve (find_profile); empty: the network's
    /// Values on the sides, straight alpha; seen along the curve, y being down, right is where y is for x.
    std::optional<Rgba> left, right;
};

struct Network {
    double width = 0, height = 0; ///< user units, > 0
    std::vector<NetworkCurve> curves;
    std::vector<FeatureProfile> profiles = {}; ///< by name
    std::string profile = {};                  ///< what curves without one have; empty: what most curves have
};

/// Larger sides of the canvas: a preset that is named without a width.
inline constexpr double kPresetWidth = 1.0 / 64;

/// The network's profile of that name, or the preset (profile.h).
std::optional<FeatureProfile> find_profile(const Network& network, const std::string& name);

/// How many segments all curves have.
std::uint64_t segment_count(const Network& network);

/// The features of a drawing: middles of strokes, and edges. A curve is closed if it ends where it begins. Segments
/// that are single points are left out.
Network network_of(const FeatureCurves& features);

/// All control points are the same.
bool is_point(const CanvasSegment& s);

} // namespace fetexc
