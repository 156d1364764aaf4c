// SPDX-License-Identifier: GPL-3.0-or-later
/// A progress line on stderr, drawn only when stderr is a terminal.
#pragma once

#include <chrono>
#include <string>

#include "compiler/compile.h"

namespace fetexc::cli {

class ProgressLine {
  public:
    /// label: what is being worked on, e.g. the file's name.
    ProgressLine(std::string label, bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Empty when nothing is to be drawn. Must not outlive the line.
    ProgressSink sink();

  private:
    void draw(const char* stage, double fraction);

    std::string label_;
    bool enabled_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point last_{};
};

} // namespace fetexc::cli
