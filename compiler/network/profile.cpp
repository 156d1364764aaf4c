// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/profile.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

/// Value and slope for t = d/width, of height 1 and width 1.
struct Shape {
    double value = 0, slope = 0;
};

Shape preset_shape(ProfileShape shape, double t) {
    if (t >= 1) return {};
    const double left = 1 - t;
    switch (shape) {
    case ProfileShape::Crease:
        return {-left * left, 2 * left};
    case ProfileShape::Groove:
        return {-(1 - t * t) * (1 - t * t), 4 * t * (1 - t * t)};
    case ProfileShape::Ridge:
        return {left * left, -2 * left};
    default:
        return {6.75 * t * left * left, 6.75 * left * (1 - 3 * t)};
    }
}

/// The stretch of a table that a distance is in: points k and k + 1. Precondition: two points, distance up to the last.
template <class Point> std::size_t stretch(const std::vector<Point>& table, double distance) {
    const auto after = std::upper_bound(table.begin() + 1, table.end() - 1, distance,
                                        [](double d, const Point& p) { return d < p.distance; });
    return static_cast<std::size_t>(after - table.begin()) - 1;
}

double secant(const std::vector<ProfilePoint>& table, std::size_t k) {
    return (table[k + 1].value - table[k].value) / (table[k + 1].distance - table[k].distance);
}

/// Fritsch and Carlson's, in the form of Brodlie: 0 at extrema, else a harmonic mean weighted by lengths; at the ends
/// the secant. Between two points the cubic is monotone.
double tangent(const std::vector<ProfilePoint>& table, std::size_t k) {
    if (k == 0) return secant(table, 0);
    if (k + 1 == table.size()) return secant(table, k - 1);
    const double before = secant(table, k - 1), after = secant(table, k);
    if (!(before * after > 0)) return 0;
    const double a = table[k].distance - table[k - 1].distance, b = table[k + 1].distance - table[k].distance;
    const double weight = (a + 2 * b) / (3 * (a + b));
    return 1 / (weight / before + (1 - weight) / after);
}

Shape table_shape(const std::vector<ProfilePoint>& table, double distance) {
    if (distance >= table.back().distance) return {table.back().value, 0};
    const std::size_t k = stretch(table, distance);
    const double length = table[k + 1].distance - table[k].distance, t = (distance - table[k].distance) / length;
    const double rise = table[k + 1].value - table[k].value, m0 = tangent(table, k) * length,
                 m1 = tangent(table, k + 1) * length;
    // value + m0·t + (3·rise − 2·m0 − m1)·t² + (m0 + m1 − 2·rise)·t³
    const double c2 = 3 * rise - 2 * m0 - m1, c3 = m0 + m1 - 2 * rise;
    return {table[k].value + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2 * c2 + t * 3 * c3)) / length};
}

double mixed(double a, double b, double t) { return a + t * (b - a); }

} // namespace

double profile_height(const FeatureProfile& p, double distance) {
    if (p.shape == ProfileShape::Table) return table_shape(p.heights, distance).value;
    return p.height * preset_shape(p.shape, distance / p.width).value;
}

/// A monotone cubic has no extremes between its points.
double largest_height(const FeatureProfile& p) {
    if (p.shape != ProfileShape::Table) return std::abs(p.height);
    double most = 0;
    for (const ProfilePoint& at : p.heights)
        most = std::max(most, std::abs(at.value));
    return most;
}

double profile_slope(const FeatureProfile& p, double distance) {
    if (p.shape == ProfileShape::Table) return table_shape(p.heights, distance).slope;
    return p.height / p.width * preset_shape(p.shape, distance / p.width).slope;
}

double profile_blend(const FeatureProfile& p, double distance) {
    if (distance >= p.width) return 1;
    if (!p.blends.empty()) {
        if (p.blends.size() == 1 || distance >= p.blends.back().distance) return p.blends.back().value;
        const std::size_t k = stretch(p.blends, distance);
        const ProfilePoint &a = p.blends[k], &b = p.blends[k + 1];
        return mixed(a.value, b.value, (distance - a.distance) / (b.distance - a.distance));
    }
    if (distance <= p.inner) return 0;
    const double s = (distance - p.inner) / (p.width - p.inner);
    return s * s * (3 - 2 * s);
}

std::optional<Rgba> profile_color(const FeatureProfile& p, double distance) {
    if (p.colors.empty()) return std::nullopt;
    if (p.colors.size() == 1 || distance >= p.colors.back().distance) return p.colors.back().color;
    const std::size_t k = stretch(p.colors, distance);
    const ProfileColor &a = p.colors[k], &b = p.colors[k + 1];
    const double t = (distance - a.distance) / (b.distance - a.distance);
    return Rgba{mixed(a.color.r, b.color.r, t), mixed(a.color.g, b.color.g, t), mixed(a.color.b, b.color.b, t),
                mixed(a.color.a, b.color.a, t)};
}

std::optional<FeatureProfile> preset_profile(std::string_view name, double width) {
    const auto found = std::ranges::find(kProfilePresets, name);
    if (found == kProfilePresets.end()) return std::nullopt;
    FeatureProfile p;
    p.name = name;
    p.shape = static_cast<ProfileShape>(found - kProfilePresets.begin());
    p.width = width, p.height = kPresetSlope * width;
    return p;
}

} // namespace fetexc
