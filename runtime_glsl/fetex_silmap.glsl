// SPDX-License-Identifier: Apache-2.0 OR MIT
// Silhouette-map textures (Sen): a bitmap whose interpolation stops at the links of a grid of points. Semantics:
// formats/SPEC.md, section 7; the same in double: formats/silmap.cpp, formats/silmap_sampler.cpp. Goes after a prelude.
//
//   vec4 fetexSilmapSample(vec2 uv)
//   vec4 fetexSilmapSampleTexel(ivec2 base, vec2 local)           the same point as texel and offset in [0,1): deep zoom
//   vec4 fetexSilmapSampleArea(vec2 uv, vec2 pixel)               mean over a pixel with these sides in texels
//   vec4 fetexSilmapSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel)
//   vec4 fetexSilmapSampleMip(vec2 uv, vec2 pixel)                any pixel; with FETEX_SILMAP_MIPS, after fetex_levels.glsl
//   vec4 fetexSilmapSampleMipTexel(ivec2 base, vec2 local, vec2 pixel)
//
//   fetexSilmapCells    R8UI or R16UI 2D, (width + 1) x (height + 1), edges clamped
//   fetexSilmapColors   2D: RGBA8, RGB8 or RGBA16F; RGBA16UI for samples of 16 bits
//   fetexSilmapMips     RGBA8 2D with a mip chain: GL's level k is the chunk SLMM of level k + 1
//
// Defined before it, by silmap_specialisation (host/shader_source.h) or by hand:
//   FETEX_SILMAP_BITS       of a coordinate in a cell: 3 (R8UI) or 7 (R16UI)
//   FETEX_SILMAP_SAMPLES    1: fetexSilmapColors is RGBA16UI
//   FETEX_SILMAP_FILTERED   0: each point has the colour of its corner; 1: of all that it reaches
//   FETEX_SILMAP_MIPS       1: there is a mip chain
//   FETEX_SILMAP_GATHER     1: textureGather of cells; where the dialect has it, unless it says otherwise
//
// Fetches of a point: two cells and one colour, filtered four cells (or two gathers) and four colours. Of a pixel: five
// cells (two gathers) and four colours in each of the one to four cells that it overlaps.

#ifndef FETEX_SILMAP_BITS
#define FETEX_SILMAP_BITS 3
#endif
#ifndef FETEX_SILMAP_SAMPLES
#define FETEX_SILMAP_SAMPLES 0
#endif
#ifndef FETEX_SILMAP_FILTERED
#define FETEX_SILMAP_FILTERED 1
#endif
#ifndef FETEX_SILMAP_MIPS
#define FETEX_SILMAP_MIPS 0
#endif
// Gathers of integers don't cross from SPIR-V to HLSL; where Vulkan runs it, define it as 1.
#ifndef FETEX_SILMAP_GATHER
#if (__VERSION__ >= 400 || defined(GL_ARB_texture_gather)) && !defined(FETEX_VULKAN)
#define FETEX_SILMAP_GATHER 1
#else
#define FETEX_SILMAP_GATHER 0
#endif
#endif

FETEX_UNIFORM(0) highp usampler2D fetexSilmapCells;
#if FETEX_SILMAP_SAMPLES
FETEX_UNIFORM(1) highp usampler2D fetexSilmapColors;
#else
FETEX_UNIFORM(1) highp sampler2D fetexSilmapColors;
#endif
#if FETEX_SILMAP_MIPS
FETEX_UNIFORM(2) highp sampler2D fetexSilmapMips;
#endif

ivec2 fetexSilmapSize() { return textureSize(fetexSilmapColors, 0); }

vec4 fetexSilmapColor(ivec2 texel) {
#if FETEX_SILMAP_SAMPLES
    return vec4(texelFetch(fetexSilmapColors, texel, 0)) * (1.0 / 65535.0);
#else
    return texelFetch(fetexSilmapColors, texel, 0);
#endif
}

uint fetexSilmapCell(ivec2 cell) {
    return texelFetch(fetexSilmapCells, clamp(cell, ivec2(0), textureSize(fetexSilmapCells, 0) - 1), 0).r;
}

// Where a cell's point is, in 0 ... 1; exact.
vec2 fetexSilmapPoint(uint cell) {
    const float unit = 1.0 / float(1 << FETEX_SILMAP_BITS);
    const uint mask = (1u << FETEX_SILMAP_BITS) - 1u;
    return vec2(float(cell & mask), float(cell >> FETEX_SILMAP_BITS & mask)) * unit + 0.5 * unit;
}
bool fetexSilmapEast(uint cell) { return (cell & (1u << (2 * FETEX_SILMAP_BITS))) != 0u; }
bool fetexSilmapSouth(uint cell) { return (cell & (2u << (2 * FETEX_SILMAP_BITS))) != 0u; }

// A cell and its neighbours.
struct FetexSilmapCells {
    uint own, west, north, east, south;
};

FetexSilmapCells fetexSilmapNeighbours(ivec2 cell) {
    FetexSilmapCells c;
#if FETEX_SILMAP_GATHER
    // Between four cells, where rounding can't reach others. Edges are clamped by the sampler.
    vec2 scale = 1.0 / vec2(textureSize(fetexSilmapCells, 0));
    uvec4 before = textureGather(fetexSilmapCells, vec2(cell) * scale);
    uvec4 after = textureGather(fetexSilmapCells, vec2(cell + 1) * scale);
    c.own = before.y, c.west = before.x, c.north = before.z, c.east = after.z, c.south = after.x;
#else
    c.own = fetexSilmapCell(cell);
    c.west = fetexSilmapCell(cell - ivec2(1, 0)), c.north = fetexSilmapCell(cell - ivec2(0, 1));
    c.east = fetexSilmapCell(cell + ivec2(1, 0)), c.south = fetexSilmapCell(cell + ivec2(0, 1));
#endif
    return c;
}

// The cell of a point, and where it is in it: cells begin in the middles of texels.
void fetexSilmapPlace(ivec2 base, vec2 local, out ivec2 cell, out vec2 at) {
    vec2 second = step(0.5, local);
    cell = base + ivec2(second);
    at = local + 0.5 - second;
}

// Which neighbour's link tells the corner: that across the side which the point lies before, seen from the cell's
// point; the line to the corner says which side that is.
ivec2 fetexSilmapAcross(vec2 point, vec2 at) {
    vec2 d = at - point;
    ivec2 towards = ivec2(d.x >= 0.0 ? 1 : -1, d.y >= 0.0 ? 1 : -1);
    vec2 room = mix(point, 1.0 - point, greaterThanEqual(d, vec2(0.0)));
    return abs(d.x) * room.y > abs(d.y) * room.x ? ivec2(towards.x, 0) : ivec2(0, towards.y);
}

// The corner whose quadrant holds the point, 0 or 1 along x and y. across: the neighbour's point, from this cell's.
ivec2 fetexSilmapQuadrant(vec2 point, ivec2 direction, vec2 across, vec2 at) {
    vec2 d = at - point;
    float turn = d.y * across.x - d.x * across.y;
    int beyond = turn * float(direction.x - direction.y) >= 0.0 ? 1 : 0;
    return direction.y == 0 ? ivec2(max(direction.x, 0), beyond) : ivec2(beyond, max(direction.y, 0));
}

// From a corner, what links part: the next along x and along y; and the far ends of the same.
struct FetexSilmapWalls {
    bool x, y, farX, farY;
};

FetexSilmapWalls fetexSilmapWallsFrom(ivec2 corner, uint own, uint west, uint north) {
    bool e = fetexSilmapEast(own), s = fetexSilmapSouth(own), w = fetexSilmapEast(west), n = fetexSilmapSouth(north);
    FetexSilmapWalls walls;
    walls.x = corner.y != 0 ? s : n, walls.farX = corner.y != 0 ? n : s;
    walls.y = corner.x != 0 ? e : w, walls.farY = corner.x != 0 ? w : e;
    return walls;
}

// Weights of the corner, the next along x, the next along y, and the one across; uv: from the corner.
vec4 fetexSilmapWeights(FetexSilmapWalls walls, vec2 uv) {
    bool toX = !walls.x, toY = !walls.y, across = (toX && !walls.farY) || (toY && !walls.farX);
    float u = uv.x, v = uv.y;
    if (toX && toY && across) return vec4((1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v);
    // One corner, two, or the plane through three; beyond their diagonal the nearest point on it.
    float beyond;
    if (toX && toY) {
        beyond = max(u + v - 1.0, 0.0);
        return vec4(max(1.0 - u - v, 0.0), u - 0.5 * beyond, v - 0.5 * beyond, 0.0);
    }
    if (toX && across) {
        beyond = max(v - u, 0.0);
        return vec4(1.0 - u - 0.5 * beyond, max(u - v, 0.0), 0.0, v - 0.5 * beyond);
    }
    if (toY && across) {
        beyond = max(u - v, 0.0);
        return vec4(1.0 - v - 0.5 * beyond, 0.0, max(v - u, 0.0), u - 0.5 * beyond);
    }
    return toX ? vec4(1.0 - u, u, 0.0, 0.0) : toY ? vec4(1.0 - v, 0.0, v, 0.0) : vec4(1.0, 0.0, 0.0, 0.0);
}

vec4 fetexSilmapSampleTexel(ivec2 base, vec2 local) {
    ivec2 cell, last = fetexSilmapSize() - 1;
    vec2 at;
    fetexSilmapPlace(base, local, cell, at);
#if FETEX_SILMAP_FILTERED
#if FETEX_SILMAP_GATHER
    FetexSilmapCells cells = fetexSilmapNeighbours(cell);
    vec2 point = fetexSilmapPoint(cells.own);
    ivec2 direction = fetexSilmapAcross(point, at);
    uint next = direction.y == 0 ? (direction.x > 0 ? cells.east : cells.west)
                                 : (direction.y > 0 ? cells.south : cells.north);
    uint own = cells.own, west = cells.west, north = cells.north;
#else
    uint own = fetexSilmapCell(cell), west = fetexSilmapCell(cell - ivec2(1, 0)),
         north = fetexSilmapCell(cell - ivec2(0, 1));
    vec2 point = fetexSilmapPoint(own);
    ivec2 direction = fetexSilmapAcross(point, at);
    uint next = fetexSilmapCell(cell + direction);
#endif
    ivec2 corner = fetexSilmapQuadrant(point, direction, fetexSilmapPoint(next) + vec2(direction) - point, at);
    vec4 weights = fetexSilmapWeights(fetexSilmapWallsFrom(corner, own, west, north), abs(at - vec2(corner)));
    ivec2 texel = clamp(cell - 1 + corner, ivec2(0), last), other = clamp(cell - corner, ivec2(0), last);
    return fetexSilmapColor(texel) * weights.x + fetexSilmapColor(ivec2(other.x, texel.y)) * weights.y +
           fetexSilmapColor(ivec2(texel.x, other.y)) * weights.z + fetexSilmapColor(other) * weights.w;
#else
    vec2 point = fetexSilmapPoint(fetexSilmapCell(cell));
    ivec2 direction = fetexSilmapAcross(point, at);
    vec2 across = fetexSilmapPoint(fetexSilmapCell(cell + direction)) + vec2(direction) - point;
    return fetexSilmapColor(clamp(cell - 1 + fetexSilmapQuadrant(point, direction, across, at), ivec2(0), last));
#endif
}

// Of each link (west, north, east, south): the integral of clamp(x - low.x, 0, width) dy along it, y cut to the box.
vec4 fetexSilmapLeftOf(vec2 point, vec4 toX, vec4 toY, vec2 low, vec2 high) {
    float width = high.x - low.x, from = clamp(point.y, low.y, high.y);
    vec4 to = clamp(toY, low.y, high.y), down = toY - point.y;
    vec4 slope = (toX - point.x) / mix(down, vec4(1.0), equal(down, vec4(0.0)));
    vec4 a = (point.x - low.x) + slope * (from - point.y), b = (point.x - low.x) + slope * (to - point.y);
    vec4 least = min(a, b), most = max(a, b), range = max(most - least, 1e-20);
    vec4 inside = clamp(-least / range, 0.0, 1.0), beyond = clamp((width - least) / range, 0.0, 1.0);
    vec4 mean = 0.5 * (beyond - inside) * (clamp(least, 0.0, width) + clamp(most, 0.0, width)) + (1.0 - beyond) * width;
    return (to - from) * mean;
}

// The quadrants' parts of a box, of the corners (0,0), (1,0), (0,1), (1,1).
vec4 fetexSilmapAreas(vec2 point, vec4 toX, vec4 toY, vec2 low, vec2 high) {
    vec4 left = fetexSilmapLeftOf(point, toX, toY, low, high);
    float width = high.x - low.x, end = clamp(toY.z, low.y, high.y);
    return max(vec4(left.x - left.y, left.y - left.z + width * (end - low.y), left.w - left.x,
                    left.z - left.w + width * (high.y - end)),
               0.0);
}

// The colour of a box in a cell, times its area. middle: of the pixel; low and high from there, as it is exact.
vec4 fetexSilmapBox(ivec2 cell, vec2 middle, vec2 low, vec2 high) {
    FetexSilmapCells cells = fetexSilmapNeighbours(cell);
    vec2 west = fetexSilmapPoint(cells.west), north = fetexSilmapPoint(cells.north),
         east = fetexSilmapPoint(cells.east), south = fetexSilmapPoint(cells.south);
    vec4 toX = vec4(west.x - 1.0, north.x, east.x + 1.0, south.x) - middle.x,
         toY = vec4(west.y, north.y - 1.0, east.y, south.y + 1.0) - middle.y;
    vec4 areas = fetexSilmapAreas(fetexSilmapPoint(cells.own) - middle, toX, toY, low, high);
    vec4 weights = areas;
#if FETEX_SILMAP_FILTERED
    vec2 at = middle + 0.5 * (low + high);
    vec4 nw = fetexSilmapWeights(fetexSilmapWallsFrom(ivec2(0, 0), cells.own, cells.west, cells.north), at);
    vec4 ne = fetexSilmapWeights(fetexSilmapWallsFrom(ivec2(1, 0), cells.own, cells.west, cells.north),
                                 vec2(1.0 - at.x, at.y));
    vec4 sw = fetexSilmapWeights(fetexSilmapWallsFrom(ivec2(0, 1), cells.own, cells.west, cells.north),
                                 vec2(at.x, 1.0 - at.y));
    vec4 se = fetexSilmapWeights(fetexSilmapWallsFrom(ivec2(1, 1), cells.own, cells.west, cells.north), 1.0 - at);
    weights = areas.x * nw + areas.y * ne.yxwz + areas.z * sw.zwxy + areas.w * se.wzyx;
#endif
    ivec2 last = fetexSilmapSize() - 1, a = clamp(cell - 1, ivec2(0), last), b = clamp(cell, ivec2(0), last);
    return fetexSilmapColor(a) * weights.x + fetexSilmapColor(ivec2(b.x, a.y)) * weights.y +
           fetexSilmapColor(ivec2(a.x, b.y)) * weights.z + fetexSilmapColor(b) * weights.w;
}

vec4 fetexSilmapSampleAreaTexel(ivec2 base, vec2 local, vec2 pixel) {
    vec2 side = clamp(pixel, vec2(1.0 / 32768.0), vec2(1.0)), reach = 0.5 * side;
    // Along each axis the pixel lies in one or both of the cells that meet in the texel's middle.
    vec2 from = local - 0.5; // from where they meet
    ivec2 first = ivec2(greaterThanEqual(from - reach, vec2(0.0))), count = 1 + ivec2(greaterThan(from + reach, vec2(0.0))) - first;
    vec4 sum = vec4(0.0);
    for (int k = 0; k < count.x * count.y; ++k) {
        ivec2 at = first + (count.x == 1 ? ivec2(0, k) : ivec2(k & 1, k >> 1));
        vec2 middle = from + 1.0 - vec2(at);
        sum += fetexSilmapBox(base + at, middle, max(-reach, -middle), min(reach, 1.0 - middle));
    }
    return sum / (side.x * side.y);
}

// uv as texel and offset; outside [0,1] the border.
void fetexSilmapPosition(vec2 uv, out ivec2 base, out vec2 local) {
    vec2 position = clamp(uv, 0.0, 1.0) * vec2(fetexSilmapSize()), whole = floor(position);
    base = ivec2(whole);
    local = position - whole;
}

vec4 fetexSilmapSample(vec2 uv) {
    ivec2 base;
    vec2 local;
    fetexSilmapPosition(uv, base, local);
    return fetexSilmapSampleTexel(base, local);
}

vec4 fetexSilmapSampleArea(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexSilmapPosition(uv, base, local);
    return fetexSilmapSampleAreaTexel(base, local, pixel);
}

#if FETEX_SILMAP_MIPS
vec4 fetexSilmapSampleMipTexel(ivec2 base, vec2 local, vec2 pixel) {
    ivec2 size = fetexSilmapSize();
    float part;
    int level = fetexLevel(size, max(max(pixel.x, pixel.y), 0.0), part);
    vec2 uv = (vec2(base) + local) / vec2(size);
    vec4 color;
    if (level > 0)
        color = fetexBilinear(fetexSilmapMips, uv, level - 1, fetexLevelSize(size, level));
    else
        color = fetexSilmapSampleAreaTexel(base, local, pixel);
    if (part > 0.0)
        color = mix(color, fetexBilinear(fetexSilmapMips, uv, level, fetexLevelSize(size, level + 1)), part);
    return color;
}

vec4 fetexSilmapSampleMip(vec2 uv, vec2 pixel) {
    ivec2 base;
    vec2 local;
    fetexSilmapPosition(uv, base, local);
    return fetexSilmapSampleMipTexel(base, local, pixel);
}
#endif
