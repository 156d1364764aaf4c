// SPDX-License-Identifier: GPL-3.0-or-later
/// The planar map against CGAL's `Arrangement_2` and `decompose` on our own traits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "compiler/planar/texel_arrangement.h"
#include "compiler/planar/texel_map.h"
#include "compiler/svg/svg.h"
#include "compiler/union_find.h"
#include "tests/stress/grid_drawing.h"
#include "tests/stress/seeds.h"
#include "tests/support/global_arrangement.h"
#include "tests/support/random_scene.h"

namespace fetexc::test {
namespace {

// --- files

Result<Scene> load(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<Diagnostic> diagnostics;
    return load_svg(bytes, {}, diagnostics);
}

std::vector<std::filesystem::path> art() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(FETEXC_ART_DIR)) {
        if (entry.path().extension() == ".svg") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// --- texel by texel

using Corners = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

/// What both decompositions of a texel have to agree on, except how they number faces.
class TexelAnswer {
  public:
    TexelAnswer(const PlanarMap& map, const SweepGraph& graph, TexelFrame frame, const SweepResult& result)
        : map_(map), graph_(graph), frame_(frame), result_(result) {
        for (const Portion& p : result.portions)
            portions_[p.edge] = p;
        for (const Trapezoid& t : result.trapezoids) {
            if (!in_corner(t)) trapezoids_.emplace_back(t.left, t.right, t.top_node, t.bottom_node);
        }
        std::sort(trapezoids_.begin(), trapezoids_.end());
        for (std::size_t s = 0; s < 4; ++s)
            sides_[s] = parts(static_cast<TexelSide>(s));
    }

    /// The first difference; empty: none.
    [[nodiscard]] std::string difference(const TexelAnswer& o) const {
        if (trapezoids_ != o.trapezoids_)
            return "trapezoids: " + std::to_string(trapezoids_.size()) + " and " + std::to_string(o.trapezoids_.size());
        Renaming names;
        bool faces = names.match(face(result_.first_face), o.face(o.result_.first_face));
        if (portions_.size() != o.portions_.size()) return "portions";
        for (const auto& [edge, p] : portions_) {
            const auto q = o.portions_.find(edge);
            if (q == o.portions_.end() || p.rank != q->second.rank) return "portion of edge " + std::to_string(edge);
            faces = names.match(face(p.left), o.face(q->second.left)) && faces;
            faces = names.match(face(p.right), o.face(q->second.right)) && faces;
        }
        if (!faces) return "faces beside edges";
        for (std::size_t s = 0; s < 4; ++s) {
            if (sides_[s].size() != o.sides_[s].size()) return "parts of side " + std::to_string(s);
            for (std::size_t k = 0; k < sides_[s].size(); ++k) {
                if (sides_[s][k].from != o.sides_[s][k].from) return "ends of parts of side " + std::to_string(s);
                if (!names.match(face(sides_[s][k].face), o.face(o.sides_[s][k].face)))
                    return "faces beside side " + std::to_string(s);
            }
        }
        const std::map<Corners, std::uint32_t> there = o.faces_of_trapezoids();
        for (const auto& [corners, f] : faces_of_trapezoids()) {
            const auto g = there.find(corners);
            if (g == there.end() || !names.match(f, g->second)) return "faces of trapezoids";
        }
        return {};
    }

  private:
    /// One face here is one face there, and the other way round.
    class Renaming {
      public:
        bool match(std::uint32_t a, std::uint32_t b) {
            return there_.try_emplace(a, b).first->second == b && here_.try_emplace(b, a).first->second == a;
        }

      private:
        std::map<std::uint32_t, std::uint32_t> there_, here_;
    };

    [[nodiscard]] std::uint32_t face(std::uint32_t f) const { return result_.face(f); }
    [[nodiscard]] const GridNode& node(std::uint32_t k) const { return map_.node(graph_.nodes[k]); }

    /// Between the texel's first or last corner and a node there: no extent at all.
    [[nodiscard]] bool in_corner(const Trapezoid& t) const {
        if (t.left != kNone || t.right != kNone || (t.top_node == kNone) == (t.bottom_node == kNone)) return false;
        const bool first = t.top_node == kNone;
        const GridNode& n = node(first ? t.bottom_node : t.top_node);
        const HalfStep side = first ? 0 : 2;
        return n.hx == frame_.left + side && n.hy == frame_.top + side;
    }

    [[nodiscard]] bool has_height(const Trapezoid& t) const {
        const auto level = [&](std::uint32_t k, std::uint32_t side) {
            if (k == kNone) return side;
            const HalfStep h = node(k).hy - frame_.top;
            return h == 0 ? 0u : h == 2 ? kNone : graph_.ranks[k].y + 1;
        };
        return level(t.top_node, 0) < level(t.bottom_node, kNone);
    }

    [[nodiscard]] std::map<Corners, std::uint32_t> faces_of_trapezoids() const {
        std::map<Corners, std::uint32_t> out;
        for (const Trapezoid& t : result_.trapezoids) {
            if (has_height(t)) out[{t.left, t.right, t.top_node, t.bottom_node}] = face(t.face);
        }
        return out;
    }

    /// Without parts that have no length.
    [[nodiscard]] std::vector<SidePart> parts(TexelSide s) const {
        const bool vertical = s == TexelSide::Left || s == TexelSide::Right;
        const auto position = [&](std::uint32_t k) {
            return map_.position(graph_.nodes[k], vertical ? Axis::X : Axis::Y);
        };
        const HalfStep corner = vertical ? frame_.top : frame_.left;
        std::vector<SidePart> out;
        for (SidePart p : result_.sides[static_cast<std::size_t>(s)]) {
            if (p.from != kNone && position(p.from) == LinePosition{corner + 2}) continue;
            if (p.from != kNone && position(p.from) == LinePosition{corner}) p.from = kNone;
            if (!out.empty() && out.back().from == p.from) out.pop_back();
            out.push_back(p);
        }
        return out;
    }

    const PlanarMap& map_;
    const SweepGraph& graph_;
    TexelFrame frame_;
    const SweepResult& result_;
    std::map<std::uint32_t, Portion> portions_; ///< by edge
    std::vector<Corners> trapezoids_;
    std::array<std::vector<SidePart>, 4> sides_;
};

/// Every texel that has edges.
void compare_texels(const Scene& scene, GridSize size, const std::string& name) {
    PlanarStats stats;
    const Result<PlanarMap> map = PlanarMap::build(scene, make_grid(scene.extent, size.width, size.height), 1, stats);
    if (!map) {
        ADD_FAILURE() << name << ": " << map.error().message << " " << map.error().place;
        return;
    }
    Compositor compositor(scene);
    TexelMapper mapper(map.value(), scene, compositor, stats);
    NodeOrder order(map.value(), stats);
    TexelArrangement arrangement(map.value(), order, stats);
    TexelMap texel;
    SweepResult cgal;
    for (std::uint32_t j = 0; j < size.height; ++j) {
        map.value().along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i == size.width || map.value().sub_edges(i, j).empty()) return;
            const std::string where = name + " at " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                      ", texel (" + std::to_string(i) + ", " + std::to_string(j) + ")";
            const bool swept = mapper.analyse(i, j, corner, texel);
            const bool arranged = arrangement.run(texel.sub_edges, texel.graph, texel.frame, cgal);
            EXPECT_TRUE(swept && arranged)
                << where << (swept ? "" : ": not swept") << (arranged ? "" : ": not arranged");
            if (!swept || !arranged) return;
            const TexelAnswer answer(map.value(), texel.graph, texel.frame, texel.sweep);
            EXPECT_EQ(answer.difference(TexelAnswer(map.value(), texel.graph, texel.frame, cgal)), "") << where;
        });
    }
}

TEST(TexelArrangement, AgreesWithTheSweepOnGridDrawings) {
    for (const std::uint64_t seed : stress_seeds(100)) {
        const Drawing d = random_drawing(seed);
        const Scene scene = scene_of(d.paths);
        const auto cells = static_cast<std::uint32_t>(d.cells);
        for (const GridSize size : {GridSize{1, 1}, GridSize{cells, cells}, GridSize{7, 3}})
            compare_texels(scene, size, "seed " + std::to_string(seed));
    }
}

TEST(TexelArrangement, AgreesWithTheSweepOnRandomScenes) {
    for (const std::uint64_t seed : stress_seeds(60)) {
        const Scene scene = random_scene(seed);
        for (const GridSize size : {GridSize{1, 1}, GridSize{8, 8}, GridSize{13, 37}})
            compare_texels(scene, size, "seed " + std::to_string(seed));
    }
}

TEST(TexelArrangement, AgreesWithTheSweepOnOurArt) {
    ASSERT_FALSE(art().empty());
    for (const auto& path : art()) {
        const Result<Scene> scene = load(path);
        ASSERT_TRUE(scene.ok()) << path;
        compare_texels(scene.value(), {64, 64}, path.filename().string());
        compare_texels(scene.value(), {1, 1}, path.filename().string());
    }
}

TEST(TexelArrangement, AgreesWithTheSweepOnTheTiger) {
    const std::filesystem::path path = std::filesystem::path(FETEXC_CORPUS_DIR) / "classic/Ghostscript_Tiger.svg";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no corpus here";
    const Result<Scene> scene = load(path);
    ASSERT_TRUE(scene.ok());
    compare_texels(scene.value(), {64, 64}, "the tiger");
    compare_texels(scene.value(), {256, 256}, "the tiger");
}

// --- the whole scene

struct Plain {
    std::vector<GlobalVertex> vertices;
    std::size_t edges = 0, faces = 0;
};

/// Degrees of the vertices by their place, to about a lattice step. No point of a drawing on a grid lies just where the
/// factors round it up or down.
std::map<std::pair<std::int64_t, std::int64_t>, std::multiset<std::size_t>>
degrees(const std::vector<GlobalVertex>& vertices) {
    std::map<std::pair<std::int64_t, std::int64_t>, std::multiset<std::size_t>> out;
    for (const GlobalVertex& v : vertices)
        out[{std::llround(0.7310585786 * v.x.mid() + 0.1234), std::llround(0.7310585786 * v.y.mid() + 0.1234)}].insert(
            v.degree);
    return out;
}

/// What arrange() found, with Euler's formula for the faces.
Plain plain(const Arrangement& a, const Grid& grid) {
    Plain out;
    UnionFind parts(a.set.vertices.size());
    std::map<std::uint32_t, std::size_t> degree;
    for (const Edge& e : a.edges) {
        if (!reaches_canvas(a.set, a.set.arcs[e.arc], grid)) continue;
        ++out.edges, ++degree[e.va], ++degree[e.vb];
        parts.unite(e.va, e.vb);
    }
    std::size_t components = 0;
    for (const auto& [v, n] : degree) {
        out.vertices.push_back({a.set.vertices[v].x, a.set.vertices[v].y, n});
        components += parts.find(v) == v ? 1 : 0;
    }
    out.faces = out.edges - out.vertices.size() + components + 1;
    return out;
}

void compare_whole(const Scene& scene, const std::string& name) {
    const Grid grid = make_grid(scene.extent, 1, 1);
    PlanarStats stats;
    const Result<Arrangement> arrangement = arrange(scene, grid, 1, stats);
    ASSERT_TRUE(arrangement.ok()) << name << ": " << arrangement.error().message;
    const Plain ours = plain(arrangement.value(), grid);
    const GlobalArrangement cgal = arrange_globally(scene, grid);
    ASSERT_EQ(cgal.undecided, "") << name;
    EXPECT_EQ(ours.vertices.size(), cgal.vertices.size()) << name;
    EXPECT_EQ(ours.edges, cgal.edges) << name;
    EXPECT_EQ(ours.faces, cgal.faces) << name;
    const auto there = degrees(cgal.vertices);
    for (const auto& [place, d] : degrees(ours.vertices)) {
        const auto it = there.find(place);
        EXPECT_TRUE(it != there.end() && it->second == d)
            << name << ": " << d.size() << " vertices, the first of degree " << *d.begin() << ", at "
            << static_cast<double>(place.first) / 0.7310585786 << ", "
            << static_cast<double>(place.second) / 0.7310585786;
    }
}

TEST(GlobalArrangement, AgreesWithOursOnGridDrawings) {
    for (const std::uint64_t seed : stress_seeds(100))
        compare_whole(scene_of(random_drawing(seed).paths), "seed " + std::to_string(seed));
}

TEST(GlobalArrangement, AgreesWithOursOnParts) {
    for (const std::uint64_t seed : stress_seeds(60))
        compare_whole(scene_of(with_parts(random_drawing(seed), seed).paths), "seed " + std::to_string(seed));
}

TEST(GlobalArrangement, AgreesWithOursOnRandomScenes) {
    for (const std::uint64_t seed : stress_seeds(60))
        compare_whole(random_scene(seed), "seed " + std::to_string(seed));
}

TEST(GlobalArrangement, AgreesWithOursOnOurArt) {
    for (const auto& path : art()) {
        const Result<Scene> scene = load(path);
        ASSERT_TRUE(scene.ok()) << path;
        compare_whole(scene.value(), path.filename().string());
    }
}

TEST(GlobalArrangement, AgreesWithOursOnTheTiger) {
    const std::filesystem::path path = std::filesystem::path(FETEXC_CORPUS_DIR) / "classic/Ghostscript_Tiger.svg";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no corpus here";
    const Result<Scene> scene = load(path);
    ASSERT_TRUE(scene.ok());
    compare_whole(scene.value(), "the tiger");
}

} // namespace
} // namespace fetexc::test
