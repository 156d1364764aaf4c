// SPDX-License-Identifier: GPL-3.0-or-later
/// How large an ordinary bitmap must be to be as good: the smallest bilinear RGBA8 bitmap, box-filtered from the truth,
/// whose error is at most a given one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "compiler/measure/errors.h"

namespace fetexc::measure {

enum class ErrorFigure : std::uint8_t { MisclassifiedArea, Psnr };

struct EqualErrorOptions {
    ErrorFigure figure = ErrorFigure::MisclassifiedArea;
    std::uint32_t largest = 16384; ///< texels on the longer side: what GPUs take
    double precision = 0.02;       ///< of the side found
    MeasureOptions measure;        ///< the first size counts
};

struct EqualErrorBitmap {
    bool found = false; ///< false: even the largest is worse; what follows is the largest's
    GridSize size;
    std::uint64_t bytes = 0;
    double error = 0;   ///< ppm or dB
    unsigned tried = 0; ///< bitmaps made and measured
    /// "1387x1040", "more than 16384x12288".
    [[nodiscard]] std::string text() const;
};

/// target: at most so many ppm, or at least so many dB. Errors: those of measure().
Result<EqualErrorBitmap> bitmap_of_equal_error(const Truth& truth, double target, const EqualErrorOptions& options);

/// The search alone: doubled from 8 until `good_enough`, then bisected. Errors of bitmaps go up and down a little from
/// size to size, so a smaller one may be good enough by luck.
struct SmallestSide {
    bool found = false;
    std::uint32_t side = 0;
    unsigned tried = 0;
};
Result<SmallestSide> smallest_side(std::uint32_t largest, double precision,
                                   const std::function<Result<bool>(std::uint32_t)>& good_enough);

} // namespace fetexc::measure
