// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc info`: what a .fetex file holds.
#include <memory>

#include <fmt/format.h>

#include "cli/fetex_input.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/texture_info.h"

namespace fetexc::cli {
namespace {

struct InfoOptions {
    std::string input;
    bool json = false, stats = false;
};

void print_text(const std::string& path, const FetexInput& input, bool stats) {
    fmt::print("file          {} ({} bytes)\n", printable(path), input.bytes);
    if (input.file.fbt) print_info(*input.file.fbt, stats);
    if (input.file.bilevel) print_info(*input.file.bilevel);
    if (input.file.silmap) print_info(*input.file.silmap);
    if (input.file.pinchmap) print_info(*input.file.pinchmap);
    if (input.file.feature_curves) print_info(*input.file.feature_curves);
    for (const auto& [key, value] : input.file.metadata)
        fmt::print("{:<13} {}\n", printable(key), printable(value));
}

void print_json(const std::string& path, const FetexInput& input, bool stats) {
    Json json = {{"schema", "fetexc-info/1"}, {"file", fetex::to_valid_utf8(path)}, {"bytes", input.bytes}};
    json["metadata"] = Json::object();
    for (const auto& [key, value] : input.file.metadata)
        json["metadata"][key] = value;
    if (input.file.fbt) json["fbt"] = info_json(*input.file.fbt, stats);
    if (input.file.bilevel) json["bilevel"] = info_json(*input.file.bilevel);
    if (input.file.silmap) json["silmap"] = info_json(*input.file.silmap);
    if (input.file.pinchmap) json["pinchmap"] = info_json(*input.file.pinchmap);
    if (input.file.feature_curves) json["curves"] = info_json(*input.file.feature_curves);
    fmt::print("{}\n", json.dump(2));
}

int run_info(const InfoOptions& options) {
    const auto input = load_fetex(options.input);
    if (!input) return report_error(input.error());
    if (options.json) {
        print_json(options.input, input.value(), options.stats);
    } else {
        print_text(options.input, input.value(), options.stats);
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
    app->add_flag(
        "--stats", options->stats,
        "Also what lookups cost: regions of texels, curves considered and solved a lookup (Tables 2, 3 of the paper)");
    return {app, [options] { return run_info(*options); }};
}

} // namespace fetexc::cli
