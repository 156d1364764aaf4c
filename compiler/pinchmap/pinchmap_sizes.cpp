// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/pinchmap_sizes.h"

#include <algorithm>
#include <optional>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kFewest = 4, kMostUnasked = 1024; ///< clusters on the longer side
constexpr std::uint32_t kSteps = 16;                      ///< the size is found to a part of itself

std::uint64_t sample_bytes(fetex::PinchmapSampleFormat format) {
    switch (format) {
    case fetex::PinchmapSampleFormat::Rgb8:
        return 3;
    case fetex::PinchmapSampleFormat::Rgba8:
        return 4;
    default:
        return 8;
    }
}

class SizeChoice {
  public:
    using Build = std::function<Result<PinchmapBuild>(const PinchmapOptions&)>;

    SizeChoice(const PinchmapOptions& options, const Extent& extent, PinchmapLimits limits, const Build& build)
        : options_(options), extent_(extent), limits_(limits), build_(build) {}

    Result<PinchmapBuild> largest() const {
        const std::uint32_t side = largest_that_fits(most());
        if (side == 0)
            return Error{ErrorClass::Unsupported, diag::kPinchmapBudget,
                         "the pinchmap doesn't fit in " + std::to_string(limits_.max_bytes) +
                             " bytes: one cluster takes " + std::to_string(pinchmap_bytes(at(1))),
                         "--max-bytes"};
        return build_(at(side));
    }

    /// Doubled until it is good enough, then bisected; the best if none is and `required` is false.
    Result<PinchmapBuild> smallest(double wrong, std::uint32_t most, bool required) const {
        std::optional<PinchmapBuild> best;
        std::uint32_t bad = 0, good = 0;
        const std::uint32_t last = largest_that_fits(most);
        for (std::uint32_t side = std::min(kFewest, last); side > 0 && good == 0;) {
            Result<PinchmapBuild> made = build_(at(side));
            if (!made) return made;
            const bool better = !best || made.value().stats.wrong_area < best->stats.wrong_area;
            if (made.value().stats.wrong_area <= wrong) good = side;
            if (good != 0 || better) best = std::move(made).value();
            if (good != 0 || side == last) break;
            bad = side, side = std::min(2 * side, last);
        }
        if (good == 0 && (required || !best))
            return Error{ErrorClass::Unsupported, diag::kPinchmapErrorUnmet,
                         "no pinchmap of up to " + std::to_string(last) + " clusters has as little wrong area", ""};
        while (good != 0 && good - bad > std::max(1U, good / kSteps)) {
            const std::uint32_t middle = bad + (good - bad) / 2;
            Result<PinchmapBuild> made = build_(at(middle));
            if (!made) return made;
            if (made.value().stats.wrong_area > wrong) {
                bad = middle;
            } else {
                good = middle, best = std::move(made).value();
            }
        }
        return std::move(*best);
    }

    [[nodiscard]] std::uint32_t most() const { return fetex::kPinchmapMaxSide >> options_.scale; }

  private:
    [[nodiscard]] PinchmapOptions at(std::uint32_t side) const {
        PinchmapOptions out = options_;
        out.size = grid_for(extent_, side);
        return out;
    }
    /// 0: not even one cluster does.
    [[nodiscard]] std::uint32_t largest_that_fits(std::uint32_t most) const {
        if (limits_.max_bytes == 0) return most;
        std::uint32_t good = 0, beyond = most + 1;
        while (good + 1 < beyond) {
            const std::uint32_t middle = good + (beyond - good) / 2;
            (pinchmap_bytes(at(middle)) <= limits_.max_bytes ? good : beyond) = middle;
        }
        return good;
    }

    const PinchmapOptions& options_;
    Extent extent_;
    PinchmapLimits limits_;
    const Build& build_;
};

} // namespace

std::uint64_t pinchmap_bytes(const PinchmapOptions& options) {
    const std::uint64_t texels = (options.size.width + std::uint64_t{1}) * (options.size.height + std::uint64_t{1});
    const std::uint32_t w = options.size.width << options.scale, h = options.size.height << options.scale;
    return texels * 4 * fetex::pinchmap_words(options.map_format) +
           std::uint64_t{w} * h * sample_bytes(options.sample_format) +
           (options.mips ? std::uint64_t{4} * fetex::fbt_mip_samples(w, h) : 0);
}

Result<PinchmapBuild> choose_pinchmap_size(const PinchmapOptions& options, const Extent& extent, PinchmapLimits limits,
                                           const std::function<Result<PinchmapBuild>(const PinchmapOptions&)>& build) {
    const SizeChoice choice(options, extent, limits, build);
    if (limits.max_wrong_area > 0) return choice.smallest(limits.max_wrong_area, choice.most(), true);
    if (limits.max_bytes > 0) return choice.largest();
    return choice.smallest(budget::kPinchmapChosenError, std::min(kMostUnasked, choice.most()), false);
}

} // namespace fetexc
