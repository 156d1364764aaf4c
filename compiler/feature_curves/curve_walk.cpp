// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/curve_walk.h"

#include <algorithm>
#include <cmath>

#include "compiler/geometry/polynomial.h"

namespace fetexc {
namespace {

__extension__ using Wide = __int128;

Interval square_root(const Interval& v) {
    return {std::max(widen_down(std::sqrt(std::max(v.lo, 0.0))), 0.0), widen_up(std::sqrt(std::max(v.hi, 0.0)))};
}

bool holds_zero(const Interval& v) { return v.lo <= 0 && v.hi >= 0; }

/// The last of the grid lines before a maximum of base + half²/−bend, or the first behind a minimum; a line that is
/// only touched isn't.
std::int32_t line_at_extremum(std::int64_t base, std::int64_t half, std::int64_t bend, std::int64_t pitch,
                              std::uint32_t count) {
    const bool maximum = bend < 0;
    const double value =
        static_cast<double>(base) - static_cast<double>(half) * (static_cast<double>(half) / static_cast<double>(bend));
    const auto last = static_cast<std::int64_t>(count);
    std::int64_t line = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::clamp(value / static_cast<double>(pitch), -1.0, last + 1.0)), 0, last);
    // line·pitch is strictly on the base's side of the extremum.
    const auto reached = [&](std::int64_t k) {
        const Wide gap = Wide{maximum ? k * pitch - base : base - k * pitch};
        return gap * (maximum ? -bend : bend) < Wide{half} * half;
    };
    const std::int64_t on = maximum ? 1 : -1;
    while (line >= 0 && line <= last && !reached(line))
        line -= on;
    while (line + on >= 0 && line + on <= last && reached(line + on))
        line += on;
    return static_cast<std::int32_t>(line);
}

} // namespace

CurveWalk::Coordinate CurveWalk::coordinate(std::int64_t p0, std::int64_t p1, std::int64_t p2, std::int64_t pitch,
                                            std::uint32_t count) {
    return {p0, p2, p1 - p0, p0 - 2 * p1 + p2, pitch, count};
}

/// 0 and 1 exactly at the ends. Else the root of its run: there bend·t + half has the sign of the run.
Interval CurveWalk::parameter(const Coordinate& c, const AxisCrossing& crossing, bool at_start, bool at_end) {
    if (at_start) return {0.0};
    if (at_end) return {1.0};
    const Interval base = static_cast<double>(c.first - c.pitch * crossing.line), half = static_cast<double>(c.half),
                   bend = static_cast<double>(c.bend);
    const Interval root = square_root(half * half - bend * base), s = crossing.increasing ? root : -root;
    const bool same_sign = (c.half > 0) == crossing.increasing || c.half == 0;
    const Interval below = same_sign ? half + s : bend;
    if (holds_zero(below)) return {0, 1};
    const Interval t = meet(same_sign ? -base / below : (s - half) / below, {0, 1});
    return empty(t) ? Interval(0, 1) : t;
}

void CurveWalk::find_crossings(const Coordinate& c, std::vector<AxisCrossing>& out) {
    out.clear();
    const std::int32_t from = grid_cell(c.first, c.pitch, c.count), to = grid_cell(c.last, c.pitch, c.count);
    const auto run = [&](std::int32_t cell, std::int32_t end, bool first, bool last) {
        const bool up = end > cell;
        for (std::int32_t line = up ? cell + 1 : cell; up ? line <= end : line > end; line += up ? 1 : -1) {
            AxisCrossing crossing{line, up, {}};
            const std::int64_t level = c.pitch * line;
            crossing.t = parameter(c, crossing, first && level == c.first, last && level == c.last);
            out.push_back(crossing);
        }
    };
    const std::int64_t end_slope = c.half + c.bend;
    const bool turns = (c.half < 0 && end_slope > 0) || (c.half > 0 && end_slope < 0);
    if (!turns) return run(from, to, true, true);
    const std::int32_t line = line_at_extremum(c.first, c.half, c.bend, c.pitch, c.count);
    // The cell of the extremum; no line is crossed twice to get there.
    const std::int32_t cell = c.bend < 0 ? std::max({line, from, to}) : std::min({line - 1, from, to});
    run(from, cell, true, false);
    run(cell, to, false, true);
}

int CurveWalk::compare_exactly(const AxisCrossing& vertical, const AxisCrossing& horizontal) const {
    const auto number = [](const Coordinate& c, const AxisCrossing& crossing) {
        if (crossing.t.width() == 0)
            return AlgebraicNumber{trimmed({mpz_class(-crossing.t.lo), 1}), crossing.t.lo - 1, crossing.t.lo + 1};
        AlgebraicNumber n{trimmed({to_mpz(c.first - c.pitch * crossing.line), to_mpz(2 * c.half), to_mpz(c.bend)}),
                          crossing.t.lo, crossing.t.hi};
        if (c.bend == 0) return n;
        // The other root is on the other side of the extremum.
        mpq_class turn(to_mpz(-c.half), to_mpz(c.bend));
        turn.canonicalize();
        if (n.lo <= turn && turn <= n.hi) (c.bend > 0) == crossing.increasing ? n.lo = turn : n.hi = turn;
        return n;
    };
    // Overlapping enclosures that can't be told apart are of one point: a corner of the grid.
    return compare_numbers(number(x_, vertical), number(y_, horizontal)).value_or(0);
}

bool CurveWalk::vertical_first(const AxisCrossing& vertical, const AxisCrossing& horizontal) const {
    int order = compare(vertical.t, horizontal.t);
    if (order == 0 && (vertical.t.width() > 0 || horizontal.t.width() > 0))
        order = compare_exactly(vertical, horizontal);
    if (order != 0) return order < 0;
    // As in walk_grid.
    return vertical.increasing != (vertical.line == static_cast<std::int32_t>(grid_.width));
}

void CurveWalk::add(const AxisCrossing& crossing, bool vertical, std::int32_t cell) {
    const double t = std::clamp(crossing.t.mid(), 0.0, 1.0);
    const auto value = [&](const Coordinate& c, std::int64_t origin) {
        if (t == 0) return static_cast<double>(c.first - origin);
        if (t == 1) return static_cast<double>(c.last - origin);
        return static_cast<double>(c.first - origin) +
               t * (2 * static_cast<double>(c.half) + t * static_cast<double>(c.bend));
    };
    const auto slope = [&](const Coordinate& c) {
        return (static_cast<double>(c.half) + t * static_cast<double>(c.bend)) / static_cast<double>(c.pitch);
    };
    const Coordinate& c = vertical ? y_ : x_;
    CurveCrossing out;
    out.at = {vertical, crossing.line, cell,
              std::clamp(value(c, c.pitch * cell) / static_cast<double>(c.pitch), 0.0, 1.0)};
    out.at.increasing = crossing.increasing;
    out.t = t, out.dx = slope(x_), out.dy = slope(y_);
    out_.push_back(out);
}

const std::vector<CurveCrossing>& CurveWalk::walk(const PlanarQuadratic& curve) {
    x_ = coordinate(curve[0].x, curve[1].x, curve[2].x, grid_.px, grid_.width);
    y_ = coordinate(curve[0].y, curve[1].y, curve[2].y, grid_.py, grid_.height);
    find_crossings(x_, across_);
    find_crossings(y_, along_);
    out_.clear();
    std::int32_t column = grid_cell(x_.first, grid_.px, grid_.width), row = grid_cell(y_.first, grid_.py, grid_.height);
    std::size_t v = 0, h = 0;
    while (v < across_.size() || h < along_.size()) {
        if (h == along_.size() || (v < across_.size() && vertical_first(across_[v], along_[h]))) {
            add(across_[v], true, row);
            column += across_[v++].increasing ? 1 : -1;
        } else {
            add(along_[h], false, column);
            row += along_[h++].increasing ? 1 : -1;
        }
    }
    return out_;
}

} // namespace fetexc
