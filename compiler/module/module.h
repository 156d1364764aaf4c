// SPDX-License-Identifier: GPL-3.0-or-later
/// Modules: libraries of the program's own, loaded only when something needs them, because what they bring along takes
/// longer to load than a small drawing to compile.
#pragma once

#include <string>

#include "compiler/result.h"

namespace fetexc {

/// Loaded by the constructor, for good: threads of the libraries behind it may outlive any call.
class Module {
  public:
    /// Looked for beside the program; where the build and the install rules put it, seen from there; nowhere else: the
    /// search path is bent by sanitizers, and strangers may write to its folders.
    explicit Module(const char* file);

    /// A function of it. Errors: kNoModule, the module isn't there or can't be loaded, or it is of another version and
    /// lacks the function.
    [[nodiscard]] Result<void*> symbol(const char* name) const;

  private:
    std::string file_;
    void* handle_ = nullptr;
    std::string why_; ///< it isn't loaded
};

} // namespace fetexc
