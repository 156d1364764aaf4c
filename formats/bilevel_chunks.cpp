// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/bilevel_chunks.h"

#include <optional>
#include <string>

#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

constexpr FourCc kHeader = fourcc("BLVH"), kTexels = fourcc("BLVT"), kMips = fourcc("BLVM"), kImage = fourcc("BLVI");
constexpr std::size_t kHeaderWords = 8, kHeaderWordsUsed = 7; ///< SPEC §2.4

std::vector<std::uint32_t> header_words(const BilevelTexture& t) {
    return {t.width, t.height, static_cast<std::uint32_t>(t.rule), t.below, t.above, t.image_width, t.image_height, 0};
}

std::optional<Finding> read_header(BilevelTexture& out, const ChunkView& chunk) {
    const auto bad = [&](std::size_t word, const char* message) {
        return Finding{FindingCode::BadBilevelHeader, chunk.offset + word * 4, std::string("BLVH: ") + message};
    };
    const auto side = [](std::uint32_t v) { return v >= 1 && v <= kBilevelMaxSide; };
    if (chunk.payload.size() != kHeaderWords * 4) return bad(0, "not 32 bytes");
    const std::vector<std::uint32_t> w = to_words(chunk.payload);
    if (!side(w[0]) || !side(w[1])) return bad(0, "width or height outside 1 … 16384");
    if (w[2] > static_cast<std::uint32_t>(BilevelRule::Median)) return bad(2, "unknown rule");
    if ((w[5] != 0 || w[6] != 0) && (!side(w[5]) || !side(w[6])))
        return bad(5, "sides of the image are neither 0 nor within 1 … 16384");
    for (std::size_t k = kHeaderWordsUsed; k < kHeaderWords; ++k)
        if (w[k] != 0) return bad(k, "reserved words aren't 0");
    out.width = w[0], out.height = w[1];
    out.rule = static_cast<BilevelRule>(w[2]);
    out.channels = bilevel_channels(out.rule);
    out.below = w[3], out.above = w[4];
    out.image_width = w[5], out.image_height = w[6];
    return std::nullopt;
}

Finding wrong_length(const ChunkView& chunk) {
    return {FindingCode::BilevelSizeMismatch, chunk.offset,
            fourcc_text(chunk.type) + ": wrong length for what BLVH says"};
}

/// BLVM: levels 1 … n, or none.
std::optional<Finding> read_mips(BilevelTexture& out, const BilevelChunks& chunks) {
    if (chunks.mips.empty()) return std::nullopt;
    const std::uint32_t levels = fbt_mip_levels(out.width, out.height);
    if (chunks.mips.begin()->first != 1 || chunks.mips.rbegin()->first != levels || chunks.mips.size() != levels)
        return Finding{FindingCode::MissingChunk, chunks.mips.begin()->second->offset,
                       "BLVM: its levels aren't 1 to " + std::to_string(levels)};
    for (const auto& [k, chunk] : chunks.mips)
        if (chunk->payload.size() != fbt_mip_level(out.width, out.height, k).samples()) return wrong_length(*chunk);
    for (const auto& [k, chunk] : chunks.mips)
        out.mips.insert(out.mips.end(), chunk->payload.begin(), chunk->payload.end());
    return std::nullopt;
}

std::optional<Finding> read_parts(BilevelTexture& out, const BilevelChunks& chunks) {
    if (auto bad = read_header(out, *chunks.header)) return bad;
    if (chunks.texels->payload.size() != std::uint64_t{out.width} * out.height * out.channels)
        return wrong_length(*chunks.texels);
    if ((chunks.image != nullptr) != (out.image_width != 0))
        return Finding{FindingCode::MissingChunk, chunks.header->offset,
                       "BLVI is there, and not asked for, or the other way round"};
    if (chunks.image && chunks.image->payload.size() != std::uint64_t{out.image_width} * out.image_height * 4)
        return wrong_length(*chunks.image);
    out.texels.assign(chunks.texels->payload.begin(), chunks.texels->payload.end());
    if (chunks.image) out.image = to_words(chunks.image->payload);
    return read_mips(out, chunks);
}

} // namespace

void BilevelChunks::add(const ChunkView& chunk) {
    if (chunk.type == kMips)
        mips[chunk.level] = &chunk;
    else
        (chunk.type == kHeader ? header : chunk.type == kTexels ? texels : image) = &chunk;
}

bool is_bilevel_chunk(const ChunkView& chunk) {
    if (chunk.representation == kWholeFile) return false;
    return chunk.type == kMips ||
           (chunk.level == 0 && (chunk.type == kHeader || chunk.type == kTexels || chunk.type == kImage));
}

void append_bilevel_chunks(std::vector<ChunkView>& chunks, const BilevelTexture& texture, std::uint8_t representation,
                           bool critical, Payloads& payloads) {
    const auto append = [&](FourCc type, std::uint16_t flags, std::uint32_t level, ByteSpan payload) {
        chunks.push_back({type, flags, representation, static_cast<std::uint8_t>(level), 0, payload});
    };
    const std::uint16_t flags = critical ? kChunkCritical : 0;
    append(kHeader, flags, 0, payloads.emplace_back(to_bytes(header_words(texture))));
    append(kTexels, flags, 0, texture.texels);
    if (!texture.image.empty()) append(kImage, flags, 0, as_bytes(texture.image, payloads));
    for (std::uint32_t k = 1; !texture.mips.empty() && k <= fbt_mip_levels(texture.width, texture.height); ++k) {
        const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
        append(kMips, 0, k, ByteSpan(texture.mips).subspan(level.first, level.samples()));
    }
}

std::vector<Finding> read_bilevel(BilevelTexture& out, const BilevelChunks& chunks, std::size_t limit) {
    if (auto bad = read_parts(out, chunks)) return {std::move(*bad)};
    std::vector<Finding> findings = validate_bilevel(out, limit);
    for (Finding& finding : findings)
        finding.offset += (finding.message.starts_with("image") ? chunks.image : chunks.header)->offset;
    return findings;
}

} // namespace fetex
