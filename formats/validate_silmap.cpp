// SPDX-License-Identifier: Apache-2.0 OR MIT
#include <algorithm>
#include <array>
#include <span>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
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

/// What is wrong with a sample; FindingCode{}: nothing.
FindingCode fault_of_halves(const std::uint32_t* words) {
    const std::array<std::uint32_t, 4> c = {words[0] & 0xffffu, words[0] >> 16, words[1] & 0xffffu, words[1] >> 16};
    // Halves without a sign order as integers do.
    if (*std::ranges::max_element(c) >= kFbtHalfInfinity || c[3] > kFbtHalfOne) return FindingCode::SilmapSampleValue;
    return c[3] == 0 && (c[0] | c[1] | c[2]) != 0 ? FindingCode::SilmapNotPremultiplied : FindingCode{};
}

FindingCode fault_of(const std::uint32_t* words, SilmapSampleFormat format) {
    if (format == SilmapSampleFormat::Rgba16F) return fault_of_halves(words);
    if (format == SilmapSampleFormat::Rgb8 && words[0] >> 24 != 255) return FindingCode::SilmapSampleValue;
    const std::array<double, 4> c = fbt_sample_channels(words, silmap_fbt_format(format));
    return std::max({c[0], c[1], c[2]}) > c[3] ? FindingCode::SilmapNotPremultiplied : FindingCode{};
}

const char* text_of(FindingCode code) {
    return code == FindingCode::SilmapNotPremultiplied
               ? ": a colour channel exceeds alpha"
               : ": a half that is negative, infinite or no number, an alpha above 1, or less than 1 in RGB8";
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
            const FindingCode fault = fault_of(&words[k], format);
            if (fault == FindingCode{}) continue;
            const std::size_t bytes = format == SilmapSampleFormat::Rgb8 ? 3 : 4;
            findings.push_back({fault, bytes * std::uint64_t{k}, part + text_of(fault)});
        }
    };
    check(texture.colors, texture.sample_format, "samples");
    check(texture.mips, SilmapSampleFormat::Rgba8, "mips");
    return findings;
}

} // namespace fetex
