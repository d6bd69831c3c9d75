//! The public worked examples in `tests/cases`, run through the binary and compared as
//! `tests/cases/README.md` says.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{announce, command, root};

fn folder() -> PathBuf {
    root().join("tests/cases")
}

/// A step of a path: a key, or what stands in brackets.
fn step<'v>(value: &'v Value, step: &str) -> Option<&'v Value> {
    match value {
        Value::Array(list) => match step.split_once('=') {
            Some((key, wanted)) => {
                list.iter().find(|entry| entry.get(key).and_then(Value::as_str) == Some(wanted))
            }
            None => list.get(step.parse::<usize>().ok()?),
        },
        _ => value.get(step),
    }
}

/// `a.b[0].c`; `list[key=value]` takes the entry that has that value.
fn dig<'v>(value: &'v Value, path: &str) -> Option<&'v Value> {
    path.split(['.', '[', ']']).filter(|part| !part.is_empty()).try_fold(value, step)
}

/// What is not as expected, in words.
fn misses(answer: &Value, expected: &Value) -> Vec<String> {
    let mut misses = Vec::new();
    for kind in ["published", "recomputed"] {
        let list = expected[kind].as_array().expect("a list of expectations");
        for entry in list {
            let path = entry["path"].as_str().expect("a path");
            let start = match entry["output"].as_str() {
                Some(output) => answer["outputs"].get(output),
                None => Some(answer),
            };
            let at = |path: &str| start.and_then(|value| dig(value, path));
            let other = |key: &str| entry.get(key).map(|path| at(path.as_str().unwrap_or("")));
            let (got, want) = (at(path), &entry["value"]);
            let met = match want {
                Value::Null | Value::Bool(_) | Value::String(_) => got == Some(want),
                _ => is_near(got, entry, other("same_as"), other("differs_from")),
            };
            if !met {
                let (why, tolerance) = (&entry["why"], &entry["tolerance"]);
                let output = &entry["output"];
                misses.push(format!(
                    "{kind} {output} {path}: wanted {want} +- {tolerance}, got {got:?} ({why})"
                ));
            }
        }
    }
    misses
}

/// A number within the tolerance, equal to another to 1e-12 or different from it if that is asked.
fn is_near(
    got: Option<&Value>,
    entry: &Value,
    same: Option<Option<&Value>>,
    differs: Option<Option<&Value>>,
) -> bool {
    let (Some(got), Some(want)) = (got.and_then(Value::as_f64), entry["value"].as_f64()) else {
        return false;
    };
    let tolerance = entry["tolerance"].as_f64().expect("a tolerance");
    let is_same = match same {
        Some(other) => other
            .and_then(Value::as_f64)
            .is_some_and(|other| (got - other).abs() <= 1e-12 * got.abs()),
        None => true,
    };
    let is_different = match differs {
        Some(other) => other.and_then(Value::as_f64).is_some_and(|other| got != other),
        None => true,
    };
    (got - want).abs() <= tolerance && is_same && is_different
}

/// What is not as expected of a file that must be refused.
fn not_refused(code: Option<i32>, message: &str, expected: &Value) -> Vec<String> {
    let mut misses = Vec::new();
    if code.map(i64::from) != expected["exit"].as_i64() {
        misses.push(format!("exit code {code:?}, wanted {}", expected["exit"]));
    }
    for part in expected["message_contains"].as_array().expect("parts of the message") {
        let part = part.as_str().expect("a text");
        if !message.to_lowercase().contains(&part.to_lowercase()) {
            misses.push(format!("a message without {part:?}"));
        }
    }
    if let Some(line) = expected["line"].as_u64()
        && !message.contains(&format!(":{line}:"))
    {
        misses.push(format!("a message without :{line}:"));
    }
    if !misses.is_empty() {
        misses.push(format!("it said: {message}"));
    }
    misses
}

fn run_case(name: &str) {
    let folder = folder().join(name);
    let expected = fs::read_to_string(folder.join("expect.json")).expect("expectations");
    let expected: Value = serde_json::from_str(&expected).expect("JSON");
    let run = command()
        .current_dir(&folder)
        .args(["run", "model.json", "--format", "json", "--quiet"])
        .output()
        .expect("the program runs");
    let message = String::from_utf8_lossy(&run.stderr);
    let misses = if expected.get("exit").is_some() {
        not_refused(run.status.code(), &message, &expected)
    } else {
        match serde_json::from_slice(&run.stdout) {
            Ok(answer) => misses(&answer, &expected),
            Err(_) => vec![format!("no answer: {message}")],
        }
    };
    assert!(misses.is_empty(), "{name}\n    {}", misses.join("\n    "));
}

macro_rules! cases {
    ($($test:ident: $name:literal,)*) => {
        const NAMES: &[&str] = &[$($name,)*];

        $(
            #[test]
            fn $test() {
                run_case($name);
            }
        )*
    };
}

cases! {
    cond_highpass_frequencies: "cond-highpass-frequencies",
    cond_inclined_plane_tilts: "cond-inclined-plane-tilts",
    ea402_s10_caliper: "ea402-s10-caliper",
    ea402_s5_furnace_temperature: "ea402-s5-furnace-temperature",
    ea402_s5_thermocouple_emf: "ea402-s5-thermocouple-emf",
    ea402_s6_power_sensor: "ea402-s6-power-sensor",
    ea402_s7_step_attenuator: "ea402-s7-step-attenuator",
    ea402_s9_multimeter: "ea402-s9-multimeter",
    feat_aliases_limits: "feat-aliases-limits",
    feat_allow_undefined_sqrt: "feat-allow-undefined-sqrt",
    feat_check_units_false: "feat-check-units-false",
    feat_components_tilt: "feat-components-tilt",
    feat_conditions_semicolon: "feat-conditions-semicolon",
    feat_copula_exponential_triangular: "feat-copula-exponential-triangular",
    feat_copula_lognormal_normal: "feat-copula-lognormal-normal",
    feat_copula_two_rectangulars: "feat-copula-two-rectangulars",
    feat_correlation_matrix_three: "feat-correlation-matrix-three",
    feat_correlation_rows_negative: "feat-correlation-rows-negative",
    feat_coverage_factor_five_readings: "feat-coverage-factor-five-readings",
    feat_coverage_factor_fixed_two: "feat-coverage-factor-fixed-two",
    feat_coverage_factor_two: "feat-coverage-factor-two",
    feat_digits_one: "feat-digits-one",
    feat_digits_rounding_edge: "feat-digits-rounding-edge",
    feat_dof_nineteen: "feat-dof-nineteen",
    feat_dof_undefined_normals: "feat-dof-undefined-normals",
    feat_estimate_formula_frequency: "feat-estimate-formula-frequency",
    feat_expanded_p_normal: "feat-expanded-p-normal",
    feat_grid_radius_frequency: "feat-grid-radius-frequency",
    feat_kelvin_radiation: "feat-kelvin-radiation",
    feat_literal_zero_max: "feat-literal-zero-max",
    feat_normal_dof_drawn_t: "feat-normal-dof-drawn-t",
    feat_paired_two: "feat-paired-two",
    feat_per_row_and_name: "feat-per-row-and-name",
    feat_periodic_positive: "feat-periodic-positive",
    feat_sensitivity_length: "feat-sensitivity-length",
    feat_shortest_0999_exponential: "feat-shortest-0999-exponential",
    feat_shortest_half: "feat-shortest-half",
    feat_specification_sweep: "feat-specification-sweep",
    feat_subtotals_groups: "feat-subtotals-groups",
    feat_t_dof_two: "feat-t-dof-two",
    feat_tolerance_normal: "feat-tolerance-normal",
    feat_trials_zero: "feat-trials-zero",
    gum_4_3_4_certificate: "gum-4.3.4-certificate",
    gum_4_4_3_readings: "gum-4.4.3-readings",
    gum_4_4_5_rectangular: "gum-4.4.5-rectangular",
    gum_4_4_6_triangular: "gum-4.4.6-triangular",
    gum_5_2_2_ten_resistors: "gum-5.2.2-ten-resistors",
    gum_g41_welch_satterthwaite: "gum-g41-welch-satterthwaite",
    gum_h2_impedance_normal: "gum-h2-impedance-normal",
    gum_h3_thermometer: "gum-h3-thermometer",
    jcgm101_9_2_2_adaptive: "jcgm101-9.2.2-adaptive",
    jcgm101_9_2_2_normal: "jcgm101-9.2.2-normal",
    jcgm101_9_2_3_rectangular: "jcgm101-9.2.3-rectangular",
    jcgm101_9_2_4_dominant_rectangular: "jcgm101-9.2.4-dominant-rectangular",
    jcgm101_9_3_mass: "jcgm101-9.3-mass",
    jcgm101_9_4_x1_000_r09: "jcgm101-9.4-x1-000-r09",
    jcgm101_9_4_x1_010_r09: "jcgm101-9.4-x1-010-r09",
    jcgm101_9_4_x1_050_r09: "jcgm101-9.4-x1-050-r09",
    nist_um_stefan_boltzmann: "nist-um-stefan-boltzmann",
    nist1900_e11_attenuator: "nist1900-e11-attenuator",
    nist1900_e13_expansion: "nist1900-e13-expansion",
    nist1900_e4_pitot_like: "nist1900-e4-pitot-like",
    prop_arcsine: "prop-arcsine",
    prop_arcsine_sum: "prop-arcsine-sum",
    prop_beta: "prop-beta",
    prop_beta_limits: "prop-beta-limits",
    prop_chi_square_5: "prop-chi-square-5",
    prop_clause8_correlated: "prop-clause8-correlated",
    prop_clause8_mild_product: "prop-clause8-mild-product",
    prop_copula_exponential_lognormal: "prop-copula-exponential-lognormal",
    prop_copula_triangular_normal: "prop-copula-triangular-normal",
    prop_correlated_product: "prop-correlated-product",
    prop_cos_uniform_phase: "prop-cos-uniform-phase",
    prop_coverage_50: "prop-coverage-50",
    prop_coverage_999: "prop-coverage-999",
    prop_ctrap_certificate: "prop-ctrap-certificate",
    prop_ctrap_sum: "prop-ctrap-sum",
    prop_exponential_sum: "prop-exponential-sum",
    prop_gamma: "prop-gamma",
    prop_gamma_fraction: "prop-gamma-fraction",
    prop_irwin_hall_2: "prop-irwin-hall-2",
    prop_large_offset: "prop-large-offset",
    prop_log_uniform_log: "prop-log-uniform-log",
    prop_log_uniform_product: "prop-log-uniform-product",
    prop_max_normals: "prop-max-normals",
    prop_normal_log_ratio: "prop-normal-log-ratio",
    prop_normal_square_far: "prop-normal-square-far",
    prop_poisson_count: "prop-poisson-count",
    prop_poisson_zero: "prop-poisson-zero",
    prop_power_precedence: "prop-power-precedence",
    prop_probability_comparison: "prop-probability-comparison",
    prop_product_rectangular: "prop-product-rectangular",
    prop_rayleigh: "prop-rayleigh",
    prop_readings_12: "prop-readings-12",
    prop_readings_product: "prop-readings-product",
    prop_samples: "prop-samples",
    prop_t_dof3: "prop-t-dof3",
    prop_t_dof5: "prop-t-dof5",
    prop_t_small_dof_sum: "prop-t-small-dof-sum",
    prop_trapezoid: "prop-trapezoid",
    prop_triangular_mode: "prop-triangular-mode",
    prop_triangular_skew_sum: "prop-triangular-skew-sum",
    prop_units_derived: "prop-units-derived",
    prop_units_ppm_percent: "prop-units-ppm-percent",
    prop_weibull: "prop-weibull",
    prop_welch_rectangular_dof: "prop-welch-rectangular-dof",
    prop_welch_satterthwaite_mixed: "prop-welch-satterthwaite-mixed",
    quam_a1_cadmium: "quam-a1-cadmium",
    quam_a3_hcl: "quam-a3-hcl",
    quam_a5_ceramic: "quam-a5-ceramic",
    seed000_inclined_plane: "seed000-inclined-plane",
    seed000_inclined_plane_abs_fold: "seed000-inclined-plane-abs-fold",
    seed000_phases_type_a: "seed000-phases-type-a",
    seed000_printed_form_third_quadrant: "seed000-printed-form-third-quadrant",
    seed000_signed_form: "seed000-signed-form",
    seed002_rotating_table_5hz: "seed002-rotating-table-5hz",
    seed003_highpass_cascade: "seed003-highpass-cascade",
    wrong_component_without_name: "wrong-component-without-name",
    wrong_correlation_out_of_reach: "wrong-correlation-out-of-reach",
    wrong_csv_empty_cell: "wrong-csv-empty-cell",
    wrong_misspelt_name: "wrong-misspelt-name",
    wrong_unknown_key: "wrong-unknown-key",
    wrong_width_without_unit: "wrong-width-without-unit",
}

#[test]
fn every_folder_is_named() {
    let named: BTreeSet<String> = NAMES.iter().map(|&name| name.to_owned()).collect();
    let found: BTreeSet<String> = fs::read_dir(folder())
        .expect("the folder of examples")
        .map(|entry| entry.expect("an entry"))
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(named, found);
}

/// All files below a folder with their contents, by their paths within it.
fn contents(top: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    let mut folders = vec![top.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let content = fs::read(&path).expect("a file");
                files.push((path.strip_prefix(top).expect("a prefix").to_owned(), content));
            }
        }
    }
    files.sort();
    files
}

#[test]
fn the_copy_is_verbatim() {
    let original = root().join("../shared/cases");
    if !original.is_dir() {
        return announce("not run: comparison with ../shared/cases, which is not there");
    }
    let (copied, original) = (contents(&folder()), contents(&original));
    let names = |files: &[(PathBuf, Vec<u8>)]| {
        files.iter().map(|(path, _)| path.clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&copied), names(&original));
    for ((path, copied), (_, original)) in copied.iter().zip(&original) {
        assert!(copied == original, "{} differs", path.display());
    }
}
