// SPDX-License-Identifier: GPL-3.0-or-later
/// What a user would pick instead of an FBT, made from the same truth: plain textures of one or four channels, as good
/// as a box filter or a distance transform in double makes them. All interpolate between texel centres in full
/// precision (a GPU's filter does worse) and repeat their edge.
///
/// - *Bitmap*: RGBA8, the exactly integrated picture (Truth::picture), premultiplied, sRGB-encoded.
/// - *Box threshold*: R8, the coverage of `above`, cut at 1/2 between two colours.
/// - *Distance field*: R8, signed distance of the texel's centre to the nearest visible edge, value 1/2 at the edge,
///   0 and 1 at half of `range` from it; cut at 1/2 like the threshold. The range counts the field's own texels, as
///   msdfgen's -pxrange does.
///
/// The last two need a scene of exactly two visible solid colours, transparent being one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compiler/measure/errors.h"
#include "compiler/measure/picture.h"
#include "compiler/measure/truth.h"
#include "compiler/result.h"

namespace fetexc::measure {

enum class Alternative : std::uint8_t { Bitmap, BoxThreshold, DistanceField };
inline constexpr std::array kAlternatives = {Alternative::Bitmap, Alternative::BoxThreshold,
                                             Alternative::DistanceField};

/// "bilinear RGBA8", "box threshold R8", "distance field R8".
const char* alternative_name(Alternative kind);
/// 4 or 1.
unsigned bytes_per_texel(Alternative kind);
/// "" or "not applicable: 5 colours", "not applicable: colours that vary".
std::string why_not(const Truth& truth, Alternative kind);

/// Texels between the values 0 and 1 of a distance field: 1/64 texel a step, and no edge farther than two texels from
/// a texel's centre has any influence.
inline constexpr double kDistanceRange = 4;

/// Largest grid of the aspect (height / width) whose texels take at most `bytes`, by its width; of width 1 where
/// nothing fits. Sides are at most 16384.
GridSize grid_of_bytes(double aspect, std::uint64_t bytes, unsigned bytes_per_texel);

/// A box threshold or a distance field.
class FieldPicture final : public Picture {
  public:
    /// values: row-major, top row first. below, above: premultiplied. range: of a distance field, else 0.
    FieldPicture(GridSize size, std::vector<std::uint8_t> values, Rgba below, Rgba above, double range);
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return size_; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return values_.size(); }

    [[nodiscard]] std::span<const std::uint8_t> values() const { return values_; }
    [[nodiscard]] Rgba below() const { return below_; }
    [[nodiscard]] Rgba above() const { return above_; }
    [[nodiscard]] double range() const { return range_; }

  private:
    GridSize size_;
    std::vector<std::uint8_t> values_;
    Rgba below_, above_;
    double range_;
};

/// A BitmapPicture (pictures.h) or a FieldPicture. Errors: those of Truth::picture; E8041 with why_not's text where
/// that isn't empty.
Result<std::unique_ptr<Picture>> make_alternative(const Truth& truth, Alternative kind, GridSize size, unsigned threads,
                                                  double range = kDistanceRange);

} // namespace fetexc::measure
