//! The page: one file of markup, a style sheet, scripts as modules. All files are static, and
//! nothing is loaded from elsewhere.

/// A file of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageAsset {
    /// Its name: the page itself is `index.html`, everything else is in `assets/`.
    pub name: &'static str,
    /// Its media type, for the header `Content-Type`.
    pub content_type: &'static str,
    /// Its text.
    pub text: &'static str,
}

macro_rules! assets {
    ($($name:literal: $kind:literal,)*) => {
        &[$(PageAsset {
            name: $name,
            content_type: $kind,
            text: include_str!(concat!("../page/", $name)),
        },)*]
    };
}

/// The files of the page, without the style of the reports' parts ([`all`]).
const OWN: &[PageAsset] = assets! {
    "index.html": "text/html; charset=utf-8",
    "style.css": "text/css; charset=utf-8",
    "answers.js": "text/javascript; charset=utf-8",
    "case.js": "text/javascript; charset=utf-8",
    "certificate-columns.js": "text/javascript; charset=utf-8",
    "certificate-rows.js": "text/javascript; charset=utf-8",
    "certificate.js": "text/javascript; charset=utf-8",
    "code.js": "text/javascript; charset=utf-8",
    "diagnosis.js": "text/javascript; charset=utf-8",
    "dialog.js": "text/javascript; charset=utf-8",
    "document.js": "text/javascript; charset=utf-8",
    "effects.js": "text/javascript; charset=utf-8",
    "equations.js": "text/javascript; charset=utf-8",
    "fields.js": "text/javascript; charset=utf-8",
    "files.js": "text/javascript; charset=utf-8",
    "form.js": "text/javascript; charset=utf-8",
    "import.js": "text/javascript; charset=utf-8",
    "mistakes.js": "text/javascript; charset=utf-8",
    "page.js": "text/javascript; charset=utf-8",
    "parts.js": "text/javascript; charset=utf-8",
    "pickers.js": "text/javascript; charset=utf-8",
    "print.js": "text/javascript; charset=utf-8",
    "result.js": "text/javascript; charset=utf-8",
    "slider.js": "text/javascript; charset=utf-8",
    "start.js": "text/javascript; charset=utf-8",
    "transport.js": "text/javascript; charset=utf-8",
    "words.de.js": "text/javascript; charset=utf-8",
    "words.en.js": "text/javascript; charset=utf-8",
    "worker.js": "text/javascript; charset=utf-8",
};

/// All files of the page.
pub fn all() -> Vec<PageAsset> {
    let report = PageAsset {
        name: "report.css",
        content_type: "text/css; charset=utf-8",
        text: gumption_report::page_style(),
    };
    OWN.iter().copied().chain([report]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every asset that the markup and the scripts name exists, and every existing one is named.
    #[test]
    fn every_asset_is_named_and_every_name_is_an_asset() {
        let names: Vec<&str> = all().iter().map(|asset| asset.name).collect();
        let texts: String = all().iter().map(|asset| asset.text).collect();
        for name in names.iter().filter(|name| **name != "index.html") {
            let named = [format!("\"assets/{name}\""), format!("\"./{name}\"")];
            assert!(named.iter().any(|named| texts.contains(named)), "{name}");
        }
        for part in texts.split("from \"./").skip(1) {
            let name = part.split('"').next().unwrap();
            assert!(names.contains(&name), "{name}");
        }
    }

    /// The policy allows no script and no style within the markup.
    #[test]
    fn the_markup_goes_with_the_policy() {
        let page = all().into_iter().find(|asset| asset.name == "index.html").unwrap().text;
        assert!(
            !page.contains(" style=") && !page.contains("<style") && !page.contains(" onclick")
        );
        for script in page.split("<script").skip(1) {
            assert!(script.starts_with(" type=\"module\" src=\"assets/"), "{script}");
        }
    }

    /// Every text that the page uses exists in every language, and there are no others.
    #[test]
    fn all_languages_say_the_same() {
        let keys = |name: &str| {
            let text = all().into_iter().find(|asset| asset.name == name).unwrap().text;
            let top = text.split("\n  key: {").next().unwrap();
            let mut keys: Vec<String> = Vec::new();
            let mut rest = top;
            // a key is a word before a colon, after a bracket, a comma or the beginning of a line
            while let Some(at) = rest.find(": ") {
                let word: String = rest[..at]
                    .chars()
                    .rev()
                    .take_while(|c| c.is_ascii_lowercase() || *c == '_' || c.is_ascii_digit())
                    .collect();
                let word: String = word.chars().rev().collect();
                let before = rest[..at - word.len()].trim_end().chars().next_back();
                if !word.is_empty() && matches!(before, Some(',' | '{')) {
                    keys.push(word);
                }
                rest = &rest[at + 2..];
            }
            keys.sort();
            keys
        };
        assert!(keys("words.en.js").len() > 80);
        assert_eq!(keys("words.en.js"), keys("words.de.js"));
    }
}
