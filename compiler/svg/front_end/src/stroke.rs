// SPDX-License-Identifier: GPL-3.0-or-later
//! Stroke outlines in f64. The outline of a run is the sum of positively oriented parts (bodies of the pieces, outer
//! wedges of the joins, caps), so nonzero winding gives their union; parts that lie inside one another do no harm.
//! Offsets of cubics come from kurbo; lines and circular arcs are offset exactly.

use kurbo::{BezPath, CubicBez, PathEl, Point, Vec2};

use crate::budget::{Budget, Failure};
use crate::dash::{dash, Run};
use crate::enclosing::enclosing_circle;
use crate::geom::{Arc, Bezier, Contour, Path, Seg};
use crate::piece::{pieces_of, turn_90, Piece};

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cap {
    Butt,
    Round,
    Square,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Join {
    Miter,
    MiterClip,
    Round,
    Bevel,
}

#[derive(Clone, Debug)]
pub struct Style {
    pub width: f64,
    pub miter_limit: f64,
    pub cap: Cap,
    pub join: Join,
    /// Empty, or an even number of lengths with a positive sum.
    pub dashes: Vec<f64>,
    pub dash_offset: f64,
}

/// Largest distance between the outline and the true one, in the units of the path.
pub struct Stroker<'a> {
    style: &'a Style,
    half: f64,
    tolerance: f64,
    contours: Vec<Contour>,
    /// True when a dash pattern was too fine and the subpath was drawn without dashes.
    pub dashes_dropped: bool,
}

/// One side of a run, in the direction of travel; side −1 lies at −normal, +1 at +normal.
#[derive(Default)]
pub struct Side {
    segs: Contour,
    cur: Point,
    /// The next line starts here, not at its own offset start (trimmed inner join).
    trim: Option<Point>,
    weld: f64,
}

impl Side {
    pub fn line_to(&mut self, p: Point) {
        if self.cur.distance(p) > self.weld {
            self.segs.push(Bezier::line(self.cur, p));
            self.cur = p;
        }
    }
    pub fn cubic(&mut self, mut c: CubicBez) {
        self.line_to(c.p0);
        let shift = self.cur - c.p0;
        (c.p0, c.p1) = (c.p0 + shift, c.p1 + shift);
        self.segs.push(Bezier::cubic(c));
        self.cur = c.p3;
    }
    pub fn arc(&mut self, arc: &Arc, tolerance: f64) {
        for c in arc.to_cubics(tolerance) {
            self.cubic(c);
        }
    }
    fn offset_line(&mut self, a: Point, b: Point) {
        let from = self.trim.take().unwrap_or(a);
        if self.segs.is_empty() {
            self.cur = from;
        }
        self.line_to(from);
        self.line_to(b);
    }
    /// The last line ends at `p` instead (before or beyond its own end).
    fn end_at(&mut self, p: Point) {
        if let Some(last) = self.segs.last_mut() {
            *last = Bezier::line(last.p[0], p);
        }
        self.cur = p;
    }
    /// The last line ends and the next one starts at `p`.
    fn trim_at(&mut self, p: Point) {
        self.end_at(p);
        self.trim = Some(p);
    }
    /// A miter: lines run on to its tip.
    fn corner(&mut self, tip: Point, after_line: bool, before_line: bool) {
        match after_line {
            true => self.end_at(tip),
            false => self.line_to(tip),
        }
        if before_line {
            self.trim = Some(tip);
        }
    }
    /// The same for the join that closes a run: the first line starts where the last one ends.
    fn trim_first(&mut self, p: Point) {
        if let Some(first) = self.segs.first_mut() {
            *first = Bezier::line(p, first.p[1]);
        }
        self.trim = None;
    }
}

pub fn reversed(contour: &[Bezier]) -> impl Iterator<Item = Bezier> + '_ {
    contour.iter().rev().map(|b| match b.degree {
        1 => Bezier::line(b.p[1], b.p[0]),
        _ => Bezier::cubic(CubicBez::new(b.p[3], b.p[2], b.p[1], b.p[0])),
    })
}

/// The two sides of a run while it grows.
pub struct Sides {
    pub side: [Side; 2],
}

impl Sides {
    fn new(p: Point, tangent: Vec2, half: f64, weld: f64) -> Self {
        let n = turn_90(tangent) * half;
        let make = |cur| Side { cur, weld, ..Side::default() };
        Sides { side: [make(p - n), make(p + n)] }
    }
}

impl<'a> Stroker<'a> {
    pub fn new(style: &'a Style, tolerance: f64) -> Self {
        Stroker { style, half: 0.5 * style.width, tolerance, contours: Vec::new(), dashes_dropped: false }
    }

    /// Closed contours whose nonzero union is the stroke of the path.
    pub fn outline(mut self, path: &Path, budget: &mut Budget) -> Result<(Vec<Contour>, bool), Failure> {
        let shortest = 0.01 * self.tolerance;
        for sub in path {
            budget.charge(sub.segs.len())?;
            let pieces = pieces_of(sub, shortest, self.tolerance);
            if pieces.is_empty() {
                if !sub.segs.is_empty() {
                    self.dot(sub.start, Vec2::new(1.0, 0.0));
                }
                continue;
            }
            for run in self.runs(pieces, sub.closed, budget)? {
                let before = self.contours.len();
                match run {
                    Run::Pieces { pieces, closed } => self.run(&pieces, closed),
                    Run::Dot { at, tangent } => self.dot(at, tangent),
                }
                budget.charge(self.contours[before..].iter().map(Vec::len).sum())?;
            }
        }
        Ok((self.contours, self.dashes_dropped))
    }

    fn runs(&mut self, pieces: Vec<Piece>, closed: bool, budget: &mut Budget) -> Result<Vec<Run>, Failure> {
        if self.style.dashes.is_empty() {
            return Ok(vec![Run::Pieces { pieces, closed }]);
        }
        let accuracy = 0.1 * self.tolerance;
        let dashed = dash(&pieces, closed, &self.style.dashes, self.style.dash_offset, accuracy, budget)?;
        Ok(dashed.unwrap_or_else(|| {
            self.dashes_dropped = true;
            vec![Run::Pieces { pieces, closed }]
        }))
    }

    fn run(&mut self, pieces: &[Piece], closed: bool) {
        if closed && self.whole_circle(pieces) {
            return;
        }
        let weld = 0.1 * self.tolerance;
        let mut sides = Sides::new(pieces[0].start(), pieces[0].tangents().0, self.half, weld);
        for (i, piece) in pieces.iter().enumerate() {
            if i > 0 {
                self.join(&pieces[i - 1], piece, &mut sides);
            }
            self.offset(piece, &mut sides);
        }
        if closed {
            self.close(pieces, sides);
        } else {
            self.finish_open(pieces, sides);
        }
    }

    fn finish_open(&mut self, pieces: &[Piece], sides: Sides) {
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        let [mut outline, back] = sides.side;
        self.cap(last.end(), last.tangents().1, &mut outline);
        outline.line_to(back.cur);
        for b in reversed(&back.segs) {
            outline.segs.push(b);
            outline.cur = b.end();
        }
        self.cap(first.start(), -first.tangents().0, &mut outline);
        self.push(outline.segs);
    }

    fn close(&mut self, pieces: &[Piece], mut sides: Sides) {
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        self.join(last, first, &mut sides);
        let n = turn_90(first.tangents().0) * self.half;
        for (side, sign) in sides.side.iter_mut().zip([-1.0, 1.0]) {
            match side.trim {
                Some(p) => side.trim_first(p),
                None => side.line_to(first.start() + n * sign),
            }
        }
        let [forward, back] = sides.side;
        self.push(forward.segs);
        self.push(reversed(&back.segs).collect());
        self.cover_core(pieces);
    }

    fn push(&mut self, mut contour: Contour) {
        if let (Some(start), Some(last)) = (contour.first().map(|b| b.p[0]), contour.last_mut()) {
            let k = last.degree as usize;
            if last.p[k].distance(start) <= 0.1 * self.tolerance {
                last.p[k] = start;
            }
        }
        crate::geom::close_contour(&mut contour);
        if contour.len() > 1 {
            self.contours.push(contour);
        }
    }

    /// Appends both offsets of a piece.
    fn offset(&self, piece: &Piece, sides: &mut Sides) {
        for (side, sign) in sides.side.iter_mut().zip([-1.0, 1.0]) {
            let d = sign * self.half;
            match piece {
                Piece::Line(a, b) => {
                    let n = turn_90(piece.tangents().0) * d;
                    side.offset_line(*a + n, *b + n);
                }
                Piece::Circle(a) => {
                    if let Some(arc) = offset_circle(a, d) {
                        side.arc(&arc, self.tolerance);
                    }
                }
                Piece::Cubic(c) => self.offset_cubic(c, d, side),
            }
        }
    }

    fn offset_cubic(&self, c: &CubicBez, d: f64, side: &mut Side) {
        let mut path = BezPath::new();
        kurbo::offset::offset_cubic(*c, d, self.tolerance, &mut path);
        let mut cur = side.cur;
        for el in path.elements() {
            match el {
                PathEl::MoveTo(p) => cur = *p,
                PathEl::CurveTo(p1, p2, p3) => {
                    if cur.distance(*p3) > side.weld || cur.distance(*p1) > side.weld {
                        side.cubic(CubicBez::new(cur, *p1, *p2, *p3));
                    }
                    cur = *p3;
                }
                _ => {}
            }
        }
    }

    /// A closed run that is one full circle: two circles, or one when the stroke covers the middle.
    fn whole_circle(&mut self, pieces: &[Piece]) -> bool {
        let mut total = 0.0;
        let mut first: Option<Arc> = None;
        for piece in pieces {
            let Piece::Circle(a) = piece else { return false };
            let c = *first.get_or_insert(*a);
            if c.centre.distance(a.centre) > self.tolerance || (c.u.hypot() - a.u.hypot()).abs() > self.tolerance {
                return false;
            }
            total += a.sweep;
        }
        if (total.abs() - std::f64::consts::TAU).abs() > 1e-9 {
            return false;
        }
        let Some(c) = first else { return false };
        let r = c.u.hypot();
        self.circle(c.centre, r + self.half, 1.0);
        if r > self.half + self.tolerance {
            self.circle(c.centre, r - self.half, -1.0);
        }
        true
    }

    fn circle(&mut self, centre: Point, r: f64, orientation: f64) {
        let (u, v) = (Vec2::new(r, 0.0), Vec2::new(0.0, r));
        let sweep = orientation * std::f64::consts::TAU;
        let arc = Arc { centre, u, v, t0: 0.0, sweep, start: centre + u, end: centre + u };
        let contour = arc.to_cubics(self.tolerance).into_iter().map(Bezier::cubic).collect();
        self.push(contour);
    }

    /// Caps of a subpath or dash of length zero (SVG 2 §13.5.4).
    fn dot(&mut self, at: Point, tangent: Vec2) {
        match self.style.cap {
            Cap::Butt => {}
            Cap::Round => self.circle(at, self.half, 1.0),
            Cap::Square => {
                let (t, n) = (tangent * self.half, turn_90(tangent) * self.half);
                let p = [at - t - n, at + t - n, at + t + n, at - t + n];
                self.push((0..4).map(|i| Bezier::line(p[i], p[(i + 1) % 4])).collect());
            }
        }
    }

    fn cap(&self, p: Point, tangent: Vec2, out: &mut Side) {
        let (t, n) = (tangent * self.half, turn_90(tangent) * self.half);
        match self.style.cap {
            Cap::Butt => {}
            Cap::Square => {
                out.line_to(p - n + t);
                out.line_to(p + n + t);
            }
            Cap::Round => {
                let arc =
                    Arc { centre: p, u: -n, v: t, t0: 0.0, sweep: std::f64::consts::PI, start: p - n, end: p + n };
                out.arc(&arc, self.tolerance);
            }
        }
        out.line_to(p + n);
    }

    /// The offset of a closed curve that fits into a circle of radius R < half folds over its middle, where winding
    /// would cancel. A point p of that middle has |p − q|² ≤ half² − R² (q: centre of that circle), and every such
    /// point lies within `half` of the curve: adding that disc makes the outline right and changes nothing else.
    fn cover_core(&mut self, pieces: &[Piece]) {
        if pieces.iter().all(|p| matches!(p, Piece::Line(..))) {
            return;
        }
        let samples: Vec<Point> = pieces.iter().flat_map(sample).collect();
        let Some((centre, radius)) = enclosing_circle(&samples, self.half) else { return };
        if radius < self.half {
            self.circle(centre, (self.half * self.half - radius * radius).sqrt(), 1.0);
        }
    }

    fn join(&self, before: &Piece, after: &Piece, sides: &mut Sides) {
        let (t1, t2) = (before.tangents().1, after.tangents().0);
        let (cross, dot) = (t1.cross(t2), t1.dot(t2));
        if dot > 0.0 && cross.abs() * self.half <= 0.1 * self.tolerance {
            return;
        }
        let p = after.start();
        let (outer, inner) = if cross >= 0.0 { (0, 1) } else { (1, 0) };
        let sign = if outer == 0 { -1.0 } else { 1.0 };
        let (o1, o2) = (turn_90(t1) * sign, turn_90(t2) * sign);
        let long = |piece: &Piece| matches!(piece, Piece::Line(a, b) if a.distance(*b) >= self.tolerance);
        self.outer_join(p, (t1, t2), (o1, o2), (long(before), long(after)), &mut sides.side[outer]);
        self.inner_join(p, before, after, o2, &mut sides.side[inner]);
    }

    /// `t`, `o`: tangents and outward normals before and after the vertex; `line`: whether the pieces are lines.
    fn outer_join(&self, p: Point, t: (Vec2, Vec2), o: (Vec2, Vec2), line: (bool, bool), side: &mut Side) {
        let (h, dot) = (self.half, o.0.dot(o.1));
        let limit = self.style.miter_limit;
        match self.style.join {
            Join::Round => {
                let sweep = o.0.cross(o.1).atan2(dot).abs();
                let arc =
                    Arc { centre: p, u: o.0 * h, v: t.0 * h, t0: 0.0, sweep, start: p + o.0 * h, end: p + o.1 * h };
                side.arc(&arc, self.tolerance);
            }
            Join::Miter | Join::MiterClip if limit * limit * (1.0 + dot) >= 2.0 => {
                side.corner(p + (o.0 + o.1) * (h / (1.0 + dot)), line.0, line.1);
                if line.1 {
                    return;
                }
            }
            Join::MiterClip => {
                let bisector = o.0 + o.1;
                let b = if bisector.hypot() > 1e-9 { bisector / bisector.hypot() } else { t.0 };
                let reach = (limit * h - h * o.0.dot(b)) / t.0.dot(b);
                if reach > 0.0 && reach.is_finite() {
                    side.line_to(p + o.0 * h + t.0 * reach);
                    side.line_to(p + o.1 * h - t.1 * reach);
                }
            }
            _ => {}
        }
        side.line_to(p + o.1 * h);
    }

    /// Inside of a turn. Two long enough lines meet in a point; otherwise the outline runs over the vertex itself, so
    /// that the parts of both pieces stay positively oriented.
    fn inner_join(&self, p: Point, before: &Piece, after: &Piece, o2: Vec2, side: &mut Side) {
        let (t1, t2) = (before.tangents().1, after.tangents().0);
        let eaten = self.half * t1.cross(t2).abs() / (1.0 + t1.dot(t2));
        let fits = |a: &Point, b: &Point| a.distance(*b) >= (2.0 * eaten).max(self.tolerance);
        let room = |piece: &Piece| matches!(piece, Piece::Line(a, b) if fits(a, b));
        if room(before) && room(after) && t1.dot(t2) > -0.99 {
            side.trim_at(p - o2 * self.half + t2 * eaten);
            return;
        }
        side.line_to(p);
        side.line_to(p - o2 * self.half);
    }
}

/// p + d·normal for a circular arc: a circle again, whose radius may be negative. None when it shrinks to its centre.
fn offset_circle(a: &Arc, d: f64) -> Option<Arc> {
    let r = a.u.hypot();
    let scale = (r - d * (a.sweep * a.u.cross(a.v)).signum()) / r;
    if scale.abs() < 1e-12 {
        return None;
    }
    let map = |p: Point| a.centre + (p - a.centre) * scale;
    Some(Arc { u: a.u * scale, v: a.v * scale, start: map(a.start), end: map(a.end), ..*a })
}

fn sample(piece: &Piece) -> Vec<Point> {
    const N: usize = 16;
    let seg = match piece {
        Piece::Line(a, b) => Seg::Line(*a, *b),
        Piece::Circle(a) => Seg::Arc(*a),
        Piece::Cubic(c) => Seg::Cubic(*c),
    };
    let at = |t: f64| match &seg {
        Seg::Line(a, b) => a.lerp(*b, t),
        Seg::Arc(a) => a.eval(a.t0 + a.sweep * t),
        Seg::Cubic(c) => kurbo::ParamCurve::eval(c, t),
        Seg::Quad(q) => kurbo::ParamCurve::eval(q, t),
    };
    (0..=N).map(|i| at(i as f64 / N as f64)).collect()
}
