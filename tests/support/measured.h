// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures given by functions, and their errors in one call.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>

#include "compiler/measure/errors.h"

namespace fetexc::test {

class FunctionPicture final : public measure::Picture {
  public:
    using Function = std::function<Rgba(measure::TexturePoint)>;
    FunctionPicture(GridSize texels, Function function) : texels_(texels), function_(std::move(function)) {}
    [[nodiscard]] Rgba at(measure::TexturePoint p) const override { return function_(p); }
    [[nodiscard]] GridSize texels() const override { return texels_; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return 0; }

  private:
    GridSize texels_;
    Function function_;
};

inline constexpr Rgba kBlack{0, 0, 0, 1}, kWhite{1, 1, 1, 1};

/// Black where the function holds.
template <class Holds> FunctionPicture black_where(GridSize texels, const Holds& holds) {
    return {texels, [holds](measure::TexturePoint p) { return holds(p) ? kBlack : kWhite; }};
}

inline std::unique_ptr<measure::Truth> truth_of(const Scene& scene, unsigned threads = 1) {
    Result<std::unique_ptr<measure::Truth>> truth = measure::Truth::of(scene, threads);
    if (!truth) throw std::runtime_error(truth.error().message);
    return std::move(truth).value();
}

inline measure::SizeErrors errors_at(const Scene& scene, const measure::Picture& picture, std::uint32_t pixels,
                                     unsigned threads = 1) {
    measure::MeasureOptions options;
    options.sizes = {{pixels, pixels}};
    options.threads = threads;
    const Result<std::vector<measure::SizeErrors>> errors = measure::measure(*truth_of(scene), picture, options);
    if (!errors) throw std::runtime_error(errors.error().message);
    return errors.value().front();
}

} // namespace fetexc::test
