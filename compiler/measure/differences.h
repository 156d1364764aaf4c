// SPDX-License-Identifier: GPL-3.0-or-later
/// Two pictures against each other, where there is no scene to say what is right: no edges, no classes, only colours.
#pragma once

#include <vector>

#include "compiler/measure/picture.h"

namespace fetexc::measure {

/// At one output size; sample points as in measure/errors.h. Differences are the largest of a channel, of premultiplied
/// RGBA, 0…1.
struct PictureDifference {
    GridSize pixels;
    double different_ppm = 0; ///< share of sample points that differ by more than 1/255
    double max = 0, mean = 0;
    TexturePoint place; ///< of max
    double psnr = 0;    ///< dB, of the box means, over black and over white; infinite for equal pictures
};

/// How means over pixels are found that aren't as good as linear.
enum class PixelMeans : std::uint8_t {
    Jumps,  ///< pictures of few colours: exact where they change (measure/pixel_means.h)
    Smooth, ///< pictures that change everywhere: at 4 × 4 points, the same of all pictures
};

/// pixels: 1 … 16384 on each side. The same figures for any number of threads.
PictureDifference difference(const Picture& a, const Picture& b, GridSize pixels, unsigned threads,
                             PixelMeans means = PixelMeans::Jumps);

/// What difference() takes of a picture at an output size: several may be held against one.
struct PictureSamples {
    GridSize pixels;
    std::vector<Rgba> points; ///< at the sample points, row-major
    std::vector<Rgba> means;  ///< box_means
};
PictureSamples samples_of(const Picture& picture, GridSize pixels, unsigned threads, PixelMeans means);
/// Precondition: of the same size.
PictureDifference difference(const PictureSamples& a, const PictureSamples& b);

/// Box means of all pixels, row-major. Edges that neither a pixel's corners nor its centre betray are missed.
std::vector<Rgba> box_means(const Picture& picture, GridSize pixels, unsigned threads,
                            PixelMeans means = PixelMeans::Jumps);

/// Mean square error of r, g, b over black and over white.
double mean_square_error(const std::vector<Rgba>& a, const std::vector<Rgba>& b);

} // namespace fetexc::measure
