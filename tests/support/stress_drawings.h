// SPDX-License-Identifier: GPL-3.0-or-later
/// Seeded drawings that are made to be hard (DESIGN §9), one generator for each kind of trap.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string_view>

#include "tests/support/drawing.h"
#include "tests/support/random.h"

namespace fetexc::test {

struct StressGenerator {
    const char* name;
    Drawing (*make)(Random& random);
    friend void PrintTo(const StressGenerator& g, std::ostream* out) { *out << g.name; } ///< for GoogleTest
};

[[nodiscard]] std::span<const StressGenerator> stress_generators();
[[nodiscard]] const StressGenerator* find_generator(std::string_view name);

/// Even-odd for odd seeds.
[[nodiscard]] Drawing stress_drawing(const StressGenerator& generator, std::uint64_t seed);

/// Closed triangles with `lines` edges through one point; every edge passes through it or ends there.
[[nodiscard]] Drawing lines_through_a_point(Random& random, int lines);

/// Thin triangles around a point, side by side, so that `rays` edges end there and nothing else meets.
[[nodiscard]] Drawing rays_from_a_point(int rays);

/// A picture in canvas units from 1e-300 to 1e12, with coordinates of very different size.
struct CanvasDrawing {
    double width = 1, height = 1;
    std::vector<std::vector<CanvasContour>> shapes;
    FillRule rule = FillRule::NonZero;
};
[[nodiscard]] CanvasDrawing wide_range_drawing(std::uint64_t seed);

} // namespace fetexc::test
