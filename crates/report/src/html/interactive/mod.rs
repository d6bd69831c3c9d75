//! Pages with a script, where they are asked for: the values of points, sorted tables, enlarged
//! figures, and what one method found hidden. The page itself is the same to the byte, but for its
//! policy, which names the script by its digest and lets nothing else run.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::POLICY;

/// What runs.
const SCRIPT: &str = include_str!("script.js");

/// Its digest as a Content-Security-Policy names it: `script-src 'sha256-...'`. Who serves pages under
/// a policy of his own puts it there.
pub fn interactive_script_digest() -> String {
    let hex = gumption_text::bytes::sha256(SCRIPT.as_bytes());
    let bytes: Vec<u8> = (0..hex.len() / 2)
        .filter_map(|place| u8::from_str_radix(hex.get(2 * place..2 * place + 2)?, 16).ok())
        .collect();
    format!("sha256-{}", STANDARD.encode(bytes))
}

/// A page of this crate with the script; any other text as it is.
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
    use maud::html;

    /// Without the script and its place in the policy the page is the same to the byte.
    #[test]
    fn nothing_else_of_the_page_changes() {
        let plain = crate::html::page("A & B", &html! { p { "</body> as a text" } });
        let with = interactive(&plain);
        let script = format!("<script>{SCRIPT}</script>");
        let allowed = format!("; script-src '{}'", interactive_script_digest());
        assert_eq!(with.matches("<script").count(), 1);
        assert_eq!(with.replacen(&script, "", 1).replacen(&allowed, "", 1), plain);
        assert_eq!(interactive("no page"), "no page");
    }

    /// The digest is that of the bytes between the tags, so neither may be told from them; and nothing
    /// in the script loads or sends.
    #[test]
    fn the_script_stands_alone() {
        assert!(!SCRIPT.contains("</") && !SCRIPT.contains("<!--"));
        for word in
            ["fetch", "XMLHttpRequest", "import", "eval", "localStorage", "http", "innerHTML"]
        {
            assert!(!SCRIPT.contains(word), "{word}");
        }
        // of the empty text, from FIPS 180-4's published example of no bytes
        let empty = gumption_text::bytes::sha256(b"");
        assert!(empty.starts_with("e3b0c44298fc1c14"));
        assert_eq!(interactive_script_digest().len(), "sha256-".len() + 44);
    }
}
