// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compile_bilevel.h"

#include <fmt/format.h>

#include "cli/bilevel_budget.h"
#include "cli/compile_image.h"
#include "cli/io.h"
#include "cli/load_scene.h"
#include "compiler/diagnostics.h"
#include "formats/fbt_samples.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

constexpr const char* kElementPrefix = "id:";

std::uint32_t packed(const Rgba& c) {
    return fetex::fbt_pack_sample({c.r, c.g, c.b, c.a}, fetex::FbtSampleFormat::Rgba8)[0];
}

struct AboveImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> pixels;
    std::string hash;
};

Error at(const std::string& path, Error error) {
    error.place = path;
    return error;
}

Result<AboveImage> load_above_image(const std::string& path, std::vector<Diagnostic>& diagnostics) {
    AboveImage out;
    if (path.empty()) return out;
    const auto bytes = read_input(path, kMaxImageBytes);
    if (!bytes) return bytes.error();
    const auto image = read_image(path, {}, diagnostics);
    if (!image) return at(path, image.error());
    out.hash = hash_of(bytes.value());
    out.width = image.value().width, out.height = image.value().height;
    out.pixels.reserve(std::size_t{out.width} * out.height);
    for (std::uint32_t y = 0; y < out.height; ++y) {
        for (std::uint32_t x = 0; x < out.width; ++x)
            out.pixels.push_back(packed(image.value().at(x, y)));
    }
    return out;
}

BilevelOptions builder_options(const BilevelRequest& request, double height) {
    BilevelOptions options;
    options.channels = request.how.channels == "auto" ? 0 : static_cast<std::uint32_t>(request.how.channels[0] - '0');
    options.exact_size = options.channels != 0;
    options.size = request.size.longer != 0 ? grid_for({1, height}, request.size.longer)
                                            : GridSize{request.size.width, request.size.height};
    options.greys = request.how.no_mid_greys ? MidGreys::Avoid : MidGreys::Allow;
    options.mips = request.mips, options.threads = request.threads;
    return options;
}

Result<BilevelBuild> build(const Silhouette& silhouette, const BilevelRequest& request, std::uint64_t image_bytes,
                           const ProgressSink& progress) {
    const BilevelOptions options = builder_options(request, silhouette.height);
    if (request.max_bytes == 0) return compile_bilevel(silhouette, options, progress);
    if (image_bytes >= request.max_bytes)
        return Error{ErrorClass::Unsupported, diag::kFbtBudget,
                     fmt::format("the image above alone takes {} bytes", image_bytes), "--max-bytes"};
    return compile_bilevel_within(silhouette, options, request.max_bytes - image_bytes, progress);
}

std::string options_text(const BilevelRequest& request, const fetex::BilevelTexture& t) {
    std::string text =
        fmt::format("rule={} silhouette={}", rule_name(t.rule), fetex::to_valid_utf8(request.how.silhouette));
    if (request.how.no_mid_greys) text += " no-mid-greys";
    if (!t.image.empty()) text += " above-image";
    return text;
}

void warn(const BilevelStats& stats, std::vector<Diagnostic>& diagnostics) {
    const auto add = [&](std::uint64_t count, int code, const std::string& what) {
        if (count > 0) diagnostics.push_back({Severity::Warning, code, fmt::format("{} {}", count, what), ""});
    };
    const PartCounts& parts = stats.parts;
    add(parts.lost, diag::kBilevelPartsLost,
        fmt::format("parts of the silhouette don't show, they are too small; one is at u,v {:.4f},{:.4f}", parts.lost_u,
                    parts.lost_v));
    add(parts.invented, diag::kBilevelPartsFalse,
        fmt::format("parts show that the silhouette hasn't; one is at u,v {:.4f},{:.4f}", parts.invented_u,
                    parts.invented_v));
    add(stats.edges_varying, diag::kBilevelColorsVary,
        "edges of the silhouette have colours that vary: what they bound is above or below as a whole");
}

} // namespace

std::optional<SilhouetteRule> silhouette_rule(const std::string& text) {
    using Kind = SilhouetteRule::Kind;
    if (text == "two-colors") return SilhouetteRule{Kind::TwoColors, {}};
    if (text == "alpha") return SilhouetteRule{Kind::Alpha, {}};
    if (text == "luminance") return SilhouetteRule{Kind::Luminance, {}};
    const std::string_view prefix = kElementPrefix;
    if (!text.starts_with(prefix) || text.size() == prefix.size()) return std::nullopt;
    return SilhouetteRule{Kind::Element, text.substr(prefix.size())};
}

const char* rule_name(fetex::BilevelRule rule) {
    switch (rule) {
    case fetex::BilevelRule::Single:
        return "single";
    case fetex::BilevelRule::Min:
        return "min";
    case fetex::BilevelRule::Max:
        return "max";
    case fetex::BilevelRule::Median:
        return "median";
    }
    return "";
}

Result<CompiledBilevel> compile_silhouette(const Silhouette& silhouette, const BilevelRequest& request,
                                           const ProgressSink& progress, std::vector<Diagnostic>& diagnostics) {
    auto image = load_above_image(request.how.above_image, diagnostics);
    if (!image) return image.error();
    auto built = build(silhouette, request, 4 * std::uint64_t{image.value().pixels.size()}, progress);
    if (!built) return built.error();
    CompiledBilevel out{std::move(built).value(), {}, std::move(image.value().hash)};
    fetex::BilevelTexture& t = out.build.texture;
    t.image_width = image.value().width, t.image_height = image.value().height;
    t.image = std::move(image.value().pixels);
    out.options = options_text(request, t);
    warn(out.build.stats, diagnostics);
    return out;
}

BilevelCliOptions add_bilevel_options(CLI::App& app, BilevelCommandOptions& options) {
    CLI::Option* silhouette =
        app.add_option(
               "--silhouette", options.silhouette,
               "What a bi-level texture shows: two-colors (default; other drawings are refused), alpha (above "
               "1/2), luminance (over white, darker than 1/2), id:NAME (the shapes of an element); of a "
               "pinchmap where its discontinuities are (default: all edges that two zones can have between them)")
            ->check([](const std::string& text) {
                return silhouette_rule(text) ? std::string()
                                             : fmt::format("'{}' is not two-colors, alpha, luminance or id:NAME", text);
            })
            ->type_name("WHAT");
    CLI::Option* channels =
        app.add_option("--channels", options.channels,
                       "Of a bi-level texture: 1, 2 or 3, more for sharper corners; auto (default): whichever shows "
                       "least wrong in the bytes that one channel takes")
            ->check(CLI::IsMember({"auto", "1", "2", "3"}))
            ->type_name("N");
    CLI::Option* greys = app.add_flag("--no-mid-greys", options.no_mid_greys,
                                      "No values from 112 to 143 in a bi-level texture, for coarse 8-bit filtering");
    CLI::Option* above = app.add_option("--above-image", options.above_image,
                                        "An image that a bi-level texture shows instead of the colour above")
                             ->type_name("FILE");
    return {{channels, greys, above}, silhouette};
}

} // namespace fetexc::cli
