//! Clause 8 of JCGM 101 with few trials.
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(clippy::unwrap_used)]

use std::path::Path;

use gumption_engine::propagate::{Control, evaluate, warnings};
use gumption_engine::task::{Coverage, Trials};
use gumption_files as file;

/// y = x1 + x2, rectangular both: the GUM interval is not validated, which many trials tell. With so
/// few that the ends are the extreme ones (q = M of JCGM 101, 7.7.2) nothing is said, by any way
/// of finding them.
#[test]
fn too_few_trials_decide_nothing() {
    let text = r#"{"inputs": {
        "x_1": {"distribution": "rectangular", "mean": 0, "half_width": 1},
        "x_2": {"distribution": "rectangular", "mean": 0, "half_width": 0.1}},
        "equations": {"y": "x_1 + x_2"}, "outputs": {"y": {}}}"#;
    let mut file = file::read_text("m.json", text, Path::new(""), &[]).unwrap();
    let mut verdict = |trials: u64, p: f64, memory: usize| {
        file.task.settings.trials = Trials::Fixed(trials);
        file.task.settings.coverage = Coverage::Probability(p);
        let control = Control::default().with_memory(memory);
        let evaluation = evaluate(&file.task, &control).unwrap();
        let output = &evaluation.rows[0].outputs[0];
        let figures = output.monte_carlo.as_deref().unwrap();
        let errors = figures.errors.symmetric_interval.map(f64::is_finite);
        let note = warnings(&file.task, &evaluation);
        let noted = note.iter().any(|w| w.code() == "interval-of-extremes");
        assert_eq!(errors.contains(&false), noted);
        assert_eq!(figures.errors.shortest_interval[0].is_finite(), !noted);
        (output.validation.unwrap().gum_valid, noted)
    };
    for memory in [64 << 20, 1 << 20] {
        assert_eq!(verdict(2, 0.95, memory), (None, true));
        assert_eq!(verdict(50, 0.95, memory), (None, true));
        assert_eq!(verdict(100_000, 0.999_999_999, memory), (None, true));
        assert_eq!(verdict(400_000, 0.999_999_999, memory), (None, true));
        assert_eq!(verdict(100_000, 0.95, memory), (Some(false), false));
    }
}
