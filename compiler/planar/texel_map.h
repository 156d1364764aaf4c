// SPDX-License-Identifier: GPL-3.0-or-later
/// One texel of the planar map, finished: faces with their visible results (DESIGN §5.5–§5.7).
#pragma once

#include <vector>

#include "compiler/planar/sweep.h"
#include "compiler/planar/texel_arrangement.h"
#include "compiler/scene/compositor.h"

namespace fetexc {

struct TexelMap {
    std::uint32_t i = 0, j = 0;
    TexelFrame frame;
    std::span<const SubEdge> sub_edges;
    SweepGraph graph; ///< of all sub-edges
    SweepResult sweep;
    std::vector<ResultId> results; ///< per face id (same for united faces)

    [[nodiscard]] ResultId left_result(const Portion& p) const { return results[p.left]; }
    [[nodiscard]] ResultId right_result(const Portion& p) const { return results[p.right]; }
};

/// The only edge of a texel, from one of its sides to another; its ends are no corners. From top to bottom, as the
/// sweep has it.
struct LoneEdge {
    std::uint32_t i = 0, j = 0; ///< texel
    const SubEdge* sub = nullptr;
    std::uint32_t top = 0, bottom = 0; ///< map nodes
    bool down = true;                  ///< t grows from top to bottom
    ResultId left = 0, right = 0;
};

/// Winding numbers → visible result; remembers the last answer, because neighbours mostly ask the same.
class ResultLookup {
  public:
    ResultLookup(const Scene& scene, Compositor& compositor) : scene_(scene), compositor_(compositor) {}
    ResultId operator()(const Windings& w);

  private:
    const Scene& scene_;
    Compositor& compositor_;
    std::vector<std::uint32_t> inside_, last_inside_;
    ResultId last_ = 0;
    bool any_ = false;
};

class TexelMapper {
  public:
    TexelMapper(const PlanarMap& map, const Scene& scene, Compositor& compositor, PlanarStats& stats,
                const SkipRules& skip = {})
        : map_(map), skip_(skip), stats_(stats), order_(map, stats), sweep_(map, order_, stats),
          arrangement_(map, order_, stats), lookup_(scene, compositor) {}

    /// From now on every face of a texel has a result of its own: edges are features whatever lies beside them
    /// (compiler/raster), and only those that split nothing are invisible.
    void tell_faces_apart() { faces_apart_ = true; }

    /// corner: winding numbers at the texel's corner, from PlanarMap::along_row. False: inconsistent (reported by the
    /// caller).
    bool analyse(std::uint32_t i, std::uint32_t j, const Windings& corner, TexelMap& out);

    /// The same of a texel with a lone edge, without a sweep. False: it has none, and stays to be analysed.
    bool analyse_lone(std::uint32_t i, std::uint32_t j, const Windings& corner, LoneEdge& out);

    Sweep& sweep() { return sweep_; }
    ResultLookup& lookup() { return lookup_; }

  private:
    /// The sub-edges' nodes in exact order, and the edges between them.
    void collect(std::span<const SubEdge> sub_edges, SweepGraph& out);
    void list_portions_of_faces(const SweepResult& sweep);
    bool assign_results(const Windings& corner, TexelMap& out);

    const PlanarMap& map_;
    SkipRules skip_;
    PlanarStats& stats_;
    NodeOrder order_;
    Sweep sweep_;
    TexelArrangement arrangement_;
    ResultLookup lookup_;
    bool faces_apart_ = false;
    // scratch
    std::vector<std::pair<std::uint32_t, std::uint32_t>> index_; ///< node → position
    std::vector<std::uint32_t> portion_start_, queue_;
    std::vector<std::pair<std::uint32_t, std::int32_t>> portion_of_face_; ///< +1: the face lies left of it
    std::vector<Windings> windings_;                                      ///< per face
    std::vector<bool> known_;
    Windings beyond_; ///< a lone edge
};

} // namespace fetexc
