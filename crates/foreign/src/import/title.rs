//! The title of a budget, and the unit that a line beside the table states for all of its values: `Budget (all
//! values in mV)`, `Einheit: mV`.

use super::ask::ReadSheet;
use super::columns::{self, Column};
use super::table::Header;
use super::words;
use gumption_units::Unit;

impl ReadSheet<'_> {
    /// The unit of all values by a line above or below the table.
    pub(super) fn unit_of_all(&self, header: &Header) -> Option<String> {
        self.units_of_all(header).into_iter().find_map(|(_, unit)| unit.ok())
    }

    /// What lines beside the table state as the unit of all values.
    fn units_of_all(&self, header: &Header) -> Vec<(usize, Result<String, String>)> {
        let is_ignored = |line: usize| {
            let of = |numbers: &str| {
                numbers.split(',').any(|number| number.trim() == (line + 1).to_string())
            };
            self.options.rows.iter().any(|(kind, numbers)| kind == "ignore" && of(numbers))
        };
        let of_line = |line: usize| {
            let cells = self.cells.row(line).iter().map(|cell| cell.trim());
            let held: Vec<&str> = cells.filter(|cell| !cell.is_empty()).collect();
            let is_beside = line < header.first || line > header.line && held.len() == 1;
            // `Unit` and `mV` in two cells
            let sign = if held.len() == 2 && !held[0].ends_with(':') { ": " } else { " " };
            let found = stated(&held.join(sign)).filter(|_| is_beside && !is_ignored(line))?;
            Some((line, found))
        };
        (0..self.cells.lines()).filter_map(of_line).collect()
    }

    /// The title above the table: what stands behind a label, `Title:`, else the first line of words;
    /// else what the file is called.
    pub(super) fn title(&self, header: &Header, file: &str) -> String {
        let lines: Vec<Vec<&str>> = (0..header.first)
            .map(|line| {
                let cells = self.cells.row(line).iter().map(|cell| cell.trim());
                cells.filter(|cell| !cell.is_empty()).collect()
            })
            .collect();
        let labelled = lines.iter().find_map(|held| match held[..] {
            [label, title] => is_label(label).then_some(title),
            [only] => {
                only.split_once(':').filter(|(label, _)| is_label(label)).map(|(_, title)| title)
            }
            _ => None,
        });
        let of_words = || {
            lines.iter().find_map(|held| match held[..] {
                [only] => is_title(only).then_some(only),
                _ => None,
            })
        };
        labelled
            .map(str::trim)
            .filter(|title| !title.is_empty())
            .or_else(of_words)
            .unwrap_or(file)
            .to_owned()
    }

    /// Asks where a line beside the table states the unit of all values, and it is not known.
    pub(super) fn unknown_units(&self, header: &Header) {
        for (line, unit) in self.units_of_all(header) {
            if let Err(word) = unit {
                self.ask(
                    line..=line,
                    format!("`{word}` may be the unit of all values, and is no unit that is known"),
                    ["the unit of the columns that state none", "a remark"],
                    format!("`--column-unit NAME=UNIT` with `--row ignore={}`", line + 1),
                );
            }
        }
    }

    /// Asks what is to become of statements of correlation, which are not read.
    pub(super) fn correlations(&self, header: &Header) {
        let is_said = |line: usize| {
            let of = |numbers: &str| {
                numbers.split(',').any(|number| number.trim() == (line + 1).to_string())
            };
            self.options.rows.iter().any(|(_, numbers)| of(numbers))
        };
        for line in
            (0..self.cells.lines()).filter(|line| !(header.first..=header.line).contains(line))
        {
            let names = [Column::Quantity, Column::Symbol, Column::Description];
            let is_name = |place: usize| {
                let of = |(at, column): &(usize, Column)| *at == place && names.contains(column);
                line > header.line
                    && self.has_uncertainty(header, line)
                    && header.columns.iter().any(of)
            };
            let mut cells = self.cells.row(line).iter().enumerate();
            let found =
                cells.find(|(place, cell)| columns::is_of_correlation(cell) && !is_name(*place));
            if let Some((_, cell)) = found.filter(|_| !is_said(line)) {
                self.ask(
                    line..=line,
                    format!("`{}` speaks of correlation, which is not read", cell.trim()),
                    ["a coefficient, which is written into the model file", "of no account"],
                    format!(
                        "`--row ignore={0}`, or `--row quantity={0}` for a quantity; a coefficient is written into \
                         the model file, `\"correlations\": [[\"a\", \"b\", r]]`",
                        line + 1
                    ),
                );
            }
        }
    }
}

/// Whether a cell is the label of a title: `Title`, `Titel:`.
fn is_label(cell: &str) -> bool {
    let word = cell.trim_end_matches(':').trim().to_lowercase();
    words::of("title:label").any(|known| known == word)
}

/// Whether a line of one cell is a title.
fn is_title(cell: &str) -> bool {
    !cell.contains('=')
        && cell.chars().filter(|c| c.is_alphabetic()).count() > 2
        && !columns::is_of_correlation(cell)
}

/// The unit that a text states for all values, or the word in its place that is none.
fn stated(text: &str) -> Option<Result<String, String>> {
    let clean = text.replace(['(', ')', '[', ']', ';', ','], " ");
    let words: Vec<&str> = clean.split_whitespace().collect();
    let small: Vec<String> =
        words.iter().map(|word| word.trim_matches(':').to_lowercase()).collect();
    let is = |meaning: &'static str, word: &str| words::of(meaning).any(|known| known == word);
    let unit = |text: &str| {
        let text = text.trim_end_matches(['.', ':', '!']);
        let is_known =
            text.parse::<f64>().is_err() && !text.is_empty() && Unit::parse(text).is_ok();
        is_known.then(|| text.to_owned()).or_else(|| columns::unit_as_meant(text))
    };
    for at in 1..words.len() {
        let before = small[..at - 1].iter().rev().find(|word| !is("title:between", word));
        let is_of_values = matches!(small[at - 1].as_str(), "in" | "en")
            && before.is_some_and(|word| is("title:before", word));
        let is_label = is("unit", &small[at - 1]) && words[at - 1].ends_with(':');
        let is_only = words.len() == at + 1 || is("title:behind", &small[at + 1]);
        if (is_of_values || is_label) && is_only {
            let is_word = words[at].chars().all(char::is_lowercase);
            return match unit(words[at]) {
                Some(unit) => Some(Ok(unit)),
                // `in general` is no unit
                None => (!is_word).then(|| Err(words[at].to_owned())),
            };
        }
    }
    None
}
