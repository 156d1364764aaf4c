// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/local_problem.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/plane.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;
using Jet = ceres::Jet<double, sqp::kMostVariables>;

constexpr double kLeast = budget::kFeatureMargin, kMost = 1 - budget::kFeatureMargin;

template <class T> T cross(const std::array<T, 2>& a, const std::array<T, 2>& b) { return a[0] * b[1] - a[1] * b[0]; }
template <class T> std::array<T, 2> operator-(const std::array<T, 2>& a, const std::array<T, 2>& b) {
    return {a[0] - b[0], a[1] - b[1]};
}

std::array<Jet, sqp::kMostVariables> jets(const sqp::Vector& x) {
    std::array<Jet, sqp::kMostVariables> out;
    for (int k = 0; k < x.size(); ++k)
        out[static_cast<std::size_t>(k)] = Jet(x[k], k);
    return out;
}

template <class Visit> void for_each_end(SegmentSet set, FeatureEdge e, Visit&& visit) {
    for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k) {
        const fetex::FeatureSegment s = fetex::kFeatureSegments[k];
        if ((set >> k & 1u) != 0 && (s.first == e || s.second == e)) visit(k, s.first == e ? s.second : s.first);
    }
}

FeaturePoint direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// Into [0, π).
double line_angle(double dx, double dy) {
    const double a = std::atan2(dy, dx);
    const double turned = a < 0 ? a + std::numbers::pi : a;
    return turned >= std::numbers::pi ? 0 : turned;
}

/// Steps along the direction from a point on the texel's boundary for which it is inside by `margin`.
struct Range {
    double low = 0, high = 0;
};
Range range_inside(FeaturePoint from, FeaturePoint along, double margin) {
    Range r{-4, 4};
    const auto cut = [&](double base, double by) {
        if (by == 0) {
            if (base < margin || base > 1 - margin) r = {1, 0};
            return;
        }
        const auto [near, far] = std::minmax({(margin - base) / by, (1 - margin - base) / by});
        r = {std::max(r.low, near), std::min(r.high, far)};
    };
    cut(from.x, along.x), cut(from.y, along.y);
    return r;
}

} // namespace

std::optional<Beside> across(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, FeatureEdge e) {
    using enum FeatureEdge;
    switch (e) {
    case North:
        return j > 0 ? std::optional(Beside{i, j - 1, South}) : std::nullopt;
    case East:
        return i + 1 < curves.width ? std::optional(Beside{i + 1, j, West}) : std::nullopt;
    case South:
        return j + 1 < curves.height ? std::optional(Beside{i, j + 1, North}) : std::nullopt;
    default:
        return i > 0 ? std::optional(Beside{i - 1, j, East}) : std::nullopt;
    }
}

StraightEnds straight_ends(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, FeatureEdge e) {
    StraightEnds out;
    bool differ = false;
    const auto look = [&](std::uint32_t ti, std::uint32_t tj, FeatureEdge te) {
        const SnappedTexel& t = curves.texel(ti, tj);
        for_each_end(static_cast<SegmentSet>(t.segments & ~t.curved), te, [&](std::uint32_t, FeatureEdge other) {
            const FeaturePoint a = fetex::feature_point(te, curves.position(ti, tj, te)),
                               b = fetex::feature_point(other, curves.position(ti, tj, other));
            // Of no length: a curve passes a corner, with one tangent on both edges.
            const double angle = distance(a, b) > 0 ? line_angle(b.x - a.x, b.y - a.y) : curves.angle(ti, tj, te);
            if (out.any && (!out.angle || std::abs(std::sin(angle - *out.angle)) > budget::kFeatureParallel))
                differ = true;
            out.any = true;
            if (!out.angle) out.angle = angle;
        });
    };
    look(i, j, e);
    if (const auto beside = across(curves, i, j, e)) look(beside->i, beside->j, beside->edge);
    if (differ) out.angle.reset();
    return out;
}

bool goes_on(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, FeatureEdge e) {
    const auto beside = across(curves, i, j, e);
    if (!beside) return false;
    const EdgeSet edges = edges_of(curves.texel(beside->i, beside->j).segments);
    return (edges >> fetex::feature_edge_index(beside->edge) & 1u) != 0;
}

LocalProblem::LocalProblem(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, double margin)
    : i_(i), j_(j), margin_(margin) {
    open_ = true;
    const SegmentSet curved = curves.texel(i, j).curved;
    for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
        if (curved >> k & 1u) add_inner(curves, k);
    inner_ = segments_.size();
    for (std::size_t p = 0; p < points_.size(); ++p)
        add_outer(curves, p);
    add_tangencies();
    expand_tangencies();
    // A segment without a point or a tangent that can change is what it is.
    for (std::size_t s = 0; s < inner_; ++s) {
        const bool moves = std::ranges::any_of(handles_, [&](const Handle& h) {
            return h.segment == s && (points_[h.point].at.variable[0] >= 0 || !points_[h.point].angle);
        });
        open_ = open_ && moves;
    }
}

int LocalProblem::add_variable(double low, double high, double start) {
    low_.push_back(low), high_.push_back(high), start_.push_back(std::clamp(start, low, high));
    return static_cast<int>(start_.size()) - 1;
}

std::size_t LocalProblem::add_point(const SnappedCurves& curves, FeatureEdge e) {
    for (std::size_t p = 0; p < points_.size(); ++p)
        if (points_[p].edge == e) return p;
    Point point;
    point.edge = e;
    const double position = curves.position(i_, j_, e);
    const StraightEnds straight = straight_ends(curves, i_, j_, e);
    if (straight.any || !goes_on(curves, i_, j_, e)) {
        point.at.base = fetex::feature_point(e, position);
        point.angle = straight.angle;
    } else {
        const FeaturePoint first = fetex::feature_point(e, 0), last = fetex::feature_point(e, 1);
        point.at = {
            first, {add_variable(kLeast, kMost, position), -1}, {FeaturePoint{last.x - first.x, last.y - first.y}, {}}};
    }
    points_.push_back(point);
    return points_.size() - 1;
}

void LocalProblem::add_inner(const SnappedCurves& curves, std::uint32_t k) {
    const fetex::FeatureSegment s = fetex::kFeatureSegments[k];
    const std::size_t a = add_point(curves, s.first), b = add_point(curves, s.second);
    const FeaturePoint start = shown_segment(curves, i_, j_, k).curve[1];
    MovablePoint middle;
    middle.variable = {add_variable(margin_, 1 - margin_, start.x), add_variable(margin_, 1 - margin_, start.y)};
    middle.by = {FeaturePoint{1, 0}, FeaturePoint{0, 1}};
    handles_.push_back({a, segments_.size()}), handles_.push_back({b, segments_.size()});
    segments_.push_back({{points_[a].at, middle, points_[b].at}});
}

void LocalProblem::add_outer(const SnappedCurves& curves, std::size_t point) {
    const auto beside = across(curves, i_, j_, points_[point].edge);
    if (!beside) return;
    const FeaturePoint shift{static_cast<double>(beside->i) - i_, static_cast<double>(beside->j) - j_};
    for_each_end(curves.texel(beside->i, beside->j).curved, beside->edge, [&](std::uint32_t k, FeatureEdge far) {
        const FeaturePoint from = fetex::feature_point(far, curves.position(beside->i, beside->j, far)),
                           along = direction(curves.angle(beside->i, beside->j, far));
        const ShownSegment now = shown_segment(curves, beside->i, beside->j, k);
        const double start = (now.curve[1].x - from.x) * along.x + (now.curve[1].y - from.y) * along.y;
        Range range = range_inside(from, along, budget::kFeatureMargin);
        const bool valid = now.fault == SignatureFault::None;
        if (range.low > range.high) range = valid ? Range{start, start} : Range{1, 0};
        if (valid) range = {std::min(range.low, start), std::max(range.high, start)};
        if (range.low > range.high) {
            open_ = false;
            return;
        }
        const bool known = now.fault != SignatureFault::NoMiddle && now.fault != SignatureFault::Outside;
        MovablePoint middle;
        middle.base = {from.x + shift.x, from.y + shift.y};
        middle.variable[0] = add_variable(range.low, range.high, known ? start : (range.low + range.high) / 2);
        middle.by[0] = along;
        handles_.push_back({point, segments_.size()});
        segments_.push_back({{points_[point].at, middle, {middle.base, {-1, -1}, {}}}});
    });
}

void LocalProblem::add_tangencies() {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        std::optional<std::size_t> first;
        for (const Handle& h : handles_) {
            if (h.point != p) continue;
            if (points_[p].angle || first) tangencies_.push_back({p, h.segment, first});
            if (!points_[p].angle && !first) first = h.segment;
        }
    }
}

template <class T> T LocalProblem::tangency(const Tangency& t, const T* x) const {
    const Point& point = points_[t.point];
    const std::array<T, 2> p = point.at.at(x), handle = middle(t.segment).at(x) - p;
    if (t.like) return cross(handle, middle(*t.like).at(x) - p);
    const FeaturePoint d = direction(*point.angle);
    return cross(handle, std::array<T, 2>{T(d.x), T(d.y)});
}

/// Twice the second difference: its square is Eq. 3.
template <class T> std::array<T, 2> LocalProblem::bend(const Segment& s, const T* x) const {
    const std::array<T, 2> a = s.points[0].at(x), b = s.points[1].at(x), c = s.points[2].at(x);
    return {2.0 * (a[0] - 2.0 * b[0] + c[0]), 2.0 * (a[1] - 2.0 * b[1] + c[1])};
}

std::optional<sqp::Vector> LocalProblem::solve() const {
    const sqp::Task task = this->task();
    const auto from = [&](sqp::Vector x) -> std::optional<sqp::Vector> {
        if (!sqp::solve(task, x, budget::kFeatureFitStop, budget::kFeatureFitSteps).solved) return {};
        return x;
    };
    const auto n = static_cast<Eigen::Index>(start_.size());
    const auto found = from(Eigen::Map<const Eigen::VectorXd>(start_.data(), n));
    return found ? found : from((task.low + task.high) / 2);
}

sqp::Task LocalProblem::task() const {
    const auto n = static_cast<Eigen::Index>(start_.size());
    sqp::Task task{*this,
                   static_cast<int>(tangencies_.size()),
                   sqp::Matrix::Zero(n, n),
                   sqp::Vector::Zero(n),
                   Eigen::Map<const Eigen::VectorXd>(low_.data(), n),
                   Eigen::Map<const Eigen::VectorXd>(high_.data(), n)};
    const auto x = jets(sqp::Vector::Zero(n));
    for (const Segment& s : segments_) {
        for (const Jet& r : bend(s, x.data())) {
            task.hessian += 2 * r.v.head(n) * r.v.head(n).transpose();
            task.gradient += 2 * r.a * r.v.head(n);
        }
    }
    return task;
}

double LocalProblem::energy(const sqp::Vector& x) const {
    double sum = 0;
    for (const Segment& s : segments_)
        for (const double r : bend(s, x.data()))
            sum += r * r;
    return sum;
}

/// A tangency is a product of two functions that are linear: its value, derivatives and second derivatives where all
/// variables are 0 are all there is to know.
void LocalProblem::expand_tangencies() {
    const auto n = static_cast<Eigen::Index>(start_.size());
    const auto x = jets(sqp::Vector::Zero(n));
    for (const Tangency& t : tangencies_) {
        const Jet value = tangency(t, x.data());
        Expansion e{value.a, {}, {}};
        for (Eigen::Index k = 0; k < n; ++k)
            if (value.v[k] != 0) e.slopes.push_back({k, value.v[k]});
        if (t.like) {
            const auto p = points_[t.point].at.at(x.data());
            const auto a = middle(t.segment).at(x.data()) - p, b = middle(*t.like).at(x.data()) - p;
            for (Eigen::Index r = 0; r < n; ++r) {
                for (Eigen::Index c = 0; c < n; ++c) {
                    const double bend =
                        a[0].v[r] * b[1].v[c] + b[1].v[r] * a[0].v[c] - a[1].v[r] * b[0].v[c] - b[0].v[r] * a[1].v[c];
                    if (bend != 0) e.bends.push_back({r, c, bend});
                }
            }
        }
        expansions_.push_back(std::move(e));
    }
}

void LocalProblem::constraints(const sqp::Vector& x, sqp::Values& values, sqp::Jacobian& jacobian) const {
    const auto m = static_cast<Eigen::Index>(expansions_.size());
    values.resize(m), jacobian.setZero(m, x.size());
    for (Eigen::Index k = 0; k < m; ++k) {
        const Expansion& e = expansions_[static_cast<std::size_t>(k)];
        double value = e.value;
        for (const auto& s : e.slopes)
            jacobian(k, s.variable) = s.value, value += s.value * x[s.variable];
        for (const auto& b : e.bends)
            jacobian(k, b.row) += b.value * x[b.column], value += b.value * x[b.row] * x[b.column] / 2;
        values[k] = value;
    }
}

void LocalProblem::add_curvature(const sqp::Values& weights, sqp::Matrix& to) const {
    for (std::size_t k = 0; k < expansions_.size(); ++k)
        for (const auto& b : expansions_[k].bends)
            to(b.row, b.column) += weights[static_cast<Eigen::Index>(k)] * b.value;
}

void LocalProblem::apply(const sqp::Vector& x, SnappedCurves& curves) const {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Point& point = points_[p];
        if (point.at.variable[0] >= 0) curves.position(i_, j_, point.edge) = x[point.at.variable[0]];
        curves.angle(i_, j_, point.edge) = point.angle ? *point.angle : angle_at(p, x);
    }
    for (std::size_t s = 0; s < inner_; ++s)
        straighten_flat(s, x, curves);
}

/// Of the longest handle, which has the least error.
double LocalProblem::angle_at(std::size_t point, const sqp::Vector& x) const {
    const std::array<double, 2> at = points_[point].at.at(x.data());
    std::array<double, 2> longest{};
    for (const Handle& h : handles_) {
        if (h.point != point) continue;
        const std::array<double, 2> handle = middle(h.segment).at(x.data()) - at;
        if (std::hypot(handle[0], handle[1]) > std::hypot(longest[0], longest[1])) longest = handle;
    }
    return line_angle(longest[0], longest[1]);
}

/// A segment between two that bend to either side is the least bent when it is straight: its chord is its tangent.
void LocalProblem::straighten_flat(std::size_t segment, const sqp::Vector& x, SnappedCurves& curves) const {
    const auto& points = segments_[segment].points;
    const std::array<double, 2> from = points[0].at(x.data()), chord = points[2].at(x.data()) - from,
                                handle = points[1].at(x.data()) - from;
    const double length = std::hypot(chord[0], chord[1]);
    if (!(std::abs(cross(chord, handle)) <= budget::kFeatureFlat * length)) return;
    for (const Handle& h : handles_)
        if (h.segment == segment && !points_[h.point].angle)
            curves.angle(i_, j_, points_[h.point].edge) = line_angle(chord[0], chord[1]);
}

} // namespace fetexc
