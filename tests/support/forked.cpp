// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/forked.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace fetexc::test {
namespace {

constexpr int kThrew = 101;

void write_all(int to, const void* data, std::size_t size) {
    const char* p = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t n = write(to, p, size);
        if (n <= 0) _exit(1);
        p += n, size -= static_cast<std::size_t>(n);
    }
}

/// Libraries that abort say so on stderr, which would look like a failed test.
void silence() {
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
}

void limit_processor_time(double seconds) {
    const auto whole = static_cast<rlim_t>(std::ceil(seconds));
    const rlimit limit{whole, whole + 1};
    if (setrlimit(RLIMIT_CPU, &limit) != 0) _exit(1);
}

[[noreturn]] void child(const std::function<std::vector<double>()>& work, int to, double seconds) {
    silence();
    limit_processor_time(seconds);
    std::vector<double> output;
    try {
        output = work();
    } catch (...) {
        _exit(kThrew);
    }
    write_all(to, output.data(), output.size() * sizeof(double));
    _exit(0);
}

/// Reads to the end; false when the deadline comes first.
bool read_all(int from, std::chrono::steady_clock::time_point deadline, std::string& out) {
    std::array<char, 65536> buffer{};
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
        pollfd ready{from, POLLIN, 0};
        if (left <= 0 || poll(&ready, 1, static_cast<int>(left)) <= 0) return false;
        const ssize_t n = read(from, buffer.data(), buffer.size());
        if (n <= 0) return true;
        out.append(buffer.data(), static_cast<std::size_t>(n));
    }
}

double processor_seconds(const rusage& u) {
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(u.ru_utime) + seconds(u.ru_stime);
}

} // namespace

ForkedRun run_forked(const std::function<std::vector<double>()>& work, double seconds) {
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) throw std::runtime_error("pipe");
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid < 0) throw std::runtime_error("fork");
    if (pid == 0) child(work, pipe_ends[1], seconds);
    close(pipe_ends[1]);
    const auto deadline =
        std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(10'000 * seconds));
    std::string bytes;
    const bool in_time = read_all(pipe_ends[0], deadline, bytes);
    close(pipe_ends[0]);
    if (!in_time) kill(pid, SIGKILL);
    int status = 0;
    rusage usage{};
    wait4(pid, &status, 0, &usage);
    ForkedRun run;
    run.seconds = processor_seconds(usage);
    if (!in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        run.ended = Ended::TimedOut;
    else if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        run.ended = Ended::Finished;
    else if (WIFEXITED(status) && WEXITSTATUS(status) == kThrew)
        run.ended = Ended::Threw;
    if (run.ended == Ended::Finished) {
        run.output.resize(bytes.size() / sizeof(double));
        std::memcpy(run.output.data(), bytes.data(), run.output.size() * sizeof(double));
    }
    return run;
}

} // namespace fetexc::test
