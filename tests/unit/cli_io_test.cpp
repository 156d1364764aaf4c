// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/io.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

namespace fs = std::filesystem;

class Io : public testing::Test {
  protected:
    Io() : folder_(fs::temp_directory_path() / ("fetexc-io-" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Io() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] std::string content(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return (std::ostringstream() << file.rdbuf()).str();
    }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

TEST_F(Io, readsWhatItWrote) {
    const std::string text("a\0b\n", 4);
    ASSERT_TRUE(write_output(path("x"), text).ok());
    const auto bytes = read_input(path("x"), 100);
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(std::string(bytes.value().begin(), bytes.value().end()), text);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Io, refusesWhatIsLongerThanTheLimit) {
    ASSERT_TRUE(write_output(path("x"), std::string(101, 'x')).ok());
    EXPECT_TRUE(read_input(path("x"), 101).ok());
    const auto bytes = read_input(path("x"), 100);
    ASSERT_FALSE(bytes.ok());
    EXPECT_EQ(bytes.error().code, diag::kInputTooLong);
    EXPECT_FALSE(read_input("/dev/zero", 1 << 20).ok());
}

TEST_F(Io, keepsPermissionsOfWhatItReplacesAndHeedsTheMask) {
    const mode_t before = ::umask(027);
    ASSERT_TRUE(write_output(path("new"), std::string("x")).ok());
    ::umask(before);
    EXPECT_EQ(fs::status(path("new")).permissions(), fs::perms(0640));
    fs::permissions(path("new"), fs::perms(0604));
    ASSERT_TRUE(write_output(path("new"), std::string("y")).ok());
    EXPECT_EQ(fs::status(path("new")).permissions(), fs::perms(0604));
    EXPECT_EQ(content("new"), "y");
}

TEST_F(Io, writesThroughALinkWithoutReplacingIt) {
    ASSERT_TRUE(write_output(path("real"), std::string("old")).ok());
    fs::create_symlink("real", folder_ / "link");
    ASSERT_TRUE(write_output(path("link"), std::string("new")).ok());
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(content("real"), "new");
    EXPECT_EQ(files(), 2u);
}

TEST_F(Io, leavesNothingBehindWhenItFails) {
    fs::create_directories(folder_ / "folder");
    const Status status = write_output(path("folder"), std::string("x"));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, diag::kCannotCreate);
    EXPECT_EQ(write_output(path("none/x"), std::string("x")).error().code, diag::kCannotCreate);
    EXPECT_EQ(write_output("/dev/full", std::string("x")).error().code, diag::kCannotWrite);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Io, knowsOneFileUnderTwoNames) {
    ASSERT_TRUE(write_output(path("a"), std::string("x")).ok());
    fs::create_hard_link(path("a"), path("b"));
    EXPECT_TRUE(same_file(path("a"), path("b")));
    EXPECT_TRUE(same_file(path("a"), path("./a")));
    EXPECT_FALSE(same_file(path("a"), path("none")));
    EXPECT_FALSE(same_file("-", "-"));
}

TEST_F(Io, checksOutputsWithoutMakingThem) {
    std::ofstream(path("file")) << "x";
    for (const std::string& good : {path("new"), path("file"), std::string("-"), std::string("/dev/null")})
        EXPECT_TRUE(check_output(good).ok()) << good;
    for (const std::string& bad : {path(""), path("none/new"), path("file/new")}) {
        const Status status = check_output(bad);
        ASSERT_FALSE(status.ok()) << bad;
        EXPECT_EQ(status.error().code, diag::kCannotCreate);
        EXPECT_EQ(status.error().place, bad);
    }
    EXPECT_EQ(files(), 1u);
    EXPECT_EQ(content("file"), "x");
}

TEST_F(Io, knowsOneFileByAnyName) {
    fs::create_directory_symlink(folder_, path("link"));
    EXPECT_EQ(identity(path("new")), identity(path("link/new")));
    EXPECT_EQ(identity(path("new")), identity(path("./none/../new")));
    EXPECT_NE(identity(path("new")), identity(path("other")));
    const std::string relative = "fetexc-no-such-file";
    EXPECT_EQ(identity(relative), identity("./" + relative));
    EXPECT_EQ(identity(relative), identity((fs::current_path() / relative).string()));
    EXPECT_EQ(identity("-"), "-");
    EXPECT_NE(identity("./-"), "-");
}

} // namespace
} // namespace fetexc::cli
