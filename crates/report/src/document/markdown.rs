//! A document as GitHub shows it: GitHub Flavored Markdown, without HTML.

use super::beside::{FigureBeside, beside};
use super::{Block, Document};
use crate::number::align;
use crate::printed::{self, Notation, in_print};
use crate::sheet::{Sheet, SheetColumn};
use crate::table::one_line;

/// The whole document that `made` makes, in the notation of print, ending in a newline.
pub(crate) fn markdown(made: impl FnOnce() -> Document) -> String {
    in_print(Notation::Print, || written(&made(), escaped))
}

/// The same for a document whose texts come from this program and have code between backticks.
pub(crate) fn markdown_with_code(document: &Document) -> String {
    written(document, with_code)
}

/// A line for a signature: escaped, because a plain line of underscores would be a rule across the
/// page.
const RULE: &str = r"\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_\_";

/// A function that escapes markup in texts.
type Escape = fn(&str) -> String;

fn written(document: &Document, escape: Escape) -> String {
    let head = document.head.iter().flat_map(|head| head.text());
    let head: Vec<String> = head.map(|line| escape(&line)).collect();
    let mut parts = vec![head.join("  \n"), format!("# {}", escape(&document.title))];
    // two spaces at the end of a line break it
    let lines: Vec<String> = document.subtitle.iter().map(|line| escape(line)).collect();
    parts.push(lines.join("  \n"));
    parts.extend(document.written(|of| block(of, document.comma, escape)));
    parts.retain(|part| !part.is_empty());
    parts.join("\n\n") + "\n"
}

fn block(block: &Block, comma: bool, escape: Escape) -> String {
    match block {
        Block::Table(sheet) if comma => table(&sheet.clone().with_commas(), escape),
        Block::Section(title) => format!("## {}", escape(title)),
        Block::Text(text) => escape(text),
        Block::InLanguage(_, part) => self::block(part, comma, escape),
        Block::Verdict(sentences) => {
            let stressed = |(place, sentence): (usize, &String)| {
                let sentence = escape(sentence);
                if place == 0 { format!("> **{sentence}**") } else { format!("> {sentence}") }
            };
            let lines: Vec<String> = sentences.iter().enumerate().map(stressed).collect();
            lines.join("\n>\n")
        }
        Block::List(items) => {
            let items: Vec<String> =
                items.iter().map(|item| format!("- {}", escape(item))).collect();
            items.join("\n")
        }
        Block::Table(sheet) => table(sheet, escape),
        Block::Figure(drawing) => {
            beside(drawing).map_or_else(String::new, |of| figure(&of, escape))
        }
        Block::Characters(_) => String::new(),
        Block::Folded(title, blocks) => {
            let blocks = blocks.iter().map(|part| self::block(part, comma, escape));
            let parts: Vec<String> =
                std::iter::once(format!("{}:", escape(title))).chain(blocks).collect();
            parts.join("\n\n")
        }
        Block::Signature(places) => {
            let line = |place: &String| format!("{}: {RULE}", escape(place));
            places.iter().map(line).collect::<Vec<_>>().join("\n\n")
        }
        Block::End(text) => format!("— {} —", escape(text)),
        Block::Listing { about, text } => listing(about, text, escape),
    }
}

/// A figure above its caption.
fn figure(of: &FigureBeside<'_>, escape: Escape) -> String {
    let FigureBeside { number, name, caption } = of;
    let caption = escape(caption);
    format!("![Figure {number}]({name})\n\n**Figure {number}.** {caption}")
}

/// A table whose source is aligned too.
fn table(sheet: &Sheet, escape: Escape) -> String {
    let columns: Vec<Vec<String>> =
        sheet.columns.iter().map(|column| cells(column, escape)).collect();
    let rows = sheet.rows();
    let line = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
    let mut lines = Vec::with_capacity(rows + 2);
    lines.push(line(columns.iter().map(|cells| cells[0].clone()).collect()));
    let rules = sheet.columns.iter().zip(&columns).map(|(column, cells)| {
        let dashes = "-".repeat(cells[0].chars().count().max(2) - 1);
        if column.is_numeric() { format!("{dashes}:") } else { format!("{dashes}-") }
    });
    lines.push(line(rules.collect()));
    for row in 1..=rows {
        lines.push(line(columns.iter().map(|cells| cells[row].clone()).collect()));
    }
    lines.join("\n")
}

/// The header and the cells of a column, padded to one width.
fn cells(column: &SheetColumn, escape: Escape) -> Vec<String> {
    let numeric = column.is_numeric();
    let body: Vec<String> = column.cells.iter().map(|cell| escape(cell)).collect();
    let body = if numeric { align(&body) } else { body };
    let cells: Vec<String> = std::iter::once(escape(&column.title())).chain(body).collect();
    let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0).max(3);
    cells
        .into_iter()
        .map(|cell| if numeric { format!("{cell:>width$}") } else { format!("{cell:<width$}") })
        .collect()
}

/// A text unchanged, between fences that are longer than any in it.
fn listing(about: &str, text: &str, escape: Escape) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest.max(2) + 1);
    format!("{}\n\n{fence}\n{}\n{fence}", escape(about), text.trim_end())
}

/// A text without markup: on one line, with a backslash before characters that would be markup. An
/// underscore within a word is not markup.
fn escaped(text: &str) -> String {
    let text = printed::text(&one_line(text));
    let mut out = String::with_capacity(text.len());
    let mut before: Option<char> = None;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let in_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        let starts_list = before.is_none() && letters.peek().is_none_or(|next| *next == ' ');
        let means_something = match letter {
            '\\' | '`' | '*' | '[' | ']' | '<' | '>' | '|' | '~' | '$' | '&' => true,
            '_' => !(in_word(before) && in_word(letters.peek().copied())),
            '#' => before.is_none(),
            '-' | '+' if text.len() > 1 => starts_list,
            _ => false,
        };
        if means_something {
            out.push('\\');
        }
        out.push(letter);
        before = Some(letter);
    }
    out
}

/// A text with code between backticks, which is unchanged except for the bars that separate cells.
fn with_code(text: &str) -> String {
    let piece = |(place, piece): (usize, &str)| {
        if place % 2 == 0 { escaped(piece) } else { format!("`{}`", piece.replace('|', "\\|")) }
    };
    // the text around code is escaped piece by piece, so its blanks are kept here
    let pieces = text.split('`').enumerate().map(|(place, text)| {
        let blank = |has: bool| if has && place % 2 == 0 { " " } else { "" };
        let inner = piece((place, text));
        let lone = text.chars().all(char::is_whitespace);
        let (before, after) =
            (text.starts_with(char::is_whitespace), text.ends_with(char::is_whitespace));
        format!("{}{}{}", blank(before && place > 0), inner.trim(), blank(after && !lone))
    });
    pieces.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_text_is_markup() {
        assert_eq!(escaped("a_ref in m/s^2"), "a_ref in m/s^2");
        assert_eq!(escaped("_a_ * b | c"), r"\_a\_ \* b \| c");
        assert_eq!(escaped("1 < 2 & $x$ [a](b) `c`"), r"1 \< 2 \& \$x\$ \[a\](b) \`c\`");
        assert_eq!(escaped("# no title\nand no second line"), r"\# no title and no second line");
        assert_eq!(escaped("- no list"), r"\- no list");
        assert_eq!(escaped("-"), "-");
        assert_eq!(escaped("-3.5"), "-3.5");
    }

    #[test]
    fn code_stays_as_it_is() {
        assert_eq!(with_code("`a_b` or `x*y`, not <b>"), r"`a_b` or `x*y`, not \<b\>");
        assert_eq!(with_code("half `a|b`  `c` of it"), r"half `a\|b` `c` of it");
        assert_eq!(with_code("no code"), "no code");
    }

    #[test]
    fn tables_have_a_rule_and_cells_of_one_width() {
        let mut sheet = Sheet::default();
        sheet.text("name", ["x".to_owned(), "long | name".to_owned()]);
        sheet.numbers("standard\nuncertainty", ["1.5".to_owned(), "-".to_owned()]);
        insta::assert_snapshot!(table(&sheet, escaped), @r"
        | name         | standard uncertainty |
        | ------------ | -------------------: |
        | x            |                  1.5 |
        | long \| name |                  -   |
        ");
    }

    #[test]
    fn a_listing_cannot_be_ended_from_inside() {
        assert!(listing("text", "a\n````\nb", escaped).ends_with("\n`````\na\n````\nb\n`````"));
    }
}
