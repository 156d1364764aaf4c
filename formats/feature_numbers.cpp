// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The numbers of signatures, distances and gradients, and where they are.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "formats/bytes.h"
#include "formats/fbt_samples.h"
#include "formats/feature_curves.h"

namespace fetex {
namespace {

/// What a step of 16 bits is worth.
double step_of(FeatureQuantity quantity, float limit) {
    switch (quantity) {
    case FeatureQuantity::Position:
        return 0x1p-15;
    case FeatureQuantity::Angle:
        return std::numbers::pi / 0x1p16;
    case FeatureQuantity::Gradient:
        return 1.0 / 32767;
    default:
        return double{limit} / 65535;
    }
}

double in_range(FeatureQuantity quantity, double v, float limit) {
    switch (quantity) {
    case FeatureQuantity::Position:
        return std::clamp(v, 0.0, 1.0);
    case FeatureQuantity::Angle: {
        const double rest = std::fmod(v, std::numbers::pi);
        return rest < 0 ? std::max(rest + std::numbers::pi, 0.0) : rest;
    }
    case FeatureQuantity::Gradient:
        return std::clamp(v, -1.0, 1.0);
    default:
        return std::clamp(v, 0.0, double{limit});
    }
}

std::uint64_t corner(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    return std::uint64_t{j} * (std::uint64_t{t.width} + 1) + i;
}

std::uint32_t load(const FeatureCurvesTexture& t, ByteSpan numbers, std::uint64_t n) {
    if (t.format == FeatureNumberFormat::Float) return load_le<std::uint32_t>(numbers, n * 4);
    return load_le<std::uint16_t>(numbers, n * 2);
}

/// Below 2^31 in amount; the processor's own rounding is towards 0.
double floor_of(double v) {
    const auto towards_zero = static_cast<double>(static_cast<std::int32_t>(v));
    return towards_zero > v ? towards_zero - 1 : towards_zero;
}

void store(const FeatureCurvesTexture& t, std::vector<std::uint8_t>& numbers, std::uint64_t n, std::uint32_t packed) {
    const std::uint32_t size = feature_number_bytes(t.format);
    for (std::uint32_t k = 0; k < size; ++k)
        numbers[n * size + k] = static_cast<std::uint8_t>(packed >> (8 * k));
}

/// The same bytes over and over.
void fill(std::vector<std::uint8_t>& numbers, std::size_t group) {
    for (std::size_t done = group; done < numbers.size(); done *= 2) // what is there already
        std::copy_n(numbers.begin(), std::min(done, numbers.size() - done),
                    numbers.begin() + static_cast<std::ptrdiff_t>(done));
}

/// The number of a north or west edge's position; the angle's, if any, is the next.
std::uint64_t position_number(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge e) {
    const std::uint64_t first = corner(t, i, j) * feature_signature_numbers(t.linear);
    return e == FeatureEdge::North ? first : first + (t.linear ? 1 : 2);
}

} // namespace

constexpr std::uint32_t kHalfSign = 0x8000;

std::uint32_t feature_pack_number(FeatureNumberFormat format, FeatureQuantity quantity, double value, float limit) {
    const double v = in_range(quantity, value, limit);
    if (format == FeatureNumberFormat::Bits16) {
        const double steps = floor_of(v / step_of(quantity, limit) + 0.5);
        // Angles: what rounds up to π is 0. Gradients: two's complement.
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(steps)) & 0xffffu;
    }
    // The floats and halves next to π are above it.
    if (format == FeatureNumberFormat::Half) {
        const std::uint32_t half = fbt_to_half(std::abs(v)) | (v < 0 ? kHalfSign : 0);
        return quantity == FeatureQuantity::Angle && fbt_half_value(half) >= std::numbers::pi ? 0 : half;
    }
    const auto single = static_cast<float>(v);
    return quantity == FeatureQuantity::Angle && single >= std::numbers::pi ? 0 : std::bit_cast<std::uint32_t>(single);
}

double feature_number(FeatureNumberFormat format, FeatureQuantity quantity, std::uint32_t packed, float limit) {
    if (format == FeatureNumberFormat::Float) return double{std::bit_cast<float>(packed)};
    if (format == FeatureNumberFormat::Half) {
        const double v = fbt_half_value(packed & ~kHalfSign);
        return packed & kHalfSign ? -v : v;
    }
    const std::int32_t steps =
        quantity == FeatureQuantity::Gradient ? static_cast<std::int16_t>(packed) : static_cast<std::int32_t>(packed);
    return steps * step_of(quantity, limit);
}

FeatureCurvesTexture feature_empty_texture(std::uint32_t width, std::uint32_t height, FeatureNumberFormat format,
                                           bool linear, float distance_limit) {
    FeatureCurvesTexture t;
    t.width = width, t.height = height, t.format = format, t.linear = linear, t.distance_limit = distance_limit;
    t.configurations.resize(std::uint64_t{width} * height);
    const std::size_t bytes = feature_number_bytes(format), group = feature_signature_numbers(linear) * bytes;
    t.signatures.resize(feature_corner_count(t) * group);
    t.distances.resize(feature_corner_count(t) * bytes);
    t.base = {0xffffffffu};
    t.profile.resize(2);
    feature_set_crossing(t, 0, 0, FeatureEdge::North, {});
    feature_set_crossing(t, 0, 0, FeatureEdge::West, {});
    feature_set_distance(t, 0, 0, distance_limit);
    fill(t.signatures, group);
    fill(t.distances, bytes);
    return t;
}

FeatureCrossing feature_crossing(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge edge) {
    const std::uint64_t n = position_number(t, i, j, edge);
    const auto value = [&](std::uint64_t k, FeatureQuantity q) {
        return feature_number(t.format, q, load(t, t.signatures, k), t.distance_limit);
    };
    return {value(n, FeatureQuantity::Position), t.linear ? 0 : value(n + 1, FeatureQuantity::Angle)};
}

FeatureSignature feature_signature(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    using enum FeatureEdge;
    return {feature_crossing(t, i, j, North), feature_crossing(t, i + 1, j, West), feature_crossing(t, i, j + 1, North),
            feature_crossing(t, i, j, West)};
}

void feature_set_crossing(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge edge,
                          const FeatureCrossing& crossing) {
    const std::uint64_t n = position_number(t, i, j, edge);
    const auto packed = [&](FeatureQuantity q, double v) {
        return feature_pack_number(t.format, q, v, t.distance_limit);
    };
    store(t, t.signatures, n, packed(FeatureQuantity::Position, crossing.position));
    if (!t.linear) store(t, t.signatures, n + 1, packed(FeatureQuantity::Angle, crossing.angle));
}

double feature_distance(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    return feature_number(t.format, FeatureQuantity::Distance, load(t, t.distances, corner(t, i, j)), t.distance_limit);
}

void feature_set_distance(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double distance) {
    store(t, t.distances, corner(t, i, j),
          feature_pack_number(t.format, FeatureQuantity::Distance, distance, t.distance_limit));
}

FeatureVector feature_gradient(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    if (t.gradients.empty()) return {};
    const std::uint64_t n = 2 * corner(t, i, j);
    const auto value = [&](std::uint64_t k) {
        return feature_number(t.format, FeatureQuantity::Gradient, load(t, t.gradients, k), t.distance_limit);
    };
    return {value(n), value(n + 1)};
}

void feature_set_gradient(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, const FeatureVector& gradient) {
    // 0 is 0 in every format.
    if (t.gradients.empty()) t.gradients.resize(2 * feature_corner_count(t) * feature_number_bytes(t.format));
    const std::uint64_t n = 2 * corner(t, i, j);
    store(t, t.gradients, n, feature_pack_number(t.format, FeatureQuantity::Gradient, gradient.x, t.distance_limit));
    store(t, t.gradients, n + 1,
          feature_pack_number(t.format, FeatureQuantity::Gradient, gradient.y, t.distance_limit));
}

} // namespace fetex
