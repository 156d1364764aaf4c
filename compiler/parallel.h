// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace fetexc {

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
    std::vector<std::thread> pool(threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
    for (std::thread& t : pool)
        t = std::thread(work);
    for (std::thread& t : pool)
        t.join();
#else
    tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body); });
#endif
}

} // namespace fetexc
