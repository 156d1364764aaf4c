// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/feature_zones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fetexc {
namespace {

constexpr double kStrip = 3, kTaper = 2; ///< clusters
constexpr double kChord = 0.5;           ///< clusters: of a strip's other side, at most about
constexpr int kMostChords = 64;          ///< of a segment
/// Of the way around outside: in larger sides of the canvas, from its middle; a full turn.
constexpr double kAround = 2.5;
constexpr int kAroundSteps = 24;

struct Step {
    double x = 0, y = 0;
};

double length(const Step& s) { return std::hypot(s.x, s.y); }
Step between(const CanvasPoint& a, const CanvasPoint& b) { return {b.x - a.x, b.y - a.y}; }

CanvasPoint point_at(const CanvasSegment& s, double t) {
    std::array<CanvasPoint, 4> p = s.p;
    for (int n = s.degree; n > 0; --n) {
        for (int k = 0; k < n; ++k)
            p[k] = {p[k].x + (p[k + 1].x - p[k].x) * t, p[k].y + (p[k + 1].y - p[k].y) * t};
    }
    return p[0];
}

CanvasPoint end_of(const CanvasContour& run) { return run.back().p[static_cast<std::size_t>(run.back().degree)]; }

bool is_closed(const CanvasContour& run) {
    const CanvasPoint first = run.front().p[0], last = end_of(run);
    return first.x == last.x && first.y == last.y;
}

class Zoner {
  public:
    Zoner(const FeatureCurves& features, std::uint32_t width, std::uint32_t height)
        : width_(features.width), height_(features.height),
          cluster_(std::max(features.width / width, features.height / height)) {}

    void add(const CanvasContour& run) {
        if (is_closed(run)) {
            contours_.push_back(run);
            return;
        }
        CanvasContour out = prolonged(run, width_, height_);
        if (outside(out.front().p[0]) && outside(end_of(out)))
            close_outside(out);
        else
            close_beside(run, out);
        contours_.push_back(std::move(out));
    }

    std::vector<CanvasContour> contours_;
    std::vector<ClosingLine> closing_;

  private:
    [[nodiscard]] bool outside(const CanvasPoint& p) const {
        return p.x < 0 || p.x > width_ || p.y < 0 || p.y > height_;
    }

    void close_outside(CanvasContour& contour) const {
        const CanvasPoint middle{width_ / 2, height_ / 2};
        const auto angle = [&](const CanvasPoint& p) { return std::atan2(p.y - middle.y, p.x - middle.x); };
        const double from = angle(end_of(contour)),
                     by = std::remainder(angle(contour.front().p[0]) - from, 2 * std::numbers::pi);
        const double radius = kAround * std::max(width_, height_);
        for (int k = 0; k <= kAroundSteps; ++k) {
            const double a = from + by * k / kAroundSteps;
            line_to({middle.x + radius * std::cos(a), middle.y + radius * std::sin(a)}, contour);
        }
        line_to(contour.front().p[0], contour);
    }

    /// Along the run's outer side: around a bend it can't cross itself there.
    void close_beside(const CanvasContour& run, CanvasContour& contour) {
        const std::vector<CanvasPoint> chain = chords(contour);
        const double side = turning(run) > 0 ? -1 : 1;
        const std::size_t before = contour.size();
        for (std::size_t k = chain.size(); k-- > 0;) {
            const Step a = k > 0 ? between(chain[k - 1], chain[k]) : between(chain[0], chain[1]);
            const Step b = k + 1 < chain.size() ? between(chain[k], chain[k + 1]) : a;
            const double la = length(a), lb = length(b);
            const Step along{a.x / la + b.x / lb, a.y / la + b.y / lb};
            const double l = length(along);
            if (!(l > 0)) continue; // it turns back
            const double by = side * kStrip * cluster_ / l;
            line_to({chain[k].x - along.y * by, chain[k].y + along.x * by}, contour);
        }
        line_to(contour.front().p[0], contour);
        for (std::size_t k = before; k < contour.size(); ++k)
            closing_.push_back({contour[k].p[0], contour[k].p[1]});
    }

    static void line_to(const CanvasPoint& p, CanvasContour& contour) { contour.push_back({1, {end_of(contour), p}}); }

    [[nodiscard]] std::vector<CanvasPoint> chords(const CanvasContour& run) const {
        std::vector<CanvasPoint> out{run.front().p[0]};
        for (const CanvasSegment& s : run) {
            double way = 0;
            for (int k = 0; k < s.degree; ++k)
                way += length(between(s.p[static_cast<std::size_t>(k)], s.p[static_cast<std::size_t>(k) + 1]));
            const int count = std::clamp(static_cast<int>(std::ceil(way / (kChord * cluster_))), 1, kMostChords);
            for (int k = 1; k <= count; ++k) {
                const CanvasPoint p = point_at(s, static_cast<double>(k) / count);
                if (length(between(out.back(), p)) > 0) out.push_back(p);
            }
        }
        return out;
    }

    /// Above 0: clockwise, as y points down.
    [[nodiscard]] double turning(const CanvasContour& run) const {
        const std::vector<CanvasPoint> chain = chords(run);
        double sum = 0;
        for (std::size_t k = 1; k + 1 < chain.size(); ++k) {
            const Step a = between(chain[k - 1], chain[k]), b = between(chain[k], chain[k + 1]);
            sum += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
        }
        return sum;
    }

    double width_, height_, cluster_;
};

Result<Scene> zone_scene(const FeatureCurves& features, std::vector<CanvasContour> contours) {
    SceneBuilder builder(features.width, features.height);
    const std::uint32_t element = builder.add_element("features");
    Node node;
    node.end = 1, node.paint = 0, node.element = element;
    node.shape = builder.add_shape(std::move(contours), FillRule::EvenOdd, element);
    builder.scene().paints.emplace_back(SolidPaint{{0, 0, 0, 1}});
    builder.scene().nodes.push_back(node);
    builder.scene().root_end = 1;
    return builder.finish({.cull = false});
}

double distance(const CanvasPoint& p, const CanvasPoint& a, const CanvasPoint& b) {
    const Step d = between(a, b), to = between(a, p);
    const double square = d.x * d.x + d.y * d.y,
                 t = square > 0 ? std::clamp((to.x * d.x + to.y * d.y) / square, 0.0, 1.0) : 0;
    return std::hypot(to.x - t * d.x, to.y - t * d.y);
}

} // namespace

Result<FeatureZones> feature_zones(const FeatureCurves& features, std::uint32_t width, std::uint32_t height,
                                   unsigned threads) {
    Zoner zoner(features, width, height);
    for (const CanvasContour& run : features.runs) {
        if (!run.empty()) zoner.add(run);
    }
    const Result<Scene> scene = zone_scene(features, std::move(zoner.contours_));
    if (!scene) return scene.error();
    auto silhouette = silhouette_of(scene.value(), {SilhouetteRule::Kind::Alpha, ""}, threads);
    if (!silhouette) return silhouette.error();
    return FeatureZones{std::move(silhouette).value(), std::move(zoner.closing_)};
}

std::uint64_t taper(std::span<const ClosingLine> closing, const FeatureCurves& frame, std::uint32_t width,
                    std::uint32_t height, std::vector<fetex::PinchmapTexel>& map) {
    std::vector<double> distances(map.size(), kTaper);
    const auto in_clusters = [&](const CanvasPoint& p) {
        return CanvasPoint{p.x / frame.width * width, p.y / frame.height * height};
    };
    const auto texel = [](double v, std::uint32_t most) {
        return static_cast<std::uint32_t>(std::clamp<double>(v, 0, most));
    };
    for (const ClosingLine& line : closing) {
        const CanvasPoint a = in_clusters(line.from), b = in_clusters(line.to);
        const auto [x0, x1] = std::minmax(a.x, b.x);
        const auto [y0, y1] = std::minmax(a.y, b.y);
        for (std::uint32_t j = texel(std::ceil(y0 - kTaper), height); j <= texel(y1 + kTaper, height); ++j) {
            for (std::uint32_t i = texel(std::ceil(x0 - kTaper), width); i <= texel(x1 + kTaper, width); ++i) {
                double& d = distances[std::size_t{j} * (width + 1) + i];
                d = std::min(d, distance({static_cast<double>(i), static_cast<double>(j)}, a, b));
            }
        }
    }
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < map.size(); ++k) {
        if (map[k].k != 0 || distances[k] >= kTaper) continue;
        const double strength = distances[k] / kTaper;
        map[k].du *= strength, map[k].dv *= strength, ++count;
    }
    return count;
}

} // namespace fetexc
