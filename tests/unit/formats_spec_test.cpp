// SPDX-License-Identifier: GPL-3.0-or-later
/// The worked example of formats/SPEC.md is what the writer writes.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/fbt_maker.h"

namespace fetex {
namespace {

FetexFile example() {
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {kFbtKindSingle << 30};
    const fetexc::test::MadeRun line{1, kFbtRayPosX, 1, {fbt_pack_point(0.25, 0), fbt_pack_point(0.75, 1)}, 0, true,
                                     {kFbtModelSolid, 0xff0000ff}};
    fetexc::test::append_list(t.records, {line}, {kFbtModelSolid, 0xffff0000});
    t.traits = fbt_traits(t);
    return {{{"generator", "example"}}, t};
}

std::string hex_dump(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    char part[32];
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        if (at % 16 == 0) {
            std::snprintf(part, sizeof part, "%04zx ", at);
            text += part;
        }
        std::snprintf(part, sizeof part, " %02x", bytes[at]);
        text += part;
        if (at % 16 == 15 || at + 1 == bytes.size()) text += "\n";
    }
    return text;
}

TEST(Spec, exampleIsWhatTheWriterWrites) {
    std::ifstream file(std::string(FETEXC_ART_DIR) + "/../../formats/SPEC.md");
    ASSERT_TRUE(file.good());
    std::stringstream text;
    text << file.rdbuf();
    const std::string dump = hex_dump(write_file(example()));
    EXPECT_NE(text.str().find("\n```\n" + dump + "```\n"), std::string::npos) << "the example should read\n" << dump;
}

TEST(Spec, exampleIsValidAndSamplesAsTheTextSays) {
    FetexFile back;
    ASSERT_FALSE(read_file(back, write_file(example())).has_value());
    EXPECT_EQ(fbt_locate(*back.fbt, 0.3, 0.5).sample, 0xff0000ffu);
    EXPECT_EQ(fbt_locate(*back.fbt, 0.6, 0.5).sample, 0xffff0000u);
}

} // namespace
} // namespace fetex
