// SPDX-License-Identifier: Apache-2.0 OR MIT
/// A hidden GLFW window: the machine's own GL driver, where there is a display. GLFW wants the main thread.
#include "runtime_glsl/host/dynamic_library.h"
#include "runtime_glsl/host/gl_context.h"

namespace fetex::detail {
namespace {

constexpr int kVisible = 0x00020004, kMajor = 0x00022002, kMinor = 0x00022003, kForwardCompatible = 0x00022006,
              kProfile = 0x00022008, kCoreProfile = 0x00032001;

struct Glfw {
    int (*init)();
    void (*default_hints)();
    void (*hint)(int, int);
    void* (*create_window)(int, int, const char*, void*, void*);
    void (*make_current)(void*);
    void (*destroy_window)(void*);
    int (*get_error)(const char**);
    void* get_proc_address;
};

bool find_functions(Glfw& glfw, void* library) {
    glfw.init = symbol<decltype(glfw.init)>(library, "glfwInit");
    glfw.default_hints = symbol<decltype(glfw.default_hints)>(library, "glfwDefaultWindowHints");
    glfw.hint = symbol<decltype(glfw.hint)>(library, "glfwWindowHint");
    glfw.create_window = symbol<decltype(glfw.create_window)>(library, "glfwCreateWindow");
    glfw.make_current = symbol<decltype(glfw.make_current)>(library, "glfwMakeContextCurrent");
    glfw.destroy_window = symbol<decltype(glfw.destroy_window)>(library, "glfwDestroyWindow");
    glfw.get_error = symbol<decltype(glfw.get_error)>(library, "glfwGetError");
    glfw.get_proc_address = symbol<void*>(library, "glfwGetProcAddress");
    return glfw.init && glfw.default_hints && glfw.hint && glfw.create_window && glfw.make_current &&
           glfw.destroy_window && glfw.get_error && glfw.get_proc_address;
}

RuntimeError glfw_failure(const Glfw& glfw, RuntimeErrc code, const char* what) {
    const char* reason = nullptr;
    glfw.get_error(&reason);
    return {code, std::string(what) + ": " + (reason ? reason : "no reason given")};
}

} // namespace

RuntimeStatus open_glfw(GlContext& context, const ContextRequest& request) {
    std::string why;
    void* library = open_library({"libglfw.so.3", "libglfw.so"}, why);
    if (!library) return RuntimeError{RuntimeErrc::BackendMissing, why};
    Glfw glfw{};
    if (!find_functions(glfw, library))
        return RuntimeError{RuntimeErrc::BackendMissing, "libglfw lacks functions of GLFW 3.3"};
    // Never terminated: other windows of the process may be GLFW's, and a second glfwInit is free.
    if (!glfw.init()) return glfw_failure(glfw, RuntimeErrc::BackendMissing, "glfwInit");
    glfw.default_hints();
    glfw.hint(kVisible, 0);
    glfw.hint(kMajor, request.major);
    glfw.hint(kMinor, request.minor);
    glfw.hint(kForwardCompatible, 1);
    glfw.hint(kProfile, kCoreProfile);
    void* window = glfw.create_window(16, 16, "fetex", nullptr, nullptr);
    if (!window) return glfw_failure(glfw, RuntimeErrc::ContextFailed, "glfwCreateWindow");
    context.make_current = [glfw, window] {
        glfw.make_current(window);
        return true;
    };
    context.release = [glfw] { glfw.make_current(nullptr); };
    context.destroy = [glfw, window] { glfw.destroy_window(window); };
    context.make_current();
    return load_functions(context, glfw.get_proc_address);
}

} // namespace fetex::detail
