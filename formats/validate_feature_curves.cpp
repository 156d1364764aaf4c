// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "formats/bitmap_samples.h"
#include "formats/bytes.h"
#include "formats/fbt_mip.h"
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
    if (!t.gradients.empty() && t.gradients.size() != 2 * bytes) return "the gradients aren't those of all corners";
    if (t.gradients.empty() && t.kind == FeatureKind::Normal) return "normals need gradients";
    const std::uint32_t words = fbt_sample_words(silmap_fbt_format(t.base_format));
    if (t.base.size() != words && t.base.size() != feature_corner_count(t) * words)
        return "the base map is neither one sample nor those of all corners";
    if (t.profiles < 1 || t.profiles > kFeatureProfilesMost) return "there aren't 1 … 16 profiles";
    if (t.profile.size() % t.profiles != 0 || t.profile.size() < 2 * std::size_t{t.profiles} ||
        t.profile.size() > std::size_t{kFeatureProfileMost} * t.profiles)
        return "profiles haven't 2 … 4096 entries each";
    if (t.profile_map.size() != (t.profiles > 1 ? feature_corner_count(t) : 0))
        return "the profile map isn't that of all corners, or there is one profile";
    if (!t.mips.empty() && t.mips.size() != fbt_mip_samples(t.width, t.height))
        return "the mips are neither empty nor all levels";
    return nullptr;
}

bool number_above_zero(float v) { return v > 0 && v <= kFbtMaxHalf; }

bool wrong_header(const FeatureCurvesTexture& t) {
    return t.format > FeatureNumberFormat::Bits16 || t.kind > FeatureKind::Height ||
           t.base_format > FeatureSampleFormat::Rgb8 || !number_above_zero(t.distance_limit) ||
           !number_above_zero(t.height_scale) || (t.kind != FeatureKind::Height && t.height_scale != 1);
}

/// What the limit of distances is in the texture's format.
double largest_distance(const FeatureCurvesTexture& t) {
    const float limit = t.distance_limit;
    return feature_number(t.format, FeatureQuantity::Distance,
                          feature_pack_number(t.format, FeatureQuantity::Distance, limit, limit), limit);
}

/// A float, half or 16 bits of −1 … 1.
bool gradient_in_range(FeatureNumberFormat format, std::uint32_t packed) {
    switch (format) {
    case FeatureNumberFormat::Float:
        return (packed & 0x7fffffffu) <= std::bit_cast<std::uint32_t>(1.0f);
    case FeatureNumberFormat::Half:
        return (packed & 0x7fffu) <= kFbtHalfOne;
    default:
        return packed != 0x8000u;
    }
}

bool number_in_range(const FeatureCurvesTexture& t, FeatureQuantity quantity, std::uint32_t packed) {
    if (quantity == FeatureQuantity::Gradient) return gradient_in_range(t.format, packed);
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
        numbers(t_.gradients, "gradients", [](std::uint64_t) { return FeatureQuantity::Gradient; });
        samples(t_.base, t_.base_format, "base");
        samples(t_.mips, FeatureSampleFormat::Rgba8, "mips");
        profile();
        profile_map();
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

    void samples(std::span<const std::uint32_t> words, FeatureSampleFormat format, const std::string& part) {
        const std::size_t step = fbt_sample_words(silmap_fbt_format(format));
        for (std::size_t k = 0; k < words.size(); k += step) {
            const SampleFault fault = bitmap_sample_fault(&words[k], format);
            if (fault == SampleFault::None) continue;
            add(fault == SampleFault::NotPremultiplied ? FindingCode::FeatureNotPremultiplied
                                                       : FindingCode::FeatureSampleValue,
                k / step * bitmap_sample_bytes(format), part + sample_fault_text(fault));
        }
    }

    void profile() {
        for (std::size_t k = 0; k < t_.profile.size(); ++k) {
            const FeatureProfileEntry& e = t_.profile[k];
            const std::uint64_t offset = k * sizeof(FeatureProfileEntry);
            const bool in_range =
                std::abs(e.height) <= kFbtMaxHalf && std::abs(e.slope) <= kFbtMaxHalf && e.blend >= 0 && e.blend <= 1;
            if (!in_range)
                add(FindingCode::FeatureProfileValue, offset, "profile: a height, slope or blend outside its range");
            if (bitmap_sample_fault(&e.color, FeatureSampleFormat::Rgba8) != SampleFault::None)
                add(FindingCode::FeatureNotPremultiplied, offset + offsetof(FeatureProfileEntry, color),
                    "profile: a colour channel exceeds alpha");
        }
    }

    void profile_map() {
        for (std::uint64_t k = 0; k < t_.profile_map.size(); ++k) {
            const unsigned word = t_.profile_map[k];
            if (word >> 12 != 0 || std::max({word & 15u, word >> 4 & 15u, word >> 8 & 15u}) >= t_.profiles)
                add(FindingCode::FeatureProfileNumber, 2 * k, "profile map: a profile that isn't there");
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
        if (used) return;
        const std::uint64_t corner = std::uint64_t{j} * (std::uint64_t{t_.width} + 1) + i;
        if (!t_.profile_map.empty() && (t_.profile_map[corner] >> (e == FeatureEdge::North ? 4 : 8) & 15u) != 0)
            add(FindingCode::FeatureUnusedEdge, 2 * corner, "profile map: an edge without a curve hasn't the default");
        if (feature_crossing(t_, i, j, e) == FeatureCrossing{}) return;
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
                 "header: unknown number format, sample format or kind, or a limit of distances or scale of heights "
                 "outside 0 … 65504"}};
    if (const char* wrong = wrong_size(texture))
        return {{FindingCode::FeatureDimensions, 0, std::string("header: ") + wrong}};
    return Check(texture, std::max<std::size_t>(limit, 1)).run();
}

} // namespace fetex
