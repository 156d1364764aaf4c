// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures in files: what is written is read back; what is damaged or hostile is refused by its number.
#include "formats/validate.h"
#include "tests/support/random_silmap.h"
#include "tests/support/representation_file_tests.h"

namespace fetexc::test {
namespace {

using namespace fetex;

struct SilmapTraits {
    using Texture = SilmapTexture;
    using Samples = SilmapSampleFormat;
    static constexpr auto kMember = &FetexFile::silmap;
    static constexpr std::uint8_t kNumber = 2;
    static constexpr const char* kPrefix = "SLM";
    static constexpr std::size_t kLevel1 = 4, kLastLevel = 5;
    static constexpr FindingCode kBadHeader = FindingCode::BadSilmapHeader,
                                 kSizeMismatch = FindingCode::SilmapSizeMismatch;
    static constexpr bool kOneFinding = true;

    /// 5×3 texels, 6×4 cells, levels of 2×1 and 1×1.
    static Texture full(Samples samples = {}) {
        return random_silmap(3, {.width = 5, .height = 3, .sample_format = samples, .mips = true});
    }
    static Texture other() {
        Texture t = full();
        t.colors[0] = 0;
        return t;
    }
    static std::vector<Texture> several() {
        std::vector<Texture> all;
        for (const SilmapCellFormat cells : kSilmapCellFormats)
            for (const Samples samples : kSilmapSampleFormats)
                for (const bool mips : {false, true})
                    all.push_back(random_silmap(
                        all.size() + 1,
                        {.width = 7, .height = 2, .cell_format = cells, .sample_format = samples, .mips = mips}));
        return all;
    }
    static std::vector<Texture> damaged() {
        std::vector<Texture> all;
        for (const Samples samples : kSilmapSampleFormats)
            all.push_back(full(samples));
        return all;
    }

    static void expect_same(const Texture& a, const Texture& b) {
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.cell_format, b.cell_format);
        EXPECT_EQ(a.sample_format, b.sample_format);
        EXPECT_EQ(a.cells, b.cells);
        EXPECT_EQ(a.colors, b.colors);
        EXPECT_EQ(a.mips, b.mips);
    }
    static std::vector<Finding> validate(const Texture& t) { return validate_silmap(t); }
    static FbtColor sample(const Texture& t) { return silmap_sample_mip(t, 2.2, 1.1, {1.5, 0.2}); }

    static std::vector<HostileWord> hostile_header() {
        return {
            {0, {0, 16385, 0xffffffff}, kBadHeader},
            {1, {0, 16385, 0xffffffff}, kBadHeader},
            {2, {2}, kBadHeader},
            {3, {4}, kBadHeader},
            {4, {1}, kBadHeader},
            {5, {1}, kBadHeader},
            {6, {1}, kBadHeader},
            {7, {1}, kBadHeader},
            {0, {16384}, kSizeMismatch}, // and doesn't allocate it
            {2, {1}, kSizeMismatch},
            {3, {1, 3}, kSizeMismatch},
        };
    }
    static std::vector<SpoiltWord> spoilt() {
        return {{3, 16, 0x01000002, "F3003"}, {kLevel1, 4, 0x01000200, "F3003"}, {kLastLevel, 0, 0x01030000, "F3003"}};
    }
    static std::vector<Fault<SilmapTraits>> faults() {
        using C = FindingCode;
        using T = Texture;
        using F = Samples;
        return {
            {"no width", C::SilmapDimensions, [](T& t) { t.width = 0; }},
            {"too high", C::SilmapDimensions, [](T& t) { t.height = 16385; }},
            {"a cell short", C::SilmapDimensions, [](T& t) { t.cells.pop_back(); }},
            {"a texel short", C::SilmapDimensions, [](T& t) { t.colors.pop_back(); }},
            {"half a texel short", C::SilmapDimensions, [](T& t) { t.colors.pop_back(); }, F::Rgba16},
            {"a level short", C::SilmapDimensions, [](T& t) { t.mips.pop_back(); }},
            {"no cell format", C::SilmapFormat, [](T& t) { t.cell_format = SilmapCellFormat(2); }},
            {"no sample format", C::SilmapFormat, [](T& t) { t.sample_format = F(4); }},
            {"a cell of 9 bits", C::SilmapFormat, [](T& t) { t.cells.back() = 256; }},
            {"brighter than alpha", C::SilmapNotPremultiplied, [](T& t) { t.colors.back() = 0x7f000080; }},
            {"of 16 bits", C::SilmapNotPremultiplied, [](T& t) { t.colors.back() = 0x7fff8000; }, F::Rgba16},
            {"light without alpha", C::SilmapNotPremultiplied, [](T& t) { t.colors.back() = 1; }, F::Rgba16F},
            {"a negative half", C::SilmapSampleValue, [](T& t) { t.colors.back() = 0x3c008001; }, F::Rgba16F},
            {"an infinite half", C::SilmapSampleValue, [](T& t) { t.colors.back() = 0x3c007c00; }, F::Rgba16F},
            {"alpha above 1", C::SilmapSampleValue, [](T& t) { t.colors.back() = 0x3c010000; }, F::Rgba16F},
            {"not opaque", C::SilmapSampleValue, [](T& t) { t.colors.back() = 0xfe000000; }, F::Rgb8},
            {"in a level", C::SilmapNotPremultiplied, [](T& t) { t.mips.back() = 0x7f000080; }, F::Rgba16F},
        };
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Silmap, RepresentationFile, SilmapTraits);

/// SPEC.md §2.5, byte by byte.
TEST(SilmapFile, hasTheBytesOfTheSpecification) {
    SilmapTexture t;
    t.width = 2, t.height = 1;
    t.cell_format = SilmapCellFormat::Bits16, t.sample_format = SilmapSampleFormat::Rgb8;
    t.cells = {0x0102, 0x0304, 0x0506, 0x0708, 0x090a, 0x0b0c};
    t.colors = {0xff030201, 0xff060504};
    t.mips = {0xff090807};
    const Chunks chunks = chunks_of(write_file(file_of<SilmapTraits>(t)));
    ASSERT_EQ(chunks.size(), 5u);
    EXPECT_EQ(chunks[1].payload,
              (Bytes{2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(chunks[2].payload, (Bytes{2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11}));
    EXPECT_EQ(chunks[3].payload, (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(chunks[4].payload, (Bytes{7, 8, 9, 255}));
    EXPECT_EQ(chunks[4].level, 1);
}

} // namespace
} // namespace fetexc::test
