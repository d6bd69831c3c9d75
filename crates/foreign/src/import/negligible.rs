//! Uncertainties that are no numbers: contributions that a sheet calls negligible, and bounds.

/// Whether a cell says that an uncertainty is not worth counting.
pub(super) fn is_negligible(text: &str) -> bool {
    const WORDS: [&str; 17] = [
        "nil",
        "none",
        "keine",
        "negligible",
        "negligable",
        "neglected",
        "neglig",
        "negl",
        "insignificant",
        "vernachlässigbar",
        "vernachlässigt",
        "vernachl",
        "négligeable",
        "négligé",
        "negligeable",
        "despreciable",
        "insignificante",
    ];
    let small = text.trim().trim_matches(['(', ')', '.', '*', ' ']).to_lowercase();
    WORDS.contains(&small.as_str())
}

/// What to write in place of a bound or an approximate number, `<0.01`, as the end of a sentence; empty of
/// other texts.
pub(super) fn advice(text: &str) -> String {
    const BOUNDS: [&str; 12] =
        ["<=", "=<", "≤", "<", "max.", "max", "up to", "below", "bis", "unter", "jusqu'à", "hasta"];
    const ABOUT: [&str; 8] = ["~", "≈", "ca.", "ca", "approx.", "about", "etwa", "environ"];
    let small = text.trim().to_lowercase();
    let behind = |all: &[&str]| {
        let rest = all.iter().find_map(|sign| small.strip_prefix(sign))?;
        let rest = rest.trim();
        let is_number = rest.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | ','));
        is_number.then(|| rest.to_owned())
    };
    if let Some(number) = behind(&BOUNDS) {
        return format!(
            ", but a bound: write {number} as the half-width of a rectangular distribution where the \
             quantity may lie anywhere within it, or `negligible` where it is not to count"
        );
    }
    if let Some(number) = behind(&ABOUT) {
        return format!(": write {number} where that is what counts");
    }
    String::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_in_place_of_numbers() {
        for text in ["negligible", "vernachlässigbar", "(negl.)", "négligeable", "Despreciable"] {
            assert!(is_negligible(text), "{text}");
        }
        for (text, number) in [("<0.01", "0.01"), ("≤ 0,01 mV", "0,01 mv"), ("~0.1", "0.1")] {
            assert!(advice(text).contains(number), "{text}");
        }
        assert_eq!(advice("maximum"), "");
    }
}
