// SPDX-License-Identifier: GPL-3.0-or-later
/// What `fetexc info` says of each representation.
#pragma once

#include <nlohmann/json.hpp>

#include "formats/bilevel.h"
#include "formats/fbt.h"
#include "formats/fbt_mip.h"
#include "formats/feature_curves.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"

namespace fetexc::cli {

using Json = nlohmann::ordered_json;

/// As cli/schema/info.schema.json has it. stats: of an FBT, the tables of the paper too.
Json info_json(const fetex::FbtTexture& texture, bool stats);
Json info_json(const fetex::BilevelTexture& texture);
Json info_json(const fetex::SilmapTexture& texture);
Json info_json(const fetex::PinchmapTexture& texture);
Json info_json(const fetex::FeatureCurvesTexture& texture);

/// For people, to stdout.
void print_info(const fetex::FbtTexture& texture, bool stats);
void print_info(const fetex::BilevelTexture& texture);
void print_info(const fetex::SilmapTexture& texture);
void print_info(const fetex::PinchmapTexture& texture);
void print_info(const fetex::FeatureCurvesTexture& texture);

/// Above level 0; 0: none.
template <class Texture> std::uint32_t mip_levels_of(const Texture& texture) {
    return texture.mips.empty() ? 0 : fetex::fbt_mip_levels(texture.width, texture.height);
}

} // namespace fetexc::cli
