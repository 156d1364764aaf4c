// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compile_pinchmap.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "cli/compile_bilevel.h"
#include "cli/compile_silmap.h"
#include "formats/fbt_samples.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kMostScale = 6; ///< 64 × 64 samples a cluster

/// Premultiplied, R low.
std::uint32_t packed_color(const std::array<double, 4>& c) {
    return fetex::fbt_pack_sample({c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]}, fetex::FbtSampleFormat::Rgba8)[0];
}

template <class Input>
Result<PinchmapBuild> compile_input(const Input& input, const PinchmapRequest& request, const ProgressSink& progress) {
    PinchmapOptions options;
    options.size = request.size, options.scale = request.how.signal_scale;
    options.map_format = request.how.map_bits == 16 ? fetex::PinchmapFormat::Bits16 : fetex::PinchmapFormat::Bits8;
    options.sample_format = silmap_sample_format(request.samples);
    if (!request.silhouette.empty()) options.silhouette = silhouette_rule(request.silhouette);
    options.mips = request.mips, options.threads = request.threads;
    auto built =
        !request.automatic && request.max_bytes == 0
            ? compile_pinchmap(input, options, progress)
            : compile_pinchmap_at_chosen_size(input, options, request.max_bytes, request.max_wrong_ppm / 1e6, progress);
    if (!built) return built;
    fetex::PinchmapTexture& t = built.value().texture;
    t.line_width = static_cast<std::uint32_t>(std::lround(request.how.line_width * fetex::kPinchmapLineUnit));
    if (t.line_width != 0) t.line_color = packed_color(*parse_color(request.how.line_color));
    return built;
}

} // namespace

Result<PinchmapBuild> compile_pinched(const Scene& scene, const PinchmapRequest& request,
                                      const ProgressSink& progress) {
    return compile_input(scene, request, progress);
}

Result<PinchmapBuild> compile_pinched(const PinchedImage& image, const PinchmapRequest& request,
                                      const ProgressSink& progress) {
    return compile_input(image, request, progress);
}

std::string options_text(const PinchmapRequest& request) {
    std::string text = fmt::format("map-bits={} signal-scale={}", request.how.map_bits, request.how.signal_scale);
    if (!request.silhouette.empty()) text += fmt::format(" silhouette={}", fetex::to_valid_utf8(request.silhouette));
    if (request.how.line_width > 0)
        text += fmt::format(" line-width={} line-color={}", request.how.line_width, request.how.line_color);
    if (request.max_wrong_ppm > 0) text += fmt::format(" max-wrong={}", request.max_wrong_ppm);
    return text;
}

std::uint32_t map_bits(const fetex::PinchmapTexture& texture) {
    return texture.map_format == fetex::PinchmapFormat::Bits16 ? 16 : 8;
}

std::vector<CLI::Option*> add_pinchmap_options(CLI::App& app, PinchmapCommandOptions& options) {
    CLI::Option* bits = app.add_option("--map-bits", options.map_bits,
                                       "Of a pinchmap: bits of each of its four channels, 8 (default) or 16")
                            ->check(CLI::IsMember({8, 16}))
                            ->type_name("N");
    CLI::Option* scale =
        app.add_option("--signal-scale", options.signal_scale,
                       "Of a pinchmap: the signal has 2^K samples for each of its texels along a side, "
                       "K from 0 (default) to 6")
            ->check(CLI::Range(0U, kMostScale))
            ->type_name("K");
    CLI::Option* width =
        app.add_option("--line-width", options.line_width,
                       "Of a pinchmap: a solid line along its discontinuities, so many texels wide, up "
                       "to 1; default: none")
            ->check(number_range(0, 1))
            ->type_name("TEXELS");
    CLI::Option* color =
        app.add_option("--line-color", options.line_color, "The line's colour, #rrggbb or #rrggbbaa; default black")
            ->check([](const std::string& text) {
                return parse_color(text) ? std::string() : fmt::format("'{}' is not #rrggbb or #rrggbbaa", text);
            })
            ->needs(width)
            ->type_name("COLOR");
    return {bits, scale, width, color};
}

} // namespace fetexc::cli
