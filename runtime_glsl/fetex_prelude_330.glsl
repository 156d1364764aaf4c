#version 330 core
// SPDX-License-Identifier: Apache-2.0 OR MIT
// Desktop OpenGL 3.3 and later.
#define FETEX_UNIFORM(n) uniform
#define FETEX_VARYING(n)
#ifdef GL_ARB_texture_gather
#extension GL_ARB_texture_gather : enable
#endif
#ifdef GL_ARB_gpu_shader5
#extension GL_ARB_gpu_shader5 : enable
#endif
