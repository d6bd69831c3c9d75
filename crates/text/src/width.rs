//! Widths as laboratories write them: a number in the input's unit, or a specification such as
//! `0.02 % rdg + 0.005 % of 10 V + 2 uV`, `Q[100; 1.5 L] nm, L in mm` or
//! `greater of 0.5 % and 0.02 mm`.

mod combined;
mod forms;
mod terms;

use super::DiagnosticKind;
use super::diagnostic_kind::WITHOUT_UNCERTAINTY;
use super::diagnostics::Collector;
use super::json::{Json, Node};
pub use super::value_text::number;
use super::value_text::{bare_number, with_plus_minus};
use gumption_units::Unit;

pub use combined::is_combined;
pub use forms::{Instrument, LinearWidth, Width};
pub use terms::{is_bare_share, share, terms};

impl Width {
    /// Reads the width at `key` of the input `name`, whose unit is `unit`; `instrument` is what the
    /// keys beside it state, `None` where no such keys can stand.
    pub fn read(
        log: &Collector,
        node: &Node,
        name: &str,
        key: &str,
        unit: &Unit,
        instrument: Option<&Instrument>,
    ) -> Result<Self, DiagnosticKind> {
        match &node.value {
            Json::Number(_) => positive(key, node.number().unwrap_or(f64::NAN)),
            Json::Text(found) => {
                let wrong = |reason| {
                    let (name, found) = (name.to_owned(), found.clone());
                    DiagnosticKind::Width { name, found, reason }
                };
                let text = without_plus_minus(found, key).map_err(wrong)?;
                match bare_number(&text) {
                    // in the input's unit, as without the quotation marks
                    Some(absolute) => positive(key, absolute),
                    None => Self::specification(&text, unit, &log.own_units(), instrument)
                        .map_err(wrong),
                }
            }
            other => Err(DiagnosticKind::WrongType {
                what: format!("`{key}`"),
                found: other.kind(),
                expected: "a number or a specification such as \"0.02 % + 2 uV\"",
            }),
        }
    }

    /// Parses a specification for a quantity in `unit`; `own` are the units that the file defines.
    ///
    /// # Errors
    /// Why it is none, as a sentence without a capital.
    pub fn specification(
        text: &str,
        unit: &Unit,
        own: &[Unit],
        instrument: Option<&Instrument>,
    ) -> Result<Self, String> {
        let text = without_outer_parentheses(text.trim());
        let width = match combined::parse(text, unit, own, instrument) {
            Some(width) => width?,
            None => Self::Sum(terms::sum(text, unit, own, instrument)?),
        };
        if width.at(1.0) > 0.0 {
            Ok(width)
        } else {
            Err(format!("it is zero, but a width must be above zero{WITHOUT_UNCERTAINTY}"))
        }
    }
}

/// A width as a number in the input's unit.
fn positive(key: &str, absolute: f64) -> Result<Width, DiagnosticKind> {
    if absolute > 0.0 {
        Ok(Width::Sum(LinearWidth { relative: 0.0, absolute }))
    } else {
        Err(DiagnosticKind::NotPositive { key: key.to_owned(), found: absolute })
    }
}

/// Why a width of two parts that do not add is rejected where only sums are read.
pub const NOT_A_SUM: &str = "only a sum of terms can stand here, such as `0.02 % + 2 uV`; it cannot be a greater of two or \
     `Q[a; bL]`";

/// Keys of widths that extend to both sides of an estimate, so that `±` may precede them.
const BOTH_SIDES: [&str; 4] = ["half_width", "semi_range", "expanded", "cmc"];

/// A width without the `±` before it, as for limits and expanded uncertainties: `±0.05 mm`,
/// `±(0.02 % + 2 uV)`.
///
/// # Errors
/// The value is a standard deviation, which is never written with `±`.
pub fn without_plus_minus(text: &str, key: &str) -> Result<String, String> {
    let written = with_plus_minus(text.trim());
    let Some(width) = written.strip_prefix('±') else { return Ok(text.to_owned()) };
    if !BOTH_SIDES.contains(&key) {
        return Err(format!(
            "`±` belongs to limits or an expanded uncertainty, but `{key}` is a standard \
             deviation: write the `half_width` of a rectangular distribution, or `expanded` with \
             its `k`, or remove the sign"
        ));
    }
    Ok(without_outer_parentheses(width.trim()).to_owned())
}

/// A text without one pair of parentheses around all of it.
fn without_outer_parentheses(text: &str) -> &str {
    let inside = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    let is_pair = |inside: &&str| {
        let mut depth = 0_i32;
        inside.chars().all(|c| {
            depth += i32::from(c == '(') - i32::from(c == ')');
            depth >= 0
        })
    };
    inside.filter(is_pair).unwrap_or(text).trim()
}

#[cfg(test)]
mod tests;
