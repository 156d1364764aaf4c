// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/bitmap_samples.h"

#include <algorithm>
#include <array>

namespace fetex {
namespace {

SampleFault fault_of_halves(const std::uint32_t* words) {
    const std::array<std::uint32_t, 4> c = {words[0] & 0xffffu, words[0] >> 16, words[1] & 0xffffu, words[1] >> 16};
    // Halves without a sign order as integers do.
    if (*std::ranges::max_element(c) >= kFbtHalfInfinity || c[3] > kFbtHalfOne) return SampleFault::Value;
    return c[3] == 0 && (c[0] | c[1] | c[2]) != 0 ? SampleFault::NotPremultiplied : SampleFault::None;
}

} // namespace

std::vector<std::uint8_t> without_alpha(std::span<const std::uint32_t> samples) {
    std::vector<std::uint8_t> out;
    out.reserve(3 * samples.size());
    for (const std::uint32_t sample : samples)
        for (unsigned shift = 0; shift < 24; shift += 8)
            out.push_back(static_cast<std::uint8_t>(sample >> shift));
    return out;
}

std::vector<std::uint32_t> with_alpha(ByteSpan bytes) {
    std::vector<std::uint32_t> out(bytes.size() / 3);
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] =
            0xff000000u | bytes[3 * k] | std::uint32_t{bytes[3 * k + 1]} << 8 | std::uint32_t{bytes[3 * k + 2]} << 16;
    return out;
}

SampleFault bitmap_sample_fault(const std::uint32_t* words, SilmapSampleFormat format) {
    if (format == SilmapSampleFormat::Rgba16F) return fault_of_halves(words);
    if (format == SilmapSampleFormat::Rgb8 && words[0] >> 24 != 255) return SampleFault::Value;
    const std::array<double, 4> c = fbt_sample_channels(words, silmap_fbt_format(format));
    return std::max({c[0], c[1], c[2]}) > c[3] ? SampleFault::NotPremultiplied : SampleFault::None;
}

const char* sample_fault_text(SampleFault fault) {
    return fault == SampleFault::NotPremultiplied
               ? ": a colour channel exceeds alpha"
               : ": a half that is negative, infinite or no number, an alpha above 1, or less than 1 in RGB8";
}

} // namespace fetex
