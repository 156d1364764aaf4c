// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/depfile.h"

#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

/// A backslash is literal unless it stands before a space or '#': then each one counts double.
std::string escape(const std::string& name) {
    std::string out;
    std::size_t backslashes = 0;
    for (const char c : name) {
        if (c == ' ' || c == '\t' || c == '#') {
            out.append(backslashes + 1, '\\');
        } else if (c == '$') {
            out += '$';
        }
        out += c;
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return out;
}

} // namespace

Result<std::string> depfile_text(const std::vector<DepfileRule>& rules) {
    std::string text;
    for (const DepfileRule& rule : rules) {
        text += escape(rule.output) + ":";
        for (const std::string& input : rule.inputs)
            text += " " + escape(input);
        text += "\n";
        for (const std::string& name : rule.inputs) {
            if (name.find('\n') != std::string::npos || rule.output.find('\n') != std::string::npos)
                return Error{ErrorClass::Usage, diag::kDepfileName,
                             "a dependency file can't name a file with a newline", name};
        }
    }
    return text;
}

} // namespace fetexc::cli
