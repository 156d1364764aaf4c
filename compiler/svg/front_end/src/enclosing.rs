// SPDX-License-Identifier: GPL-3.0-or-later
//! Smallest enclosing circle (Welzl's incremental algorithm, points visited in a fixed scrambled order).

use kurbo::Point;

type Circle = (Point, f64);

fn holds(circle: &Circle, p: Point) -> bool {
    circle.0.distance(p) <= circle.1 * (1.0 + 1e-12)
}

fn from_two(a: Point, b: Point) -> Circle {
    (a.midpoint(b), 0.5 * a.distance(b))
}

/// Circle through three points; the widest pair's circle when they lie on a line.
fn from_three(a: Point, b: Point, c: Point) -> Circle {
    let (u, v) = (b - a, c - a);
    let d = 2.0 * u.cross(v);
    let (uu, vv) = (u.hypot2(), v.hypot2());
    let offset = kurbo::Vec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / d;
    if !offset.is_finite() {
        let widest = [from_two(a, b), from_two(b, c), from_two(a, c)];
        return widest.into_iter().max_by(|x, y| x.1.total_cmp(&y.1)).unwrap_or((a, 0.0));
    }
    (a + offset, offset.hypot())
}

/// None when the points don't fit into a circle of radius `limit` (decided early by their box).
pub fn enclosing_circle(points: &[Point], limit: f64) -> Option<Circle> {
    let extent = |get: fn(&Point) -> f64| {
        let (lo, hi) =
            points.iter().map(get).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        hi - lo
    };
    if points.is_empty() || !(extent(|p| p.x).max(extent(|p| p.y)) < 2.0 * limit) {
        return None;
    }
    let n = points.len();
    let stride = (1..n).rev().find(|s| gcd(*s, n) == 1 && *s <= n * 5 / 8 + 1).unwrap_or(1);
    let p = |i: usize| points[i * stride % n];
    let mut circle = (p(0), 0.0);
    for i in 1..n {
        if holds(&circle, p(i)) {
            continue;
        }
        circle = (p(i), 0.0);
        for j in 0..i {
            if holds(&circle, p(j)) {
                continue;
            }
            circle = from_two(p(i), p(j));
            for k in 0..j {
                if !holds(&circle, p(k)) {
                    circle = from_three(p(i), p(j), p(k));
                }
            }
        }
    }
    (circle.1 < limit).then_some(circle)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 {
        a
    } else {
        gcd(b, a % b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_circle_of_an_ellipse() {
        let points: Vec<Point> = (0..64).map(|i| i as f64 * 0.1).map(|t| Point::new(3.0 * t.cos(), t.sin())).collect();
        let (c, r) = enclosing_circle(&points, 10.0).unwrap();
        assert!(c.distance(Point::ZERO) < 0.05 && (r - 3.0).abs() < 0.05, "{c:?} {r}");
        assert!(enclosing_circle(&points, 2.0).is_none());
    }
}
