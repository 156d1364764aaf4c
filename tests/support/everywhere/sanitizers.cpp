// SPDX-License-Identifier: GPL-3.0-or-later
/// Compiled into every test program, and into the command line of sanitizer builds. GL libraries keep what they
/// allocated (OSMesaMakeCurrent its framebuffer, LLVM its tables) until the process ends. Leaks of our own are still
/// reported.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FETEXC_LEAKS_ARE_CHECKED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define FETEXC_LEAKS_ARE_CHECKED 1
#endif

#ifdef FETEXC_LEAKS_ARE_CHECKED
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOSMesa\nleak:libEGL\nleak:libGLX\nleak:_dri.so\nleak:libLLVM\nleak:libglfw\nleak:libX11\n";
}
#endif

// The SVG front end hands its result over from a thread of Rust's standard library, which ThreadSanitizer can't see
// into.
#if defined(__SANITIZE_THREAD__)
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
    return "race:rust_begin_short_backtrace\nrace:std4sync4mpmc\nrace:libOSMesa\nrace:libEGL\nrace:_dri.so\nrace:"
           "libLLVM\n"
           "race:libgallium\nrace:libGLX\nrace:libglfw\n";
}
#endif
