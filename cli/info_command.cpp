// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc info`: what a .fetex file holds.
#include <array>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/fetex_input.h"
#include "cli/messages.h"
#include "cli/options.h"

namespace fetexc::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
    std::string input;
    bool json = false;
};

/// Texels of the texture proper (without the apron) by what their second word says they are.
std::array<std::uint64_t, 3> count_kinds(const fetex::FbtTexture& fbt) {
    std::array<std::uint64_t, 3> counts{};
    const std::size_t row = fbt.width + fbt.apron;
    for (std::size_t j = 0; j < fbt.height; ++j) {
        for (std::size_t i = 0; i < fbt.width; ++i)
            ++counts[fbt.texels[2 * (j * row + i) + 1] >> 30];
    }
    return counts;
}

Json traits_json(const fetex::FbtTraits& traits) {
    return {{"maxDegree", traits.max_degree},
            {"lines", (traits.degrees & 2) != 0},
            {"quadratics", (traits.degrees & 4) != 0},
            {"cubics", (traits.degrees & 8) != 0},
            {"bands", traits.bands},
            {"interpolated", traits.interpolated},
            {"translucent", traits.translucent},
            {"directions", traits.directions},
            {"maxEntries", traits.max_entries},
            {"maxBands", traits.max_bands}};
}

Json fbt_json(const fetex::FbtTexture& fbt) {
    const auto kinds = count_kinds(fbt);
    return {{"width", fbt.width},
            {"height", fbt.height},
            {"apron", fbt.apron},
            {"gpuBytes", 4 * (fbt.texels.size() + fbt.records.size())},
            {"texelBytes", 4 * fbt.texels.size()},
            {"recordBytes", 4 * fbt.records.size()},
            {"texels", {{"empty", kinds[0]}, {"single", kinds[1]}, {"banded", kinds[2]}}},
            {"traits", traits_json(fbt.traits)}};
}

void print_fbt(const fetex::FbtTexture& fbt) {
    const auto kinds = count_kinds(fbt);
    const double total = static_cast<double>(fbt.width) * fbt.height;
    const auto share = [&](std::uint64_t n) { return 100 * static_cast<double>(n) / total; };
    const std::size_t texel_bytes = 4 * fbt.texels.size(), record_bytes = 4 * fbt.records.size();
    const fetex::FbtTraits& t = fbt.traits;
    fmt::print("fbt           {} x {} texels{}\n", fbt.width, fbt.height, fbt.apron ? " and an apron of samples" : "");
    fmt::print("  on the GPU  {} bytes: {} in texels, {} in curves ({:.1f} bytes a texel)\n",
               texel_bytes + record_bytes, texel_bytes, record_bytes,
               static_cast<double>(texel_bytes + record_bytes) / total);
    fmt::print("  texels      {:.1f}% empty, {:.1f}% with one band, {:.1f}% with more\n", share(kinds[0]),
               share(kinds[1]), share(kinds[2]));
    fmt::print("  curves      {}{}{}{}\n", t.degrees == 0 ? "none" : "", t.degrees & 2 ? "lines " : "",
               t.degrees & 4 ? "quadratics " : "", t.degrees & 8 ? "cubics" : "");
    fmt::print("  sampler     {}, {}, {}; longest list {} entries, most bands {}\n", t.bands ? "bands" : "no bands",
               t.interpolated ? "interpolated samples" : "constant samples", t.translucent ? "translucent" : "opaque",
               t.max_entries, t.max_bands);
}

void print_text(const std::string& path, const FetexInput& input) {
    fmt::print("file          {} ({} bytes)\n", printable(path), input.bytes);
    if (input.file.fbt) print_fbt(*input.file.fbt);
    for (const auto& [key, value] : input.file.metadata)
        fmt::print("{:<13} {}\n", printable(key), printable(value));
}

void print_json(const std::string& path, const FetexInput& input) {
    Json json = {{"schema", "fetexc-info/1"}, {"file", fetex::to_valid_utf8(path)}, {"bytes", input.bytes}};
    json["metadata"] = Json::object();
    for (const auto& [key, value] : input.file.metadata)
        json["metadata"][key] = value;
    if (input.file.fbt) json["fbt"] = fbt_json(*input.file.fbt);
    fmt::print("{}\n", json.dump(2));
}

int run_info(const InfoOptions& options) {
    const auto input = load_fetex(options.input);
    if (!input) return report_error(input.error());
    if (options.json) {
        print_json(options.input, input.value());
    } else {
        print_text(options.input, input.value());
    }
    return kExitOk;
}

} // namespace

Command add_info_command(CLI::App& parent) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* app =
        parent.add_subcommand("info", "Say what a .fetex file holds: size, kinds of texels, traits, metadata");
    app->add_option("input", options->input, "A .fetex file, or - for stdin")->required()->type_name("FILE");
    app->add_flag("--json", options->json, "Print JSON (cli/schema/info.schema.json)");
    return {app, [options] { return run_info(*options); }};
}

} // namespace fetexc::cli
