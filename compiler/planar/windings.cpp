// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/windings.h"

#include <algorithm>

namespace fetexc {
namespace {

void add_winding(Windings& w, std::uint32_t shape, std::int32_t change) {
    const auto it =
        std::lower_bound(w.begin(), w.end(), shape, [](const Contribution& c, std::uint32_t s) { return c.shape < s; });
    if (it == w.end() || it->shape != shape) {
        w.insert(it, {shape, change});
    } else if ((it->winding += change) == 0) {
        w.erase(it);
    }
}

} // namespace

void add_windings(Windings& w, std::span<const Contribution> changes, std::int32_t sign) {
    constexpr std::size_t few = 4;
    if (changes.size() <= few) {
        for (const Contribution& c : changes)
            add_winding(w, c.shape, sign * c.winding);
        return;
    }
    Windings out; // both ascend
    out.reserve(w.size() + changes.size());
    auto at = w.begin();
    for (const Contribution& c : changes) {
        while (at != w.end() && at->shape < c.shape)
            out.push_back(*at++);
        std::int32_t sum = sign * c.winding;
        if (at != w.end() && at->shape == c.shape) sum += (at++)->winding;
        if (sum != 0) out.push_back({c.shape, sum});
    }
    out.insert(out.end(), at, w.end());
    w = std::move(out);
}

} // namespace fetexc
