// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/svg/scene_mapping.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "compiler/diagnostics.h"
#include "compiler/scene/scene_builder.h"
#include "compiler/svg/gradient.h"

namespace fetexc::svg {
namespace {

/// A gradient with more bands than this keeps its hard edges inside the paint (warning 2014).
constexpr std::size_t kMostBands = 256;

Affine to_affine(const fetexc_svg_affine& m) { return {m.a, m.b, m.c, m.d, m.e, m.f}; }

std::string to_string(const fetexc_svg_string& s) { return {s.text, s.length}; }

} // namespace

std::vector<CanvasContour> contours_of(const fetexc_svg_view& view, const fetexc_svg_shape& shape) {
    std::vector<CanvasContour> contours;
    contours.reserve(shape.count);
    for (std::uint32_t i = 0; i < shape.count; ++i) {
        const fetexc_svg_contour& c = view.contours[shape.first + i];
        CanvasContour& contour = contours.emplace_back();
        contour.reserve(c.count);
        for (const fetexc_svg_segment* s = view.segments + c.first; s != view.segments + c.first + c.count; ++s) {
            CanvasSegment& segment = contour.emplace_back();
            segment.degree = static_cast<int>(s->degree);
            for (std::size_t k = 0; k < 4; ++k)
                segment.p[k] = {s->p[2 * k], s->p[2 * k + 1]};
        }
    }
    return contours;
}

namespace {

std::vector<GradientStop> stops_of(const fetexc_svg_view& view, const fetexc_svg_paint& paint) {
    std::vector<GradientStop> stops;
    for (std::uint32_t i = 0; i < paint.stop_count; ++i) {
        const fetexc_svg_stop& s = view.stops[paint.stop + i];
        stops.push_back({s.offset, {s.r, s.g, s.b, s.a}});
    }
    return stops;
}

Gradient gradient_of(const fetexc_svg_view& view, const fetexc_svg_paint& p) {
    Gradient g;
    g.radial = p.kind == FETEXC_SVG_RADIAL;
    g.canvas_to_gradient = to_affine(p.to_paint);
    g.stops = stops_of(view, p);
    g.spread = static_cast<Spread>(p.spread);
    if (g.radial)
        std::tie(g.cx, g.cy, g.r, g.fx, g.fy, g.fr) = std::tie(p.v[0], p.v[1], p.v[2], p.v[3], p.v[4], p.v[5]);
    else
        std::tie(g.x1, g.y1, g.x2, g.y2) = std::tie(p.v[0], p.v[1], p.v[2], p.v[3]);
    return g;
}

Paint raster_of(const fetexc_svg_view& view, const fetexc_svg_paint& p) {
    const std::uint8_t* first = view.bytes + p.offset;
    const std::size_t size = std::size_t{4} * p.width * p.height;
    return RasterPaint{p.width, p.height, {first, first + size}, to_affine(p.to_paint), p.smooth != 0};
}

/// Equal gradients get equal keys, so that shapes which share one also share its bands.
std::string key_of(const fetexc_svg_view& view, const fetexc_svg_paint& p) {
    std::string key(reinterpret_cast<const char*>(&p.kind), 2 * sizeof(std::uint32_t));
    key.append(reinterpret_cast<const char*>(p.v), sizeof p.v);
    key.append(reinterpret_cast<const char*>(&p.to_paint), sizeof p.to_paint);
    key.append(reinterpret_cast<const char*>(view.stops + p.stop), p.stop_count * sizeof(fetexc_svg_stop));
    return key;
}

/// How a fill is painted: once, or once for each band, within the clip.
struct PaintedPart {
    std::uint32_t paint = kNone, clip = kNone;
};
using PaintedParts = std::vector<PaintedPart>;

class Mapper {
  public:
    Mapper(const fetexc_svg_view& view, bool cull, std::vector<Diagnostic>& diagnostics)
        : view_(view), cull_(cull), builder_(view.width, view.height), diagnostics_(diagnostics) {}

    Result<Scene> run() {
        for (std::size_t i = 0; i < view_.element_count; ++i)
            builder_.add_element(to_string(view_.elements[i]));
        for (std::size_t i = 0; i < view_.shape_count; ++i) {
            const fetexc_svg_shape& s = view_.shapes[i];
            const FillRule rule = s.rule == 0 ? FillRule::NonZero : FillRule::EvenOdd;
            builder_.add_shape(contours_of(view_, s), rule, s.element);
        }
        add_clips();
        add_nodes();
        add_masks();
        return builder_.finish({cull_});
    }

  private:
    void add_clips() {
        for (std::size_t i = 0; i < view_.clip_count; ++i) {
            const fetexc_svg_clip& c = view_.clips[i];
            Clip clip{{}, c.parent};
            for (std::uint32_t k = 0; k < c.count; ++k) {
                const fetexc_svg_clip_member& m = view_.clip_members[c.first + k];
                clip.members.push_back({m.shape, m.clip});
            }
            builder_.scene().clips.push_back(std::move(clip));
        }
    }

    /// Fills may become several nodes, so ends are renumbered afterwards.
    void add_nodes() {
        std::vector<Node>& nodes = builder_.scene().nodes;
        first_.resize(view_.node_count + 1);
        for (std::size_t i = 0; i < view_.node_count; ++i) {
            first_[i] = static_cast<std::uint32_t>(nodes.size());
            if (view_.nodes[i].kind == FETEXC_SVG_GROUP)
                add_group(view_.nodes[i]);
            else
                add_fill(view_.nodes[i]);
        }
        first_[view_.node_count] = static_cast<std::uint32_t>(nodes.size());
        for (Node& node : nodes)
            if (node.kind == Node::Kind::Group) node.end = first_[node.end];
        builder_.scene().root_end = first_[view_.root_end];
    }

    void add_group(const fetexc_svg_node& n) {
        Node node;
        node.kind = Node::Kind::Group;
        node.end = n.end; // still the front end's numbering
        node.clip = n.clip;
        node.opacity = n.opacity;
        node.blend = static_cast<Blend>(n.blend);
        node.mask = n.mask;
        node.isolated = n.isolated != 0;
        builder_.scene().nodes.push_back(node);
    }

    void add_fill(const fetexc_svg_node& n) {
        std::vector<Node>& nodes = builder_.scene().nodes;
        for (const PaintedPart& part : parts(n)) {
            Node node;
            node.clip = part.clip;
            node.shape = n.shape;
            node.paint = part.paint;
            node.element = n.element;
            nodes.push_back(node);
            nodes.back().end = static_cast<std::uint32_t>(nodes.size());
        }
    }

    void add_masks() {
        for (std::size_t i = 0; i < view_.mask_count; ++i) {
            const fetexc_svg_mask& m = view_.masks[i];
            Mask mask;
            mask.first = first_[m.first];
            mask.end = first_[m.end];
            mask.luminance = m.luminance != 0;
            mask.linear_rgb = m.linear_rgb != 0;
            mask.region_shape = m.region;
            mask.parent = m.parent;
            builder_.scene().masks.push_back(mask);
        }
    }

    std::uint32_t add_paint(Paint paint) {
        std::vector<Paint>& paints = builder_.scene().paints;
        paints.push_back(std::move(paint));
        return static_cast<std::uint32_t>(paints.size() - 1);
    }

    PaintedParts parts(const fetexc_svg_node& n) {
        const fetexc_svg_paint& p = view_.paints[n.paint];
        if (p.kind == FETEXC_SVG_SOLID) return {{add_paint(SolidPaint{stops_of(view_, p)[0].color})}};
        if (p.kind == FETEXC_SVG_RASTER) return {{add_paint(raster_of(view_, p))}};
        const std::string key = key_of(view_, p);
        if (const auto known = gradients_.find(key); known != gradients_.end()) return known->second;
        const Gradient g = gradient_of(view_, p);
        if (!has_hard_edges(g)) return gradients_[key] = {{add_paint(as_paint(g))}};
        if (PaintedParts all = banded(g, canvas(), n.element); !all.empty()) return gradients_[key] = std::move(all);
        // Too many for the whole canvas, perhaps not for this shape.
        if (PaintedParts own = banded(g, seen(n.shape), n.element); !own.empty()) return own;
        const char* text =
            "the gradient's hard edges are too many or of a kind that can't be cut; they are not features";
        diagnostics_.push_back({Severity::Warning, diag::kSvgGradientBands, text, name_of(n.element)});
        return gradients_[key] = {{add_paint(as_paint(g))}};
    }

    PaintedParts banded(const Gradient& g, const Box& seen, std::uint32_t element) {
        PaintedParts parts;
        if (!(seen.x0 < seen.x1 && seen.y0 < seen.y1)) return parts;
        for (Band& band : bands_of(g, seen, canvas(), kMostBands)) {
            PaintedPart part{add_paint(std::move(band.paint)), kNone};
            if (!band.region.empty()) {
                const std::uint32_t shape = builder_.add_shape(band.region, band.rule, element);
                builder_.scene().clips.push_back({{{shape, kNone}}, kNone});
                part.clip = static_cast<std::uint32_t>(builder_.scene().clips.size() - 1);
            }
            parts.push_back(part);
        }
        return parts;
    }

    [[nodiscard]] Box canvas() const { return {0, 0, view_.width, view_.height}; }

    /// Visible part of a shape's box.
    [[nodiscard]] Box seen(std::uint32_t shape) const {
        Box box{INFINITY, INFINITY, -INFINITY, -INFINITY};
        const fetexc_svg_shape& s = view_.shapes[shape];
        for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
            const fetexc_svg_contour& c = view_.contours[i];
            for (std::uint32_t k = c.first; k < c.first + c.count; ++k)
                for (std::size_t q = 0; q <= view_.segments[k].degree; ++q) {
                    const double x = view_.segments[k].p[2 * q], y = view_.segments[k].p[2 * q + 1];
                    box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
                }
        }
        return {std::max(box.x0, 0.0), std::max(box.y0, 0.0), std::min(box.x1, view_.width),
                std::min(box.y1, view_.height)};
    }

    [[nodiscard]] std::string name_of(std::uint32_t element) const {
        return element < view_.element_count ? to_string(view_.elements[element]) : std::string();
    }

    const fetexc_svg_view& view_;
    bool cull_;
    SceneBuilder builder_;
    std::vector<Diagnostic>& diagnostics_;
    std::vector<std::uint32_t> first_; ///< first scene node of each node of the front end
    std::map<std::string, PaintedParts> gradients_;
};

} // namespace

Result<Scene> to_scene(const fetexc_svg_view& view, bool cull, std::vector<Diagnostic>& diagnostics) {
    return Mapper(view, cull, diagnostics).run();
}

} // namespace fetexc::svg
