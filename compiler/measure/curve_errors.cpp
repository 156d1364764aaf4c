// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/curve_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compiler/error_budget.h"
#include "compiler/measure/curve_displacement.h"
#include "compiler/measure/pictures.h"
#include "compiler/measure/truth_samples.h"
#include "compiler/parallel.h"
#include "formats/feature_sampler.h"

namespace fetexc::measure {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct SpreadSample {
    double value = 0;
    TexturePoint place;
};

/// value(number of the pixel, point): nothing where the figure says nothing. In the order of rows of pixels.
template <class Value> Spread spread_of(GridSize pixels, unsigned threads, const Value& value) {
    std::vector<std::vector<SpreadSample>> rows(pixels.height);
    parallel_for(pixels.height, threads, [&](std::size_t row) {
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const TexturePoint p = sample_point(pixels, i, static_cast<std::uint32_t>(row));
            if (const std::optional<double> v = value(row * pixels.width + i, p)) rows[row].push_back({*v, p});
        }
    });
    Spread out;
    std::vector<double> all;
    for (const std::vector<SpreadSample>& row : rows) {
        for (const SpreadSample& s : row) {
            out.mean += s.value, all.push_back(s.value);
            if (s.value > out.max) out.max = s.value, out.place = s.place;
        }
    }
    out.points = all.size();
    if (all.empty()) return out;
    out.mean /= static_cast<double>(all.size());
    const auto high = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 99 / 100);
    std::ranges::nth_element(all, high);
    out.p99 = *high;
    return out;
}

std::array<double, 3> normal_of(const Rgba& c) { return {2 * c.r - 1, 2 * c.g - 1, 2 * c.b - 1}; }

/// By the arc tangent, which small angles take no accuracy from.
double angle_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return kDegrees * std::atan2(std::hypot(x, y, z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// The points' colours as they are, the means as they are seen.
PictureSamples samples_at(const Picture& picture, GridSize pixels, const CurveMeasureOptions& options) {
    PictureSamples out = samples_of(picture, pixels, options.threads, PixelMeans::Smooth);
    if (options.seen)
        out.means = box_means(SeenPicture(picture, options.seen), pixels, options.threads, PixelMeans::Smooth);
    return out;
}

PictureSamples seen(PictureSamples samples, const CurveMeasureOptions& options) {
    if (!options.seen) return samples;
    for (Rgba& c : samples.points)
        c = options.seen(c);
    return samples;
}

class DistanceErrors {
  public:
    DistanceErrors(const CurveTruth& truth, const fetex::FeatureCurvesTexture& texture)
        : truth_(truth), texture_(texture), texel_(2 / (texture.width + texture.height / truth.height())) {}

    [[nodiscard]] std::optional<double> at(TexturePoint p) const {
        const WidthPoint at = truth_.to_width(p);
        const EdgePoint found = truth_.nearest(at, texel_);
        if (found.edge == kNone || !(found.distance > 0) || !is_plain(p, at, found)) return std::nullopt;
        const double exact = std::min(found.distance / texel_, double{texture_.distance_limit});
        return std::abs(fetex::feature_at(texture_, p.u * texture_.width, p.v * texture_.height).distance - exact);
    }

  private:
    /// budget::kFeaturePlain. Corners of the point's texel are two texels and a half from the nearest curve at most.
    [[nodiscard]] bool is_plain(TexturePoint p, WidthPoint at, const EdgePoint& found) const {
        const WidthPoint foot = point_at(truth_.curves()[found.edge], found.t);
        const double nx = (at.x - foot.x) / found.distance, ny = (at.y - foot.y) / found.distance;
        const double i = std::floor(std::min(p.u * texture_.width, texture_.width - 1.0)),
                     j = std::floor(std::min(p.v * texture_.height, texture_.height - 1.0));
        for (int c = 0; c < 4; ++c) {
            const WidthPoint corner =
                truth_.to_width({(i + (c & 1)) / texture_.width, (j + (c >> 1)) / texture_.height});
            const double along = (corner.x - foot.x) * nx + (corner.y - foot.y) * ny;
            const EdgePoint near = truth_.nearest(corner, std::abs(along) + budget::kFeaturePlain * texel_);
            if (near.edge == kNone || std::abs(along) - near.distance > budget::kFeaturePlain * texel_) return false;
            if (!(near.distance > 0)) continue;
            const WidthPoint its = point_at(truth_.curves()[near.edge], near.t);
            const double cosine = ((corner.x - its.x) * nx + (corner.y - its.y) * ny) / near.distance;
            if ((along < 0 ? -cosine : cosine) < budget::kFeatureSameWay) return false;
        }
        return true;
    }

    const CurveTruth& truth_;
    const fetex::FeatureCurvesTexture& texture_;
    double texel_; ///< width units: a texel of what the texture's distances count (texels_per_unit)
};

} // namespace

double texel_side(const CurveTruth& truth, const Picture& picture) {
    const GridSize n = picture.texels();
    return std::max(1.0 / n.width, truth.height() / n.height);
}

CurveMeasurer::CurveMeasurer(const CurveTruth& truth, const std::vector<GridSize>& sizes, CurveMeasureOptions options)
    : truth_(truth), options_(std::move(options)) {
    for (const GridSize pixels : sizes)
        samples_.push_back(samples_at(truth, pixels, options_));
}

CurveErrors CurveMeasurer::at_size(const PictureSamples& truth, const Picture& picture,
                                   const fetex::FeatureCurvesTexture* texture) const {
    const GridSize pixels = truth.pixels;
    const PictureSamples found = samples_at(picture, pixels, options_);
    CurveErrors out;
    out.pixels = pixels, out.pixels_per_texel = static_cast<double>(pixels.width) / picture.texels().width;
    out.colors = difference(seen(truth, options_), seen(found, options_));
    if (truth_.kind() == fetex::FeatureKind::Normal)
        out.angle = spread_of(pixels, options_.threads, [&](std::size_t k, TexturePoint) -> std::optional<double> {
            return angle_between(normal_of(truth.points[k]), normal_of(found.points[k]));
        });
    if (texture == nullptr) return out;
    const double step = std::max(1.0 / pixels.width, truth_.height() / pixels.height);
    CurveDistances moved = curve_distances(truth_, curves_of(*texture, truth_.height()), step,
                                           options_.reach * texel_side(truth_, picture), options_.threads);
    out.to_picture = moved.to_picture, out.to_truth = moved.to_truth;
    const DistanceErrors errors(truth_, *texture);
    out.distance = spread_of(pixels, options_.threads, [&](std::size_t, TexturePoint p) { return errors.at(p); });
    return out;
}

std::vector<CurveErrors> CurveMeasurer::measure(const Picture& picture,
                                                const fetex::FeatureCurvesTexture* texture) const {
    std::vector<CurveErrors> out;
    for (const PictureSamples& truth : samples_)
        out.push_back(at_size(truth, picture, texture));
    return out;
}

CurveErrors curve_errors(const CurveTruth& truth, const Picture& picture, const fetex::FeatureCurvesTexture* texture,
                         GridSize pixels, const CurveMeasureOptions& options) {
    return CurveMeasurer(truth, {pixels}, options).measure(picture, texture).front();
}

} // namespace fetexc::measure
