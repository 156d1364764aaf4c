// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/curve_texture.h"

#include <array>
#include <cmath>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/feature_curves/plane.h"
#include "compiler/feature_curves/signatures.h"
#include "formats/feature_curve_geometry.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;

class Writer {
  public:
    Writer(const SnappedCurves& curves, fetex::FeatureNumberFormat format, float distance_limit) : curves_(curves) {
        out_.texture = fetex::feature_empty_texture(curves.width, curves.height, format, false, distance_limit);
    }

    QuadraticTexture run() {
        for (std::uint32_t j = 0; j <= curves_.height; ++j)
            for (std::uint32_t i = 0; i <= curves_.width; ++i)
                for (const FeatureEdge e : {FeatureEdge::North, FeatureEdge::West})
                    fetex::feature_set_crossing(out_.texture, i, j, e,
                                                {curves_.position(i, j, e), curves_.angle(i, j, e)});
        for (std::uint32_t j = 0; j < curves_.height; ++j)
            for (std::uint32_t i = 0; i < curves_.width; ++i)
                out_.texture.configurations[std::size_t{j} * curves_.width + i] = configuration(i, j);
        return std::move(out_);
    }

  private:
    fetex::FeatureConfiguration configuration(std::uint32_t i, std::uint32_t j) {
        const SegmentSet set = curves_.texel(i, j).segments;
        if (set == 0) return 0;
        const fetex::FeatureSignature signature = fetex::feature_signature(out_.texture, i, j);
        const auto first = static_cast<std::uint32_t>(std::countr_zero(set)),
                   last = static_cast<std::uint32_t>(std::bit_width(set)) - 1;
        const bool first_straight = is_straight(i, j, first, signature),
                   last_straight = first == last ? first_straight : is_straight(i, j, last, signature);
        return fetex::feature_pack(fetex::kFeatureSegments[first], fetex::kFeatureSegments[last], first_straight,
                                   last_straight);
    }

    bool is_straight(std::uint32_t i, std::uint32_t j, std::uint32_t segment,
                     const fetex::FeatureSignature& signature) {
        if ((curves_.texel(i, j).curved >> segment & 1u) == 0) return true;
        const auto read = fetex::feature_curve(signature, fetex::kFeatureSegments[segment], false);
        if (read && fault_of({read->b0, read->b1, read->b2}) == SignatureFault::None) return false;
        const SegmentCurve curve = shown_segment(curves_, i, j, segment).curve;
        if (is_flat(curve))
            ++out_.flat;
        else
            straighten(i, j, from_chord(curve));
        return true;
    }

    void straighten(std::uint32_t i, std::uint32_t j, double moved) {
        ++out_.straightened;
        if (moved > budget::kFeatureChord) ++out_.moved;
        if (moved > out_.farthest) out_.farthest = moved, out_.farthest_i = i, out_.farthest_j = j;
    }

    static double from_chord(const SegmentCurve& c) {
        return std::hypot(c[0].x - 2 * c[1].x + c[2].x, c[0].y - 2 * c[1].y + c[2].y) / 4;
    }

    static bool is_flat(const SegmentCurve& c) {
        const double ax = c[1].x - c[0].x, ay = c[1].y - c[0].y, bx = c[2].x - c[1].x, by = c[2].y - c[1].y;
        const double turn = std::abs(ax * by - ay * bx), lengths = std::hypot(ax, ay) * std::hypot(bx, by);
        if (turn < 2 * fetex::kFeatureLeastTurn * lengths) return true;
        return from_chord(c) <= budget::kFeatureFlat;
    }

    const SnappedCurves& curves_;
    QuadraticTexture out_;
};

} // namespace

QuadraticTexture quadratic_texture(const SnappedCurves& curves, fetex::FeatureNumberFormat format,
                                   float distance_limit) {
    return Writer(curves, format, distance_limit).run();
}

std::vector<Diagnostic> rounding_diagnostics(const QuadraticTexture& written) {
    constexpr double kParts = 10000;
    if (written.moved == 0) return {};
    const auto parts = static_cast<std::uint64_t>(std::ceil(written.farthest * kParts));
    return {
        {Severity::Warning, diag::kFeatureStraightened,
         std::to_string(written.moved) +
             " segments of feature curves are straight: the texture's numbers are too coarse for them; they moved by " +
             std::to_string(parts) + " ten-thousandths of a texel at most",
         "texel (" + std::to_string(written.farthest_i) + ", " + std::to_string(written.farthest_j) + ")"}};
}

} // namespace fetexc
