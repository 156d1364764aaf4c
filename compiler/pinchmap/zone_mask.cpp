// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/zone_mask.h"

#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace fetexc {
namespace {

/// Sides of 3 × 3 clusters, row by row from the lowest bit; whether the middle one is valid.
bool is_valid_pattern(unsigned pattern) {
    const auto side = [&](unsigned i, unsigned j) { return pattern >> (3 * j + i) & 1U; };
    const auto active = [&](unsigned i, unsigned j) { // the corner below on the right of (i,j)
        return !(side(i, j) == side(i + 1, j) && side(i, j) == side(i, j + 1) && side(i, j) == side(i + 1, j + 1));
    };
    const bool nw = active(0, 0), ne = active(1, 0), sw = active(0, 1), se = active(1, 1);
    const int count = nw + ne + sw + se;
    if (count == 4 || (count == 2 && nw == se)) return false;
    const unsigned middle = side(1, 1);
    return !(nw && ne && side(1, 0) == middle) && !(sw && se && side(1, 2) == middle) &&
           !(nw && sw && side(0, 1) == middle) && !(ne && se && side(2, 1) == middle);
}

bool is_valid(unsigned pattern) {
    static const std::array<bool, 512> table = [] {
        std::array<bool, 512> out{};
        for (unsigned k = 0; k < out.size(); ++k)
            out[k] = is_valid_pattern(k);
        return out;
    }();
    return table[pattern];
}

unsigned pattern_around(const ZoneMask& mask, std::int64_t i, std::int64_t j) {
    unsigned pattern = 0, bit = 0;
    for (std::int64_t y = j - 1; y <= j + 1; ++y) {
        for (std::int64_t x = i - 1; x <= i + 1; ++x)
            pattern |= unsigned{mask.at(x, y)} << bit++;
    }
    return pattern;
}

/// Clusters x … x + side − 1 of each axis, to one side.
struct Move {
    std::uint32_t x = 0, y = 0, side = 2;
    std::uint8_t above = 0;
};
/// The cheapest first; of equal ones the first in the map.
using Order = std::tuple<double, std::uint32_t, std::uint32_t, std::uint8_t>;

class Enforcer {
  public:
    Enforcer(ZoneMask& mask, std::span<const double> parts)
        : mask_(mask), parts_(parts), listed_(2 * mask.above.size()) {}

    MaskMoves run() {
        for (std::uint32_t j = 0; j < mask_.height; ++j) {
            for (std::uint32_t i = 0; i < mask_.width; ++i) {
                if (is_valid_cluster(mask_, i, j)) continue;
                broken_.emplace(j, i);
                list_around({i, j, 1, 0});
            }
        }
        MaskMoves out;
        out.broken = broken_.size();
        while (!broken_.empty()) {
            const Move move = best_.empty() ? larger_move() : first_listed();
            out.lost += cost(move), ++out.moves;
            apply(move);
        }
        return out;
    }

  private:
    static constexpr std::int64_t kReach = 4; ///< a square changes what squares so far away are worth

    template <class Visit> void each(const Move& m, std::int64_t margin, const Visit& visit) const {
        const auto begin = [&](std::uint32_t v) { return std::max<std::int64_t>(std::int64_t{v} - margin, 0); };
        const auto end = [&](std::uint32_t v, std::uint32_t size) {
            return std::min<std::int64_t>(std::int64_t{v} + m.side + margin, size);
        };
        for (std::int64_t y = begin(m.y); y < end(m.y, mask_.height); ++y) {
            for (std::int64_t x = begin(m.x); x < end(m.x, mask_.width); ++x)
                visit(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        }
    }

    [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * mask_.width + x; }

    [[nodiscard]] double cost(const Move& m) const {
        double sum = 0;
        each(m, 0, [&](std::uint32_t x, std::uint32_t y) {
            const double part = parts_[index(x, y)];
            if (mask_.above[index(x, y)] != m.above) sum += m.above != 0 ? 1 - 2 * part : 2 * part - 1;
        });
        return sum;
    }

    [[nodiscard]] int invalid_around(const Move& m) const {
        int count = 0;
        each(m, 1, [&](std::uint32_t x, std::uint32_t y) { count += is_valid_cluster(mask_, x, y) ? 0 : 1; });
        return count;
    }

    /// Whether it leaves fewer invalid; false for one that changes nothing.
    bool helps(const Move& m) {
        std::vector<std::pair<std::size_t, std::uint8_t>> before;
        each(m, 0,
             [&](std::uint32_t x, std::uint32_t y) { before.emplace_back(index(x, y), mask_.above[index(x, y)]); });
        if (std::ranges::none_of(before, [&](const auto& b) { return b.second != m.above; })) return false;
        const int now = invalid_around(m);
        if (now == 0) return false;
        for (const auto& [at, side] : before)
            mask_.above[at] = m.above;
        const int then = invalid_around(m);
        for (const auto& [at, side] : before)
            mask_.above[at] = side;
        return then < now;
    }

    void list_around(const Move& changed) {
        each(changed, kReach, [&](std::uint32_t x, std::uint32_t y) {
            for (const std::uint8_t above : {0, 1})
                list({x, y, 2, above});
        });
    }
    void list(const Move& m) {
        std::optional<double>& listed = listed_[2 * index(m.x, m.y) + m.above];
        if (listed) best_.erase({*listed, m.y, m.x, m.above});
        listed.reset();
        if (!helps(m)) return;
        listed = cost(m);
        best_.insert({*listed, m.y, m.x, m.above});
    }
    [[nodiscard]] Move first_listed() const {
        const auto& [cost, y, x, above] = *best_.begin();
        return {x, y, 2, above};
    }

    /// The cheapest of the least size that helps; as large as the map it makes all one side, which is valid.
    Move larger_move() {
        for (std::uint32_t side = 3;; ++side) {
            std::set<Order> found;
            std::set<std::pair<std::uint32_t, std::uint32_t>> places;
            for (const auto& [j, i] : broken_) {
                const std::uint32_t back = side; // a square that ends beside a cluster changes whether that is valid
                for (std::uint32_t y = j - std::min(j, back); y <= std::min(j + 1, mask_.height - 1); ++y) {
                    for (std::uint32_t x = i - std::min(i, back); x <= std::min(i + 1, mask_.width - 1); ++x)
                        places.emplace(y, x);
                }
            }
            for (const auto& [y, x] : places) {
                for (const std::uint8_t above : {0, 1}) {
                    const Move m{x, y, side, above};
                    if (helps(m)) found.insert({cost(m), y, x, above});
                }
            }
            if (found.empty()) continue;
            const auto& [cost, y, x, above] = *found.begin();
            return {x, y, side, above};
        }
    }

    void apply(const Move& m) {
        each(m, 0, [&](std::uint32_t x, std::uint32_t y) { mask_.above[index(x, y)] = m.above; });
        each(m, 1, [&](std::uint32_t x, std::uint32_t y) {
            if (is_valid_cluster(mask_, x, y))
                broken_.erase({y, x});
            else
                broken_.emplace(y, x);
        });
        list_around(m);
    }

    ZoneMask& mask_;
    std::span<const double> parts_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> broken_; ///< row, column
    std::set<Order> best_;                                     ///< squares of 2 × 2 that help
    std::vector<std::optional<double>> listed_;                ///< by place and side: their costs in best_
};

} // namespace

CornerSides sides_around(const ZoneMask& mask, std::uint32_t i, std::uint32_t j) {
    const std::int64_t x = i, y = j;
    return {mask.at(x - 1, y - 1), mask.at(x, y - 1), mask.at(x - 1, y), mask.at(x, y)};
}

ZoneMask majority_mask(std::span<const double> parts, std::uint32_t width, std::uint32_t height) {
    ZoneMask out{width, height, std::vector<std::uint8_t>(parts.size())};
    std::ranges::transform(parts, out.above.begin(), [](double part) { return part > 0.5 ? 1 : 0; });
    return out;
}

bool is_valid_cluster(const ZoneMask& mask, std::uint32_t i, std::uint32_t j) {
    return is_valid(pattern_around(mask, i, j));
}

MaskMoves enforce_constraints(ZoneMask& mask, std::span<const double> parts) { return Enforcer(mask, parts).run(); }

} // namespace fetexc
