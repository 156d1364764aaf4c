// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps from drawings and images: valid, sharp, with signals that don't mix sides, and honest about what is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/measure/alternatives.h"
#include "compiler/measure/errors.h"
#include "compiler/pinchmap/pinchmap_builder.h"
#include "compiler/pinchmap/pinchmap_sizes.h"
#include "formats/validate.h"
#include "tests/support/art_scenes.h"
#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using fetex::PinchmapFormat;
using fetex::PinchmapSampleFormat;
using test::art;
using test::kShapes;
using test::scene_of_svg;

PinchmapOptions options_of(std::uint32_t side, std::uint32_t scale = 0) {
    PinchmapOptions options;
    options.size = {side, side}, options.scale = scale, options.threads = 0;
    return options;
}

/// Without features.
const FeatureCurves kNoFeatures;

Result<PinchmapBuild> compile_pinchmap(const RasterImage& image, const PinchmapOptions& options) {
    return fetexc::compile_pinchmap(PinchedImage{image, kNoFeatures}, options);
}

template <class Input> PinchmapBuild build(const Input& input, const PinchmapOptions& options) {
    auto made = compile_pinchmap(input, options);
    EXPECT_TRUE(made.ok()) << made.error().message;
    const auto findings = fetex::validate_pinchmap(made.value().texture, 1);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    return std::move(made).value();
}

bool says(const PinchmapBuild& b, int code) {
    return std::ranges::any_of(b.diagnostics, [&](const Diagnostic& d) { return d.code == code; });
}

TEST(PinchmapBuilder, allFormatsAreValid) {
    const Scene scene = art("yin_yang");
    for (const PinchmapFormat format : {PinchmapFormat::Bits8, PinchmapFormat::Bits16}) {
        for (const PinchmapSampleFormat samples : {PinchmapSampleFormat::Rgba8, PinchmapSampleFormat::Rgba16,
                                                   PinchmapSampleFormat::Rgba16F, PinchmapSampleFormat::Rgb8}) {
            PinchmapOptions options = options_of(21, 1);
            options.map_format = format, options.sample_format = samples, options.mips = true;
            const PinchmapBuild b = build(scene, options);
            EXPECT_EQ(b.stats.gpu_bytes, pinchmap_bytes(options));
            EXPECT_EQ(b.texture.width, 21u);
            EXPECT_EQ(fetex::pinchmap_signal_width(b.texture), 42u);
        }
    }
}

TEST(PinchmapBuilder, isTheSameForAnyThreads) {
    const Scene scene = art("lighthouse");
    PinchmapOptions options = options_of(40);
    options.mips = true, options.threads = 1;
    const PinchmapBuild one = build(scene, options);
    options.threads = 4;
    const PinchmapBuild four = build(scene, options);
    EXPECT_EQ(one.texture.map, four.texture.map);
    EXPECT_EQ(one.texture.signal, four.texture.signal);
    EXPECT_EQ(one.texture.mips, four.texture.mips);
    EXPECT_EQ(one.diagnostics.size(), four.diagnostics.size());
}

int largest_difference(std::uint32_t a, std::uint32_t b) {
    int largest = 0;
    for (unsigned shift = 0; shift < 32; shift += 8)
        largest =
            std::max(largest, std::abs(static_cast<int>(a >> shift & 0xff) - static_cast<int>(b >> shift & 0xff)));
    return largest;
}

/// Two colours: every sample has one of them, within a step.
TEST(PinchmapBuilder, signalsDontMixSides) {
    for (const std::uint32_t scale : {0u, 1u, 2u}) {
        const PinchmapBuild b = build(art("alternatives/icon"), options_of(32, scale));
        EXPECT_EQ(b.stats.signal.lost, 0);
        const std::vector<std::uint32_t>& signal = b.texture.signal;
        const auto other = std::ranges::find_if(
            signal, [&](std::uint32_t sample) { return largest_difference(sample, signal[0]) > 100; });
        ASSERT_NE(other, signal.end());
        std::size_t colors[2] = {0, 0};
        for (const std::uint32_t sample : signal) {
            const bool first = largest_difference(sample, signal[0]) <= 1;
            ASSERT_TRUE(first || largest_difference(sample, *other) <= 1);
            ++colors[first ? 0 : 1];
        }
        EXPECT_GT(colors[0], 100u);
        EXPECT_GT(colors[1], 100u);
    }
}

const char* const kGradients = R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="320" height="320">
<linearGradient id="a" gradientUnits="userSpaceOnUse" x1="0" y1="0" x2="320" y2="100"><stop stop-color="#203040"/><stop offset="1" stop-color="#90d0ff"/></linearGradient>
<linearGradient id="b" gradientUnits="userSpaceOnUse" x1="0" y1="0" x2="0" y2="320"><stop stop-color="#fff0c0"/><stop offset="1" stop-color="#c02010"/></linearGradient>
<rect width="320" height="320" fill="url(#a)"/><path d="M-10 97 C 120 20 190 240 340 131 V 400 H -10 Z" fill="url(#b)"/></svg>)svg";

/// Gradients go on up to the edge between them: no sample has half of the other side, nor is drawn to one half of its
/// surroundings as a mean of them would be.
TEST(PinchmapBuilder, gradientsReachTheEdge) {
    const Scene scene = scene_of_svg(kGradients);
    const PinchmapBuild b = build(scene, options_of(20));
    const auto truth = measure::Truth::of(scene, 0);
    double largest = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 200; ++x) {
            const measure::TexturePoint p{(x + 0.5) / 200, (y + 0.5) / 200};
            if (truth.value()->edge_within(p, 0.004)) continue; // a twelfth of a cluster
            const Rgba right = truth.value()->color(truth.value()->result_at(p), p);
            const fetex::FbtColor c = fetex::pinchmap_sample(b.texture, p.u * 20, p.v * 20);
            largest = std::max({largest, std::abs(c.r - right.r), std::abs(c.g - right.g), std::abs(c.b - right.b)});
        }
    }
    EXPECT_LE(largest, 0.03);
}

/// A dot of a tenth of a cluster: named with its area and place, and blurred.
TEST(PinchmapBuilder, whatIsTooSmallIsNamed) {
    const std::string text =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="320" height="320"><rect width="320" height="320" fill="#fff"/>
<rect x="200" y="0" width="200" height="320"/><rect x="73" y="153" width="4" height="4"/></svg>)svg";
    const PinchmapBuild b = build(scene_of_svg(text), options_of(32));
    EXPECT_TRUE(says(b, diag::kPinchmapPartsLost));
    EXPECT_NEAR(b.stats.signal.lost, 16.0 / 320 / 320, 4e-5);
    EXPECT_NEAR(b.stats.signal.lost_u, 75.0 / 320, 0.01);
    EXPECT_NEAR(b.stats.signal.lost_v, 155.0 / 320, 0.01);
    const fetex::FbtColor there = fetex::pinchmap_sample(b.texture, 7.5, 15.5);
    EXPECT_GT(there.r, 0.5);
    EXPECT_LT(there.r, 0.97);
    EXPECT_FALSE(says(build(art("alternatives/icon"), options_of(32)), diag::kPinchmapPartsLost));
}

/// Stripes of a third of a cluster: blurred everywhere, to their mean, and said so. A shape with room has none such.
TEST(PinchmapBuilder, crowdedEdgesAreBlurred) {
    std::string text =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="320" height="320"><rect width="320" height="320" fill="#fff"/>)svg";
    for (int k = 0; k < 20; ++k)
        text += "<rect x='" + std::to_string(100 + 6 * k) + "' y='60' width='3' height='200'/>";
    const PinchmapBuild b = build(scene_of_svg(text + "</svg>"), options_of(32));
    EXPECT_GT(b.stats.lost_edges.texels, 50u);
    EXPECT_GT(b.stats.lost_edges.worst, 0.5);
    EXPECT_TRUE(says(b, diag::kPinchmapPartsLost));
    EXPECT_TRUE(fetex::pinchmap_is_open(b.texture));
    double sum = 0;
    for (int k = 0; k < 100; ++k)
        sum += fetex::pinchmap_sample(b.texture, 12 + 0.08 * k, 16.3).r;
    EXPECT_NEAR(sum / 100, 0.5, 0.1);
    EXPECT_EQ(build(art("alternatives/gear_logo"), options_of(32)).stats.lost_edges.texels, 0u);
}

class SampledPinchmap final : public measure::Picture {
  public:
    explicit SampledPinchmap(const fetex::PinchmapTexture& t) : t_(t) {}
    [[nodiscard]] Rgba at(measure::TexturePoint p) const override {
        const fetex::FbtColor c = fetex::pinchmap_sample(t_, p.u * t_.width, p.v * t_.height);
        return {c.r, c.g, c.b, c.a};
    }
    [[nodiscard]] GridSize texels() const override { return {t_.width, t_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return fetex::pinchmap_gpu_bytes(t_); }

  private:
    const fetex::PinchmapTexture& t_;
};

/// The largest error of a colour away from edges, of 255.
double worst_color(const Scene& scene, const PinchmapBuild& b) {
    const auto truth = measure::Truth::of(scene, 0);
    measure::MeasureOptions options;
    options.sizes = {{128, 128}}, options.threads = 0;
    options.figures = measure::Figures::none();
    options.figures.away = true;
    const auto measurer = measure::Measurer::of(*truth.value(), options);
    return 255 * measurer.value().measure(SampledPinchmap(b.texture))[0].away.max;
}

/// Circles and gradients in many colours: zones that are worth it elsewhere leave no hole or isle in other places.
TEST(PinchmapBuilder, zonesLeaveNoSpots) {
    const Scene discs = art("discs");
    const PinchmapBuild b = build(discs, options_of(40));
    EXPECT_LE(worst_color(discs, b), 20);
    EXPECT_LE(b.stats.wrong_area, 8.3e-3);
}

/// Three colours that all touch: two zones can't hold them.
TEST(PinchmapBuilder, edgesInAZoneAreNamed) {
    const std::string text =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="100" height="100" fill="#fff"/>
<rect width="50" height="50" fill="#00f"/><rect x="50" width="50" height="50" fill="#0a0"/></svg>)svg";
    const PinchmapBuild b = build(scene_of_svg(text), options_of(16));
    EXPECT_GE(b.stats.edges_blurred, 1u);
    EXPECT_TRUE(says(b, diag::kPinchmapEdgesBlurred));
    const auto said =
        std::ranges::find(b.diagnostics, static_cast<int>(diag::kPinchmapEdgesBlurred), &Diagnostic::code);
    EXPECT_NE(said->message.find(" % of all by length and contrast; the one that shows most is at u,v "),
              std::string::npos);
    const std::string two =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><rect width="100" height="100" fill="#fff"/>
<rect x="10" y="10" width="40" height="50" fill="#00f"/><rect x="60" y="20" width="30" height="50" fill="#0a0"/></svg>)svg";
    const PinchmapBuild c = build(scene_of_svg(two), options_of(16));
    EXPECT_EQ(c.stats.edges_blurred, 0u);
    EXPECT_FALSE(says(c, diag::kPinchmapEdgesBlurred));
}

/// Two squares that touch in a corner: named, with how much that blurs.
TEST(PinchmapBuilder, crossingsAreNamed) {
    const std::string text =
        R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="160" height="160"><rect width="160" height="160" fill="#fff"/>
<rect x="20" y="20" width="60" height="60"/><rect x="80" y="80" width="60" height="60"/></svg>)svg";
    const PinchmapBuild b = build(scene_of_svg(text), options_of(16));
    EXPECT_EQ(b.stats.crosses, 1u);
    const auto said = std::ranges::find(b.diagnostics, static_cast<int>(diag::kPinchmapCrosses), &Diagnostic::code);
    ASSERT_NE(said, b.diagnostics.end());
    EXPECT_EQ(said->message,
              "1 crossings of edges are blurred, about 1953.1 ppm of the drawing; one is at u,v 0.5000,0.5000");
}

/// A disc whose alpha falls within `pixels`, of one gradient.
RasterImage disc(std::uint32_t side, double pixels) {
    return test::image_of(side, side, [&](double x, double y) {
        const double from = std::hypot(x - side / 2.0, y - side / 2.0) - side * 0.31;
        const double a = std::clamp(0.5 - from / pixels, 0.0, 1.0), g = x / side;
        return Rgba{a * g, a * 0.5, a * (1 - g), a};
    });
}

TEST(PinchmapBuilder, softTransitionsArentCut) {
    const PinchmapBuild hard = build(disc(512, 1), options_of(16)), soft = build(disc(512, 12), options_of(16));
    EXPECT_EQ(hard.stats.soft_texels, 0u);
    EXPECT_FALSE(fetex::pinchmap_is_open(hard.texture));
    EXPECT_EQ(soft.stats.soft_texels, soft.stats.active);
    // Across the edge at the right: in a sixteenth of a cluster from one side to the other, or not.
    const auto step = [](const PinchmapBuild& b) {
        double largest = 0;
        for (double x = 11; x < 15; x += 1.0 / 16)
            largest = std::max(largest, std::abs(fetex::pinchmap_sample(b.texture, x, 8.2).a -
                                                 fetex::pinchmap_sample(b.texture, x + 1.0 / 16, 8.2).a));
        return largest;
    };
    EXPECT_GT(step(hard), 0.95);
    EXPECT_LT(step(soft), 0.2);
}

PinchmapBuild build_featured(const RasterImage& image, std::vector<CanvasContour> runs) {
    const FeatureCurves features{static_cast<double>(image.width), static_cast<double>(image.height), std::move(runs)};
    auto made = fetexc::compile_pinchmap(PinchedImage{image, features}, options_of(32));
    EXPECT_TRUE(made.ok()) << made.error().message;
    const auto findings = fetex::validate_pinchmap(made.value().texture, 1);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    return std::move(made).value();
}

/// Opaque, of two greys; their edge is a pixel wide on the left and becomes softer to the right, up to 24 pixels.
RasterImage softening() {
    return test::image_of(512, 512, [](double x, double y) {
        const double pixels = 1 + 23 * std::clamp((x - 160) / 192, 0.0, 1.0);
        return test::grey(0.5 + 0.3 * std::clamp((y - 250) / pixels, -0.5, 0.5));
    });
}

double strength_of(const fetex::PinchmapTexture& t, std::uint32_t i, std::uint32_t j) {
    const fetex::PinchmapTexel texel = fetex::pinchmap_texel(t, i, j);
    return texel.k == 0 ? std::max(std::abs(texel.du), std::abs(texel.dv)) : -1;
}

/// The strength of the active texel in a column.
double strength_in_column(const fetex::PinchmapTexture& t, std::uint32_t i) {
    double strength = -1;
    for (std::uint32_t j = 0; j <= t.height; ++j)
        strength = std::max(strength, strength_of(t, i, j));
    return strength;
}

void expect_taper(const PinchmapBuild& b) {
    ASSERT_EQ(b.texture.width, 32u);
    for (std::uint32_t i = 0; i <= 10; ++i)
        EXPECT_EQ(strength_in_column(b.texture, i), 1) << i;
    for (std::uint32_t i = 10; i < 14; ++i)
        EXPECT_GE(strength_in_column(b.texture, i), strength_in_column(b.texture, i + 1)) << i;
    for (std::uint32_t i = 14; i <= 32; ++i)
        EXPECT_EQ(strength_in_column(b.texture, i), 0) << i;
    const auto step = [&](double x) {
        double largest = 0;
        for (double y = 14; y < 17; y += 1.0 / 16)
            largest = std::max(largest, std::abs(fetex::pinchmap_sample(b.texture, x, y).r -
                                                 fetex::pinchmap_sample(b.texture, x, y + 1.0 / 16).r));
        return largest;
    };
    EXPECT_GT(step(3.3), 0.29);
    EXPECT_LT(step(25.3), 0.06);
}

/// Colours without alpha, of a silhouette of their own and of features: sharp where the image is, and no longer where
/// it isn't, and that is said.
TEST(PinchmapBuilder, softTransitionsOfColorsArentCut) {
    const PinchmapBuild b = build(softening(), options_of(32));
    expect_taper(b);
    EXPECT_TRUE(says(b, diag::kPinchmapEdgesBlurred));
    EXPECT_GE(b.stats.soft_edges.texels, 18u);
    EXPECT_EQ(b.stats.soft_edges.texels, b.stats.soft_texels);
    EXPECT_GT(b.stats.soft_edges.widest, 10);
    EXPECT_GT(b.stats.soft_edges.u, 0.5);
    PinchmapOptions options = options_of(32);
    options.silhouette = SilhouetteRule{SilhouetteRule::Kind::Luminance, ""};
    expect_taper(build(softening(), options));
    expect_taper(build_featured(softening(), {test::polyline({{0, 250}, {512, 250}})}));
}

/// An edge that is sharp is so whatever its contrast, beside noise and where a feature lies a pixel beside it.
TEST(PinchmapBuilder, faintEdgesAreSharp) {
    std::uint32_t state = 1;
    const RasterImage image = test::image_of(512, 512, [&](double /*x*/, double y) {
        state = state * 1664525 + 1013904223;
        return test::grey(0.5 + (y < 250 ? 0.02 : -0.02) + 0.004 * (state >> 8) / 0x1p24);
    });
    const PinchmapBuild b = build_featured(image, {test::polyline({{0, 251}, {512, 251}})});
    EXPECT_EQ(b.stats.soft_texels, 0u);
    EXPECT_FALSE(says(b, diag::kPinchmapEdgesBlurred));
}

/// Bright above and dark below y = 256 on the left, less and less so up to x = 320; one grey on the right of that.
RasterImage crease() {
    return test::image_of(512, 512, [](double x, double y) {
        const double contrast = std::clamp((320 - x) / 200, 0.0, 1.0);
        return test::grey(0.5 + (y < 256 ? 0.4 : -0.4) * contrast);
    });
}

/// A feature that ends in the image: sharp where it begins, at the border, and no longer where it ends.
TEST(PinchmapBuilder, openFeaturesTaper) {
    const PinchmapBuild b = build_featured(crease(), {test::polyline({{0, 256}, {320, 256}})});
    const auto step = [&](double x) {
        return fetex::pinchmap_sample(b.texture, x, 15.99).r - fetex::pinchmap_sample(b.texture, x, 16.01).r;
    };
    const auto strength = [&](std::uint32_t i) {
        const fetex::PinchmapTexel t = fetex::pinchmap_texel(b.texture, i, 16);
        return t.k == 0 ? std::max(std::abs(t.du), std::abs(t.dv)) : 0;
    };
    EXPECT_NEAR(step(0.5), 0.8, 0.01);
    EXPECT_NEAR(step(15.5), 0.8 * (320 - 248) / 200, 0.02);
    EXPECT_LE(std::abs(step(20)), 0.02);
    for (std::uint32_t i = 0; i <= 18; ++i)
        EXPECT_EQ(strength(i), 1) << i;
    EXPECT_NEAR(strength(19), 0.5, 0.01);
    EXPECT_EQ(strength(20), 0);
    EXPECT_GT(b.stats.soft_texels, 10u);
    // What closes it pinches nothing: the picture is the image there.
    double largest = 0;
    for (double y = 4; y < 28; y += 0.17) {
        for (double x = 17; x < 31; x += 0.19) {
            const double contrast = std::clamp((20 - x) / 12.5, 0.0, 1.0),
                         truth = 0.5 + (y < 16 ? 0.4 : -0.4) * contrast;
            largest = std::max(largest, std::abs(fetex::pinchmap_sample(b.texture, x, y).r - truth));
        }
    }
    EXPECT_LE(largest, 0.15); // half of what fades within the last two clusters
}

/// From border to border nothing has to be closed inside; closed curves don't either, and one in another is a hole.
TEST(PinchmapBuilder, featuresFromBorderToBorderArentSoft) {
    const RasterImage image =
        test::image_of(512, 512, [](double x, double y) { return test::grey(x + 0.3 * y < 300 ? 0.9 : 0.2); });
    const PinchmapBuild b = build_featured(image, {test::polyline({{300, 0}, {300 - 0.3 * 512, 512}})});
    EXPECT_EQ(b.stats.soft_texels, 0u);
    EXPECT_GT(b.stats.active, 30u);
    EXPECT_LE(b.stats.wrong_area * 1e6, 300);
    const std::vector<CanvasPoint> outer{{90, 90}, {420, 90}, {420, 420}, {90, 420}, {90, 90}},
        inner{{200, 200}, {200, 310}, {310, 310}, {310, 200}, {200, 200}};
    const PinchmapBuild ring = build_featured(test::image_of(512, 512,
                                                             [](double x, double y) {
                                                                 const double d =
                                                                     std::max(std::abs(x - 255), std::abs(y - 255));
                                                                 return test::grey(d < 165 && d > 55 ? 0.1 : 0.8);
                                                             }),
                                              {test::polyline(outer), test::polyline(inner)});
    EXPECT_EQ(ring.stats.soft_texels, 0u);
    EXPECT_NEAR(fetex::pinchmap_sample(ring.texture, 16, 16).r, 0.8, 0.01);
    EXPECT_NEAR(fetex::pinchmap_sample(ring.texture, 8, 16).r, 0.1, 0.01);
    EXPECT_NEAR(fetex::pinchmap_sample(ring.texture, 2, 2).r, 0.8, 0.01);
}

/// The paper's case, §7.3: as good as from the drawing, and no pixel that mixes both sides gets into the signal.
TEST(PinchmapBuilder, imagesAreAsGoodAsDrawings) {
    const PinchmapBuild b = build(disc(1024, 1), options_of(32));
    EXPECT_LE(b.stats.wrong_area * 1e6, 150);
    for (const std::uint32_t sample : b.texture.signal) {
        const std::uint32_t alpha = sample >> 24;
        EXPECT_TRUE(alpha <= 1 || alpha >= 254) << alpha;
    }
}

TEST(PinchmapBuilder, sizesOfItsOwnChoice) {
    const Scene scene = art("alternatives/glyph_g");
    const auto within = compile_pinchmap_at_chosen_size(scene, options_of(0), 20000, 0);
    ASSERT_TRUE(within.ok());
    EXPECT_LE(within.value().stats.gpu_bytes, 20000u);
    EXPECT_GE(within.value().stats.gpu_bytes, 18000u);
    const auto good = compile_pinchmap_at_chosen_size(scene, options_of(0), 0, 4e-4);
    ASSERT_TRUE(good.ok());
    EXPECT_LE(good.value().stats.wrong_area, 4e-4);
    EXPECT_LE(good.value().texture.width, 70u);
    const auto chosen = compile_pinchmap_at_chosen_size(scene, options_of(0), 0, 0);
    EXPECT_LE(chosen.value().stats.wrong_area, budget::kPinchmapChosenError);
    EXPECT_EQ(compile_pinchmap_at_chosen_size(scene, options_of(0), 10, 0).error().code, diag::kPinchmapBudget);
    EXPECT_EQ(compile_pinchmap_at_chosen_size(scene, options_of(0), 5000, 1e-5).error().code,
              diag::kPinchmapErrorUnmet);
}

TEST(PinchmapBuilder, refusesSizes) {
    const Scene scene = art("alternatives/star");
    EXPECT_EQ(compile_pinchmap(scene, options_of(0)).error().code, diag::kSizeOutOfRange);
    EXPECT_EQ(compile_pinchmap(scene, options_of(16384, 1)).error().code, diag::kSizeOutOfRange);
    EXPECT_EQ(compile_pinchmap(disc(16, 1), options_of(20000)).error().code, diag::kSizeOutOfRange);
}

/// §7.3's comparison, over six shapes: against a bitmap of eight times the memory, at two magnifications.
TEST(PinchmapBuilder, betterThanABitmapOfEightTimesTheMemory) {
    for (const std::uint32_t magnification : {4u, 16u}) {
        double area_logs[2] = {0, 0}, psnr[2] = {0, 0};
        int better_areas = 0, better_psnrs = 0;
        for (const char* name : kShapes) {
            const Scene scene = art(std::string("alternatives/") + name);
            const PinchmapBuild b = build(scene, options_of(32));
            const auto truth = measure::Truth::of(scene, 0);
            const auto bitmap = measure::make_alternative(*truth.value(), measure::Alternative::Bitmap, {128, 128}, 0);
            EXPECT_GT(bitmap.value()->gpu_bytes(), 7.7 * b.stats.gpu_bytes);
            measure::MeasureOptions options;
            options.sizes = {{32 * magnification, 32 * magnification}}, options.threads = 0;
            options.figures = measure::Figures::none();
            options.figures.misclassified = options.figures.psnr = true;
            const auto measurer = measure::Measurer::of(*truth.value(), options);
            const SampledPinchmap ours(b.texture);
            const measure::Picture* const pictures[] = {&ours, bitmap.value().get()};
            measure::SizeErrors errors[2];
            for (std::size_t k = 0; k < 2; ++k) {
                const measure::SizeErrors& e = errors[k] = measurer.value().measure(*pictures[k])[0];
                area_logs[k] += std::log(std::max(e.misclassified_ppm, 1.0)), psnr[k] += e.psnr;
                std::printf("  x%u %-12s %s %7.0f ppm %6.2f dB\n", magnification, name,
                            k == 0 ? "pinchmap" : "bitmap  ", e.misclassified_ppm, e.psnr);
            }
            better_areas += errors[0].misclassified_ppm < errors[1].misclassified_ppm;
            better_psnrs += errors[0].psnr > errors[1].psnr;
        }
        const double count = std::size(kShapes);
        std::printf("  x%u mean: %.0f ppm, %.2f dB; bitmap %.0f ppm, %.2f dB\n", magnification,
                    std::exp(area_logs[0] / count), psnr[0] / count, std::exp(area_logs[1] / count), psnr[1] / count);
        EXPECT_LT(area_logs[0], area_logs[1] + count * std::log(0.7));
        EXPECT_GT(psnr[0], psnr[1] + 5 * count);
        EXPECT_GE(better_areas, 4); // not gear_logo's corners and yin_yang's ring: compiler/pinchmap/README.md
        EXPECT_GE(better_psnrs, magnification == 4 ? 5 : 6);
    }
}

} // namespace
} // namespace fetexc
