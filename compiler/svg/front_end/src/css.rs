// SPDX-License-Identifier: GPL-3.0-or-later
//! The properties of an element that matter before usvg runs: attributes, style sheet rules and the style attribute.

use simplecss::{AttributeOperator, DeclarationTokenizer, Element, PseudoClass, StyleSheet};
use usvg::roxmltree::{Document, Node};

struct XmlElement<'a, 'input>(Node<'a, 'input>);

impl Element for XmlElement<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(XmlElement)
    }
    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(XmlElement)
    }
    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }
    fn attribute_matches(&self, name: &str, operator: AttributeOperator) -> bool {
        self.0.attribute(name).is_some_and(|value| operator.matches(value))
    }
    fn pseudo_class_matches(&self, class: PseudoClass) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.prev_sibling_element().is_none()
    }
}

/// The rules of all style elements that refer to something; others are of no interest here.
pub fn referring_rules<'a>(doc: &'a Document) -> StyleSheet<'a> {
    let mut sheet = StyleSheet::new();
    for style in doc.descendants().filter(|n| n.has_tag_name("style")) {
        let css = matches!(style.attribute("type"), None | Some("text/css"));
        if let Some(text) = style.text().filter(|t| css && t.contains("url(")) {
            sheet.parse_more(text);
        }
    }
    sheet.rules.retain(|rule| rule.declarations.iter().any(|d| d.value.contains("url(")));
    sheet
}

/// Calls `f(property, value)` for every attribute and declaration of an element.
pub fn for_each_property<'a>(node: Node<'a, '_>, sheet: &StyleSheet<'a>, mut f: impl FnMut(&'a str, &'a str)) {
    for attribute in node.attributes() {
        if attribute.name() != "style" {
            f(attribute.name(), attribute.value());
        }
    }
    for rule in &sheet.rules {
        if rule.selector.matches(&XmlElement(node)) {
            for declaration in &rule.declarations {
                f(declaration.name, declaration.value);
            }
        }
    }
    if let Some(style) = node.attribute("style") {
        for declaration in DeclarationTokenizer::from(style) {
            f(declaration.name, declaration.value);
        }
    }
}

/// One property of the style attribute or the attribute of that name, without the cascade.
pub fn own_property<'a>(node: &Node<'a, '_>, name: &str) -> Option<&'a str> {
    let styled = node
        .attribute("style")
        .and_then(|style| DeclarationTokenizer::from(style).filter(|d| d.name == name).map(|d| d.value).last());
    styled.or_else(|| node.attribute(name))
}

/// Identifiers in url(#…) of a value.
pub fn url_ids(value: &str) -> impl Iterator<Item = &str> {
    value.split("url(").skip(1).filter_map(|rest| {
        let inside = rest.split(')').next()?.trim().trim_matches(|c| c == '"' || c == '\'').trim();
        inside.strip_prefix('#')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_every_url() {
        let ids: Vec<_> = url_ids("url(#a) url( '#b' ) url(x.svg#c)").collect();
        assert_eq!(ids, ["a", "b"]);
    }
}
