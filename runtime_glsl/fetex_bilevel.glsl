// SPDX-License-Identifier: Apache-2.0 OR MIT
// Bi-level textures (Loviscach): a small grey texture, interpolated and cut at 1/2. Semantics: formats/SPEC.md, section 6;
// the same in double: formats/bilevel.cpp. Goes after a prelude and fetex_levels.glsl.
//
//   vec4 fetexBilevelSample(vec2 uv)                                  hard
//   vec4 fetexBilevelSampleTexel(ivec2 base, vec2 local)              the same point as texel and offset in [0,1): deep zoom
//   vec4 fetexBilevelSampleArea(vec2 uv, vec2 pixel)                  soft: coverage of a pixel with these sides in texels
//   vec4 fetexBilevelSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel)
//   vec4 fetexBilevelSampleMip(vec2 uv, vec2 pixel)                   any pixel; with FETEX_BILEVEL_MIPS
//   vec4 fetexBilevelSampleMipTexel(ivec2 base, vec2 local, vec2 pixel)
//   float fetexBilevelValue(vec2 uv)                                  what is cut
//
//   fetexBilevelTexels   R8, RG8 or RGB8 2D (RGBA8 does too), one level, edges clamped
//   fetexBilevelMips     R8 2D with a mip chain: GL's level k is the chunk BLVM of level k + 1; edges clamped
//   fetexBilevelImage    RGBA8 2D
//
// Defined before it, by bilevel_specialisation (host/shader_source.h) or by hand:
//   FETEX_BILEVEL_RULE      0 single, 1 min, 2 max, 3 median; FETEX_BILEVEL_CHANNELS follows, 1, 2, 2, 3
//   FETEX_BILEVEL_BELOW, FETEX_BILEVEL_ABOVE   premultiplied colours: constants, or uniforms of yours
//   FETEX_BILEVEL_IMAGE     1: fetexBilevelImage is the colour above
//   FETEX_BILEVEL_MIPS      1: there is a mip chain
//   FETEX_BILEVEL_FILTERED  1: one fetch through the hardware's LINEAR filter instead of interpolation in the shader, and
//                           the screen's derivatives instead of the gradient. Filters that round their weights to 8 bits
//                           move edges by up to 1/512 texel, those that round results show steps when magnified.

#ifndef FETEX_BILEVEL_RULE
#define FETEX_BILEVEL_RULE 0
#endif
#ifndef FETEX_BILEVEL_CHANNELS
#if FETEX_BILEVEL_RULE == 0
#define FETEX_BILEVEL_CHANNELS 1
#elif FETEX_BILEVEL_RULE == 3
#define FETEX_BILEVEL_CHANNELS 3
#else
#define FETEX_BILEVEL_CHANNELS 2
#endif
#endif
#ifndef FETEX_BILEVEL_BELOW
#define FETEX_BILEVEL_BELOW vec4(0.0)
#endif
#ifndef FETEX_BILEVEL_ABOVE
#define FETEX_BILEVEL_ABOVE vec4(1.0)
#endif
#ifndef FETEX_BILEVEL_IMAGE
#define FETEX_BILEVEL_IMAGE 0
#endif
#ifndef FETEX_BILEVEL_MIPS
#define FETEX_BILEVEL_MIPS 0
#endif
#ifndef FETEX_BILEVEL_FILTERED
#define FETEX_BILEVEL_FILTERED 0
#endif
// Change of a value along each side of the pixel.
#ifndef FETEX_BILEVEL_DERIVATIVES
#define FETEX_BILEVEL_DERIVATIVES(t) vec2(dFdx(t), dFdy(t))
#endif
// One fetch gets a channel of four texels. For three channels four fetches of a texel are not dearer.
#ifndef FETEX_BILEVEL_GATHER
#if FETEX_BILEVEL_CHANNELS == 1 && (__VERSION__ >= 400 || defined(GL_ARB_texture_gather))
#define FETEX_BILEVEL_GATHER 1
#elif FETEX_BILEVEL_CHANNELS == 2 && (__VERSION__ >= 400 || defined(GL_ARB_gpu_shader5))
#define FETEX_BILEVEL_GATHER 1
#else
#define FETEX_BILEVEL_GATHER 0
#endif
#endif

FETEX_UNIFORM(0) highp sampler2D fetexBilevelTexels;
#if FETEX_BILEVEL_MIPS
FETEX_UNIFORM(1) highp sampler2D fetexBilevelMips;
#endif
#if FETEX_BILEVEL_IMAGE
FETEX_UNIFORM(2) highp sampler2D fetexBilevelImage;
#endif

#if FETEX_BILEVEL_CHANNELS == 1
#define FETEX_BILEVEL_VALUES float
#define FETEX_BILEVEL_SWIZZLE r
#elif FETEX_BILEVEL_CHANNELS == 2
#define FETEX_BILEVEL_VALUES vec2
#define FETEX_BILEVEL_SWIZZLE rg
#else
#define FETEX_BILEVEL_VALUES vec3
#define FETEX_BILEVEL_SWIZZLE rgb
#endif

ivec2 fetexBilevelSize() { return textureSize(fetexBilevelTexels, 0); }

// Chosen: of the slopes along x and y those of the channel whose value the rule takes.
#if FETEX_BILEVEL_RULE == 0
float fetexBilevelCombine(FETEX_BILEVEL_VALUES v) { return v; }
vec2 fetexBilevelChosen(float x, float y, float v) { return vec2(x, y); }
#elif FETEX_BILEVEL_RULE == 1
float fetexBilevelCombine(vec2 v) { return min(v.x, v.y); }
vec2 fetexBilevelChosen(vec2 x, vec2 y, vec2 v) { return v.y < v.x ? vec2(x.y, y.y) : vec2(x.x, y.x); }
#elif FETEX_BILEVEL_RULE == 2
float fetexBilevelCombine(vec2 v) { return max(v.x, v.y); }
vec2 fetexBilevelChosen(vec2 x, vec2 y, vec2 v) { return v.y > v.x ? vec2(x.y, y.y) : vec2(x.x, y.x); }
#else
float fetexBilevelCombine(vec3 v) { return max(min(v.x, v.y), min(max(v.x, v.y), v.z)); }
vec2 fetexBilevelChosen(vec3 x, vec3 y, vec3 v) {
    float t = fetexBilevelCombine(v);
    return v.x == t ? vec2(x.x, y.x) : v.y == t ? vec2(x.y, y.y) : vec2(x.z, y.z);
}
#endif

// Per channel: the value at a point, and its gradient, per texel.
struct FetexBilevelValues {
    FETEX_BILEVEL_VALUES value, slopeX, slopeY;
};

#if FETEX_BILEVEL_FILTERED
FetexBilevelValues fetexBilevelValues(ivec2 base, vec2 local) {
    FetexBilevelValues v;
    v.value = textureLod(fetexBilevelTexels, (vec2(base) + local) / vec2(fetexBilevelSize()), 0.0).FETEX_BILEVEL_SWIZZLE;
    v.slopeX = v.slopeY = FETEX_BILEVEL_VALUES(0.0); // the screen's derivatives instead
    return v;
}
#else
// Texels stand in their middles: the square of four around the point begins in this texel or the one before.
FetexBilevelValues fetexBilevelValues(ivec2 base, vec2 local) {
    vec2 at = local - 0.5, whole = floor(at), weight = at - whole;
    FETEX_BILEVEL_VALUES upperLeft, upperRight, lowerLeft, lowerRight;
#if FETEX_BILEVEL_GATHER
    // Between the four, where rounding can't reach another square. Edges are clamped by the sampler.
    vec2 between = (vec2(base) + whole + 1.0) / vec2(fetexBilevelSize());
    vec4 four = textureGather(fetexBilevelTexels, between);
#if FETEX_BILEVEL_CHANNELS == 1
    upperLeft = four.w, upperRight = four.z, lowerLeft = four.x, lowerRight = four.y;
#else
    vec4 second = textureGather(fetexBilevelTexels, between, 1);
    upperLeft = vec2(four.w, second.w), upperRight = vec2(four.z, second.z);
    lowerLeft = vec2(four.x, second.x), lowerRight = vec2(four.y, second.y);
#endif
#else
    ivec2 last = fetexBilevelSize() - 1, corner = base + ivec2(whole);
    ivec2 a = clamp(corner, ivec2(0), last), b = clamp(corner + 1, ivec2(0), last);
    upperLeft = texelFetch(fetexBilevelTexels, a, 0).FETEX_BILEVEL_SWIZZLE;
    upperRight = texelFetch(fetexBilevelTexels, ivec2(b.x, a.y), 0).FETEX_BILEVEL_SWIZZLE;
    lowerLeft = texelFetch(fetexBilevelTexels, ivec2(a.x, b.y), 0).FETEX_BILEVEL_SWIZZLE;
    lowerRight = texelFetch(fetexBilevelTexels, b, 0).FETEX_BILEVEL_SWIZZLE;
#endif
    FETEX_BILEVEL_VALUES upperSlope = upperRight - upperLeft, lowerSlope = lowerRight - lowerLeft;
    FETEX_BILEVEL_VALUES upper = upperLeft + upperSlope * weight.x, lower = lowerLeft + lowerSlope * weight.x;
    FetexBilevelValues v;
    v.slopeX = upperSlope + (lowerSlope - upperSlope) * weight.y;
    v.slopeY = lower - upper;
    v.value = upper + v.slopeY * weight.y;
    return v;
}
#endif

float fetexBilevelCoverageTexel(ivec2 base, vec2 local, vec2 pixel) {
    FetexBilevelValues v = fetexBilevelValues(base, local);
    float t = fetexBilevelCombine(v.value);
#if FETEX_BILEVEL_FILTERED
    return fetexCut(t - 0.5, FETEX_BILEVEL_DERIVATIVES(t));
#else
    return fetexCut(t - 0.5, fetexBilevelChosen(v.slopeX, v.slopeY, v.value) * clamp(pixel, 0.0, 1.0));
#endif
}

vec4 fetexBilevelAbove(ivec2 base, vec2 local) {
#if FETEX_BILEVEL_IMAGE && FETEX_BILEVEL_FILTERED
    return textureLod(fetexBilevelImage, (vec2(base) + local) / vec2(fetexBilevelSize()), 0.0);
#elif FETEX_BILEVEL_IMAGE
    return fetexBilinear(fetexBilevelImage, (vec2(base) + local) / vec2(fetexBilevelSize()), 0, textureSize(fetexBilevelImage, 0));
#else
    return FETEX_BILEVEL_ABOVE;
#endif
}

vec4 fetexBilevelColor(float coverage, ivec2 base, vec2 local) {
    return mix(FETEX_BILEVEL_BELOW, fetexBilevelAbove(base, local), coverage);
}

vec4 fetexBilevelSampleTexel(ivec2 base, vec2 local) {
    float t = fetexBilevelCombine(fetexBilevelValues(base, local).value);
    return fetexBilevelColor(t > 0.5 ? 1.0 : 0.0, base, local);
}

vec4 fetexBilevelSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel) {
    return fetexBilevelColor(fetexBilevelCoverageTexel(base, local, pixel), base, local);
}

// uv as texel and offset; outside [0,1] the border.
void fetexBilevelPosition(vec2 uv, out ivec2 base, out vec2 local) {
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(fetexBilevelSize()), whole = floor(position);
    base = ivec2(whole);
    local = position - whole;
}

float fetexBilevelValue(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexBilevelPosition(uv, base, local);
    return fetexBilevelCombine(fetexBilevelValues(base, local).value);
}

vec4 fetexBilevelSample(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexBilevelPosition(uv, base, local);
    return fetexBilevelSampleTexel(base, local);
}

vec4 fetexBilevelSampleArea(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexBilevelPosition(uv, base, local);
    return fetexBilevelSampleAreaTexel(base, local, pixel);
}

#if FETEX_BILEVEL_MIPS
float fetexBilevelMipLevel(vec2 uv, int level) {
    return fetexBilinear(fetexBilevelMips, uv, level - 1, fetexLevelSize(fetexBilevelSize(), level)).r;
}

vec4 fetexBilevelSampleMipTexel(ivec2 base, vec2 local, vec2 pixel) {
    vec2 uv = (vec2(base) + local) / vec2(fetexBilevelSize());
    float part;
    int level = fetexLevel(fetexBilevelSize(), max(pixel.x, pixel.y), part);
    float coverage = level > 0 ? fetexBilevelMipLevel(uv, level) : fetexBilevelCoverageTexel(base, local, pixel);
    if (part > 0.0) coverage = mix(coverage, fetexBilevelMipLevel(uv, level + 1), part * part);
    return fetexBilevelColor(coverage, base, local);
}

vec4 fetexBilevelSampleMip(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexBilevelPosition(uv, base, local);
    return fetexBilevelSampleMipTexel(base, local, pixel);
}
#endif
