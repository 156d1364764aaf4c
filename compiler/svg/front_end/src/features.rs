// SPDX-License-Identifier: GPL-3.0-or-later
//! What usvg drops without a word, found in the XML and reported by name.

use usvg::roxmltree::{Document, Node};

use crate::css::own_property;
use crate::names::{shorten, Lines};
use crate::report::{Finding, Report};

const SVG_NAMESPACE: &str = "http://www.w3.org/2000/svg";

fn by_tag(tag: &str) -> Option<(Finding, &'static str)> {
    Some(match tag {
        "animate" | "animateTransform" | "animateMotion" | "animateColor" | "set" => {
            (Finding::Animation, "animation is ignored; the drawing is compiled as it stands")
        }
        "script" => (Finding::Script, "scripts are not run"),
        "font" | "font-face" => (Finding::SvgFont, "SVG fonts are not supported"),
        "meshgradient" | "meshGradient" | "mesh" | "hatch" | "hatchpath" => {
            (Finding::MeshOrHatch, "mesh gradients and hatches are not supported")
        }
        "foreignObject" => (Finding::ForeignObject, "foreignObject is not drawn"),
        _ => return None,
    })
}

fn href<'a>(node: &Node<'a, '_>) -> Option<&'a str> {
    let find = |plain: bool| node.attributes().find(|a| a.name() == "href" && a.namespace().is_none() == plain);
    find(true).or_else(|| find(false)).map(|a| a.value())
}

fn is_external(node: &Node) -> bool {
    let Some(target) = href(node) else { return false };
    match node.tag_name().name() {
        "use" | "linearGradient" | "radialGradient" | "pattern" => !target.trim_start().starts_with('#'),
        "image" | "feImage" => target.contains("://"),
        _ => false,
    }
}

fn has_words(node: &Node) -> bool {
    node.descendants().any(|n| n.text().is_some_and(|t| !t.trim().is_empty()))
}

fn inspect(node: &Node, lines: &Lines, report: &mut Report) {
    let tag = node.tag_name().name();
    if let Some((finding, message)) = by_tag(tag) {
        report.add(finding, message, lines.name(node));
    }
    if tag == "text" && report.without_fonts && has_words(node) {
        report.add(Finding::TextWithoutFonts, "text is not drawn: no fonts were given", lines.name(node));
    }
    if tag == "style" {
        let text = node.text().unwrap_or_default();
        if text.contains("@media") {
            report.add(Finding::MediaQuery, "rules inside @media are ignored", lines.name(node));
        }
        if text.contains("@font-face") {
            report.add(Finding::SvgFont, "@font-face is ignored; pass the font file instead", lines.name(node));
        }
    }
    if is_external(node) {
        let target = shorten(href(node).unwrap_or_default());
        report.add(Finding::ExternalReference, format!("reference to another document: {target}"), lines.name(node));
    }
    if let Some(effect) = own_property(node, "vector-effect").map(str::trim) {
        if !matches!(effect, "none" | "non-scaling-stroke") {
            report.add(
                Finding::VectorEffect,
                format!("vector-effect {} is ignored", shorten(effect)),
                lines.name(node),
            );
        }
    }
}

pub fn report_dropped(doc: &Document, lines: &Lines, report: &mut Report) {
    for node in doc.descendants().filter(Node::is_element) {
        if matches!(node.tag_name().namespace(), None | Some(SVG_NAMESPACE)) {
            inspect(&node, lines, report);
        }
    }
}
