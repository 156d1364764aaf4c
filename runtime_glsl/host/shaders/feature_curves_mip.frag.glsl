// SPDX-License-Identifier: Apache-2.0 OR MIT
vec4 fetexSampleAt(ivec2 base, vec2 local) {
    fetexClampPosition(base, local, fetexFeatureSize());
    return fetexFeatureSampleMipTexel(base, local, fetexPixelSides);
}
