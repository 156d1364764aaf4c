// SPDX-License-Identifier: GPL-3.0-or-later
//! The C entry points. Nothing unwinds out of them; pointers are checked for null, not for anything else.

use std::ffi::{c_char, CStr};
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::path::PathBuf;
use std::time::Duration;

use crate::abi::{Error, FindingEntry, Options, Str, View, ABI};
use crate::budget::{Code, Failure};
use crate::document::Drawing;
use crate::load::{is_note, Settings};
use crate::worker::load_guarded;

const MOST_THREADS: u32 = 1024;

/// The arrays, and the view that points into them.
pub struct Document {
    _drawing: Drawing,
    _elements: Vec<Str>,
    _findings: Vec<FindingEntry>,
    view: View,
}

fn text_of(s: &str) -> Str {
    Str { text: s.as_ptr(), length: s.len() }
}

impl Document {
    /// The arrays live on the heap and never move again, so the view stays valid with the box.
    fn new(drawing: Drawing) -> Box<Document> {
        let elements: Vec<Str> = drawing.elements.iter().map(|s| text_of(s)).collect();
        let entry = |f: &crate::report::Entry| FindingEntry {
            code: f.code,
            severity: !is_note(f.code) as u32,
            message: text_of(&f.message),
            place: text_of(&f.place),
        };
        let findings: Vec<FindingEntry> = drawing.findings.iter().map(entry).collect();
        let view = view_of(&drawing, &elements, &findings);
        Box::new(Document { _drawing: drawing, _elements: elements, _findings: findings, view })
    }
}

fn view_of(d: &Drawing, elements: &[Str], findings: &[FindingEntry]) -> View {
    View {
        abi: ABI,
        root_end: d.root_end,
        width: d.width,
        height: d.height,
        nodes: d.nodes.as_ptr(),
        node_count: d.nodes.len(),
        shapes: d.shapes.as_ptr(),
        shape_count: d.shapes.len(),
        contours: d.contours.as_ptr(),
        contour_count: d.contours.len(),
        segments: d.segments.as_ptr(),
        segment_count: d.segments.len(),
        paints: d.paints.as_ptr(),
        paint_count: d.paints.len(),
        stops: d.stops.as_ptr(),
        stop_count: d.stops.len(),
        clips: d.clips.as_ptr(),
        clip_count: d.clips.len(),
        clip_members: d.clip_members.as_ptr(),
        clip_member_count: d.clip_members.len(),
        masks: d.masks.as_ptr(),
        mask_count: d.masks.len(),
        elements: elements.as_ptr(),
        element_count: elements.len(),
        findings: findings.as_ptr(),
        finding_count: findings.len(),
        bytes: d.bytes.as_ptr(),
        byte_count: d.bytes.len(),
        paths_recovered: d.paths_recovered,
        paths_kept_f32: d.paths_kept_f32,
    }
}

/// # Safety: null or a NUL-terminated string.
unsafe fn string(p: *const c_char) -> Option<String> {
    (!p.is_null()).then(|| CStr::from_ptr(p).to_string_lossy().into_owned())
}

/// # Safety: as the header says.
unsafe fn settings(o: &Options) -> Settings {
    let count = if o.font_files.is_null() { 0 } else { o.font_file_count };
    let positive = |v: f64, default: f64| if v.is_finite() && v > 0.0 { v } else { default };
    Settings {
        font_files: (0..count).filter_map(|i| string(*o.font_files.add(i))).map(PathBuf::from).collect(),
        system_fonts: o.system_fonts != 0,
        default_family: string(o.default_family),
        resources_dir: string(o.resources_dir).map(PathBuf::from),
        dpi: positive(o.dpi, 96.0).clamp(10.0, 4000.0),
        raster_pixels: o.raster_pixels.clamp(16, 16384),
        arc_tolerance: positive(o.arc_tolerance, 2f64.powi(-26)).max(1e-12),
        stroke_tolerance: positive(o.stroke_tolerance, 2f64.powi(-22)).max(1e-12),
        max_bytes: o.max_bytes,
        max_elements: o.max_elements,
        max_segments: o.max_segments,
        max_raster_bytes: o.max_raster_bytes,
        max_nesting: o.max_nesting.min(1000),
        time: Duration::from_millis(o.max_milliseconds as u64),
        threads: thread_count(o.threads),
        centre_lines: o.centre_lines,
    }
}

fn thread_count(wanted: u32) -> usize {
    match wanted {
        0 => std::thread::available_parallelism().map_or(1, |n| n.get()),
        n => n.min(MOST_THREADS) as usize,
    }
}

fn copy_text(text: &str, out: &mut [u8]) {
    let mut end = text.len().min(out.len() - 1);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    out[..end].copy_from_slice(&text.as_bytes()[..end]);
    out[end] = 0;
}

fn write_error(failure: &Failure, out: &mut Error) {
    out.code = failure.code as u32;
    copy_text(&failure.message, &mut out.message);
    copy_text(&failure.place, &mut out.place);
}

#[no_mangle]
pub extern "C" fn fetexc_svg_abi() -> u32 {
    ABI
}

/// # Safety
/// `data` points to `length` bytes (or is null with length 0), `options` to options, `error` to writable memory or null.
#[no_mangle]
pub unsafe extern "C" fn fetexc_svg_load(
    data: *const u8,
    length: usize,
    options: *const Options,
    error: *mut Error,
) -> *mut Document {
    let result = catch_unwind(AssertUnwindSafe(|| {
        crate::report::install_log_capture();
        let options = options.as_ref().ok_or_else(|| Failure::new(Code::Internal, "no options"))?;
        let settings = settings(options);
        if length as u64 > settings.max_bytes {
            return Err(Failure::new(Code::TooManyBytes, format!("longer than {} bytes", settings.max_bytes)));
        }
        let bytes = if data.is_null() { Vec::new() } else { std::slice::from_raw_parts(data, length).to_vec() };
        load_guarded(bytes, settings).map(Document::new)
    }));
    let result = result.unwrap_or_else(|_| Err(Failure::new(Code::Internal, "internal failure")));
    match result {
        Ok(document) => Box::into_raw(document),
        Err(failure) => {
            if let Some(out) = error.as_mut() {
                write_error(&failure, out);
            }
            std::ptr::null_mut()
        }
    }
}

/// # Safety
/// `document` is null or comes from `fetexc_svg_load` and has not been freed.
#[no_mangle]
pub unsafe extern "C" fn fetexc_svg_get(document: *const Document) -> *const View {
    document.as_ref().map_or(std::ptr::null(), |d| &d.view)
}

/// # Safety
/// `document` is null or comes from `fetexc_svg_load` and has not been freed.
#[no_mangle]
pub unsafe extern "C" fn fetexc_svg_free(document: *mut Document) {
    if !document.is_null() {
        let _ = catch_unwind(AssertUnwindSafe(|| drop(Box::from_raw(document))));
    }
}
