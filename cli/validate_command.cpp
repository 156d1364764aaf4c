// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc validate`: every rule of formats/SPEC.md, one numbered finding for each that is broken.
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/fetex_input.h"
#include "cli/messages.h"
#include "cli/options.h"

namespace fetexc::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ValidateOptions {
    std::vector<std::string> inputs;
    bool json = false, quiet = false;
    std::size_t limit = 64;
};

struct Verdict {
    std::string path;
    std::uint64_t bytes = 0;
    std::vector<fetex::Finding> findings;
};

Json verdict_json(const Verdict& verdict) {
    Json findings = Json::array();
    for (const fetex::Finding& finding : verdict.findings)
        findings.push_back(
            {{"code", fetex::finding_id(finding.code)}, {"offset", finding.offset}, {"message", finding.message}});
    return {{"file", fetex::to_valid_utf8(verdict.path)},
            {"bytes", verdict.bytes},
            {"valid", findings.empty()},
            {"findings", findings}};
}

void print_verdict(const Verdict& verdict, bool quiet) {
    for (const fetex::Finding& finding : verdict.findings)
        fmt::print("{}: {}\n", printable(verdict.path), printable(describe(finding)));
    if (verdict.findings.empty() && !quiet)
        fmt::print("{}: valid ({} bytes)\n", printable(verdict.path), verdict.bytes);
}

int run_validate(const ValidateOptions& options) {
    int exit = kExitOk;
    Json files = Json::array();
    for (const std::string& path : options.inputs) {
        const auto bytes = read_fetex_bytes(path);
        if (!bytes) {
            exit = std::max(exit, report_error(bytes.error()));
            continue;
        }
        const Verdict verdict{path, bytes.value().size(), fetex::validate_file(bytes.value(), options.limit)};
        if (!verdict.findings.empty()) exit = std::max(exit, exit_code(ErrorClass::InvalidInput));
        if (options.json) {
            files.push_back(verdict_json(verdict));
        } else {
            print_verdict(verdict, options.quiet);
        }
    }
    if (options.json) fmt::print("{}\n", Json{{"schema", "fetexc-validate/1"}, {"files", files}}.dump(2));
    return exit;
}

} // namespace

Command add_validate_command(CLI::App& parent) {
    const auto options = std::make_shared<ValidateOptions>();
    CLI::App* app =
        parent.add_subcommand("validate", "Check .fetex files against formats/SPEC.md; exit 3 when one breaks a rule");
    app->add_option("inputs", options->inputs, "The .fetex files, or - for stdin")->required()->type_name("FILE");
    app->add_flag("--json", options->json, "Print JSON (cli/schema/validate.schema.json)");
    app->add_option("--limit", options->limit, "Most findings to list for a file (default 64)")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    add_quiet_option(*app, options->quiet);
    return {app, [options] { return run_validate(*options); }};
}

} // namespace fetexc::cli
