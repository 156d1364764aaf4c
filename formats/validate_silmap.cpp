// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>
#include <span>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"

namespace fetex {
namespace {

bool side(std::uint32_t v) { return v >= 1 && v <= kSilmapMaxSide; }

/// What is wrong with the sizes; nullptr: nothing. Precondition: the formats are known.
const char* wrong_size(const SilmapTexture& t) {
    if (!side(t.width) || !side(t.height)) return "width or height outside 1 … 16384";
    if (t.cells.size() != std::uint64_t{silmap_columns(t)} * silmap_rows(t))
        return "the cells aren't (width+1)·(height+1)";
    if (t.colors.size() != std::uint64_t{t.width} * t.height * fbt_sample_words(silmap_fbt_format(t.sample_format)))
        return "the bitmap hasn't width·height samples";
    if (!t.mips.empty() && t.mips.size() != fbt_mip_samples(t.width, t.height))
        return "the mips are neither empty nor all levels";
    return nullptr;
}

FindingCode code_of(SampleFault fault) {
    return fault == SampleFault::NotPremultiplied ? FindingCode::SilmapNotPremultiplied
                                                  : FindingCode::SilmapSampleValue;
}

} // namespace

std::vector<Finding> validate_silmap(const SilmapTexture& texture, std::size_t limit) {
    limit = std::max<std::size_t>(limit, 1);
    if (texture.cell_format > SilmapCellFormat::Bits16 || texture.sample_format > SilmapSampleFormat::Rgb8)
        return {{FindingCode::SilmapFormat, 0, "header: unknown cell format or sample format"}};
    if (const char* wrong = wrong_size(texture))
        return {{FindingCode::SilmapDimensions, 0, std::string("header: ") + wrong}};
    if (texture.cell_format == SilmapCellFormat::Bits8 &&
        std::ranges::any_of(texture.cells, [](std::uint16_t c) { return c > 0xff; }))
        return {{FindingCode::SilmapFormat, 0, "cells: more than 8 bits in one"}};
    std::vector<Finding> findings;
    const auto check = [&](std::span<const std::uint32_t> words, SilmapSampleFormat format, const std::string& part) {
        const std::size_t step = fbt_sample_words(silmap_fbt_format(format));
        for (std::size_t k = 0; k < words.size() && findings.size() < limit; k += step) {
            const SampleFault fault = bitmap_sample_fault(&words[k], format);
            if (fault == SampleFault::None) continue;
            const std::size_t bytes = format == SilmapSampleFormat::Rgb8 ? 3 : 4;
            findings.push_back({code_of(fault), bytes * std::uint64_t{k}, part + sample_fault_text(fault)});
        }
    };
    check(texture.colors, texture.sample_format, "samples");
    check(texture.mips, SilmapSampleFormat::Rgba8, "mips");
    return findings;
}

} // namespace fetex
