// SPDX-License-Identifier: GPL-3.0-or-later
//! One shape converted twice at once: exactly as usvg does (f32, arcs flattened to 0.1 unit), which gives a fingerprint,
//! and in f64 with arcs kept. A usvg path whose points equal a fingerprint takes the exact geometry.

use std::collections::hash_map::DefaultHasher;
use std::hash::Hasher;

use kurbo::{CubicBez, Point, QuadBez, SvgArc};
use svgtypes::{PathParser, PathSegment, SimplePathSegment, SimplifyingPathParser};
use usvg::tiny_skia_path::{self, PathBuilder, PathSegment as SkiaSegment, PathVerb};

use crate::geom::{Arc, Path, Seg, Subpath};

/// usvg flattens arcs with this tolerance (user units); the fingerprint has to do the same.
const USVG_ARC_TOLERANCE: f64 = 0.1;

/// Counting the cubics of an arc stops here; no budget allows as many.
const MOST_CUBICS: usize = 1 << 24;

#[derive(Default)]
pub struct ExactBuilder {
    path: Path,
    cur: Point,
    start: Point,
    drawing: bool,
}

impl ExactBuilder {
    pub fn move_to(&mut self, p: Point) {
        (self.cur, self.start, self.drawing) = (p, p, false);
    }
    fn open(&mut self) -> &mut Subpath {
        if !self.drawing {
            self.path.push(Subpath { start: self.start, ..Subpath::default() });
            self.cur = self.start;
            self.drawing = true;
        }
        self.path.last_mut().expect("just opened")
    }
    fn push(&mut self, make: impl FnOnce(Point) -> Seg) {
        self.open();
        let seg = make(self.cur);
        self.cur = seg.end();
        self.open().segs.push(seg);
    }
    pub fn line_to(&mut self, p: Point) {
        self.push(|a| Seg::Line(a, p));
    }
    pub fn quad_to(&mut self, p1: Point, p2: Point) {
        self.push(|a| Seg::Quad(QuadBez::new(a, p1, p2)));
    }
    pub fn cubic_to(&mut self, p1: Point, p2: Point, p3: Point) {
        self.push(|a| Seg::Cubic(CubicBez::new(a, p1, p2, p3)));
    }
    pub fn arc_to(&mut self, arc: &kurbo::Arc, end: Point) {
        let (s, c) = arc.x_rotation.sin_cos();
        let (u, v) = (arc.radii.x * kurbo::Vec2::new(c, s), arc.radii.y * kurbo::Vec2::new(-s, c));
        self.push(|start| {
            Seg::Arc(Arc { centre: arc.center, u, v, t0: arc.start_angle, sweep: arc.sweep_angle, start, end })
        });
    }
    pub fn close(&mut self) {
        let start = self.start;
        if self.open().segs.is_empty() || self.cur != start {
            self.push(|a| Seg::Line(a, start));
        }
        self.open().closed = true;
        self.drawing = false;
        self.cur = start;
    }
    pub fn finish(self) -> Path {
        self.path
    }
}

/// The usvg path and the exact one, built side by side.
#[derive(Default)]
pub struct Twin {
    pub f32_path: PathBuilder,
    pub exact: ExactBuilder,
}

pub fn fingerprint(path: &tiny_skia_path::Path) -> u64 {
    let code = |verb: &PathVerb| match verb {
        PathVerb::Move => 1u64,
        PathVerb::Line => 2,
        PathVerb::Quad => 3,
        PathVerb::Cubic => 4,
        PathVerb::Close => 5,
    };
    let mut hasher = DefaultHasher::new();
    for verbs in path.verbs().chunks(16) {
        hasher.write_u64(verbs.iter().fold(0, |packed, verb| packed << 4 | code(verb)));
    }
    for p in path.points() {
        hasher.write_u64((p.x.to_bits() as u64) << 32 | p.y.to_bits() as u64);
    }
    hasher.finish()
}

/// A usvg path as it is, for shapes that no fingerprint explains (text, units that depend on context).
pub fn from_usvg(path: &tiny_skia_path::Path) -> Path {
    let at = |p: tiny_skia_path::Point| Point::new(p.x as f64, p.y as f64);
    let mut out = ExactBuilder::default();
    for segment in path.segments() {
        match segment {
            SkiaSegment::MoveTo(p) => out.move_to(at(p)),
            SkiaSegment::LineTo(p) => out.line_to(at(p)),
            SkiaSegment::QuadTo(a, p) => out.quad_to(at(a), at(p)),
            SkiaSegment::CubicTo(a, b, p) => out.cubic_to(at(a), at(b), at(p)),
            SkiaSegment::Close => out.close(),
        }
    }
    out.finish()
}

fn svg_arc(
    from: Point,
    to: Point,
    radii: (f64, f64),
    rotation: f64,
    large_arc: bool,
    sweep: bool,
) -> Option<kurbo::Arc> {
    let x_rotation = rotation.to_radians();
    kurbo::Arc::from_svg_arc(&SvgArc { from, to, radii: radii.into(), x_rotation, large_arc, sweep })
}

impl Twin {
    pub fn move_to(&mut self, p: Point) {
        self.f32_path.move_to(p.x as f32, p.y as f32);
        self.exact.move_to(p);
    }
    pub fn line_to(&mut self, p: Point) {
        self.f32_path.line_to(p.x as f32, p.y as f32);
        self.exact.line_to(p);
    }
    pub fn close(&mut self) {
        self.f32_path.close();
        self.exact.close();
    }
    /// Clockwise quarter of an axis-parallel ellipse, as usvg draws circles, ellipses and rounded corners: its end point
    /// in both precisions, because usvg computes it in f32.
    pub fn quarter_to(&mut self, rx: (f32, f64), ry: (f32, f64), to32: (f32, f32), from: Point, to: Point) {
        if let Some(prev) = self.f32_path.last_point() {
            let from32 = Point::new(prev.x as f64, prev.y as f64);
            let end32 = Point::new(to32.0 as f64, to32.1 as f64);
            match svg_arc(from32, end32, (rx.0 as f64, ry.0 as f64), 0.0, false, true) {
                Some(arc) => arc.to_cubic_beziers(USVG_ARC_TOLERANCE, |a, b, p| self.f32_cubic(a, b, p)),
                None => self.f32_path.line_to(to32.0, to32.1),
            }
        }
        match svg_arc(from, to, (rx.1, ry.1), 0.0, false, true) {
            Some(arc) => self.exact.arc_to(&arc, to),
            None => self.exact.line_to(to),
        }
    }
    fn f32_cubic(&mut self, a: Point, b: Point, p: Point) {
        self.f32_path.cubic_to(a.x as f32, a.y as f32, b.x as f32, b.y as f32, p.x as f32, p.y as f32);
    }
    fn simple(&mut self, segment: &SimplePathSegment, skip_exact: bool) -> Point {
        match *segment {
            SimplePathSegment::MoveTo { x, y } => {
                self.move_to(Point::new(x, y));
                Point::new(x, y)
            }
            SimplePathSegment::LineTo { x, y } => {
                self.line_to(Point::new(x, y));
                Point::new(x, y)
            }
            SimplePathSegment::Quadratic { x1, y1, x, y } => {
                self.f32_path.quad_to(x1 as f32, y1 as f32, x as f32, y as f32);
                self.exact.quad_to(Point::new(x1, y1), Point::new(x, y));
                Point::new(x, y)
            }
            SimplePathSegment::CurveTo { x1, y1, x2, y2, x, y } => {
                let (a, b, p) = (Point::new(x1, y1), Point::new(x2, y2), Point::new(x, y));
                self.f32_cubic(a, b, p);
                if !skip_exact {
                    self.exact.cubic_to(a, b, p);
                }
                p
            }
            SimplePathSegment::ClosePath => {
                self.close();
                self.exact.start
            }
        }
    }
}

/// Number of cubics usvg (kurbo) cuts a full turn of this radius into.
pub fn usvg_cubics(radius: f64) -> f64 {
    (1.1163 * radius / USVG_ARC_TOLERANCE).powf(1.0 / 6.0)
}

/// svgtypes hands out the cubics of an arc from the front of a vector: quadratic in their number, which only absurd radii
/// (beyond 1e18) make large. Charged as such, before usvg does it.
fn arc_cost(count: usize) -> usize {
    count.saturating_add(count.saturating_mul(count) / 256)
}

/// How many simplified segments a raw one becomes, and the arc if it is one.
fn expansion(raw: &PathSegment, cur: Point, after_close: bool) -> (usize, Option<(kurbo::Arc, Point)>) {
    let implied_move = after_close && !matches!(raw, PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. });
    let extra = implied_move as usize;
    let PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } = *raw else {
        return (1 + extra, None);
    };
    let to = if abs { Point::new(x, y) } else { Point::new(x + cur.x, y + cur.y) };
    match svg_arc(cur, to, (rx, ry), x_axis_rotation, large_arc, sweep) {
        Some(arc) => {
            let n = arc.append_iter(USVG_ARC_TOLERANCE).take(MOST_CUBICS).count();
            (n + extra, Some((arc, to)))
        }
        None => (1 + extra, None),
    }
}

/// Whether path data has an arc; not asked of every byte in turn, so that the compiler can take many at once.
pub fn may_hold_arcs(d: &str) -> bool {
    d.as_bytes().chunks(64).any(|part| part.iter().fold(false, |found, b| found | (b | 0x20 == b'a')))
}

/// The `d` attribute. `budget` is the number of segments left; None when it runs out.
pub fn path_data(d: &str, budget: &mut usize) -> Option<Twin> {
    if may_hold_arcs(d) {
        return data_with_arcs(d, budget);
    }
    let mut twin = Twin::default();
    for segment in SimplifyingPathParser::from(d).map_while(Result::ok) {
        *budget = budget.checked_sub(1)?;
        twin.simple(&segment, false);
    }
    Some(twin)
}

/// Parsed raw and simplified in step: the simplified stream is what usvg sees, the raw one still knows the arcs.
fn data_with_arcs(d: &str, budget: &mut usize) -> Option<Twin> {
    let mut twin = Twin::default();
    let mut simple = SimplifyingPathParser::from(d);
    let (mut cur, mut after_close) = (Point::ZERO, false);
    for raw in PathParser::from(d) {
        let Ok(raw) = raw else { break };
        let closes = matches!(raw, PathSegment::ClosePath { .. });
        if closes && after_close {
            continue; // svgtypes drops repeated closes
        }
        let (count, arc) = expansion(&raw, cur, after_close);
        *budget = budget.checked_sub(arc_cost(count))?;
        for _ in 0..count {
            let Some(Ok(segment)) = simple.next() else { return Some(twin) };
            let flattened = arc.is_some() && matches!(segment, SimplePathSegment::CurveTo { .. });
            cur = twin.simple(&segment, flattened);
        }
        if let Some((arc, to)) = arc {
            if count > 0 {
                twin.exact.arc_to(&arc, to);
                cur = to;
            }
        }
        after_close = closes;
    }
    Some(twin)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(d: &str) -> Path {
        path_data(d, &mut 1000).unwrap().exact.finish()
    }

    #[test]
    fn keeps_arcs_and_relative_positions() {
        let path = exact("M10 10a5 5 0 0 1 10 0l5 5z m1 1 h3");
        assert_eq!(path.len(), 2);
        assert!(matches!(path[0].segs[0], Seg::Arc(_)));
        assert_eq!(path[0].segs.len(), 3);
        assert!(path[0].closed && !path[1].closed);
        assert_eq!(path[1].start, Point::new(11.0, 11.0));
    }

    #[test]
    fn zero_length_subpath_survives() {
        assert_eq!(exact("M5 5z").len(), 1);
        assert_eq!(exact("M5 5l0 0").len(), 1);
        assert_eq!(exact("M5 5").len(), 0);
    }

    #[test]
    fn data_without_arcs_needs_no_second_parser() {
        let table = [
            "M1 2l3 4h5v-6H1V2C1 2 3 4 5 6s1 2 3 4S9 8 7 6Q1 2 3 4t5 6T7 8z",
            "M1 1L2 2zl3 3zzm1 1l2 2zM5 5zh1",
            "m1,1 2,2 3,3z 4 4",
            "M1 1L2 2 L3",
            "L1 1",
            "M1 1L2 2zL3 x",
            "",
        ];
        for d in table {
            let (mut left, mut left_in_step) = (100, 100);
            let (one, two) = (path_data(d, &mut left).unwrap(), data_with_arcs(d, &mut left_in_step).unwrap());
            assert_eq!(left, left_in_step, "{d}");
            assert_eq!(format!("{:?}", one.exact.finish()), format!("{:?}", two.exact.finish()), "{d}");
            assert_eq!(
                one.f32_path.finish().as_ref().map(fingerprint),
                two.f32_path.finish().as_ref().map(fingerprint)
            );
        }
    }

    #[test]
    fn budget_runs_out() {
        assert!(path_data("M0 0L1 1L2 2L3 3", &mut 3).is_none());
    }
}
