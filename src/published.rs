//! The published examples that `gumption verify` recomputes: model files with the values that
//! documents print.

use gumption_command::PublishedExamples;

macro_rules! cases {
    ($($name:literal,)*) => {
        &[$(($name, include_str!(concat!("../tests/cases/", $name, "/model.json"))),)*]
    };
}

macro_rules! measurements {
    ($($name:literal,)*) => {
        &[
            ("power", include_str!("../models/examples/power.json")),
            $(($name, include_str!(concat!("../models/examples/published/", $name, ".json"))),)*
        ]
    };
}

/// All of them, in the order in which they are printed.
pub(crate) const EXAMPLES: PublishedExamples = PublishedExamples {
    cases: cases! {
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
    },
    values: include_str!("published.json"),
    models: &[
        ("rotating-table", include_str!("../models/rotating_table.json")),
        ("sensitivity-datasheet", include_str!("../models/sensitivity_datasheet.json")),
        ("normalized-error", include_str!("../models/normalized_error.json")),
    ],
    // the README's, and those of the folder that need no other file
    more: measurements! {
        "gum-h1-end-gauge",
        "gum-h3-thermometer-line",
        "gum-h4-radon",
        "quam-a2-naoh",
        "quam-a4-bread",
        "quam-a5-ceramic-line",
        "tn1900-e2-surface-temperature",
        "tn1900-e3-viscometer",
        "tn1900-e4-pitot",
        "tn1900-e7-thermistor",
        "tn1900-e8-carbon-dioxide",
        "tn1900-e15-reflection",
        "tn1900-e17-gas-mixture",
        "tn1900-e32-load-cell",
        "ea402-s2-weight",
        "ea402-s4-gauge-block",
        "ea402-s11-block-calibrator",
        "cg3-pressure-balance",
        "iso8655-pipette",
        "humidity-dew-point",
        "thermistor-steinhart-hart",
        "prt-above-zero",
        "prt-below-zero",
        "thermocouple-k",
        "dmm-resistor",
        "mismatch",
        "brinell",
        "torque",
        "ph",
        "ac-shunt",
        "reflection-saved",
    },
};

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use serde_json::{Value, json};

    use super::EXAMPLES;

    /// The cases are those of the folders whose published values are not empty, and the list of values
    /// begins with what these folders hold.
    #[test]
    fn every_case_with_published_values_is_embedded() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases");
        let mut wanted: Vec<Value> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter_map(|path| {
                let text = std::fs::read_to_string(path.join("expect.json")).ok()?;
                let case: Value = serde_json::from_str(&text).unwrap();
                let (name, published) = (path.file_name()?.to_str()?, &case["published"]);
                (!published.as_array()?.is_empty()).then(|| {
                    json!({
                        "example": name,
                        "model": name,
                        "set": [],
                        "source": case["source"],
                        "published": published,
                        "notes": case["notes"],
                    })
                })
            })
            .collect();
        wanted.sort_by_key(|case| case["example"].to_string());
        let embedded: Vec<&str> = EXAMPLES.cases.iter().map(|(name, _)| *name).collect();
        assert_eq!(embedded, wanted.iter().map(|case| &case["example"]).collect::<Vec<_>>());
        let values: Vec<Value> = serde_json::from_str(EXAMPLES.values).unwrap();
        for (found, wanted) in values.iter().zip(&wanted) {
            assert_eq!(found, wanted);
        }
    }

    /// Every built-in model and every example belongs to one field of the page's gallery, and has a
    /// title that is no code name; no name of the gallery is left over.
    #[test]
    fn the_gallery_has_everything_once() {
        let catalogue = crate::catalogue();
        let templates = catalogue.iter().filter_map(|of| Some((of.name(), of.template?)));
        let all: Vec<(&str, &str)> = templates.chain(EXAMPLES.starting_points()).collect();
        let mut wanted: Vec<&str> = all.iter().map(|(name, _)| *name).collect();
        let mut arranged: Vec<&str> =
            gumption_live::gallery::fields().flat_map(|(_, names)| names).collect();
        wanted.sort_unstable();
        arranged.sort_unstable();
        assert_eq!(arranged, wanted);
        let title = |name: &str, text: &str| {
            let of: Value = serde_json::from_str(text).unwrap();
            let own = || of["title"].as_str().unwrap().to_owned();
            gumption_live::gallery::title(name).map_or_else(own, str::to_owned)
        };
        let mut titles: Vec<String> = all.iter().map(|(name, text)| title(name, text)).collect();
        for ((name, _), title) in all.iter().zip(&titles) {
            assert!(!title.trim().is_empty() && title != name, "{name}: {title}");
        }
        titles.sort_unstable();
        assert!(titles.windows(2).all(|two| two[0] != two[1]), "{titles:?}");
    }

    #[test]
    fn every_example_says_where_it_is_from() {
        let values: Vec<Value> = serde_json::from_str(EXAMPLES.values).unwrap();
        assert!(values.len() > EXAMPLES.cases.len());
        for example in values {
            assert!(!example["source"].as_str().unwrap().is_empty(), "{example}");
            assert!(!example["published"].as_array().unwrap().is_empty(), "{example}");
        }
    }
}
