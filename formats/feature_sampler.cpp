// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/feature_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/fbt_mip.h"
#include "formats/feature_interpolation.h"
#include "formats/interpolation.h"
#include "formats/mip_chain.h"

namespace fetex {
namespace {

/// A normal shorter than this is one that points out of the texture.
constexpr double kLeastNormal = 0x1p-20;

struct Vector3 {
    double x = 0, y = 0, z = 1;
};

Vector3 unit(const Vector3& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length >= kLeastNormal ? Vector3{v.x / length, v.y / length, v.z / length} : Vector3{};
}

FeatureTexel texel_of(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    FeatureTexel out;
    out.segments = feature_unpack(t.configurations[std::size_t{j} * t.width + i]);
    for (std::uint32_t k = 0; k < out.segments.count; ++k)
        out.curves[k] = feature_segment_curve(t, i, j, k);
    const FeatureSignature signature = feature_signature(t, i, j);
    for (std::size_t e = 0; e < signature.size(); ++e)
        out.positions[e] = signature[e].position;
    out.open = feature_open_edges(t, i, j);
    return out;
}

std::uint32_t ends_of(const FeatureCurvesTexture& t, std::int64_t i, std::int64_t j) {
    std::uint32_t edges = 0;
    if (i < 0 || j < 0 || i >= t.width || j >= t.height) return edges;
    for (const FeatureSegment s : feature_unpack(t.configurations[static_cast<std::size_t>(j * t.width + i)]))
        edges |= 1u << feature_edge_index(s.first) | 1u << feature_edge_index(s.second);
    return edges;
}

void add(FeatureProducts& sum, double part, const FeatureProducts& p) {
    sum.slope += part * p.slope, sum.base_slope += part * p.base_slope, sum.blend += part * p.blend;
    sum.across += part * p.across, sum.height += part * p.height;
    sum.color.r += part * p.color.r, sum.color.g += part * p.color.g;
    sum.color.b += part * p.color.b, sum.color.a += part * p.color.a;
}

/// Of all profiles that count at the point.
FeatureProducts products_of(const FeatureCurvesTexture& t, const FeatureAt& at, double reach) {
    if (t.profiles == 1) return feature_profile_mean(t, at.distance, reach);
    FeatureProducts sum;
    sum.blend = 0;
    for (std::uint32_t k = 0; k < t.profiles; ++k)
        if (at.profiles[k] > 0) add(sum, at.profiles[k], feature_profile_mean(t, at.distance, reach, k));
    return sum;
}

std::array<double, kFeatureProfilesMost> by_profile(const FeatureTexelProfiles& numbers,
                                                    const FeatureProfileWeights& weights) {
    std::array<double, kFeatureProfilesMost> out{};
    for (std::size_t k = 0; k < 4; ++k)
        out[numbers.corners[k]] += weights.corners[k], out[numbers.edges[k]] += weights.edges[k];
    return out;
}

template <class Of> FbtColor weighted(const std::array<double, 4>& weights, const Of& of) {
    FbtColor sum;
    for (std::uint32_t c = 0; c < kFeatureCorners; ++c) {
        if (weights[c] == 0) continue;
        const FbtColor v = of(c);
        sum.r += weights[c] * v.r, sum.g += weights[c] * v.g, sum.b += weights[c] * v.b, sum.a += weights[c] * v.a;
    }
    return sum;
}

Vector3 normal_of(const FbtColor& c, FeatureSampleFormat format) {
    const auto component = [&](double v) { return std::clamp(v * feature_normal_factor(format) - 1, -1.0, 1.0); };
    return unit({component(c.r), component(c.g), component(c.b)});
}

/// Equation 1.
Vector3 shown_normal(const FeatureProducts& p, const FeatureVector& g, const Vector3& base) {
    const double along = std::hypot(p.base_slope * std::hypot(g.x, g.y), p.blend), rest = 1 - p.blend;
    return unit({along * base.x - p.slope * g.x, along * base.y - p.slope * g.y, rest + along * base.z});
}

struct Place {
    std::uint32_t texel = 0;
    double local = 0;
};
Place place_of(double v, std::uint32_t texels) {
    const double at = clamp_to(v, texels);
    const auto i = std::min(static_cast<std::uint32_t>(at), texels - 1);
    return {i, at - i};
}

} // namespace

std::uint32_t feature_open_edges(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    const std::int64_t column = i, row = j;
    const auto across = [&](std::int64_t a, std::int64_t b, FeatureEdge theirs, FeatureEdge ours) {
        return (ends_of(t, a, b) >> feature_edge_index(theirs) & 1u) << feature_edge_index(ours);
    };
    using enum FeatureEdge;
    return (across(column, row - 1, South, North) | across(column + 1, row, West, East) |
            across(column, row + 1, North, South) | across(column - 1, row, East, West)) &
           ~ends_of(t, column, row);
}

FeatureAt feature_at_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    const FeaturePoint p{clamp_to(fx, 1), clamp_to(fy, 1)};
    const FeatureTexel texel = texel_of(t, i, j);
    std::array<double, 4> distances{};
    for (std::uint32_t c = 0; c < kFeatureCorners; ++c)
        distances[c] = feature_distance(t, i + (c & 1), j + (c >> 1));
    const FeatureRegion region = feature_region(texel, distances, p);
    const auto weights = feature_weights(texel, region.corners, p);
    FeatureAt out;
    out.distance = std::min(region.distance, double{t.distance_limit});
    for (std::uint32_t c = 0; c < kFeatureCorners; ++c) {
        const FeatureVector g = feature_gradient(t, i + (c & 1), j + (c >> 1));
        out.gradient.x += weights[c] * g.x, out.gradient.y += weights[c] * g.y;
    }
    if (t.profiles > 1)
        out.profiles = by_profile(feature_texel_profiles(t, i, j), feature_profile_weights(texel, region, p));
    const auto base = [&](std::uint32_t c) { return feature_base(t, i + (c & 1), j + (c >> 1)); };
    out.base = weighted(weights, base);
    out.across = out.base;
    if (texel.segments.count == 0) return out;
    out.across = weighted(feature_weights(texel, region.across[0], p), base);
    if (texel.segments.count == 2)
        out.across = mix(out.across, weighted(feature_weights(texel, region.across[1], p), base), region.second);
    return out;
}

FeatureAt feature_at(const FeatureCurvesTexture& t, double x, double y) {
    const auto [i, fx] = place_of(x, t.width);
    const auto [j, fy] = place_of(y, t.height);
    return feature_at_local(t, i, j, fx, fy);
}

double feature_reach(FeaturePixel pixel) {
    const double w = clamp_to(pixel.width, 1), h = clamp_to(pixel.height, 1);
    return std::sqrt((w * w + h * h) / 8);
}

FbtColor feature_shown(const FeatureCurvesTexture& t, const FeatureAt& at, double reach) {
    const FeatureProducts p = products_of(t, at, reach);
    const FbtColor base = p.across > 0 ? mix(at.base, at.across, p.across / p.blend) : at.base;
    switch (t.kind) {
    case FeatureKind::Normal: {
        const Vector3 n = shown_normal(p, at.gradient, normal_of(base, t.base_format));
        return {(n.x + 1) / 2, (n.y + 1) / 2, (n.z + 1) / 2, 1};
    }
    case FeatureKind::Height: {
        const double v = std::clamp(p.height / t.height_scale + p.blend * base.r, 0.0, 1.0);
        return {v, v, v, 1};
    }
    default:
        return {p.color.r + p.blend * base.r, p.color.g + p.blend * base.g, p.color.b + p.blend * base.b,
                p.color.a + p.blend * base.a};
    }
}

FbtColor feature_sample_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    return feature_shown(t, feature_at_local(t, i, j, fx, fy));
}

FbtColor feature_sample(const FeatureCurvesTexture& t, double x, double y) {
    return feature_shown(t, feature_at(t, x, y));
}

FbtColor feature_sample_area_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx,
                                   double fy, FeaturePixel pixel) {
    return feature_shown(t, feature_at_local(t, i, j, fx, fy), feature_reach(pixel));
}

FbtColor feature_sample_area(const FeatureCurvesTexture& t, double x, double y, FeaturePixel pixel) {
    return feature_shown(t, feature_at(t, x, y), feature_reach(pixel));
}

FbtColor feature_sample_mip(const FeatureCurvesTexture& t, double x, double y, FeaturePixel pixel) {
    const double side = std::max({0.0, pixel.width, pixel.height});
    const auto [k, part] = fbt_mip_place(t.width, t.height, side);
    const FbtColor fine =
        k == 0 ? feature_sample_area(t, x, y, pixel) : fbt_mip_color(t.mips, t.width, t.height, k, x, y);
    return part > 0 ? mix(fine, fbt_mip_color(t.mips, t.width, t.height, k + 1, x, y), part) : fine;
}

std::vector<std::uint32_t> feature_make_mips(const FeatureCurvesTexture& t) {
    constexpr double side = 1.0 / kFeatureMipPoints, share = side * side;
    return make_mip_chain(t.width, t.height, [&](std::uint32_t j, std::span<FbtColor> row) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            FbtColor sum;
            for (std::uint32_t n = 0; n < kFeatureMipPoints * kFeatureMipPoints; ++n) {
                const FbtColor c = feature_sample_area_local(t, i, j, (n % kFeatureMipPoints + 0.5) * side,
                                                             (n / kFeatureMipPoints + 0.5) * side, {side, side});
                sum.r += share * c.r, sum.g += share * c.g, sum.b += share * c.b, sum.a += share * c.a;
            }
            row[i] = sum;
        }
    });
}

} // namespace fetex
