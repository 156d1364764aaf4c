// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/feature_scene.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace fetexc {
namespace {

/// From a point on the border of the image or beyond it straight away from it, as far as the image is wide or high;
/// nothing for others.
std::optional<CanvasSegment> way_out(const CanvasPoint& p, double width, double height) {
    const auto outwards = [](double v, double size) { return v <= 0 ? -size : v >= size ? size : 0; };
    const double dx = outwards(p.x, width), dy = dx == 0 ? outwards(p.y, height) : 0;
    if (dx == 0 && dy == 0) return std::nullopt;
    return CanvasSegment{1, {p, {p.x + dx, p.y + dy}}};
}

/// There and back, so that it is closed; a lone line twice, as one pair of lines would be dropped as empty.
CanvasContour there_and_back(const CanvasContour& run) {
    CanvasContour out = run;
    for (auto s = run.rbegin(); s != run.rend(); ++s) {
        out.push_back(*s);
        std::reverse(out.back().p.begin(), out.back().p.begin() + s->degree + 1);
    }
    if (run.size() == 1) out.insert(out.end(), {out[0], out[1]});
    return out;
}

/// The direction that compiler/planar/merged_curves calls +1: the smaller control polygon.
void orient(Segment& s) {
    const auto end = s.p.begin() + s.degree + 1;
    if (std::lexicographical_compare(std::make_reverse_iterator(end), s.p.rend(), s.p.begin(), end))
        std::reverse(s.p.begin(), end);
}

auto key(const Segment& s) { return std::tie(s.degree, s.p); }

void keep_each_once(std::vector<Segment>& segments) {
    for (Segment& s : segments)
        orient(s);
    std::ranges::sort(segments, [](const Segment& a, const Segment& b) { return key(a) < key(b); });
    const auto same = [](const Segment& a, const Segment& b) { return key(a) == key(b); };
    segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
}

} // namespace

// Textures whose texels lie half outside have no end there.
CanvasContour prolonged(const CanvasContour& run, double width, double height) {
    const CanvasPoint first = run.front().p[0], last = run.back().p[static_cast<std::size_t>(run.back().degree)];
    if (first.x == last.x && first.y == last.y) return run;
    CanvasContour out;
    if (const auto way = way_out(first, width, height)) out.push_back({1, {way->p[1], way->p[0]}});
    out.insert(out.end(), run.begin(), run.end());
    if (const auto way = way_out(last, width, height)) out.push_back(*way);
    return out;
}

Result<Scene> feature_scene(const FeatureCurves& features, std::uint32_t image_width, std::uint32_t image_height) {
    SceneBuilder builder(image_width, image_height);
    const double sx = image_width / features.width, sy = image_height / features.height;
    std::vector<CanvasContour> contours;
    std::uint64_t segments = 0;
    for (const CanvasContour& run : features.runs) {
        if (run.empty()) continue;
        segments += run.size();
        contours.push_back(there_and_back(prolonged(run, features.width, features.height)));
        for (CanvasSegment& s : contours.back()) {
            for (CanvasPoint& p : s.p)
                p = {p.x * sx, p.y * sy};
        }
    }
    const std::uint32_t element = builder.add_element("features");
    Node node;
    node.end = 1;
    node.shape = builder.add_shape(std::move(contours), FillRule::NonZero, element);
    node.paint = 0;
    node.element = element;
    builder.scene().paints.emplace_back(SolidPaint{{0, 0, 0, 1}});
    builder.scene().nodes.push_back(node);
    builder.scene().root_end = 1;
    Result<Scene> scene = builder.finish({.cull = false});
    if (!scene) return scene;
    keep_each_once(scene.value().segments);
    scene.value().shapes[0].count = static_cast<std::uint32_t>(scene.value().segments.size());
    scene.value().stats.segments_in = segments;
    return scene;
}

bool has_features(const Scene& scene) {
    return std::ranges::any_of(scene.segments, [&](const Segment& s) {
        const auto [x0, x1] = std::minmax_element(s.p.begin(), s.p.begin() + s.degree + 1,
                                                  [](const auto& a, const auto& b) { return a.x < b.x; });
        const auto [y0, y1] = std::minmax_element(s.p.begin(), s.p.begin() + s.degree + 1,
                                                  [](const auto& a, const auto& b) { return a.y < b.y; });
        return x0->x <= scene.extent.lattice_w && x1->x >= 0 && y0->y <= scene.extent.lattice_h && y1->y >= 0;
    });
}

} // namespace fetexc
