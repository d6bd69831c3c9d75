//! Equations as MathML, which browsers typeset without a script.

use gumption_engine::model::formula::{Formula, Layout};
use maud::{Markup, html};

/// What stands between an equation and the equations of what it uses.
const WHERE: &str = " with ";

/// Greek letters by their names; their capitals begin with a capital.
const GREEK: [(&str, char, char); 24] = [
    ("alpha", 'α', 'Α'),
    ("beta", 'β', 'Β'),
    ("gamma", 'γ', 'Γ'),
    ("delta", 'δ', 'Δ'),
    ("epsilon", 'ε', 'Ε'),
    ("zeta", 'ζ', 'Ζ'),
    ("eta", 'η', 'Η'),
    ("theta", 'θ', 'Θ'),
    ("iota", 'ι', 'Ι'),
    ("kappa", 'κ', 'Κ'),
    ("lambda", 'λ', 'Λ'),
    ("mu", 'μ', 'Μ'),
    ("nu", 'ν', 'Ν'),
    ("xi", 'ξ', 'Ξ'),
    ("omicron", 'ο', 'Ο'),
    ("pi", 'π', 'Π'),
    ("rho", 'ρ', 'Ρ'),
    ("sigma", 'σ', 'Σ'),
    ("tau", 'τ', 'Τ'),
    ("upsilon", 'υ', 'Υ'),
    ("phi", 'φ', 'Φ'),
    ("chi", 'χ', 'Χ'),
    ("psi", 'ψ', 'Ψ'),
    ("omega", 'ω', 'Ω'),
];

/// A formula, or the right side of an equation with those of what it uses; as it was written where it
/// is none.
pub(super) fn equation(text: &str) -> Markup {
    typeset(text).unwrap_or_else(|| html! { (text) })
}

fn typeset(text: &str) -> Option<Markup> {
    let (whole, uses) = match text.split_once(WHERE) {
        Some((whole, uses)) => (whole, Some(uses)),
        None => (text, None),
    };
    let whole = layout(whole)?;
    let uses = match uses {
        Some(uses) => {
            let (name, of) = uses.split_once(" = ")?;
            Some((layout(name)?, layout(of)?))
        }
        None => None,
    };
    Some(html! {
        math displaystyle="true" { (part(&whole)) }
        @if let Some((name, of)) = uses {
            ", " math displaystyle="true" { (part(&name)) mo { "=" } (part(&of)) }
        }
    })
}

fn layout(text: &str) -> Option<Layout> {
    Formula::parse(text).ok()?.layout()
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
        // a part of a later version
        _ => html! {},
    }
}

/// A number, a power of ten as it is written by hand.
fn number(text: &str) -> Markup {
    match text.split_once(['e', 'E']) {
        Some((digits, power)) => html! {
            mrow {
                mn { (digits) } mo { "\u{22c5}" }
                msup { mn { "10" } mn { (power.trim_start_matches('+').replace('-', "\u{2212}")) } }
            }
        },
        None => html! { mn { (text) } },
    }
}

/// The name of a quantity: Greek letters as such, and what follows an underscore below the line.
fn name(text: &str) -> Markup {
    match text.split_once('_') {
        Some((base, below)) if !base.is_empty() && !below.is_empty() => {
            let below: Vec<String> = below.split('_').map(letter).collect();
            html! { msub { mi { (letter(base)) } mi { (below.join(",\u{2009}")) } } }
        }
        _ => html! { mi { (letter(text)) } },
    }
}

/// A Greek letter for its name; other names as they are.
fn letter(name: &str) -> String {
    let found = GREEK.iter().find_map(|(word, small, capital)| {
        let is_capital = name.starts_with(|c: char| c.is_ascii_uppercase());
        let is_it = name.eq_ignore_ascii_case(word) && name[1..] == word[1..];
        is_it.then_some(if is_capital { *capital } else { *small })
    });
    found.map_or_else(|| name.to_owned(), String::from)
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

    /// Words are no formula, and nothing of a text is markup.
    #[test]
    fn other_texts_stand_as_written() {
        assert_eq!(text("row x, column <b>y</b>"), "row x, column &lt;b&gt;y&lt;/b&gt;");
        assert_eq!(
            text("a < b"),
            "<math displaystyle=\"true\"><mrow><mi>a</mi><mo>&lt;</mo><mi>b</mi></mrow></math>"
        );
    }
}
