// SPDX-License-Identifier: GPL-3.0-or-later
//! Basic shapes of the XML in both precisions (see twin.rs), following usvg's own construction point by point.

use kurbo::Point;
use usvg::roxmltree::Node;
use usvg::tiny_skia_path::Rect;

use crate::twin::{may_hold_arcs, path_data, usvg_cubics, Twin};

/// A length in user units: usvg's f32 arithmetic and the exact one. None where it depends on context (%, em, ex).
fn length(node: &Node, name: &str, dpi: f64) -> Option<Option<(f32, f64)>> {
    use svgtypes::LengthUnit as Unit;
    let Some(text) = node.attribute(name) else { return Some(None) };
    let length: svgtypes::Length = text.parse().ok()?;
    let (n, n32, dpi32) = (length.number, length.number as f32, dpi as f32);
    let pair = match length.unit {
        Unit::None | Unit::Px => (n32, n),
        Unit::In => (n32 * dpi32, n * dpi),
        Unit::Cm => (n32 * dpi32 / 2.54, n * dpi / 2.54),
        Unit::Mm => (n32 * dpi32 / 25.4, n * dpi / 25.4),
        Unit::Pt => (n32 * dpi32 / 72.0, n * dpi / 72.0),
        Unit::Pc => (n32 * dpi32 / 6.0, n * dpi / 6.0),
        _ => return None,
    };
    Some(Some(pair))
}

fn length_or_zero(node: &Node, name: &str, dpi: f64) -> Option<(f32, f64)> {
    Some(length(node, name, dpi)?.unwrap_or((0.0, 0.0)))
}

/// rx and ry as SVG resolves them: a negative or missing one takes the other's value.
fn radii(node: &Node, dpi: f64) -> Option<Option<[(f32, f64); 2]>> {
    let get = |name| Some(length(node, name, dpi)?.filter(|v| !v.1.is_sign_negative()));
    Some(match (get("rx")?, get("ry")?) {
        (Some(a), Some(b)) => Some([a, b]),
        (Some(a), None) | (None, Some(a)) => Some([a, a]),
        _ => None,
    })
}

fn ellipse(c: [(f32, f64); 2], r: [(f32, f64); 2]) -> Option<Twin> {
    let [(cx32, cx), (cy32, cy)] = c;
    let [(rx32, rx), (ry32, ry)] = r;
    if !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let p = [(cx + rx, cy), (cx, cy + ry), (cx - rx, cy), (cx, cy - ry)].map(Point::from);
    let q = [(cx32 + rx32, cy32), (cx32, cy32 + ry32), (cx32 - rx32, cy32), (cx32, cy32 - ry32)];
    let mut twin = Twin::default();
    twin.f32_path.move_to(q[0].0, q[0].1);
    twin.exact.move_to(p[0]);
    for i in 0..4 {
        twin.quarter_to(r[0], r[1], q[(i + 1) % 4], p[i], p[(i + 1) % 4]);
    }
    twin.close();
    Some(twin)
}

fn rect(node: &Node, dpi: f64) -> Option<Twin> {
    let get = |name| length_or_zero(node, name, dpi);
    let ((x32, x), (y32, y), (w32, w), (h32, h)) = (get("x")?, get("y")?, get("width")?, get("height")?);
    if !(w > 0.0 && h > 0.0) {
        return None;
    }
    let clamp = |r: (f32, f64), side: (f32, f64)| (r.0.min(side.0 / 2.0), r.1.min(side.1 / 2.0));
    let [rx, ry] = radii(node, dpi)?.unwrap_or_default();
    let (rx, ry) = (clamp(rx, (w32, w)), clamp(ry, (h32, h)));
    if rx.1 == 0.0 || ry.1 == 0.0 {
        return sharp_rect([x32, y32, w32, h32], [x, y, w, h], rx.1 == 0.0);
    }
    rounded_rect([x32, y32, w32, h32], [x, y, w, h], rx, ry)
}

fn sharp_rect(f: [f32; 4], d: [f64; 4], plain: bool) -> Option<Twin> {
    if !plain {
        return None; // usvg draws lines for arcs of height 0: rare, its own path is exact enough
    }
    let mut twin = Twin::default();
    twin.f32_path.push_rect(Rect::from_xywh(f[0], f[1], f[2], f[3])?);
    let [x, y, w, h] = d;
    twin.exact.move_to(Point::new(x, y));
    for p in [(x + w, y), (x + w, y + h), (x, y + h)] {
        twin.exact.line_to(p.into());
    }
    twin.exact.close();
    Some(twin)
}

fn rounded_rect(f: [f32; 4], d: [f64; 4], rx: (f32, f64), ry: (f32, f64)) -> Option<Twin> {
    let [x3, y3, w3, h3] = f;
    let [x, y, w, h] = d;
    let ((rx3, rxd), (ry3, ryd)) = (rx, ry);
    // Corner by corner: where its arc starts and ends.
    let from = [(x + w - rxd, y), (x + w, y + h - ryd), (x + rxd, y + h), (x, y + ryd)].map(Point::from);
    let to = [(x + w, y + ryd), (x + w - rxd, y + h), (x, y + h - ryd), (x + rxd, y)].map(Point::from);
    let from32 = [(x3 + w3 - rx3, y3), (x3 + w3, y3 + h3 - ry3), (x3 + rx3, y3 + h3), (x3, y3 + ry3)];
    let to32 = [(x3 + w3, y3 + ry3), (x3 + w3 - rx3, y3 + h3), (x3, y3 + h3 - ry3), (x3 + rx3, y3)];
    let mut twin = Twin::default();
    twin.f32_path.move_to(x3 + rx3, y3);
    twin.exact.move_to(to[3]);
    for i in 0..4 {
        twin.f32_path.line_to(from32[i].0, from32[i].1);
        twin.exact.line_to(from[i]);
        twin.quarter_to(rx, ry, to32[i], from[i], to[i]);
    }
    twin.close();
    Some(twin)
}

fn line(node: &Node, dpi: f64) -> Option<Twin> {
    let get = |name| length_or_zero(node, name, dpi);
    let ((x1f, x1), (y1f, y1), (x2f, x2), (y2f, y2)) = (get("x1")?, get("y1")?, get("x2")?, get("y2")?);
    let mut twin = Twin::default();
    twin.f32_path.move_to(x1f, y1f);
    twin.f32_path.line_to(x2f, y2f);
    twin.exact.move_to(Point::new(x1, y1));
    twin.exact.line_to(Point::new(x2, y2));
    Some(twin)
}

fn poly(node: &Node, closed: bool, budget: &mut usize) -> Option<Twin> {
    let mut twin = Twin::default();
    for (i, (x, y)) in svgtypes::PointsParser::from(node.attribute("points")?).enumerate() {
        *budget = budget.checked_sub(1)?;
        match i {
            0 => twin.move_to(Point::new(x, y)),
            _ => twin.line_to(Point::new(x, y)),
        }
    }
    if closed && !twin.f32_path.is_empty() {
        twin.close();
    }
    Some(twin)
}

/// Cubics of the arcs of a circle, ellipse or rounded rectangle.
fn charge_arcs(node: &Node, dpi: f64, budget: &mut usize) -> Option<()> {
    let radius = ["r", "rx", "ry"].into_iter().filter_map(|a| length(node, a, dpi).flatten()).map(|v| v.1.abs());
    let count = usvg_cubics(radius.fold(0.0, f64::max));
    *budget = budget.saturating_sub(count as usize + 4);
    (*budget > 0).then_some(())
}

/// At least what `shape` charges, without reading paths; None if only reading can tell.
pub fn most_segments(node: &Node, dpi: f64) -> Option<usize> {
    let by_length = |name| node.attribute(name).map_or(0, |text| 2 * text.len());
    match node.tag_name().name() {
        "path" if node.attribute("d").is_some_and(may_hold_arcs) => None,
        "path" => Some(by_length("d")),
        "polyline" | "polygon" => Some(by_length("points")),
        "circle" | "ellipse" | "rect" => {
            let mut left = usize::MAX;
            charge_arcs(node, dpi, &mut left).map(|()| usize::MAX - left)
        }
        _ => Some(0),
    }
}

/// Both versions of a shape element; None for other elements, invalid shapes, lengths that depend on context, or when
/// the budget of segments runs out (then it is 0).
pub fn shape(node: &Node, dpi: f64, budget: &mut usize) -> Option<Twin> {
    let get = |name| length_or_zero(node, name, dpi);
    Some(match node.tag_name().name() {
        "path" => {
            let twin = path_data(node.attribute("d")?, budget);
            if twin.is_none() {
                *budget = 0;
            }
            twin?
        }
        "polyline" => poly(node, false, budget)?,
        "polygon" => poly(node, true, budget)?,
        "line" => line(node, dpi)?,
        "circle" | "ellipse" | "rect" if charge_arcs(node, dpi, budget).is_none() => return None,
        "circle" => ellipse([get("cx")?, get("cy")?], [get("r")?; 2])?,
        "ellipse" => ellipse([get("cx")?, get("cy")?], radii(node, dpi)??)?,
        "rect" => rect(node, dpi)?,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use usvg::roxmltree::Document;

    #[test]
    fn most_segments_is_never_less_than_the_charge() {
        let table = [
            "<path d='M1 1zh1zh1zzv1z1 1h.1.1.1.1-1-1'/>",
            "<path d='M0 0l1 1 1 1-1-1.5.5.5.5c1 1 1 1 1 1 1 1 1 1 1 1s1 1 1 1t1 1 1 1q1 1 1 1zt1 1z'/>",
            "<path d='m1,1,1,1,1,1'/>",
            "<path d=''/>",
            "<path/>",
            "<polygon points='1 1 2,2-3-3.4.4'/>",
            "<polyline points='1 1'/>",
            "<circle r='1e30'/>",
            "<ellipse rx='1in' ry='2'/>",
            "<rect width='1' height='2' rx='7'/>",
            "<line x1='3'/>",
            "<g/>",
        ];
        for text in table {
            let doc = Document::parse(text).unwrap();
            let mut left = 1_000_000_000;
            shape(&doc.root_element(), 96.0, &mut left);
            assert!(most_segments(&doc.root_element(), 96.0).unwrap() >= 1_000_000_000 - left, "{text}");
        }
        let arcs = Document::parse("<path d='M1 1A1 1 0 0 1 1e30 1'/>").unwrap();
        assert_eq!(most_segments(&arcs.root_element(), 96.0), None);
    }
}
