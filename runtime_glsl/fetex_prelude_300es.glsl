#version 300 es
// SPDX-License-Identifier: Apache-2.0 OR MIT
// OpenGL ES 3.0 and WebGL 2.
precision highp float;
precision highp int;
precision highp usampler2D;
#define FETEX_UNIFORM(n) uniform
#define FETEX_VARYING(n)
