// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's assertions stay on where it is an oracle: what they don't catch crashes or is wrong. Timings go without.
#ifndef FETEXC_CGAL_UNCHECKED
#undef NDEBUG
#endif
#include <CGAL/Arr_Bezier_curve_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/CORE_algebraic_number_traits.h>
#include <CGAL/Cartesian.h>

#include <ctime>

#include "tests/support/cgal_arrangement.h"
#include "tests/support/cgal_oracles.h"

namespace fetexc::test {
namespace {

using NumberTraits = CGAL::CORE_algebraic_number_traits;
using RationalKernel = CGAL::Cartesian<NumberTraits::Rational>;
using AlgebraicKernel = CGAL::Cartesian<NumberTraits::Algebraic>;
using Traits = CGAL::Arr_Bezier_curve_traits_2<RationalKernel, AlgebraicKernel, NumberTraits>;

/// Points are boxes until something needs more; here they shrink until the middle is good to a double.
CanvasPoint middle(const Traits::Point_2& p) {
    constexpr double narrow = 1e-10;
    for (int k = 0; k < 200 && !p.is_exact(); ++k) {
        NumberTraits::Rational x0, y0, x1, y1;
        p.get_bbox(x0, y0, x1, y1);
        if (CGAL::to_double(x1 - x0) < narrow && CGAL::to_double(y1 - y0) < narrow) break;
        if (!p.refine()) break;
    }
    const auto [x, y] = p.approximate();
    return {x, y};
}

void insert(std::span<const Path> paths, CGAL::Arrangement_2<Traits>& arrangement) {
    std::vector<Traits::Curve_2> curves;
    for (const Path& path : paths) {
        for (const auto& segment : path) {
            std::vector<Traits::Rat_point_2> control;
            for (const LatticePoint& p : segment)
                control.emplace_back(p.x, p.y);
            curves.emplace_back(control.begin(), control.end());
        }
    }
    CGAL::insert(arrangement, curves.begin(), curves.end());
}

} // namespace

Subdivision bezier_subdivision(std::span<const Path> paths) {
    CGAL::Arrangement_2<Traits> arrangement;
    insert(paths, arrangement);
    return plain(arrangement, middle);
}

InsertionTiming time_bezier_insertion(std::span<const Path> paths) {
    const std::clock_t start = std::clock();
    CGAL::Arrangement_2<Traits> a;
    insert(paths, a);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return {seconds, a.number_of_vertices(), a.number_of_edges(), a.number_of_faces()};
}

} // namespace fetexc::test
