// SPDX-License-Identifier: GPL-3.0-or-later
/// Shrinks a failing drawing to a small file. See README.md.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "tests/support/shrink.h"
#include "tests/support/stress_drawings.h"

namespace fetexc::test {
namespace {

struct Options {
    std::string file, generator, predicate = "any", message, output;
    std::uint64_t seed = 0;
    unsigned seconds = 10;
    bool list = false;
};

Failure any_failure(const Drawing& drawing, std::uint64_t seed) { return first_failure(drawing, seed); }

/// What the option names; crash and hang run every check, "any" is every way to fail.
struct Predicate {
    Failure (*run)(const Drawing&, std::uint64_t) = any_failure;
    bool fails = true, crashes = true, hangs = true;

    [[nodiscard]] bool holds(const Outcome& outcome) const {
        return (outcome.kind == Outcome::Kind::Fails && fails) || (outcome.kind == Outcome::Kind::Crashes && crashes) ||
               (outcome.kind == Outcome::Kind::Hangs && hangs);
    }
};

std::optional<Predicate> predicate_named(const std::string& name) {
    if (name == "any") return Predicate{};
    if (name == "crash") return Predicate{any_failure, false, true, false};
    if (name == "hang") return Predicate{any_failure, false, false, true};
    const StressCheck* check = find_check(name);
    if (check == nullptr) return {};
    return Predicate{check->run, true, false, false};
}

void list_names() {
    fmt::print("predicates:\n");
    for (const StressCheck& check : stress_checks())
        fmt::print("  {:<8} {}\n", check.name, check.what);
    fmt::print("  crash    any check ends with a signal\n  hang     any check exceeds the time limit\n"
               "  any      any of these\ngenerators:\n");
    for (const StressGenerator& generator : stress_generators())
        fmt::print("  {}\n", generator.name);
}

Result<Drawing> input(const Options& o) {
    if (!o.file.empty()) return read_drawing(o.file);
    const StressGenerator* generator = find_generator(o.generator);
    if (generator == nullptr) return Error{ErrorClass::Usage, 0, "no such generator: " + o.generator, "--generator"};
    return stress_drawing(*generator, o.seed);
}

int run(const Options& o) {
    if (o.list) {
        list_names();
        return 0;
    }
    const Result<Drawing> drawing = input(o);
    if (!drawing) {
        fmt::print(stderr, "minimize: {}: {}\n", drawing.error().place, drawing.error().message);
        return static_cast<int>(drawing.error().cls);
    }
    const std::optional<Predicate> predicate = predicate_named(o.predicate);
    if (!predicate) {
        fmt::print(stderr, "minimize: no such predicate: {} (--list names them)\n", o.predicate);
        return 1;
    }
    std::string last;
    const auto still_fails = [&](const Drawing& d) {
        const Outcome outcome = ask_in_child([&] { return predicate->run(d, o.seed); }, o.seconds);
        const bool holds = predicate->holds(outcome) && outcome.message.find(o.message) != std::string::npos;
        if (holds) last = outcome.message;
        return holds;
    };
    if (!still_fails(drawing.value())) {
        fmt::print(stderr, "minimize: the drawing doesn't fail \"{}\"\n", o.predicate);
        return 7;
    }
    ShrinkCounts counts;
    const Drawing small = shrink(drawing.value(), still_fails, &counts);
    fmt::print(stderr, "{} -> {} curves ({} drawings tried, {} smaller ones kept): {}\n", curve_count(drawing.value()),
               curve_count(small), counts.tried, counts.kept, last);
    if (o.output.empty()) {
        write_drawing(small, std::cout);
        return 0;
    }
    std::ofstream out(o.output);
    write_drawing(small, out);
    return out ? 0 : 2;
}

} // namespace
} // namespace fetexc::test

int main(int argc, char** argv) {
    fetexc::test::Options o;
    CLI::App app{"Shrinks a failing drawing (.crv) until nothing more can go."};
    auto* file = app.add_option("input", o.file, "the drawing")->check(CLI::ExistingFile);
    app.add_option("--generator", o.generator, "of stress drawings, instead of a file")->excludes(file);
    app.add_option("--seed", o.seed, "of the generator, and of the checks' grids and angles");
    app.add_option("--predicate", o.predicate, "what must go on failing")->capture_default_str();
    app.add_option("--message", o.message, "text that the failure must contain");
    app.add_option("--limit", o.seconds, "seconds of processor time")
        ->capture_default_str()
        ->check(CLI::Range(1, 3600));
    app.add_option("-o,--output", o.output, "file to write; without it, standard output");
    app.add_flag("--list", o.list, "names of predicates and generators");
    CLI11_PARSE(app, argc, argv);
    return fetexc::test::run(o);
}
