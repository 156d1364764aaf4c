// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/blend.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

struct Rgb {
    double r = 0, g = 0, b = 0;
};

// ---- separable modes (§10.1): backdrop b, source s, both straight ----

double hard_light(double b, double s) { return s <= 0.5 ? b * 2 * s : b + (2 * s - 1) - b * (2 * s - 1); }

double color_dodge(double b, double s) {
    if (b <= 0) return 0;
    return s >= 1 ? 1 : std::min(1.0, b / (1 - s));
}

double color_burn(double b, double s) {
    if (b >= 1) return 1;
    return s <= 0 ? 0 : 1 - std::min(1.0, (1 - b) / s);
}

double soft_light(double b, double s) {
    if (s <= 0.5) return b - (1 - 2 * s) * b * (1 - b);
    const double d = b <= 0.25 ? ((16 * b - 12) * b + 4) * b : std::sqrt(b);
    return b + (2 * s - 1) * (d - b);
}

double separable(Blend mode, double b, double s) {
    switch (mode) {
    case Blend::Multiply:
        return b * s;
    case Blend::Screen:
        return b + s - b * s;
    case Blend::Overlay:
        return hard_light(s, b);
    case Blend::Darken:
        return std::min(b, s);
    case Blend::Lighten:
        return std::max(b, s);
    case Blend::ColorDodge:
        return color_dodge(b, s);
    case Blend::ColorBurn:
        return color_burn(b, s);
    case Blend::HardLight:
        return hard_light(b, s);
    case Blend::SoftLight:
        return soft_light(b, s);
    case Blend::Difference:
        return std::abs(b - s);
    case Blend::Exclusion:
        return b + s - 2 * b * s;
    default:
        return s; // Normal; the others are not separable
    }
}

// ---- non-separable modes (§10.2) ----

double luminosity(const Rgb& c) { return 0.3 * c.r + 0.59 * c.g + 0.11 * c.b; }
double lowest(const Rgb& c) { return std::min({c.r, c.g, c.b}); }
double highest(const Rgb& c) { return std::max({c.r, c.g, c.b}); }
double saturation(const Rgb& c) { return highest(c) - lowest(c); }

/// Moves a channel towards the luminosity l by a factor.
Rgb towards(const Rgb& c, double l, double factor) {
    return {l + (c.r - l) * factor, l + (c.g - l) * factor, l + (c.b - l) * factor};
}

Rgb clip_color(Rgb c) {
    const double l = luminosity(c);
    if (const double n = lowest(c); n < 0) c = towards(c, l, l / (l - n));
    if (const double x = highest(c); x > 1) c = towards(c, l, (1 - l) / (x - l));
    return c;
}

Rgb with_luminosity(const Rgb& c, double l) {
    const double d = l - luminosity(c);
    return clip_color({c.r + d, c.g + d, c.b + d});
}

Rgb with_saturation(const Rgb& c, double s) {
    const double low = lowest(c), range = saturation(c);
    if (range <= 0) return {};
    return {(c.r - low) * s / range, (c.g - low) * s / range, (c.b - low) * s / range};
}

Rgb blend_colors(Blend mode, const Rgb& b, const Rgb& s) {
    switch (mode) {
    case Blend::Hue:
        return with_luminosity(with_saturation(s, saturation(b)), luminosity(b));
    case Blend::Saturation:
        return with_luminosity(with_saturation(b, saturation(s)), luminosity(b));
    case Blend::Color:
        return with_luminosity(s, luminosity(b));
    case Blend::Luminosity:
        return with_luminosity(b, luminosity(s));
    default:
        return {separable(mode, b.r, s.r), separable(mode, b.g, s.g), separable(mode, b.b, s.b)};
    }
}

Rgb straight(const Rgba& c) {
    if (c.a <= 0) return {};
    return {std::min(1.0, c.r / c.a), std::min(1.0, c.g / c.a), std::min(1.0, c.b / c.a)};
}

} // namespace

Rgba scaled(const Rgba& c, double factor) { return {c.r * factor, c.g * factor, c.b * factor, c.a * factor}; }

Rgba premultiplied(const Rgba& s) {
    const double a = std::clamp(s.a, 0.0, 1.0);
    return {std::clamp(s.r, 0.0, 1.0) * a, std::clamp(s.g, 0.0, 1.0) * a, std::clamp(s.b, 0.0, 1.0) * a, a};
}

Rgba over(const Rgba& b, const Rgba& s) {
    const double k = 1 - s.a;
    return {s.r + b.r * k, s.g + b.g * k, s.b + b.b * k, s.a + b.a * k};
}

Rgba blend_over(const Rgba& b, const Rgba& s, Blend mode) {
    if (mode == Blend::Normal) return over(b, s);
    const Rgb mixed = blend_colors(mode, straight(b), straight(s));
    const double kb = 1 - s.a, ks = 1 - b.a, both = s.a * b.a;
    return {s.r * ks + b.r * kb + both * mixed.r, s.g * ks + b.g * kb + both * mixed.g,
            s.b * ks + b.b * kb + both * mixed.b, s.a + b.a * kb};
}

} // namespace fetexc
