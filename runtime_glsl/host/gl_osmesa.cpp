// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Mesa's software renderer without any window system.
#include <array>
#include <vector>

#include "runtime_glsl/host/dynamic_library.h"
#include "runtime_glsl/host/gl_context.h"

namespace fetex::detail {
namespace {

constexpr int kFormat = 0x22, kRgba = 0x1908, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36, kMinor = 0x37;
constexpr int kSide = 4; ///< of the buffer that OSMesa insists on; everything is drawn into framebuffer objects

struct OsMesa {
    void* (*create)(const int*, void*);
    unsigned char (*make_current)(void*, void*, unsigned, int, int);
    void (*destroy)(void*);
    void* get_proc_address;
};

bool find_functions(OsMesa& mesa, void* library) {
    mesa.create = symbol<decltype(mesa.create)>(library, "OSMesaCreateContextAttribs");
    mesa.make_current = symbol<decltype(mesa.make_current)>(library, "OSMesaMakeCurrent");
    mesa.destroy = symbol<decltype(mesa.destroy)>(library, "OSMesaDestroyContext");
    mesa.get_proc_address = symbol<void*>(library, "OSMesaGetProcAddress");
    return mesa.create && mesa.make_current && mesa.destroy && mesa.get_proc_address;
}

} // namespace

RuntimeStatus open_osmesa(GlContext& context, const ContextRequest& request) {
    std::string why;
    void* library = open_library({"libOSMesa.so.8", "libOSMesa.so"}, why);
    if (!library) return RuntimeError{RuntimeErrc::BackendMissing, why};
    OsMesa mesa{};
    if (!find_functions(mesa, library))
        return RuntimeError{RuntimeErrc::BackendMissing, "libOSMesa lacks OSMesaCreateContextAttribs"};
    const std::array<int, 9> attributes = {kFormat, kRgba,         kProfile, kCoreProfile, kMajor, request.major,
                                           kMinor,  request.minor, 0};
    void* handle = mesa.create(attributes.data(), nullptr);
    if (!handle) return RuntimeError{RuntimeErrc::ContextFailed, "OSMesaCreateContextAttribs gave no context"};
    auto buffer = std::make_shared<std::vector<unsigned char>>(kSide * kSide * 4);
    context.make_current = [mesa, handle, buffer] {
        return mesa.make_current(handle, buffer->data(), GL_UNSIGNED_BYTE, kSide, kSide) != 0;
    };
    context.release = [mesa] { mesa.make_current(nullptr, nullptr, 0, 0, 0); };
    context.destroy = [mesa, handle] { mesa.destroy(handle); };
    if (!context.make_current()) return RuntimeError{RuntimeErrc::ContextFailed, "OSMesaMakeCurrent failed"};
    return load_functions(context, mesa.get_proc_address);
}

} // namespace fetex::detail
