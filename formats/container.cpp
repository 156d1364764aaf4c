// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/container.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>

#include "formats/crc32c.h"

namespace fetex {
namespace {

/// High bit against 7-bit transfers, CR LF and LF against newline conversion, 0x1a against `type` (as PNG and KTX2).
constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'F', 'T', 'X', 0x0d, 0x0a, 0x1a, 0x0a};

// Offsets in the header (SPEC §1.1) and in an entry of the chunk table (SPEC §1.2).
constexpr std::size_t kAtVersion = 8, kAtChunkCount = 12, kAtLength = 16, kAtTableCrc = 24, kAtHeaderCrc = 28;
constexpr std::size_t kAtFlags = 4, kAtRepresentation = 6, kAtLevel = 7, kAtOffset = 8, kAtSize = 16, kAtCrc = 24,
                      kAtReserved = 28;

constexpr std::uint64_t align_up(std::uint64_t v) { return (v + (kChunkAlignment - 1)) & ~(kChunkAlignment - 1); }

Finding finding(FindingCode code, std::uint64_t offset, std::string message) {
    return {code, offset, std::move(message)};
}

bool valid_type(FourCc type) {
    for (int k = 0; k < 4; ++k) {
        const std::uint32_t c = type >> (8 * k) & 0xffu;
        if (!((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) return false;
    }
    return true;
}

auto identity(const ChunkView& chunk) { return std::tuple(chunk.type, chunk.representation, chunk.level); }

std::optional<Finding> check_header(ByteSpan bytes) {
    const std::size_t known = std::min(bytes.size(), kMagic.size());
    if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(known), kMagic.begin()))
        return finding(FindingCode::BadMagic, 0, "not a .fetex file, or mangled by a text-mode transfer");
    if (bytes.size() < kHeaderBytes)
        return finding(FindingCode::Truncated, bytes.size(), "the file ends inside its header");
    if (load_le<std::uint16_t>(bytes, kAtVersion) != kVersionMajor)
        return finding(FindingCode::UnsupportedVersion, kAtVersion,
                       "major version " + std::to_string(load_le<std::uint16_t>(bytes, kAtVersion)) +
                           ", this reader knows " + std::to_string(kVersionMajor));
    if (load_le<std::uint32_t>(bytes, kAtHeaderCrc) != crc32c(bytes.first(kAtHeaderCrc)))
        return finding(FindingCode::BadHeaderChecksum, kAtHeaderCrc, "the header is damaged");
    const std::uint64_t length = load_le<std::uint64_t>(bytes, kAtLength);
    if (bytes.size() < length)
        return finding(FindingCode::Truncated, bytes.size(),
                       "the file should have " + std::to_string(length) + " bytes, it has " +
                           std::to_string(bytes.size()));
    if (bytes.size() > length)
        return finding(FindingCode::ExtraBytes, length,
                       std::to_string(bytes.size() - length) + " bytes after the end of the file");
    return std::nullopt;
}

std::optional<Finding> check_table(ByteSpan bytes) {
    const std::uint32_t count = load_le<std::uint32_t>(bytes, kAtChunkCount);
    if (count > kMaxChunks || kHeaderBytes + std::uint64_t{count} * kChunkEntryBytes > bytes.size())
        return finding(FindingCode::TooManyChunks, kAtChunkCount,
                       std::to_string(count) + " chunks: beyond the limit or the file");
    const ByteSpan table = bytes.subspan(kHeaderBytes, std::size_t{count} * kChunkEntryBytes);
    if (load_le<std::uint32_t>(bytes, kAtTableCrc) != crc32c(table))
        return finding(FindingCode::BadTableChecksum, kAtTableCrc, "the chunk table is damaged");
    return std::nullopt;
}

/// Reads one table entry whose chunk must start after `end`, the end of the one before; moves `end` behind it.
std::optional<Finding> read_chunk(ChunkView& chunk, ByteSpan bytes, std::size_t entry, std::uint64_t& end) {
    chunk.type = load_le<std::uint32_t>(bytes, entry);
    chunk.flags = load_le<std::uint16_t>(bytes, entry + kAtFlags);
    chunk.representation = bytes[entry + kAtRepresentation];
    chunk.level = bytes[entry + kAtLevel];
    chunk.offset = load_le<std::uint64_t>(bytes, entry + kAtOffset);
    const std::uint64_t size = load_le<std::uint64_t>(bytes, entry + kAtSize);
    if (!valid_type(chunk.type)) return finding(FindingCode::BadChunkType, entry, "chunk type isn't of A-Z, 0-9");
    const std::string name = "chunk " + fourcc_text(chunk.type);
    if ((chunk.flags & ~kChunkCritical) != 0 || load_le<std::uint32_t>(bytes, entry + kAtReserved) != 0)
        return finding(FindingCode::ReservedNotZero, entry, name + ": reserved bits of its table entry are set");
    if (chunk.offset != align_up(end))
        return finding(FindingCode::BadChunkOffset, entry + kAtOffset,
                       name + " must start at " + std::to_string(align_up(end)) + ", not at " +
                           std::to_string(chunk.offset));
    if (chunk.offset > bytes.size() || size > bytes.size() - chunk.offset)
        return finding(FindingCode::BadChunkSize, entry + kAtSize, name + " reaches beyond the end of the file");
    for (std::uint64_t at = end; at < chunk.offset; ++at)
        if (bytes[at] != 0) return finding(FindingCode::PaddingNotZero, at, "padding before " + name + " isn't 0");
    chunk.payload = bytes.subspan(static_cast<std::size_t>(chunk.offset), static_cast<std::size_t>(size));
    if (load_le<std::uint32_t>(bytes, entry + kAtCrc) != crc32c(chunk.payload))
        return finding(FindingCode::BadChunkChecksum, chunk.offset, name + " is damaged");
    end = chunk.offset + size;
    return std::nullopt;
}

std::optional<Finding> check_duplicates(const ContainerView& container) {
    std::vector<ChunkView> sorted = container.chunks;
    std::sort(sorted.begin(), sorted.end(),
              [](const ChunkView& a, const ChunkView& b) { return identity(a) < identity(b); });
    const auto twin = std::adjacent_find(sorted.begin(), sorted.end(), [](const ChunkView& a, const ChunkView& b) {
        return identity(a) == identity(b);
    });
    if (twin == sorted.end()) return std::nullopt;
    return finding(FindingCode::DuplicateChunk, twin->offset, "chunk " + fourcc_text(twin->type) + " is there twice");
}

template <class T> void store_le(std::vector<std::uint8_t>& out, std::size_t at, T value) {
    for (std::size_t k = 0; k < sizeof(T); ++k)
        out[at + k] = static_cast<std::uint8_t>(value >> (8 * k));
}

void store_entry(std::vector<std::uint8_t>& out, std::size_t entry, const ChunkView& chunk, std::uint64_t offset) {
    store_le(out, entry, chunk.type);
    store_le(out, entry + kAtFlags, chunk.flags);
    store_le(out, entry + kAtRepresentation, chunk.representation);
    store_le(out, entry + kAtLevel, chunk.level);
    store_le(out, entry + kAtOffset, offset);
    store_le(out, entry + kAtSize, static_cast<std::uint64_t>(chunk.payload.size()));
    store_le(out, entry + kAtCrc, crc32c(chunk.payload));
}

} // namespace

std::string fourcc_text(FourCc code) {
    std::string text;
    for (int k = 0; k < 4; ++k)
        text += static_cast<char>(code >> (8 * k) & 0xffu);
    return text;
}

std::string finding_id(FindingCode code) {
    char text[8];
    std::snprintf(text, sizeof text, "F%04u", static_cast<unsigned>(code) % 10000u);
    return text;
}

std::vector<std::uint8_t> write_container(const std::vector<Chunk>& chunks) {
    std::vector<ChunkView> views;
    for (const Chunk& c : chunks)
        views.push_back({c.type, c.flags, c.representation, c.level, 0, c.payload});
    return write_container_of_views(views);
}

std::vector<std::uint8_t> write_container_of_views(std::span<const ChunkView> chunks) {
    const std::size_t table_end = kHeaderBytes + chunks.size() * kChunkEntryBytes;
    std::uint64_t length = table_end;
    for (const ChunkView& chunk : chunks)
        length = align_up(length) + chunk.payload.size();

    std::vector<std::uint8_t> out;
    out.reserve(static_cast<std::size_t>(length));
    out.resize(table_end, 0);
    std::copy(kMagic.begin(), kMagic.end(), out.begin());
    store_le(out, kAtVersion, kVersionMajor);
    store_le(out, kAtVersion + 2, kVersionMinor);
    store_le(out, kAtChunkCount, static_cast<std::uint32_t>(chunks.size()));
    store_le(out, kAtLength, length);
    std::size_t entry = kHeaderBytes;
    for (const ChunkView& chunk : chunks) {
        out.resize(static_cast<std::size_t>(align_up(out.size())), 0);
        store_entry(out, entry, chunk, out.size());
        out.insert(out.end(), chunk.payload.begin(), chunk.payload.end());
        entry += kChunkEntryBytes;
    }
    store_le(out, kAtTableCrc, crc32c(ByteSpan(out).subspan(kHeaderBytes, table_end - kHeaderBytes)));
    store_le(out, kAtHeaderCrc, crc32c(ByteSpan(out).first(kAtHeaderCrc)));
    return out;
}

std::optional<Finding> read_container(ContainerView& out, ByteSpan bytes) {
    out = {};
    if (auto bad = check_header(bytes)) return bad;
    if (auto bad = check_table(bytes)) return bad;
    ContainerView container;
    container.version_major = load_le<std::uint16_t>(bytes, kAtVersion);
    container.version_minor = load_le<std::uint16_t>(bytes, kAtVersion + 2);
    container.chunks.resize(load_le<std::uint32_t>(bytes, kAtChunkCount));
    std::size_t entry = kHeaderBytes;
    std::uint64_t end = kHeaderBytes + container.chunks.size() * kChunkEntryBytes;
    for (ChunkView& chunk : container.chunks) {
        if (auto bad = read_chunk(chunk, bytes, entry, end)) return bad;
        entry += kChunkEntryBytes;
    }
    if (end != bytes.size())
        return finding(FindingCode::BadLength, kAtLength, "the stated length isn't the end of the last chunk");
    if (auto bad = check_duplicates(container)) return bad;
    out = std::move(container);
    return std::nullopt;
}

} // namespace fetex
