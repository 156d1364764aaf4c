// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/bench_csv.h"

#include <functional>

#include <fmt/format.h>

#include "compiler/error_budget.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

using measure::Distances;
using measure::SizeErrors;

/// errors is null where there are no figures.
struct Row {
    const BenchPoint& point;
    const SizeErrors* errors;
    bool last_output; ///< the one that the bitmap of equal error was looked for at
};
struct Column {
    const char* name; ///< with the unit
    std::function<std::string(const Row&)> cell;
};

/// Enough to see any change that matters, few enough to be the same from every compiler.
std::string figure(double v) { return fmt::format("{:.5g}", v); }

/// In 1/255.
std::string color(double v) { return v < budget::kColorNoise ? std::string("0") : figure(v * 255); }

using DistanceFigure = double Distances::*;
Column distance(const char* name, Distances SizeErrors::*way, DistanceFigure which, bool texels) {
    return {name, [=](const Row& r) {
                if (r.errors == nullptr) return std::string();
                const double width_units = r.errors->*way.*which;
                return figure(texels ? width_units / r.point.texel_side : width_units * 1000);
            }};
}

template <class Of> Column of_errors(const char* name, const Of& of) {
    return {name, [of](const Row& r) { return r.errors == nullptr ? std::string() : of(*r.errors); }};
}

template <class Of> Column of_equal(const char* name, const Of& of) {
    return {name, [of](const Row& r) {
                return r.point.equal_bitmap && r.last_output ? of(*r.point.equal_bitmap) : std::string();
            }};
}

template <class Of> Column of_times(const char* name, const Of& of) {
    return {name, [of](const Row& r) { return r.point.times ? of(*r.point.times) : std::string(); }};
}

template <class Of> Column of_sampler(const char* name, const Of& of) {
    return of_times(name, [of](const BenchTimes& t) { return t.sampler ? of(*t.sampler) : std::string(); });
}

std::vector<Column> texture_columns() {
    return {{"file", [](const Row& r) { return csv_field(fetex::to_valid_utf8(r.point.file)); }},
            {"method", [](const Row& r) { return csv_field(r.point.method); }},
            {"options", [](const Row& r) { return csv_field(r.point.options); }},
            {"size (texels)", [](const Row& r) { return std::to_string(r.point.size); }},
            {"width (texels)", [](const Row& r) { return std::to_string(r.point.texels.width); }},
            {"height (texels)", [](const Row& r) { return std::to_string(r.point.texels.height); }},
            {"size (bytes)",
             [](const Row& r) { return r.errors == nullptr ? std::string() : std::to_string(r.point.bytes); }},
            {"note", [](const Row& r) { return csv_field(r.point.note); }}};
}

std::vector<Column> error_columns() {
    using E = SizeErrors;
    using D = Distances;
    return {
        of_errors("output width (px)", [](const E& e) { return std::to_string(e.pixels.width); }),
        of_errors("output height (px)", [](const E& e) { return std::to_string(e.pixels.height); }),
        of_errors("misclassified area (ppm)", [](const E& e) { return figure(e.misclassified_ppm); }),
        of_errors("standard deviation of sampling (ppm)", [](const E& e) { return figure(e.misclassified_error_ppm); }),
        distance("truth's edges to picture's: mean (texels)", &E::to_picture, &D::mean, true),
        distance("truth's edges to picture's: p95 (texels)", &E::to_picture, &D::p95, true),
        distance("truth's edges to picture's: Hausdorff (texels)", &E::to_picture, &D::hausdorff, true),
        distance("truth's edges to picture's: mean (1/1000 width)", &E::to_picture, &D::mean, false),
        distance("truth's edges to picture's: p95 (1/1000 width)", &E::to_picture, &D::p95, false),
        distance("truth's edges to picture's: Hausdorff (1/1000 width)", &E::to_picture, &D::hausdorff, false),
        of_errors("truth's edges to picture's: points beyond reach",
                  [](const E& e) { return std::to_string(e.to_picture.beyond_reach); }),
        distance("picture's edges to truth's: mean (texels)", &E::to_truth, &D::mean, true),
        distance("picture's edges to truth's: p95 (texels)", &E::to_truth, &D::p95, true),
        distance("picture's edges to truth's: Hausdorff (texels)", &E::to_truth, &D::hausdorff, true),
        distance("picture's edges to truth's: mean (1/1000 width)", &E::to_truth, &D::mean, false),
        distance("picture's edges to truth's: p95 (1/1000 width)", &E::to_truth, &D::p95, false),
        distance("picture's edges to truth's: Hausdorff (1/1000 width)", &E::to_truth, &D::hausdorff, false),
        of_errors("picture's edges to truth's: points beyond reach",
                  [](const E& e) { return std::to_string(e.to_truth.beyond_reach); }),
        of_errors("PSNR (dB)", [](const E& e) { return fmt::format("{:.2f}", e.psnr); }),
        of_errors("largest colour error away from edges (1/255)", [](const E& e) { return color(e.away.max); }),
        of_errors("mean colour error away from edges (1/255)", [](const E& e) { return color(e.away.mean); }),
        of_errors("islands lost", [](const E& e) { return std::to_string(e.islands.lost); }),
        of_errors("islands false", [](const E& e) { return std::to_string(e.islands.invented); }),
    };
}

std::vector<Column> equal_columns() {
    using B = measure::EqualErrorBitmap;
    return {
        of_equal("bitmap of equal area: more than", [](const B& b) { return std::string(b.found ? "no" : "yes"); }),
        of_equal("bitmap of equal area: width (texels)", [](const B& b) { return std::to_string(b.size.width); }),
        of_equal("bitmap of equal area: height (texels)", [](const B& b) { return std::to_string(b.size.height); }),
        of_equal("bitmap of equal area: size (bytes)", [](const B& b) { return std::to_string(b.bytes); }),
    };
}

std::vector<Column> timed_columns() {
    using T = BenchTimes;
    using S = fetex::SamplerCost;
    return {
        of_times("timed: compile (CPU s)", [](const T& t) { return fmt::format("{:.4g}", t.compile_seconds); }),
        of_times("timed: compile (sorts of a million numbers)",
                 [](const T& t) { return fmt::format("{:.4g}", t.compile_ratio); }),
        of_sampler("timed: sampler (plain bilinear lookups)",
                   [](const S& s) { return fmt::format("{:.4g}", s.median); }),
        of_sampler("timed: sampler, lower quartile",
                   [](const S& s) { return fmt::format("{:.4g}", s.lower_quartile); }),
        of_sampler("timed: sampler, upper quartile",
                   [](const S& s) { return fmt::format("{:.4g}", s.upper_quartile); }),
        of_times(
            "timed: area sampler (plain bilinear lookups)",
            [](const T& t) { return t.area_sampler ? fmt::format("{:.4g}", t.area_sampler->median) : std::string(); }),
        of_times("timed: note", [](const T& t) { return csv_field(fetex::to_valid_utf8(t.why_no_sampler)); }),
    };
}

void add_line(std::string& out, const std::vector<Column>& columns, const Row& row) {
    for (std::size_t k = 0; k < columns.size(); ++k)
        out += (k == 0 ? "" : ",") + columns[k].cell(row);
    out += "\n";
}

} // namespace

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string bench_csv(const std::vector<BenchFile>& files, bool timed) {
    std::vector<Column> columns;
    for (const auto& part :
         {texture_columns(), error_columns(), equal_columns(), timed ? timed_columns() : std::vector<Column>()})
        columns.insert(columns.end(), part.begin(), part.end());
    std::string out;
    for (const Column& c : columns)
        out += (out.empty() ? "" : ",") + csv_field(c.name);
    out += "\n";
    for (const BenchFile& file : files) {
        for (const BenchPoint& point : file.points) {
            if (point.errors.empty()) add_line(out, columns, {point, nullptr, true});
            for (const SizeErrors& e : point.errors)
                add_line(out, columns, {point, &e, &e == &point.errors.back()});
        }
    }
    return out;
}

} // namespace fetexc::cli
