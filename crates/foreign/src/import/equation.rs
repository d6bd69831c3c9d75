//! The equations of a sheet: lines such as `R = U/I`, and cells behind `Equation`.

use super::ask::ReadSheet;
use super::columns::{self, identifier};
use super::grid::Cells;
use super::number::{expression, number_with_unit};
use super::words;
use gumption_columns::separator::Separator;
use gumption_engine::model::formula::{Formula, check_name};
use gumption_units::Unit;

/// Equations of a sheet, at most.
const MOST_EQUATIONS: usize = 200;

/// An equation of the sheet.
#[derive(Clone, Debug, PartialEq)]
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

/// A text with a sign of equality, and where it stands.
struct WrittenEquation {
    line: usize,
    text: String,
    /// Whether a label calls it the equation.
    is_labelled: bool,
    /// The text of the next cell.
    next: String,
}

impl ReadSheet<'_> {
    /// The equations of the sheet, that of the result last; `known` are the names of its rows. `None` after a
    /// mistake or a question.
    pub(super) fn equations(&self, known: &[String]) -> Option<Vec<Equation>> {
        if let Some(said) = &self.options.equation {
            let Some((left, right)) = said.split_once('=') else {
                self.fail(0, format!("`--equation \"{said}\"`: write `NAME = FORMULA`"));
                return None;
            };
            let name = identifier(left);
            return match (check_name(&name), Formula::parse(right)) {
                (Ok(()), Ok(_)) => {
                    Some(vec![Equation { line: 0, name, formula: right.trim().to_owned() }])
                }
                (Ok(()), Err(error)) => {
                    self.fail(0, format!("`--equation \"{said}\"`: {error}"));
                    None
                }
                (Err(_), _) => {
                    self.fail(0, format!("`--equation \"{said}\"`: `{}` is no name", left.trim()));
                    None
                }
            };
        }
        let mut read: Vec<Equation> = Vec::new();
        for written in written_equations(self.cells) {
            if let Some(equation) = self.equation(&written, known)? {
                let is_repeated = |of: &Equation| {
                    let same = |text: &str| text.split_whitespace().collect::<String>();
                    of.name == equation.name && same(&of.formula) == same(&equation.formula)
                };
                if read.len() <= MOST_EQUATIONS && !read.iter().any(is_repeated) {
                    read.push(equation);
                }
            }
        }
        if let Some(equation) = read.get(MOST_EQUATIONS) {
            self.fail(
                equation.line,
                format!("the sheet has more than {MOST_EQUATIONS} equations; a budget has fewer"),
            );
            return None;
        }
        self.in_order(read, known)
    }

    /// An equation of quantities of the sheet; `Some(None)` of other texts, `None` after a mistake.
    fn equation(&self, written: &WrittenEquation, known: &[String]) -> Option<Option<Equation>> {
        let WrittenEquation { line, text, is_labelled, next } = written;
        let comma = self.cells.decimal_comma();
        let (left, right) = text.split_once('=').unwrap_or(("", text));
        let (left, right) = (left.trim(), right.trim());
        if is_of_uncertainties(left, right) {
            return Some(None);
        }
        let names = |text: &str| {
            let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            words.any(|word| {
                let word = word.trim_start_matches(|c: char| c.is_ascii_digit());
                known.iter().any(|name| name == word)
            })
        };
        let names_quantity = names(right);
        let name = identifier(left);
        let is_name = check_name(&name).is_ok()
            && !left.starts_with(|c: char| c.is_ascii_digit())
            && !left.contains(['*', '·', '×', '^', '+', '/', '\'', '"']);
        // `y = a - 0,5*b` between commas is cut
        let is_cut = next.starts_with(|c: char| c.is_ascii_digit())
            && self.cells.separator() == Some(Separator::Comma)
            && text.ends_with(|c: char| c.is_ascii_digit())
            && (names_quantity || names(next));
        if is_name && is_cut {
            self.fail(
                *line,
                format!("`{text}` may go on in the next cell: put an equation in quotation marks"),
            );
            return None;
        }
        let has_sum = is_name && right.contains(['Σ', '∑', '∏', '∫']);
        let formula = as_formula(right, comma);
        let parsed = Formula::parse(&formula);
        match parsed {
            Ok(parsed) if is_name && parsed.names().next().is_some() => {
                let all_known =
                    parsed.names().all(|(used, _)| known.iter().any(|name| name == used));
                Some((names_quantity || all_known || *is_labelled).then_some(Equation {
                    line: *line,
                    name,
                    formula,
                }))
            }
            Ok(parsed) if parsed.names().next().is_none() => Some(None),
            _ if !names_quantity && !has_sum => Some(None),
            // `U = 5 V`
            _ if number_with_unit(right, comma)
                .is_some_and(|(_, unit)| Unit::parse(unit).is_ok()) =>
            {
                Some(None)
            }
            parsed => {
                let reason = match parsed {
                    Err(error) => error.to_string(),
                    Ok(_) => "its left side is no name".to_owned(),
                };
                self.ask(
                    *line..=*line,
                    format!("`{text}` cannot be read as an equation, {reason}"),
                    ["the equation of the result", "a remark"],
                    "`--equation \"y = FORMULA\"`, or correct the line",
                );
                None
            }
        }
    }

    /// The equation of the result last, with those that it needs before it.
    fn in_order(&self, read: Vec<Equation>, known: &[String]) -> Option<Vec<Equation>> {
        let names: Vec<Vec<String>> = read.iter().map(Equation::names).collect();
        let is_whole = |place: &usize| {
            names[*place].iter().all(|name| {
                known.contains(name) || read.iter().any(|quantity| quantity.name == *name)
            })
        };
        let whole: Vec<usize> = (0..read.len()).filter(is_whole).collect();
        if let Some(equation) = read.first().filter(|_| whole.is_empty()) {
            let lacks =
                names[0].iter().find(|name| !known.contains(name)).cloned().unwrap_or_default();
            self.ask(
                equation.line..=equation.line,
                format!(
                    "the equation `{} = {}` needs `{lacks}`, which no row is called",
                    equation.name, equation.formula
                ),
                ["the equation of the result, with other names", "a remark"],
                "`--equation \"y = FORMULA\"` with the names of the rows",
            );
            return None;
        }
        let is_used = |place: &usize| {
            whole.iter().any(|other| other != place && names[*other].contains(&read[*place].name))
        };
        let last: Vec<usize> = whole.iter().copied().filter(|place| !is_used(place)).collect();
        let result = match last.as_slice() {
            [] => {
                return whole.is_empty().then(Vec::new).or_else(|| {
                    self.fail(
                        read[0].line,
                        format!("`{}` and another equation need each other", read[0].name),
                    );
                    None
                });
            }
            [one] => *one,
            [first, second, ..] => {
                let [first, second] = [*first, *second].map(|place| &read[place]);
                self.ask(
                    first.line.min(second.line)..=first.line.max(second.line),
                    "two equations can be that of the result",
                    [
                        &format!("`{} = {}`", first.name, first.formula) as &str,
                        &format!("`{} = {}`", second.name, second.formula),
                    ],
                    "`--equation \"y = FORMULA\"`",
                );
                return None;
            }
        };
        let mut needed = vec![result];
        let mut next = 0;
        while let Some(&place) = needed.get(next) {
            for name in &names[place] {
                let by = whole.iter().copied().find(|by| read[*by].name == *name);
                if let Some(by) = by.filter(|_| !known.contains(name)) {
                    needed.retain(|other| *other != by || next == 0);
                    needed.push(by);
                }
            }
            next += 1;
            if next > 100 {
                self.fail(read[result].line, "the equations need each other");
                return None;
            }
        }
        let mut ordered: Vec<Equation> = Vec::new();
        for place in needed.into_iter().rev() {
            if !ordered.contains(&read[place]) {
                ordered.push(read[place].clone());
            }
        }
        Some(ordered)
    }
}

/// The texts of a sheet that may be equations: with `=`, or behind a label.
fn written_equations(cells: &Cells) -> Vec<WrittenEquation> {
    let mut found = Vec::new();
    for line in 0..cells.lines() {
        let mut is_behind_label = false;
        for (place, cell) in cells.row(line).iter().enumerate() {
            let text = cell.trim();
            if text.is_empty() {
                continue;
            }
            let label = |words: &str| {
                words::meaning("text", &columns::plain_case(words)) == Some("equation")
            };
            let behind = text
                .split_once(':')
                .filter(|(before, _)| label(before))
                .map(|(_, behind)| behind.trim());
            let text = behind.unwrap_or(text);
            let is_labelled =
                behind.is_some() || std::mem::replace(&mut is_behind_label, label(text));
            let is_one = text.contains('=') || is_labelled && !text.is_empty() && !is_behind_label;
            if is_one {
                let next = cells.text(line, place + 1).trim().to_owned();
                found.push(WrittenEquation { line, text: text.to_owned(), is_labelled, next });
            }
        }
    }
    found
}

/// The right side of an equation of a sheet as formulas are written.
pub(super) fn as_formula(right: &str, decimal_comma: bool) -> String {
    let points = if decimal_comma { with_points(right) } else { right.to_owned() };
    expression(&points).replace(';', ",")
}

/// Whether an equation says how the uncertainty of the result is made of others, `U = k*uc` or `u(y) =
/// sqrt(u(a)^2 + u(b)^2)`: that is computed here. `U` alone may be a voltage, whose parts have other names.
pub(super) fn is_of_uncertainties(left: &str, right: &str) -> bool {
    const FUNCTIONS: [&str; 5] = ["u_c(", "uc(", "u_i(", "u(", "U("];
    let compact: String = left.split_whitespace().collect();
    let is_combined = FUNCTIONS.iter().any(|function| compact.starts_with(function))
        || matches!(compact.as_str(), "uc" | "u_c");
    if !is_combined && !matches!(compact.as_str(), "U" | "U95" | "u") {
        return false;
    }
    // `u(a)` is one name, whatever `a` is
    let mut right: String = right.split_whitespace().collect();
    let uncertainty = |text: &str| {
        let at = FUNCTIONS.iter().filter_map(|function| text.find(function)).min()?;
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
fn with_points(text: &str) -> String {
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
