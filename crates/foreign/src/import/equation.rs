//! The equations of a sheet: lines such as `R = U/I`, and cells behind `equation`.

use std::collections::{HashMap, HashSet};

use super::Budget;
use super::columns;
use super::cut::Cut;
use super::grid::Cells;
use super::number::{expression, number_with_unit};
use super::rows::Row;
use gumption_engine::model::formula::{Formula, Scope, Typing, check_name};
use gumption_units::Unit;

/// An equation of the sheet.
#[derive(Clone, Debug)]
pub(super) struct Equation {
    pub(super) line: usize,
    pub(super) name: String,
    pub(super) formula: String,
}

impl Equation {
    /// The names that it needs.
    pub(super) fn names(&self) -> Vec<String> {
        let formula = Formula::parse(&self.formula).ok();
        formula.iter().flat_map(Formula::names).map(|(name, _)| name.to_owned()).collect()
    }
}

/// Whether the last of some equations, of which each may use those before it, is a sum of multiples of what
/// they name: such a one has sensitivities where nothing tells the estimates.
pub(super) fn is_linear(equations: &[Equation]) -> bool {
    let names: Vec<String> = equations.iter().flat_map(Equation::names).collect();
    // of no ratio that an equation would have
    let place = |i: usize| [1.37 + 0.61 * i as f64, 2.93 - 0.17 * i as f64];
    let at = |[first, second]: [f64; 2]| {
        let mut values: HashMap<String, f64> = HashMap::new();
        for (i, name) in names.iter().enumerate() {
            let [a, b] = place(i);
            values.entry(name.clone()).or_insert(first * a + second * b);
        }
        let mut last = None;
        for equation in equations {
            let formula = Formula::parse(&equation.formula).ok()?;
            let value = formula.evaluate(&Scope::new(), &values).ok()?;
            values.insert(equation.name.clone(), value);
            last = Some(value);
        }
        last.filter(|value| value.is_finite())
    };
    let [whole, first, second, none] = [[1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]].map(at);
    let (Some(whole), Some(first), Some(second), Some(none)) = (whole, first, second, none) else {
        return false;
    };
    let size = whole.abs() + first.abs() + second.abs() + none.abs();
    (whole - first - second + none).abs() <= 1e-9 * size
}

/// A text that looks like an equation and cannot be read as one.
#[derive(Clone, Debug)]
pub(super) struct Unread {
    pub(super) line: usize,
    /// The name on its left side.
    name: String,
    pub(super) text: String,
    pub(super) reason: String,
    /// Whether a label calls it the equation.
    pub(super) is_labelled: bool,
    /// Whether an equation of that name stands before it.
    is_repeated: bool,
    /// Whether it is one only if it names quantities of the sheet: it has no sign of an operation.
    needs_names: bool,
}

/// The equations of a sheet, that of the result last, and what could not be read.
#[derive(Clone, Debug, Default)]
pub(super) struct Equations {
    pub(super) read: Vec<Equation>,
    pub(super) unread: Vec<Unread>,
    /// Cells with an equation that may go on in the next ones.
    cut: Vec<Cut>,
}

/// Words before an equation.
const LABELS: [&str; 23] = [
    "model function",
    "measurement model",
    "measurement equation",
    "mathematical model of the measurement",
    "modellfunktion",
    "messgleichung",
    "fonction de mesure",
    "ecuación",
    "modelo",
    "modelo matemático",
    "fórmula",
    "equation",
    "formula",
    "model",
    "model equation",
    "gleichung",
    "formel",
    "modell",
    "modellgleichung",
    "équation",
    "formule",
    "modèle",
    "mathematical model",
];

impl Equations {
    /// All that a sheet holds, in its order.
    pub(super) fn of(cells: &Cells) -> Self {
        let mut found = Self::default();
        for line in 0..cells.lines() {
            let row = cells.row(line);
            for (place, cell) in row.iter().enumerate() {
                let label = columns::plain(cell);
                let is_label = LABELS.contains(&label.as_str());
                let at = if is_label {
                    let behind = row.iter().enumerate().skip(place + 1);
                    behind.into_iter().find(|(_, cell)| !cell.trim().is_empty())
                } else {
                    Some((place, cell)).filter(|(_, cell)| cell.contains('='))
                };
                let Some((at, written)) = at else { continue };
                let behind_label = LABELS.iter().find_map(|label| {
                    let lower = written.to_lowercase();
                    lower.strip_prefix(label)?.trim_start().strip_prefix(':')?;
                    written.get(written.find(':')? + 1..)
                });
                let text = behind_label.unwrap_or(written);
                found.cut.extend(Cut::of(cells, line, at, text));
                found.add(cells, line, text, is_label);
            }
        }
        found
    }

    fn add(&mut self, cells: &Cells, line: usize, written: &str, is_labelled: bool) {
        let Some((left, right)) = written.split_once('=') else {
            if is_labelled {
                self.without_name(cells, line, written, "it has no `=`");
            }
            return;
        };
        // `2y`, and not `1. R`
        let begins_with_factor = left.trim().starts_with(|c: char| c.is_ascii_digit())
            && !left.trim().contains([' ', '.', ')']);
        let is_product = left.contains(['*', '·', '×', '⋅', '^']) || begins_with_factor;
        if left.trim().is_empty() || is_product {
            self.without_name(cells, line, written, "its left side is no name");
            return;
        }
        let name = columns::identifier(left);
        if check_name(&name).is_err() {
            return;
        }
        if is_of_uncertainties(left, right) {
            return;
        }
        let is_known = self.read.iter().any(|known| known.name == name);
        let right = right.trim();
        let comma = cells.decimal_comma();
        let formula = as_formula(right, comma);
        match Formula::parse(&formula) {
            Ok(parsed) => {
                let same = |text: &str| text.split_whitespace().collect::<String>();
                let is_repeated = self
                    .read
                    .iter()
                    .any(|known| known.name == name && same(&known.formula) == same(&formula));
                if parsed.names().next().is_some() && !is_repeated {
                    self.read.push(Equation { line, name, formula });
                }
            }
            Err(error) => {
                let is_quantity = number_with_unit(right, comma)
                    .is_some_and(|(_, unit)| unit.is_empty() || Unit::parse(unit).is_ok());
                let has_operator = formula.contains(['*', '/', '^', '+', '-', '(']);
                let is_short = left.split_whitespace().count() <= 2;
                let has_sign = has_operator || formula.contains(['\\', 'Σ', '∑', '∏', '∫', '÷']);
                let is_one = is_short && formula.contains(char::is_alphabetic);
                if is_labelled && !is_known || (is_one && !is_quantity) {
                    let (text, reason) = (written.trim().to_owned(), error.to_string());
                    let (is_repeated, needs_names) = (is_known, !has_sign && !is_labelled);
                    let unread =
                        Unread { line, name, text, reason, is_labelled, is_repeated, needs_names };
                    self.unread.push(unread);
                }
            }
        }
    }

    /// The line and what is wrong, where the name of a row is a number's beginning.
    pub(super) fn cut_row(
        &self,
        is_name: impl Fn(usize, usize) -> bool,
    ) -> Option<(usize, String)> {
        self.cut.iter().find_map(|cut| cut.fault_of_row(&is_name))
    }

    /// Keeps a formula that gives nothing a name.
    fn without_name(&mut self, cells: &Cells, line: usize, written: &str, why: &str) {
        let right = written.rsplit_once('=').map_or(written, |(_, right)| right).trim();
        let Some(formula) = readable(right, cells.decimal_comma()) else { return };
        if Formula::parse(&formula).is_ok_and(|formula| formula.names().next().is_none()) {
            return;
        }
        self.unread.push(Unread {
            line,
            name: String::new(),
            text: written.trim().to_owned(),
            reason: format!("{why}; write `y = {right}`, with the name of the result"),
            is_labelled: false,
            is_repeated: false,
            needs_names: true,
        });
    }

    /// Leaves the equation of the result, last, and those that it needs.
    ///
    /// # Errors
    /// The line and the reason where it is not clear which one is the result's.
    pub(super) fn of_result(mut self, known: &[String]) -> Result<Self, (usize, String)> {
        if let Some(cut) = self.cut.iter().find_map(|cut| cut.fault(known)) {
            return Err(cut);
        }
        self.one_of_a_name(known)?;
        let names: Vec<Vec<String>> = self.read.iter().map(Equation::names).collect();
        let all_known: HashSet<&str> =
            known.iter().chain(self.read.iter().map(|of| &of.name)).map(String::as_str).collect();
        let is_known = |name: &String| all_known.contains(name.as_str());
        let all: Vec<usize> = (0..self.read.len()).collect();
        let are_whole: Vec<bool> = names.iter().map(|of| of.iter().all(is_known)).collect();
        let is_whole = |place: &usize| are_whole[*place];
        // a sheet may chain thousands of them
        let mut used: HashMap<&str, HashSet<usize>> = HashMap::new();
        for place in all.iter().copied().filter(is_whole) {
            for name in &names[place] {
                used.entry(name).or_default().insert(place);
            }
        }
        let is_used = |place: &usize| {
            let by = used.get(self.read[*place].name.as_str());
            by.is_some_and(|by| by.iter().any(|other| other != place))
        };
        let whole: Vec<usize> = all.iter().copied().filter(is_whole).collect();
        let among = if whole.is_empty() { all } else { whole };
        let last: Vec<usize> = among.iter().copied().filter(|place| !is_used(place)).collect();
        let result = match (last.as_slice(), among.first()) {
            ([one], _) => *one,
            ([first, second, ..], _) => {
                let [first, second] = [*first, *second].map(|place| &self.read[place]);
                return Err((
                    second.line,
                    format!(
                        "the result can be `{}` of line {} or `{}` of line {}: leave one equation, or \
                         let one use the other",
                        first.name,
                        first.line + 1,
                        second.name,
                        second.line + 1
                    ),
                ));
            }
            ([], Some(first)) => {
                let reason =
                    format!("`{}` and another equation need each other", self.read[*first].name);
                return Err((self.read[*first].line, reason));
            }
            ([], None) => return Ok(self),
        };
        let mut needed = vec![result];
        let mut next = 0;
        while let Some(&place) = needed.get(next) {
            for name in &names[place] {
                let by = self.read.iter().position(|equation| equation.name == *name);
                if let Some(by) = by.filter(|by| !needed.contains(by) && !known.contains(name)) {
                    needed.push(by);
                }
            }
            next += 1;
        }
        needed.reverse();
        self.read = needed.into_iter().map(|place| self.read[place].clone()).collect();
        Ok(self)
    }
}

impl Equations {
    /// Leaves one equation of each name, that of quantities which the sheet has where others are of
    /// something else.
    ///
    /// # Errors
    /// The line and the reason where two are of such quantities.
    fn one_of_a_name(&mut self, known: &[String]) -> Result<(), (usize, String)> {
        let defined: Vec<String> = self.read.iter().map(|of| of.name.clone()).collect();
        let is_whole = |equation: &Equation| {
            equation.names().iter().all(|name| {
                known.contains(name) || *name != equation.name && defined.contains(name)
            })
        };
        let mut left: Vec<Equation> = Vec::new();
        for equation in std::mem::take(&mut self.read) {
            match left.iter_mut().find(|of| of.name == equation.name) {
                None => left.push(equation),
                Some(first) if is_whole(first) && is_whole(&equation) => {
                    let reason = format!(
                        "`{0}` is `{1}` in line {2} and `{3}` in line {4}: leave one equation",
                        equation.name,
                        first.formula,
                        first.line + 1,
                        equation.formula,
                        equation.line + 1
                    );
                    return Err((equation.line, reason));
                }
                Some(first) if is_whole(&equation) => *first = equation,
                Some(_) => {}
            }
        }
        self.read = left;
        Ok(())
    }
}

/// The right side of an equation of a sheet as formulas are written.
fn as_formula(right: &str, decimal_comma: bool) -> String {
    let points = if decimal_comma { with_points(right) } else { right.to_owned() };
    with_degrees(&expression(&points).replace(';', ","))
}

/// `20 °C` as formulas have it, `20 [°C]`.
fn with_degrees(text: &str) -> String {
    let mut parts = text.split_inclusive(['C', 'F']);
    let is_bare = |part: &str| {
        let before = part.strip_suffix("°C").or_else(|| part.strip_suffix("°F"))?.trim_end();
        before.ends_with(|c: char| c.is_ascii_digit()).then(|| before.to_owned())
    };
    let written = |part: &str| match is_bare(part) {
        Some(before) => format!("{before} [{}]", if part.ends_with('C') { "°C" } else { "°F" }),
        None => part.to_owned(),
    };
    parts.by_ref().map(written).collect()
}

/// The same where it can be read.
pub(super) fn readable(right: &str, decimal_comma: bool) -> Option<String> {
    Some(as_formula(right, decimal_comma)).filter(|formula| Formula::parse(formula).is_ok())
}

/// Whether an equation says how the uncertainty of the result is made of others, `U = k*uc` or `u(y) =
/// sqrt(u(a)^2 + u(b)^2)`: that is computed here. `U` alone may be a voltage, whose parts have other names.
pub(super) fn is_of_uncertainties(left: &str, right: &str) -> bool {
    const FUNCTIONS: [&str; 5] = ["u_c(", "uc(", "u_i(", "u(", "U("];
    let compact: String = left.split_whitespace().collect();
    let is_combined = FUNCTIONS.iter().any(|of| compact.starts_with(of))
        || matches!(compact.as_str(), "uc" | "u_c");
    if !is_combined && !matches!(compact.as_str(), "U" | "U95" | "u") {
        return false;
    }
    // `u(a)` is one name, whatever `a` is
    let mut right: String = right.split_whitespace().collect();
    let uncertainty = |text: &str| {
        let at = FUNCTIONS.iter().filter_map(|of| text.find(of)).min()?;
        Some(at..at + text[at..].find(')')? + 1)
    };
    while let Some(span) = uncertainty(&right) {
        right.replace_range(span, "uc");
    }
    let words: Vec<&str> = right.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    let is_one = |word: &str| {
        matches!(word, "uc" | "u_c") || is_combined && word.starts_with('u') && word.len() <= 4
    };
    let is_factor = |word: &str| {
        matches!(word, "" | "k" | "kp" | "k_p" | "sqrt" | "sum" | "Σ" | "c_i" | "ci")
            || is_combined && word.starts_with('c') && word.len() <= 4
            || word.bytes().all(|c| c.is_ascii_digit())
    };
    words.iter().all(|word| is_one(word) || is_factor(word))
        && words.iter().any(|word| is_one(word))
}

/// Decimal commas of a formula as points; other commas separate arguments.
pub(super) fn with_points(text: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let is_digit = |place: Option<usize>| {
        place.and_then(|place| characters.get(place)).is_some_and(char::is_ascii_digit)
    };
    let point = |(place, c): (usize, &char)| {
        let is_mark = *c == ',' && is_digit(place.checked_sub(1)) && is_digit(Some(place + 1));
        if is_mark { '.' } else { *c }
    };
    characters.iter().enumerate().map(point).collect()
}

impl Budget<'_> {
    /// What the equations give the result, with the types of these names: nothing after a mistake.
    pub(super) fn typing_of(equations: &[Equation], known: Scope) -> Option<Typing> {
        let mut scope = known;
        let mut last = None;
        for equation in equations {
            let formula = Formula::parse(&equation.formula).ok()?;
            let typing = formula.check(&scope).ok()?;
            scope.define(equation.name.as_str(), typing);
            last = Some(typing);
        }
        last
    }

    /// Says which texts look like equations and could not be read; a mistake where nothing else tells
    /// how the result is made, or where the text is of a name of which another equation is read and
    /// names quantities; `known` are the names of the rows.
    pub(super) fn unread(
        &mut self,
        unread: &[Unread],
        has_other: bool,
        equations: &[Equation],
        known: &[String],
    ) {
        for Unread { line, name, text, reason, is_labelled, is_repeated, needs_names } in unread {
            let said = format!("`{text}` cannot be read as an equation: {reason}");
            let right = text.split_once('=').map_or(text.as_str(), |(_, right)| right);
            let mut words = right.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            // `2a`
            let names = words.any(|word| {
                let word = word.trim_start_matches(|c: char| c.is_ascii_digit());
                known.iter().any(|name| name == word)
            });
            if *needs_names && !names {
                continue;
            }
            let other = equations.iter().find(|equation| equation.name == *name);
            if let Some(other) = other.filter(|_| names) {
                let reason = format!(
                    "{said}; another equation of `{name}` stands in line {}",
                    other.line + 1
                );
                self.fail(*line, reason);
            } else if *is_repeated {
                // a statement of the result
            } else if has_other && !is_labelled {
                self.guessed.push(format!("line {}: {said}; it is not taken", line + 1));
            } else {
                self.fail(*line, said);
            }
        }
    }

    /// Says which rows no equation names; `used` are the names that they need.
    pub(super) fn unused(&mut self, rows: &[Row], equations: &[Equation], used: &[String]) {
        let measurand = equations.last().map(|equation| equation.name.clone()).unwrap_or_default();
        for row in rows.iter().filter(|row| !used.contains(&row.name)) {
            self.guessed.push(format!(
                "line {}: `{}` is not in the equation of {measurand}: it contributes nothing",
                row.line + 1,
                row.name
            ));
        }
    }
}
