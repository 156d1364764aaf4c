// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace fetexc::test {

/// Ends the program, naming the case, when the case takes longer than some processor time: a hang is found and named,
/// a busy machine isn't blamed.
class Watchdog {
  public:
    static constexpr int kSeconds = 120; ///< cases take milliseconds; sanitizers make them slower, not this slow

    Watchdog(const char* generator, unsigned long long seed, int seconds = kSeconds) {
        std::snprintf(message_, sizeof message_, "\nwatchdog: %s, seed %llu takes longer than %d s\n", generator, seed,
                      seconds);
        std::signal(SIGPROF, &Watchdog::bark);
        set(seconds);
    }
    ~Watchdog() { set(0); }
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

  private:
    static void set(int seconds) {
        const itimerval timer{{0, 0}, {seconds, 0}};
        setitimer(ITIMER_PROF, &timer, nullptr);
    }
    static void bark(int) { // only async-signal-safe calls
        std::size_t length = 0;
        while (message_[length] != '\0')
            ++length;
        [[maybe_unused]] const auto written = write(STDERR_FILENO, message_, length);
        std::abort();
    }
    static inline char message_[160] = "";
};

} // namespace fetexc::test
