// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/image_regions.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "compiler/diagnostics.h"
#include "compiler/fbt/features.h"
#include "compiler/parallel.h"
#include "compiler/planar/trapezoid_sides.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

Error inconsistent(std::uint32_t i, std::uint32_t j) {
    return {ErrorClass::Runtime, diag::kPlanarInconsistent,
            "the planar map contradicts itself; please report this file",
            "texel (" + std::to_string(i) + ", " + std::to_string(j) + ")"};
}

/// The trapezoids of a texel, to find the regions of points, level after level downwards.
class TrapezoidIndex {
  public:
    TrapezoidIndex(const PlanarMap& map, const TexelMap& texel, const TexelFeatures& features)
        : map_(map), texel_(texel), sides_(map, texel) {
        for (const Trapezoid& t : texel.sweep.trapezoids) {
            const Extent1 y = sides_.levels(t);
            if (y.size() > 0) slabs_.push_back({&t, y, features.region_of_face[t.face]});
        }
        std::ranges::stable_sort(slabs_, {}, [](const Slab& s) { return s.y.low; });
    }

    /// Planar space; no level may be above the one before.
    void descend(double y) {
        while (next_ < slabs_.size() && slabs_[next_].y.low <= y)
            open_.push_back(next_++);
        std::erase_if(open_, [&](std::size_t k) { return slabs_[k].y.high <= y; });
        stretches_.clear();
        for (const std::size_t k : open_)
            stretches_.push_back({sides_.at(*slabs_[k].trapezoid, y), slabs_[k].region});
        std::ranges::sort(stretches_, {}, [](const Stretch1& s) { return std::tuple(s.x.low, s.x.high, s.region); });
    }

    /// Of a point on this level; points of edges belong to either side, and what roundings leave between two
    /// trapezoids to the left one. kNone: the level has none.
    [[nodiscard]] std::uint32_t region_at(double x) const {
        if (stretches_.empty()) return kNone;
        const auto right = std::ranges::upper_bound(stretches_, x, {}, [](const Stretch1& s) { return s.x.low; });
        return (right == stretches_.begin() ? right : right - 1)->region;
    }

    /// For each region a point of its largest trapezoid, in texels.
    void points(std::size_t regions, std::vector<TexelPoint>& out) const {
        const Grid& g = map_.grid();
        std::vector<double> largest(regions, -1);
        const std::size_t first = out.size();
        out.resize(first + regions, {texel_.i + 0.5, texel_.j + 0.5});
        for (const Slab& s : slabs_) {
            const double y = s.y.at(0.5);
            const Extent1 x = sides_.at(*s.trapezoid, y);
            const double area = s.y.size() * x.size();
            if (!(area > largest[s.region])) continue;
            largest[s.region] = area;
            out[first + s.region] = {x.at(0.5) / static_cast<double>(g.px), y / static_cast<double>(g.py)};
        }
    }

  private:
    struct Slab {
        const Trapezoid* trapezoid;
        Extent1 y;
        std::uint32_t region;
    };
    struct Stretch1 {
        Extent1 x;
        std::uint32_t region;
    };

    const PlanarMap& map_;
    const TexelMap& texel_;
    TrapezoidSides sides_;
    std::vector<Slab> slabs_; ///< by their tops
    std::size_t next_ = 0;
    std::vector<std::size_t> open_; ///< slabs that hold the level
    std::vector<Stretch1> stretches_;
};

/// Connected parts of the texel's edges that have one region on both sides.
std::uint64_t count_floating(const TexelMap& texel, const TexelFeatures& features, UnionFind& sets) {
    if (features.edges_invisible == 0) return 0;
    sets.reset(texel.graph.nodes.size());
    std::uint64_t parts = 0;
    std::vector<bool> touched(texel.graph.nodes.size(), false);
    for (const Portion& p : texel.sweep.portions) {
        if (texel.left_result(p) != texel.right_result(p)) continue;
        const SweepEdge& e = texel.graph.edges[p.edge];
        for (const std::uint32_t node : {e.top, e.bottom}) {
            if (!touched[node]) ++parts;
            touched[node] = true;
        }
        if (sets.find(e.top) != sets.find(e.bottom)) --parts;
        sets.unite(e.top, e.bottom);
    }
    return parts;
}

/// What a row of texels finds; regions are row-local.
struct RowRegions {
    std::vector<TexelPoint> inside;
    std::uint64_t floating = 0;
    Status status;
};

class RegionFinder {
  public:
    RegionFinder(const FeaturedImage& picture, const PlanarMap& map, const CompileOptions& options,
                 std::vector<std::uint32_t>& region_of_pixel)
        : picture_(picture), map_(map), options_(options), compositor_(picture.features, options.skip),
          region_of_pixel_(region_of_pixel) {}

    RowRegions find(std::uint32_t j, ReachabilityRow& reach) {
        RowRegions row;
        PlanarStats unused;
        TexelMapper mapper(map_, picture_.features, compositor_, unused, options_.skip);
        mapper.tell_faces_apart();
        FeatureBuilder builder(map_, mapper, options_.skip);
        TexelMap texel;
        TexelFeatures features;
        UnionFind sets;
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i == map_.grid().width || !row.status) return;
            const bool edges = !map_.sub_edges(i, j).empty();
            if (edges && (!mapper.analyse(i, j, corner, texel) || !builder.build(texel, features))) {
                row.status = inconsistent(i, j);
                return;
            }
            if (edges) row.floating += count_floating(texel, features, sets);
            if (!edges || features.bands.empty()) {
                const std::uint32_t region = reach.add_empty(0);
                row.inside.push_back({i + 0.5, j + 0.5});
                return each_pixel(
                    i, j, [](double) {}, [&](double) { return region; });
            }
            const std::uint32_t first = reach.add_texel(texel, features.region_of_face, features.region_result);
            TrapezoidIndex index(map_, texel, features);
            index.points(features.region_result.size(), row.inside);
            each_pixel(
                i, j, [&](double y) { index.descend(y); },
                [&](double x) {
                    const std::uint32_t region = index.region_at(x);
                    return first + (region == kNone ? features.corner_region : region);
                });
        });
        return row;
    }

  private:
    /// For every row of pixels whose centres lie in the texel descend(y), then region_at(x) of each pixel; planar
    /// space.
    template <class Descend, class RegionAt>
    void each_pixel(std::uint32_t i, std::uint32_t j, const Descend& descend, const RegionAt& region_at) {
        const Grid& g = map_.grid();
        const std::uint32_t width = picture_.image.width, height = picture_.image.height;
        const std::uint32_t first = first_pixel(i, width, g.width), end = first_pixel(i + 1, width, g.width);
        if (first == end) return;
        for (std::uint32_t y = first_pixel(j, height, g.height); y < first_pixel(j + 1, height, g.height); ++y) {
            descend(pixel_centre(y, height, g.height) * static_cast<double>(g.py));
            for (std::uint32_t x = first; x < end; ++x)
                region_of_pixel_[std::size_t{y} * width + x] =
                    region_at(pixel_centre(x, width, g.width) * static_cast<double>(g.px));
        }
    }

    const FeaturedImage& picture_;
    const PlanarMap& map_;
    const CompileOptions& options_;
    Compositor compositor_;
    std::vector<std::uint32_t>& region_of_pixel_;
};

} // namespace

Result<ImageRegions> find_image_regions(const FeaturedImage& picture, const PlanarMap& map,
                                        const CompileOptions& options) {
    const Grid& g = map.grid();
    const RasterImage& image = picture.image;
    std::vector<std::uint32_t> region_of_pixel(std::size_t{image.width} * image.height);
    RegionFinder finder(picture, map, options, region_of_pixel);
    std::vector<ReachabilityRow> reach;
    for (std::uint32_t j = 0; j < g.height; ++j)
        reach.emplace_back(map, j, Separation::Edges);
    std::vector<RowRegions> rows(g.height);
    parallel_for(g.height, options.threads,
                 [&](std::size_t j) { rows[j] = finder.find(static_cast<std::uint32_t>(j), reach[j]); });
    for (const RowRegions& row : rows) {
        if (!row.status) return row.status.error();
    }
    ImageRegions out{ReachabilityGraph(map, reach, options.threads), std::move(region_of_pixel), {}, 0};
    if (out.graph.conflict()) return inconsistent(out.graph.conflict()->i, out.graph.conflict()->j);
    for (std::uint32_t j = 0; j < g.height; ++j) {
        out.inside.insert(out.inside.end(), rows[j].inside.begin(), rows[j].inside.end());
        out.floating += rows[j].floating;
        const std::size_t first = std::size_t{first_pixel(j, image.height, g.height)} * image.width,
                          last = std::size_t{first_pixel(j + 1, image.height, g.height)} * image.width;
        for (std::size_t k = first; k < last; ++k)
            out.region_of_pixel[k] += out.graph.row_start(j);
    }
    return out;
}

} // namespace fetexc
