#version 430 core
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Desktop OpenGL 4.3 and later: explicit bindings, texture units 0, 1, ...
#ifndef FETEX_BINDING
#define FETEX_BINDING 0
#endif
#define FETEX_UNIFORM(n) layout(binding = FETEX_BINDING + n) uniform
#define FETEX_VARYING(n) layout(location = n)
