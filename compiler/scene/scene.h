// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene: what every front end produces and every representation is built from (DESIGN §2–§4).
///
/// Frames
/// - canvas space: user units, x right, y down, the picture is [0,width]×[0,height]. Paints live here.
/// - lattice space: integers; the canvas is [0,lattice_w]×[0,lattice_h], the larger of the two is 2^26.
///   canvas = lattice · (width/lattice_w, height/lattice_h). All geometry lives here, already snapped and merged, so
///   that ground truth and planar map see the same curves. Coordinates stay within kLatticeLimit in absolute value.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace fetexc {

inline constexpr std::int64_t kLatticeSteps = std::int64_t{1} << 26; ///< over the larger side of the extent
inline constexpr std::int64_t kLatticeLimit = std::int64_t{1} << 28; ///< |coordinate| bound after guard-box clipping
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct LatticePoint {
    std::int64_t x = 0, y = 0;
    friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
    friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// A point in canvas space (user units).
struct CanvasPoint {
    double x = 0, y = 0;
};

/// x' = a·x + c·y + e, y' = b·x + d·y + f (SVG order).
struct Affine {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
};

struct Extent {
    double width = 0, height = 0; ///< user units, > 0
    std::int64_t lattice_w = 0, lattice_h = 0;
};

/// sRGB-encoded colour, 0…1. Straight alpha in paints, premultiplied in compositing results (said where it matters).
struct Rgba {
    double r = 0, g = 0, b = 0, a = 0;
    friend bool operator==(const Rgba&, const Rgba&) = default;
};

/// A Bezier segment, degree 1…3, control points p[0..degree] in lattice space. Never a single point.
struct Segment {
    int degree = 1;
    std::array<LatticePoint, 4> p{};
};

enum class FillRule : std::uint8_t { NonZero, EvenOdd };

/// A closed path set: segments [first, first+count) form closed contours (the end points' signed sum is zero).
struct Shape {
    std::uint32_t first = 0, count = 0;
    FillRule rule = FillRule::NonZero;
    std::uint32_t element = kNone; ///< index into Scene::elements: where it came from
};

/// Equal neighbouring offsets are a hard edge; the front end turns hard edges into geometry (see split note in README).
struct GradientStop {
    double offset = 0;
    Rgba color; ///< straight alpha
};

enum class Spread : std::uint8_t { Pad, Reflect, Repeat };

struct SolidPaint {
    Rgba color; ///< straight alpha
};
/// t = x coordinate of canvas_to_unit(p).
struct LinearPaint {
    Affine canvas_to_unit;
    std::vector<GradientStop> stops;
    Spread spread = Spread::Pad;
};
/// Two-circle gradient as SVG 2: t=0 on circle (fx,fy,fr), t=1 on circle (cx,cy,r), in gradient space.
struct RadialPaint {
    Affine canvas_to_gradient;
    double cx = 0, cy = 0, r = 1, fx = 0, fy = 0, fr = 0;
    std::vector<GradientStop> stops;
    Spread spread = Spread::Pad;
};
/// A bitmap: premultiplied RGBA8, row-major, pixel (i,j) covers [i,i+1)×[j,j+1) in pixel space; transparent outside.
struct RasterPaint {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    Affine canvas_to_pixel;
    bool smooth = true; ///< bilinear between pixel centres (edge clamped), else nearest
};
using Paint = std::variant<SolidPaint, LinearPaint, RadialPaint, RasterPaint>;

/// Order of W3C Compositing 1.
enum class Blend : std::uint8_t {
    Normal,
    Multiply,
    Screen,
    Overlay,
    Darken,
    Lighten,
    ColorDodge,
    ColorBurn,
    HardLight,
    SoftLight,
    Difference,
    Exclusion,
    Hue,
    Saturation,
    Color,
    Luminosity,
};

/// Inside iff any member is inside and the parent clip (if any) is inside. No members: nothing is inside.
struct ClipMember {
    std::uint32_t shape = kNone;
    std::uint32_t clip = kNone; ///< the member's own clip-path
};
struct Clip {
    std::vector<ClipMember> members;
    std::uint32_t parent = kNone; ///< clip-path on the clipPath element
};

/// Node of the compositing tree, preorder: children of node i are i+1 … end-1.
struct Node {
    enum class Kind : std::uint8_t { Group, Fill };
    Kind kind = Kind::Fill;
    std::uint32_t end = 0;
    std::uint32_t clip = kNone;
    double opacity = 1;
    // Group (always composited in isolation when opacity < 1, blend ≠ Normal, mask or isolated; else transparent to its
    // parent)
    Blend blend = Blend::Normal;
    std::uint32_t mask = kNone;
    bool isolated = false;
    // Fill
    std::uint32_t shape = kNone, paint = kNone;
    std::uint32_t element = kNone;
};

/// Mask content is a tree of its own in Scene::nodes: [first, end). Outside region_shape (if any) the mask is 0.
struct Mask {
    std::uint32_t first = 0, end = 0;
    bool luminance = true;   ///< else alpha
    bool linear_rgb = false; ///< color-interpolation: linearRGB, for luminance
    std::uint32_t region_shape = kNone;
    std::uint32_t parent = kNone; ///< mask on the mask element
};

/// Place in the input, for diagnostics.
struct Element {
    std::string name; ///< e.g. "path#wheel", "text", "rect @ line 12"
};

struct SceneStats {
    std::uint64_t layers_in = 0, layers_empty = 0, layers_outside = 0, layers_hidden = 0, layers_transparent = 0;
    std::uint64_t segments_in = 0, segments_zero = 0, vertices_in = 0, vertices_merged = 0;
    double max_displacement = 0; ///< largest move of a control point by snapping and merging, in lattice steps
    std::uint64_t raster_layers = 0;
};

struct Scene {
    Extent extent;
    std::vector<Segment> segments;
    std::vector<Shape> shapes;
    std::vector<Paint> paints;
    std::vector<Clip> clips;
    std::vector<Mask> masks;
    std::vector<Node> nodes;
    std::uint32_t root_end = 0; ///< the picture is nodes [0, root_end); mask contents follow
    std::vector<Element> elements;
    SceneStats stats;
};

} // namespace fetexc
