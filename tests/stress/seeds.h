// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

namespace fetexc::test {

/// Seeds of a stress test: 0 … count − 1. FETEXC_STRESS_SEEDS=N asks for N instead, FETEXC_STRESS_FIRST=K starts at K.
inline std::vector<std::uint64_t> stress_seeds(std::uint64_t count) {
    const auto from_environment = [](const char* name, std::uint64_t otherwise) {
        const char* text = std::getenv(name);
        return text != nullptr ? std::stoull(text) : otherwise;
    };
    std::vector<std::uint64_t> seeds(from_environment("FETEXC_STRESS_SEEDS", count));
    std::iota(seeds.begin(), seeds.end(), from_environment("FETEXC_STRESS_FIRST", 0));
    return seeds;
}

} // namespace fetexc::test
