// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/features.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "compiler/union_find.h"
#include "formats/fbt.h"

namespace fetexc {
namespace {

/// Regions: faces joined over invisible edges.
class RegionFinder {
  public:
    RegionFinder(const TexelMap& texel, TexelFeatures& out)
        : texel_(texel), out_(out), joined_(texel.sweep.faces.size()) {}

    /// Returns the visible sub-edges.
    std::vector<std::uint32_t> run() {
        const SweepResult& s = texel_.sweep;
        std::vector<std::uint32_t> visible;
        for (std::uint32_t f = 0; f < s.faces.size(); ++f)
            joined_.unite(f, s.face(f));
        for (const Portion& p : s.portions) {
            if (texel_.left_result(p) == texel_.right_result(p))
                joined_.unite(p.left, p.right);
            else
                visible.push_back(texel_.graph.edges[p.edge].sub);
        }
        out_.edges_visible = visible.size(), out_.edges_invisible = s.portions.size() - visible.size();
        number_regions();
        out_.corner_region = out_.region_of_face[s.first_face];
        return visible;
    }

  private:
    void number_regions() {
        std::vector<std::uint32_t> number(joined_.size(), kNone);
        out_.region_of_face.resize(joined_.size());
        out_.region_result.clear();
        for (std::uint32_t f = 0; f < joined_.size(); ++f) {
            const std::uint32_t r = joined_.find(f);
            if (number[r] == kNone) {
                number[r] = static_cast<std::uint32_t>(out_.region_result.size());
                out_.region_result.push_back(texel_.results[r]);
            }
            out_.region_of_face[f] = number[r];
        }
    }

    const TexelMap& texel_;
    TexelFeatures& out_;
    UnionFind joined_;
};

enum class Touch : std::uint8_t { None, Top, Bottom, Left, Right };

/// Everything about the visible part of one texel while its bands are built.
class BandBuilder {
  public:
    BandBuilder(const PlanarMap& map, TexelMapper& mapper, const TexelMap& texel, TexelFeatures& out)
        : map_(map), mapper_(mapper), texel_(texel), out_(out) {}

    bool run(const std::vector<std::uint32_t>& visible) {
        mapper_.collect(texel_.sub_edges, visible, graph_);
        find_cuts();
        if (!mapper_.sweep().run(texel_.sub_edges, graph_, cuts_, texel_.frame, sweep_)) return false;
        map_regions();
        std::vector<std::vector<std::uint32_t>> by_band(cuts_.size() + 1);
        for (std::uint32_t p = 0; p < sweep_.portions.size(); ++p)
            by_band[sweep_.portions[p].band].push_back(p);
        for (std::uint32_t b = 0; b < by_band.size(); ++b) {
            if (!build_band(b, by_band[b])) return false;
        }
        return true;
    }

  private:
    [[nodiscard]] const GridNode& node(std::uint32_t k) const { return map_.node(graph_.nodes[k]); }
    [[nodiscard]] bool on_texel_side(const GridNode& n) const {
        return n.hx == texel_.frame.left || n.hx == texel_.frame.left + 2 || n.hy == texel_.frame.top ||
               n.hy == texel_.frame.top + 2;
    }

    /// Band lines: the levels of interior nodes where other than two visible edges meet (FBT §3.2).
    void find_cuts() {
        std::vector<std::uint32_t> degree(graph_.nodes.size(), 0);
        for (const SweepEdge& e : graph_.edges)
            ++degree[e.top], ++degree[e.bottom];
        on_cut_.assign(graph_.nodes.size(), false);
        for (std::uint32_t k = 0; k < graph_.nodes.size();) {
            std::uint32_t last = k;
            bool junction = false;
            const bool border = node(k).hy != texel_.frame.top + 1;
            for (; last < graph_.nodes.size() && graph_.ranks[last].y == graph_.ranks[k].y; ++last) {
                junction = junction || (!on_texel_side(node(last)) && degree[last] != 2);
            }
            if (junction && !border) {
                cuts_.push_back({k, last});
                std::fill(on_cut_.begin() + k, on_cut_.begin() + last, true);
            }
            k = last;
        }
    }

    /// Region of every band face, through the first sweep's faces beside the same edge.
    void map_regions() {
        std::vector<const Portion*> first(texel_.sub_edges.size(), nullptr);
        for (const Portion& p : texel_.sweep.portions)
            first[texel_.graph.edges[p.edge].sub] = &p;
        region_.assign(sweep_.faces.size(), kNone);
        for (const Portion& p : sweep_.portions) {
            const Portion& original = *first[graph_.edges[p.edge].sub];
            region_[sweep_.face(p.left)] = out_.region_of_face[original.left];
            region_[sweep_.face(p.right)] = out_.region_of_face[original.right];
        }
    }

    [[nodiscard]] double side_level(int steps) const {
        return static_cast<double>(map_.grid().py) * (texel_.frame.top / 2 + steps);
    }

    bool build_band(std::uint32_t b, const std::vector<std::uint32_t>& portions) {
        Band band;
        band.y0 = b == 0 ? side_level(0) : node(cuts_[b - 1].first).y;
        band.y1 = b == cuts_.size() ? side_level(1) : node(cuts_[b].first).y;
        if (portions.empty()) {
            band.regions.push_back(region_at_left_side(0.5 * (band.y0 + band.y1)));
        } else {
            link(portions);
            for (std::uint32_t p : portions) {
                if (!used_[p] && chain_start(p)) add_feature(p, band);
            }
            for (std::uint32_t p : portions) {
                if (!used_[p]) add_feature(p, band); // closed loops
            }
            if (!order_features(band)) return false;
        }
        out_.bands.push_back(std::move(band));
        return true;
    }

    /// A band without edges lies in one region: the one beside the texel's left side there.
    [[nodiscard]] std::uint32_t region_at_left_side(double y) const {
        for (const Trapezoid& t : texel_.sweep.trapezoids) {
            if (t.left != kNone) continue;
            const double top = t.top_node == kNone ? side_level(0) : map_.node(texel_.graph.nodes[t.top_node]).y;
            const double bottom =
                t.bottom_node == kNone ? side_level(1) : map_.node(texel_.graph.nodes[t.bottom_node]).y;
            if (top <= y && y <= bottom && top < bottom) return out_.region_of_face[t.face];
        }
        return out_.corner_region;
    }

    // --- chains
    // ----------------------------------------------------------------------------------------------------------------

    [[nodiscard]] bool open_end(std::uint32_t p, bool top) const {
        const Portion& portion = sweep_.portions[p];
        if (top ? portion.from_cut : portion.to_cut) return true;
        const std::uint32_t k = top ? graph_.edges[portion.edge].top : graph_.edges[portion.edge].bottom;
        return on_cut_[k] || on_texel_side(node(k));
    }

    [[nodiscard]] bool chain_start(std::uint32_t p) const { return open_end(p, true) || open_end(p, false); }

    [[nodiscard]] Touch touch(std::uint32_t p, bool top) const {
        const Portion& portion = sweep_.portions[p];
        const std::uint32_t k = top ? graph_.edges[portion.edge].top : graph_.edges[portion.edge].bottom;
        if ((top ? portion.from_cut : portion.to_cut) || on_cut_[k]) return top ? Touch::Top : Touch::Bottom;
        const GridNode& n = node(k);
        if (n.hy == texel_.frame.top) return Touch::Top;
        if (n.hy == texel_.frame.top + 2) return Touch::Bottom;
        return n.hx == texel_.frame.left ? Touch::Left : n.hx == texel_.frame.left + 2 ? Touch::Right : Touch::None;
    }

    /// The two portion ends at every interior node of the band.
    void link(const std::vector<std::uint32_t>& portions) {
        used_.resize(sweep_.portions.size(), false);
        at_node_.assign(graph_.nodes.size(), {kNone, kNone});
        for (std::uint32_t p : portions) {
            for (const bool top : {true, false}) {
                if (open_end(p, top)) continue;
                auto& pair = at_node_[top ? graph_.edges[sweep_.portions[p].edge].top
                                          : graph_.edges[sweep_.portions[p].edge].bottom];
                (pair[0] == kNone ? pair[0] : pair[1]) = p;
            }
        }
    }

    struct Walk {
        std::vector<std::uint32_t> portions;
        std::vector<bool> downward; ///< walked from top to bottom
    };

    /// From one open end to the other, or once around a loop.
    Walk walk(std::uint32_t start) {
        Walk w;
        bool down = open_end(start, true) || !open_end(start, false);
        for (std::uint32_t p = start; p != kNone && !used_[p];) {
            used_[p] = true;
            w.portions.push_back(p);
            w.downward.push_back(down);
            if (open_end(p, !down)) break;
            const SweepEdge& e = graph_.edges[sweep_.portions[p].edge];
            const std::uint32_t k = down ? e.bottom : e.top;
            const auto& pair = at_node_[k];
            const std::uint32_t q = pair[0] == p ? pair[1] : pair[0];
            if (q == kNone) break;
            down = graph_.edges[sweep_.portions[q].edge].top == k;
            p = q;
        }
        return w;
    }

    void add_feature(std::uint32_t start, Band& band) {
        const Walk w = walk(start);
        SimpleFeature f;
        for (std::size_t i = 0; i < w.portions.size(); ++i) {
            const SweepEdge& edge = graph_.edges[sweep_.portions[w.portions[i]].edge];
            f.steps.push_back({edge.sub, edge.down == w.downward[i]});
        }
        direct(w, f);
        band.features.push_back(std::move(f));
    }

    // --- ray direction and inside (FBT §4.5: never towards a side that the feature touches)
    // --------------------------------------

    void direct(const Walk& w, SimpleFeature& f) const {
        const std::uint32_t a = w.portions.front(), b = w.portions.back();
        const Touch ta = open_end(a, w.downward.front()) ? touch(a, w.downward.front()) : Touch::None;
        const Touch tb = open_end(b, !w.downward.back()) ? touch(b, !w.downward.back()) : Touch::None;
        const auto touches = [&](Touch t) { return ta == t || tb == t; };
        if (touches(Touch::Left) && touches(Touch::Right)) {
            f.ray = fetex::kFbtRayPosY;
            const bool a_left = ta == Touch::Left;
            const std::uint32_t p = a_left ? a : b;
            const bool leaves_down = a_left ? w.downward.front() : !w.downward.back();
            set_inside(f, p, !leaves_down); // above: right of a falling edge, left of a rising one
            return;
        }
        const bool positive = !touches(Touch::Right);
        f.ray = positive ? fetex::kFbtRayPosX : fetex::kFbtRayNegX;
        std::uint32_t first = 0, last = 0;
        topmost(w, first, last);
        set_inside(f, positive ? last : first, positive);
    }

    /// The leftmost and rightmost portion just below the chain's first point in sweep order.
    void topmost(const Walk& w, std::uint32_t& first, std::uint32_t& last) const {
        first = last = kNone;
        const auto key = [&](std::uint32_t p) {
            const Portion& portion = sweep_.portions[p];
            return portion.rank != kNone
                       ? std::pair<std::uint32_t, std::uint32_t>(0, portion.rank)
                       : std::pair<std::uint32_t, std::uint32_t>(graph_.edges[portion.edge].top + 1, p);
        };
        for (std::uint32_t p : w.portions) {
            const auto k = key(p);
            if (first == kNone || k.first < key(first).first)
                first = last = p;
            else if (k.first == key(first).first) {
                if (k.second < key(first).second) first = p;
                if (k.second > key(last).second) last = p;
            }
        }
    }

    void set_inside(SimpleFeature& f, std::uint32_t p, bool left) const {
        const Portion& portion = sweep_.portions[p];
        f.inside = sweep_.face(left ? portion.left : portion.right);
        f.outside = sweep_.face(left ? portion.right : portion.left);
    }

    // --- order: what lies inside a feature comes before it
    // -----------------------------------------------------------------------

    bool order_features(Band& band) const {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> parents; // inside face → feature
        for (std::uint32_t k = 0; k < band.features.size(); ++k)
            parents.emplace_back(band.features[k].inside, k);
        std::sort(parents.begin(), parents.end());
        for (std::size_t k = 1; k < parents.size(); ++k) {
            if (parents[k].first == parents[k - 1].first) return false;
        }
        std::vector<std::uint32_t> depth(band.features.size(), kNone);
        for (std::uint32_t k = 0; k < band.features.size(); ++k) {
            if (!find_depth(band, parents, k, depth)) return false;
        }
        std::vector<std::uint32_t> order(band.features.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t x, std::uint32_t y) { return depth[x] > depth[y]; });
        std::vector<SimpleFeature> sorted;
        for (std::uint32_t k : order) {
            band.regions.push_back(region_[band.features[k].inside]);
            sorted.push_back(std::move(band.features[k]));
        }
        band.features = std::move(sorted);
        return find_rest(band, parents);
    }

    /// Number of features around feature k; false when they run in a circle.
    static bool find_depth(const Band& band, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& parents,
                           std::uint32_t k, std::vector<std::uint32_t>& depth) {
        std::vector<std::uint32_t> path;
        std::uint32_t base = 0;
        for (std::uint32_t at = k;;) {
            if (depth[at] != kNone) {
                base = depth[at] + 1;
                break;
            }
            path.push_back(at);
            if (path.size() > band.features.size()) return false;
            const auto it = std::lower_bound(parents.begin(), parents.end(), std::pair(band.features[at].outside, 0u));
            if (it == parents.end() || it->first != band.features[at].outside) break;
            at = it->second;
        }
        for (std::size_t i = path.size(); i-- > 0;)
            depth[path[i]] = base++;
        return true;
    }

    /// The one face that is inside nothing.
    bool find_rest(Band& band, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& parents) const {
        std::uint32_t rest = kNone;
        for (const SimpleFeature& f : band.features) {
            const auto it = std::lower_bound(parents.begin(), parents.end(), std::pair(f.outside, 0u));
            if (it != parents.end() && it->first == f.outside) continue;
            if (rest != kNone && rest != f.outside) return false;
            rest = f.outside;
        }
        if (rest == kNone) return false;
        band.regions.push_back(region_[rest]);
        return true;
    }

    const PlanarMap& map_;
    TexelMapper& mapper_;
    const TexelMap& texel_;
    TexelFeatures& out_;
    SweepGraph graph_; ///< of the visible sub-edges
    std::vector<Cut> cuts_;
    std::vector<bool> on_cut_, used_;
    SweepResult sweep_;
    std::vector<std::uint32_t> region_; ///< per face of sweep_ (roots)
    std::vector<std::array<std::uint32_t, 2>> at_node_;
};

} // namespace

bool build_features(const PlanarMap& map, TexelMapper& mapper, const TexelMap& texel, TexelFeatures& out) {
    out = {};
    const std::vector<std::uint32_t> visible = RegionFinder(texel, out).run();
    if (visible.empty()) return true;
    return BandBuilder(map, mapper, texel, out).run(visible);
}

} // namespace fetexc
