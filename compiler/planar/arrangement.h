// SPDX-License-Identifier: GPL-3.0-or-later
/// All intersections of the arcs, and the arcs cut there: edges that meet in vertices only (DESIGN §5.4).
#pragma once

#include "compiler/parallel.h"
#include "compiler/planar/arcs.h"
#include "compiler/result.h"

namespace fetexc {

/// Part of an arc between two consecutive vertices on it; t grows from va to vb.
struct Edge {
    std::uint32_t arc = 0;
    Interval ta, tb;
    std::uint32_t va = 0, vb = 0;
};

struct Arrangement {
    ArcSet set;
    UnwrittenVector<Edge> edges;

    /// The edge as a stretch of its curve, outer parameter range.
    [[nodiscard]] Stretch stretch_of(const Edge& e) const {
        const Arc& a = set.arcs[e.arc];
        return {&set.curves[a.curve], {e.ta.lo, e.tb.hi}, a.x_increasing, a.y_increasing};
    }
};

/// Every crossing, tangency, shared end point, overlap and coincidence is decided by a certificate or exactly. Pairs
/// are spread over `threads`; the result does not depend on it.
Result<Arrangement> arrange(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats,
                            const SkipRules& skip = {});

} // namespace fetexc
