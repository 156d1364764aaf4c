// SPDX-License-Identifier: GPL-3.0-or-later
/// What the SVG front end makes of whole documents: structure, findings by number and name, and hostile bytes.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/svg/svg.h"

namespace fetexc {
namespace {

using Diagnostics = std::vector<Diagnostic>;

Result<Scene> load_bytes(const std::string& svg, Diagnostics& d, const SvgOptions& options = {}) {
    return load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, options, d);
}

std::string document(const std::string& body) {
    return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='100' "
           "height='100'>" +
           body + "</svg>";
}

Result<Scene> load(const std::string& body, Diagnostics& d, const SvgOptions& options = {}) {
    return load_bytes(document(body), d, options);
}

int error_of(const std::string& svg, const SvgOptions& options = {}) {
    Diagnostics d;
    const Result<Scene> scene = load_bytes(svg, d, options);
    return scene.ok() ? 0 : scene.error().code;
}

/// Premultiplied colour at a canvas point of a 100 × 100 drawing.
Rgba color(const std::string& body, double x, double y) {
    Diagnostics d;
    const Result<Scene> scene = load(body, d);
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
    if (!scene.ok()) return {};
    const double unit = static_cast<double>(scene.value().extent.lattice_w) / 100;
    return GroundTruth(scene.value()).color_at(x * unit, y * unit);
}

void expect_near(const Rgba& a, const Rgba& b) {
    // Solid results are rounded to RGBA8.
    EXPECT_NEAR(a.r, b.r, 0.51 / 255);
    EXPECT_NEAR(a.g, b.g, 0.51 / 255);
    EXPECT_NEAR(a.b, b.b, 0.51 / 255);
    EXPECT_NEAR(a.a, b.a, 0.51 / 255);
}

bool reports(const Diagnostics& d, int code, const std::string& place) {
    for (const Diagnostic& x : d)
        if (x.code == code && x.place == place) return true;
    return false;
}

// ---- structure ----

TEST(SvgInput, fillRulesAndPaintOrder) {
    const std::string star = "d='M10 10H90V90H10zM30 30H70V70H30z'";
    expect_near(color("<path fill='#f00' " + star + "/>", 50, 50), {1, 0, 0, 1});
    expect_near(color("<path fill='#f00' fill-rule='evenodd' " + star + "/>", 50, 50), {0, 0, 0, 0});
    const std::string rect = "<rect x='20' y='20' width='60' height='60' fill='#f00' stroke='#00f' stroke-width='20' ";
    expect_near(color(rect + "/>", 25, 50), {0, 0, 1, 1});
    expect_near(color(rect + "paint-order='stroke'/>", 25, 50), {1, 0, 0, 1});
}

TEST(SvgInput, groupOpacityIsNotElementOpacity) {
    const std::string two =
        "<rect width='60' height='100' fill='#f00'/><rect x='40' width='60' height='100' fill='#00f'/>";
    expect_near(color("<g opacity='.5'>" + two + "</g>", 50, 50), {0, 0, 0.5, 0.5});
    expect_near(color("<g fill-opacity='.5'>" + two + "</g>", 50, 50), {0.25, 0, 0.5, 0.75});
}

TEST(SvgInput, blendModes) {
    const std::string under = "<rect width='100' height='100' fill='#ff8000'/>";
    const auto over = [&](const std::string& mode) {
        return color(under + "<rect width='100' height='100' fill='#0080ff' style='mix-blend-mode:" + mode + "'/>", 50,
                     50);
    };
    const double g = 128 / 255.0;
    expect_near(over("multiply"), {0, g * g, 0, 1});
    expect_near(over("screen"), {1, g + g - g * g, 1, 1});
    expect_near(over("difference"), {1, 0, 1, 1});
    expect_near(over("exclusion"), {1, g + g - 2 * g * g, 1, 1});
}

TEST(SvgInput, clippedGroupIsolatesBlending) {
    const std::string body = "<rect width='100' height='100' fill='#ff0000'/><clipPath id='c'><rect width='50' "
                             "height='100'/></clipPath><g clip-path='url(#c)'><rect width='100' height='100' "
                             "fill='#00ff00' style='mix-blend-mode:multiply'/></g>";
    expect_near(color(body, 25, 50), {0, 1, 0, 1});
    expect_near(color(body, 75, 50), {1, 0, 0, 1});
}

TEST(SvgInput, nestedClips) {
    const std::string body = "<clipPath id='a'><rect width='50' height='100'/></clipPath>"
                             "<clipPath id='b' clip-path='url(#a)'><rect y='0' width='100' height='50'/></clipPath>"
                             "<clipPath id='c'><g><rect width='100' height='100' clip-path='url(#b)'/></g>"
                             "<rect width='100' height='100' clip-path='url(#b)'/></clipPath>"
                             "<rect width='100' height='100' fill='#f00' clip-path='url(#c)'/>";
    expect_near(color(body, 25, 25), {1, 0, 0, 1});
    expect_near(color(body, 75, 25), {});
    expect_near(color(body, 25, 75), {});
}

TEST(SvgInput, masksAreVectorsAndNest) {
    const std::string body =
        "<mask id='m' maskUnits='userSpaceOnUse' x='0' y='0' width='80' height='100'>"
        "<rect width='100' height='100' fill='#808080'/></mask>"
        "<mask id='n' mask='url(#m)' style='mask-type:alpha' maskUnits='userSpaceOnUse' x='0' y='0' "
        "width='100' height='100'><rect width='100' height='50' fill-opacity='.5'/></mask>"
        "<rect width='100' height='100' fill='#f00' mask='url(#n)'/>";
    const double v = 128 / 255.0 * 0.5;
    expect_near(color(body, 50, 25), {v, 0, 0, v});
    expect_near(color(body, 90, 25), {}); // outside the region of m
    expect_near(color(body, 50, 75), {}); // outside the content of n
}

TEST(SvgInput, maskInLinearRgb) {
    const auto with = [](const std::string& more) {
        return color("<mask id='m' " + more +
                         "><rect width='100' height='100' fill='#808080'/></mask>"
                         "<rect width='100' height='100' fill='#f00' mask='url(#m)'/>",
                     50, 50)
            .a;
    };
    EXPECT_NEAR(with(""), 128 / 255.0, 1e-3);
    EXPECT_NEAR(with("color-interpolation='linearRGB'"), 0.2158, 1e-3);
}

TEST(SvgInput, useSymbolAndNestedSvg) {
    const std::string body = "<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10' fill='#f00'/></symbol>"
                             "<use href='#s' x='10' y='10' width='30' height='30'/>"
                             "<svg x='50' y='50' width='40' height='20' viewBox='0 0 10 10' "
                             "preserveAspectRatio='xMaxYMid meet'><rect width='10' height='10' fill='#00f'/></svg>";
    expect_near(color(body, 25, 25), {1, 0, 0, 1});
    expect_near(color(body, 45, 45), {});
    expect_near(color(body, 80, 60), {0, 0, 1, 1});
    expect_near(color(body, 60, 60), {});
}

TEST(SvgInput, patternIsVectorTiles) {
    Diagnostics d;
    const std::string body = "<pattern id='p' width='20' height='20' patternUnits='userSpaceOnUse'><rect width='10' "
                             "height='10' fill='#f00'/></pattern><rect width='100' height='100' fill='url(#p)'/>";
    const Result<Scene> scene = load(body, d);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(d.empty());
    EXPECT_EQ(scene.value().stats.raster_layers, 0u);
    expect_near(color(body, 45, 65), {1, 0, 0, 1});
    expect_near(color(body, 55, 65), {});
}

TEST(SvgInput, finePatternIsARasterLayer) {
    Diagnostics d;
    const std::string body = "<pattern id='p' width='1' height='1' patternUnits='userSpaceOnUse'><rect width='.5' "
                             "height='1' fill='#f00'/></pattern><rect id='r' width='100' height='100' fill='url(#p)'/>";
    const Result<Scene> scene = load(body, d);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(reports(d, diag::kSvgPatternRasterised, "rect#r"));
    EXPECT_EQ(scene.value().stats.raster_layers, 1u);
    expect_near(color(body, 50.25, 50.5), {1, 0, 0, 1});
    expect_near(color(body, 50.75, 50.5), {});
}

TEST(SvgInput, filterIsARasterLayerInItsPlace) {
    Diagnostics d;
    const std::string body = "<rect width='100' height='100' fill='#fff'/><filter id='f'><feFlood flood-color='#00f'/>"
                             "</filter><g id='g' filter='url(#f)'><rect x='20' y='20' width='40' height='40'/></g>"
                             "<rect x='50' width='50' height='100' fill='#f00'/>";
    const Result<Scene> scene = load(body, d);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(reports(d, diag::kSvgFilterRasterised, "g#g"));
    expect_near(color(body, 40, 40), {0, 0, 1, 1});
    expect_near(color(body, 55, 40), {1, 0, 0, 1});
    expect_near(color(body, 10, 40), {1, 1, 1, 1});
}

TEST(SvgInput, embeddedBitmapAndSvg) {
    // 2 × 1 pixels: red, half-transparent blue.
    const std::string png = "data:image/png;base64,"
                            "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAADklEQVR4nGP4z8AAQg0AD3oDfnfpf5cA"
                            "AAAASUVORK5CYII=";
    Diagnostics d;
    const std::string body = "<image id='pic' x='10' y='10' width='40' height='20' style='image-rendering:pixelated' "
                             "href=\"" +
                             png +
                             "\"/>"
                             "<image x='50' y='50' width='40' height='40' href=\"data:image/svg+xml;utf8,&lt;svg "
                             "xmlns='http://www.w3.org/2000/svg' width='4' height='4'>&lt;circle cx='2' cy='2' r='2' "
                             "fill='lime'/>&lt;/svg>\"/>";
    const Result<Scene> scene = load(body, d);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(reports(d, diag::kSvgBitmapImage, "image#pic"));
    EXPECT_EQ(scene.value().stats.raster_layers, 1u) << "the SVG is not a raster layer";
    expect_near(color(body, 20, 20), {1, 0, 0, 1});
    expect_near(color(body, 70, 70), {0, 1, 0, 1});
    expect_near(color(body, 51, 51), {});
}

TEST(SvgInput, compressedInputIsTheSame) {
    // gzip of <svg xmlns="http://www.w3.org/2000/svg" width="8" height="8"><rect width="4" height="8"/></svg>
    const std::string hex = "1f8b0800000000000203b3292e4b57a8c8cdc92bb655ca282929b0d2d72f2f2fd72b37d6cb2f4ad7"
                            "37323030d007aa505228cf4c29c9b055b25052c848cd4ccf280131ed6c8a52934b605226c852fa76"
                            "36207d76008d22c1025f000000";
    Diagnostics d;
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    const Result<Scene> scene = load_bytes(bytes, d);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_EQ(scene.value().extent.width, 8);
    EXPECT_EQ(scene.value().segments.size(), 4u);
    EXPECT_EQ(error_of(bytes.substr(0, bytes.size() / 2)), diag::kSvgBadGzip);
}

/// Some font of the machine, or nothing.
std::string any_font() {
    const std::filesystem::path folder = "/usr/share/fonts";
    if (!std::filesystem::exists(folder)) return {};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().filename() == "DejaVuSans.ttf") return entry.path().string();
    return {};
}

TEST(SvgInput, textBecomesOutlines) {
    const std::string font = any_font();
    if (font.empty()) GTEST_SKIP() << "DejaVuSans.ttf is not on this machine";
    SvgOptions options;
    options.font_files.push_back(font);
    Diagnostics d;
    const Result<Scene> scene =
        load("<text id='title' x='10' y='90' font-size='100' font-family='DejaVu Sans'>I</text>", d, options);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(d.empty());
    ASSERT_EQ(scene.value().shapes.size(), 1u);
    EXPECT_EQ(scene.value().elements[scene.value().nodes[0].element].name, "text#title");
    const double unit = static_cast<double>(scene.value().extent.lattice_w) / 100;
    const GroundTruth truth(scene.value());
    EXPECT_EQ(truth.color_at(25 * unit, 60 * unit).a, 1) << "the stem of the letter";
    EXPECT_EQ(truth.color_at(45 * unit, 60 * unit).a, 0);
}

TEST(SvgInput, resourcesOnlyFromTheirFolder) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fetexc_svg_resources";
    std::filesystem::create_directories(folder / "inside");
    const auto write = [](const std::filesystem::path& path) {
        std::ofstream(path)
            << "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><rect width='9' height='9'/></svg>";
    };
    write(folder / "inside" / "a.svg");
    write(folder / "outside.svg");
    SvgOptions options;
    options.resources_dir = folder / "inside";
    const auto shapes = [&](const std::string& href) {
        Diagnostics d;
        const Result<Scene> scene = load("<image width='90' height='90' href='" + href + "'/>", d, options);
        EXPECT_EQ(d.empty(), scene.ok() && !scene.value().shapes.empty());
        return scene.ok() ? scene.value().nodes.size() : 99;
    };
    EXPECT_GT(shapes("a.svg"), 0u);
    EXPECT_EQ(shapes("../outside.svg"), 0u);
    EXPECT_EQ(shapes((folder / "outside.svg").string()), 0u);
    std::filesystem::remove_all(folder);
}

// ---- findings ----

TEST(SvgFindings, textWithoutFontsNamesTheElement) {
    Diagnostics d;
    ASSERT_TRUE(load("<text id='title' x='10' y='20'>Hello</text>\n<text x='1' y='9'>x</text><text> </text>", d).ok());
    EXPECT_TRUE(reports(d, diag::kSvgTextWithoutFonts, "text#title"));
    EXPECT_TRUE(reports(d, diag::kSvgTextWithoutFonts, "text @ line 2"));
    EXPECT_EQ(d.size(), 2u);
}

TEST(SvgFindings, droppedFeatures) {
    Diagnostics d;
    ASSERT_TRUE(load("<rect id='r' width='9' height='9'><animate attributeName='x'/></rect><script>1</script>"
                     "<style>@media print { rect { fill: red } }</style><foreignObject id='f'/>"
                     "<use id='u' href='other.svg#a'/><path id='v' vector-effect='fixed-position' d='M0 0h1v1z'/>"
                     "<g id='p' style='mix-blend-mode:plus-lighter'><rect width='9' height='9'/></g>",
                     d)
                    .ok());
    EXPECT_TRUE(reports(d, diag::kSvgAnimation, "animate @ line 1"));
    EXPECT_TRUE(reports(d, diag::kSvgScript, "script @ line 1"));
    EXPECT_TRUE(reports(d, diag::kSvgMediaQuery, "style @ line 1"));
    EXPECT_TRUE(reports(d, diag::kSvgForeignObject, "foreignObject#f"));
    EXPECT_TRUE(reports(d, diag::kSvgExternalReference, "use#u"));
    EXPECT_TRUE(reports(d, diag::kSvgVectorEffect, "path#v"));
    EXPECT_TRUE(reports(d, diag::kSvgPlusLighter, "g#p"));
}

TEST(SvgFindings, manyOfAKindAreCounted) {
    Diagnostics d;
    std::string body;
    for (int i = 0; i < 50; ++i)
        body += "<text>t</text>";
    ASSERT_TRUE(load(body, d).ok());
    ASSERT_EQ(d.size(), 21u);
    EXPECT_EQ(d.back().message, "30 more like this");
}

TEST(SvgFindings, fillsKnowTheirElement) {
    Diagnostics d;
    const Result<Scene> scene = load("<g transform='scale(2)'><circle id='wheel' cx='20' cy='20' r='9'/></g>", d);
    ASSERT_TRUE(scene.ok());
    const Node& fill = scene.value().nodes.back();
    ASSERT_LT(fill.element, scene.value().elements.size());
    EXPECT_EQ(scene.value().elements[fill.element].name, "circle#wheel");
}

// ---- hostile input ----

TEST(SvgHostile, notAnSvg) {
    EXPECT_EQ(error_of(""), diag::kSvgMalformed);
    EXPECT_EQ(error_of("hello"), diag::kSvgMalformed);
    EXPECT_EQ(error_of("<html/>"), diag::kSvgMalformed);
    EXPECT_EQ(error_of("<svg xmlns='http://www.w3.org/2000/svg'>\xff\xfe</svg>"), diag::kSvgNotUtf8);
    EXPECT_EQ(error_of("\x1f\x8b garbage"), diag::kSvgBadGzip);
    EXPECT_EQ(error_of("<svg xmlns='http://www.w3.org/2000/svg' width='0' height='10'/>"), diag::kSvgNoSize);
    EXPECT_EQ(error_of("<svg xmlns='http://www.w3.org/2000/svg' width='-5' height='10'/>"), diag::kSvgNoSize);
}

TEST(SvgHostile, everyTruncationIsAnErrorOrADrawing) {
    const std::string svg =
        document("<defs><linearGradient id='a'><stop offset='.5' stop-color='red'/></linearGradient>"
                 "</defs><path d='M1 2C3 4 5 6 7 8A9 9 0 1 1 2 2z' fill='url(#a)' stroke='blue' "
                 "stroke-dasharray='1 2'/>");
    for (std::size_t n = 0; n < svg.size(); ++n)
        EXPECT_NE(error_of(svg.substr(0, n)), 0) << n;
    EXPECT_EQ(error_of(svg), 0);
}

TEST(SvgHostile, randomDamageNeverCrashes) {
    const std::string svg = document("<style>.a{fill:url(#g)}</style><radialGradient id='g' r='.4' fx='.2'><stop "
                                     "stop-color='red'/><stop offset='1'/></radialGradient><mask id='m'><circle r='50' "
                                     "fill='#fff'/></mask><g mask='url(#m)' transform='rotate(30) scale(2 .5)'><path "
                                     "class='a' stroke='#123' stroke-width='3' stroke-dasharray='5,1' d='M5 5 l20 3 "
                                     "q4,5 9 9 t 8 8 s 3 4 5 6 a 8 4 20 0 1 4 4 z'/><use href='#q' x='4'/></g><rect "
                                     "id='q' width='9' height='7' rx='2' clip-path='none' opacity='.4'/>");
    std::mt19937 random(11);
    for (int i = 0; i < 400; ++i) {
        std::string damaged = svg;
        for (int k = 0; k < 4; ++k)
            damaged[random() % damaged.size()] = static_cast<char>(random() % 128);
        const int code = error_of(damaged);
        EXPECT_TRUE(code == 0 || (code >= 1001 && code <= 1012) || (code >= 3001 && code <= 3005)) << code;
        EXPECT_NE(code, diag::kSvgInternal);
    }
}

TEST(SvgHostile, hugeAndBadNumbers) {
    for (const char* number : {"1e38", "-1e38", "1e300", "NaN", "inf", "1e-300", "99999999999999999999"}) {
        const std::string n = number;
        const std::string body =
            "<rect x='" + n + "' width='" + n + "' height='9'/><path d='M0 0L" + n + " 5L5 " + n + "A" + n + " 3 " + n +
            " 0 1 7 7z' stroke='red' stroke-width='" + n + "' stroke-dasharray='" + n + " 1' stroke-miterlimit='" + n +
            "'/><g transform='scale(" + n + ")'><circle r='" + n +
            "' stroke='red' stroke-width='1'/></g>"
            "<linearGradient id='a' x2='" +
            n + "' gradientTransform='scale(" + n + ")' spreadMethod='repeat'><stop/><stop offset='" + n +
            "' stop-color='red'/></linearGradient><rect width='9' height='9' fill='url(#a)'/>";
        const int code = error_of(document(body));
        EXPECT_TRUE(code == 0 || code == diag::kSvgTooManySegments) << number << " " << code;
    }
    for (const char* size : {"1e38", "1e-30", "1e300"}) {
        const std::string s = size;
        const int code = error_of("<svg xmlns='http://www.w3.org/2000/svg' width='" + s + "' height='" + s +
                                  "' viewBox='0 0 10 10'><circle r='5' stroke='red'/></svg>");
        EXPECT_TRUE(code == 0 || code == diag::kSvgNoSize || code == diag::kSceneExtentInvalid) << size << " " << code;
    }
}

TEST(SvgHostile, deepNesting) {
    std::string deep;
    for (int i = 0; i < 200000; ++i)
        deep += "<g>";
    EXPECT_EQ(error_of(document(deep)), diag::kSvgMalformed);
    for (int i = 0; i < 200000; ++i)
        deep += "</g>";
    EXPECT_EQ(error_of(document(deep)), diag::kSvgTooDeep);
    std::string fine;
    for (int i = 0; i < 400; ++i)
        fine += "<g opacity='.9'>";
    fine += "<rect width='9' height='9'/>";
    for (int i = 0; i < 400; ++i)
        fine += "</g>";
    const int code = error_of(document(fine));
    EXPECT_TRUE(code == 0 || code == diag::kSceneTooLarge) << code;
}

TEST(SvgHostile, deepReferences) {
    std::string chain = "<mask id='m0'><rect width='9' height='9' fill='#fff'/></mask>";
    for (int i = 1; i < 20000; ++i)
        chain += "<mask id='m" + std::to_string(i) + "'><rect width='9' height='9' mask='url(#m" +
                 std::to_string(i - 1) + ")'/></mask>";
    EXPECT_EQ(error_of(document(chain + "<rect width='9' height='9' mask='url(#m19999)'/>")), diag::kSvgTooDeep);
}

std::string laughs(const std::string& first, const std::string& open, const std::string& use,
                   const std::string& close) {
    std::string out = first;
    for (int i = 1; i < 12; ++i) {
        const auto with = [&](std::string text, int n) {
            for (std::size_t at; (at = text.find('%')) != std::string::npos;)
                text.replace(at, 1, std::to_string(n));
            return text;
        };
        out += with(open, i);
        for (int k = 0; k < 10; ++k)
            out += with(use, i - 1);
        out += close;
    }
    return out;
}

TEST(SvgHostile, billionLaughsThroughUse) {
    const std::string body =
        laughs("<g id='a0'><rect width='1' height='1'/></g>", "<g id='a%'>", "<use href='#a%'/>", "</g>");
    EXPECT_EQ(error_of(document(body + "<use href='#a11'/>")), diag::kSvgTooManyElements);
}

TEST(SvgHostile, billionLaughsThroughPatterns) {
    const std::string body =
        laughs("<pattern id='a0' width='1' height='1'><rect width='1' height='1'/></pattern>",
               "<pattern id='a%' width='1' height='1'>", "<rect width='1' height='1' fill='url(#a%)'/>", "</pattern>");
    EXPECT_EQ(error_of(document(body + "<rect width='9' height='9' fill='url(#a11)'/>")), diag::kSvgTooManyElements);
}

TEST(SvgHostile, billionLaughsThroughMasksClipsAndStyle) {
    const std::string masks = laughs("<mask id='a0'><rect width='1' height='1'/></mask>", "<mask id='a%'>",
                                     "<rect width='1' height='1' mask='url(#a%)'/>", "</mask>");
    EXPECT_EQ(error_of(document(masks + "<rect width='9' height='9' mask='url(#a11)'/>")), diag::kSvgTooManyElements);
    const std::string styled =
        laughs("<mask id='a0'><rect width='1' height='1'/></mask>", "<style>.c%{mask:url(#a%)}</style><mask id='a%'>",
               "<rect width='1' height='1' class='c%'/>", "</mask>");
    EXPECT_EQ(error_of(document(styled + "<rect width='9' height='9' class='c11'/>")), diag::kSvgTooManyElements);
}

TEST(SvgHostile, billionLaughsThroughEntities) {
    std::string svg = "<!DOCTYPE svg [<!ENTITY a0 'ha'>";
    for (int i = 1; i < 12; ++i) {
        svg += "<!ENTITY a" + std::to_string(i) + " '";
        for (int k = 0; k < 10; ++k)
            svg += "&a" + std::to_string(i - 1) + ";";
        svg += "'>";
    }
    svg += "]><svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><text>&a11;</text></svg>";
    EXPECT_EQ(error_of(svg), diag::kSvgMalformed);
}

TEST(SvgHostile, circularReferences) {
    EXPECT_EQ(error_of(document("<g id='a'><use href='#b'/></g><g id='b'><use href='#c'/></g><g id='c'><use href='#a'/>"
                                "</g>")),
              diag::kSvgTooManyElements)
        << "usvg gives up at its depth limit";
    EXPECT_EQ(
        error_of(document("<pattern id='p' width='9' height='9'><rect fill='url(#q)' width='9' height='9'/></pattern>"
                          "<pattern id='q' width='9' height='9'><rect fill='url(#r)' width='9' height='9'/></pattern>"
                          "<pattern id='r' width='9' height='9'><rect fill='url(#p)' width='9' height='9'/></pattern>"
                          "<rect width='9' height='9' fill='url(#p)'/>")),
        diag::kSvgTooDeep);
    EXPECT_EQ(error_of(document("<linearGradient id='a' href='#b'/><linearGradient id='b' href='#c'/><linearGradient "
                                "id='c' href='#b'/><rect width='9' height='9' fill='url(#a)'/>")),
              diag::kSvgTooDeep);
    EXPECT_EQ(error_of(document("<mask id='m'><rect width='9' height='9' mask='url(#m)'/></mask><rect width='9' "
                                "height='9' mask='url(#m)'/>")),
              0);
}

TEST(SvgHostile, limitsHaveTheirNumbers) {
    SvgOptions o;
    o.limits.bytes = 100;
    EXPECT_EQ(error_of(document("<rect/>"), o), diag::kSvgTooManyBytes);
    o = {};
    o.limits.segments = 50;
    std::string zigzag = "M0 0";
    for (int i = 0; i < 100; ++i)
        zigzag += "L" + std::to_string(i) + " " + std::to_string(i % 7);
    EXPECT_EQ(error_of(document("<path d='" + zigzag + "'/>"), o), diag::kSvgTooManySegments);
    EXPECT_EQ(error_of(document("<circle r='9' fill='none' stroke='red' stroke-dasharray='.1 .1'/>"), o),
              diag::kSvgTooManySegments);
    o = {};
    o.limits.elements = 10;
    std::string many;
    for (int i = 0; i < 100; ++i)
        many += "<rect/>";
    EXPECT_EQ(error_of(document(many), o), diag::kSvgTooManyElements);
    o = {};
    o.limits.raster_bytes = 1000;
    EXPECT_EQ(
        error_of(document("<filter id='f'><feFlood/></filter><rect width='90' height='90' filter='url(#f)'/>"), o),
        diag::kSvgTooManyPixels);
    o = {};
    o.font_files.push_back("/no/such/font.ttf");
    EXPECT_EQ(error_of(document("<rect/>"), o), diag::kSvgFontFile);
}

TEST(SvgHostile, slowDrawingsEndAtTheTimeLimit) {
    // Hundreds of wide blurs: minutes of work.
    std::string body = "<filter id='f' x='-1' y='-1' width='3' height='3'><feTurbulence numOctaves='50' "
                       "baseFrequency='.1'/><feGaussianBlur stdDeviation='50'/></filter>";
    for (int i = 0; i < 500; ++i)
        body += "<rect width='90' height='90' filter='url(#f)'/>";
    SvgOptions o;
    o.raster_pixels = 2048;
    o.limits.milliseconds = 500;
    const auto start = std::chrono::steady_clock::now();
    const int code = error_of(document(body), o);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_TRUE(code == diag::kSvgTimeout || code == diag::kSvgTooManyPixels) << code;
    EXPECT_LT(took.count(), 10);
}

TEST(SvgHostile, filesAreNotReadWithoutPermission) {
    Diagnostics d;
    ASSERT_TRUE(load("<image width='9' height='9' href='/etc/passwd'/><image width='9' height='9' "
                     "href='../../secret.png'/>",
                     d)
                    .ok());
    EXPECT_TRUE(reports(d, diag::kSvgParserMessage, ""));
}

} // namespace
} // namespace fetexc
