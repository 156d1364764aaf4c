// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/wrong_area.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

using fetex::SilmapBox;

/// At most three links cross a level: west or east ones that have left it, and north or south.
struct ShownLine {
    double top = 0, bottom = 0;
    ResultId right = 0;
};
struct ShownLines {
    ResultId left = 0;
    std::array<ShownLine, 3> line;
    std::uint32_t count = 0;

    void add(double top, double bottom, ResultId right) {
        if (right == (count == 0 ? left : line[count - 1].right)) return;
        line[count++] = {top, bottom, right};
    }
};

/// The shown lines over the levels of a slab's part, and what integrates against them.
class Integral {
  public:
    Integral(const SilmapBox& box, const ShownCell& shown) : box_(box), shown_(shown) {
        const fetex::SilmapPoint& p = shown.point;
        slope_[fetex::kSilmapWest] = p.x / (p.y - shown.exit[fetex::kSilmapWest]);
        slope_[fetex::kSilmapEast] = (p.x - 1) / (p.y - shown.exit[fetex::kSilmapEast]);
        slope_[fetex::kSilmapNorth] = (p.x - shown.exit[fetex::kSilmapNorth]) / p.y;
        slope_[fetex::kSilmapSouth] = (p.x - shown.exit[fetex::kSilmapSouth]) / (p.y - 1);
        whole_ = box.x0 <= 0 && box.x1 >= 1;
    }

    /// Between two levels of a slab with no shown point between them.
    double over(const TruthSlab& slab, std::span<const TruthLine> truth, double y0, double y1) {
        find_shown(y0, y1);
        const double height = slab.y1 - slab.y0, from = (y0 - slab.y0) / height, to = (y1 - slab.y0) / height;
        if (truth.size() == 1 && lines_.count == 1 && whole_ && slab.left == lines_.left &&
            truth[0].right == lines_.line[0].right) {
            const double run = truth[0].bottom - truth[0].top;
            return (y1 - y0) * mean_size(truth[0].top + run * from - lines_.line[0].top,
                                         truth[0].top + run * to - lines_.line[0].bottom);
        }
        return (y1 - y0) * mean_wrong(slab, truth, from, to);
    }

  private:
    /// Mean of |d| while d goes evenly from a to b.
    static double mean_size(double a, double b) {
        if (a * b >= 0) return std::abs(a + b) / 2;
        return (a * a + b * b) / (2 * (std::abs(a) + std::abs(b)));
    }

    [[nodiscard]] double x_on(std::uint32_t link, double y) const {
        return std::clamp(shown_.point.x + (y - shown_.point.y) * slope_[link], 0.0, 1.0);
    }

    void find_shown(double y0, double y1) {
        using namespace fetex;
        const double middle = (y0 + y1) / 2;
        const bool above = middle < shown_.point.y;
        const double west = shown_.exit[kSilmapWest], east = shown_.exit[kSilmapEast];
        const bool by_west = above ? west < middle : west > middle, by_east = above ? east < middle : east > middle;
        const std::array<ResultId, 4>& c = shown_.corners;
        const ResultId left = c[above ? kSilmapNW : kSilmapSW], right = c[above ? kSilmapNE : kSilmapSE];
        const auto add = [&](std::uint32_t link, ResultId result) {
            if (result != (lines_.count == 0 ? lines_.left : lines_.line[lines_.count - 1].right))
                lines_.add(x_on(link, y0), x_on(link, y1), result);
        };
        lines_.count = 0;
        lines_.left = by_west ? c[above ? kSilmapSW : kSilmapNW] : left;
        if (by_west) add(kSilmapWest, left);
        add(above ? kSilmapNorth : kSilmapSouth, right);
        if (by_east) add(kSilmapEast, c[above ? kSilmapSE : kSilmapNE]);
    }

    /// Mean over the levels of the length that is wrong. It changes evenly between crossings of lines: there the middle
    /// level tells.
    double mean_wrong(const TruthSlab& slab, std::span<const TruthLine> truth, double from, double to) {
        find_crossings(truth, from, to);
        double sum = 0, begin = 0;
        for (std::size_t k = 0; k <= crossings_; ++k) {
            const double end = k < crossings_ ? crossing_[k] : 1;
            if (end > begin) sum += (end - begin) * wrong_at(slab, truth, from, to, (begin + end) / 2);
            begin = std::max(begin, end);
        }
        return sum;
    }

    void find_crossings(std::span<const TruthLine> truth, double from, double to) {
        crossings_ = 0;
        const auto meet = [&](double a, double b) { // differences at both ends
            if (a * b < 0 && crossings_ < kMostCrossings) crossing_[crossings_++] = a / (a - b);
        };
        for (std::uint32_t s = 0; s < lines_.count; ++s) {
            const ShownLine& line = lines_.line[s];
            for (const TruthLine& t : truth) {
                const double run = t.bottom - t.top;
                meet(t.top + run * from - line.top, t.top + run * to - line.bottom);
            }
            if (whole_) continue;
            meet(box_.x0 - line.top, box_.x0 - line.bottom);
            meet(box_.x1 - line.top, box_.x1 - line.bottom);
        }
        std::sort(crossing_.begin(), crossing_.begin() + static_cast<std::ptrdiff_t>(crossings_));
    }

    [[nodiscard]] double wrong_at(const TruthSlab& slab, std::span<const TruthLine> truth, double from, double to,
                                  double part) const {
        const double level = from + part * (to - from);
        double wrong = 0, x = box_.x0;
        ResultId is = slab.left, shows = lines_.left;
        std::size_t t = 0, s = 0;
        while (x < box_.x1) {
            const double next_truth = t < truth.size() ? truth[t].top + level * (truth[t].bottom - truth[t].top) : 2;
            const double next_shown =
                s < lines_.count ? lines_.line[s].top + part * (lines_.line[s].bottom - lines_.line[s].top) : 2;
            const double next = std::min({next_truth, next_shown, box_.x1});
            if (next > x && is != shows) wrong += next - x;
            x = std::max(x, next);
            if (next_truth <= next_shown && next_truth <= next)
                is = truth[t++].right;
            else if (next_shown <= next)
                shows = lines_.line[s++].right;
        }
        return wrong;
    }

    static constexpr std::size_t kMostCrossings = 64; ///< of three lines with what is in a slab: more is a blur
    const SilmapBox& box_;
    const ShownCell& shown_;
    std::array<double, 4> slope_{}; ///< dx/dy
    bool whole_ = true;             ///< the box is the cell
    ShownLines lines_;
    std::array<double, kMostCrossings> crossing_;
    std::size_t crossings_ = 0;
};

} // namespace

double ShownCell::exit_of(const fetex::SilmapPoint& point, std::uint32_t link, const fetex::SilmapPoint& across) {
    switch (link) {
    case fetex::kSilmapWest:
        return point.y + (across.y - point.y) * (point.x / (point.x - across.x));
    case fetex::kSilmapEast:
        return point.y + (across.y - point.y) * ((1 - point.x) / (across.x - point.x));
    case fetex::kSilmapNorth:
        return point.x + (across.x - point.x) * (point.y / (point.y - across.y));
    default:
        return point.x + (across.x - point.x) * ((1 - point.y) / (across.y - point.y));
    }
}

double wrong_area(const TruthSlabs& truth, std::span<const TruthSlab> slabs, const SilmapBox& box,
                  const ShownCell& shown) {
    Integral integral(box, shown);
    std::array<double, 3> cuts{shown.point.y, shown.exit[fetex::kSilmapWest], shown.exit[fetex::kSilmapEast]};
    if (cuts[0] > cuts[1]) std::swap(cuts[0], cuts[1]);
    if (cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
    if (cuts[0] > cuts[1]) std::swap(cuts[0], cuts[1]);
    double area = 0;
    std::size_t cut = 0;
    for (const TruthSlab& slab : slabs) {
        const std::span<const TruthLine> lines = truth.lines_of(slab);
        double y = slab.y0;
        for (; cut < cuts.size() && cuts[cut] < slab.y1; ++cut) {
            if (!(cuts[cut] > y)) continue;
            area += integral.over(slab, lines, y, cuts[cut]);
            y = cuts[cut];
        }
        area += integral.over(slab, lines, y, slab.y1);
    }
    return area;
}

} // namespace fetexc
