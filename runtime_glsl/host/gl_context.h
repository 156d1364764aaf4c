// SPDX-License-Identifier: Apache-2.0 OR MIT
/// An off-screen GL context of one of the back ends. Internal to the host library.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <glad/gl.h>

#include "runtime_glsl/host/renderer.h"

namespace fetex {

/// Owns the context; its functions are in gl. Made by open_context, not current. Libraries stay loaded for the life of
/// the process: Mesa doesn't survive being unloaded.
struct GlContext {
    GladGLContext gl{};
    bool es = false;
    std::string description; ///< GL_VERSION, GL_RENDERER
    std::function<bool()> make_current;
    std::function<void()> release; ///< after it no context of this API is current
    std::function<void()> destroy; ///< released before

    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    ~GlContext() {
        if (destroy) destroy();
    }
};

/// Wants GL 3.3 core (4.3 for Glsl430), or ES 3.0 for Essl300 under EGL.
Outcome<std::unique_ptr<GlContext>> open_context(const RendererOptions& options);

/// Current for as long as it lives.
class CurrentContext {
  public:
    explicit CurrentContext(GlContext& context) : context_(context), ok_(context.make_current()) {}
    ~CurrentContext() { context_.release(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;
    [[nodiscard]] bool ok() const { return ok_; }

  private:
    GlContext& context_;
    bool ok_;
};

namespace detail {
struct ContextRequest {
    int major = 3, minor = 3;
    bool es = false;
};
// One per library: they fill in make_current, release and destroy, and load the functions.
RuntimeStatus open_osmesa(GlContext& context, const ContextRequest& request);
RuntimeStatus open_egl_surfaceless(GlContext& context, const ContextRequest& request);
RuntimeStatus open_egl_device(GlContext& context, const ContextRequest& request);
RuntimeStatus open_glfw(GlContext& context, const ContextRequest& request);

/// Fills context.gl through get_proc_address(name); the context must be current.
RuntimeStatus load_functions(GlContext& context, void* get_proc_address);
} // namespace detail

} // namespace fetex
