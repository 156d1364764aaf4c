// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/curve_truth.h"

#include <algorithm>
#include <cmath>

#include "compiler/measure/bilinear.h"
#include "compiler/measure/colors.h"
#include "compiler/scene/bezier.h"

namespace fetexc::measure {
namespace {

using fetex::FeatureKind;

constexpr Rgba kBlack{0, 0, 0, 1};

Rgba premultiplied(const Rgba& c) { return {c.r * c.a, c.g * c.a, c.b * c.a, c.a}; }

NormalVector unit(const NormalVector& n) {
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return length > 0 ? NormalVector{n.x / length, n.y / length, n.z / length} : NormalVector{};
}

Rgba grey(double v) {
    const double shown = std::clamp(v, 0.0, 1.0);
    return {shown, shown, shown, 1};
}

/// Width units: parts of curves that are looked through for the nearest point are no longer on the canvas, so that few
/// are looked at.
constexpr double kPart = 1.0 / 128;

VisibleEdge edge_of(const CanvasSegment& s) {
    VisibleEdge e;
    e.degree = s.degree;
    for (std::size_t n = 0; n <= static_cast<std::size_t>(s.degree); ++n)
        e.p[n] = {s.p[n].x, s.p[n].y};
    return e;
}

/// Halved until the polygon of control points is short enough; curves beyond the canvas stay as they are.
void add_parts(const CanvasSegment& s, double height, std::vector<VisibleEdge>& out) {
    const VisibleEdge e = edge_of(s);
    const WidthBox box = box_of(e);
    const bool near = box.x0 < 2 && box.x1 > -1 && box.y0 < 2 * height && box.y1 > -height;
    if (!near || std::max(box.x1 - box.x0, box.y1 - box.y0) <= kPart) {
        out.push_back(e);
        return;
    }
    add_parts(bezier::part(s, 0, 0.5), height, out);
    add_parts(bezier::part(s, 0.5, 1), height, out);
}

/// Of four pixels around a point.
template <class Of> Rgba interpolated(const RasterImage& image, TexturePoint p, const Of& of) {
    const TexelWeights x(p.u, image.width), y(p.v, image.height);
    const auto row = [&](std::size_t j) {
        return mix(of(x.index[0], y.index[j]), of(x.index[1], y.index[j]), x.offset);
    };
    return mix(row(0), row(1), y.offset);
}

} // namespace

double heights_white(const CurveProfiles& profiles, const BaseImage& base) {
    if (base.image != nullptr) return base.height_scale;
    double most = 0;
    for (const FeatureProfile& p : profiles.profiles)
        most = std::max(most, largest_height(p));
    return most > 0 ? 2 * most : 1;
}

/// What is done at a point, and from where the curve is.
struct CurveTruth::Near {
    double slope = 0, blend = 1, height = 0; ///< h', b, h
    Rgba color = kBlack;                     ///< premultiplied
    WidthPoint away;                         ///< from the nearest curve, of length 1; 0 on it
};

CurveTruth::CurveTruth(const Network& network, CurveProfiles profiles, const CurveTruthOptions& options)
    : width_(network.width), height_(network.height / network.width), profiles_(std::move(profiles)), options_(options),
      reach_(profile_reach(profiles_) / network.width) {
    if (!(options_.white_height > 0)) options_.white_height = heights_white(profiles_, options_.base);
    for (std::size_t k = 0; k < network.curves.size(); ++k) {
        for (const CanvasSegment& s : network.curves[k].segments) {
            CanvasSegment scaled = s;
            for (CanvasPoint& p : scaled.p)
                p = {p.x / width_, p.y / width_};
            add_parts(scaled, height_, curves_);
            profile_of_.resize(curves_.size(), profiles_.of_curve[k]);
        }
    }
    index_ = std::make_unique<const EdgeIndex>(curves_, height_);
}

CurveTruth::Near CurveTruth::near(TexturePoint p) const {
    const WidthPoint at = to_width(p);
    const EdgePoint found = nearest(at, reach_);
    if (found.edge == kNone) return {};
    const FeatureProfile& profile = profiles_.profiles[profile_of_[found.edge]];
    const double distance = found.distance * width_;
    const WidthPoint from = point_at(curves_[found.edge], found.t);
    Near out;
    out.slope = profile_slope(profile, distance), out.blend = profile_blend(profile, distance);
    out.height = profile_height(profile, distance);
    out.color = premultiplied(profile_color(profile, distance).value_or(kBlack));
    if (found.distance > 0) out.away = {(at.x - from.x) / found.distance, (at.y - from.y) / found.distance};
    return out;
}

Rgba CurveTruth::base_color(TexturePoint p) const {
    const RasterImage& image = *options_.base.image;
    return interpolated(image, p, [&](std::uint32_t x, std::uint32_t y) { return image.at(x, y); });
}

NormalVector CurveTruth::normal_of_heights(TexturePoint p) const {
    const RasterImage& image = *options_.base.image;
    const double scale = options_.base.height_scale, columns = image.width / width_,
                 rows = image.height / (width_ * height_); // pixels a user unit
    const auto slopes = [&](std::uint32_t x, std::uint32_t y) -> Rgba {
        const std::uint32_t left = x > 0 ? x - 1 : 0, right = std::min(x + 1, image.width - 1);
        const std::uint32_t above = y > 0 ? y - 1 : 0, below = std::min(y + 1, image.height - 1);
        const double across = (image.at(right, y).r - image.at(left, y).r) * columns,
                     down = (image.at(x, below).r - image.at(x, above).r) * rows;
        return {scale * across / std::max(right - left, 1u), scale * down / std::max(below - above, 1u), 0, 1};
    };
    const Rgba slope = interpolated(image, p, slopes);
    return unit({-slope.r, -slope.g, 1});
}

NormalVector CurveTruth::base_normal(TexturePoint p) const {
    if (options_.base.image == nullptr) return {};
    if (options_.base.kind == BaseImageKind::Height) return normal_of_heights(p);
    const Rgba c = base_color(p);
    const double y = 2 * c.g - 1;
    return unit({2 * c.r - 1, options_.base.y_up ? -y : y, 2 * c.b - 1});
}

/// Equation 1.
NormalVector CurveTruth::shown_normal(TexturePoint p, const Near& near) const {
    const NormalVector base = base_normal(p);
    const double along = near.blend * std::hypot(near.slope, 1.0), rest = 1 - near.blend;
    return unit({along * base.x - rest * near.slope * near.away.x, along * base.y - rest * near.slope * near.away.y,
                 rest + along * base.z});
}

Rgba CurveTruth::at(TexturePoint p) const {
    const Near shown = near(p);
    const double b = shown.blend, rest = 1 - b;
    switch (options_.kind) {
    case FeatureKind::Normal: {
        const NormalVector n = shown_normal(p, shown);
        return {(n.x + 1) / 2, (n.y + 1) / 2, (n.z + 1) / 2, 1};
    }
    case FeatureKind::Height: {
        if (options_.base.image == nullptr) return grey(0.5 + rest * shown.height / options_.white_height);
        const double base = base_color(p).r * options_.base.height_scale;
        return grey((rest * shown.height + b * base) / options_.white_height);
    }
    default:
        const Rgba base = options_.base.image != nullptr ? base_color(p) : premultiplied(options_.base_color);
        return mix(shown.color, base, b);
    }
}

} // namespace fetexc::measure
