// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/texture_segments.h"

#include "compiler/parallel.h"
#include "formats/feature_curve_geometry.h"

namespace fetexc {

CanvasSegment curve_of(const TextureSegment& s) {
    if (s.middle) return {2, {s.from, *s.middle, s.to}};
    return {1, {s.from, s.to}};
}

TextureSegments::TextureSegments(const fetex::FeatureCurvesTexture& texture, unsigned threads)
    : width_(texture.width), height_(texture.height), configurations_(texture.configurations),
      profile_map_(texture.profile_map), north_(fetex::feature_corner_count(texture)), west_(north_.size()),
      occupied_(width_, height_) {
    if (!texture.linear) middles_.resize(2 * configurations_.size());
    // What a word of the bits of a column has belongs to one thread.
    parallel_for_chunks(std::size_t{height_} + 1, OccupiedTexels::kWord, threads,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t j = begin; j < end; ++j)
                                add_row(texture, static_cast<std::uint32_t>(j));
                        });
}

void TextureSegments::add_row(const fetex::FeatureCurvesTexture& texture, std::uint32_t j) {
    for (std::uint32_t i = 0; i <= width_; ++i) {
        const std::size_t corner = std::size_t{j} * (std::size_t{width_} + 1) + i;
        north_[corner] = fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::North).position;
        west_[corner] = fetex::feature_crossing(texture, i, j, fetex::FeatureEdge::West).position;
        if (i == width_ || j == height_ || configurations_[texel(i, j)] == 0) continue;
        occupied_.set(i, j);
        if (!texture.linear) bend(texture, i, j);
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
