// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/crc32c.h"

#include <array>

#if defined(__x86_64__) && defined(__GNUC__)
#define FETEX_X86_CRC32C
#include <nmmintrin.h>
#endif

namespace fetex {
namespace {

using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

/// tables[k][b]: the checksum of byte b followed by k zero bytes, for eight bytes at a time ("slicing by 8").
constexpr Tables make_tables() {
    Tables tables{};
    for (std::uint32_t b = 0; b < 256; ++b) {
        std::uint32_t c = b;
        for (int bit = 0; bit < 8; ++bit)
            c = (c & 1u) ? c >> 1 ^ 0x82f63b78u : c >> 1;
        tables[0][b] = c;
    }
    for (std::size_t k = 1; k < 8; ++k)
        for (std::size_t b = 0; b < 256; ++b)
            tables[k][b] = tables[k - 1][b] >> 8 ^ tables[0][tables[k - 1][b] & 0xffu];
    return tables;
}

constexpr Tables kTables = make_tables();

#ifdef FETEX_X86_CRC32C
[[gnu::target("sse4.2")]] std::uint32_t crc32c_by_instruction(ByteSpan bytes) {
    std::uint64_t c = 0xffffffffu;
    std::size_t at = 0;
    for (; at + 8 <= bytes.size(); at += 8)
        c = _mm_crc32_u64(c, load_le<std::uint64_t>(bytes, at));
    auto last = static_cast<std::uint32_t>(c);
    for (; at < bytes.size(); ++at)
        last = _mm_crc32_u8(last, bytes[at]);
    return ~last;
}
#endif

} // namespace

std::uint32_t crc32c(ByteSpan bytes) {
#ifdef FETEX_X86_CRC32C
    if (__builtin_cpu_supports("sse4.2")) return crc32c_by_instruction(bytes);
#endif
    return crc32c_by_tables(bytes);
}

std::uint32_t crc32c_by_tables(ByteSpan bytes) {
    std::uint32_t c = 0xffffffffu;
    std::size_t at = 0;
    for (; at + 8 <= bytes.size(); at += 8) {
        const std::uint32_t low = c ^ load_le<std::uint32_t>(bytes, at);
        const std::uint32_t high = load_le<std::uint32_t>(bytes, at + 4);
        c = kTables[7][low & 0xffu] ^ kTables[6][low >> 8 & 0xffu] ^ kTables[5][low >> 16 & 0xffu] ^
            kTables[4][low >> 24] ^ kTables[3][high & 0xffu] ^ kTables[2][high >> 8 & 0xffu] ^
            kTables[1][high >> 16 & 0xffu] ^ kTables[0][high >> 24];
    }
    for (; at < bytes.size(); ++at)
        c = c >> 8 ^ kTables[0][(c ^ bytes[at]) & 0xffu];
    return ~c;
}

} // namespace fetex
