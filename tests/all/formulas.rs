//! The typed models against the same measurements written as formulas, `models/formulas/`.

use std::fs;
use std::path::Path;

use gumption::file::read_text;
use gumption::propagate::gum::Gum;
use gumption::propagate::monte_carlo::MonteCarlo;
use gumption::propagate::{Control, Evaluation, evaluate};
use gumption::task::{Task, Trials};
use serde_json::Value;

/// What both forms may differ by, as a share of the standard uncertainty. A model is some dozens of
/// operations, each with a rounding of 1e-16 of its value; the estimates here are at most a few
/// thousand standard uncertainties.
const SHARE: f64 = 1e-12;

/// What a figure of the trials may differ by, as a share of the standard uncertainty: single trials
/// may lie where roundings are magnified more than at the estimate.
const SHARE_OF_TRIALS: f64 = 1e-9;

/// Trials of either form.
const TRIALS: u64 = 5_000;

/// Sweeps with exactly the inputs of the ready file, and the name of that file.
const SWEEPS: [(&str, &str); 4] = [
    ("inclined_plane_campaign", "inclined_plane"),
    ("inclined_plane_spurious_quadrants", "inclined_plane_spurious"),
    ("inclined_plane_spurious_vector_quadrants", "inclined_plane_spurious_vector"),
    ("normalized_error_table", "normalized_error"),
];

fn models() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/models"))
}

fn text(name: &str) -> String {
    let path = models().join(name).with_extension("json");
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

/// The `equations` of a file as they are written, because their order counts.
fn equations(text: &str) -> &str {
    let start = text.find("  \"equations\": {\n").expect("equations");
    let end = start + text[start..].find("\n  },\n").expect("their end");
    &text[start..end + "\n  },\n".len()]
}

/// The line that names the typed model.
fn model_line(model: &str) -> String {
    format!("  \"model\": \"{model}\",\n")
}

/// The name of the formula file of a typed model.
fn twin(model: &str) -> String {
    format!("formulas/{}", model.replace('-', "_"))
}

fn task(name: &str, text: &str) -> Task {
    let read = read_text(name, text, models(), &[]);
    let mut task = read.unwrap_or_else(|problems| panic!("{name}: {problems:?}")).task;
    task.settings.trials = Trials::Fixed(TRIALS);
    task
}

fn evaluated(task: &Task) -> Evaluation {
    evaluate(task, &Control::default()).expect("an evaluation")
}

/// Evaluates two files that differ in the form of the model only.
fn compare(name: &str, typed: &str, written: &str) {
    let (typed, written) = (task(name, typed), task(name, written));
    let outputs: Vec<&String> = typed.model.outputs.iter().map(|o| &o.quantity.name).collect();
    let (one, other) = (evaluated(&typed), evaluated(&written));
    assert_eq!(one.rows.len(), other.rows.len(), "{name}");
    for (row, (one, other)) in one.rows.iter().zip(&other.rows).enumerate() {
        for (output, (one, other)) in outputs.iter().zip(one.outputs.iter().zip(&other.outputs)) {
            let place = format!("{name}, row {row}, {output}");
            let (gum, its_gum) = (one.gum.as_ref().unwrap(), other.gum.as_ref().unwrap());
            compare_gum(&place, &typed, gum, its_gum);
            let u = gum.standard_uncertainty;
            let (trials, its_trials) = (&one.monte_carlo, &other.monte_carlo);
            compare_trials(&place, u, trials.as_ref().unwrap(), its_trials.as_ref().unwrap());
        }
    }
}

fn compare_gum(place: &str, task: &Task, one: &Gum, other: &Gum) {
    let u = one.standard_uncertainty;
    // where nothing varies a rounding of the value is left
    let tolerance = if u > 0.0 { SHARE * u } else { 1e-15 * one.estimate.abs() };
    let off = (one.estimate - other.estimate).abs();
    assert!(off <= tolerance, "{place}: estimates differ by {off:e}, u is {u:e}");
    assert_eq!(one.budget().count(), other.budget().count(), "{place}");
    for (line, its_line) in one.budget().zip(other.budget()) {
        let input = &task.variables[line.variable].name;
        let off = (line.sensitivity - its_line.sensitivity).abs();
        // an input that is known exactly may have any coefficient, yet it is computed alike
        let tolerance = if u > 0.0 && line.standard_uncertainty > 0.0 {
            SHARE * u / line.standard_uncertainty
        } else {
            SHARE * line.sensitivity.abs()
        };
        assert!(
            off <= tolerance,
            "{place}: sensitivities to {input} are {:e} and {:e}",
            line.sensitivity,
            its_line.sensitivity
        );
    }
}

fn compare_trials(place: &str, u: f64, one: &MonteCarlo, other: &MonteCarlo) {
    let figures = |of: &MonteCarlo| {
        let [low, high] = of.symmetric_interval;
        [of.location(), of.median, low, high]
    };
    for (one, other) in figures(one).into_iter().zip(figures(other)) {
        let tolerance = SHARE_OF_TRIALS * u + 1e-15 * one.abs();
        assert!((one - other).abs() <= tolerance, "{place}: trials give {one:e} and {other:e}");
    }
}

#[test]
fn formula_files_agree_with_the_typed_models() {
    for entry in gumption::catalogue() {
        let model = entry.typed.declaration.name;
        let written = text(&twin(model));
        let (ready, members) = (json(entry.template.unwrap()), json(&written));
        assert_eq!(members["inputs"], ready["inputs"], "{model}");
        for output in entry.typed.declaration.outputs {
            assert!(members["outputs"].get(output.name).is_some(), "{model}: {}", output.name);
        }
        compare(model, &written.replace(equations(&written), &model_line(model)), &written);
    }
}

/// Typed models whose equations are stated as formulas, which can be copied into a file.
const STATED: [&str; 9] = [
    "inclined-plane",
    "rotating-table",
    "rotating-table-instant",
    "sensitivity",
    "normalized-error",
    "projection-45",
    "axis-sensitivity",
    "relative-sensitivity",
    "phase-budget",
];

/// What the pages say that a typed model computes is what it computes.
#[test]
fn stated_equations_are_those_that_are_computed() {
    for model in STATED {
        let entry = gumption::catalogue().find(model).expect(model);
        let written = text(&twin(model));
        let members = json(&written);
        // inputs that the file leaves out have their defaults
        let absent = entry.typed.declaration.inputs.iter().filter_map(|input| {
            let default = input.default.filter(|_| members["inputs"].get(input.name).is_none())?;
            Some(format!("    {:?}: \"{default} [{}]\"", input.name, input.unit))
        });
        let (mut used, mut own) = (absent.collect::<Vec<String>>(), Vec::new());
        for output in entry.typed.declaration.outputs {
            let (equation, with) = match output.equation.split_once(" with ") {
                Some((equation, with)) => (equation, with.split_once(" = ")),
                None => (output.equation, None),
            };
            used.extend(with.map(|(name, text)| format!("    {name:?}: {text:?}")));
            own.push(format!("    {:?}: {equation:?}", output.name));
        }
        // what an equation uses stands before it: of the outputs the later ones
        let lines: Vec<String> = used.into_iter().chain(own.into_iter().rev()).collect();
        let stated = format!("  \"equations\": {{\n{}\n  }},\n", lines.join(",\n"));
        let typed = written.replace(equations(&written), &model_line(model));
        compare(model, &typed, &written.replace(equations(&written), &stated));
    }
}

#[test]
fn formulas_agree_in_every_row_of_a_sweep() {
    for (sweep, ready) in SWEEPS {
        let typed = text(sweep);
        let line = model_line(&ready.replace('_', "-"));
        assert!(typed.contains(&line), "{sweep}");
        let formulas = text(&format!("formulas/{ready}"));
        compare(sweep, &typed, &typed.replace(&line, equations(&formulas)));
    }
}

/// As they stand, without the typed file beside them.
#[test]
fn every_formula_file_has_its_typed_model() {
    let mut files = 0;
    for entry in fs::read_dir(models().join("formulas")).expect("formula files") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        assert!(gumption::catalogue().find(&name.replace('_', "-")).is_some(), "{name}");
        gumption::file::read(&path, &[]).unwrap_or_else(|problems| panic!("{problems:?}"));
        files += 1;
    }
    assert_eq!(files, gumption::catalogue().len());
}
