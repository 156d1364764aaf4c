// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line: finds the subcommand, runs it, turns whatever happened into an exit code.
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include <fmt/format.h>

#include "cli/messages.h"
#include "cli/options.h"
#include "cli/version.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

constexpr const char* kDescription =
    "fetexc turns vector art into small GPU textures whose edges stay sharp at any magnification.";

constexpr const char* kFooter = R"(
Examples:
  fetexc compile sign.svg                          writes sign.fetex beside it
  fetexc compile sign.svg -o out/sign.fetex --size 64 --report text
  fetexc compile art/*.svg -o build/ -j 2 --depfile build/art.d
  fetexc render sign.fetex -o sign.png --size 1024
  fetexc render sign.fetex -o zoom.png --view 0.2,0.3,0.05,0.05 --size 1024 --backend osmesa
  fetexc info sign.fetex --json
  fetexc validate build/*.fetex
  fetexc compare sign.svg sign.fetex --size 512,2048 --diff wrong.png
  fetexc bench art/*.svg --csv bench.csv --html bench.html
  cat sign.svg | fetexc compile - -o - | fetexc render - -o - > sign.png

"-" is stdin as an input and stdout as an output. Messages go to stderr.
Exit codes: 0 fine, 1 usage, 2 reading or writing, 3 invalid input, 4 failure at run time, 5 not supported,
7 compared and found beyond a threshold.
'fetexc COMMAND --help' explains a command; README.md lists the numbered diagnostics.)";

int usage_error(const CLI::App& app, const std::string& why) {
    print_message(fmt::format("error {}: {}", code_name(Severity::Error, diag::kBadUsage), why));
    fmt::print(stderr, "Try '{} --help'.\n", app.get_name());
    return exit_code(ErrorClass::Usage);
}

/// CLI11 throws for --help and --version too; those succeed.
int finish_parsing(const CLI::App& app, const CLI::ParseError& stop) {
    if (stop.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(stop);
    return usage_error(app, stop.what());
}

int run(int argc, char** argv) {
    CLI::App app(kDescription, "fetexc");
    app.footer(kFooter);
    app.set_version_flag("--version", version_text,
                         "Print the version, what it was built from, and the back ends found");
    app.require_subcommand(1);
    const std::vector<Command> commands = {add_compile_command(app),  add_render_command(app),  add_info_command(app),
                                           add_validate_command(app), add_compare_command(app), add_bench_command(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& stop) {
        return finish_parsing(app, stop);
    }
    for (const Command& command : commands) {
        if (command.app->parsed()) return command.run();
    }
    return usage_error(app, "no subcommand"); // require_subcommand keeps us from here
}

int run_guarded(int argc, char** argv) {
    try {
        const int exit = run(argc, argv);
        if (std::fflush(stdout) != 0)
            return report_error({ErrorClass::Io, diag::kCannotWrite, "can't write", "stdout"});
        return exit;
    } catch (const std::system_error& error) { // fmt, when stdout is full or closed
        return report_error({ErrorClass::Io, diag::kCannotWrite, error.what(), "stdout"});
    } catch (const std::bad_alloc&) {
        return report_error({ErrorClass::Runtime, diag::kOutOfMemory, "out of memory", {}});
    } catch (const std::exception& error) {
        return report_error(
            {ErrorClass::Runtime, diag::kInternal, fmt::format("internal error: {}", error.what()), {}});
    }
}

} // namespace
} // namespace fetexc::cli

int main(int argc, char** argv) { return fetexc::cli::run_guarded(argc, argv); }
