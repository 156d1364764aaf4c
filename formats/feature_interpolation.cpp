// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/feature_interpolation.h"

#include <algorithm>
#include <cmath>

namespace fetex {
namespace {

using CornerValues = std::array<double, 4>;

constexpr std::uint32_t kEast = 1, kSouth = 2;
/// Points count as this far from the texel's edges where weights are taken: no set of corners has no weight then.
constexpr double kWeightMargin = 0x1p-20;

bool has(std::uint32_t set, std::uint32_t member) { return (set >> member & 1u) != 0; }

/// A texel's symmetry, undone: corner 0 of the frame is the corner `mirror`, x and y are exchanged after mirroring.
struct Frame {
    std::uint32_t mirror = 0; ///< kEast: x, kSouth: y
    bool exchange = false;

    [[nodiscard]] FeaturePoint to(FeaturePoint p) const {
        if (mirror & kEast) p.x = 1 - p.x;
        if (mirror & kSouth) p.y = 1 - p.y;
        return exchange ? FeaturePoint{p.y, p.x} : p;
    }
    /// The texel's corner that is `corner` of the frame.
    [[nodiscard]] std::uint32_t from(std::uint32_t corner) const {
        if (exchange) corner = (corner & kEast) << 1 | corner >> 1;
        return corner ^ mirror;
    }
};

/// A segment in its frame: opposite ones from the frame's north to its south; others around corner 0, from the
/// frame's north to its west.
struct Placed {
    Frame frame;
    bool opposite = false, reversed = false; ///< reversed: from the segment's second edge to its first
    FeaturePoint b0, b1, b2, p;
};

Placed place(FeatureSegment s, const FeatureQuadratic& curve, FeaturePoint p) {
    using enum FeatureEdge;
    Placed out;
    out.opposite = (s.first == North && s.second == South) || (s.first == East && s.second == West);
    out.frame.exchange = out.opposite && s.first == East;
    // East to west becomes, exchanged, south to north: mirrored.
    if (out.opposite)
        out.frame.mirror = s.first == East ? kEast : 0;
    else
        out.frame.mirror =
            (s.first == East || s.second == East ? kEast : 0) | (s.first == South || s.second == South ? kSouth : 0);
    out.b0 = out.frame.to(curve.b0), out.b1 = out.frame.to(curve.b1), out.b2 = out.frame.to(curve.b2);
    out.reversed = !out.opposite && s.first == East; // east to south: the south one is along x
    if (out.reversed) std::swap(out.b0, out.b2);
    out.p = out.frame.to(p);
    return out;
}

/// The root in 0 … 1 of the quadratic with Bernstein coefficients first ≥ 0, middle, last ≤ 0. There is one, and no
/// subtraction of what is alike.
double only_root(double first, double middle, double last) {
    const double root = std::sqrt(std::max(middle * middle - first * last, 0.0));
    const double up = middle >= 0 ? middle + root : first, down = middle >= 0 ? -last : root - middle;
    return up + down > 0 ? up / (up + down) : 0;
}

double cross(FeaturePoint a, FeaturePoint b) { return a.x * b.y - a.y * b.x; }
FeaturePoint minus(FeaturePoint a, FeaturePoint b) { return {a.x - b.x, a.y - b.y}; }

/// Of a point from the line through `at` that goes on to `towards` (or to `else_towards`, if they are one).
double from_line(FeaturePoint point, FeaturePoint at, FeaturePoint towards, FeaturePoint else_towards) {
    FeaturePoint along = minus(towards, at);
    if (along.x == 0 && along.y == 0) along = minus(else_towards, at);
    const double length = std::hypot(along.x, along.y);
    return length > 0 ? std::abs(cross(along, minus(point, at))) / length : 0;
}

/// What stands for the distance at a corner of the frame that the point doesn't reach: that from the curve's tangent at
/// its end nearby, or from its chord.
double stand_in(const Placed& s, std::uint32_t corner) {
    const FeaturePoint c{corner & kEast ? 1.0 : 0.0, corner & kSouth ? 1.0 : 0.0};
    if (!s.opposite && corner == (kEast | kSouth)) return from_line(c, s.b0, s.b2, s.b2);
    const bool at_first = s.opposite ? (corner & kSouth) == 0 : corner != kSouth;
    return at_first ? from_line(c, s.b0, s.b1, s.b2) : from_line(c, s.b2, s.b1, s.b0);
}

/// Values along the texel's edges from corner to corner: linear, but 0 at the point of an open edge.
class Border {
  public:
    Border(const FeatureTexel& texel, const Frame& frame, const CornerValues& values)
        : texel_(texel), frame_(frame), values_(values) {}

    /// Between two neighbouring corners of the frame, the first the one of lower x and y, at `along` of the way.
    [[nodiscard]] double at(std::uint32_t a, std::uint32_t b, double along) const {
        const double from = values_[a], to = values_[b];
        const std::uint32_t ca = frame_.from(a), cb = frame_.from(b);
        const std::uint32_t edge = edge_between(ca, cb);
        if (!has(texel_.open, edge)) return from + along * (to - from);
        const double q = ca < cb ? texel_.positions[edge] : 1 - texel_.positions[edge];
        return along < q ? from * (1 - along / q) : q < 1 ? to * ((along - q) / (1 - q)) : 0;
    }

  private:
    static std::uint32_t edge_between(std::uint32_t a, std::uint32_t b) {
        using enum FeatureEdge;
        const std::uint32_t low = std::min(a, b), high = std::max(a, b);
        if ((low ^ high) == kEast) return feature_edge_index(low & kSouth ? South : North);
        return feature_edge_index(low & kEast ? East : West);
    }

    const FeatureTexel& texel_;
    const Frame& frame_;
    const CornerValues& values_;
};

/// A point against one segment: on rays that each cross the curve once.
struct Side {
    std::uint32_t corners = 0;             ///< of the texel, on the point's side
    bool first = false;                    ///< the side of corner 0 of the frame
    double p = 0, curve = 0, far_side = 0; ///< along the ray: of the point, of the curve, of the border beyond it
    double along = 0;                      ///< of the curve there: its parameter

    /// From the curve, 0, to where the ray begins or ends, 1.
    [[nodiscard]] double share() const {
        const double of = first ? curve - p : p - curve, all = first ? curve : far_side - curve;
        return all > 0 ? of / all : 0;
    }
};

/// Opposite ends: rays along x, from 0 to 1. Else rays from corner 0, measured by x + y.
Side side_of(const Placed& s) {
    Side out;
    const double first = s.opposite ? s.p.y - s.b0.y : cross(s.b0, s.p),
                 middle = s.opposite ? s.p.y - s.b1.y : cross(s.b1, s.p),
                 last = s.opposite ? s.p.y - s.b2.y : cross(s.b2, s.p);
    out.along = only_root(first, middle, last);
    const FeaturePoint on = feature_curve_at({s.b0, s.b1, s.b2}, out.along);
    out.p = s.opposite ? s.p.x : s.p.x + s.p.y;
    out.curve = s.opposite ? on.x : on.x + on.y;
    const double farther = std::max(s.p.x, s.p.y);
    out.far_side = s.opposite ? 1 : farther > 0 ? out.p / farther : 1;
    out.first = out.p <= out.curve;
    for (std::uint32_t c = 0; c < kFeatureCorners; ++c)
        if ((s.opposite ? (c & kEast) == 0 : c == 0) == out.first) out.corners |= 1u << s.frame.from(c);
    return out;
}

/// Linear along the ray: 0 on the curve, the border's value on the border.
double distance_along(const Placed& s, const Side& side, const Border& border, const CornerValues& values) {
    const FeaturePoint p = s.p;
    const double share = side.share();
    if (side.first) return (s.opposite ? border.at(0, kSouth, p.y) : values[0]) * share;
    if (s.opposite) return share * border.at(kEast, kEast | kSouth, p.y);
    return share *
           (p.x >= p.y ? border.at(kEast, kEast | kSouth, p.y / p.x) : border.at(kSouth, kEast | kSouth, p.x / p.y));
}

/// No segment: bilinear, and less where an edge is open.
double distance_without(const FeatureTexel& texel, const CornerValues& d, FeaturePoint p) {
    const Frame frame;
    const Border border(texel, frame, d);
    const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
    double least = 0;
    const auto dip = [&](std::uint32_t a, std::uint32_t b, double along, double nearness) {
        least = std::min(least, nearness * (border.at(a, b, along) - mix(d[a], d[b], along)));
    };
    if (texel.open != 0) {
        dip(0, kEast, p.x, 1 - p.y), dip(kSouth, kEast | kSouth, p.x, p.y);
        dip(0, kSouth, p.y, 1 - p.x), dip(kEast, kEast | kSouth, p.y, p.x);
    }
    return std::max(mix(mix(d[0], d[1], p.x), mix(d[2], d[3], p.x), p.y) + least, 0.0);
}

} // namespace

FeatureRegion feature_region(const FeatureTexel& texel, const CornerValues& distances, FeaturePoint p) {
    const std::uint32_t count = texel.segments.count;
    if (count == 0) {
        FeatureRegion out;
        out.distance = distance_without(texel, distances, p);
        return out;
    }
    std::array<Placed, 2> placed;
    std::array<Side, 2> sides;
    std::uint32_t reached = kFeatureAllCorners;
    for (std::uint32_t k = 0; k < count; ++k) {
        placed[k] = place(texel.segments.segment[k], texel.curves[k], p);
        sides[k] = side_of(placed[k]);
        reached &= sides[k].corners;
    }
    FeatureRegion out;
    std::array<double, 2> along{};
    for (std::uint32_t k = 0; k < count; ++k) {
        CornerValues values{};
        for (std::uint32_t c = 0; c < kFeatureCorners; ++c) {
            const std::uint32_t corner = placed[k].frame.from(c);
            values[c] = reached == 0 || has(reached, corner) ? distances[corner] : stand_in(placed[k], c);
        }
        along[k] = distance_along(placed[k], sides[k], Border(texel, placed[k].frame, values), values);
        out.nearness[k] = 1 - sides[k].share();
        out.along[k] = placed[k].reversed ? 1 - sides[k].along : sides[k].along;
        const std::uint32_t beyond = kFeatureAllCorners & ~sides[k].corners,
                            others = count == 2 ? beyond & sides[1 - k].corners : beyond;
        out.across[k] = others != 0 ? others : beyond;
    }
    out.distance = count == 2 ? std::min(along[0], along[1]) : along[0];
    if (count == 2 && along[0] + along[1] > 0) out.second = along[0] / (along[0] + along[1]);
    // Segments that cross where they shouldn't leave parts without a corner: there the first decides alone.
    out.corners = reached != 0 ? reached : sides[0].corners;
    return out;
}

std::array<double, 4> feature_bilinear(std::uint32_t corners, FeaturePoint p) {
    const double x = std::clamp(p.x, kWeightMargin, 1 - kWeightMargin),
                 y = std::clamp(p.y, kWeightMargin, 1 - kWeightMargin);
    CornerValues w = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    double sum = 0;
    for (std::uint32_t c = 0; c < kFeatureCorners; ++c)
        sum += w[c] = has(corners, c) ? w[c] : 0;
    for (double& v : w)
        v /= sum;
    return w;
}

std::array<double, 4> feature_weights(const FeatureTexel& texel, std::uint32_t corners, FeaturePoint p) {
    CornerValues w = feature_bilinear(corners, p);
    // On an open edge each side of the point has the value of its own corner; that fades towards the edge across.
    const auto open = [&](FeatureEdge e, std::uint32_t a, std::uint32_t b, double along, double nearness) {
        if (!has(texel.open, feature_edge_index(e)) || !has(corners, a) || !has(corners, b)) return;
        const double more = nearness * ((along < texel.positions[feature_edge_index(e)] ? 0 : 1) - along);
        w[a] -= more, w[b] += more;
    };
    using enum FeatureEdge;
    open(North, 0, 1, p.x, 1 - p.y), open(South, 2, 3, p.x, p.y);
    open(West, 0, 2, p.y, 1 - p.x), open(East, 1, 3, p.y, p.x);
    double sum = 0;
    for (double& v : w)
        sum += v = std::max(v, 0.0);
    for (double& v : w)
        v /= sum;
    return w;
}

} // namespace fetex
