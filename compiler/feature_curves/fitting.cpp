// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/fitting.h"

#include <algorithm>
#include <array>
#include <optional>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/local_problem.h"
#include "compiler/feature_curves/plane.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;

/// A problem reads the points of its texel and of those beside it, and writes those of its texel: problems of texels
/// whose columns and rows are equal modulo 3 don't meet.
constexpr std::uint32_t kColorsAlong = 3;
/// A problem that has no solution may get one when its neighbours' are solved.
constexpr int kSweeps = 2;
constexpr std::size_t kChunk = 16;
/// Middle points close to an edge make parabolas that come back: then once more, farther inside.
constexpr std::array kMargins = {budget::kFeatureMargin, 1.0 / 8};

struct TexelIndex {
    std::uint32_t i = 0, j = 0;
};

class Fitter {
  public:
    Fitter(SnappedCurves& curves, unsigned threads) : curves_(curves), threads_(threads) {}

    void run() {
        for_each_texel([&](TexelIndex t) { settle_straight(t); });
        for_each_texel([&](TexelIndex t) { take_straight_directions(t); });
        std::vector<TexelIndex> invalid = find_invalid();
        count_invalid(invalid);
        for (int sweep = 0; sweep < kSweeps && !invalid.empty(); ++sweep) {
            curves_.stats.problems += invalid.size();
            solve(invalid);
            invalid = find_invalid();
        }
        for (const TexelIndex t : invalid)
            straighten(t);
        for (const TexelIndex t : invalid)
            mend(t);
    }

  private:
    template <class Visit> void for_each_texel(const Visit& visit) {
        parallel_for(curves_.height, threads_, [&](std::size_t j) {
            for (std::uint32_t i = 0; i < curves_.width; ++i)
                visit(TexelIndex{i, static_cast<std::uint32_t>(j)});
        });
    }
    SnappedTexel& texel(TexelIndex t) { return curves_.texels[std::size_t{t.j} * curves_.width + t.i]; }

    /// What is a line by its tangents, or has no length, is straight.
    void settle_straight(TexelIndex t) {
        SnappedTexel& s = texel(t);
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            if (s.curved >> k & 1u && is_aligned(curves_, t.i, t.j, k))
                s.curved = static_cast<SegmentSet>(s.curved & ~(1u << k));
    }

    /// Where straight segments with one direction go on in curves. Each texel writes its north and west edges, and
    /// those of the border.
    void take_straight_directions(TexelIndex t) {
        const auto take = [&](FeatureEdge e) {
            if (!curves_.is_used(t.i, t.j, e)) return;
            if (const StraightEnds ends = straight_ends(curves_, t.i, t.j, e); ends.angle)
                curves_.angle(t.i, t.j, e) = *ends.angle;
        };
        take(FeatureEdge::North), take(FeatureEdge::West);
        if (t.i + 1 == curves_.width) take(FeatureEdge::East);
        if (t.j + 1 == curves_.height) take(FeatureEdge::South);
    }

    std::vector<TexelIndex> find_invalid() {
        std::vector<std::vector<TexelIndex>> rows(curves_.height);
        for_each_texel([&](TexelIndex t) {
            if (texel(t).curved != 0 && has_fault(curves_, t.i, t.j)) rows[t.j].push_back(t);
        });
        std::vector<TexelIndex> all;
        for (const auto& row : rows)
            all.insert(all.end(), row.begin(), row.end());
        return all;
    }

    void count_invalid(const std::vector<TexelIndex>& invalid) {
        for (const SnappedTexel& t : curves_.texels)
            curves_.stats.curved += static_cast<std::uint64_t>(std::popcount(t.curved));
        for (const TexelIndex t : invalid)
            for_each_fault(t, [&](std::uint32_t) { ++curves_.stats.invalid; });
    }

    template <class Visit> void for_each_fault(TexelIndex t, const Visit& visit) {
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            if (texel(t).curved >> k & 1u && shown_segment(curves_, t.i, t.j, k).fault != SignatureFault::None)
                visit(k);
    }

    void solve(const std::vector<TexelIndex>& invalid) {
        std::array<std::vector<TexelIndex>, kColorsAlong * kColorsAlong> colors;
        for (const TexelIndex t : invalid)
            colors[t.j % kColorsAlong * kColorsAlong + t.i % kColorsAlong].push_back(t);
        for (const std::vector<TexelIndex>& color : colors) {
            std::vector<char> solved(color.size());
            parallel_for_chunks(color.size(), kChunk, threads_, [&](std::size_t first, std::size_t end) {
                for (std::size_t k = first; k < end; ++k)
                    solved[k] = fit(color[k]);
            });
            curves_.stats.fitted += static_cast<std::uint64_t>(std::count(solved.begin(), solved.end(), 1));
        }
    }

    /// False: nothing has changed.
    bool fit(TexelIndex t) {
        if (!has_fault(curves_, t.i, t.j)) return false; // a neighbour's problem made it valid
        for (const double margin : kMargins)
            if (fit(t, margin)) return true;
        return false;
    }

    bool fit(TexelIndex t, double margin) {
        const LocalProblem problem(curves_, t.i, t.j, margin);
        if (!problem.open()) return false;
        const std::optional<sqp::Vector> x = problem.solve();
        if (!x) return false;
        const std::array<fetex::FeatureCrossing, 4> before = crossings(t);
        const std::array<SegmentSet, 4> valid = valid_beside(t);
        const SegmentSet curved = texel(t).curved;
        problem.apply(*x, curves_);
        settle_straight(t);
        if (!has_fault(curves_, t.i, t.j) && still_valid(t, valid)) {
            texel(t).kinds |= kFitted;
            return true;
        }
        set_crossings(t, before);
        texel(t).curved = curved;
        return false;
    }

    std::array<fetex::FeatureCrossing, 4> crossings(TexelIndex t) const {
        std::array<fetex::FeatureCrossing, 4> out;
        for (const FeatureEdge e : fetex::kFeatureEdges)
            out[fetex::feature_edge_index(e)] = {curves_.position(t.i, t.j, e), curves_.angle(t.i, t.j, e)};
        return out;
    }
    void set_crossings(TexelIndex t, const std::array<fetex::FeatureCrossing, 4>& to) {
        for (const FeatureEdge e : fetex::kFeatureEdges) {
            const fetex::FeatureCrossing& c = to[fetex::feature_edge_index(e)];
            curves_.position(t.i, t.j, e) = c.position, curves_.angle(t.i, t.j, e) = c.angle;
        }
    }

    /// Curved segments of the neighbours that are valid.
    std::array<SegmentSet, 4> valid_beside(TexelIndex t) const {
        std::array<SegmentSet, 4> out{};
        for (const FeatureEdge e : fetex::kFeatureEdges) {
            const auto beside = across(curves_, t.i, t.j, e);
            if (!beside) continue;
            const SegmentSet curved = curves_.texel(beside->i, beside->j).curved;
            for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
                if (curved >> k & 1u && shown_segment(curves_, beside->i, beside->j, k).fault == SignatureFault::None)
                    out[fetex::feature_edge_index(e)] |= static_cast<SegmentSet>(1u << k);
        }
        return out;
    }
    bool still_valid(TexelIndex t, const std::array<SegmentSet, 4>& before) const {
        const std::array<SegmentSet, 4> now = valid_beside(t);
        for (std::size_t e = 0; e < now.size(); ++e)
            if ((before[e] & ~now[e]) != 0) return false;
        return true;
    }

    void straighten(TexelIndex t) {
        for_each_fault(t, [&](std::uint32_t k) {
            SnappedTexel& s = texel(t);
            s.curved = static_cast<SegmentSet>(s.curved & ~(1u << k));
            s.kinds |= kStraightened;
            ++curves_.stats.straightened;
        });
    }

    /// Curves that go on from the texel's straight segments take their directions, where they stay valid so.
    void mend(TexelIndex t) {
        for (const FeatureEdge e : fetex::kFeatureEdges) {
            if (!curves_.is_used(t.i, t.j, e)) continue;
            const StraightEnds ends = straight_ends(curves_, t.i, t.j, e);
            if (!ends.angle) continue;
            const double before = curves_.angle(t.i, t.j, e);
            const std::array<SegmentSet, 4> beside = valid_beside(t);
            curves_.angle(t.i, t.j, e) = *ends.angle;
            if (has_fault(curves_, t.i, t.j) || !still_valid(t, beside)) curves_.angle(t.i, t.j, e) = before;
        }
    }

    SnappedCurves& curves_;
    unsigned threads_;
};

} // namespace

void fit_signatures(SnappedCurves& curves, unsigned threads) { Fitter(curves, threads).run(); }

} // namespace fetexc
