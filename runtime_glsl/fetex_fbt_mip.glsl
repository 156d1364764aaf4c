// SPDX-License-Identifier: Apache-2.0 OR MIT
// The mip chain of a feature-based texture: views with more than one texel a pixel. Semantics: formats/SPEC.md, section
// 4.2; the same in double: formats/fbt_mip.cpp. Goes after fetex_fbt.glsl, fetex_fbt_area.glsl and
// fetex_levels.glsl, for textures that have a chain.
//
//   vec4 fetexFbtSampleMip(vec2 uv, float texelsPerPixel)                       a square pixel
//   vec4 fetexFbtSampleMipAniso(vec2 uv, vec2 dx, vec2 dy)                      uv from pixel to pixel (dFdx, dFdy)
//   vec4 fetexFbtSampleMipTexel(ivec2 base, vec2 local, float texelsPerPixel)   as fetexFbtSampleTexel
//   vec4 fetexFbtSampleMipAnisoTexel(ivec2 base, vec2 local, vec2 dx, vec2 dy)  the same; dx, dy in texels
//
//   fetexFbtMips     RGBA8 2D with a mip chain: GL's level k is the chunk FBTM of level k + 1; no filter is used: some
//                    drivers round what they interpolate to 8 bits, so the shader does it
//
// Any number of texels a pixel will do; below the scale of level 1 the features are area sampled, once a tap.

FETEX_UNIFORM(3) highp sampler2D fetexFbtMips;

const int fetexFbtMipMaxTaps = 8;

vec4 fetexFbtMipLevel(vec2 uv, int level) {
    return fetexBilinear(fetexFbtMips, uv, level - 1, fetexLevelSize(fetexFbtSize(), level));
}

// Mean over a square of so many texels around a position, which may lie beyond the texture.
vec4 fetexFbtBox(ivec2 base, vec2 local, float side) {
    local = mix(local, vec2(0.0), lessThan(base, ivec2(0))); // there its border is repeated
    local = mix(local, vec2(1.0), greaterThanEqual(base, fetexFbtSize()));
    return fetexFbtSampleAreaTexel(base, local, vec2(max(0.5 * side, 1e-7)));
}

vec4 fetexFbtSampleMipTexel(ivec2 base, vec2 local, float texelsPerPixel) {
    float side = max(texelsPerPixel, 0.0), part;
    int level = fetexLevel(fetexFbtSize(), side, part);
    vec2 uv = (vec2(base) + local) / vec2(fetexFbtSize());
    vec4 fine = level > 0 ? fetexFbtMipLevel(uv, level) : fetexFbtBox(base, local, min(side, 1.0));
    return part > 0.0 ? mix(fine, fetexFbtMipLevel(uv, level + 1), part) : fine;
}

vec4 fetexFbtSampleMip(vec2 uv, float texelsPerPixel) {
    ivec2 base;
    vec2 local;
    fetexFbtLocate(uv, base, local);
    return fetexFbtSampleMipTexel(base, local, texelsPerPixel);
}

// dx, dy in texels.
vec4 fetexFbtSampleMipAnisoTexel(ivec2 base, vec2 local, vec2 dx, vec2 dy) {
    float lengthX = length(dx), lengthY = length(dy), longer = max(lengthX, lengthY);
    vec2 axis = lengthX >= lengthY ? dx : dy;
    float height = longer > 0.0 ? abs(dx.x * dy.y - dx.y * dy.x) / longer : 0.0;
    float ratio = longer > 0.0 ? longer / max(height, longer / float(fetexFbtMipMaxTaps)) : 1.0;
    float taps = max(floor(ratio + (0.5 - 1.0 / 1024.0)), 1.0), side = max(longer / taps, height);
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap < int(taps); ++tap) {
        vec2 at = local + axis * ((float(tap) + 0.5) / taps - 0.5), whole = floor(at);
        sum += fetexFbtSampleMipTexel(base + ivec2(whole), at - whole, side);
    }
    return sum / taps;
}

vec4 fetexFbtSampleMipAniso(vec2 uv, vec2 dx, vec2 dy) {
    vec2 size = vec2(fetexFbtSize()), local;
    ivec2 base;
    fetexFbtLocate(uv, base, local);
    return fetexFbtSampleMipAnisoTexel(base, local, dx * size, dy * size);
}
