// SPDX-License-Identifier: Apache-2.0 OR MIT
// The sample grid of a tile in 32.32 fixed point (host/sample_grid.h), and the average over a pixel's samples.
#ifdef FETEX_VULKAN
layout(push_constant) uniform FetexView {
    ivec4 fetexOrigin;
    ivec4 fetexStep;
    int fetexSupersample;
#ifdef FETEX_VIEW_FOOTPRINT
    vec2 fetexPixelSides; // in texels
#endif
};
#else
uniform highp ivec4 fetexOrigin; // integer x, y; fraction x, y in 2^-32 as bits
uniform highp ivec4 fetexStep;
uniform highp int fetexSupersample;
#ifdef FETEX_VIEW_FOOTPRINT
uniform highp vec2 fetexPixelSides;
#endif
#endif

FETEX_VARYING(0) out highp vec4 fetexPixel;

// origin + q*step for one axis, q < 2^13: the product with the fraction in two halves that fit in 32 bits.
void fetexAxis(int origin, uint originFraction, int stepWhole, uint stepFraction, uint q, out int whole,
               out uint fraction) {
    uint lowHalf = q * (stepFraction & 0xffffu);
    uint highHalf = q * (stepFraction >> 16u) + (lowHalf >> 16u);
    uint product = (highHalf << 16u) | (lowHalf & 0xffffu);
    fraction = originFraction + product;
    uint carry = fraction < originFraction ? 1u : 0u;
    whole = origin + int(q) * stepWhole + int((highHalf >> 16u) + carry);
}

// Integer texel, and the local offset as a multiple of 2^-24, exact in fp32.
void fetexPosition(uvec2 q, out ivec2 base, out vec2 local) {
    uint fx, fy;
    fetexAxis(fetexOrigin.x, uint(fetexOrigin.z), fetexStep.x, uint(fetexStep.z), q.x, base.x, fx);
    fetexAxis(fetexOrigin.y, uint(fetexOrigin.w), fetexStep.y, uint(fetexStep.w), q.y, base.y, fy);
    local = vec2(float(fx >> 8u), float(fy >> 8u)) * (1.0 / 16777216.0);
}

// Outside the texture the nearest point of its border.
void fetexClampPosition(inout ivec2 base, inout vec2 local, ivec2 size) {
    local = mix(local, vec2(0.0), lessThan(base, ivec2(0)));
    local = mix(local, vec2(65535.0 / 65536.0), greaterThanEqual(base, size));
    base = clamp(base, ivec2(0), size - 1);
}

vec4 fetexSampleAt(ivec2 base, vec2 local);

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < fetexSupersample; ++y) {
        for (int x = 0; x < fetexSupersample; ++x) {
            ivec2 base;
            vec2 local;
            fetexPosition(pixel * uint(fetexSupersample) + uvec2(x, y), base, local);
            sum += fetexSampleAt(base, local);
        }
    }
    fetexPixel = sum / float(fetexSupersample * fetexSupersample);
}
