// SPDX-License-Identifier: GPL-3.0-or-later
/// Options that several subcommands share, and how their values are read.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace fetexc::cli {

/// "WxH" gives both sides; "N" the longer one, the other follows from an aspect ratio.
struct SizeValue {
    std::uint32_t width = 0, height = 0; ///< both 0 when longer is set
    std::uint32_t longer = 0;
    bool automatic = false; ///< "auto", where the option takes it; the others are 0
};
struct PixelSize {
    std::uint32_t width = 0, height = 0;
};

/// A part of the texture in texture space: x right, y down, the whole is (0, 0, 1, 1).
struct ViewValue {
    double x = 0, y = 0, w = 1, h = 1;
};

inline constexpr std::uint32_t kMaxSide = 16384; ///< texels or pixels

std::optional<SizeValue> parse_size(const std::string& text);
/// "#rrggbb" or "#rrggbbaa": R, G, B and A, 0 … 1, as they are.
std::optional<std::array<double, 4>> parse_color(const std::string& text);
/// w, h > 0; all four finite and of magnitude at most fetex::kMaxView (outside the texture its edge is repeated).
std::optional<ViewValue> parse_view(const std::string& text);

/// The longer side is size.longer, the other by aspect = width/height, rounded, at least 1.
PixelSize resolve_size(const SizeValue& size, double aspect);

/// Takes numbers from least to most; unlike CLI::Range, "nan" isn't one of them.
CLI::Validator number_range(double least, double most);

/// Adds options to a subcommand; the value must outlive the parsing.
CLI::Option* add_size_option(CLI::App& app, SizeValue& value, const std::string& help);
/// Also takes "auto".
CLI::Option* add_size_or_auto_option(CLI::App& app, SizeValue& value, const std::string& help);
void add_view_option(CLI::App& app, ViewValue& value);
void add_quiet_option(CLI::App& app, bool& quiet);

/// A subcommand: what was added to the command line, and what runs when it was chosen. run returns the exit code.
struct Command {
    CLI::App* app = nullptr;
    std::function<int()> run;
};

Command add_compile_command(CLI::App& parent);
Command add_render_command(CLI::App& parent);
Command add_info_command(CLI::App& parent);
Command add_validate_command(CLI::App& parent);
Command add_compare_command(CLI::App& parent);
Command add_bench_command(CLI::App& parent);

} // namespace fetexc::cli
