// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/label_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fetexc::cli {
namespace {

constexpr double kGap = 9;    ///< pixels from a point to its label
constexpr double kMarker = 5; ///< half a marker
constexpr double kOutside = 1000, kOnLabel = 100, kOnPoint = 10, kOnLine = 1, kOtherEnd = 2.5;

struct Place {
    PlacedLabel label;
    double preference = 0;
};

PixelBox box_of(const PlacedLabel& l, double width, double font_size) {
    const double x0 = l.right_aligned ? l.x - width : l.x;
    return {x0, l.y - 0.6 * font_size, x0 + width, l.y + 0.6 * font_size};
}

/// Around one end of a line.
void add_places(PixelPosition end, double width, double font_size, double preference, std::vector<Place>& out) {
    const double up = font_size * 1.1;
    const auto add = [&](double dx, double dy, bool right_aligned, double cost) {
        PlacedLabel l{end.x + dx, end.y + dy, right_aligned, {}};
        l.box = box_of(l, width, font_size);
        out.push_back({l, preference + cost});
    };
    add(kGap, 0, false, 0);
    for (const double steps : {-1.0, 1.0, -2.0, 2.0}) {
        add(kGap, steps * up * 0.8, false, 0.1 * std::fabs(steps));
        add(-width / 2, steps * up, false, 0.2 + 0.1 * std::fabs(steps));
        add(-kGap, steps * up * 0.8, true, 0.4 + 0.1 * std::fabs(steps));
    }
    add(-kGap, 0, true, 0.5);
}

bool crosses(const PixelBox& box, PixelPosition a, PixelPosition b) {
    constexpr int kSteps = 64;
    for (int k = 0; k <= kSteps; ++k) {
        const double t = static_cast<double>(k) / kSteps, x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y);
        if (x > box.x0 && x < box.x1 && y > box.y0 && y < box.y1) return true;
    }
    return false;
}

double cost_of(const Place& place, const std::vector<NamedLine>& lines, const std::vector<PlacedLabel>& placed,
               const PixelBox& room) {
    const PixelBox& box = place.label.box;
    double cost = place.preference;
    if (box.x0 < room.x0 || box.x1 > room.x1 || box.y0 < room.y0 || box.y1 > room.y1) cost += kOutside;
    for (const PlacedLabel& other : placed)
        cost += box.overlaps(other.box) ? kOnLabel : 0;
    for (const NamedLine& line : lines) {
        for (std::size_t k = 0; k < line.points.size(); ++k) {
            const PixelPosition p = line.points[k];
            if (box.overlaps({p.x - kMarker, p.y - kMarker, p.x + kMarker, p.y + kMarker})) cost += kOnPoint;
            if (k > 0 && crosses(box, line.points[k - 1], p)) cost += kOnLine;
        }
    }
    return cost;
}

} // namespace

double text_width(const std::string& text, double font_size) {
    return 0.56 * font_size * static_cast<double>(text.size());
}

std::vector<PlacedLabel> place_labels(const std::vector<NamedLine>& lines, const PixelBox& room, double font_size) {
    std::vector<PlacedLabel> placed;
    for (const NamedLine& line : lines) {
        const double width = text_width(line.name, font_size);
        std::vector<Place> places;
        if (line.points.empty()) {
            placed.emplace_back();
            continue;
        }
        add_places(line.points.back(), width, font_size, 0, places);
        if (line.points.size() > 1) add_places(line.points.front(), width, font_size, kOtherEnd, places);
        double best = std::numeric_limits<double>::infinity();
        PlacedLabel chosen;
        for (const Place& place : places) {
            const double cost = cost_of(place, lines, placed, room);
            if (cost < best) best = cost, chosen = place.label;
        }
        placed.push_back(chosen);
    }
    return placed;
}

} // namespace fetexc::cli
