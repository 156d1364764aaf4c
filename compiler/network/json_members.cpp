// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/json_members.h"

#include "compiler/network/network_reader.h"

namespace fetexc::json {
namespace {

std::string position_name(std::span<const std::uint8_t> bytes, std::size_t at) {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, bytes.size()));
    const auto line = 1 + std::count(bytes.begin(), end, '\n');
    const auto start = std::find(std::make_reverse_iterator(end), bytes.rend(), '\n').base();
    return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::ptrdiff_t>(end - start, 1));
}

/// The library's text without its number and position, which come before ": ", or before "] " where it names none.
std::string reason(const std::string& what) {
    const std::size_t colon = what.find(": "), bracket = what.find("] ");
    const std::size_t end = colon != std::string::npos ? colon : bracket;
    return end == std::string::npos ? what : what.substr(end + 2);
}

} // namespace

Json parse(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > kNetworkMaxBytes) refuse(diag::kNetworkTooLarge, "the network is longer than 256 MiB", "");
    try {
        return Json::parse(bytes.begin(), bytes.end());
    } catch (const Json::parse_error& e) {
        refuse(diag::kNetworkMalformed, "not JSON: " + reason(e.what()), position_name(bytes, e.byte));
    } catch (const Json::exception& e) { // a number beyond double precision
        refuse(diag::kNetworkNumber, reason(e.what()), "");
    }
}

} // namespace fetexc::json
