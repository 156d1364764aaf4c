// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of all errors and diagnostics. A number never changes its meaning; README.md lists them for users.
/// 1xxx input/front end errors, 2xxx front end warnings, 3xxx scene, 4xxx geometry and planar map, 5xxx representations,
/// 6xxx container and validation, 7xxx runtime (GL), 8xxx command line and I/O.
#pragma once

namespace fetexc::diag {

// Geometry and planar map (owner: compiler/geometry, compiler/planar)
inline constexpr int kPlanarInconsistent = 4001;   ///< an internal invariant of the planar map failed; nothing is written
inline constexpr int kTooManyIntersections = 4002; ///< limit on arrangement size exceeded
inline constexpr int kSliversCollapsed = 4101;     ///< regions thinner than the output grid were collapsed (count)

// Representations (owner: compiler/fbt)
inline constexpr int kSizeOutOfRange = 5001; ///< --size outside 1 … 16384 texels
inline constexpr int kFbtTooLarge = 5002;    ///< more records than the format can address

} // namespace fetexc::diag
