//! Pages for a browser.

use crate::printed::in_file_notation;
use roxmltree::{Document, Node};

use super::super::html;
use super::*;

/// A page and its body.
fn page(diagnosis: &Diagnosis) -> (String, String) {
    with_body(html(diagnosis, &provenance()))
}

/// A page and its body, which is well-formed XML, loads nothing and runs nothing.
pub(super) fn with_body(page: String) -> (String, String) {
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"), "{page}");
    let from = page.find("<body>").unwrap();
    let to = page.find("</body>").unwrap() + "</body>".len();
    let body = page[from..to].to_owned();
    let document = parsed(&body);
    let all = || document.descendants().filter(Node::is_element);
    for element in all() {
        let name = element.tag_name().name();
        assert!(!["script", "iframe", "img", "link", "image", "use"].contains(&name), "{name}");
        for attribute in element.attributes() {
            let key = attribute.name();
            assert!(!key.starts_with("on") && !["src", "style"].contains(&key), "{key}");
            // only within the page
            assert!(key != "href" || attribute.value().starts_with("#section-"), "{attribute:?}");
            assert!(!attribute.value().contains("NaN"), "{attribute:?}");
        }
    }
    assert!(!text(document.root_element()).contains(",,"), "{body}");
    // nothing is loaded from elsewhere; the only address is the name of the drawings' language
    assert_eq!(page.matches("http").count(), 1 + all().filter(|e| e.has_tag_name(SVG)).count());
    assert!(!page.contains("<script") && !page.contains("url(") && !page.contains("@import"));
    (page, body)
}

pub(super) const SVG: (&str, &str) = ("http://www.w3.org/2000/svg", "svg");

pub(super) fn parsed(body: &str) -> Document<'_> {
    Document::parse(body).unwrap_or_else(|error| panic!("{error}:\n{body}"))
}

/// The text in an element, with single spaces and numbers in the notation of files.
pub(super) fn text(node: Node<'_, '_>) -> String {
    let parts = node.descendants().filter(Node::is_text).filter_map(|n| n.text());
    let words = parts.flat_map(str::split_whitespace);
    in_file_notation(&words.collect::<Vec<_>>().join(" "))
}

#[test]
fn numbers_are_those_of_the_json() {
    let diagnosis = diagnosis();
    let (_, body) = page(&diagnosis);
    let document = parsed(&body);
    let cells = |name: &str| -> Vec<String> {
        let rows = document.descendants().filter(|node| node.has_tag_name("tr"));
        let mut rows = rows.filter(|row| {
            row.children().find(Node::is_element).is_some_and(|first| text(first) == name)
        });
        // the hypothesis stands below the effect of the same name
        let row = rows.next_back().unwrap_or_else(|| panic!("{name} in {body}"));
        let numbers = row.children().filter(|cell| cell.attribute("class") == Some("number"));
        numbers.map(text).filter(|cell| !cell.is_empty() && cell != "-").collect()
    };
    let answer = json(&diagnosis);
    assert_agreement(&answer, &cells);
    assert_sentences(&answer, &text(document.root_element()));
    for needed in ["0123abcd", "4567", "data.csv, SHA-256", env!("CARGO_PKG_VERSION"), "95 %"] {
        assert!(body.contains(needed), "{needed}");
    }
}

#[test]
fn drawings_have_the_numbers_of_the_tables() {
    let (_, body) = page(&diagnosis());
    let document = parsed(&body);
    let drawings: Vec<String> = document
        .descendants()
        .filter(|node| node.has_tag_name(SVG) && node.attribute("class") == Some("wide"))
        .map(|drawing| {
            let texts = drawing.descendants().filter(|node| node.tag_name().name() == "text");
            texts.map(text).collect::<Vec<_>>().join("\n")
        })
        .collect();
    // data and sims of two outputs, the map, the bars, the intervals, the shrinkage, residuals and
    // predictions of two outputs
    assert_eq!(drawings.len(), 2 + 4 + 2 + 2);
    let drawings = &drawings[2..];
    for needed in ["A: p = 5.4e-49", "B: p = 0.012", "f in Hz", "tilt in deg"] {
        assert!(drawings[0].lines().any(|line| line == needed), "{needed}: {}", drawings[0]);
    }
    for needed in ["0.878", "0.110", "0.012", "low-pass + delay"] {
        assert!(drawings[1].lines().any(|line| line == needed), "{needed}: {}", drawings[1]);
    }
    assert!(drawings[2].contains("low-pass/fc in Hz"), "{}", drawings[2]);
    assert!(drawings[3].contains("4.49 → 1.06 u"), "{}", drawings[3]);
    assert!(drawings[4].contains("residual in m/s^2"), "{}", drawings[4]);
    let captions = document.descendants().filter(|node| node.has_tag_name("figcaption"));
    assert_eq!(captions.count(), 2 + drawings.len());
}

#[test]
fn nothing_is_drawn_outside() {
    for diagnosis in [diagnosis(), many(), hostile(), unexplained(), with_something_beside()] {
        assert_inside(&page(&diagnosis).1);
    }
}

/// Every drawing of a body stays within its frame.
pub(super) fn assert_inside(body: &str) {
    let document = parsed(body);
    for drawing in document.descendants().filter(|node| node.has_tag_name(SVG)) {
        let size: Vec<f64> =
            drawing.attribute("viewBox").unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
        let inside = |key: &str, most: f64| {
            let values = drawing.descendants().filter_map(|node| node.attribute(key));
            for value in values.filter_map(|value| value.parse::<f64>().ok()) {
                assert!((0.0..=most).contains(&value), "{key} = {value} of {most}");
            }
        };
        ["x", "x1", "x2", "cx"].iter().for_each(|key| inside(key, size[2]));
        ["y", "y1", "y2", "cy"].iter().for_each(|key| inside(key, size[3]));
    }
}

#[test]
fn names_are_texts_whatever_is_in_them() {
    let (page, body) = page(&hostile());
    assert!(page.contains("&lt;script&gt;"));
    let document = parsed(&body);
    let title = document.descendants().find(|node| node.has_tag_name("h1")).unwrap();
    assert!(text(title).starts_with("title<script>alert('&amp;')</script>\" [31m long-name"));
    // neither characters that a terminal obeys nor marks that turn the text around
    assert!(!page.contains(['\u{1b}', '\u{202e}']));
}

#[test]
fn what_is_hardly_there_has_a_page() {
    let (text, _) = page(&bare());
    assert!(text.contains("There is no gap") && !text.contains("NaN"), "{text}");
    let (text, _) = page(&unexplained());
    assert!(text.contains("none of the candidate effects explains it"), "{text}");
}

#[test]
fn many_rows_make_no_large_page() {
    let (page, _) = page(&many());
    // every figure is there once for a page and once for a narrow screen
    assert!(page.len() < 1_200_000, "{}", page.len());
    assert!(page.contains("Each stroke spans the residuals of neighbouring values."));
}

#[test]
fn the_same_diagnosis_gives_the_same_page() {
    assert_eq!(page(&diagnosis()).0, page(&diagnosis()).0);
}
