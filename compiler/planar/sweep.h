// SPDX-License-Identifier: GPL-3.0-or-later
/// Horizontal trapezoid decomposition of one texel (DESIGN §5.5, FBT §4.4), by a sweep from top to bottom over edges
/// that meet in nodes only. Level edges count as slightly falling to the right, so no case is special.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/planar/node_order.h"

namespace fetexc {

/// An edge of the texel for the sweep; top comes before bottom in sweep order.
struct SweepEdge {
    std::uint32_t sub = 0;             ///< index into PlanarMap::sub_edges(i,j)
    std::uint32_t top = 0, bottom = 0; ///< indices into the sweep's nodes
    bool down = true;                  ///< t grows from top to bottom
};

/// What a sweep runs over.
struct SweepGraph {
    std::vector<std::uint32_t> nodes; ///< map nodes, in sweep order
    std::vector<NodeRank> ranks;
    std::vector<SweepEdge> edges;
};

/// The part of an edge inside one band. Faces are those of the band: after `unite`, equal ids are one face.
struct Portion {
    std::uint32_t edge = 0, band = 0;
    std::uint32_t left = 0, right = 0;
    bool from_cut = false;      ///< enters through the band's top line (which is a cut, not the texel's side)
    bool to_cut = false;        ///< leaves through its bottom line
    std::uint32_t rank = kNone; ///< starts on the band's top line: position among those, from the left
};

/// 4-sided sub-region: bounded by two edges (or texel sides, kNone) and two horizontal lines through nodes. Sub-regions
/// connected inside the texel have one face.
struct Trapezoid {
    std::uint32_t left = kNone, right = kNone;           ///< sweep edges
    std::uint32_t top_node = kNone, bottom_node = kNone; ///< kNone: texel border or cut
    std::uint32_t face = 0;
};

/// A stretch of a texel's side and the face beside it: from a node on to the next part's, the last to the side's end.
struct SidePart {
    std::uint32_t from = kNone; ///< sweep node; kNone: the side's first corner
    std::uint32_t face = 0;
};

enum class TexelSide : std::uint8_t { Top, Bottom, Left, Right };

struct SweepResult {
    std::vector<Portion> portions; ///< in order of their top
    std::vector<Trapezoid> trapezoids;
    /// By TexelSide, rightwards or downwards; parts may have no length. Of a sweep without cuts only.
    std::array<std::vector<SidePart>, 4> sides;
    std::vector<std::uint32_t> faces; ///< face parent links; use face()
    std::uint32_t first_face = 0;     ///< leftmost in the first slab

    void clear() {
        portions.clear(), trapezoids.clear(), faces.clear(), first_face = 0;
        for (std::vector<SidePart>& side : sides)
            side.clear();
    }

    [[nodiscard]] std::uint32_t face(std::uint32_t f) const {
        while (faces[f] != f)
            f = faces[f];
        return f;
    }
};

/// Nodes [first, last) lie on a band line.
struct Cut {
    std::uint32_t first = 0, last = 0;
};

struct TexelFrame {
    HalfStep left = 0, top = 0; ///< half steps of the texel's left and top sides
};

class Sweep {
  public:
    Sweep(const PlanarMap& map, NodeOrder& order, PlanarStats& stats) : map_(map), order_(order), stats_(stats) {}

    /// cuts: ascending, disjoint ranges of nodes on one level each; that level ends a band and starts the next, edges
    /// along it belong to neither. False: the order of edges at a node contradicts the order found before, which exact
    /// predicates rule out; the caller reports it.
    bool run(std::span<const SubEdge> sub_edges, const SweepGraph& graph, std::span<const Cut> cuts, TexelFrame frame,
             SweepResult& out);

  private:
    struct Gap {
        std::uint32_t face = 0, trapezoid = 0;
    };
    /// Where a node lies in its band: what is connected around it depends on it.
    enum class Side : std::uint8_t { Interior, Top, Bottom, Left, Right };
    void note_first_slab();
    void note_node_on_side(std::uint32_t k, Side side, std::uint32_t left, std::uint32_t right);
    [[nodiscard]] std::vector<SidePart>& side(TexelSide s) { return out_->sides[static_cast<std::size_t>(s)]; }
    void prepare(std::size_t nodes);
    [[nodiscard]] Side side_of(std::uint32_t k) const;
    bool at_node(std::uint32_t k);
    bool cut(Cut range);
    bool find_incoming(std::uint32_t k, std::size_t& from) const;
    std::size_t locate(std::uint32_t k, std::uint32_t edge);
    void replace(std::uint32_t k, std::size_t from, std::size_t count, Side side);
    void next_band();
    void rank_top_line();
    void collect_outgoing(std::uint32_t k);
    bool left_of(std::uint32_t e, std::uint32_t f);
    bool left_of_within(std::uint32_t e, std::uint32_t f);
    int order_between(std::uint32_t e, std::uint32_t f, Axis axis, std::uint32_t from, std::uint32_t to);
    int level_edge_against(std::uint32_t e, std::uint32_t f);
    std::uint32_t new_face();
    Gap open_gap(std::uint32_t face, std::size_t position, std::uint32_t top_node);
    void close_gap(const Gap& gap, std::uint32_t bottom_node);
    void unite(std::uint32_t a, std::uint32_t b);
    void add_portion(std::uint32_t edge, bool from_cut);
    [[nodiscard]] const GridNode& node(std::uint32_t k) const { return map_.node(nodes_[k]); }

    const PlanarMap& map_;
    NodeOrder& order_;
    PlanarStats& stats_;
    std::span<const SubEdge> sub_edges_;
    std::span<const std::uint32_t> nodes_;
    std::span<const NodeRank> ranks_;
    std::span<const SweepEdge> edges_;
    TexelFrame frame_;
    SweepResult* out_ = nullptr;
    std::vector<std::uint32_t> status_;                ///< edges crossing the sweep line, left to right
    std::vector<Gap> gaps_;                            ///< status_.size() + 1
    std::vector<std::uint32_t> portion_;               ///< current portion of each edge
    std::vector<std::uint32_t> first_out_, out_edges_; ///< outgoing edges per node (CSR)
    std::vector<std::uint32_t> next_out_;              ///< scratch
    std::vector<std::uint32_t> in_count_;
    std::vector<std::uint32_t> outgoing_;
    std::vector<bool> level_on_cut_; ///< per edge: lies on a band line
    std::uint32_t band_ = 0;
    bool seen_first_slab_ = false, has_cuts_ = false;
    bool decided_ = true; ///< no comparison of this sweep was left open
};

} // namespace fetexc
