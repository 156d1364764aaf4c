// SPDX-License-Identifier: Apache-2.0 OR MIT
// The one place that chooses how a pixel is filtered. pixel: its sides in texels.
vec4 fetexFbtSampleFiltered(ivec2 base, vec2 local, vec2 pixel) {
    return fetexFbtSampleMipAnisoTexel(base, local, vec2(pixel.x, 0.0), vec2(0.0, pixel.y));
}

vec4 fetexSampleAt(ivec2 base, vec2 local) {
    fetexClampPosition(base, local, fetexFbtSize());
    return fetexFbtSampleFiltered(base, local, fetexPixelSides);
}
