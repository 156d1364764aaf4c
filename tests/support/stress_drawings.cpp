// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/stress_drawings.h"

#include <array>

#include "tests/support/random_shapes.h"
#include "tests/support/stress_parts.h"

namespace fetexc::test {
namespace {

/// Any degree, through the point q/4: lines at t = 1/4, the others at t = 1/2.
ControlPoints curve_through(Random& random, LatticePoint q, int degree, std::int64_t reach) {
    const LatticePoint centre{q.x / 4, q.y / 4};
    ControlPoints c;
    for (int i = 0; i < degree; ++i)
        c.push_back(centre + random_offset(random, reach));
    if (degree == 1) c.push_back(q - 3 * c[0]);
    if (degree == 2) c.push_back(q - c[0] - 2 * c[1]);
    if (degree == 3) c.push_back(2 * q - c[0] - 3 * (c[1] + c[2]));
    return c;
}

Drawing planted_crossings(Random& random) {
    const LatticePoint q = 4 * random_centre(random) + LatticePoint{random.integer(0, 3), random.integer(0, 3)};
    const std::int64_t reach = std::int64_t{1} << random.integer(4, 22);
    Drawing out;
    for (int n = random.integer(2, 7); n > 0; --n)
        out.paths.push_back({curve_through(random, q, random.integer(1, 3), reach)});
    return out;
}

/// Nearly the same path again, each control point up to 32 steps off; one time in three far beyond the canvas.
Drawing ulp_neighbours(Random& random) {
    Path base = random_path(random);
    if (random.chance(0.33)) {
        for (auto& curve : base) {
            for (LatticePoint& p : curve)
                p = 3 * p - LatticePoint{kSide, kSide};
        }
    }
    Drawing out;
    out.paths.push_back(base);
    for (int n = random.integer(1, 4); n > 0; --n) {
        const bool ends_stay = random.chance(0.5);
        const std::int64_t reach = std::int64_t{1} << random.integer(0, 5);
        Path copy = base;
        for (auto& curve : copy) {
            for (std::size_t i = 0; i < curve.size(); ++i) {
                const bool end = i == 0 || i + 1 == curve.size();
                if (!(end && ends_stay)) curve[i] = curve[i] + random_offset(random, reach);
            }
        }
        out.paths.push_back(copy);
    }
    return out;
}

/// The same quadratic as a cubic, the same line as a quadratic or a cubic.
ControlPoints disguised(const ControlPoints& c) {
    if (c.size() == 2) {
        const LatticePoint d = c[1] - c[0];
        return {c[0], c[0] + LatticePoint{d.x / 3, d.y / 3}, c[0] + LatticePoint{2 * (d.x / 3), 2 * (d.y / 3)}, c[1]};
    }
    const auto third = [](LatticePoint p) { return LatticePoint{p.x / 3, p.y / 3}; };
    return {c[0], third(c[0] + 2 * c[1]), third(2 * c[1] + c[2]), c[2]};
}

ControlPoints thrice(ControlPoints c) {
    for (LatticePoint& p : c)
        p = {p.x - p.x % 192, p.y - p.y % 192};
    return c;
}

/// Stretches of one curve, forth and back, some in disguise; a border drawn by both its neighbours.
Drawing overlaps(Random& random) {
    Drawing out;
    const ControlPoints whole = thrice(divisible_curve(random, random.integer(1, 3)));
    for (int n = random.integer(2, 5); n > 0; --n) {
        const int from = random.integer(-1, 4), to = random.integer(-1, 5);
        ControlPoints part = random.chance(0.3) || from == to ? whole : stretch_of(whole, from, to);
        if (part.size() < 4 && random.chance(0.3)) part = disguised(part);
        Path path{random.chance(0.3) ? backwards(part) : part};
        if (random.chance(0.5)) path.push_back({path.back().back(), random_point(random)});
        out.paths.push_back(path);
    }
    return out;
}

/// Curves that start on another curve's points at quarters, and on lines' points.
Drawing t_junctions(Random& random) {
    Drawing out;
    const ControlPoints whole = divisible_curve(random, random.integer(1, 3));
    out.paths.push_back({whole});
    for (int n = random.integer(1, 5); n > 0; --n) {
        ControlPoints c = random_curve(random, random.integer(1, 3));
        c.front() = stretch_of(whole, random.integer(1, 3), 4).front();
        if (random.chance(0.3)) c.back() = stretch_of(whole, random.integer(0, 4), 4).front();
        out.paths.push_back({c});
    }
    const LatticePoint p = random_point(random), step = random_offset(random, kSide / 64);
    out.paths.push_back({{p, p + 7 * step}});
    for (int n = random.integer(0, 3); n > 0; --n)
        out.paths.push_back({{p + random.integer(1, 6) * step, random_point(random), random_point(random)}});
    return out;
}

/// A cubic whose derivative is (v·t − u) times a linear vector: a cusp at u/v.
ControlPoints cusp(Random& random) {
    const std::int64_t v = random.integer(2, 5), u = random.integer(1, static_cast<int>(v) - 1);
    const LatticePoint a = 2 * random_offset(random, kSide / 64), b = 2 * random_offset(random, kSide / 64);
    const LatticePoint middle = (v - u) * a - u * b;
    const LatticePoint p0 = random_centre(random), p1 = p0 - u * a;
    const LatticePoint p2 = p1 + LatticePoint{middle.x / 2, middle.y / 2};
    return {p0, p1, p2, p2 + (v - u) * b};
}

ControlPoints odd_curve(Random& random) {
    const LatticePoint a = random_point(random), b = random_point(random), h = random_point(random);
    switch (random.integer(0, 8)) {
    case 0:
        return cusp(random);
    case 1: { // nearly a cusp, or a tiny loop
        ControlPoints c = cusp(random);
        c[random.chance(0.5) ? 1 : 2] = c[random.chance(0.5) ? 1 : 2] + random_offset(random, 2);
        return c;
    }
    case 2:
        return {a, a, h, b};
    case 3:
        return {a, h, b, b};
    case 4:
        return {a, a, b, b};
    case 5: // a loop inside
        return {a, b + 2 * (h - a), a + 2 * (h - b), b};
    case 6: // a loop as a whole
        return {a, h, b, a};
    case 7: // there and back on one line
        return {a, a + 2 * LatticePoint{(h - a).x / 2, (h - a).y / 2}, h,
                a + LatticePoint{(h - a).x / 2, (h - a).y / 2}};
    default: // a line or a quadratic in disguise
        return disguised(thrice(random_curve(random, random.integer(1, 2))));
    }
}

Drawing odd_curves(Random& random) {
    Drawing out;
    for (int n = random.integer(1, 3); n > 0; --n) {
        Path path;
        for (int m = random.integer(1, 2); m > 0; --m)
            path.push_back(odd_curve(random));
        out.paths.push_back(path);
    }
    return out;
}

LatticePoint turned(LatticePoint p) { return {-p.y, p.x}; }

/// The outline of a thick line along a spine with right and sharp angles: it overlaps itself, partly along common
/// edges.
Path thick_line(Random& random) {
    const std::int64_t pitch = kSide / 16;
    const bool square = random.chance(0.5);
    std::vector<LatticePoint> spine{random_centre(random)};
    for (int n = random.integer(2, 6); n > 0; --n) {
        LatticePoint d = random_offset(random, 2);
        if (square) (random.chance(0.5) ? d.x : d.y) = 0;
        spine.push_back(spine.back() + pitch * d);
    }
    const std::int64_t half = square ? pitch / 2 : random_between(random, 1, pitch);
    std::vector<LatticePoint> left, right;
    for (std::size_t i = 0; i + 1 < spine.size(); ++i) {
        const LatticePoint d = spine[i + 1] - spine[i];
        const double length = std::max(1.0, std::hypot(static_cast<double>(d.x), static_cast<double>(d.y)));
        const double k = static_cast<double>(half) / length;
        const LatticePoint n =
            turned({std::llround(k * static_cast<double>(d.x)), std::llround(k * static_cast<double>(d.y))});
        for (const std::size_t j : {i, i + 1})
            left.push_back(spine[j] + n), right.push_back(spine[j] - n);
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    Path path;
    for (std::size_t i = 0; i + 1 < left.size(); ++i) {
        const bool round = i % 2 == 1 && random.chance(0.4);
        if (round)
            path.push_back({left[i], left[i] + turned(left[i + 1] - left[i]), left[i + 1]});
        else
            path.push_back({left[i], left[i + 1]});
    }
    return path;
}

Drawing thick_lines(Random& random) {
    Drawing out;
    for (int n = random.integer(1, 3); n > 0; --n)
        out.paths.push_back(thick_line(random));
    return out;
}

Drawing bundles(Random& random) { return lines_through_a_point(random, random.integer(10, 60)); }

/// Ends on grid lines and corners, edges along grid lines, extrema exactly on them; of grids with 2^k cells.
Drawing on_grid_lines(Random& random) {
    const std::int64_t cell = kSide >> random.integer(1, 4);
    const auto snap = [&](LatticePoint p) {
        const auto to = [&](std::int64_t v) { return (v + cell / 2) / cell * cell; };
        const int which = random.integer(0, 3); // neither, x, y, a corner
        return LatticePoint{which & 1 ? to(p.x) : p.x, which & 2 ? to(p.y) : p.y};
    };
    Drawing out;
    for (int n = random.integer(1, 4); n > 0; --n) {
        Path path;
        LatticePoint at = snap(random_point(random));
        for (int m = random.integer(2, 5); m > 0; --m) {
            ControlPoints c = random_curve(random, random.integer(1, 3));
            c.front() = at;
            for (std::size_t i = 1; i < c.size(); ++i)
                c[i] = snap(c[i]);
            if (c.size() == 3 && random.chance(0.5)) { // the extremum (y0 + y1)/2 lies on a line
                c[2].y = c[0].y;
                c[1].y = 2 * ((c[1].y + cell / 2) / cell * cell) - c[0].y;
            }
            if (c.size() == 2 && random.chance(0.3)) c[1].x = c[0].x;
            at = c.back();
            path.push_back(c);
        }
        out.paths.push_back(path);
    }
    return out;
}

/// What encloses nothing, between shapes that enclose something.
Drawing zero_parts(Random& random) {
    Drawing out;
    for (int n = random.integer(1, 6); n > 0; --n) {
        const LatticePoint a = random_point(random), b = random_point(random), h = random_point(random);
        switch (random.integer(0, 7)) {
        case 0:
            out.paths.push_back({});
            break;
        case 1:
            out.paths.push_back({{a, a}});
            break;
        case 2:
            out.paths.push_back({{a, a, a}, {a, a, a, a}});
            break;
        case 3:
            out.paths.push_back({{a, b}});
            break;
        case 4:
            out.paths.push_back({{a, h, b}, {b, h, a}});
            break;
        case 5:
            out.paths.push_back({{a, h, a}});
            break;
        case 6:
            out.paths.push_back({{a, h, b, a}, {a, b, h, a}});
            break;
        default:
            out.paths.push_back(random_path(random));
        }
    }
    return out;
}

/// Needles and lenses from 1 to 1024 steps wide: the output grid has 2^11/n of a step for n texels.
Drawing slivers(Random& random) {
    Drawing out;
    for (int n = random.integer(1, 5); n > 0; --n) {
        const std::int64_t width = std::int64_t{1} << random.integer(0, 10);
        const LatticePoint a = random_point(random), b = random_point(random);
        const LatticePoint off = random_offset(random, width);
        if (random.chance(0.4)) {
            out.paths.push_back({{a, b}, {b, b + off}});
        } else if (random.chance(0.5)) {
            const LatticePoint h = random_point(random);
            out.paths.push_back({{a, h, b}, {b, h + off, a}});
        } else {
            ControlPoints c = random_curve(random, 3), back = backwards(c);
            back[1] = back[1] + off, back[2] = back[2] + random_offset(random, width);
            out.paths.push_back({c, back});
        }
    }
    return out;
}

/// Few places, so that every coincidence happens. The same space as integer_grid_test's.
Drawing coarse_grid(Random& random) {
    const int cells = 1 << random.integer(2, 4), span = std::min(cells - 1, random.chance(0.3) ? cells - 1 : 4);
    const std::int64_t unit = kSide / cells;
    const auto point = [&] {
        const std::int64_t x = unit / 2 + unit * random.integer(0, span);
        return LatticePoint{x, unit / 2 + unit * random.integer(0, span)};
    };
    Drawing out;
    for (int n = random.integer(1, 6); n > 0; --n) {
        Path path;
        LatticePoint at = point();
        for (int m = random.integer(2, 5); m > 0; --m) {
            ControlPoints c{at};
            for (int d = random.integer(1, 3); d > 0; --d)
                c.push_back(point());
            at = c.back();
            path.push_back(c);
        }
        out.paths.push_back(path);
    }
    return out;
}

/// Shapes that reach over the canvas's border, with edges along it.
Drawing over_the_border(Random& random) {
    const std::array<std::int64_t, 6> places{-kSide / 2, -1, 0, kSide, kSide + 1, 3 * kSide / 2};
    const auto coordinate = [&] {
        return random.chance(0.4) ? places[static_cast<std::size_t>(random.integer(0, 5))]
                                  : random_between(random, -kSide / 2, 3 * kSide / 2);
    };
    Drawing out;
    for (int n = random.integer(1, 4); n > 0; --n) {
        Path path = random_path(random);
        LatticePoint at = path.front().front();
        for (auto& curve : path) {
            for (LatticePoint& p : curve)
                p.x = coordinate(), p.y = coordinate();
            curve.front() = at, at = curve.back();
        }
        out.paths.push_back(path);
    }
    return out;
}

Drawing anything(Random& random) {
    Drawing out;
    for (int n = random.integer(1, 5); n > 0; --n)
        out.paths.push_back(random_path(random));
    return out;
}

constexpr std::array kGenerators{
    StressGenerator{"planted_crossings", planted_crossings},
    StressGenerator{"ulp_neighbours", ulp_neighbours},
    StressGenerator{"near_tangents", near_tangents},
    StressGenerator{"exact_tangents", exact_tangents},
    StressGenerator{"shared_tangent_ends", shared_tangent_ends},
    StressGenerator{"overlaps", overlaps},
    StressGenerator{"t_junctions", t_junctions},
    StressGenerator{"odd_curves", odd_curves},
    StressGenerator{"thick_lines", thick_lines},
    StressGenerator{"bundles", bundles},
    StressGenerator{"on_grid_lines", on_grid_lines},
    StressGenerator{"zero_parts", zero_parts},
    StressGenerator{"slivers", slivers},
    StressGenerator{"coarse_grid", coarse_grid},
    StressGenerator{"over_the_border", over_the_border},
    StressGenerator{"anything", anything},
};

double power_of_ten(Random& random, int low, int high) { return std::pow(10.0, random.between(low, high)); }

} // namespace

std::span<const StressGenerator> stress_generators() { return kGenerators; }

const StressGenerator* find_generator(std::string_view name) {
    const auto it =
        std::find_if(kGenerators.begin(), kGenerators.end(), [&](const StressGenerator& g) { return name == g.name; });
    return it == kGenerators.end() ? nullptr : &*it;
}

Drawing stress_drawing(const StressGenerator& generator, std::uint64_t seed) {
    Random random(seed);
    Drawing out = generator.make(random);
    out.rule = seed % 2 == 1 ? FillRule::EvenOdd : FillRule::NonZero;
    return out;
}

Drawing lines_through_a_point(Random& random, int lines) {
    const LatticePoint c = random_centre(random);
    Drawing out;
    for (int k = 0; k < lines; k += 2) {
        const LatticePoint p = random_offset(random, kSide / 4), q = random_offset(random, 1 << random.integer(8, 20));
        if (p == LatticePoint{} || q == LatticePoint{}) continue;
        if (random.chance(0.5))
            out.paths.push_back({{c - p, c + p}, {c + p, c + p + q}});
        else
            out.paths.push_back({{c, c + p}, {c + p, c + p + q}});
    }
    return out;
}

Drawing rays_from_a_point(int rays) {
    const LatticePoint c{kSide / 2, kSide / 2};
    const auto at = [&](int k) {
        const double angle = 6.283185307179586 * k / rays;
        return c + LatticePoint{std::llround(0.4 * static_cast<double>(kSide) * std::cos(angle)),
                                std::llround(0.4 * static_cast<double>(kSide) * std::sin(angle))};
    };
    Drawing out;
    for (int k = 0; k + 1 < rays; k += 2)
        out.paths.push_back({{c, at(k)}, {at(k), at(k + 1)}});
    return out;
}

CanvasDrawing wide_range_drawing(std::uint64_t seed) {
    Random random(seed);
    CanvasDrawing out;
    const double side = random.chance(0.5) ? power_of_ten(random, -300, 12) : power_of_ten(random, -3, 5);
    out.width = side, out.height = side * (random.chance(0.5) ? 1 : power_of_ten(random, -3, 3));
    out.rule = seed % 2 == 1 ? FillRule::EvenOdd : FillRule::NonZero;
    const auto coordinate = [&](double canvas) {
        const double v = random.chance(0.6) ? random.between(-0.2, 1.2) * canvas : power_of_ten(random, -300, 12);
        return random.chance(0.8) ? v : random.chance(0.5) ? -v : 0;
    };
    const auto point = [&] {
        const double x = coordinate(out.width);
        return CanvasPoint{x, coordinate(out.height)};
    };
    for (int n = random.integer(1, 5); n > 0; --n) {
        CanvasContour contour;
        CanvasPoint at = point();
        for (int m = random.integer(2, 5); m > 0; --m) {
            CanvasSegment s;
            s.degree = random.integer(1, 3);
            s.p[0] = at;
            for (int i = 1; i <= s.degree; ++i)
                s.p[static_cast<std::size_t>(i)] = point();
            at = s.p[static_cast<std::size_t>(s.degree)];
            contour.push_back(s);
        }
        out.shapes.push_back({contour});
    }
    return out;
}

} // namespace fetexc::test
