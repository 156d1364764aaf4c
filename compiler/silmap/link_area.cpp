// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/link_area.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Mean of max(0, f) while f goes evenly from a to b.
double mean_above(double a, double b) {
    const double pa = std::max(a, 0.0), pb = std::max(b, 0.0);
    if (a * b >= 0) return (pa + pb) / 2; // nearly always
    return (pa * pa + pb * pb) / (2 * std::abs(a - b));
}

int counts(ResultId is, ResultId plus, ResultId minus) {
    return static_cast<int>(is == plus) - static_cast<int>(is == minus);
}

/// ∫ C_plus(x) − C_minus(x) dy on the way from one point to another, with the sign of its way down.
double integral(const CellTruth& truth, const SilmapPoint& from, const SilmapPoint& to, ResultId plus, ResultId minus) {
    const bool down = from.y < to.y;
    const SilmapPoint &top = down ? from : to, &bottom = down ? to : from;
    if (!(top.y < bottom.y)) return 0;
    const double slope = (bottom.x - top.x) / (bottom.y - top.y);
    double sum = 0;
    for (const TruthSlab& slab : truth.slabs) {
        if (slab.y1 <= top.y) continue;
        if (slab.y0 >= bottom.y) break;
        const double y0 = std::max(slab.y0, top.y), y1 = std::min(slab.y1, bottom.y);
        const double x0 = top.x + (y0 - top.y) * slope, x1 = top.x + (y1 - top.y) * slope;
        const double u0 = (y0 - slab.y0) * slab.per_height, u1 = (y1 - slab.y0) * slab.per_height;
        int slope_now = counts(slab.left, plus, minus);
        double mean = slope_now * mean_above(x0 - truth.box.x0, x1 - truth.box.x0);
        for (const TruthLine& line : truth.all.lines_of(slab)) {
            const int slope_then = counts(line.right, plus, minus);
            if (slope_then == slope_now) continue;
            mean += (slope_then - slope_now) * mean_above(x0 - line.top - u0 * line.run, x1 - line.top - u1 * line.run);
            slope_now = slope_then;
        }
        if (truth.box.x1 < 1) mean -= slope_now * mean_above(x0 - truth.box.x1, x1 - truth.box.x1);
        sum += (y1 - y0) * mean;
    }
    return down ? sum : -sum;
}

} // namespace

ResultId result_at(const CellTruth& truth, double x, double y) {
    const TruthSlab* slab = truth.slabs.data();
    for (const TruthSlab* last = slab + truth.slabs.size() - 1; slab != last && slab->y1 <= y;)
        ++slab;
    const double u = (y - slab->y0) * slab->per_height;
    ResultId result = slab->left;
    for (const TruthLine& line : truth.all.lines_of(*slab)) {
        if (line.top + u * line.run > x) break;
        result = line.right;
    }
    return result;
}

double ShownCell::exit_of(const SilmapPoint& point, std::uint32_t link, const SilmapPoint& across) {
    switch (link) {
    case fetex::kSilmapWest:
        return point.y + (across.y - point.y) * (point.x / (point.x - across.x));
    case fetex::kSilmapEast:
        return point.y + (across.y - point.y) * ((1 - point.x) / (across.x - point.x));
    case fetex::kSilmapNorth:
        return point.x + (across.x - point.x) * (point.y / (point.y - across.y));
    default:
        return point.x + (across.x - point.x) * ((1 - point.y) / (across.y - point.y));
    }
}

double area_of(const CellTruth& truth, ResultId result) {
    double sum = 0;
    for (const TruthSlab& slab : truth.slabs) {
        double width = 0, from = truth.box.x0;
        ResultId is = slab.left;
        for (const TruthLine& line : truth.all.lines_of(slab)) {
            const double to = line.top + line.run / 2; // in the box
            if (is == result) width += to - from;
            from = to, is = line.right;
        }
        if (is == result) width += truth.box.x1 - from;
        sum += (slab.y1 - slab.y0) * width;
    }
    return sum;
}

double link_area(const CellTruth& truth, const SilmapPoint& point, std::uint32_t link, double exit,
                 const std::array<ResultId, 4>& corners) {
    using namespace fetex;
    const auto between = [&](const SilmapPoint& from, const SilmapPoint& to, std::uint32_t plus, std::uint32_t minus) {
        return corners[plus] == corners[minus] ? 0 : integral(truth, from, to, corners[plus], corners[minus]);
    };
    switch (link) {
    case kSilmapWest:
        return between({0, exit}, point, kSilmapSW, kSilmapNW);
    case kSilmapNorth:
        return between({exit, 0}, point, kSilmapNW, kSilmapNE);
    case kSilmapSouth:
        return between(point, {exit, 1}, kSilmapSW, kSilmapSE);
    default: // and what lies above it, along the whole level
        return between({1, exit}, point, kSilmapNE, kSilmapSE) + between({1, 0}, {1, exit}, kSilmapNE, kSilmapSE);
    }
}

} // namespace fetexc
