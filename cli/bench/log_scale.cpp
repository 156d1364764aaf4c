// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/log_scale.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

namespace fetexc::cli {
namespace {

constexpr double kLeastDecades = 1.0 / 3;
constexpr double kMargin = 0.06; ///< of the axis, on either side

std::string with_commas(std::string digits) {
    for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

} // namespace

LogScale::LogScale(double lo, double hi, double first_pixel, double last_pixel)
    : lo_(std::log10(lo)), hi_(std::log10(hi)), first_(first_pixel), last_(last_pixel) {
    assert(lo > 0 && lo <= hi);
    const double missing = std::max(kLeastDecades - (hi_ - lo_), 0.0) / 2;
    const double margin = kMargin * (hi_ - lo_) + missing;
    lo_ -= margin, hi_ += margin;
}

double LogScale::pixel(double value) const {
    return first_ + (std::log10(value) - lo_) / (hi_ - lo_) * (last_ - first_);
}

std::vector<double> LogScale::multiples(const std::vector<double>& factors) const {
    std::vector<double> values;
    for (int power = static_cast<int>(std::floor(lo_)); power <= static_cast<int>(std::ceil(hi_)); ++power) {
        for (const double factor : factors) {
            const double value = factor * std::pow(10, power);
            if (std::log10(value) >= lo_ && std::log10(value) <= hi_) values.push_back(value);
        }
    }
    return values;
}

std::vector<double> LogScale::ticks(std::size_t most) const {
    std::vector<double> decades = multiples({1});
    if (decades.size() >= 3) {
        const std::size_t step = (decades.size() + most - 1) / most;
        std::vector<double> kept;
        for (std::size_t k = 0; k < decades.size(); k += step)
            kept.push_back(decades[k]);
        return kept;
    }
    std::vector<double> finer = multiples({1, 2, 5});
    if (finer.size() < 3) finer = multiples({1, 1.5, 2, 3, 5, 7});
    if (finer.size() < 2) finer = multiples({1, 1.5, 2, 2.5, 3, 4, 5, 6, 8}); // no third of a decade has fewer than two
    return finer.size() <= most || decades.size() < 2 ? finer : decades;
}

std::string count_label(double value) {
    if (value < 1000) return fmt::format("{:.4g}", value);
    return with_commas(fmt::format("{:.0f}", value));
}

std::string bytes_label(double value) {
    if (value < 1000) return fmt::format("{:.3g} B", value);
    if (value < 1e6) return fmt::format("{:.3g} kB", value / 1e3);
    if (value < 1e9) return fmt::format("{:.3g} MB", value / 1e6);
    return fmt::format("{:.3g} GB", value / 1e9);
}

} // namespace fetexc::cli
