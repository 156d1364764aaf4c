// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <optional>
#include <sstream>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/silmap/silmap_builder.h"
#include "formats/fbt_mip.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kFewest = 4, kMost = 16384, kMostUnasked = 1024;

/// They follow from the size alone.
std::uint64_t bytes_of(const SilmapOptions& options) {
    const std::uint64_t texels = std::uint64_t{options.size.width} * options.size.height,
                        cells = (options.size.width + std::uint64_t{1}) * (options.size.height + std::uint64_t{1});
    std::uint64_t bytes = cells * (options.cell_format == fetex::SilmapCellFormat::Bits8 ? 1 : 2);
    switch (options.sample_format) {
    case fetex::SilmapSampleFormat::Rgb8:
        bytes += 3 * texels;
        break;
    case fetex::SilmapSampleFormat::Rgba8:
        bytes += 4 * texels;
        break;
    default:
        bytes += 8 * texels;
    }
    if (options.mips) bytes += 4 * fetex::fbt_mip_samples(options.size.width, options.size.height);
    return bytes;
}

using BuildAtSize = std::function<Result<SilmapBuild>(const SilmapOptions&)>;

class SizeChoice {
  public:
    /// largest: texels on the longer side.
    SizeChoice(const Extent& extent, const SilmapOptions& options, std::uint64_t max_bytes, std::uint32_t largest,
               BuildAtSize build)
        : extent_(extent), options_(options), max_bytes_(max_bytes), largest_(largest), build_(std::move(build)) {}

    Result<SilmapBuild> largest() {
        std::uint32_t good = 0, least = largest_ + 1; // fits; doesn't
        while (good + 1 < least) {
            const std::uint32_t middle = good + (least - good) / 2;
            (fits(middle) ? good : least) = middle;
        }
        if (good == 0) {
            return Error{ErrorClass::Unsupported, diag::kSilmapBudget,
                         "the texture doesn't fit in " + std::to_string(max_bytes_) + " bytes: one texel takes " +
                             std::to_string(bytes_of(at(1))),
                         "--max-bytes"};
        }
        return build_(at(good));
    }

    /// The best if none is good enough and `required` is false.
    Result<SilmapBuild> smallest(double max_wrong, std::uint32_t most, bool required) {
        most = std::min(most, largest_);
        std::optional<SilmapBuild> found;
        std::uint32_t bad = 0, good = 0;
        for (std::uint32_t size = kFewest; size <= most && good == 0 && !error_; size *= 2) {
            std::optional<SilmapBuild> made = build(size);
            if (!made) break;
            least_wrong_ = std::min(least_wrong_, made->stats.wrong_area);
            if (made->stats.wrong_area <= max_wrong)
                good = size;
            else
                bad = size;
            found = std::move(made);
        }
        if (good == 0 && (required || !found)) return not_met(max_wrong);
        if (good == 0) return std::move(*found);
        for (std::uint32_t step = (good - bad) / 2; step > 0 && step >= good / kPrecision; step = (good - bad) / 2) {
            const std::uint32_t size = bad + step;
            std::optional<SilmapBuild> made = build(size);
            if (!made) break;
            if (made->stats.wrong_area <= max_wrong)
                good = size, found = std::move(made);
            else
                bad = size;
        }
        return std::move(*found);
    }

  private:
    static constexpr std::uint32_t kPrecision = 16; ///< a size is found to this part

    [[nodiscard]] SilmapOptions at(std::uint32_t longer_side) const {
        SilmapOptions o = options_;
        o.size = grid_for(extent_, longer_side);
        return o;
    }
    [[nodiscard]] bool fits(std::uint32_t size) const { return max_bytes_ == 0 || bytes_of(at(size)) <= max_bytes_; }

    /// Nothing: it doesn't fit, or can't be built (error_).
    std::optional<SilmapBuild> build(std::uint32_t size) {
        if (!fits(size)) return std::nullopt;
        try {
            Result<SilmapBuild> made = build_(at(size));
            if (made) return std::move(made).value();
            error_ = made.error();
        } catch (const std::bad_alloc&) {
            error_ = Error{ErrorClass::Runtime, diag::kOutOfMemory, "out of memory", ""};
        }
        return std::nullopt;
    }

    [[nodiscard]] Error not_met(double max_wrong) const {
        if (error_ && !std::isfinite(least_wrong_)) return *error_;
        if (!std::isfinite(least_wrong_)) {
            return {ErrorClass::Unsupported, diag::kSilmapBudget,
                    "the texture doesn't fit in " + std::to_string(max_bytes_) + " bytes", "--max-bytes"};
        }
        std::ostringstream text;
        text << "no size has at most " << max_wrong * kMillion << " ppm of wrong area; the least was "
             << least_wrong_ * kMillion << " ppm";
        return {ErrorClass::Unsupported, diag::kSilmapErrorUnmet, text.str(), "--max-wrong"};
    }

    static constexpr double kMillion = 1e6;
    Extent extent_;
    const SilmapOptions& options_;
    std::uint64_t max_bytes_;
    std::uint32_t largest_;
    BuildAtSize build_;
    double least_wrong_ = INFINITY;
    std::optional<Error> error_;
};

Result<SilmapBuild> choose(SizeChoice& choice, std::uint64_t max_bytes, double max_wrong_area) {
    if (max_wrong_area > 0) return choice.smallest(max_wrong_area, kMost, true);
    if (max_bytes != 0) return choice.largest();
    return choice.smallest(budget::kSilmapChosenError, kMostUnasked, false);
}

} // namespace

Result<SilmapBuild> compile_silmap_at_chosen_size(const Scene& scene, const SilmapOptions& options,
                                                  std::uint64_t max_bytes, double max_wrong_area,
                                                  const ProgressSink& progress) {
    SizeChoice choice(scene.extent, options, max_bytes, kMost,
                      [&](const SilmapOptions& how) { return compile_silmap(scene, how, progress); });
    return choose(choice, max_bytes, max_wrong_area);
}

Result<SilmapBuild> compile_silmap_at_chosen_size(const FeaturedImage& picture, const SilmapOptions& options,
                                                  std::uint64_t max_bytes, double max_wrong_area,
                                                  const ProgressSink& progress) {
    const std::uint32_t pixels = std::max(picture.image.width, picture.image.height);
    SizeChoice choice(picture.features.extent, options, max_bytes, pixels,
                      [&](const SilmapOptions& how) { return compile_silmap(picture, how, progress); });
    return choose(choice, max_bytes, max_wrong_area);
}

} // namespace fetexc
