// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_reader.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "compiler/silmap/point_seed.h"

namespace fetexc {
namespace {

void place(SilmapCellData& c, const CellSteps& at, fetex::SilmapCellFormat format) {
    c.x = at.x, c.y = at.y;
    c.shown.point = {fetex::silmap_position(format, at.x), fetex::silmap_position(format, at.y)};
}

/// What else is read of a row: of drawings, or of features.
struct RowNotes {
    PartsRow* parts = nullptr;
    FaceRow* faces = nullptr;
};

/// A cell with visible edges, before its neighbours are known.
struct ReadCell {
    std::uint32_t i = 0;
    CellSteps seed;
    std::uint32_t first_slab = 0, slabs = 0, edges_across = 0, corners = 0; ///< as in SilmapCellData
};
using ReadRow = std::vector<ReadCell>;

class RowReader {
  public:
    RowReader(const PlanarMap& map, const Scene& scene, Compositor& compositor, const CellReading& how,
              const SkipRules& skip, SilmapCells& out)
        : map_(map), mapper_(map, scene, compositor, stats_, skip), reader_(map, how.chord), how_(how), out_(out) {}

    /// False: the map contradicts itself.
    bool read(std::uint32_t j, const RowNotes& notes, ReadRow& cells) {
        notes_ = notes;
        if (notes_.faces != nullptr) mapper_.tell_faces_apart();
        bool good = true;
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i > out_.width || !good) return;
            const std::size_t edges = map_.sub_edges(i, j).size();
            ++stats_.texels;
            ++(edges == 0 ? stats_.texels_empty : edges == 1 ? stats_.texels_simple : stats_.texels_arranged);
            if (notes_.faces == nullptr) note_result(i, j, mapper_.lookup()(corner));
            if (edges == 0) {
                if (notes_.faces != nullptr) notes_.faces->add_empty();
            } else {
                good = read_edges(i, j, corner, cells);
            }
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

    bool read_edges(std::uint32_t i, std::uint32_t j, const Windings& corner, ReadRow& cells) {
        LoneEdge lone;
        if (mapper_.analyse_lone(i, j, corner, lone)) {
            notes_.parts->add(map_, lone);
            reader_.read(lone, drawing_);
        } else {
            if (!mapper_.analyse(i, j, corner, cell_)) return false;
            if (notes_.parts != nullptr)
                notes_.parts->add(map_, cell_);
            else
                notes_.faces->add(cell_);
            reader_.read(cell_, drawing_);
        }
        if (!drawing_.chords.empty()) add(i, j, cells);
        return true;
    }

    void add(std::uint32_t i, std::uint32_t j, ReadRow& cells) {
        ReadCell c;
        c.i = i;
        TruthSlabs& truth = out_.truth[j];
        c.first_slab = static_cast<std::uint32_t>(truth.slabs.size());
        slabs_.add(drawing_, out_.box(i, j), truth);
        c.slabs = static_cast<std::uint32_t>(truth.slabs.size()) - c.first_slab;
        c.corners = static_cast<std::uint32_t>(drawing_.corners.size());
        for (std::uint32_t link = 0; link < 4; ++link) {
            const std::vector<double>& crossings = drawing_.crossings[link];
            c.edges_across |= static_cast<std::uint32_t>(std::min<std::size_t>(crossings.size(), 255)) << 8 * link;
        }
        c.seed = seed_of(drawing_, how_.format, how_.on_edge);
        cells.push_back(c);
    }

    const PlanarMap& map_;
    PlanarStats stats_;
    TexelMapper mapper_;
    CellReader reader_;
    CellReading how_;
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

/// Sets what cells of a row have corners of different results.
void want_parted(const SilmapCells& cells, std::uint32_t j, std::vector<std::uint8_t>& wanted) {
    const ResultId *above = cells.results.data() + std::size_t{j > 0 ? j - 1 : 0} * cells.width,
                   *below = cells.results.data() + std::size_t{std::min(j, cells.height - 1)} * cells.width;
    bool parted = above[0] != below[0]; // the texels left of the cell
    wanted[0] |= parted ? 1 : 0;
    for (std::uint32_t i = 1; i < cells.width; ++i) {
        const bool left = std::exchange(parted, above[i] != below[i]);
        wanted[i] |= left || parted || above[i - 1] != above[i] ? 1 : 0;
    }
    wanted[cells.width] |= parted ? 1 : 0;
}

/// Columns of a row's cells: of those with edges, and of those without whose corners differ, an edge running along a
/// side; near: and of those next to cells with edges.
std::vector<std::uint32_t> columns_of(const SilmapCells& cells, std::uint32_t j, const std::vector<ReadRow>& edged,
                                      bool near) {
    std::vector<std::uint8_t> wanted(std::size_t{cells.width} + 1, 0);
    for (std::uint32_t row = j > 0 ? j - 1 : 0; near && row <= std::min(j + 1, cells.height); ++row) {
        for (const ReadCell& c : edged[row]) {
            for (std::uint32_t i = c.i > 0 ? c.i - 1 : 0; i <= std::min(c.i + 1, cells.width); ++i)
                wanted[i] = 1;
        }
    }
    for (const ReadCell& c : edged[j])
        wanted[c.i] = 1;
    want_parted(cells, j, wanted);
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i <= cells.width; ++i) {
        if (wanted[i] != 0) out.push_back(i);
    }
    return out;
}

/// The cells of a row, in their places.
void write_row(SilmapCells& cells, std::uint32_t j, const std::vector<std::uint32_t>& columns, const ReadRow& edged,
               fetex::SilmapCellFormat format) {
    TruthSlabs& truth = cells.truth[j];
    auto next = edged.begin();
    SilmapCellData* out = cells.cells.data() + cells.row_start[j];
    for (const std::uint32_t i : columns) {
        SilmapCellData& c = *out++;
        c = {};
        c.i = i, c.j = j;
        if (next != edged.end() && next->i == i) {
            place(c, next->seed, format);
            c.first_slab = next->first_slab, c.slabs = next->slabs;
            c.edges_across = next->edges_across, c.corners = next->corners;
            ++next;
        } else {
            c.plain = true;
            const std::uint32_t middle = fetex::silmap_step(format, 0.5);
            place(c, {middle, middle}, format);
            c.first_slab = static_cast<std::uint32_t>(truth.slabs.size()), c.slabs = 1;
            TruthBuilder::add_plain(cells.inside(i, j), cells.box(i, j), truth);
        }
    }
}

void write_cells(SilmapCells& cells, const std::vector<ReadRow>& edged, bool near, fetex::SilmapCellFormat format,
                 unsigned threads) {
    std::vector<std::vector<std::uint32_t>> columns(edged.size());
    parallel_for(edged.size(), threads,
                 [&](std::size_t j) { columns[j] = columns_of(cells, static_cast<std::uint32_t>(j), edged, near); });
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& row : columns) {
        cells.row_start.push_back(static_cast<std::uint32_t>(count));
        count += row.size();
    }
    cells.row_start.push_back(static_cast<std::uint32_t>(count));
    cells.cells.resize(count);
    parallel_for(edged.size(), threads,
                 [&](std::size_t j) { write_row(cells, static_cast<std::uint32_t>(j), columns[j], edged[j], format); });
}

/// notes(j): of a row.
template <class Notes>
std::optional<SilmapCells> read_all(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                    const CellReading& how, bool near, unsigned threads, const SkipRules& skip,
                                    const Notes& notes, PlanarStats& stats) {
    SilmapCells out;
    out.width = map.grid().width - 1, out.height = map.grid().height - 1;
    out.results.resize(std::size_t{out.width} * out.height);
    const std::size_t rows = std::size_t{out.height} + 1;
    out.truth.resize(rows);
    out.left.resize(rows), out.top.resize(std::size_t{out.width} + 1);
    std::vector<ReadRow> edged(rows);
    constexpr std::size_t chunk = 8; // rows that share a reader's memory
    std::vector<PlanarStats> chunk_stats((rows + chunk - 1) / chunk);
    std::atomic<bool> good = true;
    parallel_for_chunks(rows, chunk, threads, [&](std::size_t first, std::size_t end) {
        RowReader reader(map, scene, compositor, how, skip, out);
        for (std::size_t j = first; j < end; ++j) {
            if (!reader.read(static_cast<std::uint32_t>(j), notes(j), edged[j])) good = false;
        }
        chunk_stats[first / chunk] = reader.stats();
    });
    if (!good) return std::nullopt;
    for (const PlanarStats& s : chunk_stats)
        add(stats, s);
    write_cells(out, edged, near, how.format, threads);
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
                                    const CellReading& how, bool near, unsigned threads, const SkipRules& skip,
                                    PlanarStats& stats) {
    std::vector<PartsRow> parts(map.grid().height);
    const auto notes = [&](std::size_t j) { return RowNotes{&parts[j], nullptr}; };
    auto cells = read_all(map, scene, compositor, how, near, threads, skip, notes, stats);
    if (!cells) return std::nullopt;
    return ReadCells{std::move(*cells), std::move(parts)};
}

std::optional<SilmapCells> read_feature_cells(const PlanarMap& map, const Scene& features, const CellReading& how,
                                              unsigned threads, const SkipRules& skip, PlanarStats& stats) {
    Compositor unasked(features, skip);
    std::vector<FaceRow> faces;
    for (std::uint32_t j = 0; j < map.grid().height; ++j)
        faces.emplace_back(map, j);
    const auto notes = [&](std::size_t j) { return RowNotes{nullptr, &faces[j]}; };
    auto out = read_all(map, features, unasked, how, false, threads, skip, notes, stats);
    if (!out) return out;
    out->of_features = true;
    if (!find_boundaries(*out, map, faces, threads)) return std::nullopt;
    return out;
}

} // namespace fetexc
