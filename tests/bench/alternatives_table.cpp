// SPDX-License-Identifier: GPL-3.0-or-later
/// What a user would pick instead, on six drawings in black and white: means of misclassified area, PSNR and boundary
/// distances at equal bytes, beside the figures of an earlier study on six other shapes of the same kinds. Exit 1 when
/// the order differs or a figure is more than a fifth off (README.md). --quick: one size, fewer samples, no PSNR.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "compiler/measure/alternatives.h"
#include "compiler/measure/errors.h"
#include "compiler/svg/svg.h"

namespace fetexc::measure {
namespace {

constexpr const char* kDrawings[] = {"glyph_g", "star", "serif_letter", "gear_logo", "icon", "yin_yang"};
constexpr int kSizes = 4, kSizeWithDistances = 1;
constexpr std::uint64_t kBytes[kSizes] = {768, 3072, 12288, 49152};

/// Distances from the truth's edges to the picture's, in 1/1000 of the width.
struct Figures {
    double ppm = 0, psnr = 0, mean = 0, hausdorff = 0;
};
using Table = Figures[std::size(kAlternatives)][kSizes];

/// Of the study; it gives distances for 3072 bytes only.
constexpr Table kStudy = {
    {{40700, 13.5, 0, 0}, {15500, 16.7, 5.7, 51}, {6140, 19.6, 0, 0}, {2260, 22.8, 0, 0}},
    {{15500, 18.3, 0, 0}, {6140, 22.6, 1.65, 24}, {2260, 27.9, 0, 0}, {1150, 32.7, 0, 0}},
    {{8510, 21.0, 0, 0}, {2440, 27.0, 0.71, 21.5}, {446, 35.3, 0, 0}, {104, 43.1, 0, 0}},
};

/// PSNR of the mean square error over all.
Figures mean_of(const std::vector<Figures>& all) {
    Figures mean;
    const auto count = static_cast<double>(all.size());
    for (const Figures& f : all) {
        mean.ppm += f.ppm / count, mean.mean += f.mean / count, mean.hausdorff += f.hausdorff / count;
        mean.psnr += std::pow(10, -f.psnr / 10) / count;
    }
    mean.psnr = -10 * std::log10(mean.psnr);
    return mean;
}

struct Run {
    std::uint32_t pixels = 2048;
    int first_size = 0, last_size = kSizes - 1;
    bool with_psnr = true;
};

Scene load(const std::string& name) {
    std::ifstream in(std::string(FETEXC_ART_DIR) + "/alternatives/" + name + ".svg", std::ios::binary);
    const std::vector<char> text((std::istreambuf_iterator<char>(in)), {});
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    std::vector<Diagnostic> diagnostics;
    auto scene = load_svg(bytes, {}, diagnostics);
    if (!scene) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), scene.error().message.c_str());
        std::exit(2);
    }
    return std::move(scene).value();
}

Figures figures_of(const Truth& truth, Alternative kind, std::uint64_t bytes, std::uint32_t pixels) {
    const GridSize size = grid_of_bytes(truth.height(), bytes, bytes_per_texel(kind));
    const auto picture = make_alternative(truth, kind, size, 0);
    MeasureOptions options;
    options.sizes = {{pixels, pixels}};
    options.reach = 4; // a lost hairline is that far from what is left
    const auto errors = measure(truth, *picture.value(), options);
    const SizeErrors& e = errors.value().front();
    std::printf("    %-18s %5llu bytes %3ux%-3u %8.0f ppm %5.1f dB  to truth %5.2f / %5.1f  to picture %5.2f / %5.1f"
                "  beyond %llu\n",
                alternative_name(kind), static_cast<unsigned long long>(bytes), size.width, size.height,
                e.misclassified_ppm, e.psnr, e.to_truth.mean * 1000, e.to_truth.hausdorff * 1000,
                e.to_picture.mean * 1000, e.to_picture.hausdorff * 1000,
                static_cast<unsigned long long>(e.to_picture.beyond_reach));
    return {e.misclassified_ppm, e.psnr, e.to_picture.mean * 1000, e.to_picture.hausdorff * 1000};
}

void measure_all(const Run& run, Table& table) {
    std::vector<Figures> all[std::size(kAlternatives)][kSizes];
    for (const char* name : kDrawings) {
        const Scene scene = load(name);
        const auto truth = Truth::of(scene, 0);
        std::printf("  %s\n", name);
        for (const Alternative kind : kAlternatives)
            for (int k = run.first_size; k <= run.last_size; ++k)
                all[static_cast<int>(kind)][k].push_back(figures_of(*truth.value(), kind, kBytes[k], run.pixels));
        std::fflush(stdout);
    }
    for (std::size_t a = 0; a < std::size(kAlternatives); ++a)
        for (int k = run.first_size; k <= run.last_size; ++k)
            table[a][k] = mean_of(all[a][k]);
}

/// A figure beside the study's; whether it is within a fifth of it.
bool print(const char* format, double figure, double study, double ratio) {
    const bool near = study == 0 || std::abs(ratio - 1) <= 0.2;
    std::printf(format, figure);
    study == 0 ? std::printf("         ") : std::printf(" (%g%s)", study, near ? "" : " !");
    return near;
}

bool print_row(const Figures& f, const Figures& s, bool with_psnr) {
    bool near = print(" | %8.0f", f.ppm, s.ppm, f.ppm / s.ppm);
    // A fifth of the root mean square error.
    if (with_psnr) near &= print(" | %5.1f", f.psnr, s.psnr, std::pow(10, (s.psnr - f.psnr) / 20));
    near &= print(" | %5.2f", f.mean, s.mean, f.mean / s.mean);
    near &= print(" | %5.1f", f.hausdorff, s.hausdorff, f.hausdorff / s.hausdorff);
    std::printf("\n");
    return near;
}

/// Distance field before box threshold before bitmap.
bool in_order(const Table& table, int k) {
    for (std::size_t a = 1; a < std::size(kAlternatives); ++a)
        if (table[a][k].ppm >= table[a - 1][k].ppm || table[a][k].psnr <= table[a - 1][k].psnr) return false;
    return true;
}

/// Whether all is as in the study.
bool print(const Run& run, const Table& table) {
    std::printf("\nmeans over %zu drawings at %u pixels (study; ! more than a fifth off)\n", std::size(kDrawings),
                run.pixels);
    std::printf("alternative | bytes | ppm |%s mean | Hausdorff\n", run.with_psnr ? " dB |" : "");
    bool good = true;
    for (int k = run.first_size; k <= run.last_size; ++k) {
        for (const Alternative kind : kAlternatives) {
            const auto a = static_cast<int>(kind);
            std::printf("%-17s | %5llu", alternative_name(kind), static_cast<unsigned long long>(kBytes[k]));
            good &= print_row(table[a][k], kStudy[a][k], run.with_psnr);
        }
        if (in_order(table, k)) continue;
        std::printf("another order than in the study at %llu bytes\n", static_cast<unsigned long long>(kBytes[k]));
        good = false;
    }
    return good;
}

} // namespace
} // namespace fetexc::measure

int main(int argc, char** argv) {
    using namespace fetexc::measure;
    const bool quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > 1 && !quick) {
        std::fprintf(stderr, "usage: alternatives_table [--quick]\n");
        return 2;
    }
    const Run run = quick ? Run{1024, kSizeWithDistances, kSizeWithDistances, false} : Run{};
    Table table = {};
    measure_all(run, table);
    return print(run, table) ? 0 : 1;
}
