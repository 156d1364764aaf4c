// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The CPU reference sampler (SPEC.md, "Sampling an FBT"): plain, slow, in double. The GLSL sampler must agree with it.
#include "formats/fbt.h"
#include "formats/fbt_samples.h"
#include "formats/fbt_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetex {
namespace {

struct Point {
    double x = 0, y = 0;
};

/// A query point in the frame of a ray: the ray runs along x, towards +x or −x. Rays along ±y see x and y swapped.
struct Ray {
    Point p;
    std::uint32_t x_shift = 0; ///< where x is in a quantised point
    bool negative = false;

    Ray(double fx, double fy, std::uint32_t direction)
        : p(direction < kFbtRayPosY ? Point{fx, fy} : Point{fy, fx}), x_shift(direction < kFbtRayPosY ? 0 : 16),
          negative((direction & 1u) != 0) {}
    [[nodiscard]] double x_of(std::uint32_t word) const { return fbt_dequantise(word >> x_shift & 0xffffu); }
    [[nodiscard]] double y_of(std::uint32_t word) const { return fbt_dequantise(word >> (16 - x_shift) & 0xffffu); }
};

/// A piece of degree 1…3 in the frame of a ray.
struct Piece {
    Piece(const std::uint32_t* words, std::uint32_t degree_of_run, const Ray& ray) : degree(degree_of_run) {
        for (std::uint32_t n = 0; n <= degree; ++n)
            c[n] = {ray.x_of(words[n]), ray.y_of(words[n])};
    }
    std::uint32_t degree;
    std::array<Point, 4> c;
};

double lerp(double a, double b, double t) { return a + (b - a) * t; }

double bezier(double a, double b, double c, double t) { return lerp(lerp(a, b, t), lerp(b, c, t), t); }

double bezier(double a, double b, double c, double d, double t) {
    return lerp(bezier(a, b, c, t), bezier(b, c, d, t), t);
}

/// Root of the y-monotone quadratic in citardauq form: C is computed from a difference, B and the root of the
/// discriminant have one sign, so nothing cancels. Pieces that quantisation made flat at an end can make the
/// denominator 0: t = 0 then.
double solve_quadratic(const Piece& q, double y) {
    const double a = q.c[0].y - 2 * q.c[1].y + q.c[2].y, b = q.c[1].y - q.c[0].y, c = q.c[0].y - y;
    const double root = std::sqrt(std::max(b * b - a * c, 0.0));
    const double denominator = b + (q.c[2].y >= q.c[0].y ? root : -root);
    return denominator == 0 ? 0.0 : std::clamp(-c / denominator, 0.0, 1.0);
}

/// Root of the y-monotone cubic: Newton kept inside a bracket, bisection where a step would leave it. Stops when t no
/// longer moves. The bracket test includes its ends: a converged step must not jump back to the middle.
double solve_cubic(const Piece& q, double y) {
    constexpr int kSteps = 128; // bisection alone needs 53
    const double up = q.c[3].y >= q.c[0].y ? 1.0 : -1.0;
    const double a = up * (q.c[3].y - q.c[0].y + 3 * (q.c[1].y - q.c[2].y));
    const double b = up * 3 * (q.c[0].y - 2 * q.c[1].y + q.c[2].y);
    const double c = up * 3 * (q.c[1].y - q.c[0].y);
    const double d = up * (q.c[0].y - y);
    double low = 0, high = 1, t = 0.5;
    std::array<double, 3> last{}; ///< t, low and high when the step before began
    for (int step = 0; step < kSteps; ++step) {
        const double f = ((a * t + b) * t + c) * t + d;
        const std::array<double, 3> now{t, low, high};
        (f < 0 ? low : high) = t;
        const double newton = t - f / ((3 * a * t + 2 * b) * t + c);
        const double next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
        if (next == t) break;
        // Two neighbours may take turns for ever: what the last step would end on is known.
        if (last == std::array{next, low, high}) return (kSteps - step) % 2 != 0 ? next : t;
        last = now, t = next;
    }
    return t;
}

/// x of the crossing of the piece with the line y = p.y; p.y lies in the half-open interval of its end points.
double crossing_x(const Piece& q, double y) {
    const auto& c = q.c;
    if (q.degree == 1) return lerp(c[0].x, c[1].x, (y - c[0].y) / (c[1].y - c[0].y));
    if (q.degree == 2) return bezier(c[0].x, c[1].x, c[2].x, solve_quadratic(q, y));
    return bezier(c[0].x, c[1].x, c[2].x, c[3].x, solve_cubic(q, y));
}

/// The normative predicate. Half-open in y so that a ray through a shared end point counts it once; the convex hull's
/// box settles most curves without solving (FBT §5). words: the piece's points.
bool crosses(const std::uint32_t* words, std::uint32_t degree, const Ray& ray, FbtQueryStats& stats) {
    ++stats.pieces;
    if ((ray.p.y >= ray.y_of(words[0])) == (ray.p.y >= ray.y_of(words[degree]))) {
        ++stats.outside;
        return false;
    }
    double left = ray.x_of(words[0]), right = left;
    for (std::uint32_t n = 1; n <= degree; ++n)
        left = std::min(left, ray.x_of(words[n])), right = std::max(right, ray.x_of(words[n]));
    if (ray.p.x < left || ray.p.x >= right) {
        ++stats.box;
        return (ray.p.x < left) != ray.negative;
    }
    ++stats.solved[degree];
    return (crossing_x(Piece(words, degree, ray), ray.p.y) > ray.p.x) != ray.negative;
}

/// Whether an odd number of the run's pieces is crossed. Neighbouring pieces share a point.
bool run_parity(const FbtTexture& texture, const std::uint32_t* words, double fx, double fy, FbtQueryStats& stats) {
    const FbtEntry entry(words[0]);
    const Ray ray(fx, fy, entry.direction());
    const std::uint32_t* points = entry.shared() ? texture.records.data() + words[2] : words + 2;
    bool odd = false;
    for (std::uint32_t k = 0; k < entry.pieces(); ++k)
        odd ^= crosses(points + std::size_t{k} * entry.degree(), entry.degree(), ray, stats);
    return odd;
}

/// First feature, in order, whose parity is odd; else what is left (FBT §4.5).
void find_region(FbtRegion& region, const FbtTexture& texture, std::uint32_t record, double fx, double fy,
                 FbtQueryStats& stats) {
    bool odd = false;
    for (;;) {
        const std::uint32_t* words = texture.records.data() + std::size_t{record} * 4;
        const FbtEntry entry(words[0]);
        ++stats.entries;
        odd ^= run_parity(texture, words, fx, fy, stats);
        const bool found = odd && entry.last_run();
        if (found || entry.last()) {
            region.record = record;
            region.rest = !found;
            region.model = found ? entry.model() : entry.rest_model();
            region.sample = found ? words[1] : words[entry.rest_word()];
            return;
        }
        if (entry.last_run()) odd = false;
        record += entry.records();
    }
}

double inside(double local) { return std::min(local, kFbtFarBorder); }

std::uint32_t base_texel(double v, std::uint32_t size) { return std::min(static_cast<std::uint32_t>(v), size - 1); }

} // namespace

FbtRegion fbt_whole_region(std::uint32_t texel, std::uint32_t i, std::uint32_t j) {
    FbtRegion region;
    region.i = i, region.j = j;
    if (texel >> 30 == kFbtKindShaded) {
        region.model = texel >> 28 & 3u;
        region.sample = texel & kFbtSampleMask;
    } else if ((texel & kFbtOpaque) != 0) {
        region.sample = texel | 0xff000000u;
    }
    return region;
}

FbtRegion fbt_locate_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                           FbtQueryStats* stats) {
    FbtQueryStats ignored;
    FbtQueryStats& counts = stats ? *stats : ignored;
    ++counts.queries;
    i = std::min(i, texture.width - 1), j = std::min(j, texture.height - 1);
    const std::uint32_t texel = fbt_texel(texture, i, j);
    if (!fbt_has_features(texel)) return fbt_whole_region(texel, i, j);
    const FbtBands bands(texture, texel);
    FbtRegion region;
    region.i = i, region.j = j;
    find_region(region, texture, bands.list(bands.find(fy, &counts.bands)), fx, fy, counts);
    return region;
}

FbtColor fbt_shade(const FbtTexture& texture, const FbtRegion& region, double fx, double fy) {
    const bool solid = region.model == kFbtModelSolid;
    const FbtSampleFormat format = solid ? FbtSampleFormat::Rgba8 : texture.sample_format;
    const std::size_t words = fbt_sample_words(format);
    std::array<double, 4> sum{};
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t i = region.i + (corner & 1u), j = region.j + (corner >> 1);
        const std::uint32_t* sample = solid ? &region.sample
                                      : region.model == kFbtModelPatch
                                          ? texture.records.data() + std::size_t{region.sample} * 4 + corner * words
                                          : texture.corners.data() + (std::size_t{j} * (texture.width + 1) + i) * words;
        const std::array<double, 4> channels = fbt_sample_channels(sample, format);
        const double weight = ((corner & 1u) ? fx : 1 - fx) * ((corner & 2u) ? fy : 1 - fy);
        for (std::size_t channel = 0; channel < 4; ++channel)
            sum[channel] += weight * channels[channel];
    }
    const double unit = fbt_sample_unit(format);
    return {sum[0] / unit, sum[1] / unit, sum[2] / unit, sum[3] / unit};
}

FbtRegion fbt_locate(const FbtTexture& texture, double x, double y) {
    const double cx = fbt_clamp_coordinate(x, texture.width), cy = fbt_clamp_coordinate(y, texture.height);
    const std::uint32_t i = base_texel(cx, texture.width), j = base_texel(cy, texture.height);
    return fbt_locate_local(texture, i, j, inside(cx - i), inside(cy - j));
}

FbtColor fbt_sample(const FbtTexture& texture, double x, double y) {
    const double cx = fbt_clamp_coordinate(x, texture.width), cy = fbt_clamp_coordinate(y, texture.height);
    const std::uint32_t i = base_texel(cx, texture.width), j = base_texel(cy, texture.height);
    return fbt_sample_local(texture, i, j, inside(cx - i), inside(cy - j));
}

FbtColor fbt_sample_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    return fbt_shade(texture, fbt_locate_local(texture, i, j, fx, fy), fx, fy);
}

std::uint32_t fbt_quantise(double v) {
    const double u = std::floor((v + 0.5) * 0x1p15 + 0.5);
    return static_cast<std::uint32_t>(std::clamp(u, 0.0, 65535.0));
}

std::uint32_t fbt_pack_point(double x, double y) { return fbt_quantise(x) | fbt_quantise(y) << 16; }

} // namespace fetex
