//! A folder with the files that cases name: right ones, and others that a case changes.

use std::cell::Cell;
use std::fs;
use std::path::Path;
use std::sync::OnceLock;

use gumption::file::read_text;
use gumption::report;
use gumption_engine::propagate::{Control, evaluate, joint_ranks, linear, origins, quantiles};

use super::choices::Choices;
use super::{grammar, mutation};
use crate::support::root;

/// A folder that goes with its thread.
pub(super) struct Folder {
    folder: tempfile::TempDir,
    changed: Cell<bool>,
}

const TABLE: &str = "f,g\n1,0.5\n2,1.5\n3,2.5\n";
const SAMPLES: &str = "# volts\n1\n1.5\n2\n0.25\n";

/// The result file of a small model.
pub(super) fn result() -> &'static str {
    static RESULT: OnceLock<String> = OnceLock::new();
    RESULT.get_or_init(|| {
        let text = r#"{"inputs": {
            "a": {"unit": "m", "distribution": "rectangular", "mean": 2, "half_width": 0.1},
            "b": {"unit": "m", "distribution": "readings", "values": [1, 1.1, 0.9, 1.05]}},
          "equations": {"y": "a*b", "z": "a + b"},
          "outputs": {"y": {"unit": "m^2"}, "z": {"unit": "m"}}, "monte_carlo": {"trials": 2000}}"#;
        let file = read_text("saved", text, Path::new(""), &[]).expect("a right file");
        let control = Control::default().with_threads(1);
        let evaluation = evaluate(&file.task, &control).expect("an answer");
        let provenance = report::Provenance { model_sha256: "0".repeat(64), files: Vec::new() };
        let scores: Vec<f64> = gumption_engine::distribution::Scores::WRITTEN.values().collect();
        let quantiles = quantiles(&file.task, &evaluation, 0, &scores, &control);
        let quantiles = quantiles.expect("threads").expect("trials");
        let ranks = joint_ranks(&file.task, &evaluation, 0, &control);
        let ranks = ranks.expect("threads").expect("trials");
        let gums: Vec<_> = evaluation.rows[0].outputs.iter().map(linear).collect();
        let origins = origins(&file.task, &file.task.rows[0], &gums, &provenance.model_sha256);
        let whole = report::EvaluationReport {
            task: &file.task,
            evaluation: &evaluation,
            warnings: &[],
            provenance: &provenance,
        };
        report::saved(&whole, &origins, &quantiles, &ranks)
    })
}

impl Folder {
    pub(super) fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let models = root().join("models");
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect(name);
        put("good.csv", TABLE);
        put("good.txt", SAMPLES);
        put("good.result", result());
        let semicolons = root().join("tests/cases/feat-conditions-semicolon/conditions.csv");
        put("conditions.csv", &fs::read_to_string(semicolons).expect("an example"));
        fs::create_dir(folder.path().join("conditions")).expect("a folder");
        for name in ["normalized_error_table.csv", "rotating_table_campaign.csv"] {
            let text = fs::read_to_string(models.join("conditions").join(name)).expect(name);
            put(&format!("conditions/{name}"), &text);
        }
        let folder = Self { folder, changed: Cell::new(true) };
        folder.restore();
        folder
    }

    /// Puts the files back that cases may change.
    pub(super) fn restore(&self) {
        if self.changed.replace(false) {
            self.write("t.csv", TABLE);
            self.write("s.txt", SAMPLES);
            self.write("r.result", result());
        }
    }

    pub(super) fn path(&self) -> &Path {
        self.folder.path()
    }

    pub(super) fn write(&self, name: &str, text: &str) {
        fs::write(self.path().join(name), text).expect(name);
    }

    /// Changes one of the files that cases name.
    pub(super) fn change(&self, choices: &mut Choices) {
        self.changed.set(true);
        match choices.below(4) {
            0 => {
                let mut file = serde_json::from_str(result()).expect("JSON");
                for _ in 0..choices.between(1, 4) {
                    mutation::mutate(choices, &mut file);
                }
                self.write("r.result", &file.to_string());
            }
            1 => {
                self.write("r.result", &mutation::damage(choices, result(), 1));
            }
            2 => self.write("t.csv", &table(choices)),
            _ => {
                let text: String = (0..choices.between(0, 12))
                    .map(|_| {
                        choices.spelling() + choices.pick(&["\n", "\n", "\r\n", "\n\n", " ", ","])
                    })
                    .collect();
                let times = usize::from(choices.chance(30));
                self.write("s.txt", &mutation::damage(choices, &text, times));
            }
        }
    }
}

/// A table, right or not.
fn table(choices: &mut Choices) -> String {
    let separator = choices.pick(&[",", ",", ";", "\t", " , "]);
    let header = if choices.chance(80) {
        "f,g\n"
    } else {
        choices.pick(&["f;g\n", "f\n", "f,f\n", "\u{feff}f,g\n", "# c\nf,g\n", "\n"])
    };
    let mut whole = header.replace(',', separator.trim());
    for _ in 0..choices.between(0, 5) {
        let cells = if choices.chance(90) { 2 } else { choices.between(0, 4) };
        let cell = |choices: &mut Choices| match choices.below(12) {
            0 => String::new(),
            1 => "\"1\n2\"".to_owned(),
            2 => "1,5".to_owned(),
            _ => choices.spelling(),
        };
        let cells: Vec<String> = (0..cells).map(|_| cell(choices)).collect();
        whole += &cells.join(separator);
        whole += choices.pick(&["\n", "\n", "\r\n", "\n#x\n", "\n\n"]);
    }
    if choices.chance(10) {
        whole += choices.pick(grammar::NAMES);
    }
    whole
}
