//! Numbers of an equation that convert a unit of its quantities, which is converted once already: `R =
//! V/(1000*I)` of V in mV.
//!
//! A result that the sheet states says whether the equation is of numbers; where none is stated, such a number
//! is told with both readings.

use serde_json::Value;

use super::super::Budget;
use super::super::equation::Equations;
use super::{digits_for, result_of};
use crate::import::stated::Figure;
use gumption_engine::decimal::significant;
use gumption_engine::model::formula::Formula;
use gumption_engine::number::elementary;
use gumption_units::{FactorBase, Unit};

/// A number that is a size of units, and the words for those.
struct Conversion {
    size: f64,
    words: String,
}

/// Sizes of units are the same but for the rounding of their quotients.
const ROUNDED: f64 = 1e-12;

impl Budget<'_> {
    /// Refuses an equation with a number that is the size of a unit of its quantities, where the numbers of the
    /// rows without their units give another result; `made` is the model with a check of units.
    pub(super) fn converted_twice(&self, made: &str, without: &str) {
        let (Some(checked), Some(numbers)) = (result_of(made), result_of(without)) else { return };
        let both = [&checked, &numbers].map(|(of, _)| [of.estimate, of.standard_uncertainty]);
        let [checked_values, values] = both;
        let is_alike = |[a, b]: [f64; 2]| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
        if is_alike([checked_values[0], values[0]]) && is_alike([checked_values[1], values[1]]) {
            return;
        }
        let Some((formula, number, words)) = converting(made) else { return };
        let written = |[estimate, u]: [f64; 2]| {
            significant(estimate, digits_for(Figure::Estimate, estimate, u))
        };
        let equations = Equations::of(self.cells).read;
        let line = equations.iter().find(|of| of.formula == formula).map_or(0, |of| of.line);
        let reason = format!(
            "the number {number} in `{formula}` is {words}: with the units of the rows the result is {}, and \
             {} by their numbers alone, where that number converts them: leave it out, as units are converted \
             here, or write the result with its estimate and unit into a row",
            checked.1.after(&written(checked_values)),
            written(values)
        );
        self.fail(line, reason);
    }
}

/// The equation with a number that is the size of a unit, that number, and what it is.
pub(super) fn converting(model: &str) -> Option<(String, String, String)> {
    let model: Value = serde_json::from_str(model).ok()?;
    let formulas = model.get("equations")?.as_object()?;
    let result = model.get("outputs")?.as_object()?.values().next()?.get("unit");
    formulas.values().filter_map(Value::as_str).find_map(|formula| {
        let parsed = Formula::parse(formula).ok()?;
        let unit_of = |name| model.get("inputs")?.get(name)?.get("unit")?.as_str();
        let units = parsed.names().filter_map(|(name, _)| unit_of(name));
        let units = units.chain(result.and_then(Value::as_str));
        let conversions = conversions(&units.collect::<Vec<_>>());
        numbers_of(formula).into_iter().find_map(|(text, number)| {
            let is_it = |of: &&Conversion| {
                [of.size, 1.0 / of.size].iter().any(|size| (number / size - 1.0).abs() < ROUNDED)
            };
            let of = conversions.iter().find(is_it)?;
            Some((formula.to_owned(), text, of.words.clone()))
        })
    })
}

/// Whether an equation has a number that may convert units by several factors at once, as 9550 does.
pub(super) fn may_convert(model: &str) -> bool {
    // 2, 4 and a half are of geometry
    const LEAST: f64 = 10.0;
    let formulas = || {
        let model: Value = serde_json::from_str(model).ok()?;
        let formulas = model.get("equations")?.as_object()?.values();
        Some(formulas.filter_map(Value::as_str).flat_map(numbers_of).collect::<Vec<_>>())
    };
    let numbers = formulas().unwrap_or_default();
    numbers.iter().any(|(_, number)| *number >= LEAST || *number <= 1.0 / LEAST)
}

/// The sizes of some units: of their prefixes, in SI units, and of each two of them.
fn conversions(units: &[&str]) -> Vec<Conversion> {
    let units: Vec<Unit> = units.iter().filter_map(|unit| Unit::parse(unit).ok()).collect();
    let mut found = Vec::new();
    for (place, unit) in units.iter().enumerate() {
        let text = unit.text();
        let of = |other: &Unit| Unit::conversion_factor(unit, other).ok();
        let pairs = units[..place].iter().filter_map(|other| {
            let words = format!("the ratio of `{text}` and `{}`", other.text());
            Some(Conversion { size: of(other)?, words })
        });
        found.extend(pairs);
        let prefixes = unit.factors().iter().filter_map(|factor| match factor.base {
            FactorBase::Named { prefix: Some(prefix), .. } => Some(f64::from(prefix.decimal())),
            _ => None,
        });
        let prefixes = prefixes.map(|decimal| elementary::pow(10.0, decimal));
        let words = format!("a size of `{text}`");
        // of what counts turns also in turns: 1/60 of rpm
        let in_turns = unit.turn().map(|_| unit.factor() / std::f64::consts::TAU);
        let in_turns = in_turns.map(|size| {
            let words =
                format!("{words} (which is in radians here: a factor 2*pi is too much, too)");
            Conversion { size, words }
        });
        // the minute of L/min
        let parts = unit.factors().iter().filter_map(|factor| match factor.base {
            FactorBase::Named { symbol, .. } => Unit::parse(symbol.spellings().next()?).ok(),
            _ => None,
        });
        let parts: Vec<f64> = parts.map(|part| part.factor()).collect();
        let sizes = prefixes.chain([unit.factor()]).chain(parts);
        found.extend(sizes.map(|size| Conversion { size, words: words.clone() }));
        found.extend(in_turns);
    }
    found.retain(|of| (of.size - 1.0).abs() > ROUNDED);
    found
}

/// The numbers of a formula with their texts, `10^-3` among them; exponents are none.
fn numbers_of(formula: &str) -> Vec<(String, f64)> {
    let signs: Vec<char> = formula.chars().collect();
    let mut found = Vec::new();
    let (mut at, mut before) = (0, ' ');
    while let Some(&sign) = signs.get(at) {
        let is_word = sign.is_alphanumeric() || matches!(sign, '_' | '.');
        let end = if is_word { end_of_word(&signs, at) } else { at + 1 };
        let word: String = signs[at..end].iter().collect();
        let number = word.parse::<f64>().ok().filter(|_| sign.is_ascii_digit() || sign == '.');
        if let Some(number) = number.filter(|_| before != '^') {
            let power = exponent_behind(&signs, end).filter(|_| number == 10.0);
            match power {
                Some(power) => {
                    found.push((format!("10^{power}"), elementary::pow(10.0, f64::from(power))));
                }
                None if signs[end..].iter().find(|sign| **sign != ' ') == Some(&'^') => {}
                None => found.push((word, number)),
            }
        }
        if sign != ' ' && !(before == '^' && matches!(sign, '-' | '(' | '+')) {
            before = sign;
        }
        at = end;
    }
    found
}

/// Where a name or a number ends, `1e-3` with its exponent.
fn end_of_word(signs: &[char], from: usize) -> usize {
    let is_number = signs[from].is_ascii_digit() || signs[from] == '.';
    let mut end = from + 1;
    while let Some(&sign) = signs.get(end) {
        let is_exponent = is_number
            && matches!(sign, '-' | '+')
            && matches!(signs[end - 1], 'e' | 'E')
            && signs.get(end + 1).is_some_and(char::is_ascii_digit);
        if !(sign.is_alphanumeric() || matches!(sign, '_' | '.') || is_exponent) {
            break;
        }
        end += 1;
    }
    end
}

/// The whole exponent behind a number: `^-3`, `^(-3)`.
fn exponent_behind(signs: &[char], from: usize) -> Option<i32> {
    let text: String = signs[from..].iter().filter(|sign| **sign != ' ').take(12).collect();
    let text = text.strip_prefix('^')?;
    let inside = text.strip_prefix('(').and_then(|text| text.split_once(')'));
    let digits = inside.map_or(text, |(inside, _)| inside);
    let end = digits
        .char_indices()
        .find(|(at, sign)| !(sign.is_ascii_digit() || *at == 0 && matches!(sign, '-' | '+')))
        .map_or(digits.len(), |(at, _)| at);
    let power = digits.get(..end)?;
    (inside.is_none() || end == digits.len()).then(|| power.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::numbers_of;

    #[test]
    fn numbers_of_formulas() {
        let texts = |formula: &str| -> Vec<String> {
            numbers_of(formula).into_iter().map(|(text, _)| text).collect()
        };
        assert_eq!(texts("V/(1000*I)"), ["1000"]);
        assert_eq!(texts("1e-3*x^2 + 10^-3*y_10"), ["1e-3", "10^-3"]);
        assert_eq!(texts("10^(-6)*a2 + 0.001*b^(-3)"), ["10^-6", "0.001"]);
        assert_eq!(texts("log10(a) + 10^(a/20)"), ["20"]);
        assert_eq!(texts("10 ^ 3 * a"), ["10^3"]);
    }
}
