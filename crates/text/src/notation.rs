//! Quantities as people write them, a whole input in one text: `5.0112(23) V`,
//! `5.0112 V ± 0.0046 V (k=2)`, `5.0112 V, U = 0.0046 V, k = 2`, `5 +0.2 -0.1 mm`.
//!
//! The text is replaced by the equivalent object before anything reads it; errors in that object
//! are reported at the text.

use std::borrow::Cow;
use std::ops::Range;

use super::DiagnosticKind;
use super::diagnostics::Collector;
use super::implied_dof;
use super::json::{Json, Member, Node};
use super::sexagesimal;
use super::value_text::{
    grouped_digits, is_comma, number_in_parentheses, with_exponents, with_plus_minus,
};
use gumption_engine::decimal::to_15_digits;
use gumption_engine::number::Shortest;
use gumption_engine::special;
use gumption_units::Unit;

/// The values of a quantity in a text: numbers as written, without the unit.
#[derive(Clone, Debug, PartialEq)]
enum Stated {
    /// A value alone.
    Exact(String),
    /// A value and its standard uncertainty.
    Standard(String, String),
    /// A value and its expanded uncertainty; the uncertainty has a unit if it differs from the unit
    /// of the value, and a coverage.
    Expanded { value: String, expanded: String, coverage: Coverage },
    /// A most probable value, and the standard uncertainties below and above it.
    Asymmetric { mode: String, low: String, high: String },
}

/// The coverage stated after an expanded uncertainty.
#[derive(Clone, Debug, PartialEq)]
struct Coverage {
    /// `k` or `p`.
    key: &'static str,
    /// Its number.
    factor: String,
    /// Degrees of freedom.
    dof: Option<String>,
}

/// Puts objects in the place of inputs and components that are written as texts or numbers.
pub fn apply(log: &Collector, root: &mut Node) {
    let Json::Object(members) = &mut root.value else { return };
    let Some(inputs) = members.iter_mut().find(|member| member.key == "inputs") else { return };
    let Json::Object(inputs) = &mut inputs.value.value else { return };
    for input in inputs {
        quantity(log, &input.key, &mut input.value, None);
        let Json::Object(fields) = &mut input.value.value else { continue };
        let unit = unit_of(fields).unwrap_or_default();
        let complex = fields.iter_mut().find(|field| field.key == "complex");
        if let Some(Json::Object(parts)) = complex.map(|parts| &mut parts.value.value) {
            for part in parts {
                if matches!(part.value.value, Json::Text(_)) {
                    let name = format!("{}.{}", input.key, part.key);
                    quantity(log, &name, &mut part.value, None);
                }
            }
        }
        let parts = fields.iter_mut().find(|field| field.key == "components");
        if let Some(Json::List(parts)) = parts.map(|parts| &mut parts.value.value) {
            for part in parts {
                if let Json::Object(_) = part.value {
                    quantity(log, &input.key, part, Some(&unit));
                }
            }
        }
    }
}

/// The unit that an object states.
fn unit_of(fields: &[Member]) -> Option<String> {
    let own = fields.iter().find(|field| field.key == "unit");
    own.and_then(|field| match &field.value.value {
        Json::Text(text) => Some(text.trim().to_owned()),
        _ => None,
    })
}

/// An input or a component that is a text or a number, or whose `value` is a text and which has no
/// distribution; a component has the `unit` of its input.
fn quantity(log: &Collector, name: &str, node: &mut Node, input_unit: Option<&str>) {
    match &mut node.value {
        Json::Number(number) => {
            let number = number.clone();
            node.value = Json::Object(members(&node.span, None, Stated::Exact(number.into())));
        }
        Json::Text(text) => {
            let read = stated(text);
            if let Some((unit, stated)) = reported(log, name, text, &node.span, read) {
                node.value = Json::Object(members(&node.span, Some(unit), stated));
            } else {
                // one error is enough
                node.value = Json::Object(members(&node.span, None, Stated::Exact("1".into())));
            }
        }
        Json::Object(fields) => {
            let has = |key: &str| fields.iter().any(|field| field.key == key);
            if has("distribution") || has("components") {
                return;
            }
            let Some(place) = fields.iter().position(|field| field.key == "value") else { return };
            let span = fields[place].value.span.clone();
            let own = unit_of(fields).or_else(|| input_unit.map(str::to_owned));
            let found = match &fields[place].value.value {
                Json::Number(number) => Some((String::new(), Stated::Exact(number.to_string()))),
                Json::Text(text) => {
                    let read = stated(text).and_then(|(unit, stated)| {
                        let declared = own.as_deref().unwrap_or(&unit);
                        in_one_unit(text, &unit, declared, &log.own_units())?;
                        Ok((unit, stated))
                    });
                    reported(log, name, text, &span, read)
                }
                _ => return,
            };
            let (unit, stated) =
                found.unwrap_or_else(|| (String::new(), Stated::Exact("1".to_owned())));
            fields.remove(place);
            let same = own.as_ref().is_none_or(|own| *own == unit);
            // numbers in another unit keep it and are converted when they are read
            let behind = if same || unit.is_empty() { String::new() } else { format!(" {unit}") };
            let unit = (own.is_none() && !unit.is_empty()).then_some(unit);
            let mut made = members(&span, unit, stated);
            if !behind.is_empty() {
                for member in &mut made {
                    let Json::Number(number) = &member.value.value else { continue };
                    if matches!(member.key.as_str(), "k" | "p" | "dof") {
                        continue;
                    }
                    let is_place = matches!(member.key.as_str(), "mean" | "mode" | "value");
                    let own = own.as_deref().filter(|_| !is_place);
                    member.value.value = match own.and_then(|own| counted_in(number, &behind, own))
                    {
                        Some(number) => Json::Number(number.into()),
                        None => Json::Text(format!("{number}{behind}")),
                    };
                }
            }
            fields.extend(made);
        }
        _ => {}
    }
}

/// Reports a value whose unit is unclear: the unit of the uncertainty or the unit that the input
/// declares. Examples: `10, U = 2 mm, k = 2` for an input in m, `20(0.5) K` for one in degC.
fn in_one_unit(text: &str, unit: &str, declared: &str, own: &[Unit]) -> Result<(), String> {
    let parse = |text: &str| Unit::parse_among(text, own).ok();
    // an unknown unit is reported where the unit is read
    let (Some(written), Some(of_input)) = (parse(unit), parse(declared)) else { return Ok(()) };
    let Some((value, behind)) = digits(text.trim()) else { return Ok(()) };
    let is_same = Unit::convert(1.0, &written, &of_input) == Ok(1.0);
    let is_bare = behind.starts_with(['±', '+', '-', '−', ',', ';']);
    let is_on_a_scale = behind.starts_with('(') && !written.has_zero_of(&of_input);
    if unit.is_empty() || is_same || !(is_bare || is_on_a_scale) {
        return Ok(());
    }
    Err(format!(
        "the value can be {value} {unit}, like its uncertainty, or {value} {declared}, in the \
         input's unit: write the unit of the value, such as `{value} {declared} ± 0.1 {unit} \
         (k=2)`, or remove `unit`"
    ))
}

/// A width in per cent or a similar unit that it shares with its value: it is then an absolute
/// width and not a fraction of the value. The result is in the unit of the input.
fn counted_in(number: &str, unit: &str, of_input: &str) -> Option<String> {
    let (unit, of_input) = (Unit::parse(unit.trim()).ok()?, Unit::parse(of_input).ok()?);
    let converted = Unit::convert(number.parse().ok()?, &unit, &of_input).ok()?;
    unit.is_relative().then(|| Shortest(to_15_digits(converted)).to_string())
}

fn reported(
    log: &Collector,
    name: &str,
    text: &str,
    span: &Range<usize>,
    read: Result<(String, Stated), String>,
) -> Option<(String, Stated)> {
    read.map_err(|reason| {
        let (key, found) = (name.to_owned(), text.to_owned());
        log.report(span, DiagnosticKind::Value { key, found, reason });
    })
    .ok()
}

/// The members of the object that replaces a text; all have the position of the text.
fn members(span: &Range<usize>, unit: Option<String>, stated: Stated) -> Vec<Member> {
    let member = |key: &str, value: Json| Member {
        key: key.to_owned(),
        key_span: span.clone(),
        value: Node { span: span.clone(), value },
    };
    let text = |key: &str, value: &str| member(key, Json::Text(value.to_owned()));
    let number = |key: &str, value: String| member(key, Json::Number(value.into()));
    let mut made: Vec<Member> =
        unit.filter(|unit| !unit.is_empty()).map(|unit| text("unit", &unit)).into_iter().collect();
    made.extend(match stated {
        Stated::Exact(value) => vec![text("distribution", "constant"), number("value", value)],
        Stated::Standard(mean, std) => {
            vec![text("distribution", "normal"), number("mean", mean), number("std", std)]
        }
        Stated::Expanded { value, expanded, coverage: Coverage { key, factor, dof } } => {
            let expanded = if expanded.contains(' ') {
                text("expanded", &expanded)
            } else {
                number("expanded", expanded)
            };
            let stated = [
                text("distribution", "normal"),
                number("mean", value),
                expanded,
                number(key, factor),
            ];
            stated.into_iter().chain(dof.map(|dof| number("dof", dof))).collect()
        }
        Stated::Asymmetric { mode, low, high } => vec![
            text("distribution", "split-normal"),
            number("mode", mode),
            number("std_low", low),
            number("std_high", high),
        ],
    });
    made
}

/// How a quantity is written.
const FORMS: &str = "write it as `5.0112 V`, `5.0112(23) V`, `5.0112 V ± 0.0046 V (k=2)` or \
                     `5 +0.2 -0.1 mm`";

/// What an uncertainty is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Uncertainty {
    /// `u =`.
    Standard,
    /// `U =`, and behind `±`.
    Expanded,
}

impl Uncertainty {
    fn symbol(self) -> &'static str {
        match self {
            Self::Standard => "u",
            Self::Expanded => "U",
        }
    }
}

/// Whether a text is a value with an uncertainty.
pub fn states_uncertainty(text: &str) -> bool {
    matches!(stated(text), Ok((_, stated)) if !matches!(stated, Stated::Exact(_)))
}

/// A value with an uncertainty, with this unit if it states none; `None` if that is no such value.
pub fn stated_in(text: &str, unit: &str) -> Option<String> {
    let (own, _) = stated(text).ok()?;
    let is_whole = !own.is_empty() || ["", "1"].contains(&unit);
    let whole = if is_whole { text.to_owned() } else { format!("{text} {unit}") };
    states_uncertainty(&whole).then_some(whole)
}

/// The keys of the input that a quantity in words stands for, and their values as they are written:
/// `5.0112(23) V` is unit V, distribution normal, mean 5.0112, std 0.0023, and `100 ohm` is unit ohm,
/// distribution constant, value 100. A quantity without a unit gives none. `None` for any other text.
pub fn written_out(text: &str) -> Option<Vec<(String, String)>> {
    let (unit, stated) = stated(text).ok()?;
    let members = members(&(0..0), Some(unit), stated);
    // `5.0112(23)` has the digits 23e-4
    let plain = |number: String| match number.parse::<f64>() {
        Ok(value) if number.contains('e') && !text.contains(['e', 'E']) => {
            Shortest(value).to_string()
        }
        _ => number,
    };
    let written = members.into_iter().filter_map(|member| match member.value.value {
        Json::Text(value) => Some((member.key, value)),
        Json::Number(value) => Some((member.key, plain(value.into()))),
        _ => None,
    });
    Some(written.collect())
}

/// Parses a text into its unit (empty without one) and its values.
fn stated(text: &str) -> Result<(String, Stated), String> {
    let text = with_plus_minus(&text.trim().replace('−', "-"));
    let text = with_exponents(&text);
    let text = match sexagesimal::degrees(&text) {
        Some((value, rest)) => format!("{} deg{rest}", Shortest(value)),
        None => text,
    };
    // (5.0112 ± 0.0046) V (k=2)
    let (inner, outer) = match text.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
        Some((inner, outer)) if inner.contains('±') => (inner.trim().to_owned(), Some(outer)),
        _ => (text.clone(), None),
    };
    // (1.234 ± 0.005)e-3 kg
    let (power, outer) = match outer.map(exponent) {
        Some((power, outer)) => (power, Some(outer)),
        None => ("", None),
    };
    if !power.is_empty() && inner.contains(['e', 'E']) {
        return Err(format!("one power of ten is enough; {FORMS}"));
    }
    let (value, rest) = digits(&inner).ok_or_else(|| {
        let first = "it does not begin with a number";
        format!("{first}; {FORMS}")
    })?;
    if is_comma(rest) {
        return Err("write a decimal fraction with a point, such as `5.01`".to_owned());
    }
    if let Some((before, of, after)) = named_uncertainty(rest) {
        let (uncertainty, behind) = digits(&after)
            .ok_or_else(|| format!("a number is needed after `{} =`", of.symbol()))?;
        let unit_end = behind.find(['(', ',', ';']).unwrap_or(behind.len());
        let unit = behind.get(..unit_end).unwrap_or_default().trim();
        if before.trim().is_empty() && !unit.is_empty() {
            return Err(format!(
                "the value has no unit, but its uncertainty is in `{unit}`; {FORMS}"
            ));
        }
        return uncertain(&value, before, of, &uncertainty, behind, false);
    }
    if let Some(after) = rest.strip_prefix('(') {
        let (inside, after) = after.split_once(')').ok_or("the parenthesis is not closed")?;
        let (power, after) = exponent(after);
        if !power.is_empty() && value.contains(['e', 'E']) {
            return Err(format!("one power of ten is enough; {FORMS}"));
        }
        let shift: i32 = match power.get(1..).filter(|power| !power.is_empty()) {
            Some(power) => power.parse().map_err(|_| FORMS.to_owned())?,
            None => 0,
        };
        let std = in_parentheses(&value, inside.trim(), shift)?;
        let value = format!("{value}{power}");
        if let Some(said) = coverage_behind(after) {
            return Err(format!(
                "the digits in parentheses are a standard uncertainty (JCGM 100, 7.2.2), but \
                 {said} belongs to an expanded one: write `5.0112(23) V` or `5.0112 V ± 0.0046 V \
                 (k=2)`"
            ));
        }
        return Ok((unit(after)?, Stated::Standard(value, std)));
    }
    if let Some((before, after)) = rest.split_once('±') {
        let after = without_parentheses(after.trim());
        let (expanded, behind) = digits(&after).ok_or("a number is needed after `±`".to_owned())?;
        let behind = match outer {
            Some(outer) if behind.trim().is_empty() => outer,
            Some(_) => return Err(format!("the unit must follow the parenthesis; {FORMS}")),
            None => behind,
        };
        let (value, expanded) = (format!("{value}{power}"), format!("{expanded}{power}"));
        return uncertain(
            &value,
            before,
            Uncertainty::Expanded,
            &expanded,
            behind,
            outer.is_some(),
        );
    }
    if rest.starts_with('+') || (rest.starts_with('-') && rest.contains('+')) {
        let (first, rest) = signed(rest).ok_or_else(|| FORMS.to_owned())?;
        let (second, rest) = signed(rest.trim()).ok_or_else(|| FORMS.to_owned())?;
        let (low, high) = match (first.strip_prefix('-'), second.strip_prefix('-')) {
            (None, Some(low)) => (low.to_owned(), first),
            (Some(low), None) => (low.to_owned(), second),
            _ => {
                return Err(format!(
                    "one of the two must have a plus sign and one a minus sign; {FORMS}"
                ));
            }
        };
        return Ok((unit(rest)?, Stated::Asymmetric { mode: value, low, high }));
    }
    Ok((unit(rest)?, Stated::Exact(value)))
}

/// Splits `V, U = 0.0046 V, k = 2` into the text before the named uncertainty, its kind, and the
/// text after the equals sign.
fn named_uncertainty(text: &str) -> Option<(&str, Uncertainty, Cow<'_, str>)> {
    let (before, rest) = text.split_once([',', ';'])?;
    let (symbol, after) = rest.split_once('=')?;
    let of = match symbol.trim() {
        "u" => Uncertainty::Standard,
        "U" => Uncertainty::Expanded,
        // 95 %, whether that is repeated or not
        "U95" | "U_95" | "U(95)" => {
            let after = after.trim();
            let is_said = after.contains(['(', ',', ';']);
            let said = if is_said { after.to_owned() } else { format!("{after} (p=95 %)") };
            return Some((before, Uncertainty::Expanded, said.into()));
        }
        _ => return None,
    };
    Some((before, of, after.trim().into()))
}

/// A specification as an uncertainty, `(0.05 % + 2 mV) (k=2)`, without its parentheses.
fn without_parentheses(text: &str) -> Cow<'_, str> {
    match text.strip_prefix('(').and_then(|rest| rest.split_once(')')) {
        Some((inside, behind)) if is_sum(inside) => format!("{inside}{behind}").into(),
        _ => text.into(),
    }
}

/// Whether an uncertainty is a sum, `0.05 % + 2 mV`.
fn is_sum(text: &str) -> bool {
    text.contains(" + ")
}

/// A coverage after a unit: `(k=2)`, `, p = 95 %`.
fn coverage_behind(text: &str) -> Option<&str> {
    let at = text.find(['(', ',', ';'])?;
    let said = text.get(at..)?.trim_start_matches([',', ';']).trim();
    let begins = said.trim_start_matches('(').trim_start();
    (begins.starts_with(['k', 'p']) && said.contains('=')).then_some(said)
}

/// A value with unit `first`, and its uncertainty with its unit and coverage. If both share one
/// unit (`is_shared`), it follows the uncertainty.
fn uncertain(
    value: &str,
    first: &str,
    of: Uncertainty,
    uncertainty: &str,
    behind: &str,
    is_shared: bool,
) -> Result<(String, Stated), String> {
    if is_comma(behind) {
        return Err("write a decimal fraction with a point, such as `0.01`".to_owned());
    }
    let (own, said) = match behind.find(['(', ',', ';']) {
        Some(at) => (behind[..at].trim(), behind[at..].trim()),
        None => (behind.trim(), ""),
    };
    let first = first.trim();
    if !first.is_empty() && own.is_empty() {
        return Err(format!("the uncertainty has no unit; {FORMS}"));
    }
    if first.is_empty() && own == "%" && !is_shared {
        let share = |value: &str| -> Option<String> {
            let of: f64 = value.parse().ok()?;
            let share: f64 = uncertainty.parse().ok()?;
            Some(gumption_engine::decimal::significant(0.01 * share * of.abs(), 2))
        };
        let as_share = share(value).unwrap_or_else(|| "0.01".to_owned());
        return Err(format!(
            "`± {uncertainty} %` can be {uncertainty} % of the value, or both can be in %: write \
             `{value} ± {as_share} {said}` or `({value} ± {uncertainty}) % {said}`"
        ));
    }
    let coverage = coverage_of(of, said)?;
    let (value, uncertainty) = (value.to_owned(), uncertainty.to_owned());
    if first.is_empty() || first == own {
        return Ok((unit(own)?, Stated::Expanded { value, expanded: uncertainty, coverage }));
    }
    // a width with its own unit, in per cent of the value, or a specification with both
    let own = if is_sum(own) { own.to_owned() } else { unit(own)? };
    let expanded = format!("{uncertainty} {own}");
    Ok((unit(first)?, Stated::Expanded { value, expanded, coverage }))
}

/// A stated coverage factor belongs to a distribution if it differs by no more than this fraction:
/// rounding to two digits, 1.0 at least, changes it by up to 5 %.
const LIKE: f64 = 0.05;

/// Names of effective degrees of freedom after a value.
const DEGREES_OF_FREEDOM: [&str; 5] = ["dof", "veff", "νeff", "ν_eff", "ν"];

/// Parses the coverage after an uncertainty: `(k=2)`, `(p=95 %)`, `(p=0.95)`, `(95 %)`.
/// Certificates write `(k=2, p=95 %)`: the result is the factor, which the probability must allow,
/// with the degrees of freedom of the t distribution to which both belong. Degrees of freedom may
/// follow: `(k=2.28, dof=10)`. All of these may also follow a comma or a semicolon without
/// parentheses: `, k = 2`. After a standard uncertainty only degrees of freedom are allowed.
fn coverage_of(of: Uncertainty, text: &str) -> Result<Coverage, String> {
    const MISSING: &str = "state the coverage of the uncertainty: `(k=2)`, `(p=95 %)`, or `(k=1)` \
                           for a standard uncertainty; degrees of freedom follow it, `(k=2.28, \
                           dof=10)`";
    let inside = match text.strip_prefix([',', ';']) {
        // `, k = 2 (95 %)`
        Some(rest) if rest.matches('(').count() == rest.matches(')').count() => {
            rest.replace('(', ",").replace(')', "")
        }
        Some(_) => return Err("the parenthesis is not closed".to_owned()),
        None if text.is_empty() && of == Uncertainty::Standard => String::new(),
        None => {
            let inside = text.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
            inside.ok_or(MISSING)?.to_owned()
        }
    };
    let (mut k, mut p, mut dof) = (None, None, None);
    let mut last_digit_of_p = None;
    let parts = inside.split([',', ';']).map(str::trim);
    for part in parts.filter(|part| of == Uncertainty::Expanded || !part.is_empty()) {
        let (key, number) = part.split_once('=').unwrap_or(("p", part));
        let number = number.trim();
        let (percent, digits) = match number.strip_suffix('%') {
            Some(percent) => (true, percent.trim()),
            None => (false, number),
        };
        let place = match key.trim() {
            "k" if !percent => &mut k,
            "p" => &mut p,
            key if DEGREES_OF_FREEDOM.contains(&key) && !percent => &mut dof,
            _ => return Err(format!("`{part}` is unknown here; {MISSING}")),
        };
        let found: f64 = match digits.parse() {
            // `k=2,28` falls into two parts
            Ok(found) if percent || part.contains('=') => found,
            Ok(_) if k.is_none() && p.is_none() && dof.is_none() => {
                return Err(format!("`{part}` alone is ambiguous; {MISSING}"));
            }
            Ok(_) => {
                return Err("write a decimal fraction with a point, such as `k=2.28`".into());
            }
            Err(_) => return Err(format!("`{part}` is unknown here; {MISSING}")),
        };
        if key.trim() == "p" {
            let share = if percent { 0.01 } else { 1.0 };
            last_digit_of_p = Some(share * implied_dof::last_digit(digits));
        }
        if DEGREES_OF_FREEDOM.contains(&key.trim()) && found <= 0.0 {
            return Err(format!("`{part}` is not valid: degrees of freedom must be above zero"));
        }
        let found = if percent {
            (gumption_engine::decimal::exact(found / 100.0), found / 100.0)
        } else {
            (digits.to_owned(), found)
        };
        if place.replace(found).is_some() {
            return Err(format!("`{}` is given twice; {MISSING}", key.trim()));
        }
    }
    let dof = dof.map(|(text, _)| text);
    if of == Uncertainty::Standard {
        return match (k, p) {
            (None, None) => Ok(Coverage { key: "k", factor: "1".to_owned(), dof }),
            (Some((factor, 1.0)), None) => Ok(Coverage { key: "k", factor, dof }),
            _ => Err("`u =` is a standard uncertainty, but the text after it belongs to an \
                      expanded one: write `U =`, or remove it"
                .to_owned()),
        };
    }
    match (k, p) {
        (Some((factor, k)), Some((_, p))) => {
            // rounded to three digits, as on certificates
            if !(p > 0.0 && p < 1.0) {
                return Err(format!("{p} is not a probability: write `95 %` or `p=0.95`"));
            }
            let needed = special::normal::quantile(0.5 + 0.5 * p);
            if k < 0.995 * needed {
                return Err(format!(
                    "k = {k} is less than the {} that {} % of a normal distribution need: if the \
                     distribution is another one, name it (`\"distribution\": \"rectangular\"`, with \
                     its `half_width`)",
                    gumption_engine::decimal::significant(needed, 3),
                    gumption_engine::decimal::exact(100.0 * p)
                ));
            }
            // t distribution, to the digits with which a factor is written
            if let Some(Ok(dof)) = dof.as_ref().map(|text| text.parse::<f64>()) {
                let of_t = special::student::two_sided_factor(p, dof);
                if (k - of_t).abs() > LIKE * of_t && (k - needed).abs() > LIKE * needed {
                    return Err(format!(
                        "k = {k} is not the {} of a t distribution with {dof} degrees of freedom and \
                         {} %; which of the three is wrong?",
                        gumption_engine::decimal::significant(of_t, 3),
                        gumption_engine::decimal::exact(100.0 * p)
                    ));
                }
            }
            if dof.is_some() {
                return Ok(Coverage { key: "k", factor, dof });
            }
            let stated = implied_dof::Factor::new(k, implied_dof::last_digit(&factor));
            let implied = stated.dof_of_nothing_named(p, last_digit_of_p.unwrap_or(0.0));
            let dof = implied.is_finite().then(|| gumption_engine::decimal::exact(implied));
            match dof.as_ref().filter(|_| k.fract() == 0.0) {
                // a conventional factor, or one for few degrees of freedom rounded to one digit
                Some(dof) => {
                    let percent = gumption_engine::decimal::exact(100.0 * p);
                    Err(format!(
                        "k = {factor} with {percent} % can be the factor of a normal distribution \
                         with a rounded probability, or that of a t distribution with {dof} \
                         degrees of freedom: write `k={factor}` alone, or `p={percent} %, \
                         dof={dof}`"
                    ))
                }
                None => Ok(Coverage { key: "k", factor, dof }),
            }
        }
        (Some((factor, _)), None) => Ok(Coverage { key: "k", factor, dof }),
        (None, Some((factor, _))) => Ok(Coverage { key: "p", factor, dof }),
        (None, None) => Err(MISSING.to_owned()),
    }
}

/// The uncertainty in parentheses: in units of the last digits of the value, or with its own
/// decimal point.
fn in_parentheses(value: &str, inside: &str, shift: i32) -> Result<String, String> {
    let is_number = inside.parse::<f64>().is_ok_and(|x| x > 0.0 && x.is_finite());
    let plain = inside.chars().all(|c| c.is_ascii_digit() || c == '.');
    if !is_number || !plain {
        return Err(format!(
            "`({inside})` is not an uncertainty in the last digits, such as `(23)`"
        ));
    }
    let power = match value.split_once(['e', 'E']) {
        Some((_, power)) => power.parse().unwrap_or(0),
        None => shift,
    };
    let mantissa = value.split(['e', 'E']).next().unwrap_or_default();
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let (digits, _) = digits(inside).ok_or_else(|| format!("`({inside})` is not a number"))?;
    let power = match inside.contains('.') {
        true => Some(power),
        false => i32::checked_sub(power, decimals),
    };
    let power = power.ok_or_else(|| format!("`{value}` has an exponent that is out of range"))?;
    Ok(if power == 0 { digits } else { format!("{digits}e{power}") })
}

/// A number in JSON syntax at the start of the text, and the rest.
fn digits(text: &str) -> Option<(String, &str)> {
    let text = text.strip_prefix('+').unwrap_or(text);
    let sign = usize::from(text.starts_with('-'));
    let end_of = |from: usize| {
        let rest = text.get(from..).unwrap_or_default();
        from + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    };
    let whole = end_of(sign);
    let mut end = whole;
    if text.get(whole..)?.starts_with('.') {
        end = end_of(whole + 1);
    }
    let mantissa = text.get(sign..end)?;
    if !mantissa.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let (power, rest) = exponent(text.get(end..)?);
    // JSON requires a digit on both sides of the point, and no leading zeros
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let before = before.trim_start_matches('0');
    let before = if before.is_empty() { "0" } else { before };
    let after = if after.is_empty() { String::new() } else { format!(".{after}") };
    let sign = if sign == 1 { "-" } else { "" };
    Some((format!("{sign}{before}{after}{power}"), rest.trim_start()))
}

/// An exponent at the start, `e-3`; the empty text if there is none.
fn exponent(text: &str) -> (&str, &str) {
    let Some(rest) = text.strip_prefix(['e', 'E']) else { return ("", text) };
    let signed = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    let end = signed.find(|c: char| !c.is_ascii_digit()).unwrap_or(signed.len());
    if end == 0 {
        return ("", text);
    }
    text.split_at(text.len() - signed.len() + end)
}

/// A number with its sign; a plus sign is left out.
fn signed(text: &str) -> Option<(String, &str)> {
    text.starts_with(['+', '-']).then(|| digits(text)).flatten()
}

/// The remaining text as a unit; whether the unit exists is checked where it is read.
fn unit(text: &str) -> Result<String, String> {
    let text = text.trim();
    if text.contains(['±', '+', '=']) {
        return Err(format!("`{text}` is not a unit"));
    }
    if let Some(digits) = number_in_parentheses(text) {
        return Err(format!(
            "a second uncertainty in parentheses, `({digits})`, is not accepted: combine the two"
        ));
    }
    if let Some(reason) = grouped_digits(text) {
        return Err(reason);
    }
    Ok(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_uncertainty_in_parentheses_is_no_factor() {
        for text in ["9.109(2)(5) mm", "5.01 (2)(3) V", "5.01(1) (3) mV"] {
            let error = stated(text).unwrap_err();
            assert!(error.contains("a second uncertainty in parentheses"), "{text}: {error}");
        }
    }

    #[test]
    fn a_quantity_in_words_is_written_out() {
        let keys = |text: &str| {
            let members = written_out(text).unwrap_or_default();
            members.iter().map(|(key, value)| format!("{key} {value}")).collect::<Vec<_>>()
        };
        let normal = ["unit V", "distribution normal", "mean 5.0112", "std 0.0023"];
        assert_eq!(keys("5.0112(23) V"), normal);
        let expanded = ["unit ohm", "distribution normal", "mean 100.02", "expanded 0.04", "k 2"];
        assert_eq!(keys("100.02 ohm ± 0.04 ohm (k=2)"), expanded);
        assert_eq!(keys("1.50"), ["distribution constant", "value 1.50"]);
        assert_eq!(keys("a + b"), [""; 0]);
    }

    fn read(text: &str) -> (String, Stated) {
        stated(text).unwrap_or_else(|error| panic!("{text}: {error}"))
    }

    #[test]
    fn what_people_write() {
        let standard = |v: &str, u: &str| Stated::Standard(v.into(), u.into());
        let with = |value: &str, expanded: &str, key, factor: &str, dof: Option<&str>| {
            let (value, expanded, factor) = (value.into(), expanded.into(), factor.into());
            let coverage = Coverage { key, factor, dof: dof.map(str::to_owned) };
            Stated::Expanded { value, expanded, coverage }
        };
        let expanded = |value: &str, expanded: &str, key, factor: &str| {
            with(value, expanded, key, factor, None)
        };
        let table = [
            ("5.0112 V", "V", Stated::Exact("5.0112".into())),
            ("3", "", Stated::Exact("3".into())),
            ("-5e-3 m/s^2", "m/s^2", Stated::Exact("-5e-3".into())),
            ("5.0112(23) V", "V", standard("5.0112", "23e-4")),
            ("100(2) ohm", "ohm", standard("100", "2")),
            ("1.2345(6)e-3 kg", "kg", standard("1.2345e-3", "6e-7")),
            ("5.0112(0.0023) V", "V", standard("5.0112", "0.0023")),
            ("5.0112 V ± 0.0046 V (k=2)", "V", expanded("5.0112", "0.0046", "k", "2")),
            ("5.0112 +- 0.0046 V (k = 2)", "V", expanded("5.0112", "0.0046", "k", "2")),
            ("(5.0112 +/- 0.0046) V (p = 95 %)", "V", expanded("5.0112", "0.0046", "p", "0.95")),
            ("20.0 degC ± 0.2 degC (95 %)", "degC", expanded("20.0", "0.2", "p", "0.95")),
            ("5.01 V ± 20 mV (k=2)", "V", expanded("5.01", "20 mV", "k", "2")),
            ("5.01 V ± 0.5 % (k=2)", "V", expanded("5.01", "0.5 %", "k", "2")),
            ("(5.01 ± 0.02) % (k=2)", "%", expanded("5.01", "0.02", "k", "2")),
            ("5.01 V ± 0.02 V (k=2, p=95 %)", "V", expanded("5.01", "0.02", "k", "2")),
            ("5.01 V ± 0.02 V (k=2.00, 95 %)", "V", expanded("5.01", "0.02", "k", "2.00")),
            // EA-4/02 M:2022, table E.1
            ("5 V ± 0.1 V (k = 2.28; 95 %)", "V", with("5", "0.1", "k", "2.28", Some("10"))),
            ("5 V ± 0.1 V (k=3.31, p=95.45 %)", "V", with("5", "0.1", "k", "3.31", Some("3"))),
            ("5 V ± 0.1 V (k=2.65, 95 %)", "V", with("5", "0.1", "k", "2.65", Some("5"))),
            ("5 V ± 0.1 V (k=2.28, dof=10)", "V", with("5", "0.1", "k", "2.28", Some("10"))),
            ("5 V ± 0.1 V (k=2.2, 95 %, dof=10)", "V", with("5", "0.1", "k", "2.2", Some("10"))),
            ("5 V ± 0.1 V (95 %; νeff = 10)", "V", with("5", "0.1", "p", "0.95", Some("10"))),
            ("5.0 V ± 0.1 V, k = 2.0", "V", expanded("5.0", "0.1", "k", "2.0")),
            ("(5.0 ± 0.1) V; k=2; 95 %", "V", expanded("5.0", "0.1", "k", "2")),
            ("5.0 V ± 0.1 V, k = 2 (95 %)", "V", expanded("5.0", "0.1", "k", "2")),
            ("5.0 V, U = 0.1 V, k = 2", "V", expanded("5.0", "0.1", "k", "2")),
            ("5.0 V; U = 20 mV (k = 2)", "V", expanded("5.0", "20 mV", "k", "2")),
            ("5.0, U = 0.1, p = 95 %", "", expanded("5.0", "0.1", "p", "0.95")),
            ("5.0 V, u = 0.05 V", "V", expanded("5.0", "0.05", "k", "1")),
            ("5.0 V, u = 0.05 V, ν = 9", "V", with("5.0", "0.05", "k", "1", Some("9"))),
            ("3 1/s", "1/s", Stated::Exact("3".into())),
            // the last digits of 1.234e-3 are 1e-6
            ("1.234(5)×10⁻³ kg", "kg", standard("1.234e-3", "5e-6")),
            ("1.234(5) x 10^-3 kg", "kg", standard("1.234e-3", "5e-6")),
            ("(1.234 ± 0.005) × 10⁻³ kg (k=2)", "kg", expanded("1.234e-3", "0.005e-3", "k", "2")),
            ("(1.234 ± 0.005)e-3 kg (k=2)", "kg", expanded("1.234e-3", "0.005e-3", "k", "2")),
            ("5·10^3 V ± 2*10^1 V (k=2)", "V", expanded("5e3", "2e1", "k", "2")),
        ];
        for (text, unit, expected) in table {
            assert_eq!(read(text), (unit.to_owned(), expected), "{text}");
        }
        let of = |mode: &str, low: &str, high: &str| Stated::Asymmetric {
            mode: mode.into(),
            low: low.into(),
            high: high.into(),
        };
        assert_eq!(read("5 +0.2 -0.1 mm"), ("mm".to_owned(), of("5", "0.1", "0.2")));
        assert_eq!(read("5 -0.1 +0.2"), (String::new(), of("5", "0.1", "0.2")));
    }

    #[test]
    fn what_is_not_clear_is_asked() {
        for (text, part) in [
            ("5.0112 V ± 0.0046 V", "state the coverage"),
            ("5.0112 V ± 0.0046 (k=2)", "has no unit"),
            ("5.01 ± 1 % (k=2)", "or both can be in %"),
            ("0.6035 ± 0.5 % (k=2)", "`0.6035 ± 0.0030 (k=2)` or `(0.6035 ± 0.5) % (k=2)`"),
            ("5.01e-2147483648(3) V", "out of range"),
            ("5.01 V ± 0.02 V (k = 2,28)", "with a point"),
            ("5 012 V", "without spaces"),
            ("5 012.3(4) V", "without spaces"),
            ("10 500 V ± 20 V (k=2)", "without spaces"),
            ("10 V ± 1 020 mV (k=2)", "without spaces"),
            ("5,0112 V", "point"),
            ("about 5 V", "begin with a number"),
            ("5.01(2", "not closed"),
            ("5.01(x) V", "last digits"),
            ("5 +0.2 +0.1", "one a minus sign"),
            ("5.0112 V ± 0.0046 V (n=2)", "state the coverage"),
            ("5.0 V ± 0.1 V (k=2, rectangular)", "`rectangular` is unknown here"),
            ("5.0 V ± 0.1 V (k=2, k=3)", "`k` is given twice"),
            // t distribution with 3 degrees of freedom: 3.18 for 95 %, 0.765 for 50 %
            ("5.0 V ± 0.1 V (k=2.5, p=0.95, dof=3)", "is not the 3.18 of a t distribution"),
            ("5.0 V ± 0.1 V (k=3, p=0.5, dof=3)", "is not the 0.765 of a t distribution"),
            ("5.0 V ± 0,1 V (k=2)", "with a point"),
            ("5.0 V ± 0.1 V, k = 2,28", "with a point"),
            ("5.0 V ± 0.1 V, k = 2 (95 %", "not closed"),
            ("5.0 V ± 0.1 V,", "unknown here"),
            ("5.0 V, U = 0.1 V", "state the coverage"),
            ("5.0 V, U = , k = 2", "a number is needed after `U =`"),
            ("5.0 V, u = 0.1 V, k = 2", "`u =` is a standard uncertainty"),
            ("5.0 V, s = 0.1 V", "is not a unit"),
            ("5.0112(46) V (k=2)", "belongs to an expanded one"),
            ("5.0112(46) V, k = 2", "belongs to an expanded one"),
            ("1'000.5 V", "without thousands separators"),
            ("5.0 V ± 1’000 mV (k=2)", "without thousands separators"),
            ("10 ± 0.05 % + 2 mV (k=2)", "is not a unit"),
            ("(5.0e3 ± 1)e-3 V (k=2)", "one power of ten is enough"),
            ("5.0, U = 2 mV, k = 2", "the value has no unit"),
            ("5.0 V ± 0.1 V (k=2, p=99 %)", "k = 2 is less than the 2.58"),
            ("5.0 V ± 0.1 V (k=1.65, 95 %)", "name it"),
            ("5.0 V ± 0.1 V (k=3, p=95 %)", "write `k=3` alone, or `p=95 %, dof=3`"),
            ("5.0 V ± 0.1 V (2)", "`2` alone is ambiguous"),
            ("5.0 V ± 0.1 V (k=2,28)", "with a point"),
            ("5.0 V, U = 0.1 V, p = 95 %, dof = 0", "above zero"),
            ("1.0e-3(2)e2 V", "one power of ten"),
            ("5.0 V ± 0.1 V (k=1.65, 95 %, rectangular)", "`rectangular` is unknown here"),
        ] {
            let error = stated(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
