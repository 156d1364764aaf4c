// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/messages.h"

#include <cstdio>

#include <fmt/format.h>

namespace fetexc::cli {
namespace {

const char* severity_name(Severity severity) {
    switch (severity) {
    case Severity::Note:
        return "note";
    case Severity::Warning:
        return "warning";
    case Severity::Error:
        return "error";
    }
    return "error";
}

std::string describe(Severity severity, int code, std::string_view input, std::string_view place,
                     std::string_view message) {
    std::string text = fmt::format("{} {}: ", severity_name(severity), code_name(severity, code));
    if (!input.empty()) text += fmt::format("{}: ", input);
    if (!place.empty() && place != input) text += fmt::format("{}: ", place);
    return text.append(message);
}

} // namespace

int exit_code(ErrorClass cls) { return static_cast<int>(cls); }

std::string code_name(Severity severity, int code) {
    constexpr std::string_view kLetters = "NWE";
    return fmt::format("{}{:04}", kLetters[static_cast<std::size_t>(severity)], code);
}

std::string describe(const Error& error, std::string_view input) {
    return describe(Severity::Error, error.code, input, error.place, error.message);
}

std::string describe(const Diagnostic& diagnostic, std::string_view input) {
    return describe(diagnostic.severity, diagnostic.code, input, diagnostic.place, diagnostic.message);
}

std::string printable(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            out += fmt::format("\\x{:02x}", byte);
        } else {
            out += c;
        }
    }
    return out;
}

void print_message(const std::string& text) { fmt::print(stderr, "fetexc: {}\n", printable(text)); }

void print_diagnostics(const std::vector<Diagnostic>& diagnostics, std::string_view input, bool quiet) {
    for (const Diagnostic& diagnostic : diagnostics) {
        if (!quiet || diagnostic.severity == Severity::Error) print_message(describe(diagnostic, input));
    }
}

int report_error(const Error& error, std::string_view input) {
    print_message(describe(error, input));
    return exit_code(error.cls);
}

} // namespace fetexc::cli
