//! The heading row of a budget: which column holds what, and in which unit.

use super::ask::{ReadSheet, beginning};
use super::both::sides;
use super::columns::{self, Column};
use super::concise::concise;
use super::coverage::{HeaderCoverage, Statement};
use super::grid::{Cells, is_empty};
use super::heading::unit_of_header;
use super::number::number_with_unit;
use super::options::ImportOptions;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_text::named_shape::NamedShape;
use gumption_text::workbook::letters;
use gumption_units::{Unit, listed};

/// The heading row of a budget.
#[derive(Clone, Debug)]
pub(super) struct Header {
    /// Its last line, from 0: that of the headings, or that of the units right below it.
    pub(super) line: usize,
    /// That of the headings.
    pub(super) first: usize,
    headings: Vec<String>,
    /// Places of columns with what they hold.
    pub(super) columns: Vec<(usize, Column)>,
    /// Columns that an option names.
    said: Vec<usize>,
    /// The units that columns state for their numbers.
    units: Vec<(usize, String)>,
}

/// The line of the headings: that of `--row heading=N`, or the first one that names the most columns, two at
/// least.
pub(super) fn line_of(cells: &Cells, options: &ImportOptions) -> Option<usize> {
    let said = options.rows.iter().find(|(kind, _)| kind == "heading");
    if let Some((_, number)) = said {
        let number: usize = number.trim().parse().ok()?;
        return number.checked_sub(1).filter(|line| *line < cells.lines());
    }
    let is_named = |text: &str| {
        let named = || options.columns.iter().any(|(_, said)| is_same(said, text));
        !text.trim().is_empty() && (cells.column(text).is_some() || named())
    };
    let score = |line: &usize| cells.row(*line).iter().filter(|cell| is_named(cell)).count();
    let best =
        (0..cells.lines()).map(|line| (score(&line), line)).rev().max_by_key(|scored| scored.0)?;
    (best.0 >= 2).then_some(best.1)
}

fn is_same(said: &str, heading: &str) -> bool {
    let plain = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    !heading.trim().is_empty() && plain(said) == plain(heading)
}

impl Header {
    /// The headings of a sheet; `None` after a mistake or a question.
    pub(super) fn of(sheet: &ReadSheet) -> Option<Self> {
        let cells = sheet.cells;
        let Some(line) = line_of(cells, sheet.options) else {
            let reason = "no budget is found: a row of headings names the columns, such as quantity, estimate, \
                          unit, standard uncertainty, half-width, U (k=2), distribution, divisor, sensitivity \
                          coefficient, degrees of freedom (or Größe, Schätzwert, Einheit, Halbbreite, \
                          Verteilung, Teiler; grandeur, estimation, unité, incertitude-type, loi, diviseur). \
                          Say which row has the headings with `--row heading=N`, and what other columns hold \
                          with `--column NAME=COLUMN`";
            sheet.fail(0, reason);
            return None;
        };
        let headings = cells.row(line).to_vec();
        let (columns, said) = (Vec::new(), Vec::new());
        let mut header = Self { line, first: line, headings, columns, said, units: Vec::new() };
        header.units_below(cells);
        header.said_columns(sheet)?;
        header.named_columns(sheet);
        header.units_of_columns(sheet);
        header.needs(sheet);
        header.repeated(sheet);
        sheet.log.is_clean().then_some(header)
    }

    /// The headings of a line with the columns that options name, as far as these are right.
    pub(super) fn said_only(cells: &Cells, line: usize, options: &ImportOptions) -> Self {
        let headings = cells.row(line).to_vec();
        let (columns, said) = (Vec::new(), Vec::new());
        let mut header = Self { line, first: line, headings, columns, said, units: Vec::new() };
        for (name, said) in &options.columns {
            if let (Some(column), &[place]) =
                (Column::named(name), header.places_of(said).as_slice())
            {
                header.columns.push((place, column));
            }
        }
        header
    }

    /// What the column of a place holds.
    pub(super) fn column_at(&self, place: usize) -> Option<Column> {
        self.columns.iter().find(|(own, _)| *own == place).map(|(_, column)| *column)
    }

    /// The columns that options name.
    fn said_columns(&mut self, sheet: &ReadSheet) -> Option<()> {
        let fail = |reason: String| {
            sheet.fail(self.first, reason);
            None
        };
        for (name, said) in &sheet.options.columns {
            let Some(column) = Column::named(name) else {
                return fail(format!(
                    "`--column {name}={said}`: there is no column `{name}`; there are {}",
                    Column::all_names()
                ));
            };
            let places = self.places_of(said);
            let &[place] = places.as_slice() else {
                let all: Vec<String> = (0..self.headings.len())
                    .filter(|place| !self.heading(*place).is_empty())
                    .map(|place| self.named(place))
                    .collect();
                let how = if places.is_empty() { "no column is" } else { "several columns are" };
                return fail(format!(
                    "`--column {name}={said}`: {how} called `{said}`; the columns are {}: say it by its letter \
                     or number",
                    listed(&all, " and ")
                ));
            };
            if let Some((_, other)) = self.columns.iter().find(|(own, _)| *own == place) {
                return fail(format!(
                    "{} cannot be both `{}` and `{}`",
                    self.named(place),
                    other.name(),
                    column.name()
                ));
            }
            if self.place(column).is_some() && !column.may_repeat() {
                return fail(format!("`--column {name}` is said twice"));
            }
            self.columns.push((place, column));
            self.said.push(place);
        }
        Some(())
    }

    /// The columns that a text of an option names: by the heading, else by a letter or a number.
    fn places_of(&self, said: &str) -> Vec<usize> {
        let same = |place: &usize| is_same(said, self.heading(*place));
        let by_heading: Vec<usize> = (0..self.headings.len()).filter(same).collect();
        let said = said.trim();
        // `#3` is the third one, whatever the headings are
        if let Some(number) = said.strip_prefix('#') {
            let place = number.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
            return place.into_iter().collect();
        }
        let letter = || {
            let digits = said.bytes().all(|byte| byte.is_ascii_alphabetic())
                && (1..=2).contains(&said.len());
            if !digits {
                return None;
            }
            let place = said.bytes().fold(0_usize, |place, byte| {
                26 * place + usize::from(byte.to_ascii_uppercase().saturating_sub(b'A')) + 1
            });
            Some(place)
        };
        let number = said.parse::<usize>().ok().or_else(letter);
        let place = number.and_then(|number| number.checked_sub(1));
        if by_heading.is_empty() { place.into_iter().collect() } else { by_heading }
    }

    /// The columns that the table of words names; what several name, and what none does, is asked.
    fn named_columns(&mut self, sheet: &ReadSheet) {
        let free: Vec<usize> = (0..self.headings.len())
            .filter(|place| !self.said.contains(place) && !self.heading(*place).is_empty())
            .collect();
        let mut by_words: Vec<(Column, Vec<usize>)> = Vec::new();
        for place in free {
            match sheet.cells.column(&self.headings[place]) {
                None => self.unknown(sheet, place),
                // an option has named the column of that kind
                Some(column) if self.place(column).is_some() && !column.may_repeat() => {
                    sheet.note(fact!("import.column-not-read", column = self.column(place)));
                    self.columns.push((place, Column::Ignored));
                }
                Some(column) => match by_words.iter_mut().find(|(own, _)| *own == column) {
                    Some((_, places)) => places.push(place),
                    None => by_words.push((column, vec![place])),
                },
            }
        }
        for (column, places) in by_words {
            if let [first, second, ..] = places[..]
                && !column.may_repeat()
            {
                let readings = [self.named(first), self.named(second)];
                sheet.ask(
                    self.first..=self.shown(sheet),
                    format!("two columns are headed as `{}`", column.name()),
                    readings.each_ref().map(String::as_str),
                    format!(
                        "`--column {}={}`, or take one away with `--column ignore={}`",
                        column.name(),
                        letters(first as u32),
                        letters(second as u32)
                    ),
                );
            }
            self.columns.extend(places.into_iter().map(|place| (place, column)));
        }
    }

    /// A column whose heading is not in the table: words are kept as remarks, and numbers and distributions
    /// are asked.
    fn unknown(&mut self, sheet: &ReadSheet, place: usize) {
        let comma = sheet.cells.decimal_comma();
        let texts: Vec<&str> = (self.line + 1..sheet.cells.lines())
            .map(|line| sheet.cells.text(line, place).trim())
            .filter(|text| !is_empty(text))
            .collect();
        let counts = |text: &&str| {
            let text = text.trim_start_matches(['±', ' ']);
            number_with_unit(text, comma).is_some()
                || Unit::parse(text).is_ok()
                || matches!(NamedShape::of(text), Some(of) if of != NamedShape::Unknown)
        };
        if !texts.iter().any(counts) {
            if !texts.is_empty() {
                sheet.note(fact!("import.column-remark", column = self.column(place)));
            }
            return self.columns.push((place, Column::Remark));
        }
        self.columns.push((place, Column::Ignored));
        let letter = letters(place as u32);
        sheet.ask(
            self.first..=self.shown(sheet),
            format!(
                "{} is headed by no word that is known, and has numbers, units or distributions",
                self.named(place)
            ),
            ["a column of the budget", "one that does not count"],
            format!(
                "`--column NAME={letter}` (NAME is one of {}), or `--column ignore={letter}`",
                Column::all_names()
            ),
        );
    }

    /// The last line that a question about columns shows.
    fn shown(&self, sheet: &ReadSheet) -> usize {
        (self.line + 2).min(sheet.cells.lines().saturating_sub(1)).max(self.first)
    }

    /// A line of units right below the headings, `;mm;µm;;`, belongs to them.
    fn units_below(&mut self, cells: &Cells) {
        let line = self.first + 1;
        let held: Vec<(usize, String)> = (0..cells.row(line).len())
            .map(|place| (place, cells.text(line, place).trim().to_owned()))
            .filter(|(_, text)| !is_empty(text))
            .collect();
        let line_of_units: Option<Vec<(usize, Option<String>)>> =
            held.iter().map(|(place, text)| Some((*place, symbol_or_unit(text)?))).collect();
        // one cell alone may be a row
        let Some(units) = line_of_units.filter(|_| held.len() > 1) else { return };
        self.line = line;
        self.units = units.into_iter().filter_map(|(place, unit)| Some((place, unit?))).collect();
    }

    /// The units of columns: of options, else of their headings.
    fn units_of_columns(&mut self, sheet: &ReadSheet) {
        for (name, unit) in &sheet.options.column_units {
            let place = Column::named(name).and_then(|column| self.place(column));
            let unit = unit.trim();
            match (place, Unit::parse(unit)) {
                (Some(place), Ok(_)) => {
                    self.units.retain(|(own, _)| *own != place);
                    self.units.push((place, unit.to_owned()));
                }
                (None, _) => {
                    sheet.fail(
                        self.first,
                        format!("`--column-unit {name}={unit}`: there is no column `{name}`"),
                    );
                }
                (_, Err(error)) => {
                    sheet.fail(self.first, format!("`--column-unit {name}={unit}`: {error}"));
                }
            }
        }
        let is_said = |column: Column| {
            sheet.options.column_units.iter().any(|(name, _)| Column::named(name) == Some(column))
        };
        for (place, column) in self.columns.clone() {
            if !column.has_unit() || is_said(column) {
                continue;
            }
            match (unit_of_header(self.heading(place), column.is_of_values()), self.unit(place)) {
                (Ok(None), _) => {}
                (Ok(Some(unit)), None) => self.units.push((place, unit)),
                (Ok(Some(unit)), Some(below)) if unit == below => {}
                (Ok(Some(unit)), Some(below)) => {
                    let below = below.to_owned();
                    self.ask_unit(sheet, place, column, [&unit, &below]);
                }
                (Err(reason), _) => {
                    let readings = ["a unit of the numbers", "a remark"];
                    let option = format!("`--column-unit {}=UNIT`", column.name());
                    sheet.ask(self.first..=self.shown(sheet), reason, readings, option);
                }
            }
        }
    }

    fn ask_unit(&self, sheet: &ReadSheet, place: usize, column: Column, units: [&str; 2]) {
        sheet.ask(
            self.first..=self.shown(sheet),
            format!("the heading and the line below it say two units for {}", self.named(place)),
            units,
            format!("`--column-unit {}=UNIT`", column.name()),
        );
    }

    /// Asks for the columns without which no budget is read, and for what divisors divide.
    fn needs(&self, sheet: &ReadSheet) {
        let names = [Column::Quantity, Column::Symbol, Column::Description];
        let lines = self.first..=self.shown(sheet);
        if names.iter().all(|name| self.place(*name).is_none()) {
            let about = "no column is known as that of the names of the quantities";
            sheet.ask(lines.clone(), about, [], "`--column quantity=COLUMN`");
        }
        let has = |column: Column| self.place(column).is_some();
        let in_estimates = self.place(Column::Estimate).is_some_and(|place| {
            let comma = sheet.cells.decimal_comma();
            (self.line + 1..sheet.cells.lines()).any(|line| {
                let text = sheet.cells.text(line, place);
                sides(text).is_some() || concise(text, comma).is_some()
            })
        });
        let has_width = in_estimates || Column::WIDTHS.into_iter().any(has);
        let has_std = has(Column::Standard) || has(Column::Relative);
        let has_limits = has(Column::Lower) && has(Column::Upper);
        if let Some(place) = self.place(Column::Deviation).filter(|_| !has_width && !has_std) {
            let letter = letters(place as u32);
            sheet.ask(
                lines.clone(),
                format!("{} holds standard deviations", self.named(place)),
                [
                    "those of means, which are standard uncertainties",
                    "those of single readings, which are divided by the root of their number",
                ],
                format!(
                    "`--column u={letter}`, or `--column uncertainty={letter}` with a column of divisors"
                ),
            );
        } else if !has_width && !has_std && !has_limits {
            let known: Vec<String> = self
                .columns
                .iter()
                .filter(|(_, column)| *column != Column::Ignored)
                .map(|(place, _)| self.named(*place))
                .collect();
            sheet.ask(
                lines.clone(),
                format!("none of {} holds an uncertainty by its heading", listed(&known, " and ")),
                [],
                "`--column u=COLUMN` (standard uncertainties), `--column U=COLUMN` (expanded), \
                 `--column half-width=COLUMN` or `--column uncertainty=COLUMN` (by the divisor or the \
                 distribution of the row)",
            );
        }
        if has(Column::Lower) != has(Column::Upper) {
            let about = "a lower and an upper limit belong together, and one of them has no column";
            sheet.ask(
                lines.clone(),
                about,
                [],
                "`--column lower=COLUMN` and `--column upper=COLUMN`",
            );
        }
        let of_divisors = [Column::Divisor, Column::Multiplier, Column::Factor];
        if let Some(place) = of_divisors.iter().find_map(|divisor| self.place(*divisor))
            && has_std
            && !has_width
            && !has_limits
        {
            let letter = letters(place as u32);
            let std = if has(Column::Standard) { Column::Standard } else { Column::Relative };
            let std = self.letter(std);
            sheet.ask(
                lines.clone(),
                format!(
                    "{} has what uncertainties are divided by, and no column of such is known",
                    self.named(place)
                ),
                [
                    &format!("what another column, or column {std}, is still to be divided by")
                        as &str,
                    "what is divided already",
                ],
                format!("`--column uncertainty=COLUMN`, or `--column ignore={letter}`"),
            );
        }
        for (place, column) in self.columns.iter().filter(|(_, column)| column.is_of_numbers()) {
            if Statement::of(self.heading(*place)).is_ok_and(|statement| statement.dof.is_some()) {
                let column = format!("{} `{}`", self.named(*place), column.name());
                let reason = format!("{column} states degrees of freedom in its heading");
                sheet.fail(self.first, format!("{reason}: write them into a column `dof`"));
            }
        }
        for column in [Column::Standard, Column::Relative, Column::HalfWidth, Column::FullWidth] {
            let Some(place) = self.place(column).filter(|place| !self.said.contains(place)) else {
                continue;
            };
            if let Some(k) =
                columns::coverage(self.heading(place)).factor(None).filter(|k| *k != 1.0)
            {
                sheet.ask(
                    lines.clone(),
                    format!(
                        "{} says a coverage factor, {}",
                        self.named(place),
                        gumption_engine::decimal::significant(k, 3)
                    ),
                    [
                        &format!("`{}`, without that factor", column.name()) as &str,
                        "expanded uncertainties with it",
                    ],
                    format!(
                        "`--column {}={1}` or `--column U={1}`",
                        column.name(),
                        letters(place as u32)
                    ),
                );
            }
        }
    }

    /// Refuses a second budget below or above this one.
    fn repeated(&self, sheet: &ReadSheet) {
        let cells = sheet.cells;
        let is_header = |line: &usize| {
            let same = |(place, _): &&(usize, Column)| {
                is_same(cells.text(*line, *place), self.heading(*place))
            };
            let same = self.columns.iter().filter(same).count();
            !(self.first..=self.line).contains(line)
                && same >= 3
                && 3 * same >= 2 * self.columns.len()
        };
        if let Some(line) = (0..cells.lines()).find(is_header) {
            let reason = format!(
                "line {} begins a second budget: keep one budget in a file, or on a sheet",
                line.max(self.first) + 1
            );
            sheet.fail(line.max(self.first), reason);
        }
    }

    /// The place of what is such a column.
    pub(super) fn place(&self, wanted: Column) -> Option<usize> {
        self.columns.iter().find(|(_, column)| *column == wanted).map(|(place, _)| *place)
    }

    /// How many columns the row of headings has.
    pub(super) fn width(&self) -> usize {
        self.headings.len()
    }

    /// Whether an option has named the column.
    pub(super) fn is_said(&self, place: usize) -> bool {
        self.said.contains(&place)
    }

    /// What the heading of a column says of the coverage of its numbers; nothing where an option has said what
    /// the column is and the rows say the rest.
    pub(super) fn coverage(&self, column: Column) -> HeaderCoverage {
        let place = self.place(column);
        let own = place.filter(|place| !(column == Column::Uncertainty && self.is_said(*place)));
        own.map_or(HeaderCoverage::None, |place| columns::coverage(self.heading(place)))
    }

    /// The words at the head of a column.
    pub(super) fn heading(&self, place: usize) -> &str {
        self.headings.get(place).map_or("", |heading| heading.trim())
    }

    /// The letter of what is such a column; empty where there is none.
    pub(super) fn letter(&self, wanted: Column) -> String {
        self.place(wanted).map_or_else(String::new, |place| letters(place as u32))
    }

    /// A column with its letter and its heading.
    pub(super) fn named(&self, place: usize) -> String {
        format!("column {} `{}`", letters(place as u32), self.heading(place))
    }

    /// The same as a part of a note.
    pub(super) fn column(&self, place: usize) -> Fact {
        let heading = beginning(self.heading(place));
        fact!("import.named-column", letter = letters(place as u32), heading)
    }

    /// The unit that a column states.
    pub(super) fn unit(&self, place: usize) -> Option<&str> {
        self.units.iter().find(|(own, _)| *own == place).map(|(_, unit)| unit.as_str())
    }

    /// The cell of a line in a column; empty where there is none.
    pub(super) fn cell<'c>(&self, cells: &'c Cells, line: usize, column: Column) -> &'c str {
        self.place(column).map_or("", |place| cells.text(line, place).trim())
    }
}

/// What a cell right below a heading says: a unit, `mV`, `in mV`, `[mV]`, `u_i / mV`; `Some(None)` of a symbol, and
/// `None` of anything else.
fn symbol_or_unit(text: &str) -> Option<Option<String>> {
    const LETTERS: [&str; 7] = ["a", "u", "U", "x", "X", "y", "k"];
    let is_symbol = |text: &str| columns::is_symbol(text) || LETTERS.contains(&text);
    let is_word = super::words::meaning("", text) == Some("unit");
    if is_symbol(text) || is_word {
        return Some(None);
    }
    let behind = text.split_once(['/', '[', '(']).filter(|(before, _)| is_symbol(before.trim()));
    let text = behind.map_or(text, |(_, behind)| behind);
    let bare = |text: &str| text.trim().trim_matches(['(', ')', '[', ']']).trim().to_owned();
    let text = bare(columns::without_in(&bare(text)));
    let is_number = text.starts_with(|c: char| c.is_ascii_digit()) && !text.starts_with("1/");
    (!is_number && !text.is_empty() && Unit::parse(&text).is_ok()).then_some(Some(text))
}
