// SPDX-License-Identifier: Apache-2.0 OR MIT
// Feature-based textures (Ramanarayanan, Bala, Walter, EGSR 2004): the sampler. Layout and semantics: formats/SPEC.md.
//
//   vec4 fetexFbtSample(vec2 uv)                        uv in [0,1]^2, x right, y down, edges repeated
//   vec4 fetexFbtSampleTexel(ivec2 base, vec2 local)    deep zoom: integer texel and offset in it, [0,1]^2
//
// Both give premultiplied, sRGB-encoded RGBA. fp32 uv is good to about 1000 pixels per texel; beyond that split the
// coordinate in integers or doubles and call the second.
//
// Needs a prelude (fetex_prelude_*.glsl) and these textures:
//   fetexFbtTexels   RG32UI 2D, (width+apron)x(height+apron), the chunk FBTT
//   fetexFbtRecords  RGBA32UI 2D, 2048 wide (or less, if all fits in one row), the chunk FBTR padded to whole rows;
//                    with FETEX_TEXTURE_BUFFER a RGBA32UI texture buffer of the same bytes
// Specialisation, from the asset's header; each default leaves the feature in:
#ifndef FETEX_FBT_APRON
#define FETEX_FBT_APRON 1 // apron of the asset, 0 or 1
#endif
#ifndef FETEX_FBT_FEATURES
#define FETEX_FBT_FEATURES 1 // 0: every texel is empty
#endif
#ifndef FETEX_FBT_DEGREES
#define FETEX_FBT_DEGREES 14 // bit d: there are pieces of degree d
#endif
#ifndef FETEX_FBT_BANDS
#define FETEX_FBT_BANDS 1 // 0: no texel is banded
#endif
#ifndef FETEX_FBT_INTERPOLATED
#define FETEX_FBT_INTERPOLATED 1 // 0: every region has one colour
#endif
#ifndef FETEX_FBT_TRANSLUCENT
#define FETEX_FBT_TRANSLUCENT 1 // 0: alpha is 1 everywhere
#endif
#ifndef FETEX_FBT_DIRECTIONS
#define FETEX_FBT_DIRECTIONS 15 // bit d: ray direction d is used (+x, -x, +y, -y)
#endif
#ifndef FETEX_FBT_MAX_ENTRIES
#define FETEX_FBT_MAX_ENTRIES 1048576 // ends the loop over a damaged list; valid lists end by themselves
#endif

FETEX_UNIFORM(0) highp usampler2D fetexFbtTexels;

vec4 fetexFbtColor(uint rgba8) {
#if FETEX_FBT_TRANSLUCENT
    uvec4 channels = uvec4(rgba8, rgba8 >> 8u, rgba8 >> 16u, rgba8 >> 24u) & 255u;
    return vec4(channels) * (1.0 / 255.0);
#else
    uvec3 channels = uvec3(rgba8, rgba8 >> 8u, rgba8 >> 16u) & 255u;
    return vec4(vec3(channels) * (1.0 / 255.0), 1.0);
#endif
}

#if FETEX_FBT_FEATURES

#ifdef FETEX_TEXTURE_BUFFER
FETEX_UNIFORM(1) highp usamplerBuffer fetexFbtRecords;
uvec4 fetexFbtRecord(uint index) { return texelFetch(fetexFbtRecords, int(index)); }
#else
FETEX_UNIFORM(1) highp usampler2D fetexFbtRecords;
uvec4 fetexFbtRecord(uint index) {
    return texelFetch(fetexFbtRecords, ivec2(int(index & 2047u), int(index >> 11u)), 0);
}
#endif

// u*2^-15 - 1/2, exact. A ray along y sees x and y swapped, so that below every ray runs along x.
vec2 fetexFbtPoint(uint word, bool swapped) {
    vec2 v = vec2(float(word & 0xffffu), float(word >> 16u)) * (1.0 / 32768.0) - 0.5;
    return swapped ? v.yx : v;
}

// Half-open in y: a ray through a point that two pieces share counts it once.
bool fetexFbtInSpan(float y0, float y1, float y) { return (y >= min(y0, y1)) != (y >= max(y0, y1)); }

#if (FETEX_FBT_DEGREES & 2) != 0
bool fetexFbtCrossesLine(vec2 a, vec2 b, vec2 p, bool negative) {
    float x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)); // not used where b.y = a.y: nothing is in the span
    return fetexFbtInSpan(a.y, b.y, p.y) && ((x > p.x) != negative);
}
#endif

#if (FETEX_FBT_DEGREES & 4) != 0
// Citardauq form: B and the root have one sign on a monotone piece, nothing cancels.
bool fetexFbtCrossesQuadratic(vec2 a, vec2 b, vec2 c, vec2 p, bool negative) {
    float A = a.y - 2.0 * b.y + c.y, B = b.y - a.y, C = a.y - p.y;
    float root = sqrt(max(B * B - A * C, 0.0));
    float denominator = B + (c.y >= a.y ? root : -root);
    float t = denominator == 0.0 ? 0.0 : clamp(-C / denominator, 0.0, 1.0);
    float x = mix(mix(a.x, b.x, t), mix(b.x, c.x, t), t);
    return fetexFbtInSpan(a.y, c.y, p.y) && ((x > p.x) != negative);
}
#endif

#if (FETEX_FBT_DEGREES & 8) != 0
// Laguerre's step, kept in a bracket: 6 steps leave at most 5e-7 texel on every monotone cubic of the u16 grid, flat
// ends and inflections included (Newton: 8 steps leave 7e-4 of the inflected ones wrong by up to 2e-2). The bracket
// test includes its ends, and a step that isn't a number fails it.
float fetexFbtSolveCubic(float y0, float y1, float y2, float y3, float y, int steps) {
    float up = y3 >= y0 ? 1.0 : -1.0;
    float a = up * (y3 - y0 + 3.0 * (y1 - y2));
    float b = up * 3.0 * (y0 - 2.0 * y1 + y2);
    float c = up * 3.0 * (y1 - y0);
    float d = up * (y0 - y);
    float low = 0.0, high = 1.0;
    float t = clamp(-d / max(a + b + c, 1e-20), 0.0, 1.0);
    for (int k = 0; k < steps; ++k) {
        float f = ((a * t + b) * t + c) * t + d;
        if (abs(f) < 2e-7) break;
        if (f < 0.0) low = t; else high = t;
        float f1 = (3.0 * a * t + 2.0 * b) * t + c;
        float f2 = 6.0 * a * t + 2.0 * b;
        float next = t - 3.0 * f / (f1 + sqrt(max(4.0 * f1 * f1 - 6.0 * f * f2, 0.0)));
        t = next >= low && next <= high ? next : 0.5 * (low + high);
    }
    return t;
}

// The bounding box of the control points settles most pieces (FBT section 5); the loop then runs zero times.
bool fetexFbtCrossesCubic(vec2 a, vec2 b, vec2 c, vec2 d, vec2 p, bool negative) {
    float left = min(min(a.x, b.x), min(c.x, d.x)), right = max(max(a.x, b.x), max(c.x, d.x));
    bool inSpan = fetexFbtInSpan(a.y, d.y, p.y);
    bool open = inSpan && p.x >= left && p.x < right;
    float t = fetexFbtSolveCubic(a.y, b.y, c.y, d.y, p.y, open ? 7 : 0);
    float x = mix(mix(mix(a.x, b.x, t), mix(b.x, c.x, t), t), mix(mix(b.x, c.x, t), mix(c.x, d.x, t), t), t);
    bool beyond = open ? x > p.x : p.x < left;
    return inSpan && (beyond != negative);
}
#endif

// Whether the run's pieces are crossed an odd number of times (FBT section 4.5). entry: SPEC section 3.3.
bool fetexFbtRunParity(uvec4 entry, vec2 local) {
    uint count = entry.y & 0xffffu, degree = (entry.y >> 16u) & 3u;
#if (FETEX_FBT_DIRECTIONS & 12) == 0
    const bool swapped = false;
#elif (FETEX_FBT_DIRECTIONS & 3) == 0
    const bool swapped = true;
#else
    bool swapped = (entry.y & 0x80000u) != 0u;
#endif
#if (FETEX_FBT_DIRECTIONS & 10) == 0
    const bool negative = false;
#elif (FETEX_FBT_DIRECTIONS & 5) == 0
    const bool negative = true;
#else
    bool negative = (entry.y & 0x40000u) != 0u;
#endif
    vec2 p = swapped ? local.yx : local;
    bool odd = false;
    // Loop counts rather than branches: software renderers execute both sides of a branch, but no loop of length 0.
#if (FETEX_FBT_DEGREES & 2) != 0
    uint lines = degree == 1u ? count : 0u;
    if (lines > 0u) {
        uvec4 words = fetexFbtRecord(entry.x);
        vec2 a = fetexFbtPoint(words.x, swapped);
        for (uint k = 1u; k <= lines; ++k) {
            uint slot = k & 3u;
            if (slot == 0u) words = fetexFbtRecord(entry.x + (k >> 2u));
            uint word = slot < 2u ? (slot == 0u ? words.x : words.y) : (slot == 2u ? words.z : words.w);
            vec2 b = fetexFbtPoint(word, swapped);
            odd = odd != fetexFbtCrossesLine(a, b, p, negative);
            a = b;
        }
    }
#endif
#if (FETEX_FBT_DEGREES & 4) != 0
    uint quadratics = degree == 2u ? count : 0u;
    for (uint k = 0u; k < quadratics; ++k) {
        uvec4 words = fetexFbtRecord(entry.x + k);
        odd = odd != fetexFbtCrossesQuadratic(fetexFbtPoint(words.x, swapped), fetexFbtPoint(words.y, swapped),
                                              fetexFbtPoint(words.z, swapped), p, negative);
    }
#endif
#if (FETEX_FBT_DEGREES & 8) != 0
    uint cubics = degree == 3u ? count : 0u;
    for (uint k = 0u; k < cubics; ++k) {
        uvec4 words = fetexFbtRecord(entry.x + k);
        odd = odd != fetexFbtCrossesCubic(fetexFbtPoint(words.x, swapped), fetexFbtPoint(words.y, swapped),
                                          fetexFbtPoint(words.z, swapped), fetexFbtPoint(words.w, swapped), p, negative);
    }
#endif
    return odd;
}

#if FETEX_FBT_BANDS
// Address of the first entry of the band that holds y. At most 2^15 bands: their ends are different u16.
uint fetexFbtFindBand(uint directory, float y) {
    uint low = 0u, high = fetexFbtRecord(directory).x - 1u;
    for (int k = 0; k < 16 && low < high; ++k) {
        uint middle = (low + high) >> 1u;
        uvec4 words = fetexFbtRecord(directory + ((middle + 1u) >> 1u));
        float end = fetexFbtPoint((middle & 1u) != 0u ? words.x : words.z, false).x;
        if (y < end) high = middle; else low = middle + 1u;
    }
    uvec4 words = fetexFbtRecord(directory + ((low + 1u) >> 1u));
    return (low & 1u) != 0u ? words.y : words.w;
}
#endif

// Sample and mask of the first feature, in order, that has the point inside; else of the terminator (FBT section 4.5).
uvec2 fetexFbtFindRegion(uint first, vec2 local) {
    uvec2 region = uvec2(0u);
    bool odd = false;
    for (int k = 0; k < FETEX_FBT_MAX_ENTRIES; ++k) {
        uvec4 entry = fetexFbtRecord(first + uint(k));
        region = entry.zw;
        if ((entry.y & 0x200000u) != 0u) break;
        odd = odd != fetexFbtRunParity(entry, local);
        if ((entry.y & 0x100000u) != 0u) {
            if (odd) break;
            odd = false;
        }
    }
    return region;
}

#endif // FETEX_FBT_FEATURES

// Corner k of the interpolation square (FBT section 4.6): the region's own sample, or a neighbouring texel's.
vec4 fetexFbtCorner(ivec2 base, uint own, uint mask, uint k) {
    uint code = (mask >> (2u * k)) & 3u;
    if (code != 0u) own = texelFetch(fetexFbtTexels, base + ivec2(int(code & 1u), int(code >> 1u)), 0).x;
    return fetexFbtColor(own);
}

vec4 fetexFbtShade(ivec2 base, vec2 local, uint own, uint mask) {
#if FETEX_FBT_INTERPOLATED
    if ((mask & 255u) != 0u) {
        vec4 upper = mix(fetexFbtCorner(base, own, mask, 0u), fetexFbtCorner(base, own, mask, 1u), local.x);
        vec4 lower = mix(fetexFbtCorner(base, own, mask, 2u), fetexFbtCorner(base, own, mask, 3u), local.x);
        return mix(upper, lower, local.y);
    }
#endif
    return fetexFbtColor(own);
}

ivec2 fetexFbtSize() { return textureSize(fetexFbtTexels, 0) - FETEX_FBT_APRON; }

vec4 fetexFbtSampleTexel(ivec2 base, vec2 local) {
    base = clamp(base, ivec2(0), fetexFbtSize() - 1);
    uvec2 texel = texelFetch(fetexFbtTexels, base, 0).xy;
    uvec2 region = uvec2(texel.x, texel.y);
#if FETEX_FBT_FEATURES
    uint kind = texel.y >> 30u;
    if (kind != 0u) {
        uint first = texel.y & 0x3fffffffu;
#if FETEX_FBT_BANDS
        if (kind == 2u) first = fetexFbtFindBand(first, local.y);
#endif
        region = fetexFbtFindRegion(first, local);
    }
#endif
    return fetexFbtShade(base, local, region.x, region.y);
}

vec4 fetexFbtSample(vec2 uv) {
    ivec2 size = fetexFbtSize();
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(size);
    ivec2 base = min(ivec2(position), size - 1);
    return fetexFbtSampleTexel(base, position - vec2(base));
}
