// SPDX-License-Identifier: GPL-3.0-or-later
//! The stroke of one usvg path, outlined in canvas space.

use kurbo::Affine;

use crate::budget::{Budget, Failure};
use crate::geom::{map_stretch, transform_contours, Contour, Path, Subpath};
use crate::recover::{magnitude, Origin};
use crate::stroke::{Cap, Join, Stroker, Style};

#[derive(Default)]
pub struct Outline {
    pub contours: Vec<Contour>,
    /// A dash pattern was too fine; the stroke is solid.
    pub dashes_dropped: bool,
}

/// `path`, `origin`: what the path was before usvg narrowed it. `tolerance`: in canvas units.
pub fn outline_of(
    stroke: &usvg::Stroke,
    path: &Path,
    origin: Option<&Origin>,
    to_root: &Affine,
    tolerance: f64,
    budget: &mut Budget,
) -> Result<Outline, Failure> {
    let style = style_of(stroke, path, origin, tolerance);
    if origin.is_some_and(|o| o.non_scaling_stroke) {
        let in_canvas: Path = path.iter().map(|s| transform_subpath(s, to_root)).collect();
        return outline(&in_canvas, &style, &Affine::IDENTITY, tolerance, budget);
    }
    outline(path, &style, to_root, tolerance, budget)
}

fn outline(
    path: &Path,
    style: &Style,
    to_root: &Affine,
    canvas_tolerance: f64,
    budget: &mut Budget,
) -> Result<Outline, Failure> {
    let stretch = map_stretch(to_root);
    let finest = 1e-13 * magnitude(path).max(style.width);
    let tolerance = (canvas_tolerance / stretch).max(finest);
    if !(stretch > 0.0 && tolerance.is_finite() && style.width.is_finite()) {
        return Ok(Outline::default());
    }
    let (mut contours, dashes_dropped) = Stroker::new(style, tolerance).outline(path, budget)?;
    transform_contours(&mut contours, to_root);
    Ok(Outline { contours, dashes_dropped })
}

fn transform_subpath(sub: &Subpath, m: &Affine) -> Subpath {
    Subpath { start: *m * sub.start, segs: sub.segs.iter().map(|s| s.transform(m)).collect(), closed: sub.closed }
}

fn style_of(stroke: &usvg::Stroke, path: &Path, origin: Option<&Origin>, tolerance: f64) -> Style {
    let cap = match stroke.linecap() {
        usvg::LineCap::Butt => Cap::Butt,
        usvg::LineCap::Round => Cap::Round,
        usvg::LineCap::Square => Cap::Square,
    };
    let join = match stroke.linejoin() {
        usvg::LineJoin::Miter => Join::Miter,
        usvg::LineJoin::MiterClip => Join::MiterClip,
        usvg::LineJoin::Round => Join::Round,
        usvg::LineJoin::Bevel => Join::Bevel,
    };
    let mut dashes: Vec<f64> = stroke.dasharray().unwrap_or_default().iter().map(|d| *d as f64).collect();
    let valid = dashes.iter().all(|d| d.is_finite() && *d >= 0.0) && dashes.iter().sum::<f64>() > 0.0;
    if !valid {
        dashes.clear();
    }
    if dashes.len() % 2 == 1 {
        dashes.extend_from_within(..);
    }
    let mut dash_offset = stroke.dashoffset() as f64;
    if let Some(author_length) = origin.and_then(|o| o.path_length).filter(|_| !dashes.is_empty()) {
        // pathLength: dashes are given in the author's units (SVG 2 §9.6.1).
        let scale = crate::piece::path_length(path, tolerance) / author_length;
        dashes.iter_mut().for_each(|d| *d *= scale);
        dash_offset *= scale;
    }
    Style {
        width: stroke.width().get() as f64,
        miter_limit: stroke.miterlimit().get() as f64,
        cap,
        join,
        dashes,
        dash_offset,
    }
}
