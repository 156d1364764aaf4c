// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors and diagnostics shared by every compiler stage. No exception crosses a stage's public header.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fetexc {

/// Exit-code classes of the command line (KTX convention): what kind of thing went wrong.
enum class ErrorClass : std::uint8_t {
    Usage = 1,        ///< bad option or combination
    Io = 2,           ///< file can't be read or written
    InvalidInput = 3, ///< input file is malformed or beyond a stated limit
    Runtime = 4,      ///< GL context, shader, memory, internal invariant
    Unsupported = 5,  ///< valid, but this build can't do it
};

/// An error: a stable number, a message for people, and the place in the input ("file.svg", "path#wheel").
struct Error {
    ErrorClass cls = ErrorClass::Runtime;
    int code = 0; ///< numbered diagnostic, documented in README.md (E1001 …)
    std::string message;
    std::string place;
};

enum class Severity : std::uint8_t { Note, Warning, Error };

/// A numbered finding that does not stop the compilation.
struct Diagnostic {
    Severity severity = Severity::Warning;
    int code = 0; ///< W2001 … ; see compiler/diagnostics.h
    std::string message;
    std::string place; ///< element of the input, e.g. "text#title" or "node 17"
};

/// Value or Error.
template <class T> class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] T& value() & {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const T& value() const& {
        assert(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && {
        assert(ok());
        return std::move(*std::get_if<0>(&state_));
    }
    [[nodiscard]] const Error& error() const {
        assert(!ok());
        return *std::get_if<1>(&state_);
    }

  private:
    std::variant<T, Error> state_;
};

/// Success or Error, for functions without a value.
class [[nodiscard]] Status {
  public:
    Status() = default;
    Status(Error error) : error_(std::move(error)) {}
    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const {
        assert(!ok());
        return *error_;
    }

  private:
    std::optional<Error> error_;
};

} // namespace fetexc
