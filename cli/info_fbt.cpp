// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "cli/report.h"
#include "cli/texture_info.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kStatsPixels = 500; ///< a side, as FBT Table 3

/// Texels by kind: of one region, with one band, with several.
std::array<std::uint64_t, 3> count_kinds(const fetex::FbtTexture& fbt) {
    std::array<std::uint64_t, 3> counts{};
    for (const std::uint32_t texel : fbt.texels)
        ++counts[texel >> 30 == fetex::kFbtKindShaded ? fetex::kFbtKindSolid : texel >> 30];
    return counts;
}

/// Texels with one region, two, more (FBT Table 2). Bands come from junctions, of three regions at least.
std::array<std::uint64_t, 3> count_regions(const fetex::FbtTexture& fbt) {
    std::array<std::uint64_t, 3> counts{};
    for (const std::uint32_t texel : fbt.texels) {
        const std::uint32_t kind = texel >> 30;
        std::size_t more = kind == fetex::kFbtKindBanded ? 2 : 0;
        if (kind == fetex::kFbtKindSingle) {
            for (std::uint32_t at = texel & fetex::kFbtAddressMask;;) {
                const fetex::FbtEntry entry(fbt.records[std::size_t{4} * at]);
                more += entry.last_run() && entry.pieces() > 0 ? 1 : 0;
                if (entry.last()) break;
                at += entry.records();
            }
        }
        ++counts[std::min<std::size_t>(more, 2)];
    }
    return counts;
}

/// What lookups at the pixel centres of a picture do (FBT Table 3).
fetex::FbtQueryStats count_queries(const fetex::FbtTexture& fbt) {
    fetex::FbtQueryStats stats;
    for (std::uint32_t py = 0; py < kStatsPixels; ++py) {
        for (std::uint32_t px = 0; px < kStatsPixels; ++px) {
            const double x = (px + 0.5) / kStatsPixels * fbt.width, y = (py + 0.5) / kStatsPixels * fbt.height;
            const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
            fetex::fbt_locate_local(fbt, i, j, x - i, y - j, &stats);
        }
    }
    return stats;
}

/// Table 1 to 3 of the paper. Its figures count the pixels of a picture; s_avg and f_test are the paper's names.
Json stats_json(const fetex::FbtTexture& fbt) {
    const auto regions = count_regions(fbt);
    const fetex::FbtQueryStats q = count_queries(fbt);
    const auto texels = static_cast<double>(fbt.texels.size()), queries = static_cast<double>(q.queries);
    const auto pieces = static_cast<double>(q.pieces), cubics = static_cast<double>(q.solved[3]);
    return {{"empty", static_cast<double>(regions[0]) / texels},
            {"twoRegions", static_cast<double>(regions[1]) / texels},
            {"moreRegions", static_cast<double>(regions[2]) / texels},
            {"pixels", kStatsPixels},
            {"bandSteps", static_cast<double>(q.bands) / queries},
            {"curvesConsidered", pieces / queries},
            {"hullTests", static_cast<double>(q.pieces - q.outside) / queries},
            {"linesSolved", static_cast<double>(q.solved[1]) / queries},
            {"quadraticsSolved", static_cast<double>(q.solved[2]) / queries},
            {"cubicsSolved", cubics / queries},
            {"cubicShare", pieces > 0 ? cubics / pieces : 0.0}};
}

void print_stats(const fetex::FbtTexture& fbt) {
    const Json s = stats_json(fbt);
    const auto at = [&](const char* key) { return s[key].get<double>(); };
    fmt::print("  regions     {:.1f}% of texels with one, {:.1f}% with two, {:.1f}% with more\n", 100 * at("empty"),
               100 * at("twoRegions"), 100 * at("moreRegions"));
    fmt::print("  a lookup    {:.4f} curves considered, {:.4f} hull tests, {:.4f} steps over bands\n",
               at("curvesConsidered"), at("hullTests"), at("bandSteps"));
    fmt::print("              solved: {:.4f} lines, {:.4f} quadratics, {:.4f} cubics ({:.4f} of the curves)\n",
               at("linesSolved"), at("quadraticsSolved"), at("cubicsSolved"), at("cubicShare"));
    fmt::print("              (means over the {0} x {0} pixels of the whole picture)\n", kStatsPixels);
}

Json traits_json(const fetex::FbtTraits& traits) {
    return {{"maxDegree", traits.max_degree},
            {"lines", (traits.degrees & 2) != 0},
            {"quadratics", (traits.degrees & 4) != 0},
            {"cubics", (traits.degrees & 8) != 0},
            {"bands", traits.bands},
            {"corners", traits.corners},
            {"patches", traits.patches},
            {"sharedPoints", traits.shared},
            {"translucent", traits.translucent},
            {"directions", traits.directions},
            {"maxEntries", traits.max_entries},
            {"maxBands", traits.max_bands},
            {"maxDepth", traits.max_depth}};
}

/// Of what has samples in a format at all.
std::string gradients_text(const fetex::FbtTexture& fbt) {
    if (!fbt.traits.corners && !fbt.traits.patches) return "constant colours";
    switch (fbt.sample_format) {
    case fetex::FbtSampleFormat::Rgba8:
        return "gradients";
    case fetex::FbtSampleFormat::Rgba16:
        return "gradients in 16 bits";
    case fetex::FbtSampleFormat::Rgba16F:
        return "gradients in 16-bit floats";
    }
    return "";
}

} // namespace

Json info_json(const fetex::FbtTexture& fbt, bool stats) {
    const auto kinds = count_kinds(fbt);
    Json json = {{"width", fbt.width},
                 {"height", fbt.height},
                 {"gpuBytes", fetex::fbt_gpu_bytes(fbt)},
                 {"texelBytes", 4 * fbt.texels.size()},
                 {"cornerBytes", 4 * fbt.corners.size()},
                 {"recordBytes", 4 * fbt.records.size()},
                 {"mipBytes", 4 * fbt.mips.size()},
                 {"mipLevels", mip_levels_of(fbt)},
                 {"samples", sample_format_name(fbt.sample_format)},
                 {"texels", {{"empty", kinds[0]}, {"single", kinds[1]}, {"banded", kinds[2]}}},
                 {"traits", traits_json(fbt.traits)}};
    if (stats) json["stats"] = stats_json(fbt);
    return json;
}

void print_info(const fetex::FbtTexture& fbt, bool stats) {
    const auto kinds = count_kinds(fbt);
    const double total = static_cast<double>(fbt.width) * fbt.height;
    const auto share = [&](std::uint64_t n) { return 100 * static_cast<double>(n) / total; };
    const std::size_t texel_bytes = 4 * (fbt.texels.size() + fbt.corners.size()), record_bytes = 4 * fbt.records.size(),
                      mip_bytes = 4 * fbt.mips.size(), bytes = texel_bytes + record_bytes + mip_bytes;
    const fetex::FbtTraits& t = fbt.traits;
    fmt::print("fbt           {} x {} texels\n", fbt.width, fbt.height);
    fmt::print("  on the GPU  {} bytes: {} in texels, {} in curves{} ({:.1f} bytes a texel)\n", bytes, texel_bytes,
               record_bytes, mip_bytes == 0 ? "" : fmt::format(", {} in {} mip levels", mip_bytes, mip_levels_of(fbt)),
               static_cast<double>(bytes) / total);
    fmt::print("  texels      {:.1f}% empty, {:.1f}% with one band, {:.1f}% with more\n", share(kinds[0]),
               share(kinds[1]), share(kinds[2]));
    fmt::print("  curves      {}{}{}{}\n", t.degrees == 0 ? "none" : "", t.degrees & 2 ? "lines " : "",
               t.degrees & 4 ? "quadratics " : "", t.degrees & 8 ? "cubics" : "");
    fmt::print("  sampler     {}, {}, {}; longest list {} entries, most bands {}\n", t.bands ? "bands" : "no bands",
               gradients_text(fbt), t.translucent ? "translucent" : "opaque", t.max_entries, t.max_bands);
    if (stats) print_stats(fbt);
}

} // namespace fetexc::cli
