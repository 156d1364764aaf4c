// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_silmap.h"

#include "formats/fbt_samples.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using namespace fetex;

constexpr double kBrightest = 4; ///< of halves

FbtColor random_color(Random& random, SilmapSampleFormat format) {
    const bool opaque = format == SilmapSampleFormat::Rgb8 || random.chance(0.5);
    const double alpha = opaque ? 1.0 : random.unit(),
                 most = format == SilmapSampleFormat::Rgba16F ? kBrightest : alpha;
    return {random.between(0, most), random.between(0, most), random.between(0, most), alpha};
}

} // namespace

SilmapTexture random_silmap(std::uint64_t seed, const RandomSilmapOptions& options) {
    Random random(seed);
    SilmapTexture t;
    t.width = options.width, t.height = options.height;
    t.cell_format = options.cell_format, t.sample_format = options.sample_format;
    const int last = static_cast<int>(silmap_steps(t.cell_format)) - 1;
    for (std::size_t k = 0; k < std::size_t{silmap_columns(t)} * silmap_rows(t); ++k) {
        SilmapCell cell;
        cell.x = static_cast<std::uint32_t>(random.integer(0, last));
        cell.y = static_cast<std::uint32_t>(random.integer(0, last));
        cell.east = random.chance(options.boundaries), cell.south = random.chance(options.boundaries);
        t.cells.push_back(silmap_pack_cell(t.cell_format, cell));
    }
    std::vector<FbtColor> palette;
    for (std::uint32_t k = 0; k < options.colors; ++k)
        palette.push_back(random_color(random, t.sample_format));
    const FbtSampleFormat format = silmap_fbt_format(t.sample_format);
    for (std::size_t k = 0; k < std::size_t{t.width} * t.height; ++k) {
        const FbtColor color =
            palette.empty()
                ? random_color(random, t.sample_format)
                : palette[static_cast<std::size_t>(random.integer(0, static_cast<int>(palette.size()) - 1))];
        const auto words = fbt_pack_sample(color, format);
        t.colors.insert(t.colors.end(), words.begin(), words.begin() + fbt_sample_words(format));
    }
    if (options.mips) t.mips = silmap_make_mips(t);
    return t;
}

} // namespace fetexc::test
