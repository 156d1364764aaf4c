// SPDX-License-Identifier: GPL-3.0-or-later
//! Who refers to whom, before usvg resolves it: how large the drawing becomes when every `use`, pattern, mask, marker and
//! clip path is expanded, how deep they nest, and whether they refer to each other in a circle. usvg itself follows
//! circles of three and more until the stack ends, and expands "billion laughs" for as long as it takes.

use std::collections::HashMap;

use simplecss::StyleSheet;
use usvg::roxmltree::{Document, Node, NodeId};

use crate::budget::{Code, Failure};
use crate::css::{for_each_property, referring_rules, url_ids};
use crate::names::{lines_of, shorten};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Painted again for every shape below the element (inherited): fill and stroke.
    Paint,
    /// Drawn again at every vertex of every shape below the element.
    Marker,
    /// Applied once: clip-path, mask, filter.
    Once,
    /// Replaced by a copy.
    Use,
    /// href between gradients, patterns, filters.
    Template,
}

#[derive(Clone, Copy, Default)]
struct Size {
    weight: u64,
    depth: u32,
}

enum State {
    Active { position: usize },
    Done(Size),
}

pub struct Limits {
    pub expanded_elements: u64,
    pub nesting: u32,
}

struct Walk<'a, 'input> {
    doc: &'a Document<'input>,
    sheet: StyleSheet<'a>,
    ids: HashMap<&'a str, Vec<NodeId>>,
    states: HashMap<NodeId, State>,
    /// Kinds of the references on the way from the start to the current element, with their positions in the walk.
    trail: Vec<(usize, Kind)>,
    limits: &'a Limits,
}

/// Elements that draw nothing where they stand, only where they are referred to.
fn is_definition(tag: &str) -> bool {
    matches!(
        tag,
        "defs"
            | "symbol"
            | "clipPath"
            | "mask"
            | "pattern"
            | "marker"
            | "filter"
            | "linearGradient"
            | "radialGradient"
            | "style"
    )
}

pub fn check(doc: &Document, limits: &Limits) -> Result<(), Failure> {
    let sheet = referring_rules(doc);
    let mut ids: HashMap<&str, Vec<NodeId>> = HashMap::new();
    for node in doc.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            let same = ids.entry(id).or_default();
            // Of elements with one id usvg takes the first or the last, depending on the reference.
            same.truncate(1);
            same.push(node.id());
        }
    }
    let mut walk = Walk { doc, sheet, ids, states: HashMap::new(), trail: Vec::new(), limits };
    let mut total = 0u64;
    for node in doc.descendants().filter(Node::is_element) {
        // Definitions count even when nothing refers to them: usvg copies `use` targets everywhere.
        total = total.max(walk.visit(node, 0)?.weight);
    }
    if total > limits.expanded_elements {
        let message = format!("{total} elements after expanding references; the limit is {}", limits.expanded_elements);
        return Err(Failure::new(Code::TooManyElements, message));
    }
    Ok(())
}

impl<'a, 'input> Walk<'a, 'input> {
    fn visit(&mut self, node: Node<'a, 'input>, position: usize) -> Result<Size, Failure> {
        match self.states.get(&node.id()) {
            Some(State::Done(size)) => {
                let size = *size;
                return self.check_depth(&node, position as u32 + size.depth).map(|_| size);
            }
            Some(State::Active { position }) => return self.circle(&node, *position).map(|_| Size::default()),
            None => {}
        }
        self.check_depth(&node, position as u32)?;
        self.states.insert(node.id(), State::Active { position });
        let size = self.measure(node, position)?;
        self.states.insert(node.id(), State::Done(size));
        Ok(size)
    }

    fn measure(&mut self, node: Node<'a, 'input>, position: usize) -> Result<Size, Failure> {
        let mut size = Size { weight: 1, depth: 1 };
        let mut merge = |part: Size, factor: u64| {
            size.weight = size.weight.saturating_add(part.weight.saturating_mul(factor));
            size.depth = size.depth.max(part.depth + 1);
        };
        for child in node.children().filter(|c| c.is_element() && !is_definition(c.tag_name().name())) {
            let part = self.visit(child, position + 1)?;
            merge(part, 1);
        }
        let mut later = Vec::new();
        for (kind, id) in self.references(node) {
            for target in self.ids.get(id).cloned().unwrap_or_default() {
                let Some(target) = self.doc.get_node(target) else { continue };
                self.trail.push((position, kind));
                let part = self.visit(target, position + 1)?;
                self.trail.pop();
                match kind {
                    Kind::Use | Kind::Once | Kind::Template => merge(part, 1),
                    Kind::Paint | Kind::Marker => later.push((kind, part)),
                }
            }
        }
        // Inherited paint is used by every shape below, markers at every vertex as well.
        let users = size.weight;
        for (kind, part) in later {
            let factor = if kind == Kind::Marker { vertices(&node) } else { 1 };
            size.weight = size.weight.saturating_add(part.weight.saturating_mul(users).saturating_mul(factor));
            size.depth = size.depth.max(part.depth + 1);
        }
        Ok(size)
    }

    fn references(&self, node: Node<'a, 'input>) -> Vec<(Kind, &'a str)> {
        let mut out = Vec::new();
        let tag = node.tag_name().name();
        for_each_property(node, &self.sheet, |name, value| {
            let kind = match name {
                "fill" | "stroke" => Kind::Paint,
                "marker" | "marker-start" | "marker-mid" | "marker-end" => Kind::Marker,
                "clip-path" | "mask" | "filter" => Kind::Once,
                "href" if tag == "use" || tag == "feImage" => Kind::Use,
                "href" if is_definition(tag) => Kind::Template,
                _ => return,
            };
            match value.trim().strip_prefix('#') {
                Some(id) if name == "href" => out.push((kind, id)),
                _ => out.extend(url_ids(value).map(|id| (kind, id))),
            }
        });
        out
    }

    /// A reference back to an element on the way. usvg breaks those of an element to itself, and those of `use` and of
    /// markers; everything else is refused.
    fn circle(&self, node: &Node, start: usize) -> Result<(), Failure> {
        let kinds: Vec<Kind> = self.trail.iter().filter(|(p, _)| *p >= start).map(|(_, k)| *k).collect();
        let all = |kind| kinds.iter().all(|k| *k == kind);
        if kinds.len() <= 1 || all(Kind::Use) || all(Kind::Marker) {
            return Ok(());
        }
        let mut failure = Failure::new(Code::TooDeep, "elements refer to each other in a circle");
        failure.place = shorten(&lines_of(self.doc).name(node));
        Err(failure)
    }

    fn check_depth(&self, node: &Node, depth: u32) -> Result<(), Failure> {
        if depth <= self.limits.nesting {
            return Ok(());
        }
        let message = format!("elements nest deeper than {}, counted through references", self.limits.nesting);
        let mut failure = Failure::new(Code::TooDeep, message);
        failure.place = lines_of(self.doc).name(node);
        Err(failure)
    }
}

/// An upper bound of the vertices of a shape, from the length of its data.
fn vertices(node: &Node) -> u64 {
    let data = node.attribute("d").or_else(|| node.attribute("points"));
    data.map_or(4, |d| d.len() as u64 / 2 + 4)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(svg: &str) -> Result<(), Code> {
        let doc = Document::parse(svg).unwrap();
        check(&doc, &Limits { expanded_elements: 100_000, nesting: 200 }).map_err(|f| f.code)
    }

    #[test]
    fn self_reference_is_left_to_usvg() {
        assert_eq!(
            verdict("<svg><pattern id='p'><rect fill='url(#p)'/></pattern><rect fill='url(#p)'/></svg>"),
            Ok(())
        );
        assert_eq!(verdict("<svg><g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g></svg>"), Ok(()));
    }

    #[test]
    fn circle_of_different_kinds_is_refused() {
        let svg =
            "<svg><pattern id='p'><rect mask='url(#m)'/></pattern><mask id='m'><rect fill='url(#p)'/></mask></svg>";
        assert_eq!(verdict(svg), Err(Code::TooDeep));
        let css = "<svg><style>.a{mask:url(#m)} .b{fill:url(#p)}</style><pattern id='p'><rect class='a'/></pattern>\
                   <mask id='m'><rect class='b'/></mask></svg>";
        assert_eq!(verdict(css), Err(Code::TooDeep));
    }

    #[test]
    fn expansion_is_counted() {
        let mut svg = String::from("<svg><g id='g0'><rect/><rect/></g>");
        for i in 1..30 {
            svg += &format!("<g id='g{i}'><use href='#g{0}'/><use href='#g{0}'/></g>", i - 1);
        }
        assert_eq!(verdict(&(svg + "</svg>")), Err(Code::TooManyElements));
    }
}
