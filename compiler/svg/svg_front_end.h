/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * C ABI of the Rust crate in front_end/: SVG bytes in, flat arrays out. Plain data only: (pointer, count) pairs joined
 * by indices, owned by the document, valid until it is freed; no callbacks, nothing unwinds. Keep in step with
 * front_end/src/abi.rs.
 *
 * All geometry and paint transforms are in canvas space: user units, x right, y down, the picture is
 * [0,width]×[0,height].
 */
#ifndef FETEXC_SVG_FRONT_END_H
#define FETEXC_SVG_FRONT_END_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FETEXC_SVG_ABI 2u
#define FETEXC_SVG_NONE 0xffffffffu

/** x' = a x + c y + e, y' = b x + d y + f */
typedef struct {
    double a, b, c, d, e, f;
} fetexc_svg_affine;

/** Bezier segment; 2·(degree+1) numbers x,y are used. */
typedef struct {
    uint32_t degree, reserved;
    double p[8];
} fetexc_svg_segment;

/** Segments [first, first+count) join end to start; closed, but for what option centre_lines gives. */
typedef struct {
    uint32_t first, count;
} fetexc_svg_contour;

/** Contours [first, first+count); rule 0 nonzero, 1 even-odd. */
typedef struct {
    uint32_t first, count, rule, element;
} fetexc_svg_shape;

/** Straight sRGB colour. */
typedef struct {
    double offset, r, g, b, a;
} fetexc_svg_stop;

enum { FETEXC_SVG_SOLID = 0, FETEXC_SVG_LINEAR = 1, FETEXC_SVG_RADIAL = 2, FETEXC_SVG_RASTER = 3 };

/**
 * Solid: one stop. Linear: v = x1 y1 x2 y2. Radial: v = cx cy r fx fy fr. `to_paint` maps canvas space to the space of
 * v, or to pixels of the raster.
 */
typedef struct {
    uint32_t kind, spread; /* spread: 0 pad, 1 reflect, 2 repeat */
    uint32_t stop, stop_count;
    double v[6];
    fetexc_svg_affine to_paint;
    uint32_t width, height; /* raster: premultiplied RGBA8 rows at bytes + offset */
    uint64_t offset;
    uint32_t smooth, reserved;
} fetexc_svg_paint;

typedef struct {
    uint32_t shape, clip;
} fetexc_svg_clip_member;
typedef struct {
    uint32_t first, count, parent;
} fetexc_svg_clip;

/** Nodes [first, end) are the content. region: a shape. */
typedef struct {
    uint32_t first, end, luminance, linear_rgb, region, parent;
} fetexc_svg_mask;

enum { FETEXC_SVG_GROUP = 0, FETEXC_SVG_FILL = 1 };

/** Preorder; children of node i are i+1 … end-1. Fills use shape, paint, element; groups the rest. blend: W3C order. */
typedef struct {
    uint32_t kind, end, clip, mask, blend, isolated, shape, paint, element;
    uint32_t line; /* 1: what option centre_lines gives */
    double opacity;
} fetexc_svg_node;

/** UTF-8 without terminator. */
typedef struct {
    const char* text;
    size_t length;
} fetexc_svg_string;

/** severity: 0 note, 1 warning; code as in compiler/diagnostics.h */
typedef struct {
    uint32_t code, severity;
    fetexc_svg_string message, place;
} fetexc_svg_finding;

typedef struct {
    uint32_t abi, root_end; /* the picture is nodes [0, root_end) */
    double width, height;
    const fetexc_svg_node* nodes;
    size_t node_count;
    const fetexc_svg_shape* shapes;
    size_t shape_count;
    const fetexc_svg_contour* contours;
    size_t contour_count;
    const fetexc_svg_segment* segments;
    size_t segment_count;
    const fetexc_svg_paint* paints;
    size_t paint_count;
    const fetexc_svg_stop* stops;
    size_t stop_count;
    const fetexc_svg_clip* clips;
    size_t clip_count;
    const fetexc_svg_clip_member* clip_members;
    size_t clip_member_count;
    const fetexc_svg_mask* masks;
    size_t mask_count;
    const fetexc_svg_string* elements;
    size_t element_count;
    const fetexc_svg_finding* findings;
    size_t finding_count;
    const uint8_t* bytes;
    size_t byte_count;
    uint64_t paths_recovered, paths_kept_f32; /* geometry taken from the XML in f64, or from usvg in f32 */
} fetexc_svg_view;

typedef struct {
    const char* const* font_files; /* NUL-terminated paths */
    size_t font_file_count;
    uint32_t system_fonts;      /* scan the fonts of the machine */
    uint32_t raster_pixels;     /* of the larger canvas side, for raster layers */
    const char* default_family; /* NULL: the first font given */
    const char* resources_dir;  /* NULL: no file is read */
    double dpi;
    double arc_tolerance;    /* largest error of arcs, as a fraction of the larger canvas side */
    double stroke_tolerance; /* the same for stroke outlines */
    uint64_t max_bytes, max_elements, max_segments, max_raster_bytes;
    uint32_t max_nesting, max_milliseconds;
    uint32_t threads;      /* 0: all; never changes what comes out */
    /* strokes as the lines themselves, contours that may be open: 1 of shapes without fill, 2 all; 0: outlines */
    uint32_t centre_lines;
} fetexc_svg_options;

typedef struct {
    uint32_t code; /* 0: no error; else as in compiler/diagnostics.h */
    char message[256], place[128];
} fetexc_svg_error;

typedef struct fetexc_svg_document fetexc_svg_document;

uint32_t fetexc_svg_abi(void);
/** NULL on failure, then *error says why. Safe on any bytes. Thread-safe. */
fetexc_svg_document* fetexc_svg_load(const uint8_t* data, size_t length, const fetexc_svg_options* options,
                                     fetexc_svg_error* error);
const fetexc_svg_view* fetexc_svg_get(const fetexc_svg_document* document);
void fetexc_svg_free(fetexc_svg_document* document);

#ifdef __cplusplus
}
#endif
#endif
