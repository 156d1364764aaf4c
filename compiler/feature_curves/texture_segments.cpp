// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/texture_segments.h"

#include "compiler/parallel.h"

namespace fetexc {
namespace {

constexpr std::size_t kRows = 8; ///< of texels, for a thread at a time

TextureSegment segment_of(const fetex::FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j,
                          fetex::FeatureSegment edges) {
    const fetex::FeatureSignature s = fetex::feature_signature(t, i, j);
    const auto point = [&](fetex::FeatureEdge e) -> CanvasPoint {
        const fetex::FeaturePoint p = fetex::feature_point(e, s[fetex::feature_edge_index(e)].position);
        return {i + p.x, j + p.y};
    };
    return {{1, {point(edges.first), point(edges.second)}}, edges};
}

} // namespace

TextureSegments::TextureSegments(const fetex::FeatureCurvesTexture& texture, unsigned threads)
    : width_(texture.width), height_(texture.height), first_(std::size_t{width_} * height_ + 1),
      occupied_(width_, height_) {
    for (std::size_t texel = 0; texel + 1 < first_.size(); ++texel) {
        const std::uint32_t count = fetex::feature_unpack(texture.configurations[texel]).count;
        first_[texel + 1] = first_[texel] + count;
        if (count > 0)
            occupied_.set(static_cast<std::uint32_t>(texel % width_), static_cast<std::uint32_t>(texel / width_));
    }
    segments_.resize(first_.back());
    parallel_for_chunks(height_, kRows, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t texel = begin * width_; texel < end * width_; ++texel) {
            std::uint32_t n = first_[texel];
            for (const fetex::FeatureSegment s : fetex::feature_unpack(texture.configurations[texel]))
                segments_[n++] = segment_of(texture, static_cast<std::uint32_t>(texel % width_),
                                            static_cast<std::uint32_t>(texel / width_), s);
        }
    });
}

} // namespace fetexc
