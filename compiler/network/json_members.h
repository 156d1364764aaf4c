// SPDX-License-Identifier: GPL-3.0-or-later
/// Members of untrusted JSON, for the readers of this stage.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "compiler/diagnostics.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc::json {

using Json = nlohmann::json;

/// Leaves a reader; never leaves this stage.
struct Refused {
    Error error;
};

[[noreturn]] inline void refuse(int code, std::string message, std::string place) {
    throw Refused{{ErrorClass::InvalidInput, code, std::move(message), std::move(place)}};
}

inline const Json& member(const Json& object, const char* name, const std::string& place) {
    const auto found = object.find(name);
    if (found == object.end()) refuse(diag::kNetworkMember, std::string("the member ") + name + " is missing", place);
    return *found;
}

inline const Json& array(const Json& value, const char* name, const std::string& place) {
    if (!value.is_array()) refuse(diag::kNetworkMember, std::string(name) + " isn't an array", place);
    return value;
}

inline void check_members(const Json& object, std::initializer_list<std::string_view> known, const std::string& place) {
    for (const auto& [name, value] : object.items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            refuse(diag::kNetworkMember, "unknown member \"" + name + "\"", place);
}

inline double number(const Json& value, const char* name, const std::string& place) {
    if (!value.is_number()) refuse(diag::kNetworkMember, std::string(name) + " isn't a number", place);
    return value.get<double>();
}

/// Empty if there is none.
inline std::string text(const Json& object, const char* name, const std::string& place) {
    const auto found = object.find(name);
    if (found == object.end()) return {};
    if (!found->is_string()) refuse(diag::kNetworkMember, std::string(name) + " isn't a string", place);
    return found->get<std::string>();
}

/// Three or four numbers from `first` on, 0 … 1.
inline Rgba color_numbers(const Json& numbers, std::size_t first, const char* name, const std::string& place) {
    const std::size_t count = numbers.size() - std::min(first, numbers.size());
    if (count != 3 && count != 4)
        refuse(diag::kNetworkMember, std::string(name) + " hasn't three or four numbers", place);
    std::array<double, 4> v = {0, 0, 0, 1};
    for (std::size_t k = 0; k < count; ++k) {
        v[k] = number(numbers[first + k], name, place);
        if (!(v[k] >= 0 && v[k] <= 1))
            refuse(diag::kNetworkNumber, std::string(name) + " has a number outside 0 … 1", place);
    }
    return {v[0], v[1], v[2], v[3]};
}

inline std::optional<Rgba> color(const Json& object, const char* name, const std::string& place) {
    const auto found = object.find(name);
    if (found == object.end()) return std::nullopt;
    return color_numbers(array(*found, name, place), 0, name, place);
}

/// Of bytes that hold one value. Errors 1501, 1503, 1504.
Json parse(std::span<const std::uint8_t> bytes);

} // namespace fetexc::json
