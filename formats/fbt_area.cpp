// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The area-sampling reference (SPEC.md, "Area sampling"): the mean over a pixel instead of a point. In double, plain
/// and slow.
///
/// Features of a band don't cross, and a feature comes right after those inside it. So the part of a pixel that shows
/// the region inside a feature is the area inside the feature less the areas inside those directly inside it; nothing
/// is blended twice, and there are no seams.
#include <algorithm>
#include <array>
#include <cmath>

#include "formats/fbt.h"
#include "formats/fbt_walk.h"

namespace fetex {
namespace {

struct Point {
    double x = 0, y = 0;
};

/// Part of a pixel's side that isn't looked at beyond its texel: single precision can't tell it from nothing.
constexpr double kLeast = 1e-5;

/// Half a side of the smallest pixel: below it single precision has no bits left for what is inside.
constexpr double kLeastHalf = 0x1p-16;

/// A rectangle in the frame of a texel.
struct Box {
    double x0 = 0, x1 = 0, y0 = 0, y1 = 0;

    [[nodiscard]] double area() const { return (x1 - x0) * (y1 - y0); }
    [[nodiscard]] Box moved(double dx, double dy) const { return {x0 + dx, x1 + dx, y0 + dy, y1 + dy}; }
    /// Inside the texel, where chains end.
    [[nodiscard]] bool inside_texel() const {
        const double dx = kLeast * (x1 - x0), dy = kLeast * (y1 - y0);
        return x0 >= -dx && y0 >= -dy && x1 <= 1 + dx && y1 <= 1 + dy;
    }
};

/// The frame of a ray: it runs along +x. Rays along ±y see x and y swapped, negative ones x mirrored.
class RayFrame {
  public:
    explicit RayFrame(std::uint32_t direction) : swapped_(direction >= kFbtRayPosY), negative_((direction & 1u) != 0) {}
    [[nodiscard]] Point point(std::uint32_t word) const {
        const double x = fbt_dequantise(word & 0xffffu), y = fbt_dequantise(word >> 16);
        return swapped_ ? Point{sign() * y, x} : Point{sign() * x, y};
    }
    [[nodiscard]] Box box(const Box& b) const {
        const Box s = swapped_ ? Box{b.y0, b.y1, b.x0, b.x1} : b;
        return negative_ ? Box{-s.x1, -s.x0, s.y0, s.y1} : s;
    }

  private:
    [[nodiscard]] double sign() const { return negative_ ? -1.0 : 1.0; }
    bool swapped_, negative_;
};

struct Piece {
    std::uint32_t degree = 1;
    std::array<Point, 4> c;

    [[nodiscard]] Point at(double t) const {
        std::array<Point, 4> p = c;
        for (std::uint32_t n = degree; n > 0; --n) {
            for (std::uint32_t k = 0; k < n; ++k)
                p[k] = {p[k].x + t * (p[k + 1].x - p[k].x), p[k].y + t * (p[k + 1].y - p[k].y)};
        }
        return p[0];
    }
    [[nodiscard]] double slope_y(double t) const {
        const double u = 1 - t, a = c[1].y - c[0].y;
        if (degree == 1) return a;
        const double b = c[2].y - c[1].y;
        if (degree == 2) return 2 * (u * a + t * b);
        return 3 * (u * u * a + 2 * u * t * b + t * t * (c[3].y - c[2].y));
    }
};

/// Root in [0,1] of a function that only grows; 0 or 1 if it has no root there.
template <typename Function> double root(const Function& f) {
    double low = 0, high = 1;
    if (f(low) >= 0) return low;
    if (f(high) <= 0) return high;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return high;
}

/// ∫ (x(t) − x0) dy along a monotone piece, x cut to the box and y to its range. Between entering the box and leaving
/// it the curve is integrated exactly: Gauss with three points holds for degree 5.
double integral(const Piece& q, const Box& box) {
    const Point first = q.c[0], last = q.c[q.degree];
    const auto level = [&](double y) { return std::clamp(y, box.y0, box.y1); };
    if (level(first.y) == level(last.y)) return 0;
    double left = first.x, right = first.x;
    for (std::uint32_t n = 1; n <= q.degree; ++n)
        left = std::min(left, q.c[n].x), right = std::max(right, q.c[n].x);
    const double width = box.x1 - box.x0;
    if (right <= box.x0) return 0;
    if (left >= box.x1) return width * (level(last.y) - level(first.y));
    const double sx = last.x >= first.x ? 1 : -1, sy = last.y >= first.y ? 1 : -1;
    const double x_in = sx > 0 ? box.x0 : box.x1, x_out = sx > 0 ? box.x1 : box.x0;
    const double y_in = sy > 0 ? box.y0 : box.y1, y_out = sy > 0 ? box.y1 : box.y0;
    const double t_out = root([&](double t) {
        const Point p = q.at(t);
        return std::max(sx * (p.x - x_out), sy * (p.y - y_out));
    });
    // A piece that leaves one of both ranges before it is in the other passes by.
    const double t_in = std::min(t_out, root([&](double t) {
                                     const Point p = q.at(t);
                                     return std::min(sx * (p.x - x_in), sy * (p.y - y_in));
                                 }));
    const double before = level(q.at(t_in).y) - level(first.y), after = level(last.y) - level(q.at(t_out).y);
    double sum = width * (sx > 0 ? after : before);
    static const double kNode = std::sqrt(0.6);
    for (const double node : {-1.0, 0.0, 1.0}) {
        const double t = 0.5 * (t_in + t_out) + 0.5 * (t_out - t_in) * node * kNode;
        const double weight = (node == 0 ? 8.0 : 5.0) / 18 * (t_out - t_in);
        sum += weight * std::clamp(q.at(t).x - box.x0, 0.0, width) * q.slope_y(t);
    }
    return sum;
}

/// The end of a chain with the nearest control point that isn't the same.
struct ChainEnd {
    std::uint32_t end = 0, before = 0;
};

/// Texels; from there on even a chain that rises one step of the output grid a texel has left every box.
constexpr double kFar = 1e6;

/// A line that carries a chain on beyond its end, along its tangent. It begins at the end.
Piece continuation(const ChainEnd& e, const RayFrame& frame) {
    const Point end = frame.point(e.end), before = frame.point(e.before);
    const double dx = end.x - before.x, dy = end.y - before.y, length = std::max(std::fabs(dx), std::fabs(dy));
    if (!(length > 0)) return {1, {end, end}};
    return {1, {end, {end.x + kFar * dx / length, end.y + kFar * dy / length}}};
}

void add(FbtColor& sum, const FbtColor& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

double clamp_unit(double v) { return std::clamp(v, 0.0, 1.0); }

/// Walks an entry list and gives every region of it its part of a box.
class ListArea {
  public:
    ListArea(const FbtTexture& texture, const Box& box, const FbtColor& corners)
        : texture_(texture), box_(box), corners_(corners) {}

    /// Mean colour over the box.
    FbtColor mean(std::uint32_t list) {
        for (std::uint32_t record = list;;) {
            const std::uint32_t* words = texture_.records.data() + std::size_t{record} * 4;
            const FbtEntry entry(words[0]);
            if (entry.pieces() > 0) add_run(entry, words);
            if (entry.last_run() && entry.pieces() > 0) end_feature(entry, words[1]);
            if (entry.last()) {
                add_region(entry.rest_model(), words[entry.rest_word()], 1 - below_[0]);
                break;
            }
            record += entry.records();
        }
        const double scale = total_ > 0 ? 1 / total_ : 0;
        return {sum_.r * scale, sum_.g * scale, sum_.b * scale, sum_.a * scale};
    }

  private:
    void add_run(const FbtEntry& entry, const std::uint32_t* words) {
        const RayFrame frame(entry.direction());
        const Box box = frame.box(box_);
        const std::uint32_t* points = entry.shared() ? texture_.records.data() + words[2] : words + 2;
        Piece q{entry.degree(), {}};
        for (std::uint32_t k = 0; k < entry.pieces(); ++k, points += entry.degree()) {
            for (std::uint32_t n = 0; n <= entry.degree(); ++n)
                q.c[n] = frame.point(points[n]);
            if (!begun_) {
                begun_ = true;
                start_ = {points[0], points[1]};
                for (std::uint32_t n = 2; n <= entry.degree() && start_.before == start_.end; ++n)
                    start_.before = points[n];
            }
            signed_area_ += integral(q, box);
        }
        end_ = {points[0], points[-1]};
        for (std::uint32_t n = 2; n <= entry.degree() && end_.before == end_.end; ++n)
            end_.before = *(points - n);
    }

    /// The part of the box inside the feature; a chain that isn't a loop goes on straight beyond the texel.
    [[nodiscard]] double inside(std::uint32_t direction) const {
        double area = signed_area_;
        if (!box_.inside_texel() && start_.end != end_.end) {
            const RayFrame frame(direction);
            const Box box = frame.box(box_);
            area += integral(continuation(end_, frame), box) - integral(continuation(start_, frame), box);
        }
        return clamp_unit(std::fabs(area) / box_.area());
    }

    /// The area inside the feature less that of the features in it.
    void end_feature(const FbtEntry& entry, std::uint32_t sample) {
        const double area = inside(entry.direction());
        const std::uint32_t depth = entry.depth();
        double& here = below_[depth];
        if (depth < kFbtMaxDepth) {
            add_region(entry.model(), sample, area - below_[depth + 1]);
            here += area;
            below_[depth + 1] = 0;
        } else { // depths are no longer told apart: taken for features each around the one before
            add_region(entry.model(), sample, area - here);
            here = std::max(here, area);
        }
        signed_area_ = 0, begun_ = false;
    }

    void add_region(std::uint32_t model, std::uint32_t sample, double part) {
        if (!(part > 0)) return;
        FbtRegion region;
        region.model = model, region.sample = sample;
        add(sum_,
            model == kFbtModelCorners ? corners_
                                      : fbt_shade(texture_, region, clamp_unit(0.5 * (box_.x0 + box_.x1)),
                                                  clamp_unit(0.5 * (box_.y0 + box_.y1))),
            part);
        total_ += part;
    }

    const FbtTexture& texture_;
    Box box_;
    FbtColor corners_; ///< of the model corners
    FbtColor sum_;
    double total_ = 0;
    std::array<double, kFbtMaxDepth + 1> below_{}; ///< [depth]: area inside the features seen at it, of one parent
    // the chain so far
    double signed_area_ = 0;
    ChainEnd start_, end_;
    bool begun_ = false;
};

/// Band after band; beyond the texel the first and the last go on.
FbtColor mean_of_features(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, const Box& box,
                          const FbtColor& corners) {
    const FbtBands bands(texture, fbt_texel(texture, i, j));
    const std::uint32_t last = bands.find(box.y1);
    FbtColor sum;
    double y = box.y0;
    for (std::uint32_t band = bands.find(box.y0);; ++band) {
        const double end = band == last ? box.y1 : bands.end(band);
        if (end > y)
            add(sum, ListArea(texture, {box.x0, box.x1, y, end}, corners).mean(bands.list(band)),
                (end - y) / (box.y1 - box.y0));
        y = end;
        if (band == last) return sum;
    }
}

/// Where a pixel leaves its texel along an axis: −1, 0 or 1. The pixel is cut to the texture.
int overlap(double& low, double& high, std::uint32_t base, std::uint32_t size) {
    if (base == 0) low = std::max(low, 0.0);
    if (base + 1 == size) high = std::min(high, 1.0);
    const double least = kLeast * (high - low);
    return low < -least ? -1 : high > 1 + least ? 1 : 0;
}

/// A texel that a pixel overlaps.
struct Share {
    std::uint32_t i = 0, j = 0;
    int dx = 0, dy = 0; ///< from the base texel
    double part = 0;    ///< of the pixel
};

double middle(double a, double b) { return 0.5 * (a + b); }

/// The model corners in the middle of a box of the base's frame, or in the nearest point of the texel.
FbtColor corner_color(const FbtTexture& texture, const Share& s, const Box& box) {
    if (texture.corners.empty()) return {};
    FbtRegion region;
    region.i = s.i, region.j = s.j, region.model = kFbtModelCorners;
    return fbt_shade(texture, region, clamp_unit(middle(box.x0, box.x1) - s.dx),
                     clamp_unit(middle(box.y0, box.y1) - s.dy));
}

} // namespace

FbtColor fbt_sample_area_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                               FbtPixel pixel) {
    const double half_x = std::clamp(pixel.half_width, kLeastHalf, 0.5),
                 half_y = std::clamp(pixel.half_height, kLeastHalf, 0.5);
    Box box{fx - half_x, fx + half_x, fy - half_y, fy + half_y};
    const int across = overlap(box.x0, box.x1, i, texture.width), down = overlap(box.y0, box.y1, j, texture.height);
    FbtColor sum;
    Share corners,
        speaker; // of the texels with the model corners the first; of those with features the one that speaks
    double corners_part = 0, featured = 0, largest = 0;
    Box span{INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (int n = 0; n < 4; ++n) {
        const int dx = (n & 1) * across, dy = (n >> 1) * down;
        if (((n & 1) && across == 0) || ((n >> 1) && down == 0)) continue;
        const Box own{std::max<double>(box.x0, dx), std::min<double>(box.x1, dx + 1), std::max<double>(box.y0, dy),
                      std::min<double>(box.y1, dy + 1)};
        const Share s{i + static_cast<std::uint32_t>(dx), j + static_cast<std::uint32_t>(dy), dx, dy,
                      own.area() / box.area()};
        const std::uint32_t texel = fbt_texel(texture, s.i, s.j);
        const FbtRegion region = fbt_whole_region(texel, s.i, s.j);
        if (fbt_has_features(texel) && pixel.exact) {
            const Box seen = own.moved(-dx, -dy);
            add(sum, mean_of_features(texture, s.i, s.j, seen, corner_color(texture, s, own)), s.part);
        } else if (fbt_has_features(texel)) {
            const double rank = n == 0 ? 2 : s.part; // the base itself, else the largest part
            if (rank > largest) largest = rank, speaker = s;
            featured += s.part;
            span = {std::min(span.x0, own.x0), std::max(span.x1, own.x1), std::min(span.y0, own.y0),
                    std::max(span.y1, own.y1)};
        } else if (region.model == kFbtModelCorners) {
            if (corners_part == 0) corners = s;
            corners_part += s.part;
        } else {
            add(sum, fbt_shade(texture, region, middle(own.x0, own.x1) - dx, middle(own.y0, own.y1) - dy), s.part);
        }
    }
    // What shows the model corners shows one gradient: it is in one texel's corners as in another's.
    const FbtColor in_corners = corner_color(texture, corners_part > 0 ? corners : speaker, box);
    add(sum, in_corners, corners_part);
    if (featured > 0) {
        const Box seen = span.moved(-speaker.dx, -speaker.dy);
        add(sum, mean_of_features(texture, speaker.i, speaker.j, seen, in_corners), featured);
    }
    return sum;
}

FbtColor fbt_sample_area(const FbtTexture& texture, double x, double y, FbtPixel pixel) {
    const double cx = fbt_clamp_coordinate(x, texture.width), cy = fbt_clamp_coordinate(y, texture.height);
    const auto i = std::min(static_cast<std::uint32_t>(cx), texture.width - 1);
    const auto j = std::min(static_cast<std::uint32_t>(cy), texture.height - 1);
    return fbt_sample_area_local(texture, i, j, cx - i, cy - j, pixel);
}

} // namespace fetex
