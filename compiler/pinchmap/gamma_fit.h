// SPDX-License-Identifier: GPL-3.0-or-later
/// Where in its zones a pinchmap's discontinuities run (Tarini and Cignoni 2005, §7.2 step 4).
///
/// They are where kB = γB, both bilinear between map texels: the line at one half of (1 + k − γ)/2, whose texels stand
/// at corners of clusters. So the fits of bi-level textures do it, with the bounds that |γ| < 1 sets for each texel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/contour_fit.h"
#include "compiler/bilevel/silhouette.h"
#include "compiler/bilevel/value_levels.h"
#include "compiler/pinchmap/zone_mask.h"
#include "compiler/solver/solver.h"
#include "formats/pinchmap.h"

namespace fetexc {

/// How (1 + k − γ)/2 is stored: offsets are k/2, and what is stored is steps less the map's own number of γ.
class PinchLevels {
  public:
    PinchLevels(std::span<const fetex::PinchmapTexel> map, fetex::PinchmapFormat format);

    [[nodiscard]] const ValueLevels& levels() const { return levels_; }
    [[nodiscard]] double gamma(std::uint16_t stored) const;
    [[nodiscard]] std::vector<std::uint16_t> stored(std::span<const fetex::PinchmapTexel> map) const;
    /// Of the map's own γ.
    [[nodiscard]] std::vector<float> values(std::span<const fetex::PinchmapTexel> map) const;

  private:
    std::vector<float> offsets_;
    ValueLevels levels_;
};

/// A map of width × height clusters without γ, and the outline that its discontinuities should follow.
struct GammaProblem {
    const Silhouette& silhouette;
    std::uint32_t width = 0, height = 0; ///< clusters
    fetex::PinchmapFormat format = fetex::PinchmapFormat::Bits8;
    unsigned threads = 1; ///< 0: all; never changes a number
};

struct GammaFit {
    FitTrace trace; ///< part of the drawing on the wrong side, after each step (contour, then stored numbers)
    std::uint64_t texels_fitted = 0, contour_steps = 0, tried = 0;
    std::uint64_t thin_cells = 0; ///< clusters with a line that the outline crosses twice or more
    double wrong = 0;             ///< part of the drawing, along finer lines
};

/// Sets γ of the texels around discontinuities: from signed distances, which Ceres moves along scan lines until the
/// discontinuity lies on the outline, then number by number to the least wrong area.
GammaFit fit_gamma(const Solver& solver, const GammaProblem& problem, std::vector<fetex::PinchmapTexel>& map);

/// Number by number from the γ that the map has. fit: goes on.
void settle_gamma(const GammaProblem& problem, std::vector<fetex::PinchmapTexel>& map, GammaFit& fit);

/// Then out of the local minimum: so many of gamma_search.h's rounds a texel. fit: of fit_gamma, goes on.
void search_gamma(const GammaProblem& problem, std::uint32_t rounds, std::vector<fetex::PinchmapTexel>& map,
                  GammaFit& fit);

/// Of such rounds: what more of them win is less than a hundredth for twice the time.
inline constexpr std::uint32_t kGammaRounds = 16;

/// Part of the drawing that a map has on the wrong side, exact along `lines` scan lines a cluster; lines: a multiple
/// of 4.
double wrong_part(const GammaProblem& problem, std::span<const fetex::PinchmapTexel> map, std::uint32_t lines);

/// Of each map texel what it costs to lie inside a zone: how much more would be wrong if e = k − γ were just below or
/// above 0 there instead of on the side where it is, other texels as they are. Texels whose e no outline comes near:
/// far.
std::vector<SideCosts> side_costs(const GammaProblem& problem, std::span<const fetex::PinchmapTexel> map, double far);

/// Of each cluster, row by row, the part of it on the wrong side.
std::vector<double> wrong_in_clusters(const GammaProblem& problem, std::span<const fetex::PinchmapTexel> map);

/// Of each map texel, the square clusters on the wrong side in the clusters around it.
std::vector<double> wrong_around(const GammaProblem& problem, std::span<const fetex::PinchmapTexel> map);

} // namespace fetexc
