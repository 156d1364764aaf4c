// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/drawing.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <istream>
#include <iterator>
#include <ostream>
#include <sstream>

namespace fetexc::test {
namespace {

Path without_gaps(const Path& path) {
    Path out;
    for (const auto& curve : path) {
        if (!out.empty() && out.back().back() != curve.front()) out.push_back({out.back().back(), curve.front()});
        out.push_back(curve);
    }
    return out.empty() ? out : closed(out);
}

template <class Visit> void each_point(const Drawing& drawing, const Visit& visit) {
    for (const Path& path : drawing.paths) {
        for (const auto& curve : path)
            std::for_each(curve.begin(), curve.end(), visit);
    }
}

Error malformed(std::size_t line, const std::string& what) {
    return {ErrorClass::InvalidInput, 0, what, "line " + std::to_string(line)};
}

/// DEGREE X Y …; coordinates beyond the lattice's limit are refused.
bool read_curve(std::istringstream& in, std::int64_t unit, int degree, Path& path) {
    std::vector<LatticePoint> curve;
    for (int i = 0; i <= degree; ++i) {
        LatticePoint p;
        const auto fits = [&](std::int64_t v) { return v >= -kLatticeLimit / unit && v <= kLatticeLimit / unit; };
        if (!(in >> p.x >> p.y) || !fits(p.x) || !fits(p.y)) return false;
        curve.push_back({p.x * unit, p.y * unit});
    }
    path.push_back(curve);
    return true;
}

} // namespace

Scene scene_of(const Drawing& drawing) {
    std::vector<Path> paths;
    std::transform(drawing.paths.begin(), drawing.paths.end(), std::back_inserter(paths), without_gaps);
    return scene_of(paths, drawing.rule, 1);
}

bool lies_inside(const Drawing& drawing) {
    bool inside = true;
    each_point(drawing, [&](LatticePoint p) {
        inside = inside && p.x > 0 && p.y > 0 && p.x < kLatticeSteps && p.y < kLatticeSteps;
    });
    return inside;
}

std::size_t curve_count(const Drawing& drawing) {
    std::size_t n = 0;
    for (const Path& path : drawing.paths)
        n += path.size();
    return n;
}

Drawing mapped(Drawing drawing, const LatticeMap& map) {
    for (Path& path : drawing.paths) {
        for (auto& curve : path)
            std::transform(curve.begin(), curve.end(), curve.begin(), map);
    }
    return drawing;
}

Drawing reversed(Drawing drawing) {
    for (Path& path : drawing.paths) {
        std::reverse(path.begin(), path.end());
        for (auto& curve : path)
            std::reverse(curve.begin(), curve.end());
    }
    return drawing;
}

Drawing permuted(Drawing drawing) {
    std::reverse(drawing.paths.begin(), drawing.paths.end());
    for (Path& path : drawing.paths)
        std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2), path.end());
    return drawing;
}

std::vector<CanvasContour> contours_of(const Drawing& drawing, double unit) {
    std::vector<CanvasContour> out;
    for (const Path& path : drawing.paths) {
        CanvasContour contour;
        for (const auto& curve : path) {
            CanvasSegment s;
            s.degree = static_cast<int>(curve.size()) - 1;
            std::transform(curve.begin(), curve.end(), s.p.begin(), [unit](LatticePoint p) {
                return CanvasPoint{static_cast<double>(p.x) * unit, static_cast<double>(p.y) * unit};
            });
            contour.push_back(s);
        }
        out.push_back(contour);
    }
    return out;
}

Result<Drawing> read_drawing(std::istream& in) {
    Drawing out;
    std::int64_t unit = 1;
    std::string text;
    for (std::size_t line = 1; std::getline(in, text); ++line) {
        std::istringstream words(text.substr(0, text.find('#')));
        std::string word;
        if (!(words >> word)) continue;
        if (word == "path") {
            out.paths.emplace_back();
        } else if (word == "rule") {
            if (!(words >> word) || (word != "evenodd" && word != "nonzero")) return malformed(line, "unknown rule");
            out.rule = word == "evenodd" ? FillRule::EvenOdd : FillRule::NonZero;
        } else if (word == "unit") {
            if (!(words >> unit) || unit < 1 || unit > kLatticeSteps)
                return malformed(line, "the unit is out of range");
        } else if (word == "1" || word == "2" || word == "3") {
            if (out.paths.empty()) return malformed(line, "a curve before the first path");
            if (!read_curve(words, unit, word[0] - '0', out.paths.back()))
                return malformed(line, "a coordinate is missing or out of range");
        } else {
            return malformed(line, "neither path, rule, unit nor a degree");
        }
        if (words >> word) return malformed(line, "too much on one line");
    }
    return out;
}

Result<Drawing> read_drawing(const std::string& file) {
    std::ifstream in(file);
    if (!in) return Error{ErrorClass::Io, 0, "can't be read", file};
    Result<Drawing> out = read_drawing(in);
    if (!out) return Error{out.error().cls, 0, out.error().message, file + ", " + out.error().place};
    return out;
}

void write_drawing(const Drawing& drawing, std::ostream& out) {
    std::uint64_t bits = static_cast<std::uint64_t>(kLatticeSteps);
    each_point(drawing,
               [&](LatticePoint p) { bits |= static_cast<std::uint64_t>(p.x) | static_cast<std::uint64_t>(p.y); });
    const std::int64_t unit = std::int64_t{1} << std::countr_zero(bits);
    if (drawing.rule == FillRule::EvenOdd) out << "rule evenodd\n";
    if (unit != 1) out << "unit " << unit << "\n";
    for (const Path& path : drawing.paths) {
        out << "path\n";
        for (const auto& curve : path) {
            out << curve.size() - 1;
            for (const LatticePoint p : curve)
                out << ' ' << p.x / unit << ' ' << p.y / unit;
            out << '\n';
        }
    }
}

} // namespace fetexc::test
