//! Numbers and units as print has them: m/s², Ω, 35°, 5 × 10⁻⁷, a true minus and narrow spaces (SI
//! brochure, 9th edition, 5.3 and 5.4).
//!
//! HTML, Markdown and figures have this notation, and text on a terminal that can show it. JSON, CSV,
//! LaTeX, workbooks and text in a pipe have the notation of files: `m/s^2`, `ohm`, `5e-7`. Which one a
//! page has is known while it is drawn: [`notation`] is on within [`in_print`].

mod number;
mod unit;

pub use number::grouped;
pub(crate) use number::text as number_text;
pub(crate) use unit::{formula_text, unit_text, value_text, with_symbols};

use crate::table::shows_print;
use gumption_units::Unit;
use std::cell::Cell;

/// How numbers and units are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Notation {
    /// As in files.
    #[default]
    File,
    /// As in print.
    Print,
    /// As in print, with a decimal comma in figures. Tables have it by their documents, and sentences
    /// in languages with a comma are written with it.
    PrintWithComma,
}

thread_local! {
    // each number of a page would need it as an argument; a thread draws one page at a time
    static NOTATION: Cell<Notation> = const { Cell::new(Notation::File) };
}

/// Draws a page in a notation.
pub(crate) fn in_print<R>(notation: Notation, draw: impl FnOnce() -> R) -> R {
    /// Restores the notation also if `draw` panics.
    struct Restore(Notation);
    impl Drop for Restore {
        fn drop(&mut self) {
            NOTATION.set(self.0);
        }
    }
    let _restore = Restore(NOTATION.replace(notation));
    draw()
}

/// Draws a text page: in the notation of print on a terminal that can show it.
pub(crate) fn on_terminal<R>(draw: impl FnOnce() -> R) -> R {
    let notation = if shows_print() { Notation::Print } else { Notation::File };
    in_print(notation, draw)
}

/// The notation of the page that is being drawn.
pub(crate) fn notation() -> Notation {
    NOTATION.get()
}

/// The text of a unit in the notation of the page.
pub(crate) fn unit(unit: &Unit) -> String {
    match notation() {
        Notation::File => unit.text().to_owned(),
        Notation::Print | Notation::PrintWithComma => {
            number_text(with_symbols(unit).text()).replace('*', "\u{b7}")
        }
    }
}

/// A number with its unit, if the unit has a name, in the notation of the page; the number is as in
/// files.
pub(crate) fn with_unit(number: &str, of: &Unit) -> String {
    if !of.has_name() {
        return number.to_owned();
    }
    let text = unit(of);
    // an angle in degrees, minutes or seconds is written without a space (SI brochure, 5.4.3)
    let is_angle = matches!(text.as_str(), "°" | "′" | "″");
    format!("{number}{}{text}", if is_angle { "" } else { " " })
}

/// A text with its numbers and exponents in the notation of the page.
pub(crate) fn text(text: &str) -> String {
    match notation() {
        Notation::File => text.to_owned(),
        Notation::Print | Notation::PrintWithComma => number_text(text),
    }
}

/// A number of a sentence: on pages whole numbers from 10 000 on are in groups of three digits.
pub(crate) fn number_in_sentence(number: &str) -> String {
    let is_long = number.len() > 4 && number.bytes().all(|byte| byte.is_ascii_digit());
    match number.parse() {
        Ok(count) if is_long && notation() != Notation::File => figure_text(&grouped(count)),
        _ => figure_text(number),
    }
}

/// A text in a figure.
pub(crate) fn figure_text(text: &str) -> String {
    let written = self::text(text);
    match notation() {
        Notation::PrintWithComma => with_comma(&written),
        Notation::File | Notation::Print => written,
    }
}

/// A text with a decimal comma instead of the point between two digits.
pub fn with_comma(text: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let is_digit = |place: Option<usize>| {
        place.and_then(|place| letters.get(place)).is_some_and(char::is_ascii_digit)
    };
    let letters = letters.iter().enumerate().map(|(place, letter)| match letter {
        '.' if is_digit(place.checked_sub(1)) && is_digit(Some(place + 1)) => ',',
        letter => *letter,
    });
    letters.collect()
}

/// A text of a page in the notation of files, to be compared with numbers.
#[cfg(test)]
pub(crate) fn in_file_notation(text: &str) -> String {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    const ON_THE_LINE: &str = "0123456789-";
    let text = text.replace('\u{202f}', " ").replace(" × 10", "e").replace('\u{2212}', "-");
    let mut made = String::new();
    let mut is_exponent = false;
    for letter in text.chars() {
        let place = RAISED.chars().position(|raised| raised == letter);
        if place.is_some() && !is_exponent && !made.ends_with('e') {
            made.push('^');
        }
        is_exponent = place.is_some();
        made.push(place.and_then(|place| ON_THE_LINE.chars().nth(place)).unwrap_or(letter));
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_between_digits_becomes_a_comma() {
        assert_eq!(with_comma("k = 2.00, up to -0.5e-3."), "k = 2,00, up to -0,5e-3.");
        assert_eq!(with_comma("z.re = 5. Then"), "z.re = 5. Then");
    }

    #[test]
    fn a_page_has_one_notation() {
        let unit_of = |text: &str| Unit::parse(text).unwrap();
        let shown = || {
            let values = [("5e-7", "m/s^2"), ("35", "deg"), ("-4.5", "kg*m^2"), ("0.5", "1")];
            values.map(|(number, unit)| text(&with_unit(number, &unit_of(unit))))
        };
        assert_eq!(shown(), ["5e-7 m/s^2", "35 deg", "-4.5 kg*m^2", "0.5"]);
        assert_eq!(
            in_print(Notation::Print, shown),
            ["5\u{202f}×\u{202f}10⁻⁷ m/s²", "35°", "\u{2212}4.5 kg·m²", "0.5"]
        );
        assert_eq!(in_print(Notation::PrintWithComma, || figure_text("-4.5")), "\u{2212}4,5");
        assert_eq!(notation(), Notation::File);
    }
}
