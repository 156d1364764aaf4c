// SPDX-License-Identifier: GPL-3.0-or-later
//! Clip paths and masks, as trees of shapes: nothing is rasterised.

use kurbo::Affine;
use usvg::{ClipPath, Group, Mask, MaskType, Node};

use crate::abi;
use crate::budget::Failure;
use crate::emit::{key, Emitter};
use crate::geom::{fill_contours, rect_contour};

impl Emitter<'_> {
    /// The clip and its own clip-path, with `outer` as the last link of the chain: inside iff inside all of them.
    pub fn clip(&mut self, clip: &ClipPath, to_root: &Affine, outer: u32) -> Result<u32, Failure> {
        let cache_key = (clip as *const ClipPath as usize, key(to_root), outer);
        if let Some(known) = self.clip_cache.get(&cache_key) {
            return Ok(*known);
        }
        let parent = match clip.clip_path() {
            Some(c) => self.clip(c, to_root, outer)?,
            None => outer,
        };
        let own = *to_root * self.recovery.transform(clip.transform());
        let mut members = Vec::new();
        self.clip_members(clip.root(), &own, abi::NONE, &mut members)?;
        let id = self.out.clip(&members, parent);
        self.clip_cache.insert(cache_key, id);
        Ok(id)
    }

    /// `inherited`: the clip of the groups around, which every member below has to satisfy too.
    fn clip_members(
        &mut self,
        group: &Group,
        to_root: &Affine,
        inherited: u32,
        members: &mut Vec<abi::ClipMember>,
    ) -> Result<(), Failure> {
        for node in group.children() {
            self.budget.charge(1)?;
            match node {
                Node::Group(g) => {
                    let own = *to_root * self.recovery.transform(g.transform());
                    let clip = match g.clip_path() {
                        Some(c) => self.clip(c, &own, inherited)?,
                        None => inherited,
                    };
                    self.clip_members(g, &own, clip, members)?;
                }
                Node::Text(t) => self.clip_members(t.flattened(), to_root, inherited, members)?,
                Node::Path(p) => self.clip_shape(p, to_root, inherited, members)?,
                Node::Image(_) => {}
            }
        }
        Ok(())
    }

    fn clip_shape(
        &mut self,
        p: &usvg::Path,
        to_root: &Affine,
        clip: u32,
        members: &mut Vec<abi::ClipMember>,
    ) -> Result<(), Failure> {
        let Some(fill) = p.fill().filter(|_| p.is_visible()) else { return Ok(()) };
        let (path, origin) = self.recovery.path(p.data(), p.id());
        let element = self.out.element(origin.as_ref().map_or("clipPath", |o| &o.name));
        let contours = fill_contours(&path, to_root, self.arc_tolerance);
        self.budget.charge(contours.iter().map(Vec::len).sum())?;
        if contours.iter().flatten().all(|b| b.is_finite()) {
            let shape = self.out.shape(&contours, fill.rule() == usvg::FillRule::EvenOdd, element);
            members.push(abi::ClipMember { shape, clip });
        }
        Ok(())
    }

    /// The content of a mask is a tree of its own, composited exactly like the picture.
    pub fn mask(&mut self, mask: &Mask, to_root: &Affine) -> Result<u32, Failure> {
        let cache_key = (mask as *const Mask as usize, key(to_root));
        if let Some(known) = self.mask_cache.get(&cache_key) {
            return Ok(*known);
        }
        let parent = match mask.mask() {
            Some(m) => self.mask(m, to_root)?,
            None => abi::NONE,
        };
        let element = self.out.element(&format!("mask#{}", crate::names::shorten(mask.id())));
        let r = mask.rect();
        let region = rect_contour(r.x() as f64, r.y() as f64, r.width() as f64, r.height() as f64, to_root);
        let region = self.out.shape(&[region], false, element);
        let outer = std::mem::take(&mut self.nodes);
        let content = self.children(mask.root().children(), to_root);
        let tree = std::mem::replace(&mut self.nodes, outer);
        content?;
        self.mask_trees.push(tree);
        self.out.masks.push(abi::Mask {
            first: 0,
            end: 0,
            luminance: (mask.kind() == MaskType::Luminance) as u32,
            linear_rgb: self.recovery.linear_masks.iter().any(|id| id == mask.id()) as u32,
            region,
            parent,
        });
        let id = self.out.masks.len() as u32 - 1;
        self.mask_cache.insert(cache_key, id);
        Ok(id)
    }
}
