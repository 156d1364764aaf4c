// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/equal_error.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "compiler/measure/sparse_bitmap.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kFirstSide = 8;

} // namespace

std::string EqualErrorBitmap::text() const {
    return (found ? "" : "more than ") + std::to_string(size.width) + "x" + std::to_string(size.height);
}

Result<SmallestSide> smallest_side(std::uint32_t largest, double precision,
                                   const std::function<Result<bool>(std::uint32_t)>& good_enough) {
    std::uint32_t bad = 0, good = std::min(kFirstSide, largest);
    unsigned tried = 0;
    for (;; good = good > largest / 2 ? largest : good * 2) {
        const auto enough = good_enough(good);
        if (!enough) return enough.error();
        ++tried;
        if (enough.value()) break;
        bad = good;
        if (good == largest) return SmallestSide{false, largest, tried};
    }
    while (good - bad > 1 && good - bad > precision * good) {
        const std::uint32_t middle = bad + (good - bad) / 2;
        const auto enough = good_enough(middle);
        if (!enough) return enough.error();
        ++tried;
        (enough.value() ? good : bad) = middle;
    }
    return SmallestSide{true, good, tried};
}

Result<EqualErrorBitmap> bitmap_of_equal_error(const Truth& truth, double target, const EqualErrorOptions& options) {
    assert(!options.measure.sizes.empty());
    const bool psnr = options.figure == ErrorFigure::Psnr;
    MeasureOptions only_that = options.measure;
    only_that.sizes.resize(1);
    only_that.figures = Figures::none();
    (psnr ? only_that.figures.psnr : only_that.figures.misclassified) = true;
    const Result<Measurer> measurer = Measurer::of(truth, only_that);
    if (!measurer) return measurer.error();
    std::map<std::uint32_t, double> errors;
    const auto good_enough = [&](std::uint32_t side) -> Result<bool> {
        const SparseBitmap bitmap(truth, grid_for(truth.scene().extent, side), options.measure.threads);
        const SizeErrors figures = measurer.value().measure(bitmap).front();
        const double error = psnr ? figures.psnr : figures.misclassified_ppm;
        errors[side] = error;
        return psnr ? error >= target : error <= target;
    };
    const auto smallest = smallest_side(options.largest, options.precision, good_enough);
    if (!smallest) return smallest.error();
    const GridSize size = grid_for(truth.scene().extent, smallest.value().side);
    return EqualErrorBitmap{smallest.value().found, size, std::uint64_t{size.width} * size.height * 4,
                            errors[smallest.value().side], smallest.value().tried};
}

} // namespace fetexc::measure
