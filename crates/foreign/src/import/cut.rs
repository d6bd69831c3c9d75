//! Equations that a text has in several cells, as its separator stands in them: `y = x - 0,5*z` between
//! commas is `y = x - 0` and `5*z`.

use super::columns::identifier;
use super::equation::{is_of_uncertainties, readable, with_points};
use super::grid::Cells;
use super::number::number_with_unit;
use gumption_columns::separator::Separator;
use gumption_engine::model::formula::{Formula, check_name};
use gumption_units::Unit;

/// An equation is in fewer cells than these.
const MOST_CELLS: usize = 10;

/// A cell with an equation, and what it may be with the cells behind it.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    line: usize,
    place: usize,
    /// As it stands in the text, with the cells that it may go on in.
    whole: String,
    /// The names that make one equation of them.
    names: Vec<String>,
}

impl Cut {
    /// That of the equation `text` in a cell.
    pub(super) fn of(cells: &Cells, line: usize, place: usize, text: &str) -> Option<Self> {
        let (left, right) = text.split_once('=')?;
        // without a name it is another mistake
        let is_named = check_name(&identifier(left)).is_ok() && !is_of_uncertainties(left, right);
        let next = cells.row(line).get(place + 1).filter(|next| is_named && !next.is_empty())?;
        let is_digit = |c: char| c.is_ascii_digit();
        let is_number = cells.separator() == Some(Separator::Comma)
            && ends_with_whole_number(text)
            && next.starts_with(is_digit);
        let alone = readable(right, cells.decimal_comma());
        let begin = cells.text(line, place).len() - text.len();
        let run_on = |count: usize| {
            let joined = cells.run_on(line, place, count)?;
            Some(joined.get(begin..)?.trim().to_owned())
        };
        let counts = 1..(cells.row(line).len() - place).min(MOST_CELLS);
        let read = counts.map_while(run_on).find_map(|whole| {
            let (_, right) = whole.split_once('=')?;
            let points = with_points(right);
            let formula = readable(if is_number { &points } else { right }, false)?;
            let names = names_of(&formula);
            (!names.is_empty() && (is_number || alone.is_none())).then_some(Self {
                line,
                place,
                whole,
                names,
            })
        });
        read.or_else(|| {
            // `y = x - 0,5 z`, but not `n = 10,5 V` beside it
            let is_value = number_with_unit(next, false)
                .is_some_and(|(_, unit)| unit.is_empty() || Unit::parse(unit).is_ok());
            let own = alone.map(|formula| names_of(&formula)).unwrap_or_default();
            let words = next.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            let others = words.map(|word| word.trim_start_matches(is_digit).to_owned());
            let names: Vec<String> = match is_value {
                true => own,
                false => own.into_iter().chain(others).collect(),
            };
            Some(Self { line, place, whole: run_on(1).filter(|_| is_number)?, names })
        })
    }

    /// The line and what is wrong, where the equation is one of these quantities.
    pub(super) fn fault(&self, known: &[String]) -> Option<(usize, String)> {
        let is_of_them = self.names.iter().any(|name| known.contains(name));
        is_of_them.then(|| {
            let whole = &self.whole;
            let reason = format!(
                "`{whole}` can be one equation or several cells: put an equation in quotation marks, with \
                 decimal points, `\"{}\"`",
                with_points(whole)
            );
            (self.line, reason)
        })
    }

    /// The same of a statement such as `y = 14,05`, where the name of a row may stand: the row would be
    /// `y = 14` of 5.
    pub(super) fn fault_of_row(
        &self,
        is_name: impl Fn(usize, usize) -> bool,
    ) -> Option<(usize, String)> {
        let (name, right) = self.whole.split_once('=')?;
        let begin = right.split_once(',').map_or(right, |(begin, _)| begin);
        let is_statement = !begin.contains(char::is_alphabetic) && !name.trim().contains(' ');
        (is_statement && is_name(self.line, self.place)).then(|| {
            let whole = &self.whole;
            let reason = format!(
                "`{whole}` can be one number or two cells: put a statement in quotation marks, with a \
                 decimal point, `\"{}\"`",
                with_points(whole)
            );
            (self.line, reason)
        })
    }
}

/// Whether a text ends with digits that a decimal comma may follow: no part of a name, `x1`, and no decimals.
fn ends_with_whole_number(text: &str) -> bool {
    let digits = text.len() - text.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let before = &text[..text.len() - digits];
    let goes_on = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | ',');
    digits > 0 && !before.ends_with(goes_on)
}

fn names_of(formula: &str) -> Vec<String> {
    let formula = Formula::parse(formula).ok();
    formula.iter().flat_map(Formula::names).map(|(name, _)| name.to_owned()).collect()
}
