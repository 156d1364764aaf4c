// SPDX-License-Identifier: GPL-3.0-or-later
//! Exact geometry for what usvg stores in f32: shapes (with arcs), transforms, the canvas and its viewBox mapping.
//! Everything is looked up by the f32 value usvg computes, so a wrong guess can't change more than an f32 rounding.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Arc;

use kurbo::{Affine, Point};
use usvg::roxmltree::{Document, Node};
use usvg::tiny_skia_path;

use crate::budget::{Code, Failure};
use crate::css::own_property;
use crate::geom::Path;
use crate::load::Settings;
use crate::names::Lines;
use crate::parallel::try_map;
use crate::shapes::{most_segments, shape};
use crate::twin::{fingerprint, from_usvg};

/// Where a shape came from and what usvg forgets about it.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    pub name: String,
    id: String,
    pub non_scaling_stroke: bool,
    pub path_length: Option<f64>,
}

struct Known {
    origin: Arc<Origin>,
    path: Arc<Path>,
}

#[derive(Default)]
pub struct Recovery {
    shapes: HashMap<u64, Vec<Known>>,
    transforms: HashMap<[u32; 6], Affine>,
    root: Option<(f64, f64, Affine)>,
    /// Ids of masks whose luminance is computed in linearRGB.
    pub linear_masks: Vec<String>,
    pub recovered: usize,
    pub kept_f32: usize,
}

fn bits(t: usvg::Transform) -> [u32; 6] {
    // + 0.0 makes −0 and 0 one key.
    [t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(|v| (v + 0.0).to_bits())
}

fn narrow(m: &Affine) -> usvg::Transform {
    let c = m.as_coeffs().map(|v| v as f32);
    usvg::Transform::from_row(c[0], c[1], c[2], c[3], c[4], c[5])
}

pub fn widen(t: usvg::Transform) -> Affine {
    Affine::new([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(|v| v as f64))
}

fn parse_transform(text: &str) -> Option<Affine> {
    let t: svgtypes::Transform = text.parse().ok()?;
    Some(Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]))
}

/// Absolute lengths in user units; None for relative ones.
fn absolute(node: &Node, name: &str, dpi: f64) -> Option<f64> {
    use svgtypes::LengthUnit as Unit;
    let length: svgtypes::Length = node.attribute(name)?.parse().ok()?;
    let factor = match length.unit {
        Unit::None | Unit::Px => 1.0,
        Unit::In => dpi,
        Unit::Cm => dpi / 2.54,
        Unit::Mm => dpi / 25.4,
        Unit::Pt => dpi / 72.0,
        Unit::Pc => dpi / 6.0,
        _ => return None,
    };
    Some(length.number * factor)
}

/// viewBox and preserveAspectRatio as a map, in f64 (SVG 2 §8.2).
fn view_box_map(svg: &Node, width: f64, height: f64) -> Option<Affine> {
    let Some(text) = svg.attribute("viewBox") else { return Some(Affine::IDENTITY) };
    let vb: svgtypes::ViewBox = text.parse().ok()?;
    let aspect: svgtypes::AspectRatio =
        svg.attribute("preserveAspectRatio").and_then(|t| t.parse().ok()).unwrap_or_default();
    let (mut sx, mut sy) = (width / vb.w, height / vb.h);
    use svgtypes::Align::*;
    if aspect.align != None {
        let s = if aspect.slice { sx.max(sy) } else { sx.min(sy) };
        (sx, sy) = (s, s);
    }
    let (w, h) = (width - vb.w * sx, height - vb.h * sy);
    let fx = match aspect.align {
        None | XMinYMin | XMinYMid | XMinYMax => 0.0,
        XMidYMin | XMidYMid | XMidYMax => 0.5,
        _ => 1.0,
    };
    let fy = match aspect.align {
        None | XMinYMin | XMidYMin | XMaxYMin => 0.0,
        XMinYMid | XMidYMid | XMaxYMid => 0.5,
        _ => 1.0,
    };
    Some(Affine::new([sx, 0.0, 0.0, sy, -vb.x * sx + w * fx, -vb.y * sy + h * fy]))
}

/// Canvas size and root map: a missing side follows from the viewBox, as SVG says for width="100%".
fn root_frame(svg: &Node, dpi: f64) -> Option<(f64, f64, Affine)> {
    let vb: Option<svgtypes::ViewBox> = svg.attribute("viewBox").and_then(|t| t.parse().ok());
    let side = |name: &str, from_box: Option<f64>| match svg.attribute(name) {
        Some(_) => absolute(svg, name, dpi),
        Option::None => from_box,
    };
    let (w, h) = (side("width", vb.map(|v| v.w))?, side("height", vb.map(|v| v.h))?);
    Some((w, h, view_box_map(svg, w, h)?))
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-5 * scale
}

/// A shorter document is read before a thread has started.
const WORTH_THREADS: usize = 16 << 10;

impl Recovery {
    /// Of the drawing itself. `beside` (what usvg does) runs at the same time if no shape can exceed the limit of
    /// segments, else afterwards: usvg gets no shapes that are refused here.
    pub fn beside<R>(
        doc: &Document,
        lines: &Lines,
        settings: &Settings,
        beside: impl FnOnce() -> R,
    ) -> Result<(Self, R), Failure> {
        let mut out = Recovery { root: root_frame(&doc.root_element(), settings.dpi), ..Recovery::default() };
        let result = out.add_beside(doc, lines, settings, beside)?;
        Ok((out, result))
    }

    /// The same of an SVG image inside it.
    pub fn add(&mut self, doc: &Document, lines: &Lines, settings: &Settings) -> Result<(), Failure> {
        self.add_beside(doc, lines, settings, || ())
    }

    fn add_beside<R>(
        &mut self,
        doc: &Document,
        lines: &Lines,
        settings: &Settings,
        beside: impl FnOnce() -> R,
    ) -> Result<R, Failure> {
        let elements: Vec<Node> = doc.descendants().filter(Node::is_element).collect();
        for node in &elements {
            self.remember_transforms(node, settings.dpi);
            if node.tag_name().name() == "mask" {
                self.remember_mask(node);
            }
        }
        let source = Source { elements, lines, settings };
        let ahead = settings.threads > 1 && doc.input_text().len() >= WORTH_THREADS;
        let (shapes, result) = if ahead && source.surely_within_limit() {
            let (shapes, result) = source.shapes_on_threads(beside);
            (shapes.map_or_else(|| source.shapes_in_order(), Ok)?, result)
        } else {
            let shapes = ahead.then(|| source.shapes_on_threads(|| ()).0).flatten();
            (shapes.map_or_else(|| source.shapes_in_order(), Ok)?, beside())
        };
        for (fingerprint, known) in shapes {
            self.shapes.entry(fingerprint).or_default().push(known);
        }
        Ok(result)
    }

    fn remember_transforms(&mut self, node: &Node, dpi: f64) {
        for name in ["transform", "gradientTransform", "patternTransform"] {
            if let Some(m) = node.attribute(name).and_then(parse_transform) {
                self.transforms.entry(bits(narrow(&m))).or_insert(m);
            }
        }
        if node.tag_name().name() == "use" {
            let own = node.attribute("transform").and_then(parse_transform).unwrap_or(Affine::IDENTITY);
            let shift = |name| if node.attribute(name).is_some() { absolute(node, name, dpi) } else { Some(0.0) };
            if let (Some(x), Some(y)) = (shift("x"), shift("y")) {
                let key = narrow(&own).pre_concat(usvg::Transform::from_translate(x as f32, y as f32));
                self.transforms.entry(bits(key)).or_insert(own * Affine::translate((x, y)));
            }
        }
    }

    fn remember_mask(&mut self, node: &Node) {
        let value = node.ancestors().filter(Node::is_element).find_map(|n| own_property(&n, "color-interpolation"));
        if let (Some("linearRGB"), Some(id)) = (value.map(str::trim), node.attribute("id")) {
            self.linear_masks.push(id.to_string());
        }
    }

    pub fn transform(&self, t: usvg::Transform) -> Affine {
        self.transforms.get(&bits(t)).copied().unwrap_or_else(|| widen(t))
    }

    /// Canvas size, and the map of the group usvg wraps around everything when the viewBox is not the canvas.
    pub fn frame(&self, size: usvg::Size, wrapper: usvg::Transform) -> (f64, f64, Affine) {
        let (w32, h32, m32) = (size.width() as f64, size.height() as f64, widen(wrapper));
        if let Some((w, h, m)) = self.root {
            let scale = w32.max(h32);
            let mut pairs = m.as_coeffs().into_iter().zip(m32.as_coeffs());
            let same_map = pairs.all(|(a, b)| close(a, b, if b == 0.0 { scale } else { b.abs() }));
            if close(w, w32, scale) && close(h, h32, scale) && same_map {
                return (w, h, m);
            }
        }
        (w32, h32, self.transform(wrapper))
    }

    /// The exact path and where it came from. `id` chooses among shapes of equal geometry.
    pub fn find(&self, path: &tiny_skia_path::Path, id: &str) -> (Arc<Path>, Option<Arc<Origin>>) {
        match self.shapes.get(&fingerprint(path)).and_then(|known| best(known, id)) {
            Some(known) => (known.path.clone(), Some(known.origin.clone())),
            None => (Arc::new(from_usvg(path)), None),
        }
    }

    /// The same, counted.
    pub fn path(&mut self, path: &tiny_skia_path::Path, id: &str) -> (Arc<Path>, Option<Arc<Origin>>) {
        let found = self.find(path, id);
        match found.1 {
            Some(_) => self.recovered += 1,
            None => self.kept_f32 += 1,
        }
        found
    }

    /// Where it came from, only.
    pub fn origin(&self, path: &tiny_skia_path::Path, id: &str) -> Option<&Origin> {
        best(self.shapes.get(&fingerprint(path))?, id).map(|k| k.origin.as_ref())
    }
}

/// A document's elements and what is needed to read them.
struct Source<'a, 'i> {
    elements: Vec<Node<'a, 'i>>,
    lines: &'a Lines,
    settings: &'a Settings,
}

impl Source<'_, '_> {
    /// Told without parsing: a segment takes more than half a byte, where arcs don't multiply them.
    fn surely_within_limit(&self) -> bool {
        let mut left = self.limit();
        self.elements.iter().all(|node| {
            let Some(most) = most_segments(node, self.settings.dpi) else { return false };
            left = left.saturating_sub(most);
            left > 0
        })
    }

    fn limit(&self) -> usize {
        usize::try_from(self.settings.max_segments).unwrap_or(usize::MAX)
    }

    /// A shape and its fingerprint; None for other elements, and when the budget of segments runs out (then it is 0).
    fn shape(&self, node: &Node, budget: &mut usize) -> Option<(u64, Known)> {
        let twin = shape(node, self.settings.dpi, budget)?;
        let fingerprint = fingerprint(&twin.f32_path.finish()?);
        let origin = Arc::new(origin(node, self.lines));
        Some((fingerprint, Known { origin, path: Arc::new(twin.exact.finish()) }))
    }

    fn shapes_in_order(&self) -> Result<Vec<(u64, Known)>, Failure> {
        let mut budget = self.limit();
        let mut shapes = Vec::new();
        for node in &self.elements {
            shapes.extend(self.shape(node, &mut budget));
            if budget == 0 {
                let message = format!("more than {} path segments", self.settings.max_segments);
                return Err(Failure::new(Code::TooManySegments, message));
            }
        }
        Ok(shapes)
    }

    /// The same; None where that fails.
    fn shapes_on_threads<R>(&self, beside: impl FnOnce() -> R) -> (Option<Vec<(u64, Known)>>, R) {
        let left = AtomicUsize::new(self.limit());
        let work = |node: &Node| {
            let before = left.load(Ordering::Relaxed);
            let mut after = before;
            let shape = self.shape(node, &mut after);
            let cost = before - after;
            let take = |left: usize| left.checked_sub(cost).filter(|rest| *rest > 0);
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take).ok()?;
            Some(shape)
        };
        let (shapes, result) = try_map(&self.elements, self.settings.threads, work, beside);
        (shapes.map(|all| all.into_iter().flatten().collect()), result)
    }
}

fn best<'a>(known: &'a [Known], id: &str) -> Option<&'a Known> {
    known.iter().find(|k| !id.is_empty() && k.origin.id == id).or(known.first())
}

fn origin(node: &Node, lines: &Lines) -> Origin {
    Origin {
        name: lines.name(node),
        id: node.attribute("id").unwrap_or_default().to_string(),
        non_scaling_stroke: own_property(node, "vector-effect").map(str::trim) == Some("non-scaling-stroke"),
        path_length: node.attribute("pathLength").and_then(|t| t.trim().parse().ok()).filter(|l: &f64| *l > 0.0),
    }
}

/// Magnitude of the coordinates of a path: below about 1e-15 of it f64 has no digits left.
pub fn magnitude(path: &Path) -> f64 {
    let far = |p: Point| p.x.abs().max(p.y.abs());
    path.iter().flat_map(|s| s.segs.iter().map(|g| far(g.start()).max(far(g.end())))).fold(0.0, f64::max)
}
