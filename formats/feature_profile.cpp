// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The profile's products, and their means over distances (SPEC.md, section 9.3).
#include <algorithm>
#include <array>
#include <cmath>

#include "formats/feature_sampler.h"
#include "formats/interpolation.h"

namespace fetex {
namespace {

constexpr std::size_t kProducts = 8;
using Products = std::array<double, kProducts>;
constexpr std::size_t kSlope = 0, kBlend = 2; ///< the slope changes its sign across a curve

Products products_of(const FeatureProfileEntry& e) {
    const double rest = 1 - double{e.blend};
    const FbtColor c = color_of(e.color);
    return {rest * e.slope, double{e.blend} * e.slope, e.blend, rest * e.height, rest * c.r, rest * c.g, rest * c.b,
            rest * c.a};
}

FeatureProducts named(const Products& p, double across) {
    return {p[0], p[1], p[kBlend], across, p[3], {p[4], p[5], p[6], p[7]}};
}

class Table {
  public:
    explicit Table(const FeatureCurvesTexture& t)
        : profile_(t.profile), step_(t.distance_limit / static_cast<double>(t.profile.size() - 1)) {}

    /// Beyond the last entry it goes on.
    [[nodiscard]] Products at(double distance) const {
        const double last = static_cast<double>(profile_.size() - 1), at = clamp_to(distance / step_, last);
        const std::size_t k = std::min(static_cast<std::size_t>(at), profile_.size() - 2);
        const Products a = products_of(profile_[k]), b = products_of(profile_[k + 1]);
        Products out{};
        for (std::size_t n = 0; n < kProducts; ++n)
            out[n] = a[n] + (at - static_cast<double>(k)) * (b[n] - a[n]);
        return out;
    }

    /// Adds `sign` times the integral from 0 ≤ from to `to`, the slope's `slope_sign` times: linear between entries.
    void add_integral(Products& sum, double from, double to, double slope_sign) const {
        const double last = step_ * static_cast<double>(profile_.size() - 1);
        while (from < to) {
            const double next_entry = from < last ? step_ * (std::floor(from / step_ + kAtEntry) + 1) : to;
            const double until = std::min(to, std::max(next_entry, from + kAtEntry * step_));
            const Products a = at(from), b = at(until);
            for (std::size_t n = 0; n < kProducts; ++n)
                sum[n] += (n == kSlope ? slope_sign : 1) * (until - from) * (a[n] + b[n]) / 2;
            from = until;
        }
    }

  private:
    static constexpr double kAtEntry = 0x1p-30; ///< steps: as near to an entry is at it
    const std::vector<FeatureProfileEntry>& profile_;
    double step_;
};

} // namespace

FeatureProducts feature_profile_mean(const FeatureCurvesTexture& t, double distance, double reach) {
    const Table table(t);
    if (!(reach > 0)) return named(table.at(distance), 0);
    Products sum{};
    table.add_integral(sum, 0, reach - distance, -1);
    const double across = sum[kBlend] / (2 * reach);
    table.add_integral(sum, std::max(distance - reach, 0.0), distance + reach, 1);
    for (double& v : sum)
        v /= 2 * reach;
    return named(sum, across);
}

} // namespace fetex
