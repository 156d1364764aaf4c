// SPDX-License-Identifier: GPL-3.0-or-later
/// The cells of a silhouette map whose edges are an image's features (the paper's Fig. 6): curves that may be open, and
/// separate whatever lies beside them.
#pragma once

#include <array>
#include <vector>

#include "compiler/planar/reachability.h"

namespace fetexc {

/// A row of cells, read from left to right: which face lies at each corner, and which faces reach each other.
class FaceRow {
  public:
    FaceRow(const PlanarMap& map, std::uint32_t row) : reach_(map, row, Separation::Edges) {}

    /// The next cell: without edges, or with them (its faces told apart).
    void add_empty() { reach_.add_empty(0); }
    void add(const TexelMap& cell);

    /// Of a cell with several faces.
    struct Corners {
        std::uint32_t i = 0;
        std::array<ResultId, 4> faces{}; ///< by corner; numbers of this cell alone
        std::array<std::uint32_t, 4> vertices{};
    };
    [[nodiscard]] const std::vector<Corners>& corners() const { return corners_; }
    [[nodiscard]] ReachabilityRow& reach() { return reach_; }

  private:
    ReachabilityRow reach_;
    std::vector<Corners> corners_;
    std::vector<std::uint32_t> region_of_face_; ///< scratch
    std::vector<ResultId> region_result_;
};

struct SilmapCells;

/// Sets faces and apart of the cells (SilmapCellData): two corners on a side are apart if no way through the two cells
/// beside it leads from one to the other without crossing a feature: one that ends in either of them separates nothing.
/// False: the map contradicts itself.
bool find_boundaries(SilmapCells& cells, const PlanarMap& map, std::vector<FaceRow>& rows, unsigned threads);

} // namespace fetexc
