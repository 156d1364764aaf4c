// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/lighting.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fetexc::cli {
namespace {

/// How much of each kind of light there is, and how small the highlight. With the light above, what is flat is at 0.78.
constexpr double kAmbient = 0.12, kDiffuse = 0.66, kSpecular = 0.35, kShininess = 24;

LightDirection unit(const LightDirection& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > 0 ? LightDirection{v.x / length, v.y / length, v.z / length} : LightDirection{};
}

double dot(const LightDirection& a, const LightDirection& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double shade(const LightDirection& normal, const LightDirection& light) {
    const double lambert = std::max(dot(normal, light), 0.0);
    const LightDirection half = unit({light.x, light.y, light.z + 1});
    const double highlight = lambert > 0 ? std::pow(std::max(dot(normal, half), 0.0), kShininess) : 0;
    const double flat = std::pow(std::max(half.z, 0.0), kShininess); // so that highlights are where something bends
    return kAmbient + kDiffuse * lambert + kSpecular * std::max(highlight - flat, 0.0);
}

} // namespace

std::optional<LightDirection> parse_light(const std::string& text) {
    LightDirection v;
    char more = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &v.x, &v.y, &v.z, &more) != 3) return std::nullopt;
    const double length = std::sqrt(dot(v, v));
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return unit(v);
}

void light_normals(fetex::Image& image, const LightDirection& light, bool y_up) {
    for (std::size_t at = 0; at + 3 < image.rgba.size(); at += 4) {
        float* const p = image.rgba.data() + at;
        const double alpha = static_cast<double>(p[3]);
        if (!(alpha > 0)) continue;
        const auto channel = [&](int k) { return 2 * static_cast<double>(p[k]) / alpha - 1; };
        const LightDirection n = unit({channel(0), y_up ? -channel(1) : channel(1), channel(2)});
        const auto grey = static_cast<float>(std::clamp(shade(n, light), 0.0, 1.0) * alpha);
        p[0] = p[1] = p[2] = grey;
    }
}

} // namespace fetexc::cli
