// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/edge_lines.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr int kSteps = 6;

EdgeLine line_of(double angle, double offset) { return {std::cos(angle), std::sin(angle), offset}; }

/// Misfits of the nine pixels.
std::array<double, 9> misfits(const EdgeLine& line, const std::array<double, 9>& coverage) {
    std::array<double, 9> out{};
    for (int k = 0; k < 9; ++k) {
        const double x = k % 3 - 1, y = k / 3 - 1;
        const EdgeLine moved{line.nx, line.ny, line.offset - line.nx * x - line.ny * y};
        out[static_cast<std::size_t>(k)] = covered_part(moved) - coverage[static_cast<std::size_t>(k)];
    }
    return out;
}

double square_sum(const std::array<double, 9>& v) {
    double sum = 0;
    for (const double d : v)
        sum += d * d;
    return sum;
}

} // namespace

double covered_part(const EdgeLine& line) {
    const double a = std::max(std::fabs(line.nx), std::fabs(line.ny)),
                 b = std::min(std::fabs(line.nx), std::fabs(line.ny));
    const double depth = -line.offset; // of the centre, in what is above
    const double far = 0.5 * (a + b), flat = 0.5 * (a - b);
    if (std::fabs(depth) >= far) return depth > 0 ? 1 : 0;
    if (std::fabs(depth) <= flat) return 0.5 + depth / a;
    const double corner = (far - std::fabs(depth)) * (far - std::fabs(depth)) / (2 * a * b);
    return depth > 0 ? 1 - corner : corner;
}

std::optional<EdgeLine> fit_edge_line(const std::array<double, 9>& c) {
    const double gx = (c[2] + 2 * c[5] + c[8]) - (c[0] + 2 * c[3] + c[6]),
                 gy = (c[6] + 2 * c[7] + c[8]) - (c[0] + 2 * c[1] + c[2]);
    if (gx == 0 && gy == 0) return std::nullopt;
    double angle = std::atan2(gy, gx), offset = 0.5 - c[4];
    double least = square_sum(misfits(line_of(angle, offset), c));
    for (int step = 0; step < kSteps; ++step) {
        constexpr double h = budget::kEdgeLineDifference;
        const std::array<double, 9> r = misfits(line_of(angle, offset), c), ra = misfits(line_of(angle + h, offset), c),
                                    ro = misfits(line_of(angle, offset + h), c);
        double aa = 0, ao = 0, oo = 0, a = 0, o = 0;
        for (std::size_t k = 0; k < 9; ++k) {
            const double da = (ra[k] - r[k]) / h, d_o = (ro[k] - r[k]) / h;
            aa += da * da, ao += da * d_o, oo += d_o * d_o, a += da * r[k], o += d_o * r[k];
        }
        const double determinant = aa * oo - ao * ao;
        if (!(determinant > budget::kEdgeLineDifference * aa * oo)) break;
        const double next_angle = angle - (a * oo - o * ao) / determinant,
                     next = offset - (o * aa - a * ao) / determinant;
        const double sum = square_sum(misfits(line_of(next_angle, next), c));
        if (!(sum < least)) break;
        angle = next_angle, offset = next, least = sum;
    }
    if (least > 9 * budget::kEdgeLineMisfit * budget::kEdgeLineMisfit) return std::nullopt;
    return line_of(angle, offset);
}

} // namespace fetexc
