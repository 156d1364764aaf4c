// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoChange = -1;
constexpr std::size_t kSamplesPerTask = 64;
constexpr std::uint32_t kBlockSide = 16; ///< squares
constexpr int kNearRings = 8;            ///< of squares, before blocks are looked at

/// Place in [0,1] where a predicate that holds at 0 and not at 1 changes.
template <class Holds> double bisect(const Holds& holds) {
    double lo = 0, hi = 1;
    for (int step = 0; step < budget::kBoundaryHalvings; ++step) {
        const double middle = (lo + hi) / 2;
        (holds(middle) ? lo : hi) = middle;
    }
    return (lo + hi) / 2;
}

/// Directions to look in, from the normal: both along it first.
constexpr double kDiagonal = 0.70710678118654752;
constexpr std::array<WidthPoint, 8> kStar{{{1, 0},
                                           {-1, 0},
                                           {0, 1},
                                           {0, -1},
                                           {kDiagonal, kDiagonal},
                                           {kDiagonal, -kDiagonal},
                                           {-kDiagonal, kDiagonal},
                                           {-kDiagonal, -kDiagonal}}};

double distance(WidthPoint a, WidthPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

double distance_to_segment(WidthPoint p, WidthPoint a, WidthPoint b) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    if (square == 0) return distance(p, a);
    const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0);
    return distance(p, {a.x + t * dx, a.y + t * dy});
}

} // namespace

PictureBoundary::PictureBoundary(const Subject& subject, const SampleGrid& grid) : subject_(subject), grid_(grid) {
    right_.assign(grid.size(), kNoChange), down_.assign(grid.size(), kNoChange);
    const GridSize n = grid.pixels();
    parallel_for(n.height, subject.threads, [&](std::size_t row) {
        for (std::uint32_t i = 0; i < n.width; ++i) {
            const std::size_t k = grid.index(i, static_cast<std::uint32_t>(row));
            if (i + 1 < n.width) right_[k] = change_between(k, k + 1);
            if (row + 1 < n.height) down_[k] = change_between(k, k + n.width);
        }
    });
    find_blocks();
}

bool PictureBoundary::has_changes(Square s) const {
    const std::size_t k = grid_.index(s.i, s.j), below = k + grid_.pixels().width;
    return right_[k] >= 0 || down_[k] >= 0 || right_[below] >= 0 || down_[k + 1] >= 0;
}

void PictureBoundary::find_blocks() {
    const GridSize n = grid_.pixels();
    const double w = 1.0 / n.width, h = subject_.truth.height() / n.height;
    for (std::uint32_t j0 = 0; j0 + 1 < n.height; j0 += kBlockSide) {
        for (std::uint32_t i0 = 0; i0 + 1 < n.width; i0 += kBlockSide) {
            const std::uint32_t i1 = std::min(i0 + kBlockSide, n.width - 1),
                                j1 = std::min(j0 + kBlockSide, n.height - 1);
            const std::size_t first = squares_.size();
            for (std::uint32_t j = j0; j < j1; ++j) {
                for (std::uint32_t i = i0; i < i1; ++i) {
                    if (has_changes({i, j})) squares_.push_back({i, j});
                }
            }
            // Sample points of the last squares lie in the pixels after them.
            if (squares_.size() > first)
                blocks_.push_back({{i0 * w, j0 * h, (i1 + 1) * w, (j1 + 1) * h}, first, squares_.size()});
        }
    }
}

WidthPoint PictureBoundary::between(std::size_t a, std::size_t b, double t) const {
    const WidthPoint p = subject_.truth.to_width(grid_.point(a)), q = subject_.truth.to_width(grid_.point(b));
    return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

/// Tells two results apart; solid ones are looked up once.
class PictureBoundary::Pair {
  public:
    Pair(const Subject& subject, ResultId first, ResultId second)
        : subject_(subject), first_(subject.truth, first), second_(subject.truth, second) {}

    /// A colour halfway between the two, as of a third region between theirs, is the first one's in spite of roundings.
    [[nodiscard]] bool takes_for_first(WidthPoint p) const {
        const TexturePoint at = subject_.truth.to_texture(p);
        const Rgba color = subject_.picture.at(at);
        return color_distance(color, first_.at(at)) <=
               color_distance(color, second_.at(at)) + budget::kColorDistanceTie;
    }

  private:
    class Paint {
      public:
        Paint(const Truth& truth, ResultId result)
            : truth_(truth), result_(result), solid_(truth.is_solid(result)),
              color_(solid_ ? truth.color(result, {}) : Rgba{}) {}
        [[nodiscard]] Rgba at(TexturePoint p) const { return solid_ ? color_ : truth_.color(result_, p); }

      private:
        const Truth& truth_;
        ResultId result_;
        bool solid_;
        Rgba color_;
    };
    const Subject& subject_;
    Paint first_, second_;
};

bool PictureBoundary::on_canvas(WidthPoint p) const {
    return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= subject_.truth.height();
}

double PictureBoundary::change_between(std::size_t a, std::size_t b) const {
    const ResultId first = grid_.picture(a), second = grid_.picture(b);
    if (first == second) return kNoChange;
    const TexturePoint middle = subject_.truth.to_texture(between(a, b, 0.5));
    if (contrast(subject_.truth.color(first, middle), subject_.truth.color(second, middle)) < subject_.min_contrast)
        return kNoChange;
    const Pair pair(subject_, first, second);
    return bisect([&](double t) { return pair.takes_for_first(between(a, b, t)); });
}

Distances PictureBoundary::to_truth() const {
    const GridSize n = grid_.pixels();
    std::vector<std::vector<DistanceSample>> rows(n.height);
    parallel_for(n.height, subject_.threads, [&](std::size_t row) {
        const auto add = [&](std::size_t a, std::size_t b, double t) {
            if (t < 0) return;
            const WidthPoint p = between(a, b, t);
            const EdgePoint nearest = subject_.truth.nearest_edge(subject_.truth.to_texture(p), subject_.reach);
            rows[row].push_back({nearest.distance, 1, nearest.edge == kNone, p});
        };
        for (std::uint32_t i = 0; i < n.width; ++i) {
            const std::size_t k = grid_.index(i, static_cast<std::uint32_t>(row));
            add(k, k + 1, right_[k]);
            add(k, k + n.width, down_[k]);
        }
    });
    std::vector<DistanceSample> all;
    for (const std::vector<DistanceSample>& row : rows)
        all.insert(all.end(), row.begin(), row.end());
    return summary(std::move(all));
}

/// Changes on the sides of a square.
std::size_t PictureBoundary::changes_around(Square s, std::array<WidthPoint, 4>& out) const {
    const std::size_t k = grid_.index(s.i, s.j), below = k + grid_.pixels().width;
    std::size_t count = 0;
    const auto add = [&](std::size_t a, std::size_t b, double t) {
        if (t >= 0) out[count++] = between(a, b, t);
    };
    add(k, k + 1, right_[k]), add(k, below, down_[k]);
    add(below, below + 1, right_[below]), add(k + 1, below + 1, down_[k + 1]);
    return count;
}

/// Two changes are joined by a line; more meet in their middle.
double PictureBoundary::distance_in_square(Square s, WidthPoint p) const {
    std::array<WidthPoint, 4> change;
    const std::size_t count = changes_around(s, change);
    if (count == 0) return kInfinity;
    if (count == 2) return distance_to_segment(p, change[0], change[1]);
    WidthPoint middle;
    for (std::size_t k = 0; k < count; ++k)
        middle.x += change[k].x / static_cast<double>(count), middle.y += change[k].y / static_cast<double>(count);
    double best = kInfinity;
    for (std::size_t k = 0; k < count; ++k)
        best = std::min(best, distance_to_segment(p, middle, change[k]));
    return best;
}

/// Below `best`, else `best`.
double PictureBoundary::distance_in_blocks(WidthPoint p, double best) const {
    for (const Block& block : blocks_) {
        if (block.box.distance(p) >= best) continue;
        for (std::size_t k = block.first; k < block.end; ++k)
            best = std::min(best, distance_in_square(squares_[k], p));
    }
    return best;
}

/// Rings of squares around the point's own, until no nearer change can follow; where that takes many (the picture lost
/// an edge), blocks. Below `best`, else `best`.
double PictureBoundary::distance_to_changes(WidthPoint p, double best) const {
    const GridSize n = grid_.pixels();
    const double height = subject_.truth.height(), pixel = std::min(1.0 / n.width, height / n.height);
    const auto columns = static_cast<int>(n.width) - 1, rows = static_cast<int>(n.height) - 1; // of squares
    const int x = static_cast<int>(p.x * n.width), y = static_cast<int>(p.y / height * n.height);
    for (int ring = 0; (ring - 2) * pixel < best; ++ring) {
        if (ring > kNearRings) return distance_in_blocks(p, best);
        for (int j = std::max(y - ring, 0); j <= std::min(y + ring, rows - 1); ++j) {
            const int step = j == y - ring || j == y + ring || ring == 0 ? 1 : 2 * ring;
            for (int i = x - ring; i <= x + ring; i += step) {
                if (i < 0 || i >= columns) continue;
                const Square square{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)};
                best = std::min(best, distance_in_square(square, p));
            }
        }
    }
    return best;
}

/// Outwards in rings until the colour goes over to the edge's other result: on both sides along the normal, and near
/// the point in six more directions (around a corner the picture may be met there only). Steps double from far below a
/// pixel to a part of one.
double PictureBoundary::distance_along_normal(const EdgeSample& s) const {
    const VisibleEdge& e = subject_.truth.edges()[s.edge];
    const WidthPoint p = s.place, normal = s.normal;
    const bool first = Pair(subject_, e.left, e.right).takes_for_first(p);
    const Pair pair(subject_, first ? e.left : e.right, first ? e.right : e.left);
    const auto along = [&](std::size_t k, double d) {
        const WidthPoint way = kStar[k];
        return WidthPoint{p.x + d * (normal.x * way.x - normal.y * way.y),
                          p.y + d * (normal.y * way.x + normal.x * way.y)};
    };
    const double pixel = grid_.pixel_side();
    double from = 0, step = budget::kBoundaryFirstStep * pixel;
    while (from < subject_.reach) {
        const double to = std::min(from + step, subject_.reach);
        const std::size_t directions = to < budget::kBoundaryStarReach * pixel ? kStar.size() : 2;
        double found = kInfinity;
        bool inside = false;
        for (std::size_t k = 0; k < directions; ++k) {
            if (!on_canvas(along(k, to))) continue;
            inside = true;
            if (pair.takes_for_first(along(k, to))) continue;
            const double t =
                bisect([&](double part) { return pair.takes_for_first(along(k, from + part * (to - from))); });
            found = std::min(found, from + t * (to - from));
        }
        if (found < kInfinity) return found;
        if (!inside) break; // nor is anything farther out
        from = to, step = std::min(to, budget::kBoundaryLargestStep * pixel);
    }
    return kInfinity;
}

/// A change between sample points counts where it is nearer by more than what joining them by lines may be off.
DistanceSample PictureBoundary::measure_at(const EdgeSample& s) const {
    const double slack = budget::kBoundaryChordError * grid_.pixel_side();
    double nearest = distance_along_normal(s);
    if (nearest > slack) {
        const double change = distance_to_changes(s.place, std::min(nearest, subject_.reach));
        if (change < std::min(nearest - slack, subject_.reach)) nearest = change;
    }
    const bool beyond = nearest > subject_.reach;
    return {beyond ? subject_.reach : nearest, s.length, beyond, s.place};
}

Distances PictureBoundary::to_picture() const {
    const std::span<const EdgeSample> samples = grid_.truth_samples().edge_samples();
    std::vector<DistanceSample> all(samples.size());
    parallel_for_chunks(samples.size(), kSamplesPerTask, subject_.threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k)
            all[k] = measure_at(samples[k]);
    });
    return summary(std::move(all));
}

} // namespace fetexc::measure
