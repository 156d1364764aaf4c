// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compare_truth.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/messages.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

using fetex::FeatureKind;

Error usage(std::string message, std::string place) {
    return {ErrorClass::Usage, diag::kBadUsage, std::move(message), std::move(place)};
}

const fetex::FeatureCurvesTexture* curves_texture(const ComparedPicture& other) {
    return other.asset && other.asset->feature_curves ? &*other.asset->feature_curves : nullptr;
}

Result<TruthFile> scene_truth(const ComparedFile& file, GridSize texels, const TruthOptions& options) {
    std::vector<Diagnostic> diagnostics;
    auto loaded =
        scene_of_bytes(file.bytes, options.scene, std::max(texels.width, texels.height), options.threads, diagnostics);
    print_diagnostics(diagnostics, file.path, options.quiet);
    if (!loaded) return at(file.path, loaded.error());
    TruthFile out;
    out.loaded = std::make_unique<const LoadedScene>(std::move(loaded).value());
    auto truth = measure::Truth::of(out.loaded->scene, options.threads);
    if (!truth) return at(file.path, truth.error());
    out.scene = std::move(truth).value();
    out.description = fmt::format("drawing of {:.6g} x {:.6g} units, {} visible edges", out.loaded->scene.extent.width,
                                  out.loaded->scene.extent.height, out.scene->edges().size());
    return out;
}

Result<TruthFile> picture_truth(const ComparedFile& file, const TruthOptions& options) {
    auto picture = picture_of(file, options.nearest ? measure::BitmapPicture::Filter::Nearest
                                                    : measure::BitmapPicture::Filter::Bilinear);
    if (!picture) return picture.error();
    TruthFile out;
    out.picture = std::move(picture).value();
    out.description = out.picture.description;
    return out;
}

/// What a texture with feature curves says of itself, else what the options do.
Result<CurvesCommandOptions> curve_options(const ComparedFile& file, const ComparedPicture& other,
                                           const TruthOptions& options) {
    CurvesCommandOptions how = options.curves;
    if (const auto* texture = curves_texture(other)) {
        if (options.kind_given && how.kind != kind_name(texture->kind))
            return usage(fmt::format("--kind {}, but OTHER is one of {}s", how.kind, kind_name(texture->kind)), "");
        how.kind = kind_name(texture->kind);
    }
    if (const Status s = check_curves_base(how); !s) return s.error();
    if (options.light && how.kind != "normal") return usage("--light is for normals", file.path);
    return how;
}

/// Floats, as tables have them: the texture's profile with that number is this one.
bool has_profile(const fetex::FeatureCurvesTexture& texture, std::size_t number, const FeatureProfile& profile,
                 double scale) {
    const std::size_t entries = fetex::feature_profile_entries(texture);
    const double step = static_cast<double>(texture.distance_limit) / static_cast<double>(entries - 1) / scale;
    for (std::size_t k = 0; k < entries; ++k) {
        const double d = static_cast<double>(k) * step;
        const fetex::FeatureProfileEntry& e = texture.profile[number * entries + k];
        if (e.slope != static_cast<float>(profile_slope(profile, d)) ||
            e.blend != static_cast<float>(profile_blend(profile, d)))
            return false;
    }
    return true;
}

/// Each of the texture's profiles is one that the truth has.
bool has_profiles_of(const fetex::FeatureCurvesTexture& texture, const CurveProfiles& truth, double scale) {
    for (std::size_t n = 0; n < texture.profiles; ++n) {
        if (std::ranges::none_of(truth.profiles,
                                 [&](const FeatureProfile& p) { return has_profile(texture, n, p, scale); }))
            return false;
    }
    return true;
}

/// Errors that come from options forgotten look like errors of the texture.
std::vector<Diagnostic> other_truth(const ComparedPicture& other, const Network& network, const CurveProfiles& profiles,
                                    const std::string& base_hash) {
    std::vector<Diagnostic> out;
    const auto* texture = curves_texture(other);
    if (texture == nullptr) return out;
    const auto say = [&](const char* what) { out.push_back({Severity::Warning, diag::kFeatureOtherTruth, what, ""}); };
    const auto& metadata = other.asset->metadata;
    const auto base = metadata.find("base.xxh128");
    if ((base == metadata.end() ? std::string() : base->second) != base_hash)
        say(base_hash.empty() ? "the texture was made with a base map, the truth has none (--base)"
                              : "the texture was made with another base map than the truth's, or with none");
    const double scale = texels_per_unit(network, {texture->width, texture->height});
    if (!has_profiles_of(*texture, profiles, scale))
        say("the texture was made with another profile than the truth's (--profile, --profile-width)");
    return out;
}

measure::CurveTruthOptions truth_options(const CurvesCommandOptions& how, const ComparedPicture& other,
                                         const LoadedBase* base, const Network& network) {
    measure::CurveTruthOptions out;
    out.kind = curves_kind(how.kind);
    out.base = base_image(how, base != nullptr ? &base->image : nullptr);
    out.base_color = straight_color(how.base_color);
    if (const auto* texture = curves_texture(other))
        out.white_height =
            static_cast<double>(texture->height_scale) / texels_per_unit(network, {texture->width, texture->height});
    return out;
}

Result<TruthFile> network_truth(const ComparedFile& file, const ComparedPicture& other, const TruthOptions& options) {
    const auto how = curve_options(file, other, options);
    if (!how) return how.error();
    std::vector<Diagnostic> diagnostics;
    TruthFile out;
    const auto load = [&]() -> Status {
        const auto network =
            network_of_bytes(file.bytes, how.value().curves, options.scene, options.threads, diagnostics);
        if (!network) return at(file.path, network.error());
        std::string profile_file;
        const auto profile = wanted_profile(network.value(), how.value(), profile_file);
        if (!profile) return profile.error();
        if (!how.value().base.empty()) {
            const auto* texture = curves_texture(other);
            const bool bright = texture != nullptr && texture->kind == FeatureKind::Color &&
                                texture->base_format == fetex::FeatureSampleFormat::Rgba16F;
            auto base = load_base(how.value(), bright, diagnostics);
            if (!base) return base.error();
            out.base = std::make_unique<const LoadedBase>(std::move(base).value());
        }
        CurveProfiles profiles = curve_profiles(network.value(), profile.value());
        for (Diagnostic& d : other_truth(other, network.value(), profiles, out.base ? out.base->hash : ""))
            diagnostics.push_back(std::move(d));
        out.description = fmt::format("network of {:.6g} x {:.6g} units, {} curves, {}s{}", network.value().width,
                                      network.value().height, network.value().curves.size(), how.value().kind,
                                      out.base ? " over a base map" : "");
        out.curves = std::make_unique<const measure::CurveTruth>(
            network.value(), std::move(profiles), truth_options(how.value(), other, out.base.get(), network.value()));
        return {};
    };
    const Status loaded = load();
    print_diagnostics(diagnostics, file.path, options.quiet);
    if (!loaded) return loaded.error();
    return out;
}

} // namespace

double TruthFile::aspect() const {
    if (scene) return 1 / scene->height();
    if (curves) return 1 / curves->height();
    const GridSize n = picture.picture->texels();
    return static_cast<double>(n.width) / n.height;
}

std::function<Rgba(const Rgba&)> seen_colors(const TruthOptions& options) {
    if (!options.light) return {};
    return [light = *options.light](const Rgba& c) { return lit_normal(c, light, false); };
}

bool is_curve_truth(const ComparedFile& truth, const ComparedPicture& other, const TruthOptions& options) {
    if (truth.kind == FileKind::Network) return true;
    return truth.kind == FileKind::Svg && (options.curves_given || curves_texture(other) != nullptr);
}

Result<TruthFile> load_truth(const ComparedFile& file, const ComparedPicture& other, const TruthOptions& options) {
    if (is_curve_truth(file, other, options)) return network_truth(file, other, options);
    if (!options.curve_option.empty())
        return usage(
            fmt::format("{} needs a network as TRUTH, or an SVG with --curves or a texture with feature curves",
                        options.curve_option),
            file.path);
    return file.kind == FileKind::Svg ? scene_truth(file, other.picture->texels(), options)
                                      : picture_truth(file, options);
}

} // namespace fetexc::cli
