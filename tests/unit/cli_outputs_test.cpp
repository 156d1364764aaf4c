// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/outputs.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gtest/gtest.h>

#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

namespace fs = std::filesystem;

/// An empty folder, gone afterwards.
class Outputs : public testing::Test {
  protected:
    Outputs() : folder_(fs::temp_directory_path() / ("fetexc-outputs-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Outputs() override { fs::remove_all(folder_); }

    std::string touch(const std::string& name) {
        const fs::path path = folder_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path) << "x";
        return path.string();
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

    fs::path folder_;
};

TEST_F(Outputs, lieBesideTheirInputs) {
    const auto plan = plan_outputs({path("a.svg"), path("d/b.tar.svgz"), path("plain")}, "");
    ASSERT_TRUE(plan.ok());
    EXPECT_EQ(plan.value().jobs[0].output, path("a.fetex"));
    EXPECT_EQ(plan.value().jobs[1].output, path("d/b.tar.fetex"));
    EXPECT_EQ(plan.value().jobs[2].output, path("plain.fetex"));
    EXPECT_EQ(plan.value().folder, "");
}

TEST_F(Outputs, goToStdoutFromStdin) {
    const auto plan = plan_outputs({"-"}, "");
    ASSERT_TRUE(plan.ok());
    EXPECT_EQ(plan.value().jobs[0].output, "-");
}

TEST_F(Outputs, ofOneInputMayBeAFileOrAFolder) {
    fs::create_directories(folder_ / "out");
    EXPECT_EQ(plan_outputs({"a.svg"}, path("x.y")).value().jobs[0].output, path("x.y"));
    EXPECT_EQ(plan_outputs({"a.svg"}, path("out")).value().jobs[0].output, path("out/a.fetex"));
    EXPECT_EQ(plan_outputs({"a.svg"}, path("new/")).value().folder, path("new/"));
}

TEST_F(Outputs, ofSeveralInputsNeedAFolder) {
    const std::string file = touch("file");
    const auto plan = plan_outputs({"a.svg", "b.svg"}, file);
    ASSERT_FALSE(plan.ok());
    EXPECT_EQ(plan.error().code, diag::kBadUsage);
    EXPECT_EQ(plan_outputs({"a.svg", "b.svg"}, "-").error().code, diag::kBadUsage);
    EXPECT_TRUE(plan_outputs({"a.svg", "b.svg"}, path("new")).ok());
}

TEST_F(Outputs, mayNotMeet) {
    const auto plan = plan_outputs({path("a/x.svg"), path("b/x.svg")}, path("out"));
    ASSERT_FALSE(plan.ok());
    EXPECT_EQ(plan.error().code, diag::kSameOutputTwice);
    EXPECT_EQ(plan_outputs({path("x.svg"), path("x.svgz")}, "").error().code, diag::kSameOutputTwice);
    EXPECT_EQ(plan_outputs({path("x.svg"), path("d/../x.svg")}, "").error().code, diag::kSameOutputTwice);
}

TEST_F(Outputs, mayNotBeAnInput) {
    const std::string input = touch("a.fetex");
    EXPECT_EQ(plan_outputs({input}, "").error().code, diag::kWouldOverwriteInput);
    fs::create_symlink("a.fetex", folder_ / "link");
    EXPECT_EQ(plan_outputs({input}, path("link")).error().code, diag::kWouldOverwriteInput);
    EXPECT_EQ(check_depfile(path("link"), {{input, path("b")}}).error().code, diag::kWouldOverwriteInput);
}

TEST_F(Outputs, ofStdinGoAlone) {
    EXPECT_EQ(plan_outputs({"-", "a.svg"}, "").error().code, diag::kBadUsage);
    EXPECT_EQ(plan_outputs({"-"}, path("out/")).error().code, diag::kBadUsage);
}

TEST_F(Outputs, onStdoutHaveNoDependencyFile) {
    EXPECT_EQ(check_depfile("x.d", {{"a.svg", "-"}}).error().code, diag::kBadUsage);
    EXPECT_EQ(check_depfile(path("b.fetex"), {{"a.svg", path("b.fetex")}}).error().code, diag::kSameOutputTwice);
    EXPECT_TRUE(check_depfile(path("x.d"), {{"a.svg", path("b.fetex")}}).ok());
}

} // namespace
} // namespace fetexc::cli
