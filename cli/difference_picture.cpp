// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/difference_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/colors.h"

namespace fetexc::cli {
namespace {

struct Rgb {
    double r = 0, g = 0, b = 0;
};

/// Evenly spaced, light to dark.
constexpr std::array<Rgb, 5> kScale = {
    {{1.00, 0.80, 0.10}, {0.95, 0.50, 0.05}, {0.80, 0.20, 0.25}, {0.45, 0.05, 0.45}, {0.05, 0.00, 0.10}}};
constexpr double kLeast = 1.0 / 255;               ///< what rounding to eight bits may do is not wrong
constexpr double kGreyFrom = 0.72, kGreyTo = 0.96; ///< of black and of white

Rgb wrong_color(double difference) {
    const double share = std::clamp(std::log(difference / kLeast) / std::log(1 / kLeast), 0.0, 1.0);
    const double at = share * (kScale.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
    const double t = at - static_cast<double>(k);
    const Rgb &a = kScale[k], &b = kScale[k + 1];
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

/// Over white. Rec. 709 weights.
Rgb grey(const Rgba& c) {
    const double light = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b + 1 - c.a;
    const double value = kGreyFrom + (kGreyTo - kGreyFrom) * std::clamp(light, 0.0, 1.0);
    return {value, value, value};
}

} // namespace

fetex::Image difference_picture(const std::vector<Rgba>& truth, const std::vector<Rgba>& other, GridSize pixels) {
    assert(truth.size() == other.size() && truth.size() == std::size_t{pixels.width} * pixels.height);
    fetex::Image image{pixels.width, pixels.height, {}};
    image.rgba.reserve(truth.size() * 4);
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const double difference = measure::contrast(truth[k], other[k]);
        const Rgb c = difference > kLeast + budget::kColorNoise ? wrong_color(difference) : grey(truth[k]);
        for (const double channel : {c.r, c.g, c.b, 1.0})
            image.rgba.push_back(static_cast<float>(channel));
    }
    return image;
}

} // namespace fetexc::cli
