// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Little-endian loads and stores, the same on every machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace fetex {

using ByteSpan = std::span<const std::uint8_t>;

/// Little-endian integer at an offset. Precondition: offset + sizeof(T) ≤ bytes.size().
template <class T> T load_le(ByteSpan bytes, std::size_t offset) {
    T value = 0;
    if constexpr (std::endian::native == std::endian::little) { // one instruction; compilers don't always see it below
        std::memcpy(&value, bytes.data() + offset, sizeof(T));
        return value;
    }
    for (std::size_t k = 0; k < sizeof(T); ++k)
        value = static_cast<T>(value | static_cast<T>(static_cast<T>(bytes[offset + k]) << (8 * k)));
    return value;
}

/// Appends a little-endian integer.
template <class T> void append_le(std::vector<std::uint8_t>& out, T value) {
    for (std::size_t k = 0; k < sizeof(T); ++k)
        out.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
}

/// Words as the file has them.
inline std::vector<std::uint8_t> to_bytes(std::span<const std::uint32_t> words) {
    std::vector<std::uint8_t> bytes;
    if constexpr (std::endian::native == std::endian::little) {
        bytes.resize(words.size() * 4);
        if (!words.empty()) std::memcpy(bytes.data(), words.data(), bytes.size());
    } else {
        for (const std::uint32_t word : words)
            append_le(bytes, word);
    }
    return bytes;
}

/// Its inverse; up to three bytes left over are ignored.
inline std::vector<std::uint32_t> to_words(ByteSpan bytes) {
    std::vector<std::uint32_t> words(bytes.size() / 4);
    for (std::size_t k = 0; k < words.size(); ++k)
        words[k] = load_le<std::uint32_t>(bytes, 4 * k);
    return words;
}

} // namespace fetex
