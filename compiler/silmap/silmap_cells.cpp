// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/silmap_cells.h"

#include <algorithm>
#include <atomic>

#include "compiler/error_budget.h"
#include "compiler/silmap/point_seed.h"

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Texels of a cell's columns or rows: the one before its middle, and the one behind.
std::array<std::uint32_t, 2> texels_beside(std::uint32_t cell, std::uint32_t texels) {
    return {cell > 0 ? cell - 1 : 0, std::min(cell, texels - 1)};
}

void place(SilmapCellData& c, std::uint32_t x, std::uint32_t y, fetex::SilmapCellFormat format) {
    c.x = x, c.y = y;
    c.shown.point = {fetex::silmap_position(format, x), fetex::silmap_position(format, y)};
}

class RowReader {
  public:
    /// faces: of features; then results mean nothing.
    RowReader(const PlanarMap& map, const Scene& scene, Compositor& compositor, fetex::SilmapCellFormat format,
              const SkipRules& skip, FaceRow* faces, SilmapCells& out)
        : map_(map), mapper_(map, scene, compositor, stats_, skip),
          reader_(map, budget::kSilmapChord / fetex::silmap_steps(format)), format_(format), faces_(faces), out_(out) {
        if (faces_ != nullptr) mapper_.tell_faces_apart();
    }

    /// False: the map contradicts itself.
    bool read(std::uint32_t j, std::vector<SilmapCellData>& cells) {
        bool good = true;
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i > out_.width || !good) return;
            const bool empty = map_.sub_edges(i, j).empty();
            ++stats_.texels;
            ++(empty                              ? stats_.texels_empty
               : map_.sub_edges(i, j).size() == 1 ? stats_.texels_simple
                                                  : stats_.texels_arranged);
            if (faces_ == nullptr) note_result(i, j, mapper_.lookup()(corner));
            if (faces_ != nullptr && empty) faces_->add_empty();
            if (empty) return;
            good = mapper_.analyse(i, j, corner, cell_);
            if (good && faces_ != nullptr) faces_->add(cell_);
            if (good) add(i, j, cells);
        });
        return good;
    }
    [[nodiscard]] const PlanarStats& stats() const { return stats_; }

  private:
    void note_result(std::uint32_t i, std::uint32_t j, ResultId result) {
        if (i == 0)
            out_.left[j] = result;
        else if (j == 0)
            out_.top[i] = result;
        else
            out_.results[(j - 1) * std::size_t{out_.width} + i - 1] = result;
    }

    void add(std::uint32_t i, std::uint32_t j, std::vector<SilmapCellData>& cells) {
        reader_.read(cell_, drawing_);
        if (drawing_.chords.empty()) return;
        SilmapCellData c;
        c.i = i, c.j = j;
        TruthSlabs& truth = out_.truth[j];
        c.first_slab = static_cast<std::uint32_t>(truth.slabs.size());
        slabs_.add(drawing_, out_.box(c), truth);
        c.slabs = static_cast<std::uint32_t>(truth.slabs.size()) - c.first_slab;
        c.corners = static_cast<std::uint32_t>(drawing_.corners.size());
        for (std::uint32_t link = 0; link < 4; ++link) {
            const std::vector<double>& crossings = drawing_.crossings[link];
            c.edges_across |= static_cast<std::uint32_t>(std::min<std::size_t>(crossings.size(), 255)) << 8 * link;
            if (crossings.size() == 1) c.crossing[link] = static_cast<float>(crossings[0]);
        }
        const CellSteps seed = seed_of(drawing_, format_);
        place(c, seed.x, seed.y, format_);
        cells.push_back(c);
    }

    const PlanarMap& map_;
    PlanarStats stats_;
    TexelMapper mapper_;
    CellReader reader_;
    fetex::SilmapCellFormat format_;
    FaceRow* faces_;
    SilmapCells& out_;
    TexelMap cell_;
    CellDrawing drawing_;
    TruthBuilder slabs_;
};

void add(PlanarStats& a, const PlanarStats& b) {
    a.exact_comparisons += b.exact_comparisons;
    a.texels += b.texels, a.texels_empty += b.texels_empty, a.texels_simple += b.texels_simple,
        a.texels_arranged += b.texels_arranged;
    a.trapezoids += b.trapezoids, a.regions += b.regions;
}

std::array<ResultId, 4> corners_of(const SilmapCells& cells, std::uint32_t i, std::uint32_t j) {
    return {cells.corner(i, j, fetex::kSilmapNW), cells.corner(i, j, fetex::kSilmapNE),
            cells.corner(i, j, fetex::kSilmapSW), cells.corner(i, j, fetex::kSilmapSE)};
}

bool one_result(const std::array<ResultId, 4>& c) { return c[0] == c[1] && c[0] == c[2] && c[0] == c[3]; }

/// Cells without edges whose corners differ: an edge runs along a side.
std::vector<SilmapCellData> with_plain(const SilmapCells& cells, std::uint32_t j,
                                       const std::vector<SilmapCellData>& edged, fetex::SilmapCellFormat format,
                                       TruthSlabs& truth) {
    std::vector<SilmapCellData> out;
    auto next = edged.begin();
    for (std::uint32_t i = 0; i <= cells.width; ++i) {
        if (next != edged.end() && next->i == i) {
            out.push_back(*next++);
            continue;
        }
        if (one_result(corners_of(cells, i, j))) continue;
        SilmapCellData c;
        c.i = i, c.j = j;
        place(c, fetex::silmap_step(format, 0.5), fetex::silmap_step(format, 0.5), format);
        c.first_slab = static_cast<std::uint32_t>(truth.slabs.size()), c.slabs = 1;
        TruthBuilder::add_plain(cells.inside(i, j), cells.box(c), truth);
        out.push_back(c);
    }
    return out;
}

const SilmapCellData* find(const SilmapCells& cells, std::uint32_t i, std::uint32_t j) {
    const auto begin = cells.cells.begin() + cells.row_start[j], end = cells.cells.begin() + cells.row_start[j + 1];
    const auto it = std::lower_bound(begin, end, i, [](const SilmapCellData& c, std::uint32_t v) { return c.i < v; });
    return it != end && it->i == i ? &*it : nullptr;
}

/// Set of links between corners of different results.
std::uint32_t boundaries_between(const std::array<ResultId, 4>& r) {
    using namespace fetex;
    const auto link = [](std::uint32_t k, bool apart) { return apart ? 1u << k : 0u; };
    return link(kSilmapWest, r[kSilmapNW] != r[kSilmapSW]) | link(kSilmapNorth, r[kSilmapNW] != r[kSilmapNE]) |
           link(kSilmapEast, r[kSilmapNE] != r[kSilmapSE]) | link(kSilmapSouth, r[kSilmapSW] != r[kSilmapSE]);
}

void link(SilmapCells& cells, SilmapCellData& c) {
    using namespace fetex;
    c.shown.corners = cells.of_features ? c.faces : corners_of(cells, c.i, c.j);
    c.boundaries = cells.of_features ? c.apart : boundaries_between(c.shown.corners);
    for (std::uint32_t k = 0; k < 4; ++k) {
        c.neighbours[k] = kNone;
        if ((c.boundaries >> k & 1) == 0) continue;
        const std::int64_t i = std::int64_t{c.i} + (k == kSilmapEast) - (k == kSilmapWest),
                           j = std::int64_t{c.j} + (k == kSilmapSouth) - (k == kSilmapNorth);
        const bool beyond = i < 0 || j < 0 || i > cells.width || j > cells.height;
        c.neighbours[k] =
            beyond
                ? kOwnPoint
                : static_cast<std::uint32_t>(find(cells, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)) -
                                             cells.cells.data());
    }
}

} // namespace

ResultId SilmapCells::corner(std::uint32_t i, std::uint32_t j, std::uint32_t corner) const {
    return results[std::size_t{texels_beside(j, height)[corner >> 1]} * width + texels_beside(i, width)[corner & 1]];
}

ResultId SilmapCells::inside(std::uint32_t i, std::uint32_t j) const {
    return i == 0 ? left[j] : j == 0 ? top[i] : results[std::size_t{j - 1} * width + i - 1];
}

fetex::SilmapBox SilmapCells::box(const SilmapCellData& c) const {
    return {c.i == 0 ? 0.5 : 0, c.j == 0 ? 0.5 : 0, c.i == width ? 0.5 : 1, c.j == height ? 0.5 : 1};
}

SilmapPoint point_across(const SilmapCells& cells, const SilmapCellData& c, const SilmapPoint& point,
                         std::uint32_t link) {
    const std::uint32_t neighbour = c.neighbours[link];
    const SilmapPoint& p = neighbour == kOwnPoint ? point : cells.cells[neighbour].shown.point;
    return {p.x + kToNeighbour[link].x, p.y + kToNeighbour[link].y};
}

std::array<double, 4> exits_of(const SilmapCells& cells, const SilmapCellData& c, const SilmapPoint& point) {
    std::array<double, 4> exit{point.y, point.x, point.y, point.x};
    for (std::uint32_t link = 0; link < 4; ++link) {
        if (c.neighbours[link] != kNone)
            exit[link] = ShownCell::exit_of(point, link, point_across(cells, c, point, link));
    }
    return exit;
}

void SilmapCells::measure(SilmapCellData& c) const {
    const CellTruth t = truth_of(c);
    c.wrong = (t.box.x1 - t.box.x0) * (t.box.y1 - t.box.y0) - area_of(t, c.shown.corners[fetex::kSilmapSE]);
    for (std::uint32_t link = 0; link < 4; ++link) {
        c.right[link] = link_area(t, c.shown.point, link, c.shown.exit[link], c.shown.corners);
        c.wrong -= c.right[link];
    }
}

void link_cells(SilmapCells& cells, unsigned threads) {
    constexpr std::size_t chunk = 256;
    const auto each = [&](const auto& visit) {
        parallel_for_chunks(cells.cells.size(), chunk, threads, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                visit(cells.cells[k]);
        });
    };
    each([&](SilmapCellData& c) { link(cells, c); });
    each([&](SilmapCellData& c) {
        c.shown.exit = exits_of(cells, c, c.shown.point);
        cells.measure(c);
    });
}

namespace {

/// faces: of features, a row each; or none.
std::optional<SilmapCells> read_all(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                    fetex::SilmapCellFormat format, unsigned threads, const SkipRules& skip,
                                    std::span<FaceRow> faces, PlanarStats& stats) {
    SilmapCells out;
    out.width = map.grid().width - 1, out.height = map.grid().height - 1;
    out.results.resize(std::size_t{out.width} * out.height);
    const std::size_t rows = std::size_t{out.height} + 1;
    out.truth.resize(rows);
    out.left.resize(rows), out.top.resize(std::size_t{out.width} + 1);
    std::vector<std::vector<SilmapCellData>> edged(rows);
    std::vector<PlanarStats> row_stats(rows);
    std::vector<char> good(rows);
    parallel_for(rows, threads, [&](std::size_t j) {
        RowReader reader(map, scene, compositor, format, skip, faces.empty() ? nullptr : &faces[j], out);
        good[j] = reader.read(static_cast<std::uint32_t>(j), edged[j]) ? 1 : 0;
        row_stats[j] = reader.stats();
    });
    if (std::ranges::find(good, 0) != good.end()) return std::nullopt;
    for (const PlanarStats& s : row_stats)
        add(stats, s);
    parallel_for(rows, threads, [&](std::size_t j) {
        edged[j] = with_plain(out, static_cast<std::uint32_t>(j), edged[j], format, out.truth[j]);
    });
    for (const std::vector<SilmapCellData>& row : edged) {
        out.row_start.push_back(static_cast<std::uint32_t>(out.cells.size()));
        out.cells.insert(out.cells.end(), row.begin(), row.end());
    }
    out.row_start.push_back(static_cast<std::uint32_t>(out.cells.size()));
    return out;
}

} // namespace

std::optional<SilmapCells> read_cells(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                      fetex::SilmapCellFormat format, unsigned threads, const SkipRules& skip,
                                      PlanarStats& stats) {
    return read_all(map, scene, compositor, format, threads, skip, {}, stats);
}

std::optional<SilmapCells> read_feature_cells(const PlanarMap& map, const Scene& features,
                                              fetex::SilmapCellFormat format, unsigned threads, const SkipRules& skip,
                                              PlanarStats& stats) {
    Compositor unasked(features, skip);
    std::vector<FaceRow> faces;
    for (std::uint32_t j = 0; j < map.grid().height; ++j)
        faces.emplace_back(map, j);
    auto out = read_all(map, features, unasked, format, threads, skip, faces, stats);
    if (!out) return out;
    out->of_features = true;
    if (!find_boundaries(*out, map, faces, threads)) return std::nullopt;
    return out;
}

} // namespace fetexc
