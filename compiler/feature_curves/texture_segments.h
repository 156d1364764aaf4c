// SPDX-License-Identifier: GPL-3.0-or-later
/// The curves that a texture stores, as Bezier segments by texel. Frame: texels, x right, y down.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/scene/scene_builder.h"
#include "formats/feature_curves.h"

namespace fetexc {

/// From its first edge to its second.
struct TextureSegment {
    CanvasPoint from, to;
    std::optional<CanvasPoint> middle; ///< of a quadratic
    fetex::FeatureSegment edges;       ///< of its texel
};

CanvasSegment curve_of(const TextureSegment& s);

/// The texels of rows and columns that have curves, a bit each.
class OccupiedTexels {
  public:
    static constexpr std::uint32_t kWord = 64; ///< texels

    OccupiedTexels(std::uint32_t width, std::uint32_t height)
        : row_words_(width / kWord + 1), column_words_(height / kWord + 1), rows_(std::size_t{row_words_} * height),
          columns_(std::size_t{column_words_} * width) {}

    void set(std::uint32_t i, std::uint32_t j) {
        rows_[std::size_t{j} * row_words_ + i / kWord] |= std::uint64_t{1} << i % kWord;
        columns_[std::size_t{i} * column_words_ + j / kWord] |= std::uint64_t{1} << j % kWord;
    }
    /// visit(i) for those of row j from column `first` to `last`, in increasing order.
    template <class Visit>
    void in_row(std::uint32_t j, std::uint32_t first, std::uint32_t last, const Visit& visit) const {
        in_line(rows_.data() + std::size_t{j} * row_words_, first, last, visit);
    }
    /// visit(j) for those of column i from row `first` to `last`.
    template <class Visit>
    void in_column(std::uint32_t i, std::uint32_t first, std::uint32_t last, const Visit& visit) const {
        in_line(columns_.data() + std::size_t{i} * column_words_, first, last, visit);
    }

  private:
    template <class Visit>
    static void in_line(const std::uint64_t* words, std::uint32_t first, std::uint32_t last, const Visit& visit) {
        for (std::uint32_t w = first / kWord; w <= last / kWord; ++w) {
            std::uint64_t bits = words[w];
            if (w == first / kWord) bits &= ~std::uint64_t{0} << first % kWord;
            if (w == last / kWord) bits &= ~std::uint64_t{0} >> (kWord - 1 - last % kWord);
            for (; bits != 0; bits &= bits - 1)
                visit(kWord * w + static_cast<std::uint32_t>(std::countr_zero(bits)));
        }
    }

    std::uint32_t row_words_, column_words_;
    std::vector<std::uint64_t> rows_, columns_;
};

class TextureSegments {
  public:
    /// Precondition: validate_feature_curves finds nothing but in distances and gradients.
    explicit TextureSegments(const fetex::FeatureCurvesTexture& texture, unsigned threads = 1);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] const OccupiedTexels& occupied() const { return occupied_; }

    [[nodiscard]] bool has_profiles() const { return !profile_map_.empty(); }
    /// Of the point on an edge of texel (i,j). Precondition: has_profiles.
    [[nodiscard]] std::uint8_t profile(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        using enum fetex::FeatureEdge;
        const std::size_t corner =
            (std::size_t{j} + (e == South ? 1 : 0)) * (std::size_t{width_} + 1) + i + (e == East ? 1 : 0);
        return static_cast<std::uint8_t>(profile_map_[corner] >> (e == North || e == South ? 4 : 8) & 15u);
    }

    /// visit(segment) for those of texel (i,j), in the order of its configuration.
    template <class Visit> void visit_texel(std::uint32_t i, std::uint32_t j, const Visit& visit) const {
        const fetex::FeatureSegmentList list = fetex::feature_unpack(configurations_[texel(i, j)]);
        for (std::uint32_t k = 0; k < list.count; ++k)
            visit(segment(i, j, k, list.segment[k]));
    }
    /// Segment 0 or 1 of texel (i,j), which has it.
    [[nodiscard]] TextureSegment segment(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return segment(i, j, k, fetex::feature_unpack(configurations_[texel(i, j)]).segment[k]);
    }

  private:
    [[nodiscard]] std::size_t texel(std::uint32_t i, std::uint32_t j) const { return std::size_t{j} * width_ + i; }
    [[nodiscard]] TextureSegment segment(std::uint32_t i, std::uint32_t j, std::uint32_t k,
                                         fetex::FeatureSegment edges) const {
        TextureSegment s{point(i, j, edges.first), point(i, j, edges.second), {}, edges};
        if (!middles_.empty()) s.middle = middles_[2 * texel(i, j) + k];
        return s;
    }
    void add_row(const fetex::FeatureCurvesTexture& texture, std::uint32_t j);
    /// Middle points of a texel's curves.
    void bend(const fetex::FeatureCurvesTexture& texture, std::uint32_t i, std::uint32_t j);

    [[nodiscard]] CanvasPoint point(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        const std::size_t corner = std::size_t{j} * (std::size_t{width_} + 1) + i;
        const double x = i, y = j;
        switch (e) {
        case fetex::FeatureEdge::North:
            return {x + north_[corner], y};
        case fetex::FeatureEdge::East:
            return {x + 1, y + west_[corner + 1]};
        case fetex::FeatureEdge::South:
            return {x + north_[corner + width_ + 1], y + 1};
        default:
            return {x, y + west_[corner]};
        }
    }

    std::uint32_t width_, height_;
    std::span<const fetex::FeatureConfiguration> configurations_;
    std::span<const std::uint16_t> profile_map_;      ///< the texture's; corners' profiles aren't looked at
    std::vector<double> north_, west_;                ///< positions, by the texels' upper left corners
    std::vector<std::optional<CanvasPoint>> middles_; ///< two a texel; none in a linear texture
    OccupiedTexels occupied_;
};

} // namespace fetexc
