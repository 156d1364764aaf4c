// SPDX-License-Identifier: GPL-3.0-or-later
/// Cholesky factors of matrices of a dozen rows, in plain loops: Eigen's are made for larger ones, and take several
/// times as long.
#pragma once

#include <array>
#include <cmath>

namespace fetexc::sqp {

template <int kMost> class SmallCholesky {
  public:
    /// The lower half of value(row, column). False: not positive definite.
    template <class Value> bool factor(int n, const Value& value) {
        n_ = n;
        for (int c = 0; c < n; ++c) {
            for (int r = c; r < n; ++r) {
                double sum = value(r, c);
                for (int k = 0; k < c; ++k)
                    sum -= at(r, k) * at(c, k);
                if (r == c) {
                    if (!(sum > 0)) return false;
                    at(c, c) = std::sqrt(sum);
                    inverse_[static_cast<std::size_t>(c)] = 1 / at(c, c);
                } else {
                    at(r, c) = sum * inverse_[static_cast<std::size_t>(c)];
                }
            }
        }
        return true;
    }

    /// v becomes L⁻¹·v, with L·Lᵀ the matrix.
    void forward(double* v) const {
        for (int r = 0; r < n_; ++r) {
            double sum = v[r];
            for (int k = 0; k < r; ++k)
                sum -= at(r, k) * v[k];
            v[r] = sum * inverse_[static_cast<std::size_t>(r)];
        }
    }
    /// v becomes L⁻ᵀ·v.
    void backward(double* v) const {
        for (int r = n_ - 1; r >= 0; --r) {
            double sum = v[r];
            for (int k = r + 1; k < n_; ++k)
                sum -= at(k, r) * v[k];
            v[r] = sum * inverse_[static_cast<std::size_t>(r)];
        }
    }
    void solve(double* v) const { forward(v), backward(v); }

  private:
    double& at(int r, int c) { return l_[static_cast<std::size_t>(r * kMost + c)]; }
    [[nodiscard]] double at(int r, int c) const { return l_[static_cast<std::size_t>(r * kMost + c)]; }

    int n_ = 0;
    std::array<double, static_cast<std::size_t>(kMost) * kMost> l_;
    std::array<double, kMost> inverse_; ///< of the diagonal
};

} // namespace fetexc::sqp
