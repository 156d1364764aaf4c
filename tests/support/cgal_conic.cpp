// SPDX-License-Identifier: GPL-3.0-or-later
#undef NDEBUG // CGAL's assertions stay on in an oracle
#include <CGAL/Arr_conic_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_algebraic_number_traits.h>
#include <CGAL/Cartesian.h>

#include "tests/support/cgal_arrangement.h"
#include "tests/support/cgal_oracles.h"

namespace fetexc::test {
namespace {

using NumberTraits = CGAL::CORE_algebraic_number_traits;
using RationalKernel = CGAL::Cartesian<NumberTraits::Rational>;
using AlgebraicKernel = CGAL::Cartesian<NumberTraits::Algebraic>;
using Traits = CGAL::Arr_conic_traits_2<RationalKernel, AlgebraicKernel, NumberTraits>;

Traits::Curve_2 line(LatticePoint p, LatticePoint q) {
    using Point = RationalKernel::Point_2;
    return Traits::Curve_2(RationalKernel::Segment_2(Point(p.x, p.y), Point(q.x, q.y)));
}

/// With P(t) = a·t² + b·t + c and q = P − c: (a × q)² = (a × b)·(q × b).
Traits::Curve_2 parabola(LatticePoint p, LatticePoint m, LatticePoint q) {
    const std::int64_t ax = p.x - 2 * m.x + q.x, ay = p.y - 2 * m.y + q.y, bx = 2 * (m.x - p.x), by = 2 * (m.y - p.y);
    const std::int64_t d = ax * by - ay * bx;
    const std::int64_t xx = ay * ay, yy = ax * ax, xy = -2 * ax * ay;
    const std::int64_t x = -2 * xx * p.x - xy * p.y - d * by, y = -2 * yy * p.y - xy * p.x + d * bx;
    const std::int64_t one = xx * p.x * p.x + yy * p.y * p.y + xy * p.x * p.y + d * (by * p.x - bx * p.y);
    const CGAL::Orientation turn = d < 0 ? CGAL::COUNTERCLOCKWISE : CGAL::CLOCKWISE; // (m − p) × (q − m) = −d/2
    return {xx, yy, xy, x, y, one, turn, Traits::Point_2(p.x, p.y), Traits::Point_2(q.x, q.y)};
}

} // namespace

Subdivision conic_subdivision(std::span<const Path> paths) {
    std::vector<Traits::Curve_2> curves;
    for (const Path& path : paths) {
        for (const auto& s : path)
            curves.push_back(s.size() == 2 ? line(s[0], s[1]) : parabola(s[0], s[1], s[2]));
    }
    CGAL::Arrangement_2<Traits> arrangement;
    CGAL::insert(arrangement, curves.begin(), curves.end());
    return plain(arrangement, [](const Traits::Point_2& p) {
        return CanvasPoint{CGAL::to_double(p.x()), CGAL::to_double(p.y())};
    });
}

} // namespace fetexc::test
