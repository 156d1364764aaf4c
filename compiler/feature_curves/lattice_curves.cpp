// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/lattice_curves.h"

#include <algorithm>
#include <utility>

#include "compiler/flat_index.h"
#include "compiler/network/simplify.h"
#include "compiler/scene/bezier.h"
#include "compiler/scene/guard_box.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/vertex_merge.h"

namespace fetexc {
namespace {

/// Ends by their number in a VertexMerge, and the control point.
struct Joint {
    std::uint32_t a = 0, b = 0;
    LatticePoint middle;
    bool straight = true;
    std::uint8_t profile = 0;
};

/// Exact: differences are below 2^30.
std::int64_t cross(const LatticePoint& o, const LatticePoint& p, const LatticePoint& q) {
    return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
}

class Collector {
  public:
    explicit Collector(std::size_t segments) : merge(segments + 1) {}

    void add(const CanvasSegment& s) {
        const LatticePoint first = snap(s.p[0]), last = snap(s.p[static_cast<std::size_t>(s.degree)]);
        if (s.degree == 1) return add_line(first, last);
        const LatticePoint middle = snap(s.p[1]);
        if (cross(first, middle, last) != 0)
            joints.push_back({merge.add(first), merge.add(last), middle, false, profile});
        else
            add_folded(s, first, last);
    }

    VertexMerge merge;
    std::vector<Joint> joints;
    std::uint8_t profile = 0; ///< of what is added

  private:
    void add_line(const LatticePoint& a, const LatticePoint& b) {
        joints.push_back({merge.add(a), merge.add(b), {}, true, profile});
    }

    /// A quadratic on a line may turn beyond its ends.
    void add_folded(const CanvasSegment& s, const LatticePoint& first, const LatticePoint& last) {
        const double dx = s.p[1].x - s.p[0].x, dy = s.p[1].y - s.p[0].y;
        const bezier::Parameters turn =
            bezier::extrema(s, std::abs(dx) > std::abs(dy) ? bezier::Axis::X : bezier::Axis::Y);
        LatticePoint at = first;
        for (const double t : turn.all()) {
            const LatticePoint next = snap(bezier::point_at(s, t));
            add_line(at, next);
            at = next;
        }
        add_line(at, last);
    }
};

struct CurveKey {
    std::uint64_t ends = 0, middle = 0;
    friend bool operator==(const CurveKey&, const CurveKey&) = default;
};
struct CurveHash {
    std::size_t operator()(const CurveKey& k) const {
        return static_cast<std::size_t>(mixed_bits(k.ends ^ mixed_bits(k.middle)));
    }
};

std::uint64_t packed(const LatticePoint& p) {
    return static_cast<std::uint64_t>(p.x) << 32 | (static_cast<std::uint64_t>(p.y) & 0xffffffffu);
}

/// Ends become numbered vertices; curves that are points then, or there already, are left out.
void take_leaders(const Collector& collected, LatticeCurves& out) {
    std::vector<std::uint32_t> number;
    const VertexMerge& merge = collected.merge;
    const auto vertex = [&](std::uint32_t point) {
        const std::uint32_t leader = merge.leader(point);
        if (number.size() <= leader) number.resize(leader + 1, kNone);
        if (number[leader] == kNone) {
            number[leader] = static_cast<std::uint32_t>(out.vertices.size());
            out.vertices.push_back(merge.at(leader));
        }
        return number[leader];
    };
    FlatIndex<CurveKey, CurveHash> known(collected.joints.size());
    for (const Joint& joint : collected.joints) {
        LatticeCurve curve{vertex(joint.a), vertex(joint.b), joint.middle, joint.straight, joint.profile};
        if (curve.a == curve.b) continue;
        // Ends have moved since.
        if (!curve.straight && cross(out.vertices[curve.a], curve.middle, out.vertices[curve.b]) == 0)
            curve.straight = true;
        if (curve.straight) curve.middle = {};
        const auto [low, high] = std::minmax(curve.a, curve.b);
        const CurveKey key{std::uint64_t{low} << 32 | high, curve.straight ? ~std::uint64_t{0} : packed(curve.middle)};
        const auto [first, is_new] = known.try_emplace(key, static_cast<std::uint32_t>(out.curves.size()));
        if (is_new)
            out.curves.push_back(curve);
        else
            out.overlaid += out.curves[first].profile != curve.profile;
    }
}

} // namespace

bool LatticeCurves::linear() const { return std::ranges::all_of(curves, &LatticeCurve::straight); }

LatticeCurves lattice_curves(const LatticeLines& lines) {
    LatticeCurves out{lines.extent, lines.vertices, {}, lines.overlaid};
    out.curves.reserve(lines.lines.size());
    for (std::size_t k = 0; k < lines.lines.size(); ++k)
        out.curves.push_back({lines.lines[k][0],
                              lines.lines[k][1],
                              {},
                              true,
                              lines.profiles.empty() ? std::uint8_t{0} : lines.profiles[k]});
    return out;
}

Result<LatticeCurves> lattice_curves(const Network& network, const TextureProfiles* profiles) {
    const Result<Extent> extent = make_extent(network.width, network.height);
    if (!extent) return extent.error();
    const Result<Network> quadratics = to_quadratics(network, quadratic_tolerance(network));
    if (!quadratics) return quadratics.error();
    LatticeCurves out{extent.value(), {}, {}, 0};
    Collector collected(segment_count(quadratics.value()));
    const LatticeScale scale = lattice_scale(out.extent);
    const GuardBox box = guard_box(out.extent);
    std::vector<CanvasSegment> inside;
    for (const NetworkCurve& curve : quadratics.value().curves) {
        inside.clear();
        for (const CanvasSegment& s : curve.segments) {
            const CanvasSegment scaled = to_lattice_space(s, scale);
            if (hull_inside(scaled, box))
                inside.push_back(scaled);
            else
                clip_to_guard_box(scaled, box, inside);
        }
        collected.profile = profiles != nullptr ? profiles->number_of(curve) : std::uint8_t{0};
        for (const CanvasSegment& s : inside)
            collected.add(s);
    }
    collected.merge.run();
    take_leaders(collected, out);
    return out;
}

} // namespace fetexc
