// SPDX-License-Identifier: GPL-3.0-or-later
//! SVG bytes to a drawing, in the order that keeps hostile input cheap: bytes, XML, references, then usvg.

use std::io::Read;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use usvg::fontdb;
use usvg::roxmltree::{self, Document, ParsingOptions};
use usvg::{ImageHrefResolver, ImageKind};

use crate::budget::{Budget, Code, Failure};
use crate::document::Drawing;
use crate::emit::{Emitter, Tolerances};
use crate::features::report_dropped;
use crate::names::Lines;
use crate::recover::Recovery;
use crate::references;
use crate::report::{Finding, Report};

#[derive(Clone, Debug)]
pub struct Settings {
    pub font_files: Vec<PathBuf>,
    pub system_fonts: bool,
    pub default_family: Option<String>,
    pub resources_dir: Option<PathBuf>,
    pub dpi: f64,
    pub raster_pixels: u32,
    pub arc_tolerance: f64,
    pub stroke_tolerance: f64,
    pub max_bytes: u64,
    pub max_elements: u64,
    pub max_segments: u64,
    pub max_raster_bytes: u64,
    pub max_nesting: u32,
    pub time: Duration,
    /// At least 1. Changes nothing but the time.
    pub threads: usize,
    /// As abi::Options has it.
    pub centre_lines: u32,
}

/// Images named by the drawing, as usvg asks for them.
#[derive(Default)]
struct Embedded {
    svgs: Vec<Arc<Vec<u8>>>,
    failure: Option<Failure>,
}

fn plain_text(data: &[u8], max_bytes: u64) -> Result<String, Failure> {
    let too_long = || Failure::new(Code::TooManyBytes, format!("longer than {max_bytes} bytes"));
    let mut bytes = Vec::new();
    if data.starts_with(&[0x1f, 0x8b]) {
        let mut decoder = flate2::read::GzDecoder::new(data).take(max_bytes + 1);
        decoder.read_to_end(&mut bytes).map_err(|_| Failure::new(Code::BadGzip, "not valid gzip data"))?;
    } else if data.len() as u64 <= max_bytes {
        bytes.extend_from_slice(data);
    } else {
        return Err(too_long());
    }
    if bytes.len() as u64 > max_bytes {
        return Err(too_long());
    }
    String::from_utf8(bytes).map_err(|_| Failure::new(Code::NotUtf8, "not UTF-8 text"))
}

fn parse_xml<'a>(text: &'a str, settings: &Settings) -> Result<Document<'a>, Failure> {
    // Texts and comments are nodes too: allow some for each element.
    let nodes_limit = u32::try_from(settings.max_elements.saturating_mul(4)).unwrap_or(u32::MAX);
    let options = ParsingOptions { allow_dtd: true, nodes_limit, ..ParsingOptions::default() };
    let doc = Document::parse_with_options(text, options).map_err(|e| match e {
        roxmltree::Error::NodesLimitReached => {
            Failure::new(Code::TooManyElements, format!("more than {} elements", settings.max_elements))
        }
        e => Failure::new(Code::Malformed, format!("not well-formed XML: {e}")),
    })?;
    if doc.root_element().tag_name().name() != "svg" {
        return Err(Failure::new(Code::Malformed, "the root element is not svg"));
    }
    Ok(doc)
}

fn check_references(doc: &Document, settings: &Settings) -> Result<(), Failure> {
    let limits = references::Limits { expanded_elements: settings.max_elements, nesting: settings.max_nesting };
    references::check(doc, &limits)
}

fn fonts(settings: &Settings) -> Result<fontdb::Database, Failure> {
    let mut db = fontdb::Database::new();
    for file in &settings.font_files {
        let bytes = std::fs::read(file).map_err(|e| Failure {
            code: Code::FontFile,
            message: format!("the font file can't be read: {e}"),
            place: file.display().to_string(),
        })?;
        let before = db.len();
        db.load_font_data(bytes);
        if db.len() == before {
            return Err(Failure {
                code: Code::FontFile,
                message: "the file holds no font".to_string(),
                place: file.display().to_string(),
            });
        }
    }
    if settings.system_fonts {
        db.load_system_fonts();
    }
    let first = db.faces().next().and_then(|f| f.families.first().map(|(name, _)| name.clone()));
    if let Some(family) = settings.default_family.clone().or(first.filter(|_| !settings.font_files.is_empty())) {
        db.set_serif_family(family.clone());
        db.set_sans_serif_family(family.clone());
        db.set_cursive_family(family.clone());
        db.set_fantasy_family(family.clone());
        db.set_monospace_family(family);
    }
    Ok(db)
}

/// SVG images inside the SVG are checked like the file itself before usvg sees them, and remembered for their geometry.
fn resolve_svg(data: Arc<Vec<u8>>, settings: &Settings, embedded: &Mutex<Embedded>) -> Option<Arc<Vec<u8>>> {
    let checked = plain_text(&data, settings.max_bytes)
        .and_then(|text| parse_xml(&text, settings).and_then(|doc| check_references(&doc, settings)));
    let mut embedded = embedded.lock().ok()?;
    match checked {
        Ok(()) => {
            embedded.svgs.push(data.clone());
            Some(data)
        }
        Err(failure) => {
            if !matches!(failure.code, Code::Malformed | Code::NotUtf8 | Code::BadGzip) {
                embedded.failure = Some(failure);
            }
            None
        }
    }
}

/// A file next to the drawing, if the caller allows a folder and the file lies inside it.
fn read_resource(href: &str, settings: &Settings) -> Option<Vec<u8>> {
    let dir = settings.resources_dir.as_ref()?.canonicalize().ok()?;
    let path = dir.join(href).canonicalize().ok().filter(|p| p.starts_with(&dir))?;
    let length = std::fs::metadata(&path).ok()?.len();
    if length > settings.max_bytes {
        return None;
    }
    std::fs::read(path).ok()
}

fn looks_like_svg(data: &[u8]) -> bool {
    data.starts_with(&[0x1f, 0x8b]) || std::str::from_utf8(data).is_ok_and(|t| t.contains("<svg"))
}

fn image_resolver<'a>(settings: &'a Settings, embedded: &'a Mutex<Embedded>) -> ImageHrefResolver<'a> {
    let by_mime = ImageHrefResolver::default_data_resolver();
    let by_content = ImageHrefResolver::default_data_resolver();
    ImageHrefResolver {
        resolve_data: Box::new(move |mime, data, options| {
            if mime == "image/svg+xml" || (mime == "text/plain" && looks_like_svg(&data)) {
                return by_mime("image/svg+xml", resolve_svg(data, settings, embedded)?, options);
            }
            by_mime(mime, data, options)
        }),
        resolve_string: Box::new(move |href, options| -> Option<ImageKind> {
            let Some(data) = read_resource(href, settings) else {
                log::warn!("the image '{}' is not read", crate::names::shorten(href));
                return None;
            };
            if looks_like_svg(&data) {
                return by_content("image/svg+xml", resolve_svg(Arc::new(data), settings, embedded)?, options);
            }
            by_content("text/plain", Arc::new(data), options)
        }),
    }
}

fn usvg_failure(e: usvg::Error) -> Failure {
    let code = match e {
        usvg::Error::NotAnUtf8Str => Code::NotUtf8,
        usvg::Error::MalformedGZip => Code::BadGzip,
        usvg::Error::InvalidSize => Code::NoSize,
        usvg::Error::ElementsLimitReached => Code::TooManyElements,
        usvg::Error::ParsingFailed(roxmltree::Error::NodesLimitReached) => Code::TooManyElements,
        _ => Code::Malformed,
    };
    Failure::new(code, e.to_string())
}

/// The tree, and the SVG images inside it.
type Converted = (usvg::Tree, Vec<Arc<Vec<u8>>>);

fn convert(doc: &Document, settings: &Settings, fontdb: fontdb::Database) -> Result<Converted, Failure> {
    let embedded = Mutex::new(Embedded::default());
    let tree = {
        let options = usvg::Options {
            dpi: settings.dpi as f32,
            font_family: settings.default_family.clone().unwrap_or_else(|| "Times New Roman".to_string()),
            image_href_resolver: image_resolver(settings, &embedded),
            fontdb: Arc::new(fontdb),
            ..usvg::Options::default()
        };
        usvg::Tree::from_xmltree(doc, &options).map_err(usvg_failure)?
    };
    let embedded = embedded.into_inner().map_err(|_| Failure::new(Code::Internal, "poisoned lock"))?;
    match embedded.failure {
        Some(failure) => Err(failure),
        None => Ok((tree, embedded.svgs)),
    }
}

/// Everything, on the calling thread. May take long in usvg or resvg: worker.rs watches the clock.
pub fn load(data: &[u8], settings: &Settings) -> Result<Drawing, Failure> {
    let mut budget = Budget::new(settings.max_segments, settings.time);
    let text = plain_text(data, settings.max_bytes)?;
    let doc = parse_xml(&text, settings)?;
    check_references(&doc, settings)?;
    let fontdb = fonts(settings)?;
    let lines = Lines::new(&text);
    let mut report = Report::new(fontdb.is_empty());
    report_dropped(&doc, &lines, &mut report);
    let (mut recovery, converted) = Recovery::beside(&doc, &lines, settings, || convert(&doc, settings, fontdb))?;
    let (tree, svgs) = converted?;
    budget.check_time()?;
    for svg in svgs {
        let text = plain_text(&svg, settings.max_bytes)?;
        recovery.add(&parse_xml(&text, settings)?, &Lines::new(&text), settings)?;
    }
    report.take_log();
    let side = tree.size().width().max(tree.size().height()) as f64;
    let tolerances = Tolerances { arc: settings.arc_tolerance * side, stroke: settings.stroke_tolerance * side };
    let mut emitter = Emitter::new(recovery, report, &mut budget, tolerances);
    emitter.raster_scale = settings.raster_pixels as f64 / side;
    emitter.centre_lines = settings.centre_lines;
    emitter.threads = if settings.centre_lines != 0 { 1 } else { settings.threads };
    emitter.raster_bytes_left = settings.max_raster_bytes;
    emitter.picture(&tree)?;
    finish(emitter)
}

fn finish(mut emitter: Emitter) -> Result<Drawing, Failure> {
    emitter.report.take_log();
    let mut drawing = std::mem::take(&mut emitter.out);
    let most = u32::MAX as usize;
    if drawing.nodes.len().max(drawing.segments.len()).max(drawing.shapes.len()) >= most {
        return Err(Failure::new(Code::TooManySegments, "more objects than can be numbered"));
    }
    drawing.paths_recovered = emitter.recovery.recovered as u64;
    drawing.paths_kept_f32 = emitter.recovery.kept_f32 as u64;
    drawing.findings = std::mem::take(&mut emitter.report).finish();
    Ok(drawing)
}

/// True for findings that only explain how something is represented.
pub fn is_note(code: u32) -> bool {
    code >= Finding::FilterRasterised as u32
}
