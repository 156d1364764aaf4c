// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/bench_plots.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include <fmt/format.h>

#include "cli/bench/log_scale.h"
#include "compiler/error_budget.h"
#include "compiler/measure/alternatives.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

/// Root mean square error in %.
double percent_of(double psnr) { return 100 * std::pow(10, -psnr / 20); }

struct ErrorFigure {
    double value = 0;
    bool at_most = false;
};

constexpr double kLeastAngle = 1e-3; ///< degrees: plots take no 0

ErrorFigure error_of(const BenchPoint& point, ErrorAxis axis) {
    if (axis == ErrorAxis::NormalAngle) {
        const double angle = point.curve_errors.back().angle->mean;
        return {std::max(angle, kLeastAngle), angle < kLeastAngle};
    }
    const measure::SizeErrors& e = point.errors.back();
    if (axis == ErrorAxis::ColorError)
        return {percent_of(std::min(e.psnr, budget::kBestPsnr)), e.psnr > budget::kBestPsnr};
    if (e.misclassified_ppm > 0) return {e.misclassified_ppm, false};
    return {0.5e6 / (static_cast<double>(e.pixels.width) * e.pixels.height), true};
}

std::optional<double> cost_of(const BenchPoint& point, CostAxis axis) {
    if (axis == CostAxis::Bytes) return static_cast<double>(point.bytes);
    if (!point.times) return std::nullopt;
    if (axis == CostAxis::CompileTime) return point.times->compile_ratio;
    if (!point.times->sampler) return std::nullopt;
    return point.times->sampler->median;
}

const std::vector<BenchPoint>& points_of(const BenchFile& file, ErrorAxis axis) {
    return axis == ErrorAxis::NormalAngle ? file.curve_points : file.points;
}

const BenchPoint* find(const BenchFile& file, const std::string& method, std::uint32_t size, ErrorAxis axis) {
    for (const BenchPoint& p : points_of(file, axis)) {
        if (p.method == method && p.size == size && !(p.errors.empty() && p.curve_errors.empty())) return &p;
    }
    return nullptr;
}

std::vector<std::uint32_t> sizes_of(const FileGroup& group, ErrorAxis axis) {
    std::vector<std::uint32_t> sizes;
    for (const BenchFile* file : group) {
        for (const BenchPoint& p : points_of(*file, axis)) {
            if (std::find(sizes.begin(), sizes.end(), p.size) == sizes.end()) sizes.push_back(p.size);
        }
    }
    std::sort(sizes.begin(), sizes.end());
    return sizes;
}

std::string describe(std::uint32_t size, double x, CostAxis cost, double y, ErrorAxis error) {
    const std::string what = error == ErrorAxis::WrongArea     ? fmt::format("{:.3g} ppm of the area wrong", y)
                             : error == ErrorAxis::NormalAngle ? fmt::format("normals off by {:.3g} degrees", y)
                                                               : fmt::format("{:.3g}% colour error", y);
    switch (cost) {
    case CostAxis::Bytes:
        return fmt::format("size {}: {}, {}", size, bytes_label(x), what);
    case CostAxis::CompileTime:
        return fmt::format("size {}: {:.3g} sorts, {}", size, x, what);
    default:
        return fmt::format("size {}: {:.3g} plain lookups, {}", size, x, what);
    }
}

/// Empty where some drawing lacks a figure.
std::optional<PlotPoint> mean_point(const FileGroup& group, const std::string& method, std::uint32_t size,
                                    ErrorAxis error, CostAxis cost) {
    double log_x = 0, log_y = 0;
    PlotPoint point;
    for (const BenchFile* file : group) {
        const BenchPoint* p = find(*file, method, size, error);
        const std::optional<double> x = p == nullptr ? std::nullopt : cost_of(*p, cost);
        if (!x || !(*x > 0)) return std::nullopt;
        const ErrorFigure y = error_of(*p, error);
        log_x += std::log(*x), log_y += std::log(y.value);
        point.at_most |= y.at_most;
    }
    const auto count = static_cast<double>(group.size());
    point.x = std::exp(log_x / count), point.y = std::exp(log_y / count);
    point.description = method + ", " + describe(size, point.x, cost, point.y, error);
    return point;
}

std::vector<PlotLine> mean_lines(const FileGroup& group, ErrorAxis error, CostAxis cost) {
    std::vector<PlotLine> lines;
    const std::span<const std::string> methods =
        error == ErrorAxis::NormalAngle ? std::span<const std::string>(curve_methods()) : bench_methods();
    for (std::size_t style = 0; style < methods.size(); ++style) {
        PlotLine line{methods[style], style, {}};
        for (const std::uint32_t size : sizes_of(group, error)) {
            if (auto point = mean_point(group, line.name, size, error, cost)) line.points.push_back(std::move(*point));
        }
        if (!line.points.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

Axis error_axis(ErrorAxis axis, bool brief) {
    if (axis == ErrorAxis::NormalAngle)
        return {
            brief ? "normals off, degrees" : "Angle that normals are off by on average, degrees", AxisUnit::Count, {}};
    if (axis == ErrorAxis::ColorError)
        return {brief ? "colour error, %" : "Colour error of the anti-aliased picture, % (root mean square)",
                AxisUnit::Count,
                {}};
    return {
        brief ? "wrong area, ppm" : "Area that shows the wrong colour, millionths (10,000 = 1%)", AxisUnit::Count, {}};
}

Axis cost_axis(CostAxis axis) {
    switch (axis) {
    case CostAxis::Bytes:
        return {"Memory on the graphics card, bytes (1 kB = 1000 bytes)", AxisUnit::Bytes, {}};
    case CostAxis::CompileTime:
        return {"Processor time to make it, in sorts of a million numbers", AxisUnit::Count, {}};
    default:
        return {"Time of a lookup, in plain bilinear lookups", AxisUnit::Count, {}};
    }
}

void widen(std::optional<std::array<double, 2>>& range, double v) {
    if (!range) range = {v, v};
    (*range)[0] = std::min((*range)[0], v), (*range)[1] = std::max((*range)[1], v);
}

} // namespace

const std::array<std::string, kPlotStyles>& bench_methods() {
    static const std::array<std::string, kPlotStyles> names = {
        kFbtMethod,
        measure::alternative_name(measure::Alternative::Bitmap),
        measure::alternative_name(measure::Alternative::BoxThreshold),
        measure::alternative_name(measure::Alternative::DistanceField),
        kBilevelOneMethod,
        kBilevelMethod,
        kSilmapMethod,
        kSilmapWideMethod,
        kPinchmapMethod};
    return names;
}

const std::vector<std::string>& curve_methods() {
    static const std::vector<std::string> names = {kCurvesMethod, kNormalMapMethod, kStraightCurvesMethod};
    return names;
}

std::vector<std::string> methods_of(const FileGroup& group, ErrorAxis error) {
    std::vector<std::string> methods;
    for (const PlotLine& line : mean_lines(group, error, CostAxis::Bytes))
        methods.push_back(line.name);
    return methods;
}

Plot mean_plot(const FileGroup& group, ErrorAxis error, CostAxis cost) {
    Plot plot;
    plot.x = cost_axis(cost), plot.y = error_axis(error, false);
    plot.lines = mean_lines(group, error, cost);
    const auto hollow = [](const PlotLine& line) {
        return std::any_of(line.points.begin(), line.points.end(), [](const PlotPoint& p) { return p.at_most; });
    };
    if (std::any_of(plot.lines.begin(), plot.lines.end(), hollow))
        plot.note =
            error == ErrorAxis::WrongArea
                ? std::string(
                      "Hollow marks: in some drawing no sample point at all was wrong; half a point counts there.")
            : error == ErrorAxis::NormalAngle
                ? fmt::format("Hollow marks: in some drawing normals are right; {:g} degrees count there.", kLeastAngle)
                : fmt::format("Hollow marks: in some drawing the error is too small to tell; {:g}% counts there.",
                              percent_of(budget::kBestPsnr));
    return plot;
}

std::vector<Plot> small_plots(const FileGroup& group, ErrorAxis error) {
    std::vector<Plot> plots;
    std::optional<std::array<double, 2>> x, y;
    for (const BenchFile* file : group) {
        Plot plot;
        plot.width = 300, plot.height = 220, plot.names = false;
        plot.title = fetex::to_valid_utf8(std::filesystem::path(file->path).stem().string());
        plot.lines = mean_lines({file}, error, CostAxis::Bytes);
        for (const PlotLine& line : plot.lines) {
            for (const PlotPoint& p : line.points)
                widen(x, p.x), widen(y, p.y);
        }
        plots.push_back(std::move(plot));
    }
    for (Plot& plot : plots) {
        plot.x = {"bytes", AxisUnit::Bytes, x};
        plot.y = error_axis(error, true);
        plot.y.range = y;
    }
    return plots;
}

} // namespace fetexc::cli
