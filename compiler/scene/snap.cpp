// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/snap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/flat_index.h"
#include "compiler/scene/guard_box.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/vertex_merge.h"

namespace fetexc {
namespace {

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

/// Closed contours clipped, in lattice space but still in double. Doing it again when they are needed again is cheaper
/// than to keep them.
class ContourClipper {
  public:
    explicit ContourClipper(const Extent& extent) : scale_(lattice_scale(extent)), box_(guard_box(extent)) {}

    /// The contour scaled, its gaps (usually only the last) closed by lines, clipped to the guard box. Each segment
    /// starts exactly where the one before it ends. Valid until the next call.
    const std::vector<CanvasSegment>& clip(const CanvasContour& contour) {
        clipped_.clear();
        if (contour.empty()) return clipped_;
        CanvasPoint start, pen;
        for (const CanvasSegment& segment : contour) {
            const CanvasSegment s = to_lattice_space(segment, scale_);
            if (&segment == contour.data())
                start = s.p[0];
            else if (!same(pen, s.p[0]))
                append(line(pen, s.p[0]));
            append(s);
            pen = s.p[s.degree];
        }
        if (!same(pen, start)) append(line(pen, start));
        return clipped_;
    }

  private:
    void append(const CanvasSegment& s) {
        if (hull_inside(s, box_))
            clipped_.push_back(s);
        else
            clip_to_guard_box(s, box_, clipped_);
    }

    LatticeScale scale_;
    GuardBox box_;
    std::vector<CanvasSegment> clipped_;
};

std::size_t count_segments(const std::vector<RawShape>& raw) {
    std::size_t segments = 0;
    for (const RawShape& shape : raw)
        for (const CanvasContour& contour : shape.contours)
            segments += contour.size() + 1;
    return segments;
}

/// Adds the start of every clipped segment to `merge`, and its number there to `joints`: contours are closed, so every
/// joint is one segment's start.
Status add_joints(const std::vector<RawShape>& raw, ContourClipper& clipper, VertexMerge& merge,
                  std::vector<std::uint32_t>& joints, Scene& scene) {
    for (const RawShape& shape : raw)
        for (const CanvasContour& contour : shape.contours) {
            for (const CanvasSegment& s : contour)
                if (Status status = check(s, shape, scene); !status) return status.error();
            scene.stats.segments_in += contour.size();
            for (const CanvasSegment& s : clipper.clip(contour)) {
                if (joints.size() + 1 >= kNone)
                    return Error{ErrorClass::InvalidInput, diag::kSceneTooLarge,
                                 "more path segments than 32-bit indices hold", ""};
                joints.push_back(merge.add(snap(s.p[0])));
            }
        }
    return {};
}

bool collinear(LatticePoint o, LatticePoint a, LatticePoint b) {
    // |differences| ≤ 2^29, so the products stay below 2^58
    return (a.x - o.x) * (b.y - o.y) == (a.y - o.y) * (b.x - o.x);
}

bool within_merge_distance(LatticePoint a, LatticePoint b) {
    const std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return static_cast<double>(dx * dx + dy * dy) < budget::kMergeDistance * budget::kMergeDistance;
}

/// With equal end points only a cubic that encloses something, and more than a merged point, is left.
bool vanishes(const Segment& s) {
    if (s.p[0] != s.p[s.degree]) return false;
    if (s.degree < 3 || collinear(s.p[0], s.p[1], s.p[2])) return true;
    return within_merge_distance(s.p[0], s.p[1]) && within_merge_distance(s.p[0], s.p[2]);
}

/// A segment's end points as joints, by the numbers of their leaders.
struct Ends {
    std::uint32_t first = kNone, last = kNone;
};

/// Borders drawn twice with rounding noise share their end points after the merge, but their handles may still differ.
/// A curve whose handles are all within the merge distance of an earlier curve's between the same end points takes them
/// over.
class TwinCurves {
  public:
    void share(Segment& s, Ends ends) {
        if (s.degree == 1) return;
        const bool flipped = s.p[s.degree] < s.p[0];
        if (flipped) std::swap(ends.first, ends.last);
        if (flipped) std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
        adopt(s, ends);
        if (flipped) std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
    }

  private:
    /// Bounds the work when very many curves join the same two points; later ones then keep their own handles.
    static constexpr std::size_t kMaxTwins = 64;

    void adopt(Segment& s, Ends ends) {
        const auto number = static_cast<std::uint32_t>(known_.size());
        const auto [first, fresh] = chains_.try_emplace(std::uint64_t{ends.first} << 32 | ends.last, number);
        if (fresh) return known_.push_back({s.degree, s.p[1], s.p[2]});
        std::uint32_t k = first;
        for (std::size_t twins = 1;; k = known_[k].next, ++twins) {
            if (is_twin(known_[k], s)) {
                s.p[1] = known_[k].p1;
                if (s.degree == 3) s.p[2] = known_[k].p2;
                return;
            }
            if (twins == kMaxTwins) return;
            if (known_[k].next == kNone) break;
        }
        known_[k].next = number;
        known_.push_back({s.degree, s.p[1], s.p[2]});
    }

    struct Known {
        int degree = 0;
        LatticePoint p1, p2;        ///< handles; p2 only of a cubic
        std::uint32_t next = kNone; ///< between the same end points
    };
    static bool is_twin(const Known& twin, const Segment& s) {
        if (twin.degree != s.degree || !within_merge_distance(twin.p1, s.p[1])) return false;
        return s.degree == 2 || within_merge_distance(twin.p2, s.p[2]);
    }
    struct Hash {
        std::size_t operator()(std::uint64_t ends) const { return static_cast<std::size_t>(mixed_bits(ends)); }
    };
    std::vector<Known> known_;
    FlatIndex<std::uint64_t, Hash> chains_; ///< both ends → first
};

/// The largest move of a control point.
class Displacement {
  public:
    void add(CanvasPoint from, LatticePoint to) {
        const double dx = static_cast<double>(to.x) - from.x, dy = static_cast<double>(to.y) - from.y;
        if (dx * dx + dy * dy < ignored_) return;
        max_ = std::max(max_, std::hypot(dx, dy));
        ignored_ = 0.999 * max_ * max_;
    }
    [[nodiscard]] double max() const { return max_; }

  private:
    double max_ = 0;
    double ignored_ = 0; ///< certainly less than max_, squared
};

CanvasPoint shifted(CanvasPoint p, double dx, double dy) { return {p.x + dx, p.y + dy}; }

/// Snaps one clipped segment whose end points go to a and b: a handle follows its end point (a quadratic's handle
/// follows the mean of both), then snaps.
Segment snap_segment(const CanvasSegment& s, LatticePoint a, LatticePoint b) {
    Segment out;
    out.degree = s.degree;
    out.p[0] = a;
    out.p[s.degree] = b;
    if (s.degree == 1) return out;
    const CanvasPoint p0 = s.p[0], p1 = s.p[s.degree];
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

/// Writes the scene's segments, contour by contour.
class SegmentWriter {
  public:
    SegmentWriter(const VertexMerge& merge, Scene& scene) : merge_(merge), scene_(scene) {}

    /// `joints`: where each segment of the closed contour starts.
    void append(std::span<const CanvasSegment> contour, std::span<const std::uint32_t> joints) {
        const std::size_t first = scene_.segments.size();
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const std::uint32_t next = joints[i + 1 == contour.size() ? 0 : i + 1];
            assert(merge_.at(next) == snap(contour[i].p[contour[i].degree]));
            append(contour[i], {merge_.leader(joints[i]), merge_.leader(next)});
        }
        if (!contour_vanishes(scene_.segments, first)) return;
        scene_.segments.resize(first);
        scene_.stats.segments_zero += 2;
    }
    [[nodiscard]] double max_displacement() const { return displacement_.max(); }

  private:
    void append(const CanvasSegment& from, Ends ends) {
        Segment to = snap_segment(from, merge_.at(ends.first), merge_.at(ends.last));
        twins_.share(to, ends);
        for (int k = 0; k < to.degree; ++k) // the last is the next segment's first
            displacement_.add(from.p[k], to.p[k]);
        if (vanishes(to))
            ++scene_.stats.segments_zero;
        else
            scene_.segments.push_back(to);
    }

    const VertexMerge& merge_;
    Scene& scene_;
    TwinCurves twins_;
    Displacement displacement_;
};

void write_shapes(const std::vector<RawShape>& raw, ContourClipper& clipper, const VertexMerge& merge,
                  std::span<const std::uint32_t> joints, Scene& scene) {
    scene.segments.clear();
    scene.segments.reserve(joints.size());
    scene.shapes.clear();
    scene.shapes.reserve(raw.size());
    SegmentWriter writer(merge, scene);
    for (const RawShape& shape : raw) {
        const auto first = static_cast<std::uint32_t>(scene.segments.size());
        for (const CanvasContour& contour : shape.contours) {
            const std::vector<CanvasSegment>& clipped = clipper.clip(contour);
            writer.append(clipped, joints.first(clipped.size()));
            joints = joints.subspan(clipped.size());
        }
        const auto count = static_cast<std::uint32_t>(scene.segments.size()) - first;
        scene.shapes.push_back({first, count, shape.rule, shape.element});
    }
    scene.stats.max_displacement = std::max(scene.stats.max_displacement, writer.max_displacement());
}

} // namespace

Status snap_shapes(const std::vector<RawShape>& raw, Scene& scene) {
    const std::size_t segments = count_segments(raw);
    ContourClipper clipper(scene.extent);
    VertexMerge merge(segments);
    std::vector<std::uint32_t> joints;
    joints.reserve(segments);
    if (Status status = add_joints(raw, clipper, merge, joints, scene); !status) return status.error();
    merge.run();
    scene.stats.vertices_in += joints.size();
    scene.stats.vertices_merged += merge.merged();
    write_shapes(raw, clipper, merge, joints, scene);
    return {};
}

} // namespace fetexc
