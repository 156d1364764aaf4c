// SPDX-License-Identifier: GPL-3.0-or-later
//! What a stroke is made of: lines, circular arcs and true cubics, all of positive length.

use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, Point, Vec2};

use crate::geom::{Arc, Seg, Subpath};

#[derive(Clone, Copy, Debug)]
pub enum Piece {
    Line(Point, Point),
    /// Circular: its offset is an arc again, exactly.
    Circle(Arc),
    Cubic(CubicBez),
}

pub fn turn_90(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

fn unit(v: Vec2) -> Vec2 {
    let length = v.hypot();
    if length > 0.0 {
        v / length
    } else {
        Vec2::new(1.0, 0.0)
    }
}

impl Piece {
    pub fn start(&self) -> Point {
        match self {
            Piece::Line(a, _) => *a,
            Piece::Circle(a) => a.start,
            Piece::Cubic(c) => c.p0,
        }
    }
    pub fn end(&self) -> Point {
        match self {
            Piece::Line(_, b) => *b,
            Piece::Circle(a) => a.end,
            Piece::Cubic(c) => c.p3,
        }
    }
    /// Unit tangents at both ends.
    pub fn tangents(&self) -> (Vec2, Vec2) {
        match self {
            Piece::Line(a, b) => (unit(*b - *a), unit(*b - *a)),
            Piece::Circle(a) => {
                let s = a.sweep.signum();
                (unit(a.deriv(a.t0) * s), unit(a.deriv(a.t0 + a.sweep) * s))
            }
            Piece::Cubic(c) => {
                let first = |from: Point, to: [Point; 3]| {
                    let far = to.into_iter().find(|p| from.distance_squared(*p) > 1e-24 * to[2].distance_squared(from));
                    unit(far.unwrap_or(to[0]) - from)
                };
                (first(c.p0, [c.p1, c.p2, c.p3]), -first(c.p3, [c.p2, c.p1, c.p0]))
            }
        }
    }
    pub fn length(&self, accuracy: f64) -> f64 {
        match self {
            Piece::Line(a, b) => a.distance(*b),
            Piece::Circle(a) => a.u.hypot() * a.sweep.abs(),
            Piece::Cubic(c) => c.arclen(accuracy),
        }
    }
    /// The part between two arc lengths; `whole` is the length of the piece.
    pub fn part(&self, from: f64, to: f64, whole: f64, accuracy: f64) -> Piece {
        let (f0, f1) = (from / whole, to / whole);
        match self {
            Piece::Line(a, b) => Piece::Line(
                if from <= 0.0 { *a } else { a.lerp(*b, f0) },
                if to >= whole { *b } else { a.lerp(*b, f1) },
            ),
            Piece::Circle(a) => {
                let (t0, sweep) = (a.t0 + a.sweep * f0, a.sweep * (f1 - f0));
                let start = if from <= 0.0 { a.start } else { a.eval(t0) };
                let end = if to >= whole { a.end } else { a.eval(t0 + sweep) };
                Piece::Circle(Arc { t0, sweep, start, end, ..*a })
            }
            Piece::Cubic(c) => {
                let t0 = if from <= 0.0 { 0.0 } else { c.inv_arclen(from, accuracy) };
                let t1 = if to >= whole { 1.0 } else { c.inv_arclen(to, accuracy) };
                Piece::Cubic(c.subsegment(t0..t1.max(t0)))
            }
        }
    }
    /// Point and unit tangent at an arc length.
    pub fn at(&self, s: f64, whole: f64, accuracy: f64) -> (Point, Vec2) {
        match self {
            Piece::Line(a, b) => (a.lerp(*b, s / whole), self.tangents().0),
            Piece::Circle(a) => {
                let t = a.t0 + a.sweep * s / whole;
                (a.eval(t), unit(a.deriv(t) * a.sweep.signum()))
            }
            Piece::Cubic(c) => {
                let t = c.inv_arclen(s.clamp(0.0, whole), accuracy);
                (c.eval(t), unit(kurbo::ParamCurveDeriv::deriv(c).eval(t).to_vec2()))
            }
        }
    }
}

/// The pieces of a subpath; segments shorter than `shortest` vanish into their neighbours.
pub fn pieces_of(sub: &Subpath, shortest: f64, tolerance: f64) -> Vec<Piece> {
    let mut out = Vec::with_capacity(sub.segs.len());
    let mut cur = sub.start;
    for seg in &sub.segs {
        let before = out.len();
        append(seg, cur, shortest, tolerance, &mut out);
        if out.len() > before {
            cur = seg.end();
        }
    }
    out
}

fn append(seg: &Seg, cur: Point, shortest: f64, tolerance: f64, out: &mut Vec<Piece>) {
    match seg {
        Seg::Line(_, b) => push_line(cur, *b, shortest, out),
        Seg::Quad(q) => push_cubic(q.raise(), cur, shortest, tolerance, out),
        Seg::Cubic(c) => push_cubic(*c, cur, shortest, tolerance, out),
        Seg::Arc(a) if a.radius_if_circle().is_some() => {
            if a.u.hypot() * a.sweep.abs() > shortest {
                out.push(Piece::Circle(*a));
            }
        }
        Seg::Arc(a) => {
            let mut cur = cur;
            for c in a.to_cubics(0.25 * tolerance) {
                push_cubic(c, cur, shortest, tolerance, out);
                cur = c.p3;
            }
        }
    }
}

fn push_line(a: Point, b: Point, shortest: f64, out: &mut Vec<Piece>) {
    if a.distance(b) > shortest {
        out.push(Piece::Line(a, b));
    }
}

/// A cubic; one whose control points lie on a line becomes the lines it runs through.
fn push_cubic(mut c: CubicBez, cur: Point, shortest: f64, tolerance: f64, out: &mut Vec<Piece>) {
    c.p0 = cur;
    let far =
        [c.p1, c.p2, c.p3].into_iter().max_by(|a, b| cur.distance_squared(*a).total_cmp(&cur.distance_squared(*b)));
    let axis = far.map_or(Vec2::ZERO, |f| f - cur);
    if axis.hypot() <= shortest {
        return; // all control points together
    }
    let axis = unit(axis);
    let off = [c.p1, c.p2, c.p3].into_iter().map(|p| axis.cross(p - cur).abs()).fold(0.0, f64::max);
    if off > 0.01 * tolerance {
        out.push(Piece::Cubic(c));
        return;
    }
    let along = [c.p0, c.p1, c.p2, c.p3].map(|p| axis.dot(p - cur));
    let mut from = cur;
    for t in turning_points(along) {
        let p = c.eval(t);
        if from.distance(p) > shortest {
            out.push(Piece::Line(from, p));
            from = p;
        }
    }
    push_line(from, c.p3, shortest, out);
}

/// Parameters in (0,1), ascending, where a cubic on a line turns back.
fn turning_points(x: [f64; 4]) -> Vec<f64> {
    let d = [x[1] - x[0], x[2] - x[1], x[3] - x[2]];
    let roots = kurbo::common::solve_quadratic(d[0], 2.0 * (d[1] - d[0]), d[0] - 2.0 * d[1] + d[2]);
    let mut ts: Vec<f64> = roots.into_iter().filter(|t| *t > 0.0 && *t < 1.0).collect();
    ts.sort_by(f64::total_cmp);
    ts
}

pub fn path_length(path: &crate::geom::Path, tolerance: f64) -> f64 {
    let of = |sub: &Subpath| pieces_of(sub, 0.0, tolerance).iter().map(|p| p.length(tolerance)).sum::<f64>();
    path.iter().map(of).sum()
}
