// SPDX-License-Identifier: Apache-2.0 OR MIT
#define GLAD_GL_IMPLEMENTATION
#include "runtime_glsl/host/gl_context.h"

#include "runtime_glsl/host/dynamic_library.h"

namespace fetex {
namespace detail {
namespace {

using GetProcAddress = GLADapiproc (*)(const char*);

GLADapiproc call_get_proc_address(void* get_proc_address, const char* name) {
    return reinterpret_cast<GetProcAddress>(get_proc_address)(name);
}

const char* text_or(const GLubyte* text, const char* otherwise) {
    return text ? reinterpret_cast<const char*>(text) : otherwise;
}

} // namespace

void* open_library(std::initializer_list<const char*> names, std::string& why) {
    for (const char* name : names) {
        // RTLD_LOCAL: OSMesa, libGL and libEGL define the same names; whichever were found first would break the
        // others.
        if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
        const char* reason = dlerror();
        why += (why.empty() ? "" : "; ") + std::string(reason ? reason : name);
    }
    return nullptr;
}

RuntimeStatus load_functions(GlContext& context, void* get_proc_address) {
    const int version = context.es ? gladLoadGLES2ContextUserPtr(&context.gl, call_get_proc_address, get_proc_address)
                                   : gladLoadGLContextUserPtr(&context.gl, call_get_proc_address, get_proc_address);
    if (version == 0 || !context.gl.TexImage2D || !context.gl.BindFramebuffer || !context.gl.GenVertexArrays)
        return RuntimeError{RuntimeErrc::GlTooOld, "the context lacks functions of OpenGL 3.3 or ES 3.0"};
    context.description = std::string(text_or(context.gl.GetString(GL_VERSION), "?")) + ", " +
                          text_or(context.gl.GetString(GL_RENDERER), "?");
    return std::nullopt;
}

} // namespace detail

namespace {

RuntimeStatus open_library_context(GlContext& context, Backend backend, const detail::ContextRequest& request) {
    switch (backend) {
    case Backend::OSMesa:
        return detail::open_osmesa(context, request);
    case Backend::EglSurfaceless:
        return detail::open_egl_surfaceless(context, request);
    case Backend::EglDevice:
        return detail::open_egl_device(context, request);
    case Backend::Glfw:
        return detail::open_glfw(context, request);
    }
    return RuntimeError{RuntimeErrc::BackendMissing, "unknown back end"};
}

} // namespace

const char* backend_name(Backend backend) {
    switch (backend) {
    case Backend::OSMesa:
        return "osmesa";
    case Backend::EglSurfaceless:
        return "egl-surfaceless";
    case Backend::EglDevice:
        return "egl-device";
    case Backend::Glfw:
        return "glfw";
    }
    return "";
}

Outcome<std::unique_ptr<GlContext>> open_context(const RendererOptions& options) {
    const bool egl = options.backend == Backend::EglSurfaceless || options.backend == Backend::EglDevice;
    detail::ContextRequest request;
    // OSMesa has no ES contexts; desktop GL 4.3 takes "#version 300 es" too.
    request.es = options.dialect == Dialect::Essl300 && egl;
    if (request.es) {
        request.minor = 0;
    } else if (options.dialect != Dialect::Glsl330) {
        request.major = 4;
    }
    auto context = std::make_unique<GlContext>();
    context->es = request.es;
    auto bad = open_library_context(*context, options.backend, request);
    if (context->release) context->release();
    if (bad) {
        bad->message = std::string(backend_name(options.backend)) + ": " + bad->message;
        return *bad;
    }
    return context;
}

BackendStatus probe_backend(Backend backend) {
    auto context = open_context({.backend = backend});
    if (!context) return {false, context.error().message};
    return {true, context.value()->description};
}

} // namespace fetex
