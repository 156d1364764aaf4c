// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes by what curves may move.
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/network/curve_profiles.h"
#include "compiler/scene/lattice.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kFewest = 4, kMost = 4096, kUnasked = 1024; ///< likewise, for what moves
constexpr std::uint32_t kSteps = 16;                                ///< the size is found to a part of itself

class SizeChoice {
  public:
    SizeChoice(const Network& network, const Extent& extent, const FeatureCurvesOptions& options,
               std::uint64_t max_bytes)
        : network_(network), extent_(extent), options_(options), max_bytes_(max_bytes) {}

    [[nodiscard]] FeatureCurvesOptions at(std::uint32_t side) const {
        FeatureCurvesOptions out = options_;
        out.size = grid_for(extent_, side);
        return out;
    }

    /// By the longer side; 0: none fits.
    [[nodiscard]] std::uint32_t largest_that_fits(std::uint32_t most) const {
        if (max_bytes_ == 0) return most;
        std::uint32_t good = 0, beyond = most + 1;
        while (beyond - good > 1) {
            const std::uint32_t middle = good + (beyond - good) / 2;
            (feature_curves_bytes(network_, at(middle)) <= max_bytes_ ? good : beyond) = middle;
        }
        return good;
    }

    /// Doubled until curves move no farther, then bisected. None does: nothing, and best() has the side of the least.
    Result<std::optional<std::uint32_t>> smallest(double max_move, std::uint32_t least, std::uint32_t most) {
        std::uint32_t bad = least - 1, good = 0;
        for (std::uint32_t side = least; good == 0;) {
            const auto moved = move_at(side);
            if (!moved) return moved.error();
            if (moved.value() <= max_move) good = side;
            if (good != 0 || side == most) break;
            bad = side, side = std::min(2 * side, most);
        }
        if (good == 0) return std::optional<std::uint32_t>();
        while (good - bad > std::max(1U, good / kSteps)) {
            const std::uint32_t middle = bad + (good - bad) / 2;
            const auto moved = move_at(middle);
            if (!moved) return moved.error();
            (moved.value() <= max_move ? good : bad) = middle;
        }
        return std::optional(good);
    }

    [[nodiscard]] std::uint32_t best() const { return best_; }
    [[nodiscard]] double least_move() const { return least_move_; }

  private:
    Result<double> move_at(std::uint32_t side) {
        const auto found = feature_curves_move(network_, at(side));
        if (!found) return found.error();
        const double moved = found.value();
        if (moved < least_move_) least_move_ = moved, best_ = side;
        return moved;
    }

    const Network& network_;
    Extent extent_;
    const FeatureCurvesOptions& options_;
    std::uint64_t max_bytes_;
    std::uint32_t best_ = 0;
    double least_move_ = INFINITY;
};

Error not_met(const SizeChoice& choice, double max_move, std::uint32_t most) {
    std::ostringstream text;
    text << "no texture with feature curves of up to " << most << " texels has them within " << max_move
         << " units of where they belong; the nearest are within " << choice.least_move();
    return {ErrorClass::Unsupported, diag::kFeatureErrorUnmet, text.str(), "--max-move"};
}

/// A texel a pixel of the base map, so that it isn't blurred.
std::uint32_t least_side(const FeatureCurvesOptions& options) {
    if (options.base.image == nullptr) return kFewest;
    return std::max({kFewest, options.base.image->width, options.base.image->height});
}

} // namespace

Result<FeatureCurvesBuild> compile_feature_curves_at_chosen_size(const Network& network,
                                                                 const FeatureCurvesOptions& options,
                                                                 FeatureLimits limits, const ProgressSink& progress) {
    const Result<Extent> extent = make_extent(network.width, network.height);
    if (!extent) return extent.error();
    SizeChoice choice(network, extent.value(), options, limits.max_bytes);
    const std::uint32_t least = least_side(options);
    const std::uint32_t most = choice.largest_that_fits(std::max(least, limits.max_move > 0 ? kMost : kUnasked));
    if (most == 0)
        return Error{ErrorClass::Unsupported, diag::kFeatureBudget,
                     "no size of a texture with feature curves fits in " + std::to_string(limits.max_bytes) + " bytes",
                     ""};
    const CurveProfiles profiles = curve_profiles(network, options.profile);
    const double narrowest = std::ranges::min_element(profiles.profiles, {}, &FeatureProfile::width)->width;
    const double max_move = limits.max_move > 0 ? limits.max_move : budget::kFeatureChosenMove * narrowest;
    const auto side = choice.smallest(max_move, std::min(least, most), most);
    if (!side) return side.error();
    if (!side.value() && limits.max_move > 0) return not_met(choice, max_move, most);
    return compile_feature_curves(network, choice.at(side.value().value_or(choice.best())), progress);
}

} // namespace fetexc
