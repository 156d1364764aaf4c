// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/pinchmap_chunks.h"

#include <algorithm>
#include <optional>
#include <string>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

constexpr FourCc kHeader = fourcc("PNCH"), kMap = fourcc("PNCD"), kSignal = fourcc("PNCS"), kMips = fourcc("PNCM");
constexpr std::size_t kHeaderWords = 12, kHeaderWordsUsed = 8; ///< SPEC §2.6
constexpr std::uint32_t kFlagOpen = 1, kFlagLine = 2, kFlagsKnown = 3;

std::vector<std::uint32_t> header_words(const PinchmapTexture& t) {
    std::vector<std::uint32_t> words = {t.width,
                                        t.height,
                                        t.scale,
                                        static_cast<std::uint32_t>(t.map_format),
                                        static_cast<std::uint32_t>(t.sample_format),
                                        (pinchmap_is_open(t) ? kFlagOpen : 0) | (t.line_width != 0 ? kFlagLine : 0),
                                        t.line_color,
                                        t.line_width};
    words.resize(kHeaderWords, 0);
    return words;
}

std::optional<Finding> read_header(PinchmapTexture& out, std::uint32_t& flags, const ChunkView& chunk) {
    const auto bad = [&](std::size_t word, const char* message) {
        return Finding{FindingCode::BadPinchmapHeader, chunk.offset + word * 4, std::string("PNCH: ") + message};
    };
    const auto side = [](std::uint32_t v) { return v >= 1 && v <= kPinchmapMaxSide; };
    if (chunk.payload.size() != kHeaderWords * 4) return bad(0, "not 48 bytes");
    const std::vector<std::uint32_t> w = to_words(chunk.payload);
    if (!side(w[0]) || !side(w[1])) return bad(0, "width or height outside 1 … 16384");
    if (w[2] > kPinchmapMaxScale || (std::uint64_t{std::max(w[0], w[1])} << w[2]) > kPinchmapMaxSide)
        return bad(2, "sides of the signal outside 1 … 16384");
    if (w[3] > static_cast<std::uint32_t>(PinchmapFormat::Bits16)) return bad(3, "unknown map format");
    if (w[4] > static_cast<std::uint32_t>(PinchmapSampleFormat::Rgb8)) return bad(4, "unknown sample format");
    if ((w[5] & ~kFlagsKnown) != 0) return bad(5, "unknown flags");
    if (w[7] > kPinchmapLineUnit || ((w[5] & kFlagLine) != 0) != (w[7] != 0) || (w[7] == 0 && w[6] != 0))
        return bad(6, "colour and width of the line aren't those of one, or not what the flag says");
    for (std::size_t k = kHeaderWordsUsed; k < kHeaderWords; ++k)
        if (w[k] != 0) return bad(k, "reserved words aren't 0");
    out.width = w[0], out.height = w[1], out.scale = w[2];
    out.map_format = static_cast<PinchmapFormat>(w[3]);
    out.sample_format = static_cast<PinchmapSampleFormat>(w[4]);
    flags = w[5];
    out.line_color = w[6], out.line_width = w[7];
    return std::nullopt;
}

Finding wrong_length(const ChunkView& chunk) {
    return {FindingCode::PinchmapSizeMismatch, chunk.offset,
            fourcc_text(chunk.type) + ": wrong length for what PNCH says"};
}

/// PNCM: levels 1 … n, or none.
std::optional<Finding> read_mips(PinchmapTexture& out, const PinchmapChunks& chunks) {
    if (chunks.mips.empty()) return std::nullopt;
    const std::uint32_t width = pinchmap_signal_width(out), height = pinchmap_signal_height(out);
    const std::uint32_t levels = fbt_mip_levels(width, height);
    if (chunks.mips.begin()->first != 1 || chunks.mips.rbegin()->first != levels || chunks.mips.size() != levels)
        return Finding{FindingCode::MissingChunk, chunks.mips.begin()->second->offset,
                       "PNCM: its levels aren't 1 to " + std::to_string(levels)};
    for (const auto& [k, chunk] : chunks.mips)
        if (chunk->payload.size() != 4 * fbt_mip_level(width, height, k).samples()) return wrong_length(*chunk);
    for (const auto& [k, chunk] : chunks.mips) {
        const std::vector<std::uint32_t> samples = to_words(chunk->payload);
        out.mips.insert(out.mips.end(), samples.begin(), samples.end());
    }
    return std::nullopt;
}

std::optional<Finding> read_parts(PinchmapTexture& out, const PinchmapChunks& chunks) {
    std::uint32_t flags = 0;
    if (auto bad = read_header(out, flags, *chunks.header)) return bad;
    const std::uint64_t texels = std::uint64_t{pinchmap_columns(out)} * pinchmap_rows(out);
    if (chunks.map->payload.size() != texels * 4 * pinchmap_words(out.map_format)) return wrong_length(*chunks.map);
    const std::uint64_t samples = std::uint64_t{pinchmap_signal_width(out)} * pinchmap_signal_height(out);
    if (chunks.signal->payload.size() != samples * bitmap_sample_bytes(out.sample_format))
        return wrong_length(*chunks.signal);
    out.map = to_words(chunks.map->payload);
    const ByteSpan colors = chunks.signal->payload;
    out.signal = out.sample_format == PinchmapSampleFormat::Rgb8 ? with_alpha(colors) : to_words(colors);
    if (pinchmap_is_open(out) != ((flags & kFlagOpen) != 0))
        return Finding{FindingCode::BadPinchmapHeader, chunks.header->offset + 20,
                       "PNCH: strengths below 1 aren't what the flag says"};
    return read_mips(out, chunks);
}

/// Where a byte of PinchmapTexture::mips lies in the file.
std::uint64_t mip_offset(const PinchmapChunks& chunks, std::uint64_t offset) {
    for (const auto& [k, chunk] : chunks.mips) {
        if (offset < chunk->payload.size()) return chunk->offset + offset;
        offset -= chunk->payload.size();
    }
    return offset;
}

} // namespace

void PinchmapChunks::add(const ChunkView& chunk) {
    if (chunk.type == kMips)
        mips[chunk.level] = &chunk;
    else
        (chunk.type == kHeader ? header : chunk.type == kMap ? map : signal) = &chunk;
}

bool is_pinchmap_chunk(const ChunkView& chunk) {
    if (chunk.representation == kWholeFile) return false;
    return chunk.type == kMips ||
           (chunk.level == 0 && (chunk.type == kHeader || chunk.type == kMap || chunk.type == kSignal));
}

void append_pinchmap_chunks(std::vector<ChunkView>& chunks, const PinchmapTexture& texture, std::uint8_t representation,
                            bool critical, Payloads& payloads) {
    const auto append = [&](FourCc type, std::uint16_t flags, std::uint32_t level, ByteSpan payload) {
        chunks.push_back({type, flags, representation, static_cast<std::uint8_t>(level), 0, payload});
    };
    const std::uint16_t flags = critical ? kChunkCritical : 0;
    append(kHeader, flags, 0, payloads.emplace_back(to_bytes(header_words(texture))));
    append(kMap, flags, 0, as_bytes(texture.map, payloads));
    append(kSignal, flags, 0,
           texture.sample_format == PinchmapSampleFormat::Rgb8 ? payloads.emplace_back(without_alpha(texture.signal))
                                                               : as_bytes(texture.signal, payloads));
    const std::uint32_t width = pinchmap_signal_width(texture), height = pinchmap_signal_height(texture);
    for (std::uint32_t k = 1; !texture.mips.empty() && k <= fbt_mip_levels(width, height); ++k) {
        const FbtMipLevel level = fbt_mip_level(width, height, k);
        append(kMips, 0, k, as_bytes(std::span(texture.mips).subspan(level.first, level.samples()), payloads));
    }
}

std::vector<Finding> read_pinchmap(PinchmapTexture& out, const PinchmapChunks& chunks, std::size_t limit) {
    if (auto bad = read_parts(out, chunks)) return {std::move(*bad)};
    std::vector<Finding> findings = validate_pinchmap(out, limit);
    for (Finding& finding : findings) {
        const auto in = [&](const char* part) { return finding.message.starts_with(part); };
        finding.offset = in("mips") ? mip_offset(chunks, finding.offset)
                                    : finding.offset + (in("map")      ? chunks.map
                                                        : in("signal") ? chunks.signal
                                                                       : chunks.header)
                                                           ->offset;
    }
    return findings;
}

} // namespace fetex
