// SPDX-License-Identifier: GPL-3.0-or-later
/// Line plots with two logarithmic axes as SVG that needs nothing from outside: for a page, for print, on its own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fetexc::cli {

enum class AxisUnit : std::uint8_t { Count, Bytes };

struct Axis {
    std::string title;
    AxisUnit unit = AxisUnit::Count;
    std::optional<std::array<double, 2>> range; ///< else what the points take
};

struct PlotPoint {
    double x = 0, y = 0;     ///< > 0
    bool at_most = false;    ///< the true y is this or less: a hollow mark
    std::string description; ///< shown when a mouse rests on the mark
};

struct PlotLine {
    std::string name;
    std::size_t style =
        0; ///< color, mark and dashes: 0 … kPlotStyles − 1, told apart in print and by any colour vision
    std::vector<PlotPoint> points;
};
inline constexpr std::size_t kPlotStyles = 9;

struct Plot {
    std::string title, note; ///< above the plot; either may be empty
    Axis x, y;
    std::vector<PlotLine> lines;
    double width = 720, height = 440; ///< pixels
    bool names = true;                ///< at the ends of lines
};

/// An <svg> element; stand_alone: a whole file with a white ground.
std::string plot_svg(const Plot& plot, bool stand_alone);

/// A mark with a stretch of line, for legends.
std::string legend_svg(std::size_t style);

/// Text for XML and HTML.
std::string escaped(const std::string& text);

} // namespace fetexc::cli
