//! The model of a budget: that of its equation, else the sum of its quantities, each times its sensitivity
//! coefficient.

use std::path::Path;

use super::ask::ReadSheet;
use super::columns::Column;
use super::document::document;
use super::equation::Equation;
use super::options::Coefficients;
use super::rows::{Row, RowKind, Rows, is_same_unit};
use super::stated::StatedFigure;
use super::table::Header;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::fact;
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::number::Shortest;
use gumption_engine::propagate::gum::{self, Gum};
use gumption_files::read_text;
use gumption_units::{Unit, listed};

/// A model's result by the law of propagation, and its unit.
pub(super) fn result_of(model: &str) -> Option<(Gum, Unit)> {
    let file = read_text("the model", model, Path::new(""), &[]).ok()?;
    let evaluated = gum::evaluate(&file.task, file.task.rows.first()?);
    let output = file.task.model.outputs.first()?;
    Some((evaluated.outputs.into_iter().next()??, output.quantity.unit.clone()))
}

/// What is wrong with a model, at most five mistakes; `None` where nothing is.
fn mistakes_of(model: &str) -> Option<String> {
    let found = read_text("the model", model, Path::new(""), &[]).err()?;
    let first: Vec<String> = found.0.iter().take(5).map(|fault| fault.kind.to_string()).collect();
    Some(first.join("; "))
}

/// A model with what its rows are multiplied by in the unit of the result; no factors where an equation says
/// how the result is made.
pub(super) struct ImportedModel {
    pub(super) text: String,
    pub(super) factors: Option<Vec<f64>>,
}

/// What the sheet says of its result besides numbers.
struct OfResult<'s> {
    name: String,
    unit: Option<String>,
    estimate: Option<&'s StatedFigure>,
}

impl ReadSheet<'_> {
    /// The model of the rows; `None` after a mistake or a question.
    pub(super) fn model(
        &self,
        header: &Header,
        rows: &Rows,
        equations: &[Equation],
        stated: &[StatedFigure],
        title: &str,
    ) -> Option<ImportedModel> {
        let of_result = self.of_result(header, rows, stated)?;
        if equations.is_empty() {
            self.linear(header, &rows.quantities, stated, &of_result, title)
        } else {
            self.of_equation(header, rows, equations, &of_result, title)
        }
    }

    /// The name and the unit of the result, and its estimate.
    fn of_result<'s>(
        &self,
        header: &Header,
        rows: &Rows,
        stated: &'s [StatedFigure],
    ) -> Option<OfResult<'s>> {
        let line =
            rows.of_result.iter().find(|row| row.kind == RowKind::Result).map(|row| row.line);
        let name = line.map_or_else(String::new, |line| self.name_of_result(header, line));
        let is_taken = |name: &str| rows.quantities.iter().any(|row| row.name == name);
        let name = match name.as_str() {
            "" if is_taken("y") => "y_result".to_owned(),
            "" => "y".to_owned(),
            name if is_taken(name) => format!("{name}_result"),
            name => name.to_owned(),
        };
        let mut units: Vec<&str> = stated.iter().map(|figure| figure.cell.unit.as_str()).collect();
        units.retain(|unit| !unit.is_empty());
        // the estimate's unit is that of the result, and figures of uncertainty may be shares of it
        let estimate = stated.iter().find(|figure| figure.is_estimate());
        let of_estimate =
            estimate.map(|estimate| estimate.cell.unit.as_str()).filter(|unit| !unit.is_empty());
        let own = units
            .iter()
            .copied()
            .find(|unit| Unit::parse(unit).is_ok_and(|parsed| !parsed.is_relative()));
        let unit = self.options.unit.as_deref().or(of_estimate).or(own).map(str::to_owned);
        if let Some(unit) = self.options.unit.as_deref().filter(|unit| Unit::parse(unit).is_err()) {
            self.fail(header.first, format!("`--unit {unit}`: it is no unit that is known"));
            return None;
        }
        Some(OfResult { name, unit, estimate })
    }

    fn of_equation(
        &self,
        header: &Header,
        all: &Rows,
        equations: &[Equation],
        of_result: &OfResult,
        title: &str,
    ) -> Option<ImportedModel> {
        let rows = all.quantities.as_slice();
        let last = equations.last()?;
        let line = last.line;
        let used: Vec<String> = equations.iter().flat_map(Equation::names).collect();
        for row in rows.iter().filter(|row| !used.contains(&row.name)) {
            self.ask(
                row.line..=row.line,
                format!("`{}` is not in the equation `{} = {}`", row.name, last.name, last.formula),
                ["of no account", "missing in the equation"],
                format!(
                    "`--row ignore={}`, or `--equation \"{} = FORMULA\"`",
                    row.line + 1,
                    last.name
                ),
            );
        }
        let has_estimates = rows.iter().any(|row| row.estimate.is_some());
        let needed = rows.iter().find(|row| row.estimate.is_none() && used.contains(&row.name));
        if let Some(row) =
            needed.filter(|_| has_estimates || header.place(Column::Estimate).is_none())
        {
            let is_sum = !last.formula.contains(['*', '/', '^', '(']);
            if has_estimates || !is_sum {
                self.fail(row.line, format!("the equation `{} = {}` needs the estimate of `{}`, and the row has none: write it, or say its column with `--column estimate=COLUMN`", last.name, last.formula, row.name));
            }
        }
        let has_estimate = of_result.estimate.is_some();
        for row in rows {
            let is_celsius = Unit::parse(&row.unit).is_ok_and(|unit| unit.offset() != 0.0);
            if is_celsius
                && !has_estimate
                && !self.options.numbers
                && used.contains(&row.name)
                && row.sensitivity.is_none()
                && all.said(row.line) != Some(RowKind::Quantity)
            {
                self.ask(
                    row.line..=row.line,
                    format!("`{}` in {} of an equation whose result the sheet does not state", row.name, row.unit),
                    ["a temperature, which counts from the zero of its scale", "a difference of temperatures"],
                    format!("`--row quantity={}` (a temperature), or write `K` as its unit (a difference)", row.line + 1),
                );
            }
        }
        self.log.is_clean().then_some(())?;
        let mut formulas: Vec<(String, String)> = equations
            .iter()
            .map(|equation| (equation.name.clone(), equation.formula.clone()))
            .collect();
        if let Some((name, _)) =
            formulas.last_mut().filter(|(name, _)| rows.iter().any(|row| row.name == *name))
        {
            name.push_str("_result");
        }
        let unit = match &of_result.unit {
            Some(unit) => unit.clone(),
            None if self.options.numbers => {
                self.ask_unit_of_result(header, "the equation is one of numbers");
                return None;
            }
            None => self.usual_unit(rows, equations),
        };
        let with = document(title, rows, &formulas, &unit, true);
        let without = document(title, rows, &formulas, &unit, false);
        let text = if self.options.numbers { without.clone() } else { with };
        if let Some(mistakes) = mistakes_of(&text) {
            let without_units = mistakes_of(&without).is_none();
            if without_units && !self.options.numbers {
                self.ask(
                    line..=line,
                    format!("the equation `{} = {}` does not pass the check of units ({})", last.name, last.formula, mistakes),
                    ["an equation of the quantities, which lacks the units of its numbers (`T - 20 [°C]`)", "one of the numbers in the units of the sheet"],
                    format!("`--equation \"{} = FORMULA\"`, or `--numbers`", last.name),
                );
            } else {
                self.fail(line, format!("the model of this budget has mistakes: {mistakes}"));
            }
            return None;
        }
        if !self.options.numbers && !has_estimate {
            self.numbers_of_units(&text, &without, last)?;
        }
        for (name, formula) in &formulas {
            self.note(fact!("import.equation", name, formula));
        }
        Some(ImportedModel { text, factors: None })
    }

    /// Asks whether a number of the equation converts units, where the sheet states no estimate of the result and
    /// the numbers without units give another one.
    fn numbers_of_units(&self, with: &str, without: &str, equation: &Equation) -> Option<()> {
        let Some(number) = conversion_number(&equation.formula) else { return Some(()) };
        let (Some((checked, unit)), Some((numbers, _))) = (result_of(with), result_of(without))
        else {
            return Some(());
        };
        let is_same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
        if is_same(checked.estimate, numbers.estimate)
            && is_same(checked.standard_uncertainty, numbers.standard_uncertainty)
        {
            return Some(());
        }
        self.ask(
            equation.line..=equation.line,
            format!("the number {number} of the equation may convert units, and the sheet states no result"),
            [
                &format!("a number of the formula: the result is {}", unit.after(&Shortest(to_15_digits(checked.estimate)).to_string())) as &str,
                &format!("a conversion of the numbers of the rows: the result is {}", Shortest(to_15_digits(numbers.estimate))),
            ],
            "`--equation \"y = FORMULA\"` without that number, `--numbers` with `--unit UNIT`, or write the estimate of \
             the result into a row",
        );
        None
    }

    /// The usual unit of what the equations give; empty for a plain number.
    fn usual_unit(&self, rows: &[Row], equations: &[Equation]) -> String {
        let mut scope = Scope::new();
        for row in rows {
            let unit = Unit::parse(&row.unit).unwrap_or_default();
            scope.define(row.name.as_str(), Typing::in_unit(&unit));
        }
        let mut last = None;
        for equation in equations {
            let typing = Formula::parse(&equation.formula)
                .ok()
                .and_then(|formula| formula.check(&scope).ok());
            let Some(typing) = typing else { return String::new() };
            scope.define(equation.name.as_str(), typing);
            last = typing.dimension.filter(|dimension| !dimension.is_none());
        }
        let unit = last.map(|dimension| dimension.usual_unit()).unwrap_or_default();
        if !unit.is_empty() {
            self.note(fact!("import.unit-of-result", unit = &unit));
        }
        unit
    }

    fn linear(
        &self,
        header: &Header,
        rows: &[Row],
        stated: &[StatedFigure],
        of_result: &OfResult,
        title: &str,
    ) -> Option<ImportedModel> {
        let first = rows.first()?.line;
        let lines = first..=rows.last()?.line;
        let has_coefficients = rows.iter().any(|row| row.sensitivity.is_some());
        let is_zero = |row: &Row| row.estimate.is_none_or(|x| x == 0.0);
        let are_deviations = rows.iter().all(is_zero);
        let one = self.options.coefficients == Some(Coefficients::One);
        if !has_coefficients && !one && !are_deviations && of_result.estimate.is_none() {
            self.ask(
                lines,
                "there is neither an equation nor a column of sensitivity coefficients",
                ["the sum of the quantities", "another function of them"],
                "`--coefficients one`, `--column sensitivity=COLUMN`, `--equation \"y = FORMULA\"`, or `--row result=N` if one of the rows is the result",
            );
            return None;
        }
        for row in rows.iter().filter(|row| has_coefficients && row.sensitivity.is_none()) {
            if row.standard_uncertainty() > 0.0 || !is_zero(row) {
                self.fail(
                    row.line,
                    format!(
                        "`{}` has no sensitivity coefficient, and other rows have one: write it",
                        row.name
                    ),
                );
            }
        }
        let unit = self.unit_of_sum(header, rows, of_result)?;
        let whole = Unit::parse(&unit).ok()?;
        let mut factors = Vec::new();
        for row in rows {
            factors.push(self.factor(rows, (row, stated), (&unit, &whole))?);
        }
        self.log.is_clean().then_some(())?;
        let written = |x: f64| Shortest(x).to_string();
        let sum: f64 = to_15_digits(
            rows.iter().zip(&factors).map(|(row, c)| c * row.estimate.unwrap_or(0.0)).sum(),
        );
        let constant = self.constant(header, rows, &factors, sum, of_result, &whole)?;
        let mut terms: Vec<String> = Vec::new();
        if constant != 0.0 {
            self.note(fact!("import.constant", constant));
            terms.push(written(constant));
        }
        terms.extend(rows.iter().zip(&factors).map(|(row, factor)| match *factor {
            1.0 => row.name.clone(),
            factor => format!("({})*{}", written(to_15_digits(factor)), row.name),
        }));
        let formulas = [(of_result.name.clone(), terms.join(" + "))];
        let [(name, formula)] = &formulas;
        let shown = if unit.is_empty() { "1" } else { &unit };
        self.note(fact!("import.sum", name, formula, unit = shown));
        let text = document(title, rows, &formulas, &unit, false);
        if let Some(mistakes) = mistakes_of(&text) {
            self.fail(header.first, format!("the model of this budget has mistakes: {mistakes}"));
            return None;
        }
        Some(ImportedModel { text, factors: Some(factors) })
    }

    fn ask_unit_of_result(&self, header: &Header, why: &str) {
        self.ask(
            header.first..=header.line,
            format!("nothing says the unit of the result: {why}"),
            [],
            "`--unit UNIT`, or write the unit into the row of the result",
        );
    }

    /// The unit of the result of a sum: stated, that of the contributions, or that which all rows make.
    fn unit_of_sum(&self, header: &Header, rows: &[Row], of_result: &OfResult) -> Option<String> {
        if let Some(unit) = &of_result.unit {
            return Some(unit.clone());
        }
        let contributions = rows.iter().filter_map(|row| row.contribution.as_ref());
        let is_share = |unit: &str| Unit::parse(unit).is_ok_and(|unit| unit.is_relative());
        let are_shares = rows.iter().all(|row| is_share(&row.unit));
        let mut of_contributions: Vec<&str> =
            contributions.map(|cell| cell.unit.as_str()).collect();
        of_contributions.retain(|unit| !unit.is_empty() && (are_shares || !is_share(unit)));
        if rows.iter().all(|row| row.unit.is_empty() && row.unit_of_sensitivity.is_none())
            && of_contributions.is_empty()
        {
            return Some(String::new());
        }
        let of_row = |row: &Row| match &row.unit_of_sensitivity {
            Some(unit) => of_coefficient(unit, &row.unit),
            // 1 of a quantity in the unit of the result
            None => row.sensitivity.is_none_or(|c| c.abs() == 1.0).then(|| row.unit.clone()),
        };
        let units: Option<Vec<String>> = rows.iter().map(of_row).collect();
        let with_unit =
            rows.iter().filter(|row| row.unit_of_sensitivity.is_some()).find_map(of_row);
        if let Some(units) = units {
            let same_dimension = |unit: &String| {
                let pair = Unit::parse(unit).ok().zip(Unit::parse(&units[0]).ok());
                pair.is_some_and(|(a, b)| a.is_compatible(&b) && a.is_relative() == b.is_relative())
            };
            let are_same = units.iter().all(|unit| is_same_unit(unit, &units[0]));
            if are_same || of_contributions.is_empty() && units.iter().all(same_dimension) {
                return Some(units[0].clone());
            }
        }
        if let Some(unit) = of_contributions.first() {
            return Some((*unit).to_owned());
        }
        if let Some(unit) = with_unit.filter(|unit| !is_share(unit)) {
            return Some(unit);
        }
        let all: Vec<String> = rows
            .iter()
            .map(|row| format!("`{}`", if row.unit.is_empty() { "1" } else { &row.unit }))
            .collect();
        let mut distinct: Vec<String> = Vec::new();
        all.into_iter().for_each(|unit| {
            if !distinct.contains(&unit) {
                distinct.push(unit)
            }
        });
        self.ask_unit_of_result(
            header,
            &format!("the quantities are in {}", listed(&distinct, " and ")),
        );
        None
    }

    /// What the numbers of a row are multiplied by; `None` after a mistake or a question.
    fn factor(
        &self,
        rows: &[Row],
        (row, stated): (&Row, &[StatedFigure]),
        (unit, whole): (&str, &Unit),
    ) -> Option<f64> {
        let own = Unit::parse(&row.unit).ok()?;
        let c = row.sensitivity.unwrap_or(1.0);
        let line = row.line;
        let shown = |unit: &str| if unit.is_empty() { "1".to_owned() } else { unit.to_owned() };
        if c == 0.0
            || row.sensitivity.is_none()
                && row.standard_uncertainty() == 0.0
                && row.estimate.is_none_or(|x| x == 0.0)
        {
            return Some(c);
        }
        // a sheet that states units of coefficients states all of them
        let states_units = rows.iter().any(|row| row.unit_of_sensitivity.is_some());
        if row.sensitivity.is_some() && states_units {
            let of_c = row.unit_of_sensitivity.as_deref().unwrap_or("1");
            let per = Unit::parse(of_c).ok()?;
            let product = per.dimension().checked_mul(own.dimension());
            if product == Some(whole.dimension()) {
                let scale = per.factor() * own.factor() / whole.factor();
                let is_one = (scale - 1.0).abs() < 1e-12;
                return Some(if is_one { c } else { to_15_digits(c * scale) });
            }
            self.fail(
                line,
                format!(
                    "the coefficient of `{}` is in `{of_c}`, and times `{}` it makes no `{}`",
                    row.name,
                    shown(&row.unit),
                    shown(unit)
                ),
            );
            return None;
        }
        let scale = Unit::conversion_factor(&own, whole).ok();
        let is_alike = scale.is_some_and(|scale| (scale - 1.0).abs() < 1e-12);
        if row.sensitivity.is_none() {
            let counts_alike = own.has_zero_of(whole) || row.estimate.is_none_or(|x| x == 0.0);
            return match scale.filter(|_| counts_alike) {
                Some(scale) => Some(scale),
                None => {
                    self.fail(line, format!("`{}` is in `{}`, and the result in `{}`: its sensitivity coefficient or the equation is missing", row.name, shown(&row.unit), shown(unit)));
                    None
                }
            };
        }
        if is_alike {
            return Some(c);
        }
        let [of_unit, ratio] = [format!("{} {} per {}", Shortest(c), shown(unit), shown(&row.unit)), match scale {
            Some(scale) => format!("a plain number, {} {} per {}", Shortest(to_15_digits(c * scale)), shown(unit), shown(&row.unit)),
            None => "in another unit, which is to be written into the cell or a column `Unit of c_i`".to_owned(),
        }];
        match (self.options.coefficients, scale) {
            (Some(Coefficients::Units), _) => return Some(c),
            (Some(Coefficients::Ratios), Some(scale)) => return Some(to_15_digits(c * scale)),
            _ => {}
        }
        // what the sheet states confirms it: a row of another contribution is refused
        let is_confirmed = row.contribution.as_ref().is_some_and(|cell| cell.value != 0.0)
            || scale.is_none() && stated.iter().any(StatedFigure::is_uncertainty) && {
                let part = |row: &Row| row.sensitivity.unwrap_or(1.0) * row.standard_uncertainty();
                let all: f64 = rows.iter().map(|row| part(row) * part(row)).sum();
                // half of the variance cannot go unnoticed
                part(row) * part(row) > 0.5 * all
            };
        if is_confirmed {
            return Some(c);
        }
        let more = if scale.is_some() {
            "`--coefficients units` or `--coefficients ratios`"
        } else {
            "`--coefficients units`, or `--column sensitivity-unit=COLUMN`"
        };
        self.ask(
            line..=line,
            format!("the coefficient {} of `{}` has no unit, and the quantity is in `{}`, the result in `{}`", Shortest(c), row.name, shown(&row.unit), shown(unit)),
            [&of_unit as &str, &ratio],
            more,
        );
        None
    }

    /// What is added to the sum of the products for the estimate of the result; `None` after a question.
    fn constant(
        &self,
        header: &Header,
        rows: &[Row],
        factors: &[f64],
        sum: f64,
        of_result: &OfResult,
        whole: &Unit,
    ) -> Option<f64> {
        // a sum of quantities in one unit, each with its sign
        let is_plain = |(row, factor): (&Row, &f64)| {
            let is_in_unit = Unit::parse(&row.unit)
                .is_ok_and(|own| own.is_compatible(whole) && own.has_zero_of(whole));
            let is_one = row.sensitivity.is_none_or(|c| c.abs() == 1.0);
            row.estimate.is_none_or(|x| x == 0.0) || *factor == 0.0 || is_one && is_in_unit
        };
        let has_signs = !header
            .place(Column::Sensitivity)
            .is_some_and(|place| header.heading(place).contains('|'));
        let is_sum = rows.iter().zip(factors).all(is_plain)
            && (has_signs
                || rows.iter().filter(|row| row.estimate.is_some_and(|x| x != 0.0)).count() < 2);
        let said = self.options.estimate.as_deref().map(str::trim);
        if said == Some("sum") || is_sum && said.is_none() {
            return Some(0.0);
        }
        if let Some(said) = said {
            return match super::number::number(said, false) {
                Some(value) => Some(to_15_digits(value - sum)),
                None => {
                    self.fail(header.first, format!("`--estimate {said}`: it is a number in the unit of the result, or `sum`"));
                    None
                }
            };
        }
        if let Some(estimate) = of_result.estimate {
            let in_unit = estimate.in_unit(whole);
            if let Some(value) = in_unit {
                let rest = to_15_digits(value - sum);
                let rounding = 1.2 * estimate.cell.half_digit.abs();
                return Some(if rest.abs() <= rounding.min(1e-6 * value.abs()) {
                    0.0
                } else {
                    rest
                });
            }
        }
        self.ask(
            header.first..=rows.last()?.line,
            "the sheet states coefficients and no estimate of the result",
            [
                &format!("the sum of the products, {}", Shortest(sum)) as &str,
                "another number, as of a product of the quantities",
            ],
            "`--estimate sum`, `--estimate NUMBER`, or `--row result=N`",
        );
        None
    }
}

/// The unit of the result of which a coefficient is stated: what stands above the stroke, if that
/// times nothing else is the product.
fn of_coefficient(coefficient: &str, unit: &str) -> Option<String> {
    let (per, own) = (Unit::parse(coefficient).ok()?, Unit::parse(unit).ok()?);
    let whole = per.dimension().checked_mul(own.dimension())?;
    let scale = per.factor() * own.factor();
    let above = coefficient.split_once('/').map_or(coefficient, |(above, _)| above).trim();
    [above, unit].into_iter().map(str::trim).find_map(|text| {
        let found = Unit::parse(text).ok().filter(|_| !text.is_empty())?;
        let fits = found.dimension() == whole && (found.factor() / scale - 1.0).abs() < 1e-12;
        fits.then(|| text.to_owned())
    })
}

/// The first number of a formula that may convert units: not one of geometry, as 2, 4 and a half are.
fn conversion_number(formula: &str) -> Option<String> {
    let mut before = ' ';
    let mut word = String::new();
    for c in formula.chars().chain([' ']) {
        let is_exponent = word.ends_with(['e', 'E'])
            && matches!(c, '-' | '+')
            && word.starts_with(|c: char| c.is_ascii_digit());
        if c.is_alphanumeric() || matches!(c, '_' | '.') || is_exponent {
            word.push(c);
            continue;
        }
        let number = word.parse::<f64>().ok().filter(|_| before != '^');
        if let Some(number) =
            number.filter(|number| !(0.1..10.0).contains(number) && *number != 0.0)
        {
            return Some(format!("{}", Shortest(number)));
        }
        if !word.is_empty() || c != ' ' {
            before = if c == ' ' { before } else { c };
        }
        word.clear();
    }
    None
}
