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

// Command line and files (owner: cli)
inline constexpr int kCannotOpen = 8001;          ///< an input can't be opened
inline constexpr int kCannotRead = 8002;          ///< an input can't be read
inline constexpr int kInputTooLong = 8003;        ///< an input is longer than the limit of bytes
inline constexpr int kCannotCreate = 8011;        ///< an output can't be created
inline constexpr int kCannotWrite = 8012;         ///< an output can't be written; what was there before is untouched
inline constexpr int kCannotMakeFolder = 8013;    ///< the output folder can't be made
inline constexpr int kWouldOverwriteInput = 8014; ///< the output is one of the inputs
inline constexpr int kSameOutputTwice = 8015;     ///< two inputs would be written to one file
inline constexpr int kDepfileName = 8021;         ///< a file name that a dependency file can't hold
inline constexpr int kCannotEncodePicture = 8031; ///< the picture can't be encoded
inline constexpr int kBadUsage = 8041;            ///< unknown option, bad value or combination

} // namespace fetexc::diag
