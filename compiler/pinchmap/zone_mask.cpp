// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/zone_mask.h"
#include "compiler/error_budget.h"

#include <array>
#include <compare>
#include <optional>
#include <set>
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
    if (i >= 1 && j >= 1 && i + 1 < mask.width && j + 1 < mask.height) {
        const std::uint8_t* const middle = &mask.above[static_cast<std::size_t>(j) * mask.width + i];
        const auto row = [](const std::uint8_t* p) { return p[-1] | unsigned{p[0]} << 1 | unsigned{p[1]} << 2; };
        return row(middle - mask.width) | row(middle) << 3 | row(middle + mask.width) << 6;
    }
    unsigned pattern = 0, bit = 0;
    for (std::int64_t y = j - 1; y <= j + 1; ++y) {
        for (std::int64_t x = i - 1; x <= i + 1; ++x)
            pattern |= unsigned{mask.at(x, y)} << bit++;
    }
    return pattern;
}

double cluster_error(const ZoneMask& mask, const ZoneTruth& truth, std::uint32_t i, std::uint32_t j) {
    if (!truth.costs.empty()) return 0;
    const std::size_t at = std::size_t{j} * mask.width + i;
    const std::uint8_t side = mask.above[at];
    const double wrong = side != 0 ? 1 - truth.parts[at] : truth.parts[at];
    if (!(wrong > 0)) return 0;
    const unsigned pattern = pattern_around(mask, i, j);
    return pattern == 0 || pattern == 511 ? wrong : 0;
}

/// Clusters x … x + width − 1, y … y + height − 1, to one side.
struct Move {
    std::uint32_t x = 0, y = 0, width = 2, height = 2;
    std::uint8_t above = 0;

    friend auto operator<=>(const Move&, const Move&) = default;
};
/// The cheapest first; of equal ones the first in the map.
using Order = std::pair<double, Move>;

class Enforcer {
  public:
    Enforcer(ZoneMask& mask, const ZoneTruth& truth)
        : mask_(mask), truth_(truth), listed_(kKinds * mask.above.size()) {}

    MaskMoves run() {
        for (std::uint32_t j = 0; j < mask_.height; ++j) {
            for (std::uint32_t i = 0; i < mask_.width; ++i) {
                const bool valid = is_valid_cluster(mask_, i, j);
                if (!valid) broken_.emplace(j, i);
                if (!valid || error_around({i, j, 1, 1}) >= budget::kPinchmapWorthAMove)
                    list_around({i, j, 1, 1}, kNear);
            }
        }
        MaskMoves out;
        out.broken = broken_.size();
        while (!broken_.empty() || !best_.empty()) {
            const Move move = best_.empty() ? larger_move() : best_.begin()->second;
            const double before = error_around(move);
            apply(move);
            out.lost += error_around(move) - before, ++out.moves;
        }
        return out;
    }

  private:
    static constexpr std::int64_t kReach = 5; ///< a rectangle changes what others so far away are worth
    static constexpr std::int64_t kNear = 3;  ///< they themselves reach so far
    static constexpr std::size_t kKinds = 8;  ///< two sides, of 2 or 3 clusters, and two colours

    template <class Visit>
    static void each_in(const Move& m, std::int64_t margin, std::uint32_t columns, std::uint32_t rows,
                        const Visit& visit) {
        const auto begin = [&](std::uint32_t v) { return std::max<std::int64_t>(std::int64_t{v} - margin, 0); };
        const auto end = [&](std::uint32_t v, std::uint32_t side, std::uint32_t size) {
            return std::min<std::int64_t>(std::int64_t{v} + side + margin, size);
        };
        for (std::int64_t y = begin(m.y); y < end(m.y, m.height, rows); ++y) {
            for (std::int64_t x = begin(m.x); x < end(m.x, m.width, columns); ++x)
                visit(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        }
    }
    template <class Visit> void each(const Move& m, std::int64_t margin, const Visit& visit) const {
        each_in(m, margin, mask_.width, mask_.height, visit);
    }

    [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * mask_.width + x; }

    /// Of all that the rectangle's sides decide.
    [[nodiscard]] double error_around(const Move& m) const {
        double sum = 0;
        each(m, 1, [&](std::uint32_t x, std::uint32_t y) { sum += cluster_error(mask_, truth_, x, y); });
        const Move corners{m.x, m.y, m.width + 1, m.height + 1};
        each_in(corners, 0, mask_.width + 1, mask_.height + 1,
                [&](std::uint32_t x, std::uint32_t y) { sum += corner_cost(mask_, truth_, x, y); });
        return sum;
    }
    [[nodiscard]] int invalid_around(const Move& m) const {
        int count = 0;
        each(m, 1, [&](std::uint32_t x, std::uint32_t y) { count += is_valid_cluster(mask_, x, y) ? 0 : 1; });
        return count;
    }

    /// What it costs for each cluster that becomes valid; nothing where there are not fewer invalid ones.
    std::optional<double> price(const Move& m) {
        std::array<std::pair<std::size_t, std::uint8_t>, 9> few{};
        std::vector<std::pair<std::size_t, std::uint8_t>> many;
        const bool small = m.width <= 3 && m.height <= 3;
        if (!small) many.resize(std::size_t{m.width} * m.height);
        const std::span before = small ? std::span(few) : std::span(many);
        std::size_t count = 0;
        bool changes = false;
        each(m, 0, [&](std::uint32_t x, std::uint32_t y) {
            before[count++] = {index(x, y), mask_.above[index(x, y)]};
            changes = changes || mask_.above[index(x, y)] != m.above;
        });
        if (!changes) return std::nullopt;
        const int now = invalid_around(m);
        const double error = error_around(m);
        if (now == 0 && error < budget::kPinchmapWorthAMove) return std::nullopt;
        for (const auto& [at, side] : before.first(count))
            mask_.above[at] = m.above;
        const int then = invalid_around(m);
        const double more = then <= now ? error_around(m) - error : 0;
        for (const auto& [at, side] : before.first(count))
            mask_.above[at] = side;
        if (then < now) return more / (now - then);
        return then == now && more < -budget::kPinchmapWorthAMove ? std::optional(more) : std::nullopt;
    }

    void list_around(const Move& changed, std::int64_t reach) {
        each(changed, reach, [&](std::uint32_t x, std::uint32_t y) {
            for (std::uint32_t kind = 0; kind < kKinds; ++kind)
                list({x, y, 2 + (kind >> 1 & 1U), 2 + (kind >> 2), static_cast<std::uint8_t>(kind & 1U)}, kind);
        });
    }
    void list(const Move& m, std::uint32_t kind) {
        std::optional<double>& listed = listed_[kKinds * index(m.x, m.y) + kind];
        if (listed) best_.erase({*listed, m});
        listed = price(m);
        if (listed) best_.insert({*listed, m});
    }

    /// The cheapest square of the least size that helps; as large as the map it makes all one side, which is valid.
    Move larger_move() {
        for (std::uint32_t side = 4;; ++side) {
            std::set<Order> found;
            std::set<std::pair<std::uint32_t, std::uint32_t>> places;
            for (const auto& [j, i] : broken_) { // a square that ends beside a cluster decides whether that is valid
                for (std::uint32_t y = j - std::min(j, side); y <= std::min(j + 1, mask_.height - 1); ++y) {
                    for (std::uint32_t x = i - std::min(i, side); x <= std::min(i + 1, mask_.width - 1); ++x)
                        places.emplace(y, x);
                }
            }
            for (const auto& [y, x] : places) {
                for (const std::uint8_t above : {0, 1}) {
                    const Move m{x, y, side, side, above};
                    if (const std::optional<double> asks = price(m)) found.insert({*asks, m});
                }
            }
            if (!found.empty()) return found.begin()->second;
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
        list_around(m, kReach);
    }

    ZoneMask& mask_;
    const ZoneTruth& truth_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> broken_; ///< row, column
    std::set<Order> best_;                                     ///< rectangles that help
    std::vector<std::optional<double>> listed_;                ///< by place and kind: their prices in best_
};

} // namespace

CornerSides sides_around(const ZoneMask& mask, std::uint32_t i, std::uint32_t j) {
    if (i >= 1 && j >= 1 && i < mask.width && j < mask.height) {
        const std::uint8_t* const se = &mask.above[std::size_t{j} * mask.width + i];
        const std::uint8_t* const ne = se - mask.width;
        return {ne[-1], ne[0], se[-1], se[0]};
    }
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

double corner_cost(const ZoneMask& mask, const ZoneTruth& truth, std::uint32_t i, std::uint32_t j) {
    const std::size_t at = std::size_t{j} * (mask.width + 1) + i;
    const CornerSides s = sides_around(mask, i, j);
    if (s.cross()) return budget::kPinchmapCross;
    if (truth.costs.empty()) {
        const double above = truth.distances[at];
        return s.active() ? 0 : std::clamp(s.nw != 0 ? -above : above, 0.0, budget::kPinchmapFarWrong);
    }
    const SideCosts& c = truth.costs[at];
    if (s.active()) return budget::kPinchmapIdle * std::max(c.below, c.above);
    return s.nw != 0 ? c.above : c.below;
}

double unmendable(const ZoneMask& mask, const ZoneTruth& truth) {
    double sum = 0;
    for (std::uint32_t j = 0; j <= mask.height; ++j) {
        for (std::uint32_t i = 0; i <= mask.width; ++i) {
            sum += corner_cost(mask, truth, i, j);
            if (i < mask.width && j < mask.height) sum += cluster_error(mask, truth, i, j);
        }
    }
    return sum;
}

MaskMoves enforce_constraints(ZoneMask& mask, const ZoneTruth& truth) { return Enforcer(mask, truth).run(); }

} // namespace fetexc
