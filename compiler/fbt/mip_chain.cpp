// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/mip_chain.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "compiler/diagnostics.h"
#include "compiler/fbt/area_means.h"
#include "compiler/fbt/samples.h"
#include "compiler/parallel.h"
#include "formats/fbt_mip.h"

namespace fetexc {
namespace {

bool divides(const fetex::FbtMipLevel& level, std::uint32_t width, std::uint32_t height) {
    return width % level.width == 0 && height % level.height == 0;
}

/// The means that levels are summed from: of levels, and of the texels as level 0. None is kept longer than it is
/// needed.
class KeptMeans {
  public:
    KeptMeans(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

    /// The last level before `level`, from `first` on, whose samples it is whole blocks of.
    [[nodiscard]] std::optional<std::uint32_t> source_of(std::uint32_t level, std::uint32_t first) const {
        const fetex::FbtMipLevel coarse = fetex::fbt_mip_level(width_, height_, level);
        for (std::uint32_t k = level; k-- > first;) {
            const auto [w, h] = size(k);
            if (divides(coarse, w, h)) return k;
        }
        return {};
    }
    [[nodiscard]] const MeanPicture& of(std::uint32_t level) const { return kept_.at(level); }
    /// Forgets what no level after this one is summed from. Sources: levels from `first` on.
    void keep(std::uint32_t level, std::uint32_t first, MeanPicture means) {
        kept_.insert_or_assign(level, std::move(means));
        std::set<std::uint32_t> wanted;
        for (std::uint32_t k = level + 1; k <= fetex::fbt_mip_levels(width_, height_); ++k)
            wanted.insert(source_of(k, first).value_or(0));
        std::erase_if(kept_, [&](const auto& entry) { return !wanted.contains(entry.first); });
    }

  private:
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> size(std::uint32_t k) const {
        if (k == 0) return {width_, height_};
        const fetex::FbtMipLevel level = fetex::fbt_mip_level(width_, height_, k);
        return {level.width, level.height};
    }
    std::uint32_t width_, height_;
    std::map<std::uint32_t, MeanPicture> kept_;
};

/// Appends a level.
void pack(const MeanPicture& means, std::vector<std::uint32_t>& samples) {
    for (const Rgba& c : means.colors)
        samples.push_back(pack_rgba8(c));
}

MeanPicture blocks(const MeanPicture& fine, const fetex::FbtMipLevel& level, unsigned threads) {
    return block_means(fine, fine.width / level.width, fine.height / level.height, threads);
}

class ChainBuilder {
  public:
    ChainBuilder(const PlanarMap& map, const Scene& scene, Compositor& compositor, const CompileOptions& options,
                 MipStats& stats)
        : map_(map), scene_(scene), compositor_(compositor), options_(options), stats_(stats) {}

    Result<std::vector<std::uint32_t>> run() {
        const std::uint32_t width = map_.grid().width, height = map_.grid().height;
        KeptMeans kept(width, height);
        std::vector<std::uint32_t> samples;
        samples.reserve(fetex::fbt_mip_samples(width, height));
        for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(width, height); ++k) {
            const fetex::FbtMipLevel level = fetex::fbt_mip_level(width, height, k);
            const std::optional<std::uint32_t> source = kept.source_of(k, 1);
            MeanPicture means;
            if (source) {
                means = blocks(kept.of(*source), level, options_.threads);
            } else if (Status good = integrate(level, means); !good) {
                return good.error();
            }
            pack(means, samples);
            kept.keep(k, 1, std::move(means));
            ++stats_.levels;
        }
        return samples;
    }

  private:
    Status integrate(const fetex::FbtMipLevel& level, MeanPicture& means) {
        const Grid& g = map_.grid();
        return divides(level, g.width, g.height) ? sum(map_, level, means) : with_own_map(level, means);
    }

    Status sum(const PlanarMap& map, const fetex::FbtMipLevel& level, MeanPicture& means) {
        const Grid& g = map.grid();
        if (block_means(map, scene_, compositor_, g.width / level.width, g.height / level.height, options_.threads,
                        means, stats_))
            return {};
        return Error{ErrorClass::Runtime, diag::kPlanarInconsistent,
                     "the planar map of a mip level contradicts itself; please report this file", ""};
    }

    /// As fine as the texture, as nearly as blocks allow: large cells of many edges take longer than small ones of few.
    Status with_own_map(const fetex::FbtMipLevel& level, MeanPicture& means) {
        const Grid& g = map_.grid();
        PlanarStats unused;
        const Grid grid =
            make_grid(scene_.extent, g.width / level.width * level.width, g.height / level.height * level.height);
        Result<PlanarMap> map = PlanarMap::build(scene_, grid, options_.threads, unused, options_.skip);
        if (!map) return map.error();
        ++stats_.own_maps;
        return sum(map.value(), level, means);
    }

    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    const CompileOptions& options_;
    MipStats& stats_;
};

/// What sample k of `samples` along a side has of each of `texels` texels: first texel, and weights from there on.
struct Overlaps {
    std::uint32_t first = 0;
    std::vector<double> weights; ///< they add up to 1
    Overlaps(std::uint32_t k, std::uint32_t samples, std::uint32_t texels) {
        const double side = static_cast<double>(texels) / samples, low = k * side, high = low + side;
        first = static_cast<std::uint32_t>(std::uint64_t{k} * texels / samples);
        for (std::uint32_t n = first; n < texels && n < high; ++n)
            weights.push_back(std::max(std::min(high, n + 1.0) - std::max(low, static_cast<double>(n)), 0.0) / side);
    }
};

void add(Rgba& sum, const Rgba& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

Rgba mean_over(const MeanPicture& fine, const Overlaps& columns, const Overlaps& rows) {
    Rgba sum{0, 0, 0, 0};
    for (std::size_t b = 0; b < rows.weights.size(); ++b) {
        for (std::size_t a = 0; a < columns.weights.size(); ++a)
            add(sum, fine.colors[(rows.first + b) * fine.width + columns.first + a],
                rows.weights[b] * columns.weights[a]);
    }
    return sum;
}

/// A level whose samples end inside texels.
MeanPicture weighted_means(const MeanPicture& texels, const fetex::FbtMipLevel& level, unsigned threads) {
    MeanPicture out{level.width, level.height, std::vector<Rgba>(level.samples())};
    std::vector<Overlaps> columns;
    for (std::uint32_t i = 0; i < level.width; ++i)
        columns.emplace_back(i, level.width, texels.width);
    parallel_for(level.height, threads, [&](std::size_t j) {
        const Overlaps rows(static_cast<std::uint32_t>(j), level.height, texels.height);
        for (std::uint32_t i = 0; i < level.width; ++i)
            out.colors[j * level.width + i] = mean_over(texels, columns[i], rows);
    });
    return out;
}

MeanPicture texel_means(const fetex::FbtTexture& t, unsigned threads) {
    MeanPicture out{t.width, t.height, std::vector<Rgba>(std::size_t{t.width} * t.height)};
    parallel_for(t.height, threads, [&](std::size_t j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            const fetex::FbtColor c =
                fetex::fbt_sample_area_local(t, i, static_cast<std::uint32_t>(j), 0.5, 0.5, {0.5, 0.5, true});
            out.colors[j * t.width + i] = {c.r, c.g, c.b, c.a};
        }
    });
    return out;
}

} // namespace

std::vector<std::uint32_t> mips_of_texture(const fetex::FbtTexture& t, unsigned threads, MipStats& stats) {
    stats.texels = stats.areas_sampled = std::uint64_t{t.width} * t.height;
    stats.levels = fetex::fbt_mip_levels(t.width, t.height);
    std::vector<std::uint32_t> samples;
    samples.reserve(fetex::fbt_mip_samples(t.width, t.height));
    KeptMeans kept(t.width, t.height);
    kept.keep(0, 0, texel_means(t, threads));
    for (std::uint32_t k = 1; k <= stats.levels; ++k) {
        const fetex::FbtMipLevel level = fetex::fbt_mip_level(t.width, t.height, k);
        const std::optional<std::uint32_t> source = kept.source_of(k, 0);
        MeanPicture means =
            source ? blocks(kept.of(*source), level, threads) : weighted_means(kept.of(0), level, threads);
        pack(means, samples);
        kept.keep(k, 0, std::move(means));
    }
    return samples;
}

Result<std::vector<std::uint32_t>> build_mips(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                              const CompileOptions& options, MipStats& stats) {
    return ChainBuilder(map, scene, compositor, options, stats).run();
}

} // namespace fetexc
