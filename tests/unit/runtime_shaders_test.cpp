// SPDX-License-Identifier: GPL-3.0-or-later
/// Every shader in every dialect and specialisation goes through Khronos's compiler, and the Vulkan ones through
/// spirv-cross to HLSL, MSL and ES. Skips, and says so, where the tools aren't installed.
#include "runtime_glsl/host/renderer.h"
#include "tests/support/shader_test.h"

namespace fetex {
namespace {

namespace fs = std::filesystem;

using fetexc::test::compiler_of;
using fetexc::test::expect_plain_ascii;
using fetexc::test::text_of;
using Shaders = fetexc::test::ShaderTest;

FbtTexture needing(std::uint32_t degrees, std::uint32_t switches, std::uint32_t directions) {
    FbtTexture t;
    t.traits.degrees = degrees;
    t.traits.bands = switches & 1u;
    t.traits.corners = switches & 2u;
    t.traits.translucent = switches & 4u;
    t.traits.patches = switches & 8u;
    t.traits.shared = switches & 16u;
    t.traits.directions = directions;
    t.traits.max_entries = degrees == 0 && (switches & 4u) == 0 ? 0 : 3; // bands of one region each have no degree
    return t;
}

/// What an asset can need: all sets of degrees with bands, corners, alpha, patches, shared points; all kinds of ray
/// sets; and all formats of samples.
std::vector<FbtTexture> all_specialisations() {
    std::vector<FbtTexture> all;
    for (std::uint32_t degrees = 0; degrees < 16; degrees += 2)
        for (std::uint32_t switches = 0; switches < 32; ++switches)
            all.push_back(needing(degrees, switches, 15));
    for (const std::uint32_t directions : {1u, 2u, 4u, 8u, 3u, 12u, 5u, 10u})
        all.push_back(needing(14, 31, directions));
    for (const FbtSampleFormat format : {FbtSampleFormat::Rgba16, FbtSampleFormat::Rgba16F}) {
        for (const std::uint32_t degrees : {0u, 14u}) {
            for (std::uint32_t switches = 0; switches < 32; ++switches) {
                all.push_back(needing(degrees, switches, 15));
                all.back().sample_format = format;
            }
        }
    }
    return all;
}

TEST_F(Shaders, compileInEveryDialectAndSpecialisation) {
    FETEXC_NEEDS_GLSLANG;
    std::size_t count = 0;
    for (const Dialect dialect : kDialects) {
        const std::string tool =
            dialect == Dialect::Vulkan450 ? "glslangValidator -V -o /dev/null" : "glslangValidator";
        // One process takes many files: name them all, run once.
        std::string files;
        for (const FbtTexture& texture : all_specialisations()) {
            for (const bool buffer : {false, true}) {
                // Where records lie doesn't interact with the rest; ES 3.0 has no texture buffers.
                if (buffer && (dialect == Dialect::Essl300 || texture.traits.degrees != 14)) continue;
                const fs::path file = folder_ / (std::to_string(count++) + ".frag");
                // Area sampling includes the plain sampler, the chain both.
                const Filter filter = count % 5 == 0 ? Filter::ExactArea : Filter::Area;
                std::ofstream(file) << (texture.traits.shared
                                            ? fbt_mip_fragment_source(dialect, texture, buffer, filter)
                                            : fbt_fragment_source(dialect, texture, buffer, filter));
                if (dialect == Dialect::Vulkan450) { // -V links all files of a call
                    ASSERT_EQ(std::system((tool + " " + file.string() + " >" + (folder_ / "log").string()).c_str()), 0)
                        << file;
                } else {
                    files += file.string() + "\n";
                }
            }
        }
        EXPECT_EQ(files.empty() ? "" : run(files, "list", "xargs glslangValidator <@"), "") << dialect_name(dialect);
        EXPECT_EQ(run(fbt_fragment_source(dialect, needing(14, 31, 15)), "point.frag", tool + " @"), "");
        EXPECT_EQ(run(view_vertex_source(dialect), "view.vert", tool + " @"), "");
        EXPECT_EQ(run(bitmap_fragment_source(dialect), "bitmap.frag", tool + " @"), "");
        EXPECT_EQ(run(filtered_bitmap_fragment_source(dialect), "filtered.frag", tool + " @"), "");
        for (const double range : {0.0, 4.0}) {
            Field field;
            field.range = range;
            EXPECT_EQ(run(field_fragment_source(dialect, field), "field.frag", tool + " @"), "") << range;
        }
    }
    EXPECT_GT(count, 300u);
}

TEST_F(Shaders, compileWithNothingSpecialised) {
    const std::string main_text =
        "void main() { color = fetexFbtSample(uv) + fetexFbtSampleArea(uv, vec2(0.1))\n"
        "    + fetexFbtSampleMip(uv, 2.5) + fetexFbtSampleMipAniso(uv, dFdx(uv), dFdy(uv)); }\n";
    const std::vector<std::string> files = {"fetex_fbt.glsl", "fetex_fbt_area.glsl", "fetex_levels.glsl",
                                            "fetex_fbt_mip.glsl"};
    expect_to_compile_by_hand(files, main_text, {"", "#define FETEX_FBT_SAMPLES 1\n", "#define FETEX_FBT_SAMPLES 2\n"});
}

TEST_F(Shaders, crossToHlslMetalAndEs) {
    FETEXC_NEEDS_GLSLANG;
    FETEXC_NEEDS_SPIRV_CROSS;
    const std::vector<FbtTexture> all = all_specialisations();
    for (std::size_t k = 0; k < all.size(); k += 7) {
        expect_to_cross(k % 2 == 0 ? fbt_fragment_source(Dialect::Vulkan450, all[k], false, Filter::Area)
                                   : fbt_mip_fragment_source(Dialect::Vulkan450, all[k]),
                        {"--version 330 --no-es"});
    }
}

/// All rules, with and without levels, image and the hardware's filter.
std::vector<std::pair<BilevelTexture, bool>> all_bilevels() {
    std::vector<std::pair<BilevelTexture, bool>> all;
    for (const BilevelRule rule : {BilevelRule::Single, BilevelRule::Min, BilevelRule::Max, BilevelRule::Median}) {
        for (std::uint32_t switches = 0; switches < 8; ++switches) {
            BilevelTexture t;
            t.rule = rule, t.channels = bilevel_channels(rule);
            t.below = 0x80402000, t.above = 0xffffffff;
            if (switches & 1u) t.mips = {0};
            if (switches & 2u) t.image = {0};
            all.emplace_back(t, (switches & 4u) != 0);
        }
    }
    return all;
}

TEST_F(Shaders, ofBilevelTexturesCompileInEveryDialect) {
    FETEXC_NEEDS_GLSLANG;
    for (const Dialect dialect : kDialects) {
        for (const auto& [texture, filtered] : all_bilevels()) {
            for (const Filter filter : {Filter::Point, Filter::Area})
                expect_to_compile(dialect, bilevel_fragment_source(dialect, texture, filter, filtered));
            if (!texture.mips.empty()) {
                expect_to_compile(dialect, bilevel_mip_fragment_source(dialect, texture, filtered));
            }
        }
    }
}

/// As an engine uses the plain file: prelude, some macros or none, library, a main of its own.
TEST_F(Shaders, ofBilevelTexturesCompileByHand) {
    const std::string main_text =
        "void main() { color = fetexBilevelSample(uv) * fetexBilevelValue(uv) + fetexBilevelSampleArea(uv, "
        "vec2(0.1))\n"
        "#if FETEX_BILEVEL_MIPS\n    + fetexBilevelSampleMip(uv, vec2(3.0))\n#endif\n; }\n";
    const std::vector<std::string> files = {"fetex_levels.glsl", "fetex_bilevel.glsl"};
    expect_to_compile_by_hand(files, main_text,
                              {"", "#define FETEX_BILEVEL_RULE 3\n#define FETEX_BILEVEL_MIPS 1\n",
                               "#define FETEX_BILEVEL_FILTERED 1\n#define FETEX_BILEVEL_IMAGE 1\n",
                               "#define FETEX_BILEVEL_GATHER 0\n"});
}

TEST_F(Shaders, ofBilevelTexturesCrossToHlslMetalAndEs) {
    FETEXC_NEEDS_GLSLANG;
    FETEXC_NEEDS_SPIRV_CROSS;
    for (const auto& [texture, filtered] : all_bilevels()) {
        expect_to_cross(texture.mips.empty()
                            ? bilevel_fragment_source(Dialect::Vulkan450, texture, Filter::Area, filtered)
                            : bilevel_mip_fragment_source(Dialect::Vulkan450, texture, filtered));
    }
}

TEST_F(Shaders, ofBilevelTexturesHaveWhatTheAssetNeeds) {
    BilevelTexture t;
    t.rule = BilevelRule::Max, t.channels = 2, t.above = 0xff0000ff;
    const std::string text = bilevel_specialisation(t);
    for (const char* line : {"#define FETEX_BILEVEL_RULE 2\n", "#define FETEX_BILEVEL_MIPS 0\n",
                             "#define FETEX_BILEVEL_IMAGE 0\n", "#define FETEX_BILEVEL_FILTERED 0\n",
                             "#define FETEX_BILEVEL_ABOVE vec4(1.000000000e+00, 0.000000000e+00, 0.000000000e+00, "
                             "1.000000000e+00)\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line << text;
    EXPECT_NE(bilevel_specialisation(t, true).find("#define FETEX_BILEVEL_FILTERED 1\n"), std::string::npos);
    for (const Dialect dialect : kDialects)
        expect_plain_ascii(bilevel_mip_fragment_source(dialect, t) + bilevel_fragment_source(dialect, t, Filter::Area));
}

/// All formats that shaders tell apart, with and without levels, nearest and filtered.
std::vector<std::pair<SilmapTexture, SilmapFilter>> all_silmaps() {
    std::vector<std::pair<SilmapTexture, SilmapFilter>> all;
    for (const SilmapCellFormat cells : {SilmapCellFormat::Bits8, SilmapCellFormat::Bits16}) {
        for (const SilmapSampleFormat samples : {SilmapSampleFormat::Rgba8, SilmapSampleFormat::Rgba16}) {
            for (std::uint32_t switches = 0; switches < 4; ++switches) {
                SilmapTexture t;
                t.cell_format = cells, t.sample_format = samples;
                if (switches & 1u) t.mips = {0};
                all.emplace_back(t, switches & 2u ? SilmapFilter::Nearest : SilmapFilter::Filtered);
            }
        }
    }
    return all;
}

TEST_F(Shaders, ofSilmapTexturesCompileInEveryDialect) {
    FETEXC_NEEDS_GLSLANG;
    for (const Dialect dialect : kDialects) {
        for (const auto& [texture, silmap] : all_silmaps()) {
            for (const Filter filter : {Filter::Point, Filter::Area})
                expect_to_compile(dialect, silmap_fragment_source(dialect, texture, filter, silmap));
            if (!texture.mips.empty()) {
                expect_to_compile(dialect, silmap_mip_fragment_source(dialect, texture, silmap));
            }
        }
    }
}

/// As an engine uses the plain file: prelude, some macros or none, library, a main of its own.
TEST_F(Shaders, ofSilmapTexturesCompileByHand) {
    const std::string main_text = "void main() { color = fetexSilmapSample(uv) + fetexSilmapSampleArea(uv, vec2(0.1))\n"
                                  "#if FETEX_SILMAP_MIPS\n    + fetexSilmapSampleMip(uv, vec2(3.0))\n#endif\n; }\n";
    const std::vector<std::string> files = {"fetex_levels.glsl", "fetex_silmap.glsl"};
    expect_to_compile_by_hand(files, main_text,
                              {"", "#define FETEX_SILMAP_BITS 7\n#define FETEX_SILMAP_MIPS 1\n",
                               "#define FETEX_SILMAP_SAMPLES 1\n", "#define FETEX_SILMAP_FILTERED 0\n",
                               "#define FETEX_SILMAP_GATHER 0\n"});
    // The others have it as it is, or not at all.
    expect_to_compile_by_hand(files, main_text, {"#define FETEX_SILMAP_GATHER 1\n"}, std::array{Dialect::Vulkan450});
}

TEST_F(Shaders, ofSilmapTexturesCrossToHlslMetalAndEs) {
    FETEXC_NEEDS_GLSLANG;
    FETEXC_NEEDS_SPIRV_CROSS;
    for (const auto& [texture, silmap] : all_silmaps()) {
        expect_to_cross(texture.mips.empty() ? silmap_fragment_source(Dialect::Vulkan450, texture, Filter::Area, silmap)
                                             : silmap_mip_fragment_source(Dialect::Vulkan450, texture, silmap));
    }
}

TEST_F(Shaders, ofSilmapTexturesHaveWhatTheAssetNeeds) {
    SilmapTexture t;
    t.cell_format = SilmapCellFormat::Bits16, t.sample_format = SilmapSampleFormat::Rgba16, t.mips = {0};
    EXPECT_EQ(silmap_specialisation(t, SilmapFilter::Nearest),
              "#define FETEX_SILMAP_BITS 7\n#define FETEX_SILMAP_SAMPLES 1\n#define FETEX_SILMAP_FILTERED 0\n"
              "#define FETEX_SILMAP_MIPS 1\n");
    EXPECT_EQ(silmap_specialisation({}),
              "#define FETEX_SILMAP_BITS 3\n#define FETEX_SILMAP_SAMPLES 0\n#define FETEX_SILMAP_FILTERED 1\n"
              "#define FETEX_SILMAP_MIPS 0\n");
    for (const Dialect dialect : kDialects)
        expect_plain_ascii(silmap_mip_fragment_source(dialect, t) + silmap_fragment_source(dialect, t, Filter::Area));
}

/// All formats that shaders tell apart, with and without levels, a line and the hardware's filter.
std::vector<std::pair<PinchmapTexture, bool>> all_pinchmaps() {
    std::vector<std::pair<PinchmapTexture, bool>> all;
    for (const PinchmapFormat map : {PinchmapFormat::Bits8, PinchmapFormat::Bits16}) {
        for (const PinchmapSampleFormat samples : {PinchmapSampleFormat::Rgba8, PinchmapSampleFormat::Rgba16}) {
            for (std::uint32_t switches = 0; switches < 8; ++switches) {
                PinchmapTexture t;
                t.map_format = map, t.sample_format = samples, t.scale = switches % 3;
                if (switches & 1u) t.mips = {0};
                if (switches & 2u) t.line_width = 3000, t.line_color = 0x80402010;
                all.emplace_back(t, (switches & 4u) != 0);
            }
        }
    }
    return all;
}

TEST_F(Shaders, ofPinchmapsCompileInEveryDialect) {
    FETEXC_NEEDS_GLSLANG;
    for (const Dialect dialect : kDialects) {
        for (const auto& [texture, filtered] : all_pinchmaps()) {
            for (const Filter filter : {Filter::Point, Filter::Area})
                expect_to_compile(dialect, pinchmap_fragment_source(dialect, texture, filter, filtered));
            if (!texture.mips.empty()) {
                expect_to_compile(dialect, pinchmap_mip_fragment_source(dialect, texture, filtered));
            }
        }
    }
}

/// As an engine uses the plain file: prelude, some macros or none, library, a main of its own.
TEST_F(Shaders, ofPinchmapsCompileByHand) {
    const std::string main_text =
        "void main() { color = fetexPinchmapSample(uv) + fetexPinchmapSampleArea(uv, vec2(0.1))\n"
        "    + fetexPinchmapPlaceAt(ivec2(1), uv, vec2(0.0)).line\n"
        "#if FETEX_PINCHMAP_MIPS\n    + fetexPinchmapSampleMip(uv, vec2(3.0))\n#endif\n; }\n";
    const std::vector<std::string> files = {"fetex_levels.glsl", "fetex_pinchmap.glsl"};
    expect_to_compile_by_hand(files, main_text,
                              {"", "#define FETEX_PINCHMAP_BITS 16\n#define FETEX_PINCHMAP_MIPS 1\n",
                               "#define FETEX_PINCHMAP_SAMPLES 1\n#define FETEX_PINCHMAP_SCALE 3\n",
                               "#define FETEX_PINCHMAP_FILTERED 1\n#define FETEX_PINCHMAP_LINE_WIDTH 0.1\n"});
}

TEST_F(Shaders, ofPinchmapsCrossToHlslMetalAndEs) {
    FETEXC_NEEDS_GLSLANG;
    FETEXC_NEEDS_SPIRV_CROSS;
    for (const auto& [texture, filtered] : all_pinchmaps()) {
        expect_to_cross(texture.mips.empty()
                            ? pinchmap_fragment_source(Dialect::Vulkan450, texture, Filter::Area, filtered)
                            : pinchmap_mip_fragment_source(Dialect::Vulkan450, texture, filtered));
    }
}

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++found;
    return found;
}

/// Where the hardware filters, a lookup is one fetch of each texture; else four. Every function that fetches is
/// called once in a lookup.
TEST_F(Shaders, ofPinchmapsFetchEachTextureOnceThroughTheFilter) {
    FETEXC_NEEDS_GLSLANG;
    PinchmapTexture t;
    t.mips = {0};
    for (const bool filtered : {true, false}) {
        const std::string name = (folder_ / "preprocessed").string();
        ASSERT_EQ(run(pinchmap_mip_fragment_source(Dialect::Glsl330, t, filtered), "one.frag",
                      "glslangValidator -E @ 2>/dev/null | tr -d ' ' | tee " + name),
                  "");
        const std::string text = text_of(name), filter = "textureLod(fetexPinchmap", fetch = "texelFetch(fetexPinchmap";
        ASSERT_GT(text.size(), 1000u);
        for (const char* texture : {"Map,", "Signal,"}) {
            EXPECT_EQ(count(text, filter + texture), filtered ? 1u : 0u) << texture;
            if (filtered && std::string(texture) == "Map,") {
                EXPECT_EQ(count(text, fetch + texture), 0u);
            }
        }
        EXPECT_EQ(count(text, filter + "Mips,"), filtered ? 1u : 0u);
        EXPECT_EQ(count(text, "fetexBilinear(fetexPinchmapMips"), filtered ? 0u : 2u);
        EXPECT_EQ(count(text, "=fetexPinchmapInterpolate("), 1u);
        EXPECT_EQ(count(text, "fetexPinchmapTexel("), filtered ? 0u : 5u); // one of them is its definition
    }
}

TEST_F(Shaders, ofPinchmapsHaveWhatTheAssetNeeds) {
    PinchmapTexture t;
    t.scale = 2, t.map_format = PinchmapFormat::Bits16, t.sample_format = PinchmapSampleFormat::Rgba16, t.mips = {0};
    t.line_width = 16384, t.line_color = 0xff0000ff;
    EXPECT_EQ(pinchmap_specialisation(t, true),
              "#define FETEX_PINCHMAP_SCALE 2\n#define FETEX_PINCHMAP_BITS 16\n#define FETEX_PINCHMAP_SAMPLES 1\n"
              "#define FETEX_PINCHMAP_MIPS 1\n#define FETEX_PINCHMAP_LINE_WIDTH 2.500000000e-01\n"
              "#define FETEX_PINCHMAP_LINE_COLOR vec4(1.000000000e+00, 0.000000000e+00, 0.000000000e+00, "
              "1.000000000e+00)\n#define FETEX_PINCHMAP_FILTERED 1\n");
    EXPECT_NE(pinchmap_specialisation({}).find("#define FETEX_PINCHMAP_BITS 8\n"), std::string::npos);
    EXPECT_NE(pinchmap_specialisation({}).find("#define FETEX_PINCHMAP_LINE_WIDTH 0.000000000e+00\n"),
              std::string::npos);
    for (const Dialect dialect : kDialects)
        expect_plain_ascii(pinchmap_mip_fragment_source(dialect, t) +
                           pinchmap_fragment_source(dialect, t, Filter::Area));
}

/// Everything that shaders tell apart: kinds and numbers; segments, curves and open edges; levels.
std::vector<FeatureCurvesTraits> all_feature_curves() {
    std::vector<FeatureCurvesTraits> all;
    for (const FeatureKind kind : {FeatureKind::Color, FeatureKind::Normal, FeatureKind::Height}) {
        for (std::uint32_t segments = 0; segments <= 2; ++segments) {
            for (std::uint32_t switches = segments % 2; switches < 8; switches += 2 + segments % 2) {
                FeatureCurvesTraits t;
                t.kind = kind, t.segments = segments, t.distance_limit = 4;
                t.linear = (switches & 1u) != 0, t.curves = !t.linear && segments > 0;
                t.open = (switches & 2u) != 0, t.mips = (switches & 4u) != 0;
                t.bits16 = (switches + segments) % 3 == 0, t.one_sample = (switches + segments) % 2 == 0;
                t.gradients = kind == FeatureKind::Normal || t.bits16;
                t.profiles = switches % 4 < 2 ? 1 : 5;
                if (switches % 3 == 1) t.base_format = FeatureSampleFormat::Rgba16;
                all.push_back(t);
            }
        }
    }
    return all;
}

TEST_F(Shaders, ofFeatureCurvesCompileInEveryDialect) {
    FETEXC_NEEDS_GLSLANG;
    for (const Dialect dialect : kDialects) {
        for (const FeatureCurvesTraits& traits : all_feature_curves())
            expect_to_compile(dialect, traits.mips ? feature_curves_mip_fragment_source(dialect, traits)
                                                   : feature_curves_fragment_source(
                                                         dialect, traits, traits.open ? Filter::Area : Filter::Point));
    }
}

TEST_F(Shaders, ofFeatureCurvesCompileByHand) {
    const std::string main_text =
        "void main() { color = fetexFeatureSample(uv) + fetexFeatureSampleArea(uv, vec2(0.1))\n"
        "    + fetexFeatureFind(ivec2(1), uv).distance\n"
        "#if FETEX_FEATURE_MIPS\n    + fetexFeatureSampleMip(uv, vec2(3.0))\n#endif\n; }\n";
    const std::vector<std::string> files = {"fetex_levels.glsl", "fetex_feature_curves.glsl"};
    expect_to_compile_by_hand(files, main_text,
                              {"", "#define FETEX_FEATURE_KIND 1\n#define FETEX_FEATURE_MIPS 1\n",
                               "#define FETEX_FEATURE_LINEAR 1\n#define FETEX_FEATURE_BITS16 1\n",
                               "#define FETEX_FEATURE_KIND 2\n#define FETEX_FEATURE_SEGMENTS 1\n",
                               "#define FETEX_FEATURE_PROFILES 2\n",
                               "#define FETEX_FEATURE_PROFILES 16\n#define FETEX_FEATURE_OPEN 0\n"
                               "#define FETEX_FEATURE_SEGMENTS 1\n"});
}

TEST_F(Shaders, ofFeatureCurvesCrossToHlslMetalAndEs) {
    FETEXC_NEEDS_GLSLANG;
    FETEXC_NEEDS_SPIRV_CROSS;
    for (const FeatureCurvesTraits& traits : all_feature_curves()) {
        expect_to_cross(traits.mips ? feature_curves_mip_fragment_source(Dialect::Vulkan450, traits)
                                    : feature_curves_fragment_source(Dialect::Vulkan450, traits, Filter::Area));
    }
}

/// Linear assets solve no equation, have no angles, and fetch two edges of a segment; without open edges nobody
/// looks for them.
TEST_F(Shaders, ofFeatureCurvesHaveWhatTheAssetNeeds) {
    FeatureCurvesTraits lines;
    lines.linear = true, lines.segments = 1, lines.kind = FeatureKind::Normal, lines.gradients = true;
    lines.distance_limit = 4;
    EXPECT_EQ(feature_curves_specialisation(lines),
              "#define FETEX_FEATURE_KIND 1\n#define FETEX_FEATURE_LIMIT 4.000000000e+00\n#define "
              "FETEX_FEATURE_LINEAR "
              "1\n#define FETEX_FEATURE_BITS16 0\n#define FETEX_FEATURE_GRADIENTS 1\n#define FETEX_FEATURE_SEGMENTS "
              "1\n#define FETEX_FEATURE_CURVES 0\n#define FETEX_FEATURE_OPEN 0\n#define FETEX_FEATURE_PROFILES "
              "1\n#define FETEX_FEATURE_SAMPLES "
              "0\n#define FETEX_FEATURE_ONE_SAMPLE 0\n#define FETEX_FEATURE_NORMAL_FACTOR "
              "2.007874016e+00\n#define FETEX_FEATURE_HEIGHT_SCALE 1.000000000e+00\n#define FETEX_FEATURE_MIPS 0\n");
    for (const Dialect dialect : kDialects)
        expect_plain_ascii(feature_curves_mip_fragment_source(dialect, lines));
    FETEXC_NEEDS_GLSLANG;
    const std::string name = (folder_ / "preprocessed").string();
    ASSERT_EQ(run(feature_curves_fragment_source(Dialect::Glsl330, lines), "one.frag",
                  "glslangValidator -E @ 2>/dev/null | tr -d ' ' | tee " + name),
              "");
    const std::string text = text_of(name);
    ASSERT_GT(text.size(), 1000u);
    for (const char* absent : {"cos(", "standIn", "fetexFeatureDip", "fetexFeatureBeside", "fetexFeatureMixed"})
        EXPECT_EQ(count(text, absent), 0u) << absent;
    EXPECT_EQ(count(text, "=fetexFeatureCrossing("), 2u);
}

TEST_F(Shaders, arePlainAscii) {
    for (const Dialect dialect : kDialects)
        expect_plain_ascii(fbt_fragment_source(dialect, {}) + fbt_mip_fragment_source(dialect, {}));
}

/// What an asset doesn't need isn't in its shader.
TEST_F(Shaders, leaveOutWhatTheAssetDoesNotNeed) {
    FbtTexture lines;
    lines.traits = {.max_degree = 1, .degrees = 2, .directions = 1, .max_entries = 2};
    const std::string text = fbt_specialisation(lines.traits);
    EXPECT_NE(text.find("#define FETEX_FBT_DEGREES 2\n"), std::string::npos);
    EXPECT_NE(text.find("#define FETEX_FBT_BANDS 0\n"), std::string::npos);
    EXPECT_NE(text.find("#define FETEX_FBT_SAMPLES 0\n"), std::string::npos);
    EXPECT_NE(fbt_specialisation({}, FbtSampleFormat::Rgba16F).find("#define FETEX_FBT_SAMPLES 2\n"),
              std::string::npos);
    EXPECT_EQ(fbt_library_source(Dialect::Glsl330, lines).find("fetexFbtSampleMip"), std::string::npos);
    FbtTexture chain = lines;
    chain.mips = {0};
    EXPECT_NE(fbt_library_source(Dialect::Glsl330, chain).find("fetexFbtSampleMip"), std::string::npos);
    FETEXC_NEEDS_GLSLANG;
    const std::string preprocessed_cubic = "glslangValidator -E @ | grep -q fetexFbtSolveCubic";
    EXPECT_NE(run(fbt_fragment_source(Dialect::Glsl330, lines), "lines.frag", preprocessed_cubic), "");
    lines.traits.degrees = 8;
    EXPECT_EQ(run(fbt_fragment_source(Dialect::Glsl330, lines), "cubics.frag", preprocessed_cubic), "");
}

} // namespace
} // namespace fetex
