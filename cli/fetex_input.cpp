// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/fetex_input.h"

#include <fmt/format.h>

#include "cli/io.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {

Result<std::vector<std::uint8_t>> read_fetex_bytes(const std::string& path) { return read_input(path, kMaxFetexBytes); }

std::string describe(const fetex::Finding& finding) {
    return fmt::format("{} at byte {}: {}", fetex::finding_id(finding.code), finding.offset, finding.message);
}

Result<FetexInput> fetex_of_bytes(std::span<const std::uint8_t> bytes, const std::string& path) {
    FetexInput input;
    input.bytes = bytes.size();
    if (const auto finding = fetex::read_file(input.file, bytes))
        return Error{ErrorClass::InvalidInput, diag::kInvalidFetex, describe(*finding), path};
    return input;
}

Result<FetexInput> load_fetex(const std::string& path) {
    const auto bytes = read_fetex_bytes(path);
    if (!bytes) return bytes.error();
    return fetex_of_bytes(bytes.value(), path);
}

const std::vector<std::string>& representation_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Representation& r : kRepresentations)
            all.emplace_back(r.name);
        return all;
    }();
    return names;
}

Status choose_representation(fetex::FetexFile& file, const std::string& name, const std::string& path) {
    bool found = false;
    std::string what = "texture";
    const auto look_at = [&](const Representation& r, auto& texture) {
        if (name == r.name) what = r.words;
        const bool wanted = name.empty() ? !found : name == r.name;
        if (wanted && texture)
            found = true;
        else
            texture.reset();
    };
    look_at(kRepresentations[0], file.fbt);
    look_at(kRepresentations[1], file.bilevel);
    look_at(kRepresentations[2], file.silmap);
    look_at(kRepresentations[3], file.pinchmap);
    look_at(kRepresentations[4], file.feature_curves);
    if (found) return {};
    return Error{ErrorClass::Unsupported, diag::kNoSuchRepresentation, "holds no " + what, path};
}

} // namespace fetexc::cli
