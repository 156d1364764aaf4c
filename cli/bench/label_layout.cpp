// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/label_layout.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

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

/// Without the other labels.
double cost_of(const Place& place, const std::vector<NamedLine>& lines, const PixelBox& room) {
    const PixelBox& box = place.label.box;
    double cost = place.preference;
    if (box.x0 < room.x0 || box.x1 > room.x1 || box.y0 < room.y0 || box.y1 > room.y1) cost += kOutside;
    for (const NamedLine& line : lines) {
        for (std::size_t k = 0; k < line.points.size(); ++k) {
            const PixelPosition p = line.points[k];
            if (box.overlaps({p.x - kMarker, p.y - kMarker, p.x + kMarker, p.y + kMarker})) cost += kOnPoint;
            if (k > 0 && crosses(box, line.points[k - 1], p)) cost += kOnLine;
        }
    }
    return cost;
}

/// A label's places, and the one it has.
struct Choice {
    std::vector<Place> places; ///< preference: all of cost_of
    std::size_t chosen = 0;

    [[nodiscard]] const PlacedLabel& label() const { return places[chosen].label; }
};

class LabelLayout {
  public:
    LabelLayout(const std::vector<NamedLine>& lines, const PixelBox& room, double font_size) {
        for (const NamedLine& line : lines) {
            const double width = text_width(line.name, font_size);
            Choice c;
            if (line.points.empty())
                c.places.emplace_back();
            else
                add_places(line.points.back(), width, font_size, 0, c.places);
            if (line.points.size() > 1) add_places(line.points.front(), width, font_size, kOtherEnd, c.places);
            for (Place& p : c.places)
                p.preference = cost_of(p, lines, room);
            const auto best = std::ranges::min_element(c.places, {}, &Place::preference);
            c.chosen = static_cast<std::size_t>(best - c.places.begin());
            choices_.push_back(std::move(c));
        }
    }

    /// Two labels at a time are moved to the places that are best for both, until none gets better.
    std::vector<PlacedLabel> run() {
        for (bool better = true; better;) {
            better = false;
            for (std::size_t a = 0; a < choices_.size(); ++a) {
                for (std::size_t b = 0; b < choices_.size(); ++b)
                    better = (a != b && move(choices_[a], choices_[b])) || better;
            }
        }
        std::vector<PlacedLabel> out;
        for (const Choice& c : choices_)
            out.push_back(c.label());
        return out;
    }

  private:
    static double on_each_other(const PlacedLabel& a, const PlacedLabel& b) {
        return a.box.overlaps(b.box) ? kOnLabel : 0;
    }
    /// Of a label there, with all but two others.
    [[nodiscard]] double cost(const Place& place, const Choice& a, const Choice& b) const {
        double cost = place.preference;
        for (const Choice& c : choices_)
            cost += &c != &a && &c != &b ? on_each_other(place.label, c.label()) : 0;
        return cost;
    }
    bool move(Choice& a, Choice& b) const {
        std::vector<double> cost_a, cost_b;
        for (const Place& p : a.places)
            cost_a.push_back(cost(p, a, b));
        for (const Place& p : b.places)
            cost_b.push_back(cost(p, a, b));
        const auto both = [&](std::size_t i, std::size_t k) {
            return cost_a[i] + cost_b[k] + on_each_other(a.places[i].label, b.places[k].label);
        };
        double best = both(a.chosen, b.chosen);
        bool moved = false;
        for (std::size_t i = 0; i < a.places.size(); ++i) {
            for (std::size_t k = 0; k < b.places.size(); ++k) {
                if (both(i, k) < best - budget::kLabelWorth)
                    best = both(i, k), a.chosen = i, b.chosen = k, moved = true;
            }
        }
        return moved;
    }

    std::vector<Choice> choices_;
};

} // namespace

double text_width(const std::string& text, double font_size) {
    return 0.56 * font_size * static_cast<double>(text.size());
}

std::vector<PlacedLabel> place_labels(const std::vector<NamedLine>& lines, const PixelBox& room, double font_size) {
    return LabelLayout(lines, room, font_size).run();
}

} // namespace fetexc::cli
