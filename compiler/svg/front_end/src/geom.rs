// SPDX-License-Identifier: GPL-3.0-or-later
//! Paths in f64 with true arcs, and their conversion to Bezier segments.

use kurbo::{Affine, CubicBez, Point, QuadBez, Vec2};

/// P(t) = centre + u cos t + v sin t for t from `t0` to `t0 + sweep`. Affine maps keep this form, so an arc stays exact
/// until it becomes cubics at the very end.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub centre: Point,
    pub u: Vec2,
    pub v: Vec2,
    pub t0: f64,
    pub sweep: f64,
    pub start: Point,
    pub end: Point,
}

/// 2^-36: relative accuracy that is enough however large an arc is.
const FINEST: f64 = 1.0 / (1u64 << 36) as f64;

/// One piece of a path.
#[derive(Clone, Copy, Debug)]
pub enum Seg {
    Line(Point, Point),
    Quad(QuadBez),
    Cubic(CubicBez),
    Arc(Arc),
}

/// A run of segments that share end points. `closed` subpaths end where they start (a line is already there if needed).
#[derive(Clone, Debug, Default)]
pub struct Subpath {
    pub start: Point,
    pub segs: Vec<Seg>,
    pub closed: bool,
}

pub type Path = Vec<Subpath>;

/// A Bezier segment as the ABI hands it out; `p[0..=degree]` are used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier {
    pub degree: u32,
    pub p: [Point; 4],
}

pub type Contour = Vec<Bezier>;

impl Bezier {
    pub fn line(a: Point, b: Point) -> Self {
        Bezier { degree: 1, p: [a, b, b, b] }
    }
    pub fn quad(q: QuadBez) -> Self {
        Bezier { degree: 2, p: [q.p0, q.p1, q.p2, q.p2] }
    }
    pub fn cubic(c: CubicBez) -> Self {
        Bezier { degree: 3, p: [c.p0, c.p1, c.p2, c.p3] }
    }
    pub fn end(&self) -> Point {
        self.p[self.degree as usize]
    }
    pub fn is_finite(&self) -> bool {
        self.p.iter().all(|p| p.is_finite())
    }
}

impl Arc {
    pub fn eval(&self, t: f64) -> Point {
        let (s, c) = t.sin_cos();
        self.centre + self.u * c + self.v * s
    }
    pub fn deriv(&self, t: f64) -> Vec2 {
        let (s, c) = t.sin_cos();
        self.v * c - self.u * s
    }
    pub fn transform(&self, m: &Affine) -> Arc {
        Arc {
            centre: *m * self.centre,
            u: linear(m, self.u),
            v: linear(m, self.v),
            t0: self.t0,
            sweep: self.sweep,
            start: *m * self.start,
            end: *m * self.end,
        }
    }
    /// Radius when the arc is circular to within rounding.
    pub fn radius_if_circle(&self) -> Option<f64> {
        let (lu, lv) = (self.u.hypot(), self.v.hypot());
        let circle = (lu - lv).abs() <= 1e-12 * lu && self.u.dot(self.v).abs() <= 1e-12 * lu * lv;
        circle.then_some(lu)
    }
    /// Cubics that stay within `tolerance` of the arc. Their number follows from the classic bound of the
    /// 4/3·tan(θ/4) construction, max radial error = (2/27)·sin⁶(θ/4)/cos²(θ/4) per unit radius.
    /// Beyond the canvas an arc gets no more than 36 bits relative to its own size.
    pub fn to_cubics(&self, tolerance: f64) -> Vec<CubicBez> {
        let radius = largest_stretch(self.u, self.v);
        let n = cubic_count(radius, self.sweep, tolerance.max(radius * FINEST));
        let step = self.sweep / n as f64;
        let arm = 4.0 / 3.0 * (0.25 * step).tan();
        let mut out = Vec::with_capacity(n);
        let mut p0 = self.start;
        for i in 0..n {
            let (a, b) = (self.t0 + i as f64 * step, self.t0 + (i + 1) as f64 * step);
            let p3 = if i + 1 == n { self.end } else { self.eval(b) };
            out.push(CubicBez::new(p0, p0 + self.deriv(a) * arm, p3 - self.deriv(b) * arm, p3));
            p0 = p3;
        }
        out
    }
}

/// Number of cubics for a sweep on an ellipse whose larger radius is `radius`.
pub fn cubic_count(radius: f64, sweep: f64, tolerance: f64) -> usize {
    const MOST: usize = 4096;
    let mut n = ((sweep.abs() / std::f64::consts::FRAC_PI_2).ceil() as usize).max(1);
    while n < MOST {
        let quarter = 0.25 * sweep.abs() / n as f64;
        let error = radius * (2.0 / 27.0) * quarter.sin().powi(6) / quarter.cos().powi(2);
        if error <= tolerance || !error.is_finite() {
            break;
        }
        n += 1;
    }
    n
}

/// The linear part of a map, applied to a vector.
pub fn linear(m: &Affine, v: Vec2) -> Vec2 {
    let c = m.as_coeffs();
    Vec2::new(c[0] * v.x + c[2] * v.y, c[1] * v.x + c[3] * v.y)
}

/// Larger singular value of the matrix with columns u, v.
pub fn largest_stretch(u: Vec2, v: Vec2) -> f64 {
    let (a, b) = (u.hypot2() + v.hypot2(), 2.0 * u.cross(v).abs());
    0.5 * ((a + b).sqrt() + (a - b).max(0.0).sqrt())
}

pub fn map_stretch(m: &Affine) -> f64 {
    let c = m.as_coeffs();
    largest_stretch(Vec2::new(c[0], c[1]), Vec2::new(c[2], c[3]))
}

pub fn map_is_finite(m: &Affine) -> bool {
    m.as_coeffs().iter().all(|c| c.is_finite())
}

impl Seg {
    pub fn start(&self) -> Point {
        match self {
            Seg::Line(a, _) => *a,
            Seg::Quad(q) => q.p0,
            Seg::Cubic(c) => c.p0,
            Seg::Arc(a) => a.start,
        }
    }
    pub fn end(&self) -> Point {
        match self {
            Seg::Line(_, b) => *b,
            Seg::Quad(q) => q.p2,
            Seg::Cubic(c) => c.p3,
            Seg::Arc(a) => a.end,
        }
    }
    pub fn transform(&self, m: &Affine) -> Seg {
        match self {
            Seg::Line(a, b) => Seg::Line(*m * *a, *m * *b),
            Seg::Quad(q) => Seg::Quad(*m * *q),
            Seg::Cubic(c) => Seg::Cubic(*m * *c),
            Seg::Arc(a) => Seg::Arc(a.transform(m)),
        }
    }
    pub fn append_beziers(&self, arc_tolerance: f64, out: &mut Contour) {
        match self {
            Seg::Line(a, b) => {
                if a != b {
                    out.push(Bezier::line(*a, *b))
                }
            }
            Seg::Quad(q) => out.push(Bezier::quad(*q)),
            Seg::Cubic(c) => out.push(Bezier::cubic(*c)),
            Seg::Arc(a) => out.extend(a.to_cubics(arc_tolerance).into_iter().map(Bezier::cubic)),
        }
    }
}

/// Closed contours of a filled path in the target space.
pub fn fill_contours(path: &Path, to_target: &Affine, arc_tolerance: f64) -> Vec<Contour> {
    let mut out = line_contours(path, to_target, arc_tolerance);
    out.iter_mut().for_each(close_contour);
    out
}

/// The same, open where the path is.
pub fn line_contours(path: &Path, to_target: &Affine, arc_tolerance: f64) -> Vec<Contour> {
    let mut out = Vec::with_capacity(path.len());
    for sub in path {
        let mut contour = Contour::with_capacity(sub.segs.len() + 1);
        for seg in &sub.segs {
            seg.transform(to_target).append_beziers(arc_tolerance, &mut contour);
        }
        if !contour.is_empty() {
            out.push(contour);
        }
    }
    out
}

/// Adds the closing line where the last point differs from the first.
pub fn close_contour(contour: &mut Contour) {
    if let (Some(first), Some(last)) = (contour.first(), contour.last()) {
        let (a, b) = (last.end(), first.p[0]);
        if a != b {
            contour.push(Bezier::line(a, b));
        }
    }
}

pub fn transform_contours(contours: &mut [Contour], m: &Affine) {
    for bezier in contours.iter_mut().flatten() {
        for p in &mut bezier.p {
            *p = *m * *p;
        }
    }
}

/// A rectangle mapped into the target space, as one contour.
pub fn rect_contour(x: f64, y: f64, w: f64, h: f64, m: &Affine) -> Contour {
    let p = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)].map(|q| *m * Point::from(q));
    (0..4).map(|i| Bezier::line(p[i], p[(i + 1) % 4])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn arc_cubics_stay_within_tolerance() {
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let (u, v) = (Vec2::new(3.0, 1.0), Vec2::new(-0.5, 1.5));
            let mut arc =
                Arc { centre: Point::ZERO, u, v, t0: 0.3, sweep: 1.7 * PI, start: Point::ZERO, end: Point::ZERO };
            arc.start = arc.eval(0.3);
            arc.end = arc.eval(0.3 + 1.7 * PI);
            let inverse = Affine::new([u.x, u.y, v.x, v.y, 0.0, 0.0]).inverse();
            for c in arc.to_cubics(tolerance) {
                for i in 0..=50 {
                    let p = kurbo::ParamCurve::eval(&c, i as f64 / 50.0);
                    let unit = (inverse * p).to_vec2().hypot();
                    assert!((unit - 1.0).abs() * largest_stretch(u, v) <= 1.01 * tolerance);
                }
            }
        }
    }

    #[test]
    fn cubic_count_grows_with_sixth_root() {
        assert_eq!(cubic_count(1.0, 2.0 * PI, 1.0), 4);
        let (a, b) = (cubic_count(1.0, 2.0 * PI, 1e-6), cubic_count(1.0, 2.0 * PI, 1e-9));
        assert!(b > 2 * a && b < 4 * a);
    }
}
