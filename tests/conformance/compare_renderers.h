// SPDX-License-Identifier: GPL-3.0-or-later
/// GLSL = CPU reference, pixel by pixel. Header only, for the conformance tests and the corpus runner.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "formats/fbt.h"
#include "runtime_glsl/host/renderer.h"
#include "runtime_glsl/host/sample_grid.h"

namespace fetexc::test {

/// Texels. A pixel whose reference colour changes when its centre moves by this much lies on an edge: quantised
/// geometry and fp32 evaluation may put it on either side (error_budget.h, kRegionTolerance).
inline constexpr double kEdgeHair = 0x1p-14;
inline constexpr double kColorStep = 1.0 / 255;

struct Comparison {
    std::uint64_t pixels = 0;
    std::uint64_t on_edge = 0; ///< differ by more than 1/255, but lie on an edge
    std::uint64_t wrong = 0;   ///< differ by more than 1/255, away from every edge
    double largest = 0;        ///< largest difference of a channel away from edges
    std::string first_wrong;   ///< where, for a message
    std::string error;         ///< the renderer failed; nothing was compared

    void add(const Comparison& other) {
        pixels += other.pixels;
        on_edge += other.on_edge;
        wrong += other.wrong;
        largest = std::max(largest, other.largest);
        if (first_wrong.empty()) first_wrong = other.first_wrong;
        if (error.empty()) error = other.error;
    }
    [[nodiscard]] bool equal() const { return error.empty() && wrong == 0 && pixels > 0; }
};

inline double color_distance(const fetex::FbtColor& a, const fetex::FbtColor& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

/// Share of the channels of two images of one size that differ by more than a step; NaN differs.
inline double different_share(const fetex::Image& a, const fetex::Image& b, double step = kColorStep) {
    std::size_t different = 0;
    for (std::size_t k = 0; k < a.rgba.size(); ++k)
        different += !(std::abs(a.rgba[k] - b.rgba[k]) <= step);
    return static_cast<double>(different) / static_cast<double>(a.rgba.size());
}

/// Whether the reference's colour sample(x, y) at a place in texels changes by more than a step within a hair of it, in
/// the eight directions. Beyond the texture its border is repeated, so there the nearest point of the border counts.
template <class Texture, class Sample>
bool changes_nearby(const Texture& texture, const Sample& sample, double x, double y, double step = kColorStep) {
    x = std::clamp<double>(x, 0, texture.width);
    y = std::clamp<double>(y, 0, texture.height);
    const fetex::FbtColor center = sample(x, y);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (color_distance(center, sample(x + dx * kEdgeHair, y + dy * kEdgeHair)) > step) return true;
    return false;
}

/// The largest difference of the four channels from `at` on; infinite if one of them is no number.
inline double pixel_difference(const fetex::Image& a, const fetex::Image& b, std::size_t at) {
    double largest = 0;
    for (std::size_t c = at; c < at + 4; ++c) {
        const double difference = std::abs(a.rgba[c] - b.rgba[c]);
        largest = std::max(largest, std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference);
    }
    return largest;
}

/// Two images of one view of the texture, one sample a pixel. sample(x, y) is the reference's colour at a place in
/// texels; pixels that differ by up to a step are equal.
template <class Texture, class Sample>
Comparison compare_images(const Texture& texture, const fetex::Outcome<fetex::Image>& reference,
                          const fetex::Outcome<fetex::Image>& drawn, const fetex::View& view, const Sample& sample,
                          double step = kColorStep) {
    Comparison result;
    if (!reference.ok() || !drawn.ok()) {
        result.error = (reference.ok() ? drawn : reference).error().message;
        return result;
    }
    const std::uint32_t width = reference.value().width, height = reference.value().height;
    const fetex::ImageAxis columns(view.x, view.w, texture.width, width, 1);
    const fetex::ImageAxis rows(view.y, view.h, texture.height, height, 1);
    result.pixels = std::uint64_t{width} * height;
    for (std::uint32_t py = 0; py < height; ++py) {
        for (std::uint32_t px = 0; px < width; ++px) {
            const double difference =
                pixel_difference(reference.value(), drawn.value(), (std::size_t{py} * width + px) * 4);
            const double x = std::ldexp(static_cast<double>(columns.position(px, 0)), -32);
            const double y = std::ldexp(static_cast<double>(rows.position(py, 0)), -32);
            if (difference > step && std::isfinite(difference) && changes_nearby(texture, sample, x, y, step)) {
                ++result.on_edge;
                continue;
            }
            result.largest = std::max(result.largest, difference);
            if (difference <= step) continue;
            ++result.wrong;
            if (result.first_wrong.empty())
                result.first_wrong = "texel position (" + std::to_string(x) + ", " + std::to_string(y) +
                                     "), difference " + std::to_string(difference);
        }
    }
    return result;
}

/// One frame, one sample a pixel.
inline Comparison compare_frame(const fetex::FbtTexture& texture, fetex::Renderer& renderer, const fetex::View& view,
                                std::uint32_t width, std::uint32_t height) {
    const fetex::RenderSize size{width, height, 1};
    return compare_images(texture, fetex::render_cpu(texture, view, size), renderer.render(view, size), view,
                          [&](double x, double y) { return fetex::fbt_sample(texture, x, y); });
}

/// Start of a view that doesn't leave the texture, if it is smaller than that: pixels beyond say nothing new.
inline double within(double start, double size) { return size >= 1 ? start : std::clamp(start, 0.0, 1 - size); }

/// Frames of side² pixels at a magnification in pixels per texel: one at the origin, then `more` of them around random
/// texels that hold features (or any, if none does). The renderer has the texture uploaded.
inline Comparison compare_at(const fetex::FbtTexture& texture, fetex::Renderer& renderer, double pixels_per_texel,
                             std::uint32_t side, std::uint32_t more, std::uint64_t seed) {
    std::vector<std::uint32_t> texels;
    for (std::uint32_t k = 0; k < texture.texels.size(); ++k) {
        const std::uint32_t kind = texture.texels[k] >> 30;
        if (kind == fetex::kFbtKindSingle || kind == fetex::kFbtKindBanded) texels.push_back(k);
    }
    if (texels.empty()) texels.push_back(0);
    const double extent = side / pixels_per_texel; // texels across the frame
    fetex::View view{0, 0, extent / texture.width, extent / texture.height};
    Comparison total = compare_frame(texture, renderer, view, side, side);
    std::mt19937_64 random(seed);
    for (std::uint32_t k = 0; k < more; ++k) {
        const std::uint32_t texel = texels[random() % texels.size()];
        const double dx = static_cast<double>(random() >> 11) * 0x1p-53,
                     dy = static_cast<double>(random() >> 11) * 0x1p-53;
        view.x = within((texel % texture.width + dx - extent / 2) / texture.width, view.w);
        view.y = within((texel / texture.width + dy - extent / 2) / texture.height, view.h);
        total.add(compare_frame(texture, renderer, view, side, side));
    }
    return total;
}

} // namespace fetexc::test
