// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/compare_outcome.h"
#include "cli/messages.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::Distances;
using measure::PictureDifference;
using measure::SizeErrors;
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

using DistancesOf = std::function<const Distances&(const SizeErrors&)>;

void add_distances(Table<SizeErrors>& table, const CompareOutcome& o, const char* label, const DistancesOf& of) {
    table.heading(label);
    const auto rows = [&](const char* unit, double scale) {
        table.row(fmt::format("  mean, {}", unit),
                  [&](const SizeErrors& e) { return fmt::format("{:.3g}", of(e).mean * scale); });
        table.row(fmt::format("  95% are nearer than, {}", unit),
                  [&](const SizeErrors& e) { return fmt::format("{:.3g}", of(e).p95 * scale); });
        table.row(fmt::format("  largest, {}", unit), [&](const SizeErrors& e) {
            return fmt::format("{}{:.3g}", of(e).beyond_reach > 0 ? "beyond " : "", of(e).hausdorff * scale);
        });
    };
    rows("texels", 1 / o.texel_side);
    rows("1/1000 of the width", 1000);
    table.row("  largest at u,v", [&](const SizeErrors& e) {
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

std::string differences_text(const CompareOutcome& o) {
    Table<PictureDifference> table(o.differences);
    table.row("output, pixels", [](const PictureDifference& d) { return size_text(d.pixels); });
    table.row("points that differ by more than 1/255, ppm",
              [](const PictureDifference& d) { return fmt::format("{:.2f}", d.different_ppm); });
    table.row("largest colour difference, 1/255", [](const PictureDifference& d) { return steps_text(d.max); });
    table.row("  at u,v", [](const PictureDifference& d) { return color_place(d.max, d.place); });
    table.row("mean colour difference, 1/255", [](const PictureDifference& d) { return steps_text(d.mean); });
    table.row("PSNR of the anti-aliased pictures, dB", [](const PictureDifference& d) { return psnr_text(d.psnr); });
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
    return text + (o.errors.empty() ? differences_text(o) : errors_text(o));
}

std::string compare_json(const CompareOutcome& o) {
    Json sizes = Json::array();
    for (const SizeErrors& e : o.errors)
        sizes.push_back(errors_json(e, o));
    for (const PictureDifference& d : o.differences)
        sizes.push_back(difference_json(d));
    const Json document = {{"schema", "fetexc-compare/1"},
                           {"truth", fetex::to_valid_utf8(o.truth)},
                           {"other", fetex::to_valid_utf8(o.other)},
                           {"against", o.errors.empty() ? "picture" : "scene"},
                           {"texels", pixels_json(o.texels)},
                           {"gpuBytes", o.gpu_bytes},
                           {"sizes", sizes},
                           {"thresholds", checks_json(o.checks)},
                           {"passed", all_passed(o)}};
    return document.dump(2) + "\n";
}

} // namespace fetexc::cli
