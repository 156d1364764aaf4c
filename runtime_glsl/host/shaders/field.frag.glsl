// SPDX-License-Identifier: Apache-2.0 OR MIT
// One channel between two colours, interpolated in the shader: some drivers' filters round to 8 bits, which moves the
// edge. The grid is shifted by half a texel.
FETEX_UNIFORM(0) highp sampler2D fetexField;

float fetexFieldTexel(ivec2 at) {
    return texelFetch(fetexField, clamp(at, ivec2(0), textureSize(fetexField, 0) - 1), 0).r;
}

vec4 fetexSampleAt(ivec2 base, vec2 local) {
    float upper = mix(fetexFieldTexel(base), fetexFieldTexel(base + ivec2(1, 0)), local.x);
    float lower = mix(fetexFieldTexel(base + ivec2(0, 1)), fetexFieldTexel(base + ivec2(1, 1)), local.x);
    float value = mix(upper, lower, local.y);
#ifdef FETEX_FIELD_RANGE
    // The distance in samples, as coverage of one that the edge runs straight through.
    float texels = float(fetexStep.x) + float(uint(fetexStep.z)) * (1.0 / 4294967296.0);
    float above = clamp((value - 0.5) * FETEX_FIELD_RANGE / texels + 0.5, 0.0, 1.0);
#else
    float above = step(0.5, value);
#endif
    return mix(FETEX_FIELD_BELOW, FETEX_FIELD_ABOVE, above);
}
