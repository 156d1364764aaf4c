// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace fetexc {

/// Gives a vector's memory back now; `v = {}` and clear() keep it.
template <class T, class Allocator> void release(std::vector<T, Allocator>& v) { std::vector<T, Allocator>().swap(v); }

/// Gives pages that hold nothing any more back to the system. The C library keeps what many small vectors took.
inline void release_free_pages() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

} // namespace fetexc
