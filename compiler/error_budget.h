// SPDX-License-Identifier: GPL-3.0-or-later
/// Every tolerance of the compiler, named, with its unit and where it comes from. Nothing else decides "close enough".
#pragma once

namespace fetexc::budget {

/// Unit roundoff of double: |fl(a∘b) − a∘b| ≤ kUnitRoundoff·|a∘b|.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Lattice steps; end points closer than this are one vertex: 2^-20 of the extent of 2^26 steps (DESIGN §3).
inline constexpr double kMergeDistance = 64.0;

/// Arcs become cubics that stay within this many lattice steps of the true arc (one step, DESIGN §4).
inline constexpr double kArcTolerance = 1.0;

/// Stroke outlines: largest distance, in lattice steps, between the cubic outline and the true offset curve.
inline constexpr double kStrokeTolerance = 1.0;

/// Texels; one step of the u16 output grid on [-1/2, 3/2).
inline constexpr double kOutputStep = 0x1p-15;

/// Texels; a sampled point farther than this from every edge is in the right region: half a diagonal of the output grid
/// (2^-16·√2) for a control point, the same again for the f32 evaluation and the parameter stop of the sampler (DESIGN §7).
inline constexpr double kRegionTolerance = 0x1p-14;

} // namespace fetexc::budget
