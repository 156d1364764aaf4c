// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/synthetic_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/random.h"

namespace fetexc::test {
namespace {

constexpr double kSide = 1000;
constexpr int kPiecesPerBorder = 8;
constexpr double kRoadsPerColumn = 1.0 / 8;

CanvasPoint between(CanvasPoint a, CanvasPoint b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

class MapMaker {
  public:
    MapMaker(std::uint64_t seed, std::size_t segments)
        : random_(seed), builder_(kSide, kSide), n_(cells_per_side(segments)), pitch_(kSide / n_) {}

    SceneBuilder run() {
        make_corners();
        make_borders();
        for (int row = 0; row < n_; ++row) {
            for (int column = 0; column < n_; ++column)
                paint(cell(row, column));
        }
        for (int road = 0; road < n_ * kRoadsPerColumn; ++road)
            paint(road_along(kSide * random_.unit(), road % 2 == 0));
        return std::move(builder_);
    }

  private:
    static int cells_per_side(std::size_t segments) {
        // A cell has four borders; a road crosses n cells with four pieces each, twice (there and back).
        const double per_cell = 4 * kPiecesPerBorder + 8 * kRoadsPerColumn;
        return std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(segments) / per_cell))));
    }

    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_ + 1) + static_cast<std::size_t>(column);
    }

    void make_corners() {
        for (int row = 0; row <= n_; ++row) {
            for (int column = 0; column <= n_; ++column) {
                const bool border_x = column == 0 || column == n_, border_y = row == 0 || row == n_;
                corners_.push_back({pitch_ * (column + (border_x ? 0 : random_.between(-0.25, 0.25))),
                                    pitch_ * (row + (border_y ? 0 : random_.between(-0.25, 0.25)))});
            }
        }
    }

    void make_borders() {
        right_.resize(corners_.size());
        down_.resize(corners_.size());
        for (int row = 0; row <= n_; ++row) {
            for (int column = 0; column <= n_; ++column) {
                const CanvasPoint corner = corners_[at(row, column)];
                if (column < n_) right_[at(row, column)] = wiggle(corner, corners_[at(row, column + 1)]);
                if (row < n_) down_[at(row, column)] = wiggle(corner, corners_[at(row + 1, column)]);
            }
        }
    }

    /// Lines, quadratics and cubics in turn.
    CanvasContour wiggle(CanvasPoint from, CanvasPoint to) {
        CanvasContour out;
        CanvasPoint at = from;
        const double reach = 0.04 * pitch_;
        for (int k = 1; k <= kPiecesPerBorder; ++k) {
            CanvasSegment s;
            s.degree = 1 + k % 3;
            CanvasPoint next = between(from, to, static_cast<double>(k) / kPiecesPerBorder);
            if (k < kPiecesPerBorder) next = moved(next, reach);
            s.p[0] = at;
            for (int i = 1; i < s.degree; ++i)
                s.p[i] = moved(between(at, next, static_cast<double>(i) / s.degree), reach);
            s.p[s.degree] = at = next;
            out.push_back(s);
        }
        return out;
    }

    CanvasPoint moved(CanvasPoint p, double reach) {
        const double x = std::clamp(p.x + random_.between(-reach, reach), 0.0, kSide);
        return {x, std::clamp(p.y + random_.between(-reach, reach), 0.0, kSide)};
    }

    static void append(CanvasContour& to, const CanvasContour& border) {
        to.insert(to.end(), border.begin(), border.end());
    }
    static void append_reversed(CanvasContour& to, const CanvasContour& border) {
        for (auto it = border.rbegin(); it != border.rend(); ++it) {
            CanvasSegment s = *it;
            std::reverse(s.p.begin(), s.p.begin() + s.degree + 1);
            to.push_back(s);
        }
    }

    [[nodiscard]] CanvasContour cell(int row, int column) const {
        CanvasContour out;
        append(out, right_[at(row, column)]);
        append(out, down_[at(row, column + 1)]);
        append_reversed(out, right_[at(row + 1, column)]);
        append_reversed(out, down_[at(row, column)]);
        return out;
    }

    /// A band of a tenth of a cell from side to side, waving.
    CanvasContour road_along(double position, bool across) {
        const double width = 0.1 * pitch_, wave = 0.3 * pitch_;
        CanvasContour out;
        const auto point = [&](double along, double beside) {
            const double v = std::clamp(position + beside, 0.0, kSide);
            return across ? CanvasPoint{along, v} : CanvasPoint{v, along};
        };
        const int pieces = 4 * n_;
        const auto side = [&](int k, double offset) {
            return point(kSide * k / pieces, offset + wave * std::sin(0.7 * k));
        };
        const auto piece = [&](int from, int to, double offset) {
            CanvasSegment s;
            s.p[0] = side(from, offset), s.p[1] = side(to, offset);
            out.push_back(s);
        };
        for (int k = 0; k < pieces; ++k)
            piece(k, k + 1, 0);
        for (int k = pieces; k > 0; --k)
            piece(k, k - 1, width);
        return out;
    }

    void paint(const CanvasContour& contour) {
        Scene& scene = builder_.scene();
        const std::uint32_t shape = builder_.add_shape({contour}, FillRule::NonZero, kNone);
        Node fill;
        fill.kind = Node::Kind::Fill;
        fill.shape = shape;
        fill.paint = static_cast<std::uint32_t>(scene.paints.size());
        fill.end = static_cast<std::uint32_t>(scene.nodes.size()) + 1;
        const auto channel = [&] { return random_.integer(0, 255) / 255.0; };
        scene.paints.push_back(SolidPaint{{channel(), channel(), channel(), 1}});
        scene.nodes.push_back(fill);
    }

    Random random_;
    SceneBuilder builder_;
    int n_;
    double pitch_;
    std::vector<CanvasPoint> corners_;
    std::vector<CanvasContour> right_, down_; ///< from each corner to its neighbour
};

} // namespace

SceneBuilder synthetic_map_builder(std::uint64_t seed, std::size_t segments) { return MapMaker(seed, segments).run(); }

} // namespace fetexc::test
