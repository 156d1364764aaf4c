// SPDX-License-Identifier: GPL-3.0-or-later
//! Walks the usvg tree and writes canvas-space geometry: groups, fills and stroke outlines in paint order.

use std::collections::HashMap;

use kurbo::Affine;
use usvg::{BlendMode, Group, Node};

use crate::abi;
use crate::budget::{Budget, Failure};
use crate::document::Drawing;
use crate::geom::{fill_contours, line_contours, map_is_finite, Contour, Path};
use crate::outline::outline_of;
use crate::outlines_ahead::{outlines_ahead, Context, OutlinesAhead};
use crate::recover::{Origin, Recovery};
use crate::report::{Finding, Report};

pub struct Emitter<'a> {
    pub out: Drawing,
    /// The tree that is being written: the picture, or the content of one mask.
    pub nodes: Vec<abi::Node>,
    pub mask_trees: Vec<Vec<abi::Node>>,
    pub recovery: Recovery,
    pub report: Report,
    pub budget: &'a mut Budget,
    pub arc_tolerance: f64,
    pub stroke_tolerance: f64,
    pub threads: usize,
    /// As abi::Options has it.
    pub centre_lines: u32,
    ahead: OutlinesAhead,
    /// Pixels per user unit of raster layers.
    pub raster_scale: f64,
    pub raster_bytes_left: u64,
    pub clip_cache: HashMap<(usize, [u64; 6], u32), u32>,
    pub mask_cache: HashMap<(usize, [u64; 6]), u32>,
    blends: HashMap<usize, bool>,
    /// Name for shapes that have none of their own: the text or image they come from.
    pub hint: Option<String>,
}

pub struct Tolerances {
    pub arc: f64,
    pub stroke: f64,
}

pub fn key(m: &Affine) -> [u64; 6] {
    m.as_coeffs().map(f64::to_bits)
}

pub const EMPTY_GROUP: abi::Node = abi::Node {
    kind: abi::GROUP,
    end: 0,
    clip: abi::NONE,
    mask: abi::NONE,
    blend: 0,
    isolated: 0,
    shape: abi::NONE,
    paint: abi::NONE,
    element: abi::NONE,
    line: 0,
    opacity: 1.0,
};

impl<'a> Emitter<'a> {
    pub fn new(recovery: Recovery, report: Report, budget: &'a mut Budget, tolerances: Tolerances) -> Self {
        Emitter {
            out: Drawing::default(),
            nodes: Vec::new(),
            mask_trees: Vec::new(),
            recovery,
            report,
            budget,
            arc_tolerance: tolerances.arc,
            stroke_tolerance: tolerances.stroke,
            threads: 1,
            centre_lines: 0,
            ahead: OutlinesAhead::default(),
            raster_scale: 1.0,
            raster_bytes_left: 0,
            clip_cache: HashMap::new(),
            mask_cache: HashMap::new(),
            blends: HashMap::new(),
            hint: None,
        }
    }

    /// The whole picture. `root` maps the content of the outermost group into the canvas.
    pub fn picture(&mut self, tree: &usvg::Tree) -> Result<(), Failure> {
        let wrapper = match tree.root().children() {
            [Node::Group(g)] => g.transform(),
            _ => usvg::Transform::identity(),
        };
        let (width, height, frame) = self.recovery.frame(tree.size(), wrapper);
        (self.out.width, self.out.height) = (width, height);
        if self.threads > 1 {
            let context = Context { recovery: &self.recovery, tolerance: self.stroke_tolerance, threads: self.threads };
            self.ahead = outlines_ahead(tree, &frame, &context, self.budget);
        }
        match tree.root().children() {
            [node @ Node::Group(g)] => self.group_at(node, g, &Affine::IDENTITY, &frame)?,
            children => self.children(children, &Affine::IDENTITY)?,
        }
        self.finish();
        Ok(())
    }

    /// Appends the contents of the masks behind the picture.
    fn finish(&mut self) {
        self.out.nodes = std::mem::take(&mut self.nodes);
        self.out.root_end = self.out.nodes.len() as u32;
        for (mask, tree) in self.out.masks.iter_mut().zip(std::mem::take(&mut self.mask_trees)) {
            let base = self.out.nodes.len() as u32;
            self.out.nodes.extend(tree.into_iter().map(|n| abi::Node { end: n.end + base, ..n }));
            (mask.first, mask.end) = (base, self.out.nodes.len() as u32);
        }
    }

    pub fn children(&mut self, nodes: &[Node], to_root: &Affine) -> Result<(), Failure> {
        for node in nodes {
            self.budget.charge(1)?;
            self.node(node, to_root)?;
        }
        Ok(())
    }

    fn node(&mut self, node: &Node, to_root: &Affine) -> Result<(), Failure> {
        match node {
            Node::Group(g) => {
                let own = *to_root * self.recovery.transform(g.transform());
                self.group_at(node, g, to_root, &own)
            }
            Node::Path(p) => self.path(p, to_root),
            Node::Image(i) => self.image(i, to_root),
            Node::Text(t) => {
                let name = if t.id().is_empty() { "text".to_string() } else { format!("text#{}", t.id()) };
                let outer = self.hint.replace(name);
                let result = self.children(t.flattened().children(), to_root);
                self.hint = outer;
                result
            }
        }
    }

    fn group_at(&mut self, node: &Node, g: &Group, parent: &Affine, own: &Affine) -> Result<(), Failure> {
        if !map_is_finite(own) {
            self.report.add(Finding::BadGeometry, "a transform overflows; the group is not drawn", self.group_name(g));
            return Ok(());
        }
        if !g.filters().is_empty() {
            return self.filter_layer(node, g, parent, own);
        }
        let clip = match g.clip_path() {
            Some(c) => self.clip(c, own, abi::NONE)?,
            None => abi::NONE,
        };
        let mask = match g.mask() {
            Some(m) => self.mask(m, own)?,
            None => abi::NONE,
        };
        let header = abi::Node {
            clip,
            mask,
            blend: self.blend(g),
            isolated: (g.should_isolate() && self.has_blend(g)) as u32,
            opacity: g.opacity().get() as f64,
            ..EMPTY_GROUP
        };
        let plain = clip == abi::NONE
            && mask == abi::NONE
            && header.blend == 0
            && header.isolated == 0
            && header.opacity == 1.0;
        let outer = self.hint.clone();
        if matches!(g.children(), [Node::Image(_)]) && !g.id().is_empty() {
            // usvg moves the id of an image to the group around it.
            self.hint = Some(format!("image#{}", crate::names::shorten(g.id())));
        }
        let result = match plain {
            true => self.children(g.children(), own),
            false => self.in_group(header, |e| e.children(g.children(), own)),
        };
        self.hint = outer;
        result
    }

    pub fn in_group(
        &mut self,
        header: abi::Node,
        content: impl FnOnce(&mut Self) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let at = self.nodes.len();
        self.nodes.push(header);
        content(self)?;
        self.nodes[at].end = self.nodes.len() as u32;
        Ok(())
    }

    pub fn group_name(&self, g: &Group) -> String {
        if !g.id().is_empty() {
            return format!("g#{}", crate::names::shorten(g.id()));
        }
        if let Some(hint) = &self.hint {
            return hint.clone();
        }
        // usvg puts a group around a shape that has a filter, a mask … of its own.
        match (self.first_shape(g.children()), g.children()) {
            (Some(name), [Node::Path(_)]) => name,
            (Some(name), _) => format!("g around {name}"),
            (None, _) => "g".to_string(),
        }
    }

    fn first_shape(&self, nodes: &[Node]) -> Option<String> {
        nodes.iter().find_map(|n| match n {
            Node::Group(g) => self.first_shape(g.children()),
            Node::Path(p) => self.recovery.origin(p.data(), p.id()).map(|o| o.name.clone()),
            Node::Image(_) | Node::Text(_) => None,
        })
    }

    pub fn blend(&mut self, g: &Group) -> u32 {
        match g.blend_mode() {
            BlendMode::PlusLighter => {
                let name = self.group_name(g);
                self.report.add(Finding::PlusLighter, "mix-blend-mode plus-lighter is drawn as normal", name);
                0
            }
            mode => mode as u32,
        }
    }

    pub fn has_blend(&mut self, g: &Group) -> bool {
        let address = g as *const Group as usize;
        if let Some(known) = self.blends.get(&address) {
            return *known;
        }
        let found = g.children().iter().any(|n| match n {
            Node::Group(c) => c.blend_mode() != BlendMode::Normal || self.has_blend(c),
            _ => false,
        });
        self.blends.insert(address, found);
        found
    }

    fn path(&mut self, p: &usvg::Path, to_root: &Affine) -> Result<(), Failure> {
        if !p.is_visible() {
            return Ok(());
        }
        let (path, origin) = self.recovery.path(p.data(), p.id());
        let name = match (&self.hint, &origin) {
            (Some(hint), _) => hint.clone(),
            (None, Some(origin)) => origin.name.clone(),
            (None, None) if p.id().is_empty() => "path".to_string(),
            (None, None) => format!("path#{}", crate::names::shorten(p.id())),
        };
        let element = self.out.element(&name);
        if p.paint_order() == usvg::PaintOrder::FillAndStroke {
            self.fill(p, &path, to_root, element)?;
            self.stroke(p, &path, origin.as_deref(), to_root, element)
        } else {
            self.stroke(p, &path, origin.as_deref(), to_root, element)?;
            self.fill(p, &path, to_root, element)
        }
    }

    fn fill(&mut self, p: &usvg::Path, path: &Path, to_root: &Affine, element: u32) -> Result<(), Failure> {
        let Some(fill) = p.fill() else { return Ok(()) };
        let bounds = p.data().bounds();
        if bounds.width() == 0.0 || bounds.height() == 0.0 {
            return Ok(());
        }
        let contours = fill_contours(path, to_root, self.arc_tolerance);
        let even_odd = fill.rule() == usvg::FillRule::EvenOdd;
        self.painted(&contours, even_odd, fill.paint(), fill.opacity().get() as f64, to_root, element)
    }

    fn stroke(
        &mut self,
        p: &usvg::Path,
        path: &Path,
        origin: Option<&Origin>,
        to_root: &Affine,
        element: u32,
    ) -> Result<(), Failure> {
        let Some(stroke) = p.stroke() else { return Ok(()) };
        if self.centre_lines == 2 || (self.centre_lines == 1 && p.fill().is_none()) {
            let contours = line_contours(path, to_root, self.arc_tolerance);
            let first = self.nodes.len();
            self.painted(&contours, false, &usvg::Paint::Color(usvg::Color::black()), 1.0, to_root, element)?;
            self.nodes[first..].iter_mut().for_each(|n| n.line = 1);
            return Ok(());
        }
        let outline = match self.ahead.take(p, to_root, self.budget)? {
            Some(outline) => outline,
            None => outline_of(stroke, path, origin, to_root, self.stroke_tolerance, self.budget)?,
        };
        if outline.dashes_dropped {
            let name = self.out.elements[element as usize].clone();
            self.report.add(Finding::DashTooFine, "the dashes are too many to draw; the stroke is solid", name);
        }
        self.painted(&outline.contours, false, stroke.paint(), stroke.opacity().get() as f64, to_root, element)
    }

    /// A shape with a paint; `to_root` is the space of the paint.
    fn painted(
        &mut self,
        contours: &[Contour],
        even_odd: bool,
        paint: &usvg::Paint,
        opacity: f64,
        to_root: &Affine,
        element: u32,
    ) -> Result<(), Failure> {
        if contours.is_empty() {
            return Ok(());
        }
        self.budget.charge(contours.iter().map(Vec::len).sum())?;
        if !contours.iter().flatten().all(|b| b.is_finite()) {
            let name = self.out.elements[element as usize].clone();
            self.report.add(Finding::BadGeometry, "coordinates overflow; the shape is not drawn", name);
            return Ok(());
        }
        if let usvg::Paint::Pattern(pattern) = paint {
            return self.pattern(contours, even_odd, pattern, opacity, to_root, element);
        }
        let Some(paint) = self.paint(paint, opacity, to_root) else { return Ok(()) };
        let shape = self.out.shape(contours, even_odd, element);
        self.push_fill(shape, paint, element);
        Ok(())
    }

    pub fn push_fill(&mut self, shape: u32, paint: u32, element: u32) {
        let end = self.nodes.len() as u32 + 1;
        self.nodes.push(abi::Node { kind: abi::FILL, end, shape, paint, element, ..EMPTY_GROUP });
    }
}
