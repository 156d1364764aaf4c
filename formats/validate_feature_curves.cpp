// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "formats/bytes.h"
#include "formats/fbt_samples.h"
#include "formats/feature_curve_geometry.h"
#include "formats/validate.h"

namespace fetex {
namespace {

bool side(std::uint32_t v) { return v >= 1 && v <= kFeatureCurvesMaxSide; }

const char* wrong_size(const FeatureCurvesTexture& t) {
    if (!side(t.width) || !side(t.height)) return "width or height outside 1 … 16384";
    if (t.configurations.size() != std::uint64_t{t.width} * t.height) return "the configurations aren't width·height";
    const std::uint64_t bytes = feature_corner_count(t) * feature_number_bytes(t.format);
    if (t.signatures.size() != bytes * feature_signature_numbers(t.linear) || t.distances.size() != bytes)
        return "signatures or distances aren't those of (width+1)·(height+1) corners";
    return nullptr;
}

bool wrong_header(const FeatureCurvesTexture& t) {
    return t.format > FeatureNumberFormat::Bits16 || !(t.distance_limit > 0) || t.distance_limit > kFbtMaxHalf;
}

/// What the limit of distances is in the texture's format.
double largest_distance(const FeatureCurvesTexture& t) {
    const float limit = t.distance_limit;
    return feature_number(t.format, FeatureQuantity::Distance,
                          feature_pack_number(t.format, FeatureQuantity::Distance, limit, limit), limit);
}

bool number_in_range(const FeatureCurvesTexture& t, FeatureQuantity quantity, std::uint32_t packed) {
    if (t.format == FeatureNumberFormat::Half && packed >= kFbtHalfInfinity) return false;
    // Floats without a sign order as integers do.
    if (t.format == FeatureNumberFormat::Float && packed >= std::bit_cast<std::uint32_t>(INFINITY)) return false;
    const double v = feature_number(t.format, quantity, packed, t.distance_limit);
    if (quantity == FeatureQuantity::Angle) return v < std::numbers::pi;
    return v <= (quantity == FeatureQuantity::Position ? 1.0 : largest_distance(t));
}

class Check {
  public:
    Check(const FeatureCurvesTexture& t, std::size_t limit) : t_(t), limit_(limit) {}

    std::vector<Finding> run() {
        numbers(t_.signatures, "signatures", [&](std::uint64_t n) {
            return !t_.linear && n % 2 == 1 ? FeatureQuantity::Angle : FeatureQuantity::Position;
        });
        numbers(t_.distances, "distances", [](std::uint64_t) { return FeatureQuantity::Distance; });
        configurations();
        if (!findings_.empty()) return std::move(findings_);
        unused_edges();
        if (!t_.linear) curves();
        return std::move(findings_);
    }

  private:
    void add(FindingCode code, std::uint64_t offset, std::string message) {
        if (findings_.size() < limit_) findings_.push_back({code, offset, std::move(message)});
    }

    template <class QuantityOf> void numbers(ByteSpan bytes, const std::string& part, const QuantityOf& quantity_of) {
        const std::uint32_t size = feature_number_bytes(t_.format);
        for (std::uint64_t n = 0; n * size < bytes.size(); ++n) {
            const std::uint32_t packed =
                size == 4 ? load_le<std::uint32_t>(bytes, n * size) : load_le<std::uint16_t>(bytes, n * size);
            if (!number_in_range(t_, quantity_of(n), packed))
                add(FindingCode::FeatureNumber, n * size, part + ": a number outside its range");
        }
    }

    void configurations() {
        for (std::size_t k = 0; k < t_.configurations.size(); ++k)
            if (const FeatureConfiguration c = t_.configurations[k];
                !feature_valid(c) || (t_.linear && feature_edges(c) != c))
                add(FindingCode::FeatureBadTexel, 2 * std::uint64_t{k}, "configurations: not a valid one");
    }

    void curves() {
        for (std::size_t k = 0; k < t_.configurations.size(); ++k) {
            const FeatureSegmentList list = feature_unpack(t_.configurations[k]);
            const auto j = static_cast<std::uint32_t>(k / t_.width), i = static_cast<std::uint32_t>(k % t_.width);
            for (std::uint32_t n = 0; n < list.count; ++n)
                if (!list.straight[n] && !feature_curve(feature_signature(t_, i, j), list.segment[n], false))
                    add(FindingCode::FeatureNoCurve, 2 * std::uint64_t{k},
                        "configurations: a segment whose tangents don't meet in the texel isn't straight");
        }
    }

    /// Some segment of the texel, if it exists, ends on its edge.
    [[nodiscard]] bool uses(std::int64_t i, std::int64_t j, FeatureEdge e) const {
        if (i < 0 || j < 0 || i >= t_.width || j >= t_.height) return false;
        const auto list = feature_unpack(t_.configurations[static_cast<std::size_t>(j * t_.width + i)]);
        return std::any_of(list.begin(), list.end(), [&](FeatureSegment s) { return s.first == e || s.second == e; });
    }

    void unused_edges() {
        using enum FeatureEdge;
        for (std::uint32_t j = 0; j <= t_.height; ++j) {
            for (std::uint32_t i = 0; i <= t_.width; ++i) {
                const std::int64_t column = i, row = j;
                unused(i, j, North, uses(column, row, North) || uses(column, row - 1, South));
                unused(i, j, West, uses(column, row, West) || uses(column - 1, row, East));
            }
        }
    }

    void unused(std::uint32_t i, std::uint32_t j, FeatureEdge e, bool used) {
        if (used || feature_crossing(t_, i, j, e) == FeatureCrossing{}) return;
        const std::uint64_t corner = std::uint64_t{j} * (std::uint64_t{t_.width} + 1) + i;
        add(FindingCode::FeatureUnusedEdge,
            corner * feature_signature_numbers(t_.linear) * feature_number_bytes(t_.format),
            "signatures: an edge without a curve hasn't the default");
    }

    const FeatureCurvesTexture& t_;
    std::size_t limit_;
    std::vector<Finding> findings_;
};

} // namespace

std::vector<Finding> validate_feature_curves(const FeatureCurvesTexture& texture, std::size_t limit) {
    if (wrong_header(texture))
        return {{FindingCode::FeatureFormat, 0,
                 "header: unknown number format, or a limit of distances outside 0 … 65504"}};
    if (const char* wrong = wrong_size(texture))
        return {{FindingCode::FeatureDimensions, 0, std::string("header: ") + wrong}};
    return Check(texture, std::max<std::size_t>(limit, 1)).run();
}

} // namespace fetex
