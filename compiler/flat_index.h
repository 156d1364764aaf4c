// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace fetexc {

/// Numbers found by key: a hash table without nodes (open addressing, linear probing, at most half full), for keys that
/// are small and cheap to compare. Entries stay. Hash(key) must be mixed well in its low bits (see mixed_bits).
template <class Key, class Hash> class FlatIndex {
  public:
    static constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

    /// Room for so many keys before the table grows.
    explicit FlatIndex(std::size_t expected = 0) { reserve(expected); }

    void reserve(std::size_t expected) {
        const std::size_t slots = std::bit_ceil(2 * std::max(expected, kFewest));
        if (slots > slots_.size()) rehash(slots);
    }

    /// The number of `key`, and whether it is new; then it is `number` (not kAbsent). The reference holds until the
    /// next call.
    std::pair<std::uint32_t&, bool> try_emplace(const Key& key, std::uint32_t number) {
        if (2 * size_ >= slots_.size()) rehash(2 * slots_.size());
        Slot& slot = slots_[slot_of(key)];
        const bool fresh = slot.number == kAbsent;
        if (fresh) slot = {key, number}, ++size_;
        return {slot.number, fresh};
    }

    /// kAbsent if the key isn't there.
    [[nodiscard]] std::uint32_t find(const Key& key) const { return slots_[slot_of(key)].number; }

    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    static constexpr std::size_t kFewest = 8;
    struct Slot {
        Key key{};
        std::uint32_t number = kAbsent;
    };

    /// Where the key is, or where it would go.
    [[nodiscard]] std::size_t slot_of(const Key& key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = Hash{}(key)&mask;
        while (slots_[at].number != kAbsent && !(slots_[at].key == key))
            at = (at + 1) & mask;
        return at;
    }

    void rehash(std::size_t slots) {
        const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots));
        for (const Slot& slot : old)
            if (slot.number != kAbsent) slots_[slot_of(slot.key)] = slot;
    }

    std::vector<Slot> slots_;
    std::size_t size_ = 0;
};

/// Every bit of the result depends on every bit of `h` (the finaliser of splitmix64).
constexpr std::uint64_t mixed_bits(std::uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

} // namespace fetexc
