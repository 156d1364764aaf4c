// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/plot.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "cli/bench/label_layout.h"
#include "cli/bench/log_scale.h"

namespace fetexc::cli {
namespace {

constexpr const char* kInk = "#222222";
constexpr const char* kGrid = "#dddddd";
constexpr const char* kFont = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// Colours of Okabe and Ito's palette; each also has its own lightness, mark and dashes.
struct Style {
    const char* color;
    const char* dashes;
    double width;
};
constexpr std::array<Style, kPlotStyles> kStyles = {{{"#0072b2", "", 2.6},
                                                     {"#d55e00", "8 3", 1.8},
                                                     {"#009e73", "2 3", 1.8},
                                                     {"#9b4d8f", "9 3 2 3", 1.8},
                                                     {"#8a6500", "5 2 1 2", 1.8},
                                                     {"#222222", "", 1.8},
                                                     {"#c2185b", "12 3", 1.8},
                                                     {"#3f8f29", "1 3", 1.8},
                                                     {"#5b4bb7", "6 2 2 2", 1.8}}};

/// Round, square, triangle, diamond, triangle on its point, cross, bar, hexagon, bow tie.
std::string mark(std::size_t style, double x, double y, bool hollow, const std::string& description) {
    const char* color = kStyles[style].color;
    const std::string paint =
        fmt::format(R"(fill="{}" stroke="{}" stroke-width="1.6")", hollow ? "#ffffff" : color, color);
    const auto closed = [&](const char* element) {
        return description.empty() ? std::string("/>")
                                   : fmt::format("><title>{}</title></{}>", escaped(description), element);
    };
    switch (style) {
    case 0:
        return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4" {}{})", x, y, paint, closed("circle"));
    case 1:
        return fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="7" height="7" {}{})", x - 3.5, y - 3.5, paint,
                           closed("rect"));
    case 2:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}l4.6,8h-9.2z" {}{})", x, y - 5, paint, closed("path"));
    case 3:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}l5,5l-5,5l-5,-5z" {}{})", x, y - 5, paint, closed("path"));
    case 4:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}l4.6,-8h-9.2z" {}{})", x, y + 5, paint, closed("path"));
    case 6:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}h11v4h-11z" {}{})", x - 5.5, y - 2, paint, closed("path"));
    case 7:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}l4.2,2.4v4.8l-4.2,2.4l-4.2,-2.4v-4.8z" {}{})", x, y - 4.8, paint,
                           closed("path"));
    case 8:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}l10,8v-8l-10,8z" {}{})", x - 5, y - 4, paint, closed("path"));
    default:
        return fmt::format(R"(<path d="M{:.1f},{:.1f}h3v3h3v3h-3v3h-3v-3h-3v-3h3z" {}{})", x - 1.5, y - 4.5, paint,
                           closed("path"));
    }
}

std::string line_style(std::size_t style) {
    const Style& s = kStyles[style];
    const std::string dashes = *s.dashes == 0 ? "" : fmt::format(R"( stroke-dasharray="{}")", s.dashes);
    return fmt::format(R"(fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round"{})", s.color, s.width,
                       dashes);
}

std::string text_at(double x, double y, const char* anchor, double size, const std::string& text,
                    const std::string& more = {}) {
    return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="{}" fill="{}"{}>{}</text>)", x, y,
                       anchor, size, kInk, more, escaped(text));
}

struct Range {
    double lo = std::numeric_limits<double>::infinity(), hi = 0;
    void add(double v) { lo = std::min(lo, v), hi = std::max(hi, v); }
};

template <class Of> Range range_of(const Plot& plot, const Axis& axis, const Of& of) {
    Range range;
    if (axis.range) return {(*axis.range)[0], (*axis.range)[1]};
    for (const PlotLine& line : plot.lines) {
        for (const PlotPoint& p : line.points)
            range.add(of(p));
    }
    return range.hi > 0 ? range : Range{1, 10};
}

/// One plot on its way to text.
class Drawing {
  public:
    explicit Drawing(const Plot& plot)
        : plot_(plot), small_(plot.width < 400),
          font_(small_ ? 10 : 12), area_{small_ ? 52.0 : 78.0,
                                         12.0 + (plot.title.empty() ? 0 : 22) + (plot.note.empty() ? 0 : 16),
                                         plot.width - (small_ ? 10 : 16), plot.height - (small_ ? 40 : 54)},
          x_range_(range_of(plot, plot.x, [](const PlotPoint& p) { return p.x; })),
          y_range_(range_of(plot, plot.y, [](const PlotPoint& p) { return p.y; })),
          x_(x_range_.lo, x_range_.hi, area_.x0, area_.x1 - name_room()),
          y_(y_range_.lo, y_range_.hi, area_.y1, area_.y0) {}

    std::string body() {
        draw_title();
        draw_note();
        draw_axes();
        for (const PlotLine& line : plot_.lines)
            draw_line(line);
        if (plot_.names) draw_names();
        return out_;
    }

  private:
    /// Names may stand to the right of the last points.
    [[nodiscard]] double name_room() const {
        double longest = 0;
        for (const PlotLine& line : plot_.lines)
            longest = std::max(longest, text_width(line.name, font_));
        return plot_.names ? std::min(longest, 0.25 * plot_.width) : 0;
    }
    void draw_title() {
        if (!plot_.title.empty())
            out_ += text_at(small_ ? 4 : area_.x0, small_ ? 16 : 20, "start", small_ ? 11 : 14, plot_.title,
                            R"( font-weight="bold")");
    }
    void draw_note() {
        if (!plot_.note.empty()) out_ += text_at(area_.x0, area_.y0 - 9, "start", font_ - 1, plot_.note);
    }
    [[nodiscard]] static std::string label(const Axis& axis, double v) {
        return axis.unit == AxisUnit::Bytes ? bytes_label(v) : count_label(v);
    }
    void rule(double x0, double y0, double x1, double y1, const char* color) {
        out_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}"/>)", x0, y0, x1, y1,
                            color);
    }
    void draw_axes() {
        for (const double v : x_.ticks(small_ ? 4 : 8)) {
            rule(x_.pixel(v), area_.y0, x_.pixel(v), area_.y1, kGrid);
            out_ += text_at(x_.pixel(v), area_.y1 + font_ + 3, "middle", font_ - 1, label(plot_.x, v));
        }
        for (const double v : y_.ticks(small_ ? 5 : 8)) {
            rule(area_.x0, y_.pixel(v), area_.x1, y_.pixel(v), kGrid);
            out_ += text_at(area_.x0 - 5, y_.pixel(v) + font_ * 0.33, "end", font_ - 1, label(plot_.y, v));
        }
        rule(area_.x0, area_.y1, area_.x1, area_.y1, kInk);
        rule(area_.x0, area_.y0, area_.x0, area_.y1, kInk);
        const double middle = (area_.y0 + area_.y1) / 2, left = font_ + 1;
        out_ += text_at((area_.x0 + area_.x1) / 2, plot_.height - 8, "middle", font_, plot_.x.title);
        out_ += text_at(left, middle, "middle", font_, plot_.y.title,
                        fmt::format(R"~( transform="rotate(-90 {:.1f} {:.1f})")~", left, middle));
    }
    void draw_line(const PlotLine& line) {
        if (line.points.empty()) return;
        std::string path, marks;
        for (const PlotPoint& p : line.points) {
            path += fmt::format("{}{:.1f},{:.1f}", path.empty() ? "M" : "L", x_.pixel(p.x), y_.pixel(p.y));
            marks += mark(line.style, x_.pixel(p.x), y_.pixel(p.y), p.at_most, p.description);
        }
        out_ += fmt::format(R"(<path d="{}" {}/>)", path, line_style(line.style)) + marks;
    }
    void draw_names() {
        std::vector<NamedLine> lines;
        for (const PlotLine& line : plot_.lines) {
            NamedLine named{line.name, {}};
            for (const PlotPoint& p : line.points)
                named.points.push_back({x_.pixel(p.x), y_.pixel(p.y)});
            lines.push_back(std::move(named));
        }
        const auto placed = place_labels(lines, {area_.x0 + 2, area_.y0, plot_.width - 2, area_.y1 - 2}, font_);
        for (std::size_t k = 0; k < placed.size(); ++k) {
            if (lines[k].points.empty()) continue;
            out_ += fmt::format(
                R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}" font-size="{}" font-weight="bold" fill="{}" )"
                R"(stroke="#ffffff" stroke-width="3" paint-order="stroke">{}</text>)",
                placed[k].x, placed[k].y + font_ * 0.35, placed[k].right_aligned ? "end" : "start", font_,
                kStyles[plot_.lines[k].style].color, escaped(lines[k].name));
        }
    }

    const Plot& plot_;
    bool small_;
    double font_;
    PixelBox area_;
    Range x_range_, y_range_;
    LogScale x_, y_;
    std::string out_;
};

} // namespace

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
            out += c;
    }
    return out;
}

std::string legend_svg(std::size_t style) {
    return fmt::format(
        R"(<svg width="36" height="12" viewBox="0 0 36 12" aria-hidden="true"><path d="M1,6H35" {}/>{}</svg>)",
        line_style(style), mark(style, 18, 6, false, {}));
}

std::string plot_svg(const Plot& plot, bool stand_alone) {
    std::string out;
    if (stand_alone) out += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out += fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
                       R"(font-family="{2}" role="img">)",
                       plot.width, plot.height, kFont);
    if (stand_alone) out += R"(<rect width="100%" height="100%" fill="#ffffff"/>)";
    return out + Drawing(plot).body() + "</svg>\n";
}

} // namespace fetexc::cli
