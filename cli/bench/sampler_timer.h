// SPDX-License-Identifier: GPL-3.0-or-later
/// What lookups cost, by drawing with them: runtime_glsl/host/sampler_cost.h for one texture after another.
#pragma once

#include <optional>
#include <string>

#include "compiler/measure/alternatives.h"
#include "compiler/measure/pictures.h"
#include "runtime_glsl/host/sampler_cost.h"

namespace fetexc::cli {

class SamplerTimer {
  public:
    /// Before other threads are started. "osmesa", "egl", "glfw". Without GL every cost is empty, and why() says why.
    explicit SamplerTimer(const std::string& backend, std::uint32_t rounds);

    /// What draws; empty if nothing does.
    [[nodiscard]] std::string description() const { return gl_ ? gl_->description() : std::string(); }
    /// Why the last cost was empty.
    [[nodiscard]] const std::string& why() const { return why_; }

    /// Against a bilinear lookup in this bitmap, from here on.
    void compare_with(const measure::BitmapPicture& bitmap);
    std::optional<fetex::SamplerCost> cost(const fetex::FbtTexture& texture);
    std::optional<fetex::SamplerCost> area_cost(const fetex::FbtTexture& texture);
    /// Through the hardware's filter where a probe finds that good enough.
    std::optional<fetex::SamplerCost> cost(const fetex::BilevelTexture& texture);
    std::optional<fetex::SamplerCost> area_cost(const fetex::BilevelTexture& texture);
    std::optional<fetex::SamplerCost> cost(const fetex::SilmapTexture& texture);
    std::optional<fetex::SamplerCost> area_cost(const fetex::SilmapTexture& texture);
    /// Through the hardware's filter where a probe finds that good enough.
    std::optional<fetex::SamplerCost> cost(const fetex::PinchmapTexture& texture);
    std::optional<fetex::SamplerCost> area_cost(const fetex::PinchmapTexture& texture);
    std::optional<fetex::SamplerCost> cost(const fetex::FeatureCurvesTexture& texture);
    std::optional<fetex::SamplerCost> area_cost(const fetex::FeatureCurvesTexture& texture);
    std::optional<fetex::SamplerCost> cost(const measure::FieldPicture& field);
    /// Of the bitmap itself: 1 but for noise.
    std::optional<fetex::SamplerCost> cost_of_bitmap();

  private:
    fetex::RuntimeStatus upload(const fetex::BilevelTexture& texture);
    fetex::RuntimeStatus upload(const fetex::PinchmapTexture& texture);
    std::optional<fetex::SamplerCost> timed(const fetex::RuntimeStatus& uploaded, fetex::Sampler sampler);

    std::optional<fetex::Renderer> gl_;
    fetex::CostOptions options_;
    std::string why_, no_bitmap_;
};

} // namespace fetexc::cli
