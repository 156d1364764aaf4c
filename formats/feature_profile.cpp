// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Profiles' products, their means over distances, and which profile counts how much (SPEC.md, section 9.3).
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "formats/feature_interpolation.h"
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
    Table(const FeatureCurvesTexture& t, std::uint32_t profile)
        : profile_(std::span(t.profile).subspan(profile * feature_profile_entries(t), feature_profile_entries(t))),
          step_(t.distance_limit / static_cast<double>(profile_.size() - 1)) {}

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
    std::span<const FeatureProfileEntry> profile_;
    double step_;
};

/// An edge where a curve ends that the texel hasn't: its point takes from the corners a and b beside it what they have
/// there, as far as the place is near to it.
struct OpenEdge {
    FeatureEdge edge{};
    std::uint32_t a = 0, b = 0;
    double along = 0, nearness = 0; ///< from a to b; 1 on the edge
};

void take(FeatureProfileWeights& w, const OpenEdge& e, double position) {
    const double of = e.along < position ? e.along : 1 - e.along, all = e.along < position ? position : 1 - position,
                 taken = e.nearness * (all > 0 ? of / all : 1);
    w.edges[feature_edge_index(e.edge)] += taken;
    w.corners[e.a] -= taken * (1 - position), w.corners[e.b] -= taken * position;
}

/// Without the texel's own segments.
FeatureProfileWeights weights_beside(const FeatureTexel& texel, std::uint32_t corners, FeaturePoint p) {
    FeatureProfileWeights out;
    out.corners = feature_bilinear(corners, p);
    if (texel.open == 0) return out;
    using enum FeatureEdge;
    for (const OpenEdge& e : {OpenEdge{North, 0, 1, p.x, 1 - p.y}, OpenEdge{East, 1, 3, p.y, p.x},
                              OpenEdge{South, 2, 3, p.x, p.y}, OpenEdge{West, 0, 2, p.y, 1 - p.x}}) {
        const std::uint32_t ends = 1u << e.a | 1u << e.b;
        if ((texel.open >> feature_edge_index(e.edge) & 1u) != 0 && (corners & ends) == ends)
            take(out, e, texel.positions[feature_edge_index(e.edge)]);
    }
    double sum = 0;
    for (double& v : out.corners)
        sum += v = std::max(v, 0.0);
    for (const double v : out.edges)
        sum += v;
    for (std::size_t k = 0; k < 4; ++k)
        out.corners[k] /= sum, out.edges[k] /= sum;
    return out;
}

} // namespace

FeatureProfileWeights feature_profile_weights(const FeatureTexel& texel, const FeatureRegion& region, FeaturePoint p) {
    FeatureProfileWeights out = weights_beside(texel, region.corners, p);
    if (texel.segments.count == 0) return out;
    // Of two segments the one that the point lies on counts alone; on an edge where both end they count alike.
    const auto [one, two] = region.nearness;
    const double nearest = std::max(one, two), first = one * (1 - two), second = two * (1 - one),
                 part = first + second > 0 ? second / (first + second) : 0;
    for (std::size_t k = 0; k < 4; ++k)
        out.corners[k] *= 1 - nearest, out.edges[k] *= 1 - nearest;
    for (std::uint32_t k = 0; k < texel.segments.count; ++k) {
        const double counts = nearest * (k == 0 ? 1 - part : part);
        const FeatureSegment s = texel.segments.segment[k];
        out.edges[feature_edge_index(s.first)] += counts * (1 - region.along[k]);
        out.edges[feature_edge_index(s.second)] += counts * region.along[k];
    }
    return out;
}

FeatureProducts feature_profile_mean(const FeatureCurvesTexture& t, double distance, double reach,
                                     std::uint32_t profile) {
    const Table table(t, profile);
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
