// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers of all errors and diagnostics. A number never changes its meaning; README.md lists them for users.
/// 1xxx input/front end errors, 2xxx front end warnings, 3xxx scene, 4xxx geometry and planar map, 5xxx representations,
/// 6xxx container and validation, 7xxx runtime (GL), 8xxx command line and I/O.
#pragma once

namespace fetexc::diag {

// Scene (owner: compiler/scene)
inline constexpr int kSceneExtentInvalid = 3001;     ///< canvas size not finite, not positive, or beyond double precision
inline constexpr int kSceneCoordinateInvalid = 3002; ///< a coordinate of a path is NaN or infinite, or a degree is not 1…3
inline constexpr int kSceneReferenceInvalid = 3003;  ///< the compositing tree is inconsistent: index out of range, cycle, bad nesting
inline constexpr int kSceneTooLarge = 3004;          ///< beyond a limit of the scene: segments, nesting depth, nested masks
inline constexpr int kScenePaintInvalid = 3005;      ///< a paint holds a non-finite number or a bitmap of the wrong length

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
inline constexpr int kOutOfMemory = 8051;         ///< the machine has no more memory
inline constexpr int kInternal = 8052;            ///< an error of the program itself

// Container, seen from the command line; the findings themselves are F numbers (formats/findings.h)
inline constexpr int kInvalidFetex = 6001;          ///< the .fetex file breaks a rule of SPEC.md
inline constexpr int kNoSuchRepresentation = 6002;  ///< the file is fine but holds no FBT

} // namespace fetexc::diag
