// SPDX-License-Identifier: GPL-3.0-or-later
/// Straight edges under the pixels of an anti-aliased picture.
#pragma once

#include <array>
#include <optional>

namespace fetexc {

/// In a pixel's frame, its centre at 0: above where nx·x + ny·y > offset; (nx, ny) of length 1.
struct EdgeLine {
    double nx = 0, ny = 0, offset = 0;
};

/// The part of a square of side 1 around 0 that is above the line; exact.
double covered_part(const EdgeLine& line);

/// The line whose covered_part in nine pixels, row by row, the pixel's own in the middle, comes nearest to `coverage`
/// (0…1 each), by least squares. None if no line fits them (root mean square beyond budget::kEdgeLineMisfit).
std::optional<EdgeLine> fit_edge_line(const std::array<double, 9>& coverage);

} // namespace fetexc
