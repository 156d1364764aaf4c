// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile`: vector art, or an image with features, in, .fetex out.
#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "cli/compile_image.h"
#include "cli/depfile.h"
#include "cli/io.h"
#include "cli/load_scene.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/version.h"
#include "compiler/diagnostics.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kDefaultTexels = 128; ///< longer side, when --size isn't given

struct CompileCommandOptions {
    std::vector<std::string> inputs;
    std::string output, depfile, report;
    std::string representation = "fbt";
    SizeValue size{0, 0, kDefaultTexels};
    bool size_given = false;
    SceneOptions scene;
    ImageOptions image;
    std::uint64_t max_bytes = 0;
    unsigned threads = 0;
    std::vector<std::string> no_skip;
    bool mips = false;
    std::string samples = "8";
    bool quiet = false;
};

std::vector<std::string> skip_rule_names() {
    std::vector<std::string> names;
    for (const SkipRule& r : kSkipRules)
        names.emplace_back(r.name);
    return names;
}

SkipRules skip_rules_without(const std::vector<std::string>& off) {
    SkipRules rules;
    for (const SkipRule& r : kSkipRules)
        rules.*r.rule = std::find(off.begin(), off.end(), r.name) == off.end();
    return rules;
}

GridSize grid_of(const SizeValue& size, const Extent& extent) {
    return size.longer != 0 ? grid_for(extent, size.longer) : GridSize{size.width, size.height};
}

/// By the compiler.
bool size_chosen(const CompileCommandOptions& options) { return options.size.automatic || options.max_bytes != 0; }

fetex::FbtSampleFormat sample_format(const CompileCommandOptions& options) {
    if (options.samples == "16") return fetex::FbtSampleFormat::Rgba16;
    return options.samples == "float" ? fetex::FbtSampleFormat::Rgba16F : fetex::FbtSampleFormat::Rgba8;
}

/// What the file says about its own making. Nothing that differs between two runs or two folders.
fetex::Metadata metadata_for(const LoadedScene& loaded, const CompileCommandOptions& options,
                             const fetex::FbtTexture& fbt) {
    std::string made_with = fmt::format("repr=fbt size={}x{}", fbt.width, fbt.height);
    if (options.mips) made_with += " mips";
    if (options.samples != "8") made_with += " samples=" + options.samples;
    if (options.scene.raster_size != 0) made_with += fmt::format(" raster-size={}", options.scene.raster_size);
    return {{"generator", "fetexc " + version_number()}, {"options", made_with}, {"source.xxh128", loaded.source_hash}};
}

struct Compiled {
    fetex::Metadata metadata;
    FbtBuild build;
};

CompileOptions compile_options(const CompileCommandOptions& options, const Extent& extent) {
    return {grid_of(options.size, extent), options.threads, skip_rules_without(options.no_skip), options.mips,
            sample_format(options)};
}

fetex::Metadata metadata_for(const LoadedImage& loaded, const CompileCommandOptions& options,
                             const fetex::FbtTexture& fbt) {
    const ImageOptions& o = options.image;
    std::string made_with = fmt::format("repr=fbt size={}x{} invalidate={}", fbt.width, fbt.height, o.invalidate);
    if (options.mips) made_with += " mips";
    if (options.samples != "8") made_with += " samples=" + options.samples;
    if (o.trace) made_with += fmt::format(" trace-contrast={} trace-speck={}", o.tracing.contrast, o.tracing.speck);
    fetex::Metadata metadata{
        {"generator", "fetexc " + version_number()}, {"options", made_with}, {"source.xxh128", loaded.source_hash}};
    if (!loaded.features_hash.empty()) metadata.emplace("features.xxh128", loaded.features_hash);
    return metadata;
}

/// An image has as many texels as pixels unless told otherwise.
Result<Compiled> load_and_compile_image(const Job& job, const CompileCommandOptions& options,
                                        std::vector<Diagnostic>& diagnostics) {
    ProgressLine progress(job.input, options.quiet);
    ImageOptions image = options.image;
    image.bright = sample_format(options) == fetex::FbtSampleFormat::Rgba16F;
    auto loaded = load_image(image, options.scene, options.threads, diagnostics);
    if (!loaded) return loaded.error();
    const FeaturedImage& picture = loaded.value().picture;
    CompileOptions how = compile_options(options, picture.features.extent);
    if (!options.size_given) how.size = {picture.image.width, picture.image.height};
    auto build = size_chosen(options) ? compile_fbt_at_chosen_size(picture, how, options.max_bytes, progress.sink())
                                      : compile_fbt(picture, how, progress.sink());
    if (!build) return build.error();
    fetex::Metadata metadata = metadata_for(loaded.value(), options, build.value().texture);
    return Compiled{std::move(metadata), std::move(build).value()};
}

Result<Compiled> load_and_compile_drawing(const Job& job, const CompileCommandOptions& options,
                                          std::vector<Diagnostic>& diagnostics) {
    ProgressLine progress(job.input, options.quiet);
    const bool chosen = size_chosen(options);
    const std::uint32_t texels =
        chosen ? kDefaultTexels : std::max({options.size.longer, options.size.width, options.size.height});
    SceneOptions scene_options = options.scene;
    scene_options.cull = skip_rules_without(options.no_skip).layers;
    auto loaded = load_scene(job.input, scene_options, texels, options.threads, diagnostics);
    if (!loaded) return loaded.error();
    const Scene& scene = loaded.value().scene;
    const CompileOptions how = compile_options(options, scene.extent);
    auto build = chosen ? compile_fbt_at_chosen_size(scene, how, options.max_bytes, progress.sink())
                        : compile_fbt(scene, how, progress.sink());
    if (!build) return build.error();
    fetex::Metadata metadata = metadata_for(loaded.value(), options, build.value().texture);
    return Compiled{std::move(metadata), std::move(build).value()};
}

/// Front end and compiler; what they have to say is appended to diagnostics, also on error.
Result<Compiled> load_and_compile(const Job& job, const CompileCommandOptions& options,
                                  std::vector<Diagnostic>& diagnostics) {
    auto compiled = options.image.image.empty() ? load_and_compile_drawing(job, options, diagnostics)
                                                : load_and_compile_image(job, options, diagnostics);
    if (!compiled) return compiled;
    const std::vector<Diagnostic>& found = compiled.value().build.report.diagnostics;
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
    return compiled;
}

CompileOutcome outcome_of(const Job& job, const fetex::FbtTexture& fbt, CompileReport report) {
    CompileOutcome outcome;
    outcome.input = job.input;
    outcome.output = job.output;
    outcome.width = fbt.width;
    outcome.height = fbt.height;
    outcome.gpu_bytes = fetex::fbt_gpu_bytes(fbt);
    outcome.samples = fbt.sample_format;
    outcome.traits = fbt.traits;
    outcome.report = std::move(report);
    return outcome;
}

Result<CompileOutcome> compile_job(const Job& job, const CompileCommandOptions& options,
                                   std::vector<Diagnostic>& diagnostics) {
    const auto start = std::chrono::steady_clock::now();
    auto compiled = load_and_compile(job, options, diagnostics);
    if (!compiled) return compiled.error();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;

    fetex::FetexFile file;
    file.fbt = std::move(compiled.value().build.texture);
    file.metadata = std::move(compiled.value().metadata);
    const std::vector<std::uint8_t> bytes = fetex::write_file(file);
    if (const Status status = write_output(job.output, bytes); !status) return status.error();

    CompileOutcome outcome = outcome_of(job, *file.fbt, std::move(compiled.value().build.report));
    outcome.report.diagnostics = diagnostics;
    outcome.file_bytes = bytes.size();
    outcome.milliseconds = elapsed.count();
    return outcome;
}

Status write_depfile(const CompileCommandOptions& options, const std::vector<CompileOutcome>& outcomes) {
    std::vector<DepfileRule> rules;
    for (const CompileOutcome& outcome : outcomes) {
        DepfileRule rule{outcome.output, {}};
        if (outcome.input != "-") rule.inputs.push_back(outcome.input);
        if (!options.image.features.empty()) rule.inputs.push_back(options.image.features);
        rule.inputs.insert(rule.inputs.end(), options.scene.fonts.begin(), options.scene.fonts.end());
        rules.push_back(std::move(rule));
    }
    const auto text = depfile_text(rules);
    if (!text) return text.error();
    return write_output(options.depfile, text.value());
}

/// On stdout, unless the texture goes there.
void print_report(const CompileCommandOptions& options, const std::vector<CompileOutcome>& outcomes) {
    const bool stdout_taken =
        std::any_of(outcomes.begin(), outcomes.end(), [](const auto& o) { return o.output == "-"; });
    std::FILE* stream = stdout_taken ? stderr : stdout;
    if (options.report == "json") fmt::print(stream, "{}", report_json(outcomes));
    if (options.report == "text") {
        for (const CompileOutcome& outcome : outcomes)
            fmt::print(stream, "{}", report_text(outcome));
    }
}

/// What the options' own conditions don't say.
Status check_inputs(const CompileCommandOptions& options) {
    const auto usage = [](const char* message) { return Error{ErrorClass::Usage, diag::kBadUsage, message, {}}; };
    const ImageOptions& image = options.image;
    if (image.image.empty())
        return options.inputs.empty() ? usage("inputs is required: SVG files, or --image") : Status();
    if (!options.inputs.empty()) return usage("--image goes alone: no other inputs");
    if (image.image == "-" || image.features == "-") return usage("--image and --features take files, not stdin");
    if (image.features.empty() && !image.trace) return usage("--image needs --features or --trace");
    return {};
}

Result<Plan> prepare(const CompileCommandOptions& options) {
    if (const Status status = check_inputs(options); !status) return status.error();
    const bool image = !options.image.image.empty();
    auto plan = plan_outputs(image ? std::vector{options.image.image} : options.inputs, options.output);
    if (!plan) return plan;
    if (image && same_file(options.image.features, plan.value().jobs[0].output))
        return Error{ErrorClass::Usage, diag::kWouldOverwriteInput, "the output would overwrite an input",
                     plan.value().jobs[0].output};
    if (!options.depfile.empty()) {
        if (const Status status = check_depfile(options.depfile, plan.value().jobs); !status) return status.error();
    }
    if (!plan.value().folder.empty()) {
        if (const Status status = make_folder(plan.value().folder); !status) return status.error();
    }
    return plan;
}

/// Every input is tried; the exit code is that of the first failure. The dependency file is written only when all
/// succeeded, as a build tool expects.
int run_compile(const CompileCommandOptions& options) {
    const auto plan = prepare(options);
    if (!plan) return report_error(plan.error());
    int exit = kExitOk;
    std::vector<CompileOutcome> outcomes;
    for (const Job& job : plan.value().jobs) {
        std::vector<Diagnostic> diagnostics;
        auto outcome = compile_job(job, options, diagnostics);
        print_diagnostics(diagnostics, job.input, options.quiet);
        if (outcome) {
            outcomes.push_back(std::move(outcome).value());
        } else {
            const int code = report_error(outcome.error(), job.input);
            if (exit == kExitOk) exit = code;
        }
    }
    print_report(options, outcomes);
    if (exit == kExitOk && !options.depfile.empty()) {
        if (const Status status = write_depfile(options, outcomes); !status) return report_error(status.error());
    }
    return exit;
}

} // namespace

Command add_compile_command(CLI::App& parent) {
    const auto options = std::make_shared<CompileCommandOptions>();
    CLI::App* app = parent.add_subcommand("compile", "Turn SVG files, or an image with features, into .fetex textures");
    app->add_option("inputs", options->inputs, "SVG or SVGZ files, or - for stdin")->type_name("FILE");
    app->add_option("-o,--output", options->output,
                    "File for one input, folder for several, - for stdout; default: beside each input")
        ->type_name("PATH");
    app->add_option("--repr", options->representation, "Representation: fbt (default)")
        ->check(CLI::IsMember({"fbt"}))
        ->type_name("NAME");
    CLI::Option* size = add_size_or_auto_option(
        *app, options->size, "Texels: both sides, or the longer one (default 128); auto: as few as cheap lookups need");
    app->add_option("--max-bytes", options->max_bytes,
                    "The largest size, to 1/64, with at most so many bytes on the GPU")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->excludes(size)
        ->type_name("N");
    app->add_flag("--mips,!--no-mips", options->mips,
                  "A mip chain too, for views of more than a texel a pixel; without (default) they need supersampling");
    app->add_option("--samples", options->samples,
                    "Gradients' colours in 8 (default) or 16 bits a channel, or as 16-bit floats, which of an --image "
                    "keep what is brighter than white")
        ->check(CLI::IsMember({"8", "16", "float"}))
        ->type_name("FORMAT");
    app->add_option("-j,--jobs", options->threads, "Threads; 0 (default) is one per core. Never changes the output")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    app->add_option("--report", options->report,
                    "Say what was made and what was skipped: text, or json (cli/schema/compile_report.schema.json)")
        ->check(CLI::IsMember({"text", "json"}))
        ->type_name("FORMAT");
    app->add_option("--depfile", options->depfile, "Write a dependency file for Make or Ninja")->type_name("FILE");
    add_image_options(*app, options->image);
    add_scene_options(*app, options->scene);
    app->add_option("--no-skip", options->no_skip, "Switch off a rule that leaves out work (tests/bench)")
        ->take_all()
        ->check(CLI::IsMember(skip_rule_names()))
        ->group(""); // hidden
    add_quiet_option(*app, options->quiet);
    return {app, [options, size] {
                options->size_given = size->count() > 0;
                return run_compile(*options);
            }};
}

} // namespace fetexc::cli
