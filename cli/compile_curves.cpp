// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compile_curves.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/compile_image.h"
#include "cli/compile_silmap.h"
#include "cli/io.h"
#include "compiler/diagnostics.h"
#include "compiler/network/network_reader.h"
#include "compiler/network/profile_reader.h"
#include "compiler/scene/lattice.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

/// The drawing's units: what options of lengths take.
constexpr double kLeastLength = 1e-9, kMostLength = 1e12;
constexpr std::uint64_t kMaxProfileBytes = std::uint64_t{1} << 24;
constexpr std::uint32_t kMostIterations = 10000;
constexpr double kMostTexels = 65504;           // of the distance limit: the format's
constexpr std::uint32_t kFeatureTexels = 16384; // drawings' raster layers have no curves; any size does

fetex::FeatureNumberFormat numbers_of(const std::string& name) {
    if (name == "float") return fetex::FeatureNumberFormat::Float;
    return name == "half" ? fetex::FeatureNumberFormat::Half : fetex::FeatureNumberFormat::Bits16;
}

bool is_preset(const std::string& name) { return std::ranges::count(kProfilePresets, name) > 0; }

BaseImageKind base_kind(const CurvesCommandOptions& how) {
    if (how.kind == "height" || how.base_height > 0) return BaseImageKind::Height;
    return how.kind == "normal" ? BaseImageKind::Normal : BaseImageKind::Color;
}

FeatureCurvesOptions builder_options(const CurvesRequest& request) {
    FeatureCurvesOptions options;
    options.numbers = numbers_of(request.how.numbers), options.linear = request.how.linear;
    options.kind = curves_kind(request.how.kind), options.sample_format = silmap_sample_format(request.samples);
    options.mips = request.mips;
    options.limit = request.how.limit, options.smooth = request.how.smooth, options.threads = request.threads;
    options.base_color = straight_color(request.how.base_color);
    options.base = base_image(request.how, nullptr);
    return options;
}

} // namespace

fetex::FeatureKind curves_kind(const std::string& name) {
    if (name == "color") return fetex::FeatureKind::Color;
    return name == "height" ? fetex::FeatureKind::Height : fetex::FeatureKind::Normal;
}

BaseImage base_image(const CurvesCommandOptions& how, const RasterImage* image) {
    BaseImage base{image, base_kind(how), how.normal_y == "up"};
    if (how.base_height > 0) base.height_scale = how.base_height;
    return base;
}

Rgba straight_color(const std::string& text) {
    const auto color = *parse_color(text);
    return {color[0], color[1], color[2], color[3]};
}

Status check_curves_base(const CurvesCommandOptions& how) {
    const auto usage = [](const char* message) { return Error{ErrorClass::Usage, diag::kBadUsage, message, {}}; };
    if (how.kind == "height" && !how.base.empty() && !(how.base_height > 0))
        return usage("--base of heights needs --base-height");
    if (how.kind == "color" && how.base_height > 0) return usage("--base-height is for --kind normal and height");
    if (how.kind != "color" && how.base_color != CurvesCommandOptions{}.base_color)
        return usage("--base-color is for --kind color");
    if (how.base == "-") return usage("--base takes a file, not stdin");
    return {};
}

Result<std::optional<FeatureProfile>> wanted_profile(const Network& network, const CurvesCommandOptions& how,
                                                     std::string& file) {
    if (how.profile.empty()) return std::optional<FeatureProfile>();
    if (const auto own = std::ranges::find(network.profiles, how.profile, &FeatureProfile::name);
        own != network.profiles.end() && how.profile_width == 0)
        return std::optional(*own);
    if (is_preset(how.profile)) {
        const double width =
            how.profile_width > 0 ? how.profile_width : kPresetWidth * std::max(network.width, network.height);
        return preset_profile(how.profile, width);
    }
    const auto bytes = read_input(how.profile, kMaxProfileBytes);
    if (!bytes) {
        Error error = bytes.error();
        error.message += "; nor has the network a profile of that name, nor is it a preset's";
        return error;
    }
    file = how.profile;
    auto profile = read_profile(bytes.value());
    if (!profile) return profile.error();
    return std::optional(std::move(profile).value());
}

Result<LoadedBase> load_base(const CurvesCommandOptions& how, bool bright, std::vector<Diagnostic>& diagnostics) {
    LoadedBase base;
    const auto bytes = read_input(how.base, kMaxImageBytes);
    if (!bytes) return bytes.error();
    base.hash = hash_of(bytes.value());
    const ImageValues values{.bright = bright, .data = base_kind(how) != BaseImageKind::Color};
    auto image = read_image(how.base, values, diagnostics);
    if (!image) return image.error();
    base.image = std::move(image).value();
    return base;
}

bool is_network(std::span<const std::uint8_t> bytes) {
    const auto first =
        std::ranges::find_if(bytes, [](std::uint8_t c) { return c != ' ' && c != '\t' && c != '\n' && c != '\r'; });
    return first != bytes.end() && *first == '{';
}

Result<Network> network_of_bytes(const std::vector<std::uint8_t>& bytes, const std::string& curves,
                                 const SceneOptions& scene, unsigned threads, std::vector<Diagnostic>& diagnostics) {
    if (is_network(bytes)) return read_network(bytes, diagnostics);
    const SvgCurves which = curves == "strokes" ? SvgCurves::Strokes
                            : curves == "edges" ? SvgCurves::Edges
                                                : SvgCurves::All;
    auto features = load_svg_features(bytes, svg_options(scene, kFeatureTexels, threads), diagnostics, which);
    if (!features) return features.error();
    Network network = network_of(features.value());
    if (network.curves.empty())
        diagnostics.push_back({Severity::Warning,
                               diag::kNetworkEmpty,
                               fmt::format("the drawing has no {} that could be feature curves",
                                           curves == "strokes" ? "strokes" : "edges or strokes"),
                               {}});
    return network;
}

Result<CompiledCurves> compile_curves(const Network& network, const CurvesRequest& request,
                                      const ProgressSink& progress, std::vector<Diagnostic>& diagnostics) {
    FeatureCurvesOptions options = builder_options(request);
    CompiledCurves out;
    auto profile = wanted_profile(network, request.how, out.profile_file);
    if (!profile) return profile.error();
    options.profile = std::move(profile).value();
    LoadedBase base;
    if (!request.how.base.empty()) {
        const bool bright = request.samples == "float" && request.how.kind == "color";
        auto loaded = load_base(request.how, bright, diagnostics);
        if (!loaded) return loaded.error();
        base = std::move(loaded).value(), options.base.image = &base.image;
    }
    const Result<Extent> extent = make_extent(network.width, network.height);
    if (!extent) return extent.error();
    const SizeValue& size = request.size;
    options.size = size.longer != 0 ? grid_for(extent.value(), size.longer) : GridSize{size.width, size.height};
    auto build = size.automatic || request.how.max_move > 0
                     ? compile_feature_curves_at_chosen_size(network, options,
                                                             {request.how.max_move, request.max_bytes}, progress)
                 : request.max_bytes == 0
                     ? compile_feature_curves(network, options, progress)
                     : compile_feature_curves_within(network, options, request.max_bytes, progress);
    if (!build) return build.error();
    const std::vector<Diagnostic>& said = build.value().diagnostics;
    diagnostics.insert(diagnostics.end(), said.begin(), said.end());
    out.build = std::move(build).value(), out.base_hash = base.hash;
    return out;
}

std::string options_text(const CurvesRequest& request, const FeatureCurvesBuild& build) {
    const CurvesCommandOptions& how = request.how;
    std::string text = fmt::format("kind={} numbers={} limit={:g} smooth={}", how.kind, how.numbers,
                                   build.texture.distance_limit, how.smooth);
    if (how.linear) text += " linear";
    if (how.curves != "all") text += " curves=" + how.curves;
    std::string names, widths;
    for (const FeatureProfile& p : build.profiles) {
        const char* separator = &p == build.profiles.data() ? "" : ",";
        names += separator + fetex::to_valid_utf8(p.name), widths += fmt::format("{}{:g}", separator, p.width);
    }
    if (!names.empty()) text += " profile=" + names;
    text += " profile-width=" + widths;
    if (how.max_move > 0) text += fmt::format(" max-move={:g}", how.max_move);
    if (how.base_height > 0) text += fmt::format(" base-height={:g}", how.base_height);
    if (how.kind == "color" && how.base.empty()) text += " base-color=" + how.base_color;
    return text;
}

const char* kind_name(fetex::FeatureKind kind) {
    switch (kind) {
    case fetex::FeatureKind::Color:
        return "color";
    case fetex::FeatureKind::Normal:
        return "normal";
    case fetex::FeatureKind::Height:
        return "height";
    }
    return "";
}

const char* numbers_name(fetex::FeatureNumberFormat format) {
    switch (format) {
    case fetex::FeatureNumberFormat::Float:
        return "float";
    case fetex::FeatureNumberFormat::Half:
        return "half";
    case fetex::FeatureNumberFormat::Bits16:
        return "16";
    }
    return "";
}

std::vector<CLI::Option*> add_shown_options(CLI::App& app, CurvesCommandOptions& options) {
    std::vector<CLI::Option*> all;
    const auto add = [&](CLI::Option* option) {
        all.push_back(option);
        return option;
    };
    add(app.add_option("--curves", options.curves,
                       "Of a texture with feature curves: what of a drawing is one: edges, the middles of strokes "
                       "(strokes), or all (default: edges of fills, and middles)"))
        ->check(CLI::IsMember({"all", "strokes", "edges"}))
        ->type_name("NAME");
    add(app.add_option("--kind", options.kind,
                       "Of a texture with feature curves: what it shows, normals (default), colours or heights"))
        ->check(CLI::IsMember({"normal", "color", "height"}))
        ->type_name("NAME");
    CLI::Option* profile = add(
        app.add_option("--profile", options.profile,
                       "What is done near all feature curves: crease, groove, ridge, seam, one of the network's "
                       "profiles, or a JSON file of one ($defs/profile of cli/schema/network.schema.json); default: "
                       "as the network and its curves say, else crease"));
    profile->type_name("NAME|FILE");
    add(app.add_option("--profile-width", options.profile_width,
                       "How far a profile of those four reaches, in the drawing's units; default: a 64th of its "
                       "larger side"))
        ->check(number_range(kLeastLength, kMostLength))
        ->needs(profile)
        ->type_name("UNITS");
    CLI::Option* base =
        add(app.add_option("--base", options.base,
                           "What a texture with feature curves shows far from them: an image of normals, colours or "
                           "heights; default: flat"));
    base->type_name("IMAGE");
    add(app.add_option("--base-height", options.base_height,
                       "The --base is heights, of which white has so many of the drawing's units"))
        ->check(number_range(kLeastLength, kMostLength))
        ->needs(base)
        ->type_name("UNITS");
    add(app.add_option("--base-color", options.base_color,
                       "Of colours without --base, #rrggbb or #rrggbbaa; default white"))
        ->check([](const std::string& text) {
            return parse_color(text) ? std::string() : fmt::format("'{}' is not #rrggbb or #rrggbbaa", text);
        })
        ->excludes(base)
        ->type_name("COLOR");
    add(app.add_option("--normal-y", options.normal_y, "Of a --base of normals: green is up (default) or down"))
        ->check(CLI::IsMember({"up", "down"}))
        ->needs(base)
        ->type_name("WAY");
    return all;
}

std::vector<CLI::Option*> add_curves_options(CLI::App& app, CurvesCommandOptions& options) {
    std::vector<CLI::Option*> all = add_shown_options(app, options);
    const auto add = [&](CLI::Option* option) {
        all.push_back(option);
        return option;
    };
    add(app.add_option("--numbers", options.numbers,
                       "Of a texture with feature curves: its numbers, integers of 16 bits (default), half or float"))
        ->check(CLI::IsMember({"16", "half", "float"}))
        ->type_name("FORMAT");
    add(app.add_flag("--linear", options.linear,
                     "A texture with feature curves that are straight in each texel: smaller and faster"));
    add(app.add_option("--limit", options.limit,
                       "Of a texture with feature curves: texels up to which distances are known; default: as far as "
                       "the profile needs"))
        ->check(number_range(0x1p-10, kMostTexels))
        ->type_name("TEXELS");
    add(app.add_option("--smooth", options.smooth,
                       "Of a texture with feature curves: how often its gradients are smoothed (default 10)"))
        ->check(CLI::Range(0U, kMostIterations))
        ->type_name("N");
    add(app.add_option("--max-move", options.max_move,
                       "Of a texture with feature curves, with --size auto or --max-bytes: the smallest in which no "
                       "curve is farther from where it belongs, in the drawing's units"))
        ->check(number_range(kLeastLength, kMostLength))
        ->type_name("UNITS");
    return all;
}

} // namespace fetexc::cli
