// SPDX-License-Identifier: Apache-2.0 OR MIT
vec4 fetexSampleAt(ivec2 base, vec2 local) {
    fetexClampPosition(base, local, fetexFeatureSize());
    vec2 fraction = vec2(float(uint(fetexStep.z)), float(uint(fetexStep.w))) * (1.0 / 4294967296.0);
    return fetexFeatureSampleAreaTexel(base, local, vec2(fetexStep.xy) + fraction);
}
