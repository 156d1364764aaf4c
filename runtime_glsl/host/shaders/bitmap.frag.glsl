// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bilinear in the shader: some drivers' filters round to 8 bits, and none interpolates exactly at high magnification.
// The grid is shifted by half a texel: base is the texel up and left of the sample.
FETEX_UNIFORM(0) highp sampler2D fetexBitmap;

vec4 fetexBitmapTexel(ivec2 at) {
    return texelFetch(fetexBitmap, clamp(at, ivec2(0), textureSize(fetexBitmap, 0) - 1), 0);
}

vec4 fetexSampleAt(ivec2 base, vec2 local) {
    vec4 upper = mix(fetexBitmapTexel(base), fetexBitmapTexel(base + ivec2(1, 0)), local.x);
    vec4 lower = mix(fetexBitmapTexel(base + ivec2(0, 1)), fetexBitmapTexel(base + ivec2(1, 1)), local.x);
    return mix(upper, lower, local.y);
}
