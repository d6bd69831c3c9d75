//! Composed effects: that formulas say what the search computed, and that what is withheld is named.

use std::sync::Arc;

use super::cases::normal;
use super::departures::{BENCHES, Bench, Simulated, said, simulated};
use crate::{
    Candidate, Case, ComposedEffect, ComposedPrior, DepartureOver, Diagnosis, DiagnosisOptions,
    Effect, ModelForm, ObservedOutput, OverridableModel, Prior, diagnose,
};
use gumption_engine::distribution::{Distribution, LogUniform, Rectangular};
use gumption_engine::model::formula::{Formula, Scope, Typing};
use gumption_engine::model::{InputQuantity, NumberForm, Output, Quantity};
use gumption_engine::task::{Row, Task, Variable};
use gumption_units::Unit;

fn quantity(name: &str, unit: &str) -> Quantity {
    Quantity { name: name.to_owned(), unit: Unit::parse(unit).unwrap(), about: String::new() }
}

/// A bench with its data as a case.
fn case_of(bench: &Bench, simulated: &Simulated) -> Case {
    let inputs: Vec<Quantity> =
        bench.inputs.iter().map(|(name, unit, ..)| quantity(name, unit)).collect();
    let conditions: Vec<Quantity> =
        bench.conditions.iter().map(|(name, unit)| quantity(name, unit)).collect();
    let outputs: Vec<Output> =
        bench.outputs.iter().map(|(name, unit, _)| Output::new(quantity(name, unit))).collect();
    let known = inputs.iter().chain(&conditions);
    let mut scope: Scope = known.map(|of| (of.name.clone(), Typing::in_unit(&of.unit))).collect();
    let mut equations = Vec::new();
    for (name, text) in bench.equations {
        let formula = Formula::parse(text).unwrap();
        let output = outputs.iter().find(|of| of.quantity.name == *name);
        let typing = match output {
            Some(of) => Typing::in_unit(&of.quantity.unit),
            None => formula.check(&scope).unwrap(),
        };
        scope.define(*name, typing);
        equations.push(((*name).to_owned(), formula));
    }
    let sim = OverridableModel {
        inputs: inputs.into_iter().map(|quantity| InputQuantity { quantity, parts: 1 }).collect(),
        conditions,
        outputs,
        maker: ModelForm::Equations(equations),
        numbers: NumberForm::Coherent,
        scope,
    };
    let distributions: Arc<[Arc<Distribution>]> =
        bench.inputs.iter().map(|(_, _, mean, std)| Arc::new(normal(*mean, *std))).collect();
    let row = |conditions: &Vec<f64>| Row {
        conditions: conditions.clone(),
        distributions: distributions.clone(),
    };
    let variables = sim
        .inputs
        .iter()
        .map(|of| Variable::new(of.quantity.name.as_str(), of.quantity.unit.clone()));
    let rows = simulated.rows.iter().map(row).collect();
    let task = Task::new(sim.model().unwrap(), variables.collect(), rows);
    let observed = bench.outputs.iter().enumerate().map(|(n, (_, _, u))| {
        Some(ObservedOutput {
            values: simulated.values.iter().map(|values| values[n]).collect(),
            last_digit: None,
            standard_uncertainties: Some(vec![*u; simulated.rows.len()]),
            simulation_uncertainties: None,
            simulation_covariance: None,
        })
    });
    let candidates = bench.listed.iter().map(|(name, unit, std, of, text)| {
        let parameter = if text.contains("p0") { "p0" } else { "p" };
        Candidate {
            effect: Effect {
                name: (*name).to_owned(),
                parameters: vec![quantity(parameter, unit)],
                overrides: vec![((*of).to_owned(), Formula::parse(text).unwrap())],
            },
            priors: vec![normal(0.0, *std)],
            about: String::new(),
            source: String::new(),
            simulator: None,
        }
    });
    Case {
        observed: observed.collect(),
        candidates: candidates.collect(),
        model: sim,
        task,
        simulated: 0,
        simulator: None,
        history: Vec::new(),
        shipped: Vec::new(),
        reachable: Vec::new(),
        replication: None,
        prior: Prior::DEFAULT,
    }
}

/// A bench diagnosed, with predictions at the conditions within and outside.
fn diagnosed(bench: &Bench, simulated: &Simulated) -> Diagnosis {
    let case = case_of(bench, simulated);
    let ahead = simulated.within.iter().chain(&simulated.outside);
    let rows: Vec<Row> = ahead
        .map(|(conditions, _)| Row { conditions: conditions.clone(), ..case.task.rows[0].clone() })
        .collect();
    diagnose(&case, Some(&rows), DiagnosisOptions::new(1), &|_| {}).unwrap()
}

/// A composed effect as a candidate, with the priors that it is handed over with.
fn pasted(of: &ComposedEffect) -> Candidate {
    let formulas = of.overrides.iter();
    let prior = |prior: ComposedPrior| -> Distribution {
        match prior {
            ComposedPrior::Normal { mean, std } => normal(mean, std),
            ComposedPrior::Rectangular { lower, upper } => {
                Rectangular::new(0.5 * (lower + upper), 0.5 * (upper - lower)).unwrap().into()
            }
            ComposedPrior::LogUniform { lower, upper } => {
                LogUniform::new(lower, upper).unwrap().into()
            }
        }
    };
    Candidate {
        effect: Effect {
            name: of.name.clone(),
            parameters: of.parameters.iter().map(|p| quantity(&p.name, &p.unit)).collect(),
            overrides: formulas
                .map(|(name, text)| (name.clone(), Formula::parse(text).unwrap()))
                .collect(),
        },
        priors: of.parameters.iter().map(|p| prior(p.prior)).collect(),
        about: String::new(),
        source: String::new(),
        simulator: None,
    }
}

/// One effect of each bench is named: quantity and argument, and the form among the first three. What
/// is composed explains the data once it stands in the list.
fn what_is_withheld_is_named(benches: &[Bench]) {
    for (number, bench) in benches.iter().enumerate() {
        let withheld = &bench.withheld[[0, 3, 0, 2, 0, 3, 2, 3][number]];
        let place = bench.withheld.iter().position(|of| of.name == withheld.name);
        let simulated = simulated(bench, place, 1);
        let found = diagnosed(bench, &simulated);
        let first = found.composed.first().unwrap();
        assert!(
            withheld.is_named_by(first).0,
            "{} {}: {:?}",
            bench.name,
            withheld.name,
            said(first)
        );
        let three = found.composed.iter().take(3);
        assert!(
            three.clone().any(|of| withheld.is_named_by(of).1),
            "{} {}: {:#?}",
            bench.name,
            withheld.name,
            found.composed.iter().map(said).collect::<Vec<_>>()
        );
        let mut case = case_of(bench, &simulated);
        case.candidates.push(pasted(first));
        let again = diagnose(&case, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
        let present = again.present.iter().find(|of| of.effect == first.name).unwrap();
        assert!(present.probability > 0.9, "{} {}: {present:?}", bench.name, withheld.name);
        // and what was said of its size holds: within five standard uncertainties, since the two
        // treat the inputs differently
        let size = present.parameters.iter().find(|of| of.name.ends_with("/k")).unwrap();
        let own = first.parameters.iter().find(|of| of.name == "k").unwrap();
        let far = (size.estimate - own.estimate).abs();
        assert!(
            far < 5.0 * size.standard_uncertainty.max(own.standard_uncertainty),
            "{size:?} {own:?}"
        );
    }
}

#[test]
fn what_is_withheld_is_named_and_explains_once_it_is_listed() {
    what_is_withheld_is_named(&BENCHES[..3]);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn what_is_withheld_of_every_bench_is_named() {
    what_is_withheld_is_named(&BENCHES);
}

/// A data set of a bench with what adds to its first output, on top of a withheld effect or of none.
fn with_another(bench: &Bench, one: Option<usize>, of: impl Fn(&[f64]) -> f64) -> Simulated {
    let mut simulated = simulated(bench, one, 1);
    for (conditions, values) in simulated.rows.iter().zip(&mut simulated.values) {
        values[0] += of(conditions);
    }
    simulated
}

/// Two departures at once are named together: moisture, and an error that decays.
#[test]
fn pairs_are_composed() {
    let bench = BENCHES.iter().find(|bench| bench.name == "balance").unwrap();
    let data = with_another(bench, Some(1), |c| 0.004 * (-c[2] / 15.0).exp());
    let found = diagnosed(bench, &data);
    let first = found.composed.first().unwrap();
    let mut over: Vec<&DepartureOver> = first.terms.iter().map(|term| &term.over).collect();
    over.sort_by_key(|over| format!("{over:?}"));
    let wanted = ["rh", "t"].map(|name| DepartureOver::Condition(name.to_owned()));
    assert_eq!(over, wanted.iter().collect::<Vec<_>>(), "{:?}", first.terms);
    assert!(!first.product, "{first:?}");
    assert!(first.shrunk.removed_fraction > 0.95, "{:?}", first.shrunk);
    // and no two terms in both orders
    let turned = |of: &ComposedEffect| of.terms.iter().rev().cloned().collect::<Vec<_>>();
    for of in found.composed.iter().filter(|of| of.terms.len() == 2) {
        assert!(found.composed.iter().all(|other| other.terms != turned(of)), "{}", of.name);
    }
}

/// A departure that is a product of functions of two conditions is named as one: a non-linearity that
/// grows with the temperature.
#[test]
fn products_are_composed() {
    let bench = BENCHES.iter().find(|bench| bench.name == "torque transducer").unwrap();
    let data = with_another(bench, None, |c| 0.02 * (c[0] / 100.0).powi(3) * (c[1] - 10.0) / 30.0);
    let found = diagnosed(bench, &data);
    let first = found.composed.first().unwrap();
    assert!(first.product && first.terms.len() == 2, "{first:?}");
    let over: Vec<&str> = first.terms.iter().filter_map(|term| term.over.name()).collect();
    assert!(over.contains(&"T"), "{over:?}");
    // the torque, or the signal that follows it
    assert!(over.contains(&"M") || over.contains(&"value"), "{over:?}");
    assert!(first.shrunk.removed_fraction > 0.95, "{:?}", first.shrunk);
    // what it is ready to paste
    let mut case = case_of(bench, &data);
    case.candidates.push(pasted(first));
    let again = diagnose(&case, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
    let present = again.present.iter().find(|of| of.effect == first.name).unwrap();
    assert!(present.probability > 0.9, "{present:?}");
}

/// What the list lacks may come beside what it has.
#[test]
fn a_term_beside_a_listed_effect_is_composed() {
    let bench = BENCHES.iter().find(|bench| bench.name == "encoder").unwrap();
    let data = with_another(bench, Some(0), |_| 0.03);
    let found = diagnosed(bench, &data);
    let beside = found.composed.iter().take(3).find(|of| of.beside == ["zero"]);
    let beside = beside.unwrap_or_else(|| {
        panic!("{:?}", found.composed.iter().map(|of| (&of.name, &of.beside)).collect::<Vec<_>>())
    });
    assert_eq!(said(beside), ["y", "th", "wave"]);
}

/// An effect that ships with the program explains what the list does not.
#[test]
fn unlisted_effects_are_tried() {
    let bench = BENCHES.iter().find(|bench| bench.name == "encoder").unwrap();
    let simulated = simulated(bench, Some(2), 1);
    let mut case = case_of(bench, &simulated);
    let mut seam = case.candidates[0].clone();
    seam.effect.name = "seam".to_owned();
    seam.effect.overrides =
        vec![("y".to_owned(), Formula::parse("y + p*(th > 214 [deg])").unwrap())];
    case.shipped = vec![case.candidates[0].clone(), seam];
    let found = diagnose(&case, None, DiagnosisOptions::new(1), &|_| {}).unwrap();
    let first = found.unlisted.first().unwrap();
    assert_eq!(first.effect, "seam");
    assert!(first.probability > 0.9, "{first:?}");
}

/// Where a wave goes through all angles the gap is not the same along them.
#[test]
fn strength_is_told_along_conditions() {
    let bench = BENCHES.iter().find(|bench| bench.name == "encoder").unwrap();
    let found = diagnosed(bench, &simulated(bench, Some(2), 1));
    let of = &found.strength[0];
    assert_eq!((of.output, of.condition, of.parts.len()), (0, 0, 8));
    let shares: f64 = of.parts.iter().map(|part| part.share_of_gap).sum();
    assert!((shares - 1.0).abs() < 0.1, "{shares}");
    // the seam lies at 214 degrees
    let before: f64 = of.parts[..4].iter().map(|part| part.share_of_gap).sum();
    assert!(before < 0.1, "{before}");
}

/// Without an effect nothing is named. Of 80 such data sets of the study none was, so the rate is not
/// well known: at 1 % the two tests would fail with a probability of 0.15 for other seeds.
fn nothing_is_named(first_seed: u64) {
    for (seed, bench) in (first_seed..).zip(&BENCHES) {
        let found = diagnosed(bench, &simulated(bench, None, seed));
        let most = found.composed.first().map_or(0.0, |of| of.probability);
        assert!(most < 0.5, "{} {seed}: {most}", bench.name);
    }
}

#[test]
fn nothing_is_named_without_a_gap() {
    nothing_is_named(2000);
}

#[test]
#[ignore = "heavy: run by .ci/extra"]
fn nothing_is_named_without_a_gap_of_other_data() {
    nothing_is_named(2008);
}

/// All 32 cases: prints a table. The whole study with its page is `examples/gap_composed.rs`.
#[test]
#[ignore = "heavy: run by .ci/extra"]
fn study() {
    let seed: u64 = std::env::var("DEPARTURE_SEED").map_or(1, |seed| seed.parse().unwrap());
    let free: u64 = std::env::var("DEPARTURE_FREE").map_or(0, |free| free.parse().unwrap());
    let (mut place, mut first, mut third) = (0, 0, 0);
    let mut held = [[0, 0], [0, 0]];
    let started = std::time::Instant::now();
    for bench in &BENCHES {
        for (number, withheld) in bench.withheld.iter().enumerate() {
            let simulated = simulated(bench, Some(number), seed);
            let found = diagnosed(bench, &simulated);
            let rights: Vec<(bool, bool)> =
                found.composed.iter().take(3).map(|of| withheld.is_named_by(of)).collect();
            let marks = [
                rights.first().is_some_and(|of| of.0),
                rights.first().is_some_and(|of| of.1),
                rights.iter().any(|of| of.1),
            ];
            place += usize::from(marks[0]);
            first += usize::from(marks[1]);
            third += usize::from(marks[2]);
            let all = simulated.within.iter().chain(&simulated.outside);
            let mut worst = [0.0_f64; 2];
            for (n, ((_, truth), predicted)) in
                all.zip(found.prediction.as_deref().unwrap()).enumerate()
            {
                let outside = usize::from(n >= simulated.within.len());
                for (truth, (value, u)) in truth.iter().zip(&predicted.outputs) {
                    let z = (value - truth).abs() / u;
                    held[outside][0] += usize::from(z < 2.0);
                    held[outside][1] += 1;
                    worst[outside] = worst[outside].max(z);
                }
            }
            let names: Vec<String> = found
                .composed
                .iter()
                .take(4)
                .map(|of| format!("{:?} {:.2}", said(of), of.probability))
                .collect();
            println!(
                "{} / {}: {marks:?} p {:.3} z {worst:.1?} {}",
                bench.name,
                withheld.name,
                found.hypotheses.iter().find(|h| h.effects.is_none()).unwrap().probability,
                names.join("; ")
            );
        }
    }
    let took = started.elapsed().as_secs_f64() / 32.0;
    println!("place {place} first {first} third {third}; predicted {held:?}; {took:.2} s a case");
    let (mut told, mut named) = (0, 0);
    for number in 0..free {
        let bench = &BENCHES[(number % 8) as usize];
        let found = diagnosed(bench, &simulated(bench, None, 1000 + number));
        let most = found.composed.first().map_or(0.0, |of| of.probability);
        told += usize::from(most > 0.0);
        named += usize::from(most > 0.5);
    }
    println!("free {free}: told {told}, named {named}");
}
