// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/pictures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fetexc::measure {
namespace {

Rgba mix(const Rgba& a, const Rgba& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

} // namespace

Rgba FbtPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::fbt_sample(texture_, p.u * texture_.width, p.v * texture_.height);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t FbtPicture::gpu_bytes() const {
    return (texture_.texels.size() + texture_.records.size()) * sizeof(std::uint32_t);
}

BitmapPicture::BitmapPicture(GridSize size, std::vector<std::uint8_t> rgba, Filter filter)
    : size_(size), rgba_(std::move(rgba)), filter_(filter) {
    assert(size.width > 0 && size.height > 0);
    assert(rgba_.size() == std::size_t{4} * size.width * size.height);
}

Rgba BitmapPicture::texel(std::int64_t i, std::int64_t j) const {
    i = std::clamp<std::int64_t>(i, 0, size_.width - 1), j = std::clamp<std::int64_t>(j, 0, size_.height - 1);
    const std::uint8_t* c =
        rgba_.data() + 4 * (static_cast<std::size_t>(j) * size_.width + static_cast<std::size_t>(i));
    return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0};
}

Rgba BitmapPicture::at(TexturePoint p) const {
    const double shift = filter_ == Filter::Bilinear ? 0.5 : 0;
    const double x = std::clamp(p.u, 0.0, 1.0) * size_.width - shift,
                 y = std::clamp(p.v, 0.0, 1.0) * size_.height - shift;
    const auto i = static_cast<std::int64_t>(std::floor(x)), j = static_cast<std::int64_t>(std::floor(y));
    if (filter_ == Filter::Nearest) return texel(i, j);
    const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
    return mix(mix(texel(i, j), texel(i + 1, j), fx), mix(texel(i, j + 1), texel(i + 1, j + 1), fx), fy);
}

} // namespace fetexc::measure
