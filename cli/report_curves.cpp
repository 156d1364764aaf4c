// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report_curves.h"

#include <fmt/format.h>

#include "cli/compile_curves.h"
#include "cli/compile_silmap.h"
#include "formats/fbt_mip.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {

CurvesOutcome curves_outcome(const FeatureCurvesBuild& build) {
    const fetex::FeatureCurvesTexture& t = build.texture;
    return {t.width,
            t.height,
            t.kind,
            t.format,
            t.base_format,
            t.linear,
            t.base.size() > 2,
            t.mips.empty() ? 0 : fetex::fbt_mip_levels(t.width, t.height),
            static_cast<double>(t.distance_limit),
            build.profiles,
            build.stats,
            {}};
}

namespace {

std::string profiles_text(const std::vector<FeatureProfile>& profiles) {
    std::string text = profiles.size() > 1 ? "profiles " : "profile ";
    for (const FeatureProfile& p : profiles)
        text += fmt::format("{}{} of {:g} units", &p == profiles.data() ? "" : ", ",
                            p.name.empty() ? "of a file" : fetex::to_valid_utf8(p.name), p.width);
    return text;
}

nlohmann::ordered_json profiles_json(const std::vector<FeatureProfile>& profiles) {
    auto all = nlohmann::ordered_json::array();
    for (const FeatureProfile& p : profiles)
        all.push_back({{"name", fetex::to_valid_utf8(p.name)}, {"width", p.width}, {"inner", p.inner}});
    return all;
}

} // namespace

std::string curves_text(const CurvesOutcome& o) {
    const FeatureCurvesStats& s = o.stats;
    std::string text =
        fmt::format("  curves     {} x {} texels of {}s, {} segments, numbers {}, samples {}; {} bytes on "
                    "the GPU\n",
                    o.width, o.height, kind_name(o.kind), o.linear ? "straight" : "curved", numbers_name(o.numbers),
                    silmap_samples_name(o.samples), s.gpu_bytes);
    text += fmt::format("  network    {} curves of {} segments; {} texels with a segment, {} with two\n", s.curves,
                        s.segments, s.texels_one, s.texels_two);
    text += fmt::format("  snapping   {} texels changed, by up to {:.3f} texels; {} ends cut, {} folds, {} parts lost; "
                        "{} ways rerouted, {} junctions\n",
                        s.moved, s.farthest, s.snapping.ends_cut, s.snapping.folded, s.snapping.lost_inside,
                        s.snapping.rerouted, s.snapping.junctions);
    text += fmt::format("  fitting    {} curved segments, {} not valid: {} problems, {} solved, {} segments "
                        "straightened, {} by rounding, "
                        "{} flat\n",
                        s.snapping.curved, s.snapping.invalid, s.snapping.problems, s.snapping.fitted,
                        s.snapping.straightened, s.straightened_by_rounding, s.flat);
    text += fmt::format("  distances  up to {:.3f} texels: {} corners; {}{}\n", o.limit, s.corners_near,
                        profiles_text(o.profiles), o.base_map ? "; a base map" : "");
    return text;
}

nlohmann::ordered_json curves_json(const CurvesOutcome& o) {
    const FeatureCurvesStats& s = o.stats;
    return {{"width", o.width},
            {"height", o.height},
            {"kind", kind_name(o.kind)},
            {"numbers", numbers_name(o.numbers)},
            {"samples", silmap_samples_name(o.samples)},
            {"linear", o.linear},
            {"baseMap", o.base_map},
            {"mipLevels", o.mip_levels},
            {"limit", o.limit},
            {"gpuBytes", s.gpu_bytes},
            {"profiles", profiles_json(o.profiles)},
            {"network", {{"curves", s.curves}, {"segments", s.segments}, {"otherProfiles", s.curves_other_profile}}},
            {"texels", {{"oneSegment", s.texels_one}, {"twoSegments", s.texels_two}}},
            {"snapping",
             {{"crossings", s.snapping.crossings},
              {"segments", s.snapping.segments},
              {"rerouted", s.snapping.rerouted},
              {"junctions", s.snapping.junctions},
              {"endsCut", s.snapping.ends_cut},
              {"folded", s.snapping.folded},
              {"lostInside", s.snapping.lost_inside},
              {"profileEdges", s.snapping.edges_of_profiles},
              {"texelsMoved", s.moved},
              {"farthest", s.farthest}}},
            {"fitting",
             {{"curved", s.snapping.curved},
              {"invalid", s.snapping.invalid},
              {"problems", s.snapping.problems},
              {"fitted", s.snapping.fitted},
              {"straightened", s.snapping.straightened},
              {"straightenedByRounding", s.straightened_by_rounding},
              {"flat", s.flat}}},
            {"cornersNear", s.corners_near}};
}

} // namespace fetexc::cli
