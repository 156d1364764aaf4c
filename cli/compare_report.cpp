// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/compare_outcome.h"
#include "cli/messages.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::CurveErrors;
using measure::Distances;
using measure::PictureDifference;
using measure::SizeErrors;
using measure::Spread;
using measure::TexturePoint;

constexpr int kLabelWidth = 46, kColumnWidth = 16;

std::string psnr_text(double psnr) { return std::isinf(psnr) ? "equal" : fmt::format("{:.2f}", psnr); }
std::string steps_text(double color) { return fmt::format("{:.3f}", color * 255); }
std::string place_text(TexturePoint p) { return fmt::format("{:.4f},{:.4f}", p.u, p.v); }
/// Of a difference that shows in the figures.
std::string color_place(double color, TexturePoint p) { return color * 255 >= 0.0005 ? place_text(p) : "-"; }
std::string size_text(GridSize n) { return fmt::format("{} x {}", n.width, n.height); }

TexturePoint place_of(const Distances& d, double height) { return {d.farthest.x, d.farthest.y / height}; }

/// A table with a column for each entry.
template <class Entry> class Table {
  public:
    explicit Table(const std::vector<Entry>& entries) : entries_(entries) {}
    void heading(const std::string& label) { text_ += label + "\n"; }
    template <class Cell> void row(const std::string& label, const Cell& cell) {
        text_ += fmt::format("{:<{}}", label, kLabelWidth);
        for (const Entry& e : entries_)
            text_ += fmt::format("{:>{}}", cell(e), kColumnWidth);
        text_ += "\n";
    }
    [[nodiscard]] std::string text() const { return text_; }

  private:
    const std::vector<Entry>& entries_;
    std::string text_;
};

/// of: an entry's distances.
template <class Entry, class Of>
void add_distances(Table<Entry>& table, const CompareOutcome& o, const char* label, const Of& of) {
    table.heading(label);
    const auto rows = [&](const char* unit, double scale) {
        table.row(fmt::format("  mean, {}", unit),
                  [&](const Entry& e) { return fmt::format("{:.3g}", of(e).mean * scale); });
        table.row(fmt::format("  95% are nearer than, {}", unit),
                  [&](const Entry& e) { return fmt::format("{:.3g}", of(e).p95 * scale); });
        table.row(fmt::format("  largest, {}", unit), [&](const Entry& e) {
            return fmt::format("{}{:.3g}", of(e).beyond_reach > 0 ? "beyond " : "", of(e).hausdorff * scale);
        });
    };
    rows("texels", 1 / o.texel_side);
    rows("1/1000 of the width", 1000);
    table.row("  largest at u,v", [&](const Entry& e) {
        return of(e).hausdorff > 0 ? place_text(place_of(of(e), o.height)) : std::string("-");
    });
}

std::string errors_text(const CompareOutcome& o) {
    Table<SizeErrors> table(o.errors);
    table.row("output, pixels", [](const SizeErrors& e) { return size_text(e.pixels); });
    table.row("pixels a texel", [](const SizeErrors& e) { return fmt::format("{:.4g}", e.pixels_per_texel); });
    table.row("misclassified area, ppm",
              [](const SizeErrors& e) { return fmt::format("{:.2f}", e.misclassified_ppm); });
    table.row("  +- (one standard deviation of sampling)",
              [](const SizeErrors& e) { return fmt::format("{:.2f}", e.misclassified_error_ppm); });
    table.row("  first at u,v", [](const SizeErrors& e) {
        return e.misclassified_ppm > 0 ? place_text(e.misclassified_place) : std::string("-");
    });
    add_distances(table, o, "from the truth's edges to the picture's",
                  [](const SizeErrors& e) -> const Distances& { return e.to_picture; });
    add_distances(table, o, "from the picture's edges to the truth's",
                  [](const SizeErrors& e) -> const Distances& { return e.to_truth; });
    table.row("PSNR of the anti-aliased picture, dB", [](const SizeErrors& e) { return psnr_text(e.psnr); });
    table.row("largest colour error away from edges, 1/255",
              [](const SizeErrors& e) { return steps_text(e.away.max); });
    table.row("  mean, 1/255", [](const SizeErrors& e) { return steps_text(e.away.mean); });
    table.row("  largest at u,v", [](const SizeErrors& e) { return color_place(e.away.max, e.away.place); });
    table.row("islands lost", [](const SizeErrors& e) { return std::to_string(e.islands.lost); });
    table.row("islands that are false", [](const SizeErrors& e) { return std::to_string(e.islands.invented); });
    table.row("  largest of both, ppm",
              [](const SizeErrors& e) { return fmt::format("{:.2f}", e.islands.largest_ppm); });
    return table.text();
}

/// of: an entry's PictureDifference.
template <class Entry, class Of> void add_differences(Table<Entry>& table, const Of& of) {
    table.row("points that differ by more than 1/255, ppm",
              [&](const Entry& e) { return fmt::format("{:.2f}", of(e).different_ppm); });
    table.row("largest colour difference, 1/255", [&](const Entry& e) { return steps_text(of(e).max); });
    table.row("  at u,v", [&](const Entry& e) { return color_place(of(e).max, of(e).place); });
    table.row("mean colour difference, 1/255", [&](const Entry& e) { return steps_text(of(e).mean); });
    table.row("PSNR of the anti-aliased pictures, dB", [&](const Entry& e) { return psnr_text(of(e).psnr); });
}

std::string differences_text(const CompareOutcome& o) {
    Table<PictureDifference> table(o.differences);
    table.row("output, pixels", [](const PictureDifference& d) { return size_text(d.pixels); });
    add_differences(table, [](const PictureDifference& d) -> const PictureDifference& { return d; });
    return table.text();
}

template <class Of>
void add_spread(Table<CurveErrors>& table, const std::string& label, const char* unit, const Of& of) {
    table.row(fmt::format("{}, mean, {}", label, unit),
              [&](const CurveErrors& e) { return fmt::format("{:.3g}", of(e).mean); });
    table.row(fmt::format("  99% are less than, {}", unit),
              [&](const CurveErrors& e) { return fmt::format("{:.3g}", of(e).p99); });
    table.row(fmt::format("  largest, {}", unit),
              [&](const CurveErrors& e) { return fmt::format("{:.3g}", of(e).max); });
    table.row("  largest at u,v",
              [&](const CurveErrors& e) { return of(e).max > 0 ? place_text(of(e).place) : std::string("-"); });
}

std::string curve_errors_text(const CompareOutcome& o) {
    Table<CurveErrors> table(o.curve_errors);
    table.row("output, pixels", [](const CurveErrors& e) { return size_text(e.pixels); });
    table.row("pixels a texel", [](const CurveErrors& e) { return fmt::format("{:.4g}", e.pixels_per_texel); });
    add_differences(table, [](const CurveErrors& e) -> const PictureDifference& { return e.colors; });
    const CurveErrors& first = o.curve_errors.front();
    if (first.angle)
        add_spread(table, "angle of normals", "degrees",
                   [](const CurveErrors& e) -> const Spread& { return *e.angle; });
    if (!first.distance) return table.text();
    add_distances(table, o, "from the truth's curves to the texture's",
                  [](const CurveErrors& e) -> const Distances& { return *e.to_picture; });
    add_distances(table, o, "from the texture's curves to the truth's",
                  [](const CurveErrors& e) -> const Distances& { return *e.to_truth; });
    add_spread(table, "error of distances near curves", "texels",
               [](const CurveErrors& e) -> const Spread& { return *e.distance; });
    table.row("  points within a texel of curves, plain",
              [](const CurveErrors& e) { return std::to_string(e.distance->points); });
    return table.text();
}

/// What has no finite value is null.
Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
Json place_json(TexturePoint p) { return {{"u", p.u}, {"v", p.v}}; }
Json pixels_json(GridSize n) { return {{"width", n.width}, {"height", n.height}}; }

Json distances_json(const Distances& d, const CompareOutcome& o) {
    const auto in = [&](double scale) {
        return Json{{"mean", d.mean * scale}, {"p95", d.p95 * scale}, {"hausdorff", d.hausdorff * scale}};
    };
    return {{"texels", in(1 / o.texel_side)},
            {"thousandthsOfWidth", in(1000)},
            {"points", d.points},
            {"beyondReach", d.beyond_reach},
            {"place", d.hausdorff > 0 ? place_json(place_of(d, o.height)) : Json(nullptr)}};
}

Json errors_json(const SizeErrors& e, const CompareOutcome& o) {
    return {{"pixels", pixels_json(e.pixels)},
            {"pixelsPerTexel", e.pixels_per_texel},
            {"misclassified",
             {{"ppm", e.misclassified_ppm},
              {"errorPpm", e.misclassified_error_ppm},
              {"place", e.misclassified_ppm > 0 ? place_json(e.misclassified_place) : Json(nullptr)}}},
            {"edgesToPicture", distances_json(e.to_picture, o)},
            {"edgesToTruth", distances_json(e.to_truth, o)},
            {"psnrDb", number(e.psnr)},
            {"colorAwayFromEdges",
             {{"max", e.away.max},
              {"mean", e.away.mean},
              {"points", e.away.points},
              {"place", e.away.max > 0 ? place_json(e.away.place) : Json(nullptr)}}},
            {"islands",
             {{"lost", e.islands.lost},
              {"false", e.islands.invented},
              {"largestPpm", e.islands.largest_ppm},
              {"place", e.islands.largest_ppm > 0 ? place_json(e.islands.place) : Json(nullptr)}}},
            {"edgesWithoutContrast", e.edges_without_contrast}};
}

Json difference_json(const PictureDifference& d) {
    return {{"pixels", pixels_json(d.pixels)},
            {"differentPpm", d.different_ppm},
            {"colorDifference",
             {{"max", d.max}, {"mean", d.mean}, {"place", d.max > 0 ? place_json(d.place) : Json(nullptr)}}},
            {"psnrDb", number(d.psnr)}};
}

Json spread_json(const Spread& s) {
    return {{"mean", s.mean},
            {"p99", s.p99},
            {"max", s.max},
            {"points", s.points},
            {"place", s.max > 0 ? place_json(s.place) : Json(nullptr)}};
}

Json curve_errors_json(const CurveErrors& e, const CompareOutcome& o) {
    Json out = difference_json(e.colors);
    out["pixelsPerTexel"] = e.pixels_per_texel;
    if (e.angle) out["normalDegrees"] = spread_json(*e.angle);
    if (!e.distance) return out;
    out["curvesToPicture"] = distances_json(*e.to_picture, o);
    out["curvesToTruth"] = distances_json(*e.to_truth, o);
    out["distanceTexels"] = spread_json(*e.distance);
    return out;
}

Json checks_json(const std::vector<ThresholdCheck>& checks) {
    Json list = Json::array();
    for (const ThresholdCheck& c : checks) {
        list.push_back({{"option", c.option},
                        {"limit", c.limit},
                        {"worst", number(c.worst)},
                        {"pixels", pixels_json(c.pixels)},
                        {"passed", c.passed}});
    }
    return list;
}

} // namespace

std::string compare_text(const CompareOutcome& o) {
    std::string text = fmt::format("truth  {}: {}\nother  {}: {}\n\n", printable(o.truth), o.truth_kind,
                                   printable(o.other), o.other_kind);
    if (!o.errors.empty()) return text + errors_text(o);
    return text + (o.curve_errors.empty() ? differences_text(o) : curve_errors_text(o));
}

std::string compare_json(const CompareOutcome& o) {
    Json sizes = Json::array();
    for (const SizeErrors& e : o.errors)
        sizes.push_back(errors_json(e, o));
    for (const CurveErrors& e : o.curve_errors)
        sizes.push_back(curve_errors_json(e, o));
    for (const PictureDifference& d : o.differences)
        sizes.push_back(difference_json(d));
    const char* against = !o.errors.empty() ? "scene" : !o.curve_errors.empty() ? "curves" : "picture";
    const Json document = {{"schema", "fetexc-compare/1"},
                           {"truth", fetex::to_valid_utf8(o.truth)},
                           {"other", fetex::to_valid_utf8(o.other)},
                           {"against", against},
                           {"texels", pixels_json(o.texels)},
                           {"gpuBytes", o.gpu_bytes},
                           {"sizes", sizes},
                           {"thresholds", checks_json(o.checks)},
                           {"passed", all_passed(o)}};
    return document.dump(2) + "\n";
}

} // namespace fetexc::cli
