// SPDX-License-Identifier: GPL-3.0-or-later
/// The certified filter against CGAL's algebraic kernel: every pair of overlapping boxes of real drawings, and
/// generated pairs of every kind and degree. What is certified must be what the kernel finds; how much is certified
/// must not sink.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "compiler/svg/svg.h"
#include "tests/stress/pair_families.h"
#include "tests/stress/seeds.h"
#include "tests/support/cgal_oracles.h"
#include "tests/support/pair_check.h"

namespace fetexc::test {
namespace {

struct Rate {
    std::uint64_t pairs = 0, certified = 0;
    [[nodiscard]] double percent() const {
        return pairs == 0 ? 100 : 100 * static_cast<double>(certified) / static_cast<double>(pairs);
    }
};

void add(Rate& sum, const Rate& r) { sum.pairs += r.pairs, sum.certified += r.certified; }

void print_rate(const std::string& name, const Rate& r) {
    std::printf("%-28s %9llu pairs %9llu certified %8.3f %%\n", name.c_str(), static_cast<unsigned long long>(r.pairs),
                static_cast<unsigned long long>(r.certified), r.percent());
}

/// One pair of pieces through the filter; the kernel's hits, where they are known, are what it must have found.
void check_pair(const Piece& a, const Piece& b, const KernelHits* hits, Rate& rate, const std::string& what) {
    const FilterAnswer answer = filter_answer(a, b);
    ++rate.pairs;
    if (answer.outcome != PairOutcome::Certified) return;
    ++rate.certified;
    if (hits == nullptr) return;
    EXPECT_FALSE(hits->overlap) << what << ": certified, but they overlap";
    EXPECT_EQ(mismatch(answer.contacts, *hits), "") << what;
}

/// The kernel's univariate answer (ours: resultant, then roots) against its bivariate one (CGAL's alone).
void check_kernel(const Piece& a, const Piece& b, const KernelHits& hits, const std::string& what) {
    const auto points =
        common_points(*a.stretch.curve, {a.first.t.lo, a.last.t.hi}, *b.stretch.curve, {b.first.t.lo, b.last.t.hi});
    EXPECT_EQ(!points, hits.common_component) << what;
    if (!points) return;
    std::vector<Contact> contacts;
    for (const ParameterPoint& p : *points)
        contacts.push_back({p.s, p.t});
    EXPECT_EQ(mismatch(contacts, hits), "") << what;
}

// --- drawings

/// Seeds of the full count: 100,000 generated pairs, and every box pair of the drawings against the kernel (three
/// minutes for the tiger). With fewer seeds as much less.
constexpr std::uint64_t kFullSeeds = 300, kFewSeeds = 8;

std::uint64_t one_in() { return std::max<std::uint64_t>(1, kFullSeeds / stress_seeds(kFewSeeds).size()); }

/// Every pair of boxes of the arcs through the filter; one in `stride` of them, and what the finished arrangement says
/// of them, against the kernel.
Rate check_scene(const Scene& scene, const Grid& grid, const std::string& name, std::uint64_t stride) {
    Rate rate;
    PlanarStats stats;
    const Result<Arrangement> arrangement = arrange(scene, grid, 1, stats);
    if (!arrangement) {
        ADD_FAILURE() << name << ": " << arrangement.error().message;
        return rate;
    }
    const std::vector<Piece> pieces = pieces_of(arrangement.value().set);
    const ArrangementContacts arranged(arrangement.value());
    for (const auto& [i, k] : box_pairs_of(pieces, grid)) {
        const Piece &a = pieces[i], &b = pieces[k];
        if (rate.pairs % stride != 0) {
            check_pair(a, b, nullptr, rate, "");
            continue;
        }
        const std::string what = name + " arcs " + std::to_string(i) + ", " + std::to_string(k);
        const KernelHits hits = kernel_hits(a, b);
        check_pair(a, b, &hits, rate, what);
        EXPECT_FALSE(hits.overlap) << what << ": overlapping arcs are left";
        EXPECT_EQ(mismatch(arranged(i, k), hits), "") << what << " in the arrangement";
    }
    return rate;
}

Rate check_drawing(const Scene& scene, const std::string& name) {
    const Rate rate = check_scene(scene, make_grid(scene.extent, 256, 256), name, one_in() == 1 ? 1 : 4 * one_in());
    print_rate(name, rate);
    return rate;
}

Result<Scene> load(const std::filesystem::path& file, const SvgOptions& options = {}) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::vector<Diagnostic> diagnostics;
    return load_svg({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, options, diagnostics);
}

TEST(PairOracle, EveryBoxPairOfTheTiger) {
    const std::filesystem::path file = std::filesystem::path(FETEXC_CORPUS_DIR) / "classic" / "Ghostscript_Tiger.svg";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no corpus on this machine: " << file;
    const Result<Scene> scene = load(file);
    ASSERT_TRUE(scene) << scene.error().message;
    const Rate rate = check_drawing(scene.value(), "tiger");
    EXPECT_GT(rate.pairs, 10000u);
    EXPECT_LE((rate.pairs - rate.certified) * 1000, rate.pairs);
}

TEST(PairOracle, EveryBoxPairOfOurArt) {
    std::size_t drawings = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FETEXC_ART_DIR)) {
        if (entry.path().extension() != ".svg") continue;
        const Result<Scene> scene = load(entry.path());
        ASSERT_TRUE(scene) << entry.path() << scene.error().message;
        check_drawing(scene.value(), entry.path().stem().string());
        ++drawings;
    }
    EXPECT_GE(drawings, 10u);
}

/// Every printable character of Latin-1 in one font.
std::string all_letters() {
    std::string rows;
    int y = 0;
    for (int first = 33; first < 256; first += 16) {
        rows += "<text x='8' y='" + std::to_string(y += 40) + "'>";
        for (int c = first; c < first + 16; ++c)
            if (c < 127 || (c > 160 && c < 256)) rows += "&#" + std::to_string(c) + ";";
        rows += "</text>";
    }
    return "<svg xmlns='http://www.w3.org/2000/svg' width='640' height='640'><g font-size='32'>" + rows + "</g></svg>";
}

/// Font files where systems keep them.
std::vector<std::filesystem::path> font_files() {
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "C:/Windows/Fonts"}) {
        if (!std::filesystem::exists(folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            const auto extension = entry.path().extension();
            if (extension == ".ttf" || extension == ".otf") files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(PairOracle, FontOutlinesAreAllCertified) {
    std::vector<std::filesystem::path> files = font_files();
    if (files.empty()) GTEST_SKIP() << "no font on this machine";
    constexpr std::size_t few = 4, many = 40;
    files.resize(std::min(files.size(), one_in() > 1 ? few : many));
    const std::string svg = all_letters();
    for (const std::filesystem::path& file : files) {
        SvgOptions options;
        options.font_files = {file};
        std::vector<Diagnostic> diagnostics;
        const Result<Scene> scene =
            load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, options, diagnostics);
        ASSERT_TRUE(scene) << scene.error().message;
        const Rate rate = check_drawing(scene.value(), file.stem().string());
        EXPECT_GT(rate.pairs, 1000u) << file;
        EXPECT_EQ(rate.certified, rate.pairs) << file;
    }
}

// --- generated pairs

/// A scene that is one texel as large as planar space, with the curves as they are.
Scene scene_of_curves(std::initializer_list<const Curve*> curves) {
    Scene scene;
    for (const Curve* c : curves) {
        Segment segment;
        segment.degree = c->degree;
        for (int i = 0; i <= c->degree; ++i)
            segment.p[i] = {c->p[i].x, c->p[i].y};
        scene.shapes.push_back({static_cast<std::uint32_t>(scene.segments.size()), 1, FillRule::EvenOdd, kNone});
        scene.segments.push_back(segment);
    }
    return scene;
}

Grid planar_space() {
    constexpr std::int64_t side = std::int64_t{1} << 43;
    return {.width = 1, .height = 1, .px = side, .py = side};
}

ArcSet arcs_of(const Curve& c) {
    PlanarStats stats;
    return prepare_arcs(scene_of_curves({&c}), planar_space(), {}, stats);
}

std::vector<Piece> pieces_of_curve(const ArcSet& set, std::uint32_t number) {
    std::vector<Piece> pieces = pieces_of(set);
    for (Piece& p : pieces) { // vertices and curves of two sets are different ones
        p.curve = number;
        p.first.vertex = 2 * p.first.vertex + number, p.last.vertex = 2 * p.last.vertex + number;
    }
    return pieces;
}

bool boxes_overlap(const Piece& a, const Piece& b) { return a.x.overlaps(b.x) && a.y.overlaps(b.y); }

/// One in so many pairs is checked with the bivariate kernel, too, and one in so many as an arrangement.
constexpr std::uint64_t kBivariate = 50, kArranged = 10;

struct Rates {
    Rate all;      ///< all monotone pieces of one curve with all of the other
    Rate close_by; ///< those that hold the place where the curves are close to each other
    Rate bivariate;
    std::uint64_t curves = 0;
};

void check_curves(const CurvePair& pair, Rates& rates, const std::string& what) {
    const ArcSet set_a = arcs_of(pair.a), set_b = arcs_of(pair.b);
    const std::vector<Piece> pieces_a = pieces_of_curve(set_a, 0), pieces_b = pieces_of_curve(set_b, 1);
    const bool bivariate = rates.curves % kBivariate == 0, arranged = rates.curves % kArranged == 0;
    ++rates.curves;
    for (const Piece& a : pieces_a) {
        for (const Piece& b : pieces_b) {
            if (!boxes_overlap(a, b)) continue;
            const KernelHits hits = kernel_hits(a, b);
            Rate rate;
            check_pair(a, b, &hits, rate, what);
            add(rates.all, rate);
            if (a.stretch.range.contains(pair.s) && b.stretch.range.contains(pair.t)) add(rates.close_by, rate);
            if (!bivariate) continue;
            add(rates.bivariate, rate);
            check_kernel(a, b, hits, what);
        }
    }
    if (arranged) check_scene(scene_of_curves({&pair.a, &pair.b}), planar_space(), what, 1);
}

constexpr std::array<std::pair<int, int>, 9> kDegrees{
    {{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {2, 3}, {3, 1}, {3, 2}, {3, 3}}};

std::string pair_name(std::uint64_t seed, const std::string& family, std::pair<int, int> degrees) {
    return "seed " + std::to_string(seed) + " " + family + " " + std::to_string(degrees.first) + "-" +
           std::to_string(degrees.second);
}

PairMaker maker_of(std::uint64_t seed, std::pair<int, int> degrees) {
    return PairMaker(16 * seed + static_cast<std::uint64_t>(4 * degrees.first + degrees.second));
}

TEST(PairOracle, GeneratedFamilies) {
    const auto seeds = stress_seeds(kFewSeeds);
    Rates rates;
    for (const auto& [family, name] : kFamilies) {
        if (family == Family::NearTangent) continue; // by gap, below
        const Rate before = rates.all;
        for (std::uint64_t seed : seeds) {
            for (const auto& degrees : kDegrees) {
                if (!applies(family, degrees.first, degrees.second)) continue;
                check_curves(maker_of(seed, degrees).make(family, degrees.first, degrees.second), rates,
                             pair_name(seed, name, degrees));
            }
        }
        print_rate(name, {rates.all.pairs - before.pairs, rates.all.certified - before.certified});
    }
    print_rate("all", rates.all);
    print_rate("of these bivariate", rates.bivariate);
    EXPECT_GE(rates.all.pairs, 100 * seeds.size());
    EXPECT_GT(rates.bivariate.pairs, 0u);
}

TEST(PairOracle, NearTangentByGap) {
    const auto seeds = stress_seeds(kFewSeeds);
    Rates rates;
    for (int exponent = 4; exponent <= 15; ++exponent) {
        const double gap = std::pow(10.0, -exponent);
        const std::string name = "relative gap 1e-" + std::to_string(exponent);
        rates.close_by = {};
        for (std::uint64_t seed : seeds) {
            for (const auto& degrees : kDegrees) {
                if (!applies(Family::NearTangent, degrees.first, degrees.second)) continue;
                PairMaker maker = maker_of(100 * seed + static_cast<std::uint64_t>(exponent), degrees);
                check_curves(maker.near_tangent(degrees.first, degrees.second, gap), rates,
                             pair_name(seed, name, degrees));
            }
        }
        print_rate(name, rates.close_by);
        EXPECT_GE(rates.close_by.pairs, 6 * seeds.size());
        if (exponent <= 8) {
            EXPECT_EQ(rates.close_by.certified, rates.close_by.pairs) << name;
        }
        if (exponent == 10) {
            EXPECT_GE(rates.close_by.percent(), 95) << name;
        }
    }
    print_rate("all", rates.all);
}

} // namespace
} // namespace fetexc::test
