// SPDX-License-Identifier: GPL-3.0-or-later
/// What a texture with feature curves should show: the exact distance to the network's curves, what is done near them
/// and the base map, put together as Parilov and Zorin's Equation 1 has it. Nothing is read from an asset.
///
/// Each point has the profile of the curve nearest to it. Normals have the exact direction away from that curve: none
/// is smoothed. Of a base map the pixels' centres count, bilinear between them, the border repeated; the normals of
/// heights are those of differences across two pixels (one at the border).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiler/feature_curves/base_map.h"
#include "compiler/measure/edge_index.h"
#include "compiler/measure/picture.h"
#include "compiler/network/curve_profiles.h"
#include "formats/feature_curves.h"

namespace fetexc::measure {

struct CurveTruthOptions {
    fetex::FeatureKind kind = fetex::FeatureKind::Normal;
    BaseImage base = {};     ///< heights: in user units; the image outlives the truth
    Rgba base_color = {};    ///< straight; of colours without an image
    double white_height = 0; ///< user units: of heights, what white stands for; 0: heights_white
};

/// Where grey says heights: what the base map's white stands for, or without an image twice the highest of what is done
/// near curves, with 0 in the middle.
double heights_white(const CurveProfiles& profiles, const BaseImage& base);

/// Const members are thread-safe.
class CurveTruth final : public Picture {
  public:
    /// The network need not outlive it. profiles: of that network.
    CurveTruth(const Network& network, CurveProfiles profiles, const CurveTruthOptions& options);
    CurveTruth(const CurveTruth&) = delete;
    CurveTruth& operator=(const CurveTruth&) = delete;

    /// Premultiplied; normals n, x right, y down, z out of the picture, as (n + 1) / 2.
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {1, 1}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return 0; }

    [[nodiscard]] fetex::FeatureKind kind() const { return options_.kind; }
    /// User units.
    [[nodiscard]] double width() const { return width_; }
    /// Of the canvas, width units.
    [[nodiscard]] double height() const { return height_; }
    [[nodiscard]] WidthPoint to_width(TexturePoint p) const { return {p.u, p.v * height_}; }
    [[nodiscard]] TexturePoint to_texture(WidthPoint p) const { return {p.x, p.y / height_}; }

    /// The network's segments, long ones in parts, in its order. Their sides say nothing.
    [[nodiscard]] std::span<const VisibleEdge> curves() const { return curves_; }
    /// Distance accurate to 1e-12; radius: width units.
    [[nodiscard]] EdgePoint nearest(WidthPoint p, double radius) const { return index_->nearest(p, radius); }

  private:
    struct Near;
    [[nodiscard]] Near near(TexturePoint p) const;
    [[nodiscard]] NormalVector shown_normal(TexturePoint p, const Near& near) const;
    [[nodiscard]] Rgba base_color(TexturePoint p) const;
    [[nodiscard]] NormalVector base_normal(TexturePoint p) const;
    [[nodiscard]] NormalVector normal_of_heights(TexturePoint p) const;

    double width_, height_;
    CurveProfiles profiles_;
    CurveTruthOptions options_;
    double reach_; ///< width units: farther away nothing is done
    std::vector<VisibleEdge> curves_;
    std::vector<std::uint32_t> profile_of_; ///< for each of curves_
    std::unique_ptr<const EdgeIndex> index_;
};

} // namespace fetexc::measure
