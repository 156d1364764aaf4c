// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The GLSL library as text, put together for a dialect and specialised to an asset. The same text lies in the folder
/// above as plain files.
#pragma once

#include <cstdint>
#include <string>

#include "formats/bilevel.h"
#include "formats/fbt.h"
#include "formats/feature_curves.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"
#include "runtime_glsl/host/image.h"

namespace fetex {

struct Field;

enum class Dialect : std::uint8_t { Glsl330, Glsl430, Essl300, Vulkan450 };
inline constexpr Dialect kDialects[] = {Dialect::Glsl330, Dialect::Glsl430, Dialect::Essl300, Dialect::Vulkan450};

/// "330", "430", "300es", "vulkan450".
const char* dialect_name(Dialect dialect);

/// #version, precision, and the macros that hide the dialects' differences. texture_buffer: records in a texture
/// buffer; not in Essl300, which has none.
std::string shader_prelude(Dialect dialect, bool texture_buffer = false);

/// The sample format, and the macros that leave out of the sampler what an asset doesn't need. "" instead leaves
/// everything in, for RGBA8.
std::string fbt_specialisation(const FbtTraits& traits, FbtSampleFormat format = FbtSampleFormat::Rgba8);

/// Prelude, specialisation, fetex_fbt.glsl and, to be followed by a fragment shader: for area sampling
/// fetex_fbt_area.glsl; if the texture has a mip chain, that, fetex_levels.glsl and fetex_fbt_mip.glsl, whose level 0
/// then is exact unless the filter is Area. Only the traits and the sample format of the texture are looked at, and
/// whether it has a chain.
std::string fbt_library_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer = false,
                               Filter filter = Filter::Point);

/// The macros that fit fetex_bilevel.glsl to an asset, its colours among them. filtered: one fetch through the
/// hardware's filter. Only the rule and the colours of the texture are looked at, and whether it has levels and an
/// image.
std::string bilevel_specialisation(const BilevelTexture& texture, bool filtered = false);

/// Prelude, specialisation, fetex_levels.glsl and fetex_bilevel.glsl, to be followed by a fragment shader.
std::string bilevel_library_source(Dialect dialect, const BilevelTexture& texture, bool filtered = false);

/// The macros that fit fetex_silmap.glsl to an asset. Only the formats of the texture are looked at, and whether it has
/// levels.
std::string silmap_specialisation(const SilmapTexture& texture, SilmapFilter filter = SilmapFilter::Filtered);

/// Prelude, specialisation and fetex_silmap.glsl, to be followed by a fragment shader.
std::string silmap_library_source(Dialect dialect, const SilmapTexture& texture,
                                  SilmapFilter filter = SilmapFilter::Filtered);

/// The macros that fit fetex_pinchmap.glsl to an asset. filtered: one fetch a texture through the hardware's filter.
/// Only scale, formats and line of the texture are looked at, and whether it has levels.
std::string pinchmap_specialisation(const PinchmapTexture& texture, bool filtered = false);

/// Prelude, specialisation, fetex_levels.glsl and fetex_pinchmap.glsl, to be followed by a fragment shader.
std::string pinchmap_library_source(Dialect dialect, const PinchmapTexture& texture, bool filtered = false);

/// What shaders depend on of a texture with feature curves.
struct FeatureCurvesTraits {
    FeatureKind kind = FeatureKind::Color;
    FeatureSampleFormat base_format = FeatureSampleFormat::Rgba8;
    float distance_limit = 1, height_scale = 1;
    bool linear = false, bits16 = false; ///< of its numbers
    bool gradients = false, one_sample = false, mips = false;
    std::uint32_t segments = 0; ///< most in a texel
    std::uint32_t profiles = 1;
    bool curves = false, open = false; ///< some segment isn't straight; some edge is open
    friend bool operator==(const FeatureCurvesTraits&, const FeatureCurvesTraits&) = default;
};
FeatureCurvesTraits feature_curves_traits(const FeatureCurvesTexture& texture);

/// The macros that fit fetex_feature_curves.glsl to an asset.
std::string feature_curves_specialisation(const FeatureCurvesTraits& traits);

/// Prelude, specialisation, with levels fetex_levels.glsl, and fetex_feature_curves.glsl, to be followed by a fragment
/// shader.
std::string feature_curves_library_source(Dialect dialect, const FeatureCurvesTraits& traits);

/// Complete shaders of the host: a triangle over the viewport, the FBT, the FBT with its mip chain, the bi-level
/// texture without its levels (Point: cut hard, else softly) and with them, the silhouette-map texture likewise (Point:
/// at points, else over pixels), the pinchmap and the texture with feature curves likewise, the bitmap in full
/// precision, the bitmap through the hardware filter, and a one-channel field (renderer.h).
std::string view_vertex_source(Dialect dialect);
std::string fbt_fragment_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer = false,
                                Filter filter = Filter::Point);
std::string fbt_mip_fragment_source(Dialect dialect, const FbtTexture& texture, bool texture_buffer = false,
                                    Filter filter = Filter::Point);
std::string bilevel_fragment_source(Dialect dialect, const BilevelTexture& texture, Filter filter = Filter::Point,
                                    bool filtered = false);
std::string bilevel_mip_fragment_source(Dialect dialect, const BilevelTexture& texture, bool filtered = false);
std::string silmap_fragment_source(Dialect dialect, const SilmapTexture& texture, Filter filter = Filter::Point,
                                   SilmapFilter silmap_filter = SilmapFilter::Filtered);
std::string silmap_mip_fragment_source(Dialect dialect, const SilmapTexture& texture,
                                       SilmapFilter silmap_filter = SilmapFilter::Filtered);
std::string pinchmap_fragment_source(Dialect dialect, const PinchmapTexture& texture, Filter filter = Filter::Point,
                                     bool filtered = false);
std::string pinchmap_mip_fragment_source(Dialect dialect, const PinchmapTexture& texture, bool filtered = false);
std::string feature_curves_fragment_source(Dialect dialect, const FeatureCurvesTraits& traits,
                                           Filter filter = Filter::Point);
std::string feature_curves_mip_fragment_source(Dialect dialect, const FeatureCurvesTraits& traits);
std::string bitmap_fragment_source(Dialect dialect);
std::string filtered_bitmap_fragment_source(Dialect dialect);
std::string field_fragment_source(Dialect dialect, const Field& field);

} // namespace fetex
