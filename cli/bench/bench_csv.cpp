// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/bench_csv.h"

#include <functional>

#include <fmt/format.h>

#include "compiler/error_budget.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

using measure::CurveErrors;
using measure::Distances;
using measure::SizeErrors;
using measure::Spread;

/// errors and curves are both null where there are no figures.
struct Row {
    const BenchPoint& point;
    const SizeErrors* errors;
    const CurveErrors* curves;
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
/// Of edges, or of curves.
struct Way {
    Distances SizeErrors::*edges;
    std::optional<Distances> CurveErrors::*curves;

    [[nodiscard]] const Distances* of(const Row& r) const {
        if (r.errors != nullptr) return &(r.errors->*edges);
        return r.curves != nullptr && r.curves->*curves ? &*(r.curves->*curves) : nullptr;
    }
};
constexpr Way kToPicture{&SizeErrors::to_picture, &CurveErrors::to_picture},
    kToTruth{&SizeErrors::to_truth, &CurveErrors::to_truth};

Column distance(const char* name, Way way, DistanceFigure which, bool texels) {
    return {name, [=](const Row& r) {
                const Distances* d = way.of(r);
                if (d == nullptr) return std::string();
                return figure(texels ? d->*which / r.point.texel_side : d->*which * 1000);
            }};
}

Column beyond_reach(const char* name, Way way) {
    return {name, [=](const Row& r) {
                const Distances* d = way.of(r);
                return d == nullptr ? std::string() : std::to_string(d->beyond_reach);
            }};
}

/// What both kinds of figures have.
template <class Of> Column of_either(const char* name, const Of& of) {
    return {name, [of](const Row& r) {
                return r.errors != nullptr   ? of(r.errors->pixels, r.errors->psnr)
                       : r.curves != nullptr ? of(r.curves->pixels, r.curves->colors.psnr)
                                             : std::string();
            }};
}

Column spread(const char* name, std::optional<Spread> CurveErrors::*which, double Spread::*value) {
    return {name, [=](const Row& r) {
                return r.curves != nullptr && r.curves->*which ? figure((*(r.curves->*which)).*value) : std::string();
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
             [](const Row& r) {
                 return r.errors == nullptr && r.curves == nullptr ? std::string() : std::to_string(r.point.bytes);
             }},
            {"note", [](const Row& r) { return csv_field(r.point.note); }}};
}

std::vector<Column> error_columns() {
    using E = SizeErrors;
    using D = Distances;
    return {
        of_either("output width (px)", [](GridSize pixels, double) { return std::to_string(pixels.width); }),
        of_either("output height (px)", [](GridSize pixels, double) { return std::to_string(pixels.height); }),
        of_errors("misclassified area (ppm)", [](const E& e) { return figure(e.misclassified_ppm); }),
        of_errors("standard deviation of sampling (ppm)", [](const E& e) { return figure(e.misclassified_error_ppm); }),
        distance("truth's edges to picture's: mean (texels)", kToPicture, &D::mean, true),
        distance("truth's edges to picture's: p95 (texels)", kToPicture, &D::p95, true),
        distance("truth's edges to picture's: Hausdorff (texels)", kToPicture, &D::hausdorff, true),
        distance("truth's edges to picture's: mean (1/1000 width)", kToPicture, &D::mean, false),
        distance("truth's edges to picture's: p95 (1/1000 width)", kToPicture, &D::p95, false),
        distance("truth's edges to picture's: Hausdorff (1/1000 width)", kToPicture, &D::hausdorff, false),
        beyond_reach("truth's edges to picture's: points beyond reach", kToPicture),
        distance("picture's edges to truth's: mean (texels)", kToTruth, &D::mean, true),
        distance("picture's edges to truth's: p95 (texels)", kToTruth, &D::p95, true),
        distance("picture's edges to truth's: Hausdorff (texels)", kToTruth, &D::hausdorff, true),
        distance("picture's edges to truth's: mean (1/1000 width)", kToTruth, &D::mean, false),
        distance("picture's edges to truth's: p95 (1/1000 width)", kToTruth, &D::p95, false),
        distance("picture's edges to truth's: Hausdorff (1/1000 width)", kToTruth, &D::hausdorff, false),
        beyond_reach("picture's edges to truth's: points beyond reach", kToTruth),
        of_either("PSNR (dB)", [](GridSize, double psnr) { return fmt::format("{:.2f}", psnr); }),
        of_errors("largest colour error away from edges (1/255)", [](const E& e) { return color(e.away.max); }),
        of_errors("mean colour error away from edges (1/255)", [](const E& e) { return color(e.away.mean); }),
        of_errors("islands lost", [](const E& e) { return std::to_string(e.islands.lost); }),
        of_errors("islands false", [](const E& e) { return std::to_string(e.islands.invented); }),
        spread("normals off: mean (degrees)", &CurveErrors::angle, &Spread::mean),
        spread("normals off: p99 (degrees)", &CurveErrors::angle, &Spread::p99),
        spread("normals off: largest (degrees)", &CurveErrors::angle, &Spread::max),
        spread("distances off near curves: mean (texels)", &CurveErrors::distance, &Spread::mean),
        spread("distances off near curves: p99 (texels)", &CurveErrors::distance, &Spread::p99),
        spread("distances off near curves: largest (texels)", &CurveErrors::distance, &Spread::max),
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
            if (point.errors.empty()) add_line(out, columns, {point, nullptr, nullptr, true});
            for (const SizeErrors& e : point.errors)
                add_line(out, columns, {point, &e, nullptr, &e == &point.errors.back()});
        }
        for (const BenchPoint& point : file.curve_points) {
            if (point.curve_errors.empty()) add_line(out, columns, {point, nullptr, nullptr, true});
            for (const CurveErrors& e : point.curve_errors)
                add_line(out, columns, {point, nullptr, &e, &e == &point.curve_errors.back()});
        }
    }
    return out;
}

} // namespace fetexc::cli
