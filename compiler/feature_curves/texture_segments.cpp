// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/texture_segments.h"

namespace fetexc {

CanvasSegment curve_of(const TextureSegment& s) {
    if (s.middle) return {2, {s.from, *s.middle, s.to}};
    return {1, {s.from, s.to}};
}

TextureSegments::TextureSegments(const fetex::FeatureCurvesTexture& texture)
    : width_(texture.width), height_(texture.height), configurations_(texture.configurations),
      occupied_(width_, height_) {
    for (std::uint32_t j = 0; j <= height_; ++j) {
        for (std::uint32_t i = 0; i <= width_; ++i) {
            north_.push_back(fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::North).position);
            west_.push_back(fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::West).position);
            if (i < width_ && j < height_ && texture.configurations[std::size_t{j} * width_ + i] != 0)
                occupied_.set(i, j);
        }
    }
}

} // namespace fetexc
