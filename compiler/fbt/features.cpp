// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/features.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "formats/fbt.h"

namespace fetexc {

bool FeatureBuilder::build(const TexelMap& texel, TexelFeatures& out) {
    texel_ = &texel, out_ = &out;
    out.clear();
    find_regions();
    return out.edges_visible == 0 || build_bands();
}

/// Regions: faces joined over invisible edges.
void FeatureBuilder::find_regions() {
    const SweepResult& s = texel_->sweep;
    joined_.reset(s.faces.size());
    for (std::uint32_t f = 0; f < s.faces.size(); ++f)
        joined_.unite(f, s.face(f));
    for (const Portion& p : s.portions) {
        if (texel_->left_result(p) == texel_->right_result(p))
            joined_.unite(p.left, p.right), ++out_->edges_invisible;
        else
            ++out_->edges_visible;
    }
    number_regions();
    out_->corner_region = out_->region_of_face[s.first_face];
}

void FeatureBuilder::number_regions() {
    number_.assign(joined_.size(), kNone);
    out_->region_of_face.resize(joined_.size());
    for (std::uint32_t f = 0; f < joined_.size(); ++f) {
        const std::uint32_t r = joined_.find(f);
        if (number_[r] == kNone) {
            number_[r] = static_cast<std::uint32_t>(out_->region_result.size());
            out_->region_result.push_back(texel_->results[r]);
        }
        out_->region_of_face[f] = number_[r];
    }
}

bool FeatureBuilder::build_bands() {
    keep_visible();
    find_cuts();
    if (!sweep_again()) return false;
    map_regions();
    used_.assign(sweep_->portions.size(), false);
    const auto end = static_cast<std::uint32_t>(sweep_->portions.size());
    std::uint32_t first = 0;
    for (std::uint32_t b = 0; b <= cuts_.size(); ++b) {
        std::uint32_t last = first;
        while (last < end && sweep_->portions[last].band == b)
            ++last;
        if (!build_band(b, {first, last})) return false;
        first = last;
    }
    return true;
}

bool FeatureBuilder::on_texel_side(const GridNode& n) const {
    return n.hx == texel_->frame.left || n.hx == texel_->frame.left + 2 || n.hy == texel_->frame.top ||
           n.hy == texel_->frame.top + 2;
}

double FeatureBuilder::side_level(int steps) const {
    return static_cast<double>(map_.grid().py) * (texel_->frame.top / 2 + steps);
}

/// The graph without invisible edges; order and ranks of the nodes that stay are those of the first sweep.
void FeatureBuilder::keep_visible() {
    const SweepGraph& all = texel_->graph;
    graph_ = &all;
    if (out_->edges_invisible == 0) return;
    graph_ = &own_graph_;
    own_graph_.nodes.clear(), own_graph_.ranks.clear(), own_graph_.edges.clear();
    number_.assign(all.nodes.size(), kNone);
    for (const Portion& p : texel_->sweep.portions) {
        if (texel_->left_result(p) == texel_->right_result(p)) continue;
        own_graph_.edges.push_back(all.edges[p.edge]);
        number_[own_graph_.edges.back().top] = number_[own_graph_.edges.back().bottom] = 0;
    }
    for (std::uint32_t k = 0; k < all.nodes.size(); ++k) {
        if (number_[k] == kNone) continue;
        number_[k] = static_cast<std::uint32_t>(own_graph_.nodes.size());
        own_graph_.nodes.push_back(all.nodes[k]);
        own_graph_.ranks.push_back(all.ranks[k]);
    }
    for (SweepEdge& e : own_graph_.edges)
        e.top = number_[e.top], e.bottom = number_[e.bottom];
}

/// Band lines: the levels of interior nodes where other than two visible edges meet (FBT §3.2).
void FeatureBuilder::find_cuts() {
    const auto nodes = static_cast<std::uint32_t>(graph_->nodes.size());
    cuts_.clear();
    degree_.assign(nodes, 0);
    for (const SweepEdge& e : graph_->edges)
        ++degree_[e.top], ++degree_[e.bottom];
    on_cut_.assign(nodes, false);
    for (std::uint32_t k = 0; k < nodes;) {
        std::uint32_t last = k;
        bool junction = false;
        const bool border = node(k).hy != texel_->frame.top + 1;
        for (; last < nodes && graph_->ranks[last].y == graph_->ranks[k].y; ++last)
            junction = junction || (!on_texel_side(node(last)) && degree_[last] != 2);
        if (junction && !border) {
            cuts_.push_back({k, last});
            std::fill(on_cut_.begin() + k, on_cut_.begin() + last, true);
        }
        k = last;
    }
}

/// Where every edge is visible and no band line cuts any, the first sweep has said it all.
bool FeatureBuilder::sweep_again() {
    sweep_ = &texel_->sweep;
    if (skip_.first_sweep && graph_ == &texel_->graph && cuts_.empty()) return true;
    sweep_ = &own_sweep_;
    return mapper_.sweep().run(texel_->sub_edges, *graph_, cuts_, texel_->frame, own_sweep_);
}

/// Region of every band face, through the first sweep's faces beside the same edge.
void FeatureBuilder::map_regions() {
    const std::vector<Portion>& originals = texel_->sweep.portions;
    first_portion_.resize(texel_->sub_edges.size());
    for (std::uint32_t p = 0; p < originals.size(); ++p)
        first_portion_[texel_->graph.edges[originals[p].edge].sub] = p;
    region_.assign(sweep_->faces.size(), kNone);
    for (const Portion& p : sweep_->portions) {
        const Portion& original = originals[first_portion_[graph_->edges[p.edge].sub]];
        region_[sweep_->face(p.left)] = out_->region_of_face[original.left];
        region_[sweep_->face(p.right)] = out_->region_of_face[original.right];
    }
}

bool FeatureBuilder::build_band(std::uint32_t b, PortionRange portions) {
    Band band;
    band.y0 = b == 0 ? side_level(0) : node(cuts_[b - 1].first).y;
    band.y1 = b == cuts_.size() ? side_level(1) : node(cuts_[b].first).y;
    band.first_feature = static_cast<std::uint32_t>(out_->features.size());
    band.first_region = static_cast<std::uint32_t>(out_->regions.size());
    if (portions.first == portions.second) {
        out_->regions.push_back(region_at_left_side(0.5 * (band.y0 + band.y1)));
    } else {
        link(portions);
        for (std::uint32_t p = portions.first; p < portions.second; ++p) {
            if (!used_[p] && chain_start(p)) add_feature(p);
        }
        for (std::uint32_t p = portions.first; p < portions.second; ++p) {
            if (!used_[p]) add_feature(p); // closed loops
        }
        band.features = static_cast<std::uint32_t>(out_->features.size()) - band.first_feature;
        if (!order_features(std::span(out_->features).subspan(band.first_feature))) return false;
    }
    out_->bands.push_back(band);
    return true;
}

/// A band without edges lies in one region: the one beside the texel's left side there.
std::uint32_t FeatureBuilder::region_at_left_side(double y) const {
    for (const Trapezoid& t : texel_->sweep.trapezoids) {
        if (t.left != kNone) continue;
        const double top = t.top_node == kNone ? side_level(0) : map_.node(texel_->graph.nodes[t.top_node]).y;
        const double bottom = t.bottom_node == kNone ? side_level(1) : map_.node(texel_->graph.nodes[t.bottom_node]).y;
        if (top <= y && y <= bottom && top < bottom) return out_->region_of_face[t.face];
    }
    return out_->corner_region;
}

// --- chains

bool FeatureBuilder::open_end(std::uint32_t p, bool top) const {
    const Portion& portion = sweep_->portions[p];
    if (top ? portion.from_cut : portion.to_cut) return true;
    const std::uint32_t k = top ? graph_->edges[portion.edge].top : graph_->edges[portion.edge].bottom;
    return on_cut_[k] || on_texel_side(node(k));
}

FeatureBuilder::Touch FeatureBuilder::touch(std::uint32_t p, bool top) const {
    const Portion& portion = sweep_->portions[p];
    const std::uint32_t k = top ? graph_->edges[portion.edge].top : graph_->edges[portion.edge].bottom;
    if ((top ? portion.from_cut : portion.to_cut) || on_cut_[k]) return top ? Touch::Top : Touch::Bottom;
    const GridNode& n = node(k);
    if (n.hy == texel_->frame.top) return Touch::Top;
    if (n.hy == texel_->frame.top + 2) return Touch::Bottom;
    return n.hx == texel_->frame.left ? Touch::Left : n.hx == texel_->frame.left + 2 ? Touch::Right : Touch::None;
}

/// The two portion ends at every interior node of the band.
void FeatureBuilder::link(PortionRange portions) {
    at_node_.assign(graph_->nodes.size(), {kNone, kNone});
    for (std::uint32_t p = portions.first; p < portions.second; ++p) {
        const SweepEdge& e = graph_->edges[sweep_->portions[p].edge];
        for (const bool top : {true, false}) {
            if (open_end(p, top)) continue;
            auto& pair = at_node_[top ? e.top : e.bottom];
            (pair[0] == kNone ? pair[0] : pair[1]) = p;
        }
    }
}

/// From one open end to the other, or once around a loop.
void FeatureBuilder::walk(std::uint32_t start) {
    chain_.clear(), downward_.clear();
    bool down = open_end(start, true) || !open_end(start, false);
    for (std::uint32_t p = start; p != kNone && !used_[p];) {
        used_[p] = true;
        chain_.push_back(p);
        downward_.push_back(down);
        if (open_end(p, !down)) break;
        const SweepEdge& e = graph_->edges[sweep_->portions[p].edge];
        const std::uint32_t k = down ? e.bottom : e.top;
        const auto& pair = at_node_[k];
        const std::uint32_t q = pair[0] == p ? pair[1] : pair[0];
        if (q == kNone) break;
        down = graph_->edges[sweep_->portions[q].edge].top == k;
        p = q;
    }
}

void FeatureBuilder::add_feature(std::uint32_t start) {
    walk(start);
    SimpleFeature f;
    f.first_step = static_cast<std::uint32_t>(out_->steps.size()), f.steps = static_cast<std::uint32_t>(chain_.size());
    for (std::size_t i = 0; i < chain_.size(); ++i) {
        const SweepEdge& edge = graph_->edges[sweep_->portions[chain_[i]].edge];
        out_->steps.push_back({edge.sub, edge.down == downward_[i]});
    }
    direct(f);
    out_->features.push_back(f);
}

// --- ray direction and inside (FBT §4.5: never towards a side that the feature touches)

void FeatureBuilder::direct(SimpleFeature& f) const {
    const std::uint32_t a = chain_.front(), b = chain_.back();
    const Touch ta = open_end(a, downward_.front()) ? touch(a, downward_.front()) : Touch::None;
    const Touch tb = open_end(b, !downward_.back()) ? touch(b, !downward_.back()) : Touch::None;
    const auto touches = [&](Touch t) { return ta == t || tb == t; };
    if (touches(Touch::Left) && touches(Touch::Right)) {
        f.ray = fetex::kFbtRayPosY;
        const bool a_left = ta == Touch::Left;
        const bool leaves_down = a_left ? downward_.front() : !downward_.back();
        set_inside(f, a_left ? a : b, !leaves_down); // above: right of a falling edge, left of a rising one
        return;
    }
    const bool positive = !touches(Touch::Right);
    f.ray = positive ? fetex::kFbtRayPosX : fetex::kFbtRayNegX;
    std::uint32_t first = 0, last = 0;
    topmost(first, last);
    set_inside(f, positive ? last : first, positive);
}

/// The leftmost and rightmost portion just below the chain's first point in sweep order.
void FeatureBuilder::topmost(std::uint32_t& first, std::uint32_t& last) const {
    first = last = kNone;
    const auto key = [&](std::uint32_t p) {
        const Portion& portion = sweep_->portions[p];
        return portion.rank != kNone ? std::pair<std::uint32_t, std::uint32_t>(0, portion.rank)
                                     : std::pair<std::uint32_t, std::uint32_t>(graph_->edges[portion.edge].top + 1, p);
    };
    for (std::uint32_t p : chain_) {
        const auto k = key(p);
        if (first == kNone || k.first < key(first).first)
            first = last = p;
        else if (k.first == key(first).first) {
            if (k.second < key(first).second) first = p;
            if (k.second > key(last).second) last = p;
        }
    }
}

void FeatureBuilder::set_inside(SimpleFeature& f, std::uint32_t p, bool left) const {
    const Portion& portion = sweep_->portions[p];
    f.inside = sweep_->face(left ? portion.left : portion.right);
    f.outside = sweep_->face(left ? portion.right : portion.left);
}

// --- order: what lies inside a feature comes before it

bool FeatureBuilder::order_features(std::span<SimpleFeature> features) {
    parents_.clear();
    for (std::uint32_t k = 0; k < features.size(); ++k)
        parents_.emplace_back(features[k].inside, k);
    std::sort(parents_.begin(), parents_.end());
    for (std::size_t k = 1; k < parents_.size(); ++k) {
        if (parents_[k].first == parents_[k - 1].first) return false;
    }
    depth_.assign(features.size(), kNone);
    for (std::uint32_t k = 0; k < features.size(); ++k) {
        if (!find_depth(features, k)) return false;
    }
    order_by_subtree(features);
    sorted_.clear();
    for (const std::uint32_t k : order_) {
        out_->regions.push_back(region_[features[k].inside]);
        sorted_.push_back(features[k]);
        sorted_.back().depth = depth_[k];
    }
    std::copy(sorted_.begin(), sorted_.end(), features.begin());
    return find_rest(features);
}

/// Each feature right after those inside it (post-order), siblings in the order of the features.
void FeatureBuilder::order_by_subtree(std::span<const SimpleFeature> features) {
    children_.clear();
    for (std::uint32_t k = 0; k < features.size(); ++k)
        children_.emplace_back(parent_of(features[k].outside), k);
    std::sort(children_.begin(), children_.end(), std::greater<>());
    order_.clear(), path_.clear(), opened_.assign(features.size(), false);
    const auto open = [&](std::uint32_t parent) { // the first sibling ends on top
        const auto by_parent = [](const auto& child) { return child.first; };
        auto child = std::ranges::lower_bound(children_, parent, std::greater<>(), by_parent);
        for (; child != children_.end() && child->first == parent; ++child)
            path_.push_back(child->second);
    };
    open(kNone);
    while (!path_.empty()) {
        const std::uint32_t k = path_.back();
        if (opened_[k]) {
            order_.push_back(k);
            path_.pop_back();
        } else {
            opened_[k] = true;
            open(k);
        }
    }
}

std::uint32_t FeatureBuilder::parent_of(std::uint32_t face) const {
    const auto it = std::lower_bound(parents_.begin(), parents_.end(), std::pair(face, 0u));
    return it == parents_.end() || it->first != face ? kNone : it->second;
}

/// Number of features around feature k; false when they run in a circle.
bool FeatureBuilder::find_depth(std::span<const SimpleFeature> features, std::uint32_t k) {
    path_.clear();
    std::uint32_t base = 0;
    for (std::uint32_t at = k; at != kNone; at = parent_of(features[at].outside)) {
        if (depth_[at] != kNone) {
            base = depth_[at] + 1;
            break;
        }
        path_.push_back(at);
        if (path_.size() > features.size()) return false;
    }
    for (std::size_t i = path_.size(); i-- > 0;)
        depth_[path_[i]] = base++;
    return true;
}

/// The one face that is inside nothing.
bool FeatureBuilder::find_rest(std::span<const SimpleFeature> features) {
    std::uint32_t rest = kNone;
    for (const SimpleFeature& f : features) {
        if (parent_of(f.outside) != kNone) continue;
        if (rest != kNone && rest != f.outside) return false;
        rest = f.outside;
    }
    if (rest == kNone) return false;
    out_->regions.push_back(region_[rest]);
    return true;
}

} // namespace fetexc
