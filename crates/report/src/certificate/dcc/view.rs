//! A stylesheet (XSLT 1.0) that shows a digital certificate to people.

use crate::certificate::words::{self, Words};
use gumption_analysis::certificate::contents::Language;

/// The stylesheet, with places for words and for the style of pages.
const TEMPLATE: &str = include_str!("view.xsl");

/// A name in the template, and the word that stands for it.
type NamedWord = (&'static str, fn(&Words) -> &'static str);

/// The words that it takes from those of a certificate.
const WORDS: [NamedWord; 18] = [
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
    ("value", |of| of.value),
    ("expanded", |of| of.expanded),
    ("low", |of| of.low),
    ("high", |of| of.high),
    ("remarks", |of| of.remarks),
    ("end", |of| of.end),
];

/// A stylesheet that makes a page for people of any digital certificate of version 3, in each of the
/// languages that certificates can be written in; its parameter `lang` is a code of ISO 639-1.
pub fn dcc_stylesheet() -> String {
    let style = escaped(crate::page_style());
    let made = TEMPLATE.replace("@STYLE@", &style);
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

/// A text as it stands in XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It is well formed, every word is filled in, and it names nothing outside of itself.
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
