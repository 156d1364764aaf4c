// SPDX-License-Identifier: GPL-3.0-or-later
/// The mip chain of an FBT (formats/fbt_mip.h): each sample the mean colour of the drawing over what it stands for.
#pragma once

#include <vector>

#include "compiler/compile.h"
#include "compiler/planar/planar_map.h"
#include "compiler/scene/compositor.h"

namespace fetexc {

/// All levels, for FbtTexture::mips. A level is summed, in double, from a finer level or the planar map wherever its
/// samples are whole blocks of theirs; else (a side that isn't a multiple of it) a planar map of its own is integrated.
/// Quantised once. Same bytes for any thread count.
Result<std::vector<std::uint32_t>> build_mips(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                              const CompileOptions& options, MipStats& stats);

/// The same of a texture that no drawing tells the colours of: texels' means by exact area sampling (a region with the
/// colour in the middle of what it has of a texel), spread evenly over the texel where a sample ends inside it. A level
/// whose samples are whole blocks of a finer level's is summed from those, in double.
std::vector<std::uint32_t> mips_of_texture(const fetex::FbtTexture& texture, unsigned threads, MipStats& stats);

} // namespace fetexc
