//! A stylesheet (XSLT 1.0) that displays a digital certificate.

use crate::certificate::words::{self, Words};
use crate::printed::unit_text;
use gumption_analysis::certificate::contents::Language;
use gumption_units::{Prefix, Symbol};

/// The stylesheet, with placeholders for words and for the style of pages.
const TEMPLATE: &str = include_str!("view.xsl");

/// A placeholder in the template, and its word.
type NamedWord = (&'static str, fn(&Words) -> &'static str);

/// The words that it shares with certificates.
const WORDS: [NamedWord; 24] = [
    ("title", |of| of.title),
    ("number", |of| of.number),
    ("device", |of| of.device),
    ("manufacturer", |of| of.manufacturer),
    ("model", |of| of.model),
    ("customer", |of| of.customer),
    ("laboratory", |of| of.laboratory),
    ("code", |of| of.code),
    ("responsible", |of| of.responsible),
    ("received", |of| of.received),
    ("calibrated", |of| of.calibrated),
    ("issued", |of| of.issued),
    ("place", |of| of.place),
    ("at_laboratory", |of| of.places[0]),
    ("at_customer", |of| of.places[1]),
    ("at_laboratory_branch", |of| of.places[2]),
    ("at_customer_branch", |of| of.places[3]),
    ("elsewhere", |of| of.places[4]),
    ("value", |of| of.value),
    ("expanded", |of| of.expanded),
    ("low", |of| of.low),
    ("high", |of| of.high),
    ("remarks", |of| of.remarks),
    ("end", |of| of.end),
];

/// A stylesheet that converts any digital certificate of version 3 into a readable page, in each of
/// the languages of certificates; its parameter `lang` is a code of ISO 639-1.
pub fn dcc_stylesheet() -> String {
    let style = escaped(crate::page_style());
    let made = TEMPLATE
        .replace("@STYLE@", &style)
        .replace("{units:prefixes}", &prefixes())
        .replace("{units:symbols}", &symbols());
    WORDS.iter().fold(made, |made, (name, word)| {
        let of = |language: Language| escaped(word(words::of(language)));
        let others = [Language::German, Language::Italian, Language::French].map(|language| {
            let code = language.code();
            format!("<xsl:when test=\"$lang = '{code}'\">{}</xsl:when>", of(language))
        });
        let choice = format!(
            "<xsl:choose>{}<xsl:otherwise>{}</xsl:otherwise></xsl:choose>",
            others.concat(),
            of(Language::English)
        );
        made.replace(&format!("{{words:{name}}}"), &choice)
    })
}

/// A case of a choice by the name of a unit or of a prefix.
fn case(name: &str, symbol: &str) -> String {
    format!("<xsl:when test=\"$name = '{}'\">{}</xsl:when>", name.to_lowercase(), escaped(symbol))
}

/// The prefixes of D-SI with their symbols.
fn prefixes() -> String {
    let of = |prefix: &Prefix| {
        let symbol = if prefix.symbol() == "u" { "\u{b5}" } else { prefix.symbol() };
        prefix.macro_name().map(|name| case(name, symbol))
    };
    gumption_units::prefixes().filter_map(of).collect()
}

/// The units of D-SI with their typographic symbols.
fn symbols() -> String {
    let of = |symbol: &Symbol| {
        let name = symbol.dsi_name()?;
        Some(case(name, &unit_text(symbol.name())))
    };
    let others = [case("kilogram", "kg"), case("one", "1")].concat();
    gumption_units::symbols().filter_map(of).collect::<String>() + &others
}

/// A text escaped for XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It is well formed, every word is filled in, and it refers to nothing external.
    #[test]
    fn every_word_is_there() {
        let text = dcc_stylesheet();
        let read = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(read.root_element().tag_name().name(), "stylesheet");
        assert!(!text.contains("{words:") && !text.contains("@STYLE@"));
        assert!(text.contains("Kalibrierschein") && text.contains("Calibration certificate"));
        assert!(!text.contains("xsl:import") && !text.contains("document("));
    }
}
