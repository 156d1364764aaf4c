// SPDX-License-Identifier: GPL-3.0-or-later
// Values read from the command line, and text written for people and build tools.
#include <gtest/gtest.h>

#include "cli/depfile.h"
#include "cli/messages.h"
#include "cli/options.h"
#include "cli/report.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

TEST(Size, readsOneNumberOrTwo) {
    const auto one = parse_size("64"), two = parse_size("64x16384");
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->longer, 64u);
    EXPECT_EQ(two->width, 64u);
    EXPECT_EQ(two->height, 16384u);
    EXPECT_EQ(two->longer, 0u);
}

TEST(Size, refusesEverythingElse) {
    for (const char* text :
         {"", "0", "16385", "-1", "64x", "x64", "64x0", "64X64", "64x64x64", " 64", "64 ", "6.4", "1e3", "99999999999"})
        EXPECT_FALSE(parse_size(text).has_value()) << text;
}

TEST(Size, followsTheAspect) {
    EXPECT_EQ(resolve_size({0, 0, 100}, 2).height, 50u);
    EXPECT_EQ(resolve_size({0, 0, 100}, 0.25).width, 25u);
    EXPECT_EQ(resolve_size({0, 0, 100}, 1e9).height, 1u);
    EXPECT_EQ(resolve_size({30, 40, 0}, 7).height, 40u);
}

TEST(View, readsFourNumbers) {
    const auto view = parse_view("0.25,-1,.5,1e-6");
    ASSERT_TRUE(view);
    EXPECT_EQ(view->x, 0.25);
    EXPECT_EQ(view->y, -1);
    EXPECT_EQ(view->w, 0.5);
    EXPECT_EQ(view->h, 1e-6);
}

TEST(View, refusesEverythingElse) {
    for (const char* text : {"", "0,0,1", "0,0,1,1,1", "0,0,0,1", "0,0,1,-1", "nan,0,1,1", "0,inf,1,1", "0,0,1,1 ",
                             "0;0;1;1", "0,,1,1", "1e9,0,1,1"})
        EXPECT_FALSE(parse_view(text).has_value()) << text;
}

TEST(NumberRange, takesItsEndsAndWhatIsBetween) {
    const CLI::Validator range = number_range(0.5, 1e9);
    for (const char* text : {"0.5", "1", "1e9", "1e+09", "3.25"})
        EXPECT_EQ(range(std::string(text)), "") << text;
}

TEST(NumberRange, refusesEverythingElse) {
    const CLI::Validator range = number_range(0.5, 1e9);
    for (const char* text : {"", " ", "0.4", "-1", "1.1e9", "nan", "NaN", "-nan", "inf", "1e999", "1 ", "1x", "one"})
        EXPECT_NE(range(std::string(text)), "") << text;
    EXPECT_EQ(range(std::string("nan")), "'nan' is not a number from 0.5 to 1e+09");
}

TEST(Depfile, escapesAsMakeReadsIt) {
    struct Case {
        const char *name, *written;
    };
    for (const Case& c : {Case{"plain", "plain"}, Case{"a b", "a\\ b"}, Case{"a\tb", "a\\\tb"}, Case{"$x", "$$x"},
                          Case{"#x", "\\#x"}, Case{"a\\b", "a\\b"}, Case{"a\\ b", "a\\\\\\ b"}, Case{"c:x", "c:x"}}) {
        const auto text = depfile_text({{"out", {c.name}}});
        ASSERT_TRUE(text.ok());
        EXPECT_EQ(text.value(), std::string("out: ") + c.written + "\n");
    }
}

TEST(Depfile, refusesNamesMakeCantWrite) {
    EXPECT_EQ(depfile_text({{"out", {"a\nb"}}}).error().code, diag::kDepfileName);
    EXPECT_EQ(depfile_text({{"o\nut", {"a"}}}).error().code, diag::kDepfileName);
}

TEST(Message, namesCodeInputAndPlace) {
    EXPECT_EQ(describe(Error{ErrorClass::InvalidInput, 1203, "reason", "path#wheel"}, "f.svg"),
              "error E1203: f.svg: path#wheel: reason");
    EXPECT_EQ(describe(Error{ErrorClass::Io, 8001, "reason", "f.svg"}, "f.svg"), "error E8001: f.svg: reason");
    EXPECT_EQ(describe(Diagnostic{Severity::Warning, 2001, "reason", ""}, "f.svg"), "warning W2001: f.svg: reason");
}

TEST(Message, showsControlCharactersInsteadOfSendingThem) {
    EXPECT_EQ(printable("a\x1b[31m\n\x7fü"), "a\\x1b[31m\\x0a\\x7fü");
}

TEST(Report, listsWhatTheShaderLeavesOut) {
    fetex::FbtTraits traits;
    traits.degrees = 1u << 1 | 1u << 3;
    traits.bands = true;
    traits.directions = 0b0101;
    const std::vector<std::string> expected = {"quadratics", "interpolated corners", "patches", "shared points", "translucency", "rays -x", "rays -y"};
    EXPECT_EQ(shader_parts_left_out(traits), expected);
}

TEST(Report, isValidJsonWhateverTheNames) {
    CompileOutcome outcome;
    outcome.input = "\xff\"\n.svg";
    outcome.report.diagnostics = {{Severity::Warning, 2001, "bad \xc3", "path#\x01"}};
    const std::string text = report_json({outcome});
    EXPECT_NE(text.find("\"code\": \"W2001\""), std::string::npos);
    EXPECT_EQ(text.find('\xff'), std::string::npos);
}

} // namespace
} // namespace fetexc::cli
