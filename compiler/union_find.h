// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace fetexc {

/// Disjoint sets of 0 … n−1. The representative of a set is its smallest member, so results don't depend on the order
/// of the calls.
class UnionFind {
  public:
    UnionFind() = default;
    explicit UnionFind(std::size_t n) { reset(n); }
    void reset(std::size_t n) {
        parent_.resize(n);
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    [[nodiscard]] std::uint32_t find(std::uint32_t k) {
        while (parent_[k] != k)
            k = parent_[k] = parent_[parent_[k]];
        return k;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    [[nodiscard]] std::size_t size() const { return parent_.size(); }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace fetexc
