// SPDX-License-Identifier: Apache-2.0 OR MIT
// Textures with feature curves (Parilov and Zorin): distances from curves, zero exactly on them, a base map and a profile.
// Semantics: formats/SPEC.md, section 9; the same in double: formats/feature_interpolation.cpp, feature_profile.cpp,
// feature_sampler.cpp. Goes after a prelude and fetex_levels.glsl.
//
//   vec4 fetexFeatureSample(vec2 uv)
//   vec4 fetexFeatureSampleTexel(ivec2 base, vec2 local)           the same point as texel and offset in [0,1): deep zoom
//   vec4 fetexFeatureSampleArea(vec2 uv, vec2 pixel)               a pixel with these sides in texels
//   vec4 fetexFeatureSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel)
//   vec4 fetexFeatureSampleMip(vec2 uv, vec2 pixel)                any pixel; with FETEX_FEATURE_MIPS
//   vec4 fetexFeatureSampleMipTexel(ivec2 base, vec2 local, vec2 pixel)
//   FetexFeatureAt fetexFeatureFind(ivec2 base, vec2 local)        distance, gradient, base map: for a profile of yours
//
// Colours as they are; normals as (n + 1) / 2, heights as grey.
//
//   fetexFeatureTexels      R16UI, width x height: bits 0-2 the first segment (0 none, 1 NE, 2 NS, 3 NW, 4 ES, 5 EW, 6 SW), bit 3
//                           it is straight, bits 4-7 the second likewise, bits 8-11 the edges N, E, S, W that are open.
//                           With several profiles RG32UI: the second word has the profiles of the corners NW, NE, SW, SE and of
//                           the edges' points N, E, S, W, four bits each
//   fetexFeatureSignatures  (width + 1) x (height + 1): north position, north angle, west position, west angle; linear: the
//                           positions. RGBA32F or RGBA16F; linear RG32F or RG16F; with FETEX_FEATURE_BITS16 RGBA16UI or RG16UI
//   fetexFeatureCorners     (width + 1) x (height + 1): distance, and gradient x, y, 0: RGBA32F, RGBA16F or RGBA16UI; without
//                           gradients R32F, R16F or R16UI
//   fetexFeatureBase        (width + 1) x (height + 1), or 1 x 1: RGBA8 or RGBA16F; RGBA16UI for samples of 16 bits
//   fetexFeatureProfile     RGBA32F, entries x 4: rows (1-b)h', b h', b, (1-b)h; (1-b) colour; and the integrals of both from 0;
//                           four rows a profile
//   fetexFeatureMips        RGBA8 2D with a mip chain: GL's level k is the chunk FCVM of level k + 1
//
// Defined before it, by feature_curves_specialisation (host/shader_source.h) or by hand:
//   FETEX_FEATURE_KIND           0 colours, 1 normals, 2 heights
//   FETEX_FEATURE_LIMIT          D, the distance of the profile's last entry, in texels
//   FETEX_FEATURE_LINEAR         1: no angles
//   FETEX_FEATURE_BITS16         1: numbers are integers of 16 bits
//   FETEX_FEATURE_GRADIENTS      1: there are gradients
//   FETEX_FEATURE_SEGMENTS       most segments in a texel: 0, 1, 2
//   FETEX_FEATURE_CURVES         1: some segment isn't straight
//   FETEX_FEATURE_OPEN           1: some edge is open
//   FETEX_FEATURE_PROFILES       how many profiles there are
//   FETEX_FEATURE_SAMPLES        1: fetexFeatureBase is RGBA16UI
//   FETEX_FEATURE_ONE_SAMPLE     1: fetexFeatureBase is 1 x 1
//   FETEX_FEATURE_NORMAL_FACTOR  of the base map's normals: 255/127, 65535/32767 or 2
//   FETEX_FEATURE_HEIGHT_SCALE   S
//   FETEX_FEATURE_MIPS           1: there is a mip chain

#ifndef FETEX_FEATURE_KIND
#define FETEX_FEATURE_KIND 0
#endif
#ifndef FETEX_FEATURE_LIMIT
#define FETEX_FEATURE_LIMIT 1.0
#endif
#ifndef FETEX_FEATURE_LINEAR
#define FETEX_FEATURE_LINEAR 0
#endif
#ifndef FETEX_FEATURE_BITS16
#define FETEX_FEATURE_BITS16 0
#endif
#ifndef FETEX_FEATURE_GRADIENTS
#define FETEX_FEATURE_GRADIENTS (FETEX_FEATURE_KIND == 1)
#endif
#ifndef FETEX_FEATURE_SEGMENTS
#define FETEX_FEATURE_SEGMENTS 2
#endif
#ifndef FETEX_FEATURE_CURVES
#define FETEX_FEATURE_CURVES !FETEX_FEATURE_LINEAR
#endif
#ifndef FETEX_FEATURE_OPEN
#define FETEX_FEATURE_OPEN 1
#endif
#ifndef FETEX_FEATURE_PROFILES
#define FETEX_FEATURE_PROFILES 1
#endif
#ifndef FETEX_FEATURE_SAMPLES
#define FETEX_FEATURE_SAMPLES 0
#endif
#ifndef FETEX_FEATURE_ONE_SAMPLE
#define FETEX_FEATURE_ONE_SAMPLE 0
#endif
#ifndef FETEX_FEATURE_NORMAL_FACTOR
#define FETEX_FEATURE_NORMAL_FACTOR (255.0 / 127.0)
#endif
#ifndef FETEX_FEATURE_HEIGHT_SCALE
#define FETEX_FEATURE_HEIGHT_SCALE 1.0
#endif
#ifndef FETEX_FEATURE_MIPS
#define FETEX_FEATURE_MIPS 0
#endif

FETEX_UNIFORM(0) highp usampler2D fetexFeatureTexels;
#if FETEX_FEATURE_BITS16
FETEX_UNIFORM(1) highp usampler2D fetexFeatureSignatures;
FETEX_UNIFORM(2) highp usampler2D fetexFeatureCorners;
#else
FETEX_UNIFORM(1) highp sampler2D fetexFeatureSignatures;
FETEX_UNIFORM(2) highp sampler2D fetexFeatureCorners;
#endif
#if FETEX_FEATURE_SAMPLES
FETEX_UNIFORM(3) highp usampler2D fetexFeatureBase;
#else
FETEX_UNIFORM(3) highp sampler2D fetexFeatureBase;
#endif
FETEX_UNIFORM(4) highp sampler2D fetexFeatureProfile;
#if FETEX_FEATURE_MIPS
FETEX_UNIFORM(5) highp sampler2D fetexFeatureMips;
#endif

ivec2 fetexFeatureSize() { return textureSize(fetexFeatureTexels, 0); }

// Distance and gradient at a corner.
vec3 fetexFeatureCorner(ivec2 at) {
#if FETEX_FEATURE_BITS16
    uvec3 stored = texelFetch(fetexFeatureCorners, at, 0).xyz;
    vec2 gradient = vec2(ivec2(stored.yz ^ 0x8000u) - 0x8000) * (1.0 / 32767.0);
    vec3 corner = vec3(float(stored.x) * (FETEX_FEATURE_LIMIT / 65535.0), gradient);
#else
    vec3 corner = texelFetch(fetexFeatureCorners, at, 0).xyz;
#endif
#if FETEX_FEATURE_GRADIENTS
    return corner;
#else
    return vec3(corner.x, 0.0, 0.0);
#endif
}

vec4 fetexFeatureBaseAt(ivec2 at) {
#if FETEX_FEATURE_SAMPLES
    return vec4(texelFetch(fetexFeatureBase, at, 0)) * (1.0 / 65535.0);
#else
    return texelFetch(fetexFeatureBase, at, 0);
#endif
}

// Position and angle on an edge: north or west of the texel at `at`.
vec2 fetexFeatureCrossing(ivec2 at, bool west) {
#if FETEX_FEATURE_BITS16
    vec4 stored = vec4(texelFetch(fetexFeatureSignatures, at, 0));
    const vec2 unit = vec2(1.0 / 32768.0, 3.14159265358979 / 65536.0);
#else
    vec4 stored = texelFetch(fetexFeatureSignatures, at, 0);
    const vec2 unit = vec2(1.0);
#endif
#if FETEX_FEATURE_LINEAR
    return vec2(west ? stored.y : stored.x, 0.0) * unit;
#else
    return (west ? stored.zw : stored.xy) * unit;
#endif
}

// Position of the point of edge 0 N, 1 E, 2 S, 3 W of a texel.
float fetexFeaturePosition(ivec2 base, int edge) {
    return fetexFeatureCrossing(base + ivec2(edge == 1, edge == 2), (edge & 1) == 1).x;
}

float fetexFeatureRatio(float a, float b) { return b > 0.0 ? a / b : 0.0; }

// Along an edge from value a to value b: linear, but 0 at q if the edge is open.
float fetexFeatureBorder(float a, float b, float along, bool open, float q) {
    float parted = along < q ? a * (1.0 - along / q) : b * fetexFeatureRatio(along - q, 1.0 - q);
    return open ? parted : mix(a, b, along);
}

#if FETEX_FEATURE_SEGMENTS > 0
// A segment in its frame: from (b0, 0) to (b2, 1) if opposite, to (0, b2) around corner 0 if not; and where the point lies on the
// ray that meets it once. Corners are x NW, y NE, z SW, w SE of the texel or of the frame.
struct FetexFeatureSide {
    bvec3 turned; // the frame: x mirrored, y mirrored, exchanged afterwards
    bool opposite, first;
    vec2 p;                 // of the point, in the frame
    float at, curve, border; // along the ray: point, curve, the texel's border beyond
    vec4 corners;           // of the texel, 1 on the point's side
#if FETEX_FEATURE_PROFILES > 1
    vec4 ends;              // of the texel's edges N, E, S, W those that it ends on, and how near where the ray meets it
#endif
#if FETEX_FEATURE_SEGMENTS > 1
    vec4 standIn; // distances of the frame's corners from tangents
#endif
};

// Values of the texel's corners as the frame's.
vec4 fetexFeatureTurned(vec4 v, bvec3 turned) {
    v = turned.x ? v.yxwz : v;
    v = turned.y ? v.zwxy : v;
    return turned.z ? v.xzyw : v;
}

FetexFeatureSide fetexFeatureSideOf(uint segment, ivec2 base, vec2 local) {
    uint kind = segment & 7u;
    FetexFeatureSide s;
    s.opposite = kind == 2u || kind == 5u;
    s.turned = bvec3(kind == 1u || kind == 4u, kind == 4u || kind == 6u, kind == 5u);
    vec2 first = fetexFeatureCrossing(base + ivec2(0, s.turned.y), s.turned.z);
    vec2 last = fetexFeatureCrossing(base + ivec2(s.turned.x || s.turned.z, kind == 2u), kind != 2u);
    vec2 q = mix(local, 1.0 - local, bvec2(s.turned.xy));
    s.p = s.turned.z ? q.yx : q;
    float b0 = s.turned.x ? 1.0 - first.x : first.x, b2 = s.turned.y ? 1.0 - last.x : last.x;
    vec2 from = vec2(b0, 0.0), to = s.opposite ? vec2(b2, 1.0) : vec2(0.0, b2), chord = to - from;
    // Bernstein coefficients of the distance from the ray, the first not negative, the last not positive: one root.
    vec2 ends = s.opposite ? vec2(s.p.y, s.p.y - 1.0) : vec2(b0 * s.p.y, -b2 * s.p.x);
#if FETEX_FEATURE_SEGMENTS > 1 || FETEX_FEATURE_CURVES
    float size = length(chord);
    vec2 along = size > 0.0 ? chord / size : vec2(0.0);
    vec4 tangents = along.xyxy;
#endif
#if FETEX_FEATURE_CURVES
    bool straight = (segment & 8u) != 0u;
    vec2 angles = vec2(first.y, last.y), cosines = cos(angles), sines = sin(angles);
    tangents = straight ? tangents : vec4(cosines.x, sines.x, cosines.y, sines.y) * mix(vec2(1.0), vec2(-1.0), bvec2(s.turned.xy)).xyxy;
    tangents = s.turned.z && !straight ? tangents.yxwz : tangents;
    float turn = tangents.x * tangents.w - tangents.y * tangents.z;
    vec2 meet = clamp(from + tangents.xy * ((chord.x * tangents.w - chord.y * tangents.z) / (turn == 0.0 ? 1.0 : turn)), 0.0, 1.0);
    vec2 middle = straight ? 0.5 * (from + to) : meet;
    float between = s.opposite ? s.p.y - middle.y : middle.x * s.p.y - middle.y * s.p.x;
    float root = sqrt(max(between * between - ends.x * ends.y, 0.0));
    float up = between >= 0.0 ? between + root : ends.x, down = between >= 0.0 ? -ends.y : root - between;
    float u = fetexFeatureRatio(up, up + down);
    vec2 on = mix(mix(from, middle, u), mix(middle, to, u), u);
#else
    float u = fetexFeatureRatio(ends.x, ends.x - ends.y);
    vec2 on = mix(from, to, u);
#endif
#if FETEX_FEATURE_PROFILES > 1
    vec4 north = vec4(1.0, 0.0, 0.0, 0.0), east = north.wxyz, south = north.wwxy, west = north.wwwx;
    s.ends = mix(kind <= 3u ? north : kind == 5u ? west : south, kind == 2u ? south : kind == 3u || kind == 6u ? west : east, u);
#endif
    s.at = s.opposite ? s.p.x : s.p.x + s.p.y;
    s.curve = s.opposite ? on.x : on.x + on.y;
    float farther = max(s.p.x, s.p.y);
    s.border = s.opposite || farther <= 0.0 ? 1.0 : s.at / farther;
    s.first = s.at <= s.curve;
    vec4 mine = kind == 1u ? vec4(0.0, 1.0, 0.0, 0.0) : kind == 2u ? vec4(1.0, 0.0, 1.0, 0.0) : kind == 3u ? vec4(1.0, 0.0, 0.0, 0.0)
              : kind == 4u ? vec4(0.0, 0.0, 0.0, 1.0) : kind == 5u ? vec4(1.0, 1.0, 0.0, 0.0) : vec4(0.0, 0.0, 1.0, 0.0);
    s.corners = s.first ? mine : 1.0 - mine;
#if FETEX_FEATURE_SEGMENTS > 1
    vec2 off = abs(s.opposite ? tangents.yw : tangents.yz), beside = vec2(b0, 1.0 - b0) * off.x;
    float across = abs(along.x * (1.0 - from.y) - along.y * (1.0 - from.x));
    s.standIn = s.opposite ? vec4(beside, vec2(b2, 1.0 - b2) * off.y) : vec4(beside, (1.0 - b2) * off.y, across);
#endif
    return s;
}

// From the curve, 0, to where the ray begins or ends, 1.
float fetexFeatureShare(FetexFeatureSide s) {
    return s.first ? fetexFeatureRatio(s.curve - s.at, s.curve) : fetexFeatureRatio(s.at - s.curve, s.border - s.curve);
}

// values: of the frame's corners.
float fetexFeatureAlong(FetexFeatureSide s, vec4 values, ivec2 base, uint openEdges) {
    bool east = s.opposite || s.p.x >= s.p.y; // of the frame; else the border beyond is the south one
    float along = s.opposite ? s.p.y : fetexFeatureRatio(min(s.p.x, s.p.y), max(s.p.x, s.p.y));
    vec2 ends = s.opposite && s.first ? values.xz : east ? values.yw : values.zw;
    float value = mix(ends.x, ends.y, along);
#if FETEX_FEATURE_OPEN
    // The texel's edge that it is, and which way along it.
    int edge = s.opposite && s.first ? 3 : east ? 1 : 2;
    edge = s.turned.z ? 3 - edge : edge;
    bool vertical = (edge & 1) == 1;
    edge = (vertical ? s.turned.x : s.turned.y) ? (edge + 2) & 3 : edge;
    bool open = ((openEdges >> uint(edge)) & 1u) != 0u;
    float q = open ? fetexFeaturePosition(base, edge) : 0.5;
    q = (vertical ? s.turned.y : s.turned.x) ? 1.0 - q : q;
    value = fetexFeatureBorder(ends.x, ends.y, along, open, q);
#endif
    value = s.first && !s.opposite ? values.x : value;
    return value * fetexFeatureShare(s);
}
#endif

#if FETEX_FEATURE_OPEN
// An open edge: the texel's corners at its ends, and the point beside it.
struct FetexFeatureEdge {
    vec4 a, b;
    float along, nearness, q;
};
FetexFeatureEdge fetexFeatureEdgeAt(ivec2 base, vec2 p, int edge) {
    FetexFeatureEdge e;
    bool vertical = (edge & 1) == 1, low = edge == 0 || edge == 3;
    e.a = low ? vec4(1.0, 0.0, 0.0, 0.0) : edge == 1 ? vec4(0.0, 1.0, 0.0, 0.0) : vec4(0.0, 0.0, 1.0, 0.0);
    e.b = edge == 0 ? vec4(0.0, 1.0, 0.0, 0.0) : edge == 3 ? vec4(0.0, 0.0, 1.0, 0.0) : vec4(0.0, 0.0, 0.0, 1.0);
    e.along = vertical ? p.y : p.x;
    float off = vertical ? p.x : p.y;
    e.nearness = low ? 1.0 - off : off;
    e.q = fetexFeaturePosition(base, edge);
    return e;
}

// What open edges take from the distance in a texel without segments.
float fetexFeatureDip(ivec2 base, vec2 p, uint openEdges, vec4 distances) {
    float least = 0.0;
    for (int edge = openEdges == 0u ? 4 : 0; edge < 4; ++edge) {
        if (((openEdges >> uint(edge)) & 1u) == 0u) continue;
        FetexFeatureEdge e = fetexFeatureEdgeAt(base, p, edge);
        float a = dot(distances, e.a), b = dot(distances, e.b);
        least = min(least, e.nearness * (fetexFeatureBorder(a, b, e.along, true, e.q) - mix(a, b, e.along)));
    }
    return least;
}

// Beside open edges between corners that both count.
vec4 fetexFeatureBeside(ivec2 base, vec2 p, uint openEdges, vec4 weights) {
    vec4 counted = weights;
    for (int edge = openEdges == 0u ? 4 : 0; edge < 4; ++edge) {
        if (((openEdges >> uint(edge)) & 1u) == 0u) continue;
        FetexFeatureEdge e = fetexFeatureEdgeAt(base, p, edge);
        float more = e.nearness * ((e.along < e.q ? 0.0 : 1.0) - e.along);
        if (dot(counted, e.a) > 0.0 && dot(counted, e.b) > 0.0) weights += more * (e.b - e.a);
    }
    weights = max(weights, 0.0);
    return weights / dot(weights, vec4(1.0));
}

#if FETEX_FEATURE_PROFILES > 1
// What open edges' points take from the corners beside them, if both of these count.
void fetexFeatureTaken(ivec2 base, vec2 p, uint openEdges, inout vec4 corners, inout vec4 edges) {
    vec4 counted = corners;
    for (int edge = openEdges == 0u ? 4 : 0; edge < 4; ++edge) {
        if (((openEdges >> uint(edge)) & 1u) == 0u) continue;
        FetexFeatureEdge e = fetexFeatureEdgeAt(base, p, edge);
        bool before = e.along < e.q;
        float of = before ? e.along : 1.0 - e.along, all = before ? e.q : 1.0 - e.q;
        float taken = dot(counted, e.a) > 0.0 && dot(counted, e.b) > 0.0 ? e.nearness * (all > 0.0 ? of / all : 1.0) : 0.0;
        edges += taken * vec4(equal(ivec4(0, 1, 2, 3), ivec4(edge)));
        corners -= taken * ((1.0 - e.q) * e.a + e.q * e.b);
    }
    corners = max(corners, 0.0);
    float sum = dot(corners, vec4(1.0)) + dot(edges, vec4(1.0));
    corners /= sum;
    edges /= sum;
}
#endif
#endif

vec4 fetexFeatureBilinear(vec2 p) { return vec4(1.0 - p.x, p.x, 1.0 - p.x, p.x) * vec4(1.0 - p.y, 1.0 - p.y, p.y, p.y); }

struct FetexFeatureAt {
    float distance; // texels
    vec2 gradient;
    vec4 base, across; // the base map, and across the segments of the texel, the nearer counting more
#if FETEX_FEATURE_PROFILES > 1
    uint profiles;            // as fetexFeatureTexels has them
    vec4 ofCorners, ofEdges;  // how much each counts
#endif
};

// Bilinear weights of a set of corners, 1 in it and 0 outside.
vec4 fetexFeatureInside(vec2 p, vec4 corners) {
    const float margin = 1.0 / 1048576.0; // off the edges, so that no set has no weight
    vec4 weights = corners * fetexFeatureBilinear(clamp(p, margin, 1.0 - margin));
    return weights / dot(weights, vec4(1.0));
}

// The weights of a set of corners.
vec4 fetexFeatureWeights(ivec2 base, vec2 p, uint openEdges, vec4 corners) {
    vec4 weights = fetexFeatureInside(p, corners);
#if FETEX_FEATURE_OPEN
    return fetexFeatureBeside(base, p, openEdges, weights);
#else
    return weights;
#endif
}

FetexFeatureAt fetexFeatureFind(ivec2 base, vec2 local) {
    uvec2 words = texelFetch(fetexFeatureTexels, base, 0).xy;
    uint word = words.x, open = word >> 8u;
    vec3 nw = fetexFeatureCorner(base), ne = fetexFeatureCorner(base + ivec2(1, 0));
    vec3 sw = fetexFeatureCorner(base + ivec2(0, 1)), se = fetexFeatureCorner(base + 1);
    vec4 distances = vec4(nw.x, ne.x, sw.x, se.x), weights = fetexFeatureBilinear(local);
    float found = dot(weights, distances);
#if FETEX_FEATURE_SEGMENTS > 0
    int segments = (word & 7u) == 0u ? 0 : (word & 0x70u) == 0u ? 1 : 2;
#else
    int segments = 0;
#endif
#if FETEX_FEATURE_OPEN
    if (segments == 0) {
        found = max(found + fetexFeatureDip(base, local, open, distances), 0.0);
        weights = fetexFeatureWeights(base, local, open, vec4(1.0));
    }
#endif
    vec4 across = weights;
#if FETEX_FEATURE_PROFILES > 1
    vec4 side = vec4(1.0), ends = vec4(0.0); // corners reached; edges' points, by the segments
    float nearest = 0.0;
#endif
    // Loops where branches would do, because some renderers skip loops that nobody needs, but no branch.
#if FETEX_FEATURE_SEGMENTS == 1
    for (int k = 0; k < segments; ++k) {
        FetexFeatureSide s = fetexFeatureSideOf(word, base, local);
        found = fetexFeatureAlong(s, fetexFeatureTurned(distances, s.turned), base, open);
        weights = fetexFeatureWeights(base, local, open, s.corners);
        across = fetexFeatureWeights(base, local, open, 1.0 - s.corners);
#if FETEX_FEATURE_PROFILES > 1
        nearest = 1.0 - fetexFeatureShare(s), side = s.corners, ends = s.ends;
#endif
    }
#elif FETEX_FEATURE_SEGMENTS == 2
    FetexFeatureSide one, two;
    vec4 reached = vec4(1.0);
    for (int k = 0; k < segments; ++k) {
        FetexFeatureSide s = fetexFeatureSideOf(k == 0 ? word : word >> 4u, base, local);
        reached *= s.corners;
        if (k == 0) one = s;
        two = s;
    }
    bool any = dot(reached, vec4(1.0)) > 0.0;
    for (int k = 0; k < segments; ++k) {
        FetexFeatureSide s = two;
        if (k == 0) s = one;
        vec4 known = any ? fetexFeatureTurned(reached, s.turned) : vec4(1.0);
        float d = fetexFeatureAlong(s, mix(s.standIn, fetexFeatureTurned(distances, s.turned), known), base, open);
        vec4 beyond = 1.0 - s.corners, others = beyond * (segments == 1 ? vec4(1.0) : k == 0 ? two.corners : one.corners);
        others = fetexFeatureWeights(base, local, open, dot(others, vec4(1.0)) > 0.0 ? others : beyond);
        across = k == 0 ? others : mix(across, others, fetexFeatureRatio(found, found + d));
        found = k == 0 ? d : min(d, found);
        weights = k == 0 ? fetexFeatureWeights(base, local, open, any ? reached : one.corners) : weights;
#if FETEX_FEATURE_PROFILES > 1
        // Of two segments the one that the point lies on counts alone; on an edge where both end they count alike.
        float nearness = 1.0 - fetexFeatureShare(s), before = nearest * (1.0 - nearness), after = nearness * (1.0 - nearest);
        ends = k == 0 ? s.ends : mix(ends, s.ends, fetexFeatureRatio(after, before + after));
        nearest = max(nearest, nearness);
        side = any ? reached : one.corners;
#endif
    }
#endif
    FetexFeatureAt at;
    at.distance = min(found, FETEX_FEATURE_LIMIT);
#if FETEX_FEATURE_PROFILES > 1
    vec4 ofCorners = fetexFeatureInside(local, side), ofEdges = vec4(0.0);
#if FETEX_FEATURE_OPEN
    fetexFeatureTaken(base, local, open, ofCorners, ofEdges);
#endif
    at.profiles = words.y;
    at.ofCorners = (1.0 - nearest) * ofCorners;
    at.ofEdges = (1.0 - nearest) * ofEdges + nearest * ends;
#endif
    at.gradient = weights.x * nw.yz + weights.y * ne.yz + weights.z * sw.yz + weights.w * se.yz;
#if FETEX_FEATURE_ONE_SAMPLE
    at.base = fetexFeatureBaseAt(ivec2(0));
    at.across = at.base;
#else
    vec4 a = fetexFeatureBaseAt(base), b = fetexFeatureBaseAt(base + ivec2(1, 0));
    vec4 c = fetexFeatureBaseAt(base + ivec2(0, 1)), d = fetexFeatureBaseAt(base + 1);
    at.base = weights.x * a + weights.y * b + weights.z * c + weights.w * d;
    at.across = across.x * a + across.y * b + across.z * c + across.w * d;
#endif
    return at;
}

// The profile's products, or their means.
struct FetexFeatureProducts {
    vec4 products; // (1-b)h', b h', b, (1-b)h
    vec4 color;    // (1-b) colour
    float across;  // of the mean of b what distances below 0 add
};

// A place in a profile at a distance not below 0: the entry before and after it, how far it is from the one to the other, in entries.
struct FetexFeatureCell {
    int first;
    float part;
};
FetexFeatureCell fetexFeatureCellAt(float distance, int entries) {
    float at = distance * (float(entries - 1) / FETEX_FEATURE_LIMIT);
    FetexFeatureCell cell;
    cell.first = min(int(at), entries - 1); // beyond the last entry the profile goes on
    cell.part = at - float(cell.first);
    return cell;
}
// row: four a profile.
vec4 fetexFeatureRow(int entry, int row, int entries) { return texelFetch(fetexFeatureProfile, ivec2(min(entry, entries - 1), row), 0); }

// Of a row: x the integral from 0 to each of two distances added, y from the first to the second; in entries.
struct FetexFeatureIntegrals {
    vec4 first, sum, difference;
};
FetexFeatureIntegrals fetexFeatureIntegral(FetexFeatureCell a, FetexFeatureCell b, int row, int entries) {
    vec4 a0 = fetexFeatureRow(a.first, row, entries), a1 = fetexFeatureRow(a.first + 1, row, entries);
    vec4 b0 = fetexFeatureRow(b.first, row, entries), b1 = fetexFeatureRow(b.first + 1, row, entries);
    vec4 untilA = fetexFeatureRow(a.first + 1, row + 2, entries), untilB = fetexFeatureRow(b.first, row + 2, entries);
    bool last = a.first == entries - 1;
    vec4 atA = last ? a0 : mix(a0, a1, a.part), atB = b.first == entries - 1 ? b0 : mix(b0, b1, b.part);
    vec4 rest = last ? -0.5 * a.part * (a0 + atA) : 0.5 * (1.0 - a.part) * (atA + a1), more = 0.5 * b.part * (b0 + atB);
    FetexFeatureIntegrals found;
    found.first = untilA - rest;
    found.sum = found.first + untilB + more;
    found.difference = a.first == b.first ? 0.5 * (b.part - a.part) * (atA + atB) : rest + (untilB - untilA) + more;
    return found;
}

FetexFeatureProducts fetexFeatureMean(float distance, float reach, int profile) {
    int row = 4 * profile;
    int entries = textureSize(fetexFeatureProfile, 0).x;
    FetexFeatureProducts p;
    p.color = vec4(0.0), p.across = 0.0;
    FetexFeatureCell b = fetexFeatureCellAt(distance + reach, entries);
    if (reach > 0.0) {
        FetexFeatureCell a = fetexFeatureCellAt(abs(distance - reach), entries);
        bool both = distance < reach;
        float scale = 0.5 * FETEX_FEATURE_LIMIT / (float(entries - 1) * reach);
        FetexFeatureIntegrals found = fetexFeatureIntegral(a, b, row, entries);
        p.products = scale * (both ? found.sum : found.difference);
        p.products.x = scale * found.difference.x; // across a curve the slope has the other sign
        p.across = both ? scale * found.first.z : 0.0;
#if FETEX_FEATURE_KIND == 0
        found = fetexFeatureIntegral(a, b, row + 1, entries);
        p.color = scale * (both ? found.sum : found.difference);
#endif
    } else {
        float part = b.first == entries - 1 ? 0.0 : b.part;
        p.products = mix(fetexFeatureRow(b.first, row, entries), fetexFeatureRow(b.first + 1, row, entries), part);
#if FETEX_FEATURE_KIND == 0
        p.color = mix(fetexFeatureRow(b.first, row + 1, entries), fetexFeatureRow(b.first + 1, row + 1, entries), part);
#endif
    }
    return p;
}

#if FETEX_FEATURE_PROFILES > 1
// Of the first of the numbers that counts: the number, and 1; 0 if none does.
uvec2 fetexFeatureCounting(uvec4 numbers, vec4 parts) {
    return parts.x > 0.0 ? uvec2(numbers.x, 1u) : parts.y > 0.0 ? uvec2(numbers.y, 1u)
         : parts.z > 0.0 ? uvec2(numbers.z, 1u) : uvec2(numbers.w, parts.w > 0.0);
}

// Of all profiles that count; one after the other, as mostly there is one. Asked for at the loop's end, as some renderers run
// through a loop once more to leave it elsewhere.
FetexFeatureProducts fetexFeatureMixed(FetexFeatureAt at, float reach) {
    const uvec4 places = uvec4(0u, 4u, 8u, 12u);
    uvec4 corners = (uvec4(at.profiles) >> places) & 15u, edges = (uvec4(at.profiles) >> (places + 16u)) & 15u;
    vec4 ofCorners = at.ofCorners, ofEdges = at.ofEdges;
    FetexFeatureProducts sum = FetexFeatureProducts(vec4(0.0), vec4(0.0), 0.0);
    uvec2 next = fetexFeatureCounting(corners, ofCorners);
    int left = textureSize(fetexFeatureProfile, 0).y / 4; // a constant would have the loop unrolled
    do {
        next = next.y == 0u ? fetexFeatureCounting(edges, ofEdges) : next;
        vec4 sameCorners = vec4(equal(corners, uvec4(next.x))), sameEdges = vec4(equal(edges, uvec4(next.x)));
        float part = dot(ofCorners, sameCorners) + dot(ofEdges, sameEdges);
        FetexFeatureProducts p = fetexFeatureMean(at.distance, reach, int(next.x));
        sum.products += part * p.products;
        sum.color += part * p.color;
        sum.across += part * p.across;
        ofCorners *= 1.0 - sameCorners;
        ofEdges *= 1.0 - sameEdges;
        next = fetexFeatureCounting(corners, ofCorners);
    } while (--left > 0 && dot(ofCorners, vec4(1.0)) + dot(ofEdges, vec4(1.0)) > 0.0);
    return sum;
}
#endif

vec3 fetexFeatureUnit(vec3 v) {
    float size = length(v);
    return size >= 1.0 / 1048576.0 ? v / size : vec3(0.0, 0.0, 1.0);
}

// reach: half of what a pixel sees, in texels; 0 for a point.
vec4 fetexFeatureShown(FetexFeatureAt at, float reach) {
#if FETEX_FEATURE_PROFILES > 1
    FetexFeatureProducts p = fetexFeatureMixed(at, reach);
#else
    FetexFeatureProducts p = fetexFeatureMean(at.distance, reach, 0);
#endif
    vec4 base = p.across > 0.0 ? mix(at.base, at.across, p.across / p.products.z) : at.base;
#if FETEX_FEATURE_KIND == 1
    vec3 n = fetexFeatureUnit(clamp(base.xyz * FETEX_FEATURE_NORMAL_FACTOR - 1.0, -1.0, 1.0));
    n *= length(vec2(p.products.y * length(at.gradient), p.products.z));
    n += vec3(-p.products.x * at.gradient, 1.0 - p.products.z);
    return vec4(0.5 * fetexFeatureUnit(n) + 0.5, 1.0);
#elif FETEX_FEATURE_KIND == 2
    return vec4(vec3(clamp(p.products.w * (1.0 / FETEX_FEATURE_HEIGHT_SCALE) + p.products.z * base.x, 0.0, 1.0)), 1.0);
#else
    return p.color + p.products.z * base;
#endif
}

float fetexFeatureReach(vec2 pixel) {
    pixel = clamp(pixel, 0.0, 1.0);
    return sqrt(dot(pixel, pixel) * 0.125);
}

vec4 fetexFeatureSampleTexel(ivec2 base, vec2 local) { return fetexFeatureShown(fetexFeatureFind(base, local), 0.0); }

vec4 fetexFeatureSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel) {
    return fetexFeatureShown(fetexFeatureFind(base, local), fetexFeatureReach(pixel));
}

// uv as texel and offset; outside [0,1] the border.
void fetexFeaturePlace(vec2 uv, out ivec2 base, out vec2 local) {
    ivec2 size = fetexFeatureSize();
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(size);
    base = min(ivec2(position), size - 1);
    local = position - vec2(base);
}

vec4 fetexFeatureSample(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexFeaturePlace(uv, base, local);
    return fetexFeatureSampleTexel(base, local);
}

vec4 fetexFeatureSampleArea(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexFeaturePlace(uv, base, local);
    return fetexFeatureSampleAreaTexel(base, local, pixel);
}

#if FETEX_FEATURE_MIPS
vec4 fetexFeatureSampleMipTexel(ivec2 base, vec2 local, vec2 pixel) {
    ivec2 size = fetexFeatureSize();
    float part;
    int level = fetexLevel(size, max(max(pixel.x, pixel.y), 0.0), part);
    vec2 uv = (vec2(base) + local) / vec2(size);
    vec4 color;
    if (level > 0)
        color = fetexBilinear(fetexFeatureMips, uv, level - 1, fetexLevelSize(size, level));
    else
        color = fetexFeatureSampleAreaTexel(base, local, pixel);
    if (part > 0.0) color = mix(color, fetexBilinear(fetexFeatureMips, uv, level, fetexLevelSize(size, level + 1)), part);
    return color;
}

vec4 fetexFeatureSampleMip(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexFeaturePlace(uv, base, local);
    return fetexFeatureSampleMipTexel(base, local, pixel);
}
#endif
