// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc bench`: error, bytes, compile time and sampler cost of drawings at many sizes, and of what else could be
/// used.
#include <algorithm>
#include <memory>
#include <optional>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/bench/bench_csv.h"
#include "cli/bench/bench_page.h"
#include "cli/bench/sweep.h"
#include "cli/fetex_input.h"
#include "cli/io.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/version.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kLeastRounds = 11, kMostRounds = 10001;

struct BenchOptions {
    std::vector<std::string> inputs, representations = representation_names();
    std::string csv, html, plot;
    std::string backend = "osmesa";
    std::uint32_t rounds = kLeastRounds;
    SweepOptions sweep;
    bool no_timing = false, no_equal_bitmap = false, quiet = false;
};

Status check_outputs(const BenchOptions& options) {
    const std::vector<std::string> outputs = {options.csv, options.html, options.plot};
    for (std::size_t a = 0; a < outputs.size(); ++a) {
        if (outputs[a].empty()) continue;
        for (const std::string& input : options.inputs) {
            if (same_file(input, outputs[a]))
                return Error{ErrorClass::Usage, diag::kWouldOverwriteInput, "an output would overwrite an input",
                             outputs[a]};
        }
        for (std::size_t b = 0; b < a; ++b) {
            if (!outputs[b].empty() && identity(outputs[a]) == identity(outputs[b]))
                return Error{ErrorClass::Usage, diag::kSameOutputTwice, "two outputs would be written there",
                             outputs[a]};
        }
    }
    if (std::count(options.inputs.begin(), options.inputs.end(), "-") > 1)
        return Error{ErrorClass::Usage, diag::kBadUsage, "stdin can be given only once", {}};
    for (const std::string& output : outputs) {
        if (output.empty()) continue;
        if (const Status status = check_output(output); !status) return status; // now, not after minutes
    }
    return {};
}

/// A line for each drawing where no progress line is drawn: a run takes minutes.
void announce(std::size_t number, std::size_t count, const std::string& input, bool quiet) {
    if (!quiet && ::isatty(STDERR_FILENO) != 1)
        print_message(fmt::format("drawing {} of {}: {}", number, count, input));
}

/// Every drawing is tried; exit is that of the first failure.
std::vector<BenchFile> sweep_all(const BenchOptions& options, SamplerTimer* timer, int& exit) {
    std::vector<BenchFile> files;
    for (std::size_t k = 0; k < options.inputs.size(); ++k) {
        const std::string& input = options.inputs[k];
        announce(k + 1, options.inputs.size(), input, options.quiet);
        std::vector<Diagnostic> diagnostics;
        auto file = [&] {
            ProgressLine progress(fmt::format("{} ({} of {})", input, k + 1, options.inputs.size()), options.quiet);
            return sweep_file(input, options.sweep, timer, progress.sink(), diagnostics);
        }();
        print_diagnostics(diagnostics, input, options.quiet);
        if (file) {
            files.push_back(std::move(file).value());
        } else {
            const int code = report_error(file.error(), input);
            if (exit == kExitOk) exit = code;
        }
    }
    return files;
}

BenchPageFacts facts_of(const BenchOptions& options, const SamplerTimer* timer) {
    BenchPageFacts facts;
    facts.version = version_number();
    facts.sizes = options.sweep.sizes, facts.outputs = options.sweep.outputs;
    facts.timed = options.sweep.timing;
    facts.compile_rounds = options.sweep.compile_rounds, facts.sampler_rounds = options.rounds;
    if (timer != nullptr) facts.renderer = timer->description(), facts.why_no_renderer = timer->why();
    return facts;
}

Status write_all(const BenchOptions& options, const std::vector<BenchFile>& files, const SamplerTimer* timer) {
    const bool nothing_asked = options.csv.empty() && options.html.empty() && options.plot.empty();
    const auto write = [](const std::string& path, const std::string& text) {
        return path.empty() ? Status() : write_output(path, text);
    };
    if (Status s = write(nothing_asked ? "-" : options.csv, bench_csv(files, options.sweep.timing)); !s) return s;
    if (Status s = write(options.html, bench_page(files, facts_of(options, timer))); !s) return s;
    return write(options.plot, bench_plot(files));
}

int run_bench(BenchOptions options) {
    options.sweep.timing = !options.no_timing, options.sweep.equal_bitmap = !options.no_equal_bitmap;
    if (const Status status = check_outputs(options); !status) return report_error(status.error());
    options.sweep.fbt = std::ranges::count(options.representations, "fbt") > 0;
    if (!options.sweep.fbt && std::ranges::any_of(options.representations, [](const auto& r) { return r != "curves"; }))
        return report_error(
            {ErrorClass::Usage, diag::kBadUsage, "--repr must name fbt, whose sizes are swept, or curves alone", {}});
    options.sweep.bilevel = std::ranges::count(options.representations, "bilevel") > 0;
    options.sweep.silmap = std::ranges::count(options.representations, "silmap") > 0;
    options.sweep.curves = std::ranges::count(options.representations, "curves") > 0;
    options.sweep.pinchmap = std::ranges::count(options.representations, "pinchmap") > 0;
    std::optional<SamplerTimer> timer; // before anything starts a thread
    if (options.sweep.timing) {
        timer.emplace(options.backend, options.rounds);
        if (timer->description().empty() && !options.quiet)
            print_message(fmt::format("note: no sampler is timed: {}", timer->why()));
    }
    SamplerTimer* const used = timer ? &*timer : nullptr;
    int exit = kExitOk;
    const std::vector<BenchFile> files = sweep_all(options, used, exit);
    if (files.empty()) return exit;
    if (const Status status = write_all(options, files, used); !status) {
        const int code = report_error(status.error());
        return exit == kExitOk ? code : exit;
    }
    return exit;
}

void add_sizes(CLI::App& app, const std::string& name, std::vector<std::uint32_t>& values, const std::string& help) {
    app.add_option(name, values, help)->delimiter(',')->check(CLI::Range(1u, kMaxSide))->type_name("N,...");
}

} // namespace

Command add_bench_command(CLI::App& parent) {
    const auto options = std::make_shared<BenchOptions>();
    options->sweep.sizes = {16, 32, 64, 128, 256};
    options->sweep.outputs = {512};
    CLI::App* app = parent.add_subcommand("bench", "Measure error, bytes and time over sizes, beside other textures");
    app->add_option("inputs", options->inputs, "SVG or SVGZ files, networks of curves, or - for stdin")
        ->required()
        ->type_name("FILE");
    add_sizes(*app, "--size", options->sweep.sizes, "Texels on the longer side (default 16,32,64,128,256)");
    add_sizes(*app, "--output-size", options->sweep.outputs,
              "Pixels on the longer side where errors are measured; plots show the last (default 512)");
    app->add_option(
           "--repr", options->representations,
           "Representations: fbt, whose sizes are swept, bilevel, silmap and pinchmap in its bytes, and curves, "
           "held against what their profiles make of a plane; fbt among them, or curves alone (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(representation_names()))
        ->type_name("NAME,...");
    app->add_option("--csv", options->csv, "Write every figure; - for stdout, the default when nothing else is written")
        ->type_name("FILE");
    app->add_option("--html", options->html, "Write a page with plots that needs nothing else")->type_name("FILE");
    app->add_option("--plot", options->plot, "Write the plot of error against bytes as an SVG")->type_name("FILE");
    app->add_flag("--no-timing", options->no_timing, "Leave out what depends on the clock");
    app->add_flag("--no-equal-bitmap", options->no_equal_bitmap, "Don't look for the bitmap that is as good");
    app->add_option("--rounds", options->rounds, "Rounds in which samplers are timed (default and least 11)")
        ->check(CLI::Range(kLeastRounds, kMostRounds))
        ->type_name("N");
    app->add_option("--backend", options->backend, "What times samplers: osmesa (default), egl or glfw")
        ->check(CLI::IsMember({"osmesa", "egl", "glfw"}))
        ->type_name("NAME");
    app->add_option("-j,--jobs", options->sweep.threads,
                    "Threads for measuring; 0 (default) is one per core. What is timed has one")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    add_scene_options(*app, options->sweep.scene);
    add_quiet_option(*app, options->quiet);
    return {app, [options] { return run_bench(*options); }};
}

} // namespace fetexc::cli
