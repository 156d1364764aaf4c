// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/snap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/scene/guard_box.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/vertex_merge.h"

namespace fetexc {
namespace {

/// Closed contours of all shapes, clipped, in lattice space but still in double.
struct Clipped {
    struct Contour {
        std::size_t first = 0, end = 0;
        std::uint32_t shape = 0;
    };
    std::vector<CanvasSegment> segments;
    std::vector<Contour> contours;
};

bool same(CanvasPoint a, CanvasPoint b) { return a.x == b.x && a.y == b.y; }

Error invalid(const char* message, const RawShape& shape, const Scene& scene) {
    const std::string place = shape.element < scene.elements.size() ? scene.elements[shape.element].name : "shape";
    return {ErrorClass::InvalidInput, diag::kSceneCoordinateInvalid, message, place};
}

Status check(const CanvasSegment& s, const RawShape& shape, const Scene& scene) {
    if (s.degree < 1 || s.degree > 3) return invalid("a segment's degree must be 1, 2 or 3", shape, scene);
    for (int i = 0; i <= s.degree; ++i)
        if (!std::isfinite(s.p[i].x) || !std::isfinite(s.p[i].y))
            return invalid("a coordinate is not a finite number", shape, scene);
    return {};
}

CanvasSegment line(CanvasPoint a, CanvasPoint b) {
    CanvasSegment s;
    s.p[0] = a;
    s.p[1] = b;
    return s;
}

/// The contour scaled, its gaps (usually only the last) closed by lines, clipped to the guard box.
void clip_contour(const CanvasContour& contour, LatticeScale scale, const GuardBox& box,
                  std::vector<CanvasSegment>& out) {
    std::optional<CanvasPoint> start, pen;
    for (const CanvasSegment& segment : contour) {
        const CanvasSegment s = to_lattice_space(segment, scale);
        if (!start) start = s.p[0];
        if (pen && !same(*pen, s.p[0])) clip_to_guard_box(line(*pen, s.p[0]), box, out);
        clip_to_guard_box(s, box, out);
        pen = s.p[s.degree];
    }
    if (pen && !same(*pen, *start)) clip_to_guard_box(line(*pen, *start), box, out);
}

Result<Clipped> clip_shapes(const std::vector<RawShape>& raw, Scene& scene) {
    Clipped out;
    const LatticeScale scale = lattice_scale(scene.extent);
    const GuardBox box = guard_box(scene.extent);
    std::size_t segments = 0, contours = 0;
    for (const RawShape& shape : raw) {
        contours += shape.contours.size();
        for (const CanvasContour& contour : shape.contours)
            segments += contour.size() + 1;
    }
    out.segments.reserve(segments);
    out.contours.reserve(contours);
    for (std::uint32_t shape = 0; shape < raw.size(); ++shape)
        for (const CanvasContour& contour : raw[shape].contours) {
            for (const CanvasSegment& s : contour)
                if (Status status = check(s, raw[shape], scene); !status) return status.error();
            scene.stats.segments_in += contour.size();
            const std::size_t first = out.segments.size();
            clip_contour(contour, scale, box, out.segments);
            out.contours.push_back({first, out.segments.size(), shape});
        }
    return out;
}

bool collinear(LatticePoint o, LatticePoint a, LatticePoint b) {
    // |differences| ≤ 2^29, so the products stay below 2^58
    return (a.x - o.x) * (b.y - o.y) == (a.y - o.y) * (b.x - o.x);
}

bool within_merge_distance(LatticePoint a, LatticePoint b) {
    return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y)) < budget::kMergeDistance;
}

/// With equal end points only a cubic that encloses something, and more than a merged point, is left.
bool vanishes(const Segment& s) {
    if (s.p[0] != s.p[s.degree]) return false;
    if (s.degree < 3 || collinear(s.p[0], s.p[1], s.p[2])) return true;
    return within_merge_distance(s.p[0], s.p[1]) && within_merge_distance(s.p[0], s.p[2]);
}

/// Borders drawn twice with rounding noise share their end points after the merge, but their handles may still differ.
/// A curve whose handles are all within the merge distance of an earlier curve's between the same end points takes them
/// over.
class TwinCurves {
  public:
    explicit TwinCurves(std::size_t segments) {
        chains_.reserve(segments);
        known_.reserve(segments);
    }
    void share(Segment& s) {
        if (s.degree == 1) return;
        const bool flipped = s.p[s.degree] < s.p[0];
        if (flipped) std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
        adopt(s);
        if (flipped) std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
    }

  private:
    /// Bounds the work when very many curves join the same two points; later ones then keep their own handles.
    static constexpr std::size_t kMaxTwins = 64;

    void adopt(Segment& s) {
        const auto [it, fresh] = chains_.try_emplace(key(s), static_cast<std::uint32_t>(known_.size()));
        if (fresh) return known_.push_back({s, kNone});
        std::uint32_t k = it->second;
        for (std::size_t twins = 1;; k = known_[k].next, ++twins) {
            if (is_twin(known_[k].curve, s)) {
                s.p = known_[k].curve.p;
                return;
            }
            if (twins == kMaxTwins) return;
            if (known_[k].next == kNone) break;
        }
        known_[k].next = static_cast<std::uint32_t>(known_.size());
        known_.push_back({s, kNone});
    }
    static bool is_twin(const Segment& twin, const Segment& s) {
        if (twin.degree != s.degree || twin.p[0] != s.p[0] || twin.p[s.degree] != s.p[s.degree]) return false;
        for (int i = 1; i < s.degree; ++i)
            if (!within_merge_distance(twin.p[i], s.p[i])) return false;
        return true;
    }
    /// Hashes of both end points; is_twin compares everything.
    static LatticePoint key(const Segment& s) {
        const std::size_t a = LatticePointHash{}(s.p[0]), b = LatticePointHash{}(s.p[s.degree]);
        return {static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)};
    }
    struct Known {
        Segment curve;
        std::uint32_t next = kNone; ///< with the same key
    };
    std::vector<Known> known_;
    std::unordered_map<LatticePoint, std::uint32_t, LatticePointHash> chains_; ///< key → first
};

CanvasPoint shifted(CanvasPoint p, double dx, double dy) { return {p.x + dx, p.y + dy}; }

double displacement(CanvasPoint from, LatticePoint to) {
    return std::hypot(static_cast<double>(to.x) - from.x, static_cast<double>(to.y) - from.y);
}

/// Snaps one clipped segment: end points go to their leaders, a handle follows its end point (a quadratic's handle
/// follows the mean of both), then snaps.
Segment snap_segment(const CanvasSegment& s, const VertexMerge& merge) {
    Segment out;
    out.degree = s.degree;
    const CanvasPoint p0 = s.p[0], p1 = s.p[s.degree];
    const LatticePoint a = merge.leader(snap(p0)), b = merge.leader(snap(p1));
    out.p[0] = a;
    out.p[s.degree] = b;
    const double ax = static_cast<double>(a.x) - p0.x, ay = static_cast<double>(a.y) - p0.y;
    const double bx = static_cast<double>(b.x) - p1.x, by = static_cast<double>(b.y) - p1.y;
    if (s.degree == 2) out.p[1] = snap(shifted(s.p[1], (ax + bx) / 2, (ay + by) / 2));
    if (s.degree == 3) out.p[1] = snap(shifted(s.p[1], ax, ay)), out.p[2] = snap(shifted(s.p[2], bx, by));
    return out;
}

/// A there-and-back line pair encloses nothing.
bool contour_vanishes(const std::vector<Segment>& segments, std::size_t first) {
    return segments.size() - first == 2 && segments[first].degree == 1 && segments[first + 1].degree == 1;
}

void append_contour(const Clipped& clipped, const Clipped::Contour& contour, const VertexMerge& merge,
                    TwinCurves& twins, Scene& scene) {
    const std::size_t first = scene.segments.size();
    for (std::size_t i = contour.first; i < contour.end; ++i) {
        const CanvasSegment& from = clipped.segments[i];
        Segment to = snap_segment(from, merge);
        twins.share(to);
        for (int k = 0; k <= to.degree; ++k)
            scene.stats.max_displacement = std::max(scene.stats.max_displacement, displacement(from.p[k], to.p[k]));
        if (vanishes(to))
            ++scene.stats.segments_zero;
        else
            scene.segments.push_back(to);
    }
    if (!contour_vanishes(scene.segments, first)) return;
    scene.segments.resize(first);
    scene.stats.segments_zero += 2;
}

} // namespace

Status snap_shapes(const std::vector<RawShape>& raw, Scene& scene) {
    Result<Clipped> result = clip_shapes(raw, scene);
    if (!result) return result.error();
    const Clipped& clipped = result.value();
    if (clipped.segments.size() >= kNone)
        return Error{ErrorClass::InvalidInput, diag::kSceneTooLarge, "more path segments than 32-bit indices hold", ""};

    VertexMerge merge(clipped.segments.size());
    for (const CanvasSegment& s : clipped.segments) // contours are closed: every joint is one segment's start
        merge.add(snap(s.p[0]));
    merge.run();
    scene.stats.vertices_in += clipped.segments.size();
    scene.stats.vertices_merged += merge.merged();

    TwinCurves twins(clipped.segments.size());
    scene.segments.clear();
    scene.segments.reserve(clipped.segments.size());
    scene.shapes.assign(raw.size(), Shape{});
    auto contour = clipped.contours.begin();
    for (std::uint32_t i = 0; i < raw.size(); ++i) {
        Shape& shape = scene.shapes[i];
        shape = {static_cast<std::uint32_t>(scene.segments.size()), 0, raw[i].rule, raw[i].element};
        for (; contour != clipped.contours.end() && contour->shape == i; ++contour)
            append_contour(clipped, *contour, merge, twins, scene);
        shape.count = static_cast<std::uint32_t>(scene.segments.size()) - shape.first;
    }
    return {};
}

} // namespace fetexc
