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

    /// The keys of an object of a script, each with the number of objects that it lies in.
    fn keys(script: &str) -> Vec<(usize, String)> {
        let mut keys = Vec::new();
        let (mut depth, mut quote, mut word, mut begins) = (0, None, String::new(), false);
        let mut letters = script.chars().peekable();
        while let Some(letter) = letters.next() {
            if let Some(end) = quote {
                match letter {
                    '\\' => drop(letters.next()),
                    _ if letter == end => quote = None,
                    _ => {}
                }
                continue;
            }
            match letter {
                '/' if letters.peek() == Some(&'/') => {
                    letters.by_ref().find(|next| *next == '\n');
                }
                '"' | '`' => quote = Some(letter),
                ':' if begins && !word.is_empty() => keys.push((depth, std::mem::take(&mut word))),
                _ => {}
            }
            depth += usize::from(['{', '(', '['].contains(&letter));
            depth -= usize::from(['}', ')', ']'].contains(&letter));
            match letter {
                '{' | ',' => (begins, word) = (true, String::new()),
                _ if letter.is_whitespace() => {}
                _ if letter.is_alphanumeric() || letter == '_' => word.push(letter),
                _ => begins = false,
            }
        }
        keys
    }

    /// Every text that the page uses exists in every language, and there are no others; no key of the
    /// page stands twice, of which only the last one would count.
    #[test]
    fn all_languages_say_the_same() {
        let of = |name: &str| {
            let text = all().into_iter().find(|asset| asset.name == name).unwrap().text;
            let mut keys = keys(text);
            keys.sort();
            let twice = keys.windows(2).find(|pair| pair[0] == pair[1] && pair[0].0 == 1);
            assert_eq!(twice, None, "{name}");
            // the names of distributions are the English ones
            keys.retain(|(depth, _)| *depth == 1);
            keys
        };
        assert!(of("words.en.js").len() > 200, "{}", of("words.en.js").len());
        assert_eq!(of("words.en.js"), of("words.de.js"));
    }
}
