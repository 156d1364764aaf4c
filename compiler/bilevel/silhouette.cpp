// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/scene/compositor.h"

namespace fetexc {
namespace {

constexpr double kCut = 0.5; ///< of alpha, of luma

/// Point at t of an edge, by de Casteljau.
WidthPoint point_on(const VisibleEdge& e, double t) {
    std::array<WidthPoint, 4> p = e.p;
    for (int n = e.degree; n > 0; --n) {
        for (int k = 0; k < n; ++k)
            p[k] = {p[k].x + t * (p[k + 1].x - p[k].x), p[k].y + t * (p[k + 1].y - p[k].y)};
    }
    return p[0];
}

double chord(const VisibleEdge& e) {
    const WidthPoint a = e.p[0], b = e.p[static_cast<std::size_t>(e.degree)];
    return std::hypot(b.x - a.x, b.y - a.y);
}

void reverse(VisibleEdge& e) {
    std::reverse(e.p.begin(), e.p.begin() + e.degree + 1);
    std::swap(e.left, e.right);
}

/// Where nothing else decides: results' ids don't, they depend on which thread came first.
std::array<double, 4> order_of(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

/// The scene's results, told apart by a rule.
class SceneSilhouette {
  public:
    SceneSilhouette(const Scene& scene, SilhouetteRule::Kind kind) : scene_(scene), kind_(kind), compositor_(scene) {}

    Result<Silhouette> find(unsigned threads) {
        ResultId somewhere = 0;
        auto edges = visible_edges(scene_, compositor_, threads, &somewhere);
        if (!edges) return edges.error();
        for (const VisibleEdge& e : edges.value()) {
            for (const ResultId r : {e.left, e.right})
                see(r, e);
        }
        if (kind_ == SilhouetteRule::Kind::TwoColors) {
            if (const Status two = find_two_colors(); !two) return two.error();
        }
        if (seen_.empty()) {
            const CanvasPoint middle{scene_.extent.width / 2, scene_.extent.height / 2};
            seen_[somewhere].color = compositor_.color(somewhere, middle);
        }
        Silhouette out;
        out.height = scene_.extent.height / scene_.extent.width;
        for (VisibleEdge& e : edges.value())
            add(e, out);
        out.above_everywhere = out.edges.empty() && is_above(seen_.begin()->first);
        choose_colors(out);
        return out;
    }

  private:
    /// A result along its edges.
    struct Seen {
        double length = 0;
        Rgba sum;   ///< colours that vary, in the middles of the edges, times their lengths
        Rgba color; ///< the one that it has, or the mean
    };

    void see(ResultId r, const VisibleEdge& e) {
        Seen& seen = seen_[r];
        const double length = chord(e);
        seen.length += length;
        if (compositor_.is_solid(r)) {
            seen.color = compositor_.color(r, {});
            return;
        }
        const WidthPoint p = point_on(e, 0.5);
        const Rgba c = compositor_.color(r, {p.x * scene_.extent.width, p.y * scene_.extent.width});
        Rgba& sum = seen.sum;
        sum = {sum.r + length * c.r, sum.g + length * c.g, sum.b + length * c.b, sum.a + length * c.a};
        const double n = seen.length;
        seen.color = n > 0 ? Rgba{sum.r / n, sum.g / n, sum.b / n, sum.a / n} : c;
    }

    Status find_two_colors() {
        const auto wrong = [](const char* what) {
            return Error{ErrorClass::Unsupported, diag::kNotTwoColors, what, "--silhouette"};
        };
        if (seen_.size() != 2) {
            return wrong(seen_.size() < 2 ? "the drawing has one colour: nothing to show"
                                          : "the drawing has more than two colours: choose a silhouette");
        }
        for (const auto& [result, seen] : seen_) {
            if (!compositor_.is_solid(result)) return wrong("the drawing's colours vary: choose a silhouette");
        }
        const auto& [a, seen_a] = *seen_.begin();
        const auto& [b, seen_b] = *seen_.rbegin();
        const Rgba &ca = seen_a.color, &cb = seen_b.color;
        const double la = luma_over_white(ca), lb = luma_over_white(cb);
        const bool first = ca.a != cb.a ? ca.a > cb.a : la != lb ? la < lb : order_of(ca) < order_of(cb);
        above_result_ = first ? a : b;
        return {};
    }

    /// Of a result as a whole, also where its colours vary: the outline is closed.
    [[nodiscard]] bool is_above(ResultId r) const {
        if (kind_ == SilhouetteRule::Kind::TwoColors) return r == above_result_;
        const Rgba& c = seen_.at(r).color;
        return kind_ == SilhouetteRule::Kind::Luminance ? luma_over_white(c) < kCut : c.a > kCut;
    }

    void add(VisibleEdge e, Silhouette& out) const {
        const bool left = is_above(e.left), right = is_above(e.right);
        if (left == right) return;
        if (!compositor_.is_solid(e.left) || !compositor_.is_solid(e.right)) ++out.edges_varying;
        if (right) reverse(e);
        e.left = 1, e.right = 0;
        out.edges.push_back(e);
    }

    /// Of each side that of the result with the longest edges.
    void choose_colors(Silhouette& out) const {
        const Seen* chosen[2] = {nullptr, nullptr};
        for (const auto& [result, seen] : seen_) {
            const Seen*& c = chosen[is_above(result) ? 1 : 0];
            if (c == nullptr || seen.length > c->length ||
                (seen.length == c->length && order_of(seen.color) < order_of(c->color)))
                c = &seen;
        }
        if (chosen[0] != nullptr) out.below = chosen[0]->color;
        if (chosen[1] != nullptr) out.above = chosen[1]->color;
    }

    const Scene& scene_;
    SilhouetteRule::Kind kind_;
    Compositor compositor_;
    std::map<ResultId, Seen> seen_;
    ResultId above_result_ = 0;
};

/// A scene of the element's shapes alone, opaque.
Result<Scene> scene_of_element(const Scene& scene, const std::string& id) {
    Scene out;
    out.extent = scene.extent, out.segments = scene.segments, out.shapes = scene.shapes;
    out.paints = {SolidPaint{{0, 0, 0, 1}}};
    for (const Node& n : scene.nodes) {
        if (n.kind != Node::Kind::Fill || n.element == kNone) continue;
        const std::string& name = scene.elements[n.element].name;
        const std::size_t hash = name.find('#');
        if (hash == std::string::npos || name.substr(hash + 1) != id) continue;
        Node fill;
        fill.shape = n.shape, fill.paint = 0, fill.element = n.element;
        out.nodes.push_back(fill);
        out.nodes.back().end = static_cast<std::uint32_t>(out.nodes.size());
    }
    out.root_end = static_cast<std::uint32_t>(out.nodes.size());
    out.elements = scene.elements;
    if (out.nodes.empty())
        return Error{ErrorClass::Usage, diag::kNoSuchElement, "no visible shape is of element #" + id, "--silhouette"};
    return out;
}

} // namespace

Result<Silhouette> silhouette_of(const Scene& scene, const SilhouetteRule& rule, unsigned threads) {
    if (rule.kind != SilhouetteRule::Kind::Element) return SceneSilhouette(scene, rule.kind).find(threads);
    const auto element = scene_of_element(scene, rule.element);
    if (!element) return element.error();
    return SceneSilhouette(element.value(), SilhouetteRule::Kind::Alpha).find(threads);
}

std::vector<OutlineSegment> outline_in_texels(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height) {
    const double sx = width, sy = height / silhouette.height;
    std::vector<OutlineSegment> out;
    for (const VisibleEdge& e : silhouette.edges) {
        // A chord of a curve with second derivative d misses it by at most d/8 of the square of its part.
        double bend = 0;
        for (int k = 0; k + 2 <= e.degree; ++k) {
            bend = std::max(bend, std::hypot((e.p[k].x - 2 * e.p[k + 1].x + e.p[k + 2].x) * sx,
                                             (e.p[k].y - 2 * e.p[k + 1].y + e.p[k + 2].y) * sy));
        }
        const double second = bend * e.degree * (e.degree - 1);
        const int chords = std::max(1, static_cast<int>(std::ceil(std::sqrt(second / 8 / budget::kOutlineChord))));
        WidthPoint from = e.p[0];
        for (int k = 1; k <= chords; ++k) {
            const WidthPoint to =
                k == chords ? e.p[static_cast<std::size_t>(e.degree)] : point_on(e, static_cast<double>(k) / chords);
            out.push_back({from.x * sx, from.y * sy, to.x * sx, to.y * sy});
            from = to;
        }
    }
    return out;
}

} // namespace fetexc
