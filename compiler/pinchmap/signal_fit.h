// SPDX-License-Identifier: GPL-3.0-or-later
/// The signal of a pinchmap (Tarini and Cignoni 2005, §7.2 step 5).
#pragma once

#include <cstdint>

#include "compiler/bilevel/silhouette.h"
#include "compiler/pinchmap/painted_rows.h"
#include "formats/pinchmap.h"

namespace fetexc {

struct SignalFit {
    std::uint64_t rounds = 0;      ///< of conjugate gradients
    std::uint64_t unseen = 0;      ///< samples that no point reads: like those beside them on their side
    double lost = 0;               ///< part of the drawing that lies far inside the other side's zone: it is blurred
    double lost_u = 0, lost_v = 0; ///< 0 … 1: a point of it
};

/// Points along each side of a cluster that the signal is fitted to. scale: K.
std::uint32_t signal_points(std::uint32_t scale);

/// Sets the samples of a texture with a map: those that, read at g of each point (§7.2: g(p) is where the sampler reads
/// for p) and interpolated, come nearest to the drawing's colours by least squares. (The paper takes means around
/// g⁻¹ of a sample, which beside a discontinuity are those of one half of it.) A point counts only
/// where the map and the drawing have it on one side; so no colour gets across, but for what is lost far inside a zone,
/// and where the strength is below 1. In clusters without an edge of the drawing others hardly count, but they do.
/// paint: of width · signal_points × height · signal_points. The same for any number of threads.
SignalFit fit_signal(fetex::PinchmapTexture& texture, const Silhouette& silhouette, const RowPainter& paint,
                     unsigned threads);

} // namespace fetexc
