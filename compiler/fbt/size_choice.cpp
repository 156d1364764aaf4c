// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/size_choice.h"

#include <algorithm>
#include <optional>
#include <string>

#include "compiler/compile.h"
#include "compiler/diagnostics.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kSmallest = 8, kLargest = 1024;    ///< without a limit on bytes
constexpr std::uint32_t kFewest = 4, kLargestGrid = 16384; ///< with one
constexpr double kWorthDoubling = 0.75;                    ///< of the cost

class SizeSearch {
  public:
    SizeSearch(const Scene& scene, const CompileOptions& options, const ProgressSink& progress)
        : scene_(scene), options_(options), progress_(progress) {}

    Result<FbtBuild> build(std::uint32_t longer_side) const {
        CompileOptions options = options_;
        options.size = grid_for(scene_.extent, longer_side);
        return compile_fbt(scene_, options, progress_);
    }

    Result<FbtBuild> cheapest() const {
        Result<FbtBuild> best = build(kSmallest);
        if (!best) return best;
        double cost = lookup_cost(best.value().texture);
        for (std::uint32_t size = 2 * kSmallest; size <= kLargest; size *= 2) {
            Result<FbtBuild> next = build(size);
            if (!next) return next;
            const double smaller = lookup_cost(next.value().texture);
            if (smaller > kWorthDoubling * cost) break;
            best = std::move(next), cost = smaller;
        }
        return best;
    }

    /// Bytes fall with the size while texels hold much (bands repeat what they share), then they grow; by halving
    /// beyond the largest power of two that fits. Small ups and downs in between are left to chance.
    Result<FbtBuild> largest_within(std::uint64_t max_bytes) const {
        std::optional<FbtBuild> best;
        std::uint64_t bytes = 0, least = UINT64_MAX;
        std::optional<Error> error;
        const auto fits = [&](std::uint32_t size) {
            const GridSize grid = grid_for(scene_.extent, size);
            bytes = sizeof(std::uint32_t) * grid.width * grid.height; // of the texels alone
            if (bytes > max_bytes && size > kFewest) return false;
            Result<FbtBuild> tried = build(size);
            if (!tried) {
                error = tried.error();
                return false;
            }
            bytes = tried.value().report.fbt.gpu_bytes, least = std::min(least, bytes);
            if (bytes <= max_bytes) best = std::move(tried).value();
            return bytes <= max_bytes;
        };
        std::uint32_t good = 0;
        for (std::uint32_t size = kFewest; size <= kLargestGrid && !error; size *= 2) {
            const std::uint64_t before = bytes;
            if (fits(size))
                good = size;
            else if (good != 0 || (before != 0 && bytes >= before))
                break;
        }
        for (std::uint32_t step = good / 2; good > 0 && step > good / 64 && !error; step /= 2) {
            if (good + step <= kLargestGrid && fits(good + step)) good += step;
        }
        for (std::uint32_t size = kFewest - 1; size > 0 && !best && !error; --size)
            fits(size);
        if (best) return std::move(*best); // also if a larger size met an error
        if (error) return *error;
        return Error{ErrorClass::Unsupported, diag::kFbtBudget,
                     "the drawing doesn't fit in " + std::to_string(max_bytes) + " bytes: it takes " +
                         std::to_string(least),
                     "--max-bytes"};
    }

  private:
    const Scene& scene_;
    const CompileOptions& options_;
    const ProgressSink& progress_;
};

} // namespace

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
    const SizeSearch search(scene, options, progress);
    return max_bytes == 0 ? search.cheapest() : search.largest_within(max_bytes);
}

} // namespace fetexc
