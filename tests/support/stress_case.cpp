// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/stress_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "compiler/diagnostics.h"
#include "tests/support/random.h"
#include "tests/support/region_check.h"

namespace fetexc::test {
namespace {

constexpr int kPoints = 8, kFewPoints = 2; ///< per texel

/// One texel, powers of two (on whose lines many drawings have something), and odd, uneven ones.
GridSize grid_of(std::uint64_t seed, std::uint64_t k) {
    static constexpr std::array<GridSize, 7> grids{{{1, 1}, {8, 8}, {3, 5}, {16, 4}, {7, 1}, {2, 2}, {5, 13}}};
    return k == 0 ? grids[0] : grids[1 + (seed + k) % (grids.size() - 1)];
}

std::string name_of(GridSize size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

MapCheck map_of(const Drawing& d, GridSize size, std::uint64_t seed, int points) {
    return check_map(scene_of(d), {size, points, seed, lies_inside(d)});
}

Failure map_failure(const Scene& scene, std::uint64_t seed, bool inside, int grids) {
    std::optional<MapCheck> first;
    for (int k = 0; k < grids; ++k) {
        const MapCheck c = check_map(scene, {grid_of(seed, static_cast<std::uint64_t>(k)), kPoints, seed, inside});
        if (c.failure) return c.failure;
        if (!first) {
            first = c;
        } else if (const Failure f = compare_faces(*first, c)) {
            return "on " + name_of(grid_of(seed, static_cast<std::uint64_t>(k))) + ": " + *f;
        }
    }
    return {};
}

Failure fails_on_grids(const Drawing& d, std::uint64_t seed) {
    return map_failure(scene_of(d), seed, lies_inside(d), 2);
}

Failure region_failure(const Scene& scene, std::uint64_t seed) {
    const GridSize size = grid_of(seed, 2);
    FbtRegions regions;
    const Result<FbtBuild> build = build_fbt(scene, {size, 1}, {}, &regions);
    if (!build)
        return "E" + std::to_string(build.error().code) + ": " + build.error().message + " " + build.error().place +
               " of " + name_of(size);
    const RegionCheck check = check_regions(scene, build.value(), regions, 60, seed);
    if (check.wrong_far == 0) return {};
    return "wrong region: " + check.worst + " of " + name_of(size);
}

Failure fails_regions(const Drawing& d, std::uint64_t seed) { return region_failure(scene_of(d), seed); }

/// The compiler says that it contradicts itself (E4001).
Failure fails_with_error(const Drawing& d, std::uint64_t seed) {
    for (std::uint64_t k = 0; k < 4; ++k) {
        const Result<FbtBuild> build = build_fbt(scene_of(d), {grid_of(seed, k), 1}, {}, nullptr);
        if (!build && build.error().code == diag::kPlanarInconsistent)
            return build.error().message + " " + build.error().place + " of " + name_of(grid_of(seed, k));
    }
    return {};
}

struct Move {
    const char* name;
    Drawing (*drawing)(const Drawing&);
    bool flips;    ///< winding numbers change their sign
    bool permutes; ///< shapes in the opposite order
};

constexpr std::array kMoves{
    Move{"mirrored",
         [](const Drawing& d) {
             return mapped(d, [](LatticePoint p) { return LatticePoint{kLatticeSteps - p.x, p.y}; });
         },
         true, false},
    Move{"transposed",
         [](const Drawing& d) { return mapped(d, [](LatticePoint p) {
                                    return LatticePoint{p.y, p.x};
                                }); }, true,
         false},
    Move{"turned by 90 degrees",
         [](const Drawing& d) {
             return mapped(d, [](LatticePoint p) { return LatticePoint{p.y, kLatticeSteps - p.x}; });
         },
         false, false},
    Move{"reversed", [](const Drawing& d) { return reversed(d); }, true, false},
    Move{"permuted", [](const Drawing& d) { return permuted(d); }, false, true},
};

/// The faces as they would be after the move.
MapCheck moved_faces(const MapCheck& c, const Move& move, std::size_t shapes) {
    MapCheck out = c;
    out.faces.clear();
    for (const auto& [key, sum] : c.faces) {
        WindingKey k = key;
        for (auto& [shape, winding] : k) {
            if (move.flips) winding = -winding;
            if (move.permutes) shape = static_cast<std::uint32_t>(shapes) - 1 - shape;
        }
        std::sort(k.begin(), k.end());
        out.faces.emplace(k, sum);
    }
    return out;
}

Failure fails_moved(const Drawing& d, std::uint64_t seed) {
    const MapCheck drawn = map_of(d, {1, 1}, seed, kFewPoints);
    if (drawn.failure) return drawn.failure;
    std::uint64_t k = 0;
    for (const Move& move : kMoves) {
        const GridSize size = grid_of(seed, k++);
        const MapCheck got = map_of(move.drawing(d), size, seed, kFewPoints);
        Failure f = got.failure;
        if (!f) f = compare_faces(moved_faces(drawn, move, d.paths.size()), got);
        if (!f && lies_inside(d) && got.edges_minus_vertices != drawn.edges_minus_vertices)
            f = "E - V is " + std::to_string(got.edges_minus_vertices) + " instead of " +
                std::to_string(drawn.edges_minus_vertices);
        if (f) return std::string(move.name) + " on " + name_of(size) + ": " + *f;
    }
    return {};
}

constexpr double kCanvas = 512;
constexpr double kStep = kCanvas / static_cast<double>(kLatticeSteps);

using CanvasMap = std::function<CanvasPoint(CanvasPoint)>;

Result<Scene> built(const Drawing& d, double canvas, const CanvasMap& map) {
    SceneBuilder builder(canvas, canvas);
    for (CanvasContour& contour : contours_of(d, kStep)) {
        for (CanvasSegment& s : contour)
            std::transform(s.p.begin(), s.p.begin() + s.degree + 1, s.p.begin(), map);
        const std::uint32_t k = builder.add_shape({contour}, d.rule, kNone);
        const double v = 0.1 + 0.8 * (k % 9) / 9;
        builder.scene().paints.emplace_back(SolidPaint{{v, 1 - v, 0.5, 1}});
        Node node;
        node.end = k + 1, node.shape = k, node.paint = k;
        builder.scene().nodes.push_back(node);
    }
    return builder.finish({false});
}

bool same_geometry(const Scene& a, const Scene& b) {
    const auto equal = [](const Segment& p, const Segment& q) { return p.degree == q.degree && p.p == q.p; };
    return std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), b.segments.end(), equal);
}

bool scene_lies_inside(const Scene& scene) {
    return std::all_of(scene.segments.begin(), scene.segments.end(), [&](const Segment& s) {
        return std::all_of(s.p.begin(), s.p.begin() + s.degree + 1, [&](LatticePoint p) {
            return p.x > 0 && p.y > 0 && p.x < scene.extent.lattice_w && p.y < scene.extent.lattice_h;
        });
    });
}

/// Through the front door: canvas coordinates in double. Scaled by 2^±40 the lattice image is the same; turned by any
/// angle it is another drawing, with invariants of its own.
Failure fails_on_canvas(const Drawing& d, std::uint64_t seed) {
    const Result<Scene> drawn = built(d, kCanvas, [](CanvasPoint p) { return p; });
    if (!drawn) return "E" + std::to_string(drawn.error().code) + ": " + drawn.error().message;
    for (const double scale : {0x1p-40, 0x1p+40}) {
        const Result<Scene> scaled = built(d, scale * kCanvas, [=](CanvasPoint p) {
            return CanvasPoint{scale * p.x, scale * p.y};
        });
        if (!scaled || !same_geometry(drawn.value(), scaled.value())) return "scaling changes the lattice image";
    }
    if (const Failure f = region_failure(drawn.value(), seed)) return f;
    Random random(seed);
    const double angle = random.between(0, 6.28), zoom = random.between(0.3, 0.9);
    const double c = zoom * std::cos(angle), s = zoom * std::sin(angle), half = kCanvas / 2;
    const Result<Scene> turned = built(d, kCanvas, [=](CanvasPoint p) {
        const double x = p.x - half, y = p.y - half;
        return CanvasPoint{half + c * x - s * y, half + s * x + c * y};
    });
    if (!turned) return "E" + std::to_string(turned.error().code) + ": " + turned.error().message;
    Failure f = check_map(turned.value(), {grid_of(seed, 1), kPoints, seed, scene_lies_inside(turned.value())}).failure;
    if (!f) f = region_failure(turned.value(), seed);
    return f ? "turned by " + std::to_string(angle) + ": " + *f : f;
}

constexpr std::array kChecks{
    StressCheck{"error", "the compiler reports a contradiction (E4001) on one of four grids", fails_with_error},
    StressCheck{"map", "an invariant of the planar map is broken, or faces differ from grid to grid", fails_on_grids},
    StressCheck{"region", "the FBT has a point in the wrong region, or can't be built", fails_regions},
    StressCheck{"moved", "faces, areas or E - V change with a mirrored, turned, reversed or permuted drawing",
                fails_moved},
    StressCheck{"canvas", "through SceneBuilder: scaled by 2^40 or turned by some angle, an invariant is broken",
                fails_on_canvas},
};

} // namespace

std::span<const StressCheck> stress_checks() { return kChecks; }

const StressCheck* find_check(std::string_view name) {
    const auto it = std::find_if(kChecks.begin(), kChecks.end(), [&](const StressCheck& c) { return name == c.name; });
    return it == kChecks.end() ? nullptr : &*it;
}

Failure first_failure(const Drawing& drawing, std::uint64_t seed) {
    for (const StressCheck& check : std::span(kChecks).subspan(1)) { // the others report errors, too
        if (const Failure f = check.run(drawing, seed)) return std::string(check.name) + ": " + *f;
    }
    return {};
}

Failure first_scene_failure(const Scene& scene, std::uint64_t seed, bool inside) {
    if (const Failure f = map_failure(scene, seed, inside, 2)) return f;
    return region_failure(scene, seed);
}

Failure compare_faces(const MapCheck& a, const MapCheck& b) {
    if (a.faces.size() != b.faces.size())
        return std::to_string(b.faces.size()) + " different faces instead of " + std::to_string(a.faces.size());
    const double tolerance = a.area_error + b.area_error + 0x1p-40;
    for (const auto& [key, sum] : a.faces) {
        const auto it = b.faces.find(key);
        if (it == b.faces.end()) return "a combination of winding numbers is gone";
        if (it->second.faces != sum.faces)
            return std::to_string(it->second.faces) + " faces instead of " + std::to_string(sum.faces);
        if (!(std::fabs(it->second.area - sum.area) <= tolerance)) {
            std::ostringstream what;
            what << "area " << it->second.area << " instead of " << sum.area;
            return what.str();
        }
    }
    return {};
}

} // namespace fetexc::test
