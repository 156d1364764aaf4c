// SPDX-License-Identifier: Apache-2.0 OR MIT
// Feature-based textures (Ramanarayanan, Bala, Walter, EGSR 2004): the sampler. Layout and semantics: formats/SPEC.md.
//
//   vec4 fetexFbtSample(vec2 uv)                        uv in [0,1]^2, x right, y down, edges repeated
//   vec4 fetexFbtSampleTexel(ivec2 base, vec2 local)    deep zoom: integer texel and offset in it, [0,1)^2; at the far
//                                                       border and beyond 1 - 2^-16
//
// Both give premultiplied, sRGB-encoded RGBA; in the sample format 2 colours may exceed 1. fp32 uv is good to about 1000 pixels per texel; beyond that split the
// coordinate in integers or doubles and call the second.
//
// Needs a prelude (fetex_prelude_*.glsl) and these textures:
//   fetexFbtTexels   R32UI 2D, width x height, the chunk FBTT
//   fetexFbtRecords  RGBA32UI 2D, 2048 wide (or less, if all fits in one row), the chunk FBTR padded to whole rows;
//                    with FETEX_TEXTURE_BUFFER a RGBA32UI texture buffer of the same bytes
//   fetexFbtCorners  R32UI 2D, (width+1) x (height+1), the chunk FBTC; only with FETEX_FBT_CORNERS. RG32UI in the sample
//                    formats 1 and 2
// Must be what the asset's header says, if that isn't 0:
#ifndef FETEX_FBT_SAMPLES
#define FETEX_FBT_SAMPLES 0 // sample format of corners and patches: 0 RGBA8, 1 RGBA16, 2 halves
#endif
// Specialisation, from the asset's header; each default leaves the feature in:
#ifndef FETEX_FBT_FEATURES
#define FETEX_FBT_FEATURES 1 // 0: every texel is of one region
#endif
#ifndef FETEX_FBT_DEGREES
#define FETEX_FBT_DEGREES 14 // bit d: there are pieces of degree d
#endif
#ifndef FETEX_FBT_BANDS
#define FETEX_FBT_BANDS 1 // 0: no texel is banded
#endif
#ifndef FETEX_FBT_CORNERS
#define FETEX_FBT_CORNERS 1 // 0: no region has the model corners
#endif
#ifndef FETEX_FBT_PATCHES
#define FETEX_FBT_PATCHES 1 // 0: no region has the model patch
#endif
#ifndef FETEX_FBT_SHARED
#define FETEX_FBT_SHARED 1 // 0: every run has its points in its entry
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

#if FETEX_FBT_CORNERS
FETEX_UNIFORM(2) highp usampler2D fetexFbtCorners;
#endif

vec4 fetexFbtColor(uint rgba8) {
#if FETEX_FBT_TRANSLUCENT
    uvec4 channels = uvec4(rgba8, rgba8 >> 8u, rgba8 >> 16u, rgba8 >> 24u) & 255u;
    return vec4(channels) * (1.0 / 255.0);
#else
    uvec3 channels = uvec3(rgba8, rgba8 >> 8u, rgba8 >> 16u) & 255u;
    return vec4(vec3(channels) * (1.0 / 255.0), 1.0);
#endif
}

#if FETEX_FBT_SAMPLES == 2
// A half without a sign, exact; GLSL 3.30 has no unpackHalf2x16.
float fetexFbtChannel(uint bits) {
    return bits < 0x400u ? float(bits) * (1.0 / 16777216.0) : uintBitsToFloat((bits << 13u) + 0x38000000u);
}
#elif FETEX_FBT_SAMPLES == 1
float fetexFbtChannel(uint bits) { return float(bits) * (1.0 / 65535.0); }
#endif

// A sample of the models corners and patch, its words in what a fetch returns, and its colour.
#if FETEX_FBT_SAMPLES != 0
#define FETEX_FBT_SAMPLE uvec2
#define FETEX_FBT_SAMPLE_WORDS xy
vec4 fetexFbtSampleColor(uvec2 words) {
    vec3 color = vec3(fetexFbtChannel(words.x & 0xffffu), fetexFbtChannel(words.x >> 16u), fetexFbtChannel(words.y & 0xffffu));
#if FETEX_FBT_TRANSLUCENT
    return vec4(color, fetexFbtChannel(words.y >> 16u));
#else
    return vec4(color, 1.0);
#endif
}
#else
#define FETEX_FBT_SAMPLE uint
#define FETEX_FBT_SAMPLE_WORDS x
vec4 fetexFbtSampleColor(uint word) { return fetexFbtColor(word); }
#endif

#if FETEX_FBT_FEATURES || FETEX_FBT_PATCHES
#ifdef FETEX_TEXTURE_BUFFER
FETEX_UNIFORM(1) highp usamplerBuffer fetexFbtRecords;
uvec4 fetexFbtRecord(uint index) { return texelFetch(fetexFbtRecords, int(index)); }
#else
FETEX_UNIFORM(1) highp usampler2D fetexFbtRecords;
uvec4 fetexFbtRecord(uint index) {
    return texelFetch(fetexFbtRecords, ivec2(int(index & 2047u), int(index >> 11u)), 0);
}
#endif
#endif

#if FETEX_FBT_FEATURES

uint fetexFbtWord(uvec4 record, uint slot) {
    return slot < 2u ? (slot == 0u ? record.x : record.y) : (slot == 2u ? record.z : record.w);
}

// Four words from a slot of record a on, into the next record b.
uvec4 fetexFbtWords(uvec4 a, uvec4 b, uint slot) {
    uvec4 even = slot >= 2u ? uvec4(a.zw, b.xy) : a;
    return (slot & 1u) == 0u ? even : uvec4(even.yzw, slot >= 2u ? b.z : b.x);
}

// u*2^-15 - 1/2, exact. A ray along y sees x and y swapped, so that below every ray runs along x.
vec2 fetexFbtPoint(uint word, bool swapped) {
    vec2 v = vec2(float(word & 0xffffu), float(word >> 16u)) * (1.0 / 32768.0) - 0.5;
    return swapped ? v.yx : v;
}

// Half-open in y: a ray through a point that two pieces share counts it once.
bool fetexFbtInSpan(float y0, float y1, float y) { return (y >= y0) != (y >= y1); }

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
// test includes its ends, and a step that isn't a number fails it. The step has cycles of two, from which the bracket's
// middle helps.
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
        bool cycles = k == 3 && high - low > 0.25; // steps from end to end of the bracket
        t = next >= low && next <= high && !cycles ? next : 0.5 * (low + high);
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

// The first word of an entry (SPEC section 3.3).
uint fetexFbtPieces(uint bits, uint degree) { return ((bits >> 10u) & 3u) == degree ? bits & 0x3ffu : 0u; }
bool fetexFbtIsLastRun(uint bits) { return (bits & 0x4000u) != 0u; } // of its feature
bool fetexFbtIsLast(uint bits) { return (bits & 0x8000u) != 0u; }    // of its list

// Whether the ray runs along y; whether towards smaller coordinates.
bool fetexFbtRaySwapped(uint bits) {
#if (FETEX_FBT_DIRECTIONS & 12) == 0
    return false;
#elif (FETEX_FBT_DIRECTIONS & 3) == 0
    return true;
#else
    return (bits & 0x2000u) != 0u;
#endif
}

bool fetexFbtRayNegative(uint bits) {
#if (FETEX_FBT_DIRECTIONS & 10) == 0
    return false;
#elif (FETEX_FBT_DIRECTIONS & 5) == 0
    return true;
#else
    return (bits & 0x1000u) != 0u;
#endif
}

// Goes through the points of a run.
struct FetexFbtPoints {
    uint at;      // word of the point
    uvec4 record; // that holds it
};

// At the first point. entry: the first record of the entry at `index`.
FetexFbtPoints fetexFbtRunPoints(uvec4 entry, uint index) {
    FetexFbtPoints points = FetexFbtPoints(index * 4u + 2u, entry);
#if FETEX_FBT_SHARED
    if ((entry.x & 0x100000u) != 0u) points = FetexFbtPoints(entry.z, fetexFbtRecord(entry.z >> 2u));
#endif
    return points;
}

uint fetexFbtFirstPoint(FetexFbtPoints points) {
#if FETEX_FBT_SHARED
    return fetexFbtWord(points.record, points.at & 3u);
#else
    return points.record.z;
#endif
}

uint fetexFbtNextPoint(inout FetexFbtPoints points) {
    ++points.at;
    uint slot = points.at & 3u;
    if (slot == 0u) points.record = fetexFbtRecord(points.at >> 2u);
    return fetexFbtWord(points.record, slot);
}

// The points of a quadratic or a cubic; goes to its last, the first of the next piece.
uvec4 fetexFbtNextPiece(inout FetexFbtPoints points, uint degree) {
    uint slot = points.at & 3u;
    uvec4 next = points.record;
    if (slot + degree > 3u) next = fetexFbtRecord((points.at >> 2u) + 1u);
    uvec4 words = fetexFbtWords(points.record, next, slot);
    points = FetexFbtPoints(points.at + degree, next);
    return words;
}

// Whether the run's pieces are crossed an odd number of times (FBT section 4.5). entry: the first record of the entry at
// `index`.
bool fetexFbtRunParity(uvec4 entry, uint index, vec2 local) {
    FetexFbtPoints points = fetexFbtRunPoints(entry, index);
    bool swapped = fetexFbtRaySwapped(entry.x), negative = fetexFbtRayNegative(entry.x);
    vec2 p = swapped ? local.yx : local;
    bool odd = false;
    // Loop counts rather than branches: software renderers execute both sides of a branch, but no loop of length 0.
#if (FETEX_FBT_DEGREES & 2) != 0
    uint lines = fetexFbtPieces(entry.x, 1u);
    if (lines > 0u) {
        vec2 start = fetexFbtPoint(fetexFbtFirstPoint(points), swapped);
        for (uint k = 0u; k < lines; ++k) {
            vec2 end = fetexFbtPoint(fetexFbtNextPoint(points), swapped);
            odd = odd != fetexFbtCrossesLine(start, end, p, negative);
            start = end;
        }
    }
#endif
#if (FETEX_FBT_DEGREES & 4) != 0
    uint quadratics = fetexFbtPieces(entry.x, 2u);
    for (uint k = 0u; k < quadratics; ++k) {
        uvec4 words = fetexFbtNextPiece(points, 2u);
        odd = odd != fetexFbtCrossesQuadratic(fetexFbtPoint(words.x, swapped), fetexFbtPoint(words.y, swapped),
                                              fetexFbtPoint(words.z, swapped), p, negative);
    }
#endif
#if (FETEX_FBT_DEGREES & 8) != 0
    uint cubics = fetexFbtPieces(entry.x, 3u);
    for (uint k = 0u; k < cubics; ++k) {
        uvec4 words = fetexFbtNextPiece(points, 3u);
        odd = odd != fetexFbtCrossesCubic(fetexFbtPoint(words.x, swapped), fetexFbtPoint(words.y, swapped),
                                          fetexFbtPoint(words.z, swapped), fetexFbtPoint(words.w, swapped), p, negative);
    }
#endif
    return odd;
}

// A word, counted from a record on.
uint fetexFbtWordFrom(uint index, uint word) { return fetexFbtWord(fetexFbtRecord(index + (word >> 2u)), word & 3u); }

#if FETEX_FBT_BANDS
// The band directory (SPEC section 3.2): how many bands, where one ends, and the record of its entry list.
uint fetexFbtBandCount(uint directory) { return fetexFbtRecord(directory).x; }

float fetexFbtBandEnd(uint directory, uint band) {
    uint ends = fetexFbtWordFrom(directory, 1u + (band >> 1u));
    return float((band & 1u) == 0u ? ends & 0xffffu : ends >> 16u) * (1.0 / 32768.0) - 0.5;
}

uint fetexFbtBandList(uint directory, uint bands, uint band) {
    return fetexFbtWordFrom(directory, 1u + ((bands + 1u) >> 1u) + band);
}

// The band that holds y. At most 2^15 bands: their ends are different u16.
uint fetexFbtFindBand(uint directory, uint bands, float y) {
    uint low = 0u, high = bands - 1u;
    for (int k = 0; k < 16 && low < high; ++k) {
        uint middle = (low + high) >> 1u;
        if (y < fetexFbtBandEnd(directory, middle)) high = middle; else low = middle + 1u;
    }
    return low;
}
#endif

// Words of an entry before the sample of the rest.
uint fetexFbtEntryWords(uint bits) {
#if FETEX_FBT_SHARED
    if ((bits & 0x100000u) != 0u) return 3u;
#endif
    return (bits & 0x3ffu) * ((bits >> 10u) & 3u) + 3u;
}

// The record of the entry after the one at `index`.
uint fetexFbtNextEntry(uint index, uint bits) { return index + ((fetexFbtEntryWords(bits) + 3u) >> 2u); }

// Model and sample of a feature, of the entry of its last run; and of the rest, of the last entry.
uvec2 fetexFbtFeatureRegion(uvec4 entry) { return uvec2((entry.x >> 16u) & 3u, entry.y); }

uvec2 fetexFbtRestRegion(uvec4 entry, uint index) {
    uint words = fetexFbtEntryWords(entry.x), rest = entry.w;
    if (words > 3u) rest = fetexFbtWordFrom(index, words);
    return uvec2((entry.x >> 18u) & 3u, rest);
}

// Region of the first feature, in order, that has the point inside; else of the rest (FBT section 4.5).
uvec2 fetexFbtFindRegion(uint index, vec2 local) {
    uvec4 entry = uvec4(0u);
    bool odd = false;
    for (int k = 0; k < FETEX_FBT_MAX_ENTRIES; ++k) {
        entry = fetexFbtRecord(index);
        odd = odd != fetexFbtRunParity(entry, index, local);
        bool lastRun = fetexFbtIsLastRun(entry.x);
        if ((odd && lastRun) || fetexFbtIsLast(entry.x)) break;
        odd = odd && !lastRun;
        index = fetexFbtNextEntry(index, entry.x);
    }
    if (odd) return fetexFbtFeatureRegion(entry);
    return fetexFbtRestRegion(entry, index);
}

#endif // FETEX_FBT_FEATURES

// The models of SPEC section 3.4. region: model, sample.
vec4 fetexFbtShade(ivec2 base, vec2 local, uvec2 region) {
#if FETEX_FBT_CORNERS || FETEX_FBT_PATCHES
    if (region.x != 0u) {
        FETEX_FBT_SAMPLE upperLeft = FETEX_FBT_SAMPLE(0u), upperRight = upperLeft, lowerLeft = upperLeft, lowerRight = upperLeft;
#if FETEX_FBT_PATCHES
        if (region.x == 2u) {
            uvec4 record = fetexFbtRecord(region.y);
#if FETEX_FBT_SAMPLES != 0
            uvec4 second = fetexFbtRecord(region.y + 1u);
            upperLeft = record.xy, upperRight = record.zw, lowerLeft = second.xy, lowerRight = second.zw;
#else
            upperLeft = record.x, upperRight = record.y, lowerLeft = record.z, lowerRight = record.w;
#endif
        }
#endif
#if FETEX_FBT_CORNERS
        if (region.x == 1u) {
            upperLeft = texelFetch(fetexFbtCorners, base, 0).FETEX_FBT_SAMPLE_WORDS;
            upperRight = texelFetch(fetexFbtCorners, base + ivec2(1, 0), 0).FETEX_FBT_SAMPLE_WORDS;
            lowerLeft = texelFetch(fetexFbtCorners, base + ivec2(0, 1), 0).FETEX_FBT_SAMPLE_WORDS;
            lowerRight = texelFetch(fetexFbtCorners, base + ivec2(1, 1), 0).FETEX_FBT_SAMPLE_WORDS;
        }
#endif
        vec4 upper = mix(fetexFbtSampleColor(upperLeft), fetexFbtSampleColor(upperRight), local.x);
        vec4 lower = mix(fetexFbtSampleColor(lowerLeft), fetexFbtSampleColor(lowerRight), local.x);
        return mix(upper, lower, local.y);
    }
#endif
    return fetexFbtColor(region.y);
}

ivec2 fetexFbtSize() { return textureSize(fetexFbtTexels, 0); }

vec4 fetexFbtSampleTexel(ivec2 base, vec2 local) {
    base = clamp(base, ivec2(0), fetexFbtSize() - 1);
    uint texel = texelFetch(fetexFbtTexels, base, 0).x;
    uint kind = texel >> 30u;
    uvec2 region = uvec2(0u, (texel & 0x1000000u) != 0u ? texel | 0xff000000u : 0u);
#if FETEX_FBT_CORNERS || FETEX_FBT_PATCHES
    if (kind == 3u) region = uvec2((texel >> 28u) & 3u, texel & 0xfffffffu);
#endif
#if FETEX_FBT_FEATURES
    if (kind == 1u || kind == 2u) {
        uint first = texel & 0x3fffffffu;
#if FETEX_FBT_BANDS
        if (kind == 2u) {
            uint bands = fetexFbtBandCount(first);
            first = fetexFbtBandList(first, bands, fetexFbtFindBand(first, bands, local.y));
        }
#endif
        region = fetexFbtFindRegion(first, local);
    }
#endif
    return fetexFbtShade(base, local, region);
}

// Integer texel and offset in it, [0,1]; uv is clamped.
void fetexFbtLocate(vec2 uv, out ivec2 base, out vec2 local) {
    ivec2 size = fetexFbtSize();
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(size);
    base = min(ivec2(position), size - 1);
    local = position - vec2(base);
}

vec4 fetexFbtSample(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexFbtLocate(uv, base, local);
    return fetexFbtSampleTexel(base, min(local, vec2(65535.0 / 65536.0)));
}
