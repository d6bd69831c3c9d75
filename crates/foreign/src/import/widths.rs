//! The uncertainty of a row: what its cells, the heading and the distribution say of its kind.
//!
//! A stated divisor or coverage factor divides; without one the distribution says what a half-width is divided
//! by, and the heading the coverage factor. Two statements that differ are asked, and so is none.

use super::ask::{ReadSheet, beginning};
use super::columns::{self, Column};
use super::coverage::{HeaderCoverage, Statement};
use super::number::constant;
use super::rows::Row;
use super::table::Header;
use super::words;
use gumption_engine::fact;
use gumption_engine::number::Shortest;
use gumption_text::named_shape::NamedShape;
use gumption_text::workbook::letters;

/// Shapes that are stated by a half width, and the square of what that is divided by.
pub(super) const HALF_WIDTHS: [(&str, f64); 3] =
    [("rectangular", 3.0), ("triangular", 6.0), ("arcsine", 2.0)];

/// What a shape's half width is divided by.
pub(super) fn divisor_of(shape: &str) -> Option<f64> {
    HALF_WIDTHS.iter().find(|(name, _)| *name == shape).map(|(_, square)| square.sqrt())
}

/// Whether a divisor is a root, as two to four digits write it: 1.7, 1.73, 2.4.
pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.021 * b.abs()
}

/// What a row says of its distribution.
pub(super) struct StatedShape {
    /// One that a model file has.
    name: Option<&'static str>,
    pub(super) is_student: bool,
    statement: Statement,
}

impl StatedShape {
    /// Of the cell, or of `--distribution`; `None` after a mistake.
    pub(super) fn of(sheet: &ReadSheet, header: &Header, line: usize) -> Option<Self> {
        let cell = header.cell(sheet.cells, line, Column::Distribution);
        let is_stated = !super::grid::is_empty(cell);
        let text = match &sheet.options.distribution {
            Some(said) if !is_stated => said.as_str(),
            _ => cell,
        };
        let statement = match Statement::of(text) {
            Ok(statement) => statement,
            Err(reason) => {
                sheet.fail(line, reason);
                return None;
            }
        };
        if super::number::number(cell, sheet.cells.decimal_comma()).is_some() {
            let reason = format!("the number `{cell}` stands in the column of the distribution");
            sheet.fail(line, format!("{reason}: has the row a cell too much?"));
            return None;
        }
        let inside = statement.rest.split_once('(').map_or("", |(_, inside)| inside);
        if inside.contains(|c: char| c.is_ascii_digit()) {
            let reason = format!("what `{text}` says besides the distribution is not understood");
            sheet.fail(line, format!("{reason}: a coverage factor is written `normal (k=2)`"));
            return None;
        }
        let name = match NamedShape::of(text) {
            Some(NamedShape::Known(name)) => Some(name),
            _ => None,
        };
        let is_student = NamedShape::of(text) == Some(NamedShape::Student);
        Some(Self { name, is_student, statement })
    }

    /// What a half-width of it is divided by.
    fn root(&self) -> Option<f64> {
        self.name.and_then(divisor_of)
    }
}

/// A factor that a row states, and where.
struct StatedFactor {
    factor: f64,
    place: String,
}

impl ReadSheet<'_> {
    /// The divisor or coverage factor that the cells of a row state, if they agree; `Err` after a question.
    fn divisor(
        &self,
        header: &Header,
        line: usize,
        shape: &StatedShape,
        width: &str,
    ) -> Result<Option<f64>, ()> {
        let comma = self.cells.decimal_comma();
        let mut stated: Vec<StatedFactor> = Vec::new();
        for column in [Column::Divisor, Column::Factor, Column::Multiplier] {
            let text = header.cell(self.cells, line, column);
            let Some(place) = header.place(column).filter(|_| !super::grid::is_empty(text)) else {
                continue;
            };
            let Some(factor) = constant(text, comma).filter(|factor| *factor > 0.0) else {
                self.fail(
                    line,
                    format!("`{text}` in {} is no factor above 0", header.named(place)),
                );
                return Err(());
            };
            if column == Column::Divisor && factor < 0.999 {
                let letter = letters(place as u32);
                self.ask(
                    line..=line,
                    format!("the divisor {text} in {} is below 1", header.named(place)),
                    ["a factor that multiplies", "a divisor"],
                    format!("`--column multiplier={letter}`, or correct the number"),
                );
                return Err(());
            }
            let factor = if column == Column::Multiplier { 1.0 / factor } else { factor };
            stated.push(StatedFactor { factor, place: header.named(place) });
        }
        let of_cell = match Statement::of(width) {
            Ok(statement) => statement.coverage,
            Err(reason) => {
                self.fail(line, reason);
                return Err(());
            }
        };
        let names = [Column::Quantity, Column::Symbol, Column::Description, Column::Remark];
        let of_words = names.map(|column| {
            let text = header.cell(self.cells, line, column);
            (
                Statement::of(text).map_or(HeaderCoverage::None, |statement| statement.coverage),
                "the words",
            )
        });
        let said = [(of_cell, "the cell"), (shape.statement.coverage, "the distribution")];
        let said =
            said.into_iter().chain(of_words).filter_map(|(coverage, place)| match coverage {
                HeaderCoverage::Factor(factor) => {
                    Some(StatedFactor { factor, place: place.to_owned() })
                }
                _ => None,
            });
        stated.extend(said);
        let Some(first) = stated.first() else { return Ok(None) };
        if let Some(other) = stated.iter().find(|other| !near(other.factor, first.factor)) {
            self.ask(
                line..=line,
                "the row states two factors",
                [
                    &format!("{} of {}", Shortest(first.factor), first.place) as &str,
                    &format!("{} of {}", Shortest(other.factor), other.place),
                ],
                "`--column ignore=COLUMN` for the one that does not count, or correct the cell",
            );
            return Err(());
        }
        Ok(Some(first.factor))
    }

    /// Asks where the name or the distribution of a row speaks of a full width, and the column does not.
    fn is_half(&self, header: &Header, line: usize, column: Column) -> Option<()> {
        let is_said = header.place(column).is_some_and(|place| header.is_said(place));
        if column == Column::FullWidth || is_said {
            return Some(());
        }
        for column in [Column::Quantity, Column::Symbol, Column::Description, Column::Distribution]
        {
            let text = header.cell(self.cells, line, column);
            let small = text.to_lowercase();
            // a remark on the name, and no name: `Range of the meter`
            let behind = small.split_once(['(', '[', ',']).map_or("", |(_, behind)| behind);
            let whole = behind.trim_matches([' ', ')', ']']);
            if words::of("text:full-width").any(|word| whole == word || whole.starts_with(word)) {
                self.ask(
                    line..=line,
                    format!("`{text}` may say that the number of its row is no half-width"),
                    ["a half-width, or what the divisor divides", "a full width"],
                    "`--column half-width=COLUMN` or `--column full-width=COLUMN`",
                );
                return None;
            }
        }
        Some(())
    }

    /// Writes the width of a row in its own unit, with what it is divided by, into the row; nothing after a
    /// mistake or a question. `text` is the cell.
    pub(super) fn width(
        &self,
        header: &Header,
        row: &mut Row,
        column: Column,
        value: f64,
        text: &str,
        shape: &StatedShape,
    ) -> Option<()> {
        let line = row.line;
        self.is_half(header, line, column)?;
        let divisor = self.divisor(header, line, shape, text).ok()?;
        let root = shape.root();
        let of_heading = header.coverage(column);
        let letter = header.letter(column);
        let shape_words = shape.name.unwrap_or("an unknown distribution");
        row.width = Some(value);
        row.distribution = shape.name;
        let contradicts = |divisor: f64, half: &str| {
            self.ask(
                line..=line,
                format!("`{text}` is {shape_words}, and its divisor is {}", Shortest(divisor)),
                [
                    half,
                    &format!("what is divided by {}, whatever the distribution", Shortest(divisor))
                        as &str,
                ],
                "`--column ignore=COLUMN` for the column of the divisors or of the distributions",
            );
            None
        };
        let half_of_shape = format!(
            "the half-width of that distribution, to be divided by {}",
            match root {
                Some(root) => gumption_engine::decimal::significant(root, 4),
                None => "its own divisor".to_owned(),
            }
        );
        match (column, divisor, root) {
            (Column::FullWidth, divisor, Some(root)) => {
                row.width = Some(value / 2.0);
                match divisor {
                    Some(divisor) if !near(divisor, 2.0 * root) => {
                        return contradicts(divisor, "a full width of that distribution");
                    }
                    _ => {}
                }
            }
            (
                Column::HalfWidth | Column::Uncertainty | Column::Expanded,
                Some(divisor),
                Some(root),
            ) if near(divisor, root) => {
                if column != Column::HalfWidth
                    && let Some(k) = of_heading.factor(None).filter(|k| !near(*k, divisor))
                {
                    self.ask(
                        line..=line,
                        format!("the heading `{}` says k = {}, and the row another divisor, {}",
                            header.place(column).map_or("", |place| header.heading(place)), Shortest(k), Shortest(divisor)),
                        [&half_of_shape as &str, "an expanded uncertainty with the factor of the heading"],
                        format!("`--column uncertainty={letter}` (the rows say the divisors), or `--column ignore=COLUMN` for them"),
                    );
                    return None;
                }
            }
            // the divisor of a full width
            (Column::Uncertainty, Some(divisor), Some(root)) if near(divisor, 2.0 * root) => {
                row.width = Some(value / 2.0);
            }
            (_, Some(divisor), Some(_)) => return contradicts(divisor, &half_of_shape),
            (Column::HalfWidth, None, Some(_)) => {}
            (_, None, Some(_)) => {
                let said = of_heading != HeaderCoverage::None || column == Column::Expanded;
                if said {
                    self.ask(
                        line..=line,
                        format!("`{text}` is {shape_words} below a heading of expanded uncertainties"),
                        [&half_of_shape as &str, "an expanded uncertainty"],
                        format!("`--column half-width={letter}`, or write the distribution `normal` into the row"),
                    );
                    return None;
                }
            }
            (Column::FullWidth, ..) => {
                self.ask(
                    line..=line,
                    format!("the distribution of the full width `{text}` is not known"),
                    ["rectangular", "another one"],
                    "`--distribution rectangular`",
                );
                return None;
            }
            (Column::HalfWidth, None, None) => {
                self.ask(
                    line..=line,
                    format!("the half-width `{text}` has neither a divisor nor a distribution with limits"),
                    ["the half-width of a rectangular distribution", "an expanded or a standard uncertainty"],
                    format!("`--distribution rectangular` (of rows that name none), `--column U={letter}` with `--k 2`, or `--column u={letter}`"),
                );
                return None;
            }
            (_, Some(divisor), None) => {
                let of_heading = of_heading.factor(row.dof);
                if let Some(k) = of_heading.filter(|k| !near(*k, divisor))
                    && matches!(header.coverage(column), HeaderCoverage::Factor(_))
                {
                    self.ask(
                        line..=line,
                        format!("the heading says the factor {}, and the row {}", Shortest(k), Shortest(divisor)),
                        ["the factor of the heading", "that of the row"],
                        format!("`--column uncertainty={letter}` (the rows say the divisors), or `--column ignore=COLUMN` for them"),
                    );
                    return None;
                }
                row.divisor = Some(divisor);
            }
            (_, None, None) => return self.expanded(header, row, column, text, shape),
        }
        Some(())
    }

    /// The factor of a row without limits and without one of its own: that of the heading, of a stated
    /// probability, or of `--k`.
    fn expanded(
        &self,
        header: &Header,
        row: &mut Row,
        column: Column,
        text: &str,
        shape: &StatedShape,
    ) -> Option<()> {
        let line = row.line;
        let of_cell =
            Statement::of(text).map_or(HeaderCoverage::None, |statement| statement.coverage);
        let said = [of_cell, shape.statement.coverage, header.coverage(column)];
        let found = said.into_iter().find(|coverage| coverage.factor(None).is_some());
        if let Some(coverage) = found {
            row.divisor = coverage.factor(row.dof);
            row.probability = coverage.probability();
            return Some(());
        }
        let letter = header.letter(column);
        if column == Column::Expanded {
            if let Some(k) = self.options.k {
                row.divisor = Some(k);
                return Some(());
            }
            self.ask(
                line..=line,
                format!("the coverage factor of the expanded uncertainty `{text}` is not stated"),
                ["k = 2", "another factor"],
                "`--k 2`, or `--column k=COLUMN`",
            );
            return None;
        }
        self.ask(
            line..=line,
            format!("nothing says what kind of uncertainty `{text}` is"),
            [
                "a standard uncertainty",
                "an expanded uncertainty, with its coverage factor",
                "the half-width of a distribution",
            ],
            format!(
                "`--column u={letter}`; `--column U={letter}` and `--k 2`; or `--column half-width={letter}` and \
                 `--distribution rectangular`"
            ),
        );
        None
    }

    /// The degrees of freedom of a row: of their column, or beside a factor. `Err` after a mistake.
    pub(super) fn dof(
        &self,
        header: &Header,
        line: usize,
        shape: &StatedShape,
    ) -> Result<Option<f64>, ()> {
        let text = without_type(header.cell(self.cells, line, Column::Dof));
        let beside = shape.statement.dof;
        if super::grid::is_empty(text) {
            return Ok(beside);
        }
        if words::meaning("text", text) == Some("infinite") {
            return Ok(None);
        }
        let at_least = text.trim_start_matches(['>', '≥', '=', ' ']);
        let Some(dof) =
            super::number::number(at_least, self.cells.decimal_comma()).filter(|dof| *dof > 0.0)
        else {
            self.fail(line, format!("`{text}` is no number of degrees of freedom above 0"));
            return Err(());
        };
        if at_least.len() < text.len() {
            let text = beginning(text);
            self.note(fact!("import.dof", line = line + 1, dof, text));
        }
        if beside.is_some_and(|beside| beside != dof) {
            self.fail(line, format!("the row says {} degrees of freedom, and another number beside its distribution", Shortest(dof)));
            return Err(());
        }
        Ok(Some(dof).filter(|dof| *dof < 1e6))
    }
}

/// Degrees of freedom without the type of the evaluation, which is often said with them: `9 (A)`.
fn without_type(text: &str) -> &str {
    let of_type = |text: &str| {
        let (plain, inside) = text.strip_suffix(')')?.rsplit_once('(')?;
        let inside = inside.to_lowercase();
        let letter = inside.strip_prefix("type").or_else(|| inside.strip_prefix("typ"));
        matches!(letter.unwrap_or(&inside).trim(), "a" | "b").then_some(plain.len())
    };
    let text = text.trim();
    of_type(text).map_or(text, |length| text[..length].trim_end())
}

/// Whether a text in brackets behind a number is its coverage, `0.2 V (k=2)`.
pub(super) fn without_factor(text: &str) -> &str {
    let is_factor = |text: &str| columns::coverage(text).factor(None).is_some();
    text.split_once('(').filter(|_| is_factor(text)).map_or(text, |(before, _)| before.trim())
}
