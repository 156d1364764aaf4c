// SPDX-License-Identifier: GPL-3.0-or-later
//! Colours, gradients, and patterns as vector tiles.

use kurbo::{Affine, Point, Rect};
use usvg::{Group, Node, Pattern, SpreadMethod};

use crate::abi;
use crate::budget::Failure;
use crate::document::{stop, to_abi};
use crate::emit::{Emitter, EMPTY_GROUP};
use crate::geom::{map_is_finite, rect_contour, Contour};
use crate::report::Finding;

/// A pattern is drawn tile by tile, as vectors, up to this many tiles and segments; beyond, it becomes a raster layer.
const MOST_TILES: f64 = 1024.0;
const MOST_TILE_SEGMENTS: f64 = 100_000.0;

pub fn inverse(m: &Affine) -> Option<Affine> {
    let inverse = m.inverse();
    (m.determinant() != 0.0 && map_is_finite(m) && map_is_finite(&inverse)).then_some(inverse)
}

fn spread(method: SpreadMethod) -> u32 {
    match method {
        SpreadMethod::Pad => 0,
        SpreadMethod::Reflect => 1,
        SpreadMethod::Repeat => 2,
    }
}

pub fn bounds(contours: &[Contour]) -> Rect {
    let points = contours.iter().flatten().flat_map(|b| b.p);
    points.fold(Rect::new(f64::MAX, f64::MAX, f64::MIN, f64::MIN), |r, p| {
        Rect::new(r.x0.min(p.x), r.y0.min(p.y), r.x1.max(p.x), r.y1.max(p.y))
    })
}

impl Emitter<'_> {
    /// None: nothing is painted (SVG 2 §13.3: a paint server with a singular transform).
    pub fn paint(&mut self, paint: &usvg::Paint, opacity: f64, to_root: &Affine) -> Option<u32> {
        let (base, kind, v): (&usvg::BaseGradient, u32, [f64; 6]) = match paint {
            usvg::Paint::Color(c) => return Some(self.out.solid(*c, opacity)),
            usvg::Paint::Pattern(_) => return None,
            usvg::Paint::LinearGradient(g) => {
                (g, abi::LINEAR, [g.x1() as f64, g.y1() as f64, g.x2() as f64, g.y2() as f64, 0.0, 0.0])
            }
            usvg::Paint::RadialGradient(g) => {
                let (r, fr) = (g.r().get() as f64, g.fr().get() as f64);
                (g, abi::RADIAL, [g.cx() as f64, g.cy() as f64, r, g.fx() as f64, g.fy() as f64, fr])
            }
        };
        if !v.iter().all(|x| x.is_finite()) {
            self.report.add(Finding::BadGeometry, "a gradient overflows; nothing is painted with it", base.id());
            return None;
        }
        let to_paint = to_abi(&inverse(&(*to_root * self.recovery.transform(base.transform())))?);
        let stops: Vec<abi::Stop> = base
            .stops()
            .iter()
            .map(|s| stop(s.offset().get() as f64, s.color(), s.opacity().get() as f64 * opacity))
            .collect();
        let paint = abi::Paint { kind, spread: spread(base.spread_method()), v, to_paint, ..abi::Paint::default() };
        Some(self.out.paint(paint, &stops))
    }

    /// The shape clips as many copies of the tile as it touches.
    pub fn pattern(
        &mut self,
        contours: &[Contour],
        even_odd: bool,
        pattern: &Pattern,
        opacity: f64,
        to_root: &Affine,
        element: u32,
    ) -> Result<(), Failure> {
        let to_canvas = *to_root * self.recovery.transform(pattern.transform());
        let Some(to_pattern) = inverse(&to_canvas) else { return Ok(()) };
        let canvas = Rect::new(0.0, 0.0, self.out.width, self.out.height);
        let seen = bounds(contours).intersect(canvas);
        if !(seen.width() > 0.0 && seen.height() > 0.0) {
            return Ok(());
        }
        let tiles = tile_range(pattern, &to_pattern, seen);
        let count = (tiles.width() + 1.0) * (tiles.height() + 1.0);
        let shape = self.out.shape(contours, even_odd, element);
        if !(count <= MOST_TILES && count * segments_in(pattern.root()) <= MOST_TILE_SEGMENTS) {
            return self.pattern_layer(shape, seen, pattern, opacity, &to_canvas, element);
        }
        let clip = self.out.clip(&[abi::ClipMember { shape, clip: abi::NONE }], abi::NONE);
        let isolated = self.has_blend(pattern.root()) as u32;
        self.in_group(abi::Node { clip, opacity, isolated, ..EMPTY_GROUP }, |e| {
            for j in tiles.y0 as i64..=tiles.y1 as i64 {
                for i in tiles.x0 as i64..=tiles.x1 as i64 {
                    e.tile(pattern, i, j, &to_canvas, element)?;
                }
            }
            Ok(())
        })
    }

    fn tile(&mut self, pattern: &Pattern, i: i64, j: i64, to_canvas: &Affine, element: u32) -> Result<(), Failure> {
        let r = pattern.rect();
        let (w, h) = (r.width() as f64, r.height() as f64);
        let own = *to_canvas * Affine::translate((r.x() as f64 + i as f64 * w, r.y() as f64 + j as f64 * h));
        let b = pattern.root().stroke_bounding_box();
        let inside = b.left() >= 0.0 && b.top() >= 0.0 && b.right() <= r.width() && b.bottom() <= r.height();
        if inside {
            return self.children(pattern.root().children(), &own);
        }
        let shape = self.out.shape(&[rect_contour(0.0, 0.0, w, h, &own)], false, element);
        let clip = self.out.clip(&[abi::ClipMember { shape, clip: abi::NONE }], abi::NONE);
        self.in_group(abi::Node { clip, ..EMPTY_GROUP }, |e| e.children(pattern.root().children(), &own))
    }
}

/// Indices of the tiles that meet a canvas rectangle, as an inclusive range of whole numbers.
fn tile_range(pattern: &Pattern, to_pattern: &Affine, seen: Rect) -> Rect {
    let r = pattern.rect();
    let corners = [(seen.x0, seen.y0), (seen.x1, seen.y0), (seen.x1, seen.y1), (seen.x0, seen.y1)];
    let mut range = Rect::new(f64::MAX, f64::MAX, f64::MIN, f64::MIN);
    for p in corners.map(|c| *to_pattern * Point::from(c)) {
        let (i, j) = ((p.x - r.x() as f64) / r.width() as f64, (p.y - r.y() as f64) / r.height() as f64);
        range = Rect::new(range.x0.min(i), range.y0.min(j), range.x1.max(i), range.y1.max(j));
    }
    Rect::new(range.x0.floor(), range.y0.floor(), range.x1.floor(), range.y1.floor())
}

/// Rough size of what one tile draws.
fn segments_in(group: &Group) -> f64 {
    let of = |node: &Node| match node {
        Node::Group(g) => segments_in(g),
        Node::Path(p) => p.data().len() as f64,
        Node::Image(_) => 1000.0,
        Node::Text(t) => segments_in(t.flattened()),
    };
    1.0 + group.children().iter().map(of).sum::<f64>()
}
