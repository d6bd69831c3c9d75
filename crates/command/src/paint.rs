//! Formatting for terminals: width, bold titles, coloured verdicts.

use std::io::{self, IsTerminal};

use anstream::{AutoStream, ColorChoice};
use clap::ValueEnum;
use gumption_report::Screen;

/// Columns of an answer that does not go to a terminal.
const PIPED: usize = 100;

/// When there are colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum When {
    /// On a terminal, unless NO_COLOR is set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl When {
    /// Decides for the whole process.
    pub(super) fn choose(self) {
        let choice = match self {
            Self::Auto => return,
            Self::Always => ColorChoice::Always,
            Self::Never => ColorChoice::Never,
        };
        choice.write_global();
    }
}

/// The screen that pages are drawn for: the terminal, which shows the letters of print if its locale
/// is one of UTF-8.
pub(super) fn screen() -> Screen {
    if !io::stdout().is_terminal() {
        return Screen { columns: PIPED, shows_print: false };
    }
    let columns = terminal_size::terminal_size().map_or(PIPED, |(width, _)| usize::from(width.0));
    Screen { columns, shows_print: has_utf8() }
}

/// Whether the locale has UTF-8: the first variable that is set decides (POSIX, 8.2). Consoles of
/// Windows have it.
fn has_utf8() -> bool {
    let is_set = |name: &&&str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let Some(name) = ["LC_ALL", "LC_CTYPE", "LANG"].iter().find(is_set) else {
        return cfg!(windows);
    };
    let value = std::env::var(name).unwrap_or_default().to_ascii_lowercase();
    value.contains("utf-8") || value.contains("utf8")
}

/// Whether standard output takes colours.
pub(super) fn is_wanted() -> bool {
    AutoStream::choice(&io::stdout()) != ColorChoice::Never
}

const BOLD: &str = "\u{1b}[1m";
const GREEN: &str = "\u{1b}[32m";
const YELLOW: &str = "\u{1b}[33m";
const RED: &str = "\u{1b}[31m";
const PLAIN: &str = "\u{1b}[0m";

/// Verdicts and their colours. Longer words precede those that they contain.
const VERDICTS: [(&str, &str); 9] = [
    ("GUM interval is not validated", YELLOW),
    ("GUM interval not validated", YELLOW),
    ("GUM interval is validated", GREEN),
    ("Decision: accepted", GREEN),
    ("Decision: rejected", RED),
    ("undecided whether the GUM interval is validated", YELLOW),
    ("  not validated", YELLOW),
    (" not compatible", RED),
    ("There is a gap", BOLD),
];

/// A text page with bold titles and coloured verdicts.
pub(super) fn painted(page: &str) -> String {
    let lines: Vec<&str> = page.split('\n').collect();
    let is_rule = |line: &str| !line.is_empty() && line.chars().all(|c| matches!(c, '═' | '─'));
    let is_title = |place: usize| {
        let below = lines.iter().skip(place + 1).find(|line| line.is_empty() || is_rule(line));
        // a title may have several lines above its double rule
        if below.is_some_and(|rule| rule.starts_with('═')) {
            return !is_rule(lines[place]) && !lines[place].is_empty();
        }
        let next = lines.get(place + 1).is_some_and(|next| {
            is_rule(next) && next.chars().count() == lines[place].chars().count()
        });
        // a line with gaps is the head of a table
        next && !lines[place].contains("  ")
    };
    let painted = lines.iter().enumerate().map(|(place, line)| {
        if place == 0 || is_title(place) {
            return if line.is_empty() { String::new() } else { format!("{BOLD}{line}{PLAIN}") };
        }
        VERDICTS.iter().fold((*line).to_owned(), |line, (words, look)| match line.contains(words) {
            true => line.replace(words, &format!("{look}{words}{PLAIN}")),
            false => line,
        })
    });
    painted.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_bold_and_verdicts_coloured() {
        let page = "Title\nsettings\n\na_x in m\n════════\n\ninput  u\n────────\na      1\n\nThe GUM interval is not validated: so.\n";
        insta::assert_snapshot!(painted(page).replace('\u{1b}', "^"), @r"
        ^[1mTitle^[0m
        settings

        ^[1ma_x in m^[0m
        ════════

        input  u
        ────────
        a      1

        The ^[33mGUM interval is not validated^[0m: so.
        ");
    }
}
