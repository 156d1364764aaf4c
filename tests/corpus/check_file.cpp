// SPDX-License-Identifier: GPL-3.0-or-later
/// One drawing against the truth, for run_truth.py: every random point in the right region, and GLSL equal to the CPU
/// reference. Prints one JSON object; exit 0 when the checks ran (whatever they found), else the class of the error.
#include <cstdio>
#include <fstream>
#include <iterator>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compiler/fbt/fbt_builder.h"
#include "compiler/svg/svg.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/region_check.h"

namespace fetexc::test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSeed = 20041;
constexpr double kMagnifications[] = {1, 8, 64, 512}; ///< pixels a texel (issue 2)
constexpr std::uint32_t kFrameSide = 128, kMoreFrames = 3;

struct Options {
    std::string file;
    std::uint32_t size = 128;
    std::uint64_t points = 100000;
    std::vector<std::string> backends;
};

bool is_vector_only(const Scene& scene) {
    for (const Paint& paint : scene.paints) {
        if (std::holds_alternative<RasterPaint>(paint)) return false;
    }
    return true;
}

Json region_json(const RegionCheck& check) {
    return {{"points", check.points},
            {"wrong", check.wrong},
            {"wrongFar", check.wrong_far},
            {"colorOff", check.color_off},
            {"worstDistance", check.worst_distance},
            {"worst", check.worst}};
}

Json comparison_json(const Comparison& comparison) {
    return {{"pixels", comparison.pixels},   {"onEdge", comparison.on_edge},         {"wrong", comparison.wrong},
            {"largest", comparison.largest}, {"firstWrong", comparison.first_wrong}, {"error", comparison.error}};
}

/// All magnifications in one comparison: they must all be right.
Comparison compare_backend(const fetex::FbtTexture& texture, fetex::Backend backend) {
    Comparison total;
    auto renderer = fetex::Renderer::open(backend);
    if (!renderer) {
        total.error = renderer.error().message;
        return total;
    }
    if (const auto error = renderer.value().upload(texture)) {
        total.error = error->message;
        return total;
    }
    for (const double magnification : kMagnifications)
        total.add(compare_at(texture, renderer.value(), magnification, kFrameSide, kMoreFrames, kSeed));
    return total;
}

Json compare_backends(const fetex::FbtTexture& texture, const std::vector<std::string>& names) {
    Json result = Json::object();
    for (const fetex::Backend backend : fetex::kBackends) {
        if (std::find(names.begin(), names.end(), fetex::backend_name(backend)) != names.end())
            result[fetex::backend_name(backend)] = comparison_json(compare_backend(texture, backend));
    }
    return result;
}

int fail(const Error& error) {
    fmt::print(stderr, "error E{}: {}: {}\n", error.code, error.place, error.message);
    return static_cast<int>(error.cls);
}

int check(const Options& options) {
    std::ifstream stream(options.file, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    std::vector<Diagnostic> diagnostics;
    SvgOptions svg;
    svg.raster_pixels = std::max(16u, 2 * options.size);
    const auto scene = load_svg(bytes, svg, diagnostics);
    if (!scene) return fail(scene.error());
    FbtRegions regions;
    const CompileOptions compile{grid_for(scene.value().extent, options.size), 1};
    const auto build = build_fbt(scene.value(), compile, {}, &regions);
    if (!build) return fail(build.error());
    Json result = {{"vectorOnly", is_vector_only(scene.value())}};
    result["regions"] = region_json(check_regions(scene.value(), build.value(), regions, options.points, kSeed));
    result["renderers"] = compare_backends(build.value().texture, options.backends);
    fmt::print("{}\n", result.dump(-1, ' ', false, Json::error_handler_t::replace));
    return 0;
}

} // namespace
} // namespace fetexc::test

int main(int argc, char** argv) {
    CLI::App app("Checks one drawing against the ground truth");
    fetexc::test::Options options;
    app.add_option("file", options.file)->required();
    app.add_option("--size", options.size, "texels on the longer side");
    app.add_option("--points", options.points, "random points");
    app.add_option("--backend", options.backends, "back ends to compare with the CPU reference");
    CLI11_PARSE(app, argc, argv);
    return fetexc::test::check(options);
}
