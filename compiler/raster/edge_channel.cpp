// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/edge_channel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetexc {

namespace {

using Mixture = std::array<double, 4>;

Mixture channels_of(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

Mixture unit(const Mixture& m) {
    double sum = 0;
    for (const double v : m)
        sum += v * v;
    Mixture out = m;
    for (double& v : out)
        v /= std::sqrt(sum);
    return out;
}

/// Sum of the squares (as matrices) of all differences between a pixel and its right and lower neighbours.
std::array<Mixture, 4> squared_differences(const RasterImage& image) {
    std::array<Mixture, 4> sum{};
    const auto add = [&](const Mixture& a, const Mixture& b) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t k = 0; k < 4; ++k)
                sum[i][k] += (b[i] - a[i]) * (b[k] - a[k]);
        }
    };
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const Mixture here = channels_of(image.at(x, y));
            if (x + 1 < image.width) add(here, channels_of(image.at(x + 1, y)));
            if (y + 1 < image.height) add(here, channels_of(image.at(x, y + 1)));
        }
    }
    return sum;
}

/// By power iteration from luminance, which it stays where nothing differs. An axis that is not quite the principal one
/// serves as well.
Mixture principal_axis(const std::array<Mixture, 4>& m) {
    constexpr int steps = 64;
    Mixture axis = unit({0.2126, 0.7152, 0.0722, 0.25});
    for (int k = 0; k < steps; ++k) {
        Mixture next{};
        double size = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t c = 0; c < 4; ++c)
                next[i] += m[i][c] * axis[c];
            size = std::max(size, std::fabs(next[i]));
        }
        if (!(size > 0)) return axis;
        axis = unit(next);
    }
    return axis;
}

/// Catmull-Rom weights of the four neighbours of a place t beyond the second.
std::array<double, 4> cubic_weights(double t) {
    const double t2 = t * t, t3 = t2 * t;
    return {0.5 * (-t + 2 * t2 - t3), 0.5 * (2 - 5 * t2 + 3 * t3), 0.5 * (t + 4 * t2 - 3 * t3), 0.5 * (t3 - t2)};
}

} // namespace

EdgeChannel::EdgeChannel(const RasterImage& image) : EdgeChannel(image.width, image.height) {
    const Mixture axis = principal_axis(squared_differences(image));
    for (std::uint32_t y = 0; y < height_; ++y) {
        for (std::uint32_t x = 0; x < width_; ++x) {
            const Mixture c = channels_of(image.at(x, y));
            for (std::size_t i = 0; i < 4; ++i)
                values_[std::size_t{y} * width_ + x] += axis[i] * c[i];
        }
    }
}

double EdgeChannel::at(double x, double y) const {
    const double u = std::clamp(x - 0.5, 0.0, width_ - 1.0), v = std::clamp(y - 0.5, 0.0, height_ - 1.0);
    const auto i = static_cast<std::int64_t>(u), j = static_cast<std::int64_t>(v);
    const std::array<double, 4> wx = cubic_weights(u - static_cast<double>(i)),
                                wy = cubic_weights(v - static_cast<double>(j));
    double sum = 0;
    for (std::int64_t b = 0; b < 4; ++b) {
        const auto row = static_cast<std::uint32_t>(std::clamp<std::int64_t>(j + b - 1, 0, height_ - 1));
        double along = 0;
        for (std::int64_t a = 0; a < 4; ++a) {
            const auto column = static_cast<std::uint32_t>(std::clamp<std::int64_t>(i + a - 1, 0, width_ - 1));
            along += wx[static_cast<std::size_t>(a)] * (*this)(column, row);
        }
        sum += wy[static_cast<std::size_t>(b)] * along;
    }
    return sum;
}

namespace {

/// Weights of the neighbours −n … n; their sum is 1.
std::vector<double> gaussian(double sigma) {
    const int n = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> weights;
    double sum = 0;
    for (int k = -n; k <= n; ++k) {
        weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
        sum += weights.back();
    }
    for (double& w : weights)
        w /= sum;
    return weights;
}

/// One pass along x; the result is turned, so that two passes make a picture.
void blur_and_turn(const std::vector<double>& in, std::uint32_t width, std::uint32_t height,
                   const std::vector<double>& weights, std::vector<double>& out) {
    const auto reach = static_cast<std::int64_t>(weights.size() / 2);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            double sum = 0;
            for (std::int64_t k = -reach; k <= reach; ++k) {
                const std::int64_t at = std::clamp<std::int64_t>(x + k, 0, width - 1);
                sum += weights[static_cast<std::size_t>(k + reach)] *
                       in[std::size_t{y} * width + static_cast<std::size_t>(at)];
            }
            out[std::size_t{x} * height + y] = sum;
        }
    }
}

} // namespace

EdgeChannel EdgeChannel::blurred(double sigma) const {
    const std::vector<double> weights = gaussian(sigma);
    EdgeChannel out(width_, height_);
    std::vector<double> turned(values_.size());
    blur_and_turn(values_, width_, height_, weights, turned);
    blur_and_turn(turned, height_, width_, weights, out.values_);
    return out;
}

EdgeChannel EdgeChannel::band_pass(double smaller, double larger) const {
    EdgeChannel out = blurred(smaller);
    const EdgeChannel wide = blurred(larger);
    for (std::size_t k = 0; k < values_.size(); ++k)
        out.values_[k] -= wide.values_[k];
    return out;
}

} // namespace fetexc
