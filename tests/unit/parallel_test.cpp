// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/parallel.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace fetexc {
namespace {

TEST(HugePages, countTheLastIfHalfFull) {
    EXPECT_EQ(huge_pages_of(0), 0u);
    EXPECT_EQ(huge_pages_of(kHugePage / 2 - 1), 0u);
    EXPECT_EQ(huge_pages_of(kHugePage / 2), 1u);
    EXPECT_EQ(huge_pages_of(kHugePage + kHugePage / 2 - 1), 1u);
    EXPECT_EQ(huge_pages_of(3 * kHugePage), 3u);
}

TEST(UnwrittenVector, startsWithAHugePageWhereThereIsOne) {
    const UnwrittenVector<std::uint64_t> large(kHugePage / 16);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % kHugePage, 0u);
}

/// Through all ways of getting memory, back and forth over where huge pages begin.
TEST(UnwrittenVector, keepsItsElementsWhileItGrowsAndShrinks) {
    UnwrittenVector<std::uint32_t> v;
    constexpr std::uint32_t most = kHugePage; // 8 MiB
    for (std::uint32_t k = 0; k < most; ++k)
        v.push_back(k);
    v.resize(1000);
    v.shrink_to_fit();
    const UnwrittenVector<std::uint32_t> copy = v;
    v.resize(most / 4);
    std::uint32_t wrong = 0;
    for (std::uint32_t k = 0; k < 1000; ++k)
        wrong += (v[k] != k) + (copy[k] != k);
    EXPECT_EQ(wrong, 0u);
}

TEST(Parallel, chunksCoverAllOnce) {
    constexpr std::size_t count = 1003;
    for (const unsigned threads : {0u, 1u, 2u}) {
        std::vector<int> seen(count);
        parallel_for_chunks(count, 64, threads, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                ++seen[k];
        });
        EXPECT_EQ(std::accumulate(seen.begin(), seen.end(), 0), static_cast<int>(count));
        EXPECT_EQ(std::ranges::count(seen, 1), static_cast<std::ptrdiff_t>(count));
    }
}

} // namespace
} // namespace fetexc
