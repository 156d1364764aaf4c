// SPDX-License-Identifier: GPL-3.0-or-later
//! The types of svg_front_end.h, field by field.

use std::ffi::c_char;

pub const ABI: u32 = 2;
pub const NONE: u32 = u32::MAX;

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Affine {
    pub m: [f64; 6],
}

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Segment {
    pub degree: u32,
    pub reserved: u32,
    pub p: [f64; 8],
}

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Contour {
    pub first: u32,
    pub count: u32,
}

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Shape {
    pub first: u32,
    pub count: u32,
    pub rule: u32,
    pub element: u32,
}

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Stop {
    pub offset: f64,
    pub r: f64,
    pub g: f64,
    pub b: f64,
    pub a: f64,
}

pub const SOLID: u32 = 0;
pub const LINEAR: u32 = 1;
pub const RADIAL: u32 = 2;
pub const RASTER: u32 = 3;

#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Paint {
    pub kind: u32,
    pub spread: u32,
    pub stop: u32,
    pub stop_count: u32,
    pub v: [f64; 6],
    pub to_paint: Affine,
    pub width: u32,
    pub height: u32,
    pub offset: u64,
    pub smooth: u32,
    pub reserved: u32,
}

#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ClipMember {
    pub shape: u32,
    pub clip: u32,
}

#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Clip {
    pub first: u32,
    pub count: u32,
    pub parent: u32,
}

#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Mask {
    pub first: u32,
    pub end: u32,
    pub luminance: u32,
    pub linear_rgb: u32,
    pub region: u32,
    pub parent: u32,
}

pub const GROUP: u32 = 0;
pub const FILL: u32 = 1;

#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Node {
    pub kind: u32,
    pub end: u32,
    pub clip: u32,
    pub mask: u32,
    pub blend: u32,
    pub isolated: u32,
    pub shape: u32,
    pub paint: u32,
    pub element: u32,
    pub line: u32,
    pub opacity: f64,
}

#[derive(Clone, Copy)]
#[repr(C)]
pub struct Str {
    pub text: *const u8,
    pub length: usize,
}

#[derive(Clone, Copy)]
#[repr(C)]
pub struct FindingEntry {
    pub code: u32,
    pub severity: u32,
    pub message: Str,
    pub place: Str,
}

#[repr(C)]
pub struct View {
    pub abi: u32,
    pub root_end: u32,
    pub width: f64,
    pub height: f64,
    pub nodes: *const Node,
    pub node_count: usize,
    pub shapes: *const Shape,
    pub shape_count: usize,
    pub contours: *const Contour,
    pub contour_count: usize,
    pub segments: *const Segment,
    pub segment_count: usize,
    pub paints: *const Paint,
    pub paint_count: usize,
    pub stops: *const Stop,
    pub stop_count: usize,
    pub clips: *const Clip,
    pub clip_count: usize,
    pub clip_members: *const ClipMember,
    pub clip_member_count: usize,
    pub masks: *const Mask,
    pub mask_count: usize,
    pub elements: *const Str,
    pub element_count: usize,
    pub findings: *const FindingEntry,
    pub finding_count: usize,
    pub bytes: *const u8,
    pub byte_count: usize,
    pub paths_recovered: u64,
    pub paths_kept_f32: u64,
}

#[repr(C)]
pub struct Options {
    pub font_files: *const *const c_char,
    pub font_file_count: usize,
    pub system_fonts: u32,
    pub raster_pixels: u32,
    pub default_family: *const c_char,
    pub resources_dir: *const c_char,
    pub dpi: f64,
    pub arc_tolerance: f64,
    pub stroke_tolerance: f64,
    pub max_bytes: u64,
    pub max_elements: u64,
    pub max_segments: u64,
    pub max_raster_bytes: u64,
    pub max_nesting: u32,
    pub max_milliseconds: u32,
    pub threads: u32,
    pub centre_lines: u32,
}

#[repr(C)]
pub struct Error {
    pub code: u32,
    pub message: [u8; 256],
    pub place: [u8; 128],
}
