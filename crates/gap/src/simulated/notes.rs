//! What is to be said of the runs.

use gumption_emulator::{Ending, GOAL, Open, OutputScatter, Scatter};
use gumption_engine::decimal::significant;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};

use crate::Case;
use crate::diagnosis::DiagnosisNote;

/// What is to be said of hypotheses that are not known well enough.
pub(super) fn open(case: &Case, ending: &Ending) -> Vec<DiagnosisNote> {
    let note = |open: &Open| {
        let name = |effect: &usize| {
            let of = case.candidates.iter().find(|of| of.simulator == Some(*effect));
            of.map_or("", |of| of.effect.name.as_str())
        };
        let name = open.effects.iter().map(name).collect::<Vec<_>>().join(" + ");
        let runs = open.runs;
        let number = |value: f64| Argument::Number(significant(value, 2));
        let goal = number(GOAL);
        let fact = match (open.error.map(number), name.is_empty()) {
            (Some(error), true) => fact!("emulator.plain", error, goal, runs),
            (Some(error), false) => fact!("emulator", name, error, goal, runs),
            (None, true) => fact!("emulator.plain-not-run", runs),
            (None, false) => fact!("emulator.not-run", name, runs),
        };
        DiagnosisNote { fact }
    };
    ending.open.iter().map(note).collect()
}

/// How often the simulator was run, and how well its outputs are known at what is reported.
pub(super) fn runs(runs: usize, unseen: Option<f64>) -> Fact {
    match unseen {
        Some(error) => {
            let error = Argument::Number(significant(error, 2));
            fact!("simulator", runs, error)
        }
        None => fact!("simulator.runs", runs),
    }
}

/// How the outputs of a noisy simulator scatter, as so many repeats show.
pub(super) fn scatter(case: &Case, scatter: Option<&Scatter>, repeats: usize) -> Vec<Fact> {
    let outputs = scatter.map_or(&[][..], Scatter::outputs).iter().zip(case.described()..);
    let note = |(of, place): (&OutputScatter, usize)| {
        let name = case.model.conditions[place].name.as_str();
        let number = |value: f64| Argument::Number(significant(value, 2));
        let deviation = number(of.deviation);
        if of.correlation == 0.0 {
            return fact!("simulator.scatter", name, deviation, repeats);
        }
        let correlation = number(of.correlation);
        fact!("simulator.scatter-correlated", name, deviation, correlation, repeats)
    };
    outputs.map(note).collect()
}
