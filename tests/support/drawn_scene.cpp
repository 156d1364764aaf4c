// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/drawn_scene.h"

#include <algorithm>

namespace fetexc::test {

Scene scene_of(const std::vector<Path>& paths, FillRule rule, std::int64_t unit) {
    Scene s;
    s.extent = {512, 512, kLatticeSteps, kLatticeSteps};
    for (const Path& path : paths) {
        const auto k = static_cast<std::uint32_t>(s.shapes.size());
        s.shapes.push_back(
            {static_cast<std::uint32_t>(s.segments.size()), static_cast<std::uint32_t>(path.size()), rule, kNone});
        for (const auto& points : path) {
            Segment segment;
            segment.degree = static_cast<int>(points.size()) - 1;
            for (std::size_t i = 0; i < points.size(); ++i)
                segment.p[i] = {points[i].x * unit, points[i].y * unit};
            s.segments.push_back(segment);
        }
        const double v = 0.1 + 0.8 * static_cast<double>(k % 9) / 9;
        s.paints.emplace_back(SolidPaint{{v, 1 - v, 0.5, 1}});
        Node node;
        node.end = k + 1, node.shape = k, node.paint = k;
        s.nodes.push_back(node);
    }
    s.root_end = static_cast<std::uint32_t>(s.nodes.size());
    return s;
}

Path closed(Path segments) {
    const LatticePoint start = segments.front().front(), end = segments.back().back();
    if (start != end) segments.push_back({end, start});
    return segments;
}

Path box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
    return {{{x0, y0}, {x1, y0}}, {{x1, y0}, {x1, y1}}, {{x1, y1}, {x0, y1}}, {{x0, y1}, {x0, y0}}};
}

std::vector<LatticePoint> half_of(std::vector<LatticePoint> c, bool first) {
    std::vector<LatticePoint> half;
    for (; !c.empty(); c.pop_back()) {
        half.push_back(first ? c.front() : c.back());
        for (std::size_t i = 0; i + 1 < c.size(); ++i)
            c[i] = {(c[i].x + c[i + 1].x) / 2, (c[i].y + c[i + 1].y) / 2};
    }
    if (!first) std::reverse(half.begin(), half.end());
    return half;
}

} // namespace fetexc::test
