// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/messages.h"

namespace fetexc::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kRedrawEvery = std::chrono::milliseconds(50);

} // namespace

ProgressLine::ProgressLine(std::string label, bool quiet)
    : label_(printable(label)), enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    if (drawn_) fmt::print(stderr, "\r\x1b[K"); // leave the line to whatever is printed next
}

ProgressSink ProgressLine::sink() {
    if (!enabled_) return {};
    return [this](const char* stage, double fraction) { draw(stage, fraction); };
}

void ProgressLine::draw(const char* stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (drawn_ && now - last_ < kRedrawEvery) return;
    last_ = now;
    drawn_ = true;
    const double clamped = std::clamp(fraction, 0.0, 1.0);
    const std::string bar(static_cast<std::size_t>(clamped * kBarWidth), '#');
    fmt::print(stderr, "\r\x1b[K[{:<{}}] {:3.0f}% {} ({})", bar, kBarWidth, clamped * 100, label_, stage);
    std::fflush(stderr);
}

} // namespace fetexc::cli
