// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/pictures.h"

#include <cassert>

#include "compiler/measure/bilinear.h"
#include "compiler/measure/colors.h"
#include "formats/feature_sampler.h"

namespace fetexc::measure {

Rgba FbtPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::fbt_sample(texture_, p.u * texture_.width, p.v * texture_.height);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t FbtPicture::gpu_bytes() const { return fetex::fbt_gpu_bytes(texture_); }

Rgba BilevelPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::bilevel_sample(texture_, p.u * texture_.width, p.v * texture_.height);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t BilevelPicture::gpu_bytes() const { return fetex::bilevel_gpu_bytes(texture_); }

Rgba SilmapPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::silmap_sample(texture_, p.u * texture_.width, p.v * texture_.height, filter_);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t SilmapPicture::gpu_bytes() const { return fetex::silmap_gpu_bytes(texture_); }

Rgba PinchmapPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::pinchmap_sample(texture_, p.u * texture_.width, p.v * texture_.height);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t PinchmapPicture::gpu_bytes() const { return fetex::pinchmap_gpu_bytes(texture_); }

Rgba FeatureCurvesPicture::at(TexturePoint p) const {
    const fetex::FbtColor c = fetex::feature_sample(texture_, p.u * texture_.width, p.v * texture_.height);
    return {c.r, c.g, c.b, c.a};
}

std::uint64_t FeatureCurvesPicture::gpu_bytes() const { return fetex::feature_gpu_bytes(texture_); }

BitmapPicture::BitmapPicture(GridSize size, std::vector<std::uint8_t> rgba, Filter filter)
    : size_(size), rgba_(std::move(rgba)), filter_(filter) {
    assert(size.width > 0 && size.height > 0);
    assert(rgba_.size() == std::size_t{4} * size.width * size.height);
}

Rgba BitmapPicture::texel(std::uint32_t i, std::uint32_t j) const {
    const std::uint8_t* c = rgba_.data() + 4 * (std::size_t{j} * size_.width + i);
    return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0};
}

Rgba BitmapPicture::at(TexturePoint p) const {
    if (filter_ == Filter::Nearest) return texel(nearest_texel(p.u, size_.width), nearest_texel(p.v, size_.height));
    const TexelWeights x(p.u, size_.width), y(p.v, size_.height);
    const auto along_row = [&](int j) {
        return mix(texel(x.index[0], y.index[j]), texel(x.index[1], y.index[j]), x.offset);
    };
    return mix(along_row(0), along_row(1), y.offset);
}

} // namespace fetexc::measure
