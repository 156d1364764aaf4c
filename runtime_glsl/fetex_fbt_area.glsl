// SPDX-License-Identifier: Apache-2.0 OR MIT
// Area sampling of feature-based textures: the mean colour over a pixel, analytically. Follows fetex_fbt.glsl, whose
// textures and macros it uses; what is computed: formats/SPEC.md, 4.1.
//
//   vec4 fetexFbtSampleArea(vec2 uv, vec2 halfPixel)                       uv in [0,1]^2
//   vec4 fetexFbtSampleAreaTexel(ivec2 base, vec2 local, vec2 halfPixel)   deep zoom: integer texel and offset in it
//
// halfPixel: half the sides of the pixel along the axes of the texture, in texels; less than 2^-16 and more than 1/2 are
// taken as these. For a pixel that is turned against the texture: half the lengths of the rows of the Jacobian of the texel
// coordinates, 0.5 * sqrt(dFdx(p)^2 + dFdy(p)^2).
#ifndef FETEX_FBT_MAX_DEPTH
#define FETEX_FBT_MAX_DEPTH 7 // features around a feature; 0: none lies in another
#endif
#ifndef FETEX_FBT_AREA_EXACT
#define FETEX_FBT_AREA_EXACT 0 // 1: every texel with features that the pixel overlaps is looked at, not one for all
#endif

#if FETEX_FBT_FEATURES

// From quantised points to the frame of a ray and a box: the box is [0,1]^2, the ray runs along +x.
struct FetexFbtFrame {
    vec2 origin, scale; // of the box, in steps of the quantised coordinates
    bool swapped, negative;
};

FetexFbtFrame fetexFbtBoxFrame(vec2 low, vec2 high) {
    return FetexFbtFrame((low + 0.5) * 32768.0, (1.0 / 32768.0) / max(high - low, 1e-7), false, false);
}

FetexFbtFrame fetexFbtRayFrame(FetexFbtFrame box, uint bits) {
    return FetexFbtFrame(box.origin, box.scale, fetexFbtRaySwapped(bits), fetexFbtRayNegative(bits));
}

vec2 fetexFbtFramed(FetexFbtFrame frame, uint word) {
    vec2 v = (vec2(float(word & 0xffffu), float(word >> 16u)) - frame.origin) * frame.scale;
    v = frame.swapped ? v.yx : v;
    return vec2(frame.negative ? 1.0 - v.x : v.x, v.y);
}

// Out of every box from `end`, away from `before`; where both are one point, that point.
vec2 fetexFbtFarPoint(vec2 end, vec2 before) {
    vec2 d = end - before;
    return end + d * (1e6 / max(max(abs(d.x), abs(d.y)), 1e-20));
}

// Integral of clamp(x, 0, 1) dy along a line, y cut to [0,1].
float fetexFbtLineArea(vec2 a, vec2 b) {
    vec2 y = clamp(vec2(a.y, b.y), 0.0, 1.0);
    float slope = b.y != a.y ? (b.x - a.x) / (b.y - a.y) : 0.0;
    vec2 x = a.x + slope * (y - a.y);
    float left = min(x.x, x.y), right = max(x.x, x.y);
    vec2 t = clamp((vec2(0.0, 1.0) - left) / max(right - left, 1e-20), 0.0, 1.0); // where x enters [0,1] and leaves it
    vec2 cut = clamp(vec2(left, right), 0.0, 1.0);
    return (y.y - y.x) * (0.5 * (t.y - t.x) * (cut.x + cut.y) + 1.0 - t.y);
}

// What a curve before it enters the box (at level.x), and after it leaves (at level.y), adds. y: of its ends.
float fetexFbtOuterArea(vec2 y, vec2 level, bool rising) {
    y = clamp(y, 0.0, 1.0);
    level = clamp(level, 0.0, 1.0);
    return rising ? y.y - level.y : level.x - y.x;
}

#if (FETEX_FBT_DEGREES & 4) != 0
// Where a monotone quadratic reaches a level, citardauq form; out of [0,1]: the nearer end.
vec2 fetexFbtReachQuadratic(vec2 a, vec2 b, vec2 c, vec2 level) {
    vec2 A = a - 2.0 * b + c, B = b - a, C = a - level;
    vec2 root = sqrt(max(B * B - A * C, 0.0));
    vec2 denominator = B + mix(-root, root, greaterThanEqual(c, a));
    return clamp(-C / mix(denominator, vec2(1.0), equal(denominator, vec2(0.0))), 0.0, 1.0);
}

float fetexFbtQuadraticArea(vec2 a, vec2 b, vec2 c) {
    bvec2 rising = greaterThanEqual(c, a);
    vec2 enter = mix(vec2(1.0), vec2(0.0), rising), leave = 1.0 - enter, sgn = leave - enter;
    vec2 tIn = mix(fetexFbtReachQuadratic(a, b, c, enter), vec2(0.0), greaterThanEqual(sgn * (a - enter), vec2(0.0)));
    vec2 tOut = mix(fetexFbtReachQuadratic(a, b, c, leave), vec2(1.0), lessThanEqual(sgn * (c - leave), vec2(0.0)));
    tIn = mix(tIn, vec2(1.0), lessThan(sgn * (c - enter), vec2(0.0)));
    tOut = mix(tOut, vec2(0.0), greaterThan(sgn * (a - leave), vec2(0.0)));
    float t1 = min(tOut.x, tOut.y), t0 = min(t1, max(tIn.x, tIn.y));
    vec2 first = mix(mix(a, b, t0), mix(b, c, t0), t0), last = mix(mix(a, b, t1), mix(b, c, t1), t1);
    float sum = fetexFbtOuterArea(vec2(a.y, c.y), vec2(first.y, last.y), rising.x);
    // Gauss with two points holds for degree 3.
    float middle = 0.5 * (t0 + t1), half1 = 0.5 * (t1 - t0);
    vec2 t = vec2(middle - half1 * 0.57735027, middle + half1 * 0.57735027);
    vec2 x = clamp(mix(mix(vec2(a.x), vec2(b.x), t), mix(vec2(b.x), vec2(c.x), t), t), 0.0, 1.0);
    vec2 slope = 2.0 * mix(vec2(b.y - a.y), vec2(c.y - b.y), t);
    return sum + half1 * dot(x, slope);
}
#endif

#if (FETEX_FBT_DEGREES & 8) != 0
float fetexFbtCubicArea(vec2 a, vec2 b, vec2 c, vec2 d) {
    vec2 y = clamp(vec2(a.y, d.y), 0.0, 1.0);
    float left = min(min(a.x, b.x), min(c.x, d.x)), right = max(max(a.x, b.x), max(c.x, d.x));
    bool through = y.x != y.y && right > 0.0 && left < 1.0;
    vec2 c3 = d - a + 3.0 * (b - c), c2 = 3.0 * (a - 2.0 * b + c), c1 = 3.0 * (b - a);
    bvec2 rising = greaterThanEqual(d, a);
    vec2 enter = mix(vec2(1.0), vec2(0.0), rising), sgn = 1.0 - 2.0 * enter;
    // Entering: the later of both axes, the smaller of two growing functions. Leaving: the sooner, the larger.
    vec2 startIn = sgn * (a - enter), startOut = startIn - 1.0, endIn = sgn * (d - enter), endOut = endIn - 1.0;
    vec2 start = vec2(min(startIn.x, startIn.y), max(startOut.x, startOut.y));
    vec2 end = vec2(min(endIn.x, endIn.y), max(endOut.x, endOut.y));
    vec2 low = vec2(0.0), high = vec2(1.0);
    vec2 t = clamp(start / min(start - end, vec2(-1e-20)), 0.0, 1.0);
    high = mix(high, vec2(0.0), greaterThanEqual(start, vec2(0.0)));
    low = mix(low, vec2(1.0), lessThanEqual(end, vec2(0.0)));
    t = clamp(t, low, max(low, high));
    bvec2 open = lessThan(low, high);
    int steps = through && any(open) ? 24 : 0;
    for (int k = 0; k < steps; ++k) {
        vec2 inAt = ((c3 * t.x + c2) * t.x + c1) * t.x * sgn + startIn;
        vec2 outAt = ((c3 * t.y + c2) * t.y + c1) * t.y * sgn + startOut;
        bvec2 onX = bvec2(inAt.x < inAt.y, outAt.x > outAt.y); // which axis decides
        vec2 f = mix(vec2(inAt.y, outAt.y), vec2(inAt.x, outAt.x), onX);
        f = mix(vec2(0.0), f, open);
        if (max(abs(f.x), abs(f.y)) < 2e-3) break;
        vec2 k3 = mix(vec2(c3.y), vec2(c3.x), onX), k2 = mix(vec2(c2.y), vec2(c2.x), onX);
        vec2 k1 = mix(vec2(c1.y), vec2(c1.x), onX), s = mix(vec2(sgn.y), vec2(sgn.x), onX);
        vec2 f1 = s * ((3.0 * k3 * t + 2.0 * k2) * t + k1), f2 = s * (6.0 * k3 * t + 2.0 * k2);
        low = mix(low, t, lessThan(f, vec2(0.0)));
        high = mix(t, high, lessThan(f, vec2(0.0)));
        vec2 next = t - 3.0 * f / (f1 + sqrt(max(4.0 * f1 * f1 - 6.0 * f * f2, 0.0)));
        if ((k & 1) == 1 && k > 2) next = vec2(-1.0); // halves the bracket
        bvec2 good = bvec2(next.x >= low.x && next.x <= high.x, next.y >= low.y && next.y <= high.y);
        t = mix(t, mix(0.5 * (low + high), next, good), open);
    }
    float t1 = t.y, t0 = min(t1, t.x);
    vec2 level = a.y + vec2(((c3.y * t0 + c2.y) * t0 + c1.y) * t0, ((c3.y * t1 + c2.y) * t1 + c1.y) * t1);
    float sum = fetexFbtOuterArea(y, level, rising.x);
    // Gauss with three points holds for degree 5.
    float middle = 0.5 * (t0 + t1), half1 = 0.5 * (t1 - t0);
    vec3 u = middle + half1 * vec3(-0.77459667, 0.0, 0.77459667);
    vec3 x = clamp(((c3.x * u + c2.x) * u + c1.x) * u + a.x, 0.0, 1.0);
    vec3 slope = (3.0 * c3.y * u + 2.0 * c2.y) * u + c1.y;
    sum += half1 * dot(x * slope, vec3(0.55555556, 0.88888889, 0.55555556));
    return through ? sum : right > 0.0 ? y.y - y.x : 0.0;
}
#endif

// A chain as far as it was read, in the frame of its ray.
struct FetexFbtChain {
    float area;
    bool begun;
    uint first, last;            // end points
    vec2 start, beyondStart;     // its first point, and a point out of every box on the tangent there
};

// Adds a run's pieces to a chain. entry: the first record of the entry at `index`. continued: the box leaves the texel.
void fetexFbtRunArea(uvec4 entry, uint index, FetexFbtFrame box, bool continued, inout FetexFbtChain chain) {
    FetexFbtPoints points = fetexFbtRunPoints(entry, index);
    FetexFbtFrame frame = fetexFbtRayFrame(box, entry.x);
    float sum = 0.0;
    uint startWord = fetexFbtFirstPoint(points);
    vec2 start = fetexFbtFramed(frame, startWord), first = start;
    if (!chain.begun) chain.first = startWord;
    vec2 afterStart = start, beforeEnd = start;
#if (FETEX_FBT_DEGREES & 2) != 0
    uint lines = fetexFbtPieces(entry.x, 1u);
    for (uint k = 0u; k < lines; ++k) {
        startWord = fetexFbtNextPoint(points);
        vec2 end = fetexFbtFramed(frame, startWord);
        sum += fetexFbtLineArea(start, end);
        if (k == 0u) afterStart = end;
        beforeEnd = start;
        start = end;
    }
#endif
#if (FETEX_FBT_DEGREES & 4) != 0
    uint quadratics = fetexFbtPieces(entry.x, 2u);
    for (uint k = 0u; k < quadratics; ++k) {
        uvec4 words = fetexFbtNextPiece(points, 2u);
        vec2 control = fetexFbtFramed(frame, words.y), end = fetexFbtFramed(frame, words.z);
        sum += fetexFbtQuadraticArea(start, control, end);
        if (k == 0u) afterStart = words.y != words.x ? control : end;
        beforeEnd = words.y != words.z ? control : start;
        startWord = words.z;
        start = end;
    }
#endif
#if (FETEX_FBT_DEGREES & 8) != 0
    uint cubics = fetexFbtPieces(entry.x, 3u);
    for (uint k = 0u; k < cubics; ++k) {
        uvec4 words = fetexFbtNextPiece(points, 3u);
        vec2 control1 = fetexFbtFramed(frame, words.y), control2 = fetexFbtFramed(frame, words.z);
        vec2 end = fetexFbtFramed(frame, words.w);
        sum += fetexFbtCubicArea(start, control1, control2, end);
        if (k == 0u) afterStart = words.y != words.x ? control1 : words.z != words.x ? control2 : end;
        beforeEnd = words.z != words.w ? control2 : words.y != words.w ? control1 : start;
        startWord = words.w;
        start = end;
    }
#endif
    chain.last = startWord;
    // Open chains go on straight beyond the texel.
    if (!chain.begun) {
        chain.start = first;
        chain.beyondStart = fetexFbtFarPoint(first, afterStart);
    }
    chain.begun = true;
    bool extends = continued && fetexFbtIsLastRun(entry.x) && chain.first != chain.last;
    float beyond = fetexFbtLineArea(start, fetexFbtFarPoint(start, beforeEnd)) - fetexFbtLineArea(chain.start, chain.beyondStart);
    chain.area += sum + (extends ? beyond : 0.0);
}

// A region's colour; corners: of the model corners, here.
vec4 fetexFbtRegionColor(uvec2 region, vec2 local, vec4 corners) {
#if FETEX_FBT_PATCHES
    vec4 color = fetexFbtShade(ivec2(0), local, region.x == 2u ? region : uvec2(0u, region.y));
#else
    vec4 color = fetexFbtColor(region.y);
#endif
    return region.x == 1u ? corners : color;
}

// Mean colour over a box of the list at record `index`, the box cut to the list's band.
vec4 fetexFbtListArea(uint index, vec2 low, vec2 high, vec4 corners) {
    vec2 least = 1e-5 * (high - low); // see fetexFbtOverlap
    bool continued = any(lessThan(low, -least)) || any(greaterThan(high, 1.0 + least));
    vec2 middle = clamp(0.5 * (low + high), 0.0, 1.0);
    FetexFbtFrame box = fetexFbtBoxFrame(low, high);
    float outermost = 0.0; // area inside the features of depth 0
#if FETEX_FBT_MAX_DEPTH > 0
    float below[FETEX_FBT_MAX_DEPTH + 2]; // [depth]: area inside the features seen at it, of one parent
    for (int k = 0; k < FETEX_FBT_MAX_DEPTH + 2; ++k) below[k] = 0.0;
#endif
    vec4 sum = vec4(0.0);
    float total = 0.0;
    FetexFbtChain chain = FetexFbtChain(0.0, false, 0u, 0u, vec2(0.0), vec2(0.0));
    uvec4 entry = uvec4(0u);
    for (int k = 0; k < FETEX_FBT_MAX_ENTRIES; ++k) {
        entry = fetexFbtRecord(index);
        fetexFbtRunArea(entry, index, box, continued, chain);
        if (fetexFbtIsLastRun(entry.x)) {
            float inside = (entry.x & 0x3ffu) != 0u ? clamp(abs(chain.area), 0.0, 1.0) : 0.0, part = inside;
#if FETEX_FBT_MAX_DEPTH > 0
            // Depths from 7 on are one: taken for features each around the one before.
            int depth = int((entry.x >> 21u) & 7u);
            part = max(inside - below[depth < 7 ? depth + 1 : depth], 0.0);
            below[depth] = depth < 7 ? below[depth] + inside : max(below[depth], inside);
            if (depth < 7) below[depth + 1] = 0.0;
            if (depth == 0) outermost += inside;
#else
            outermost += inside;
#endif
            sum += part * fetexFbtRegionColor(fetexFbtFeatureRegion(entry), middle, corners);
            total += part;
            chain.area = 0.0;
            chain.begun = false;
        }
        if (fetexFbtIsLast(entry.x)) break;
        index = fetexFbtNextEntry(index, entry.x);
    }
    float rest = max(1.0 - outermost, 0.0);
    sum += rest * fetexFbtRegionColor(fetexFbtRestRegion(entry, index), middle, corners);
    return sum / max(total + rest, 1e-20);
}

// Mean colour over a box of a texel with features: band after band, the first and the last going on beyond the texel.
vec4 fetexFbtFeatureArea(uint texel, vec2 low, vec2 high, vec4 corners) {
    uint first = texel & 0x3fffffffu;
#if FETEX_FBT_BANDS
    uint bands = 1u, band = 0u;
    bool banded = (texel >> 30u) == 2u;
    if (banded) {
        bands = fetexFbtBandCount(first);
        band = fetexFbtFindBand(first, bands, low.y);
    }
    vec4 sum = vec4(0.0);
    float y = low.y;
    for (; band < bands; ++band) {
        float end = high.y;
        if (band + 1u < bands) end = min(end, fetexFbtBandEnd(first, band));
        uint list = first;
        if (banded) list = fetexFbtBandList(first, bands, band);
        if (end > y) sum += (end - y) * fetexFbtListArea(list, vec2(low.x, y), vec2(high.x, end), corners);
        if (end >= high.y) break;
        y = end;
    }
    return sum / (high.y - low.y);
#else
    return fetexFbtListArea(first, low, high, corners);
#endif
}

#endif // FETEX_FBT_FEATURES

// Where a pixel leaves its texel along an axis: -1, 0 or 1. The pixel is cut to the texture.
int fetexFbtOverlap(inout float low, inout float high, int base, int size) {
    if (base == 0) low = max(low, 0.0);
    if (base + 1 == size) high = min(high, 1.0);
    float least = 1e-5 * (high - low); // less of the pixel isn't looked at: in fp32 it may have no height
    return low < -least ? -1 : high > 1.0 + least ? 1 : 0;
}

vec4 fetexFbtSampleAreaTexel(ivec2 base, vec2 local, vec2 halfPixel) {
    ivec2 size = fetexFbtSize();
    base = clamp(base, ivec2(0), size - 1);
    halfPixel = clamp(halfPixel, vec2(1.0 / 65536.0), vec2(0.5));
    vec2 low = local - halfPixel, high = local + halfPixel;
    ivec2 side;
    side.x = fetexFbtOverlap(low.x, high.x, base.x, size.x);
    side.y = fetexFbtOverlap(low.y, high.y, base.y, size.y);
    // The pixel's stretches in the base and beside it, and the parts that lie beside it.
    vec4 inner = vec4(max(low, 0.0), min(high, 1.0));
    vec4 outer = vec4(side.x > 0 ? 1.0 : low.x, side.y > 0 ? 1.0 : low.y, side.x > 0 ? high.x : 0.0, side.y > 0 ? high.y : 0.0);
    vec2 outside = mix(vec2(0.0), outer.zw - outer.xy, notEqual(side, ivec2(0))) / (high - low);
    vec4 sum = vec4(0.0);
    float featured = 0.0, largest = 0.0, cornerPart = 0.0; // cornerPart: in texels of the model corners
    ivec2 speaker = ivec2(0), cornerTexel = ivec2(0);
    uint speakerTexel = 0u;
    vec4 span = vec4(2.0, 2.0, -2.0, -2.0);
    int columns = side.x != 0 ? 2 : 1, texels = side.y != 0 ? 2 * columns : columns;
    for (int n = 0; n < texels; ++n) {
        bvec2 isBeside = bvec2(columns == 2 && (n & 1) != 0, n >= columns);
        ivec2 offset = ivec2(isBeside) * side;
        vec2 parts = mix(1.0 - outside, outside, isBeside);
        float part = parts.x * parts.y;
        uint texel = texelFetch(fetexFbtTexels, base + offset, 0).x;
        uint kind = texel >> 30u;
        if (kind == 0u) sum += part * fetexFbtColor((texel & 0x1000000u) != 0u ? texel | 0xff000000u : 0u);
#if FETEX_FBT_CORNERS
        if ((texel >> 28u) == 13u) {
            if (cornerPart == 0.0) cornerTexel = offset;
            cornerPart += part;
        }
#endif
#if FETEX_FBT_FEATURES || FETEX_FBT_PATCHES
        vec4 own = vec4(isBeside.x ? outer.x : inner.x, isBeside.y ? outer.y : inner.y, isBeside.x ? outer.z : inner.z,
                        isBeside.y ? outer.w : inner.w);
#endif
#if FETEX_FBT_PATCHES
        if ((texel >> 28u) == 14u)
            sum += part * fetexFbtShade(base, 0.5 * (own.xy + own.zw) - vec2(offset), uvec2(2u, texel & 0xfffffffu));
#endif
#if FETEX_FBT_FEATURES
        if (kind == 1u || kind == 2u) {
#if FETEX_FBT_AREA_EXACT
            vec4 corners = vec4(0.0);
#if FETEX_FBT_CORNERS
            corners = fetexFbtShade(base + offset, 0.5 * (own.xy + own.zw) - vec2(offset), uvec2(1u, 0u));
#endif
            sum += part * fetexFbtFeatureArea(texel, own.xy - vec2(offset), own.zw - vec2(offset), corners);
#else
            float rank = n == 0 ? 2.0 : part; // the base itself, else the largest part
            if (rank > largest) {
                largest = rank;
                speaker = offset;
                speakerTexel = texel;
            }
            featured += part;
            span = vec4(min(span.xy, own.xy), max(span.zw, own.zw));
#endif
        }
#endif
    }
    vec4 corners = vec4(0.0);
#if FETEX_FBT_CORNERS
    if (cornerPart == 0.0) cornerTexel = speaker;
    corners = fetexFbtShade(base + cornerTexel, clamp(0.5 * (low + high) - vec2(cornerTexel), 0.0, 1.0), uvec2(1u, 0u));
    sum += cornerPart * corners;
#endif
#if FETEX_FBT_FEATURES && !FETEX_FBT_AREA_EXACT
    if (featured > 0.0)
        sum += featured * fetexFbtFeatureArea(speakerTexel, span.xy - vec2(speaker), span.zw - vec2(speaker), corners);
#endif
    return sum;
}

vec4 fetexFbtSampleArea(vec2 uv, vec2 halfPixel) {
    ivec2 base;
    vec2 local;
    fetexFbtLocate(uv, base, local);
    return fetexFbtSampleAreaTexel(base, local, halfPixel);
}
