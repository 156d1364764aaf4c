// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile`: vector art, or an image with features, in, .fetex out.
#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/compile_bilevel.h"
#include "cli/compile_curves.h"
#include "cli/compile_image.h"
#include "cli/compile_pinchmap.h"
#include "cli/compile_silmap.h"
#include "cli/depfile.h"
#include "cli/fetex_input.h"
#include "cli/io.h"
#include "cli/load_scene.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/version.h"
#include "compiler/diagnostics.h"
#include "formats/fbt_mip.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kDefaultTexels = 128; ///< longer side, when --size isn't given

struct CompileCommandOptions {
    std::vector<std::string> inputs;
    std::string output, depfile, report;
    std::vector<std::string> representations = {"fbt"};
    SizeValue size{0, 0, kDefaultTexels};
    bool size_given = false;
    SceneOptions scene;
    ImageOptions image;
    BilevelCommandOptions bilevel;
    SilmapCommandOptions silmap;
    PinchmapCommandOptions pinchmap;
    CurvesCommandOptions curves;
    bool silhouette_given = false;
    /// Options, and the representations of which one must be made for them to mean anything.
    struct OptionsFor {
        std::vector<CLI::Option*> options;
        std::vector<std::string> representations;
    };
    std::vector<OptionsFor> only_for;
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

bool makes(const CompileCommandOptions& options, const char* representation) {
    return std::ranges::count(options.representations, representation) > 0;
}

/// What an input became.
struct Compiled {
    std::string source_hash, features_hash; ///< empty: none
    std::optional<FbtBuild> fbt;
    std::optional<CompiledBilevel> bilevel;
    std::optional<SilmapBuild> silmap;
    std::optional<PinchmapBuild> pinchmap;
    std::optional<CompiledCurves> curves;
    CompileReport report; ///< the FBT's if there is one
};

SilmapRequest silmap_request(const CompileCommandOptions& options, const Extent& extent) {
    SilmapRequest request;
    request.how = options.silmap;
    request.size = grid_of(options.size, extent), request.automatic = options.size.automatic;
    request.max_bytes = options.max_bytes, request.samples = options.samples;
    request.mips = options.mips, request.threads = options.threads;
    request.skip = skip_rules_without(options.no_skip);
    return request;
}

PinchmapRequest pinchmap_request(const CompileCommandOptions& options, const Extent& extent) {
    PinchmapRequest request;
    request.how = options.pinchmap, request.max_wrong_ppm = options.silmap.max_wrong_ppm;
    if (options.silhouette_given) request.silhouette = options.bilevel.silhouette;
    request.size = grid_of(options.size, extent), request.automatic = options.size.automatic;
    request.max_bytes = options.max_bytes, request.samples = options.samples;
    request.mips = options.mips, request.threads = options.threads;
    return request;
}

CurvesRequest curves_request(const CompileCommandOptions& options) {
    CurvesRequest request;
    request.how = options.curves, request.size = options.size;
    request.max_bytes = options.max_bytes, request.samples = options.samples, request.threads = options.threads;
    request.mips = options.mips;
    return request;
}

/// What the file says about its own making. Nothing that differs between two runs or two folders.
std::string options_text(const Compiled& compiled, const CompileCommandOptions& options) {
    std::string text = fmt::format("repr={}", fmt::join(options.representations, ","));
    if (compiled.fbt) text += fmt::format(" size={}x{}", compiled.fbt->texture.width, compiled.fbt->texture.height);
    if ((compiled.fbt || compiled.silmap) && (!compiled.features_hash.empty() || options.image.trace))
        text += fmt::format(" invalidate={}", options.image.invalidate);
    if (options.image.values.data) text += " data";
    if (options.mips) text += " mips";
    if (options.samples != "8") text += " samples=" + options.samples;
    if (options.image.trace)
        text += fmt::format(" trace-contrast={} trace-speck={}", options.image.tracing.contrast,
                            options.image.tracing.speck);
    if (options.scene.raster_size != 0) text += fmt::format(" raster-size={}", options.scene.raster_size);
    const auto add = [&](const char* name, const auto& texture, const std::string& how) {
        const char* prefix = options.representations.size() > 1 ? name : "";
        text += fmt::format(" {}size={}x{} {}", prefix, texture.width, texture.height, how);
    };
    if (compiled.bilevel) add("bilevel-", compiled.bilevel->build.texture, compiled.bilevel->options);
    if (compiled.silmap) add("silmap-", compiled.silmap->texture, options_text(silmap_request(options, {})));
    if (compiled.pinchmap) add("pinchmap-", compiled.pinchmap->texture, options_text(pinchmap_request(options, {})));
    if (compiled.curves)
        add("curves-", compiled.curves->build.texture, options_text(curves_request(options), compiled.curves->build));
    return text;
}

fetex::Metadata metadata_for(const Compiled& compiled, const CompileCommandOptions& options) {
    fetex::Metadata metadata{{"generator", "fetexc " + version_number()},
                             {"options", options_text(compiled, options)},
                             {"source.xxh128", compiled.source_hash}};
    if (!compiled.features_hash.empty()) metadata.emplace("features.xxh128", compiled.features_hash);
    if (compiled.bilevel && !compiled.bilevel->image_hash.empty())
        metadata.emplace("above-image.xxh128", compiled.bilevel->image_hash);
    if (compiled.curves && !compiled.curves->base_hash.empty())
        metadata.emplace("base.xxh128", compiled.curves->base_hash);
    return metadata;
}

CompileOptions compile_options(const CompileCommandOptions& options, const Extent& extent) {
    return {grid_of(options.size, extent), options.threads, skip_rules_without(options.no_skip), options.mips,
            sample_format(options)};
}

/// Of a drawing or a bitmap. silhouette: what found it, or why there is none.
Status add_bilevel(const Result<Silhouette>& silhouette, const CompileCommandOptions& options,
                   const ProgressSink& progress, std::vector<Diagnostic>& diagnostics, Compiled& compiled) {
    if (!silhouette) return silhouette.error();
    BilevelRequest request;
    request.how = options.bilevel, request.max_bytes = options.max_bytes;
    request.mips = options.mips, request.threads = options.threads;
    if (options.size_given) request.size = options.size;
    auto built = compile_silhouette(silhouette.value(), request, progress, diagnostics);
    if (!built) return built.error();
    compiled.bilevel = std::move(built).value();
    return {};
}

Status add_silmap(Result<SilmapBuild> built, std::vector<Diagnostic>& diagnostics, Compiled& compiled) {
    if (!built) return built.error();
    const std::vector<Diagnostic>& said = built.value().report.diagnostics;
    diagnostics.insert(diagnostics.end(), said.begin(), said.end());
    compiled.silmap = std::move(built).value();
    return {};
}

Status add_pinchmap(Result<PinchmapBuild> built, std::vector<Diagnostic>& diagnostics, Compiled& compiled) {
    if (!built) return built.error();
    const std::vector<Diagnostic>& said = built.value().diagnostics;
    diagnostics.insert(diagnostics.end(), said.begin(), said.end());
    compiled.pinchmap = std::move(built).value();
    return {};
}

Status add_fbt(Result<FbtBuild> build, Compiled& compiled) {
    if (!build) return build.error();
    compiled.fbt = std::move(build).value();
    compiled.report = compiled.fbt->report;
    return {};
}

/// FBTs and silhouette maps of an image have as many texels as pixels unless told otherwise.
Result<Compiled> load_and_compile_image(const Job& job, const CompileCommandOptions& options,
                                        std::vector<Diagnostic>& diagnostics) {
    ProgressLine progress(job.input, options.quiet);
    ImageOptions image = options.image;
    image.values.bright = sample_format(options) == fetex::FbtSampleFormat::Rgba16F;
    auto loaded = load_image(image, options.scene, options.threads, diagnostics);
    if (!loaded) return loaded.error();
    const FeaturedImage& picture = loaded.value().picture;
    Compiled compiled;
    compiled.source_hash = loaded.value().source_hash, compiled.features_hash = loaded.value().features_hash;
    compiled.report.image.width = picture.image.width, compiled.report.image.height = picture.image.height;
    if (makes(options, "fbt")) {
        CompileOptions how = compile_options(options, picture.features.extent);
        if (!options.size_given) how.size = {picture.image.width, picture.image.height};
        auto build = size_chosen(options) ? compile_fbt_at_chosen_size(picture, how, options.max_bytes, progress.sink())
                                          : compile_fbt(picture, how, progress.sink());
        if (const Status s = add_fbt(std::move(build), compiled); !s) return s.error();
    }
    if (makes(options, "bilevel")) {
        const auto silhouette = silhouette_of(picture.image, *silhouette_rule(options.bilevel.silhouette));
        if (const Status s = add_bilevel(silhouette, options, progress.sink(), diagnostics, compiled); !s)
            return s.error();
    }
    if (makes(options, "silmap")) {
        SilmapRequest request = silmap_request(options, picture.features.extent);
        if (!options.size_given) request.size = {picture.image.width, picture.image.height};
        auto built = compile_silhouette_map(picture, request, progress.sink());
        if (const Status s = add_silmap(std::move(built), diagnostics, compiled); !s) return s.error();
    }
    if (makes(options, "pinchmap")) {
        PinchmapRequest request = pinchmap_request(options, picture.features.extent);
        auto built = compile_pinched(PinchedImage{picture.image, loaded.value().features}, request, progress.sink());
        if (const Status s = add_pinchmap(std::move(built), diagnostics, compiled); !s) return s.error();
    }
    return compiled;
}

Result<Compiled> compile_drawing(const Job& job, const std::vector<std::uint8_t>& bytes,
                                 const CompileCommandOptions& options, std::vector<Diagnostic>& diagnostics) {
    ProgressLine progress(job.input, options.quiet);
    const bool chosen = size_chosen(options);
    const std::uint32_t texels =
        chosen ? kDefaultTexels : std::max({options.size.longer, options.size.width, options.size.height});
    SceneOptions scene_options = options.scene;
    scene_options.cull = skip_rules_without(options.no_skip).layers;
    auto loaded = scene_of_bytes(bytes, scene_options, texels, options.threads, diagnostics);
    if (!loaded) return loaded.error();
    const Scene& scene = loaded.value().scene;
    Compiled compiled;
    compiled.report.scene = scene.stats;
    if (makes(options, "fbt")) {
        const CompileOptions how = compile_options(options, scene.extent);
        auto build = chosen ? compile_fbt_at_chosen_size(scene, how, options.max_bytes, progress.sink())
                            : compile_fbt(scene, how, progress.sink());
        if (const Status s = add_fbt(std::move(build), compiled); !s) return s.error();
    }
    if (makes(options, "bilevel")) {
        const auto silhouette = silhouette_of(scene, *silhouette_rule(options.bilevel.silhouette), options.threads);
        if (const Status s = add_bilevel(silhouette, options, progress.sink(), diagnostics, compiled); !s)
            return s.error();
    }
    if (makes(options, "silmap")) {
        auto built = compile_silhouette_map(scene, silmap_request(options, scene.extent), progress.sink());
        if (const Status s = add_silmap(std::move(built), diagnostics, compiled); !s) return s.error();
    }
    if (makes(options, "pinchmap")) {
        auto built = compile_pinched(scene, pinchmap_request(options, scene.extent), progress.sink());
        if (const Status s = add_pinchmap(std::move(built), diagnostics, compiled); !s) return s.error();
    }
    return compiled;
}

/// A network as it is, a drawing for what of it is a curve.
Status add_curves(const std::vector<std::uint8_t>& bytes, const CompileCommandOptions& options,
                  const ProgressSink& progress, std::vector<Diagnostic>& diagnostics, Compiled& compiled) {
    const auto network = network_of_bytes(bytes, options.curves.curves, options.scene, options.threads, diagnostics);
    if (!network) return network.error();
    auto built = compile_curves(network.value(), curves_request(options), progress, diagnostics);
    if (!built) return built.error();
    compiled.curves = std::move(built).value();
    return {};
}

Error usage(std::string message) { return {ErrorClass::Usage, diag::kBadUsage, std::move(message), {}}; }

bool makes_only_curves(const CompileCommandOptions& options) {
    return std::ranges::all_of(options.representations, [](const std::string& name) { return name == "curves"; });
}

/// A file on disk, read once for all representations.
Result<Compiled> load_and_compile_input(const Job& job, const CompileCommandOptions& options,
                                        std::vector<Diagnostic>& diagnostics) {
    const auto bytes = read_input(job.input, SvgLimits{}.bytes);
    if (!bytes) return bytes.error();
    const bool only_curves = makes_only_curves(options);
    if (!only_curves && is_network(bytes.value())) return usage("a network is for --repr curves alone");
    Compiled compiled;
    if (!only_curves) {
        auto drawing = compile_drawing(job, bytes.value(), options, diagnostics);
        if (!drawing) return drawing;
        compiled = std::move(drawing).value();
    }
    compiled.source_hash = hash_of(bytes.value());
    if (makes(options, "curves")) {
        ProgressLine progress(job.input, options.quiet);
        if (const Status s = add_curves(bytes.value(), options, progress.sink(), diagnostics, compiled); !s)
            return s.error();
    }
    return compiled;
}

/// Front end and compiler; what they have to say is appended to diagnostics, also on error.
Result<Compiled> load_and_compile(const Job& job, const CompileCommandOptions& options,
                                  std::vector<Diagnostic>& diagnostics) {
    auto compiled = options.image.image.empty() ? load_and_compile_input(job, options, diagnostics)
                                                : load_and_compile_image(job, options, diagnostics);
    if (!compiled) return compiled;
    const std::vector<Diagnostic>& found = compiled.value().report.diagnostics;
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
    return compiled;
}

BilevelOutcome outcome_of(const BilevelBuild& build) {
    const fetex::BilevelTexture& t = build.texture;
    BilevelOutcome outcome;
    outcome.width = t.width, outcome.height = t.height, outcome.rule = t.rule;
    outcome.mip_levels = t.mips.empty() ? 0 : fetex::fbt_mip_levels(t.width, t.height);
    outcome.gpu_bytes = fetex::bilevel_gpu_bytes(t);
    outcome.image_width = t.image_width, outcome.image_height = t.image_height;
    outcome.stats = build.stats;
    return outcome;
}

CompileOutcome outcome_of(const Job& job, const Compiled& compiled) {
    CompileOutcome outcome;
    outcome.input = job.input;
    outcome.output = job.output;
    outcome.has_fbt = compiled.fbt.has_value();
    if (compiled.fbt) {
        const fetex::FbtTexture& fbt = compiled.fbt->texture;
        outcome.width = fbt.width, outcome.height = fbt.height;
        outcome.gpu_bytes = fetex::fbt_gpu_bytes(fbt);
        outcome.samples = fbt.sample_format, outcome.traits = fbt.traits;
    }
    if (compiled.bilevel) outcome.bilevel = outcome_of(compiled.bilevel->build);
    if (compiled.silmap) outcome.silmap = silmap_outcome(*compiled.silmap);
    if (compiled.pinchmap) outcome.pinchmap = pinchmap_outcome(*compiled.pinchmap);
    if (compiled.curves) {
        outcome.curves = curves_outcome(compiled.curves->build);
        outcome.curves->profile_file = compiled.curves->profile_file;
    }
    outcome.report = compiled.report;
    return outcome;
}

Result<CompileOutcome> compile_job(const Job& job, const CompileCommandOptions& options,
                                   std::vector<Diagnostic>& diagnostics) {
    const auto start = std::chrono::steady_clock::now();
    auto compiled = load_and_compile(job, options, diagnostics);
    if (!compiled) return compiled.error();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;

    CompileOutcome outcome = outcome_of(job, compiled.value());
    fetex::FetexFile file;
    file.metadata = metadata_for(compiled.value(), options);
    if (compiled.value().fbt) file.fbt = std::move(compiled.value().fbt->texture);
    if (compiled.value().bilevel) file.bilevel = std::move(compiled.value().bilevel->build.texture);
    if (compiled.value().silmap) file.silmap = std::move(compiled.value().silmap->texture);
    if (compiled.value().pinchmap) file.pinchmap = std::move(compiled.value().pinchmap->texture);
    if (compiled.value().curves) file.feature_curves = std::move(compiled.value().curves->build.texture);
    const std::vector<std::uint8_t> bytes = fetex::write_file(file);
    if (const Status status = write_output(job.output, bytes); !status) return status.error();

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
        for (const std::string& beside : {options.image.features, options.bilevel.above_image, options.curves.base}) {
            if (!beside.empty()) rule.inputs.push_back(beside);
        }
        if (outcome.curves && !outcome.curves->profile_file.empty())
            rule.inputs.push_back(outcome.curves->profile_file);
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

/// Options of a representation that isn't made.
Status check_representations(const CompileCommandOptions& options) {
    for (const std::string& name : options.representations) {
        if (std::ranges::count(options.representations, name) > 1)
            return usage(fmt::format("--repr names {} twice", name));
    }
    for (const auto& [of_some, names] : options.only_for) {
        if (std::ranges::any_of(names, [&](const std::string& name) { return makes(options, name.c_str()); })) continue;
        for (const CLI::Option* o : of_some) {
            if (o->count() > 0)
                return usage(fmt::format("{} is for --repr {}", o->get_name(), fmt::join(names, " or ")));
        }
    }
    return {};
}

/// What the options' own conditions don't say.
Status check_inputs(const CompileCommandOptions& options) {
    if (const Status status = check_representations(options); !status) return status.error();
    const ImageOptions& image = options.image;
    if (makes(options, "bilevel") && options.size.automatic)
        return usage("--size auto chooses sizes for --repr fbt, silmap, pinchmap and curves");
    if (options.samples == "rgb8" && makes(options, "fbt"))
        return usage("--samples rgb8 is for --repr silmap, pinchmap and curves alone");
    if (makes(options, "curves") && !image.image.empty())
        return usage("--repr curves takes drawings and networks; its image is --base");
    if (const Status status = check_curves_base(options.curves); !status) return status.error();
    if (options.silmap.max_wrong_ppm > 0 && !size_chosen(options))
        return usage("--max-wrong goes with --size auto or --max-bytes");
    if (options.curves.max_move > 0 && !size_chosen(options))
        return usage("--max-move goes with --size auto or --max-bytes");
    if (options.bilevel.above_image == "-") return usage("--above-image takes a file, not stdin");
    if (image.image.empty())
        return options.inputs.empty() ? usage("inputs is required: SVG files or networks, or --image") : Status();
    if (!options.inputs.empty()) return usage("--image goes alone: no other inputs");
    if (image.image == "-" || image.features == "-") return usage("--image and --features take files, not stdin");
    if (options.bilevel.silhouette.starts_with("id:")) return usage("--silhouette id:NAME is for drawings");
    const bool featured = makes(options, "fbt") || makes(options, "silmap");
    if (featured && image.features.empty() && !image.trace) return usage("--image needs --features or --trace");
    return {};
}

Result<Plan> prepare(const CompileCommandOptions& options) {
    if (const Status status = check_inputs(options); !status) return status.error();
    const bool image = !options.image.image.empty();
    auto plan = plan_outputs(image ? std::vector{options.image.image} : options.inputs, options.output);
    if (!plan) return plan;
    for (const Job& job : plan.value().jobs) {
        if (same_file(options.image.features, job.output) || same_file(options.bilevel.above_image, job.output) ||
            same_file(options.curves.base, job.output))
            return Error{ErrorClass::Usage, diag::kWouldOverwriteInput, "the output would overwrite an input",
                         job.output};
    }
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
    CLI::App* app = parent.add_subcommand(
        "compile", "Turn SVG files, networks of curves, or an image with features, into .fetex textures");
    app->add_option(
           "inputs", options->inputs,
           "SVG or SVGZ files, for --repr curves also networks (cli/schema/network.schema.json), or - for stdin")
        ->type_name("FILE");
    app->add_option("-o,--output", options->output,
                    "File for one input, folder for several, - for stdout; default: beside each input")
        ->type_name("PATH");
    app->add_option("--repr", options->representations,
                    "Representations: fbt (feature-based texture, default), bilevel (bi-level texture), silmap "
                    "(silhouette-map texture), pinchmap, curves (texture with feature curves), or several of them")
        ->delimiter(',')
        ->check(CLI::IsMember(representation_names()))
        ->type_name("NAME,...");
    CLI::Option* size = add_size_or_auto_option(
        *app, options->size,
        "Texels: both sides, or the longer one (default 128); auto: of an FBT as few as cheap lookups need, of a "
        "silhouette-map texture or a pinchmap as few as --max-wrong lets, with feature curves as --max-move does");
    app->add_option("--max-bytes", options->max_bytes,
                    "The largest size, to 1/64, with at most so many bytes on the GPU; of each representation")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->excludes(size)
        ->type_name("N");
    app->add_flag("--mips,!--no-mips", options->mips,
                  "A mip chain too, for views of more than a texel a pixel; without (default) they need supersampling");
    CLI::Option* samples =
        app->add_option(
               "--samples", options->samples,
               "Colours (of an FBT those of gradients) in 8 (default) or 16 bits a channel, or as 16-bit floats, which "
               "of an --image keep what is brighter than white; rgb8: 8 bits without alpha, of a silhouette-map "
               "texture or a pinchmap's signal")
            ->check(CLI::IsMember({"8", "16", "float", "rgb8"}))
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
    const BilevelCliOptions bilevel = add_bilevel_options(*app, options->bilevel);
    const SilmapCliOptions silmap = add_silmap_options(*app, options->silmap);
    options->only_for = {{bilevel.own, {"bilevel"}},
                         {{bilevel.silhouette}, {"bilevel", "pinchmap"}},
                         {silmap.own, {"silmap"}},
                         {{silmap.max_wrong}, {"silmap", "pinchmap"}},
                         {add_pinchmap_options(*app, options->pinchmap), {"pinchmap"}},
                         {add_curves_options(*app, options->curves), {"curves"}},
                         {{samples}, {"fbt", "silmap", "pinchmap", "curves"}},
                         {{app->get_option("--features"), app->get_option("--trace")}, {"fbt", "silmap", "pinchmap"}},
                         {{app->get_option("--invalidate")}, {"fbt", "silmap"}}};
    add_scene_options(*app, options->scene);
    app->add_option("--no-skip", options->no_skip, "Switch off a rule that leaves out work (tests/bench)")
        ->take_all()
        ->check(CLI::IsMember(skip_rule_names()))
        ->group(""); // hidden
    add_quiet_option(*app, options->quiet);
    return {app, [options, size, silhouette = bilevel.silhouette] {
                options->size_given = size->count() > 0, options->silhouette_given = silhouette->count() > 0;
                return run_compile(*options);
            }};
}

} // namespace fetexc::cli
