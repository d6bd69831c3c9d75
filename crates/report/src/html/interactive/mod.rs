//! Pages with a script, on request: values of points, sorted tables, enlarged figures, and hidden
//! results of a method. The page itself is the same to the byte, except for its policy, which names
//! the script by its digest and allows no other.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::POLICY;

/// What runs.
const SCRIPT: &str = include_str!("script.js");

/// Its digest in the form of a Content-Security-Policy: `script-src 'sha256-...'`. A server with
/// its own policy adds it there.
pub fn interactive_script_digest() -> String {
    let hex = gumption_text::bytes::sha256(SCRIPT.as_bytes());
    let bytes: Vec<u8> = (0..hex.len() / 2)
        .filter_map(|place| u8::from_str_radix(hex.get(2 * place..2 * place + 2)?, 16).ok())
        .collect();
    format!("sha256-{}", STANDARD.encode(bytes))
}

/// A page of this crate with the script; any other text is unchanged.
pub fn interactive(page: &str) -> String {
    let policy = format!("content=\"{POLICY}\"");
    let allowed = format!("content=\"{POLICY}; script-src '{}'\"", interactive_script_digest());
    match (page.split_once(&policy), page.rfind("</body>")) {
        (Some((before, rest)), Some(_)) => {
            let (body, end) = rest.rsplit_once("</body>").unwrap_or((rest, ""));
            format!("{before}{allowed}{body}<script>{SCRIPT}</script></body>{end}")
        }
        _ => page.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Foot;
    use maud::html;

    /// Without the script and its place in the policy the page is the same to the byte.
    #[test]
    fn nothing_else_of_the_page_changes() {
        let plain = crate::html::page_in(
            "en",
            "A & B",
            &Foot::of_title("A & B"),
            &html! { p { "</body> as a text" } },
        );
        let with = interactive(&plain);
        let script = format!("<script>{SCRIPT}</script>");
        let allowed = format!("; script-src '{}'", interactive_script_digest());
        assert_eq!(with.matches("<script").count(), 1);
        assert_eq!(with.replacen(&script, "", 1).replacen(&allowed, "", 1), plain);
        assert_eq!(interactive("no page"), "no page");
    }

    /// The digest covers the bytes between the tags, so the script must not contain either tag; and
    /// nothing in it loads or sends data.
    #[test]
    fn the_script_stands_alone() {
        assert!(!SCRIPT.contains("</") && !SCRIPT.contains("<!--"));
        for word in
            ["fetch", "XMLHttpRequest", "import", "eval", "localStorage", "http", "innerHTML"]
        {
            assert!(!SCRIPT.contains(word), "{word}");
        }
        // digest of the empty text, from FIPS 180-4's published example without bytes
        let empty = gumption_text::bytes::sha256(b"");
        assert!(empty.starts_with("e3b0c44298fc1c14"));
        assert_eq!(interactive_script_digest().len(), "sha256-".len() + 44);
    }
}
