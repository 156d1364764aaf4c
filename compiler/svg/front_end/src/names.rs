// SPDX-License-Identifier: GPL-3.0-or-later
//! Names of XML elements for people: "path#wheel", "rect @ line 12".

use usvg::roxmltree::{Document, Node};

/// Line numbers by byte offset, because roxmltree counts from the start each time.
pub struct Lines(Vec<usize>);

impl Lines {
    pub fn new(text: &str) -> Self {
        Lines(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i).collect())
    }
    pub fn line_of(&self, offset: usize) -> usize {
        self.0.partition_point(|nl| *nl < offset) + 1
    }
    pub fn name(&self, node: &Node) -> String {
        let tag = node.tag_name().name();
        match node.attribute("id") {
            Some(id) if !id.trim().is_empty() => format!("{tag}#{}", shorten(id)),
            _ => format!("{tag} @ line {}", self.line_of(node.range().start)),
        }
    }
}

/// Identifiers come from the input: keep messages of bounded length and on one line.
pub fn shorten(text: &str) -> String {
    const MOST: usize = 80;
    let clean: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(MOST + 1).collect();
    if clean.chars().count() <= MOST {
        return clean;
    }
    clean.chars().take(MOST).chain("…".chars()).collect()
}

pub fn lines_of(doc: &Document) -> Lines {
    Lines::new(doc.input_text())
}
