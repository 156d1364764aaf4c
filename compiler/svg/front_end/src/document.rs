// SPDX-License-Identifier: GPL-3.0-or-later
//! The arrays behind the C view, and how they are filled.

use std::collections::HashMap;

use kurbo::Affine;

use crate::abi;
use crate::geom::Contour;
use crate::report::Entry;

#[derive(Default)]
pub struct Drawing {
    pub width: f64,
    pub height: f64,
    pub root_end: u32,
    pub nodes: Vec<abi::Node>,
    pub shapes: Vec<abi::Shape>,
    pub contours: Vec<abi::Contour>,
    pub segments: Vec<abi::Segment>,
    pub paints: Vec<abi::Paint>,
    pub stops: Vec<abi::Stop>,
    pub clips: Vec<abi::Clip>,
    pub clip_members: Vec<abi::ClipMember>,
    pub masks: Vec<abi::Mask>,
    pub elements: Vec<String>,
    pub findings: Vec<Entry>,
    pub bytes: Vec<u8>,
    pub paths_recovered: u64,
    pub paths_kept_f32: u64,
    element_ids: HashMap<String, u32>,
}

pub fn to_abi(m: &Affine) -> abi::Affine {
    abi::Affine { m: m.as_coeffs() }
}

impl Drawing {
    pub fn element(&mut self, name: &str) -> u32 {
        if let Some(id) = self.element_ids.get(name) {
            return *id;
        }
        let id = self.elements.len() as u32;
        self.elements.push(name.to_string());
        self.element_ids.insert(name.to_string(), id);
        id
    }

    pub fn shape(&mut self, contours: &[Contour], even_odd: bool, element: u32) -> u32 {
        let first = self.contours.len() as u32;
        for contour in contours {
            let from = self.segments.len() as u32;
            self.contours.push(abi::Contour { first: from, count: contour.len() as u32 });
            self.segments.extend(contour.iter().map(|b| {
                let mut p = [0.0; 8];
                for (i, q) in b.p.iter().enumerate() {
                    (p[2 * i], p[2 * i + 1]) = (q.x, q.y);
                }
                abi::Segment { degree: b.degree, reserved: 0, p }
            }));
        }
        self.shapes.push(abi::Shape { first, count: contours.len() as u32, rule: even_odd as u32, element });
        self.shapes.len() as u32 - 1
    }

    pub fn paint(&mut self, paint: abi::Paint, stops: &[abi::Stop]) -> u32 {
        let stop = self.stops.len() as u32;
        self.stops.extend_from_slice(stops);
        self.paints.push(abi::Paint { stop, stop_count: stops.len() as u32, ..paint });
        self.paints.len() as u32 - 1
    }

    pub fn solid(&mut self, rgb: usvg::Color, alpha: f64) -> u32 {
        let stop = stop(0.0, rgb, alpha);
        self.paint(abi::Paint { kind: abi::SOLID, ..abi::Paint::default() }, &[stop])
    }

    pub fn raster(&mut self, rgba: &[u8], width: u32, height: u32, to_pixel: &Affine, smooth: bool) -> u32 {
        let offset = self.bytes.len() as u64;
        self.bytes.extend_from_slice(rgba);
        let to_paint = to_abi(to_pixel);
        let paint = abi::Paint {
            kind: abi::RASTER,
            width,
            height,
            offset,
            to_paint,
            smooth: smooth as u32,
            ..abi::Paint::default()
        };
        self.paint(paint, &[])
    }

    pub fn clip(&mut self, members: &[abi::ClipMember], parent: u32) -> u32 {
        let first = self.clip_members.len() as u32;
        self.clip_members.extend_from_slice(members);
        self.clips.push(abi::Clip { first, count: members.len() as u32, parent });
        self.clips.len() as u32 - 1
    }
}

pub fn stop(offset: f64, c: usvg::Color, alpha: f64) -> abi::Stop {
    let unit = |v: u8| v as f64 / 255.0;
    abi::Stop { offset, r: unit(c.red), g: unit(c.green), b: unit(c.blue), a: alpha }
}
