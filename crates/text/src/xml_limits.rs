//! Limits for XML documents. Parsers compare the attributes of an element, and the namespaces in
//! its scope, pairwise: their time grows at least with the square of the number. One pass checks
//! this before a parser sees the text.

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

/// Maximum number of attributes of an element, including declarations of namespaces.
const MOST_ATTRIBUTES: usize = 256;

/// Maximum nesting of elements.
const DEEPEST: usize = 256;

/// Maximum number of namespaces in scope of an element.
const MOST_NAMESPACES: usize = 64;

/// A limit that the document exceeds.
#[derive(Debug, PartialEq, Eq)]
pub struct Excess {
    /// The byte of the text at which the element begins.
    pub at: usize,
    /// What was found, and the limit.
    pub reason: String,
}

/// Checks an XML document; invalid XML is left to the reader.
///
/// # Errors
/// The first element that exceeds a limit.
pub fn check(text: &str) -> Result<(), Excess> {
    let mut xml = Reader::from_str(text);
    // the number of namespaces declared by each open element
    let mut open: Vec<usize> = Vec::new();
    let mut in_scope = 0;
    loop {
        let at = xml.buffer_position() as usize;
        let event = xml.read_event();
        let is_start = matches!(event, Ok(Event::Start(_)));
        match event {
            Ok(Event::Start(element) | Event::Empty(element)) => {
                let [attributes, namespaces] = counts(&element);
                let depth = open.len() + 1;
                let excess = [
                    (attributes, MOST_ATTRIBUTES, "attributes at one element"),
                    (depth, DEEPEST, "nested elements"),
                    (in_scope + namespaces, MOST_NAMESPACES, "namespaces for one element"),
                ];
                if let Some((found, most, what)) =
                    excess.into_iter().find(|(found, most, _)| found > most)
                {
                    let reason = format!(
                        "its XML has {found} {what} here; this version reads at most {most}"
                    );
                    return Err(Excess { at, reason });
                }
                if is_start {
                    open.push(namespaces);
                    in_scope += namespaces;
                }
            }
            Ok(Event::End(_)) => in_scope -= open.pop().unwrap_or(0),
            Ok(Event::Eof) | Err(_) => return Ok(()),
            Ok(_) => {}
        }
    }
}

/// How many attributes an element has, and how many of them declare a namespace.
fn counts(element: &BytesStart<'_>) -> [usize; 2] {
    let mut counts = [0; 2];
    // an error in one attribute does not end the others
    for attribute in element.attributes().with_checks(false) {
        counts[0] += 1;
        let declares = |key: &str| key == "xmlns" || key.starts_with("xmlns:");
        counts[1] += usize::from(attribute.is_ok_and(|attribute| declares(attribute.key.as_ref())));
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> Option<(usize, String)> {
        check(text).err().map(|Excess { at, reason }| (at, reason))
    }

    #[test]
    fn attributes_depth_and_namespaces_have_limits() {
        let attributes = |count: usize| -> String {
            (0..count).map(|n| format!(" a{n}=\"1\"")).collect::<String>()
        };
        assert_eq!(refused(&format!("<r><e{}/></r>", attributes(256))), None);
        let (at, reason) = refused(&format!("<r><e{}/></r>", attributes(20_000))).unwrap();
        assert_eq!(at, 3);
        assert_eq!(
            reason,
            "its XML has 20000 attributes at one element here; this version reads at most 256"
        );
        let nested = |depth: usize| format!("{}{}", "<e>".repeat(depth), "</e>".repeat(depth));
        assert_eq!(refused(&nested(256)), None);
        let (at, reason) = refused(&nested(257)).unwrap();
        assert_eq!(at, 768);
        assert!(reason.contains("257 nested elements here; this version reads at most 256"));
        let declared = |depth: usize| -> String {
            let open = (0..depth).map(|n| format!("<e xmlns:n{n}=\"u\">"));
            open.collect::<String>() + &"</e>".repeat(depth)
        };
        assert_eq!(refused(&declared(64)), None);
        for depth in [65, 200, 8000] {
            let (_, reason) = refused(&declared(depth)).unwrap();
            assert!(reason.contains("65 namespaces for one element here"), "{reason}");
        }
        // namespaces of an element end with it
        assert_eq!(refused(&format!("<r>{}</r>", declared(40).repeat(50))), None);
    }

    #[test]
    fn what_is_no_xml_is_not_told_here() {
        for text in ["", "<", "<a", "</a>", "<a b", "<a b=>", "text", "<a></b>", "\u{0}"] {
            assert_eq!(refused(text), None, "{text}");
        }
    }
}
