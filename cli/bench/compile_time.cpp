// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bench/compile_time.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <ctime>
#include <random>

namespace fetexc::cli {
namespace {

/// Seconds of processor time of this process: the SVG front end has a thread of its own.
double processor_seconds() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double yardstick_seconds() {
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> numbers(kYardstickNumbers);
    std::generate(numbers.begin(), numbers.end(), random);
    const double start = processor_seconds();
    std::sort(numbers.begin(), numbers.end());
    return processor_seconds() - start;
}

} // namespace

double median(std::vector<double> values) {
    assert(!values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

Result<std::vector<CompileTime>> time_works(const std::vector<Work>& works, unsigned rounds) {
    std::vector<std::vector<double>> seconds(works.size()), ratios(works.size());
    for (unsigned round = 0; round < rounds; ++round) {
        const double yardstick = yardstick_seconds();
        for (std::size_t k = 0; k < works.size(); ++k) {
            const double start = processor_seconds();
            if (const Status status = works[k](); !status) return status.error();
            seconds[k].push_back(processor_seconds() - start);
            ratios[k].push_back(seconds[k].back() / yardstick);
        }
    }
    std::vector<CompileTime> times;
    for (std::size_t k = 0; k < works.size(); ++k)
        times.push_back({median(seconds[k]), median(ratios[k])});
    return times;
}

} // namespace fetexc::cli
