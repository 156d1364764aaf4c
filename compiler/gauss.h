// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss quadrature on [0,1] with three points: exact for degree 5.
#pragma once

#include <array>

namespace fetexc {

struct GaussPoint {
    double at, weight;
};
inline constexpr double kGaussReach = 0.38729833462074170; ///< √15 / 10
inline constexpr std::array<GaussPoint, 3> kGauss{
    {{0.5 - kGaussReach, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + kGaussReach, 5.0 / 18}}};

} // namespace fetexc
