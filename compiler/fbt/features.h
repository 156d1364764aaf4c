// SPDX-License-Identifier: GPL-3.0-or-later
/// From the faces and edges of one texel to bands of ordered simple features (FBT §3.2, §4.5).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "compiler/planar/texel_map.h"
#include "compiler/union_find.h"

namespace fetexc {

/// One edge of a simple feature in chain order; forward: runs with growing t.
struct FeatureStep {
    std::uint32_t sub = 0; ///< index into the texel's sub-edges
    bool forward = true;
};

/// A chain that splits its band into two. The region of `inside` lies where a ray in direction `ray` meets the chain an
/// odd number of times.
struct SimpleFeature {
    std::uint32_t first_step = 0, steps = 0; ///< in TexelFeatures::steps
    std::uint32_t ray = 0;                   ///< fetex::kFbtRay…
    std::uint32_t inside = 0, outside = 0;   ///< band faces
    std::uint32_t depth = 0;                 ///< features of the band that it lies inside of
};

struct Band {
    double y0 = 0, y1 = 0;                         ///< planar space
    std::uint32_t first_feature = 0, features = 0; ///< in TexelFeatures::features, in the order of the region test
    std::uint32_t first_region = 0; ///< in TexelFeatures::regions: of each feature's inside, then of what is left
};

struct TexelFeatures {
    std::vector<Band> bands; ///< empty: no visible edge
    std::vector<SimpleFeature> features;
    std::vector<FeatureStep> steps;
    std::vector<std::uint32_t> regions;
    std::vector<std::uint32_t> region_of_face; ///< first sweep's face → region
    std::vector<ResultId> region_result;
    std::uint32_t corner_region = 0; ///< holds the texel's corner (i,j)
    std::uint64_t edges_visible = 0, edges_invisible = 0;

    [[nodiscard]] std::span<const SimpleFeature> features_of(const Band& b) const {
        return std::span(features).subspan(b.first_feature, b.features);
    }
    [[nodiscard]] std::span<const std::uint32_t> regions_of(const Band& b) const {
        return std::span(regions).subspan(b.first_region, b.features + 1);
    }
    [[nodiscard]] std::span<const FeatureStep> steps_of(const SimpleFeature& f) const {
        return std::span(steps).subspan(f.first_step, f.steps);
    }
    void clear() {
        bands.clear(), features.clear(), steps.clear(), regions.clear(), region_of_face.clear(), region_result.clear();
        corner_region = 0, edges_visible = 0, edges_invisible = 0;
    }
};

/// Builds texel after texel, keeping its scratch memory.
class FeatureBuilder {
  public:
    FeatureBuilder(const PlanarMap& map, TexelMapper& mapper, const SkipRules& skip = {})
        : map_(map), mapper_(mapper), skip_(skip) {}

    /// Drops edges with the same visible result on both sides, cuts at the junctions of the rest, chains, directs and
    /// orders them. False: the chains don't form a tree of regions (an internal contradiction, reported by the caller).
    bool build(const TexelMap& texel, TexelFeatures& out);

  private:
    enum class Touch : std::uint8_t { None, Top, Bottom, Left, Right };
    using PortionRange = std::pair<std::uint32_t, std::uint32_t>;

    void find_regions();
    void number_regions();
    bool build_bands();
    void keep_visible();
    void find_cuts();
    bool sweep_again();
    void map_regions();
    bool build_band(std::uint32_t b, PortionRange portions);
    [[nodiscard]] std::uint32_t region_at_left_side(double y) const;
    [[nodiscard]] bool open_end(std::uint32_t p, bool top) const;
    [[nodiscard]] bool chain_start(std::uint32_t p) const { return open_end(p, true) || open_end(p, false); }
    [[nodiscard]] Touch touch(std::uint32_t p, bool top) const;
    void link(PortionRange portions);
    void walk(std::uint32_t start);
    void add_feature(std::uint32_t start);
    void direct(SimpleFeature& f) const;
    void topmost(std::uint32_t& first, std::uint32_t& last) const;
    void set_inside(SimpleFeature& f, std::uint32_t p, bool left) const;
    bool order_features(std::span<SimpleFeature> features);
    bool find_depth(std::span<const SimpleFeature> features, std::uint32_t k);
    void order_by_subtree(std::span<const SimpleFeature> features);
    bool find_rest(std::span<const SimpleFeature> features);
    /// The feature that has the face inside, or kNone.
    [[nodiscard]] std::uint32_t parent_of(std::uint32_t face) const;
    [[nodiscard]] const GridNode& node(std::uint32_t k) const { return map_.node(graph_->nodes[k]); }
    [[nodiscard]] bool on_texel_side(const GridNode& n) const;
    [[nodiscard]] double side_level(int steps) const;

    const PlanarMap& map_;
    TexelMapper& mapper_;
    SkipRules skip_;
    const TexelMap* texel_ = nullptr;
    TexelFeatures* out_ = nullptr;
    const SweepGraph* graph_ = nullptr;  ///< of the visible sub-edges
    const SweepResult* sweep_ = nullptr; ///< over it, cut at the band lines
    std::vector<Cut> cuts_;

    // scratch
    UnionFind joined_; ///< faces over invisible edges
    SweepGraph own_graph_;
    SweepResult own_sweep_;
    std::vector<std::uint32_t> number_, degree_;
    std::vector<bool> on_cut_, used_;
    std::vector<std::uint32_t> region_;        ///< per face of *sweep_ (roots)
    std::vector<std::uint32_t> first_portion_; ///< of the first sweep, per sub-edge
    std::vector<std::array<std::uint32_t, 2>> at_node_;
    std::vector<std::uint32_t> chain_;                              ///< portions
    std::vector<bool> downward_;                                    ///< walked from top to bottom
    std::vector<std::pair<std::uint32_t, std::uint32_t>> parents_;  ///< inside face → feature
    std::vector<std::pair<std::uint32_t, std::uint32_t>> children_; ///< (parent, feature), descending
    std::vector<bool> opened_;
    std::vector<std::uint32_t> depth_, path_, order_;
    std::vector<SimpleFeature> sorted_;
};

} // namespace fetexc
