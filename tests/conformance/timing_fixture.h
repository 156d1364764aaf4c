// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests of what samplers cost, on a software renderer with one thread. Skips where there is none. Header only.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "runtime_glsl/host/sampler_cost.h"

namespace fetexc::test {

class TimingTest : public testing::Test {
  protected:
    void SetUp() override {
        auto opened = fetex::open_for_timing();
        if (!opened && opened.error().code == fetex::RuntimeErrc::BackendMissing)
            GTEST_SKIP() << opened.error().message;
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        renderer_.emplace(std::move(opened.value()));
        ASSERT_TRUE(renderer_->is_software()) << renderer_->description();
    }
    fetex::SamplerCost cost_of(fetex::Sampler sampler, const fetex::CostOptions& options) {
        const auto cost = fetex::sampler_cost(*renderer_, sampler, options);
        EXPECT_TRUE(cost.ok()) << cost.error().message;
        return cost ? cost.value() : fetex::SamplerCost{};
    }

    std::optional<fetex::Renderer> renderer_;
};

} // namespace fetexc::test
