// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/fbt_builder.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <sstream>

#include "compiler/diagnostics.h"
#include "compiler/fbt/mip_chain.h"
#include "compiler/fbt/row_writer.h"
#include "compiler/parallel.h"
#include "compiler/release.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kMaxSize = 16384;

/// Reports at most once per percent, from one thread at a time.
class RowProgress {
  public:
    RowProgress(const ProgressSink& sink, std::uint32_t rows) : sink_(sink), rows_(rows) {}
    void row_done() {
        const std::uint32_t done = ++done_;
        if (!sink_ || done * 100 / rows_ == (done - 1) * 100 / rows_) return;
        const std::lock_guard lock(mutex_);
        sink_("fbt", static_cast<double>(done) / rows_);
    }

  private:
    const ProgressSink& sink_;
    std::uint32_t rows_;
    std::atomic<std::uint32_t> done_{0};
    std::mutex mutex_;
};

void add(PlanarStats& a, const PlanarStats& b) {
    a.exact_comparisons += b.exact_comparisons;
    a.texels += b.texels, a.texels_empty += b.texels_empty, a.texels_simple += b.texels_simple,
        a.texels_arranged += b.texels_arranged;
    a.trapezoids += b.trapezoids, a.regions += b.regions;
    a.edges_invisible += b.edges_invisible, a.edges_visible += b.edges_visible;
}

void add(FbtStats& a, const FbtStats& b) {
    a.texels_empty += b.texels_empty, a.texels_two_regions += b.texels_two_regions,
        a.texels_more_regions += b.texels_more_regions;
    a.texels_banded += b.texels_banded, a.bands += b.bands, a.bands_avoided += b.bands_avoided;
    a.features += b.features, a.pieces += b.pieces, a.regions += b.regions,
        a.regions_interpolated += b.regions_interpolated;
    a.runs_shared += b.runs_shared, a.pieces_demoted += b.pieces_demoted, a.slivers_collapsed += b.slivers_collapsed;
}

void add(fetex::FbtTraits& a, const fetex::FbtTraits& b) {
    a.max_degree = std::max(a.max_degree, b.max_degree);
    a.degrees |= b.degrees, a.directions |= b.directions;
    a.bands |= b.bands, a.corners |= b.corners, a.patches |= b.patches, a.shared |= b.shared,
        a.translucent |= b.translucent;
    a.max_entries = std::max(a.max_entries, b.max_entries), a.max_bands = std::max(a.max_bands, b.max_bands);
    a.max_depth = std::max(a.max_depth, b.max_depth);
}

class Builder {
  public:
    Builder(const Scene& scene, const CompileOptions& options, const ProgressSink& progress, const PlanarMap& map,
            Compositor& compositor, const SampleSource* samples = nullptr, const ReachabilityGraph* graph = nullptr)
        : scene_(scene), options_(options), map_(map), compositor_(compositor),
          corners_(map, scene, compositor, options.threads),
          sampler_(map, scene, compositor, corners_, options.sample_format),
          samples_(samples != nullptr ? *samples : sampler_), given_graph_(graph),
          separation_(samples != nullptr ? Separation::Edges : Separation::Results),
          progress_(progress, map.grid().height) {}

    Result<FbtBuild> run(CompileReport report, FbtRegions* regions) {
        const Grid& g = map_.grid();
        std::vector<RowOutput> rows(g.height);
        std::vector<PlanarStats> stats(g.height);
        std::vector<Status> status(g.height);
        std::vector<ReachabilityRow> reach;
        for (std::uint32_t j = 0; j < g.height && given_graph_ == nullptr; ++j)
            reach.emplace_back(map_, j, separation_);
        parallel_for(g.height, options_.threads, [&](std::size_t j) {
            status[j] =
                build_row(static_cast<std::uint32_t>(j), rows[j], reach.empty() ? nullptr : &reach[j], stats[j]);
            progress_.row_done();
        });
        for (const Status& s : status) {
            if (!s) return s.error();
        }
        for (const PlanarStats& s : stats)
            add(report.planar, s);
        std::optional<ReachabilityGraph> own;
        if (given_graph_ == nullptr) own.emplace(map_, reach, options_.threads);
        const ReachabilityGraph& graph = own ? *own : *given_graph_;
        if (graph.conflict()) return inconsistent(graph.conflict()->i, graph.conflict()->j);
        report.planar.reach_vertices = graph.vertices(), report.planar.reach_links = graph.links().size();
        report.planar.regions_connected = graph.component_count();
        Result<FbtBuild> build = join(rows, std::move(report), graph, regions);
        if (build && regions != nullptr) regions->reachability = graph;
        return build;
    }

  private:
    /// For people: the texel, and where it is on the canvas.
    [[nodiscard]] std::string place_of(std::uint32_t i, std::uint32_t j) const {
        const Grid& g = map_.grid();
        const CanvasPoint p = to_canvas(scene_, g, static_cast<double>(g.px * i), static_cast<double>(g.py * j));
        std::ostringstream out;
        out << "texel (" << i << ", " << j << "), canvas (" << p.x << ", " << p.y << ")";
        return out.str();
    }

    [[nodiscard]] Error inconsistent(std::uint32_t i, std::uint32_t j) const {
        return {ErrorClass::Runtime, diag::kPlanarInconsistent,
                "the planar map contradicts itself; please report this file", place_of(i, j)};
    }

    Status build_row(std::uint32_t j, RowOutput& out, ReachabilityRow* reach, PlanarStats& stats) {
        TexelMapper mapper(map_, scene_, compositor_, stats, options_.skip);
        if (separation_ == Separation::Edges) mapper.tell_faces_apart();
        FeatureBuilder feature_builder(map_, mapper, options_.skip);
        RowWriter writer(map_, samples_, options_.sample_format, out);
        TexelMap texel;
        TexelFeatures features;
        Status status;
        map_.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i == map_.grid().width || !status) return;
            const std::span<const SubEdge> edges = map_.sub_edges(i, j);
            ++stats.texels;
            ++(edges.empty() ? stats.texels_empty : edges.size() == 1 ? stats.texels_simple : stats.texels_arranged);
            if (edges.empty() && options_.skip.empty_texels) {
                if (reach != nullptr) reach->add_empty(corners_.at(i, j));
                return writer.write_whole(samples_.whole(i, j));
            }
            if (!mapper.analyse(i, j, corner, texel) || !feature_builder.build(texel, features)) {
                status = inconsistent(i, j);
                return;
            }
            stats.edges_visible += features.edges_visible, stats.edges_invisible += features.edges_invisible;
            if (features.bands.empty()) {
                if (reach != nullptr) reach->add_empty(corners_.at(i, j));
                return writer.write_whole(samples_.whole(i, j));
            }
            const std::uint32_t vertex = reach != nullptr
                                             ? reach->add_texel(texel, features.region_of_face, features.region_result)
                                             : given_graph_->first_vertex(i, j) - given_graph_->row_start(j);
            out.stats.bands_avoided += levels(texel) - std::min(levels(texel), features.bands.size() - 1);
            writer.write_texel(texel, features, vertex);
        });
        return status;
    }

    /// Horizontal lines that the trapezoid decomposition of the paper's §4.4 draws inside the texel.
    [[nodiscard]] std::size_t levels(const TexelMap& texel) const {
        std::size_t n = 0;
        for (std::uint32_t k : texel.graph.nodes) {
            if (map_.node(k).hy == texel.frame.top + 1) ++n;
        }
        return n;
    }

    Result<FbtBuild> join(std::vector<RowOutput>& rows, CompileReport report, const ReachabilityGraph& graph,
                          FbtRegions* regions) {
        FbtBuild build;
        build.report = std::move(report);
        fetex::FbtTexture& t = build.texture;
        t.width = map_.grid().width, t.height = map_.grid().height;
        t.sample_format = options_.sample_format;
        for (const RowOutput& row : rows)
            add(t.traits, row.traits), add(build.report.fbt, row.stats);
        std::vector<std::uint32_t> collapsed; // vertices of the graph
        std::vector<std::size_t> base{0};     // where each row's records begin
        for (std::uint32_t j = 0; j < t.height; ++j) {
            for (std::uint32_t v : rows[j].collapsed)
                collapsed.push_back(graph.row_start(j) + v);
            base.push_back(base.back() + rows[j].records.size() / 4);
        }
        if (base.back() > fetex::kFbtSampleMask) {
            return Error{ErrorClass::Unsupported, diag::kFbtTooLarge,
                         "the texture needs more records than the format can address", ""};
        }
        t.records.resize(4 * base.back());
        t.texels.resize(static_cast<std::size_t>(t.width) * t.height);
        parallel_for(t.height, options_.threads, [&](std::size_t j) {
            place_row(rows[j], base[j], t.texels.begin() + static_cast<std::ptrdiff_t>(j * t.width), t);
        });
        if (t.traits.corners) place_corners(t);
        for (std::uint32_t j = 0; regions != nullptr && j < t.height; ++j) {
            for (const RegionEntry& e : rows[j].entries)
                regions->entries.push_back(
                    {e.record + static_cast<std::uint32_t>(base[j]), e.rest, e.result, e.vertex + graph.row_start(j)});
        }
        build.report.fbt.gpu_bytes = fetex::fbt_gpu_bytes(t);
        report_lost(collapsed, graph, build.report);
        if (regions != nullptr) {
            for (std::uint32_t j = 0; j <= t.height; ++j) {
                for (std::uint32_t i = 0; i <= t.width; ++i)
                    regions->corners.push_back(corners_.at(i, j));
            }
        }
        return build;
    }

    /// Parts of the picture of which no texel has anything left. (A collapsed piece of a larger part loses nothing that
    /// could be seen.)
    void report_lost(const std::vector<std::uint32_t>& collapsed, const ReachabilityGraph& graph,
                     CompileReport& report) const {
        if (collapsed.empty()) return;
        const std::vector<std::uint32_t>& part = graph.components();
        std::vector<bool> is_collapsed(part.size(), false), seen(part.size(), false);
        for (std::uint32_t v : collapsed)
            is_collapsed[v] = true;
        for (std::uint32_t v = 0; v < part.size(); ++v) {
            if (!is_collapsed[v]) seen[part[v]] = true;
        }
        std::uint64_t lost = 0;
        std::string first;
        for (std::uint32_t v : collapsed) {
            if (seen[part[v]]) continue;
            seen[part[v]] = true;
            if (lost++ == 0) first = place_of(graph.column(v), graph.row(v));
        }
        if (lost == 0) return;
        report.fbt.parts_lost = lost;
        report.diagnostics.push_back({Severity::Warning, diag::kSliversCollapsed,
                                      std::to_string(lost) + (lost == 1 ? " part" : " parts") +
                                          " of the picture, everywhere thinner than the output grid, left out",
                                      first});
    }

    static void place_row(RowOutput& row, std::size_t base, std::vector<std::uint32_t>::iterator texels,
                          fetex::FbtTexture& t) {
        const auto first = static_cast<std::uint32_t>(base);
        for (std::uint32_t w : row.record_indices)
            row.records[w] += first;
        for (std::uint32_t w : row.word_indices)
            row.records[w] += 4 * first;
        for (std::uint32_t& texel : row.texels) {
            const std::uint32_t kind = texel >> 30;
            const bool corners = (texel >> 28 & 3u) == fetex::kFbtModelCorners;
            if (kind != fetex::kFbtKindSolid && !(kind == fetex::kFbtKindShaded && corners)) texel += first;
        }
        std::copy(row.texels.begin(), row.texels.end(), texels);
        std::copy(row.records.begin(), row.records.end(), t.records.begin() + static_cast<std::ptrdiff_t>(4 * base));
        release(row.texels), release(row.records), release(row.record_indices), release(row.word_indices);
    }

    void place_corners(fetex::FbtTexture& t) const {
        const std::size_t words = fetex::fbt_sample_words(t.sample_format), columns = std::size_t{t.width} + 1;
        t.corners.resize(words * columns * (std::size_t{t.height} + 1));
        parallel_for(std::size_t{t.height} + 1, options_.threads, [&](std::size_t j) {
            for (std::uint32_t i = 0; i <= t.width; ++i) {
                const Rgba c = samples_.corner(i, static_cast<std::uint32_t>(j));
                const auto packed = fetex::fbt_pack_sample({c.r, c.g, c.b, c.a}, t.sample_format);
                std::copy_n(packed.begin(), words, t.corners.data() + words * (j * columns + i));
            }
        });
        for (std::size_t k = 0; k < t.corners.size(); k += words)
            t.traits.translucent |= !fetex::fbt_sample_opaque(t.corners.data() + k, t.sample_format);
    }

    const Scene& scene_;
    const CompileOptions& options_;
    const PlanarMap& map_;
    Compositor& compositor_;
    CornerResults corners_;
    RegionSampler sampler_;
    const SampleSource& samples_;
    const ReachabilityGraph* given_graph_; ///< none: built here
    Separation separation_;
    RowProgress progress_;
};

std::uint32_t other_side(double by, double along, std::uint32_t texels) {
    return static_cast<std::uint32_t>(std::clamp(std::round(by * texels / along), 1.0, static_cast<double>(kMaxSize)));
}

GridSize complete(const Extent& e, GridSize s) {
    if (s.width == 0 && s.height != 0) s.width = other_side(e.width, e.height, s.height);
    if (s.height == 0 && s.width != 0) s.height = other_side(e.height, e.width, s.width);
    return s;
}

const RegionEntry& entry_of(const std::vector<RegionEntry>& entries, const fetex::FbtRegion& region) {
    return *std::lower_bound(entries.begin(), entries.end(), region,
                             [](const RegionEntry& e, const fetex::FbtRegion& r) {
                                 return std::pair(e.record, e.rest) < std::pair(r.record, r.rest);
                             });
}

void add_mips(FbtBuild& build, std::vector<std::uint32_t> mips) {
    fetex::FbtTexture& t = build.texture;
    t.mips = std::move(mips);
    t.traits.translucent |= std::ranges::any_of(t.mips, [](std::uint32_t c) { return c < 0xff000000u; });
    build.report.mips.gpu_bytes = 4 * t.mips.size();
    build.report.fbt.gpu_bytes = fetex::fbt_gpu_bytes(t);
}

} // namespace

ResultId FbtRegions::result_of(const fetex::FbtRegion& region, std::uint32_t width) const {
    if (region.record == 0xffffffffu) return corners[static_cast<std::size_t>(region.j) * (width + 1) + region.i];
    return entry_of(entries, region).result;
}

std::uint32_t FbtRegions::vertex_of(const fetex::FbtRegion& region) const {
    if (region.record == 0xffffffffu) return reachability->first_vertex(region.i, region.j);
    return entry_of(entries, region).vertex;
}

GridSize grid_for(const Extent& extent, std::uint32_t longer_side) {
    return complete(extent, extent.width >= extent.height ? GridSize{longer_side, 0} : GridSize{0, longer_side});
}

Result<GridSize> texels_for(const Extent& extent, GridSize wanted) {
    const GridSize size = complete(extent, wanted);
    if (size.width < 1 || size.height < 1 || size.width > kMaxSize || size.height > kMaxSize) {
        return Error{ErrorClass::Usage, diag::kSizeOutOfRange, "the size must be 1 to 16384 texels on each side", ""};
    }
    return size;
}

Result<FbtBuild> build_fbt_of_features(const Scene& features, const PlanarMap& map, const ReachabilityGraph& graph,
                                       const SampleSource& samples, CompileReport report, const CompileOptions& options,
                                       const ProgressSink& progress) {
    Compositor compositor(features, options.skip);
    Result<FbtBuild> build =
        Builder(features, options, progress, map, compositor, &samples, &graph).run(std::move(report), nullptr);
    if (build && options.mips) {
        if (progress) progress("mip chain", 0);
        FbtBuild& made = build.value();
        add_mips(made, mips_of_texture(made.texture, options.threads, made.report.mips));
    }
    return build;
}

Result<FbtBuild> build_fbt(const Scene& scene, const CompileOptions& options, const ProgressSink& progress,
                           FbtRegions* regions) {
    const Result<GridSize> size = texels_for(scene.extent, options.size);
    if (!size) return size.error();
    CompileReport report;
    report.scene = scene.stats;
    if (progress) progress("planar map", 0);
    const Grid grid = make_grid(scene.extent, size.value().width, size.value().height);
    Result<PlanarMap> map = PlanarMap::build(scene, grid, options.threads, report.planar, options.skip);
    if (!map) return map.error();
    const ColorSteps steps =
        options.sample_format == fetex::FbtSampleFormat::Rgba8 ? ColorSteps::Rgba8 : ColorSteps::Rgba16;
    auto compositor = std::make_unique<Compositor>(scene, options.skip, steps);
    Result<FbtBuild> build = Builder(scene, options, progress, map.value(), *compositor).run(report, regions);
    if (build && options.mips) {
        if (progress) progress("mip chain", 0);
        auto mips = build_mips(map.value(), scene, *compositor, options, build.value().report.mips);
        if (!mips) return mips.error();
        add_mips(build.value(), std::move(mips).value());
    }
    if (regions != nullptr) regions->compositor = std::move(compositor);
    return build;
}

Result<FbtBuild> compile_fbt(const Scene& scene, const CompileOptions& options, const ProgressSink& progress) {
    return build_fbt(scene, options, progress, nullptr);
}

} // namespace fetexc
