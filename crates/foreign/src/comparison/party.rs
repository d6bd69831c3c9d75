//! Whose results a column holds where its heading says so: those of the laboratory, `U_lab`, `Laborwert`,
//! or of the reference that it is compared with, `Ref. value`, `zugewiesener Wert`.

/// The first results of a pair are those of the laboratory, the second ones those of the reference.
const LABORATORY: u8 = 1;
const REFERENCE: u8 = 2;

/// Words of a laboratory, and those that begin a German compound with `wert`.
const LABORATORIES: [&str; 14] = [
    "lab",
    "lab's",
    "laboratory",
    "laboratory's",
    "labor",
    "labors",
    "laboratorium",
    "laboratoire",
    "labo",
    "participant",
    "participant's",
    "teilnehmer",
    "teilnehmers",
    "nmi",
];
const REFERENCES: [&str; 20] = [
    "ref",
    "reference",
    "referenz",
    "bezugs",
    "référence",
    "réf",
    "assigned",
    "zugewiesener",
    "zugewiesenen",
    "zugewiesen",
    "assignée",
    "assigné",
    "consensus",
    "konsens",
    "crv",
    "scrv",
    "kcrv",
    "pilot",
    "referenzlabor",
    "referenzlabors",
];

/// The index of an assigned value in ISO 13528, which is no word.
const ASSIGNED: &str = "pt";

/// Words between others, which say nothing where a column has an owner.
const BETWEEN: [&str; 11] = ["of", "the", "by", "des", "der", "von", "du", "de", "la", "le", "l'"];

/// Words between two quantities that a difference is of.
const OF_DIFFERENCES: [&str; 5] = ["from", "vom", "zum", "zur", "minus"];

/// Whether a word names the laboratory or the reference.
fn owner(word: &str) -> Option<u8> {
    let word = word.to_lowercase();
    let word = word.trim_matches('.');
    let word = word.strip_prefix("l'").or(word.strip_prefix("d'")).unwrap_or(word);
    if LABORATORIES.contains(&word) {
        Some(LABORATORY)
    } else if REFERENCES.contains(&word) {
        Some(REFERENCE)
    } else {
        None
    }
}

/// The owner of a German compound, and its noun: `Laborwert`, `Referenzwertes`, `Laborergebnis`.
fn compound(word: &str) -> Option<(u8, &'static str)> {
    const NOUNS: [(&str, &str); 5] = [
        ("messwert", "Messwert"),
        ("mittelwert", "Mittelwert"),
        ("wert", "Wert"),
        ("ergebnis", "Ergebnis"),
        ("unsicherheit", "Unsicherheit"),
    ];
    let small = word.to_lowercase();
    let ends = ["", "s", "es", "e"].into_iter();
    ends.filter_map(|end| small.strip_suffix(end)).find_map(|word| {
        NOUNS.iter().find_map(|(ending, noun)| {
            let of = word.strip_suffix(ending).filter(|stem| !stem.is_empty())?;
            Some((owner(of.trim_end_matches('-'))?, *noun))
        })
    })
}

/// The owner that is the index of a symbol, and the symbol: `U_lab`, `xref`, `u(x_pt)`.
fn indexed(word: &str) -> Option<(u8, &str)> {
    let mut letters = word.chars();
    let stem = letters.next().filter(|first| matches!(first, 'x' | 'X' | 'U' | 'u' | 'k' | 'K'))?;
    let index = letters.as_str();
    let index = index.strip_prefix(['_', '-']).unwrap_or(index);
    let of = if index == ASSIGNED { REFERENCE } else { owner(index)? };
    Some((of, word.get(..stem.len_utf8())?))
}

/// Nouns of what an uncertainty is of.
const NOUNS_OF_VALUES: [&str; 7] =
    ["value", "wert", "wertes", "valeur", "result", "ergebnis", "résultat"];

/// Whether a word is that of an uncertainty.
fn is_of_uncertainty(word: &str) -> bool {
    let small = word.to_lowercase();
    matches!(word, "U" | "u")
        || ["uncert", "unsich", "incert"].iter().any(|word_part| small.contains(word_part))
}

/// The owner in a name of two words, and the other one: `Value_lab`, `ref_U`.
fn joined(word: &str) -> Option<(u8, &str)> {
    let (first, second) = word.split_once('_')?;
    owner(second).map(|party| (party, first)).or_else(|| owner(first).map(|party| (party, second)))
}

/// The owner of what a heading stands above, and the heading without it: of `Ref. U [V]` it is `U [V]`.
/// `None` where none or both are named.
pub(super) fn split(heading: &str) -> Option<(u8, String)> {
    let spaced = heading.replace('(', " (").replace('[', " [");
    let (mut found, mut kept): (Option<u8>, Vec<String>) = (None, Vec::new());
    for word in spaced.split_whitespace() {
        let bare = word.trim_matches(['(', ')', '[', ']', ',', ':']);
        // `Deviation from reference` is none of the reference
        if OF_DIFFERENCES.contains(&bare.to_lowercase().as_str()) {
            return None;
        }
        // of an index in brackets the symbol stands before them: `u(x_ref)`
        let is_enclosed = word.starts_with(['(', '[']);
        let own = owner(bare)
            .map(|party| (party, ""))
            .or_else(|| compound(bare))
            .or_else(|| {
                indexed(bare).map(|(party, stem)| (party, if is_enclosed { "" } else { stem }))
            })
            .or_else(|| joined(bare));
        match own {
            Some((of, _)) if found.is_some_and(|other| other != of) => return None,
            Some((of, rest)) => {
                found = Some(of);
                // a unit may stand behind the comma
                let comma = if word.ends_with(',') { "," } else { "" };
                kept.extend((!rest.is_empty()).then(|| format!("{rest}{comma}")));
            }
            None => kept.push(word.to_owned()),
        }
    }
    let found = found?;
    kept.retain(|word| !BETWEEN.contains(&word.to_lowercase().as_str()));
    // `U of the reference value` is an uncertainty
    if kept.iter().any(|word| is_of_uncertainty(word)) {
        kept.retain(|word| !NOUNS_OF_VALUES.contains(&word.to_lowercase().as_str()));
    }
    Some((found, kept.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn owners_in_headings() {
        for (heading, expected) in [
            ("Lab value [V]", Some((1, "value [V]"))),
            ("U_lab (k=2) [mV]", Some((1, "U (k=2) [mV]"))),
            ("Ulab", Some((1, "U"))),
            ("U(lab)", Some((1, "U"))),
            ("u(x_ref)", Some((2, "u"))),
            ("x_pt", Some((2, "x"))),
            ("Ref. value / V", Some((2, "value / V"))),
            ("Laborwert", Some((1, "Wert"))),
            ("Unsicherheit des Referenzwertes (k=2)", Some((2, "Unsicherheit (k=2)"))),
            ("zugewiesener Wert [V]", Some((2, "Wert [V]"))),
            ("Valeur de référence", Some((2, "Valeur"))),
            ("Valeur du laboratoire", Some((1, "Valeur"))),
            ("Incertitude de la valeur assignée", Some((2, "Incertitude"))),
            ("Assigned value", Some((2, "value"))),
            ("U of the assigned value", Some((2, "U"))),
            ("Pt 100 value", None),
            ("Value_lab", Some((1, "Value"))),
            ("ref_U", Some((2, "U"))),
            ("U_lab, V", Some((1, "U, V"))),
            ("Ergebnis Referenzlabor", Some((2, "Ergebnis"))),
            ("Deviation from reference", None),
            ("Reference laboratory", None),
            ("x_lab - x_ref", None),
            ("Value", None),
            ("Ultra", None),
            ("", None),
        ] {
            assert_eq!(
                split(heading),
                expected.map(|(of, rest): (u8, &str)| (of, rest.to_owned())),
                "{heading}"
            );
        }
    }
}
