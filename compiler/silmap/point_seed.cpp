// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/point_seed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

constexpr double kOut = 9.0 / 4, kStepWeight = 0.1;

SilmapPoint middle_of(const std::vector<CellChord>& chords) {
    double x = 0, y = 0, sum = 0;
    for (const CellChord& c : chords) {
        const double dx = c.x1 - c.x0, dy = c.y1 - c.y0, length = std::sqrt(dx * dx + dy * dy);
        x += length * (c.x0 + c.x1) / 2, y += length * (c.y0 + c.y1) / 2, sum += length;
    }
    return sum > 0 ? SilmapPoint{x / sum, y / sum} : SilmapPoint{chords.front().x0, chords.front().y0};
}

SilmapPoint nearest_on(const CellChord& c, const SilmapPoint& p) {
    const double dx = c.x1 - c.x0, dy = c.y1 - c.y0, square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp(((p.x - c.x0) * dx + (p.y - c.y0) * dy) / square, 0.0, 1.0) : 0;
    return {c.x0 + t * dx, c.y0 + t * dy};
}

/// Steps beside an edge, the best of all columns that it passes where it is more level than upright, of rows elsewhere.
class StepScan {
  public:
    /// shift: of the edge. weight: of the squared distance from the middle, against the distance from the edge.
    /// on_edge: cells; as near to the edge is near enough.
    StepScan(fetex::SilmapCellFormat format, const SilmapPoint& shift, const SilmapPoint& middle, double weight,
             double on_edge)
        : format_(format), shift_(shift), middle_(middle), weight_(weight), on_edge_(on_edge) {}

    void add(const CellChord& c) {
        const double dx = c.x1 - c.x0, dy = c.y1 - c.y0;
        if (std::abs(dx) >= std::abs(dy))
            scan<true>(c.x0 + shift_.x, c.y0 + shift_.y, dx, dy);
        else
            scan<false>(c.y0 + shift_.y, c.x0 + shift_.x, dy, dx);
    }
    [[nodiscard]] std::optional<CellSteps> best() const { return best_; }

  private:
    /// Along x or y from (u, v) on: outwards from the middle, no farther than a step exactly on the edge could win, or
    /// until one is near enough. Of equal ones the first wins.
    template <bool level> void scan(double u, double v, double du, double dv) {
        if (du == 0) return;
        const double from = std::min(u, u + du), to = std::max(u, u + du), slope = dv / du,
                     across = 1 / std::sqrt(1 + slope * slope), middle = level ? middle_.x : middle_.y,
                     beside = level ? middle_.y : middle_.x;
        const std::uint32_t first = fetex::silmap_step(format_, from), end = fetex::silmap_step(format_, to),
                            start = std::clamp(fetex::silmap_step(format_, middle), first, end);
        double least = least_;
        std::optional<CellSteps> best;
        bool found = false;
        const auto look = [&](std::uint32_t k, bool ties) {
            const double at = fetex::silmap_position(format_, k), along_u = at - middle;
            const double far = weight_ * (along_u * along_u);
            if (far > least) return false;
            if (at < from || at > to) return true;
            const double edge = v + (at - u) * slope;
            const std::uint32_t n = fetex::silmap_step(format_, edge);
            const double place = fetex::silmap_position(format_, n), along_v = place - beside;
            const double off = std::abs(place - edge) * across;
            const double cost = off + weight_ * (along_u * along_u + along_v * along_v);
            if (cost < least || (ties && best && cost == least))
                least = cost, best = level ? CellSteps{k, n} : CellSteps{n, k}, found = off <= on_edge_;
            return true;
        };
        std::uint32_t before = start, after = start + 1;
        for (bool back = true, on = true; (back || on) && !found;) {
            back = back && look(before, true) && before > first;
            if (back) --before;
            if (found) break;
            on = on && after <= end && look(after, false);
            ++after;
        }
        if (best) least_ = least, best_ = best;
    }

    fetex::SilmapCellFormat format_;
    SilmapPoint shift_, middle_;
    double weight_, on_edge_, least_ = INFINITY;
    std::optional<CellSteps> best_;
};

SilmapPoint nearest_of(const CellDrawing& drawing, const SilmapPoint& to) {
    SilmapPoint best = to;
    double least = INFINITY;
    for (const CellChord& c : drawing.chords) {
        const SilmapPoint p = nearest_on(c, to);
        const double square = (p.x - to.x) * (p.x - to.x) + (p.y - to.y) * (p.y - to.y);
        if (square < least) least = square, best = p;
    }
    return best;
}

} // namespace

CellSteps seed_of(const CellDrawing& drawing, fetex::SilmapCellFormat format, double on_edge_steps) {
    const auto at = [&](const SilmapPoint& p) -> CellSteps {
        return {fetex::silmap_step(format, p.x), fetex::silmap_step(format, p.y)};
    };
    if (!drawing.corners.empty()) {
        return at(std::ranges::max_element(drawing.corners, [](const CellCorner& a, const CellCorner& b) {
                      return std::tuple(a.edges, a.turn) < std::tuple(b.edges, b.turn);
                  })->at);
    }
    const SilmapPoint middle = middle_of(drawing.chords), on_edge = nearest_of(drawing, middle);
    std::size_t across = 0;
    for (const std::vector<double>& side : drawing.crossings)
        across += side.size();
    if (across != 2) return at(on_edge);
    // The middle of an arc lies a third of its height inside. Chords three quarters of the height farther out have as
    // much of the arc outside as inside.
    const double height = 3 * std::hypot(on_edge.x - middle.x, on_edge.y - middle.y);
    const SilmapPoint shift{kOut * (on_edge.x - middle.x), kOut * (on_edge.y - middle.y)};
    StepScan scan(format, shift, on_edge, kStepWeight / fetex::silmap_steps(format) + height,
                  on_edge_steps / fetex::silmap_steps(format));
    for (const CellChord& c : drawing.chords)
        scan.add(c);
    return scan.best().value_or(at(on_edge));
}

} // namespace fetexc
