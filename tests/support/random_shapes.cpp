// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetexc::test {
namespace {

double step(const ShapeSpace& s) { return std::max(s.width, s.height) / s.cells; }

CanvasPoint grid_point(Random& random, const ShapeSpace& s) {
    const double d = step(s);
    const int nx = static_cast<int>(std::ceil(s.width / d)), ny = static_cast<int>(std::ceil(s.height / d));
    return {d * random.integer(-1, nx + 1), d * random.integer(-1, ny + 1)};
}

CanvasPoint any_point(Random& random, const ShapeSpace& s) {
    return {random.between(-0.1, 1.1) * s.width, random.between(-0.1, 1.1) * s.height};
}

bool same(CanvasPoint a, CanvasPoint b) { return a.x == b.x && a.y == b.y; }

template <class Point> CanvasContour random_path(Random& random, Point point) {
    CanvasContour out;
    const CanvasPoint start = point();
    CanvasPoint pen = start;
    const int count = random.integer(2, 7);
    for (int i = 0; i < count; ++i) {
        const CanvasPoint next = i + 1 == count ? start : point();
        switch (random.integer(1, 3)) {
        case 1:
            out.push_back(line(pen, next));
            break;
        case 2:
            out.push_back(quadratic(pen, point(), next));
            break;
        default: {
            const CanvasPoint a = point(), b = point(); // arguments have no fixed order of evaluation
            out.push_back(cubic(pen, a, b, next));
        }
        }
        pen = next;
    }
    return out;
}

Contours grid_polygon(Random& random, const ShapeSpace& s) {
    std::vector<CanvasPoint> corners;
    for (int i = random.integer(3, 8); i > 0; --i)
        corners.push_back(grid_point(random, s));
    return {polygon(corners)};
}

Contours grid_curves(Random& random, const ShapeSpace& s) {
    return {random_path(random, [&] { return grid_point(random, s); })};
}

Contours free_curves(Random& random, const ShapeSpace& s) {
    return {random_path(random, [&] { return any_point(random, s); })};
}

Contours grid_rectangles(Random& random, const ShapeSpace& s) {
    Contours out;
    for (int i = random.integer(1, 2); i > 0; --i) {
        const CanvasPoint a = grid_point(random, s);
        const double w = step(s) * random.integer(1, 4), h = step(s) * random.integer(1, 4);
        out.push_back(rectangle(a.x, a.y, a.x + w, a.y + h));
    }
    return out;
}

Contours grid_circles(Random& random, const ShapeSpace& s) {
    const CanvasPoint centre = grid_point(random, s);
    const double radius = step(s) * random.integer(1, 3) / 2;
    Contours out{circle(centre, radius)};
    if (random.chance(0.3)) out.push_back(circle({centre.x + 2 * radius, centre.y}, radius));     // tangent
    if (random.chance(0.3)) out.push_back(circle({centre.x + radius / 2, centre.y}, radius / 2)); // tangent inside
    return out;
}

/// Thin triangles on both sides of a common point: every edge passes through it or ends there.
Contours star(Random& random, const ShapeSpace& s) {
    const CanvasPoint c = grid_point(random, s);
    Contours out;
    for (int i = random.integer(4, 24); i > 0; --i) {
        const CanvasPoint p = grid_point(random, s), q = any_point(random, s);
        if (same(p, c)) continue;
        out.push_back(polygon({p, {2 * c.x - p.x, 2 * c.y - p.y}, random.chance(0.5) ? c : q}));
    }
    return out;
}

Contours loop(Random& random, const ShapeSpace& s) {
    const CanvasPoint a = grid_point(random, s);
    const CanvasPoint h = grid_point(random, s), k = grid_point(random, s);
    Contours out{{cubic(a, h, k, a)}};
    if (random.chance(0.4)) { // a path with a loop inside one cubic: crossed handles
        const CanvasPoint b{a.x + 2 * step(s), a.y};
        out.push_back(
            {cubic(a, {a.x + 5 * step(s), a.y + 3 * step(s)}, {a.x - 3 * step(s), a.y + 3 * step(s)}, b), line(b, a)});
    }
    return out;
}

CanvasPoint towards(CanvasPoint a, CanvasPoint b, double t) { return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; }

/// A cubic of a degenerate kind from a to b.
CanvasSegment odd_cubic(Random& random, const ShapeSpace& s, CanvasPoint a, CanvasPoint b) {
    const CanvasPoint h = grid_point(random, s);
    switch (random.integer(0, 5)) {
    case 0:
        return cubic(a, a, h, b);
    case 1:
        return cubic(a, h, b, b);
    case 2:
        return cubic(a, a, b, b); // a line
    case 3:
        return cubic(a, towards(a, b, 1.5), towards(a, b, -0.5), b); // a line, folded
    case 4:
        return cubic(a, towards(a, h, 2.0 / 3), towards(b, h, 2.0 / 3), b); // a quadratic
    default: {
        // a cusp: the derivative (p1−p0)(1−t)² + 2(p2−p1)t(1−t) + (p3−p2)t² vanishes at t = 1/2
        const CanvasPoint p1{a.x + 3 * step(s), a.y + 3 * step(s)};
        return cubic(a, p1, {p1.x - (b.x - a.x), p1.y - (b.y - a.y)}, b);
    }
    }
}

Contours odd_cubics(Random& random, const ShapeSpace& s) {
    CanvasContour out;
    const CanvasPoint start = grid_point(random, s);
    CanvasPoint pen = start;
    const int count = random.integer(2, 4);
    for (int i = 0; i < count; ++i) {
        const CanvasPoint next = i + 1 == count ? start : grid_point(random, s);
        out.push_back(odd_cubic(random, s, pen, next));
        pen = next;
    }
    return {out};
}

Contours tiny(Random& random, const ShapeSpace& s) {
    const CanvasPoint c = random.chance(0.5) ? grid_point(random, s) : any_point(random, s);
    const double size = std::max(s.width, s.height) * 0x1p-20 * std::exp2(random.between(-2, 5.3));
    if (random.chance(0.3)) return {circle(c, size)};
    const auto near = [&] { return CanvasPoint{c.x + random.between(-size, size), c.y + random.between(-size, size)}; };
    if (random.chance(0.5)) return {random_path(random, near)};
    return {polygon({near(), near(), grid_point(random, s)})}; // a needle
}

/// One border of a strip, drawn forth by one cell and back by the next.
CanvasSegment border(Random& random, CanvasPoint a, CanvasPoint b, double reach) {
    const auto off = [&](double t) {
        const CanvasPoint p = towards(a, b, t);
        return CanvasPoint{p.x + random.between(-reach, reach), p.y + random.between(-reach, reach)};
    };
    switch (random.integer(1, 3)) {
    case 1:
        return line(a, b);
    case 2:
        return quadratic(a, off(0.5), b);
    default: {
        const CanvasPoint h = off(1.0 / 3), k = off(2.0 / 3);
        return cubic(a, h, k, b);
    }
    }
}

CanvasSegment back(CanvasSegment s) {
    std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
    return s;
}

std::vector<Contours> partition(Random& random, const ShapeSpace& s) {
    const int cells = random.integer(2, 5);
    const double top = random.between(0, 0.3) * s.height, bottom = random.between(0.6, 1) * s.height;
    std::vector<CanvasSegment> borders;
    for (int i = 0; i <= cells; ++i) {
        const double x = s.width * (i + random.between(-0.2, 0.2)) / cells;
        borders.push_back(border(random, {x, top}, {x + random.between(-2, 2), bottom}, 0.1 * s.width));
    }
    std::vector<Contours> out;
    for (int i = 0; i < cells; ++i) {
        const CanvasSegment& left = borders[i];
        const CanvasSegment right = back(borders[i + 1]);
        out.push_back({{left, line(left.p[left.degree], right.p[0]), right, line(right.p[right.degree], left.p[0])}});
    }
    return out;
}

} // namespace

CanvasSegment line(CanvasPoint a, CanvasPoint b) {
    CanvasSegment s;
    s.p[0] = a;
    s.p[1] = b;
    return s;
}

CanvasSegment quadratic(CanvasPoint a, CanvasPoint b, CanvasPoint c) {
    CanvasSegment s;
    s.degree = 2;
    s.p = {a, b, c, {}};
    return s;
}

CanvasSegment cubic(CanvasPoint a, CanvasPoint b, CanvasPoint c, CanvasPoint d) {
    CanvasSegment s;
    s.degree = 3;
    s.p = {a, b, c, d};
    return s;
}

CanvasContour polygon(const std::vector<CanvasPoint>& corners) {
    CanvasContour out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const CanvasPoint a = corners[i], b = corners[(i + 1) % corners.size()];
        if (!same(a, b)) out.push_back(line(a, b));
    }
    return out;
}

CanvasContour rectangle(double x0, double y0, double x1, double y1) {
    return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

CanvasContour circle(CanvasPoint c, double r) {
    const double k = 4 * (std::sqrt(2.0) - 1) / 3 * r; // tangent length of a quarter turn
    const std::array<CanvasPoint, 4> p{{{c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, {c.x, c.y - r}}};
    return {cubic(p[0], {c.x + r, c.y + k}, {c.x + k, c.y + r}, p[1]),
            cubic(p[1], {c.x - k, c.y + r}, {c.x - r, c.y + k}, p[2]),
            cubic(p[2], {c.x - r, c.y - k}, {c.x - k, c.y - r}, p[3]),
            cubic(p[3], {c.x + k, c.y - r}, {c.x + r, c.y - k}, p[0])};
}

Contours reversed(const Contours& contours) {
    Contours out;
    for (const CanvasContour& contour : contours) {
        CanvasContour turned;
        for (auto it = contour.rbegin(); it != contour.rend(); ++it)
            turned.push_back(back(*it));
        out.push_back(turned);
    }
    return out;
}

std::vector<Contours> random_shapes(Random& random, const ShapeMix& mix, const ShapeSpace& space) {
    const std::array<double, 10> weights{mix.polygons, mix.curves, mix.free_curves, mix.rectangles, mix.circles,
                                         mix.stars,    mix.loops,  mix.odd_cubics,  mix.tiny,       mix.partitions};
    double sum = 0;
    for (double w : weights)
        sum += w;
    double pick = random.unit() * sum;
    std::size_t kind = 0;
    while (kind + 1 < weights.size() && (pick -= weights[kind]) >= 0)
        ++kind;
    switch (kind) {
    case 0:
        return {grid_polygon(random, space)};
    case 1:
        return {grid_curves(random, space)};
    case 2:
        return {free_curves(random, space)};
    case 3:
        return {grid_rectangles(random, space)};
    case 4:
        return {grid_circles(random, space)};
    case 5:
        return {star(random, space)};
    case 6:
        return {loop(random, space)};
    case 7:
        return {odd_cubics(random, space)};
    case 8:
        return {tiny(random, space)};
    default:
        return partition(random, space);
    }
}

} // namespace fetexc::test
