// SPDX-License-Identifier: GPL-3.0-or-later
/// The SVG front end on several threads: nothing but the time may depend on how many, errors and findings included.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/svg/svg.h"

namespace fetexc {
namespace {

constexpr unsigned kThreadCounts[] = {2, 3, 16, 0};

void write(std::ostream& out, const std::vector<GradientStop>& stops) {
    for (const GradientStop& s : stops)
        out << ' ' << s.offset << ':' << s.color.r << ',' << s.color.g << ',' << s.color.b << ',' << s.color.a;
}

void write(std::ostream& out, const Affine& m) {
    out << ' ' << m.a << ' ' << m.b << ' ' << m.c << ' ' << m.d << ' ' << m.e << ' ' << m.f;
}

struct PaintWriter {
    std::ostream& out;
    void operator()(const SolidPaint& p) const { write(out, {{0, p.color}}); }
    void operator()(const LinearPaint& p) const {
        write(out, p.canvas_to_unit);
        write(out, p.stops);
    }
    void operator()(const RadialPaint& p) const {
        write(out, p.canvas_to_gradient);
        write(out, p.stops);
    }
    void operator()(const RasterPaint& p) const {
        write(out, p.canvas_to_pixel);
        out << ' ' << p.width << ' ' << p.height;
        for (const std::uint8_t byte : p.rgba)
            out << ' ' << int{byte};
    }
};

void write_geometry(std::ostream& out, const Scene& scene) {
    for (const Segment& s : scene.segments) {
        out << "segment " << s.degree;
        for (int k = 0; k <= s.degree; ++k)
            out << ' ' << s.p[static_cast<std::size_t>(k)].x << ' ' << s.p[static_cast<std::size_t>(k)].y;
        out << '\n';
    }
    for (const Shape& s : scene.shapes)
        out << "shape " << s.first << ' ' << s.count << ' ' << static_cast<int>(s.rule) << ' ' << s.element << '\n';
    for (const Clip& c : scene.clips) {
        out << "clip " << c.parent;
        for (const ClipMember& m : c.members)
            out << ' ' << m.shape << ',' << m.clip;
        out << '\n';
    }
}

void write_tree(std::ostream& out, const Scene& scene) {
    for (const Node& n : scene.nodes)
        out << "node " << static_cast<int>(n.kind) << ' ' << n.end << ' ' << n.clip << ' ' << n.opacity << ' '
            << static_cast<int>(n.blend) << ' ' << n.mask << ' ' << n.isolated << ' ' << n.shape << ' ' << n.paint
            << ' ' << n.element << '\n';
    for (const Mask& m : scene.masks)
        out << "mask " << m.first << ' ' << m.end << ' ' << m.region_shape << ' ' << m.parent << '\n';
    for (const Paint& paint : scene.paints) {
        out << "paint " << paint.index();
        std::visit(PaintWriter{out}, paint);
        out << '\n';
    }
    for (const Element& e : scene.elements)
        out << "element " << e.name << '\n';
    out << scene.root_end << ' ' << scene.stats.layers_in << ' ' << scene.stats.layers_empty << ' '
        << scene.stats.segments_in << ' ' << scene.stats.vertices_in << ' ' << scene.stats.max_displacement << '\n';
}

/// Everything load_svg() has to say, as text.
std::string outcome(const std::string& body, SvgOptions options, unsigned threads) {
    const std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='100' "
        "height='100'>" +
        body + "</svg>";
    options.threads = threads;
    std::vector<Diagnostic> diagnostics;
    const Result<Scene> scene =
        load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, options, diagnostics);
    std::ostringstream out;
    out << std::hexfloat;
    for (const Diagnostic& d : diagnostics)
        out << "finding " << d.code << ' ' << d.message << " @ " << d.place << '\n';
    if (!scene) {
        out << "error " << scene.error().code << ' ' << scene.error().message << " @ " << scene.error().place << '\n';
        return out.str();
    }
    write_geometry(out, scene.value());
    write_tree(out, scene.value());
    return out.str();
}

std::string strokes(int count) {
    std::string body = "<g fill='none' stroke='navy' stroke-linejoin='round'>";
    for (int i = 0; i < count; ++i) {
        const std::string x = std::to_string(i % 50 * 2), y = std::to_string(i / 50 * 3);
        body += "<path stroke-width='." + std::to_string(i % 9 + 1) + "' d='M" + x + " " + y + "q9 1 3 7t-4 2l" +
                std::to_string(i % 5) + " 3z'/>";
    }
    return body + "</g>";
}

/// Strokes in all places and of all kinds that the walk treats differently.
const std::string kKinds = R"(
<defs><path id='wave' d='M5 5C20 0 20 20 40 10S70 30 90 5'/>
<linearGradient id='lg'><stop offset='0' stop-color='red'/><stop offset='1' stop-color='blue'/></linearGradient>
<pattern id='pat' width='7' height='7' patternUnits='userSpaceOnUse'><path d='M1 1q4 1 5 5' stroke='lime'/></pattern>
<mask id='m'><use href='#wave' stroke='white' fill='none' stroke-width='8'/></mask>
<filter id='f'><feGaussianBlur stdDeviation='1'/></filter></defs>
<use href='#wave' stroke='black' fill='none' stroke-width='3'/>
<use href='#wave' stroke='black' fill='none' stroke-width='3'/>
<use href='#wave' y='20' stroke='url(#lg)' fill='yellow' stroke-width='4' stroke-dasharray='5 2 1'/>
<use href='#wave' y='30' stroke='url(#pat)' fill='none' stroke-width='9'/>
<g transform='rotate(30) scale(2 .5)'>
<path d='M20 5A9 4 0 0 1 40 9' vector-effect='non-scaling-stroke' stroke='teal' fill='none' stroke-width='2'/>
<path d='M20 9A9 4 0 0 1 40 19' pathLength='10' stroke='teal' fill='none' stroke-dasharray='1 .5'/></g>
<circle id='fine' cx='50' cy='50' r='40' fill='none' stroke='red' stroke-dasharray='.00001 .00001'/>
<path id='dot' d='M50 50z' stroke='red'/><path d='M60 50z' stroke='red' stroke-linecap='round' stroke-width='4'/>
<path id='far' d='M0 0L1e38 1e38 3e38 0' stroke='red' stroke-width='1e38' fill='none'/>
<g transform='scale(1e35)'><g transform='scale(1e35)'><g transform='scale(1e35)'>
<g transform='scale(1e35)'><g transform='scale(1e35)'><g transform='scale(1e35)'>
<g transform='scale(1e35)'><g transform='scale(1e35)'><g transform='scale(1e35)'>
<path d='M0 0l1e30 3' stroke='red' stroke-width='3'/></g></g></g></g></g></g></g></g></g>
<g mask='url(#m)'><path d='M0 20h90v20' stroke='green' stroke-width='7' fill='none' paint-order='stroke'/></g>
<g filter='url(#f)'><path d='M0 90h90' stroke='green'/></g>
<path d='M0 95h90' stroke='green' visibility='hidden'/><g opacity='.5'><path d='M0 97h90' stroke='green'/></g>
<image width='30' height='30' href="data:image/svg+xml;utf8,&lt;svg xmlns='http://www.w3.org/2000/svg' width='30' height='30'&gt;&lt;path d='M2 2q20 0 9 9' stroke='red'/&gt;&lt;/svg&gt;"/>
)";

void expect_same(const std::string& body, const SvgOptions& options, const std::string& expected) {
    for (const unsigned threads : kThreadCounts)
        EXPECT_TRUE(outcome(body, options, threads) == expected) << threads << " threads";
}

TEST(SvgThreads, everyKindOfStrokeIsTheSame) {
    SvgOptions options;
    options.raster_pixels = 64;
    const std::string expected = outcome(kKinds, options, 1);
    EXPECT_NE(expected.find("finding " + std::to_string(diag::kSvgDashTooFine)), std::string::npos);
    EXPECT_NE(expected.find("finding " + std::to_string(diag::kSvgBadGeometry)), std::string::npos);
    EXPECT_NE(expected.find("segment "), std::string::npos);
    expect_same(kKinds, options, expected);
}

TEST(SvgThreads, manyStrokesAreTheSame) {
    const std::string body = strokes(1000);
    expect_same(body, {}, outcome(body, {}, 1));
}

TEST(SvgThreads, findingsBeyondTheFirstFewAreTheSame) {
    std::string body;
    for (int i = 0; i < 60; ++i)
        body += "<circle id='c" + std::to_string(i) + "' r='" + std::to_string(40 + i % 7) +
                "' fill='none' stroke='red' stroke-dasharray='.0000" + std::to_string(i % 9 + 1) + "'/>";
    const std::string expected = outcome(body, {}, 1);
    EXPECT_NE(expected.find("40 more like this"), std::string::npos);
    expect_same(body, {}, expected);
}

TEST(SvgThreads, limitsAreTheSame) {
    const std::string body = strokes(40) + kKinds;
    bool loaded = false, refused = false;
    for (std::uint64_t segments = 50; segments < 20'000; segments = segments * 3 / 2) {
        SvgOptions options;
        options.raster_pixels = 64;
        options.limits.segments = segments;
        const std::string expected = outcome(body, options, 1);
        (expected.find("error ") == std::string::npos ? loaded : refused) = true;
        expect_same(body, options, expected);
    }
    EXPECT_TRUE(loaded && refused);
}

TEST(SvgThreads, aLimitBetweenTwoRunsOfOneStrokeIsExact) {
    const std::string body = "<circle r='40' fill='none' stroke='red' stroke-dasharray='1'/>" + strokes(5);
    SvgOptions options;
    std::uint64_t low = 1, high = 4'000'000; // refused, loaded
    while (high - low > 1) {
        options.limits.segments = (low + high) / 2;
        (outcome(body, options, 1).starts_with("error") ? low : high) = options.limits.segments;
    }
    options.limits.segments = low;
    expect_same(body, options, outcome(body, options, 1));
    options.limits.segments = high;
    expect_same(body, options, outcome(body, options, 1));
}

/// Filled shapes of every kind, some twice, enough for their reading to be spread over threads.
std::string fills(int count) {
    std::string body;
    for (int i = 0; i < count; ++i) {
        const std::string x = std::to_string(i % 50 * 2), y = std::to_string(i % 70), id = std::to_string(i);
        body += "<path id='p" + id + "' d='M" + x + " " + y + "h3l1 4a2 1 10 0 1 3 1z'/><path d='M" + x +
                " 3q4 1 3 7t1 2z'/>";
        body += "<circle cx='" + x + "' cy='" + y + "' r='2'/><polygon points='" + y + " 1 4 " + x + " 9 9'/>";
        body += "<rect x='" + x + "' width='3' height='4' rx='1'/><use href='#p" + id + "' y='1'/>";
    }
    return body;
}

TEST(SvgThreads, manyFillsAreTheSame) {
    const std::string body = fills(200);
    expect_same(body, {}, outcome(body, {}, 1));
}

TEST(SvgThreads, shapesReadBesideTheParserAreTheSame) {
    std::string body; // no arcs: nothing can exceed the limit
    for (int i = 0; i < 400; ++i)
        body += "<path id='p" + std::to_string(i % 300) + "' d='M" + std::to_string(i % 90) + " 3q4 1 3 7.25t1 2z'/>" +
                "<circle r='" + std::to_string(i % 7) + ".3' transform='translate(" + std::to_string(i) + ".7)'/>";
    expect_same(body, {}, outcome(body, {}, 1));
    const std::string broken = body + "<image href='data:image/svg+xml;utf8,&lt;svg'/><use href='#none'/>";
    expect_same(broken, {}, outcome(broken, {}, 1));
}

TEST(SvgThreads, aLimitWhileShapesAreReadIsExact) {
    const std::string body = "<defs>" + fills(200) + "</defs><path d='M0 0h9v9z'/>"; // read, but not drawn
    SvgOptions options;
    std::uint64_t low = 1, high = 4'000'000; // refused, loaded
    while (high - low > 1) {
        options.limits.segments = (low + high) / 2;
        (outcome(body, options, 1).starts_with("error") ? low : high) = options.limits.segments;
    }
    for (const std::uint64_t segments : {std::uint64_t{1}, low / 2, low, high}) {
        options.limits.segments = segments;
        const std::string expected = outcome(body, options, 1);
        EXPECT_EQ(expected.starts_with("error " + std::to_string(diag::kSvgTooManySegments)), segments <= low);
        expect_same(body, options, expected);
    }
}

TEST(SvgThreads, hostileDashesEndAtTheLimit) {
    std::string body;
    for (int i = 0; i < 2000; ++i)
        body += "<circle r='45' fill='none' stroke='red' stroke-dasharray='.01 .01'/>";
    SvgOptions options;
    options.limits.segments = 400'000;
    const std::string expected = outcome(body, options, 1);
    EXPECT_TRUE(expected.starts_with("error " + std::to_string(diag::kSvgTooManySegments))) << expected.substr(0, 200);
    expect_same(body, options, expected);
}

} // namespace
} // namespace fetexc
