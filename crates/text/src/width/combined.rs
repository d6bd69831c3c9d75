//! Widths of two parts that do not add: Q\[a; bL\], the greater of two.

use super::forms::{Instrument, LinearWidth, Width};
use super::terms::{converted, ratio, share, sum};
use crate::value_text::{decimal_comma, is_comma, number};
use gumption_units::Unit;

/// The two parts of a width, as written.
enum Parts<'t> {
    /// Of Q\[a; bL\]: the text in the brackets and the text after them.
    Brackets { inside: &'t str, behind: &'t str },
    /// Of `greater of a and b`, and its other ways to write it.
    Greater([&'t str; 2]),
}

/// Whether a text is a width of two parts that do not add, and no formula.
pub fn is_combined(text: &str) -> bool {
    Parts::of(text.trim()).is_some()
}

impl<'t> Parts<'t> {
    fn of(text: &'t str) -> Option<Self> {
        if let Some(rest) = text.strip_prefix('Q')
            && let Some(rest) = rest.trim_start().strip_prefix('[')
        {
            let (inside, behind) = rest.split_once(']')?;
            return Some(Self::Brackets { inside, behind: behind.trim() });
        }
        let words = ["the greater of ", "greater of ", "the larger of ", "larger of "];
        if let Some(rest) = words.iter().find_map(|words| text.strip_prefix(words)) {
            return Self::greater(rest.split_once(" and ").or_else(|| rest.split_once(" or "))?);
        }
        let words = ["whichever is greater", "whichever is larger"];
        if let Some(before) = words.iter().find_map(|words| text.strip_suffix(words)) {
            return Self::greater(before.trim_end().trim_end_matches(',').split_once(" or ")?);
        }
        let pair = text.strip_prefix("max(")?.strip_suffix(')')?.split_once(',')?;
        // of numbers alone and of names it is a formula
        let has_unit = |part: &str| {
            let rest = number(part.trim()).map(|(_, rest)| rest);
            rest.is_ok_and(|rest| rest.starts_with(|c: char| c == '%' || c.is_alphabetic()))
        };
        if has_unit(pair.0) || has_unit(pair.1) { Self::greater(pair) } else { None }
    }

    #[allow(clippy::unnecessary_wraps)]
    fn greater((first, second): (&'t str, &'t str)) -> Option<Self> {
        Some(Self::Greater([first.trim(), second.trim()]))
    }
}

/// The width of two parts that a text states; `None` if the text is another specification.
pub(super) fn parse(
    text: &str,
    unit: &Unit,
    own: &[Unit],
    instrument: Option<&Instrument>,
) -> Option<Result<Width, String>> {
    Some(match Parts::of(text)? {
        Parts::Greater([first, second]) => sum(first, unit, own, instrument)
            .and_then(|first| Ok(Width::Greater([first, sum(second, unit, own, instrument)?]))),
        Parts::Brackets { inside, behind } => {
            root_of_squares(inside, behind, unit, own, instrument).map(Width::RootOfSquares)
        }
    })
}

/// What follows the brackets: the unit of both numbers, and the quantity L with its unit.
struct Behind<'t> {
    unit: &'t str,
    quantity: Option<(&'t str, &'t str)>,
}

impl<'t> Behind<'t> {
    /// Of `nm, L in mm` and `nm (L in mm)`.
    fn of(text: &'t str) -> Self {
        let Some((before, unit)) = text.split_once(" in ") else {
            return Self { unit: text, quantity: None };
        };
        let before = before.trim_end();
        let at = before.rfind(|c: char| !c.is_alphanumeric()).map_or(0, |at| at + 1);
        let (first, name) = before.split_at(at);
        let first = first.trim_end_matches([',', ';', '(', ' ']);
        Self { unit: first, quantity: Some((name, unit.trim_end_matches(')').trim())) }
    }
}

/// The two parts of Q\[a; bL\]: a, and b times the estimate.
///
/// # Errors
/// Why they cannot be read, as a sentence without a capital.
fn root_of_squares(
    inside: &str,
    behind: &str,
    unit: &Unit,
    own: &[Unit],
    instrument: Option<&Instrument>,
) -> Result<[LinearWidth; 2], String> {
    let written = format!("Q[{inside}]");
    if unit.is_celsius() || !unit.level_exponent().is_zero() {
        return Err(format!(
            "in `{written}` L is the estimate, which has no share in `{unit}`: write a width in `{unit}`"
        ));
    }
    let separator = if inside.contains(';') { ';' } else { ',' };
    let parts: Vec<&str> = inside.split(separator).map(str::trim).collect();
    let &[first, second] = parts.as_slice() else {
        return Err(format!("`{written}` has two parts, such as `Q[100; 1.5 L] nm, L in mm`"));
    };
    let Behind { unit: common, quantity } = Behind::of(behind);
    let (constant, unit_of_first) = number(first)?;
    let (slope, rest) = number(second)?;
    for (value, rest) in [(constant, unit_of_first), (slope, rest)] {
        if is_comma(rest) {
            return Err(decimal_comma(value, rest));
        }
        if !(value >= 0.0 && value.is_finite()) {
            return Err(format!("`{written}` has a part that is not a positive value"));
        }
    }
    let names: &[&str] = &quantity.map_or(vec!["L", "l"], |(name, _)| vec![name]);
    let unit_of_second =
        names.iter().find_map(|name| rest.strip_suffix(name)).ok_or_else(|| {
            format!("in `{written}` the second part needs L, as in `Q[100; 1.5 L] nm, L in mm`")
        })?;
    let unit_of_second = unit_of_second.trim_end_matches(['*', '·', '⋅', '×', ' ']);
    let is_without_units = unit_of_first.is_empty() && unit_of_second.is_empty();
    let linear = |relative, absolute| LinearWidth { relative, absolute };
    match quantity {
        // the numbers are in a unit for L in another unit
        Some((_, unit_of_quantity)) if is_without_units && !common.is_empty() => {
            let constant = converted(constant, common, own, unit, first)?;
            let slope = converted(slope, common, own, unit, second)?;
            let of_one = converted(1.0, unit_of_quantity, own, unit, behind)?;
            Ok([linear(0.0, constant), linear(slope / of_one, 0.0)])
        }
        None if common.is_empty() && !(unit_of_first.is_empty() && unit.has_name()) => {
            let absolute = sum(first, unit, own, instrument)?;
            let share = match unit_of_second {
                "" => Some((1.0, "")),
                text => share(text).or_else(|| ratio(text, unit, own)),
            };
            let (factor, _) = share.filter(|(_, base)| base.is_empty()).ok_or_else(|| {
                format!(
                    "`{unit_of_second}` in `{second}` is not a ratio: write a number, `um/m` or the like \
                     before L, or `Q[100; 1.5 L] nm, L in mm`"
                )
            })?;
            Ok([absolute, linear(slope * factor, 0.0)])
        }
        _ => Err(format!(
            "`{written}` needs the unit of its numbers and the unit of L: write them after the brackets, \
             such as `Q[100; 1.5 L] nm, L in mm`, or in them, such as `Q[0.1 um; 1.5e-6 L]`"
        )),
    }
}
