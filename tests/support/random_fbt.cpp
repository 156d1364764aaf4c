// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_fbt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "formats/validate.h"

namespace fetexc::test {
namespace {

using fetex::FbtTexture;

class Generator {
  public:
    Generator(std::uint64_t seed, const RandomFbtOptions& options) : random_(seed), options_(options) {}
    FbtTexture make();

  private:
    // The standard distributions differ between libraries; these don't.
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
    bool chance(std::uint32_t percent) { return below(100) < percent; }
    double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    std::uint32_t one_of(std::uint32_t bits);

    std::uint32_t color();
    std::uint32_t mask(std::uint32_t i, std::uint32_t j);
    double coordinate();
    double control(double a, double b, double u) { return a + (b - a) * u; }
    std::array<double, 2> monotone_handles();
    std::uint32_t append_polyline(std::uint32_t count);
    std::uint32_t append_curves(std::uint32_t degree, std::uint32_t count);
    std::uint32_t append_list(std::uint32_t i, std::uint32_t j);
    std::uint32_t append_directory(std::uint32_t i, std::uint32_t j);
    std::uint32_t next_record() const { return static_cast<std::uint32_t>(texture_.records.size() / 4); }
    std::uint32_t texel_word(std::uint32_t i, std::uint32_t j);

    std::mt19937_64 random_;
    RandomFbtOptions options_;
    FbtTexture texture_;
};

std::uint32_t Generator::one_of(std::uint32_t bits) {
    for (;;) {
        const std::uint32_t k = below(4);
        if (bits >> k & 1u) return k;
    }
}

std::uint32_t Generator::color() {
    const std::uint32_t alpha = options_.translucent && chance(40) ? below(256) : 255;
    return below(alpha + 1) | below(alpha + 1) << 8 | below(alpha + 1) << 16 | alpha << 24;
}

/// Any codes that name texels which are there.
std::uint32_t Generator::mask(std::uint32_t i, std::uint32_t j) {
    if (!options_.interpolated || chance(30)) return 0;
    const bool right = i + 1 < options_.width + options_.apron, down = j + 1 < options_.height + options_.apron;
    std::uint32_t bits = 0;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t code = below(4);
        if (((code & 1u) == 0 || right) && ((code & 2u) == 0 || down)) bits |= code << (2 * corner);
    }
    return bits;
}

/// Often inside the texel, often on a coarse grid, where rays meet end points exactly, or on a side of the texel.
double Generator::coordinate() {
    if (chance(15)) return below(2);
    if (chance(25)) return below(17) / 16.0;
    return chance(80) ? unit() : 2 * unit() - 0.5;
}

/// Relative positions of the inner control values of a cubic that never turns back: d1 ≥ −√(d0·d2) for the differences
/// d0, d1, d2 of the control values. Flat ends and inflections among them.
std::array<double, 2> Generator::monotone_handles() {
    static constexpr std::array<double, 3> kSpecial = {0.0, 1.0, 1.0 / 3};
    for (;;) {
        const double u = chance(25) ? kSpecial[below(3)] : unit(), v = chance(25) ? kSpecial[below(3)] : unit();
        if (v - u >= -std::sqrt(u * (1 - v))) return {u, v};
    }
}

std::uint32_t Generator::append_polyline(std::uint32_t count) {
    const std::uint32_t first = next_record();
    for (std::uint32_t k = 0; k <= count; ++k)
        texture_.records.push_back(fetex::fbt_pack_point(coordinate(), coordinate()));
    texture_.records.resize((texture_.records.size() + 3) / 4 * 4, 0);
    return first;
}

std::uint32_t Generator::append_curves(std::uint32_t degree, std::uint32_t count) {
    const std::uint32_t first = next_record();
    double x0 = coordinate(), y0 = coordinate();
    for (std::uint32_t k = 0; k < count; ++k) {
        const double x1 = coordinate(), y1 = chance(10) ? y0 : coordinate();
        auto& out = texture_.records;
        out.push_back(fetex::fbt_pack_point(x0, y0));
        if (degree == 2) {
            out.push_back(fetex::fbt_pack_point(control(x0, x1, unit()), control(y0, y1, chance(20) ? 0 : unit())));
        } else {
            const auto hx = monotone_handles(), hy = monotone_handles();
            out.push_back(fetex::fbt_pack_point(control(x0, x1, hx[0]), control(y0, y1, hy[0])));
            out.push_back(fetex::fbt_pack_point(control(x0, x1, hx[1]), control(y0, y1, hy[1])));
        }
        out.push_back(fetex::fbt_pack_point(x1, y1));
        if (degree == 2) out.push_back(0);
        x0 = x1;
        y0 = y1;
    }
    return first;
}

/// Pieces first, then the entries that point at them; some runs share the pieces of another.
std::uint32_t Generator::append_list(std::uint32_t i, std::uint32_t j) {
    std::vector<std::uint32_t> entries;
    const std::uint32_t features = options_.degrees == 0 ? 0 : below(options_.max_features + 1);
    for (std::uint32_t feature = 0; feature < features; ++feature) {
        const std::uint32_t runs = 1 + below(3);
        const std::uint32_t direction = one_of(options_.directions);
        std::uint32_t address = 0, shape = 0;
        for (std::uint32_t run = 0; run < runs; ++run) {
            if (run == 0 || chance(80)) {
                const std::uint32_t degree = one_of(options_.degrees), count = 1 + below(options_.max_pieces);
                address = degree == 1 ? append_polyline(count) : append_curves(degree, count);
                shape = count | degree << 16;
            }
            const bool last = run + 1 == runs;
            entries.push_back(address);
            entries.push_back(shape | direction << 18 | (last ? fetex::kFbtEntryLastRun : 0));
            entries.push_back(last ? color() : 0);
            entries.push_back(last ? mask(i, j) : 0);
        }
    }
    entries.insert(entries.end(), {0, fetex::kFbtEntryTerminator, color(), mask(i, j)});
    const std::uint32_t first = next_record();
    texture_.records.insert(texture_.records.end(), entries.begin(), entries.end());
    return first;
}

std::uint32_t Generator::append_directory(std::uint32_t i, std::uint32_t j) {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t k = below(7); k > 0; --k)
        ends.push_back(chance(40) ? fetex::fbt_quantise((1 + below(15)) / 16.0) : 0x4001 + below(0x7fff));
    ends.push_back(0xc000);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(ends.size()), 0};
    for (const std::uint32_t end : ends) {
        words.push_back(end);
        words.push_back(append_list(i, j));
    }
    words.resize((words.size() + 3) / 4 * 4, 0);
    const std::uint32_t first = next_record();
    texture_.records.insert(texture_.records.end(), words.begin(), words.end());
    return first;
}

std::uint32_t Generator::texel_word(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t choice = below(options_.bands ? 4 : 3);
    if (choice == 0) return mask(i, j);
    if (choice == 3) return fetex::kFbtKindBanded << 30 | append_directory(i, j);
    return fetex::kFbtKindSingle << 30 | append_list(i, j);
}

FbtTexture Generator::make() {
    texture_.width = options_.width;
    texture_.height = options_.height;
    texture_.apron = options_.apron;
    for (std::uint32_t j = 0; j < options_.height + options_.apron; ++j) {
        for (std::uint32_t i = 0; i < options_.width + options_.apron; ++i) {
            texture_.texels.push_back(color());
            texture_.texels.push_back(i < options_.width && j < options_.height ? texel_word(i, j) : 0);
        }
    }
    texture_.traits = fetex::fbt_traits(texture_);
    return std::move(texture_);
}

} // namespace

FbtTexture random_fbt(std::uint64_t seed, const RandomFbtOptions& options) { return Generator(seed, options).make(); }

} // namespace fetexc::test
