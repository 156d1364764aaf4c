// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/silmap_chunks.h"

#include <algorithm>
#include <optional>
#include <string>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

constexpr FourCc kHeader = fourcc("SLMH"), kCells = fourcc("SLMC"), kSamples = fourcc("SLMS"), kMips = fourcc("SLMM");
constexpr std::size_t kHeaderWords = 8, kHeaderWordsUsed = 4; ///< SPEC §2.5

std::vector<std::uint32_t> header_words(const SilmapTexture& t) {
    std::vector<std::uint32_t> words = {t.width, t.height, static_cast<std::uint32_t>(t.cell_format),
                                        static_cast<std::uint32_t>(t.sample_format)};
    words.resize(kHeaderWords, 0);
    return words;
}

std::size_t cell_bytes(SilmapCellFormat format) { return format == SilmapCellFormat::Bits8 ? 1 : 2; }

std::vector<std::uint8_t> packed_cells(const SilmapTexture& t) {
    if (t.cell_format == SilmapCellFormat::Bits8) return {t.cells.begin(), t.cells.end()};
    std::vector<std::uint8_t> out;
    out.reserve(2 * t.cells.size());
    for (const std::uint16_t cell : t.cells)
        append_le(out, cell);
    return out;
}

std::vector<std::uint16_t> unpacked_cells(ByteSpan bytes, SilmapCellFormat format) {
    if (format == SilmapCellFormat::Bits8) return {bytes.begin(), bytes.end()};
    std::vector<std::uint16_t> out(bytes.size() / 2);
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = load_le<std::uint16_t>(bytes, 2 * k);
    return out;
}

std::optional<Finding> read_header(SilmapTexture& out, const ChunkView& chunk) {
    const auto bad = [&](std::size_t word, const char* message) {
        return Finding{FindingCode::BadSilmapHeader, chunk.offset + word * 4, std::string("SLMH: ") + message};
    };
    const auto side = [](std::uint32_t v) { return v >= 1 && v <= kSilmapMaxSide; };
    if (chunk.payload.size() != kHeaderWords * 4) return bad(0, "not 32 bytes");
    const std::vector<std::uint32_t> w = to_words(chunk.payload);
    if (!side(w[0]) || !side(w[1])) return bad(0, "width or height outside 1 … 16384");
    if (w[2] > static_cast<std::uint32_t>(SilmapCellFormat::Bits16)) return bad(2, "unknown cell format");
    if (w[3] > static_cast<std::uint32_t>(SilmapSampleFormat::Rgb8)) return bad(3, "unknown sample format");
    for (std::size_t k = kHeaderWordsUsed; k < kHeaderWords; ++k)
        if (w[k] != 0) return bad(k, "reserved words aren't 0");
    out.width = w[0], out.height = w[1];
    out.cell_format = static_cast<SilmapCellFormat>(w[2]);
    out.sample_format = static_cast<SilmapSampleFormat>(w[3]);
    return std::nullopt;
}

Finding wrong_length(const ChunkView& chunk) {
    return {FindingCode::SilmapSizeMismatch, chunk.offset,
            fourcc_text(chunk.type) + ": wrong length for what SLMH says"};
}

/// SLMM: levels 1 … n, or none.
std::optional<Finding> read_mips(SilmapTexture& out, const SilmapChunks& chunks) {
    if (chunks.mips.empty()) return std::nullopt;
    const std::uint32_t levels = fbt_mip_levels(out.width, out.height);
    if (chunks.mips.begin()->first != 1 || chunks.mips.rbegin()->first != levels || chunks.mips.size() != levels)
        return Finding{FindingCode::MissingChunk, chunks.mips.begin()->second->offset,
                       "SLMM: its levels aren't 1 to " + std::to_string(levels)};
    for (const auto& [k, chunk] : chunks.mips)
        if (chunk->payload.size() != 4 * fbt_mip_level(out.width, out.height, k).samples()) return wrong_length(*chunk);
    for (const auto& [k, chunk] : chunks.mips) {
        const std::vector<std::uint32_t> samples = to_words(chunk->payload);
        out.mips.insert(out.mips.end(), samples.begin(), samples.end());
    }
    return std::nullopt;
}

std::optional<Finding> read_parts(SilmapTexture& out, const SilmapChunks& chunks) {
    if (auto bad = read_header(out, *chunks.header)) return bad;
    const std::uint64_t cells = std::uint64_t{silmap_columns(out)} * silmap_rows(out);
    if (chunks.cells->payload.size() != cells * cell_bytes(out.cell_format)) return wrong_length(*chunks.cells);
    const std::uint64_t samples = std::uint64_t{out.width} * out.height;
    if (chunks.samples->payload.size() != samples * bitmap_sample_bytes(out.sample_format))
        return wrong_length(*chunks.samples);
    out.cells = unpacked_cells(chunks.cells->payload, out.cell_format);
    const ByteSpan colors = chunks.samples->payload;
    out.colors = out.sample_format == SilmapSampleFormat::Rgb8 ? with_alpha(colors) : to_words(colors);
    return read_mips(out, chunks);
}

/// Where a byte of SilmapTexture::mips lies in the file.
std::uint64_t mip_offset(const SilmapChunks& chunks, std::uint64_t offset) {
    for (const auto& [k, chunk] : chunks.mips) {
        if (offset < chunk->payload.size()) return chunk->offset + offset;
        offset -= chunk->payload.size();
    }
    return offset;
}

} // namespace

void SilmapChunks::add(const ChunkView& chunk) {
    if (chunk.type == kMips)
        mips[chunk.level] = &chunk;
    else
        (chunk.type == kHeader ? header : chunk.type == kCells ? cells : samples) = &chunk;
}

bool is_silmap_chunk(const ChunkView& chunk) {
    if (chunk.representation == kWholeFile) return false;
    return chunk.type == kMips ||
           (chunk.level == 0 && (chunk.type == kHeader || chunk.type == kCells || chunk.type == kSamples));
}

void append_silmap_chunks(std::vector<ChunkView>& chunks, const SilmapTexture& texture, std::uint8_t representation,
                          bool critical, Payloads& payloads) {
    const auto append = [&](FourCc type, std::uint16_t flags, std::uint32_t level, ByteSpan payload) {
        chunks.push_back({type, flags, representation, static_cast<std::uint8_t>(level), 0, payload});
    };
    const std::uint16_t flags = critical ? kChunkCritical : 0;
    append(kHeader, flags, 0, payloads.emplace_back(to_bytes(header_words(texture))));
    append(kCells, flags, 0, payloads.emplace_back(packed_cells(texture)));
    append(kSamples, flags, 0,
           texture.sample_format == SilmapSampleFormat::Rgb8 ? payloads.emplace_back(without_alpha(texture.colors))
                                                             : as_bytes(texture.colors, payloads));
    for (std::uint32_t k = 1; !texture.mips.empty() && k <= fbt_mip_levels(texture.width, texture.height); ++k) {
        const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
        append(kMips, 0, k, as_bytes(std::span(texture.mips).subspan(level.first, level.samples()), payloads));
    }
}

std::vector<Finding> read_silmap(SilmapTexture& out, const SilmapChunks& chunks, std::size_t limit) {
    if (auto bad = read_parts(out, chunks)) return {std::move(*bad)};
    std::vector<Finding> findings = validate_silmap(out, limit);
    for (Finding& finding : findings)
        finding.offset = finding.message.starts_with("mips") ? mip_offset(chunks, finding.offset)
                                                             : finding.offset + chunks.samples->offset;
    return findings;
}

} // namespace fetex
