// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/two_zones.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "compiler/scene/compositor.h"

namespace fetexc {
namespace {

WidthPoint middle_of(const VisibleEdge& e) {
    std::array<WidthPoint, 4> p = e.p;
    for (int n = e.degree; n > 0; --n) {
        for (int k = 0; k < n; ++k)
            p[k] = {(p[k].x + p[k + 1].x) / 2, (p[k].y + p[k + 1].y) / 2};
    }
    return p[0];
}

/// Results in sets, each with a zone relative to the set's first.
class Parities {
  public:
    explicit Parities(std::size_t count) : parent_(count), odd_(count, 0) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    /// Of its set, and in which zone of it.
    std::pair<std::size_t, int> find(std::size_t k) const {
        int odd = 0;
        for (; parent_[k] != k; k = parent_[k])
            odd ^= odd_[k];
        return {k, odd};
    }
    /// Puts them into different zones if nothing is known.
    void part(std::size_t a, std::size_t b) {
        const auto [root_a, odd_a] = find(a);
        const auto [root_b, odd_b] = find(b);
        if (root_a == root_b) return;
        const auto [from, to] = std::pair{std::max(root_a, root_b), std::min(root_a, root_b)};
        parent_[from] = to, odd_[from] = odd_a ^ odd_b ^ 1;
    }

  private:
    std::vector<std::size_t> parent_;
    std::vector<int> odd_;
};

class Zoner {
  public:
    explicit Zoner(const Scene& scene) : scene_(scene), compositor_(scene) {}

    Result<TwoZones> find(unsigned threads) {
        ResultId somewhere = 0;
        auto found = visible_edges(scene_, compositor_, threads, &somewhere);
        if (!found) return found.error();
        edges_ = std::move(found).value();
        TwoZones out;
        out.silhouette.height = scene_.extent.height / scene_.extent.width;
        out.edges = edges_.size();
        weigh();
        const Parities parities = part();
        double most = 0;
        for (std::size_t k = 0; k < edges_.size(); ++k)
            add(k, parities, out, most);
        const double all = std::accumulate(weights_.begin(), weights_.end(), 0.0);
        if (all > 0) out.blurred_part /= all;
        out.silhouette.above_everywhere = false;
        return out;
    }

  private:
    struct Pair {
        std::size_t a = 0, b = 0;
        double weight = 0;
    };

    /// By first appearance: ids say nothing.
    std::size_t number(ResultId r) { return numbers_.try_emplace(r, numbers_.size()).first->second; }

    void weigh() {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> at;
        for (const VisibleEdge& e : edges_) {
            const WidthPoint m = middle_of(e), from = e.p[0], to = e.p[static_cast<std::size_t>(e.degree)];
            const CanvasPoint p{m.x * scene_.extent.width, m.y * scene_.extent.width};
            const Rgba a = compositor_.color(e.left, p), b = compositor_.color(e.right, p);
            const double contrast =
                std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
            weights_.push_back(contrast * std::hypot(to.x - from.x, to.y - from.y));
            const std::size_t left = number(e.left), right = number(e.right);
            const auto key = std::pair{std::min(left, right), std::max(left, right)};
            const auto [place, fresh] = at.try_emplace(key, pairs_.size());
            if (fresh) pairs_.push_back({key.first, key.second, 0});
            pairs_[place->second].weight += weights_.back();
        }
    }
    Parities part() {
        std::ranges::stable_sort(pairs_, [](const Pair& a, const Pair& b) { return a.weight > b.weight; });
        Parities out(numbers_.size());
        for (const Pair& p : pairs_)
            out.part(p.a, p.b);
        return out;
    }

    void add(std::size_t k, const Parities& parities, TwoZones& out, double& most) {
        VisibleEdge e = edges_[k];
        const int left = parities.find(number(e.left)).second, right = parities.find(number(e.right)).second;
        if (left == right) {
            ++out.blurred, out.blurred_part += weights_[k];
            const WidthPoint m = middle_of(e);
            if (weights_[k] > most)
                most = weights_[k], out.blurred_u = m.x, out.blurred_v = m.y / out.silhouette.height;
            return;
        }
        if (right != 0) std::reverse(e.p.begin(), e.p.begin() + e.degree + 1);
        e.left = 1, e.right = 0;
        out.silhouette.edges.push_back(e);
    }

    const Scene& scene_;
    Compositor compositor_;
    std::vector<VisibleEdge> edges_;
    std::vector<double> weights_; ///< of edges
    std::map<ResultId, std::size_t> numbers_;
    std::vector<Pair> pairs_;
};

} // namespace

Result<TwoZones> two_zones_of(const Scene& scene, unsigned threads) { return Zoner(scene).find(threads); }

} // namespace fetexc
