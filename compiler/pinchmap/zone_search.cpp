// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/zone_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

/// Square clusters: the temperature, and the price of a cluster that breaks a constraint, at first and in the end.
constexpr double kHot = 0.3, kCold = 0.01, kBroken = 0.5, kBrokenInTheEnd = 2;
constexpr std::uint64_t kTries = 300; ///< for each cluster where zones may change
constexpr std::uint32_t kReach = 8;   ///< clusters from a dear corner, where zones may change
constexpr std::uint32_t kNear = 2;    ///< clusters from a corner that may be on either side
constexpr std::uint32_t kMostSide = 3;

struct Rectangle {
    std::uint32_t x = 0, y = 0, width = 1, height = 1;
};

/// What depends on the sides of a rectangle's clusters.
struct Energy {
    double cost = 0;
    int broken = 0;
};

class Search {
  public:
    Search(ZoneMask& mask, const ZoneTruth& truth, std::uint64_t seed) : mask_(mask), truth_(truth), random_(seed) {
        const std::vector<std::uint8_t> dear = near_dear_corners();
        for (std::uint32_t j = 0; j < mask.height; ++j) {
            for (std::uint32_t i = 0; i < mask.width; ++i) {
                if (dear[index(i, j)] != 0 && may_change(i, j)) places_.push_back({i, j});
            }
        }
    }

    void run() {
        best_ = mask_.above;
        for (std::uint64_t n = 0; n < kTries; ++n) {
            const double t = static_cast<double>(n) / kTries;
            price_ = kBroken * std::pow(kBrokenInTheEnd / kBroken, t);
            const double temperature = kHot * std::pow(kCold / kHot, t);
            for (std::size_t k = 0; k < places_.size(); ++k)
                attempt(temperature);
        }
        mask_.above = best_;
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const { return std::size_t{j} * mask_.width + i; }

    [[nodiscard]] std::vector<std::uint8_t> near_dear_corners() const {
        std::vector<std::uint8_t> out(mask_.above.size(), 0);
        for (std::uint32_t j = 0; j <= mask_.height; ++j) {
            for (std::uint32_t i = 0; i <= mask_.width; ++i) {
                if (corner_cost(mask_, truth_, i, j) < budget::kPinchmapDear) continue;
                for (std::uint32_t y = j - std::min(j, kReach); y < std::min(j + kReach, mask_.height); ++y) {
                    for (std::uint32_t x = i - std::min(i, kReach); x < std::min(i + kReach, mask_.width); ++x)
                        out[index(x, y)] = 1;
                }
            }
        }
        return out;
    }
    [[nodiscard]] bool may_change(std::uint32_t i, std::uint32_t j) const {
        for (std::uint32_t y = j - std::min(j, kNear); y <= std::min(j + 1 + kNear, mask_.height); ++y) {
            for (std::uint32_t x = i - std::min(i, kNear); x <= std::min(i + 1 + kNear, mask_.width); ++x) {
                const SideCosts& c = truth_.costs[std::size_t{y} * (mask_.width + 1) + x];
                if (std::max(c.below, c.above) < budget::kPinchmapOpen) return true;
            }
        }
        return false;
    }

    [[nodiscard]] Energy energy(const Rectangle& r) const {
        Energy out;
        for (std::uint32_t y = r.y - std::min(r.y, 1U); y <= std::min(r.y + r.height, mask_.height - 1); ++y) {
            for (std::uint32_t x = r.x - std::min(r.x, 1U); x <= std::min(r.x + r.width, mask_.width - 1); ++x)
                out.broken += is_valid_cluster(mask_, x, y) ? 0 : 1;
        }
        for (std::uint32_t y = r.y; y <= r.y + r.height; ++y) {
            for (std::uint32_t x = r.x; x <= r.x + r.width; ++x)
                out.cost += corner_cost(mask_, truth_, x, y);
        }
        return out;
    }

    template <class Visit> void each(const Rectangle& r, const Visit& visit) {
        std::size_t n = 0;
        for (std::uint32_t y = r.y; y < r.y + r.height; ++y) {
            for (std::uint32_t x = r.x; x < r.x + r.width; ++x)
                visit(mask_.above[index(x, y)], n++);
        }
    }

    void attempt(double temperature) {
        const auto& [x, y] = places_[random_() % places_.size()];
        const std::uint64_t bits = random_();
        const auto side_of = [&](std::uint64_t b, std::uint32_t room) {
            return std::min(static_cast<std::uint32_t>(1 + b % kMostSide), room);
        };
        const Rectangle r{x, y, side_of(bits >> 1, mask_.width - x), side_of(bits >> 32, mask_.height - y)};
        const std::uint8_t above = bits & 1U;
        std::array<std::uint8_t, std::size_t{kMostSide} * kMostSide> saved{};
        bool changes = false;
        each(r, [&](std::uint8_t side, std::size_t n) { saved[n] = side, changes = changes || side != above; });
        if (!changes) return;
        const Energy before = energy(r);
        each(r, [&](std::uint8_t& side, std::size_t) { side = above; });
        const Energy after = energy(r);
        const double more = after.cost - before.cost + price_ * (after.broken - before.broken);
        if (more > 0 && unit() >= std::exp(-more / temperature)) {
            each(r, [&](std::uint8_t& side, std::size_t n) { side = saved[n]; });
            return;
        }
        cost_ += after.cost - before.cost, broken_ += after.broken - before.broken;
        if (broken_ == 0 && cost_ < least_ - budget::kPinchmapCostRounding) least_ = cost_, best_ = mask_.above;
    }

    double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    struct Place {
        std::uint32_t x, y;
    };

    ZoneMask& mask_;
    const ZoneTruth& truth_;
    std::mt19937_64 random_;
    std::vector<Place> places_;
    double cost_ = 0, least_ = 0; ///< more than in the beginning
    int broken_ = 0;
    double price_ = 0; ///< now
    std::vector<std::uint8_t> best_;
};

} // namespace

void search_zones(ZoneMask& mask, const ZoneTruth& truth, std::uint64_t seed) { Search(mask, truth, seed).run(); }

} // namespace fetexc
