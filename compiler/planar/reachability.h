// SPDX-License-Identifier: GPL-3.0-or-later
/// The reachability graph (DESIGN §5.6, FBT §4.4): which parts of the texture can be reached from which without
/// crossing a visible edge.
///
/// The paper's vertices are the 4-sided sub-regions of the trapezoid decomposition. Sub-regions connected inside their
/// texel are one vertex here, a region of the texel, and so are neighbouring texels of a row without a visible edge
/// that show one result: nothing is spent on the empty parts of a scene. Links run across the sides between texels,
/// where two regions with the same visible result face each other along a stretch of positive length.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/planar/facing.h"
#include "compiler/planar/texel_map.h"

namespace fetexc {

/// What separates neighbouring texels: different results (a drawing), or edges alone (features over an image; then
/// every texel is a vertex of its own, and results say nothing from texel to texel).
enum class Separation : std::uint8_t { Results, Edges };

/// Two regions with different results face each other although no edge runs between them: a right planar map rules it
/// out.
struct ReachConflict {
    std::uint32_t i = 0, j = 0; ///< texel to the right of the side, or below it
};

/// Vertices a < b.
struct ReachLink {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const ReachLink&, const ReachLink&) = default;
};

/// One row of texels, built from left to right. Rows can be built in parallel.
class ReachabilityRow {
  public:
    ReachabilityRow() = default;
    ReachabilityRow(const PlanarMap& map, std::uint32_t row, Separation separation = Separation::Results)
        : map_(&map), separation_(separation), row_(row) {}

    /// The next texel has no visible edge. Returns its vertex, row-local.
    std::uint32_t add_empty(ResultId result);
    /// The next texel, with its regions. Returns the vertex of region 0; region r's is r further.
    std::uint32_t add_texel(const TexelMap& texel, std::span<const std::uint32_t> region_of_face,
                            std::span<const ResultId> region_result);

    /// The first one, on a side between two texels of the row.
    [[nodiscard]] const std::optional<ReachConflict>& conflict() const { return conflict_; }

  private:
    friend class ReachabilityGraph;
    using Parts = std::vector<LinePart>;
    std::uint32_t new_vertex(ResultId result);
    void link_to_left(const Parts& left);
    /// The texel's side, in parts; replaces `out`.
    void list_parts(const TexelMap& texel, TexelSide side, std::span<const std::uint32_t> region_of_face,
                    std::uint32_t first, Parts& out) const;

    const PlanarMap* map_ = nullptr;
    Separation separation_ = Separation::Results;
    std::uint32_t row_ = 0, next_ = 0;  ///< next texel
    std::vector<std::uint32_t> column_; ///< per vertex: its first texel
    std::vector<ResultId> result_;
    std::vector<ReachLink> links_;
    Parts top_, bottom_, right_; ///< right_: of the texel before next_
    Parts scratch_;
    bool run_ = false; ///< that texel had no visible edge
    std::optional<ReachConflict> conflict_;
};

class ReachabilityGraph {
  public:
    /// Joins all rows of the map, from the top.
    ReachabilityGraph(const PlanarMap& map, std::vector<ReachabilityRow>& rows, unsigned threads);

    [[nodiscard]] std::size_t vertices() const { return result_.size(); }
    [[nodiscard]] std::span<const ReachLink> links() const { return links_; } ///< ascending
    [[nodiscard]] ResultId result(std::uint32_t vertex) const { return result_[vertex]; }
    /// First vertex of row j; j = height: vertices().
    [[nodiscard]] std::uint32_t row_start(std::uint32_t j) const { return row_start_[j]; }
    /// The vertex of region 0 of texel (i,j), or of the run that the texel belongs to.
    [[nodiscard]] std::uint32_t first_vertex(std::uint32_t i, std::uint32_t j) const;
    /// First texel of a vertex.
    [[nodiscard]] std::uint32_t column(std::uint32_t vertex) const { return column_[vertex]; }
    [[nodiscard]] std::uint32_t row(std::uint32_t vertex) const;
    /// For every vertex the smallest vertex that it can reach.
    [[nodiscard]] const std::vector<std::uint32_t>& components() const { return components_; }
    [[nodiscard]] std::uint64_t component_count() const { return component_count_; }
    [[nodiscard]] const std::optional<ReachConflict>& conflict() const { return conflict_; }

  private:
    struct RowLinks {
        std::vector<ReachLink> links; ///< inside a row and to the one below
        std::optional<ReachConflict> conflict;
    };
    [[nodiscard]] RowLinks links_of(const ReachabilityRow& row) const;
    void link_rows(const PlanarMap& map, const ReachabilityRow& above, const ReachabilityRow& below,
                   RowLinks& out) const;
    void find_components();

    std::vector<std::uint32_t> row_start_, column_;
    std::vector<ResultId> result_;
    std::vector<ReachLink> links_;
    std::vector<std::uint32_t> components_;
    std::uint64_t component_count_ = 0;
    std::optional<ReachConflict> conflict_;
};

} // namespace fetexc
