// SPDX-License-Identifier: GPL-3.0-or-later
/// Which region of which texel every pixel of an image lies in, and which regions reach each other (FBT §4.3, §4.4).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/compile.h"
#include "compiler/planar/reachability.h"

namespace fetexc {

/// A point in texels.
struct TexelPoint {
    double x = 0, y = 0;
};

/// Regions are numbered as the vertices of the reachability graph: every region of every texel is one.
struct ImageRegions {
    ReachabilityGraph graph;
    std::vector<std::uint32_t> region_of_pixel; ///< row by row
    std::vector<TexelPoint> inside;             ///< per region a point of it
    std::uint64_t floating = 0;                 ///< parts of features that split nothing in their texel
};

/// Centre of pixel k of `pixels`, in texels of `texels`.
inline double pixel_centre(std::uint32_t k, std::uint32_t pixels, std::uint32_t texels) {
    return (2.0 * k + 1) * texels / (2.0 * pixels);
}
/// First pixel whose centre lies in texel i or beyond.
inline std::uint32_t first_pixel(std::uint32_t i, std::uint32_t pixels, std::uint32_t texels) {
    const std::uint64_t n = std::uint64_t{2} * i * pixels, d = std::uint64_t{2} * texels;
    return static_cast<std::uint32_t>(n <= texels ? 0 : (n - texels + d - 1) / d);
}

/// map: of the picture's features. The same for any number of threads. Error kPlanarInconsistent.
Result<ImageRegions> find_image_regions(const FeaturedImage& picture, const PlanarMap& map,
                                        const CompileOptions& options);

} // namespace fetexc
