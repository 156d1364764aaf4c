// SPDX-License-Identifier: GPL-3.0-or-later
//! Raster layers: what can't be vector is rendered by resvg (filters, very fine patterns) or decoded (bitmaps).

use kurbo::{Affine, Point, Rect};
use resvg::tiny_skia::{self, Pixmap};
use usvg::{Group, ImageKind, ImageRendering, Node, Pattern};

use crate::abi;
use crate::budget::{Code, Failure};
use crate::emit::{Emitter, EMPTY_GROUP};
use crate::geom::{map_stretch, rect_contour};
use crate::paint::inverse;
use crate::report::Finding;

/// No bitmap is decoded beyond this many pixels, and no layer rendered.
const MOST_PIXELS: f64 = 64.0 * 1024.0 * 1024.0;

fn to_skia(m: &Affine) -> tiny_skia::Transform {
    let c = m.as_coeffs().map(|v| v as f32);
    tiny_skia::Transform::from_row(c[0], c[1], c[2], c[3], c[4], c[5])
}

/// Whole pixels that cover a rectangle.
fn round_out(r: Rect) -> Rect {
    Rect::new(r.x0.floor(), r.y0.floor(), r.x1.ceil(), r.y1.ceil())
}

fn rect_of(r: usvg::Rect) -> Rect {
    Rect::new(r.left() as f64, r.top() as f64, r.right() as f64, r.bottom() as f64)
}

/// resvg places a node at the origin by its bounding box; undo that.
fn render_at(node: &Node, m: &Affine, pixmap: &mut Pixmap) {
    if let Some(b) = node.abs_layer_bounding_box() {
        let t = to_skia(m).pre_translate(b.x(), b.y());
        resvg::render_node(node, t, &mut pixmap.as_mut());
    }
}

impl Emitter<'_> {
    fn reserve(&mut self, w: f64, h: f64, name: &str) -> Result<Pixmap, Failure> {
        self.budget.check_time()?;
        let bytes = w * h * 4.0;
        if !(w * h <= MOST_PIXELS && bytes <= self.raster_bytes_left as f64) {
            let mut failure =
                Failure::new(Code::TooManyPixels, format!("raster layers need more than the limit ({w} x {h} pixels)"));
            failure.place = name.to_string();
            return Err(failure);
        }
        self.raster_bytes_left -= bytes as u64;
        Pixmap::new(w as u32, h as u32)
            .ok_or_else(|| Failure::new(Code::TooManyPixels, "a raster layer can't be allocated"))
    }

    /// The group as resvg renders it, with its filters, clip, mask and opacity; only its blend mode stays outside.
    pub fn filter_layer(&mut self, node: &Node, g: &Group, parent: &Affine, own: &Affine) -> Result<(), Failure> {
        let name = self.group_name(g);
        self.check_images(g, &name)?;
        let to_pixel = Affine::scale(self.raster_scale);
        let region = (to_pixel * *own).transform_rect_bbox(rect_of(g.layer_bounding_box().to_rect()));
        let canvas =
            round_out(Rect::new(0.0, 0.0, self.out.width, self.out.height).scale_from_origin(self.raster_scale));
        // What lies outside the canvas may still be blurred into it: render up to one canvas around.
        let wide = canvas.inflate(canvas.width(), canvas.height());
        let window = round_out(region).intersect(wide);
        if !(window.width() >= 1.0 && window.height() >= 1.0) || round_out(region).intersect(canvas).is_zero_area() {
            return Ok(());
        }
        let mut pixmap = self.reserve(window.width(), window.height(), &name)?;
        let shift = Affine::translate((-window.x0, -window.y0));
        render_at(node, &(shift * to_pixel * *parent), &mut pixmap);
        self.report.take_log();
        self.report.add(Finding::FilterRasterised, "filtered content becomes a raster layer", name.clone());
        let element = self.out.element(&name);
        let blend = self.blend(g);
        if blend == 0 {
            self.layer(&pixmap, window, canvas, element);
            return Ok(());
        }
        self.in_group(abi::Node { blend, ..EMPTY_GROUP }, |e| {
            e.layer(&pixmap, window, canvas, element);
            Ok(())
        })
    }

    /// A fill of the non-transparent part of a pixmap whose origin is at `window` in raster space.
    fn layer(&mut self, pixmap: &Pixmap, window: Rect, canvas: Rect, element: u32) {
        let Some(used) = used_part(pixmap, canvas - window.origin().to_vec2()) else { return };
        let (w, h) = (used.width() as u32, used.height() as u32);
        let rgba = cut(pixmap, used);
        let at = window.origin() + used.origin().to_vec2();
        let to_pixel = Affine::translate(-at.to_vec2()) * Affine::scale(self.raster_scale);
        let contour = rect_contour(0.0, 0.0, w as f64, h as f64, &to_pixel.inverse());
        let shape = self.out.shape(&[contour], false, element);
        let paint = self.out.raster(&rgba, w, h, &to_pixel, true);
        self.push_fill(shape, paint, element);
    }

    /// A pattern with more tiles than are worth drawing: one tile rendered, repeated over the box of the shape.
    pub fn pattern_layer(
        &mut self,
        shape: u32,
        seen: Rect,
        pattern: &Pattern,
        opacity: f64,
        to_canvas: &Affine,
        element: u32,
    ) -> Result<(), Failure> {
        let name = self.out.elements[element as usize].clone();
        self.check_images(pattern.root(), &name)?;
        let r = pattern.rect();
        let scale = self.raster_scale * map_stretch(to_canvas);
        let tile_px = [r.width(), r.height()].map(|side| (side as f64 * scale).ceil().clamp(1.0, 8192.0));
        let mut tile = self.reserve(tile_px[0], tile_px[1], &name)?;
        let (sx, sy) = (tile_px[0] / r.width() as f64, tile_px[1] / r.height() as f64);
        for node in pattern.root().children() {
            render_at(node, &Affine::scale_non_uniform(sx, sy), &mut tile);
        }
        let window = round_out(seen.scale_from_origin(self.raster_scale));
        let mut pixmap = self.reserve(window.width(), window.height(), &name)?;
        let tile_to_pixel = Affine::translate(-window.origin().to_vec2())
            * Affine::scale(self.raster_scale)
            * *to_canvas
            * Affine::translate((r.x() as f64, r.y() as f64))
            * Affine::scale_non_uniform(1.0 / sx, 1.0 / sy);
        fill_with(&mut pixmap, &tile, &tile_to_pixel, opacity);
        self.report.take_log();
        self.report.add(Finding::PatternRasterised, "a pattern of very many tiles becomes a raster layer", name);
        let to_pixel = Affine::translate(-window.origin().to_vec2()) * Affine::scale(self.raster_scale);
        let paint = self.out.raster(pixmap.data(), pixmap.width(), pixmap.height(), &to_pixel, true);
        self.push_fill(shape, paint, element);
        Ok(())
    }

    pub fn image(&mut self, image: &usvg::Image, to_root: &Affine) -> Result<(), Failure> {
        if !image.is_visible() {
            return Ok(());
        }
        let name = self.hint.clone().unwrap_or_else(|| "image".to_string());
        let element = self.out.element(&name);
        let (w, h) = (image.size().width() as f64, image.size().height() as f64);
        let contour = rect_contour(0.0, 0.0, w, h, to_root);
        if !contour.iter().all(|b| b.is_finite()) {
            self.report.add(Finding::BadGeometry, "coordinates overflow; the image is not drawn", name);
            return Ok(());
        }
        let shape = self.out.shape(&[contour], false, element);
        if let ImageKind::SVG(tree) = image.kind() {
            let clip = self.out.clip(&[abi::ClipMember { shape, clip: abi::NONE }], abi::NONE);
            let isolated = self.has_blend(tree.root()) as u32;
            return self.in_group(abi::Node { clip, isolated, ..EMPTY_GROUP }, |e| {
                e.children(tree.root().children(), to_root)
            });
        }
        if !(w * h <= MOST_PIXELS) {
            self.report.add(Finding::ImageDropped, format!("the bitmap is too large ({w} x {h} pixels)"), name);
            return Ok(());
        }
        self.bitmap(image, shape, to_root, element)
    }

    fn bitmap(&mut self, image: &usvg::Image, shape: u32, to_root: &Affine, element: u32) -> Result<(), Failure> {
        let name = self.out.elements[element as usize].clone();
        let (w, h) = (image.size().width() as f64, image.size().height() as f64);
        let mut pixmap = self.reserve(w, h, &name)?;
        render_at(&Node::Image(Box::new(image.clone())), &Affine::IDENTITY, &mut pixmap);
        self.report.take_log();
        let Some(to_image) = inverse(to_root) else { return Ok(()) };
        // Far more pixels than the texture can show would only alias: average them down.
        let density = 1.0 / (map_stretch(to_root) * self.raster_scale);
        let step = (density / 2.0).floor().clamp(1.0, 64.0) as u32;
        if step > 1 {
            self.report.add(Finding::RasterReduced, format!("the bitmap is reduced {step} times"), name.clone());
        }
        let (rgba, rw, rh) = reduce(&pixmap, step);
        let to_pixel = Affine::scale_non_uniform(rw as f64 / w, rh as f64 / h) * to_image;
        self.report.add(Finding::BitmapImage, format!("embedded bitmap of {w} x {h} pixels"), name);
        let smooth = matches!(
            image.rendering_mode(),
            ImageRendering::OptimizeQuality | ImageRendering::Smooth | ImageRendering::HighQuality
        );
        let paint = self.out.raster(&rgba, rw, rh, &to_pixel, smooth);
        self.push_fill(shape, paint, element);
        Ok(())
    }

    /// Bitmaps and pattern tiles that resvg would decode or allocate on the way must be of bearable size.
    fn check_images(&mut self, g: &Group, name: &str) -> Result<(), Failure> {
        let mut worst = 0.0f64;
        largest_raster(g, self.raster_scale, &mut worst);
        if worst <= MOST_PIXELS {
            return Ok(());
        }
        let mut failure =
            Failure::new(Code::TooManyPixels, format!("content of {worst:.3e} pixels inside a raster layer"));
        failure.place = name.to_string();
        Err(failure)
    }
}

fn largest_raster(g: &Group, scale: f64, worst: &mut f64) {
    for node in g.children() {
        match node {
            Node::Image(i) => *worst = worst.max(i.size().width() as f64 * i.size().height() as f64),
            Node::Path(p) => {
                for paint in [p.fill().map(|f| f.paint()), p.stroke().map(|s| s.paint())].into_iter().flatten() {
                    if let usvg::Paint::Pattern(pattern) = paint {
                        let m = p.abs_transform().pre_concat(pattern.transform());
                        let (sx, sy) = m.get_scale();
                        let area = pattern.rect().width() as f64 * pattern.rect().height() as f64;
                        *worst = worst.max(area * sx as f64 * sy as f64 * scale * scale);
                    }
                }
            }
            Node::Group(c) => largest_raster(c, scale, worst),
            Node::Text(_) => {}
        }
        node.subroots(|root| largest_raster(root, scale, worst));
    }
}

/// Box of the pixels that are not transparent, within `limit`.
fn used_part(pixmap: &Pixmap, limit: Rect) -> Option<Rect> {
    let all = Rect::new(0.0, 0.0, pixmap.width() as f64, pixmap.height() as f64);
    let area = limit.intersect(all);
    let mut used: Option<Rect> = None;
    for y in area.y0 as usize..area.y1.max(0.0) as usize {
        let row = &pixmap.pixels()[y * pixmap.width() as usize..][..pixmap.width() as usize];
        for (x, pixel) in row.iter().enumerate().take(area.x1.max(0.0) as usize).skip(area.x0 as usize) {
            if pixel.alpha() > 0 {
                let cell = Rect::from_origin_size(Point::new(x as f64, y as f64), (1.0, 1.0));
                used = Some(used.map_or(cell, |u| u.union(cell)));
            }
        }
    }
    used
}

fn cut(pixmap: &Pixmap, part: Rect) -> Vec<u8> {
    let (x0, x1) = (part.x0 as usize * 4, part.x1 as usize * 4);
    let row = pixmap.width() as usize * 4;
    let rows = part.y0 as usize..part.y1 as usize;
    rows.flat_map(|y| pixmap.data()[y * row + x0..y * row + x1].iter().copied()).collect()
}

fn fill_with(pixmap: &mut Pixmap, tile: &Pixmap, tile_to_pixel: &Affine, opacity: f64) {
    let shader = tiny_skia::Pattern::new(
        tile.as_ref(),
        tiny_skia::SpreadMode::Repeat,
        tiny_skia::FilterQuality::Bicubic,
        opacity as f32,
        to_skia(tile_to_pixel),
    );
    let paint = tiny_skia::Paint { shader, ..tiny_skia::Paint::default() };
    if let Some(all) = tiny_skia::Rect::from_xywh(0.0, 0.0, pixmap.width() as f32, pixmap.height() as f32) {
        pixmap.fill_rect(all, &paint, tiny_skia::Transform::identity(), None);
    }
}

/// Averages step × step pixels (fewer at the right and bottom edge).
fn reduce(pixmap: &Pixmap, step: u32) -> (Vec<u8>, u32, u32) {
    let (w, h) = (pixmap.width(), pixmap.height());
    if step <= 1 {
        return (pixmap.data().to_vec(), w, h);
    }
    let (rw, rh) = (w.div_ceil(step), h.div_ceil(step));
    let mut out = Vec::with_capacity(rw as usize * rh as usize * 4);
    for j in 0..rh {
        for i in 0..rw {
            let (mut sum, mut count) = ([0u32; 4], 0u32);
            for y in j * step..((j + 1) * step).min(h) {
                for x in i * step..((i + 1) * step).min(w) {
                    let at = (y as usize * w as usize + x as usize) * 4;
                    (0..4).for_each(|c| sum[c] += pixmap.data()[at + c] as u32);
                    count += 1;
                }
            }
            out.extend(sum.map(|s| ((s + count / 2) / count) as u8));
        }
    }
    (out, rw, rh)
}
