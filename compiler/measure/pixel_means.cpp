// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/pixel_means.h"

#include <vector>

#include "compiler/error_budget.h"
#include "compiler/measure/colors.h"

namespace fetexc::measure {
namespace {

Rgba middle(const Rgba& a, const Rgba& b) {
    return {(a.r + b.r) / 2, (a.g + b.g) / 2, (a.b + b.b) / 2, (a.a + b.a) / 2};
}

/// Mean between two places of a line with colours a and b: halved where these differ, down to the jump between them.
template <class At>
Rgba mean_between(const At& at, double from, const Rgba& a, double to, const Rgba& b, int halvings) {
    if (halvings == 0 || contrast(a, b) < budget::kJump) return middle(a, b);
    const double half = (from + to) / 2;
    const Rgba c = at(half);
    return middle(mean_between(at, from, a, half, c, halvings - 1), mean_between(at, half, c, to, b, halvings - 1));
}

template <class At> Rgba line_mean(const At& at, unsigned intervals) {
    Rgba sum, last = at(0);
    for (unsigned k = 1; k <= intervals; ++k) {
        const double from = (k - 1.0) / intervals, to = static_cast<double>(k) / intervals;
        const Rgba next = at(to);
        add(sum, mean_between(at, from, last, to, next, budget::kJumpHalvings), 1.0 / intervals);
        last = next;
    }
    return sum;
}

/// Lines whose means don't go on as their neighbours' do: an edge enters or leaves the pixel around there.
std::vector<char> bends(const std::vector<Rgba>& lines) {
    std::vector<char> out(lines.size(), 0);
    for (std::size_t l = 1; l + 1 < lines.size(); ++l) {
        if (contrast(middle(lines[l - 1], lines[l + 1]), lines[l]) >= budget::kLinearPixel)
            out[l - 1] = out[l] = out[l + 1] = 1;
    }
    return out;
}

} // namespace

bool is_linear(const PixelCorners& corners, const Rgba& center) {
    Rgba mean;
    for (const Rgba& c : corners)
        add(mean, c, 0.25);
    return contrast(mean, center) < budget::kLinearPixel;
}

namespace {

/// The picture changes more along u than along v.
bool changes_across(const Picture& picture, const PixelArea& area) {
    std::array<std::array<Rgba, 3>, 3> c;
    for (std::size_t y = 0; y < 3; ++y) {
        for (std::size_t x = 0; x < 3; ++x)
            c[y][x] = picture.at({area.u + 0.5 * static_cast<double>(x) * area.width,
                                  area.v + 0.5 * static_cast<double>(y) * area.height});
    }
    double across = 0, down = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t n = 0; n < 2; ++n)
            across += color_distance(c[k][n], c[k][n + 1]), down += color_distance(c[n][k], c[n + 1][k]);
    }
    return across >= down;
}

} // namespace

Rgba supersampled(const Picture& picture, const PixelArea& area, unsigned intervals) {
    const bool level = changes_across(picture, area);
    const auto mean_at = [&](double side) {
        return line_mean(
            [&](double t) {
                return picture.at(
                    {area.u + (level ? t : side) * area.width, area.v + (level ? side : t) * area.height});
            },
            intervals);
    };
    std::vector<Rgba> lines;
    for (unsigned l = 0; l < intervals; ++l)
        lines.push_back(mean_at((l + 0.5) / intervals));
    const std::vector<char> refine = bends(lines);
    Rgba sum;
    for (unsigned l = 0; l < intervals; ++l) {
        if (refine[l] == 0) {
            add(sum, lines[l], 1.0 / intervals);
            continue;
        }
        for (const Rgba& third : {mean_at((l + 1.0 / 6) / intervals), lines[l], mean_at((l + 5.0 / 6) / intervals)})
            add(sum, third, 1.0 / (3 * intervals));
    }
    return sum;
}

} // namespace fetexc::measure
