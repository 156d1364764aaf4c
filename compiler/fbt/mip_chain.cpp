// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/mip_chain.h"

#include <algorithm>
#include <utility>

#include "compiler/diagnostics.h"
#include "compiler/fbt/area_means.h"
#include "compiler/fbt/samples.h"
#include "compiler/parallel.h"
#include "formats/fbt_mip.h"

namespace fetexc {
namespace {

class ChainBuilder {
  public:
    ChainBuilder(const PlanarMap& map, const Scene& scene, Compositor& compositor, const CompileOptions& options,
                 MipStats& stats)
        : map_(map), scene_(scene), compositor_(compositor), options_(options), stats_(stats) {}

    Result<std::vector<std::uint32_t>> run() {
        const std::uint32_t width = map_.grid().width, height = map_.grid().height;
        std::vector<std::uint32_t> samples;
        samples.reserve(fetex::fbt_mip_samples(width, height));
        for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(width, height); ++k) {
            if (Status good = integrate(fetex::fbt_mip_level(width, height, k)); !good) return good.error();
            for (const Rgba& c : means_.back().colors)
                samples.push_back(pack_rgba8(c));
            ++stats_.levels;
        }
        return samples;
    }

  private:
    static bool divides(const fetex::FbtMipLevel& level, std::uint32_t width, std::uint32_t height) {
        return width % level.width == 0 && height % level.height == 0;
    }

    /// Appends the level's means.
    Status integrate(const fetex::FbtMipLevel& level) {
        const auto fine = std::find_if(means_.rbegin(), means_.rend(),
                                       [&](const MeanPicture& m) { return divides(level, m.width, m.height); });
        if (fine != means_.rend()) {
            means_.push_back(
                block_means(*fine, fine->width / level.width, fine->height / level.height, options_.threads));
            return {};
        }
        const Grid& g = map_.grid();
        return divides(level, g.width, g.height) ? sum(map_, level) : with_own_map(level);
    }

    Status sum(const PlanarMap& map, const fetex::FbtMipLevel& level) {
        const Grid& g = map.grid();
        MeanPicture means;
        if (!block_means(map, scene_, compositor_, g.width / level.width, g.height / level.height, options_.threads,
                         means, stats_))
            return Error{ErrorClass::Runtime, diag::kPlanarInconsistent,
                         "the planar map of a mip level contradicts itself; please report this file", ""};
        means_.push_back(std::move(means));
        return {};
    }

    /// As fine as the texture, as nearly as blocks allow: large cells of many edges take longer than small ones of few.
    Status with_own_map(const fetex::FbtMipLevel& level) {
        const Grid& g = map_.grid();
        PlanarStats unused;
        const Grid grid =
            make_grid(scene_.extent, g.width / level.width * level.width, g.height / level.height * level.height);
        Result<PlanarMap> map = PlanarMap::build(scene_, grid, options_.threads, unused, options_.skip);
        if (!map) return map.error();
        ++stats_.own_maps;
        return sum(map.value(), level);
    }

    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    const CompileOptions& options_;
    MipStats& stats_;
    std::vector<MeanPicture> means_; ///< of the levels so far
};

} // namespace

namespace {

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

Rgba mean_over(const std::vector<Rgba>& means, std::uint32_t width, const Overlaps& columns, const Overlaps& rows) {
    Rgba sum{0, 0, 0, 0};
    for (std::size_t b = 0; b < rows.weights.size(); ++b) {
        for (std::size_t a = 0; a < columns.weights.size(); ++a)
            add(sum, means[(rows.first + b) * width + columns.first + a], rows.weights[b] * columns.weights[a]);
    }
    return sum;
}

} // namespace

std::vector<std::uint32_t> mips_of_texture(const fetex::FbtTexture& t, unsigned threads, MipStats& stats) {
    std::vector<Rgba> means(std::size_t{t.width} * t.height);
    parallel_for(t.height, threads, [&](std::size_t j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            const fetex::FbtColor c =
                fetex::fbt_sample_area_local(t, i, static_cast<std::uint32_t>(j), 0.5, 0.5, {0.5, 0.5, true});
            means[j * t.width + i] = {c.r, c.g, c.b, c.a};
        }
    });
    stats.texels = stats.areas_sampled = means.size();
    stats.levels = fetex::fbt_mip_levels(t.width, t.height);
    std::vector<std::uint32_t> samples;
    for (std::uint32_t k = 1; k <= stats.levels; ++k) {
        const fetex::FbtMipLevel level = fetex::fbt_mip_level(t.width, t.height, k);
        for (std::uint32_t j = 0; j < level.height; ++j) {
            const Overlaps rows(j, level.height, t.height);
            for (std::uint32_t i = 0; i < level.width; ++i)
                samples.push_back(pack_rgba8(mean_over(means, t.width, Overlaps(i, level.width, t.width), rows)));
        }
    }
    return samples;
}

Result<std::vector<std::uint32_t>> build_mips(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                              const CompileOptions& options, MipStats& stats) {
    return ChainBuilder(map, scene, compositor, options, stats).run();
}

} // namespace fetexc
