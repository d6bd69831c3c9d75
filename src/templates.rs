//! The model files that measurements can be started from.

use std::sync::LazyLock;

use gumption_engine::model::typed::Catalogue;

macro_rules! templates {
    ($($name:literal: $file:literal,)*) => {
        &[$(($name, include_str!(concat!("../models/", $file, ".json"))),)*]
    };
}

/// Name and template of each built-in measurement.
const TEMPLATES: &[(&str, &str)] = templates! {
    "inclined-plane": "inclined_plane",
    "inclined-plane-spurious": "inclined_plane_spurious",
    "inclined-plane-spurious-vector": "inclined_plane_spurious_vector",
    "spurious-component": "spurious_component",
    "spurious-component-inverse": "spurious_component_inverse",
    "spurious-component-modulus": "spurious_component_modulus",
    "wave-interference": "wave_interference",
    "rotating-table": "rotating_table",
    "rotating-table-instant": "rotating_table_instant",
    "sensitivity": "sensitivity",
    "sensitivity-matrix": "sensitivity_matrix",
    "mean-of-repetitions": "mean_of_repetitions",
    "normalized-error": "normalized_error",
    "projection-45": "projection_45",
    "axis-sensitivity": "axis_sensitivity",
    "relative-sensitivity": "relative_sensitivity",
    "phase-budget": "phase_budget",
    "measuring-chain": "measuring_chain",
    "seismic-response": "seismic_response",
    "gravity-rotation": "gravity_rotation",
};

/// The built-in measurements with their templates.
pub fn catalogue() -> &'static Catalogue {
    static ALL: LazyLock<Catalogue> = LazyLock::new(|| {
        let template = |name: &str| TEMPLATES.iter().find(|(of, _)| *of == name);
        let built_in = gumption_measurements::catalogue().iter();
        built_in
            .map(|entry| template(entry.name()).map_or(*entry, |(_, text)| entry.template(text)))
            .collect()
    });
    &ALL
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measurement_has_its_template() {
        assert_eq!(catalogue().len(), TEMPLATES.len());
        for entry in catalogue() {
            let model = format!("\"model\": \"{}\"", entry.name());
            assert!(entry.template.is_some_and(|text| text.contains(&model)), "{model}");
        }
    }
}
