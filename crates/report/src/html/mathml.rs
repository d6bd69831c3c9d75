//! Equations as MathML, which browsers typeset without a script.

use crate::equation::{Equation, greek, parts_of_name, parts_of_number};
use gumption_engine::model::formula::Layout;
use maud::{Markup, html};

/// A formula, or the right side of an equation with those that it uses; unchanged if it is not a
/// formula.
pub(super) fn equation(text: &str) -> Markup {
    typeset(text).unwrap_or_else(|| html! { (text) })
}

fn typeset(text: &str) -> Option<Markup> {
    let Equation { whole, uses } = Equation::read(text)?;
    Some(html! {
        @for (place, (sign, term)) in terms(&whole).into_iter().enumerate() {
            @if place > 0 { " " }
            math displaystyle="true" {
                @if let Some(Layout::Sign(sign)) = sign { mo form="infix" { (sign) } }
                (part(term))
            }
        }
        @if let Some([name, of]) = uses {
            ", " math displaystyle="true" { (part(&name)) mo { "=" } (part(&of)) }
        }
    })
}

/// The terms of a sum, each with the sign before it: a line may break between them. An expression that
/// is not a sum is one term.
fn terms(whole: &Layout) -> Vec<(Option<&Layout>, &Layout)> {
    let mut terms = Vec::new();
    let mut rest = whole;
    while let Layout::Row(parts) = rest
        && let [first, sign @ Layout::Sign("+" | "\u{2212}"), last] = parts.as_slice()
    {
        terms.push((Some(sign), last));
        rest = first;
    }
    terms.push((None, rest));
    terms.reverse();
    terms
}

fn part(layout: &Layout) -> Markup {
    match layout {
        Layout::Number(text) => number(text),
        Layout::Name(text) => name(text),
        Layout::Sign(sign) if sign.chars().all(|c| c.is_alphanumeric()) => html! { mi { (sign) } },
        Layout::Sign(fence @ ("(" | ")" | "|")) => html! { mo lspace="0" rspace="0" { (fence) } },
        Layout::Sign(sign) => html! { mo { (sign) } },
        Layout::Text(text) => html! { mtext { (text) } },
        Layout::Row(parts) => html! { mrow { @for one in parts { (part(one)) } } },
        Layout::Fraction(parts) => html! { mfrac { (part(&parts[0])) (part(&parts[1])) } },
        Layout::Power(parts) => html! { msup { (part(&parts[0])) (part(&parts[1])) } },
        Layout::Root(inside, None) => html! { msqrt { (part(inside)) } },
        Layout::Root(inside, Some(index)) => html! { mroot { (part(inside)) mn { (index) } } },
        Layout::Cases(parts) => {
            let [one, condition, other] = &**parts;
            html! {
                mrow {
                    mo { "{" }
                    mtable columnalign="left" {
                        mtr { mtd { (part(one)) } mtd { mtext { "if " } (part(condition)) } }
                        mtr { mtd { (part(other)) } mtd { mtext { "otherwise" } } }
                    }
                }
            }
        }
        // a variant added in a later version
        _ => html! {},
    }
}

/// A number, with a power of ten in mathematical notation.
fn number(text: &str) -> Markup {
    match parts_of_number(text) {
        (digits, Some(power)) => html! {
            mrow { mn { (digits) } mo { "\u{22c5}" } msup { mn { "10" } mn { (power) } } }
        },
        (digits, None) => html! { mn { (digits) } },
    }
}

/// The name of a quantity: Greek letters as such, and the text after an underscore as a subscript.
fn name(text: &str) -> Markup {
    let (base, below) = parts_of_name(text);
    if below.is_empty() {
        return html! { mi { (letter(base)) } };
    }
    let below: Vec<String> = below.into_iter().map(letter).collect();
    html! { msub { mi { (letter(base)) } mi { (below.join(",\u{2009}")) } } }
}

/// A Greek letter for its name; other names unchanged.
fn letter(name: &str) -> String {
    greek(name).map_or_else(|| name.to_owned(), String::from)
}

#[cfg(test)]
mod tests {
    fn text(equation: &str) -> String {
        super::equation(equation).into_string()
    }

    #[test]
    fn fractions_powers_and_names() {
        assert_eq!(
            text("a_ref*sin(theta)/2"),
            "<math displaystyle=\"true\"><mfrac><mrow><msub><mi>a</mi><mi>ref</mi></msub><mo>⋅</mo><mrow><mi>sin</mi><mrow>\
             <mo lspace=\"0\" rspace=\"0\">(</mo><mi>θ</mi>\
             <mo lspace=\"0\" rspace=\"0\">)</mo></mrow></mrow></mrow><mn>2</mn></mfrac></math>"
        );
        assert_eq!(
            text("2.5e-3*U"),
            "<math displaystyle=\"true\"><mrow><mrow><mn>2.5</mn><mo>⋅</mo><msup><mn>10</mn><mn>−3</mn></msup></mrow>\
             <mo>⋅</mo><mi>U</mi></mrow></math>"
        );
    }

    #[test]
    fn what_is_used_follows() {
        assert_eq!(
            text("r*w_0^2 with w_0 = 2*pi*f"),
            "<math displaystyle=\"true\"><mrow><mi>r</mi><mo>⋅</mo><msup><msub><mi>w</mi><mi>0</mi></msub><mn>2</mn></msup>\
             </mrow></math>, <math displaystyle=\"true\"><msub><mi>w</mi><mi>0</mi></msub><mo>=</mo><mrow><mn>2</mn><mo>⋅</mo>\
             <mi>π</mi><mo>⋅</mo><mi>f</mi></mrow></math>"
        );
    }

    /// Words are not a formula, and no text becomes markup.
    #[test]
    fn other_texts_stand_as_written() {
        assert_eq!(text("row x, column <b>y</b>"), "row x, column &lt;b&gt;y&lt;/b&gt;");
        assert_eq!(
            text("a < b"),
            "<math displaystyle=\"true\"><mrow><mi>a</mi><mo>&lt;</mo><mi>b</mi></mrow></math>"
        );
    }
}
