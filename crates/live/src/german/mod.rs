//! What the page says in German: the sentences and words of the reports, which are English, in their
//! places. What has no translation stays as it is; `tests` holds that nothing has none.

#[cfg(test)]
mod tests;
mod texts;

use texts::{BRIEF_LENGTH, TEXTS};

/// Whose words stand at the beginnings of a part's rows and at the lines of its figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RowNames {
    /// Names that the file gives: they stay.
    OfFile,
    /// The report's own words.
    OfReport,
}

/// Elements that hold a text of their own.
const HOLDERS: [&str; 13] =
    ["p", "figcaption", "th", "td", "li", "text", "title", "summary", "h2", "h3", "h4", "dt", "dd"];

/// Markup of a report with its texts in German.
pub(crate) fn part(html: &str, names: RowNames) -> String {
    let mut made = String::with_capacity(html.len() + html.len() / 8);
    let mut rest = html;
    while let Some((before, tag, inner, after)) = next_holder(rest) {
        made += &labelled(before);
        made += &of_holder(tag, inner, names);
        rest = after;
    }
    made + &labelled(rest)
}

/// Markup with the names of its figures, which only those hear who do not see them, in German.
fn labelled(markup: &str) -> String {
    const LABEL: &str = "aria-label=\"";
    let mut parts = markup.split(LABEL);
    let mut made = parts.next().unwrap_or("").to_owned();
    for part in parts {
        let (label, rest) = part.split_once('"').unwrap_or((part, ""));
        made += LABEL;
        made += &text_of(label).unwrap_or_else(|| label.to_owned());
        made += "\"";
        made += rest;
    }
    made
}

/// The next element that holds text: what comes before its content, its opening tag, its content, and
/// what follows that.
fn next_holder(html: &str) -> Option<(&str, &str, &str, &str)> {
    let mut from = 0;
    loop {
        let start = from + html.get(from..)?.find('<')?;
        let end = start + html.get(start..)?.find('>')?;
        let tag = html.get(start + 1..end)?;
        let name = tag.split([' ', '/']).next().unwrap_or("");
        from = end + 1;
        if tag.ends_with('/') || !HOLDERS.contains(&name) {
            continue;
        }
        let close = from + html.get(from..)?.find(&format!("</{name}>"))?;
        return Some((html.get(..from)?, tag, html.get(from..close)?, html.get(close..)?));
    }
}

fn of_holder(tag: &str, inner: &str, names: RowNames) -> String {
    let text = inner.trim();
    // the verdict's first sentence is strong as a whole
    if let Some(strong) = text.strip_prefix("<strong>").and_then(|t| t.strip_suffix("</strong>")) {
        return format!("<strong>{}</strong>", of_holder(tag, strong, names));
    }
    let is_name = tag.starts_with("text") || tag.contains("scope=\"row\"");
    let is_own = text.contains(' ') || text == "residual";
    if names == RowNames::OfFile && is_name && !is_own {
        return inner.to_owned();
    }
    // titles are the file's, except those that begin with words of the report
    if tag.starts_with('h') && !begins_like_a_title(text) {
        return inner.to_owned();
    }
    text_of(text).unwrap_or_else(|| inner.to_owned())
}

fn begins_like_a_title(text: &str) -> bool {
    let mut all = TEXTS.sentences.iter().filter_map(|sentence| sentence.pieces.first());
    all.any(|first| first.len() > 4 && text.starts_with(first.as_str()))
}

/// A text in German: a word, or sentences one after the other.
fn text_of(text: &str) -> Option<String> {
    // lines of a heading
    let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if let Some(word) = word(&flat).or_else(|| word(text)) {
        return Some(word.to_owned());
    }
    let mut made = String::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (said, behind) = sentence(rest)?;
        made += &said;
        let stop = behind.len() - behind.strip_prefix('.').unwrap_or(behind).trim_start().len();
        made += behind.get(..stop)?;
        rest = behind.get(stop..)?;
    }
    Some(made)
}

fn word(text: &str) -> Option<&'static str> {
    let mut all = TEXTS.words.iter().chain(&TEXTS.shapes);
    all.find(|(english, _)| english == text).map(|(_, german)| german.as_str())
}

/// The first sentence of a text in German, and what follows it.
fn sentence(text: &str) -> Option<(String, &str)> {
    let brief = if text.chars().count() <= BRIEF_LENGTH { TEXTS.brief.as_slice() } else { &[] };
    let all = TEXTS.sentences.iter().chain(brief);
    let mut all = all.filter(|sentence| sentence.least <= text.len());
    all.find_map(|sentence| {
        let (captured, rest) = fitted(&sentence.pieces, text)?;
        Some((filled(&sentence.german, &captured), rest))
    })
}

/// What stands between the pieces of a pattern at the beginning of a text, and what follows them:
/// nothing, or a full stop.
fn fitted<'t>(pieces: &[String], text: &'t str) -> Option<(Vec<&'t str>, &'t str)> {
    let (first, pieces) = pieces.split_first()?;
    let mut rest = beginning(text, first)?;
    let mut captured = Vec::new();
    if pieces.is_empty() {
        return ends(rest).then_some((captured, rest));
    }
    for (number, piece) in pieces.iter().enumerate() {
        let is_last = number + 1 == pieces.len();
        if is_last && piece.is_empty() {
            let whole = rest.strip_suffix('.').unwrap_or(rest);
            captured.push(whole);
            return Some((captured, rest.get(whole.len()..)?));
        }
        let found = rest
            .match_indices(piece.as_str())
            .find(|(at, _)| !is_last || ends(rest.get(at + piece.len()..).unwrap_or("")));
        let (at, _) = found?;
        captured.push(rest.get(..at)?);
        rest = rest.get(at + piece.len()..)?;
    }
    Some((captured, rest))
}

/// What follows a beginning, whose first letter may be a capital one.
fn beginning<'t>(text: &'t str, with: &str) -> Option<&'t str> {
    if let Some(rest) = text.strip_prefix(with) {
        return Some(rest);
    }
    let (mut own, mut wanted) = (text.chars(), with.chars());
    let same = own.next()?.to_lowercase().eq(wanted.next()?.to_lowercase());
    if same { own.as_str().strip_prefix(wanted.as_str()) } else { None }
}

/// Whether a sentence may end here.
fn ends(rest: &str) -> bool {
    rest.is_empty() || rest == "." || rest.starts_with(". ")
}

/// A German sentence with what varies in it.
fn filled(german: &str, captured: &[&str]) -> String {
    let mut made = String::new();
    let mut rest = german;
    while let Some((before, behind)) = rest.split_once('{') {
        made += before;
        let Some((place, after)) = behind.split_once('}') else { break };
        let digits = place.trim_end_matches([':', '+']);
        let text = digits.parse().ok().and_then(|place: usize| captured.get(place));
        let text = text.copied().unwrap_or("");
        made += &match place.strip_prefix(digits) {
            Some(":") => text_of(text).unwrap_or_else(|| with_commas(text)),
            Some("+") => with_commas(&joined_in_german(text)),
            _ => with_commas(text),
        };
        rest = after;
    }
    made + rest
}

/// A text with a decimal comma in its numbers. What is between backticks is code and unchanged.
fn with_commas(text: &str) -> String {
    let is_code = text.contains("<code>") || text.contains('`');
    if is_code { text.to_owned() } else { gumption_report::with_comma(text) }
}

/// An enumeration with German words between its names.
fn joined_in_german(text: &str) -> String {
    TEXTS
        .between
        .iter()
        .fold(text.to_owned(), |text, (english, german)| text.replace(english, german))
}
