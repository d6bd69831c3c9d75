//! Number formats of workbook cells (ECMA-376-1, 18.8.30): what a cell displays around the number
//! that it holds.
//!
//! A cell that displays `0.02 %` holds 0.0002, one that displays `0.5 µm` holds 0.5, and one that
//! displays `√3` holds 3. The reader of a sheet means what it displays.

use gumption_engine::decimal;

/// How a cell displays a number, by the sections of its format.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct NumberFormat {
    usual: FormatSection,
    /// The section for negative numbers, if there is one.
    negative: Option<FormatSection>,
}

/// What a section of a format displays around a number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct FormatSection {
    /// A prefix that changes the value of the number: `√`, `1/`, a minus sign.
    before: String,
    behind: Behind,
}

/// What a cell displays after its number, or instead of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
enum Behind {
    #[default]
    Nothing,
    /// The number is displayed multiplied by 100.
    Percent,
    /// In per cent, followed by letters: `0.1 % FS`.
    PercentOf(String),
    /// Letters, such as a unit, or a power of ten.
    Letters(String),
    /// Nothing; the number is displayed divided by this many powers of 1000.
    Thousands(u32),
    /// Characters between the digits, possibly a decimal mark that the value does not have.
    Between(String),
    /// A text instead of the number.
    Instead(String),
}

/// The part of a section in which a character stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SignPlace {
    Before,
    Within,
}

impl NumberFormat {
    /// Parses a format: its first section is for positive numbers, the second for negative ones.
    pub(crate) fn of(format: &str) -> Self {
        let (usual, rest) = FormatSection::of(format, false);
        let negative = rest.map(|rest| FormatSection::of(rest, true).0);
        Self { usual, negative }
    }

    fn section(&self, value: f64) -> &FormatSection {
        self.negative.as_ref().filter(|_| value < 0.0).unwrap_or(&self.usual)
    }

    /// Whether a cell displays the bare number.
    pub(crate) fn is_plain(&self) -> bool {
        let is_plain = |section: &FormatSection| *section == FormatSection::default();
        is_plain(&self.usual) && self.negative.as_ref().is_none_or(is_plain)
    }

    /// Whether the displayed digits are those of the value, possibly in per cent.
    pub(crate) fn shows_digits_of(&self, value: f64) -> bool {
        let FormatSection { before, behind } = self.section(value);
        before.is_empty()
            && match behind {
                Behind::Letters(letters) => {
                    !letters.starts_with(makes_another) && !is_power(letters)
                }
                Behind::Between(_) | Behind::Instead(_) | Behind::Thousands(_) => false,
                Behind::Nothing | Behind::Percent | Behind::PercentOf(_) => true,
            }
    }

    /// The number as displayed, with all its digits. If it is displayed divided or in pieces, the
    /// text is not a number, so that a caller that needs a number rejects it.
    pub(crate) fn text(&self, value: f64) -> String {
        let FormatSection { before, behind } = self.section(value);
        let hundredfold = || decimal::to_15_digits(100.0 * value.abs());
        let shown = |number: &str| {
            let sign = if value < 0.0 { "-" } else { "" };
            format!("{sign}{before}{number}")
        };
        let number = value.abs().to_string();
        match behind {
            Behind::Nothing => shown(&number),
            Behind::Percent => shown(&format!("{}%", hundredfold())),
            Behind::PercentOf(letters) => shown(&format!("{}% {letters}", hundredfold())),
            Behind::Thousands(count) => {
                let thousands = "000".repeat((*count).min(100) as usize);
                shown(&format!("{number} shown divided by 1{thousands}"))
            }
            // with a space it would be a unit
            Behind::Letters(letters) if is_power(letters) => shown(&(number + letters)),
            Behind::Letters(letters) => shown(&format!("{number} {letters}")),
            Behind::Between(signs) => {
                shown(&format!("{number} shown with `{signs}` between digits"))
            }
            Behind::Instead(text) => text.clone(),
        }
    }
}

/// Whether a character before or after a number changes its value.
fn makes_another(sign: char) -> bool {
    sign.is_numeric() || "√∛/^×·⋅*<>≤≥-−–%‰⁻".contains(sign)
}

/// Whether letters are a power of ten for the number before them: `e3`, `×10³ V`.
fn is_power(letters: &str) -> bool {
    let power = letters.strip_prefix(['e', 'E']).unwrap_or_default();
    let times = letters.strip_prefix(['×', '·', '⋅', '*', 'x']).unwrap_or_default();
    power.parse::<i32>().is_ok() || times.trim_start().starts_with("10")
}

impl FormatSection {
    /// The first section of a format, and the rest.
    fn of(format: &str, is_negative: bool) -> (Self, Option<&str>) {
        let (mut before, mut between, mut behind) = (String::new(), String::new(), String::new());
        let mut part = SignPlace::Before;
        let mut is_percent = false;
        // commas after the last digit divide; commas between digits group
        let (mut commas, mut thousands) = (0, 0);
        let mut rest = None;
        let is_general = format.split(';').next().is_some_and(|usual| usual.contains("General"));
        let digits =
            if is_general { format.replacen("General", "0", 1) } else { format.to_owned() };
        let mut signs = digits.chars().peekable();
        let mut is_text = false;
        while let Some(sign) = signs.next() {
            let mut literal = |text: &str| match part {
                SignPlace::Before => before.push_str(text),
                SignPlace::Within => behind.push_str(text),
            };
            match sign {
                ';' => {
                    rest = Some(signs.collect::<String>().len());
                    break;
                }
                '%' => is_percent = true,
                ',' if part == SignPlace::Within => commas += 1,
                ',' => {}
                '.' => thousands += std::mem::take(&mut commas),
                '"' => {
                    let quoted: String = signs.by_ref().take_while(|c| *c != '"').collect();
                    literal(&quoted);
                }
                '\\' => literal(&signs.next().map(String::from).unwrap_or_default()),
                // a space of a character's width, and a character that fills the cell
                '_' | '*' => drop(signs.next()),
                '[' => {
                    // a currency, or its replacement, before the language
                    let inside: String = signs.by_ref().take_while(|c| *c != ']').collect();
                    let currency = inside.strip_prefix('$').unwrap_or_default();
                    literal(currency.split('-').next().unwrap_or_default());
                }
                '0' | '#' | '?' => {
                    part = SignPlace::Within;
                    commas = 0;
                    between.push_str(&std::mem::take(&mut behind));
                }
                // an exponent and a fraction keep the value
                'E' | 'e' if signs.peek().is_some_and(|c| matches!(c, '+' | '-')) => {
                    let _sign = signs.next();
                }
                '/' if part == SignPlace::Within => {}
                '@' => is_text = true,
                other => literal(&other.to_string()),
            }
        }
        let rest = rest.and_then(|length| format.get(format.len() - length..));
        let found = if part == SignPlace::Before {
            let before = before.trim();
            let is_shown = !is_text && !before.is_empty();
            let behind =
                if is_shown { Behind::Instead(before.to_owned()) } else { Behind::Nothing };
            Self { before: String::new(), behind }
        } else {
            let behind = Behind::of(&between, behind.trim(), thousands + commas, is_percent);
            Self { before: changing(&before, is_negative), behind }
        };
        (found, rest)
    }
}

/// The part of a prefix that changes the value of the number: `√`, but nothing of `U = `. A
/// negative number keeps its sign, whether the section repeats it or not.
fn changing(before: &str, is_negative: bool) -> String {
    let label = before.rfind(['=', ':']).map_or(0, |at| at + 1);
    let before = before.get(label..).unwrap_or_default().trim();
    let before =
        if is_negative { before.trim_start_matches(['-', '−', '–', '(']) } else { before };
    if before.contains(makes_another) { before.to_owned() } else { String::new() }
}

impl Behind {
    fn of(between: &str, letters: &str, thousands: u32, is_percent: bool) -> Self {
        // marks of groups change nothing
        if !between.chars().all(|c| c.is_whitespace() || matches!(c, '\'' | '’')) {
            return Self::Between(between.to_owned());
        }
        if thousands > 0 {
            return Self::Thousands(thousands);
        }
        // brackets and dashes of bookkeeping
        let letters = letters.trim_start_matches(')').trim();
        let is_nothing =
            letters.chars().all(|c| matches!(c, '-' | '.' | ':' | ',' | '±' | '=' | ' '));
        let letters = if is_nothing { "" } else { letters };
        match (is_percent, letters.is_empty()) {
            (true, true) => Self::Percent,
            (true, false) => Self::PercentOf(letters.to_owned()),
            (false, true) => Self::Nothing,
            (false, false) => Self::Letters(letters.to_owned()),
        }
    }
}

/// The power of ten of the last digit that a format displays; in per cent the displayed number is
/// multiplied by 100. `None` if the format does not determine it, as with `General`, fractions and
/// texts.
pub(crate) fn last_digit(format: &str, value: f64) -> Option<i32> {
    // the digit placeholders, the decimal mark and the exponent of the first section
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
    let are_zeros = |text: &str| text.bytes().all(|byte| byte == b'0');
    if mantissa.is_empty() || !are_zeros(whole) || !are_zeros(decimals) {
        return None;
    }
    let decimals = u32::try_from(decimals.len()).ok()?;
    match exponent {
        None => Some(-i32::try_from(decimals).ok()?),
        // several digits before the mark require exponents that are multiples of their number
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
            ("\"unfinished", "unfinished"),
            ("0.0%\" FS\"", "0.02% FS"),
            ("0.0%\\ \\F\\S", "0.02% FS"),
            ("0.00%_)", "0.02%"),
            ("0.0,", "0.0002 shown divided by 1000"),
            ("0,,\" M\"", "0.0002 shown divided by 1000000"),
            ("0,.0", "0.0002 shown divided by 1000"),
            ("#,##0.00", "0.0002"),
            ("#,###", "0.0002"),
            ("# ?/?", "0.0002"),
            ("#\\ ##0.000\\ 000", "0.0002"),
            ("_-* #,##0.00_-;-* #,##0.00_-;_-* \"-\"??_-;_-@_-", "0.0002"),
            // prefixes and suffixes that change the value
            ("\"√\"0", "√0.0002"),
            ("√0", "√0.0002"),
            ("\"k = √\"0", "√0.0002"),
            ("\"1/\"0", "1/0.0002"),
            ("\"-\"0", "-0.0002"),
            ("-0", "-0.0002"),
            ("\"<\"0.0", "<0.0002"),
            ("\"2×\"0.0%", "2×0.02%"),
            ("0.0\"×10³\"", "0.0002×10³"),
            ("0.0\"x10^3\"", "0.0002x10^3"),
            ("0.0\"·10⁻³ V\"", "0.0002·10⁻³ V"),
            ("0.0\"e3\"", "0.0002e3"),
            ("0.0\"/2\"", "0.0002 /2"),
            ("0.0\"'\"", "0.0002 '"),
            ("(0.0)\" V\"", "0.0002 V"),
            ("0.000\" ±\"", "0.0002"),
            ("0.0\" (k=2)\"", "0.0002 (k=2)"),
            ("0.0,\\-", "0.0002 shown divided by 1000"),
            ("0\",\"0", "0.0002 shown with `,` between digits"),
            ("0\\.00", "0.0002 shown with `.` between digits"),
            ("\"√3\"", "√3"),
        ] {
            assert_eq!(NumberFormat::of(format).text(0.0002), shown, "{format}");
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
        assert_eq!(NumberFormat::of("0%").text(0.07), "7%");
        assert_eq!(NumberFormat::of("0%").text(-1.5), "-150%");
        // in red, in brackets, and with the section's letters
        for (format, shown) in [
            ("0.0", "-3"),
            ("0.0;[Red]0.0", "-3"),
            ("0.0\" V\";\"-\"0.0\" V\"", "-3 V"),
            ("0.0_);(0.0)", "-3"),
            ("\"√\"0", "-√3"),
            ("0.0;0.0\"×10³\"", "-3×10³"),
        ] {
            assert_eq!(NumberFormat::of(format).text(-3.0), shown, "{format}");
        }
        for (format, is_of_value) in
            [("0.0", true), ("0.0\" mV\"", true), ("0.0\"×10³\"", false), ("√0", false)]
        {
            assert_eq!(NumberFormat::of(format).shows_digits_of(1.0), is_of_value, "{format}");
        }
    }
}
