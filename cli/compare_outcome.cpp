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

using Errors = measure::SizeErrors;
using Curves = measure::CurveErrors;
using Difference = measure::PictureDifference;

/// The same figure of each kind of entry.
template <class... Of> struct Figure : Of... { using Of::operator()...; };
template <class... Of> Figure(Of...) -> Figure<Of...>; // clang 14 has none for aggregates
/// Not one of such entries: options that ask for it are refused before.
template <class Entry> constexpr auto nothing = [](const Entry&) { return 0.0; };

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
                         const auto& worse, const auto& figure) {
        if (!limit) return;
        ThresholdCheck c{option, what, unit, *limit, 0, {}, true};
        if (!outcome.errors.empty())
            find_worst(c, outcome.errors, figure, worse);
        else if (!outcome.curve_errors.empty())
            find_worst(c, outcome.curve_errors, figure, worse);
        else
            find_worst(c, outcome.differences, figure, worse);
        checks.push_back(c);
    };
    const std::greater<> more;
    add(thresholds.misclassified, "--max-misclassified", "misclassified area", "ppm", more,
        Figure{[](const Errors& e) { return e.misclassified_ppm; }, nothing<Curves>, nothing<Difference>});
    const auto farthest = [&](const measure::Distances& a, const measure::Distances& b) {
        return std::max(hausdorff(a, outcome.texel_side), hausdorff(b, outcome.texel_side));
    };
    add(thresholds.distance, "--max-distance",
        outcome.curve_errors.empty() ? "largest distance between edges" : "largest distance between curves", "texels",
        more,
        Figure{[&](const Errors& e) { return farthest(e.to_truth, e.to_picture); },
               [&](const Curves& e) { return farthest(*e.to_truth, *e.to_picture); }, nothing<Difference>});
    add(thresholds.psnr, "--min-psnr", "PSNR", "dB", std::less<>{},
        Figure{[](const Errors& e) { return e.psnr; }, [](const Curves& e) { return e.colors.psnr; },
               [](const Difference& d) { return d.psnr; }});
    add(
        thresholds.color, "--max-color", "largest colour error", "/255",
        [](double a, double b) { return a > b + 255 * budget::kColorNoise; },
        Figure{[](const Errors& e) { return e.away.max * 255; }, [](const Curves& e) { return e.colors.max * 255; },
               [](const Difference& d) { return d.max * 255; }});
    add(thresholds.islands, "--max-islands", "lost and false islands", "", more,
        Figure{[](const Errors& e) { return static_cast<double>(e.islands.lost + e.islands.invented); },
               nothing<Curves>, nothing<Difference>});
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
