//! Formulas of numbers alone, `60/2`: of a quantity in degrees they can be 30 degrees, as the quantity
//! is given, or 30 radians, as formulas count. None of the two is taken. Nor is it of names that have no
//! unit, as those of a column without one in its heading.

use std::collections::HashMap;

use super::scopes;
use gumption_engine::decimal::to_15_digits;
use gumption_engine::model::formula::{Formula, NameKind, PlainNumber, Scope};
use gumption_engine::number::Shortest;
use gumption_text::DiagnosticKind;
use gumption_text::value_text::{ValueOf, converted, with_unit};
use gumption_text::width::number;
use gumption_units::{Turn, Unit};

/// The mistake of an estimate that is a formula of numbers alone; that of another key is
/// [`DiagnosticKind::of_key`].
pub(super) fn mistake(formula: &Formula, unit: &Unit, of: ValueOf) -> Option<DiagnosticKind> {
    let reason = refused(formula, unit, of)?;
    let (key, found) = ("mean".to_owned(), formula.text().to_owned());
    Some(DiagnosticKind::Value { key, found, reason })
}

/// The mistake of an estimate or a limit in per cent, degrees or the like that is computed from names of which
/// no unit is said: their numbers can be in that unit or plain.
pub(super) fn without_unit(
    formula: &Formula,
    unit: &Unit,
    is_unstated: impl Fn(&str) -> bool,
) -> Option<DiagnosticKind> {
    let text = formula.text().trim();
    let first = formula.names().next().map(|(name, _)| name)?;
    let are_plain = formula.names().all(|(name, _)| is_unstated(name));
    let is_share = unit.dimension().is_none() && unit.level_exponent().is_zero();
    let is_in_radians = unit.turn() == Some(Turn::Angle) && names_pi(text);
    if !are_plain || is_in_radians || !is_share || unit.factor() == 1.0 || text.contains(['[', '"'])
    {
        return None;
    }
    let (plain, own) = match unit.turn() {
        Some(Turn::Angle) => ("in radians".to_owned(), "rad"),
        _ => (format!("plain, of which 1 is {} {unit}", Shortest(unit.from_si(1.0))), "1"),
    };
    let reason = format!(
        "`{first}` has no unit, so that its number can be in `{unit}`, as the quantity is given, or {plain}: \
         give `{first}` a unit, `{unit}` or `{own}`"
    );
    Some(DiagnosticKind::Value { key: "mean".to_owned(), found: text.to_owned(), reason })
}

/// The mistake of a formula of conditions for what is in per cent, degrees or the like that chooses among plain
/// numbers, or adds to one: `if(f > 100 [Hz], 5, 8)` can be 5 % or 500 %.
pub(super) fn plain_number(
    formula: &Formula,
    unit: &Unit,
    of: ValueOf,
    kind_of: impl Fn(&str) -> NameKind,
) -> Option<DiagnosticKind> {
    let text = formula.text().trim();
    let is_in_radians = unit.turn() == Some(Turn::Angle) && names_pi(text);
    let is_scaled = unit.dimension().is_none()
        && unit.level_exponent().is_zero()
        && unit.factor() != 1.0
        && unit.turn() != Some(Turn::Periods);
    if !is_scaled || is_in_radians || formula.names().next().is_none() {
        return None;
    }
    let found = formula.plain_number(kind_of, of == ValueOf::Difference)?;
    let (counted, plain) = match unit.turn() {
        Some(_) => ("in radians", "rad"),
        None => ("plain", "1"),
    };
    let one = format!("of which 1 is {} {unit}", Shortest(unit.from_si(1.0)));
    let PlainNumber { text: number, is_alone, .. } = &found;
    // an angle of 5 rad is written so, and 500 % are the number 5
    let other = match (found.number, unit.turn()) {
        (Some(value), None) => {
            format!("`{} [{unit}]`", Shortest(to_15_digits(unit.from_si(value))))
        }
        _ => format!("`{number} [{plain}]`"),
    };
    let remedy = match (found.number, is_alone) {
        (None, _) => format!("give `{number}` a unit, `{unit}` or `{plain}`"),
        (_, true) => format!("write `{number} [{unit}]` or {other}"),
        // what stands beside the number has no unit either
        (_, false) => format!("write `({text})*1 [{unit}]` or `({text})*1 [{plain}]`"),
    };
    let reason = format!(
        "`{number}` has no unit, so that it can be in `{unit}`, as the quantity is given, or {counted}, as \
         formulas count, {one}: {remedy}"
    );
    Some(DiagnosticKind::Value { key: "mean".to_owned(), found: text.to_owned(), reason })
}

/// Whether a formula computes with pi, as one in radians.
fn names_pi(text: &str) -> bool {
    text.contains("pi") || text.contains('π')
}

/// Why a formula of conditions that has none, nor a unit in brackets, is no value in `unit`; `None` of
/// every other formula, and where both readings are the same plain number. Angles may be computed with
/// pi, as in radians.
fn refused(formula: &Formula, unit: &Unit, of: ValueOf) -> Option<String> {
    let text = formula.text().trim();
    let is_plain =
        unit.dimension().is_none() && unit.factor() == 1.0 && unit.level_exponent().is_zero();
    let is_angle = unit.turn() == Some(Turn::Angle);
    let is_in_radians = is_angle && names_pi(text);
    if is_plain || is_in_radians || formula.names().next().is_some() || text.contains(['[', '"']) {
        return None;
    }
    let value = formula.evaluate(&Scope::new(), &HashMap::<String, f64>::new()).ok()?;
    let own = in_unit(text, value, unit, of);
    let is_coherent = unit.factor() == 1.0 && unit.zero().is_none();
    if is_coherent || unit.is_celsius() || !unit.level_exponent().is_zero() {
        return Some(format!("it is computed from numbers alone, without a unit: write `{own}`"));
    }
    let coherent = |unit: &str| {
        let written = Unit::parse(unit).map(|unit| in_unit(text, value, &unit, of));
        (format!("`{unit}`"), written.unwrap_or_else(|_| format!("{} {unit}", Shortest(value))))
    };
    let (counted, other) = match unit.turn() {
        Some(_) if unit.dimension().is_none() => coherent("rad"),
        _ if unit.dimension().is_none() => {
            let converted = Shortest(unit.from_si(value));
            ("plain numbers".to_owned(), format!("{converted} {unit}"))
        }
        _ => coherent(&scopes::coherent(unit.dimension())),
    };
    Some(format!(
        "it is computed from numbers alone, which can be in `{unit}`, as the quantity is given, or in \
         {counted}, as formulas count: write `{own}` or `{other}`"
    ))
}

/// The formula with the unit behind its first number, where it reads as that value; else the value.
fn in_unit(text: &str, value: f64, unit: &Unit, of: ValueOf) -> String {
    let written = number(text).map(|(_, rest)| {
        let first = text.get(..text.len() - rest.len()).unwrap_or_default().trim_end();
        format!("{first} {unit}{rest}")
    });
    let is_same = |written: &String| {
        let read = with_unit(written).map(|read| converted(read, unit, of, &[]));
        read.and_then(Result::ok).is_some_and(|read| (read - value).abs() <= 1e-12 * value.abs())
    };
    written.ok().filter(is_same).unwrap_or_else(|| format!("{} {unit}", Shortest(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str, unit: &str) -> Option<String> {
        let unit = Unit::parse(unit).expect("a unit");
        refused(&Formula::parse(text).expect("a formula"), &unit, ValueOf::Difference)
    }

    #[test]
    fn both_readings_are_named() {
        for (text, unit, parts) in [
            ("60/2", "deg", ["`60 deg/2`", "`60 rad/2`"]),
            ("0.1/sqrt(3)", "deg", ["`0.1 deg/sqrt(3)`", "`0.1 rad/sqrt(3)`"]),
            ("0.5/2", "%", ["`0.5 %/2`", "`25 %`"]),
            ("1/2", "ppm", ["`1 ppm/2`", "`500000 ppm`"]),
            ("5/2", "mm", ["`5 mm/2`", "`5 m/2`"]),
            ("(1 + 2)*2", "mm", ["`6 mm`", "`6 m`"]),
            ("0.2/2", "dB", ["`0.2 dB/2`", "without a unit"]),
            ("5/2", "V", ["`5 V/2`", "without a unit"]),
        ] {
            let said = said(text, unit).expect(text);
            for part in parts {
                assert!(said.contains(part), "{text} {unit}: {said}");
            }
        }
    }

    /// Names without a unit in per cent or degrees, in an estimate, a width, a limit, of a condition, a column or
    /// a constant; with a unit, and beside one, they are what they say.
    #[test]
    fn names_without_a_unit_are_refused_with_both_readings() {
        let read = |condition: &str, mean: &str, unit: &str| {
            let text = format!(
                r#"{{"conditions": {{"c": {{{condition}"values": [0.5, 1]}}}},
                "inputs": {{"k": {{"distribution": "constant", "value": 45}},
                "s": {{"unit": "%", "distribution": "constant", "value": 2}},
                "x": {{"unit": "{unit}", "distribution": "normal", "mean": "{mean}", "std": 0.1}}}},
                "equations": {{"y": "x*s"}},
                "outputs": {{"y": {{"unit": "%", "tolerance": {{"upper": "s*0 + 3*c*1 [%]"}}}}}}}}"#
            );
            let text = text.replace("s*0 + ", "");
            crate::read_text("m", &text, std::path::Path::new(""), &[])
                .map_err(|e| format!("{e:?}"))
        };
        for (mean, unit, said) in [
            ("c", "%", "`c` has no unit, so that its number can be in `%`"),
            ("2*c", "%", "of which 1 is 100 %"),
            ("k", "deg", "in radians: give `k` a unit, `deg` or `rad`"),
            ("k + c", "ppm", "of which 1 is 1000000 ppm"),
        ] {
            let found = read("", mean, unit).unwrap_err();
            assert!(found.contains(said), "{mean} {unit}: {found}");
        }
        for (condition, mean, unit) in [
            (r#""unit": "%", "#, "c", "%"),
            (r#""unit": "1", "#, "c", "%"),
            ("", "c", "1"),
            ("", "c*s", "%"),
            ("", "c*1 [%]", "%"),
            ("", "pi*c/180", "deg"),
        ] {
            read(condition, mean, unit).unwrap();
        }
    }

    /// Choices and sums of plain numbers in a width, an estimate, a limit and a capability; not ratios of
    /// conditions, the whole less one, and what says its unit.
    #[test]
    fn formulas_of_conditions_with_plain_numbers_are_refused() {
        let read = |unit: &str, [mean, std, upper, cmc]: [&str; 4]| {
            let text = format!(
                r#"{{"conditions": {{"f": {{"unit": "Hz", "values": [10, 1000]}},
                "f0": {{"unit": "kHz", "values": [1, 1]}}, "c": {{"values": [1, 2]}}}},
                "inputs": {{"x": {{"unit": "{unit}", "distribution": "normal", "mean": {mean},
                "std": {std}}}}}, "equations": {{"y": "x"}},
                "outputs": {{"y": {{"unit": "{unit}", "tolerance": {{"upper": {upper}}},
                "cmc": {cmc}}}}}}}"#
            );
            let read = crate::read_text("m", &text, std::path::Path::new(""), &[]);
            read.map(|_| ()).map_err(|mistakes| mistakes.to_string())
        };
        let places = ["mean", "std", "upper", "cmc"];
        let at = |unit: &str, key: &str, formula: &str| {
            let all = places.map(|place| match place {
                _ if place == key => format!("\"{formula}\""),
                "std" | "cmc" => "0.1".to_owned(),
                _ => "10".to_owned(),
            });
            read(unit, [&all[0], &all[1], &all[2], &all[3]])
        };
        for (unit, key, formula, said) in [
            ("%", "upper", "if(f > 100 [Hz], 5, 8)", "write `5 [%]` or `500 [%]`"),
            ("%", "cmc", "if(f > 100 [Hz], 0.5, 0.8)", "write `0.5 [%]` or `50 [%]`"),
            ("%", "std", "if(f > 100 [Hz], 0.1, 0.2)", "write `0.1 [%]` or `10 [%]`"),
            ("%", "std", "0.1*(1 + f/1000 [Hz])", "`(0.1*(1 + f/1000 [Hz]))*1 [%]`"),
            ("%", "std", "sqrt(0.1^2 + (0.05*f/1000 [Hz])^2)", "`0.1^2` has no unit"),
            ("%", "mean", "100 - f/[Hz]/100", "`(100 - f/[Hz]/100)*1 [%]`"),
            ("deg", "mean", "if(f>100 [Hz],10,20)", "write `10 [deg]` or `10 [rad]`"),
            ("ppm", "std", "if(f > 100 [Hz], 0.1, 0.2)", "or `100000 [ppm]`"),
            ("mV/V", "std", "max(0.1, 0.2*f/1000 [Hz])", "`0.1` has no unit"),
            ("um/m", "upper", "if(f > 100 [Hz], 5, 8)", "write `5 [um/m]`"),
            ("%", "mean", "if(f > 100 [Hz], c, 3)", "give `c` a unit, `%` or `1`"),
            ("%", "upper", "if(f > 100 [Hz], 5 [%], 8)", "write `8 [%]` or `800 [%]`"),
        ] {
            let found = at(unit, key, formula).unwrap_err();
            assert!(found.contains(said) && found.contains(&format!("of `{key}`")), "{found}");
        }
        for (unit, key, formula) in [
            ("%", "mean", "f/f0"),
            ("%", "mean", "1 - f/f0"),
            ("%", "upper", "0.5*(1 - f/f0)"),
            ("%", "mean", "1/(1 + (f/f0)^2)"),
            ("%", "mean", "if(f > 100 [Hz], f/f0, 0)"),
            ("%", "std", "0.01*f/f0"),
            ("%", "std", "if(f > 100 [Hz], 0.1 [%], 0.2 [%])"),
            ("%", "std", "if(f > 100 [Hz], 0.1 [1], 0.2 [1])"),
            ("%", "std", "(0.1*(1 + f/1000 [Hz]))*1 [%]"),
            ("deg", "mean", "if(f > 100 [Hz], pi/4, pi/2)"),
            ("1", "std", "if(f > 100 [Hz], 0.1, 0.2)"),
        ] {
            assert_eq!(at(unit, key, formula), Ok(()), "{formula} in {unit}");
        }
    }

    fn model(input: &str, unit: &str) -> Result<crate::ModelFile, gumption_text::Diagnostics> {
        let text = format!(
            r#"{{"inputs": {{"x": {input}}}, "equations": {{"y": "x"}},
            "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
        );
        crate::read_text("m", &text, std::path::Path::new(""), &[])
    }

    /// A number in quotation marks is one without them, in whatever unit.
    #[test]
    fn one_number_is_in_the_unit_of_its_quantity() {
        for (unit, fields, [mean, std]) in [
            ("deg", r#""distribution": "normal", "mean": "30", "std": "0.1""#, [30.0, 0.1]),
            ("mm", r#""distribution": "normal", "mean": "30", "std": "0.1""#, [30.0, 0.1]),
            ("%", r#""distribution": "normal", "mean": "30", "std": "0.5""#, [30.0, 0.5]),
            ("ppm", r#""distribution": "constant", "value": "3""#, [3.0, 0.0]),
            (
                "deg",
                r#""distribution": "readings", "values": ["30", "31", 32]"#,
                [31.0, 1.0 / 3.0_f64.sqrt()],
            ),
        ] {
            let input = format!(r#"{{"unit": "{unit}", {fields}}}"#);
            let file = model(&input, unit).unwrap();
            let known = &file.task.rows[0].distributions[0];
            let found = [known.mean(), known.standard_uncertainty()];
            let is_near = |(a, b): (f64, f64)| (a - b).abs() < 1e-12;
            assert!(is_near((found[0], mean)) && is_near((found[1], std)), "{input}: {found:?}");
        }
    }

    #[test]
    fn formulas_of_numbers_are_refused_where_they_stand() {
        for (unit, fields, key) in [
            ("deg", r#""distribution": "normal", "mean": "60/2", "std": 1"#, "mean"),
            (
                "deg",
                r#""distribution": "rectangular", "mean": 1, "half_width": "0.1/sqrt(3)""#,
                "half_width",
            ),
            ("%", r#""distribution": "normal", "mean": 1, "std": "0.5/2""#, "std"),
            ("dB", r#""distribution": "normal", "mean": 1, "std": "0.2/2""#, "std"),
            ("ppm", r#""distribution": "readings", "values": [1, "4/2", 3]"#, "values"),
        ] {
            let said = model(&format!(r#"{{"unit": "{unit}", {fields}}}"#), unit).unwrap_err();
            assert_eq!(said.0.len(), 1, "{said}");
            let said = said.to_string();
            assert!(
                said.contains("numbers alone") && said.contains(&format!("of `{key}`")),
                "{said}"
            );
        }
        let checked =
            r#"{"unit": "deg", "distribution": "normal", "mean": "pi/6", "std": "0.3 deg/3"}"#;
        let file = model(checked, "deg").unwrap();
        let known = &file.task.rows[0].distributions[0];
        assert!((known.mean() - 30.0).abs() < 1e-12);
        assert!((known.standard_uncertainty() - 0.1).abs() < 1e-12);
    }

    #[test]
    fn what_is_read_in_one_way() {
        for (text, unit) in
            [("60/2", "1"), ("60/2", "rad"), ("pi/4", "deg"), ("2*f", "deg"), ("5 [mm]/2", "mm")]
        {
            assert_eq!(said(text, unit), None, "{text} {unit}");
        }
    }
}
