// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/overlay.h"

#include <array>

#include "cli/pen.h"
#include "formats/feature_curve_geometry.h"

namespace fetexc::cli {
namespace {

constexpr Ink kHalo{1, 1, 1, 0.7F}, kBoundary{0.85F, 0, 0.45F, 1}, kLink{0.1F, 0.35F, 0.9F, 0.6F},
    kSide{0.45F, 0.45F, 0.45F, 0.5F}, kPoint{1, 0.85F, 0, 1}, kRim{0.1F, 0.1F, 0.1F, 1};
/// Of feature curves, by profile; then from the first again.
constexpr std::array<Ink, 8> kProfiles = {
    kBoundary,           {0.1F, 0.35F, 0.9F, 1},   {0, 0.55F, 0.2F, 1},     {0.9F, 0.45F, 0, 1}, {0.5F, 0.1F, 0.75F, 1},
    {0, 0.6F, 0.65F, 1}, {0.55F, 0.35F, 0.15F, 1}, {0.35F, 0.35F, 0.35F, 1}};
/// Pixels a cell from which its sides and other links are drawn, and the texels' colours.
constexpr double kRoomForSides = 12, kRoomForTexels = 28;

/// A texture's view in pixels.
class Frame {
  public:
    Frame(std::uint32_t width, std::uint32_t height, const fetex::View& view, const fetex::Image& image)
        : width_(width), height_(height), view_(view), scale_x_(image.width / (view.w * width)),
          scale_y_(image.height / (view.h * height)) {}

    /// Of a point in texels.
    [[nodiscard]] Pixel at(double x, double y) const {
        return {(x - view_.x * width_) * scale_x_, (y - view_.y * height_) * scale_y_};
    }
    /// Pixels a texel.
    [[nodiscard]] double room() const { return std::min(scale_x_, scale_y_); }
    [[nodiscard]] double thickness() const { return std::clamp(room() / 10, 1.0, 4.0); }

    /// visit(i, j): of 0 … width by 0 … height those that show, and those up to `reach` beside them.
    template <class Visit> void each(double reach, const Visit& visit) const {
        const auto range = [&](double from, double extent, std::uint32_t size) {
            const auto bound = [&](double v) {
                return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, double{1} * size));
            };
            return std::array{bound(from * size - reach), bound((from + extent) * size + 1 + reach)};
        };
        const auto is = range(view_.x, view_.w, width_), js = range(view_.y, view_.h, height_);
        for (std::uint32_t j = js[0]; j <= js[1]; ++j) {
            for (std::uint32_t i = is[0]; i <= is[1]; ++i)
                visit(i, j);
        }
    }

  private:
    std::uint32_t width_, height_;
    const fetex::View& view_;
    double scale_x_, scale_y_;
};

class SilmapOverlay {
  public:
    SilmapOverlay(const fetex::SilmapTexture& texture, const fetex::View& view, fetex::Image& image)
        : texture_(texture), frame_(texture.width, texture.height, view, image), pen_(image) {}

    void draw() {
        if (frame_.room() >= kRoomForSides) {
            frame_.each(0.5, [&](std::uint32_t i, std::uint32_t j) { draw_sides(i, j); });
            frame_.each(0.5, [&](std::uint32_t i, std::uint32_t j) { draw_links(i, j, false); });
        }
        if (frame_.room() >= kRoomForTexels)
            frame_.each(0.5, [&](std::uint32_t i, std::uint32_t j) { draw_texel(i, j); });
        frame_.each(0.5, [&](std::uint32_t i, std::uint32_t j) { draw_links(i, j, true); });
        frame_.each(0.5, [&](std::uint32_t i, std::uint32_t j) { draw_point(i, j); });
    }

  private:
    /// A local place of a cell.
    [[nodiscard]] Pixel at(std::uint32_t i, std::uint32_t j, fetex::SilmapPoint p) const {
        return frame_.at(i - 0.5 + p.x, j - 0.5 + p.y);
    }

    void draw_sides(std::uint32_t i, std::uint32_t j) {
        pen_.dashed(at(i, j, {0, 0}), at(i, j, {1, 0}), 1, kSide);
        pen_.dashed(at(i, j, {0, 0}), at(i, j, {0, 1}), 1, kSide);
    }

    /// To the east and south: the others are those of the neighbours.
    void draw_links(std::uint32_t i, std::uint32_t j, bool boundaries) {
        const fetex::SilmapShape shape = fetex::silmap_shape(texture_, i, j);
        for (const std::uint32_t link : {fetex::kSilmapEast, fetex::kSilmapSouth}) {
            const bool boundary = (shape.boundaries >> link & 1) != 0;
            if (boundary != boundaries || (!boundary && shape.boundaries == 0 && !has_boundaries(i, j, link))) continue;
            const Pixel from = at(i, j, shape.point), to = at(i, j, shape.across[link]);
            if (boundary) pen_.line(from, to, 2 * frame_.thickness(), kHalo);
            pen_.line(from, to, boundary ? frame_.thickness() : 1, boundary ? kBoundary : kLink);
        }
    }

    /// The neighbour.
    [[nodiscard]] bool has_boundaries(std::uint32_t i, std::uint32_t j, std::uint32_t link) const {
        const bool east = link == fetex::kSilmapEast;
        return fetex::silmap_shape(texture_, east ? i + 1 : i, east ? j : j + 1).boundaries != 0;
    }

    void draw_point(std::uint32_t i, std::uint32_t j) {
        const fetex::SilmapShape shape = fetex::silmap_shape(texture_, i, j);
        if (shape.boundaries == 0 || frame_.room() < kRoomForSides) return;
        pen_.disc(at(i, j, shape.point), frame_.thickness() + 1, kRim);
        pen_.disc(at(i, j, shape.point), frame_.thickness(), kPoint);
    }

    /// The texel below and to the right of a cell's corner.
    void draw_texel(std::uint32_t i, std::uint32_t j) {
        if (i >= texture_.width || j >= texture_.height) return;
        const fetex::FbtColor c = fetex::silmap_sample(texture_, i + 0.5, j + 0.5, fetex::SilmapFilter::Nearest);
        const auto straight = [&](double v) { return static_cast<float>(c.a > 0 ? std::min(v / c.a, 1.0) : 0); };
        const double radius = std::min(frame_.room() / 8, 6.0);
        pen_.disc(frame_.at(i + 0.5, j + 0.5), radius + 1.5, kRim);
        pen_.disc(frame_.at(i + 0.5, j + 0.5), radius + 0.5, kHalo);
        pen_.disc(frame_.at(i + 0.5, j + 0.5), radius,
                  {straight(c.r), straight(c.g), straight(c.b), static_cast<float>(c.a)});
    }

    const fetex::SilmapTexture& texture_;
    Frame frame_;
    Pen pen_;
};

class PinchmapOverlay {
  public:
    PinchmapOverlay(const fetex::PinchmapTexture& texture, const fetex::View& view, fetex::Image& image)
        : texture_(texture), frame_(texture.width, texture.height, view, image), pen_(image) {}

    void draw() {
        if (frame_.room() >= kRoomForSides) frame_.each(1, [&](std::uint32_t i, std::uint32_t j) { draw_sides(i, j); });
        // All halos first, so that none lies over another cluster's line.
        const double thickness = frame_.thickness();
        frame_.each(1, [&](std::uint32_t i, std::uint32_t j) { draw_line(i, j, 2 * thickness, kHalo); });
        frame_.each(1, [&](std::uint32_t i, std::uint32_t j) { draw_line(i, j, thickness, kBoundary); });
        frame_.each(1, [&](std::uint32_t i, std::uint32_t j) { draw_arrow(i, j); });
    }

  private:
    void draw_sides(std::uint32_t i, std::uint32_t j) {
        if (i < texture_.width) pen_.dashed(frame_.at(i, j), frame_.at(i + 1.0, j), 1, kSide);
        if (j < texture_.height) pen_.dashed(frame_.at(i, j), frame_.at(i, j + 1.0), 1, kSide);
    }

    /// The discontinuity in a cluster: where k − gamma, bilinear, is 0; through squares small enough to be straight in.
    void draw_line(std::uint32_t i, std::uint32_t j, double thickness, const Ink& ink) {
        if (i >= texture_.width || j >= texture_.height) return;
        const auto side = [&](std::uint32_t di, std::uint32_t dj) {
            const fetex::PinchmapTexel t = fetex::pinchmap_texel(texture_, i + di, j + dj);
            return t.k - t.gamma;
        };
        const std::array<double, 4> f{side(0, 0), side(1, 0), side(0, 1), side(1, 1)};
        if ((f[0] > 0) == (f[1] > 0) && (f[0] > 0) == (f[2] > 0) && (f[0] > 0) == (f[3] > 0)) return;
        constexpr int kMostSteps = 16;
        const int steps = std::clamp(static_cast<int>(frame_.room() / 4), 1, kMostSteps);
        for (int s = 0; s < steps * steps; ++s) {
            const Square square{static_cast<double>(s % steps) / steps, static_cast<double>(s / steps) / steps,
                                1.0 / steps};
            draw_square(i, j, f, square, [&](Pixel p, Pixel q) { pen_.line(p, q, thickness, ink); });
        }
    }

    /// Of a cluster.
    struct Square {
        double x = 0, y = 0, side = 1;
    };

    /// From where the line comes in to where it goes out; of two lines each from the side before to the next.
    template <class Draw>
    void draw_square(std::uint32_t i, std::uint32_t j, const std::array<double, 4>& f, const Square& s,
                     const Draw& draw) const {
        const auto value = [&](double x, double y) {
            return (f[0] * (1 - x) + f[1] * x) * (1 - y) + (f[2] * (1 - x) + f[3] * x) * y;
        };
        const std::array corners{std::array{s.x, s.y}, std::array{s.x + s.side, s.y},
                                 std::array{s.x + s.side, s.y + s.side}, std::array{s.x, s.y + s.side}};
        std::array<Pixel, 4> found;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [ax, ay] = corners[k];
            const auto [bx, by] = corners[(k + 1) % 4];
            const double from = value(ax, ay), to = value(bx, by);
            if ((from > 0) == (to > 0)) continue;
            const double t = from / (from - to);
            found[count++] = frame_.at(i + ax + (bx - ax) * t, j + ay + (by - ay) * t);
        }
        for (std::size_t k = 0; k + 1 < count; k += 2)
            draw(found[k], found[k + 1]);
    }

    /// Of an active texel: which way it pinches, as long as its strength lets.
    void draw_arrow(std::uint32_t i, std::uint32_t j) {
        const fetex::PinchmapTexel t = fetex::pinchmap_texel(texture_, i, j);
        if (t.k != 0 || frame_.room() < kRoomForSides) return;
        const Pixel from = frame_.at(i - 0.35 * t.du, j - 0.35 * t.dv),
                    to = frame_.at(i + 0.35 * t.du, j + 0.35 * t.dv);
        pen_.line(from, to, 1.5, kLink);
        pen_.disc(to, frame_.thickness(), kLink);
        pen_.disc(frame_.at(i, j), frame_.thickness() + 1, kRim);
        pen_.disc(frame_.at(i, j), frame_.thickness(), kPoint);
    }

    const fetex::PinchmapTexture& texture_;
    Frame frame_;
    Pen pen_;
};

class CurvesOverlay {
  public:
    CurvesOverlay(const fetex::FeatureCurvesTexture& texture, const fetex::View& view, fetex::Image& image)
        : texture_(texture), frame_(texture.width, texture.height, view, image), pen_(image) {}

    void draw() {
        if (frame_.room() >= kRoomForSides) each_texel([&](std::uint32_t i, std::uint32_t j) { draw_sides(i, j); });
        each_texel([&](std::uint32_t i, std::uint32_t j) { draw_segments(i, j, 2 * frame_.thickness(), &kHalo); });
        each_texel([&](std::uint32_t i, std::uint32_t j) { draw_segments(i, j, frame_.thickness(), nullptr); });
        if (frame_.room() >= kRoomForSides) each_texel([&](std::uint32_t i, std::uint32_t j) { draw_knots(i, j); });
    }

  private:
    template <class Visit> void each_texel(const Visit& visit) const {
        frame_.each(0, [&](std::uint32_t i, std::uint32_t j) {
            if (i < texture_.width && j < texture_.height) visit(i, j);
        });
    }

    [[nodiscard]] fetex::FeatureSegmentList segments(std::uint32_t i, std::uint32_t j) const {
        return fetex::feature_unpack(texture_.configurations[std::size_t{j} * texture_.width + i]);
    }

    void draw_sides(std::uint32_t i, std::uint32_t j) {
        pen_.dashed(frame_.at(i, j), frame_.at(i + 1.0, j), 1, kSide);
        pen_.dashed(frame_.at(i, j), frame_.at(i, j + 1.0), 1, kSide);
    }

    /// Without an ink in those of the profiles, that of the nearer end.
    void draw_segments(std::uint32_t i, std::uint32_t j, double thickness, const Ink* ink) {
        constexpr int kMostChords = 32;
        const fetex::FeatureTexelProfiles profiles = fetex::feature_texel_profiles(texture_, i, j);
        const int chords = std::clamp(static_cast<int>(frame_.room() / 4), 1, kMostChords);
        for (std::uint32_t k = 0; k < segments(i, j).count; ++k) {
            const fetex::FeatureQuadratic q = fetex::feature_segment_curve(texture_, i, j, k);
            const fetex::FeatureSegment s = segments(i, j).segment[k];
            const auto profile = [&](fetex::FeatureEdge e) -> const Ink& {
                return kProfiles[profiles.edges[fetex::feature_edge_index(e)] % kProfiles.size()];
            };
            const auto at = [&](int n) {
                const fetex::FeaturePoint p = fetex::feature_curve_at(q, static_cast<double>(n) / chords);
                return frame_.at(i + p.x, j + p.y);
            };
            for (int n = 0; n < chords; ++n)
                pen_.line(at(n), at(n + 1), thickness,
                          ink != nullptr ? *ink : profile(2 * n < chords ? s.first : s.second));
        }
    }

    void draw_knots(std::uint32_t i, std::uint32_t j) {
        const fetex::FeatureSignature signature = fetex::feature_signature(texture_, i, j);
        for (const fetex::FeatureSegment s : segments(i, j)) {
            for (const fetex::FeatureEdge e : {s.first, s.second}) {
                const fetex::FeaturePoint p = fetex::feature_point(e, signature[fetex::feature_edge_index(e)].position);
                pen_.disc(frame_.at(i + p.x, j + p.y), frame_.thickness() + 1, kRim);
                pen_.disc(frame_.at(i + p.x, j + p.y), frame_.thickness(), kPoint);
            }
        }
    }

    const fetex::FeatureCurvesTexture& texture_;
    Frame frame_;
    Pen pen_;
};

} // namespace

void draw_overlay(const fetex::PinchmapTexture& texture, const fetex::View& view, fetex::Image& image) {
    PinchmapOverlay(texture, view, image).draw();
}

void draw_overlay(const fetex::SilmapTexture& texture, const fetex::View& view, fetex::Image& image) {
    SilmapOverlay(texture, view, image).draw();
}

void draw_overlay(const fetex::FeatureCurvesTexture& texture, const fetex::View& view, fetex::Image& image) {
    CurvesOverlay(texture, view, image).draw();
}

} // namespace fetexc::cli
