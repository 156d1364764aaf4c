// SPDX-License-Identifier: Apache-2.0 OR MIT
// Pinchmaps (Tarini and Cignoni): a bitmap, read where a small map says, so that colours on two sides of a line never mix.
// Semantics: formats/SPEC.md, section 8; the same in double: formats/pinchmap.cpp, formats/pinchmap_sampler.cpp. Goes after a
// prelude and fetex_levels.glsl.
//
//   vec4 fetexPinchmapSample(vec2 uv)
//   vec4 fetexPinchmapSampleTexel(ivec2 base, vec2 local)          the same point as texel and offset in [0,1): deep zoom
//   vec4 fetexPinchmapSampleArea(vec2 uv, vec2 pixel)              soft: a pixel with these sides in texels (clusters)
//   vec4 fetexPinchmapSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel)
//   vec4 fetexPinchmapSampleMip(vec2 uv, vec2 pixel)               any pixel; with FETEX_PINCHMAP_MIPS
//   vec4 fetexPinchmapSampleMipTexel(ivec2 base, vec2 local, vec2 pixel)
//   FetexPinchmapPlace fetexPinchmapPlaceAt(ivec2 base, vec2 local, vec2 pixel)   where the signal is read: any signal of yours
//
//   fetexPinchmapMap      2D, (width + 1) x (height + 1), edges clamped: RGBA8_SNORM, the file's bytes less 127; RGBA16I, the
//                         file's integers less 32767, or, if filtered, the same as RGBA16_SNORM
//   fetexPinchmapSignal   2D: RGBA8, RGB8 or RGBA16F; RGBA16UI for samples of 16 bits
//   fetexPinchmapMips     RGBA8 2D with a mip chain: GL's level k is the chunk PNCM of level k + 1
//
// Defined before it, by pinchmap_specialisation (host/shader_source.h) or by hand:
//   FETEX_PINCHMAP_SCALE       K: the signal has 2^K samples to a texel
//   FETEX_PINCHMAP_BITS        of the map: 8 or 16
//   FETEX_PINCHMAP_SAMPLES     1: fetexPinchmapSignal is RGBA16UI
//   FETEX_PINCHMAP_MIPS        1: there is a mip chain
//   FETEX_PINCHMAP_LINE_WIDTH  of the solid line, in texels; 0.0: none
//   FETEX_PINCHMAP_LINE_COLOR  premultiplied: a constant, or a uniform of yours
//   FETEX_PINCHMAP_FILTERED    1: one fetch a texture, through the hardware's LINEAR filter (LINEAR_MIPMAP_LINEAR of the mips),
//                              and the screen's derivatives, instead of interpolation in the shader. Filters that round their
//                              weights to 8 bits show steps when magnified. Samples of 16 bits are interpolated in the shader.

#ifndef FETEX_PINCHMAP_SCALE
#define FETEX_PINCHMAP_SCALE 0
#endif
#ifndef FETEX_PINCHMAP_BITS
#define FETEX_PINCHMAP_BITS 8
#endif
#ifndef FETEX_PINCHMAP_SAMPLES
#define FETEX_PINCHMAP_SAMPLES 0
#endif
#ifndef FETEX_PINCHMAP_MIPS
#define FETEX_PINCHMAP_MIPS 0
#endif
#ifndef FETEX_PINCHMAP_LINE_WIDTH
#define FETEX_PINCHMAP_LINE_WIDTH 0.0
#endif
#ifndef FETEX_PINCHMAP_LINE_COLOR
#define FETEX_PINCHMAP_LINE_COLOR vec4(0.0, 0.0, 0.0, 1.0)
#endif
#ifndef FETEX_PINCHMAP_FILTERED
#define FETEX_PINCHMAP_FILTERED 0
#endif

#if FETEX_PINCHMAP_BITS == 16 && !FETEX_PINCHMAP_FILTERED
FETEX_UNIFORM(0) highp isampler2D fetexPinchmapMap;
#else
FETEX_UNIFORM(0) highp sampler2D fetexPinchmapMap;
#endif
#if FETEX_PINCHMAP_SAMPLES
FETEX_UNIFORM(1) highp usampler2D fetexPinchmapSignal;
#else
FETEX_UNIFORM(1) highp sampler2D fetexPinchmapSignal;
#endif
#if FETEX_PINCHMAP_MIPS
FETEX_UNIFORM(2) highp sampler2D fetexPinchmapMips;
#endif

const float fetexPinchmapScale = float(1 << FETEX_PINCHMAP_SCALE); // samples to a texel
const float fetexPinchmapHalf = 0.5 / fetexPinchmapScale;          // h: half the side of a fexel

ivec2 fetexPinchmapSize() { return textureSize(fetexPinchmapMap, 0) - 1; }

// Steps 1 and 2, between a cluster's four texels.
struct FetexPinchmapBlend {
    vec2 direction; // times its strength
    float rest;     // 1 - |k|: what vanishes is interpolated as it is, not as a difference
    float sign;     // of k: -1 or 1, one of them in a whole cluster
    float from;     // k - gamma
    vec2 slope;     // of that, per texel
};

#if FETEX_PINCHMAP_FILTERED
FetexPinchmapBlend fetexPinchmapInterpolate(ivec2 base, vec2 local) {
    vec2 position = vec2(base) + local;
    vec4 at = textureLod(fetexPinchmapMap, (position + 0.5) / vec2(textureSize(fetexPinchmapMap, 0)), 0.0);
    FetexPinchmapBlend b;
    b.direction = at.xy, b.rest = 1.0 - abs(at.z), b.sign = at.z < 0.0 ? -1.0 : 1.0, b.from = at.z - at.w;
    vec2 right = dFdx(position), down = dFdy(position);
    float area = right.x * down.y - right.y * down.x, alongX = dFdx(b.from), alongY = dFdy(b.from);
    vec2 slope = vec2(alongX * down.y - alongY * right.y, alongY * right.x - alongX * down.x);
    b.slope = area == 0.0 ? vec2(0.0) : slope / area;
    return b;
}
#else
// direction, 1 - |k|, k - gamma; adds k.
vec4 fetexPinchmapTexel(ivec2 at, inout float sides) {
#if FETEX_PINCHMAP_BITS == 16
    vec4 texel = vec4(texelFetch(fetexPinchmapMap, at, 0)) / 32767.0;
#else
    vec4 texel = texelFetch(fetexPinchmapMap, at, 0);
#endif
    sides += texel.z;
    return vec4(texel.xy, 1.0 - abs(texel.z), texel.z - texel.w);
}

FetexPinchmapBlend fetexPinchmapInterpolate(ivec2 base, vec2 local) {
    float sides = 0.0;
    vec4 upperLeft = fetexPinchmapTexel(base, sides), upperRight = fetexPinchmapTexel(base + ivec2(1, 0), sides);
    vec4 lowerLeft = fetexPinchmapTexel(base + ivec2(0, 1), sides), lowerRight = fetexPinchmapTexel(base + 1, sides);
    vec4 upperSlope = upperRight - upperLeft, lowerSlope = lowerRight - lowerLeft;
    vec4 upper = upperLeft + upperSlope * local.x, down = lowerLeft + lowerSlope * local.x - upper;
    vec4 at = upper + down * local.y;
    FetexPinchmapBlend b;
    b.direction = at.xy, b.rest = at.z, b.sign = sides < 0.0 ? -1.0 : 1.0, b.from = at.w;
    b.slope = vec2(upperSlope.w + (lowerSlope.w - upperSlope.w) * local.y, down.w);
    return b;
}
#endif

// Step 3: 1 - |k|, linear along the pinch: of its two ways through the cluster the one nearer to what was interpolated.
float fetexPinchmapRest(FetexPinchmapBlend b, vec2 local) {
    vec2 towards = mix(vec2(b.sign), vec2(-b.sign), lessThan(b.direction, vec2(0.0)));
    vec2 ways = 0.5 - towards * (local - 0.5), off = abs(ways - b.rest);
    float way = off.x <= off.y ? ways.x : ways.y;
    return b.direction.x == 0.0 || b.direction.y == 0.0 || b.rest == 1.0 ? b.rest : way;
}

struct FetexPinchmapPlace {
    vec2 at;    // from the upper left corner of the cluster
    float line; // the part of the pixel on the solid line
};

// Steps 3 to 6, of a pixel with these sides in texels; 0: of a point.
FetexPinchmapPlace fetexPinchmapPlaceAt(ivec2 base, vec2 local, vec2 pixel) {
    const float least = 1.0 / 1099511627776.0; // keeps 0/0 out
    FetexPinchmapBlend b = fetexPinchmapInterpolate(base, local);
    float rest = fetexPinchmapRest(b, local), k = b.sign * (1.0 - rest);
    vec2 direction = clamp(b.direction / max(min(rest, b.rest), least), -1.0, 1.0);
    // The cut: which side of gamma, and how much of the pixel.
    vec2 change = abs(b.slope) * clamp(pixel, 0.0, 1.0);
    float way = b.from > 0.0 ? 1.0 : -1.0, from = abs(b.from), room = (way == b.sign ? rest : 2.0 - rest) + from;
    float reach = 0.5 * (change.x + change.y), most = fetexPinchmapHalf * max(room, 0.0);
    float part = reach > most ? most / reach : 1.0;
    float coverage = reach > 0.0 ? fetexCut(b.from, change * part) : b.from > 0.0 ? 1.0 : 0.0;
    float beyond = max(from - reach * part, 0.0) / max(room - reach * part, least);
    float shift = (2.0 * coverage - 1.0) * fetexPinchmapHalf + way * (1.0 - fetexPinchmapHalf) * beyond - k;
    FetexPinchmapPlace place;
    place.at = local + shift * direction;
    float width = 0.5 * FETEX_PINCHMAP_LINE_WIDTH * length(b.slope);
    place.line = (fetexCut(b.from + width, change) - fetexCut(b.from - width, change)) * max(abs(direction.x), abs(direction.y));
    return place;
}

vec4 fetexPinchmapFetch(ivec2 at) {
#if FETEX_PINCHMAP_SAMPLES
    return vec4(texelFetch(fetexPinchmapSignal, at, 0)) * (1.0 / 65535.0);
#else
    return texelFetch(fetexPinchmapSignal, at, 0);
#endif
}

// Step 7. at: in clusters, from the upper left corner of that one.
vec4 fetexPinchmapColor(ivec2 base, vec2 at) {
    ivec2 size = textureSize(fetexPinchmapSignal, 0), first = base << FETEX_PINCHMAP_SCALE;
#if FETEX_PINCHMAP_FILTERED && !FETEX_PINCHMAP_SAMPLES
    return textureLod(fetexPinchmapSignal, (vec2(first) + at * fetexPinchmapScale) / vec2(size), 0.0);
#else
    vec2 position = at * fetexPinchmapScale - 0.5, whole = floor(position), weight = position - whole;
    ivec2 a = clamp(first + ivec2(whole), ivec2(0), size - 1), b = clamp(first + ivec2(whole) + 1, ivec2(0), size - 1);
    vec4 upper = mix(fetexPinchmapFetch(a), fetexPinchmapFetch(ivec2(b.x, a.y)), weight.x);
    vec4 lower = mix(fetexPinchmapFetch(ivec2(a.x, b.y)), fetexPinchmapFetch(b), weight.x);
    return mix(upper, lower, weight.y);
#endif
}

vec4 fetexPinchmapSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel) {
    FetexPinchmapPlace place = fetexPinchmapPlaceAt(base, local, pixel);
    return mix(fetexPinchmapColor(base, place.at), FETEX_PINCHMAP_LINE_COLOR, place.line);
}

vec4 fetexPinchmapSampleTexel(ivec2 base, vec2 local) { return fetexPinchmapSampleAreaTexel(base, local, vec2(0.0)); }

// uv as texel and offset; outside [0,1] the border.
void fetexPinchmapPosition(vec2 uv, out ivec2 base, out vec2 local) {
    ivec2 size = fetexPinchmapSize();
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(size);
    base = min(ivec2(position), size - 1);
    local = position - vec2(base);
}

vec4 fetexPinchmapSample(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexPinchmapPosition(uv, base, local);
    return fetexPinchmapSampleTexel(base, local);
}

vec4 fetexPinchmapSampleArea(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexPinchmapPosition(uv, base, local);
    return fetexPinchmapSampleAreaTexel(base, local, pixel);
}

#if FETEX_PINCHMAP_MIPS
vec4 fetexPinchmapSampleMipTexel(ivec2 base, vec2 local, vec2 pixel) {
    FetexPinchmapPlace place = fetexPinchmapPlaceAt(base, local, pixel);
    ivec2 size = textureSize(fetexPinchmapSignal, 0);
    float longer = max(max(pixel.x, pixel.y), 0.0), part;
    int level = fetexLevel(size, longer * fetexPinchmapScale, part);
    vec2 uv = (vec2(base) + place.at) * fetexPinchmapScale / vec2(size);
    vec4 color;
#if FETEX_PINCHMAP_FILTERED
    vec4 levels = textureLod(fetexPinchmapMips, uv, max(float(level - 1) + part, 0.0));
    color = level > 0 ? levels : mix(fetexPinchmapColor(base, place.at), levels, part);
#else
    if (level > 0)
        color = fetexBilinear(fetexPinchmapMips, uv, level - 1, fetexLevelSize(size, level));
    else
        color = fetexPinchmapColor(base, place.at);
    if (part > 0.0) color = mix(color, fetexBilinear(fetexPinchmapMips, uv, level, fetexLevelSize(size, level + 1)), part);
#endif
    return mix(color, FETEX_PINCHMAP_LINE_COLOR, place.line / max(longer, 1.0));
}

vec4 fetexPinchmapSampleMip(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexPinchmapPosition(uv, base, local);
    return fetexPinchmapSampleMipTexel(base, local, pixel);
}
#endif
