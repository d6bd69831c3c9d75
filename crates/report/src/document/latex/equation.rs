//! Equations in mathematical mode.

use super::escaped;
use crate::equation::{Equation, greek, parts_of_name, parts_of_number};
use gumption_engine::model::formula::Layout;

/// A formula, or the right side of an equation with those that it uses; unchanged if it is not a
/// formula.
pub(super) fn equation(text: &str) -> String {
    let whole = match Equation::read(text) {
        Some(Equation { whole, uses: None }) => displayed(&part(&whole)),
        Some(Equation { whole, uses: Some([name, of]) }) => {
            let (name, of) = (part(&name), part(&of));
            format!("{}, {}", displayed(&part(&whole)), displayed(&format!("{name} = {of}")))
        }
        None => return escaped(text),
    };
    // fractions on neighbouring lines keep their distance
    match whole.contains("\\frac") {
        true => format!("\\rule[-2.6ex]{{0pt}}{{6.2ex}}{whole}"),
        false => whole,
    }
}

/// A formula in mathematical mode, without the `$`; a text that is no formula, as text.
///
/// ```
/// assert_eq!(gumption_report::equation_latex("m/V_0"), "\\frac{m}{V_{0}}");
/// ```
pub fn equation_latex(formula: &str) -> String {
    match Equation::read(formula) {
        Some(Equation { whole, uses: None }) => part(&whole),
        _ => format!("\\mbox{{{}}}", escaped(formula)),
    }
}

fn displayed(mathematics: &str) -> String {
    match mathematics.contains("\\frac") {
        true => format!("$\\displaystyle {mathematics}$"),
        false => format!("${mathematics}$"),
    }
}

fn part(layout: &Layout) -> String {
    match layout {
        Layout::Number(text) => match parts_of_number(text) {
            (digits, None) => digits.to_owned(),
            (digits, Some(power)) => {
                format!("{digits} \\cdot 10^{{{}}}", power.replace('\u{2212}', "-"))
            }
        },
        Layout::Name(text) => name(text),
        Layout::Sign(text) => sign(text),
        // the narrow space before a unit has no effect inside a box
        Layout::Text(text) => match text.strip_prefix('\u{202f}') {
            Some(unit) => format!("\\,\\mbox{{{}}}", escaped(unit)),
            None => format!("\\mbox{{{}}}", escaped(text)),
        },
        Layout::Row(parts) => parts.iter().map(part).collect::<Vec<_>>().join(" "),
        Layout::Fraction(parts) => format!("\\frac{{{}}}{{{}}}", part(&parts[0]), part(&parts[1])),
        Layout::Power(parts) => format!("{{{}}}^{{{}}}", part(&parts[0]), part(&parts[1])),
        Layout::Root(inside, None) => format!("\\sqrt{{{}}}", part(inside)),
        Layout::Root(inside, Some(index)) => format!("\\sqrt[{index}]{{{}}}", part(inside)),
        Layout::Cases(parts) => {
            let [one, condition, other] = parts.each_ref().map(part);
            format!(
                "\\left\\{{\\begin{{array}}{{ll}}{one} & \\mbox{{if }} {condition} \\\\ {other} & \
                 \\mbox{{otherwise}}\\end{{array}}\\right."
            )
        }
        // a variant added in a later version
        _ => String::new(),
    }
}

fn name(text: &str) -> String {
    let (base, below) = parts_of_name(text);
    let base = letter(base, "\\mathit");
    if below.is_empty() {
        return base;
    }
    let below: Vec<String> = below.iter().map(|one| letter(one, "\\mathrm")).collect();
    format!("{base}_{{{}}}", below.join(",\\,"))
}

/// A Greek letter for its name; other words in a font.
fn letter(name: &str, font: &str) -> String {
    let is_capital = name.starts_with(|c: char| c.is_ascii_uppercase());
    match greek(name) {
        // letters that look like Latin ones have no command
        Some('\u{3bf}') => "o".to_owned(),
        Some(letter) if is_capital && !"ΓΔΘΛΞΠΣΥΦΨΩ".contains(letter) => {
            format!("\\mathrm{{{}}}", name.get(..1).unwrap_or_default())
        }
        Some(_) => format!("\\{name}"),
        None if name.len() == 1 && name != "_" => name.to_owned(),
        None if name.is_ascii() => format!("{font}{{{}}}", name.replace('_', "\\_")),
        None => format!("\\mbox{{{}}}", escaped(name)),
    }
}

fn sign(text: &str) -> String {
    match text {
        "\u{2212}" => "-".to_owned(),
        "\u{22c5}" => "\\cdot".to_owned(),
        "\u{2264}" => "\\le".to_owned(),
        "\u{2265}" => "\\ge".to_owned(),
        "\u{2260}" => "\\ne".to_owned(),
        "\u{230a}" => "\\lfloor".to_owned(),
        "\u{230b}" => "\\rfloor".to_owned(),
        "\u{2308}" => "\\lceil".to_owned(),
        "\u{2309}" => "\\rceil".to_owned(),
        text if text.chars().any(char::is_alphabetic) => match text.trim() {
            word if word.len() < text.len() => format!("\\quad\\mathrm{{{word}}}\\quad"),
            word => format!("\\mathrm{{{word}}}"),
        },
        text => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_mathematics() {
        assert_eq!(
            equation("sqrt(a_ref^2 + 1e-3)/theta"),
            "\\rule[-2.6ex]{0pt}{6.2ex}$\\displaystyle \\frac{\\sqrt{{a_{\\mathrm{ref}}}^{2} + 1 \\cdot 10^{-3}}}{\\theta}$"
        );
        // names that begin or end with an underscore
        assert_eq!(equation("_x_ + _"), "$\\mathit{\\_x\\_} + \\mathit{\\_}$");
        assert_eq!(equation("abs(a*sin(tilt))"), "$| a \\cdot \\mathrm{sin} ( \\mathit{tilt} ) |$");
        assert_eq!(equation("r*w with w = 2*pi"), "$r \\cdot w$, $w = 2 \\cdot \\pi$");
        assert_eq!(equation("50 % of it"), escaped("50 % of it"));
        // a unit keeps its distance
        assert_eq!(equation("x + 2 [mm]"), "$x + 2 \\,\\mbox{mm}$");
    }
}
