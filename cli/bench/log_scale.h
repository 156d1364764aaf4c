// SPDX-License-Identifier: GPL-3.0-or-later
/// A logarithmic axis: values to pixels, and the values worth a tick.
#pragma once

#include <string>
#include <vector>

namespace fetexc::cli {

class LogScale {
  public:
    /// Shows lo … hi (both > 0, lo <= hi) and a little more on both sides; at least a third of a decade.
    LogScale(double lo, double hi, double first_pixel, double last_pixel);
    [[nodiscard]] double pixel(double value) const;
    /// Ascending, within the axis: powers of ten, every second, third … one where there would be more than `most`;
    /// where there would be fewer than three, also 2 and 5 times them, then 1.5, 3 and 7 times, then more. At least
    /// two.
    [[nodiscard]] std::vector<double> ticks(std::size_t most) const;

  private:
    [[nodiscard]] std::vector<double> multiples(const std::vector<double>& factors) const;
    double lo_, hi_; ///< decimal logarithms
    double first_, last_;
};

/// "0.002", "1.5", "20", "3,000,000".
std::string count_label(double value);
/// "500 B", "20 kB", "1.5 MB"; a kB is 1000 bytes.
std::string bytes_label(double value);

} // namespace fetexc::cli
