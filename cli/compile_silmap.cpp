// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/compile_silmap.h"

#include <fmt/format.h>

namespace fetexc::cli {
namespace {

SilmapEffort effort(const std::string& name) {
    if (name == "quick") return SilmapEffort::Quick;
    return name == "thorough" ? SilmapEffort::Thorough : SilmapEffort::Auto;
}

template <class Input>
Result<SilmapBuild> compile_input(const Input& input, const SilmapRequest& request, const ProgressSink& progress) {
    SilmapOptions options;
    options.size = request.size;
    options.cell_format =
        request.how.cell_bits == 16 ? fetex::SilmapCellFormat::Bits16 : fetex::SilmapCellFormat::Bits8;
    options.sample_format = silmap_sample_format(request.samples);
    options.effort = effort(request.how.effort);
    options.mips = request.mips, options.threads = request.threads, options.skip = request.skip;
    if (!request.automatic && request.max_bytes == 0) return compile_silmap(input, options, progress);
    return compile_silmap_at_chosen_size(input, options, request.max_bytes, request.how.max_wrong_ppm / 1e6, progress);
}

} // namespace

Result<SilmapBuild> compile_silhouette_map(const Scene& scene, const SilmapRequest& request,
                                           const ProgressSink& progress) {
    return compile_input(scene, request, progress);
}

Result<SilmapBuild> compile_silhouette_map(const FeaturedImage& picture, const SilmapRequest& request,
                                           const ProgressSink& progress) {
    return compile_input(picture, request, progress);
}

std::string options_text(const SilmapRequest& request) {
    std::string text = fmt::format("cell-bits={}", request.how.cell_bits);
    if (request.how.effort != "auto") text += fmt::format(" effort={}", request.how.effort);
    if (request.how.max_wrong_ppm > 0) text += fmt::format(" max-wrong={}", request.how.max_wrong_ppm);
    return text;
}

std::uint32_t cell_bits(const fetex::SilmapTexture& texture) {
    return texture.cell_format == fetex::SilmapCellFormat::Bits16 ? 16 : 8;
}

fetex::SilmapSampleFormat silmap_sample_format(const std::string& name) {
    if (name == "16") return fetex::SilmapSampleFormat::Rgba16;
    if (name == "float") return fetex::SilmapSampleFormat::Rgba16F;
    return name == "rgb8" ? fetex::SilmapSampleFormat::Rgb8 : fetex::SilmapSampleFormat::Rgba8;
}

const char* silmap_samples_name(fetex::SilmapSampleFormat format) {
    switch (format) {
    case fetex::SilmapSampleFormat::Rgba8:
        return "8";
    case fetex::SilmapSampleFormat::Rgba16:
        return "16";
    case fetex::SilmapSampleFormat::Rgba16F:
        return "float";
    case fetex::SilmapSampleFormat::Rgb8:
        return "rgb8";
    }
    return "";
}

SilmapCliOptions add_silmap_options(CLI::App& app, SilmapCommandOptions& options) {
    CLI::Option* bits = app.add_option("--cell-bits", options.cell_bits,
                                       "Of a silhouette-map texture: bits a cell, 8 (default; points at 8 x 8 places) "
                                       "or 16 (128 x 128)")
                            ->check(CLI::IsMember({8, 16}))
                            ->type_name("N");
    CLI::Option* effort = app.add_option("--effort", options.effort,
                                         "Of a silhouette-map texture: quick, or thorough, which may take ten to "
                                         "thirty times as long for a third "
                                         "less wrong area; auto (default): quick where more than 4096 cells have edges")
                              ->check(CLI::IsMember({"auto", "quick", "thorough"}))
                              ->type_name("NAME");
    CLI::Option* wrong =
        app.add_option(
               "--max-wrong", options.max_wrong_ppm,
               "Of a silhouette-map texture or a pinchmap whose size is chosen: the smallest that shows at most "
               "so many millionths of the picture on the wrong side of an edge (--size auto alone: 1000)")
            ->check(number_range(0.1, 1e6))
            ->type_name("PPM");
    return {{bits, effort}, wrong};
}

} // namespace fetexc::cli
