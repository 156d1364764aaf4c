// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/guard_box.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/scene/bezier.h"

namespace fetexc {
namespace {

using bezier::Axis;

/// Handles may still move with a merged end point, and must stay within kLatticeLimit then.
constexpr double kHandleLimit = static_cast<double>(kLatticeLimit) - 2 * budget::kMergeDistance;
/// Control polygons approach the curve fourfold per halving, and a curve in the box needs two to fit the limit.
constexpr int kMaxHalvings = 8;

bool contains(const GuardBox& box, CanvasPoint p) {
    return p.x >= box.x0 && p.x <= box.x1 && p.y >= box.y0 && p.y <= box.y1;
}

CanvasPoint clamped(const GuardBox& box, CanvasPoint p) {
    return {std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)};
}

bool handles_fit(const CanvasSegment& s) {
    for (int i = 1; i < s.degree; ++i)
        if (std::abs(s.p[i].x) > kHandleLimit || std::abs(s.p[i].y) > kHandleLimit) return false;
    return true;
}

/// Parameters where one coordinate equals `border`, appended unsorted.
void add_crossings(const CanvasSegment& s, Axis axis, double border, std::vector<double>& out) {
    std::vector<double> breaks{0};
    const bezier::Parameters turns = bezier::extrema(s, axis);
    for (double t : turns.all())
        breaks.push_back(t);
    breaks.push_back(1);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double before = bezier::value_at(s, axis, breaks[i]) - border;
        const double after = bezier::value_at(s, axis, breaks[i + 1]) - border;
        if (before == 0) out.push_back(breaks[i]);
        if ((before < 0 && after > 0) || (before > 0 && after < 0))
            out.push_back(bezier::solve_monotone(s, axis, border, breaks[i], breaks[i + 1]));
    }
}

/// 0, every parameter on one of the four border lines, 1; ascending.
std::vector<double> border_parameters(const CanvasSegment& s, const GuardBox& box) {
    std::vector<double> t{0, 1};
    add_crossings(s, Axis::X, box.x0, t);
    add_crossings(s, Axis::X, box.x1, t);
    add_crossings(s, Axis::Y, box.y0, t);
    add_crossings(s, Axis::Y, box.y1, t);
    std::sort(t.begin(), t.end());
    t.erase(std::unique(t.begin(), t.end()), t.end());
    return t;
}

void add_line(CanvasPoint a, CanvasPoint b, std::vector<CanvasSegment>& out) {
    if (a.x == b.x && a.y == b.y) return;
    CanvasSegment line;
    line.p[0] = a;
    line.p[1] = b;
    out.push_back(line);
}

/// A curve inside the box may have handles far outside it; halving pulls them in.
void add_inside(const CanvasSegment& s, const GuardBox& box, int halvings, std::vector<CanvasSegment>& out) {
    if (handles_fit(s)) {
        out.push_back(s);
        return;
    }
    CanvasSegment first = bezier::part(s, 0, 0.5), second = bezier::part(s, 0.5, 1);
    first.p[first.degree] = second.p[0] = clamped(box, second.p[0]);
    if (halvings == kMaxHalvings) { // only a curve that leaves the box by rounding gets here
        add_line(s.p[0], s.p[s.degree], out);
        return;
    }
    add_inside(first, box, halvings + 1, out);
    add_inside(second, box, halvings + 1, out);
}

/// Between two neighbouring border parameters the curve stays in the box or in one of its eight outer regions.
void add_part(const CanvasSegment& s, const GuardBox& box, double t0, double t1, std::vector<CanvasSegment>& out) {
    const CanvasPoint a = clamped(box, bezier::point_at(s, t0)), b = clamped(box, bezier::point_at(s, t1));
    if (!contains(box, bezier::point_at(s, t0 + (t1 - t0) / 2))) return add_line(a, b, out);
    CanvasSegment inside = bezier::part(s, t0, t1);
    inside.p[0] = a;
    inside.p[inside.degree] = b;
    add_inside(inside, box, 0, out);
}

} // namespace

GuardBox guard_box(const Extent& extent) {
    const auto margin = static_cast<double>(kLatticeSteps);
    return {-margin, -margin, static_cast<double>(extent.lattice_w) + margin,
            static_cast<double>(extent.lattice_h) + margin};
}

void clip_to_guard_box(const CanvasSegment& s, const GuardBox& box, std::vector<CanvasSegment>& out) {
    if (hull_inside(s, box)) {
        out.push_back(s);
        return;
    }
    const std::vector<double> t = border_parameters(s, box);
    for (std::size_t i = 0; i + 1 < t.size(); ++i)
        add_part(s, box, t[i], t[i + 1], out);
}

} // namespace fetexc
