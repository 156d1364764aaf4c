// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The .glsl files, put into the library at build time by embed.cmake.
#pragma once

namespace fetex {

struct EmbeddedShader {
    const char* name; ///< file name; nullptr ends the table
    const char* text;
};
extern const EmbeddedShader kEmbeddedShaders[];

} // namespace fetex
