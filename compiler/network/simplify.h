// SPDX-License-Identifier: GPL-3.0-or-later
/// Networks of lower degree.
#pragma once

#include "compiler/network/network.h"
#include "compiler/result.h"

namespace fetexc {

/// Cubics become as many quadratics as it takes to stay within `tolerance` of them (> 0, user units), at equal steps of
/// their parameter; quadratics with two equal control points become lines (Parilov and Zorin take no others). Ends of
/// segments stay as they are, bit for bit. Tangents of neighbouring quadratics differ by an angle of the order of the
/// tolerance over their length. Error 1504: more than kNetworkMaxSegments come out.
Result<Network> to_quadratics(const Network& network, double tolerance);

/// Curves become chords whose ends lie on them, that stay within `tolerance` of them. Likewise.
Result<Network> to_lines(const Network& network, double tolerance);

/// User units: kQuadraticTolerance for a network.
double quadratic_tolerance(const Network& network);

} // namespace fetexc
