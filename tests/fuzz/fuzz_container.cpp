// SPDX-License-Identifier: GPL-3.0-or-later
/// Any bytes into the reader; what it takes is sampled, on every texel. Checksums are mended first in half of the
/// inputs, or the fuzzer would never get past them.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "formats/crc32c.h"
#include "formats/fetex_file.h"
#include "formats/validate.h"

namespace {

using fetex::ByteSpan;
using fetex::load_le;

void store32(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k)
        bytes[at + k] = static_cast<std::uint8_t>(value >> (8 * k));
}

void mend_checksums(std::vector<std::uint8_t>& bytes) {
    if (bytes.size() < fetex::kHeaderBytes) return;
    const ByteSpan all(bytes);
    const std::uint32_t count = load_le<std::uint32_t>(all, 12);
    if (count > (bytes.size() - fetex::kHeaderBytes) / fetex::kChunkEntryBytes) return;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t entry = fetex::kHeaderBytes + fetex::kChunkEntryBytes * std::size_t{k};
        const auto offset = load_le<std::uint64_t>(all, entry + 8), size = load_le<std::uint64_t>(all, entry + 16);
        if (offset <= bytes.size() && size <= bytes.size() - offset)
            store32(bytes, entry + 24, fetex::crc32c(all.subspan(offset, size)));
    }
    store32(bytes, 24, fetex::crc32c(all.subspan(fetex::kHeaderBytes, fetex::kChunkEntryBytes * std::size_t{count})));
    store32(bytes, 28, fetex::crc32c(all.first(28)));
}

void sample_everywhere(const fetex::FbtTexture& texture) {
    const std::uint32_t columns = texture.width < 64 ? texture.width : 64,
                        rows = texture.height < 64 ? texture.height : 64;
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i)
            for (const double f : {0.0, 0.3, 0.99})
                if (!(fetex::fbt_sample_local(texture, i, j, f, 1 - f).a <= 1 + 1e-9)) std::abort();
}

void sample_everywhere(const fetex::BilevelTexture& texture) {
    const std::uint32_t step_x = 1 + texture.width / 64, step_y = 1 + texture.height / 64;
    for (std::uint32_t j = 0; j <= texture.height; j += step_y)
        for (std::uint32_t i = 0; i <= texture.width; i += step_x)
            for (const double side : {0.0, 0.3, 7.0}) {
                const fetex::BilevelPixel pixel{side, side};
                const auto color = texture.mips.empty() ? fetex::bilevel_sample_area(texture, i - 0.3, j + 0.6, pixel)
                                                        : fetex::bilevel_sample_mip(texture, i - 0.3, j + 0.6, pixel);
                if (!(color.a <= 1 + 1e-9)) std::abort();
            }
}

void sample_everywhere(const fetex::SilmapTexture& texture) {
    const std::uint32_t step_x = 1 + texture.width / 64, step_y = 1 + texture.height / 64;
    for (std::uint32_t j = 0; j <= texture.height; j += step_y)
        for (std::uint32_t i = 0; i <= texture.width; i += step_x)
            for (const double side : {0.0, 0.3, 7.0}) {
                const fetex::SilmapPixel pixel{side, side};
                const auto color = texture.mips.empty() ? fetex::silmap_sample_area(texture, i - 0.3, j + 0.6, pixel)
                                                        : fetex::silmap_sample_mip(texture, i - 0.3, j + 0.6, pixel);
                const auto nearest = fetex::silmap_sample(texture, i - 0.3, j + 0.6, fetex::SilmapFilter::Nearest);
                if (!(color.a <= 1 + 1e-9) || !(nearest.a <= 1)) std::abort();
            }
}

void sample_everywhere(const fetex::PinchmapTexture& texture) {
    const std::uint32_t step_x = 1 + texture.width / 64, step_y = 1 + texture.height / 64;
    for (std::uint32_t j = 0; j <= texture.height; j += step_y)
        for (std::uint32_t i = 0; i <= texture.width; i += step_x)
            for (const double side : {0.0, 0.3, 7.0}) {
                const fetex::PinchmapPixel pixel{side, side};
                const auto color = texture.mips.empty() ? fetex::pinchmap_sample_area(texture, i - 0.3, j + 0.6, pixel)
                                                        : fetex::pinchmap_sample_mip(texture, i - 0.3, j + 0.6, pixel);
                if (!(color.a <= 1 + 1e-9)) std::abort();
            }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::vector<std::uint8_t> bytes(data + 1, data + size);
    if (data[0] & 1) mend_checksums(bytes);
    fetex::FetexFile file;
    const auto finding = fetex::read_file(file, bytes);
    if (finding.has_value() == fetex::validate_file(bytes).empty()) std::abort(); // the two must agree
    if (finding) return 0;
    if (file.fbt && file.fbt->traits.max_entries < 4096) sample_everywhere(*file.fbt);
    if (file.bilevel) sample_everywhere(*file.bilevel);
    if (file.silmap) sample_everywhere(*file.silmap);
    if (file.pinchmap) sample_everywhere(*file.pinchmap);
    fetex::FetexFile again; // what is taken survives another round
    if (fetex::read_file(again, fetex::write_file(file))) std::abort();
    return 0;
}
