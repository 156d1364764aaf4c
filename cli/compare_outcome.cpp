// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compare_outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "compiler/error_budget.h"

namespace fetexc::cli {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Texels; beyond the reach nothing is known but that.
double hausdorff(const measure::Distances& d, double texel_side) {
    return d.beyond_reach > 0 ? kInfinite : d.hausdorff / texel_side;
}

/// Takes the worst of all sizes; `worse` says whether the first figure is worse than the second.
template <class Entry, class Figure, class Worse>
void find_worst(ThresholdCheck& check, const std::vector<Entry>& entries, const Figure& figure, const Worse& worse) {
    for (const Entry& e : entries) {
        const double found = figure(e);
        if (check.pixels.width != 0 && !worse(found, check.worst)) continue;
        check.worst = found, check.pixels = e.pixels;
    }
    check.passed = !worse(check.worst, check.limit);
}

} // namespace

std::vector<ThresholdCheck> check(const CompareOutcome& outcome, const Thresholds& thresholds) {
    std::vector<ThresholdCheck> checks;
    const auto add = [&](const std::optional<double>& limit, const char* option, const char* what, const char* unit,
                         const auto& worse, const auto& of_errors, const auto& of_difference) {
        if (!limit) return;
        ThresholdCheck c{option, what, unit, *limit, 0, {}, true};
        if (outcome.errors.empty())
            find_worst(c, outcome.differences, of_difference, worse);
        else
            find_worst(c, outcome.errors, of_errors, worse);
        checks.push_back(c);
    };
    using Errors = measure::SizeErrors;
    using Difference = measure::PictureDifference;
    const auto nothing = [](const Difference&) { return 0.0; };
    const std::greater<> more;
    add(
        thresholds.misclassified, "--max-misclassified", "misclassified area", "ppm", more,
        [](const Errors& e) { return e.misclassified_ppm; }, nothing);
    add(
        thresholds.distance, "--max-distance", "largest distance between edges", "texels", more,
        [&](const Errors& e) {
            return std::max(hausdorff(e.to_truth, outcome.texel_side), hausdorff(e.to_picture, outcome.texel_side));
        },
        nothing);
    add(
        thresholds.psnr, "--min-psnr", "PSNR", "dB", std::less<>{}, [](const Errors& e) { return e.psnr; },
        [](const Difference& d) { return d.psnr; });
    add(
        thresholds.color, "--max-color", "largest colour error", "/255",
        [](double a, double b) { return a > b + 255 * budget::kColorNoise; },
        [](const Errors& e) { return e.away.max * 255; }, [](const Difference& d) { return d.max * 255; });
    add(
        thresholds.islands, "--max-islands", "lost and false islands", "", more,
        [](const Errors& e) { return static_cast<double>(e.islands.lost + e.islands.invented); }, nothing);
    return checks;
}

bool all_passed(const CompareOutcome& outcome) {
    return std::all_of(outcome.checks.begin(), outcome.checks.end(), [](const auto& c) { return c.passed; });
}

std::string describe(const ThresholdCheck& c) {
    const std::string worst = std::isinf(c.worst) ? std::string("beyond the reach") : fmt::format("{:.6g}", c.worst);
    const std::string unit = *c.unit == 0 || std::isinf(c.worst) ? ""
                             : *c.unit == '/'                    ? c.unit
                                                                 : fmt::format(" {}", c.unit);
    return fmt::format("{} {}{} at {} x {} pixels is beyond {} {:.6g}", c.what, worst, unit, c.pixels.width,
                       c.pixels.height, c.option, c.limit);
}

} // namespace fetexc::cli
