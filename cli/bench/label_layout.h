// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the names of lines go: beside an end of their line, clear of each other and of what is drawn.
#pragma once

#include <string>
#include <vector>

namespace fetexc::cli {

struct PixelPosition {
    double x = 0, y = 0;
};

struct PixelBox {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] bool overlaps(const PixelBox& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

/// A line to name: its points from left to right or as they come.
struct NamedLine {
    std::string name;
    std::vector<PixelPosition> points;
};

/// A name stands with its left end (or its right one) at `x`, its middle at `y`.
struct PlacedLabel {
    double x = 0, y = 0;
    bool right_aligned = false;
    PixelBox box;
};

/// One label for each line, inside `room`. Of a few places around both ends of each line, those that cover least, no
/// two labels having better ones: other labels count most, then points, then lines. The last end is preferred, and its
/// right. A line without points has an empty label.
std::vector<PlacedLabel> place_labels(const std::vector<NamedLine>& lines, const PixelBox& room, double font_size);

/// Width of a text in a common sans-serif face; a guess that errs on the wide side.
double text_width(const std::string& text, double font_size);

} // namespace fetexc::cli
