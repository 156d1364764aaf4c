// SPDX-License-Identifier: GPL-3.0-or-later
/// Shader texts through Khronos's compiler, and through spirv-cross. Tests skip, and say so, where the tools aren't
/// installed.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "runtime_glsl/host/shader_source.h"

#define FETEXC_NEEDS_TOOL(name, package)                                                                               \
    if (std::system("command -v " name " >/dev/null 2>&1") != 0)                                                       \
    GTEST_SKIP() << name " (package " package ") isn't installed"
#define FETEXC_NEEDS_GLSLANG FETEXC_NEEDS_TOOL("glslangValidator", "glslang-tools")
#define FETEXC_NEEDS_SPIRV_CROSS FETEXC_NEEDS_TOOL("spirv-cross", "spirv-cross")

namespace fetexc::test {

inline std::string text_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// Compiles @ and writes nothing.
inline std::string compiler_of(fetex::Dialect dialect) {
    return dialect == fetex::Dialect::Vulkan450 ? "glslangValidator -V -o /dev/null @" : "glslangValidator @";
}

/// Some drivers and WebGL refuse other characters, even in comments; and tabs confuse line numbers.
inline void expect_plain_ascii(const std::string& text) {
    for (const char c : text)
        ASSERT_TRUE(c == '\n' || (c >= 32 && c < 127)) << static_cast<int>(c);
}

class ShaderTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::path(testing::TempDir()) / ("fetex_shaders_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// Runs the command with @ as the file's path; "" or what the tool said.
    std::string run(const std::string& name, const std::string& command) {
        const std::filesystem::path log = folder_ / "log";
        std::string line = command;
        for (std::size_t at = 0; (at = line.find('@', at)) != std::string::npos;)
            line.replace(at, 1, (folder_ / name).string());
        if (std::system((line + " >" + log.string() + " 2>&1").c_str()) == 0) return {};
        return line + "\n" + text_of(log);
    }
    /// The same after the text was written to the file.
    std::string run(const std::string& text, const std::string& name, const std::string& command) {
        std::ofstream(folder_ / name) << text;
        return run(name, command);
    }

    /// Precondition: the tools are there.
    void expect_to_compile(fetex::Dialect dialect, const std::string& text) {
        EXPECT_EQ(run(text, "compiled.frag", compiler_of(dialect)), "");
    }

    /// The plain files of runtime_glsl as an engine uses them: prelude, some macros or none, library, a main of its
    /// own.
    void expect_to_compile_by_hand(const std::vector<std::string>& files, const std::string& main_text,
                                   const std::vector<std::string>& macros,
                                   std::span<const fetex::Dialect> dialects = fetex::kDialects) {
        FETEXC_NEEDS_GLSLANG;
        const std::string root = std::string(FETEXC_ART_DIR) + "/../../runtime_glsl/";
        std::string library;
        for (const std::string& file : files)
            library += text_of(root + file);
        ASSERT_GT(library.size(), 5000u);
        for (const fetex::Dialect dialect : dialects) {
            const std::string prelude = text_of(root + "fetex_prelude_" + fetex::dialect_name(dialect) + ".glsl");
            ASSERT_FALSE(prelude.empty());
            for (const std::string& some : macros)
                EXPECT_EQ(run(prelude + some + library + "FETEX_VARYING(0) in highp vec2 uv;\n" +
                                  "FETEX_VARYING(0) out highp vec4 color;\n" + main_text,
                              "plain.frag", compiler_of(dialect)),
                          "")
                    << some;
        }
    }

    /// A text of Dialect::Vulkan450, to HLSL, Metal, ES and targets. What comes out for ES must compile again.
    /// Precondition: the tools are there.
    void expect_to_cross(const std::string& source, std::vector<std::string> targets = {}) {
        const std::string binary = (folder_ / "shader.spv").string();
        ASSERT_EQ(run(source, "cross.frag", "glslangValidator -V -o " + binary + " @"), "");
        for (const char* always : {"--hlsl --shader-model 50", "--msl", "--version 310 --es"})
            targets.emplace_back(always);
        for (const std::string& target : targets)
            EXPECT_EQ(run("es.frag", "spirv-cross " + binary + " " + target + " --output @"), "") << target;
        EXPECT_EQ(run("es.frag", "glslangValidator @"), ""); // the last is the one for ES
    }

    std::filesystem::path folder_;
};

} // namespace fetexc::test
