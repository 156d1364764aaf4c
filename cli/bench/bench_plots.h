// SPDX-License-Identifier: GPL-3.0-or-later
/// From figures to plots: which lines there are, means over drawings, what stands on the axes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_point.h"
#include "cli/bench/plot.h"

namespace fetexc::cli {

/// What is plotted upwards, at the last output size, and to the right.
enum class ErrorAxis : std::uint8_t {
    WrongArea,
    ColorError,
    NormalAngle, ///< of BenchFile::curve_points, the others of its points
};
enum class CostAxis : std::uint8_t { Bytes, CompileTime, SamplerCost };

/// Methods in the order of their styles.
const std::array<std::string, kPlotStyles>& bench_methods();
/// Those of NormalAngle: bitmaps have the style that they have there.
const std::vector<std::string>& curve_methods();

/// Drawings that the same methods apply to.
using FileGroup = std::vector<const BenchFile*>;

/// Methods that apply to every drawing of the group.
std::vector<std::string> methods_of(const FileGroup& group, ErrorAxis error = ErrorAxis::WrongArea);

/// One line for each of methods_of, one point for each size: geometric means over the drawings. Where no sample point
/// was wrong, half a point counts, where the PSNR is beyond what can be told, that; the mean then says "at most".
/// Without lines when no drawing has such figures (nothing was timed).
Plot mean_plot(const FileGroup& group, ErrorAxis error, CostAxis cost);

/// Small plots, one for each drawing, error against bytes; all with the same axes.
std::vector<Plot> small_plots(const FileGroup& group, ErrorAxis error);

} // namespace fetexc::cli
