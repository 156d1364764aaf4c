// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers that are the same for every standard library: only std::mt19937_64 itself is specified bit for bit.
#pragma once

#include <cstdint>
#include <random>

namespace fetexc::test {

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Uniform in [0,1), 53 bits.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform in low … high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool chance(double probability) { return unit() < probability; }

  private:
    std::mt19937_64 engine_;
};

} // namespace fetexc::test
