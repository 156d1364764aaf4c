// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/outputs.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "cli/io.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

namespace fs = std::filesystem;

Error usage(int code, std::string message, std::string place = {}) {
    return {ErrorClass::Usage, code, std::move(message), std::move(place)};
}

bool is_folder(const std::string& path) {
    std::error_code ec;
    return path.ends_with('/') || fs::is_directory(path, ec);
}

std::string output_beside(const std::string& input) { return fs::path(input).replace_extension(".fetex").string(); }

std::string output_in(const std::string& folder, const std::string& input) {
    return (fs::path(folder) / fs::path(input).filename().replace_extension(".fetex")).string();
}

Status check_combination(const std::vector<std::string>& inputs, const std::string& output, bool to_folder) {
    const auto from_stdin = std::count(inputs.begin(), inputs.end(), "-");
    if (from_stdin > 0 && (inputs.size() > 1 || to_folder))
        return usage(diag::kBadUsage, "input from stdin goes alone, and to a file or to stdout");
    if (inputs.size() > 1 && output == "-") return usage(diag::kBadUsage, "several inputs can't go to stdout");
    std::error_code ec;
    if (to_folder && fs::exists(output, ec) && !fs::is_directory(output, ec))
        return usage(diag::kBadUsage, "several inputs need a folder as output, and this is a file", output);
    return {};
}

Status check_collisions(const std::vector<Job>& jobs) {
    std::map<std::string, std::string> owner;
    for (const Job& job : jobs) {
        if (job.output == "-") continue;
        const auto [place, fresh] = owner.emplace(identity(job.output), job.input);
        if (!fresh)
            return usage(diag::kSameOutputTwice,
                         fmt::format("would be written from {} and from {}", place->second, job.input), job.output);
        for (const Job& other : jobs) {
            if (same_file(other.input, job.output))
                return usage(diag::kWouldOverwriteInput, "the output would overwrite an input", job.output);
        }
    }
    return {};
}

} // namespace

Result<Plan> plan_outputs(const std::vector<std::string>& inputs, const std::string& output) {
    const bool to_folder = !output.empty() && output != "-" && (inputs.size() > 1 || is_folder(output));
    if (const Status status = check_combination(inputs, output, to_folder); !status) return status.error();
    Plan plan;
    if (to_folder) plan.folder = output;
    for (const std::string& input : inputs) {
        if (to_folder) {
            plan.jobs.push_back({input, output_in(output, input)});
        } else if (!output.empty()) {
            plan.jobs.push_back({input, output});
        } else {
            plan.jobs.push_back({input, input == "-" ? "-" : output_beside(input)});
        }
    }
    if (const Status status = check_collisions(plan.jobs); !status) return status.error();
    return plan;
}

Status check_depfile(const std::string& depfile, const std::vector<Job>& jobs) {
    for (const Job& job : jobs) {
        if (job.output == "-") return usage(diag::kBadUsage, "--depfile needs an output with a name, not stdout");
        if (same_file(depfile, job.input))
            return usage(diag::kWouldOverwriteInput, "the dependency file would overwrite an input", depfile);
        if (identity(depfile) == identity(job.output))
            return usage(diag::kSameOutputTwice, "the dependency file is also an output", depfile);
    }
    return {};
}

} // namespace fetexc::cli
