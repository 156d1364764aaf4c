// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/point_moves.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

using fetex::SilmapPoint;

constexpr std::uint32_t opposite(std::uint32_t link) { return link ^ 2u; }

struct Step {
    std::int64_t x, y;
};
constexpr std::array<Step, 8> kSteps{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// The step that goes nearest to a direction.
std::size_t octant(const SilmapPoint& g) {
    constexpr double kSteep = 0.41421356237309503; // tan(π/8)
    const double ax = std::abs(g.x), ay = std::abs(g.y);
    const int x = ax > kSteep * ay ? (g.x > 0 ? 1 : -1) : 0, y = ay > kSteep * ax ? (g.y > 0 ? 1 : -1) : 0;
    for (std::size_t k = 0; k < kSteps.size(); ++k) {
        if (kSteps[k].x == x && kSteps[k].y == y) return k;
    }
    return 0;
}

/// Seen from the point outwards: the corner on the right of a link, and that on the left.
std::pair<std::uint32_t, std::uint32_t> beside(std::uint32_t link) {
    using namespace fetex;
    switch (link) {
    case kSilmapWest:
        return {kSilmapNW, kSilmapSW};
    case kSilmapNorth:
        return {kSilmapNE, kSilmapNW};
    case kSilmapEast:
        return {kSilmapSE, kSilmapNE};
    default:
        return {kSilmapSW, kSilmapSE};
    }
}

/// What the neighbour there calls a corner that both have.
std::uint32_t corner_across(std::uint32_t corner, std::uint32_t link) {
    return corner ^ (link == fetex::kSilmapWest || link == fetex::kSilmapEast ? 1u : 2u);
}

} // namespace

double PointMoves::wrong_around(std::uint32_t cell) const {
    double sum = cells_.cells[cell].wrong;
    for (const std::uint32_t n : cells_.cells[cell].neighbours)
        sum += n < kOwnPoint ? cells_.cells[n].wrong : 0;
    return sum;
}

double PointMoves::area(const SilmapCellData& c, const SilmapPoint& point, std::uint32_t link, double exit) const {
    return samples_.empty() ? link_area(cells_.truth_of(c), point, link, exit, c.shown.corners)
                            : samples_of(c).link_area(point, link, exit, c.shown.corners);
}

/// What the point at another place takes away; something not above `bar` if it isn't worth knowing.
void PointMoves::evaluate(const SilmapCellData& c, double bar, Trial& t) const {
    t.gain = 0;
    double most = 0; // that the neighbours may win
    for (std::uint32_t link = 0; link < 4; ++link) {
        const std::uint32_t neighbour = c.neighbours[link];
        if (neighbour == kNone) continue;
        t.exit[link] = ShownCell::exit_of(t.point, link, point_across(cells_, c, t.point, link));
        t.right[link] = area(c, t.point, link, t.exit[link]);
        t.gain += t.right[link] - c.right[link];
        if (neighbour != kOwnPoint) most += cells_.cells[neighbour].wrong;
    }
    for (std::uint32_t link = 0; link < 4 && t.gain + most > bar; ++link) {
        const std::uint32_t neighbour = c.neighbours[link];
        if (neighbour >= kOwnPoint) continue;
        const SilmapCellData& n = cells_.cells[neighbour];
        const std::uint32_t back = opposite(link);
        const SilmapPoint across{t.point.x - kToNeighbour[link].x, t.point.y - kToNeighbour[link].y};
        t.neighbour_exit[link] = ShownCell::exit_of(n.shown.point, back, across);
        t.neighbour_right[link] = area(n, n.shown.point, back, t.neighbour_exit[link]);
        t.gain += t.neighbour_right[link] - n.right[back], most -= n.wrong;
    }
}

bool PointMoves::try_at(const SilmapCellData& c, std::int64_t x, std::int64_t y, Trial& best) {
    if (x < 0 || y < 0 || x >= steps_ || y >= steps_ || (x == c.x && y == c.y)) return false;
    Trial trial;
    trial.x = x, trial.y = y;
    trial.point = place(x, y);
    ++tried_;
    evaluate(c, best.gain, trial);
    if (!(trial.gain > best.gain)) return false;
    best = trial;
    return true;
}

void PointMoves::accept(SilmapCellData& c, const Trial& t) {
    c.x = static_cast<std::uint32_t>(t.x), c.y = static_cast<std::uint32_t>(t.y);
    c.shown.point = t.point;
    for (std::uint32_t link = 0; link < 4; ++link) {
        if (c.neighbours[link] == kNone) continue;
        c.wrong -= t.right[link] - c.right[link];
        c.shown.exit[link] = t.exit[link], c.right[link] = t.right[link];
        if (c.neighbours[link] == kOwnPoint) continue;
        SilmapCellData& n = cells_.cells[c.neighbours[link]];
        const std::uint32_t back = opposite(link);
        n.wrong -= t.neighbour_right[link] - n.right[back];
        n.shown.exit[back] = t.neighbour_exit[link], n.right[back] = t.neighbour_right[link];
    }
}

/// Of what is won by the point's place, up to a factor, from a few points along each link: the region that lies there
/// should be on its own side of the link.
SilmapPoint PointMoves::gradient(const SilmapCellData& c, const SilmapPoint& p) const {
    SilmapPoint sum{0, 0};
    for (std::uint32_t link = 0; link < 4; ++link) {
        if (c.neighbours[link] == kNone) continue;
        const SilmapPoint across = point_across(cells_, c, p, link), way{across.x - p.x, across.y - p.y};
        const double balance = samples_.empty() ? balance_of(c, p, link, way) : sampled_balance_of(c, p, link, way);
        sum.x += balance * way.y, sum.y -= balance * way.x;
    }
    return sum;
}

/// What lies along a link: more than 0 if more of what belongs on its right, the nearer to the point the more it
/// counts.
double PointMoves::balance_of(const SilmapCellData& c, const SilmapPoint& p, std::uint32_t link,
                              const SilmapPoint& way) const {
    constexpr std::array<double, 4> parts{0.125, 0.375, 0.625, 0.875}; // of the way to the other point
    const std::uint32_t neighbour = c.neighbours[link];
    const ResultId right = c.shown.corners[beside(link).first], left = c.shown.corners[beside(link).second];
    double balance = 0;
    for (const double part : parts) {
        const double x = p.x + part * way.x, y = p.y + part * way.y;
        const bool inside = x >= 0 && x < 1 && y >= 0 && y < 1;
        if (!inside && neighbour == kOwnPoint) continue;
        const ResultId is = inside ? result_at(cells_.truth_of(c), x, y)
                                   : result_at(cells_.truth_of(cells_.cells[neighbour]), x - kToNeighbour[link].x,
                                               y - kToNeighbour[link].y);
        balance += (1 - part) * (static_cast<int>(is == right) - static_cast<int>(is == left));
    }
    return balance;
}

/// The same times some factor.
double PointMoves::sampled_balance_of(const SilmapCellData& c, const SilmapPoint& p, std::uint32_t link,
                                      const SilmapPoint& way) const {
    constexpr std::uint32_t parts = 6;
    const auto [right, left] = beside(link);
    const CellSamples& own = samples_of(c);
    const std::uint32_t columns = CellSamples::kColumns, lines = own.lines();
    // In 2^-16 of places, a cell further right and down, so that nothing is below 0.
    constexpr double place = 1 << 16, column = CellSamples::kColumns * place;
    const double line = lines * place;
    const auto du = static_cast<std::int32_t>(way.x * (column / parts)),
               dv = static_cast<std::int32_t>(way.y * (line / parts));
    auto u = static_cast<std::uint32_t>(static_cast<std::int32_t>((p.x + 1) * column) + du / 2),
         v = static_cast<std::uint32_t>(static_cast<std::int32_t>((p.y + 1) * line) + dv / 2);
    int balance = 0, weight = 2 * parts - 1; // the part's distance from the other point, in halves of parts
    const auto go_on = [&] { u += static_cast<std::uint32_t>(du), v += static_cast<std::uint32_t>(dv); };
    for (; weight > 0; weight -= 2, go_on()) {
        const std::uint32_t i = (u >> 16) - columns, j = (v >> 16) - lines;
        if (i >= columns || j >= lines) break;
        balance += weight * own.side(i, j, right, left);
    }
    if (c.neighbours[link] == kOwnPoint) return balance;
    const CellSamples& other = samples_of(cells_.cells[c.neighbours[link]]);
    for (; weight > 0; weight -= 2, go_on())
        balance += weight * other.side((u >> 16) % columns, (v >> 16) & (lines - 1), corner_across(right, link),
                                       corner_across(left, link));
    return balance;
}

double PointMoves::walk(std::uint32_t cell, std::int64_t stride) {
    SilmapCellData& c = cells_.cells[cell];
    double won = 0;
    Step came{0, 0};
    for (;;) {
        const SilmapPoint g = gradient(c, c.shown.point);
        if (g.x == 0 && g.y == 0) return won;
        const std::size_t ahead = octant(g);
        Trial best;
        best.gain = budget::kSilmapWorthAMove;
        for (const std::size_t turn : {0, 1, 7, 2, 6}) {
            const Step& step = kSteps[(ahead + turn) % kSteps.size()];
            // Beside where it came from: that has been tried.
            if (won > 0 && std::abs(step.x + came.x) <= 1 && std::abs(step.y + came.y) <= 1) continue;
            try_at(c, c.x + stride * step.x, c.y + stride * step.y, best);
        }
        if (best.x < 0) return won;
        won += best.gain;
        came = {(best.x - c.x) / stride, (best.y - c.y) / stride};
        accept(c, best);
    }
}

double PointMoves::settle_once(SilmapCellData& c, std::span<const std::int64_t> strides) {
    const SilmapPoint g = gradient(c, c.shown.point);
    if (g.x == 0 && g.y == 0) return 0;
    const Step& ahead = kSteps[octant(g)];
    const auto goes_on = [&](std::int64_t x, std::int64_t y) {
        if (x < 0 || y < 0 || x >= steps_ || y >= steps_) return false;
        const SilmapPoint there = gradient(c, place(x, y));
        return there.x * static_cast<double>(ahead.x) + there.y * static_cast<double>(ahead.y) > 0;
    };
    std::int64_t x = c.x, y = c.y;
    std::int64_t most = steps_;
    for (const std::int64_t stride : strides) { // the last of the stride before has failed
        for (most /= stride; most > 0 && goes_on(x + stride * ahead.x, y + stride * ahead.y); --most)
            x += stride * ahead.x, y += stride * ahead.y;
        most = stride - 1;
    }
    Trial best;
    best.gain = budget::kSilmapWorthAMove;
    try_at(c, x, y, best);
    try_at(c, x + ahead.x, y + ahead.y, best);
    if (best.x < 0) return 0;
    accept(c, best);
    return best.gain;
}

bool PointMoves::is_worth_settling(std::uint32_t cell) const { return wrong_around(cell) >= budget::kSilmapSettle; }

double PointMoves::settle(std::uint32_t cell, std::span<const std::int64_t> strides) {
    constexpr int most = 3;
    if (!is_worth_settling(cell)) return 0;
    double won = 0, last = budget::kSilmapSettleAgain;
    for (int k = 0; k < most && last >= budget::kSilmapSettleAgain; ++k)
        won += last = settle_once(cells_.cells[cell], strides);
    return won;
}

double PointMoves::search(std::uint32_t cell, std::span<const std::int64_t> strides) {
    SilmapCellData& c = cells_.cells[cell];
    Trial best;
    best.gain = budget::kSilmapWorthAMove;
    const std::int64_t first = strides.front();
    for (std::int64_t y = first / 2; y < steps_; y += first) {
        for (std::int64_t x = first / 2; x < steps_; x += first)
            try_at(c, x, y, best);
    }
    double won = 0;
    if (best.x >= 0) won += best.gain, accept(c, best);
    for (const std::int64_t stride : strides) {
        for (bool moved = true; moved;) {
            Trial next;
            next.gain = budget::kSilmapWorthAMove;
            for (const Step& step : kSteps)
                try_at(c, c.x + stride * step.x, c.y + stride * step.y, next);
            moved = next.x >= 0;
            if (moved) won += next.gain, accept(c, next);
        }
    }
    return won;
}

} // namespace fetexc
