// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/fetex_file.h"

#include "formats/bilevel_chunks.h"
#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/feature_curve_chunks.h"
#include "formats/pinchmap_chunks.h"
#include "formats/silmap_chunks.h"
#include "formats/validate.h"
#include <algorithm>

namespace fetex {
namespace {

constexpr FourCc kMeta = fourcc("META"), kFbtHeader = fourcc("FBTH"), kFbtTexels = fourcc("FBTT"),
                 kFbtCorners = fourcc("FBTC"), kFbtRecords = fourcc("FBTR"), kFbtMips = fourcc("FBTM");
constexpr std::size_t kFbtHeaderWords = 16; ///< SPEC §2.2
constexpr std::uint32_t kFlagBands = 1, kFlagCorners = 2, kFlagTranslucent = 4, kFlagPatches = 8, kFlagShared = 16,
                        kFlagsKnown = 31;
/// As write_file numbers them.
constexpr std::uint8_t kFbtRepresentation = 0, kBilevelRepresentation = 1, kSilmapRepresentation = 2,
                       kPinchmapRepresentation = 3, kFeatureCurvesRepresentation = 4;

using Words = std::vector<std::uint32_t>;

/// Length of the UTF-8 sequence at `at`, 0 if there is none: no overlong forms, surrogates or values past U+10FFFF.
std::size_t utf8_length(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
        return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0u;
    };
    const auto tail = [&](std::size_t k) { return (byte(k) & 0xc0u) == 0x80u; };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return 1;
    if (lead >= 0xc2 && lead < 0xe0) return tail(1) ? 2 : 0;
    if (lead >= 0xe0 && lead < 0xf0) {
        const std::uint32_t low = lead == 0xe0 ? 0xa0 : 0x80, high = lead == 0xed ? 0x9f : 0xbf;
        return byte(1) >= low && byte(1) <= high && tail(2) ? 3 : 0;
    }
    if (lead >= 0xf0 && lead < 0xf5) {
        const std::uint32_t low = lead == 0xf0 ? 0x90 : 0x80, high = lead == 0xf4 ? 0x8f : 0xbf;
        return byte(1) >= low && byte(1) <= high && tail(2) && tail(3) ? 4 : 0;
    }
    return 0;
}

bool is_utf8(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text, at);
        if (length == 0) return false;
        at += length;
    }
    return true;
}

std::vector<std::uint8_t> write_metadata(const Metadata& metadata) {
    Metadata clean;
    for (const auto& [key, value] : metadata)
        if (!key.empty()) clean.emplace(to_valid_utf8(key), to_valid_utf8(value));
    std::vector<std::uint8_t> out;
    append_le(out, static_cast<std::uint32_t>(clean.size()));
    for (const auto& [key, value] : clean) {
        append_le(out, static_cast<std::uint32_t>(key.size()));
        append_le(out, static_cast<std::uint32_t>(value.size()));
        out.insert(out.end(), key.begin(), key.end());
        out.insert(out.end(), value.begin(), value.end());
    }
    return out;
}

Finding bad_metadata(const ChunkView& chunk, std::size_t at, const char* message) {
    return {FindingCode::BadMetadata, chunk.offset + at, std::string("META: ") + message};
}

std::optional<Finding> read_metadata(Metadata& out, const ChunkView& chunk) {
    const ByteSpan bytes = chunk.payload;
    if (bytes.size() < 4) return bad_metadata(chunk, 0, "no room for the count");
    const std::uint32_t count = load_le<std::uint32_t>(bytes, 0);
    std::size_t at = 4;
    std::string previous; // keys aren't empty, so any first key is greater
    for (std::uint32_t k = 0; k < count; ++k) {
        if (bytes.size() - at < 8) return bad_metadata(chunk, at, "fewer entries than counted");
        const std::uint64_t key_size = load_le<std::uint32_t>(bytes, at);
        const std::uint64_t value_size = load_le<std::uint32_t>(bytes, at + 4);
        at += 8;
        if (key_size + value_size > bytes.size() - at) return bad_metadata(chunk, at, "an entry leaves the chunk");
        const auto* text = reinterpret_cast<const char*>(bytes.data()) + at;
        std::string key(text, static_cast<std::size_t>(key_size));
        std::string value(text + key_size, static_cast<std::size_t>(value_size));
        if (!is_utf8(key) || !is_utf8(value)) return bad_metadata(chunk, at, "not UTF-8");
        if (key <= previous) return bad_metadata(chunk, at, "keys are empty, repeated or not sorted");
        at += static_cast<std::size_t>(key_size + value_size);
        previous = key;
        out.emplace(std::move(key), std::move(value));
    }
    if (at != bytes.size()) return bad_metadata(chunk, at, "bytes after the last entry");
    return std::nullopt;
}

Words fbt_header_words(const FbtTexture& t) {
    Words words = {t.width,
                   t.height,
                   static_cast<std::uint32_t>(t.sample_format),
                   t.traits.max_degree,
                   t.traits.degrees,
                   (t.traits.bands ? kFlagBands : 0) | (t.traits.corners ? kFlagCorners : 0) |
                       (t.traits.translucent ? kFlagTranslucent : 0) | (t.traits.patches ? kFlagPatches : 0) |
                       (t.traits.shared ? kFlagShared : 0),
                   t.traits.directions,
                   t.traits.max_entries,
                   t.traits.max_bands,
                   static_cast<std::uint32_t>(t.records.size() / 4),
                   t.traits.max_depth};
    words.resize(kFbtHeaderWords, 0);
    return words;
}

void append_fbt_chunks(std::vector<ChunkView>& chunks, const FbtTexture& texture, std::uint8_t representation,
                       Payloads& payloads) {
    const auto append = [&](FourCc type, ByteSpan payload) {
        chunks.push_back({type, kChunkCritical, representation, 0, 0, payload});
    };
    append(kFbtHeader, payloads.emplace_back(to_bytes(fbt_header_words(texture))));
    append(kFbtTexels, as_bytes(texture.texels, payloads));
    if (texture.traits.corners) append(kFbtCorners, as_bytes(texture.corners, payloads));
    append(kFbtRecords, as_bytes(texture.records, payloads));
    for (std::uint32_t k = 1; !texture.mips.empty() && k <= fbt_mip_levels(texture.width, texture.height); ++k) {
        const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
        const auto samples = std::span(texture.mips).subspan(level.first, level.samples());
        chunks.push_back({kFbtMips, 0, representation, static_cast<std::uint8_t>(k), 0, as_bytes(samples, payloads)});
    }
}

/// The chunks of one FBT.
struct FbtChunks {
    const ChunkView* header = nullptr;
    const ChunkView* texels = nullptr;
    const ChunkView* corners = nullptr;
    const ChunkView* records = nullptr;
    std::map<std::uint8_t, const ChunkView*> mips; ///< by level
};

/// FBTH: dimensions and traits; `records` gets the stated count.
std::optional<Finding> read_fbt_header(FbtTexture& out, std::uint32_t& records, const ChunkView& chunk) {
    const auto bad = [&](std::size_t word, const char* message) {
        return Finding{FindingCode::BadFbtHeader, chunk.offset + word * 4, std::string("FBTH: ") + message};
    };
    if (chunk.payload.size() != kFbtHeaderWords * 4) return bad(0, "not 64 bytes");
    const Words w = to_words(chunk.payload);
    out.width = w[0];
    out.height = w[1];
    if (out.width < 1 || out.width > kFbtMaxSide || out.height < 1 || out.height > kFbtMaxSide)
        return bad(0, "width or height outside 1 … 16384");
    if (w[2] > static_cast<std::uint32_t>(FbtSampleFormat::Rgba16F)) return bad(2, "unknown sample format");
    out.sample_format = static_cast<FbtSampleFormat>(w[2]);
    if ((w[5] & ~kFlagsKnown) != 0) return bad(5, "unknown flags");
    out.traits.max_degree = w[3];
    out.traits.degrees = w[4];
    out.traits.bands = (w[5] & kFlagBands) != 0;
    out.traits.corners = (w[5] & kFlagCorners) != 0;
    out.traits.patches = (w[5] & kFlagPatches) != 0;
    out.traits.shared = (w[5] & kFlagShared) != 0;
    out.traits.translucent = (w[5] & kFlagTranslucent) != 0;
    out.traits.directions = w[6];
    out.traits.max_entries = w[7];
    out.traits.max_bands = w[8];
    records = w[9];
    out.traits.max_depth = w[10];
    for (std::size_t k = 11; k < kFbtHeaderWords; ++k)
        if (w[k] != 0) return bad(k, "reserved words aren't 0");
    return std::nullopt;
}

bool wrong_length(const ChunkView& chunk, std::uint64_t words) { return chunk.payload.size() != words * 4; }

/// FBTM: levels 1 … n, or none.
std::optional<Finding> read_mips(FbtTexture& out, const FbtChunks& chunks) {
    if (chunks.mips.empty()) return std::nullopt;
    const std::uint32_t levels = fbt_mip_levels(out.width, out.height);
    if (chunks.mips.begin()->first != 1 || chunks.mips.rbegin()->first != levels || chunks.mips.size() != levels)
        return Finding{FindingCode::MissingChunk, chunks.mips.begin()->second->offset,
                       "FBTM: its levels aren't 1 to " + std::to_string(levels)};
    for (const auto& [k, chunk] : chunks.mips) {
        if (wrong_length(*chunk, fbt_mip_level(out.width, out.height, k).samples()))
            return Finding{FindingCode::FbtSizeMismatch, chunk->offset, "FBTM: wrong length for the level"};
    }
    for (const auto& [k, chunk] : chunks.mips) {
        const Words samples = to_words(chunk->payload);
        out.mips.insert(out.mips.end(), samples.begin(), samples.end());
    }
    return std::nullopt;
}

std::optional<Finding> read_fbt(FbtTexture& out, const FbtChunks& chunks) {
    std::uint32_t records = 0;
    if (auto bad = read_fbt_header(out, records, *chunks.header)) return bad;
    if (wrong_length(*chunks.texels, std::uint64_t{out.width} * out.height))
        return Finding{FindingCode::FbtSizeMismatch, chunks.texels->offset, "FBTT: wrong length for the dimensions"};
    if ((chunks.corners != nullptr) != out.traits.corners)
        return Finding{FindingCode::MissingChunk, chunks.header->offset,
                       "FBTC is there, and not needed, or the other way round"};
    const std::uint64_t corners = (std::uint64_t{out.width} + 1) * (out.height + 1);
    if (chunks.corners && wrong_length(*chunks.corners, corners * fbt_sample_words(out.sample_format)))
        return Finding{FindingCode::FbtSizeMismatch, chunks.corners->offset, "FBTC: wrong length for the dimensions"};
    if (wrong_length(*chunks.records, std::uint64_t{records} * 4))
        return Finding{FindingCode::FbtSizeMismatch, chunks.records->offset, "FBTR: wrong length for the record count"};
    out.texels = to_words(chunks.texels->payload);
    if (chunks.corners) out.corners = to_words(chunks.corners->payload);
    out.records = to_words(chunks.records->payload);
    return read_mips(out, chunks);
}

/// Where a byte of FbtTexture::mips lies in the file.
std::uint64_t mip_offset(const FbtChunks& chunks, std::uint64_t offset) {
    for (const auto& [k, chunk] : chunks.mips) {
        if (offset < chunk->payload.size()) return chunk->offset + offset;
        offset -= chunk->payload.size();
    }
    return offset;
}

/// validate_fbt counts offsets within a part; this moves them to the file.
void to_file_offsets(std::vector<Finding>& findings, const FbtChunks& chunks) {
    for (Finding& finding : findings) {
        const auto in = [&](const char* part) { return finding.message.starts_with(part); };
        if (in("mips")) {
            finding.offset = mip_offset(chunks, finding.offset);
            continue;
        }
        finding.offset += (in("texels")    ? chunks.texels
                           : in("corners") ? chunks.corners
                           : in("records") ? chunks.records
                                           : chunks.header)
                              ->offset;
    }
}

/// Everything a reader does, up to `limit` findings. `out` is complete if there are none.
class Reader {
  public:
    Reader(FetexFile& out, std::size_t limit) : out_(out), limit_(limit) {}

    void read(ByteSpan bytes) {
        ContainerView container;
        if (auto bad = read_container(container, bytes)) return findings_.push_back(std::move(*bad));
        for (const ChunkView& chunk : container.chunks)
            if (auto bad = sort_in(chunk)) return findings_.push_back(std::move(*bad));
        if (metadata_)
            if (auto bad = read_metadata(out_.metadata, *metadata_)) return findings_.push_back(std::move(*bad));
        check_numbers();
        if (findings_.empty()) read_fbt_chunks();
        if (findings_.size() < limit_) read_bilevel_chunks();
        if (findings_.size() < limit_) read_silmap_chunks();
        if (findings_.size() < limit_) read_pinchmap_chunks();
        if (findings_.size() < limit_) read_feature_curves_chunks();
    }
    std::vector<Finding> take() { return std::move(findings_); }

  private:
    /// Level 0 of the known chunks, and any of FBTM, BLVM, SLMM, PNCM and FCVM; of each kind the representation of the
    /// lowest number is the one that is read.
    std::optional<Finding> sort_in(const ChunkView& chunk) {
        const bool fbt = chunk.type == kFbtHeader || chunk.type == kFbtTexels || chunk.type == kFbtCorners ||
                         chunk.type == kFbtRecords;
        if (chunk.type == kMeta && chunk.representation == kWholeFile && chunk.level == 0) {
            metadata_ = &chunk;
        } else if (fbt && chunk.representation != kWholeFile && chunk.level == 0) {
            FbtChunks& group = fbts_[chunk.representation];
            (chunk.type == kFbtHeader    ? group.header
             : chunk.type == kFbtTexels  ? group.texels
             : chunk.type == kFbtCorners ? group.corners
                                         : group.records) = &chunk;
        } else if (chunk.type == kFbtMips && chunk.representation != kWholeFile) {
            fbts_[chunk.representation].mips[chunk.level] = &chunk;
        } else if (is_bilevel_chunk(chunk)) {
            bilevels_[chunk.representation].add(chunk);
        } else if (is_silmap_chunk(chunk)) {
            silmaps_[chunk.representation].add(chunk);
        } else if (is_pinchmap_chunk(chunk)) {
            pinchmaps_[chunk.representation].add(chunk);
        } else if (is_feature_curves_chunk(chunk)) {
            feature_curves_[chunk.representation].add(chunk);
        } else if ((chunk.flags & kChunkCritical) != 0) {
            return Finding{FindingCode::UnknownCriticalChunk, chunk.offset,
                           "chunk " + fourcc_text(chunk.type) + " is critical and this reader doesn't know it"};
        }
        return std::nullopt;
    }

    void read_fbt_chunks() {
        for (const auto& [representation, chunks] : fbts_) {
            if (!chunks.header || !chunks.texels || !chunks.records)
                return findings_.push_back(
                    {FindingCode::MissingChunk, 0,
                     "representation " + std::to_string(representation) + ": an FBT needs FBTH, FBTT and FBTR"});
        }
        if (fbts_.empty()) return;
        const FbtChunks& chunks = fbts_.begin()->second;
        FbtTexture texture;
        if (auto bad = read_fbt(texture, chunks)) return findings_.push_back(std::move(*bad));
        findings_ = validate_fbt(texture, limit_);
        to_file_offsets(findings_, chunks);
        if (findings_.empty()) out_.fbt = std::move(texture);
    }

    /// A number is of one representation.
    void check_numbers() {
        const auto report = [&](std::uint8_t representation, const char* kinds) {
            findings_.push_back({FindingCode::RepresentationKinds, 0,
                                 "representation " + std::to_string(representation) + " is " + kinds + " at once"});
        };
        for (const auto& [number, chunks] : bilevels_)
            if (fbts_.contains(number)) return report(number, "an FBT and a bi-level texture");
        for (const auto& [number, chunks] : silmaps_) {
            if (fbts_.contains(number)) return report(number, "an FBT and a silhouette-map texture");
            if (bilevels_.contains(number)) return report(number, "a bi-level and a silhouette-map texture");
        }
        for (const auto& [number, chunks] : pinchmaps_)
            if (fbts_.contains(number) || bilevels_.contains(number) || silmaps_.contains(number))
                return report(number, "a pinchmap and something else");
        for (const auto& [number, chunks] : feature_curves_)
            if (fbts_.contains(number) || bilevels_.contains(number) || silmaps_.contains(number) ||
                pinchmaps_.contains(number))
                return report(number, "a texture with feature curves and something else");
    }

    void read_bilevel_chunks() {
        for (const auto& [representation, chunks] : bilevels_) {
            if (!chunks.header || !chunks.texels)
                return findings_.push_back(
                    {FindingCode::MissingChunk, 0,
                     "representation " + std::to_string(representation) + ": a bi-level texture needs BLVH and BLVT"});
        }
        if (bilevels_.empty()) return;
        BilevelTexture texture;
        std::vector<Finding> found = read_bilevel(texture, bilevels_.begin()->second, limit_ - findings_.size());
        if (found.empty()) out_.bilevel = std::move(texture);
        add(std::move(found));
    }

    void read_silmap_chunks() {
        for (const auto& [representation, chunks] : silmaps_) {
            if (!chunks.header || !chunks.cells || !chunks.samples)
                return findings_.push_back({FindingCode::MissingChunk, 0,
                                            "representation " + std::to_string(representation) +
                                                ": a silhouette-map texture needs SLMH, SLMC and SLMS"});
        }
        if (silmaps_.empty()) return;
        SilmapTexture texture;
        std::vector<Finding> found = read_silmap(texture, silmaps_.begin()->second, limit_ - findings_.size());
        if (found.empty()) out_.silmap = std::move(texture);
        add(std::move(found));
    }

    void read_pinchmap_chunks() {
        for (const auto& [representation, chunks] : pinchmaps_) {
            if (!chunks.header || !chunks.map || !chunks.signal)
                return findings_.push_back(
                    {FindingCode::MissingChunk, 0,
                     "representation " + std::to_string(representation) + ": a pinchmap needs PNCH, PNCD and PNCS"});
        }
        if (pinchmaps_.empty()) return;
        PinchmapTexture texture;
        std::vector<Finding> found = read_pinchmap(texture, pinchmaps_.begin()->second, limit_ - findings_.size());
        if (found.empty()) out_.pinchmap = std::move(texture);
        add(std::move(found));
    }

    void read_feature_curves_chunks() {
        for (const auto& [representation, chunks] : feature_curves_) {
            if (!chunks.complete())
                return findings_.push_back(
                    {FindingCode::MissingChunk, 0,
                     "representation " + std::to_string(representation) +
                         ": a texture with feature curves needs FCVH, FCVC, FCVS, FCVD, FCVB and FCVP"});
        }
        if (feature_curves_.empty()) return;
        FeatureCurvesTexture texture;
        std::vector<Finding> found =
            read_feature_curves(texture, feature_curves_.begin()->second, limit_ - findings_.size());
        if (found.empty()) out_.feature_curves = std::move(texture);
        add(std::move(found));
    }

    void add(std::vector<Finding> found) {
        findings_.insert(findings_.end(), std::move_iterator(found.begin()), std::move_iterator(found.end()));
    }

    FetexFile& out_;
    std::size_t limit_;
    const ChunkView* metadata_ = nullptr;
    std::map<std::uint8_t, FbtChunks> fbts_;
    std::map<std::uint8_t, BilevelChunks> bilevels_;
    std::map<std::uint8_t, SilmapChunks> silmaps_;
    std::map<std::uint8_t, PinchmapChunks> pinchmaps_;
    std::map<std::uint8_t, FeatureCurvesChunks> feature_curves_;
    std::vector<Finding> findings_;
};

} // namespace

std::string to_valid_utf8(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text, at);
        out += length == 0 ? "\xef\xbf\xbd" : text.substr(at, length);
        at += std::max<std::size_t>(length, 1);
    }
    return out;
}

std::vector<std::uint8_t> write_file(const FetexFile& file) {
    Payloads payloads;
    std::vector<ChunkView> chunks;
    chunks.push_back({kMeta, 0, kWholeFile, 0, 0, payloads.emplace_back(write_metadata(file.metadata))});
    if (file.fbt) append_fbt_chunks(chunks, *file.fbt, kFbtRepresentation, payloads);
    if (file.bilevel) append_bilevel_chunks(chunks, *file.bilevel, kBilevelRepresentation, !file.fbt, payloads);
    if (file.silmap)
        append_silmap_chunks(chunks, *file.silmap, kSilmapRepresentation, !file.fbt && !file.bilevel, payloads);
    if (file.pinchmap)
        append_pinchmap_chunks(chunks, *file.pinchmap, kPinchmapRepresentation,
                               !file.fbt && !file.bilevel && !file.silmap, payloads);
    if (file.feature_curves)
        append_feature_curves_chunks(chunks, *file.feature_curves, kFeatureCurvesRepresentation,
                                     !file.fbt && !file.bilevel && !file.silmap && !file.pinchmap, payloads);
    return write_container_of_views(chunks);
}

std::optional<Finding> read_file(FetexFile& out, ByteSpan bytes) {
    out = {};
    FetexFile file;
    Reader reader(file, 1);
    reader.read(bytes);
    std::vector<Finding> findings = reader.take();
    if (!findings.empty()) return std::move(findings.front());
    out = std::move(file);
    return std::nullopt;
}

std::vector<Finding> validate_file(ByteSpan bytes, std::size_t limit) {
    FetexFile file;
    Reader reader(file, std::max<std::size_t>(limit, 1));
    reader.read(bytes);
    return reader.take();
}

} // namespace fetex
