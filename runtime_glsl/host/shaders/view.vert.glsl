// SPDX-License-Identifier: Apache-2.0 OR MIT
// One triangle over the whole viewport, without vertex data.
#ifdef FETEX_VULKAN
#define FETEX_VERTEX gl_VertexIndex
#else
#define FETEX_VERTEX gl_VertexID
#endif
void main() {
    gl_Position = vec4(FETEX_VERTEX == 1 ? 3.0 : -1.0, FETEX_VERTEX == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
