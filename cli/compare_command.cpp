// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compare`: how far a texture is from the drawing it was made of, or from another one.
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cli/compare_input.h"
#include "cli/compare_outcome.h"
#include "cli/compare_truth.h"
#include "cli/difference_picture.h"
#include "cli/fetex_input.h"
#include "cli/image_file.h"
#include "cli/io.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "compiler/diagnostics.h"
#include "compiler/measure/classifier.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kDefaultPixels = 1024;
constexpr double kMaxReach = 64;       ///< texels
constexpr double kMostThreshold = 1e9; ///< no figure is larger

struct CompareOptions {
    std::string truth, other, diff;
    std::string representation;         ///< of OTHER; empty: what it holds
    std::vector<std::uint32_t> sizes;   ///< pixels on the longer side
    std::vector<double> magnifications; ///< pixels a texel of the other
    double reach = measure::MeasureOptions{}.reach;
    TruthOptions how; ///< of TRUTH
    Thresholds thresholds;
    bool json = false;
};

Error usage(std::string message, std::string place = {}) {
    return {ErrorClass::Usage, diag::kBadUsage, std::move(message), std::move(place)};
}

/// The sizes asked for, then the magnifications.
Result<std::vector<GridSize>> output_sizes(const CompareOptions& options, double aspect, GridSize texels) {
    std::vector<GridSize> sizes;
    for (const std::uint32_t longer : options.sizes) {
        const PixelSize size = resolve_size({0, 0, longer}, aspect);
        sizes.push_back({size.width, size.height});
    }
    for (const double magnification : options.magnifications) {
        const double width = std::round(texels.width * magnification),
                     height = std::round(texels.height * magnification);
        if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
            return usage(fmt::format("--magnification {:g} of {} x {} texels gives no output size from 1 to {}",
                                     magnification, texels.width, texels.height, kMaxSide));
        sizes.push_back({static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)});
    }
    return sizes;
}

/// The texture among OTHER's that the comparison is of, if it is one with feature curves.
const fetex::FeatureCurvesTexture* curves_texture(const ComparedPicture& other) {
    return other.asset && other.asset->feature_curves ? &*other.asset->feature_curves : nullptr;
}

void measure_curves(const measure::CurveTruth& truth, const ComparedPicture& other, const std::vector<GridSize>& sizes,
                    const CompareOptions& options, CompareOutcome& outcome) {
    measure::CurveMeasureOptions how;
    how.reach = options.reach, how.threads = options.how.threads, how.seen = seen_colors(options.how);
    for (const GridSize size : sizes) // one after the other takes less memory
        outcome.curve_errors.push_back(measure::curve_errors(truth, *other.picture, curves_texture(other), size, how));
    outcome.texel_side = measure::texel_side(truth, *other.picture), outcome.height = truth.height();
}

/// Fills in the figures.
Status measure_all(const TruthFile& truth, const ComparedPicture& other, const std::vector<GridSize>& sizes,
                   const CompareOptions& options, CompareOutcome& outcome) {
    const unsigned threads = options.how.threads;
    if (truth.curves) {
        measure_curves(*truth.curves, other, sizes, options, outcome);
        return {};
    }
    if (!truth.scene) {
        for (const GridSize size : sizes)
            outcome.differences.push_back(measure::difference(*truth.picture.picture, *other.picture, size, threads));
        return {};
    }
    measure::MeasureOptions how;
    how.sizes = sizes, how.reach = options.reach, how.threads = threads;
    auto errors = measure::measure(*truth.scene, *other.picture, how);
    if (!errors) return errors.error();
    outcome.errors = std::move(errors).value();
    outcome.texel_side = measure::texel_side(*truth.scene, *other.picture);
    outcome.height = truth.scene->height();
    return {};
}

/// As it is compared.
std::vector<Rgba> seen_means(const TruthFile& truth, const measure::Picture& picture, GridSize pixels,
                             const CompareOptions& options) {
    const auto seen = seen_colors(options.how);
    const auto how = truth.curves ? measure::PixelMeans::Smooth : measure::PixelMeans::Jumps;
    const unsigned threads = options.how.threads;
    return seen ? measure::box_means(measure::SeenPicture(picture, seen), pixels, threads, how)
                : measure::box_means(picture, pixels, threads, how);
}

Result<std::vector<Rgba>> truth_means(const TruthFile& truth, GridSize pixels, const CompareOptions& options) {
    if (truth.scene) return truth.scene->picture(pixels, options.how.threads);
    const measure::Picture* picture = truth.curves.get();
    return seen_means(truth, picture != nullptr ? *picture : *truth.picture.picture, pixels, options);
}

Status write_difference(const TruthFile& truth, const measure::Picture& other, GridSize pixels,
                        const CompareOptions& options) {
    const auto expected = truth_means(truth, pixels, options);
    if (!expected) return expected.error();
    const auto png =
        encode_png(difference_picture(expected.value(), seen_means(truth, other, pixels, options), pixels));
    if (!png) return at(options.diff, png.error());
    return write_output(options.diff, png.value());
}

Status check_options(const CompareOptions& options) {
    if (options.truth == "-" && options.other == "-") return usage("only one of the files can be stdin");
    if (options.thresholds.distance && *options.thresholds.distance > options.reach)
        return usage(
            fmt::format("--max-distance {:g} is beyond --reach {:g}", *options.thresholds.distance, options.reach));
    for (const std::string& input : {options.truth, options.other, options.how.curves.base}) {
        if (same_file(input, options.diff))
            return Error{ErrorClass::Usage, diag::kWouldOverwriteInput, "the output would overwrite an input",
                         options.diff};
    }
    if (options.diff == "-") return usage("--diff needs a file: stdout has the figures");
    return options.diff.empty() ? Status() : check_output(options.diff);
}

Status check_difference_size(GridSize pixels, const CompareOptions& options) {
    if (options.diff.empty() || std::uint64_t{pixels.width} * pixels.height <= fetex::kMaxImagePixels) return {};
    return usage(fmt::format("--diff takes at most {} pixels, and the last size is {} x {}", fetex::kMaxImagePixels,
                             pixels.width, pixels.height));
}

Status check_kinds(const ComparedFile& truth, const ComparedFile& other, const CompareOptions& options) {
    if (other.kind == FileKind::Svg || other.kind == FileKind::Network)
        return usage("OTHER must be a .fetex or a PNG; a drawing or a network can only be the truth", other.path);
    const Thresholds& t = options.thresholds;
    if (truth.kind != FileKind::Svg && truth.kind != FileKind::Network && (t.misclassified || t.distance || t.islands))
        return usage("--max-misclassified, --max-distance and --max-islands need an SVG as TRUTH", truth.path);
    if (!options.representation.empty() && other.kind != FileKind::Asset)
        return usage("--repr is for a .fetex", options.other);
    return {};
}

/// Thresholds of figures that there aren't.
Status check_curve_thresholds(const ComparedPicture& other, const CompareOptions& options) {
    const Thresholds& t = options.thresholds;
    if (t.misclassified || t.islands)
        return usage("--max-misclassified and --max-islands are for drawings, not for what is done near curves",
                     options.truth);
    if (t.distance && curves_texture(other) == nullptr)
        return usage("--max-distance of a network's curves needs a texture with feature curves as OTHER",
                     options.other);
    return {};
}

Result<CompareOutcome> compare(const CompareOptions& options) {
    if (const Status status = check_options(options); !status) return status.error();
    const auto truth_file = read_compared(options.truth), other_file = read_compared(options.other);
    if (!truth_file) return truth_file.error();
    if (!other_file) return other_file.error();
    if (const Status status = check_kinds(truth_file.value(), other_file.value(), options); !status)
        return status.error();
    const auto filter =
        options.how.nearest ? measure::BitmapPicture::Filter::Nearest : measure::BitmapPicture::Filter::Bilinear;
    const auto other = picture_of(other_file.value(), filter, options.representation);
    if (!other) return other.error();
    const measure::Picture& picture = *other.value().picture;
    if (is_curve_truth(truth_file.value(), other.value(), options.how)) {
        if (const Status status = check_curve_thresholds(other.value(), options); !status) return status.error();
    }
    const auto truth = load_truth(truth_file.value(), other.value(), options.how);
    if (!truth) return truth.error();
    const auto sizes = output_sizes(options, truth.value().aspect(), picture.texels());
    if (!sizes) return sizes.error();
    if (const Status status = check_difference_size(sizes.value().back(), options); !status) return status.error();

    CompareOutcome outcome;
    outcome.truth = options.truth, outcome.other = options.other;
    outcome.truth_kind = truth.value().description, outcome.other_kind = other.value().description;
    outcome.texels = picture.texels(), outcome.gpu_bytes = picture.gpu_bytes();
    if (const Status status = measure_all(truth.value(), other.value(), sizes.value(), options, outcome); !status)
        return at(options.truth, status.error());
    outcome.checks = check(outcome, options.thresholds);
    if (!options.diff.empty()) {
        const Status status = write_difference(truth.value(), picture, sizes.value().back(), options);
        if (!status) return status.error();
    }
    return outcome;
}

int run_compare(CompareOptions options) {
    if (options.sizes.empty() && options.magnifications.empty()) options.sizes = {kDefaultPixels};
    const auto outcome = compare(options);
    if (!outcome) return report_error(outcome.error());
    fmt::print("{}", options.json ? compare_json(outcome.value()) : compare_text(outcome.value()));
    for (const ThresholdCheck& c : outcome.value().checks) {
        if (!c.passed)
            print_message(
                describe(Diagnostic{Severity::Error, diag::kBeyondThreshold, describe(c), {}}, options.other));
    }
    return all_passed(outcome.value()) ? kExitOk : kExitDifference;
}

void add_threshold(CLI::App& app, const std::string& name, std::optional<double>& value, const std::string& help,
                   const std::string& unit) {
    app.add_option(name, value, help)->check(number_range(0, kMostThreshold))->type_name(unit);
}

void add_thresholds(CLI::App& app, Thresholds& t) {
    add_threshold(app, "--max-misclassified", t.misclassified, "Exit 7 when more of the area shows a wrong colour",
                  "PPM");
    add_threshold(app, "--max-distance", t.distance, "Exit 7 when an edge is farther from where it belongs, either way",
                  "TEXELS");
    add_threshold(app, "--min-psnr", t.psnr, "Exit 7 when the anti-aliased picture is worse", "DB");
    add_threshold(app, "--max-color", t.color,
                  "Exit 7 when a colour (away from edges, if TRUTH is an SVG) is off by more than N/255", "N");
    add_threshold(app, "--max-islands", t.islands, "Exit 7 when more islands are lost or false", "N");
}

} // namespace

Command add_compare_command(CLI::App& parent) {
    const auto options = std::make_shared<CompareOptions>();
    CLI::App* app =
        parent.add_subcommand("compare", "Say how far a texture is from a drawing, or from another texture");
    app->add_option("truth", options->truth,
                    "What is right: an SVG, a network of curves, a .fetex or a PNG; - for stdin")
        ->required()
        ->type_name("TRUTH");
    app->add_option("other", options->other, "What is judged: a .fetex or a PNG; - for stdin")
        ->required()
        ->type_name("OTHER");
    app->add_option(
           "--repr", options->representation,
           "What of OTHER: fbt, bilevel, silmap, pinchmap or curves; default: the first of these that it holds")
        ->check(CLI::IsMember(representation_names()))
        ->type_name("NAME");
    app->add_option("--size", options->sizes, "Output sizes: pixels on the longer side (default 1024)")
        ->delimiter(',')
        ->check(CLI::Range(1u, kMaxSide))
        ->type_name("N,...");
    app->add_option("--magnification", options->magnifications, "Output sizes: pixels a texel of OTHER")
        ->delimiter(',')
        ->check(number_range(1.0 / kMaxSide, kMaxSide))
        ->type_name("X,...");
    app->add_flag("--nearest", options->how.nearest, "Look PNGs up without interpolation; default: bilinear");
    app->add_option("--reach", options->reach,
                    "Texels within which edges are looked for and colours may come from the other side (default 1.5)")
        ->check(number_range(0.1, kMaxReach))
        ->type_name("TEXELS");
    add_thresholds(*app, options->thresholds);
    app->add_option("--diff", options->diff,
                    "Write a PNG of the last size: the truth in grey, wrong pixels from yellow (2/255) to black")
        ->type_name("FILE");
    app->add_flag("--json", options->json, "Print JSON (cli/schema/compare.schema.json)");
    app->add_option("-j,--jobs", options->how.threads,
                    "Threads; 0 (default) is one per core. Never changes the figures")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    add_scene_options(*app, options->how.scene);
    add_quiet_option(*app, options->how.quiet);
    add_light_option(*app, options->how.light);
    const std::vector<CLI::Option*> shown = add_shown_options(*app, options->how.curves);
    return {app, [options, app, shown] {
                options->how.curves_given = app->count("--curves") > 0,
                options->how.kind_given = app->count("--kind") > 0;
                for (const CLI::Option* o : shown) {
                    if (o->count() > 0) options->how.curve_option = o->get_name();
                }
                if (options->how.light) options->how.curve_option = "--light";
                return run_compare(*options);
            }};
}

} // namespace fetexc::cli
