// SPDX-License-Identifier: GPL-3.0-or-later
/// What mip levels are worth on a drawing: a line a file, tab-separated. For run_mips.py, and for people.
///   file, W, H, bytes of the FBT and of its chain, PSNR of the chain at 1/2, 1/4, 1/8, 1/16 px a texel; then, at 1/2
///   and at 1/4: bytes of an FBT of W/2 (W/4) texels, PSNR of that with 16 and with 256 samples a pixel; then PSNR at 1
///   px a texel of the FBT with 16 samples a pixel, and of an RGBA8 level of its size.
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "compiler/svg/svg.h"
#include "tests/support/mip_check.h"

namespace fetexc::test {
namespace {

int fail(const char* file, const Error& error) {
    std::fprintf(stderr, "%s: error E%d: %s\n", file, error.code, error.message.c_str());
    return static_cast<int>(error.cls);
}

Result<Scene> load(const char* file, std::uint32_t texels) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    std::vector<Diagnostic> diagnostics;
    SvgOptions options;
    options.raster_pixels = 2 * texels;
    return load_svg(bytes, options, diagnostics);
}

/// Mean of n×n samples over a square pixel.
fetex::FbtColor supersampled(const fetex::FbtTexture& texture, double x, double y, double side, int n) {
    fetex::FbtColor sum;
    for (int k = 0; k < n * n; ++k) {
        const double dx = ((k % n + 0.5) / n - 0.5) * side, dy = ((k / n + 0.5) / n - 0.5) * side;
        const fetex::FbtColor c = fetex::fbt_sample(texture, x + dx, y + dy);
        sum.r += c.r / (n * n), sum.g += c.g / (n * n), sum.b += c.b / (n * n), sum.a += c.a / (n * n);
    }
    return sum;
}

/// The truth rounded to 8 bits, as a level holds it.
double rounded_psnr(const std::vector<Rgba>& truth) {
    double sum = 0;
    for (const Rgba& c : truth) {
        const auto r = [](double v) { return measure::to_byte(v) / 255.0; };
        sum += measure::square_error(c, {r(c.r), r(c.g), r(c.b), r(c.a)});
    }
    return measure::decibels(sum / static_cast<double>(truth.size()));
}

int print_line(const char* file, std::uint32_t texels) {
    const Result<Scene> scene = load(file, texels);
    if (!scene) return fail(file, scene.error());
    CompileOptions options{grid_for(scene.value().extent, texels), 1};
    options.mips = true;
    const Result<FbtBuild> build = compile_fbt(scene.value(), options);
    if (!build) return fail(file, build.error());
    const fetex::FbtTexture& t = build.value().texture;
    std::printf("%s\t%u\t%u\t%llu\t%zu", file, t.width, t.height,
                static_cast<unsigned long long>(fetex::fbt_gpu_bytes(t) - 4 * t.mips.size()), 4 * t.mips.size());
    for (const double psnr : minified_psnr(scene.value(), t))
        std::printf("\t%.1f", psnr);
    for (const std::uint32_t k : {1u, 2u}) {
        const GridSize size{std::max(t.width >> k, 1u), std::max(t.height >> k, 1u)};
        const Result<FbtBuild> coarse = compile_fbt(scene.value(), {size, 1});
        if (!coarse) return fail(file, coarse.error());
        const fetex::FbtTexture& c = coarse.value().texture;
        const std::vector<Rgba> truth = area_means(scene.value(), size);
        std::printf("\t%llu", static_cast<unsigned long long>(fetex::fbt_gpu_bytes(c)));
        for (const int n : {4, 16})
            std::printf("\t%.1f",
                        psnr_of(truth, size, c, [&](double x, double y) { return supersampled(c, x, y, 1, n); }));
    }
    const GridSize size{t.width, t.height};
    const std::vector<Rgba> truth = area_means(scene.value(), size);
    std::printf("\t%.1f\t%.1f\n",
                psnr_of(truth, size, t, [&](double x, double y) { return supersampled(t, x, y, 1, 4); }),
                rounded_psnr(truth));
    return 0;
}

} // namespace
} // namespace fetexc::test

int main(int argc, char** argv) {
    std::uint32_t texels = 0;
    if (argc == 3) std::from_chars(argv[2], argv[2] + std::char_traits<char>::length(argv[2]), texels);
    if (texels == 0) {
        std::fputs("usage: corpus_mip_errors FILE TEXELS\n", stderr);
        return 1;
    }
    return fetexc::test::print_line(argv[1], texels);
}
