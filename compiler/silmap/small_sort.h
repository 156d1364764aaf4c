// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace fetexc {

/// Stable; fast for the few items of a cell, for which std::stable_sort asks for memory.
template <class T, class Less> void small_sort(std::vector<T>& items, const Less& less) {
    constexpr std::size_t few = 32;
    if (items.size() > few) return std::stable_sort(items.begin(), items.end(), less);
    for (std::size_t k = 1; k < items.size(); ++k) {
        for (std::size_t n = k; n > 0 && less(items[n], items[n - 1]); --n)
            std::swap(items[n], items[n - 1]);
    }
}

} // namespace fetexc
