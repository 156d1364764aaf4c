// SPDX-License-Identifier: GPL-3.0-or-later
/// 10,000 random networks of curves, and the strokes and edges of the corpus' drawings.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "compiler/svg/svg.h"
#include "tests/support/quadratic_check.h"

namespace fetexc {
namespace {

using test::Random;

TEST(FeatureQuadraticsStress, tenThousandRandomNetworksAreValid) {
    SnapStats sum;
    for (std::uint64_t seed = 0; seed < 10000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto width = static_cast<std::uint32_t>(random.integer(1, 16)),
                   height = static_cast<std::uint32_t>(random.integer(1, 16));
        const LatticeCurves curves = lattice_curves(test::random_curve_network(random, width, height)).value();
        const SnappedCurves snapped = snap_quadratics(curves, width, height);
        test::check_snapped(curves, snapped);
        sum.curved += snapped.stats.curved, sum.invalid += snapped.stats.invalid;
        sum.straightened += snapped.stats.straightened;
        if (HasFailure()) break;
    }
    RecordProperty("curved", std::to_string(sum.curved));
    RecordProperty("invalid", std::to_string(sum.invalid));
    RecordProperty("straightened", std::to_string(sum.straightened));
    EXPECT_GT(sum.invalid, 50000u);
    EXPECT_LT(sum.straightened, sum.curved / 5);
}

TEST(FeatureQuadraticsStress, corpusIsValid) {
    const char* given = std::getenv("FETEXC_CORPUS");
    const std::filesystem::path folder = given != nullptr ? given : FETEXC_CORPUS_DIR;
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no corpus here";
    constexpr std::uint32_t kSide = 64;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".svg") files.push_back(entry.path());
    std::ranges::sort(files);
    int checked = 0;
    for (const std::filesystem::path& file : files) {
        SCOPED_TRACE(file.filename().string());
        std::ifstream in(file, std::ios::binary);
        const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
        std::vector<Diagnostic> diagnostics;
        const auto features = load_svg_features(bytes, {}, diagnostics);
        if (!features.ok()) continue;
        const Network network = network_of(features.value());
        const auto curves = lattice_curves(network);
        if (!curves.ok()) continue;
        const double larger = std::max(network.width, network.height);
        const auto side = [&](double v) { return std::max(1u, static_cast<std::uint32_t>(kSide * v / larger + 0.5)); };
        const SnappedCurves snapped = snap_quadratics(curves.value(), side(network.width), side(network.height));
        test::check_snapped(curves.value(), snapped);
        ++checked;
        if (HasFailure()) break;
    }
    EXPECT_GT(checked, 0);
}

} // namespace
} // namespace fetexc
