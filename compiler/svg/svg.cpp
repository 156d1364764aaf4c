// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/svg/svg.h"

#include <memory>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/svg/scene_mapping.h"
#include "compiler/svg/svg_front_end.h"

namespace fetexc {
namespace {

struct Free {
    void operator()(fetexc_svg_document* document) const { fetexc_svg_free(document); }
};
using Document = std::unique_ptr<fetexc_svg_document, Free>;

/// Keeps the strings alive that the C options point to.
struct OptionStrings {
    std::vector<std::string> fonts;
    std::vector<const char*> font_pointers;
    std::string resources;
};

fetexc_svg_options to_c(const SvgOptions& o, OptionStrings& strings) {
    for (const std::filesystem::path& font : o.font_files)
        strings.fonts.push_back(font.string());
    for (const std::string& font : strings.fonts)
        strings.font_pointers.push_back(font.c_str());
    strings.resources = o.resources_dir.string();
    fetexc_svg_options c{};
    c.font_files = strings.font_pointers.data();
    c.font_file_count = strings.font_pointers.size();
    c.system_fonts = o.system_fonts ? 1 : 0;
    c.raster_pixels = o.raster_pixels;
    c.default_family = o.default_family.empty() ? nullptr : o.default_family.c_str();
    c.resources_dir = strings.resources.empty() ? nullptr : strings.resources.c_str();
    c.dpi = o.dpi;
    c.arc_tolerance = budget::kArcTolerance / static_cast<double>(kLatticeSteps);
    c.stroke_tolerance = budget::kStrokeTolerance / static_cast<double>(kLatticeSteps);
    c.max_bytes = o.limits.bytes;
    c.max_elements = o.limits.elements;
    c.max_segments = o.limits.segments;
    c.max_raster_bytes = o.limits.raster_bytes;
    c.max_nesting = o.limits.nesting;
    c.max_milliseconds = o.limits.milliseconds;
    c.threads = o.threads;
    return c;
}

Error to_error(const fetexc_svg_error& e) {
    const int code = static_cast<int>(e.code);
    ErrorClass cls = ErrorClass::InvalidInput;
    if (code == diag::kSvgInternal) cls = ErrorClass::Runtime;
    if (code == diag::kSvgFontFile) cls = ErrorClass::Io;
    return {cls, code, e.message, e.place};
}

void append_findings(const fetexc_svg_view& view, std::vector<Diagnostic>& out) {
    for (std::size_t i = 0; i < view.finding_count; ++i) {
        const fetexc_svg_finding& f = view.findings[i];
        const auto text = [](const fetexc_svg_string& s) { return std::string(s.text, s.length); };
        out.push_back({f.severity == 0 ? Severity::Note : Severity::Warning, static_cast<int>(f.code), text(f.message),
                       text(f.place)});
    }
}

} // namespace

namespace {

Result<Document> load_document(std::span<const std::uint8_t> bytes, const SvgOptions& options, std::uint32_t centre_lines,
                               std::vector<Diagnostic>& diagnostics) {
    OptionStrings strings;
    fetexc_svg_options c_options = to_c(options, strings);
    c_options.centre_lines = centre_lines;
    fetexc_svg_error error{};
    Document document(fetexc_svg_load(bytes.data(), bytes.size(), &c_options, &error));
    if (!document) return to_error(error);
    append_findings(*fetexc_svg_get(document.get()), diagnostics);
    return document;
}

} // namespace

Result<Scene> load_svg(std::span<const std::uint8_t> bytes, const SvgOptions& options,
                       std::vector<Diagnostic>& diagnostics) {
    const Result<Document> document = load_document(bytes, options, 0, diagnostics);
    if (!document) return document.error();
    return svg::to_scene(*fetexc_svg_get(document.value().get()), options.cull, diagnostics);
}

Result<FeatureCurves> load_svg_features(std::span<const std::uint8_t> bytes, const SvgOptions& options,
                                        std::vector<Diagnostic>& diagnostics, SvgCurves which) {
    const std::uint32_t centre_lines = which == SvgCurves::Edges ? 0 : which == SvgCurves::Features ? 1 : 2;
    const Result<Document> document = load_document(bytes, options, centre_lines, diagnostics);
    if (!document) return document.error();
    const fetexc_svg_view& view = *fetexc_svg_get(document.value().get());
    if (view.clip_count + view.mask_count > 0)
        diagnostics.push_back({Severity::Warning, diag::kFeaturesUnclipped,
                               "clips and masks in the features' drawing don't cut its features", ""});
    FeatureCurves features{view.width, view.height, {}};
    for (std::uint32_t n = 0; n < view.root_end; ++n) {
        const fetexc_svg_node& node = view.nodes[n];
        if (node.kind != FETEXC_SVG_FILL || view.paints[node.paint].kind == FETEXC_SVG_RASTER) continue;
        if (which == SvgCurves::Strokes && node.line == 0) continue;
        for (CanvasContour& contour : svg::contours_of(view, view.shapes[node.shape]))
            features.runs.push_back(std::move(contour));
    }
    return features;
}

} // namespace fetexc
