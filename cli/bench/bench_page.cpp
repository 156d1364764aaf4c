// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/bench_page.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/bench/bench_plots.h"
#include "cli/bench/compile_time.h"
#include "cli/bench/log_scale.h"
#include "compiler/error_budget.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {
namespace {

constexpr const char* kStyleSheet = R"(
body{font:16px/1.5 Helvetica,Arial,"Liberation Sans","DejaVu Sans",sans-serif;color:#222;background:#fff;max-width:960px;margin:2em auto;padding:0 1em}
h1{font-size:1.7em;line-height:1.2}h2{font-size:1.3em;margin-top:2em;border-bottom:1px solid #ccc}h3{font-size:1.05em;margin:1.6em 0 .2em}
p{margin:.4em 0}svg{max-width:100%;height:auto}
.small{display:grid;grid-template-columns:repeat(auto-fill,minmax(290px,1fr));gap:6px}
.legend{list-style:none;padding:0}.legend li{margin:.3em 0}
table{border-collapse:collapse;font-size:12px;line-height:1.3}
th,td{padding:2px 6px;text-align:right;border-bottom:1px solid #ddd;vertical-align:bottom}
th:nth-child(-n+2),td:nth-child(-n+2){text-align:left}tr.first td{border-top:1px solid #888}
.wide{overflow-x:auto}.note{color:#555}
@media print{body{max-width:none;margin:0;font-size:11pt}h3,figure,svg,tr{break-inside:avoid}.wide{overflow:visible}table{font-size:7pt}}
)";

std::string name_of(const BenchFile& file) {
    return escaped(fetex::to_valid_utf8(std::filesystem::path(file.path).stem().string()));
}

/// Drawings, not networks.
FileGroup all_of(const std::vector<BenchFile>& files) {
    FileGroup group;
    for (const BenchFile& f : files) {
        if (!f.points.empty()) group.push_back(&f);
    }
    return group;
}

FileGroup with_curves(const std::vector<BenchFile>& files) {
    FileGroup group;
    for (const BenchFile& f : files) {
        if (!f.curve_points.empty() && !f.curve_points.front().curve_errors.empty()) group.push_back(&f);
    }
    return group;
}

FileGroup two_colored(const std::vector<BenchFile>& files) {
    FileGroup group;
    for (const BenchFile& f : files) {
        if (f.two_colors) group.push_back(&f);
    }
    return group;
}

/// In any plot of the group: those of single drawings show what applies to them.
std::vector<std::string> methods_shown(const FileGroup& group, ErrorAxis error) {
    std::vector<std::string> shown;
    for (const BenchFile* file : group) {
        const std::vector<std::string> methods = methods_of({file}, error);
        shown.insert(shown.end(), methods.begin(), methods.end());
    }
    return shown;
}

std::string drawings(std::size_t count) { return count == 1 ? "one drawing" : fmt::format("{} drawings", count); }

const char* explanation(std::size_t method) {
    constexpr std::array<const char*, kPlotStyles> kTexts = {
        "what fetexc makes: every cell of the texture carries the curves that cross it and one colour for each side, "
        "so edges stay sharp however far one zooms in",
        "an ordinary texture: a picture in red, green, blue and opacity, smoothed by the graphics card between its "
        "cells",
        "one channel instead of four: how much of each cell is covered, cut at one half. Only for drawings of two "
        "plain colours",
        "one channel: the distance to the nearest edge, cut at the edge. Sharp edges, round corners. Only for drawings "
        "of two plain colours",
        "what fetexc makes of drawings of two plain colours: one channel whose values are chosen so that, smoothed and "
        "cut at one half, they are the drawing",
        "the same with one, two or three channels, whichever shows least wrong: where two edges meet each can have a "
        "channel of its own",
        "what fetexc makes of drawings for small shaders: an ordinary texture, and for each of its cells one point and "
        "two bits that say where colours end",
        "the same with points on a finer grid",
        "what fetexc makes of drawings with two zones: an ordinary texture, and a small map that says how to move the "
        "place where it is read, so that colours on the two sides of a line never mix"};
    return kTexts[method];
}

std::string legend(const std::vector<std::string>& methods) {
    std::string out = "<ul class=\"legend\">\n";
    for (std::size_t k = 0; k < bench_methods().size(); ++k) {
        if (std::find(methods.begin(), methods.end(), bench_methods()[k]) == methods.end()) continue;
        out += fmt::format("<li>{} <b>{}</b>: {}.</li>\n", legend_svg(k), escaped(bench_methods()[k]), explanation(k));
    }
    return out + "</ul>\n";
}

std::string curve_legend(const std::vector<std::string>& methods) {
    constexpr std::array<const char*, 3> kTexts = {
        "what fetexc makes of curves: every cell of the texture carries the curves that cross it, its corners the "
        "distance to them, and a small table what is done at each distance",
        "an ordinary texture of normals, smoothed by the graphics card between its cells",
        "the same with straight lines for curves in each cell: less memory a cell, and a faster lookup. Drawings of "
        "lines have it anyway"};
    std::string out = "<ul class=\"legend\">\n";
    for (std::size_t k = 0; k < kTexts.size(); ++k) {
        if (std::ranges::count(methods, curve_methods()[k]) == 0) continue;
        out += fmt::format("<li>{} <b>{}</b>: {}.</li>\n", legend_svg(k), escaped(curve_methods()[k]), kTexts[k]);
    }
    return out + "</ul>\n";
}

struct PlotText {
    ErrorAxis error;
    CostAxis cost;
    const char* heading;
    const char* sentence;
};
constexpr PlotText kPlots[] = {
    {ErrorAxis::WrongArea, CostAxis::Bytes, "Error against memory",
     "How much of the picture shows a wrong colour, for the memory that the texture takes; lower is more accurate, "
     "further left is smaller, so down and to the left is better."},
    {ErrorAxis::WrongArea, CostAxis::CompileTime, "Error against the time it takes to make the texture",
     "How much of the picture shows a wrong colour, for the processor time that making the texture took; lower is more "
     "accurate, further left is faster, so down and to the left is better. The ordinary textures are made here by "
     "exact integration, for accuracy: programs made for speed take less time than that."},
    {ErrorAxis::WrongArea, CostAxis::SamplerCost, "Error against the time it takes to look a colour up",
     "How much of the picture shows a wrong colour, for the time that drawing with the texture takes beside an "
     "ordinary one of the same bytes (1 is as fast); lower is more accurate, further left is faster to draw."},
    {ErrorAxis::ColorError, CostAxis::Bytes, "Error of the smoothed picture against memory",
     "How far the colours of the drawn pixels are off on average, edges smoothed, for the memory that the texture "
     "takes; lower is more accurate, further left is smaller."}};

constexpr PlotText kCurvePlots[] = {
    {ErrorAxis::NormalAngle, CostAxis::Bytes, "Error against memory",
     "How far the normals are off on average, for the memory that the texture takes; lower is more accurate, further "
     "left is smaller."},
    {ErrorAxis::NormalAngle, CostAxis::CompileTime, "Error against the time it takes to make the texture",
     "The same for the processor time that making the texture took. The ordinary normal map is made here of the exact "
     "surface, for accuracy and not for speed."},
    {ErrorAxis::NormalAngle, CostAxis::SamplerCost, "Error against the time it takes to look a normal up",
     "The same for the time that drawing with the texture takes beside an ordinary one of the same bytes (1 is as "
     "fast)."}};

std::string plots_of(const FileGroup& group, std::span<const PlotText> texts, const BenchPageFacts& facts) {
    std::string out;
    for (const PlotText& text : texts) {
        const Plot plot = mean_plot(group, text.error, text.cost);
        if (plot.lines.empty()) continue;
        out += fmt::format("<h3>{}</h3>\n<p>{}</p>\n<figure>{}</figure>\n", text.heading, text.sentence,
                           plot_svg(plot, false));
    }
    if (!facts.timed)
        out += "<p class=\"note\">Nothing was timed in this run, so there are no plots against time.</p>\n";
    else if (facts.renderer.empty())
        out += fmt::format("<p class=\"note\">No lookups were timed: {}.</p>\n", escaped(facts.why_no_renderer));
    return out;
}

std::string small_plots_of(const FileGroup& group, ErrorAxis error, const char* which) {
    std::string out = fmt::format("<h3>Each drawing on its own</h3>\n<p>{} against memory as above, for {}; all with "
                                  "the same axes. Down and to the left is better.</p>\n<div class=\"small\">\n",
                                  error == ErrorAxis::NormalAngle ? "Normals off" : "Wrong area", which);
    for (const Plot& plot : small_plots(group, error))
        out += plot_svg(plot, false);
    return out + "</div>\n";
}

std::string psnr_cell(double psnr) { return psnr > budget::kEqualPsnr ? "equal" : fmt::format("{:.1f}", psnr); }

std::string equal_cell(const BenchPoint& p) {
    if (!p.equal_bitmap) return "";
    const measure::EqualErrorBitmap& b = *p.equal_bitmap;
    return fmt::format("{}{} × {} ({})",
                       !b.found                                ? "more than "
                       : p.errors.back().misclassified_ppm > 0 ? ""
                                                               : "at least ",
                       b.size.width, b.size.height, bytes_label(static_cast<double>(b.bytes)));
}

std::string lookup_cell(const BenchPoint& p) {
    if (!p.times || !p.times->sampler) return "";
    std::string text = fmt::format("{:.2f}", p.times->sampler->median);
    if (p.times->area_sampler) text += fmt::format(" ({:.2f})", p.times->area_sampler->median);
    return text;
}

std::string table_row(const BenchFile& file, const BenchPoint& p, bool first) {
    std::string row = fmt::format("<tr{}><td>{}</td><td>{}</td><td>{} × {}</td>", first ? " class=\"first\"" : "",
                                  first ? name_of(file) : "", escaped(p.method), p.texels.width, p.texels.height);
    if (p.errors.empty())
        return row + fmt::format("<td colspan=\"10\" class=\"note\" style=\"text-align:left\">{}</td></tr>\n",
                                 escaped(p.note));
    const measure::SizeErrors& e = p.errors.back();
    const auto cell = [&](const std::string& text) { row += "<td>" + text + "</td>"; };
    cell(bytes_label(static_cast<double>(p.bytes)));
    cell(e.misclassified_ppm > 0 ? count_label(e.misclassified_ppm) : "0");
    cell(fmt::format("{:.4f}", e.to_picture.mean * 1000));
    cell(fmt::format("{:.3f}", std::max(e.to_picture.hausdorff, e.to_truth.hausdorff) * 1000));
    cell(psnr_cell(e.psnr));
    cell(fmt::format("{:.2f}", e.away.max * 255));
    cell(fmt::format("{} + {}", e.islands.lost, e.islands.invented));
    cell(p.times ? fmt::format("{:.3g}", p.times->compile_ratio) : "");
    cell(lookup_cell(p));
    cell(equal_cell(p));
    return row + "</tr>\n";
}

std::string table_of(const std::vector<BenchFile>& files) {
    std::string out =
        "<div "
        "class=\"wide\"><table>\n<thead><tr><th>drawing</th><th>method</th><th>texels</th><th>memory</th><th>wrong "
        "area, millionths</th><th>edges off on average, 1/1000 of the width</th><th>edges off at most, 1/1000 of the "
        "width</th><th>PSNR, dB</th><th>colour off at most, 1/255, away from edges</th><th>islands lost + false</th>"
        "<th>time to make, sorts</th><th>time of a lookup (of the mean over a pixel), plain lookups</th><th>ordinary "
        "bitmap as good in wrong area"
        "</th></tr></thead>\n<tbody>\n";
    for (const BenchFile& file : files) {
        for (const BenchPoint& p : file.points)
            out += table_row(file, p, &p == &file.points.front());
    }
    return out + "</tbody></table></div>\n";
}

std::string curve_row(const BenchFile& file, const BenchPoint& p, bool first) {
    std::string row = fmt::format("<tr{}><td>{}</td><td>{}</td><td>{} × {}</td>", first ? " class=\"first\"" : "",
                                  first ? name_of(file) : "", escaped(p.method), p.texels.width, p.texels.height);
    const measure::CurveErrors& e = p.curve_errors.back();
    const auto cell = [&](const std::string& text) { row += "<td>" + text + "</td>"; };
    const auto optional_cell = [&](const auto& of, const auto& text) { cell(of ? text(*of) : std::string()); };
    cell(bytes_label(static_cast<double>(p.bytes)));
    cell(fmt::format("{:.3f}", e.angle->mean));
    cell(fmt::format("{:.2f}", e.angle->p99));
    optional_cell(e.to_picture, [](const measure::Distances& d) { return fmt::format("{:.4f}", d.mean * 1000); });
    optional_cell(e.to_picture, [](const measure::Distances& d) { return fmt::format("{:.3f}", d.hausdorff * 1000); });
    optional_cell(e.distance, [](const measure::Spread& s) { return fmt::format("{:.4f}", s.mean); });
    cell(psnr_cell(e.colors.psnr));
    cell(p.times ? fmt::format("{:.3g}", p.times->compile_ratio) : "");
    cell(lookup_cell(p));
    return row + "</tr>\n";
}

std::string curve_table_of(const FileGroup& files) {
    std::string out =
        "<div class=\"wide\"><table>\n<thead><tr><th>drawing</th><th>method</th><th>texels</th><th>memory</th>"
        "<th>normals off on average, degrees</th><th>99% are off by less than, degrees</th><th>curves off on average, "
        "1/1000 of the width</th><th>curves off at most, 1/1000 of the width</th><th>distances off near curves, "
        "texels</th><th>PSNR, dB</th><th>time to make, sorts</th><th>time of a lookup (of the mean over a pixel), "
        "plain "
        "lookups</th></tr></thead>\n<tbody>\n";
    for (const BenchFile* file : files) {
        for (const BenchPoint& p : file->curve_points)
            out += curve_row(*file, p, &p == &file->curve_points.front());
    }
    return out + "</tbody></table></div>\n";
}

std::string curve_section(const FileGroup& group, const BenchPageFacts& facts) {
    return fmt::format(
        "<h2>Curves of {}</h2>\n<p>The drawings' lines and edges as folds of a surface (a crease as wide "
        "as a 64th of the picture on either side, unless a network says otherwise), in normals, held "
        "against the exact surface; the textures have the same memory.</p>\n{}{}{}<h3>Figures of "
        "curves</h3>\n{}",
        drawings(group.size()), curve_legend(methods_shown(group, ErrorAxis::NormalAngle)),
        plots_of(group, kCurvePlots, facts), small_plots_of(group, ErrorAxis::NormalAngle, "every one with curves"),
        curve_table_of(group));
}

std::string how_measured(const std::vector<BenchFile>& files, const BenchPageFacts& facts) {
    std::string out = fmt::format(
        "<ul>\n<li>Sizes swept: {} texels on the longer side of the feature-based texture; the other textures have at "
        "most its bytes, and its shape. A texel is a cell of a texture.</li>\n",
        fmt::join(facts.sizes, ", "));
    const double points = static_cast<double>(facts.outputs.back()) * facts.outputs.back();
    out += fmt::format("<li>Errors are measured against the drawing's own curves, not against another picture of it, "
                       "at {} pixels on the "
                       "longer side: one sample point a pixel ({:.2g} millionths of a square picture each).</li>\n",
                       facts.outputs.back(), 1e6 / points);
    out += "<li>A line's points are geometric means over the drawings, of both coordinates.</li>\n";
    out +=
        "<li>Edges off: how far the drawing's edges are from those that the texture shows, counted up to one and a "
        "half texels. PSNR: peak signal-to-noise ratio of the smoothed picture against the exact one; each 6 dB halve "
        "the error, and about 70 dB is where right pictures can't be told apart. Islands: spots of a colour that the "
        "texture lost, and false ones.</li>\n";
    out +=
        fmt::format("<li>As good in wrong area: the smallest ordinary bitmap, of at most 16,384 texels a side, with no "
                    "more of it; its side is right to {:g}%.</li>\n",
                    100 * budget::kEqualErrorPrecision);
    if (facts.timed) {
        out +=
            fmt::format("<li>Time to make: processor time of one thread from the SVG file to the texture, median of {} "
                        "rounds, in units of sorting {} pseudo-random numbers (std::sort, 64 bits) in the same round. "
                        "The ordinary textures are made by exact integration, for accuracy and not for speed; faster "
                        "programs exist.</li>\n",
                        facts.compile_rounds, count_label(kYardstickNumbers));
        if (!facts.renderer.empty())
            out += fmt::format(
                "<li>Time of a lookup: median of {} rounds, each drawing the whole picture with the texture "
                "and with an ordinary bilinear one of the same bytes, by {}.</li>\n",
                facts.sampler_rounds, escaped(facts.renderer));
    }
    return out + fmt::format("<li>{}, fetexc {}.</li>\n</ul>\n", drawings(files.size()), escaped(facts.version));
}

std::string section(const FileGroup& group, const std::string& heading, const char* which,
                    const BenchPageFacts& facts) {
    return fmt::format("<h2>{}</h2>\n{}{}{}", heading, legend(methods_shown(group, ErrorAxis::WrongArea)),
                       plots_of(group, kPlots, facts), small_plots_of(group, ErrorAxis::WrongArea, which));
}

} // namespace

std::string bench_plot(const std::vector<BenchFile>& files) {
    const FileGroup all = all_of(files), plain = two_colored(files);
    if (all.empty()) { // networks alone
        const FileGroup curves = with_curves(files);
        Plot plot = mean_plot(curves, ErrorAxis::NormalAngle, CostAxis::Bytes);
        plot.title = fmt::format("Error against memory, curves of {}", drawings(curves.size()));
        return plot_svg(plot, true);
    }
    const bool use_plain = !plain.empty();
    Plot plot = mean_plot(use_plain ? plain : all, ErrorAxis::WrongArea, CostAxis::Bytes);
    plot.title = fmt::format("Error against memory, mean of {}{}", drawings(use_plain ? plain.size() : all.size()),
                             use_plain ? " of two plain colours" : "");
    return plot_svg(plot, true);
}

std::string bench_page(const std::vector<BenchFile>& files, const BenchPageFacts& facts) {
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                      "<meta name=\"viewport\" content=\"width=device-width\">\n"
                      "<title>fetexc: error, memory and time of textures</title>\n";
    out += fmt::format(
        "<style>{}</style>\n</head>\n<body>\n<h1>How accurate is a texture for its memory, and for the time "
        "it takes?</h1>\n",
        kStyleSheet);
    out += fmt::format(
        "<p>A texture is a picture on a graphics card, stored as a grid of cells (texels) that programs look colours "
        "up in. "
        "When one zooms in, an ordinary texture blurs. fetexc turns drawings into textures that keep their edges. This "
        "page "
        "holds {} against what one would use instead, in the same memory. In every plot, both axes are logarithmic: "
        "each step along them multiplies.</p>\n",
        drawings(files.size()));
    const FileGroup all = all_of(files), plain = two_colored(files);
    if (!all.empty())
        out += section(all, all.size() == 1 ? "The drawing" : fmt::format("All {}", drawings(all.size())),
                       "every drawing", facts);
    if (!plain.empty() && plain.size() < all.size())
        out += section(plain, fmt::format("The {} of two plain colours", drawings(plain.size())),
                       "those of two plain colours", facts);
    if (const FileGroup curves = with_curves(files); !curves.empty()) out += curve_section(curves, facts);
    out += "<h2>How this was measured</h2>\n" + how_measured(files, facts);
    if (!all.empty()) out += "<h2>All figures</h2>\n" + table_of(files);
    return out + "</body>\n</html>\n";
}

} // namespace fetexc::cli
