// SPDX-License-Identifier: GPL-3.0-or-later
/// One drawing under all checks: what the stress tests run and the minimiser asks again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tests/support/drawing.h"
#include "tests/support/map_check.h"

namespace fetexc::test {

/// What goes wrong; none when all is well. seed: of grids, points and angles.
using Failure = std::optional<std::string>;

struct StressCheck {
    const char* name;
    const char* what; ///< one line for people
    Failure (*run)(const Drawing& drawing, std::uint64_t seed);
};

/// "error", "map", "region", "moved", "canvas".
[[nodiscard]] std::span<const StressCheck> stress_checks();
[[nodiscard]] const StressCheck* find_check(std::string_view name);

/// The first failure of all checks, its check's name in front.
[[nodiscard]] Failure first_failure(const Drawing& drawing, std::uint64_t seed);

/// The same for a scene from any source, which nothing is known about: map invariants on several grids, and regions.
[[nodiscard]] Failure first_scene_failure(const Scene& scene, std::uint64_t seed, bool inside);

/// Faces by winding numbers: the same number of them, the same areas.
[[nodiscard]] Failure compare_faces(const MapCheck& a, const MapCheck& b);

} // namespace fetexc::test
