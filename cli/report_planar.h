// SPDX-License-Identifier: GPL-3.0-or-later
/// What reports say of a planar map.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compiler/compile.h"

namespace fetexc::cli {

/// Several lines.
std::string planar_text(const PlanarStats& stats);
nlohmann::ordered_json planar_json(const PlanarStats& stats);

/// Percent.
double share(std::uint64_t part, std::uint64_t whole);

} // namespace fetexc::cli
