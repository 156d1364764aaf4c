// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/map_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "compiler/planar/reachability.h"
#include "compiler/planar/trapezoid_area.h"
#include "compiler/union_find.h"
#include "tests/support/exact_winding.h"
#include "tests/support/random.h"
#include "tests/support/trapezoid_point.h"

namespace fetexc::test {
namespace {

WindingKey key_of(const Windings& w) {
    WindingKey key;
    for (const Contribution& c : w)
        key.emplace_back(c.shape, c.winding);
    return key;
}

/// Everything about one texel that the checks share.
struct Faces {
    std::vector<std::uint32_t> region; ///< face id → 0 … count − 1
    std::uint32_t count = 0;
    std::vector<Windings> windings; ///< by region
    std::vector<double> area;       ///< by region, part of the canvas
};

class Checker {
  public:
    Checker(const Scene& scene, const MapCheckOptions& options, const PlanarMap& map)
        : options_(options), map_(map), compositor_(scene), mapper_(map, scene, compositor_, stats_),
          random_(options.seed) {
        for (const Shape& shape : scene.shapes) {
            shapes_.emplace_back();
            for (std::uint32_t k = shape.first; k < shape.first + shape.count; ++k)
                shapes_.back().push_back(planar_curve(scene.segments[k], map.grid()));
        }
    }

    MapCheck run() {
        const Grid& g = map_.grid();
        std::vector<ReachabilityRow> rows;
        std::vector<std::vector<double>> areas(g.height); // by vertex of the row
        for (std::uint32_t j = 0; j < g.height && !out_.failure; ++j) {
            rows.emplace_back(map_, j);
            walk_row(j, rows.back(), areas[j]);
        }
        if (out_.failure) return out_;
        check_bottom();
        const ReachabilityGraph graph(map_, rows, 1);
        if (graph.conflict()) fail(graph.conflict()->i, graph.conflict()->j, "neighbouring texels disagree");
        sum_faces(graph, areas);
        if (options_.inside) check_whole_plane(graph);
        return out_;
    }

  private:
    void fail(std::uint32_t i, std::uint32_t j, const std::string& what) {
        if (!out_.failure)
            out_.failure = what + ", texel (" + std::to_string(i) + ", " + std::to_string(j) + ") of " +
                           std::to_string(map_.grid().width) + "x" + std::to_string(map_.grid().height);
    }

    ResultId id_of(const Windings& w) {
        const auto [it, fresh] = ids_.try_emplace(key_of(w), static_cast<ResultId>(keys_.size()));
        if (fresh) keys_.push_back(&it->first);
        return it->second;
    }

    void walk_row(std::uint32_t j, ReachabilityRow& row, std::vector<double>& areas) {
        const Grid& g = map_.grid();
        const double texel_area = 1.0 / (static_cast<double>(g.width) * g.height);
        const auto add_area = [&](std::uint32_t vertex, double area) {
            if (vertex >= areas.size()) areas.resize(vertex + 1, 0);
            areas[vertex] += area;
        };
        TexelMap texel;
        bottom_.clear();
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (out_.failure || i == g.width) return;
            if (map_.sub_edges(i, j).empty()) {
                add_area(row.add_empty(id_of(corner)), texel_area);
                bottom_.push_back(corner);
                return;
            }
            if (!mapper_.analyse(i, j, corner, texel)) return fail(i, j, "the sweep contradicts itself");
            Faces faces;
            check_texel(texel, corner, faces);
            if (out_.failure) return;
            std::vector<ResultId> ids;
            for (const Windings& w : faces.windings)
                ids.push_back(id_of(w));
            const std::uint32_t first = row.add_texel(texel, faces.region, ids);
            for (std::uint32_t r = 0; r < faces.count; ++r)
                add_area(first + r, faces.area[r]);
            bottom_.push_back(
                faces.windings[faces.region[texel.sweep.sides[static_cast<int>(TexelSide::Bottom)].front().face]]);
        });
    }

    /// Row `height` of the running sums goes along the bottom border, seen from inside.
    void check_bottom() {
        const Grid& g = map_.grid();
        map_.along_row(g.height, [&](std::uint32_t i, const Windings& w) {
            if (i < g.width && key_of(w) != key_of(bottom_[i])) fail(i, g.height - 1, "the bottom border disagrees");
        });
    }

    void check_texel(const TexelMap& texel, const Windings& corner, Faces& faces) {
        const SweepResult& s = texel.sweep;
        faces.region.assign(s.faces.size(), kNone);
        for (std::uint32_t f = 0; f < s.faces.size(); ++f) {
            std::uint32_t& region = faces.region[s.face(f)];
            if (region == kNone) region = faces.count++;
            faces.region[f] = region;
        }
        check_euler(texel, faces);
        spread_windings(texel, corner, faces);
        if (out_.failure) return;
        check_areas(texel, faces);
        const std::size_t n = s.trapezoids.size(), points = static_cast<std::size_t>(options_.points_per_texel);
        for (std::size_t k = 0; k < std::min(n, points); ++k) {
            const std::size_t pick =
                n <= points ? k : static_cast<std::size_t>(random_.integer(0, static_cast<int>(n) - 1));
            check_point(texel, s.trapezoids[pick], faces);
        }
    }

    /// With the texel's frame, V − E + F = 1 + C: frame nodes and frame edges cancel, the outer face is the 1.
    void check_euler(const TexelMap& texel, const Faces& faces) {
        const SweepGraph& graph = texel.graph;
        UnionFind sets(graph.nodes.size() + 1); // the last: the frame
        std::int64_t inner = 0, components = 0;
        for (std::uint32_t k = 0; k < graph.nodes.size(); ++k) {
            const GridNode& n = map_.node(graph.nodes[k]);
            if (n.hx == texel.frame.left + 1 && n.hy == texel.frame.top + 1)
                ++inner;
            else
                sets.unite(k, static_cast<std::uint32_t>(graph.nodes.size()));
        }
        for (const SweepEdge& e : graph.edges)
            sets.unite(e.top, e.bottom);
        for (std::uint32_t k = 0; k < sets.size(); ++k)
            components += sets.find(k) == k ? 1 : 0;
        if (inner - static_cast<std::int64_t>(graph.edges.size()) + static_cast<std::int64_t>(faces.count) !=
            components)
            fail(texel.i, texel.j,
                 "Euler's formula fails: " + std::to_string(inner) + " inner vertices, " +
                     std::to_string(graph.edges.size()) + " edges, " + std::to_string(faces.count) + " faces, " +
                     std::to_string(components) + " components");
    }

    /// From the corner's face across the edges; then every edge has to agree with both its sides.
    void spread_windings(const TexelMap& texel, const Windings& corner, Faces& faces) {
        const SweepResult& s = texel.sweep;
        faces.windings.assign(faces.count, {});
        std::vector<bool> known(faces.count, false);
        const std::uint32_t start = faces.region[s.first_face];
        faces.windings[start] = corner, known[start] = true;
        const auto across = [&](const Portion& p, bool rightwards) {
            const SweepEdge& e = texel.graph.edges[p.edge];
            Windings w = faces.windings[faces.region[rightwards ? p.left : p.right]];
            add_windings(w, map_.contributions_of(texel.sub_edges[e.sub]), e.down == rightwards ? 1 : -1);
            return w;
        };
        for (bool grew = true; grew;) {
            grew = false;
            for (const Portion& p : s.portions) {
                const std::uint32_t left = faces.region[p.left], right = faces.region[p.right];
                if (known[left] == known[right]) continue;
                faces.windings[known[left] ? right : left] = across(p, known[left]);
                known[left] = known[right] = grew = true;
            }
        }
        if (std::find(known.begin(), known.end(), false) != known.end())
            fail(texel.i, texel.j, "a face that no edge leads to");
        for (const Portion& p : s.portions) {
            if (key_of(across(p, true)) != key_of(faces.windings[faces.region[p.right]]))
                return fail(texel.i, texel.j, "winding numbers beside an edge disagree");
        }
    }

    void check_areas(const TexelMap& texel, Faces& faces) {
        const Grid& g = map_.grid();
        const double whole = static_cast<double>(g.px) * static_cast<double>(g.py), canvas = whole * g.width * g.height;
        TrapezoidAreas areas(map_, texel);
        faces.area.assign(faces.count, 0);
        double sum = 0, error = 0;
        for (const Trapezoid& t : texel.sweep.trapezoids) {
            const BoundedArea a = areas.of(t);
            if (a.area < -a.error)
                fail(texel.i, texel.j, "a trapezoid is inside out by " + std::to_string(a.area / whole));
            faces.area[faces.region[t.face]] += a.area / canvas;
            sum += a.area, error += a.error;
        }
        out_.area_error += error / canvas;
        if (!(std::fabs(sum - whole) <= error))
            fail(texel.i, texel.j, "areas add up to " + std::to_string(sum / whole) + " of the texel");
    }

    /// A random point inside the trapezoid: in its face, so with its face's winding numbers.
    void check_point(const TexelMap& texel, const Trapezoid& t, const Faces& faces) {
        const TrapezoidPoint p = point_in(map_, texel, t, random_);
        if (p.wrong_order) return fail(texel.i, texel.j, "the sides of a trapezoid are in the wrong order");
        if (!p.point) {
            ++out_.points_undecidable;
            return;
        }
        ++out_.points;
        WindingKey expected;
        for (std::uint32_t shape = 0; shape < shapes_.size(); ++shape) {
            const std::optional<int> w = winding_at(shapes_[shape], *p.point);
            if (!w) {
                --out_.points, ++out_.points_undecidable;
                return;
            }
            if (*w != 0) expected.emplace_back(shape, *w);
        }
        if (expected != key_of(faces.windings[faces.region[t.face]]))
            fail(texel.i, texel.j, "a rational point has other winding numbers than its face");
    }

    void sum_faces(const ReachabilityGraph& graph, const std::vector<std::vector<double>>& areas) {
        const std::vector<std::uint32_t> root = graph.components();
        for (std::uint32_t j = 0; j < areas.size(); ++j) {
            for (std::uint32_t v = 0; v < areas[j].size(); ++v) {
                const std::uint32_t vertex = graph.row_start(j) + v;
                FaceSum& sum = out_.faces[*keys_[graph.result(vertex)]];
                sum.faces += root[vertex] == vertex ? 1 : 0;
                sum.area += areas[j][v];
            }
        }
    }

    void check_whole_plane(const ReachabilityGraph& graph) {
        const Arrangement& a = map_.arrangement();
        UnionFind sets(a.set.vertices.size());
        std::set<std::uint32_t> vertices;
        for (const Edge& e : a.edges) {
            sets.unite(e.va, e.vb);
            vertices.insert({e.va, e.vb});
        }
        const auto components =
            std::count_if(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return sets.find(v) == v; });
        const auto v = static_cast<std::int64_t>(vertices.size()), e = static_cast<std::int64_t>(a.edges.size());
        const auto f = static_cast<std::int64_t>(graph.component_count());
        out_.edges_minus_vertices = e - v;
        if (v - e + f != 1 + components)
            fail(0, 0,
                 "Euler's formula fails for the canvas: " + std::to_string(v) + " vertices, " + std::to_string(e) +
                     " edges, " + std::to_string(f) + " faces, " + std::to_string(components) + " components");
        check_integrals();
    }

    void check_integrals() {
        const Grid& g = map_.grid();
        const double canvas = static_cast<double>(g.right()) * static_cast<double>(g.bottom());
        std::vector<double> sums(shapes_.size(), 0), errors(shapes_.size(), 0);
        for (const auto& [key, sum] : out_.faces) {
            for (const auto& [shape, winding] : key) {
                sums[shape] += winding * sum.area;
                errors[shape] += std::abs(winding) * out_.area_error;
            }
        }
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const double expected = winding_area(shapes_[s]).get_d() / canvas;
            if (!(std::fabs(sums[s] - expected) <= errors[s] + 0x1p-40 * (1 + std::fabs(expected)))) {
                std::ostringstream what;
                what << "shape " << s << ": areas times winding numbers give " << sums[s] << ", its contour "
                     << expected;
                fail(0, 0, what.str());
            }
        }
    }

    const MapCheckOptions& options_;
    const PlanarMap& map_;
    PlanarStats stats_;
    Compositor compositor_;
    TexelMapper mapper_;
    Random random_;
    std::vector<std::vector<PlanarCurve>> shapes_;
    std::map<WindingKey, ResultId> ids_;
    std::vector<const WindingKey*> keys_; ///< by id
    std::vector<Windings> bottom_;        ///< at the lower left corners of the row's texels
    MapCheck out_;
};

} // namespace

MapCheck check_map(const Scene& scene, const MapCheckOptions& options) {
    PlanarStats stats;
    const Grid grid = make_grid(scene.extent, options.size.width, options.size.height);
    const Result<PlanarMap> map = PlanarMap::build(scene, grid, 1, stats);
    if (!map) {
        MapCheck out;
        out.failure = "E" + std::to_string(map.error().code) + ": " + map.error().message + ", " + map.error().place +
                      " of " + std::to_string(grid.width) + "x" + std::to_string(grid.height);
        return out;
    }
    return Checker(scene, options, map.value()).run();
}

} // namespace fetexc::test
