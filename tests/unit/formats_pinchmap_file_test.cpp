// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps in files: what is written is read back; what is damaged or hostile is refused by its number.
#include "formats/validate.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/representation_file_tests.h"

namespace fetexc::test {
namespace {

using namespace fetex;

struct PinchmapTraits {
    using Texture = PinchmapTexture;
    using Samples = PinchmapSampleFormat;
    static constexpr auto kMember = &FetexFile::pinchmap;
    static constexpr std::uint8_t kNumber = 3;
    static constexpr const char* kPrefix = "PNC";
    static constexpr std::size_t kMap = 2, kSignal = 3, kLevel1 = 4, kLastLevel = 6;
    static constexpr FindingCode kBadHeader = FindingCode::BadPinchmapHeader,
                                 kSizeMismatch = FindingCode::PinchmapSizeMismatch;
    static constexpr bool kOneFinding = false; // what a texel spoils for its neighbours is found there too

    /// 5×3 clusters, 6×4 map texels, a signal of 10×6 and its levels of 5×3, 2×1 and 1×1.
    static Texture full(Samples samples = {}) {
        Texture t = pinchmap_of(mask_of({"..###", "..###", "....."}), {.scale = 1,
                                                                       .map_format = PinchmapFormat::Bits8,
                                                                       .sample_format = samples,
                                                                       .signal = KnownSignal::Random,
                                                                       .gamma_from = -0.5,
                                                                       .gamma_to = 0.5,
                                                                       .mips = true,
                                                                       .seed = 3});
        t.line_color = 0xff102030, t.line_width = 4096;
        return t;
    }
    static Texture other() {
        Texture t = full();
        t.signal[0] = 0;
        return t;
    }
    static std::vector<Texture> several() {
        std::vector<Texture> all;
        std::uint64_t seed = 0;
        for (const PinchmapFormat format : kPinchmapFormats)
            for (const Samples samples : kPinchmapSampleFormats)
                for (const bool mips : {false, true})
                    all.push_back(pinchmap_of(mask_of({".......", "##.....", "##.....", "##....."}),
                                              {.scale = static_cast<std::uint32_t>(seed % 3),
                                               .map_format = format,
                                               .sample_format = samples,
                                               .signal = KnownSignal::Random,
                                               .gamma_from = -0.9,
                                               .gamma_to = 0.9,
                                               .least_strength = seed % 2 == 0 ? 0.5 : 1.0,
                                               .mips = mips,
                                               .seed = ++seed}));
        return all;
    }
    static std::vector<Texture> damaged() {
        std::vector<Texture> all;
        for (const Samples samples : kPinchmapSampleFormats)
            all.push_back(full(samples));
        return all;
    }

    static void expect_same(const Texture& a, const Texture& b) {
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.scale, b.scale);
        EXPECT_EQ(a.map_format, b.map_format);
        EXPECT_EQ(a.sample_format, b.sample_format);
        EXPECT_EQ(a.line_color, b.line_color);
        EXPECT_EQ(a.line_width, b.line_width);
        EXPECT_EQ(a.map, b.map);
        EXPECT_EQ(a.signal, b.signal);
        EXPECT_EQ(a.mips, b.mips);
    }
    static std::vector<Finding> validate(const Texture& t) { return validate_pinchmap(t); }
    static FbtColor sample(const Texture& t) { return pinchmap_sample_mip(t, 2.2, 1.1, {1.5, 0.2}); }

    static std::vector<HostileWord> hostile_header() {
        return {
            {0, {0, 16385, 0xffffffff}, kBadHeader},
            {1, {0, 16385, 0xffffffff}, kBadHeader},
            {2, {15, 32, 0xffffffff}, kBadHeader},
            {2, {12}, kBadHeader}, // 5·2^12 samples
            {3, {2}, kBadHeader},
            {4, {4}, kBadHeader},
            {5, {4}, kBadHeader},
            {5, {0}, kBadHeader}, // there is a line
            {5, {3}, kBadHeader}, // every strength is 1
            {6, {0x01000002}, FindingCode::PinchmapNotPremultiplied},
            {7, {0, 65537}, kBadHeader},
            {8, {1}, kBadHeader},
            {9, {1}, kBadHeader},
            {10, {1}, kBadHeader},
            {11, {1}, kBadHeader},
            {0, {8192}, kSizeMismatch}, // and doesn't allocate it
            {2, {0}, kSizeMismatch},
            {3, {1}, kSizeMismatch},
            {4, {1, 3}, kSizeMismatch},
        };
    }
    static std::vector<SpoiltWord> spoilt() {
        return {{kMap, 4 * 7 + 3, 0, "F4005", "(1,1)", 1}, // gamma of -1
                {kSignal, 16, 0x01000002, "F4003"},
                {kLevel1, 4, 0x01000200, "F4003"},
                {kLevel1 + 1, 0, 0x01030000, "F4003"}};
    }
    static std::vector<Fault<PinchmapTraits>> faults() {
        using C = FindingCode;
        using T = Texture;
        using F = Samples;
        return {
            {"no width", C::PinchmapDimensions, [](T& t) { t.width = 0; }},
            {"too high", C::PinchmapDimensions, [](T& t) { t.height = 8193; }},
            {"too fine", C::PinchmapDimensions, [](T& t) { t.scale = 40; }},
            {"a map texel short", C::PinchmapDimensions, [](T& t) { t.map.pop_back(); }},
            {"a sample short", C::PinchmapDimensions, [](T& t) { t.signal.pop_back(); }},
            {"half a sample short", C::PinchmapDimensions, [](T& t) { t.signal.pop_back(); }, F::Rgba16},
            {"a level short", C::PinchmapDimensions, [](T& t) { t.mips.pop_back(); }},
            {"no map format", C::PinchmapFormat, [](T& t) { t.map_format = PinchmapFormat(2); }},
            {"no sample format", C::PinchmapFormat, [](T& t) { t.sample_format = F(4); }},
            {"a wide line", C::PinchmapFormat, [](T& t) { t.line_width = 65537; }},
            {"a bright line", C::PinchmapNotPremultiplied, [](T& t) { t.line_color = 0x7f000080; }},
            {"brighter than alpha", C::PinchmapNotPremultiplied, [](T& t) { t.signal.back() = 0x7f000080; }},
            {"of 16 bits", C::PinchmapNotPremultiplied, [](T& t) { t.signal.back() = 0x7fff8000; }, F::Rgba16},
            {"light without alpha", C::PinchmapNotPremultiplied, [](T& t) { t.signal.back() = 1; }, F::Rgba16F},
            {"a negative half", C::PinchmapSampleValue, [](T& t) { t.signal.back() = 0x3c008001; }, F::Rgba16F},
            {"alpha above 1", C::PinchmapSampleValue, [](T& t) { t.signal.back() = 0x3c010000; }, F::Rgba16F},
            {"not opaque", C::PinchmapSampleValue, [](T& t) { t.signal.back() = 0xfe000000; }, F::Rgb8},
            {"in a level", C::PinchmapNotPremultiplied, [](T& t) { t.mips.back() = 0x7f000080; }, F::Rgba16F},
            // The line goes down at corner 2 of rows 0 and 1, turns at (2,2) and leaves at row 2.
            {"a step beyond 1", C::PinchmapValue, [](T& t) { t.map[2] = 0x7f7f7fff; }},
            {"gamma of 1", C::PinchmapValue, [](T& t) { t.map[2] = 0xfe7f7ffe; }},
            {"a k between", C::PinchmapValue, [](T& t) { t.map[0] = 0x7f307f7f; }},
            {"a direction at rest", C::PinchmapValue, [](T& t) { t.map[0] = 0x7f00807f; }},
            {"an open cluster", C::PinchmapCluster, [](T& t) { t.map[8] = 0x7f007f7f; }},
            {"an island", C::PinchmapDirection, [](T& t) { t.map[23] = 0x7f7f7f7f; }},
            {"backwards", C::PinchmapDirection, [](T& t) { t.map[2] = 0x7f7f7f00; }},
            {"along the line", C::PinchmapDirection, [](T& t) { t.map[2] = 0x7f7ffe7f; }},
            {"a skew turn", C::PinchmapDirection, [](T& t) { t.map[14] = 0x7f7f40fe; }},
        };
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Pinchmap, RepresentationFile, PinchmapTraits);

/// SPEC.md §2.6, byte by byte: two clusters of one sample each, a line between them of strength 64/127.
TEST(PinchmapFile, hasTheBytesOfTheSpecification) {
    PinchmapTexture t;
    t.width = 2, t.height = 1, t.sample_format = PinchmapSampleFormat::Rgb8;
    t.line_color = 0x80402010, t.line_width = 0x1234;
    t.map = {0x7f007f7f, 0x807f7fbf, 0x7ffe7f7f, 0x7f007f7f, 0x807f7fbf, 0x7ffe7f7f};
    t.signal = {0xff030201, 0xff060504};
    t.mips = {0xff090807};
    ASSERT_TRUE(validate_pinchmap(t).empty());
    const Chunks chunks = chunks_of(write_file(file_of<PinchmapTraits>(t)));
    ASSERT_EQ(chunks.size(), 5u);
    EXPECT_EQ(chunks[1].payload,
              (Bytes{2,    0,    0,    0,    1,    0,    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0,
                     0x10, 0x20, 0x40, 0x80, 0x34, 0x12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(chunks[2].payload, (Bytes{127, 127, 0, 127, 191, 127, 127, 128, 127, 127, 254, 127,
                                        127, 127, 0, 127, 191, 127, 127, 128, 127, 127, 254, 127}));
    EXPECT_EQ(chunks[3].payload, (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(chunks[4].payload, (Bytes{7, 8, 9, 255}));
    EXPECT_EQ(chunks[4].level, 1);
}

} // namespace
} // namespace fetexc::test
