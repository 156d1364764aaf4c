// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/curve_insertion.h"

#include <algorithm>
#include <span>

#include "compiler/feature_curves/curve_walk.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;

/// Of a band: its edges stay in a processor's second-level cache, and lines are cut into few pieces.
constexpr std::uint32_t kBandRows = 16;

constexpr auto segment_table() {
    std::array<std::array<std::uint8_t, 4>, 4> table{};
    for (const FeatureEdge a : fetex::kFeatureEdges)
        for (const FeatureEdge b : fetex::kFeatureEdges)
            if (a != b)
                table[fetex::feature_edge_index(a)][fetex::feature_edge_index(b)] =
                    static_cast<std::uint8_t>(segment_between(a, b));
    return table;
}
constexpr auto kSegmentBetween = segment_table();

/// A curve comes into the next texel.
struct Step {
    FeatureEdge out{}, in{};   ///< of the texel before, of the next
    std::int32_t i = 0, j = 0; ///< the one before
    std::int32_t next_i = 0, next_j = 0;
};
Step step_of(const GridCrossing& c) {
    using enum FeatureEdge;
    const std::int32_t low = c.line - 1, from = c.increasing ? low : c.line, to = c.increasing ? c.line : low;
    if (c.vertical) return {c.increasing ? East : West, c.increasing ? West : East, from, c.cell, to, c.cell};
    return {c.increasing ? South : North, c.increasing ? North : South, c.cell, from, c.cell, to};
}

/// The texels of a band of rows, and their edges but the lower ones of its last row, which are the next band's.
struct Band {
    std::int32_t width = 0;
    GridRows rows;
    std::int32_t lines_end = 0; ///< horizontal grid lines up to this are the band's
    EdgeView<EdgePoint> points;
    EdgeView<EdgeDirection> directions; ///< nothing if everything is straight
    EdgeView<EdgeProfile> profiles;     ///< nothing if all are 0
    SnappedTexel* texels = nullptr;     ///< of all rows
    CurveArms* arms = nullptr;          ///< of all curves

    Band(const Grid& grid, GridRows of, InsertedCurves& out)
        : width(static_cast<std::int32_t>(grid.width)), rows(of),
          lines_end(of.last + (of.last == static_cast<std::int32_t>(grid.height) ? 1 : 0)), points(out.points.view()),
          directions(out.directions.view()), profiles(out.profiles.view()), texels(out.texels.data()),
          arms(out.arms.data()) {}

    [[nodiscard]] bool has(std::int32_t i, std::int32_t j) const { return is_column(i) && rows.has(j); }
    [[nodiscard]] bool owns(const GridCrossing& c) const {
        if (c.vertical) return rows.has(c.cell);
        return is_column(c.cell) && c.line >= rows.first && c.line < lines_end;
    }
    [[nodiscard]] bool is_column(std::int32_t i) const {
        return static_cast<std::uint32_t>(i) < static_cast<std::uint32_t>(width); // −1 is a large number
    }
    [[nodiscard]] SnappedTexel& texel(std::int32_t i, std::int32_t j) const {
        return texels[std::ptrdiff_t{j} * width + i];
    }
    template <class T> static T& at(const EdgeView<T>& edges, const GridCrossing& c) {
        const auto line = static_cast<std::uint32_t>(c.line), cell = static_cast<std::uint32_t>(c.cell);
        return c.vertical ? edges.at(line, cell, FeatureEdge::West) : edges.at(cell, line, FeatureEdge::North);
    }
};

/// A curve on its way from texel to texel. It has a band of its own, so that nothing written to memory could change it.
class Way {
  public:
    Way(const Band& band, std::uint32_t curve, bool straight) : band_(band), curve_(curve), straight_(straight) {}

    void operator()(const GridCrossing& c) {
        if (band_.owns(c)) Band::at(band_.points, c).add(c.position), ++counts_.crossings;
        const Step s = step_of(c);
        if (band_.has(s.i, s.j)) {
            if (crossed_)
                pass(s);
            else
                set_arm(0, s.out, c.position);
        }
        in_ = s.in, position_ = c.position, crossed_ = true, i_ = s.next_i, j_ = s.next_j;
    }

    /// Of vertices on the edge they are added with their knot, from all of its lines.
    void add_direction(const GridCrossing& c, double dx, double dy) {
        if (band_.owns(c)) Band::at(band_.directions, c).add(dx, dy);
    }

    void add_profile(const GridCrossing& c, std::uint8_t profile) {
        if (band_.profiles.edges != nullptr && band_.owns(c)) Band::at(band_.profiles, c).add(profile);
    }

    void finish(InsertionCounts& counts) {
        if (crossed_ && band_.has(i_, j_)) set_arm(1, in_, position_);
        counts.add(counts_);
    }

  private:
    void set_arm(std::size_t end, FeatureEdge e, double position) {
        band_.arms[curve_].edge[end] = e, band_.arms[curve_].position[end] = position;
    }

    /// Through a texel. A quadratic may leave it by the edge that it came in by, and is lost there.
    void pass(const Step& s) {
        SnappedTexel& t = band_.texel(s.i, s.j);
        if (!straight_ && in_ == s.out) {
            t.kinds |= kFolded;
            ++counts_.folded;
            return;
        }
        const std::uint32_t segment = kSegmentBetween[fetex::feature_edge_index(in_)][fetex::feature_edge_index(s.out)];
        insert_segment(t, segment);
        ++counts_.segments;
        if (!straight_) t.curved |= static_cast<SegmentSet>(1u << segment);
    }

    Band band_;
    std::uint32_t curve_;
    bool straight_, crossed_ = false;
    FeatureEdge in_{};
    std::int32_t i_ = 0, j_ = 0;
    double position_ = 0;
    InsertionCounts counts_;
};

class Inserter {
  public:
    Inserter(const LatticeCurves& curves, const Grid& grid, const Band& band)
        : curves_(curves), grid_(grid), walk_(grid), band_(band) {}

    void insert(std::uint32_t k) {
        const LatticeCurve& curve = curves_.curves[k];
        const PlanarPoint from = planar_point(curves_, grid_, curve.a), to = planar_point(curves_, grid_, curve.b);
        if (!curve.straight) return insert_quadratic(k, {from, planar_point(grid_, curve.middle), to}, curve.profile);
        Way way(band_, k, true);
        if (band_.directions.edges == nullptr && band_.profiles.edges == nullptr) {
            way = walk_rows(grid_, from, to, band_.rows, way);
        } else {
            const double dx = static_cast<double>(to.x - from.x) / static_cast<double>(grid_.px),
                         dy = static_cast<double>(to.y - from.y) / static_cast<double>(grid_.py);
            walk_rows(grid_, from, to, band_.rows, [&](const GridCrossing& c) {
                way(c);
                way.add_profile(c, curve.profile);
                if (band_.directions.edges != nullptr && !lies_on(from, c) && !lies_on(to, c))
                    way.add_direction(c, dx, dy);
            });
        }
        way.finish(counts_);
    }

    [[nodiscard]] const InsertionCounts& counts() const { return counts_; }

  private:
    void insert_quadratic(std::uint32_t k, const PlanarQuadratic& curve, std::uint8_t profile) {
        Way way(band_, k, false);
        for (const CurveCrossing& c : walk_.walk(curve)) {
            way(c.at);
            way.add_profile(c.at, profile);
            if (c.t > 0 && c.t < 1) way.add_direction(c.at, c.dx, c.dy);
        }
        way.finish(counts_);
    }

    [[nodiscard]] bool lies_on(PlanarPoint p, const GridCrossing& c) const {
        return c.vertical ? p.x == grid_.px * c.line : p.y == grid_.py * c.line;
    }

    const LatticeCurves& curves_;
    const Grid& grid_;
    CurveWalk walk_;
    Band band_;
    InsertionCounts counts_;
};

/// Which curves reach into which band.
class BandLists {
  public:
    BandLists(const LatticeCurves& curves, const Grid& grid, bool one) : height_(grid.height), one_(one) {
        starts_.assign(count() + 1, 0);
        const auto last_row = static_cast<std::int32_t>(grid.height) - 1;
        const auto bands = [&](const LatticeCurve& c, const auto& visit) {
            if (one_) return visit(0);
            const std::int32_t a = grid_cell(planar_point(curves, grid, c.a).y, grid.py, grid.height),
                               b = grid_cell(planar_point(curves, grid, c.b).y, grid.py, grid.height);
            const auto [low, high] = std::minmax(a, b);
            if (high < 0 || low > last_row) return;
            const auto first = static_cast<std::uint32_t>(std::max(low, 0)) / kBandRows,
                       last = static_cast<std::uint32_t>(std::min(high, last_row)) / kBandRows;
            for (std::uint32_t band = first; band <= last; ++band)
                visit(band);
        };
        for (const LatticeCurve& c : curves.curves)
            bands(c, [&](std::uint32_t band) { ++starts_[band + 1]; });
        for (std::size_t band = 0; band < count(); ++band)
            starts_[band + 1] += starts_[band];
        numbers_.resize(starts_.back());
        std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t k = 0; k < curves.curves.size(); ++k)
            bands(curves.curves[k], [&](std::uint32_t band) { numbers_[next[band]++] = k; });
    }

    [[nodiscard]] std::size_t count() const { return one_ ? 1 : (height_ + kBandRows - 1) / kBandRows; }
    [[nodiscard]] GridRows rows(std::size_t band) const {
        const auto row = [&](std::size_t k) {
            return static_cast<std::int32_t>(std::min<std::size_t>(k * kBandRows, height_));
        };
        return one_ ? GridRows{0, row(height_)} : GridRows{row(band), row(band + 1)};
    }
    [[nodiscard]] std::span<const std::uint32_t> curves(std::size_t band) const {
        return std::span(numbers_).subspan(starts_[band], starts_[band + 1] - starts_[band]);
    }

  private:
    std::uint32_t height_;
    bool one_;
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> numbers_;
};

} // namespace

InsertedCurves insert_curves(const LatticeCurves& curves, const Grid& grid, bool tangents, unsigned threads) {
    InsertedCurves out;
    out.texels.resize(std::size_t{grid.width} * grid.height);
    out.arms.resize(curves.curves.size());
    out.points = EdgePoints(grid.width, grid.height);
    if (tangents) out.directions = EdgeDirections(grid.width, grid.height);
    const auto other = [](const LatticeCurve& c) { return c.profile != 0; };
    if (std::ranges::any_of(curves.curves, other)) out.profiles = EdgeProfiles(grid.width, grid.height);
    const BandLists bands(curves, grid, tangents);
    std::vector<InsertionCounts> counts(bands.count());
    parallel_for(bands.count(), threads, [&](std::size_t k) {
        const GridRows rows = bands.rows(k);
        const Band band(grid, rows, out);
        out.points.reset_rows(static_cast<std::size_t>(rows.first), static_cast<std::size_t>(band.lines_end));
        if (tangents) out.directions.reset_rows(0, std::size_t{grid.height} + 1);
        if (!out.profiles.empty())
            out.profiles.reset_rows(static_cast<std::size_t>(rows.first), static_cast<std::size_t>(band.lines_end));
        Inserter inserter(curves, grid, band);
        for (const std::uint32_t curve : bands.curves(k))
            inserter.insert(curve);
        counts[k] = inserter.counts();
    });
    for (const InsertionCounts& c : counts)
        out.counts.add(c);
    return out;
}

} // namespace fetexc
