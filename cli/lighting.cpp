// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/lighting.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

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

Rgba lit_normal(const Rgba& color, const LightDirection& light, bool y_up) {
    if (!(color.a > 0)) return color;
    const auto component = [&](double v) { return 2 * v / color.a - 1; };
    const LightDirection n =
        unit({component(color.r), y_up ? -component(color.g) : component(color.g), component(color.b)});
    const double grey = std::clamp(shade(n, light), 0.0, 1.0) * color.a;
    return {grey, grey, grey, color.a};
}

void light_normals(fetex::Image& image, const LightDirection& light, bool y_up) {
    for (std::size_t at = 0; at + 3 < image.rgba.size(); at += 4) {
        float* const p = image.rgba.data() + at;
        const auto channel = [&](int k) { return static_cast<double>(p[k]); };
        const Rgba lit = lit_normal({channel(0), channel(1), channel(2), channel(3)}, light, y_up);
        p[0] = static_cast<float>(lit.r), p[1] = static_cast<float>(lit.g), p[2] = static_cast<float>(lit.b);
    }
}

void add_light_option(CLI::App& app, std::optional<LightDirection>& light) {
    app.add_option_function<std::string>(
           "--light",
           [&light](const std::string& text) {
               light = parse_light(text);
               if (!light) throw CLI::ValidationError("--light", fmt::format("'{}' is not x,y,z, not all 0", text));
           },
           "Colours are normals: the surface lit from there, x right, y down, z out of the picture")
        ->type_name("X,Y,Z");
}

} // namespace fetexc::cli
