//! Number formats of a workbook's cells (ECMA-376-1, 18.8.30): what a cell shows behind the number that
//! it holds.
//!
//! A cell that shows `0.02 %` holds 0.0002, and one that shows `0.5 µm` holds 0.5. Who reads a sheet
//! means what it shows.

use gumption_engine::decimal;

/// What a cell shows behind its number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) enum Behind {
    #[default]
    Nothing,
    /// The number is shown a hundred times as large.
    Percent,
    /// As per cent, with letters: `0.1 % FS`.
    PercentOf(String),
    /// Letters, as those of a unit.
    Letters(String),
    /// Nothing, and the number is shown divided by so many thousands.
    Thousands(u32),
}

impl Behind {
    /// By the format's section for positive numbers, its first.
    pub(super) fn of(format: &str) -> Self {
        let mut letters = String::new();
        let (mut has_number, mut is_percent) = (false, false);
        // commas behind the last digit divide, and those between digits group
        let (mut commas, mut thousands) = (0, 0);
        let digits = format.replacen("General", "0", 1);
        let mut signs = digits.chars();
        while let Some(sign) = signs.next() {
            match sign {
                ';' => break,
                '%' => is_percent = true,
                ',' if has_number => commas += 1,
                '.' => thousands += std::mem::take(&mut commas),
                '"' => letters.extend(signs.by_ref().take_while(|c| *c != '"')),
                '\\' => letters.extend(signs.next()),
                // room of a sign's width, and a sign that fills the cell
                '_' | '*' => drop(signs.next()),
                '[' => {
                    // a currency, or whatever was put in its place, before the language
                    let inside: String = signs.by_ref().take_while(|c| *c != ']').collect();
                    let currency = inside.strip_prefix('$').unwrap_or_default();
                    letters.push_str(currency.split('-').next().unwrap_or_default());
                }
                '0' | '#' | '?' => {
                    has_number = true;
                    commas = 0;
                    letters.clear();
                }
                _ => {}
            }
        }
        let letters = letters.trim();
        if thousands + commas > 0 {
            return Self::Thousands(thousands + commas);
        }
        if is_percent {
            let is_bare = !letters.contains(char::is_alphabetic);
            return if is_bare { Self::Percent } else { Self::PercentOf(letters.to_owned()) };
        }
        let is_unit = letters == "%"
            || has_number
                && letters.contains(|c: char| c.is_alphabetic() || matches!(c, '°' | '‰'));
        if is_unit { Self::Letters(letters.to_owned()) } else { Self::Nothing }
    }

    /// A number with what stands behind it; no number where it is shown divided, so that who needs one
    /// refuses it.
    pub(super) fn text(&self, value: f64) -> String {
        match self {
            Self::Nothing => value.to_string(),
            Self::Percent => format!("{}%", decimal::to_15_digits(100.0 * value)),
            Self::PercentOf(letters) => {
                format!("{}% {letters}", decimal::to_15_digits(100.0 * value))
            }
            Self::Thousands(count) => {
                format!("{value} shown divided by 1{}", "000".repeat((*count).min(100) as usize))
            }
            Self::Letters(letters) => format!("{value} {letters}"),
        }
    }
}

/// The power of ten of the last digit that a format shows of a number, which is shown a hundred times as
/// large in per cent; `None` where the format does not tell, as `General`, fractions and texts do not.
pub(super) fn last_digit(format: &str, value: f64) -> Option<i32> {
    // the placeholders of digits, the decimal mark and the exponent of the first section
    let mut core = String::new();
    let mut signs = format.chars();
    while let Some(sign) = signs.next() {
        match sign {
            ';' => break,
            '"' => drop(signs.by_ref().find(|c| *c == '"')),
            '[' => drop(signs.by_ref().find(|c| *c == ']')),
            '\\' | '_' | '*' => drop(signs.next()),
            '0' | '#' | '?' => core.push('0'),
            '.' | '%' | 'E' | 'e' | '/' | '@' => core.push(sign.to_ascii_uppercase()),
            c if c.is_alphabetic() => return None,
            _ => {}
        }
    }
    let value = if core.contains('%') { 100.0 * value } else { value };
    let core = core.replace('%', "");
    let (mantissa, exponent) = core.split_once('E').map_or((&*core, None), |(m, e)| (m, Some(e)));
    let (whole, decimals) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let are_zeros = |text: &str| text.bytes().all(|of| of == b'0');
    if mantissa.is_empty() || !are_zeros(whole) || !are_zeros(decimals) {
        return None;
    }
    let decimals = u32::try_from(decimals.len()).ok()?;
    match exponent {
        None => Some(-i32::try_from(decimals).ok()?),
        // several digits before the mark go with exponents that are their multiples
        Some(_) if whole.len() == 1 => decimal::position(value, decimals + 1),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_cell_shows() {
        for (format, shown) in [
            ("General", "0.0002"),
            ("General\" V\"", "0.0002 V"),
            ("0.00", "0.0002"),
            ("0.00%", "0.02%"),
            ("0.00\\ %", "0.02%"),
            ("0.00%;[Red]-0.00%", "0.02%"),
            ("0.00\"%\"", "0.0002 %"),
            ("0.000\" µm\"", "0.0002 µm"),
            ("0.0\\ \\m\\V", "0.0002 mV"),
            ("\"±\" 0.0", "0.0002"),
            ("\"U = \"0.0\" V\"", "0.0002 V"),
            ("\"n\" 0", "0.0002"),
            ("#,##0.00 [$Ω-407]", "0.0002 Ω"),
            ("0.0 \\°\\C", "0.0002 °C"),
            ("0.00_);(0.00\" m\")", "0.0002"),
            ("0.00E+00", "0.0002"),
            ("[Red]0.0", "0.0002"),
            ("@", "0.0002"),
            ("\"unfinished", "0.0002"),
            ("0.0%\" FS\"", "0.02% FS"),
            ("0.0%\\ \\F\\S", "0.02% FS"),
            ("0.00%_)", "0.02%"),
            ("0.0,", "0.0002 shown divided by 1000"),
            ("0,,\" M\"", "0.0002 shown divided by 1000000"),
            ("0,.0", "0.0002 shown divided by 1000"),
            ("#,##0.00", "0.0002"),
            ("#,###", "0.0002"),
        ] {
            assert_eq!(Behind::of(format).text(0.0002), shown, "{format}");
        }
        for (format, value, last) in [
            ("0.00", 10.016_67, Some(-2)),
            ("#,##0.000_);(#,##0.000)", 1234.5, Some(-3)),
            ("0", 2.5, Some(0)),
            ("0.0##\" mV\"", 2.5, Some(-3)),
            ("0.00%", 0.0412, Some(-2)),
            ("0.00E+00", 1234.0, Some(1)),
            ("[Red]0.0\\ \\V", 1.0, Some(-1)),
            ("##0.0E+0", 1234.0, None),
            ("General", 1.5, None),
            ("# ?/?", 1.5, None),
            ("@", 1.5, None),
        ] {
            assert_eq!(last_digit(format, value), last, "{format}");
        }
        assert_eq!(Behind::Percent.text(0.07), "7%");
        assert_eq!(Behind::Percent.text(-1.5), "-150%");
    }
}
