// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__SANITIZE_THREAD__)
#include <atomic>
#else
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#endif

#include "compiler/huge_pages.h"

namespace fetexc {

/// How many threads `threads` asks for: no more than there are processors.
inline std::size_t thread_count(unsigned threads) {
    const unsigned all = std::max(1u, std::thread::hardware_concurrency());
    return threads == 0 ? all : std::min(threads, all);
}

#if !defined(__SANITIZE_THREAD__)
/// oneTBB warns of more threads than there are processors; `automatic` obeys masks of processors.
inline tbb::task_arena arena_of(unsigned threads) {
    return tbb::task_arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(thread_count(threads)));
}
#endif

/// body(k) for k = 0 … count − 1, on `threads` threads (0: all). In any order: what the calls write must not depend on
/// it.
template <class Body> void parallel_for(std::size_t count, unsigned threads, const Body& body) {
#if defined(__SANITIZE_THREAD__)
    // ThreadSanitizer can't see how oneTBB, a library built without it, orders its threads: plain threads here.
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t k = next++; k < count; k = next++)
            body(k);
    };
    std::vector<std::thread> pool(thread_count(threads));
    for (std::thread& t : pool)
        t = std::thread(work);
    for (std::thread& t : pool)
        t.join();
#else
    arena_of(threads).execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
#endif
}

/// body(first, end) for stretches of at most `chunk` of the numbers 0 … count − 1.
template <class Body>
void parallel_for_chunks(std::size_t count, std::size_t chunk, unsigned threads, const Body& body) {
    parallel_for((count + chunk - 1) / chunk, threads,
                 [&](std::size_t k) { body(k * chunk, std::min(count, (k + 1) * chunk)); });
}

/// Leaves new elements unwritten, for vectors that several threads fill. Large ones lie in pages of 2 MiB where the
/// system has them: first touching 4 KiB at a time takes longer than what is done with it.
template <class T> struct UnwrittenAllocator : std::allocator<T> {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    template <class U> struct rebind { using other = UnwrittenAllocator<U>; };
    template <class U> void construct(U*) {}
    template <class U, class... Args> void construct(U* p, Args&&... args) {
        std::construct_at(p, std::forward<Args>(args)...);
    }
    T* allocate(std::size_t n) {
        if (huge_pages_of(n * sizeof(T)) == 0) return std::allocator<T>::allocate(n);
        return static_cast<T*>(allocate_in_huge_pages(n * sizeof(T)));
    }
    void deallocate(T* p, std::size_t n) {
        if (huge_pages_of(n * sizeof(T)) == 0) return std::allocator<T>::deallocate(p, n);
        free_in_huge_pages(p);
    }
};
template <class T> using UnwrittenVector = std::vector<T, UnwrittenAllocator<T>>;

/// `less` is a total order, or what it takes for equal can't be told apart: the sort isn't stable.
template <class T, class Less> void parallel_sort(std::vector<T>& items, unsigned threads, const Less& less) {
#if defined(__SANITIZE_THREAD__)
    std::sort(items.begin(), items.end(), less);
    static_cast<void>(threads);
#else
    arena_of(threads).execute([&] { tbb::parallel_sort(items.begin(), items.end(), less); });
#endif
}

} // namespace fetexc
