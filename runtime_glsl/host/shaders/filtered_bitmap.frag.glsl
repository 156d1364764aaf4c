// SPDX-License-Identifier: Apache-2.0 OR MIT
// The plain lookup through the hardware's filter: what the cost of the other samplers is compared with.
FETEX_UNIFORM(0) highp sampler2D fetexBitmap;

vec4 fetexSampleAt(ivec2 base, vec2 local) {
    vec2 position = vec2(base) + local + 0.5;
    return textureLod(fetexBitmap, position / vec2(textureSize(fetexBitmap, 0)), 0.0);
}
