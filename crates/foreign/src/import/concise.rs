//! Estimates with their standard uncertainty in the last digits, `20.00(6) V` (JCGM 100, 7.2.2).

use gumption_engine::decimal::to_15_digits;

use super::number::half_digit;
use super::number::number;
use gumption_text::value_text::with_exponents;

/// The number, its standard uncertainty and the unit behind both; `None` of other texts. A power of ten may
/// follow the parenthesis, `1.5(3)e-3 V` or `1.5(3)×10⁻³ V`.
pub(crate) fn concise(text: &str, decimal_comma: bool) -> Option<(f64, f64, &str)> {
    let text = text.trim();
    let written = with_exponents(text);
    let (digits, rest) = written.split_once('(')?;
    let (inside, behind) = rest.split_once(')')?;
    let (power, unit) = exponent(behind).unwrap_or((0, behind));
    let digits = match power {
        0 => digits.trim_end().to_owned(),
        power => format!("{}e{power}", digits.trim_end()),
    };
    let value = number(&digits, decimal_comma).filter(|_| !digits.contains('%'))?;
    let is_written = !inside.is_empty() && inside.bytes().all(|byte| byte.is_ascii_digit());
    // half of a unit of the last digit of the number
    let std = number(inside, false).filter(|_| is_written)? * 2.0 * half_digit(&digits);
    let std = if power == 0 { std } else { to_15_digits(std) };
    let unit = text.get(text.len().checked_sub(unit.trim().len())?..)?;
    // any other power of ten is none
    let is_unit = !unit.starts_with(['e', 'E', '·', '×', '*', '(']);
    is_unit.then_some((value, std, unit))
}

/// The power of ten that a text begins with, `e-3`, and what follows it.
fn exponent(text: &str) -> Option<(i32, &str)> {
    let rest = text.strip_prefix(['e', 'E'])?;
    let signed = rest.strip_prefix(['-', '+']).unwrap_or(rest);
    let length = signed.find(|c: char| !c.is_ascii_digit()).unwrap_or(signed.len());
    let (power, unit) = rest.split_at(rest.len() - signed.len() + length);
    Some((power.parse().ok()?, unit))
}

#[cfg(test)]
mod tests {
    use super::concise;

    #[test]
    fn uncertainties_in_the_last_digits() {
        for (text, found) in [
            ("20.00(6) V", Some((20.0, 0.06, "V"))),
            ("0.50(3)", Some((0.5, 0.03, ""))),
            ("100(2) mV", Some((100.0, 2.0, "mV"))),
            ("20.00 V (k=2)", None),
            ("20.00(k=2)", None),
            ("1.5(3)e-3 V", Some((0.0015, 0.0003, "V"))),
            ("1.5(3)×10^-3 V", Some((0.0015, 0.0003, "V"))),
            ("1.50(12) × 10⁻³ V", Some((0.0015, 0.00012, "V"))),
            ("-1.5(3)E+3", Some((-1500.0, 300.0, ""))),
            ("1.5(3)e V", None),
            ("1.5e3(3)e3 V", None),
            ("1.5(3)×2 V", None),
            ("20 V", None),
        ] {
            let read = concise(text, false);
            let is_same = match (read, found) {
                // two roundings
                (Some((x, u, unit)), Some((value, std, of))) => {
                    x == value && (u / std - 1.0_f64).abs() < 1e-15 * 4.0 && unit == of
                }
                (read, found) => read == found,
            };
            assert!(is_same, "{text}: {read:?}");
        }
    }
}
