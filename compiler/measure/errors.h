// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors of a picture against the truth. One set of definitions for assets, bitmaps and every alternative. README.md
/// says how far each figure can be off.
///
/// *Sample points.* One in each pixel of an output size, at a place in it chosen by a fixed hash: no edge is in step
/// with them.
/// *Class.* A sampled colour is taken for the result that it is nearest to (Euclidean distance of premultiplied RGBA),
/// among the truth's result at the point and the results on both sides of every visible edge within `reach`, each with
/// the colour it would have at the point; a tie goes to the truth, and so do results that differ from it by less than
/// `min_contrast` there. For two solid colours that is the threshold halfway between them.
/// *Misclassified area.* The share of sample points whose class is not the truth's result.
/// *Boundary distance.* To the truth: points where the picture's class changes between neighbouring sample points,
/// found by bisection, to the nearest visible edge. To the picture: points along the visible edges, about a
/// pixel apart and weighted by the length they stand for, to the nearest change of the picture between the edge's two
/// results along the edge's normal, or to the lines that join the changes found between sample points where those are
/// nearer by more than an eighth of a pixel. Both up to `reach`; edges with less contrast than `min_contrast` are left
/// out and counted. *PSNR.* 10·log10(1 / mean square error) of the anti-aliased picture, the box mean over each pixel
/// (of the picture: supersampled), against the exactly integrated truth; over r, g, b, composited over black and over
/// white. *Colour error.* Largest difference of a channel (premultiplied RGBA), at sample points farther than a texel
/// from every visible edge. *Islands.* Connected sets of sample points (four neighbours) of one class. Lost: one of the
/// truth that the picture has nowhere: neither at its points nor around them, within a pixel (asked at 32 × 32 places),
/// is its class nearer than the one that the picture has at the point. False: one of the picture whose result the truth
/// has nowhere, asked at the same places. Wrong colours farther than `reach` from all edges are colour errors, not
/// islands.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/measure/picture.h"
#include "compiler/measure/truth.h"

namespace fetexc::measure {

/// Which figures are wanted; the others cost nothing.
struct Figures {
    bool misclassified = true, boundary = true, psnr = true, away = true, islands = true;

    static constexpr Figures none() { return {false, false, false, false, false}; }
    /// Those that take the truth and the picture at every sample point.
    [[nodiscard]] bool samples() const { return misclassified || boundary || away || islands; }
};

struct MeasureOptions {
    std::vector<GridSize> sizes;     ///< output sizes in pixels, 1 … 16384 on each side
    double reach = 1.5;              ///< texels
    double min_contrast = 4.0 / 255; ///< largest difference of a channel across an edge
    unsigned supersample = 8; ///< intervals of a line through a pixel that an edge crosses (measure/pixel_means.h)
    unsigned threads = 0;     ///< never changes the figures
    Figures figures;
};

/// In width units.
struct Distances {
    double mean = 0, p95 = 0, hausdorff = 0;
    std::uint64_t points = 0;
    std::uint64_t beyond_reach = 0; ///< counted with `reach`
    WidthPoint farthest;
};

struct Islands {
    std::uint64_t lost = 0, invented = 0;
    double largest_ppm = 0; ///< area of the largest of both
    TexturePoint place;     ///< a point of that one
};

struct ColorError {
    double max = 0, mean = 0; ///< 0…1
    std::uint64_t points = 0;
    TexturePoint place; ///< of max
};

/// At one output size. Of figures that weren't wanted: NaN in each `double` but places, 0 in each count.
struct SizeErrors {
    GridSize pixels;
    double pixels_per_texel = 0;
    double misclassified_ppm = 0;
    double misclassified_error_ppm = 0; ///< of sampling: one standard deviation
    TexturePoint misclassified_place;   ///< the first one, by rows of pixels
    Distances to_truth, to_picture;
    double psnr = 0; ///< dB; infinite for equal pictures
    ColorError away;
    Islands islands;
    std::uint64_t edges_without_contrast = 0;
};

class TruthSamples;

/// Several pictures against one truth: what figures need of the truth alone is found once. Const members are
/// thread-safe.
class Measurer {
  public:
    /// The truth must outlive it. Errors: as Truth::picture's.
    static Result<Measurer> of(const Truth& truth, MeasureOptions options);
    ~Measurer();
    Measurer(Measurer&&) noexcept;
    Measurer& operator=(Measurer&&) noexcept;

    /// One entry for each size.
    [[nodiscard]] std::vector<SizeErrors> measure(const Picture& picture) const;

  private:
    Measurer(const Truth& truth, MeasureOptions options);
    const Truth* truth_;
    MeasureOptions options_;
    std::vector<TruthSamples> samples_; ///< of each size
};

/// Of one picture, one size after the other: less memory than a Measurer of all sizes.
Result<std::vector<SizeErrors>> measure(const Truth& truth, const Picture& picture, const MeasureOptions& options);

} // namespace fetexc::measure
