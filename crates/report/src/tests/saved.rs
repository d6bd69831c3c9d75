//! Results that become inputs: what is saved and read back is what was evaluated.

use gumption_engine::fact::Argument;
use std::path::Path;

use crate::{EvaluationReport, Provenance, saved};
use gumption_engine::distribution::Scores;
use gumption_engine::number::CodePath;
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::MonteCarlo;
use gumption_engine::propagate::{
    Control, Evaluation, evaluate, linear, origins, quantiles_and_ranks, trial_hash, warnings,
};
use gumption_engine::task::Trials;
use gumption_files as file;
use gumption_files::ModelFile;
use gumption_text::{Diagnostic, DiagnosticKind};

const TRIALS: u64 = 400_000;

/// A calibration: two outputs that share a gain and an offset, one with readings of its own.
const CALIBRATION: &str = r#"{"inputs": {
    "gain": {"unit": "1", "distribution": "normal", "mean": 2, "std": 0.02},
    "offset": {"unit": "mV", "distribution": "rectangular", "mean": 0, "half_width": 60},
    "indication": {"unit": "V", "distribution": "readings",
                   "values": [3.01, 2.99, 3.04, 3.02, 2.97, 2.98, 3.0]}},
    "equations": {"a": "gain*indication + offset", "b": "0.9*gain*(3 [V]) + offset",
                  "skew": "exp(20*offset/[V])", "square": "(gain - 2)^2"},
    "outputs": {"a": {"unit": "mV"}, "b": {"unit": "mV"}, "skew": {}, "square": {}}}"#;

fn calibration() -> String {
    CALIBRATION.to_owned()
}

struct Run {
    file: ModelFile,
    evaluation: Evaluation,
}

impl Run {
    fn new(text: &str, folder: &Path, seed: u64) -> Self {
        let mut file = file::read_text("m.json", text, folder, &[]).unwrap();
        file.task.settings.trials = Trials::Fixed(TRIALS);
        file.task.settings.seed = seed;
        let evaluation = evaluate(&file.task, &Control::default()).unwrap();
        Self { file, evaluation }
    }

    fn gum(&self, output: usize) -> &Gum {
        self.evaluation.rows[0].outputs[output].gum.as_ref().unwrap()
    }

    fn trials(&self, output: usize) -> &MonteCarlo {
        self.evaluation.rows[0].outputs[output].monte_carlo.as_deref().unwrap()
    }

    /// Writes the result file; the model's hash is `model`.
    fn save(&self, path: &Path, model: &str) {
        let task = &self.file.task;
        let scores: Vec<f64> = Scores::WRITTEN.values().collect();
        let found = quantiles_and_ranks(task, &self.evaluation, 0, &scores, &Control::default());
        let gums: Vec<_> = self.evaluation.rows[0].outputs.iter().map(linear).collect();
        let origins = origins(task, &task.rows[0], &gums, model);
        let provenance = Provenance { model_sha256: model.to_owned(), files: Vec::new() };
        let report = EvaluationReport {
            task,
            evaluation: &self.evaluation,
            warnings: &[],
            provenance: &provenance,
        };
        let (quantiles, ranks) = found.unwrap().unwrap();
        std::fs::write(path, saved(&report, &origins, &quantiles, &ranks)).unwrap();
    }
}

fn diagnostics(text: &str, folder: &Path) -> Vec<Diagnostic> {
    file::read_text("m.json", text, folder, &[]).unwrap_err().0
}

/// One input from a result file as it stands.
fn alone(fields: &str, unit: &str) -> String {
    format!(
        r#"{{"inputs": {{"x": {{"distribution": "result", "file": "c.json", {fields}}}}},
            "equations": {{"y": "x"}}, "outputs": {{"y": {{"unit": "{unit}"}}}}}}"#
    )
}

/// The difference of `a` of one file and `b` of another.
fn difference(first: &str, second: &str) -> String {
    format!(
        r#"{{"inputs": {{"a": {{"distribution": "result", "file": "{first}", "output": "a"}},
                      "b": {{"distribution": "result", "file": "{second}", "output": "b"}}}},
            "equations": {{"d": "a - b"}}, "outputs": {{"d": {{"unit": "mV"}}}}}}"#
    )
}

fn direct() -> Run {
    let text = calibration().replacen(r#""square": ""#, r#""d": "a - b", "square": ""#, 1);
    let text = text.replace(r#""square": {}"#, r#""d": {"unit": "mV"}"#);
    Run::new(&text, Path::new(""), 1)
}

/// How far trials drawn from a saved result may be from those of the direct run: by the scatter of
/// both runs, and by that of the trials that the result holds. By measurement over seeds this is 0.3
/// of the scatter of as many random trials, which is that of the direct run times sqrt(M/32768).
struct Scatter {
    kept: f64,
}

impl Default for Scatter {
    fn default() -> Self {
        Self { kept: 0.3 * (TRIALS as f64 / 32_768.0).sqrt() }
    }
}

impl Scatter {
    /// The differences of u and of both ends of the symmetric interval, in standard deviations; five
    /// are a false failure rate of 6e-7 each.
    fn off(&self, direct: &MonteCarlo, saved: &MonteCarlo) -> [f64; 3] {
        let of = |a: f64, b: f64, errors: [f64; 2]| {
            (a - b).abs() / errors[0].hypot(errors[1]).hypot(self.kept * errors[0])
        };
        let both = [direct, saved];
        let u = both.map(|figures| figures.standard_uncertainty.unwrap());
        let of_u = both.map(|figures| figures.errors.standard_uncertainty.unwrap());
        let [low, high] = [0, 1].map(|end| {
            let errors = both.map(|figures| figures.errors.symmetric_interval[end]);
            of(direct.symmetric_interval[end], saved.symmetric_interval[end], errors)
        });
        [of(u[0], u[1], of_u), low, high]
    }
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} {b}");
}

/// Another seed draws from the saved trials: the standard deviation is theirs to 1e-3 of quantile
/// table and 5 standard errors of the second run; so are the ends of the interval to 5 standard
/// errors of it (false failure rate 6e-7 each).
#[test]
fn a_result_is_drawn_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let run = Run::new(&calibration(), folder.path(), 1);
    run.save(&folder.path().join("c.json"), "c");
    for (output, name) in ["a", "b", "skew", "square"].into_iter().enumerate() {
        let unit = run.file.task.model.outputs[output].quantity.unit.text().to_owned();
        let again = Run::new(&alone(&format!(r#""output": "{name}""#), &unit), folder.path(), 2);
        let (was, is) = (run.trials(output), again.trials(0));
        let error = is.errors.standard_uncertainty.unwrap();
        let (u, v) = (was.standard_uncertainty.unwrap(), is.standard_uncertainty.unwrap());
        assert!((u - v).abs() < 1e-3 * u + 5.0 * error, "{name}: {u} {v}");
        for end in 0..2 {
            let (a, b) = (was.symmetric_interval[end], is.symmetric_interval[end]);
            let error = is.errors.symmetric_interval[end];
            assert!((a - b).abs() < 5.0 * error, "{name}: {a} {b} {error}");
        }
        let (was, is) = (run.gum(output), again.gum(0));
        if name == "square" {
            // no sensitivity at the estimate: the figures of the trials stand in
            close(is.standard_uncertainty, u, 1e-15);
        } else {
            assert_eq!(is.estimate, was.estimate);
            assert_eq!(is.standard_uncertainty, was.standard_uncertainty);
            match (was.dof, is.dof) {
                (Dof::Finite(a), Dof::Finite(b)) => close(b, a, 1e-12),
                (a, b) => assert_eq!(a, b),
            }
            close(is.expanded_uncertainty().unwrap(), was.expanded_uncertainty().unwrap(), 1e-12);
        }
        assert_eq!(is.budget().next().unwrap().distribution, "result");
    }
}

/// The difference of two outputs of one saved result is the direct run's: by the law of propagation to
/// rounding, degrees of freedom included; u and the ends of the interval of the trials as far as the
/// two runs scatter, and the trials that the result holds ([`Scatter`]).
#[test]
fn a_difference_of_two_outputs_is_as_if_computed_directly() {
    let folder = tempfile::tempdir().unwrap();
    Run::new(&calibration(), folder.path(), 1).save(&folder.path().join("c.json"), "c");
    let (direct, saved) = (direct(), Run::new(&difference("c.json", "c.json"), folder.path(), 3));
    let (was, is) = (direct.gum(3), saved.gum(0));
    close(is.estimate, was.estimate, 1e-12);
    close(is.standard_uncertainty, was.standard_uncertainty, 1e-9);
    close(is.expanded_uncertainty().unwrap(), was.expanded_uncertainty().unwrap(), 1e-9);
    let (Dof::Finite(a), Dof::Finite(b)) = (was.dof, is.dof) else { panic!() };
    close(b, a, 1e-9);
    let off = Scatter::default().off(direct.trials(3), saved.trials(0));
    assert!(off.iter().all(|off| *off < 5.0), "{off:?}");
    // the note says so
    assert!(saved.file.warnings.iter().any(|w| w.code() == "result-correlation"));
}

/// The same through two results of the same model file, and through a result of a result; results
/// of another model file are independent.
#[test]
fn common_inputs_are_kept_through_different_results() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let first = Run::new(&calibration(), folder.path(), 1);
    first.save(&path("c.json"), "model");
    Run::new(&calibration(), folder.path(), 2).save(&path("second.json"), "model");
    Run::new(&calibration(), folder.path(), 2).save(&path("other.json"), "other model");
    let b = alone(r#""output": "b""#, "V").replace("\"y\"", "\"b\"");
    Run::new(&b, folder.path(), 4).save(&path("chain.json"), "chain");
    let direct = direct();
    for second in ["second.json", "chain.json"] {
        let is = Run::new(&difference("c.json", second), folder.path(), 3);
        close(is.gum(0).standard_uncertainty, direct.gum(3).standard_uncertainty, 1e-9);
        close(
            is.gum(0).expanded_uncertainty().unwrap(),
            direct.gum(3).expanded_uncertainty().unwrap(),
            1e-9,
        );
        let (u, v) = (direct.trials(3), is.trials(0));
        close(v.standard_uncertainty.unwrap(), u.standard_uncertainty.unwrap(), 0.02);
    }
    let independent = Run::new(&difference("c.json", "other.json"), folder.path(), 3);
    let squares = first.gum(0).standard_uncertainty.hypot(first.gum(1).standard_uncertainty);
    close(independent.gum(0).standard_uncertainty, squares, 1e-12);
    assert!(independent.file.task.correlations.is_empty());
}

#[test]
fn units_are_converted() {
    let folder = tempfile::tempdir().unwrap();
    let run = Run::new(&calibration(), folder.path(), 1);
    run.save(&folder.path().join("c.json"), "c");
    let volts = Run::new(&alone(r#""output": "a", "unit": "V""#, "V"), folder.path(), 1);
    close(volts.gum(0).estimate, run.gum(0).estimate / 1000.0, 1e-15);
    close(volts.gum(0).standard_uncertainty, run.gum(0).standard_uncertainty / 1000.0, 1e-15);
    let own = Run::new(&alone(r#""output": "a""#, "V"), folder.path(), 1);
    close(own.gum(0).standard_uncertainty, volts.gum(0).standard_uncertainty, 1e-15);
    close(own.trials(0).symmetric_interval[0], volts.trials(0).symmetric_interval[0], 1e-12);
    let wrong = diagnostics(&alone(r#""output": "a", "unit": "m""#, "m"), folder.path());
    assert!(matches!(wrong[0].kind, DiagnosticKind::WrongDimension { .. }), "{wrong:?}");
}

/// A component of an input is the result's deviation from its estimate; an estimate of the command
/// line moves the distribution.
#[test]
fn a_result_can_be_moved() {
    let folder = tempfile::tempdir().unwrap();
    let run = Run::new(&calibration(), folder.path(), 1);
    run.save(&folder.path().join("c.json"), "c");
    let text = r#"{"inputs": {"x": {"unit": "V", "mean": 7, "components": [
        {"name": "calibration", "distribution": "result", "file": "c.json", "output": "a"}]}},
        "equations": {"y": "x"}, "outputs": {"y": {"unit": "mV"}}}"#;
    let component = Run::new(text, folder.path(), 1);
    assert_eq!(component.gum(0).estimate, 7000.0);
    close(component.gum(0).standard_uncertainty, run.gum(0).standard_uncertainty, 1e-12);
    let middle = component.trials(0).location() - 7000.0;
    let was = run.trials(0).location() - run.gum(0).estimate;
    assert!((middle - was).abs() < 0.01 * run.gum(0).standard_uncertainty, "{middle} {was}");
}

#[test]
fn wrong_files_are_refused_with_their_places() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.json");
    let text = alone(r#""output": "a""#, "V");
    let at = |kind: &dyn Fn(&DiagnosticKind) -> bool, source: &str, text: &str| {
        let found = diagnostics(text, folder.path());
        let hit = found.iter().any(|p| kind(&p.kind) && p.source.name == source);
        assert!(hit, "{found:?}");
    };
    at(&|f| matches!(f, DiagnosticKind::Unreadable { .. }), "m.json", &text);
    std::fs::write(&path, r#"{"inputs": {}}"#).unwrap();
    at(&|f| matches!(f, DiagnosticKind::NotResult { .. }), "c.json", &text);
    std::fs::write(&path, r#"{"result": true, "format": 2}"#).unwrap();
    at(&|f| matches!(f, DiagnosticKind::UnknownFormat { .. }), "c.json", &text);
    std::fs::write(&path, "{\"result\": true,\n").unwrap();
    at(&|f| matches!(f, DiagnosticKind::NotJson { .. }), "c.json", &text);
    Run::new(&calibration(), folder.path(), 1).save(&path, "c");
    let found = diagnostics(&alone(r#""output": "sqare""#, "1"), folder.path());
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].kind.suggestion().as_deref(), Some("square"));
    let good = std::fs::read_to_string(&path).unwrap();
    let broken = |from: &str, to: &str| {
        assert!(good.contains(from));
        std::fs::write(&path, good.replacen(from, to, 1)).unwrap();
    };
    broken("\"quantiles\": [", "\"quantiles\": [1e9, ");
    at(&|f| matches!(f, DiagnosticKind::Distribution { .. }), "c.json", &text);
    broken("\"sensitivities\": [", "\"sensitivities\": [1, ");
    at(&|f| matches!(f, DiagnosticKind::SavedEntry { .. }), "c.json", &text);
    broken("\"step\": 0.0078125", "\"step\": 0");
    at(&|f| matches!(f, DiagnosticKind::NotPositive { .. }), "c.json", &text);
    broken("\"dof\": ", "\"dof\": -1, \"was\": ");
    at(&|f| matches!(f, DiagnosticKind::NotPositive { .. }), "c.json", &text);
    std::fs::write(&path, &good).unwrap();
    let declared =
        difference("c.json", "c.json").replacen('{', r#"{"correlations": [["b", "a", 0.5]], "#, 1);
    at(&|f| matches!(f, DiagnosticKind::SavedCorrelation { .. }), "m.json", &declared);
}

/// The answer of a saved result with a constant among its outputs, and the same bytes again.
#[test]
fn the_file_is_a_function_of_the_evaluation() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1},
        "k": {"distribution": "constant", "value": 3}},
        "equations": {"y": "x*k", "z": "k"}, "outputs": {"y": {}, "z": {}}}"#;
    let (one, two) = (folder.path().join("c.json"), folder.path().join("d.json"));
    Run::new(text, folder.path(), 1).save(&one, "c");
    Run::new(text, folder.path(), 1).save(&two, "c");
    assert_eq!(std::fs::read(&one).unwrap(), std::fs::read(&two).unwrap());
    let constant = Run::new(&alone(r#""output": "z""#, "1"), folder.path(), 1);
    assert_eq!(constant.gum(0).estimate, 3.0);
    assert_eq!(constant.gum(0).standard_uncertainty, 0.0);
    // the quantiles of trials of a normal distribution lie where its own do, to the scatter of
    // 4e5 trials: 5 x 0.3 x sqrt(p (1 - p)/M)/phi(z) is 0.005 at |z| < 2
    let value: serde_json::Value = serde_json::from_slice(&std::fs::read(&one).unwrap()).unwrap();
    let quantiles = value["outputs"]["y"]["quantiles"].as_array().unwrap();
    for (z, q) in Scores::WRITTEN.values().zip(quantiles) {
        if z.abs() < 2.0 {
            let q = q.as_f64().unwrap();
            assert!((q - (3.0 + 0.3 * z)).abs() < 0.008, "{z}: {q}");
        }
    }
}

/// The text of a result file as it was written before it held ranks.
fn without_ranks(text: &str) -> String {
    let mut parts = text.split("\"ranks\": [");
    let mut left = parts.next().unwrap().to_owned();
    for part in parts {
        left.truncate(left.trim_end().trim_end_matches(',').len());
        left += part.split_once(']').unwrap().1;
    }
    // nor did it have digests then
    let digests = left.find(",\n  \"sha256_of_parts\"").unwrap();
    left.truncate(digests);
    left + "\n}\n"
}

/// All outputs of a file at once, one a function of others' inputs, two of no normal shape, and a
/// linear combination of two others, so that their correlation matrix is singular. By the law of
/// propagation they cancel. What is left of c - a - b in the trials is below 1/sqrt(32768) of the
/// largest of them, u(c) = 0.129, as the note of such cases says; of d - 5 exp(5) a = exp(5 x) - ...
/// it is its own scatter: with x = 1 + w, exp(5) (exp(5 w) - 5 w), whose standard deviation over w
/// from -0.1 to 0.1 is exp(5) 0.0388 = 5.753 (by integration).
#[test]
fn dependent_outputs_are_drawn_together() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.json");
    let text = r#"{"inputs": {"x": {"distribution": "rectangular", "mean": 1, "half_width": 0.1},
        "z": {"distribution": "rectangular", "mean": 2, "half_width": 0.2}},
        "equations": {"a": "x", "b": "z", "c": "x + z", "d": "exp(5*x)"},
        "outputs": {"a": {}, "b": {}, "c": {}, "d": {}}}"#;
    Run::new(text, folder.path(), 1).save(&path, "c");
    let inputs: Vec<String> = ["a", "b", "c", "d"]
        .map(|name| {
            format!(
                r#""{name}": {{"distribution": "result", "file": "c.json", "output": "{name}"}}"#
            )
        })
        .into();
    let text = format!(
        r#"{{"inputs": {{{}}}, "equations": {{"e": "c - a - b", "f": "d - 5*exp(5)*a", "s": "c"}},
            "outputs": {{"e": {{}}, "f": {{}}, "s": {{}}}}}}"#,
        inputs.join(", ")
    );
    let run = Run::new(&text, folder.path(), 2);
    assert!(run.gum(0).standard_uncertainty < 1e-8);
    assert!(
        run.gum(1).standard_uncertainty < 1e-6 * run.gum(1).budget().nth(3).unwrap().contribution
    );
    let left = run.trials(0).standard_uncertainty.unwrap();
    assert!(left < 0.129 / 32_768_f64.sqrt(), "{left}");
    let left = run.trials(1).standard_uncertainty.unwrap();
    close(left, 5.753, 0.02);
    let notes = warnings(&run.file.task, &run.evaluation);
    let of = |code: &str| -> Vec<&str> {
        notes.iter().filter(|w| w.code() == code).map(|w| w.place.as_str()).collect()
    };
    assert_eq!(of("result-cancellation"), ["e"]);
    assert!(of("gaussian-copula").is_empty());

    // without ranks it is the Gaussian copula that joins them, and it cannot do that with these
    // shapes: the run says so. Its coefficients are off by less than 0.02, so what is left of
    // c - a - b has a variance below 2 x 0.02 (u_a u_c + u_b u_c + u_a u_b), 0.036 in u
    std::fs::write(&path, without_ranks(&std::fs::read_to_string(&path).unwrap())).unwrap();
    let run = Run::new(&text, folder.path(), 2);
    let left = run.trials(0).standard_uncertainty.unwrap();
    assert!(left < 0.036, "{left}");
    assert!(run.evaluation.copula_adjusted > 0.0 && run.evaluation.copula_adjusted < 0.02);
    let notes = warnings(&run.file.task, &run.evaluation);
    let effect = notes.iter().find(|w| w.code() == "copula-effect" && w.place == "e").unwrap();
    let drawn = effect.fact.arguments.iter().find(|(name, _)| *name == "drawn").unwrap();
    let Argument::Number(drawn) = &drawn.1 else { panic!("{drawn:?}") };
    assert!(drawn.starts_with(&format!("{left:.0e}")[..1]), "{drawn} {left}");
    assert!(run.file.warnings.iter().any(|w| w.code() == "result-without-ranks"));
}

/// Functions of two outputs of one saved result, strongly nonlinear ones of broad inputs among them,
/// against the direct run.
#[test]
fn functions_of_two_outputs_are_as_if_computed_directly() {
    let folder = tempfile::tempdir().unwrap();
    let inputs = r#"{"check_units": false, "inputs": {
        "x": {"distribution": "normal", "mean": 1, "std": 0.3},
        "t": {"distribution": "rectangular", "mean": 2, "half_width": 1.5}},"#;
    let (v, w) = (r#""v": "x*x*t""#, r#""w": "exp(x)/t""#);
    let functions = r#""difference": "v - w", "ratio": "v/w", "product": "v*w""#;
    let outputs = r#""outputs": {"difference": {}, "ratio": {}, "product": {}}}"#;
    let direct = format!(r#"{inputs} "equations": {{{v}, {w}, {functions}}}, {outputs}"#);
    let direct = Run::new(&direct, folder.path(), 1);
    let saved =
        format!(r#"{inputs} "equations": {{{v}, {w}}}, "outputs": {{"v": {{}}, "w": {{}}}}}}"#);
    Run::new(&saved, folder.path(), 2).save(&folder.path().join("c.json"), "c");
    let text = format!(
        r#"{{"inputs": {{"v": {{"distribution": "result", "file": "c.json", "output": "v"}},
            "w": {{"distribution": "result", "file": "c.json", "output": "w"}}}},
            "equations": {{{functions}}}, {outputs}"#
    );
    let run = Run::new(&text, folder.path(), 3);
    let off = |run: &Run, output: usize| {
        Scatter::default().off(direct.trials(output), run.trials(output))
    };
    for output in 0..3 {
        let off = off(&run, output);
        assert!(off.iter().all(|off| *off < 5.0), "{output}: {off:?}");
    }
    // a Gaussian copula with the same coefficient is far off in each
    let path = folder.path().join("c.json");
    std::fs::write(&path, without_ranks(&std::fs::read_to_string(&path).unwrap())).unwrap();
    let run = Run::new(&text, folder.path(), 3);
    for output in 0..3 {
        let off = off(&run, output);
        assert!(off.iter().any(|off| *off > 10.0), "{output}: {off:?}");
    }
}

/// An output that two inputs name has one value; every output keeps its distribution; and a declared
/// correlation with another input is drawn as it is without ranks, for all that it links.
#[test]
fn inputs_of_one_result_and_others() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.json");
    let saved = Run::new(&calibration(), folder.path(), 1);
    saved.save(&path, "c");
    let with = |correlations: &str| {
        format!(
            r#"{{{correlations} "check_units": false, "inputs": {{
            "a": {{"distribution": "result", "file": "c.json", "output": "a"}},
            "again": {{"unit": "V", "distribution": "result", "file": "c.json", "output": "a"}},
            "skew": {{"distribution": "result", "file": "c.json", "output": "skew"}},
            "n": {{"unit": "V", "distribution": "normal", "mean": 0, "std": 1}}}},
            "equations": {{"a_1": "a", "s_1": "skew", "zero": "a/1000 - again", "all": "a + skew + n"}},
            "outputs": {{"a_1": {{"unit": "mV"}}, "s_1": {{}}, "zero": {{}}, "all": {{}}}}}}"#
        )
    };
    let run = Run::new(&with(""), folder.path(), 2);
    for (output, of) in [(0, 0), (1, 2)] {
        let (was, is) = (saved.trials(of), run.trials(output));
        for end in 0..2 {
            let difference = was.symmetric_interval[end] - is.symmetric_interval[end];
            assert!(difference.abs() < 5.0 * is.errors.symmetric_interval[end]);
        }
    }
    // the same table in two units, to the rounding of 6 V
    assert!(run.trials(2).standard_uncertainty.unwrap() < 1e-14);
    assert_eq!(run.evaluation.rows[0].jointly_drawn[0].variables, [0, 1, 2]);

    let linked = with(r#""correlations": [["skew", "n", 0.5]],"#);
    let first = Run::new(&linked, folder.path(), 2);
    assert!(first.evaluation.rows[0].jointly_drawn.is_empty());
    std::fs::write(&path, without_ranks(&std::fs::read_to_string(&path).unwrap())).unwrap();
    let second = Run::new(&linked, folder.path(), 2);
    // a quantity that does not vary has no coefficient
    let bits = |run: &Run| {
        run.evaluation.rows[0].correlations.iter().map(|of| of.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(bits(&first), bits(&second));
    for output in 0..4 {
        assert_eq!(first.trials(output), second.trials(output));
    }
}

/// The trials that a result holds are drawn as the same bits on any number of threads.
#[test]
fn what_is_drawn_together_is_reproducible() {
    let folder = tempfile::tempdir().unwrap();
    Run::new(&calibration(), folder.path(), 1).save(&folder.path().join("c.json"), "c");
    let file = file::read_text("m", &difference("c.json", "c.json"), folder.path(), &[]).unwrap();
    let hash = |threads: usize, path: CodePath| {
        let control = Control::default().with_threads(threads).with_path(path);
        trial_hash(&file.task, 20_000, &control).unwrap()
    };
    let first = hash(1, CodePath::BASELINE);
    for path in CodePath::available() {
        assert_eq!(hash(2, path), first, "{path:?}");
    }
}
