//! The published examples that ship with the program: model files with the values that documents
//! print, and where these stand in the answer.

use serde::Deserialize;

/// A worked example with its published values.
#[derive(Debug)]
pub(super) struct Example {
    pub(super) name: String,
    /// Text of the model file.
    pub(super) model: &'static str,
    /// Replacements of inputs, as `gumption run --set` takes them.
    pub(super) set: Vec<String>,
    /// The document.
    pub(super) source: String,
    pub(super) published: Vec<Published>,
    /// What a reader of the table should know.
    pub(super) notes: String,
}

/// A number that a document prints.
#[derive(Debug, Deserialize)]
pub(super) struct Published {
    /// The output; none for what belongs to all of them.
    pub(super) output: Option<String>,
    /// Where it stands in the answer: `gum.interval[0]`.
    pub(super) path: String,
    pub(super) value: f64,
    pub(super) tolerance: f64,
    /// Where the tolerance comes from.
    pub(super) why: String,
}

/// The values of one of the files under `tests/cases`; other keys are for other checks.
#[derive(Deserialize)]
struct Expectation {
    source: String,
    published: Vec<Published>,
    notes: String,
}

/// An entry of `papers.json`: a ready file, replacements in it, published values.
#[derive(Deserialize)]
struct Measurement {
    example: String,
    model: String,
    set: Vec<String>,
    source: String,
    published: Vec<Published>,
    notes: String,
}

macro_rules! cases {
    ($($name:literal,)*) => {
        /// Name, model file and expected values of each worked example that has published ones.
        const CASES: &[(&str, &str, &str)] = &[$((
            $name,
            include_str!(concat!("../../../../tests/cases/", $name, "/model.json")),
            include_str!(concat!("../../../../tests/cases/", $name, "/expect.json")),
        ),)*];
    };
}

cases! {
    "ea402-s10-caliper",
    "ea402-s5-furnace-temperature",
    "ea402-s5-thermocouple-emf",
    "ea402-s6-power-sensor",
    "ea402-s7-step-attenuator",
    "ea402-s9-multimeter",
    "gum-4.3.4-certificate",
    "gum-4.4.3-readings",
    "gum-4.4.5-rectangular",
    "gum-4.4.6-triangular",
    "gum-5.2.2-ten-resistors",
    "gum-g41-welch-satterthwaite",
    "gum-h2-impedance-normal",
    "gum-h3-thermometer",
    "jcgm101-9.2.2-adaptive",
    "jcgm101-9.2.2-normal",
    "jcgm101-9.2.3-rectangular",
    "jcgm101-9.2.4-dominant-rectangular",
    "jcgm101-9.3-mass",
    "jcgm101-9.4-x1-000-r09",
    "jcgm101-9.4-x1-010-r09",
    "jcgm101-9.4-x1-050-r09",
    "nist-um-stefan-boltzmann",
    "nist1900-e11-attenuator",
    "nist1900-e13-expansion",
    "prop-ctrap-certificate",
    "quam-a1-cadmium",
    "quam-a3-hcl",
    "quam-a5-ceramic",
    "seed002-rotating-table-5hz",
}

/// The measurements of three papers, with the numbers that these print.
const PAPERS: &str = include_str!("papers.json");

/// The ready files that [`PAPERS`] names.
const MODELS: [(&str, &str); 3] = [
    ("rotating-table", include_str!("../../../../models/rotating_table.json")),
    ("sensitivity-datasheet", include_str!("../../../../models/sensitivity_datasheet.json")),
    ("normalized-error", include_str!("../../../../models/normalized_error.json")),
];

/// All examples, in the order in which they are printed.
///
/// # Errors
/// An embedded file that cannot be read, which a test rules out.
pub(super) fn all() -> Result<Vec<Example>, String> {
    let mut examples = Vec::new();
    for (name, model, expected) in CASES {
        let Expectation { source, published, notes } =
            serde_json::from_str(expected).map_err(|error| format!("{name}: {error}"))?;
        let (name, set) = ((*name).to_owned(), Vec::new());
        examples.push(Example { name, model, set, source, published, notes });
    }
    let papers: Vec<Measurement> =
        serde_json::from_str(PAPERS).map_err(|error| format!("papers.json: {error}"))?;
    for Measurement { example: name, model, set, source, published, notes } in papers {
        let found = MODELS.iter().find(|(known, _)| *known == model);
        let (_, model) = found.ok_or_else(|| format!("{name}: no file for `{model}`"))?;
        examples.push(Example { name, model, set, source, published, notes });
    }
    Ok(examples)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The list above is that of the folders whose published values are not empty.
    #[test]
    fn every_case_with_published_values_is_embedded() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/cases");
        let mut wanted: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| {
                let Ok(text) = std::fs::read_to_string(path.join("expect.json")) else {
                    return false;
                };
                let value: serde_json::Value = serde_json::from_str(&text).unwrap();
                value["published"].as_array().is_some_and(|published| !published.is_empty())
            })
            .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
            .collect();
        wanted.sort();
        let embedded: Vec<&str> = CASES.iter().map(|(name, ..)| *name).collect();
        assert_eq!(embedded, wanted);
    }

    #[test]
    fn every_example_is_complete() {
        let examples = all().unwrap();
        assert!(examples.len() > CASES.len());
        for (number, example) in examples.iter().enumerate() {
            assert!(!example.published.is_empty(), "{}", example.name);
            assert!(!example.source.is_empty(), "{}", example.name);
            assert!(examples[..number].iter().all(|other| other.name != example.name));
        }
    }
}
