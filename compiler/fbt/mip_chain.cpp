// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/mip_chain.h"

#include <algorithm>
#include <utility>

#include "compiler/diagnostics.h"
#include "compiler/fbt/area_means.h"
#include "compiler/fbt/samples.h"
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

Result<std::vector<std::uint32_t>> build_mips(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                              const CompileOptions& options, MipStats& stats) {
    return ChainBuilder(map, scene, compositor, options, stats).run();
}

} // namespace fetexc
