// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_reader.h"

#include <algorithm>

#include "compiler/silmap/point_seed.h"

namespace fetexc {
namespace {

void place(SilmapCellData& c, std::uint32_t x, std::uint32_t y, fetex::SilmapCellFormat format) {
    c.x = x, c.y = y;
    c.shown.point = {fetex::silmap_position(format, x), fetex::silmap_position(format, y)};
}

/// What else is read of a row: of drawings, or of features.
struct RowNotes {
    PartsRow* parts = nullptr;
    FaceRow* faces = nullptr;

    void add_empty(ResultId result, bool middle) const {
        if (parts != nullptr)
            parts->add_empty(result, middle);
        else
            faces->add_empty();
    }
    void add_cell(const TexelMap& cell, bool middle) const {
        if (parts != nullptr)
            parts->add_cell(cell, middle);
        else
            faces->add(cell);
    }
};

class RowReader {
  public:
    RowReader(const PlanarMap& map, const Scene& scene, Compositor& compositor, fetex::SilmapCellFormat format,
              double chord, const SkipRules& skip, const RowNotes& notes, SilmapCells& out)
        : map_(map), mapper_(map, scene, compositor, stats_, skip), reader_(map, chord), format_(format), notes_(notes),
          out_(out) {
        if (notes_.faces != nullptr) mapper_.tell_faces_apart();
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
            if (notes_.faces == nullptr) note_result(i, j, mapper_.lookup()(corner));
            const bool middle = i > 0 && j > 0; // of a texel
            if (empty) return notes_.add_empty(out_.inside(i, j), middle);
            good = mapper_.analyse(i, j, corner, cell_);
            if (!good) return;
            notes_.add_cell(cell_, middle);
            add(i, j, cells);
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
    RowNotes notes_;
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

bool one_result(const SilmapCells& cells, std::uint32_t i, std::uint32_t j) {
    const ResultId first = cells.corner(i, j, 0);
    return first == cells.corner(i, j, 1) && first == cells.corner(i, j, 2) && first == cells.corner(i, j, 3);
}

/// Cells without edges whose corners differ, an edge running along a side; near: and those next to cells with edges.
std::vector<SilmapCellData> with_plain(const SilmapCells& cells, std::uint32_t j,
                                       const std::vector<std::vector<SilmapCellData>>& edged, bool near,
                                       fetex::SilmapCellFormat format, TruthSlabs& truth) {
    std::vector<bool> wanted(std::size_t{cells.width} + 1, false);
    for (std::uint32_t row = j > 0 ? j - 1 : 0; near && row <= std::min(j + 1, cells.height); ++row) {
        for (const SilmapCellData& c : edged[row]) {
            for (std::uint32_t i = c.i > 0 ? c.i - 1 : 0; i <= std::min(c.i + 1, cells.width); ++i)
                wanted[i] = true;
        }
    }
    std::vector<SilmapCellData> out;
    auto next = edged[j].begin();
    for (std::uint32_t i = 0; i <= cells.width; ++i) {
        if (next != edged[j].end() && next->i == i) {
            out.push_back(*next++);
            continue;
        }
        if (!wanted[i] && one_result(cells, i, j)) continue;
        SilmapCellData c;
        c.i = i, c.j = j, c.plain = true;
        place(c, fetex::silmap_step(format, 0.5), fetex::silmap_step(format, 0.5), format);
        c.first_slab = static_cast<std::uint32_t>(truth.slabs.size()), c.slabs = 1;
        TruthBuilder::add_plain(cells.inside(i, j), cells.box(c), truth);
        out.push_back(c);
    }
    return out;
}

/// notes(j): of a row.
template <class Notes>
std::optional<SilmapCells> read_all(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                    fetex::SilmapCellFormat format, double chord, bool near, unsigned threads,
                                    const SkipRules& skip, const Notes& notes, PlanarStats& stats) {
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
        RowReader reader(map, scene, compositor, format, chord, skip, notes(j), out);
        good[j] = reader.read(static_cast<std::uint32_t>(j), edged[j]) ? 1 : 0;
        row_stats[j] = reader.stats();
    });
    if (std::ranges::find(good, 0) != good.end()) return std::nullopt;
    for (const PlanarStats& s : row_stats)
        add(stats, s);
    std::vector<std::vector<SilmapCellData>> all(rows);
    parallel_for(rows, threads, [&](std::size_t j) {
        all[j] = with_plain(out, static_cast<std::uint32_t>(j), edged, near, format, out.truth[j]);
    });
    for (const std::vector<SilmapCellData>& row : all) {
        out.row_start.push_back(static_cast<std::uint32_t>(out.cells.size()));
        out.cells.insert(out.cells.end(), row.begin(), row.end());
    }
    out.row_start.push_back(static_cast<std::uint32_t>(out.cells.size()));
    return out;
}

} // namespace

std::uint64_t cells_with_edges(const PlanarMap& map) {
    std::uint64_t n = 0;
    for (std::uint32_t j = 0; j < map.grid().height; ++j) {
        for (std::uint32_t i = 0; i < map.grid().width; ++i)
            n += map.sub_edges(i, j).empty() ? 0 : 1;
    }
    return n;
}

std::optional<ReadCells> read_cells(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                    fetex::SilmapCellFormat format, double chord, bool near, unsigned threads,
                                    const SkipRules& skip, PlanarStats& stats) {
    std::vector<PartsRow> parts;
    for (std::uint32_t j = 0; j < map.grid().height; ++j)
        parts.emplace_back(map, j);
    const auto notes = [&](std::size_t j) { return RowNotes{&parts[j], nullptr}; };
    auto cells = read_all(map, scene, compositor, format, chord, near, threads, skip, notes, stats);
    if (!cells) return std::nullopt;
    return ReadCells{std::move(*cells), std::move(parts)};
}

std::optional<SilmapCells> read_feature_cells(const PlanarMap& map, const Scene& features,
                                              fetex::SilmapCellFormat format, double chord, unsigned threads,
                                              const SkipRules& skip, PlanarStats& stats) {
    Compositor unasked(features, skip);
    std::vector<FaceRow> faces;
    for (std::uint32_t j = 0; j < map.grid().height; ++j)
        faces.emplace_back(map, j);
    const auto notes = [&](std::size_t j) { return RowNotes{nullptr, &faces[j]}; };
    auto out = read_all(map, features, unasked, format, chord, false, threads, skip, notes, stats);
    if (!out) return out;
    out->of_features = true;
    if (!find_boundaries(*out, map, faces, threads)) return std::nullopt;
    return out;
}

} // namespace fetexc
