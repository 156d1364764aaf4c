// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace fetexc {

inline constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// Of bytes of memory, the last at least half full: 0 of less than 1 MiB.
constexpr std::size_t huge_pages_of(std::size_t bytes) {
    return bytes / kHugePage + (bytes % kHugePage >= kHugePage / 2 ? 1 : 0);
}

/// Memory that starts with its huge pages, if the system gives any; throws std::bad_alloc.
inline void* allocate_in_huge_pages(std::size_t bytes) {
    if (bytes > static_cast<std::size_t>(PTRDIFF_MAX) - kHugePage) throw std::bad_alloc();
    const std::size_t huge = huge_pages_of(bytes) * kHugePage, whole = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    void* p = std::aligned_alloc(kHugePage, whole);
    if (p == nullptr) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    static_cast<void>(madvise(p, huge, MADV_HUGEPAGE)); // only advice: there may be none
#else
    static_cast<void>(huge);
#endif
    return p;
}

inline void free_in_huge_pages(void* p) { std::free(p); }

} // namespace fetexc
