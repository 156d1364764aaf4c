#version 430 core
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Desktop OpenGL 4.3 and later: texture units 0 and 1 are bound in the text (a literal: sums need GLSL 4.4).
#define FETEX_UNIFORM(n) layout(binding = n) uniform
#define FETEX_VARYING(n) layout(location = n)
