// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_fbt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/validate.h"
#include "tests/support/fbt_maker.h"

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
    double wide_channel(double most);
    void append_sample(std::vector<std::uint32_t>& words);
    MadeRegion region();
    double coordinate();
    double control(double a, double b, double u) { return a + (b - a) * u; }
    std::array<double, 2> monotone_handles();
    std::vector<std::uint32_t> polyline(std::uint32_t count);
    std::vector<std::uint32_t> curves(std::uint32_t degree, std::uint32_t count);
    std::uint32_t list();
    std::uint32_t directory();
    std::uint32_t texel();

    std::mt19937_64 random_;
    RandomFbtOptions options_;
    FbtTexture texture_;
    std::vector<MadeRun> written_; ///< with points to share
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

/// Often 0 or all there can be, now and then below the smallest normal half.
double Generator::wide_channel(double most) {
    if (chance(10)) return 0;
    if (chance(10)) return most;
    return most * (chance(10) ? 0x1p-15 : 1.0) * unit();
}

/// A sample in the texture's format.
void Generator::append_sample(std::vector<std::uint32_t>& words) {
    const fetex::FbtSampleFormat format = options_.sample_format;
    if (format == fetex::FbtSampleFormat::Rgba8) return words.push_back(color());
    const double alpha = options_.translucent && chance(40) ? wide_channel(1) : 1.0;
    const double most = format == fetex::FbtSampleFormat::Rgba16F ? 4.0 : alpha;
    const double r = wide_channel(most), g = wide_channel(most), b = wide_channel(most);
    const auto packed = fetex::fbt_pack_sample({r, g, b, alpha}, format);
    words.insert(words.end(), packed.begin(), packed.end());
}

MadeRegion Generator::region() {
    const std::uint32_t choice = below(10);
    if (options_.corners && choice < 3) return {fetex::kFbtModelCorners, 0};
    if (!options_.patches || choice < 6) return {fetex::kFbtModelSolid, color()};
    std::vector<std::uint32_t> samples;
    for (int k = 0; k < 4; ++k)
        append_sample(samples);
    return {fetex::kFbtModelPatch, append_patch(texture_.records, samples)};
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

std::vector<std::uint32_t> Generator::polyline(std::uint32_t count) {
    std::vector<std::uint32_t> points;
    for (std::uint32_t k = 0; k <= count; ++k)
        points.push_back(fetex::fbt_pack_point(coordinate(), coordinate()));
    return points;
}

std::vector<std::uint32_t> Generator::curves(std::uint32_t degree, std::uint32_t count) {
    double x0 = coordinate(), y0 = coordinate();
    std::vector<std::uint32_t> out{fetex::fbt_pack_point(x0, y0)};
    for (std::uint32_t k = 0; k < count; ++k) {
        const double x1 = coordinate(), y1 = chance(10) ? y0 : coordinate();
        if (degree == 2) {
            out.push_back(fetex::fbt_pack_point(control(x0, x1, unit()), control(y0, y1, chance(20) ? 0 : unit())));
        } else {
            const auto hx = monotone_handles(), hy = monotone_handles();
            out.push_back(fetex::fbt_pack_point(control(x0, x1, hx[0]), control(y0, y1, hy[0])));
            out.push_back(fetex::fbt_pack_point(control(x0, x1, hx[1]), control(y0, y1, hy[1])));
        }
        out.push_back(fetex::fbt_pack_point(x1, y1));
        x0 = x1;
        y0 = y1;
    }
    return out;
}

/// Some runs share the points of a list before.
std::uint32_t Generator::list() {
    std::vector<MadeRun> runs;
    const std::uint32_t features = options_.degrees == 0 ? 0 : below(options_.max_features + 1);
    for (std::uint32_t feature = 0; feature < features; ++feature) {
        const std::uint32_t direction = one_of(options_.directions);
        for (std::uint32_t left = 1 + below(3); left > 0; --left) {
            MadeRun run;
            if (!written_.empty() && chance(20)) {
                run = written_[below(static_cast<std::uint32_t>(written_.size()))];
            } else {
                run.degree = one_of(options_.degrees), run.pieces = 1 + below(options_.max_pieces);
                run.points = run.degree == 1 ? polyline(run.pieces) : curves(run.degree, run.pieces);
            }
            run.direction = direction, run.last = left == 1;
            if (run.last) run.inside = region();
            runs.push_back(std::move(run));
        }
    }
    std::uint32_t depth = 0;
    for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
        if (run->last && run != runs.rbegin()) depth = std::min(below(depth + 2), fetex::kFbtMaxDepth);
        run->depth = depth;
    }
    std::vector<std::uint32_t> first_words;
    const MadeRegion rest = region();
    const std::uint32_t first = append_list(texture_.records, runs, rest, &first_words);
    for (std::size_t k = 0; k < runs.size(); ++k) {
        MadeRun& run = runs[k];
        if (run.points.empty()) continue;
        run.points.clear(), run.inside = {}, run.shared_from = first_words[k];
        written_.push_back(run);
    }
    return first;
}

std::uint32_t Generator::directory() {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t k = below(7); k > 0; --k)
        ends.push_back(chance(40) ? fetex::fbt_quantise((1 + below(15)) / 16.0) : 0x4001 + below(0x7fff));
    ends.push_back(0xc000);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> bands;
    for (const std::uint32_t end : ends)
        bands.emplace_back(end, list());
    return append_directory(texture_.records, bands);
}

std::uint32_t Generator::texel() {
    const std::uint32_t choice = below(options_.bands ? 4 : 3);
    if (choice == 3) return (fetex::kFbtKindBanded << 30) | directory();
    if (choice != 0) return (fetex::kFbtKindSingle << 30) | list();
    const MadeRegion r = region();
    if (r.model != fetex::kFbtModelSolid) return shaded_texel(r);
    return r.sample >> 24 == 255 ? solid_texel(r.sample) : 0;
}

FbtTexture Generator::make() {
    texture_.width = options_.width;
    texture_.height = options_.height;
    texture_.sample_format = options_.sample_format;
    if (options_.corners) {
        for (std::uint32_t k = 0; k < (options_.width + 1) * (options_.height + 1); ++k)
            append_sample(texture_.corners);
    }
    for (std::uint32_t k = 0; k < options_.width * options_.height; ++k)
        texture_.texels.push_back(texel());
    if (options_.mips) {
        for (std::uint64_t k = fetex::fbt_mip_samples(options_.width, options_.height); k > 0; --k)
            texture_.mips.push_back(color());
    }
    texture_.traits = fetex::fbt_traits(texture_);
    if (!texture_.traits.corners) texture_.corners.clear(), texture_.traits = fetex::fbt_traits(texture_);
    return std::move(texture_);
}

} // namespace

FbtTexture random_fbt(std::uint64_t seed, const RandomFbtOptions& options) { return Generator(seed, options).make(); }

} // namespace fetexc::test
