// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/feature_curve_chunks.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

constexpr FourCc kHeader = fourcc("FCVH"), kConfigurations = fourcc("FCVC"), kSignatures = fourcc("FCVS"),
                 kDistances = fourcc("FCVD"), kGradients = fourcc("FCVG"), kBase = fourcc("FCVB"),
                 kProfile = fourcc("FCVP"), kProfileMap = fourcc("FCVI"), kMips = fourcc("FCVM");
constexpr std::array<FourCc, 6> kNeeded = {kHeader, kConfigurations, kSignatures, kDistances, kBase, kProfile};
constexpr std::size_t kHeaderWords = 16, kHeaderWordsUsed = 10; ///< SPEC §2.7
constexpr std::uint32_t kFlagLinear = 1, kFlagGradients = 2, kFlagOneSample = 4, kFlagsKnown = 7;
constexpr std::size_t kEntryWords = 4;

std::uint32_t sample_words(const FeatureCurvesTexture& t) { return fbt_sample_words(silmap_fbt_format(t.base_format)); }

std::vector<std::uint32_t> header_words(const FeatureCurvesTexture& t) {
    std::vector<std::uint32_t> words = {t.width,
                                        t.height,
                                        static_cast<std::uint32_t>(t.format),
                                        (t.linear ? kFlagLinear : 0) | (t.gradients.empty() ? 0 : kFlagGradients) |
                                            (t.base.size() == sample_words(t) ? kFlagOneSample : 0),
                                        std::bit_cast<std::uint32_t>(t.distance_limit),
                                        static_cast<std::uint32_t>(t.kind),
                                        static_cast<std::uint32_t>(t.base_format),
                                        static_cast<std::uint32_t>(feature_profile_entries(t)),
                                        std::bit_cast<std::uint32_t>(t.height_scale),
                                        t.profiles > 1 ? t.profiles : 0};
    words.resize(kHeaderWords, 0);
    return words;
}

/// What FCVH says of other chunks' lengths, beyond what a texture has.
struct Lengths {
    std::uint32_t flags = 0, entries = 0;
};

/// Numbers that nothing else depends on are the validator's.
std::optional<Finding> read_header(FeatureCurvesTexture& out, Lengths& lengths, const ChunkView& chunk) {
    const auto bad = [&](std::size_t word, const char* message) {
        return Finding{FindingCode::BadFeatureHeader, chunk.offset + word * 4, std::string("FCVH: ") + message};
    };
    const auto side = [](std::uint32_t v) { return v >= 1 && v <= kFeatureCurvesMaxSide; };
    if (chunk.payload.size() != kHeaderWords * 4) return bad(0, "not 64 bytes");
    const std::vector<std::uint32_t> w = to_words(chunk.payload);
    if (!side(w[0]) || !side(w[1])) return bad(0, "width or height outside 1 … 16384");
    if (w[2] > static_cast<std::uint32_t>(FeatureNumberFormat::Bits16)) return bad(2, "unknown number format");
    if ((w[3] & ~kFlagsKnown) != 0) return bad(3, "unknown flags");
    if (w[5] > static_cast<std::uint32_t>(FeatureKind::Height)) return bad(5, "unknown kind");
    if (w[6] > static_cast<std::uint32_t>(FeatureSampleFormat::Rgb8)) return bad(6, "unknown sample format");
    if (w[7] < 2 || w[7] > kFeatureProfileMost) return bad(7, "the profile hasn't 2 … 4096 entries");
    if (w[9] == 1 || w[9] > kFeatureProfilesMost) return bad(9, "profiles are neither 0, for one, nor 2 … 16");
    for (std::size_t k = kHeaderWordsUsed; k < kHeaderWords; ++k)
        if (w[k] != 0) return bad(k, "reserved words aren't 0");
    lengths = {w[3], w[7]};
    out.width = w[0], out.height = w[1], out.format = static_cast<FeatureNumberFormat>(w[2]);
    out.linear = (w[3] & kFlagLinear) != 0, out.distance_limit = std::bit_cast<float>(w[4]);
    out.kind = static_cast<FeatureKind>(w[5]), out.base_format = static_cast<FeatureSampleFormat>(w[6]);
    out.height_scale = std::bit_cast<float>(w[8]), out.profiles = std::max(w[9], 1u);
    return std::nullopt;
}

Finding wrong_length(const ChunkView& chunk) {
    return {FindingCode::FeatureSizeMismatch, chunk.offset,
            fourcc_text(chunk.type) + ": wrong length for what FCVH says"};
}

std::vector<std::uint8_t> copy_of(const ChunkView& chunk) { return {chunk.payload.begin(), chunk.payload.end()}; }

std::vector<std::uint8_t> bytes_of(const std::vector<std::uint16_t>& words) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(2 * words.size());
    for (const std::uint16_t word : words)
        append_le(bytes, word);
    return bytes;
}

std::vector<std::uint16_t> short_words(ByteSpan bytes) {
    std::vector<std::uint16_t> words;
    words.reserve(bytes.size() / 2);
    for (std::uint64_t k = 0; k < bytes.size(); k += 2)
        words.push_back(load_le<std::uint16_t>(bytes, k));
    return words;
}

std::vector<std::uint32_t> profile_words(const FeatureCurvesTexture& t) {
    std::vector<std::uint32_t> words;
    for (const FeatureProfileEntry& e : t.profile)
        words.insert(words.end(), {std::bit_cast<std::uint32_t>(e.height), std::bit_cast<std::uint32_t>(e.slope),
                                   std::bit_cast<std::uint32_t>(e.blend), e.color});
    return words;
}

/// Precondition: the chunk has the length that FCVH says.
void read_profile(FeatureCurvesTexture& out, const ChunkView& chunk) {
    const std::vector<std::uint32_t> w = to_words(chunk.payload);
    out.profile.resize(w.size() / kEntryWords);
    for (std::size_t k = 0; k < out.profile.size(); ++k) {
        const std::uint32_t* e = &w[kEntryWords * k];
        out.profile[k] = {std::bit_cast<float>(e[0]), std::bit_cast<float>(e[1]), std::bit_cast<float>(e[2]), e[3]};
    }
}

/// FCVM: levels 1 … n, or none.
std::optional<Finding> read_mips(FeatureCurvesTexture& out, const FeatureCurvesChunks& chunks) {
    if (chunks.mips.empty()) return std::nullopt;
    const std::uint32_t levels = fbt_mip_levels(out.width, out.height);
    if (chunks.mips.begin()->first != 1 || chunks.mips.rbegin()->first != levels || chunks.mips.size() != levels)
        return Finding{FindingCode::MissingChunk, chunks.mips.begin()->second->offset,
                       "FCVM: its levels aren't 1 to " + std::to_string(levels)};
    for (const auto& [k, chunk] : chunks.mips)
        if (chunk->payload.size() != 4 * fbt_mip_level(out.width, out.height, k).samples()) return wrong_length(*chunk);
    for (const auto& [k, chunk] : chunks.mips) {
        const std::vector<std::uint32_t> samples = to_words(chunk->payload);
        out.mips.insert(out.mips.end(), samples.begin(), samples.end());
    }
    return std::nullopt;
}

/// Bytes that a part must have, given the header.
std::uint64_t part_bytes(const FeatureCurvesTexture& t, const Lengths& lengths, FourCc part) {
    const std::uint64_t corners = feature_corner_count(t), numbers = corners * feature_number_bytes(t.format);
    if (part == kHeader) return kHeaderWords * 4;
    if (part == kConfigurations) return 2 * std::uint64_t{t.width} * t.height;
    if (part == kSignatures) return numbers * feature_signature_numbers(t.linear);
    if (part == kGradients) return 2 * numbers;
    if (part == kBase) return (lengths.flags & kFlagOneSample ? 1 : corners) * bitmap_sample_bytes(t.base_format);
    if (part == kProfile) return 4 * kEntryWords * std::uint64_t{lengths.entries} * t.profiles;
    return part == kProfileMap ? 2 * corners : numbers;
}

std::optional<Finding> read_parts(FeatureCurvesTexture& out, const FeatureCurvesChunks& chunks) {
    const auto& parts = chunks.parts;
    Lengths lengths;
    if (auto bad = read_header(out, lengths, *parts.at(kHeader))) return bad;
    if (parts.contains(kGradients) != ((lengths.flags & kFlagGradients) != 0))
        return Finding{FindingCode::MissingChunk, parts.at(kHeader)->offset,
                       "FCVG is there, and FCVH doesn't say so, or the other way round"};
    if (parts.contains(kProfileMap) != (out.profiles > 1))
        return Finding{FindingCode::MissingChunk, parts.at(kHeader)->offset,
                       "FCVI is there, and FCVH has one profile, or the other way round"};
    for (const auto& [part, chunk] : parts)
        if (chunk->payload.size() != part_bytes(out, lengths, part)) return wrong_length(*chunk);
    out.configurations = short_words(parts.at(kConfigurations)->payload);
    out.signatures = copy_of(*parts.at(kSignatures)), out.distances = copy_of(*parts.at(kDistances));
    if (parts.contains(kGradients)) out.gradients = copy_of(*parts.at(kGradients));
    const ByteSpan base = parts.at(kBase)->payload;
    out.base = out.base_format == FeatureSampleFormat::Rgb8 ? with_alpha(base) : to_words(base);
    read_profile(out, *parts.at(kProfile));
    if (parts.contains(kProfileMap)) out.profile_map = short_words(parts.at(kProfileMap)->payload);
    return read_mips(out, chunks);
}

/// Where a byte of FeatureCurvesTexture::mips lies in the file.
std::uint64_t mip_offset(const FeatureCurvesChunks& chunks, std::uint64_t offset) {
    for (const auto& [k, chunk] : chunks.mips) {
        if (offset < chunk->payload.size()) return chunk->offset + offset;
        offset -= chunk->payload.size();
    }
    return offset;
}

/// The part that the validator's message names.
FourCc part_named(const std::string& message) {
    const std::pair<const char*, FourCc> names[] = {{"configurations", kConfigurations},
                                                    {"signatures", kSignatures},
                                                    {"distances", kDistances},
                                                    {"gradients", kGradients},
                                                    {"base", kBase},
                                                    {"profile map", kProfileMap},
                                                    {"profile", kProfile}};
    for (const auto& [name, part] : names)
        if (message.starts_with(name)) return part;
    return kHeader;
}

} // namespace

void FeatureCurvesChunks::add(const ChunkView& chunk) {
    if (chunk.type == kMips)
        mips[chunk.level] = &chunk;
    else
        parts[chunk.type] = &chunk;
}

bool FeatureCurvesChunks::complete() const {
    return std::ranges::all_of(kNeeded, [&](FourCc part) { return parts.contains(part); });
}

bool is_feature_curves_chunk(const ChunkView& chunk) {
    if (chunk.representation == kWholeFile) return false;
    return chunk.type == kMips || (chunk.level == 0 && (chunk.type == kGradients || chunk.type == kProfileMap ||
                                                        std::ranges::find(kNeeded, chunk.type) != kNeeded.end()));
}

void append_feature_curves_chunks(std::vector<ChunkView>& chunks, const FeatureCurvesTexture& texture,
                                  std::uint8_t representation, bool critical, Payloads& payloads) {
    const auto append = [&](FourCc type, std::uint16_t flags, std::uint32_t level, ByteSpan payload) {
        chunks.push_back({type, flags, representation, static_cast<std::uint8_t>(level), 0, payload});
    };
    const std::uint16_t flags = critical ? kChunkCritical : 0;
    append(kHeader, flags, 0, payloads.emplace_back(to_bytes(header_words(texture))));
    append(kConfigurations, flags, 0, payloads.emplace_back(bytes_of(texture.configurations)));
    append(kSignatures, flags, 0, texture.signatures);
    append(kDistances, flags, 0, texture.distances);
    if (!texture.gradients.empty()) append(kGradients, flags, 0, texture.gradients);
    append(kBase, flags, 0,
           texture.base_format == FeatureSampleFormat::Rgb8 ? payloads.emplace_back(without_alpha(texture.base))
                                                            : as_bytes(texture.base, payloads));
    append(kProfile, flags, 0, payloads.emplace_back(to_bytes(profile_words(texture))));
    if (texture.profiles > 1) append(kProfileMap, flags, 0, payloads.emplace_back(bytes_of(texture.profile_map)));
    for (std::uint32_t k = 1; !texture.mips.empty() && k <= fbt_mip_levels(texture.width, texture.height); ++k) {
        const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
        append(kMips, 0, k, as_bytes(std::span(texture.mips).subspan(level.first, level.samples()), payloads));
    }
}

std::vector<Finding> read_feature_curves(FeatureCurvesTexture& out, const FeatureCurvesChunks& chunks,
                                         std::size_t limit) {
    if (auto bad = read_parts(out, chunks)) return {std::move(*bad)};
    std::vector<Finding> findings = validate_feature_curves(out, limit);
    for (Finding& finding : findings)
        finding.offset = finding.message.starts_with("mips")
                             ? mip_offset(chunks, finding.offset)
                             : finding.offset + chunks.parts.at(part_named(finding.message))->offset;
    return findings;
}

} // namespace fetex
