// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/base_map.h"

#include <algorithm>
#include <cmath>

#include "compiler/parallel.h"

namespace fetexc {
namespace {

constexpr std::size_t kRows = 8; ///< of corners, for a thread at a time

/// The pixels along an axis that are averaged at a corner, and how much each counts; adds up to 1.
struct Span {
    std::uint32_t first = 0;
    std::vector<double> weights;
};

std::vector<Span> spans(std::uint32_t texels, std::uint32_t pixels) {
    const double pitch = static_cast<double>(pixels) / texels, width = std::max(pitch, 1.0);
    std::vector<Span> out(std::size_t{texels} + 1);
    for (std::uint32_t k = 0; k <= texels; ++k) {
        const double from = std::max(k * pitch - width / 2, 0.0),
                     to = std::min(k * pitch + width / 2, static_cast<double>(pixels));
        Span& span = out[k];
        span.first = std::min(static_cast<std::uint32_t>(from), pixels - 1);
        for (std::uint32_t p = span.first; p < pixels && (p < to || p == span.first); ++p)
            span.weights.push_back((std::min(p + 1.0, to) - std::max<double>(p, from)) / (to - from));
    }
    return out;
}

/// normalised; straight up if it is 0.
NormalVector unit(const NormalVector& n) {
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    if (!(length > 0)) return {};
    return {n.x / length, n.y / length, n.z / length};
}

NormalVector from_color(const Rgba& c, bool y_up) {
    const double y = 2 * c.g - 1;
    return unit({2 * c.r - 1, y_up ? -y : y, 2 * c.b - 1});
}

} // namespace

std::vector<Rgba> corner_colors(const RasterImage& image, std::uint32_t width, std::uint32_t height, unsigned threads) {
    const std::vector<Span> columns = spans(width, image.width), rows = spans(height, image.height);
    std::vector<Rgba> out(columns.size() * rows.size());
    parallel_for_chunks(rows.size(), kRows, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin * columns.size(); at < end * columns.size(); ++at) {
            const Span &across = columns[at % columns.size()], &down = rows[at / columns.size()];
            Rgba& sum = out[at];
            sum = {0, 0, 0, 0};
            for (std::uint32_t y = 0; y < down.weights.size(); ++y) {
                for (std::uint32_t x = 0; x < across.weights.size(); ++x) {
                    const Rgba c = image.at(across.first + x, down.first + y);
                    const double w = down.weights[y] * across.weights[x];
                    sum.r += w * c.r, sum.g += w * c.g, sum.b += w * c.b, sum.a += w * c.a;
                }
            }
        }
    });
    return out;
}

std::vector<NormalVector> corner_normals(const BaseImage& base, std::uint32_t width, std::uint32_t height,
                                         unsigned threads) {
    const std::vector<Rgba> colors = corner_colors(*base.image, width, height, threads);
    std::vector<NormalVector> out(colors.size());
    if (base.kind == BaseImageKind::Normal) {
        std::ranges::transform(colors, out.begin(), [&](const Rgba& c) { return from_color(c, base.y_up); });
        return out;
    }
    const std::size_t columns = std::size_t{width} + 1, rows = std::size_t{height} + 1;
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t left = i > 0 ? i - 1 : i, right = std::min(i + 1, columns - 1), above = j > 0 ? j - 1 : j,
                              below = std::min(j + 1, rows - 1);
            const auto at = [&](std::size_t x, std::size_t y) { return base.height_scale * colors[y * columns + x].r; };
            out[j * columns + i] = unit({-(at(right, j) - at(left, j)) / static_cast<double>(right - left),
                                         -(at(i, below) - at(i, above)) / static_cast<double>(below - above), 1});
        }
    }
    return out;
}

} // namespace fetexc
