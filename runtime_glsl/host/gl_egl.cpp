// SPDX-License-Identifier: Apache-2.0 OR MIT
/// EGL without a surface: on Mesa's surfaceless platform, or on a device. The few types and numbers of EGL's stable ABI
/// that are needed stand here, so that building takes no EGL headers.
#include <array>
#include <cstdint>
#include <cstdio>

#include "runtime_glsl/host/dynamic_library.h"
#include "runtime_glsl/host/gl_context.h"

namespace fetex::detail {
namespace {

using Handle = void*;
using Int = std::int32_t;
constexpr unsigned kPlatformSurfaceless = 0x31dd, kPlatformDevice = 0x313f, kOpenGlApi = 0x30a2, kOpenGlEsApi = 0x30a0;
constexpr Int kNone = 0x3038, kSurfaceType = 0x3033, kPbufferBit = 1, kRenderableType = 0x3040, kOpenGlBit = 8,
              kOpenGlEs3Bit = 0x40, kMajor = 0x3098, kMinor = 0x30fb, kProfileMask = 0x30fd, kCoreProfileBit = 1;

struct Egl {
    unsigned (*initialize)(Handle, Int*, Int*);
    unsigned (*choose_config)(Handle, const Int*, Handle*, Int, Int*);
    unsigned (*bind_api)(unsigned);
    Handle (*create_context)(Handle, Handle, Handle, const Int*);
    unsigned (*make_current)(Handle, Handle, Handle, Handle);
    unsigned (*destroy_context)(Handle, Handle);
    Int (*get_error)();
    Handle (*get_proc_address)(const char*);
    Handle (*get_platform_display)(unsigned, Handle, const Int*);
    unsigned (*query_devices)(Int, Handle*, Int*);
};

RuntimeStatus find_functions(Egl& egl) {
    std::string why;
    void* library = open_library({"libEGL.so.1", "libEGL.so"}, why);
    if (!library) return RuntimeError{RuntimeErrc::BackendMissing, why};
    egl.initialize = symbol<decltype(egl.initialize)>(library, "eglInitialize");
    egl.choose_config = symbol<decltype(egl.choose_config)>(library, "eglChooseConfig");
    egl.bind_api = symbol<decltype(egl.bind_api)>(library, "eglBindAPI");
    egl.create_context = symbol<decltype(egl.create_context)>(library, "eglCreateContext");
    egl.make_current = symbol<decltype(egl.make_current)>(library, "eglMakeCurrent");
    egl.destroy_context = symbol<decltype(egl.destroy_context)>(library, "eglDestroyContext");
    egl.get_error = symbol<decltype(egl.get_error)>(library, "eglGetError");
    egl.get_proc_address = symbol<decltype(egl.get_proc_address)>(library, "eglGetProcAddress");
    if (!egl.initialize || !egl.choose_config || !egl.bind_api || !egl.create_context || !egl.make_current ||
        !egl.destroy_context || !egl.get_error || !egl.get_proc_address)
        return RuntimeError{RuntimeErrc::BackendMissing, "libEGL lacks functions of EGL 1.4"};
    egl.get_platform_display =
        reinterpret_cast<decltype(egl.get_platform_display)>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
    egl.query_devices = reinterpret_cast<decltype(egl.query_devices)>(egl.get_proc_address("eglQueryDevicesEXT"));
    if (!egl.get_platform_display)
        return RuntimeError{RuntimeErrc::BackendMissing, "libEGL lacks eglGetPlatformDisplayEXT"};
    return std::nullopt;
}

RuntimeError egl_failure(const Egl& egl, const char* what) {
    char text[96];
    std::snprintf(text, sizeof text, "%s failed, EGL error 0x%04x", what, static_cast<unsigned>(egl.get_error()));
    return {RuntimeErrc::ContextFailed, text};
}

RuntimeStatus open_on_display(GlContext& context, const Egl& egl, Handle display, const ContextRequest& request) {
    Int major = 0, minor = 0;
    if (!display || !egl.initialize(display, &major, &minor)) return egl_failure(egl, "eglInitialize");
    const unsigned api = request.es ? kOpenGlEsApi : kOpenGlApi;
    if (!egl.bind_api(api)) return egl_failure(egl, "eglBindAPI");
    const std::array<Int, 5> wanted = {kSurfaceType, kPbufferBit, kRenderableType,
                                       request.es ? kOpenGlEs3Bit : kOpenGlBit, kNone};
    Handle config = nullptr;
    Int configs = 0;
    egl.choose_config(display, wanted.data(), &config, 1, &configs);
    // Without a config (a device may have none): EGL_KHR_no_config_context.
    const std::array<Int, 7> attributes = {
        kMajor, request.major, kMinor, request.minor, request.es ? kNone : kProfileMask, kCoreProfileBit, kNone};
    Handle handle = egl.create_context(display, configs > 0 ? config : nullptr, nullptr, attributes.data());
    if (!handle) return egl_failure(egl, "eglCreateContext");
    context.make_current = [egl, display, handle, api] {
        return egl.bind_api(api) && egl.make_current(display, nullptr, nullptr, handle);
    };
    context.release = [egl, display] { egl.make_current(display, nullptr, nullptr, nullptr); };
    context.destroy = [egl, display, handle] { egl.destroy_context(display, handle); };
    if (!context.make_current()) return egl_failure(egl, "eglMakeCurrent");
    return load_functions(context, reinterpret_cast<void*>(egl.get_proc_address));
}

} // namespace

RuntimeStatus open_egl_surfaceless(GlContext& context, const ContextRequest& request) {
    Egl egl{};
    if (auto bad = find_functions(egl)) return bad;
    return open_on_display(context, egl, egl.get_platform_display(kPlatformSurfaceless, nullptr, nullptr), request);
}

/// The first device that gives a context: hardware comes before software in EGL's list.
RuntimeStatus open_egl_device(GlContext& context, const ContextRequest& request) {
    Egl egl{};
    if (auto bad = find_functions(egl)) return bad;
    if (!egl.query_devices) return RuntimeError{RuntimeErrc::BackendMissing, "libEGL lacks eglQueryDevicesEXT"};
    std::array<Handle, 16> devices{};
    Int count = 0;
    if (!egl.query_devices(static_cast<Int>(devices.size()), devices.data(), &count) || count == 0)
        return RuntimeError{RuntimeErrc::BackendMissing, "EGL knows no device"};
    RuntimeStatus last;
    for (Int k = 0; k < count; ++k) {
        const Handle display = egl.get_platform_display(kPlatformDevice, devices[static_cast<std::size_t>(k)], nullptr);
        last = open_on_display(context, egl, display, request);
        if (!last) return last;
        if (context.destroy) { // a context was made, but it isn't good enough
            context.release();
            context.destroy();
            context.make_current = nullptr;
            context.release = context.destroy = nullptr;
        }
    }
    return last;
}

} // namespace fetex::detail
