// SPDX-License-Identifier: Apache-2.0 OR MIT
// What samplers share: which mip levels a pixel takes, interpolation in full precision, and soft edges. Goes once, after a
// prelude, before fetex_fbt_mip.glsl, fetex_bilevel.glsl, fetex_silmap.glsl, fetex_pinchmap.glsl and fetex_feature_curves.glsl. Level 0
// is the size of the texture, level k the chunk FBTM, BLVM, SLMM, PNCM or FCVM of level k and GL's level k - 1.

// Rounded down, exactly; for v > 0.
int fetexLog2(float v) { return (floatBitsToInt(v) >> 23) - 127; }

ivec2 fetexLevelSize(ivec2 size, int level) { return max(size >> level, ivec2(1)); }

// Texels across a sample of a level, in the direction that has more.
float fetexLevelScale(ivec2 size, int level) {
    vec2 scale = vec2(size) / vec2(fetexLevelSize(size, level));
    return max(scale.x, scale.y);
}

// The coarsest level that isn't coarser than a pixel of so many texels a side; part: how far it is to the next, 0 to 1, by
// logarithms. Scales lie from 2^k to below 2^(k+1).
int fetexLevel(ivec2 size, float side, out float part) {
    int levels = max(fetexLog2(float(max(size.x, size.y))), 1);
    int level = min(fetexLog2(max(side, 1.0)), levels);
    if (fetexLevelScale(size, level) > side) level = max(level - 1, 0);
    if (side >= fetexLevelScale(size, levels)) level = levels;
    float from = fetexLevelScale(size, level), to = fetexLevelScale(size, min(level + 1, levels));
    part = level < levels && side > from ? log2(side / from) / log2(to / from) : 0.0;
    return level;
}

// Between the samples, which stand in the middle of what they are of; those at the border are repeated. size: of GL's level.
vec4 fetexBilinear(highp sampler2D samples, vec2 uv, int level, ivec2 size) {
    ivec2 last = size - 1;
    vec2 at = clamp(uv, 0.0, 1.0) * vec2(size) - 0.5, whole = floor(at), weight = at - whole;
    ivec2 a = clamp(ivec2(whole), ivec2(0), last), b = clamp(ivec2(whole) + 1, ivec2(0), last);
    vec4 upper = mix(texelFetch(samples, a, level), texelFetch(samples, ivec2(b.x, a.y), level), weight.x);
    vec4 lower = mix(texelFetch(samples, ivec2(a.x, b.y), level), texelFetch(samples, b, level), weight.x);
    return mix(upper, lower, weight.y);
}

// The part of a pixel on the positive side of a straight edge. value: in its middle, 0 on the edge; change: along its sides.
float fetexCut(float value, vec2 change) {
    change = abs(change);
    float shorter = min(change.x, change.y), longer = max(change.x, change.y), fromEdge = abs(value);
    // A corner of the pixel meets the edge: from there on the part grows ever less. Quotients of 0 are kept out.
    float beyond = clamp(fromEdge - 0.5 * (longer - shorter), 0.0, shorter);
    float missing = 0.5 * beyond * (beyond / max(shorter, 1e-30));
    // Where nothing changes the cut is hard: the quotient is out of range.
    return clamp(0.5 + sign(value) * ((fromEdge - missing) / max(longer, 1e-30)), 0.0, 1.0);
}
