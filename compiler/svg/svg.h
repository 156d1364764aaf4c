// SPDX-License-Identifier: GPL-3.0-or-later
/// The SVG front end: SVG or SVGZ bytes to a scene (DESIGN §4).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compiler/raster/feature_scene.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Beyond a limit load_svg() gives error 1005 … 1012; it never hangs or takes memory without bound.
struct SvgLimits {
    std::uint64_t bytes = std::uint64_t{64} << 20;         ///< of the file and of embedded SVGs, unpacked
    std::uint64_t elements = 1'000'000;                    ///< in the XML, and after expanding all references
    std::uint64_t segments = 4'000'000;                    ///< Bezier segments, after stroking
    std::uint64_t raster_bytes = std::uint64_t{256} << 20; ///< RGBA bytes of raster layers and bitmaps
    std::uint32_t nesting = 500;                           ///< counted through references; at most 1000
    std::uint32_t milliseconds = 30'000;
};

struct SvgOptions {
    std::vector<std::filesystem::path> font_files; ///< without fonts text is not drawn (warning 2001)
    bool system_fonts = false;                     ///< scan the fonts of the machine
    std::string default_family;                    ///< for unknown families; empty: that of the first font file
    double dpi = 96;                               ///< for mm, pt and the like; 10 … 4000
    /// Folder from which bitmaps named by the drawing may be read; empty: no file is read.
    std::filesystem::path resources_dir;
    std::uint32_t raster_pixels = 1024; ///< resolution of raster layers: pixels on the larger canvas side, 16 … 16384
    unsigned threads = 1;               ///< 0: all; never changes the scene
    SvgLimits limits;
    bool cull = true; ///< SkipRules::layers
};

/// Everything visible becomes fills of canvas-space paths (strokes outlined, text to outlines), hard gradient edges
/// become geometry, and what can't be vector becomes a raster layer. `diagnostics` gets warnings (2001 …) and notes
/// (2101 …) that name the element; they are appended also when the result is an error. Bytes may be untrusted.
/// Thread-safe.
///
/// On error 1009 (time) a library that can't be interrupted may go on working in the background until it ends.
Result<Scene> load_svg(std::span<const std::uint8_t> bytes, const SvgOptions& options,
                       std::vector<Diagnostic>& diagnostics);

/// What of a drawing is taken. Edges are those of fills, hidden ones too; middles of strokes may be open.
enum class SvgCurves {
    Features, ///< edges, those of stroke outlines too, but middles for the strokes of shapes without fill
    Edges,    ///< edges, those of stroke outlines too
    Strokes,  ///< middles of all strokes
    All,      ///< edges, middles of all strokes
};

/// The drawing as curves; bitmaps have none. Frame: the drawing's canvas. Clips and masks are not applied (warning
/// 2053). Otherwise as load_svg.
Result<FeatureCurves> load_svg_features(std::span<const std::uint8_t> bytes, const SvgOptions& options,
                                        std::vector<Diagnostic>& diagnostics, SvgCurves which = SvgCurves::Features);

} // namespace fetexc
