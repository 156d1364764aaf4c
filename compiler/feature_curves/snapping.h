// SPDX-License-Identifier: GPL-3.0-or-later
/// Snapping (Parilov and Zorin 2008, §4): a network becomes a valid configuration and signature for each texel, by
/// inserting one segment after the other; of quadratics, signatures that aren't valid are fitted. README.md has the
/// steps.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/feature_curves/lattice_curves.h"
#include "compiler/feature_curves/transformations.h"
#include "compiler/result.h"

namespace fetexc {

/// Why curves in a texel aren't where the input has them; bits of FeatureMove::kinds.
enum FeatureMoveKind : std::uint8_t {
    kEdgeMerged = 1,     ///< several points of an edge became one
    kVertexCut = 2,      ///< a vertex inside the texel: a straight segment replaces the lines that meet there
    kRerouted = 4,       ///< a segment became part of the others (the table)
    kEndCut = 8,         ///< an end inside the texel: the curve ends on the boundary
    kFolded = 16,        ///< lines that leave through the edge that they came in by
    kLostInside = 32,    ///< lines that touch no edge
    kFitted = 64,        ///< points and tangents moved for a segment to be valid, here or beside
    kStraightened = 128, ///< no valid quadratic was found: a segment is straight, and bends where it ends
};

/// A texel that isn't as the input has it.
struct FeatureMove {
    std::uint32_t i = 0, j = 0;
    std::uint8_t kinds = 0;
    /// Texels; no point of the input's curves in the texel is farther from the texture's curves, but for what
    /// kLostInside has left out.
    double distance = 0;
};

struct SnapStats {
    std::uint64_t lines = 0, crossings = 0, segments = 0; ///< segments: inserted, before the table
    std::uint64_t rerouted = 0;                           ///< segments that the table replaced
    std::uint64_t junctions = 0;                          ///< three and more ways out of a texel joined in it
    std::uint64_t ends_cut = 0, folded = 0, lost_inside = 0;
    std::uint64_t curved = 0, invalid = 0; ///< segments that aren't straight, and those of them that weren't valid
    std::uint64_t problems = 0, fitted = 0, straightened = 0; ///< local problems, solved ones, segments made straight
    std::uint64_t edges_of_profiles = 0; ///< edges with a point that curves of several profiles cross
};

struct SnappedTexel {
    SegmentSet segments = 0; ///< a configuration
    SegmentSet inserted = 0; ///< what was inserted
    SegmentSet curved = 0;   ///< of the segments: the others are straight
    std::uint8_t kinds = 0;  ///< FeatureMoveKind, those that only quadratics have, and kFolded of one that turns inside
};

/// Positions of edges that no segment ends on are the default.
struct SnappedCurves {
    std::uint32_t width = 0, height = 0;
    std::vector<SnappedTexel> texels; ///< row by row
    /// (width+1)·(height+1): of the north edge of texel (i,j), and of its west edge.
    std::vector<double> north, west;
    std::vector<double> north_angle, west_angle; ///< the same of tangents, in [0, π); empty if everything is straight
    std::vector<std::uint8_t> north_profile, west_profile; ///< the same of profiles; empty if all are 0
    SnapStats stats;
    std::vector<FeatureMove> moves; ///< row by row

    /// Of texel (i,j).
    [[nodiscard]] double position(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        return is_vertical(e) ? west[corner(i, j, e)] : north[corner(i, j, e)];
    }
    [[nodiscard]] double& position(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) {
        return is_vertical(e) ? west[corner(i, j, e)] : north[corner(i, j, e)];
    }
    [[nodiscard]] double angle(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        return is_vertical(e) ? west_angle[corner(i, j, e)] : north_angle[corner(i, j, e)];
    }
    [[nodiscard]] double& angle(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) {
        return is_vertical(e) ? west_angle[corner(i, j, e)] : north_angle[corner(i, j, e)];
    }
    [[nodiscard]] std::uint8_t& profile(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) {
        return is_vertical(e) ? west_profile[corner(i, j, e)] : north_profile[corner(i, j, e)];
    }
    [[nodiscard]] const SnappedTexel& texel(std::uint32_t i, std::uint32_t j) const {
        return texels[std::size_t{j} * width + i];
    }
    /// A segment of the texel, or of the one across the edge, ends on it. Of (width, j) and (i, height): West, North.
    [[nodiscard]] bool is_used(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const;

  private:
    static bool is_vertical(fetex::FeatureEdge e) {
        return e == fetex::FeatureEdge::East || e == fetex::FeatureEdge::West;
    }
    [[nodiscard]] std::size_t corner(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        const std::size_t column = i + (e == fetex::FeatureEdge::East), row = j + (e == fetex::FeatureEdge::South);
        return row * (std::size_t{width} + 1) + column;
    }
};

/// Preconditions: 1 ≤ width, height ≤ 16384. On `threads` threads (0: all), with the same result for any number.
SnappedCurves snap_lines(const LatticeLines& lines, std::uint32_t width, std::uint32_t height, unsigned threads = 1);

/// Likewise.
SnappedCurves snap_quadratics(const LatticeCurves& curves, std::uint32_t width, std::uint32_t height,
                              unsigned threads = 1);

/// Warnings 5141 … 5144: what moved by more than kFeatureMoveTold, what is missing, and what is straight.
std::vector<Diagnostic> snap_diagnostics(const SnappedCurves& curves);

/// The texture of straight segments; distances are the limit.
fetex::FeatureCurvesTexture linear_texture(const SnappedCurves& curves, fetex::FeatureNumberFormat format,
                                           float distance_limit, unsigned threads = 1);

} // namespace fetexc
