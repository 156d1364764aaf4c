// SPDX-License-Identifier: GPL-3.0-or-later
/// The last part of a fit: bytes, one after another, each to where the wrong area around it is least.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/bilevel/contour_fit.h"
#include "compiler/bilevel/threshold_cells.h"
#include "compiler/bilevel/value_levels.h"

namespace fetexc {

/// Values between 112 and 143 in level 0.
enum class MidGreys : std::uint8_t { Allow, Avoid };

/// How many levels the values have, and what they are; greys: of bytes.
struct StoredLevels {
    ValueLevels levels;
    MidGreys greys = MidGreys::Allow;

    /// v + by within the levels; what falls on a grey to be avoided goes on to the next one that isn't.
    [[nodiscard]] std::uint16_t moved(std::uint16_t v, int by) const;
};

/// v + by within 0 … 255; what falls on a grey to be avoided goes on to the next one that isn't.
std::uint8_t moved(std::uint8_t v, int by, MidGreys greys);

/// How long.
struct ByteSweeps {
    int most = 60; ///< sweeps in all
    int pairs = 0; ///< of them at most so many over pairs
    bool settle = false;
};

/// Sweeps over the texels of the cells, in order: a byte goes up or down, by steps that grow while they help and shrink
/// while they don't, until no single step of 1 makes the wrong area less. Then sweeps over pairs of bytes, of
/// neighbours or of two channels of a texel, by 1 each; after such a sweep single ones again, and in the end, if they
/// are to settle, every byte goes as far from one half as costs nothing. What nothing around has changed since it was
/// last tried isn't tried again. The trace gets the wrong area after each sweep. Returns the bytes and pairs tried.
std::uint64_t fit_bytes(const ThresholdCells& cells, std::vector<std::uint8_t>& values, MidGreys greys,
                        ByteSweeps sweeps, FitTrace& trace);

/// The same of numbers stored otherwise; steps grow and shrink between the levels' grain and so many of it as of bytes.
std::uint64_t fit_stored(const ThresholdCells& cells, std::vector<std::uint16_t>& stored, const StoredLevels& levels,
                         ByteSweeps sweeps, FitTrace& trace);

} // namespace fetexc
