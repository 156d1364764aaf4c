// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/known_pinchmap.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "formats/fbt_samples.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using namespace fetex;

constexpr double kBrightest = 4;        ///< of halves
constexpr double kRoundBy = 1.0 / 1024; ///< more than the map's 16 bits may take away again

/// Sides of the clusters around a corner.
struct Around {
    int nw = 0, ne = 0, sw = 0, se = 0;
    [[nodiscard]] bool active() const { return !(nw == ne && ne == sw && sw == se); }
    [[nodiscard]] bool cross() const { return nw == se && ne == sw && nw != ne; }
};
Around around(const PinchmapMask& m, int i, int j) {
    return {m.at(i - 1, j - 1), m.at(i, j - 1), m.at(i - 1, j), m.at(i, j)};
}
bool active(const PinchmapMask& m, int i, int j) { return around(m, i, j).active(); }

int sign_of(int v) { return (v > 0) - (v < 0); }

bool valid_cluster(const PinchmapMask& m, int i, int j) {
    const bool nw = active(m, i, j), ne = active(m, i + 1, j), sw = active(m, i, j + 1), se = active(m, i + 1, j + 1);
    const int count = nw + ne + sw + se;
    if (count == 4 || (count == 2 && nw == se)) return false;
    if (nw && ne && m.at(i, j - 1) == m.at(i, j)) return false;
    if (sw && se && m.at(i, j + 1) == m.at(i, j)) return false;
    if (nw && sw && m.at(i - 1, j) == m.at(i, j)) return false;
    return !(ne && se && m.at(i + 1, j) == m.at(i, j));
}

PinchmapMask random_blobs(Random& random, std::uint32_t width, std::uint32_t height) {
    PinchmapMask m{width, height, std::vector<int>(std::size_t{width} * height, -1)};
    const int blobs = 1 + static_cast<int>(width * height / 12);
    for (int n = 0; n < blobs; ++n) {
        const int x = random.integer(-1, static_cast<int>(width)), y = random.integer(-1, static_cast<int>(height)),
                  w = random.integer(2, 6), h = random.integer(2, 6), side = random.chance(0.6) ? 1 : -1;
        for (int j = std::max(y, 0); j < std::min<int>(y + h, static_cast<int>(height)); ++j)
            for (int i = std::max(x, 0); i < std::min<int>(x + w, static_cast<int>(width)); ++i)
                m.sides[static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)] = side;
    }
    return m;
}

FbtColor random_color(Random& random, PinchmapSampleFormat format) {
    const bool opaque = format == PinchmapSampleFormat::Rgb8 || random.chance(0.5);
    const double alpha = opaque ? 1.0 : random.unit(),
                 most = format == PinchmapSampleFormat::Rgba16F ? kBrightest : alpha;
    return {random.between(0, most), random.between(0, most), random.between(0, most), alpha};
}

FbtColor color_of_side(int side) { return {side > 0 ? 1.0 : 0.0, 0, side > 0 ? 0.0 : 1.0, 1}; }

/// The map's texels as values.
class Maker {
  public:
    Maker(const PinchmapMask& mask, const KnownPinchmapOptions& options)
        : mask_(mask), options_(options), random_(options.seed) {
        texture_.width = mask.width, texture_.height = mask.height, texture_.scale = options.scale;
        texture_.map_format = options.map_format, texture_.sample_format = options.sample_format;
    }

    PinchmapTexture make() {
        make_texels();
        if (options_.turns_round) round_turns();
        for (const PinchmapTexel& texel : texels_) {
            const auto words = pinchmap_pack(texture_.map_format, texel);
            texture_.map.insert(texture_.map.end(), words.begin(), words.begin() + pinchmap_words(texture_.map_format));
        }
        make_signal();
        if (options_.mips) texture_.mips = pinchmap_make_mips(texture_);
        return texture_;
    }

  private:
    PinchmapTexel& texel(std::uint32_t i, std::uint32_t j) { return texels_[std::size_t{j} * (mask_.width + 1) + i]; }

    void make_texels() {
        for (int j = 0; j <= static_cast<int>(mask_.height); ++j)
            for (int i = 0; i <= static_cast<int>(mask_.width); ++i) {
                const Around a = around(mask_, i, j);
                PinchmapTexel texel;
                texel.gamma = random_.between(options_.gamma_from, options_.gamma_to);
                if (a.active()) {
                    const double strength = random_.between(options_.least_strength, 1);
                    texel.du = strength * sign_of(a.ne + a.se - a.nw - a.sw);
                    texel.dv = strength * sign_of(a.sw + a.se - a.nw - a.ne);
                } else {
                    texel.k = a.nw;
                }
                texels_.push_back(texel);
            }
    }

    /// Of a cluster with three active corners the middle one's gamma is, towards the cluster's side, no less than the
    /// mean of the others'. Changes only go one way a side, so this ends.
    void round_turns() {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::uint32_t j = 0; j < mask_.height; ++j)
                for (std::uint32_t i = 0; i < mask_.width; ++i)
                    changed |= round_turn(i, j);
        }
    }

    bool round_turn(std::uint32_t i, std::uint32_t j) {
        std::array<PinchmapTexel*, 4> corners = {&texel(i, j), &texel(i + 1, j), &texel(i, j + 1),
                                                 &texel(i + 1, j + 1)};
        if (std::ranges::count(corners, 0.0, [](const PinchmapTexel* t) { return t->k; }) != 3) return false;
        const auto other = static_cast<std::size_t>(
            std::ranges::find_if(corners, [](const PinchmapTexel* t) { return t->k != 0; }) - corners.begin());
        const double side = corners[other]->k, mean = (corners[other ^ 1]->gamma + corners[other ^ 2]->gamma) / 2;
        double& turn = corners[other ^ 3]->gamma;
        if (side * turn >= side * mean + kRoundBy / 2) return false;
        turn = mean + side * kRoundBy;
        return true;
    }

    void make_signal() {
        const FbtSampleFormat format = silmap_fbt_format(texture_.sample_format);
        for (std::uint32_t b = 0; b < pinchmap_signal_height(texture_); ++b)
            for (std::uint32_t a = 0; a < pinchmap_signal_width(texture_); ++a) {
                const int side = mask_.at(static_cast<int>(a >> options_.scale), static_cast<int>(b >> options_.scale));
                const FbtColor color = options_.signal == KnownSignal::TwoColors
                                           ? color_of_side(side)
                                           : random_color(random_, texture_.sample_format);
                const auto words = fbt_pack_sample(color, format);
                texture_.signal.insert(texture_.signal.end(), words.begin(), words.begin() + fbt_sample_words(format));
            }
    }

    const PinchmapMask& mask_;
    KnownPinchmapOptions options_;
    Random random_;
    PinchmapTexture texture_;
    std::vector<PinchmapTexel> texels_;
};

} // namespace

int PinchmapMask::at(int i, int j) const {
    const auto column = static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(width) - 1)),
               row = static_cast<std::size_t>(std::clamp(j, 0, static_cast<int>(height) - 1));
    return sides[row * width + column];
}

PinchmapMask mask_of(const std::vector<std::string>& rows) {
    PinchmapMask m{static_cast<std::uint32_t>(rows.front().size()), static_cast<std::uint32_t>(rows.size()), {}};
    for (const std::string& row : rows)
        for (const char c : row)
            m.sides.push_back(c == '#' ? 1 : -1);
    return m;
}

bool has_cross(const PinchmapMask& mask) {
    for (int j = 0; j <= static_cast<int>(mask.height); ++j)
        for (int i = 0; i <= static_cast<int>(mask.width); ++i)
            if (around(mask, i, j).cross()) return true;
    return false;
}

bool is_valid(const PinchmapMask& mask) {
    for (int j = 0; j < static_cast<int>(mask.height); ++j)
        for (int i = 0; i < static_cast<int>(mask.width); ++i)
            if (!valid_cluster(mask, i, j)) return false;
    return true;
}

std::vector<PinchmapMask> all_valid_masks(std::uint32_t side) {
    std::vector<PinchmapMask> all;
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << (side * side - 1); ++bits) {
        PinchmapMask m{side, side, {1}};
        for (std::uint32_t k = 0; k + 1 < side * side; ++k)
            m.sides.push_back(bits >> k & 1 ? 1 : -1);
        if (!has_cross(m) && is_valid(m)) all.push_back(std::move(m));
    }
    return all;
}

/// Broken clusters and those around them become one side, again and again: in the end at worst all do.
PinchmapMask random_mask(std::uint64_t seed, std::uint32_t width, std::uint32_t height) {
    Random random(seed);
    PinchmapMask m = random_blobs(random, width, height);
    for (bool changed = true; changed;) {
        changed = false;
        for (int j = 0; j <= static_cast<int>(height); ++j)
            for (int i = 0; i <= static_cast<int>(width); ++i) {
                const bool broken =
                    around(m, i, j).cross() ||
                    (i < static_cast<int>(width) && j < static_cast<int>(height) && !valid_cluster(m, i, j));
                if (!broken) continue;
                changed = true;
                const int reach = random.integer(1, 3);
                for (int y = std::max(j - reach, 0); y < std::min(j + reach, static_cast<int>(height)); ++y)
                    for (int x = std::max(i - reach, 0); x < std::min(i + reach, static_cast<int>(width)); ++x)
                        m.sides[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = m.at(i, j);
            }
    }
    return m;
}

PinchmapTexture pinchmap_of(const PinchmapMask& mask, const KnownPinchmapOptions& options) {
    return Maker(mask, options).make();
}

} // namespace fetexc::test
