// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/module/module.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>

#include "compiler/diagnostics.h"

namespace fetexc {
namespace {

/// From the program's folder: beside it, installed, and from the build's test programs.
constexpr const char* kPlaces[] = {".", FETEXC_MODULES_FROM_PROGRAM, "../cli"};

} // namespace

Module::Module(const char* file) : file_(file), why_("no " + file_ + " beside the program") {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
    if (failed) return;
    for (const char* place : kPlaces) {
        const std::filesystem::path path = folder / place / file;
        if (!std::filesystem::exists(path, failed)) continue;
        handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle_ == nullptr) why_ = std::string("can't load ") + dlerror();
        return;
    }
}

Result<void*> Module::symbol(const char* name) const {
    if (handle_ == nullptr) return Error{ErrorClass::Runtime, diag::kNoModule, why_, {}};
    void* const address = dlsym(handle_, name);
    if (address != nullptr) return address;
    return Error{ErrorClass::Runtime, diag::kNoModule, file_ + " is of another version: it lacks " + name, {}};
}

} // namespace fetexc
