//! The rows of a budget: what their cells say, and what has to be guessed.

use gumption_engine::decimal::{significant, to_15_digits};
use gumption_engine::model::formula::{Formula, check_name};
use gumption_engine::number::Shortest;
use gumption_units::{Dimension, Unit};

use super::columns::{self, Column, Header};
use super::concise::concise;
use super::coverage::{HeaderCoverage, Statement};
use super::linear::{CONTRIBUTIONS_DIFFER, standard_uncertainty};
use super::negligible::{self, is_negligible};
use super::stated::{Stated, half_digit};
use super::{Budget, equation, number};
use gumption_columns::separator::Separator;
use gumption_text::named_shape::NamedShape;
use gumption_text::share::{self, Share};
use gumption_text::value_text::grouped_digits;
use gumption_text::width::Width;

/// A row of the budget.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    pub(super) line: usize,
    /// The name in formulas.
    pub(super) name: String,
    /// The words of the sheet.
    pub(super) about: String,
    pub(super) estimate: Option<f64>,
    pub(super) unit: String,
    pub(super) width: Option<f64>,
    pub(super) std: Option<f64>,
    pub(super) distribution: Option<&'static str>,
    pub(super) divisor: Option<f64>,
    /// The coverage probability that the divisor is of, where no factor is stated.
    pub(super) probability: Option<f64>,
    pub(super) sensitivity: Option<f64>,
    /// As the sheet writes it; empty where it does not.
    pub(super) unit_of_sensitivity: String,
    pub(super) dof: Option<f64>,
    /// Whether the sheet says that its evaluation is of type A (JCGM 100, 4.2).
    pub(super) is_type_a: bool,
    /// Whether it is a figure of the result: `U`, `k`.
    pub(super) is_summary: bool,
    /// Of the result: what the sheet says of it.
    pub(super) figures: Vec<Stated>,
}

/// What a sheet holds below its header.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    pub(super) rows: Vec<Row>,
    pub(super) result: Option<Row>,
    /// What it says of the result.
    pub(super) stated: Vec<Stated>,
    /// Its coverage factor.
    pub(super) factor: Option<f64>,
}

/// Whether a row has no uncertainty, coefficient or shape.
fn is_bare_of(row: &Row) -> bool {
    row.width.is_none()
        && row.std.is_none()
        && row.sensitivity.is_none()
        && row.distribution.is_none()
}

/// Whether a row has neither an estimate nor a coefficient, a shape or a divisor.
fn is_bare_of_shape(row: &Row) -> bool {
    row.estimate.is_none()
        && row.sensitivity.is_none()
        && row.distribution.is_none()
        && row.divisor.is_none()
}

impl Budget<'_> {
    /// The rows of the quantities, and what the sheet says of the result; `used` are the names that
    /// the equations need.
    pub(super) fn rows(
        &mut self,
        header: &Header,
        measurand: Option<&str>,
        used: &[String],
    ) -> Table {
        let mut table = Table::default();
        let is_uncertain = |line: &usize| {
            let of = |column| header.cell(self.cells, *line, column).trim();
            Column::UNCERTAIN.iter().any(|column| !is_empty(of(*column)))
        };
        let last_uncertain = (header.line + 1..self.cells.lines()).rev().find(is_uncertain);
        let mut empty = 0;
        for line in header.line + 1..self.cells.lines() {
            let label = header.cell(self.cells, line, Column::Quantity).trim().to_owned();
            let is_blank = self.cells.row(line).iter().all(|cell| cell.trim().is_empty());
            if is_blank {
                // a budget may have one empty line, not two
                empty += 1;
                continue;
            }
            let is_below = empty > 1 && !table.rows.is_empty();
            if !is_below {
                empty = 0;
            }
            let symbol = header.cell(self.cells, line, Column::Symbol).trim().to_owned();
            let is_sentence = label.contains('=') && self.is_alone(header, line);
            // `P = P1 + A` with a unit beside it is the row of the result
            let left = label.split('=').next().filter(|_| !is_sentence).unwrap_or(&label);
            let is_measurand = [left, &symbol]
                .into_iter()
                .any(|words| measurand.is_some_and(|name| columns::identifier(words) == name));
            let words = if symbol.is_empty() { &label } else { &symbol };
            // a symbol of results may be that of a quantity: `U` of a voltage, `p` of a pressure
            let is_after = last_uncertain.is_some_and(|last| line > last);
            let is_symbol = !used.contains(&columns::identifier(words))
                && (columns::is_combined_symbol(words)
                    && (!self.is_quantity(header, line)
                        || self.lacks_shape(header, line)
                        || !header.has(Column::Estimate))
                    || columns::is_summary_symbol(words)
                        && (self.is_bare(header, line) && is_after
                            || self.is_figure(header, line, table.rows.len())));
            let is_y = matches!(words.as_str(), "y" | "Y")
                && !used.contains(words)
                && self.lacks_shape(header, line);
            let is_result = columns::is_result(&label)
                || columns::is_expanded_symbol(words)
                || is_measurand
                || is_y;
            if !is_result && columns::is_subtotal(&label) {
                let text = format!("line {}: `{label}` is a sum of other rows; left out", line + 1);
                self.guessed.push(text);
                continue;
            }
            if is_below && !is_result && !is_symbol {
                self.guessed.push(format!(
                    "line {}: `{}` stands below the table and is not taken",
                    line + 1,
                    self.cells
                        .row(line)
                        .iter()
                        .map(|cell| cell.trim())
                        .find(|cell| !cell.is_empty())
                        .unwrap_or_default()
                ));
                continue;
            }
            // told apart from the rows; a quantity may have such words in its name or a remark
            let speaks = self.cells.row(line).iter().any(|cell| columns::is_of_correlation(cell));
            if (is_sentence && !is_result) || (speaks && !self.is_quantity(header, line)) {
                continue;
            }
            let row = self.row(header, line, label.clone(), is_result || is_symbol);
            let is_factor = columns::is_factor(words)
                && (is_bare_of(&row) || words.chars().count() > 1 && row.sensitivity.is_none());
            if is_factor && row.unit.is_empty() {
                let known = row.estimate.or(row.divisor).or(row.std).or(row.width);
                table.factor = table.factor.or(known.filter(|factor| *factor > 0.0));
                let text = format!("line {}: `{words}` is a coverage factor, not taken", line + 1);
                self.understood.push(text);
                continue;
            }
            if columns::is_effective_dof(words) && !self.is_quantity_with_unit(&row) {
                self.understood.push(format!(
                    "line {}: `{words}` are those of the result, and not compared",
                    line + 1
                ));
                continue;
            }
            let nothing = row.estimate.is_none() && row.width.is_none() && row.std.is_none();
            if label.is_empty() && nothing {
                continue;
            }
            let is_nameless = label.is_empty() && symbol.is_empty() && !table.rows.is_empty();
            if is_nameless && is_bare_of_shape(&row) {
                let reason = "a row without a name has an uncertainty alone, which may be the combined one of the \
                              rows above: write `Combined` or `Expanded (k=2)`, or the name of the quantity";
                self.fail(line, reason.to_owned());
                continue;
            }
            if is_result || is_symbol {
                self.surplus(header, line);
                table.stated.extend(self.stated(header, line, &row));
                let mut row = row;
                if is_y {
                    row.name = columns::identifier(words);
                }
                let is_figure = columns::is_expanded_symbol(words) && row.estimate.is_none();
                self.result_row(&mut table, row, is_symbol || is_figure);
                continue;
            }
            let is_unit_of_result =
                nothing && is_after && measurand.is_none() && table.result.is_none();
            if is_unit_of_result && !row.unit.is_empty() {
                self.guessed.push(format!(
                    "line {}: `{label}` has a unit and no numbers, and is taken for the result",
                    line + 1
                ));
                let name = columns::identifier(words);
                table.result = Some(Row { name, ..row });
                continue;
            }
            if nothing && self.names_quantities(&label, &table.rows) {
                let reason = format!(
                    "`{label}` may be the equation of the result: write `y = {label}`, with its name"
                );
                self.fail(line, reason);
                continue;
            }
            if nothing {
                self.guessed.push(format!("line {}: `{label}` has no numbers; left out", line + 1));
                continue;
            }
            self.surplus(header, line);
            let mut row = row;
            let plain = columns::with_unit_in_brackets(words);
            let words = plain.as_ref().map_or(words.as_str(), |(name, _)| *name);
            row.name = self.name(words, &table.rows, line, used);
            self.divided(header, &row);
            self.coverage(header, &mut row);
            self.concise(header, &mut row);
            self.contradictions(&row);
            table.rows.push(row);
        }
        self.factor_of_heading(header, &table.rows);
        // an equation names its result itself
        if table.result.as_ref().is_none_or(|result| result.is_summary)
            && table.rows.last().is_none_or(|last| !used.contains(&last.name))
            && let Some(reason) = self.last_is_result(header, &table.rows)
            && (measurand.is_none() || reason == NO_UNCERTAINTY)
            && let Some(last) = table.rows.pop()
        {
            self.guessed.push(format!(
                "line {}: `{}` {reason} and is taken for the result",
                last.line + 1,
                last.name
            ));
            table.stated.extend(self.stated(header, last.line, &last));
            table.result = Some(last);
        } else if measurand.is_none()
            && table.result.as_ref().is_none_or(|result| result.is_summary)
            && let Some(signs) = self.signs(header, &table.rows)
            && let Some(mut last) = table.rows.pop()
        {
            self.difference(&mut table.rows, &mut last, &signs);
            table.stated.extend(self.stated(header, last.line, &last));
            table.result = Some(last);
        }
        self.deviations(header, &table.rows);
        self.blank_estimates(header, &table.rows);
        self.blank_uncertainties(header, &table.rows);
        self.stated_twice(header, &table.rows);
        if let Some(result) = &mut table.result {
            result.figures.clone_from(&table.stated);
            if columns::is_result(&result.about) || result.is_summary {
                result.name = String::new();
            }
        }
        table
    }

    /// Whether words can be read as a formula of two quantities of the sheet at least, `A-B`.
    fn names_quantities(&self, words: &str, rows: &[Row]) -> bool {
        let Some(formula) = equation::readable(words, self.cells.decimal_comma()) else {
            return false;
        };
        let names = Formula::parse(&formula).map_or(0, |formula| {
            let is_known = |name: &str| rows.iter().any(|row| row.name == name);
            let names: Vec<bool> = formula.names().map(|(name, _)| is_known(name)).collect();
            if names.iter().all(|known| *known) { names.len() } else { 0 }
        });
        names > 1
    }

    /// Says how standard deviations are taken where nothing tells whether they are those of single readings.
    fn deviations(&mut self, header: &Header, rows: &[Row]) {
        let heading = header.heading_of(Column::Std).trim();
        if columns::is_deviation(heading) && rows.iter().any(|row| row.std.is_some()) {
            self.guessed.push(format!(
                "`{heading}` is taken for the standard uncertainties: where it is of single readings, divide it \
                 by the root of their number"
            ));
        }
    }

    /// Says which quantities have no estimate where others have one.
    fn blank_estimates(&mut self, header: &Header, rows: &[Row]) {
        if !header.has(Column::Estimate) || rows.iter().all(|row| row.estimate.is_none()) {
            return;
        }
        for row in rows.iter().filter(|row| row.estimate.is_none()) {
            self.guessed.push(format!(
                "line {}: `{}` has no estimate, and 0 is taken, as of a correction",
                row.line + 1,
                row.name
            ));
        }
    }

    /// Says which quantities have no uncertainty; of a shape without one that is told already.
    fn blank_uncertainties(&mut self, header: &Header, rows: &[Row]) {
        let is_blank =
            |row: &&Row| row.width.is_none() && row.std.is_none() && row.distribution.is_none();
        for row in rows.iter().filter(is_blank) {
            let column = Column::UNCERTAIN.into_iter().find(|column| header.has(*column));
            self.guessed.push(format!(
                "line {}: `{}` has no uncertainty below `{}` and is taken for a constant",
                row.line + 1,
                row.name,
                column.map_or("", |column| header.heading_of(column)).trim()
            ));
        }
    }

    /// Refuses a row of which two columns that may hold the same thing say something else.
    fn stated_twice(&self, header: &Header, rows: &[Row]) {
        let comma = self.cells.decimal_comma();
        let number = |text: &str| {
            let text = without_factor(without_sign(text));
            let read = number::number_with_unit(text, comma);
            let read = read.map(|(value, unit)| (value, unit.to_owned()));
            read.or_else(|| Some((number::constant(text, comma)?, String::new())))
        };
        for (place, column) in header.others_of_known_kinds() {
            let own = header.heading_of(column).trim();
            for row in rows {
                let text = self.cells.text(row.line, place);
                let Some((second, unit)) = number(text) else { continue };
                let first = header.cell(self.cells, row.line, column).trim();
                let differs = match number(first) {
                    // another unit may say the same
                    Some((_, of_first)) if of_first != unit => false,
                    Some((first, _)) => match column {
                        Column::Estimate => first != second,
                        Column::Sensitivity => !is_near(first.abs(), second.abs(), SAME),
                        // a standard or an expanded uncertainty beside what they are made of
                        Column::Width => {
                            let ratio = second / standard_uncertainty(row).unwrap_or(first);
                            let usual = [1.0, 1.96, 2.0, 3.0, first / second * ratio];
                            !usual.into_iter().any(|of| is_near(ratio, of, SAME))
                        }
                        _ => !is_near(first, second, SAME),
                    },
                    None => is_empty(first) && second != 0.0,
                };
                if differs {
                    let first =
                        if is_empty(first) { "nothing".to_owned() } else { format!("`{first}`") };
                    let reason = format!(
                        "the columns `{own}` and `{}` may both be the {}, and have {first} and `{}` here: \
                         take one of them away, or head it with what it is",
                        header.heading(place).trim(),
                        column.name(),
                        text.trim()
                    );
                    self.fail(row.line, reason);
                    break;
                }
            }
        }
    }

    /// A row with cells beyond the columns of its header: in a text a number may have been torn at its
    /// decimal comma; beside the table of a workbook they are told.
    fn surplus(&mut self, header: &Header, line: usize) {
        let columns = header.width(self.cells);
        let row = self.cells.row(line);
        let count = row.iter().rposition(|cell| !cell.trim().is_empty()).map_or(0, |last| last + 1);
        let Some(cell) =
            row.iter().skip(columns).map(|cell| cell.trim()).find(|cell| !cell.is_empty())
        else {
            return;
        };
        match self.cells.separator() {
            None => {
                let said =
                    format!("line {}: `{cell}` stands below no heading and is not taken", line + 1);
                self.guessed.push(said);
            }
            Some(separator) => {
                let hint = if separator == Separator::Comma {
                    "; numbers with decimal commas between commas are written in quotes, or between \
                     semicolons"
                } else {
                    ""
                };
                let reason = format!(
                    "the row has {count} cells, the header {columns}, so that `{cell}` stands below no \
                     heading{hint}"
                );
                self.fail(line, reason);
            }
        }
    }

    /// A line of the table as it stands there; where it is `lenient`, texts in the place of numbers are
    /// no mistakes.
    fn row(&mut self, header: &Header, line: usize, label: String, lenient: bool) -> Row {
        let mut row = Row { line, about: label, ..Row::default() };
        row.unit = self.unit(header, line, lenient);
        self.unit_of_name(header, &mut row, lenient);
        row.estimate = self.in_unit(header, line, (Column::Estimate, lenient), &mut row);
        self.corrected(header, lenient, &mut row);
        row.width = self.in_unit(header, line, (Column::Width, lenient), &mut row);
        row.std = self.in_unit(header, line, (Column::Std, lenient), &mut row);
        self.relative(header, lenient, &mut row);
        if let Some((c, unit)) = self.with_unit(header, line, Column::Sensitivity, lenient) {
            row.sensitivity = Some(c);
            unit.clone_into(&mut row.unit_of_sensitivity);
        }
        let stated = header.cell(self.cells, line, Column::UnitOfSensitivity).trim();
        if row.unit_of_sensitivity.is_empty() && !matches!(stated, "-" | "–") {
            stated.clone_into(&mut row.unit_of_sensitivity);
        }
        row.divisor = self.divisor(header, line, lenient);
        row.dof = self.dof(header, line, lenient);
        let of_type = header.cell(self.cells, line, Column::Evaluation);
        row.is_type_a = columns::evaluation(of_type) == Some('A');
        if !lenient {
            self.numbers_as_units(header, line);
            self.said_in_words(header, &mut row);
        }
        let has_limits = self.limits(header, &mut row, lenient).is_some();
        row.distribution = self.distribution(header, &row, lenient);
        if has_limits && row.distribution.is_none() && row.divisor.is_none() && row.std.is_none() {
            row.distribution = Some("rectangular");
            self.guessed.push(format!(
                "line {}: a rectangular distribution is taken between the limits",
                line + 1
            ));
        }
        if !lenient {
            self.extent(header, &mut row, has_limits);
        }
        row
    }

    /// Takes the degrees of freedom that stand with a factor, `normal (k=2.28; dof=10)`, or that are one less
    /// than the number of readings; refuses factors that can be read in two ways, and such of a standard
    /// uncertainty.
    fn said_in_words(&mut self, header: &Header, row: &mut Row) {
        let line = row.line;
        let cell = |column| header.cell(self.cells, line, column).trim();
        let is_unsaid = is_empty(cell(Column::Dof));
        for column in [Column::Distribution, Column::Width, Column::Std] {
            let text = cell(column);
            let statement = match Statement::of(text) {
                Ok(statement) => statement,
                Err(reason) => return self.fail(line, reason),
            };
            let factor = statement.coverage.factor(None);
            if column == Column::Std && factor.is_some_and(|k| !near(k, 1.0)) {
                let heading = header.heading_of(column).trim();
                let reason = format!(
                    "`{text}` below `{heading}` can be a standard uncertainty, or an expanded one: leave the \
                     factor out, or head the column `U`"
                );
                return self.fail(line, reason);
            }
            match statement.dof {
                Some(dof) if is_unsaid || row.dof == Some(dof) => row.dof = Some(dof),
                Some(dof) => {
                    let reason = format!(
                        "`{text}` says {} degrees of freedom, their column `{}`: which is right?",
                        Shortest(dof),
                        cell(Column::Dof)
                    );
                    return self.fail(line, reason);
                }
                None => {}
            }
        }
        let number = row.divisor.filter(|_| columns::is_root_of_n(cell(Column::Divisor)));
        let readings = number.map(|root| (root * root).round()).filter(|number| *number >= 2.0);
        if let Some(readings) = readings.filter(|_| is_unsaid && row.dof.is_none()) {
            row.dof = Some(readings - 1.0);
            self.guessed.push(format!(
                "line {}: {} degrees of freedom are taken, as of the standard deviation of {} readings",
                line + 1,
                Shortest(readings - 1.0),
                Shortest(readings)
            ));
        }
    }

    /// Whether a row has the numbers of a quantity in a unit, and none of a summary.
    fn is_quantity_with_unit(&self, row: &Row) -> bool {
        !row.unit.is_empty() || row.estimate.is_some() && row.std.or(row.width).is_some()
    }

    /// Why the last row is the result and no quantity, if it is: it lacks what every other one has, or it
    /// is their sum with their combined uncertainty, to half a unit of the last digit that is printed.
    fn last_is_result(&self, header: &Header, rows: &[Row]) -> Option<&'static str> {
        let (last, others) = rows.split_last().filter(|(_, others)| !others.is_empty())?;
        let bare = |row: &Row| row.width.is_none() && row.std.is_none();
        let is_constant = says_constant(header.cell(self.cells, last.line, Column::Distribution));
        let is_alone = last.distribution.is_none() && !is_constant && last.sensitivity.is_none();
        // constants may have no coefficient either
        let has_coefficients = others.iter().any(|row| row.sensitivity.is_some())
            && others.iter().all(|row| row.sensitivity.is_some() || bare(row));
        let contributes =
            !is_empty(header.cell(self.cells, last.line, Column::Contribution).trim());
        let is_told = others.iter().all(|row| row.sensitivity.is_some())
            || has_coefficients && (contributes || !bare(last));
        if is_alone && is_told && bare(last) && !contributes && self.is_far(header, last, others) {
            let reason = format!(
                "`{}` has neither an uncertainty nor a coefficient, and is not what the others make: it can be \
                 a constant, whose coefficient is missing, a result that contradicts them, or stand beside the \
                 budget: take the row out, give its coefficient, or write the equation",
                last.name
            );
            self.fail(last.line, reason);
            return None;
        }
        if is_alone && is_told {
            return Some(if bare(last) {
                NO_UNCERTAINTY
            } else {
                "has neither a sensitivity coefficient nor a distribution"
            });
        }
        if bare(last) && last.sensitivity.is_none() && last.distribution.is_none() && !is_constant {
            return others.iter().all(|row| !bare(row)).then_some(NO_UNCERTAINTY);
        }
        // a sum of two rows may be a third one by chance, with its uncertainty as well hardly
        let near = |column: Column, a: f64, b: f64| {
            let text = without_factor(header.cell(self.cells, last.line, column).trim());
            let number = number::number_with_unit(text, self.cells.decimal_comma());
            let share = number.map_or(0.0, |(value, unit)| {
                half_digit(text.strip_suffix(unit).unwrap_or(text)) / value.abs()
            });
            (a - b).abs() <= share.clamp(0.01, SAME) * a.abs().max(b.abs())
        };
        let scaled = in_unit_of(last, others)?;
        let (sum, combined) = sum_of(&scaled);
        let column = if last.std.is_some() { Column::Std } else { Column::Width };
        let stated = last.std.or(last.width);
        let is_combined =
            stated.map(|u| near(column, u, combined) || near(column, u, 2.0 * combined));
        let is_sum = last.estimate.is_some_and(|estimate| near(Column::Estimate, estimate, sum));
        let is_shaped = last.distribution.is_some_and(|shape| shape != "normal");
        let is_combined_alone =
            last.estimate.is_none() && is_alone && is_combined == Some(true) && last.dof.is_none();
        let may_be_total = is_combined_alone && last.divisor.is_none() && !last.is_type_a;
        // where no row has an estimate, the others have what uncertainties are divided by
        let have_estimates = others.iter().all(|row| row.estimate.is_some());
        let are_divided = last.divisor.is_none()
            && others.iter().all(|row| row.divisor.is_some() || row.distribution.is_some());
        if others.len() > 1 && may_be_total && !have_estimates && !are_divided {
            let reason = format!(
                "`{}` has the combined uncertainty of the rows above, and can be the result or a further \
                 quantity: name the result `Combined`, or give the others their estimates",
                last.name
            );
            self.fail(last.line, reason);
            return None;
        }
        if others.len() > 1 && is_combined_alone && (have_estimates || may_be_total) {
            return Some("has no estimate, and the combined uncertainty of the others");
        }
        if others.len() < 2 || !is_sum || is_constant || is_shaped {
            return None;
        }
        let is_of_zeros = others.iter().all(|row| row.estimate.unwrap_or(0.0) == 0.0);
        let others_are_shaped = others.iter().all(|row| row.distribution.is_some());
        let can_be_either = |what: &str| {
            let reason = format!(
                "`{}` {what}, and can be the result or a further quantity: name the result `Result`, or \
                 write its equation",
                last.name
            );
            self.fail(last.line, reason);
        };
        if is_of_zeros && is_combined == Some(true) && last.sensitivity.is_none() {
            // a row of its own kind among others that have shapes
            if others_are_shaped && is_alone && last.dof.is_none() {
                return Some("is the sum of the others with their combined uncertainty");
            }
            if last.distribution.is_none() && last.dof.is_none() {
                can_be_either("is 0 like the others, with their combined uncertainty");
            }
            return None;
        }
        if is_combined == Some(false) && is_alone && others_are_shaped && !is_of_zeros {
            can_be_either(
                "is the sum of the others with another uncertainty than their combined one, and has no \
                 distribution",
            );
            return None;
        }
        if is_combined == Some(false) {
            return None;
        }
        if last.sensitivity.is_none() && is_combined == Some(true) {
            return Some("is the sum of the others with their combined uncertainty");
        }
        if last.estimate != Some(0.0) && last.sensitivity == Some(1.0) {
            let with = if is_combined.is_some() { " with their combined uncertainty" } else { "" };
            let reason = format!(
                "`{}` is the sum of the others{with}, and can be the result, or a further quantity with its \
                 coefficient: leave that out, or name the result `Result`",
                last.name
            );
            self.fail(last.line, reason);
        }
        None
    }

    /// Whether a row cannot be what others in one unit with coefficients of 1 and -1 make, which leave no
    /// constant to be added: it is of another kind, or far from their sum.
    fn is_far(&self, header: &Header, last: &Row, others: &[Row]) -> bool {
        let Some(first) = others.first() else { return false };
        let are_plain = others.iter().all(|row| {
            row.unit == first.unit
                && row.sensitivity.is_some_and(|c| c.abs() == 1.0)
                && row.unit_of_sensitivity.is_empty()
        });
        let units = (Unit::parse(&last.unit), Unit::parse(&first.unit));
        let scale = match units {
            _ if last.unit == first.unit || last.unit.is_empty() => Some(1.0),
            (Ok(of), Ok(unit)) => Unit::conversion_factor(&of, &unit).ok(),
            _ => return false,
        };
        let (sum, combined) = sum_of(others);
        let half_digit = self.half_digit(header, last, Column::Estimate);
        let signs: Vec<f64> = others.iter().filter_map(|row| row.sensitivity).collect();
        let is_apart = scale.is_none_or(|scale| {
            let apart = last.estimate.map_or(0.0, |estimate| scale * estimate - sum);
            let is_apart = apart.abs() > FAR * combined + 1.01 * scale * half_digit;
            // a slip of one sign is told by the linear model, and changes no uncertainty
            is_apart && Self::sign_that_explains(others, &signs, apart).is_empty()
        });
        are_plain && is_apart
    }

    /// Whether a line has no uncertainty, coefficient, shape or divisor.
    fn is_bare(&self, header: &Header, line: usize) -> bool {
        Column::UNCERTAIN
            .iter()
            .chain(&[Column::Sensitivity, Column::Distribution])
            .all(|column| header.cell(self.cells, line, *column).trim().is_empty())
    }

    /// Whether a line has neither a shape nor a coefficient, where the table has columns of them.
    fn lacks_shape(&self, header: &Header, line: usize) -> bool {
        let columns = [Column::Distribution, Column::Sensitivity];
        let is_blank = |of: &Column| is_empty(header.cell(self.cells, line, *of).trim());
        columns.iter().any(|of| header.has(*of)) && columns.iter().all(is_blank)
    }

    /// Whether a line below the quantities is a figure of the result by what it lacks and the others have:
    /// no estimate, and nothing but its coverage in place of a shape.
    fn is_figure(&self, header: &Header, line: usize, quantities: usize) -> bool {
        let cell = |line: usize, column| header.cell(self.cells, line, column).trim();
        let of_shape = cell(line, Column::Distribution);
        let has_estimate = |line: &usize| !is_empty(cell(*line, Column::Estimate));
        let is_uncertain =
            |line: &usize| Column::UNCERTAIN.iter().any(|of| !is_empty(cell(*line, *of)));
        // where no column has estimates, the rows of quantities have shapes, or stand above the combined one
        let is_combined = |line: &usize| {
            let words = cell(*line, Column::Quantity);
            columns::is_combined_symbol(words) || columns::is_result(words)
        };
        let has_shape = |line: &usize| {
            let text = cell(*line, Column::Distribution);
            !is_empty(text) && !is_factor_of(text)
        };
        let combined = (header.line + 1..line).rev().find(is_combined);
        let is_of_table = |of: &usize| {
            if header.has(Column::Estimate) {
                has_estimate(of)
            } else if header.has(Column::Distribution) {
                has_shape(of) || is_combined(of)
            } else {
                combined.is_some_and(|combined| *of <= combined)
            }
        };
        quantities > 1
            && is_empty(cell(line, Column::Estimate))
            && is_empty(cell(line, Column::Sensitivity))
            && (is_empty(of_shape) || is_factor_of(of_shape))
            && (header.line + 1..line).filter(is_uncertain).all(|line| is_of_table(&line))
            && (line + 1..self.cells.lines()).all(|line| !is_of_table(&line))
    }

    /// Whether a line has the numbers of a quantity: an estimate, and an uncertainty.
    fn is_quantity(&self, header: &Header, line: usize) -> bool {
        let is_number = |column| {
            let text = without_sign(header.cell(self.cells, line, column));
            number::number_with_unit(text, self.cells.decimal_comma()).is_some()
        };
        let has = |column| header.columns.iter().any(|(_, of)| *of == column);
        (!has(Column::Estimate) || is_number(Column::Estimate))
            && Column::UNCERTAIN.into_iter().any(is_number)
    }

    /// Whether a line has one cell with something in it, of those that the header names.
    fn is_alone(&self, header: &Header, line: usize) -> bool {
        let cells = header.columns.iter().map(|(_, of)| header.cell(self.cells, line, *of).trim());
        cells.filter(|cell| !cell.is_empty()).count() < 2
    }

    /// Takes over what a row of results says beside its figures.
    fn result_row(&mut self, table: &mut Table, mut row: Row, is_summary: bool) {
        if columns::is_of_uncertainty(&row.about) || is_summary {
            row.estimate = None;
        }
        // a sum of contributions names no quantity
        row.is_summary = is_summary || (row.estimate.is_none() && columns::is_result(&row.about));
        if is_summary {
            self.understood.push(format!(
                "line {}: `{}` is a figure of the result, not a quantity",
                row.line + 1,
                row.about
            ));
        }
        match &mut table.result {
            Some(known) if !known.is_summary || row.is_summary => {
                known.estimate = known.estimate.or(row.estimate);
                if known.unit.is_empty() {
                    known.unit = row.unit;
                }
            }
            result => *result = Some(row),
        }
    }

    /// A name for formulas; `used` are those that the equations need, of which each is of one row.
    fn name(&mut self, words: &str, rows: &[Row], line: usize, used: &[String]) -> String {
        let mut name = columns::identifier(words);
        if check_name(&name).is_err() {
            name = format!("x_{}", rows.len() + 1);
        }
        let wanted = name.clone();
        if used.contains(&wanted)
            && let Some(first) = rows.iter().find(|row| row.name == wanted)
        {
            let reason = format!(
                "the lines {} and {} are both called `{wanted}`, which the equation uses: which one is it?",
                first.line + 1,
                line + 1
            );
            self.fail(line, reason);
        }
        let mut number = 2;
        while rows.iter().any(|row| row.name == name) {
            name = format!("{wanted}_{number}");
            number += 1;
        }
        if name != words {
            self.guessed.push(format!("line {}: `{words}` is called `{name}`", line + 1));
        }
        name
    }

    /// Why the cell of a column holds no number, though it looks like one.
    fn no_number(&self, header: &Header, line: usize, column: Column) -> Option<String> {
        let (place, _) = header.columns.iter().find(|(_, of)| *of == column)?;
        self.cells.no_number(line, *place)
    }

    /// The number in a cell and the unit behind it, which is empty where there is none.
    fn with_unit<'c>(
        &'c self,
        header: &Header,
        line: usize,
        column: Column,
        lenient: bool,
    ) -> Option<(f64, &'c str)> {
        let text = header.cell(self.cells, line, column).trim();
        if is_empty(text) {
            return None;
        }
        if let Some(reason) = self.no_number(header, line, column) {
            if !lenient {
                self.fail(line, reason);
            }
            return None;
        }
        // an uncertainty may have its sign and its factor with it
        let text = match column {
            Column::Width | Column::Std => without_factor(without_sign(text)),
            Column::Dof => columns::without_type(text),
            _ => text,
        };
        let comma = self.cells.decimal_comma();
        let is_of_concise = |unit: &str| unit.is_empty() || Unit::parse(unit).is_ok();
        if column == Column::Estimate
            && let Some((value, _, unit)) = concise(text, comma)
            && is_of_concise(unit)
        {
            return Some((value, unit));
        }
        let read = number::number_with_unit(text, comma)
            .map(|(value, unit)| (value, columns::without_in(unit)));
        let is_unit = |unit: &str| grouped_digits(unit).is_none() && Unit::parse(unit).is_ok();
        let read = read.filter(|(_, unit)| unit.is_empty() || is_unit(unit)).or_else(|| {
            let of_text = (column == Column::Sensitivity).then(|| number::constant(text, comma));
            of_text.flatten().map(|value| (value, ""))
        });
        if read.is_none() && !lenient {
            let groups = text.contains('.') && text.contains(',') || is_grouped(text);
            let advice = negligible::advice(text);
            let hint = if !advice.is_empty() {
                &advice
            } else if groups {
                ": digits are not grouped by points or commas"
            } else if text.ends_with(['*', '†', '‡']) {
                ": what a mark says of it belongs into a column, such as `Distribution`"
            } else {
                ""
            };
            let reason =
                format!("`{text}` in the column of the {} is no number{hint}", column.name());
            self.fail(line, reason);
        }
        let is_written = header.columns.iter().any(|(place, of)| {
            // its side of a cell that holds an estimate and its uncertainty
            let is_side = *of == Column::Estimate || Column::UNCERTAIN.contains(of);
            let is_of_cell =
                *of == column || is_side && self.cells.text(line, *place).contains(text);
            is_of_cell && self.cells.is_written(line, *place)
        });
        if let Some((_, unit)) = read
            && is_written
            && let digits = text.strip_suffix(unit).unwrap_or(text).trim()
            && let plain = number::without_groups(digits)
            && let digits = plain.as_deref().unwrap_or(digits)
            && let Err(reason) = self.marks.borrow_mut().with_point(digits)
            && self.log.is_clean()
        {
            self.fail(line, reason);
        }
        read
    }

    /// Degrees of freedom; `None` where they are infinite, or not stated.
    fn dof(&mut self, header: &Header, line: usize, lenient: bool) -> Option<f64> {
        let text = columns::without_type(header.cell(self.cells, line, Column::Dof));
        let infinite = ["inf", "infinity", "∞", "unendlich", "infinite", "infini"];
        if infinite.contains(&text.to_lowercase().as_str()) {
            return None;
        }
        let at_least = text.trim_start_matches(['>', '≥', '=', ' ']);
        if at_least.len() < text.len() {
            let dof = number::number(at_least, self.cells.decimal_comma());
            if let Some(dof) = dof.filter(|_| !lenient) {
                self.guessed.push(format!(
                    "line {}: {} degrees of freedom are taken of `{text}`",
                    line + 1,
                    Shortest(dof)
                ));
            }
            return dof.filter(|dof| *dof < 1e6);
        }
        let (value, unit) = self.with_unit(header, line, Column::Dof, lenient)?;
        if !unit.is_empty() && !lenient {
            let reason =
                format!("the degrees of freedom have no unit, so that `{unit}` is too much");
            self.fail(line, reason);
        }
        Some(value).filter(|dof| dof.is_finite() && *dof < 1e6)
    }

    /// A number in the unit of its row, which is that of its first number where no column has one; per
    /// cent and ppm are a share of the estimate where the unit is none of them.
    pub(super) fn in_unit(
        &mut self,
        header: &Header,
        line: usize,
        (column, lenient): (Column, bool),
        row: &mut Row,
    ) -> Option<f64> {
        let text = header.cell(self.cells, line, column).trim();
        if column == Column::Width && text.contains(" + ") && !lenient {
            return self.specification(text, line, row);
        }
        let is_uncertain = matches!(column, Column::Width | Column::Std);
        if is_uncertain && is_negligible(text) {
            let said = format!(
                "line {}: the sheet calls the uncertainty of `{}` `{text}`: 0 is taken",
                line + 1,
                row.about
            );
            self.guessed.extend((!lenient).then_some(said));
            return Some(0.0);
        }
        let (value, unit) = self.with_unit(header, line, column, lenient)?;
        let unit = unit.to_owned();
        // `0.06 (95 %)` is no share
        let own_text = if is_uncertain { without_factor(text) } else { text };
        let may_be_negative = column.is_of_place() || column == Column::Correction;
        if !may_be_negative && value < 0.0 && !lenient {
            self.fail(line, format!("the {} `{text}` is below zero", column.name()));
            return None;
        }
        let unit = match self.unit_of_uncertainty(header, line, column) {
            "" => unit,
            own if unit.is_empty() && !own_text.contains('%') => own.to_owned(),
            own if own == unit || own == "%" && own_text.contains('%') => unit,
            own => {
                if !lenient {
                    let column = header.heading_of(Column::UnitOfUncertainty);
                    let reason = format!("`{text}` stands beside `{own}` below `{column}`");
                    self.fail(line, reason);
                }
                return None;
            }
        };
        if !unit.is_empty() && Unit::parse(&unit).is_err() {
            if !lenient {
                self.fail(line, format!("the unit `{unit}` of the uncertainty is not known"));
            }
            return None;
        }
        let of_header = header.unit(column).unwrap_or_default();
        // what a line says of all values yields to what a row says
        let is_of_all = header.unit_of_all.as_ref().is_some_and(|(_, unit)| unit == of_header);
        let dimension = |unit: &str| Unit::parse(unit).ok().map(|unit| unit.dimension());
        let is_of_row = !row.unit.is_empty() && dimension(&row.unit) != dimension(of_header);
        let of_header = if is_of_all && (!unit.is_empty() || is_of_row) { "" } else { of_header };
        let is_percent = own_text.contains('%') && unit.is_empty();
        if !of_header.is_empty() && (is_percent || !unit.is_empty()) && !lenient {
            let own = if is_percent { "%" } else { unit.as_str() };
            if own != of_header {
                let reason =
                    format!("`{text}` stands in a column whose heading says `{of_header}`");
                self.fail(line, reason);
                return None;
            }
        }
        let unit = match (unit.as_str(), is_percent) {
            ("", true) => "%",
            ("", false) => of_header,
            (unit, _) => unit,
        };
        // the number of a cell in per cent is a share already
        let value = if is_percent { 100.0 * value } else { value };
        let (share, own) = (Unit::parse(unit).ok(), Unit::parse(&row.unit).ok());
        let of_value = share.as_ref().map(|share| Share::of(share, own.as_ref()));
        match (of_value, share) {
            (Some(Share::OfValue), Some(_))
                if own
                    .as_ref()
                    .is_some_and(|own| own.is_celsius() || !own.level_exponent().is_zero())
                    && !columns::is_share_of_estimate(header.heading_of(column)) =>
            {
                if !lenient {
                    let reason = format!(
                        "`{text}` of a quantity in `{}`: it is not clear what the share is of; write it in \
                         that unit, or head the column `Uncertainty (% of reading)`",
                        row.unit
                    );
                    self.fail(line, reason);
                }
                None
            }
            (Some(Share::OfValue), Some(share)) => {
                let share = (value * share.factor(), unit);
                self.share(share, line, (column, lenient), row)
            }
            (Some(Share::Doubtful), _) if !column.is_of_place() => {
                if !lenient {
                    self.fail(line, format!("`{text}`: {}", share::two_meanings(unit, &row.unit)));
                }
                None
            }
            _ if unit.is_empty() => Some(value),
            _ => {
                if !column.is_of_place() && !lenient {
                    self.unit_of_estimate(header, unit, (line, text), row)?;
                }
                self.converted((value, unit), line, (column, lenient), row)
            }
        }
    }

    /// Refuses an uncertainty whose unit is none of its estimate's: of a plain number, or of an estimate
    /// without a unit where it may be a share; tells that the estimate is taken to be in that unit else.
    fn unit_of_estimate(
        &mut self,
        header: &Header,
        unit: &str,
        (line, text): (usize, &str),
        row: &Row,
    ) -> Option<()> {
        let estimate = row.estimate.filter(|estimate| *estimate != 0.0 && row.unit.is_empty());
        let Some(estimate) = estimate else { return Some(()) };
        let is_ratio =
            Unit::parse(unit).is_ok_and(|of| of.dimension().is_none() && of.turn().is_none());
        let is_number = header.cell(self.cells, line, Column::Unit).trim() == "1";
        if is_ratio {
            self.fail(line, format!("`{text}`: {}", share::two_meanings(unit, "1")));
            return None;
        }
        if is_number {
            let reason = format!("`{text}` is in `{unit}`, but the unit of this row is `1`");
            self.fail(line, reason);
            return None;
        }
        self.guessed.push(format!(
            "line {}: the estimate {} has no unit; that of its uncertainty, `{unit}`, is taken",
            line + 1,
            Shortest(estimate)
        ));
        Some(())
    }

    /// Takes the standard uncertainty that is stated as a share of the estimate, where no other one is;
    /// refuses one that says something else than the other one.
    fn relative(&mut self, header: &Header, lenient: bool, row: &mut Row) -> Option<()> {
        let line = row.line;
        let text = header.cell(self.cells, line, Column::Relative).trim().to_owned();
        let (value, unit) = self.with_unit(header, line, Column::Relative, lenient)?;
        let of_header = header.unit(Column::Relative).unwrap_or_default();
        let unit = match unit {
            // the number of a cell in per cent is a share already
            "" if text.contains('%') => "",
            "" => of_header,
            unit => unit,
        };
        let unit = Unit::parse(unit).ok().filter(|unit| unit.dimension().is_none());
        let share = unit.map(|unit| value * unit.factor()).filter(|share| *share >= 0.0);
        let estimate = row.estimate.filter(|estimate| *estimate != 0.0 || share == Some(0.0));
        let (Some(share), Some(estimate)) = (share, estimate) else {
            if !lenient && row.std.is_none() && row.width.is_none() {
                let heading = header.heading_of(Column::Relative);
                let advice = match header.has(Column::Estimate) {
                    true => "",
                    false => {
                        ", as no column has estimates: write them, or where all of the budget is in shares of \
                         the result head the column `Standard uncertainty (%)`"
                    }
                };
                let reason =
                    format!("`{text}` below `{heading}` is no share of an estimate{advice}");
                self.fail(line, reason);
            }
            return None;
        };
        let found = to_15_digits(share * estimate.abs());
        match row.std {
            None if row.width.is_some() => {}
            None => row.std = Some(found),
            // as far as both are printed
            Some(known) if !lenient && (found - known).abs() > 0.1 * found.max(known) => {
                let reason = format!(
                    "the standard uncertainty {} and the relative one, `{text}` of {}, are not one: which \
                     is right?",
                    Shortest(known),
                    Shortest(estimate)
                );
                self.fail(line, reason);
            }
            Some(_) => {}
        }
        Some(())
    }

    /// What the column of the units of uncertainties has for a number; empty where it has nothing.
    fn unit_of_uncertainty(&self, header: &Header, line: usize, column: Column) -> &str {
        let text = header.cell(self.cells, line, Column::UnitOfUncertainty).trim();
        let is_uncertain = matches!(column, Column::Width | Column::Std);
        if is_uncertain && !is_empty(text) { columns::without_in(text) } else { "" }
    }

    /// A width as data sheets have it, `0.02 % + 2 mV`, at the estimate.
    fn specification(&mut self, text: &str, line: usize, row: &Row) -> Option<f64> {
        let written =
            if self.cells.decimal_comma() { equation::with_points(text) } else { text.to_owned() };
        // `± (0.5 % + 2 mV)`
        let bare = without_sign(&written);
        let inside = bare.strip_prefix('(').and_then(|bare| bare.strip_suffix(')'));
        let unit = Unit::parse(&row.unit).ok()?;
        let width = Width::specification(inside.unwrap_or(bare), &unit, &[]);
        match width.and_then(|width| Ok((width, row.estimate.ok_or("the estimate is missing")?))) {
            Ok((width, 0.0)) if width.relative > 0.0 => {
                let reason = format!(
                    "`{text}` of the estimate 0 lacks its share: state what it is a share of, such as `35 ppm of \
                     10 V + 5 uV`"
                );
                self.fail(line, reason);
                None
            }
            Ok((width, estimate)) => {
                let found = to_15_digits(width.at(estimate));
                self.guessed.push(format!(
                    "line {}: `{text}` is {} at the estimate {}",
                    line + 1,
                    unit.after(&Shortest(found).to_string()),
                    Shortest(estimate)
                ));
                Some(found)
            }
            Err(reason) => {
                self.fail(line, format!("`{text}`: {reason}"));
                None
            }
        }
    }

    /// A share of the estimate in the unit of its row; `unit` is that of the share.
    fn share(
        &mut self,
        (share, unit): (f64, &str),
        line: usize,
        (column, lenient): (Column, bool),
        row: &mut Row,
    ) -> Option<f64> {
        let whole = Unit::parse(unit).map_or(1.0, |unit| unit.factor());
        let text = format!("{} {unit}", Shortest(to_15_digits(share / whole)));
        let reason = match row.estimate.filter(|_| column != Column::Estimate) {
            // nothing else is said of the quantity: it is in per cent itself
            None if row.unit.is_empty() => {
                unit.clone_into(&mut row.unit);
                return Some(to_15_digits(share / whole));
            }
            None => format!("`{text}` is a share, but the unit of this row is `{}`", row.unit),
            Some(0.0) => format!(
                "`{text}` of the estimate 0 is nothing: state the {} in the unit of the quantity, or what \
                 it is a share of",
                column.name()
            ),
            Some(estimate) if row.unit.is_empty() && (estimate.abs() - 1.0).abs() > 1e-9 => {
                format!(
                    "`{text}` of a quantity without a unit can be {text} of the estimate {}, or {} itself: \
                     write that number",
                    Shortest(estimate),
                    Shortest(to_15_digits(share))
                )
            }
            Some(estimate) => {
                self.guessed.push(format!(
                    "line {}: `{text}` is taken of the estimate {}",
                    line + 1,
                    Shortest(estimate)
                ));
                // a correction goes with the sign of what it corrects
                let whole = if column == Column::Correction { estimate } else { estimate.abs() };
                return Some(to_15_digits(share * whole));
            }
        };
        if !lenient {
            self.fail(line, reason);
        }
        None
    }

    /// A number with a unit behind it, in that of its row.
    pub(super) fn converted(
        &self,
        (value, unit): (f64, &str),
        line: usize,
        (column, lenient): (Column, bool),
        row: &mut Row,
    ) -> Option<f64> {
        if row.unit.is_empty() {
            unit.clone_into(&mut row.unit);
        }
        let (from, to) = (Unit::parse(unit).ok()?, Unit::parse(&row.unit).ok()?);
        let factor = Unit::conversion_factor(&from, &to).ok();
        // of a temperature the size of the degree
        let shifted = column.is_of_place() && from.zero() != to.zero();
        match factor.filter(|_| !shifted) {
            Some(1.0) => Some(value),
            Some(_) => Some(to_15_digits(to.from_si(from.to_si(value)))),
            None if lenient => None,
            None => {
                let hint = if column == Column::Std {
                    "; what is in the unit of the result is headed `Contribution`, beside coefficients"
                } else {
                    ""
                };
                let (name, own) = (column.name(), &row.unit);
                self.fail(line, format!("the {name} is in `{unit}`, but the row in `{own}`{hint}"));
                None
            }
        }
    }

    /// The coverage factor of a row: of its divisor, its distribution (`normal (k=2)`), its uncertainty
    /// (`0.4 mV (k=2)`), or the header of its column.
    fn coverage(&mut self, header: &Header, row: &mut Row) {
        let Some(width) = row.width.filter(|width| *width > 0.0) else {
            return self.standard_beside_words(header, row);
        };
        let cell = |column| HeaderCoverage::of(header.cell(self.cells, row.line, column));
        let of_header = header.coverage(Column::Width);
        let is_normal = matches!(row.distribution, None | Some("normal"));
        let divisor = row.divisor.map(|k| (HeaderCoverage::Factor(k), "the divisor"));
        let mut stated: Vec<(HeaderCoverage, &str)> = divisor.into_iter().collect();
        let of_words = self.coverage_in_words(header, row.line);
        if !is_normal && stated.is_empty() && of_words.factor(None).is_some() {
            let reason = format!(
                "`{}` is {}, and its words say a coverage factor or probability: {} can be its half-width or \
                 an expanded uncertainty; leave the one or the other out",
                row.about,
                row.distribution.unwrap_or_default(),
                header.cell(self.cells, row.line, Column::Width).trim()
            );
            return self.fail(row.line, reason);
        }
        for (coverage, place) in [
            (cell(Column::Distribution), "the distribution"),
            (cell(Column::Width), "the uncertainty"),
            (of_words, OF_WORDS),
            (of_header, "the heading"),
        ] {
            // a heading speaks of the rows that say nothing else
            let counts = match place {
                OF_WORDS => is_normal,
                "the heading" => stated.is_empty() && is_normal,
                _ => true,
            };
            if counts && coverage.factor(row.dof).is_some() {
                stated.push((coverage, place));
            }
        }
        // a factor goes before a probability, of which the sheet may have taken the factor of a normal one
        let first = stated.iter().find(|(of, _)| of.probability().is_none()).or(stated.first());
        if let Some((coverage, of)) = first.copied()
            && let Some(factor) = coverage.factor(row.dof)
        {
            let differs = |other: HeaderCoverage| {
                [row.dof, None]
                    .into_iter()
                    .filter_map(|dof| other.factor(dof))
                    .all(|other| !near(factor, other))
            };
            if let Some((other, by)) = stated.iter().find(|(other, _)| differs(*other)) {
                let reason = format!(
                    "{of} says {}, {by} {}: which factor is it?",
                    Shortest(factor),
                    Shortest(other.factor(row.dof).unwrap_or(f64::NAN))
                );
                self.fail(row.line, reason);
            }
            row.divisor = Some(factor);
            row.probability = coverage.probability();
            if of == OF_WORDS {
                self.guessed.push(format!(
                    "line {}: the uncertainty of `{}` is expanded by its words: it is divided by {}",
                    row.line + 1,
                    row.name,
                    significant(factor, 4)
                ));
            }
            if let Some((p, dof)) = row.probability.zip(row.dof) {
                self.understood.push(format!(
                    "line {}: of {} % and {} degrees of freedom k = {} of the t distribution",
                    row.line + 1,
                    Shortest(to_15_digits(100.0 * p)),
                    Shortest(dof),
                    significant(factor, 4)
                ));
            }
            return;
        }
        if !is_normal {
            let heading = header.heading_of(Column::Width).trim();
            if of_header.factor(None).is_some() || of_header == HeaderCoverage::Expanded {
                self.guessed.push(format!(
                    "line {}: `{}` is {}, by which {} below `{heading}` is taken for its half-width, and for \
                     no expanded uncertainty",
                    row.line + 1,
                    row.name,
                    row.distribution.unwrap_or_default(),
                    header.cell(self.cells, row.line, Column::Width).trim()
                ));
            }
            return;
        }
        let line = row.line + 1;
        if let Some(std) = row.std.filter(|std| *std > 0.0) {
            let [stated, standard] =
                [Column::Width, Column::Std].map(|of| header.heading_of(of).trim());
            // `u` is a standard uncertainty as well
            let are_alike = columns::is_standard_symbol(stated);
            if width < std * (1.0 - SAME) || are_alike && width > std * (1.0 + SAME) {
                let reason = format!(
                    "`{}` is {} below `{stated}` and {} below `{standard}`: which is its standard \
                     uncertainty?",
                    row.name,
                    Shortest(width),
                    Shortest(std)
                );
                self.fail(row.line, reason);
            }
            row.divisor = Some(if are_alike { 1.0 } else { width / std });
            return;
        }
        let heading = header.heading_of(Column::Width).trim();
        if columns::is_of_limits(heading) && row.distribution.is_none() {
            let reason = format!(
                "`{heading}` is no standard uncertainty, and nothing says what it is divided by: name the \
                 distribution of `{}` in a column `Distribution` (rectangular, if nothing more is known), \
                 or write a divisor",
                row.name
            );
            self.fail(row.line, reason);
            return;
        }
        if of_header == HeaderCoverage::Expanded {
            row.divisor = Some(2.0);
            self.guessed.push(format!(
                "line {line}: `{}` is expanded, and nothing says by which factor: k = 2 is taken",
                row.name
            ));
        } else {
            self.guessed.push(format!(
                "line {line}: nothing says what the uncertainty of `{}` is divided by: k = 1 is taken, as \
                 of a standard uncertainty",
                row.name
            ));
        }
    }

    /// Says that a standard uncertainty is taken as it is where the words of its row say a coverage factor.
    fn standard_beside_words(&mut self, header: &Header, row: &Row) {
        let of_words = self.coverage_in_words(header, row.line).factor(row.dof);
        let (Some(std), Some(factor)) = (row.std.filter(|std| *std > 0.0), of_words) else {
            return;
        };
        if !near(factor, 1.0) && row.divisor.is_none() {
            self.guessed.push(format!(
                "line {}: the words of `{}` say k = {}, and {} below `{}` is taken for its standard uncertainty, \
                 divided already",
                row.line + 1,
                row.about,
                Shortest(to_15_digits(factor)),
                Shortest(std),
                header.heading_of(Column::Std).trim()
            ));
        }
    }

    /// What the name of a row, or a column of remarks, says of the coverage of its uncertainty:
    /// `Certificate (k=2)`, `Cert U95`.
    fn coverage_in_words(&self, header: &Header, line: usize) -> HeaderCoverage {
        let name = header.cell(self.cells, line, Column::Quantity);
        let remarks = header.unknown.iter().map(|place| self.cells.text(line, *place));
        // a share alone may be of something else: `Humidity at 60 %`
        let coverage = |text: &str| {
            let last = text.split_whitespace().next_back().unwrap_or_default();
            let of_symbol = columns::probability_of_symbol(last).map(HeaderCoverage::Probability);
            let is_factor = |of: &HeaderCoverage| matches!(of, HeaderCoverage::Factor(_));
            of_symbol.or_else(|| Some(HeaderCoverage::of(text)).filter(is_factor))
        };
        [name].into_iter().chain(remarks).find_map(coverage).unwrap_or(HeaderCoverage::None)
    }

    /// Says how a divisor beside nothing but standard uncertainties is taken: below `u` they are still to
    /// be divided, below words they are what is left.
    fn divided(&mut self, header: &Header, row: &Row) {
        if row.divisor.is_none_or(|divisor| near(divisor, 1.0)) {
            return;
        }
        let column = if header.has(Column::Width) { Column::Width } else { Column::Std };
        let heading = header.heading_of(column).trim();
        let is_to_be_divided = column == Column::Width && columns::is_standard_symbol(heading);
        let (own, other) = if is_to_be_divided {
            (row.width.filter(|_| row.std.is_none()), "still to be divided")
        } else {
            (row.std.filter(|_| !header.has(Column::Width)), "already divided")
        };
        if let Some(u) = own.filter(|u| *u > 0.0) {
            self.guessed.push(format!(
                "line {}: {} below `{heading}` is taken as {other} by {}",
                row.line + 1,
                Shortest(u),
                header.cell(self.cells, row.line, Column::Divisor).trim(),
            ));
        }
    }

    /// A heading says a coverage factor, and each row that it can be of another one.
    fn factor_of_heading(&self, header: &Header, rows: &[Row]) {
        let coverage = header.coverage(Column::Width);
        let Some(factor) = coverage.factor(None) else { return };
        let is_of_it = |row: &&Row| {
            row.width.is_some_and(|width| width > 0.0)
                && matches!(row.distribution, None | Some("normal"))
                && !is_empty(header.cell(self.cells, row.line, Column::Divisor).trim())
        };
        let of_it: Vec<&Row> = rows.iter().filter(is_of_it).collect();
        let differs = |row: &&Row| {
            let factors = [row.dof, None].map(|dof| coverage.factor(dof).unwrap_or(factor));
            row.divisor.is_some_and(|divisor| factors.iter().all(|of| !near(divisor, *of)))
        };
        if let Some(row) = of_it.first()
            && of_it.iter().all(differs)
        {
            let divisor = row.divisor.unwrap_or(f64::NAN);
            let reason = format!(
                "the heading says {}, the divisor {}: which factor is it?",
                Shortest(factor),
                Shortest(divisor)
            );
            self.fail(row.line, reason);
        }
    }

    /// Says what a row's shape, uncertainty and divisor do not say together.
    fn contradictions(&mut self, row: &Row) {
        let line = row.line + 1;
        let shape = row.distribution.filter(|shape| *shape != "normal");
        let uncertain = row.std.or(row.width).is_some_and(|u| u > 0.0);
        if let Some(shape) = row.distribution.filter(|_| !uncertain) {
            self.guessed.push(format!(
                "line {line}: `{}` is {shape} without an uncertainty; it is taken for a constant",
                row.name
            ));
        } else if let (Some(shape), true) = (shape, is_normal_here(row)) {
            self.guessed.push(format!(
                "line {line}: `{}` is {shape}, but its uncertainty is not half a width: a normal \
                 distribution of that standard uncertainty is taken",
                row.name
            ));
        }
        if let (Some(u), Some(std)) = (standard_uncertainty(row), row.std)
            && row.width.is_some_and(|width| width > 0.0)
            && std > 0.0
        {
            let ratio = (u / std).max(std / u);
            let said = format!(
                "`{}` has the standard uncertainty {} by its stated uncertainty and divisor, and {} in \
                 the column of standard uncertainties",
                row.name,
                significant(u, 3),
                Shortest(std)
            );
            if ratio > CONTRIBUTIONS_DIFFER {
                self.fail(row.line, format!("{said}: which is right?"));
            } else if ratio > 1.1 {
                self.guessed.push(format!("line {line}: {said}: the former is taken"));
            }
        }
    }

    /// A divisor: a number, a root such as `√3` or `sqrt(3)`, or a factor such as `k = 2`.
    fn divisor(&mut self, header: &Header, line: usize, lenient: bool) -> Option<f64> {
        let text = header.cell(self.cells, line, Column::Divisor).trim();
        if is_empty(text) {
            return None;
        }
        if let Some(reason) = self.no_number(header, line, Column::Divisor) {
            if !lenient {
                self.fail(line, reason);
            }
            return None;
        }
        if columns::is_root_of_n(text) {
            return self.root_of_n(header, line, lenient);
        }
        match number::constant(text, self.cells.decimal_comma()) {
            Some(divisor) if divisor >= 1.0 => Some(divisor),
            _ if lenient => None,
            Some(factor) if factor > 0.0 && self.multiplies(header, line, factor) => {
                let divisor = 1.0 / factor;
                self.understood.push(format!(
                    "line {}: the factor `{text}` multiplies, as 1/{} does",
                    line + 1,
                    significant(divisor, 4)
                ));
                Some(divisor)
            }
            Some(factor) if factor > 0.0 => {
                let reason = format!(
                    "the divisor `{text}` is below 1: does it multiply, as 1/{} would divide?",
                    significant(1.0 / factor, 4)
                );
                self.fail(line, reason);
                None
            }
            _ => {
                self.fail(line, format!("the divisor `{text}` is no number above 0"));
                None
            }
        }
    }

    /// The root of the number of readings that stands in a row.
    fn root_of_n(&self, header: &Header, line: usize, lenient: bool) -> Option<f64> {
        let place = header.number_of_readings(self.cells);
        let text = place.map_or("", |place| self.cells.text(line, place).trim());
        let number = number::number(text, self.cells.decimal_comma());
        let number = number.filter(|number| *number >= 1.0 && number.fract() == 0.0);
        if number.is_none() && !lenient {
            let divisor = header.cell(self.cells, line, Column::Divisor).trim();
            let found = match text {
                "" => "there is none in a column `n`".to_owned(),
                text => format!("`{text}` in the column `n` is no whole number above 0"),
            };
            self.fail(line, format!("the divisor `{divisor}` needs a number of readings: {found}"));
        }
        number.map(f64::sqrt)
    }

    /// Whether a factor below 1 is 1 over what the row's distribution is divided by, in a column of
    /// factors; of a normal one whose coverage factor is not stated where another row has such a one.
    fn multiplies(&self, header: &Header, line: usize, factor: f64) -> bool {
        if !columns::is_of_factors(header.heading_of(Column::Divisor)) {
            return false;
        }
        let of_shape = |line: usize, factor: f64| {
            let text = header.cell(self.cells, line, Column::Distribution);
            match NamedShape::of(text) {
                Some(NamedShape::Known(shape)) => {
                    // also that of a full width
                    let is_it =
                        |usual: f64| [usual, 2.0 * usual].iter().any(|of| near(*of, 1.0 / factor));
                    divisor_of(shape).map(is_it)
                }
                _ => None,
            }
        };
        if let Some(is_alike) = of_shape(line, factor) {
            return is_alike;
        }
        let cell = |column| HeaderCoverage::of(header.cell(self.cells, line, column));
        let coverage =
            [cell(Column::Distribution), cell(Column::Width), header.coverage(Column::Width)];
        if let Some(stated) = coverage.iter().find_map(|of| of.factor(None)) {
            return near(stated, 1.0 / factor);
        }
        let text = header.cell(self.cells, line, Column::Distribution);
        let is_normal = NamedShape::of(text) == Some(NamedShape::Known("normal"));
        is_normal
            && (header.line + 1..self.cells.lines()).any(|line| {
                let text = header.cell(self.cells, line, Column::Divisor).trim();
                let factor = number::constant(text, self.cells.decimal_comma());
                factor.is_some_and(|factor| factor < 1.0 && of_shape(line, factor) == Some(true))
            })
    }

    fn unit(&mut self, header: &Header, line: usize, lenient: bool) -> String {
        let text = columns::without_in(header.cell(self.cells, line, Column::Unit).trim());
        let text = text.trim_matches(['[', ']']);
        if text.is_empty() || matches!(text, "-" | "–" | "1") {
            return String::new();
        }
        match Unit::parse(text) {
            Ok(_) => text.to_owned(),
            Err(_) if columns::unit_as_meant(text).is_some() => {
                columns::unit_as_meant(text).unwrap_or_default()
            }
            Err(_) if lenient => String::new(),
            // a slip of the keyboard is no plain number
            Err(error) if !error.suggestions().is_empty() => {
                self.fail(line, format!("the unit `{text}`: {error}"));
                String::new()
            }
            Err(error) => {
                self.guessed.push(format!(
                    "line {}: `{text}` is taken for a plain number, because it is no unit known \
                     here ({error})",
                    line + 1
                ));
                String::new()
            }
        }
    }

    /// Refuses a number in a column of units, where a cell before it is missing; powers of ten (`10^-6`) and
    /// 1 are units of plain numbers.
    fn numbers_as_units(&self, header: &Header, line: usize) {
        for column in [Column::Unit, Column::UnitOfUncertainty, Column::UnitOfSensitivity] {
            let text = header.cell(self.cells, line, column).trim();
            let is_power = text.contains(['^', '⁻']);
            let number = number::number(text, self.cells.decimal_comma());
            if is_power || number.is_none_or(|number| number == 1.0) {
                continue;
            }
            let (count, columns) = (self.cells.row(line).len(), header.width(self.cells));
            let shorter = if count < columns {
                format!("the row has {count} cells, the header {columns}: is a cell missing?")
            } else {
                "write the unit, or `1` for a plain number".to_owned()
            };
            let reason = format!(
                "the number `{text}` stands in the column of the {}: {shorter}",
                column.name()
            );
            return self.fail(line, reason);
        }
    }

    /// Takes the unit that stands behind a name, `dT [K]`, where the row has no other one.
    fn unit_of_name(&mut self, header: &Header, row: &mut Row, lenient: bool) {
        for column in [Column::Symbol, Column::Quantity] {
            let words = header.cell(self.cells, row.line, column);
            let Some((_, unit)) = columns::with_unit_in_brackets(words) else {
                continue;
            };
            let other = self.other_unit(header, row, &unit);
            // a remark in parentheses may be of what makes the quantity: `Temperature (°C)` in mm
            // but not beside the unit of all values, which may be that of most
            let is_of_all = |other: &str| {
                header.unit_of_all.as_ref().is_some_and(|(_, of_all)| of_all == other)
            };
            let is_beside =
                |(other, _): &(String, _)| is_remark_beside(&unit, other) && !is_of_all(other);
            let is_remark = words.trim().ends_with(')')
                && (self.states_unit(header, row.line) || other.as_ref().is_some_and(is_beside));
            if is_remark {
                continue;
            }
            if other.is_none() && row.unit.is_empty() {
                self.understood.push(format!(
                    "line {}: the unit `{unit}` of `{}`",
                    row.line + 1,
                    words.trim()
                ));
                row.unit = unit;
            } else if let Some((other, place)) = other.filter(|_| !lenient) {
                let reason = format!(
                    "`{}` says `{unit}`, but {place} `{other}`: which is the unit of its numbers?",
                    words.trim()
                );
                self.fail(row.line, reason);
            }
        }
    }

    /// Whether a row has the unit `1`, or a unit behind its numbers.
    fn states_unit(&self, header: &Header, line: usize) -> bool {
        let comma = self.cells.decimal_comma();
        let cell = |column| header.cell(self.cells, line, column).trim();
        let mut numbers = [Column::Estimate, Column::Width, Column::Std].into_iter();
        cell(Column::Unit) == "1"
            || numbers.any(|column| {
                let read = number::number_with_unit(without_sign(cell(column)), comma);
                read.is_some_and(|(_, unit)| !unit.is_empty())
            })
    }

    /// A unit that the table states for a row beside that in its name, and where, if it is another one.
    fn other_unit(&self, header: &Header, row: &Row, unit: &str) -> Option<(String, &'static str)> {
        let own = Unit::parse(unit).ok()?;
        let is_other = |text: &str| {
            let same = Unit::parse(text).ok().filter(|of| of.dimension() == own.dimension());
            let factor = same.filter(|of| of.zero() == own.zero());
            factor.is_none_or(|of| (of.factor() / own.factor() - 1.0).abs() > 1e-12)
        };
        let of_headings = [Column::Estimate, Column::Width, Column::Std].map(|of| header.unit(of));
        let of_row =
            (!row.unit.is_empty()).then_some((row.unit.as_str(), "the column of the unit"));
        let of_headings = of_headings.into_iter().flatten().map(|of| (of, "a heading"));
        let mut stated = of_row.into_iter().chain(of_headings);
        // a share is of the estimate
        let is_share = |text: &str| Unit::parse(text).is_ok_and(|of| of.is_relative());
        let found = stated.find(|(text, _)| is_other(text) && !is_share(text))?;
        Some((found.0.to_owned(), found.1))
    }

    fn distribution(&mut self, header: &Header, row: &Row, lenient: bool) -> Option<&'static str> {
        let text = header.cell(self.cells, row.line, Column::Distribution).trim();
        if says_constant(text) {
            if !lenient && row.width.or(row.std).is_some_and(|u| u > 0.0) {
                let reason = format!("a `{text}` has no uncertainty, and this row states one");
                self.fail(row.line, reason);
            }
            return None;
        }
        // a half width needs its shape, or what it is divided by
        let is_undivided = row.width.is_some_and(|width| width > 0.0)
            && row.divisor.is_none()
            && row.std.is_none()
            && !lenient;
        let needs = is_undivided && !is_factor_of(text);
        // a probability has its factor with degrees of freedom alone, which may be infinite
        let is_without_dof =
            row.dof.is_none() && is_empty(header.cell(self.cells, row.line, Column::Dof).trim());
        let is_stated = [HeaderCoverage::of(text), header.coverage(Column::Width)]
            .iter()
            .any(|of| of.factor(None).is_some() && (of.probability().is_none() || !is_without_dof));
        let needs_dof = is_undivided && !is_stated;
        match NamedShape::of(text)? {
            NamedShape::Known(name) => Some(name),
            NamedShape::Student if needs_dof && row.dof.is_none() => {
                let reason = format!(
                    "`{text}` needs a divisor or degrees of freedom: what is the stated uncertainty \
                     divided by?"
                );
                self.fail(row.line, reason);
                None
            }
            NamedShape::Student
                if is_without_dof && !lenient && row.width.or(row.std).is_some_and(|u| u > 0.0) =>
            {
                let reason = format!(
                    "`{text}` has degrees of freedom, and none are stated: write them in a column `Degrees of \
                     freedom`, or `normal` where they are infinite"
                );
                self.fail(row.line, reason);
                None
            }
            NamedShape::Student => Some("normal"),
            NamedShape::Unknown
                if !lenient
                    && self.cells.separator() == Some(Separator::Comma)
                    && number::number(text, true).is_some() =>
            {
                let reason = format!(
                    "the number `{text}` stands in the column of the distribution: has a cell of this row \
                     a comma too much?"
                );
                self.fail(row.line, reason);
                None
            }
            NamedShape::Unknown if needs => {
                let reason = format!(
                    "the distribution `{text}` is not known, and there is no divisor; normal, \
                     rectangular, triangular, U-shaped and t are known"
                );
                self.fail(row.line, reason);
                None
            }
            NamedShape::Unknown => {
                if !lenient && !is_factor_of(text) {
                    self.guessed.push(format!(
                        "line {}: the distribution `{text}` is not known; the divisor decides",
                        row.line + 1
                    ));
                }
                None
            }
        }
    }
}

/// Whether a unit in parentheses behind a name is no other statement of the unit of its row: it is of another
/// dimension, or both are of temperatures, of which one may be a difference.
fn is_remark_beside(unit: &str, other: &str) -> bool {
    let dimension = |text: &str| Unit::parse(text).ok().map(|unit| unit.dimension());
    let (own, other) = (dimension(unit), dimension(other));
    own != other || own == Some(Dimension::TEMPERATURE)
}

/// Whether a cell says that there is nothing.
pub(super) fn is_empty(text: &str) -> bool {
    matches!(text.to_lowercase().as_str(), "" | "-" | "–" | "—" | "n/a" | "na" | "n.a.")
}

/// Rows in the unit of another one, where they are in one of its kind or in none; `None` where they are in
/// another one, or count from another zero.
pub(super) fn in_unit_of(last: &Row, rows: &[Row]) -> Option<Vec<Row>> {
    let to = Unit::parse(&last.unit).ok()?;
    let scaled = |row: &Row| {
        let is_unsaid = row.unit.is_empty() || last.unit.is_empty();
        if row.unit == last.unit || is_unsaid || row.sensitivity.is_some() {
            return Some(row.clone());
        }
        let from = Unit::parse(&row.unit).ok()?;
        let factor = Unit::conversion_factor(&from, &to).ok().filter(|_| from.has_zero_of(&to))?;
        let times = |value: Option<f64>| value.map(|value| factor * value);
        let [estimate, width, std] = [row.estimate, row.width, row.std].map(times);
        Some(Row { estimate, width, std, unit: last.unit.clone(), ..row.clone() })
    };
    rows.iter().map(scaled).collect()
}

/// What rows of one unit make together, each times its coefficient where it has one, and the standard
/// uncertainty of that.
fn sum_of(rows: &[Row]) -> (f64, f64) {
    let of = |row: &Row| row.sensitivity.unwrap_or(1.0);
    let terms = rows.iter().map(|row| of(row) * row.estimate.unwrap_or(0.0));
    let squares =
        rows.iter().filter_map(|row| Some((of(row) * standard_uncertainty(row)?).powi(2)));
    (terms.sum(), squares.sum::<f64>().sqrt())
}

/// Whether the cell of a distribution says that there is none.
fn says_constant(text: &str) -> bool {
    let words = text.trim().to_lowercase();
    matches!(
        words.as_str(),
        "constant" | "const" | "const." | "konstante" | "konstant" | "constante"
    )
}

/// Whether a text states a coverage factor.
fn is_factor_of(text: &str) -> bool {
    HeaderCoverage::of(text).factor(None).is_some()
}

/// An uncertainty without the sign before it.
pub(super) fn without_sign(text: &str) -> &str {
    text.trim().trim_start_matches(['±', ' '])
}

/// An uncertainty without the factor or the probability in parentheses behind it, `0.2 V (k=2)`.
pub(super) fn without_factor(text: &str) -> &str {
    text.split_once('(').filter(|_| is_factor_of(text)).map_or(text, |(of, _)| of.trim())
}

/// Whether a number may have its digits in groups, `1.234,5` or `1,500`.
fn is_grouped(text: &str) -> bool {
    let mut groups = text.split(',');
    let is_first = groups.next().is_some_and(|first| !first.is_empty() && first.len() <= 4);
    let mut rest = groups.peekable();
    is_first && rest.peek().is_some() && rest.all(|group| group.len() == 3)
}

/// A result this many combined standard uncertainties from what its quantities make is not theirs: sheets
/// round by less.
const FAR: f64 = 0.1;

/// Where a row says its coverage beside its numbers.
const OF_WORDS: &str = "the words";

/// Why the last row of a budget is taken for its result.
const NO_UNCERTAINTY: &str = "has no uncertainty of its own";

/// Shapes that are stated by a half width, and the square of what that is divided by.
pub(super) const HALF_WIDTHS: [(&str, f64); 3] =
    [("rectangular", 3.0), ("triangular", 6.0), ("arcsine", 2.0)];

/// What a shape's half width is divided by.
pub(super) fn divisor_of(shape: &str) -> Option<f64> {
    HALF_WIDTHS.iter().find(|(name, _)| *name == shape).map(|(_, square)| square.sqrt())
}

pub(super) fn near(a: f64, b: f64) -> bool {
    is_near(a, b, 0.01)
}

/// Two digits, of which the least are 1.0, are rounded by up to this share.
const SAME: f64 = 0.05;

pub(super) fn is_near(a: f64, b: f64, share: f64) -> bool {
    a == b || (a / b - 1.0).abs() < share
}

/// Whether a row whose shape is not normal becomes a normal input: its uncertainty is divided by
/// something else than the shape's divisor.
fn is_normal_here(row: &Row) -> bool {
    let usual = row.distribution.and_then(divisor_of);
    row.width.is_some()
        && row.divisor.zip(usual).is_some_and(|(divisor, usual)| !near(divisor, usual))
}
