// SPDX-License-Identifier: GPL-3.0-or-later
/// What the user reads on stderr, and the exit code that goes with it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

inline constexpr int kExitOk = 0;
inline constexpr int kExitDifference = 7; ///< "compare"-like commands: both are fine, but they differ

/// 1 usage, 2 I/O, 3 invalid file, 4 runtime, 5 unsupported.
int exit_code(ErrorClass cls);

/// "error E1203: file.svg: path#wheel: reason"; the input's name is left out where it is the place already.
std::string describe(const Error& error, std::string_view input);
/// "warning W2001: file.svg: text#title: reason"
std::string describe(const Diagnostic& diagnostic, std::string_view input);
/// "E1203", "W2001", "N2001"
std::string code_name(Severity severity, int code);

/// "fetexc: " + text on stderr, control characters made visible (names in an input are not trusted).
void print_message(const std::string& text);
/// One line for each; quiet: errors only.
void print_diagnostics(const std::vector<Diagnostic>& diagnostics, std::string_view input, bool quiet);
/// Prints the error and returns its exit code.
int report_error(const Error& error, std::string_view input = {});

/// Control characters as \xNN.
std::string printable(std::string_view text);

} // namespace fetexc::cli
