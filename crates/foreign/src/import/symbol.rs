//! Symbols at the head of columns, with the unit that stands behind them: `u_i(y) mg`, `u / mm`.
//!
//! A heading of contributions that is not known takes the check against the sheet with it, so that all
//! forms in use are read: with the name of the measurand in place of `y`, and with a unit behind a blank, a
//! stroke, `in`, or in brackets.

use super::columns::{Column, unit_as_meant};
use super::heading::is_scale;
use gumption_engine::model::formula::is_name;
use gumption_units::Unit;

/// What a symbol of uncertainties at the head of a column is of, and what stands behind it; `None` of other
/// headings, and where words follow that are no unit.
pub(super) fn of_uncertainties(heading: &str) -> Option<(Column, &str)> {
    let text = heading.trim();
    let (column, rest) = product(text).or_else(|| with_argument(text)).or_else(|| bare(text))?;
    let behind = rest.trim();
    let is_separated = behind.is_empty() || behind.starts_with(['(', '[', '/']);
    let is_apart = rest.starts_with(char::is_whitespace)
        && (behind.starts_with("in ")
            || behind.starts_with("en ")
            || is_unit(behind.split(['(', '[']).next().unwrap_or("")));
    (is_separated || is_apart).then_some((column, rest))
}

/// What stands before the unit of a quotient, `u / mm`, `U (k=2) / mm`, `x in mm`; the whole heading where
/// there is none.
pub(super) fn before_unit(heading: &str) -> &str {
    let unit = |text: &str| {
        let text = text.trim();
        let bare = text.strip_prefix(['(', '[']).and_then(|text| text.strip_suffix([')', ']']));
        let bare = bare.unwrap_or(text.split(" (").next().unwrap_or(text)).trim();
        // types of evaluations, `A/B`
        bare != "B" && is_unit(bare)
    };
    [" / ", " in ", " en ", "/"]
        .into_iter()
        .find_map(|sign| heading.split_once(sign).filter(|(_, behind)| unit(behind)))
        .map_or(heading, |(before, _)| before.trim())
}

fn is_unit(text: &str) -> bool {
    let text = text.trim();
    let is_number = text.parse::<f64>().is_ok();
    !text.is_empty() && !is_number && (Unit::parse(text).is_ok() || unit_as_meant(text).is_some())
}

/// `|c_i|·u(x_i)`, a contribution, and what stands behind it.
fn product(text: &str) -> Option<(Column, &str)> {
    let coefficients = ["|c_i|", "|ci|", "c_i", "ci"];
    let rest = coefficients.iter().find_map(|coefficient| text.strip_prefix(coefficient))?;
    let rest = rest.trim_start().trim_start_matches(['·', '*', '×', '⋅']).trim_start();
    let (_, rest) = with_argument(rest).or_else(|| bare(rest))?;
    Some((Column::Contribution, rest))
}

/// `u(x_i)` of a quantity, `u_i(y)` and `u_i(W_x)` of a result, and what stands behind them.
fn with_argument(text: &str) -> Option<(Column, &str)> {
    let rest = text.strip_prefix('u')?;
    let indexed = rest.strip_prefix("_i").or(rest.strip_prefix('i'));
    let behind = indexed.map_or(rest, str::trim_start);
    let (argument, rest) = behind.strip_prefix('(')?.split_once(')')?;
    let argument = argument.trim();
    let column = match argument {
        "x" | "xi" | "x_i" | "Xi" | "X_i" => Column::Standard,
        "y" => Column::Contribution,
        // `u_i(mV)` has a unit there, and `u_i(rel)` says what kind of numbers they are
        name if indexed.is_some()
            && is_name(name)
            && (!is_unit(name) || is_unit(rest))
            && !is_scale(name) =>
        {
            Column::Contribution
        }
        _ => return None,
    };
    Some((column, rest))
}

/// `u_i` alone, and what stands behind it.
fn bare(text: &str) -> Option<(Column, &str)> {
    let rest = text.strip_prefix("u_i").or(text.strip_prefix("ui"))?;
    let ends = !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    ends.then_some((Column::Standard, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_of_uncertainties() {
        for (heading, column) in [
            ("ui(y) mg", Some(Column::Contribution)),
            ("ui(Wx) mg", Some(Column::Contribution)),
            ("ui(Wx) (mg)", Some(Column::Contribution)),
            ("ui(Wx)", Some(Column::Contribution)),
            ("u_i(y) / mg", Some(Column::Contribution)),
            ("u(y) in mg", Some(Column::Contribution)),
            ("|ci|u(xi) (mg)", Some(Column::Contribution)),
            ("|c_i| · u(x_i) / mg", Some(Column::Contribution)),
            ("c_i u_i", Some(Column::Contribution)),
            ("u_i mg", Some(Column::Standard)),
            ("ui/mg", Some(Column::Standard)),
            ("ui / mg", Some(Column::Standard)),
            ("u(x_i) µV", Some(Column::Standard)),
            ("u_i of the day", None),
            ("uid", None),
        ] {
            let found = of_uncertainties(heading).map(|(column, _)| column);
            assert_eq!(found, column, "{heading}");
        }
    }

    #[test]
    fn quotients() {
        for (heading, before) in [
            ("u / mm", "u"),
            ("u/mm", "u"),
            ("U (k=2) / mm", "U (k=2)"),
            ("U / mm (k=2)", "U"),
            ("x in mm", "x"),
            ("c_i / (mm/K)", "c_i"),
            ("Estimate / mm", "Estimate"),
            ("A/B", "A/B"),
            ("Resolution / half-width", "Resolution / half-width"),
            ("c / 2", "c / 2"),
        ] {
            assert_eq!(before_unit(heading), before, "{heading}");
        }
    }
}
