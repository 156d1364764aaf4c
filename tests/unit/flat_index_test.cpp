// SPDX-License-Identifier: GPL-3.0-or-later
/// FlatIndex against std::unordered_map, and what happens when it grows, and when every key collides.
#include "compiler/flat_index.h"

#include <random>
#include <unordered_map>

#include <gtest/gtest.h>

namespace fetexc {
namespace {

struct Mixed {
    std::size_t operator()(std::uint64_t key) const { return static_cast<std::size_t>(mixed_bits(key)); }
};
/// The last slot: every probe wraps around.
struct AlwaysLast {
    std::size_t operator()(std::uint64_t) const { return ~std::size_t{0}; }
};
struct Identity {
    std::size_t operator()(std::uint64_t key) const { return static_cast<std::size_t>(key); }
};

template <class Hash> void expect_like_unordered_map(std::size_t expected, std::size_t count, std::uint64_t keys) {
    std::mt19937_64 random(count * 31 + expected);
    FlatIndex<std::uint64_t, Hash> index(expected);
    std::unordered_map<std::uint64_t, std::uint32_t> reference;
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t key = random() % keys;
        const auto number = static_cast<std::uint32_t>(random() % 1000);
        const auto [it, fresh_there] = reference.try_emplace(key, number);
        const auto [found, fresh] = index.try_emplace(key, number);
        ASSERT_EQ(fresh, fresh_there);
        ASSERT_EQ(found, it->second);
    }
    EXPECT_EQ(index.size(), reference.size());
    for (std::uint64_t key = 0; key < std::min<std::uint64_t>(keys, 5000); ++key) {
        const auto it = reference.find(key);
        ASSERT_EQ(index.find(key), it == reference.end() ? index.kAbsent : it->second) << key;
    }
}

TEST(FlatIndex, FindsWhatAMapFinds) {
    for (const std::size_t expected : {0u, 1u, 100u, 5000u, 20000u}) {
        expect_like_unordered_map<Mixed>(expected, 10000, 3000);
        expect_like_unordered_map<Mixed>(expected, 10000, 1u << 30);
        expect_like_unordered_map<Identity>(expected, 10000, 3000);
    }
}

TEST(FlatIndex, FindsWhenEveryKeyCollides) {
    expect_like_unordered_map<AlwaysLast>(0, 1000, 300);
    expect_like_unordered_map<AlwaysLast>(1000, 1000, 300);
}

TEST(FlatIndex, EmptyFindsNothing) {
    const FlatIndex<std::uint64_t, Mixed> index;
    EXPECT_EQ(index.size(), 0u);
    EXPECT_EQ(index.find(0), index.kAbsent); // the key that unused slots hold
}

TEST(FlatIndex, NumbersCanBeReplaced) {
    FlatIndex<std::uint64_t, Mixed> index;
    EXPECT_TRUE(index.try_emplace(7, 1).second);
    index.try_emplace(7, 2).first = 3;
    EXPECT_EQ(index.find(7), 3u);
    for (std::uint64_t key = 100; key < 1000; ++key) // grows
        index.try_emplace(key, 0);
    EXPECT_EQ(index.find(7), 3u);
    index.reserve(10000);
    EXPECT_EQ(index.find(7), 3u);
    EXPECT_EQ(index.size(), 901u);
}

TEST(MixedBits, SpreadsGridsOverTheLowBits) {
    // Neighbours on a grid, packed as lattice points are, must not crowd the low bits.
    std::vector<int> uses(1u << 12);
    for (std::uint64_t x = 0; x < 64; ++x)
        for (std::uint64_t y = 0; y < 64; ++y)
            ++uses[mixed_bits(x << 52 | y << 20) & (uses.size() - 1)];
    EXPECT_LT(*std::max_element(uses.begin(), uses.end()), 10); // 4096 balls in 4096 bins: about 7
}

} // namespace
} // namespace fetexc
