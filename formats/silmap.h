// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Silhouette-map texture: a bitmap, and a grid of points and boundary bits that says where its colours end; the layout
/// and the CPU reference sampler. P. Sen, "Silhouette Maps for Improved Texture Magnification", Graphics Hardware 2004.
/// Normative text: formats/SPEC.md, sections 2.5 and 7.
///
/// Frames: texel space, x right, y down, [0,W]×[0,H] is the drawing. A texel's colour stands in its middle,
/// (i+1/2, j+1/2). Cells are shifted by half a texel: cell (i,j), 0 … W by 0 … H, covers [i-1/2, i+1/2) ×
/// [j-1/2, j+1/2); its corners are the middles of texels i-1 and i by j-1 and j. Inside a cell a point is local,
/// 0 … 1 from its upper left corner. Beyond the border texels and cells repeat: a border cell's point stands at the
/// same place of the cell that isn't there, with the same bits. Points anywhere are allowed, and count as the nearest
/// one of the drawing.
///
/// A cell's point and those of its four neighbours are joined by straight links, of which a *boundary* separates the
/// two corners on its sides. The links divide the cell into four skewed quadrants, each with one corner (the paper,
/// §2). What lies on a link lies south of it (east and west links), or east of it (north and south links).
///
/// Colours are premultiplied and sRGB-encoded.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/fbt.h"

namespace fetex {

/// How a cell is packed, low to high: steps of x, steps of y, east, south.
enum class SilmapCellFormat : std::uint32_t {
    Bits8 = 0,  ///< 3 + 3 + 1 + 1 bits: the paper's byte (§2.4)
    Bits16 = 1, ///< 7 + 7 + 1 + 1 bits
};

/// The bitmap's samples. 0 to 2 are those of FbtSampleFormat.
enum class SilmapSampleFormat : std::uint32_t {
    Rgba8 = 0,
    Rgba16 = 1,
    Rgba16F = 2,
    Rgb8 = 3, ///< opaque; in memory RGBA8 with alpha 255, in the file three bytes
};

/// As what samples are packed in memory: fbt_pack_sample, fbt_sample_channels, fbt_sample_words take it.
inline FbtSampleFormat silmap_fbt_format(SilmapSampleFormat format) {
    return format == SilmapSampleFormat::Rgb8 ? FbtSampleFormat::Rgba8 : static_cast<FbtSampleFormat>(format);
}

struct SilmapCell {
    std::uint32_t x = 0, y = 0;       ///< the point, in steps: 0 … silmap_steps − 1
    bool east = false, south = false; ///< boundary between this point and that of the neighbour
    friend bool operator==(const SilmapCell&, const SilmapCell&) = default;
};

/// Of a coordinate.
inline unsigned silmap_step_bits(SilmapCellFormat format) { return format == SilmapCellFormat::Bits8 ? 3 : 7; }
/// Steps across a cell, 8 or 128.
inline std::uint32_t silmap_steps(SilmapCellFormat format) { return 1u << silmap_step_bits(format); }
/// Where a step is in the cell, (step + 1/2) / steps; exact.
inline double silmap_position(SilmapCellFormat format, std::uint32_t step) {
    return (step + 0.5) / silmap_steps(format);
}
/// The step nearest to a local coordinate, ties up; outside 0 … 1 the first or the last.
inline std::uint32_t silmap_step(SilmapCellFormat format, double position) {
    const std::uint32_t steps = silmap_steps(format);
    if (!(position > 0)) return 0;
    return position < 1 ? static_cast<std::uint32_t>(position * steps) : steps - 1;
}
/// Precondition: x and y below silmap_steps.
std::uint16_t silmap_pack_cell(SilmapCellFormat format, const SilmapCell& cell);
SilmapCell silmap_unpack_cell(SilmapCellFormat format, std::uint16_t packed);

/// Owning silhouette-map texture. validate_silmap (formats/validate.h) checks the invariants; a reader calls it before
/// anything is sampled.
struct SilmapTexture {
    std::uint32_t width = 0, height = 0; ///< texels, 1 … 16384
    SilmapCellFormat cell_format = SilmapCellFormat::Bits8;
    SilmapSampleFormat sample_format = SilmapSampleFormat::Rgba8;
    std::vector<std::uint16_t> cells;  ///< (width+1)·(height+1), packed, row by row
    std::vector<std::uint32_t> colors; ///< width·height samples, packed, row by row
    /// Empty, or levels 1 … n (fbt_mip_level(width, height, k) gives their sizes and where they begin), RGBA8, row by
    /// row.
    std::vector<std::uint32_t> mips;
};

/// Cells across and down.
inline std::uint32_t silmap_columns(const SilmapTexture& t) { return t.width + 1; }
inline std::uint32_t silmap_rows(const SilmapTexture& t) { return t.height + 1; }

/// Bytes of cells, bitmap and mip levels, as the file has them. (Some GPUs keep three bytes as four.)
std::uint64_t silmap_gpu_bytes(const SilmapTexture& t);

/// Corners of a cell; bit 0: east, bit 1: south. A set of corners has bit 1 << corner for each.
inline constexpr std::uint32_t kSilmapNW = 0, kSilmapNE = 1, kSilmapSW = 2, kSilmapSE = 3;
/// Links of a cell: indices, and as 1 << link members of a set.
inline constexpr std::uint32_t kSilmapWest = 0, kSilmapNorth = 1, kSilmapEast = 2, kSilmapSouth = 3;

struct SilmapPoint {
    double x = 0, y = 0;
};

/// What of the map concerns a cell, in its local frame.
struct SilmapShape {
    SilmapPoint point;                 ///< 0 … 1
    std::array<SilmapPoint, 4> across; ///< the neighbours' points by link: west −1 … 0 by 0 … 1, and so on
    std::uint32_t boundaries = 0;      ///< set of links
};
/// i 0 … width, j 0 … height; more count as these.
SilmapShape silmap_shape(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j);

/// The corner whose skewed quadrant holds a point of the cell, local 0 … 1.
std::uint32_t silmap_quadrant(const SilmapShape& shape, double x, double y);

/// The set of corners that a point of the corner's quadrant is filtered from (the paper's rules, §2.1): the corner;
/// a corner next to it, if the link between isn't a boundary; the one across, if neither link is on one of the two
/// ways.
std::uint32_t silmap_reachable(std::uint32_t corner, std::uint32_t boundaries);

/// Weights of the corners of a set at a point of the cell, local 0 … 1: not negative, they add up to 1. One corner: its
/// own colour; two: linear along their side; four: bilinear; three: linear (the plane through them), a point beyond the
/// diagonal of the triangle counting as the nearest one on it. Precondition: one of the 13 sets that silmap_reachable
/// gives: not empty, not two corners across.
std::array<double, 4> silmap_weights(std::uint32_t corners, double x, double y);

/// Part of the plane in a cell's local frame.
struct SilmapBox {
    double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
};
/// The area that the quadrant of each corner has of a box in the cell; they add up to the box's. Precondition: 0 ≤ x0 ≤
/// x1 ≤ 1, likewise y.
std::array<double, 4> silmap_areas(const SilmapShape& shape, const SilmapBox& box);

/// Nearest: a point has the colour of its corner. Filtered: interpolated between the corners it reaches.
enum class SilmapFilter { Nearest, Filtered };

/// Where a point fell.
struct SilmapRegion {
    std::uint32_t i = 0, j = 0;  ///< the cell
    double x = 0, y = 0;         ///< local
    std::uint32_t corner = 0;    ///< of its quadrant
    std::uint32_t reachable = 0; ///< set of corners
};
SilmapRegion silmap_locate(const SilmapTexture& texture, double x, double y);
/// As silmap_locate, for a point given as texel (i,j) of the texture plus local offset in [0,1] (deep zoom).
SilmapRegion silmap_locate_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// The colour at a point.
FbtColor silmap_sample(const SilmapTexture& texture, double x, double y, SilmapFilter filter = SilmapFilter::Filtered);
FbtColor silmap_sample_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                             SilmapFilter filter = SilmapFilter::Filtered);

/// The sides of a pixel along x and y, in texels, kSilmapSmallestPixel … 1; less and more count as these.
inline constexpr double kSilmapSmallestPixel = 0x1p-15;
struct SilmapPixel {
    double width = 0, height = 0;
};

/// The colour of a pixel around a point: the mean over it. Each quadrant counts with its area, exactly, with the colour
/// that it has in the middle of what the pixel has of the cell: exact but for filtered quadrants that a link cuts.
FbtColor silmap_sample_area(const SilmapTexture& texture, double x, double y, SilmapPixel pixel,
                            SilmapFilter filter = SilmapFilter::Filtered);
FbtColor silmap_sample_area_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                  SilmapPixel pixel, SilmapFilter filter = SilmapFilter::Filtered);

/// The colour of a pixel of any size around a point, sides as in SilmapPixel but without its upper bound. Trilinear:
/// the levels between whose scales (fbt_mip_scale) the longer side lies, mixed by its logarithm, as fbt_sample_mip
/// does. Level 0 is silmap_sample_area over the pixel, sides of at most 1. Continuous in the sides. Precondition: the
/// texture has mips.
FbtColor silmap_sample_mip(const SilmapTexture& texture, double x, double y, SilmapPixel pixel,
                           SilmapFilter filter = SilmapFilter::Filtered);

/// The mip chain of a texture, from what it shows (the paper, §2.2): each texel the mean of the quadrants' colours by
/// their areas, filtered, each sample of a level the mean of its share of the texels. Packed as SilmapTexture::mips;
/// what exceeds 1 or alpha is clipped. mips of the texture are not looked at.
std::vector<std::uint32_t> silmap_make_mips(const SilmapTexture& texture);

} // namespace fetex
