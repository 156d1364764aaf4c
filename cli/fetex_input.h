// SPDX-License-Identifier: GPL-3.0-or-later
/// Reading .fetex files for the subcommands.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compiler/result.h"
#include "formats/fetex_file.h"

namespace fetexc::cli {

inline constexpr std::uint64_t kMaxFetexBytes = std::uint64_t{1} << 31; ///< longer files are refused unread

Result<std::vector<std::uint8_t>> read_fetex_bytes(const std::string& path);

/// Read and checked. Errors: those of read_input; E6001 with the first finding when the file is invalid.
struct FetexInput {
    fetex::FetexFile file;
    std::uint64_t bytes = 0;
};
Result<FetexInput> load_fetex(const std::string& path);
/// The same for bytes already read; path: for messages.
Result<FetexInput> fetex_of_bytes(std::span<const std::uint8_t> bytes, const std::string& path);

/// What a file may hold, in the order in which it is looked for.
struct Representation {
    const char* name;  ///< as --repr takes it
    const char* words; ///< for messages
};
inline constexpr std::array<Representation, 5> kRepresentations{{{"fbt", "FBT"},
                                                                 {"bilevel", "bi-level texture"},
                                                                 {"silmap", "silhouette-map texture"},
                                                                 {"pinchmap", "pinchmap"},
                                                                 {"curves", "texture with feature curves"}}};

/// Their names.
const std::vector<std::string>& representation_names();

/// What the file holds of that name; of the empty name the first that it holds. The others are dropped. Error E6002
/// where it isn't there. path: for messages.
Status choose_representation(fetex::FetexFile& file, const std::string& name, const std::string& path);

/// Calls visit with the texture that choose_representation left.
template <class Visit> auto with_texture(const fetex::FetexFile& file, const Visit& visit) {
    if (file.fbt) return visit(*file.fbt);
    if (file.bilevel) return visit(*file.bilevel);
    if (file.silmap) return visit(*file.silmap);
    if (file.pinchmap) return visit(*file.pinchmap);
    return visit(*file.feature_curves);
}

/// "F0101 at byte 12: reason"
std::string describe(const fetex::Finding& finding);

} // namespace fetexc::cli
