// SPDX-License-Identifier: Apache-2.0 OR MIT
/// dlopen with messages. Internal to the host library.
#pragma once

#include <initializer_list>
#include <string>

#include <dlfcn.h>

namespace fetex::detail {

/// The first of the libraries that can be opened, with RTLD_LOCAL; null and the reasons otherwise.
void* open_library(std::initializer_list<const char*> names, std::string& why);

/// A function of the library, null if it hasn't got it.
template <class Function> Function symbol(void* library, const char* name) {
    return reinterpret_cast<Function>(dlsym(library, name));
}

} // namespace fetex::detail
