// SPDX-License-Identifier: GPL-3.0-or-later
/// A renderer on every back end that this machine has, in every dialect that runs there: what conformance tests are
/// instantiated with.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "runtime_glsl/host/renderer.h"

namespace fetexc::test {

inline std::string describe(const fetex::RendererOptions& options) {
    return std::string(fetex::backend_name(options.backend)) + " " + fetex::dialect_name(options.dialect) +
           (options.texture_buffer ? " texture buffer" : "");
}

/// The back ends as they are, and the other dialects and texture buffers where Mesa draws.
inline std::vector<fetex::RendererOptions> backend_variants() {
    using fetex::Backend;
    using fetex::Dialect;
    std::vector<fetex::RendererOptions> all;
    for (const Backend backend : fetex::kBackends)
        all.push_back({.backend = backend});
    all.push_back({.backend = Backend::OSMesa, .dialect = Dialect::Glsl430});
    all.push_back({.backend = Backend::OSMesa, .dialect = Dialect::Essl300});
    all.push_back({.backend = Backend::OSMesa, .texture_buffer = true});
    all.push_back({.backend = Backend::EglSurfaceless, .dialect = Dialect::Essl300});
    return all;
}

/// A variant's name as GoogleTest wants it.
inline std::string variant_name(const testing::TestParamInfo<fetex::RendererOptions>& tested) {
    std::string name = describe(tested.param);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
    return name;
}

class BackendTest : public testing::TestWithParam<fetex::RendererOptions> {
  protected:
    /// GLFW needs a display; the others come with the packages that the build asks for and must work.
    void SetUp() override {
        auto opened = fetex::Renderer::open(GetParam());
        if (opened.ok()) {
            renderer_.emplace(std::move(opened.value()));
        } else if (GetParam().backend == fetex::Backend::Glfw && !std::getenv("DISPLAY")) {
            GTEST_SKIP() << "no DISPLAY: " << opened.error().message;
        } else {
            FAIL() << describe(GetParam()) << ": " << opened.error().message;
        }
    }

    std::optional<fetex::Renderer> renderer_;
};

} // namespace fetexc::test
