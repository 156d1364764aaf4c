// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/size_choice.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>

#include "compiler/diagnostics.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kSmallest = 8, kLargest = 1024;    ///< without a limit on bytes
constexpr std::uint32_t kFewest = 4, kLargestGrid = 16384; ///< with one
constexpr std::uint32_t kMostTexels = 4;                   ///< a pixel of an image, along a side (W2056)
constexpr double kWorthDoubling = 0.75;                    ///< of the cost

Result<FbtBuild> built(const Extent& extent, std::uint32_t longer_side, const BuildAtSize& build) {
    try {
        return build(grid_for(extent, longer_side));
    } catch (const std::bad_alloc&) {
        return Error{ErrorClass::Runtime, diag::kOutOfMemory, "out of memory", ""};
    }
}

std::uint32_t longer_side(const RasterImage& image) { return std::max(image.width, image.height); }

} // namespace

Result<FbtBuild> cheapest_lookup(const Extent& extent, std::uint32_t smallest, std::uint32_t largest,
                                 const BuildAtSize& build) {
    Result<FbtBuild> best = built(extent, smallest, build);
    if (!best) return best;
    double cost = lookup_cost(best.value().texture);
    // A lookup reads one word at least: below 1 / kWorthDoubling nothing can pay.
    for (std::uint32_t size = 2 * smallest; size <= largest && kWorthDoubling * cost >= 1; size *= 2) {
        Result<FbtBuild> next = built(extent, size, build);
        if (!next) break;
        const double smaller = lookup_cost(next.value().texture);
        if (smaller > kWorthDoubling * cost) break;
        best = std::move(next), cost = smaller;
    }
    return best;
}

Result<FbtBuild> largest_within(const Extent& extent, std::uint32_t largest, std::uint64_t max_bytes,
                                const BuildAtSize& build) {
    std::optional<FbtBuild> best;
    std::uint64_t bytes = 0, least = UINT64_MAX;
    std::optional<Error> error;
    const auto fits = [&](std::uint32_t size) {
        const GridSize grid = grid_for(extent, size);
        bytes = sizeof(std::uint32_t) * grid.width * grid.height; // of the texels alone
        if (bytes > max_bytes && size > kFewest) return false;
        Result<FbtBuild> tried = built(extent, size, build);
        if (!tried) {
            error = tried.error();
            return false;
        }
        bytes = tried.value().report.fbt.gpu_bytes, least = std::min(least, bytes);
        if (bytes <= max_bytes) best = std::move(tried).value();
        return bytes <= max_bytes;
    };
    std::uint32_t good = 0;
    for (std::uint32_t size = std::min(kFewest, largest); !error; size = std::min(2 * size, largest)) {
        const std::uint64_t before = bytes;
        if (fits(size))
            good = size;
        else if (good != 0 || (before != 0 && bytes >= before))
            break;
        if (size == largest) break;
    }
    for (std::uint32_t step = good / 2; good > 0 && step > good / 64 && !error; step /= 2) {
        if (good + step < largest && fits(good + step)) good += step;
    }
    for (std::uint32_t size = std::min(kFewest, largest) - 1; size > 0 && !best && !error; --size)
        fits(size);
    if (best) return std::move(*best); // also if a larger size met an error
    if (error) return *error;
    return Error{ErrorClass::Unsupported, diag::kFbtBudget,
                 "the texture doesn't fit in " + std::to_string(max_bytes) + " bytes: it takes " +
                     std::to_string(least),
                 "--max-bytes"};
}

double lookup_cost(const fetex::FbtTexture& texture) {
    constexpr std::uint32_t kPoints = 64;
    fetex::FbtQueryStats stats;
    for (std::uint32_t v = 0; v < kPoints; ++v) {
        for (std::uint32_t u = 0; u < kPoints; ++u) {
            const double x = (u + 0.5) / kPoints * texture.width, y = (v + 0.5) / kPoints * texture.height;
            const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
            fetex::fbt_locate_local(texture, i, j, x - i, y - j, &stats);
        }
    }
    return static_cast<double>(stats.queries + stats.bands + stats.entries + stats.pieces) /
           static_cast<double>(stats.queries);
}

Result<FbtBuild> compile_fbt_at_chosen_size(const Scene& scene, const CompileOptions& options, std::uint64_t max_bytes,
                                            const ProgressSink& progress) {
    const auto build = [&](GridSize size) {
        CompileOptions at = options;
        at.size = size;
        return compile_fbt(scene, at, progress);
    };
    return max_bytes == 0 ? cheapest_lookup(scene.extent, kSmallest, kLargest, build)
                          : largest_within(scene.extent, kLargestGrid, max_bytes, build);
}

Result<FbtBuild> compile_fbt_at_chosen_size(const FeaturedImage& picture, const CompileOptions& options,
                                            std::uint64_t max_bytes, const ProgressSink& progress) {
    const auto build = [&](GridSize size) {
        CompileOptions at = options;
        at.size = size;
        return compile_fbt(picture, at, progress);
    };
    const std::uint32_t pixels = longer_side(picture.image);
    const Extent extent{static_cast<double>(picture.image.width), static_cast<double>(picture.image.height), 0, 0};
    return max_bytes == 0 ? cheapest_lookup(extent, pixels, std::min(kMostTexels * pixels, kLargestGrid), build)
                          : largest_within(extent, pixels, max_bytes, build);
}

} // namespace fetexc
