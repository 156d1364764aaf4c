// SPDX-License-Identifier: GPL-3.0-or-later
/// Features over an image as a Scene, for the planar map (FBT §4.1, §4.2).
#pragma once

#include <vector>

#include "compiler/scene/scene_builder.h"

namespace fetexc {

/// Runs of segments, open or closed, in a frame of width×height (x right, y down).
struct FeatureCurves {
    double width = 0, height = 0; ///< > 0
    std::vector<CanvasContour> runs;
};

/// A run with those of its ends that lie on the border of its frame or beyond it prolonged straight away from it, as
/// far as the frame is wide or high; a closed one as it is. run: not empty.
CanvasContour prolonged(const CanvasContour& run, double width, double height);

/// A scene of one shape that holds every curve once, snapped and merged as a drawing's, in the direction in which it
/// counts +1 (so that no two cancel each other: there is an edge wherever a feature is). Ends on the border of the
/// image or beyond it go on away from it. Its extent is the image, in pixels. Windings and colours of this scene mean
/// nothing: its map is read with TexelMapper::tell_faces_apart and Separation::Edges. Errors: 3001, 3002, 3004.
Result<Scene> feature_scene(const FeatureCurves& features, std::uint32_t image_width, std::uint32_t image_height);

/// Some curve touches the canvas.
bool has_features(const Scene& scene);

} // namespace fetexc
