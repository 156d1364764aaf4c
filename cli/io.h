// SPDX-License-Identifier: GPL-3.0-or-later
/// Files in and out of the command line: "-" is stdin/stdout, and a failed write never harms what was there before.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

/// Errors E8001 (can't open), E8002 (can't read), E8003 (longer than limit bytes).
Result<std::vector<std::uint8_t>> read_input(const std::string& path, std::uint64_t limit);

/// Writes to a temporary file in the folder of path, then renames it over path: a reader sees the old bytes or all of
/// the new ones. Devices and pipes are written in place; a symbolic link keeps pointing where it did. Errors E8011,
/// E8012.
Status write_output(const std::string& path, std::span<const std::uint8_t> bytes);
Status write_output(const std::string& path, const std::string& text);

/// Whether write_output could make the file, as far as can be told beforehand: the folder is there and open to us, and
/// no folder is in the file's place. For what takes long before it writes. Error E8011.
Status check_output(const std::string& path);

/// The same for all names of one file, which needn't exist; "-" for "-".
std::string identity(const std::string& path);

/// True when both name the same existing file (also through links); false for "-".
bool same_file(const std::string& a, const std::string& b);

/// Makes the folder and its parents; error E8013.
Status make_folder(const std::string& path);

} // namespace fetexc::cli
