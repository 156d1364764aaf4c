// SPDX-License-Identifier: GPL-3.0-or-later
/// Prepared input of the planar map (DESIGN §5.1): monotone arcs, each stretch of plane curve once, with what crossing
/// it changes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiler/compile.h"
#include "compiler/geometry/exact.h"
#include "compiler/planar/grid.h"
#include "compiler/planar/merged_curves.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// A point of the planar map, in planar space. Integral points are exact; others are enclosed, and defined by what
/// meets there, so that any question about them can be answered exactly (planar/exact_points.h).
struct Vertex {
    Interval x, y;
    bool integral = false;
    IntPoint point;
    std::uint32_t a = kNone, b = kNone;          ///< not integral: curves that cross there; b = kNone: an extremum of a
    Interval s, t;                               ///< its parameters on a and b
    std::shared_ptr<const NarrowContact> narrow; ///< the same, of crossings that exact arithmetic found
};

/// x- and y-monotone stretch between two vertices.
struct Arc {
    std::uint32_t curve = 0;
    Interval t0, t1; ///< enclosures of the parameters of v0, v1; t0 < t1
    std::uint32_t v0 = 0, v1 = 0;
    bool x_increasing = true, y_increasing = true;
    std::uint32_t first_contribution = 0, contributions = 0;
};

/// Two curves that turned out to share their algebraic curve (partial overlap): indices into ArcSet::curves.
struct SharedSupport {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const SharedSupport&, const SharedSupport&) = default;
};

struct ArcSet {
    std::vector<Curve> curves;
    std::vector<Vertex> vertices;
    std::vector<Arc> arcs;
    std::vector<Contribution> contributions;
    bool too_many_contributions = false; ///< kMaxContributions; some are missing
    std::uint32_t undecided = kNone;     ///< a vertex whose place couldn't be decided

    [[nodiscard]] Stretch stretch_of(const Arc& a) const {
        return {&curves[a.curve], {a.t0.lo, a.t1.hi}, a.x_increasing, a.y_increasing};
    }
    [[nodiscard]] std::span<const Contribution> contributions_of(const Arc& a) const {
        return std::span(contributions).subspan(a.first_contribution, a.contributions);
    }
};

/// The scene's merged curves (planar/merged_curves.h) cut at their extrema. `shared`: partial overlaps of curves found
/// by an earlier pass over the same scene; their common stretches become one arc.
ArcSet prepare_arcs(const Scene& scene, const Grid& grid, std::span<const SharedSupport> shared, PlanarStats& stats,
                    unsigned threads = 1, const SkipRules& skip = {});

} // namespace fetexc
