#version 450
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Vulkan GLSL: combined image samplers at FETEX_SET, FETEX_BINDING and up.
#ifndef FETEX_SET
#define FETEX_SET 0
#endif
#ifndef FETEX_BINDING
#define FETEX_BINDING 0
#endif
#define FETEX_UNIFORM(n) layout(set = FETEX_SET, binding = FETEX_BINDING + n) uniform
#define FETEX_VARYING(n) layout(location = n)
#define FETEX_VULKAN 1
