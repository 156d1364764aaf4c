// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report_planar.h"

#include <fmt/format.h>

namespace fetexc::cli {

double share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string planar_text(const PlanarStats& p) {
    std::string text = fmt::format("  texels     {:.1f}% empty, {:.1f}% simple, {:.1f}% arranged (of {})\n",
                                   share(p.texels_empty, p.texels), share(p.texels_simple, p.texels),
                                   share(p.texels_arranged, p.texels), p.texels);
    text += fmt::format("  pieces     {} of {} segments; {} null, {} reduced in degree, {} on a shared support\n",
                        p.pieces, p.segments, p.segments_null, p.degree_reduced, p.pieces_shared);
    text += fmt::format("  pairs      {} near each other: {} settled by the filter, {} by exact arithmetic; {} "
                        "overlaps; {} exact comparisons\n",
                        p.box_pairs, p.pairs_certified, p.pairs_exact, p.overlaps, p.exact_comparisons);
    text +=
        fmt::format("  planar map {} crossings, {} grid crossings, {} vertices, {} edges, {} trapezoids, {} regions\n",
                    p.crossings, p.grid_crossings, p.vertices, p.edges, p.trapezoids, p.regions);
    if (p.regions_connected == 0) return text; // nobody asked
    text += fmt::format("  reachable  {} parts of the picture separated by visible edges ({} vertices, {} links)\n",
                        p.regions_connected, p.reach_vertices, p.reach_links);
    text += fmt::format("  edges      {} visible, {} invisible ones dropped\n", p.edges_visible, p.edges_invisible);
    return text;
}

nlohmann::ordered_json planar_json(const PlanarStats& p) {
    return {
        {"segments", p.segments},
        {"segmentsNull", p.segments_null},
        {"degreeReduced", p.degree_reduced},
        {"pieces", p.pieces},
        {"piecesShared", p.pieces_shared},
        {"nearCusps", p.near_cusps},
        {"pairs",
         {{"near", p.box_pairs}, {"certified", p.pairs_certified}, {"exact", p.pairs_exact}, {"overlaps", p.overlaps}}},
        {"exactComparisons", p.exact_comparisons},
        {"vertices", p.vertices},
        {"edges", p.edges},
        {"crossings", p.crossings},
        {"gridCrossings", p.grid_crossings},
        {"texels",
         {{"total", p.texels},
          {"empty", p.texels_empty},
          {"simple", p.texels_simple},
          {"arranged", p.texels_arranged}}},
        {"trapezoids", p.trapezoids},
        {"regions", p.regions},
        {"edgesVisible", p.edges_visible},
        {"edgesInvisible", p.edges_invisible},
        {"reachability",
         {{"vertices", p.reach_vertices}, {"links", p.reach_links}, {"components", p.regions_connected}}}};
}

} // namespace fetexc::cli
