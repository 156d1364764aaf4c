// SPDX-License-Identifier: GPL-3.0-or-later
/// What a bi-level texture shows: a part of the canvas, "above", and its outline.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/planar/visible_edges.h"
#include "compiler/raster/image.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Width units as of VisibleEdge. Every edge of the outline inside the canvas once, with what is above on its left.
struct Silhouette {
    double height = 1;              ///< of the canvas
    std::vector<VisibleEdge> edges; ///< left = 1, right = 0; neighbours share their end points bit for bit
    bool above_everywhere = false;  ///< where there is no edge at all
    double pixelated = 0;           ///< width units: side of the pixels that the outline comes from; 0: none
    Rgba below, above; ///< premultiplied; of several on a side that with the longest edges, of those that vary the mean
                       ///< along their edges, of a bitmap the mean
    std::uint64_t edges_varying = 0; ///< edges with a colour that isn't solid on a side
};

/// 0 black … 1 white: of premultiplied, sRGB-encoded colours (weights of ITU-R BT.709).
inline double luma_over_white(const Rgba& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b + (1 - c.a); }

/// What is above. Of a drawing, each shape's paint over the same others as a whole: one that varies is told by the mean
/// along its edges.
struct SilhouetteRule {
    enum class Kind : std::uint8_t {
        TwoColors, ///< the scene has two visible colours; the more opaque of them, else the darker
        Alpha,     ///< alpha above 1/2
        Luminance, ///< over white darker than 1/2 (the mean of R, G, B weighted as luma, sRGB-encoded)
        Element,   ///< inside the shapes of an element, whatever is drawn over it
    };
    Kind kind = Kind::TwoColors;
    std::string element; ///< id
};

/// Errors: those of PlanarMap::build; kNotTwoColors for a scene of more or fewer colours, or colours that vary;
/// kNoSuchElement.
Result<Silhouette> silhouette_of(const Scene& scene, const SilhouetteRule& rule, unsigned threads);

/// The outline of a picture: the line at one half between pixel centres, interpolated bilinearly (marching squares,
/// saddles by the mean of their four pixels). TwoColors: luminance if alpha never changes, else alpha.
/// No errors; Element is taken as TwoColors.
Result<Silhouette> silhouette_of(const RasterImage& image, const SilhouetteRule& rule);

/// A piece of the outline; above is on its left.
struct OutlineSegment {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// The outline in texels of a texture, curves in chords (budget::kOutlineChord), in the order of edges.
std::vector<OutlineSegment> outline_in_texels(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height);

} // namespace fetexc
