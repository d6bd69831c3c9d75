//! Equations as pages show them: the layout of a formula, and the names of quantities in it.

use gumption_engine::model::formula::{Formula, Layout};

/// What stands between an equation and the equation of what it uses.
const WHERE: &str = " with ";

/// Greek letters by their names, small and capital.
const GREEK: [(&str, [char; 2]); 24] = [
    ("alpha", ['α', 'Α']),
    ("beta", ['β', 'Β']),
    ("gamma", ['γ', 'Γ']),
    ("delta", ['δ', 'Δ']),
    ("epsilon", ['ε', 'Ε']),
    ("zeta", ['ζ', 'Ζ']),
    ("eta", ['η', 'Η']),
    ("theta", ['θ', 'Θ']),
    ("iota", ['ι', 'Ι']),
    ("kappa", ['κ', 'Κ']),
    ("lambda", ['λ', 'Λ']),
    ("mu", ['μ', 'Μ']),
    ("nu", ['ν', 'Ν']),
    ("xi", ['ξ', 'Ξ']),
    ("omicron", ['ο', 'Ο']),
    ("pi", ['π', 'Π']),
    ("rho", ['ρ', 'Ρ']),
    ("sigma", ['σ', 'Σ']),
    ("tau", ['τ', 'Τ']),
    ("upsilon", ['υ', 'Υ']),
    ("phi", ['φ', 'Φ']),
    ("chi", ['χ', 'Χ']),
    ("psi", ['ψ', 'Ψ']),
    ("omega", ['ω', 'Ω']),
];

/// A formula, and where it is followed by the equation of a quantity that it uses, that quantity with
/// its formula.
pub(crate) struct Equation {
    pub(crate) whole: Layout,
    pub(crate) uses: Option<[Layout; 2]>,
}

impl Equation {
    /// Reads a formula, `a + b`, or one with what it uses, `r*w^2 with w = 2*pi*f`; `None` where it is
    /// no formula or nothing to lay out.
    pub(crate) fn read(text: &str) -> Option<Self> {
        let layout = |text: &str| Formula::parse(text).ok()?.layout();
        let Some((whole, uses)) = text.split_once(WHERE) else {
            return Some(Self { whole: layout(text)?, uses: None });
        };
        let (name, of) = uses.split_once(" = ")?;
        Some(Self { whole: layout(whole)?, uses: Some([layout(name)?, layout(of)?]) })
    }
}

/// A name and what stands below the line: what follows its first underscore, at each further one.
pub(crate) fn parts_of_name(name: &str) -> (&str, Vec<&str>) {
    match name.split_once('_') {
        Some((base, below)) if !base.is_empty() && !below.is_empty() => {
            (base, below.split('_').collect())
        }
        _ => (name, Vec::new()),
    }
}

/// The Greek letter of a name, `theta` or `Theta`.
pub(crate) fn greek(name: &str) -> Option<char> {
    let first = name.chars().next()?;
    let small = name.to_ascii_lowercase();
    let (word, letters) = GREEK.iter().find(|(word, _)| *word == small)?;
    // only the first letter may be a capital
    (name.get(1..)? == word.get(1..)?).then(|| letters[usize::from(first.is_ascii_uppercase())])
}

/// The digits and the power of ten of a number, with the minus sign that print has.
pub(crate) fn parts_of_number(text: &str) -> (&str, Option<String>) {
    match text.split_once(['e', 'E']) {
        Some((digits, power)) => {
            (digits, Some(power.trim_start_matches('+').replace('-', "\u{2212}")))
        }
        None => (text, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_letters_and_indices() {
        assert_eq!(parts_of_name("a_x_syst"), ("a", vec!["x", "syst"]));
        assert_eq!(parts_of_name("_a"), ("_a", vec![]));
        assert_eq!(greek("theta"), Some('θ'));
        assert_eq!(greek("Omega"), Some('Ω'));
        assert_eq!(greek("thetA"), None);
        assert_eq!(greek("tilt"), None);
    }

    #[test]
    fn words_are_no_equation() {
        assert!(Equation::read("row x, column y").is_none());
        assert!(Equation::read("r*w_0^2 with w_0 = 2*pi*f").is_some());
        assert!(Equation::read("a with b").is_none());
    }
}
