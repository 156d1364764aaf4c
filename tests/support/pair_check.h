// SPDX-License-Identifier: GPL-3.0-or-later
/// The certified filter and the arrangement against CGAL's algebraic kernel, pair by pair of monotone pieces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/geometry/intersect.h"
#include "compiler/planar/arrangement.h"

namespace fetexc::test {

/// A monotone piece as the planar map makes it, with what its caller knows of its ends.
struct Piece {
    struct End {
        Interval t;
        std::uint32_t vertex = kNone;  ///< of the arc set
        std::optional<IntPoint> point; ///< integral ends
    };
    Stretch stretch;
    End first, last;
    Interval x, y; ///< box
    std::uint32_t curve = 0;
};

std::vector<Piece> pieces_of(const ArcSet& set);

/// Pairs (smaller index first) of pieces that reach the canvas and whose closed boxes overlap.
std::vector<std::pair<std::uint32_t, std::uint32_t>> box_pairs_of(const std::vector<Piece>& pieces, const Grid& grid);

/// The kernel's answer for one pair. Pieces on one algebraic curve meet where their parameter ranges touch, and in the
/// curve's double point; both are rational facts, or roots of a quadratic.
struct KernelHits {
    std::vector<ExactHit> required; ///< on both pieces
    std::vector<ExactHit> allowed;  ///< within the enclosure of an end that is no integer point, or just beyond an end
    bool common_component = false;  ///< both run on one algebraic curve
    bool decided = true;
    bool overlap = false; ///< … and share more than points (of lines: planar/arcs rules it out)
};
KernelHits kernel_hits(const Piece& a, const Piece& b);

struct FilterAnswer {
    PairOutcome outcome = PairOutcome::Undecided;
    bool by_boxes = false; ///< a shared end is all that the boxes have in common
    std::vector<Contact> contacts;
};
/// As planar/arrangement asks: shared ends and ends on the other piece are found exactly first.
FilterAnswer filter_answer(const Piece& a, const Piece& b);

/// Empty when each contact encloses exactly one hit and each required hit lies in exactly one contact.
std::string mismatch(const std::vector<Contact>& contacts, const KernelHits& hits);

/// Contacts of pieces (given as arcs) according to the finished arrangement: the vertices that both pass.
class ArrangementContacts {
  public:
    explicit ArrangementContacts(const Arrangement& arrangement);
    [[nodiscard]] std::vector<Contact> operator()(std::uint32_t arc_a, std::uint32_t arc_b) const;

  private:
    struct OnPiece {
        std::uint32_t vertex;
        Interval t;
    };
    std::vector<std::vector<OnPiece>> along_;
};

} // namespace fetexc::test
