// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/texture_segments.h"

#include "formats/feature_curve_geometry.h"

namespace fetexc {

CanvasSegment curve_of(const TextureSegment& s) {
    if (s.middle) return {2, {s.from, *s.middle, s.to}};
    return {1, {s.from, s.to}};
}

TextureSegments::TextureSegments(const fetex::FeatureCurvesTexture& texture)
    : width_(texture.width), height_(texture.height), configurations_(texture.configurations),
      occupied_(width_, height_) {
    if (!texture.linear) middles_.resize(2 * configurations_.size());
    for (std::uint32_t j = 0; j <= height_; ++j) {
        for (std::uint32_t i = 0; i <= width_; ++i) {
            north_.push_back(fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::North).position);
            west_.push_back(fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::West).position);
            if (i == width_ || j == height_ || configurations_[std::size_t{j} * width_ + i] == 0) continue;
            occupied_.set(i, j);
            if (!texture.linear) bend(texture, i, j);
        }
    }
}

void TextureSegments::bend(const fetex::FeatureCurvesTexture& texture, std::uint32_t i, std::uint32_t j) {
    const std::size_t texel = std::size_t{j} * width_ + i;
    const std::uint32_t count = fetex::feature_unpack(configurations_[texel]).count;
    for (std::uint32_t k = 0; k < count; ++k) {
        const fetex::FeatureQuadratic q = fetex::feature_segment_curve(texture, i, j, k);
        if (!q.straight) middles_[2 * texel + k] = CanvasPoint{i + q.b1.x, j + q.b1.y};
    }
}

} // namespace fetexc
