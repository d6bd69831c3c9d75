//! What reports of a diagnosis look like, and that their numbers are those of the JSON answer.

mod check;
mod csv;
mod departure;
mod html;
mod table;

use serde_json::Value;

use crate::Provenance;
use gumption_engine::fact;
use gumption_engine::task::ModelStatement;
use gumption_gap::{
    DepartureForm, DepartureKind, DepartureOver, DepartureShape, DescribedEffect, Diagnosis,
    DiagnosisNote, EffectParameter, EstimatedNoise, GapPart, GapRegion, GapShare, GapTest,
    Hypothesis, HypothesisKind, LeftBeside, MostProbable, NamedQuantity, NextMeasurements,
    NoiseEstimate, Predicted, PresentEffect, PriorConflict, ProposalKind, ProposedMeasurement,
    ReplicatedEffect, ReplicatedEffects, RowGap, SerialCorrelation, Shrinkage, Shrunk,
    SuspectValue, UncertaintyFactor, ValueGap,
};

fn named(name: &str, unit: &str) -> NamedQuantity {
    NamedQuantity { name: name.to_owned(), unit: unit.to_owned() }
}

fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn parameter(name: &str, unit: &str, [estimate, u, low, high]: [f64; 4]) -> EffectParameter {
    EffectParameter {
        name: name.to_owned(),
        unit: unit.to_owned(),
        estimate,
        standard_uncertainty: u,
        interval: [low, high],
    }
}

fn hypothesis(
    effects: Option<&[&str]>,
    figures: [f64; 5],
    parameters: Vec<EffectParameter>,
) -> Hypothesis {
    let [prior, probability, log_evidence, standard_error, effective_sample_size] = figures;
    let effects = effects.map(strings);
    Hypothesis {
        effects,
        beside: false,
        prior,
        probability,
        log_evidence,
        standard_error,
        effective_sample_size,
        best_log_likelihood: 0.0,
        fitted: parameters.len(),
        parameters,
    }
}

/// Rows over a frequency in octaves and two tilts; the gap grows with the frequency.
fn rows(count: usize) -> Vec<RowGap> {
    let row = |number: usize| {
        let f = 0.5 * 2_f64.powi((number / 2) as i32 % 10);
        let tilt = [0.0, 35.0][number % 2];
        // a fixed pattern in place of noise
        let noise = 0.03 * ((number * 7 % 11) as f64 - 5.0);
        let value = |gap: f64| ValueGap {
            measured: 5.0 + gap + noise,
            u: 0.05,
            before: gap + noise,
            u_before: 0.06,
            u_validation: 0.06,
            after: noise,
            u_after: 0.055,
            left: noise,
            u_corrected: 0.01,
        };
        RowGap { conditions: vec![f, tilt], outputs: vec![value(0.004 * f), value(0.0)] }
    };
    (0..count).map(row).collect()
}

/// Stated uncertainties that are too small, with a value that is off, and estimated ones.
fn noise() -> Vec<NoiseEstimate> {
    let mut stated = NoiseEstimate::new(0);
    let probability = 0.912_345;
    stated.factor =
        Some(UncertaintyFactor { estimate: 1.9234, interval: [1.6123, 2.3456], probability });
    stated.suspects = vec![SuspectValue { row: 6, probability: 0.991_234, size: -8.1234 }];
    stated.serial =
        Some(SerialCorrelation { estimate: 0.8765, interval: [0.71, 0.95], probability: 0.61 });
    let mut estimated = NoiseEstimate::new(1);
    estimated.estimated = Some(EstimatedNoise { standard_uncertainty: 0.051_234, power: 0.25 });
    vec![stated, estimated]
}

/// Candidates with everything that is said of them, and with nothing.
fn candidates() -> Vec<DescribedEffect> {
    let mut low_pass = DescribedEffect::new("low-pass");
    low_pass.about = "An amplifier of first order.".to_owned();
    low_pass.source = "a book on amplifiers".to_owned();
    low_pass.overrides = vec![("a_x".to_owned(), "a_x/sqrt(1 + (f/fc)^2)".to_owned())];
    low_pass.parameters = vec![["fc".into(), "Hz".into(), "cut-off frequency".into()]];
    vec![low_pass, DescribedEffect::new("delay")]
}

/// Proposals of every kind.
fn next() -> NextMeasurements {
    let proposal = |kind, [count, rows]: [usize; 2], loss| {
        let mut proposal = ProposedMeasurement::new(kind);
        proposal.count = count;
        proposal.expected_entropy_loss = loss;
        proposal.count_for_20_to_1 = (rows > 0).then_some(rows);
        proposal
    };
    let mut next = NextMeasurements::default();
    next.entropy = 0.5432;
    next.separates = Some([Some(strings(&["low-pass"])), Some(strings(&["low-pass", "delay"]))]);
    next.proposals = vec![
        proposal(
            ProposalKind::Outside { conditions: vec![300.123_456_789, 35.0] },
            [4, 12],
            0.4321,
        ),
        proposal(ProposalKind::Repeats { conditions: vec![256.0, 0.0] }, [4, 40], 0.3),
        proposal(
            ProposalKind::Input {
                input: named("a_ref", "m/s^2"),
                standard_uncertainty: 0.002,
                stated: 0.01,
            },
            [1, 0],
            0.2,
        ),
        proposal(
            ProposalKind::Output {
                output: named("phase", "deg"),
                conditions: vec![1.0, 0.0],
                standard_uncertainty: 0.5,
            },
            [4, 0],
            0.15,
        ),
        proposal(ProposalKind::Row { conditions: vec![256.0, 0.0] }, [1, 40], 0.1),
    ];
    next.equivalent = vec![vec![strings(&["low-pass"]), strings(&["slow amplifier"])]];
    next
}

/// A diagnosis with everything in it.
fn diagnosis() -> Diagnosis {
    let low_pass =
        || parameter("low-pass/fc", "Hz", [46.319_515, 1.372_947, 43.600_42, 48.749_874]);
    let delay = parameter("delay/tau", "ms", [-0.012_345, 0.004_567, -0.021_5, -0.003_2]);
    let shrunk = |rms_before, rms_after, noise_floor, removed_fraction| Shrunk {
        rms_before,
        rms_after,
        noise_floor,
        removed_fraction,
    };
    Diagnosis {
        title: "Two outputs of a bench".to_owned(),
        source: "a bench of two".to_owned(),
        sim: ModelStatement::of_formulas([
            ("a_x".to_owned(), "g*sin(tilt)".to_owned()),
            ("ratio".to_owned(), "a_x/a_r".to_owned()),
        ]),
        outputs: vec![named("a_x", "m/s^2"), named("ratio", "")],
        conditions: vec![named("f", "Hz"), named("tilt", "deg")],
        history: 0..0,
        gap: GapTest { present: true, p_value: Some(8.836_58e-47), chi2: 346.237_98, dof: 40.0 },
        candidates: candidates(),
        interrupted: false,
        row_count: 20,
        regions: vec![
            GapRegion {
                output: Some(0),
                range: Some((0, [64.0, 256.0])),
                p_value: 5.413_141e-49,
                share_of_gap: 0.984_827,
                mean_z: 4.022_039,
            },
            GapRegion {
                output: None,
                range: None,
                p_value: 0.0123,
                share_of_gap: 0.1234,
                mean_z: -0.567,
            },
        ],
        most_probable: MostProbable {
            kind: HypothesisKind::Explained,
            effects: strings(&["low-pass"]),
            prior_conflict: true,
            beside: None,
            probability: 0.877_777_86,
            indistinguishable: vec![strings(&["low-pass"]), strings(&["low-pass", "delay"])],
            indistinguishable_probability: 0.987_777_86,
        },
        hypotheses: vec![
            hypothesis(
                Some(&["low-pass"]),
                [0.078_571, 0.877_777_86, 63.091_823, 0.027_252, 215.104],
                vec![low_pass()],
            ),
            hypothesis(
                Some(&["low-pass", "delay"]),
                [0.007_142_857, 0.11, 62.313_915, 0.112_549, 71.58],
                vec![low_pass(), delay],
            ),
            hypothesis(None, [0.15, 0.012, 55.209_461, 0.0, 0.0], vec![]),
            hypothesis(Some(&[]), [0.15, 0.000_222_14, -1_234.567_89, 0.005_43, 60.0], vec![]),
            hypothesis(Some(&["delay"]), [0.078_571, 3.1e-54, -2000.0, 0.5, 99.0], vec![]),
        ],
        shrinkage: Shrinkage {
            all: shrunk(4.489_181, 1.061_558, 1.053_037, 0.999_054),
            outputs: vec![
                shrunk(0.343_56, 0.066_662, 0.059_902, 0.992_524),
                shrunk(0.111_315, 0.053_378, 0.059_902, 0.987),
            ],
            rms_after_interval: [0.851_58, 1.262_605],
            claimed_fraction: 0.998_283,
            meaningful: true,
            chi2_per_dof: [13.784_69, 1.018_084],
            within: [0.5, 0.958_333],
            log_density_gain: 162.715_87,
            blocks: 6,
            values: 40_000,
            shares: Vec::new(),
        },
        next: next(),
        prediction: Some(vec![
            Predicted {
                conditions: vec![1.0, 0.0],
                outputs: vec![(2.065_512, 0.006_01), (1.0, 0.1)],
                model: vec![2.1, 1.0],
            },
            Predicted {
                conditions: vec![400.0, 35.0],
                outputs: vec![(1561.2, 13.4), (1.1, 0.12)],
                model: vec![1580.0, 1.2],
            },
        ]),
        rows: rows(20),
        noise: noise(),
        present: vec![PresentEffect {
            effect: "low-pass".into(),
            probability: 0.987_777_86,
            parameters: vec![low_pass()],
        }],
        simulator: None,
        replication: Some(ReplicatedEffects {
            condition: named("device", ""),
            groups: vec![1.0, 2.0],
            effects: vec![ReplicatedEffect {
                effect: "low-pass".into(),
                probability_shared: 0.61,
                probability_own: 0.31,
                by_ratios: true,
                sizes: vec![low_pass(), low_pass()],
                spread: Some(parameter("low-pass/fc", "", [0.123, 0.045, 0.05, 0.21])),
            }],
        }),
        departure: Vec::new(),
        composed: Vec::new(),
        unlisted: Vec::new(),
        strength: Vec::new(),
        prior_conflicts: vec![PriorConflict {
            effect: "low-pass".into(),
            effects: vec!["low-pass".into()],
            parameter: low_pass(),
            prior_distance: 6.1234,
            bounded: false,
            widened: 10.0,
            probability: 0.81,
        }],
        notes: vec![DiagnosisNote { fact: fact!("few-conditions", count = 3_usize) }],
        probability: 0.95,
        seed: 1,
    }
}

/// A diagnosis whose names are long and hostile.
fn hostile() -> Diagnosis {
    let mut hostile = diagnosis();
    let name = |text: &str| {
        format!(
            "{text}<script>alert('&amp;')</script>\"\u{1b}[31m\u{202e}{}",
            "long-name ".repeat(9)
        )
    };
    hostile.title = name("title");
    (hostile.source, hostile.sim.source) = (name("source"), name("model"));
    hostile.sim.name = Some(name("typed"));
    hostile.sim.equations.iter_mut().for_each(|(of, formula)| *formula = name(of));
    for named in hostile.outputs.iter_mut().chain(&mut hostile.conditions) {
        *named = NamedQuantity { name: name(&named.name).replace(' ', "_"), unit: name("unit") };
    }
    for hypothesis in &mut hostile.hypotheses {
        for effect in hypothesis.effects.iter_mut().flatten() {
            *effect = name(effect);
        }
        for parameter in &mut hypothesis.parameters {
            parameter.name = name(&parameter.name);
            parameter.unit = name("unit");
        }
    }
    for candidate in &mut hostile.candidates {
        candidate.name = name(&candidate.name);
        candidate.about = name("about");
        candidate.overrides.iter_mut().for_each(|(of, formula)| *formula = name(of));
    }
    let groups = hostile.most_probable.indistinguishable.iter_mut().flatten();
    for effect in groups.chain(&mut hostile.most_probable.effects) {
        *effect = name(effect);
    }
    let next = &mut hostile.next;
    let separated = next.separates.iter_mut().flatten().flatten().flatten();
    let equivalent = next.equivalent.iter_mut().flatten().flatten();
    separated.chain(equivalent).for_each(|effect| *effect = name(effect));
    hostile.notes[0].fact = fact!("few-conditions", count = name("note"));
    hostile
}

/// What is hardly there: one row, no conditions, nothing estimated, nothing finite.
fn bare() -> Diagnosis {
    let mut bare = diagnosis();
    bare.title = String::new();
    bare.source = String::new();
    bare.sim = ModelStatement::default();
    bare.conditions.clear();
    bare.regions.clear();
    bare.gap = GapTest { present: false, p_value: None, chi2: f64::NAN, dof: 0.0 };
    bare.most_probable = MostProbable {
        prior_conflict: false,
        beside: None,
        kind: HypothesisKind::None,
        effects: Vec::new(),
        probability: 1.0,
        indistinguishable: vec![Vec::new()],
        indistinguishable_probability: 1.0,
    };
    bare.hypotheses =
        vec![hypothesis(Some(&[]), [1.0, 1.0, f64::NEG_INFINITY, f64::INFINITY, 0.0], vec![])];
    bare.rows = rows(1);
    bare.rows[0].conditions.clear();
    for value in &mut bare.rows[0].outputs {
        *value = ValueGap {
            u: 0.0,
            before: 0.0,
            u_before: 0.0,
            u_validation: 0.0,
            after: 0.0,
            u_after: 0.0,
            ..*value
        };
    }
    let nothing =
        Shrunk { rms_before: 0.0, rms_after: 0.0, noise_floor: 0.0, removed_fraction: 0.0 };
    bare.shrinkage.all = nothing;
    bare.shrinkage.outputs = vec![nothing; 2];
    bare.shrinkage.rms_after_interval = [0.0, 0.0];
    bare.shrinkage.meaningful = false;
    bare.next = NextMeasurements::default();
    bare.prediction = Some(Vec::new());
    bare.noise.clear();
    bare.present.clear();
    bare.candidates.clear();
    bare.replication = None;
    bare.prior_conflicts.clear();
    bare.notes.clear();
    bare
}

/// The verdict "unexplained".
fn unexplained() -> Diagnosis {
    let mut unexplained = diagnosis();
    unexplained.most_probable = MostProbable {
        prior_conflict: false,
        beside: None,
        kind: HypothesisKind::Unexplained,
        effects: Vec::new(),
        probability: 0.99,
        indistinguishable: Vec::new(),
        indistinguishable_probability: 0.99,
    };
    unexplained.next = NextMeasurements::default();
    unexplained.departure = vec![
        DepartureForm {
            outputs: strings(&["a_x"]),
            kind: DepartureKind::Proportional,
            common: true,
            over: DepartureOver::Condition("f".to_owned()),
            shape: DepartureShape::Step { at: 71.5, up: false },
            scale: Some(3.456),
            logarithmic: true,
            scale_unit: "Hz".to_owned(),
            size: 0.012_345,
            unit: String::new(),
            beside: strings(&["delay"]),
            probability: 0.912_345,
        },
        DepartureForm {
            outputs: strings(&["a_x", "ratio"]),
            kind: DepartureKind::Additive,
            common: false,
            over: DepartureOver::Value,
            shape: DepartureShape::Rising,
            scale: Some(4.567),
            logarithmic: false,
            scale_unit: "m/s^2".to_owned(),
            size: 0.123_45,
            unit: "m/s^2".to_owned(),
            beside: Vec::new(),
            probability: 0.067_89,
        },
    ];
    unexplained
}

/// Low-pass and delay with something left beside them.
fn with_something_beside() -> Diagnosis {
    let mut beside = diagnosis();
    let form = unexplained().departure.remove(1);
    beside.departure = vec![DepartureForm { beside: strings(&["low-pass", "delay"]), ..form }];
    let share = |what: GapPart, share_of_gap: f64| GapShare { what, share_of_gap };
    beside.shrinkage.shares = vec![
        share(GapPart::Effect("low-pass".to_owned()), 0.912_345),
        share(GapPart::Effect("delay".to_owned()), 0.056_789),
        share(GapPart::Departure, 0.023_456),
        share(GapPart::Noise, 0.007_41),
    ];
    beside.most_probable = MostProbable {
        kind: HypothesisKind::Explained,
        effects: strings(&["low-pass", "delay"]),
        prior_conflict: false,
        probability: 0.987_654,
        beside: Some(LeftBeside {
            probability: 0.976_543,
            form: beside.departure[0].clone(),
            share_of_gap: 0.023_456,
        }),
        indistinguishable: vec![strings(&["low-pass", "delay"])],
        indistinguishable_probability: 0.987_654,
    };
    for (of, probability) in beside.hypotheses.iter_mut().zip([0.01, 0.987_654]) {
        of.probability = probability;
        of.beside = probability > 0.5;
    }
    beside
}

/// A record of many rows.
fn many() -> Diagnosis {
    let mut many = diagnosis();
    many.rows = rows(6000);
    for (number, row) in many.rows.iter_mut().enumerate() {
        row.conditions[0] = 1e-3 * number as f64;
    }
    many
}

fn provenance() -> Provenance {
    Provenance {
        model_sha256: "0123abcd".to_owned(),
        files: vec![("data.csv".to_owned(), "4567".to_owned())],
    }
}

fn json(diagnosis: &Diagnosis) -> Value {
    serde_json::from_str(&super::json(diagnosis)).unwrap()
}

/// Whether a printed number is the exact one, rounded once to the digits that are printed.
#[track_caller]
fn assert_rounded(printed: &str, exact: &Value) {
    let exact = exact.as_f64().unwrap_or_else(|| panic!("{exact} for {printed}"));
    let read: f64 = printed.parse().unwrap_or_else(|_| panic!("`{printed}` for {exact}"));
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len()) as i32;
    let exponent: i32 = exponent.parse().unwrap();
    let mut place = exponent - decimals;
    // zeros at the end of a whole number may stand for digits that are not given
    if decimals == 0 {
        place += mantissa.len() as i32 - mantissa.trim_end_matches('0').len() as i32;
    }
    let half = 0.5 * 10_f64.powi(place);
    assert!((read - exact).abs() <= half * (1.0 + 1e-9), "`{printed}` for {exact}");
    assert!(printed == "0" || read != 0.0 || exact.abs() <= half, "`{printed}` for {exact}");
}

/// Compares the cells of the tables with the JSON answer; `cells` gives the cells of the line that
/// begins with a text, numbers only.
fn assert_agreement(answer: &Value, cells: &dyn Fn(&str) -> Vec<String>) {
    let check = |line: &str, exact: &[&Value]| {
        let cells = cells(line);
        assert_eq!(cells.len(), exact.len(), "{line}: {cells:?}");
        for (printed, exact) in cells.iter().zip(exact) {
            assert_rounded(printed, exact);
        }
    };
    for (place, letter) in ["A", "B"].iter().enumerate() {
        let region = &answer["where"][place];
        check(letter, &[&region["p_value"], &region["share_of_gap"], &region["mean_z"]]);
    }
    for (place, name) in ["low-pass", "low-pass + delay"].iter().enumerate() {
        let own = &answer["hypotheses"][place];
        let keys = ["prior", "probability", "log_evidence", "standard_error", "ess"];
        check(name, &keys.map(|key| &own[key]));
    }
    let own = &answer["hypotheses"][2];
    check("unexplained", &["prior", "probability", "log_evidence"].map(|key| &own[key]));
    let own = &answer["hypotheses"][0]["parameters"]["low-pass/fc"];
    let [low, high] = [0, 1].map(|end| &own["interval"][end]);
    check("low-pass/fc", &[&own["estimate"], &own["standard_uncertainty"], low, high]);
    let shrinks = &answer["shrinks"];
    let keys = ["rms_before", "rms_after", "noise_floor", "removed_fraction"];
    check("rms residual, all outputs", &keys.map(|key| &shrinks[key]));
    for name in ["a_x", "ratio"] {
        let own = &shrinks["outputs"][name];
        check(&format!("rms residual of {name}"), &keys.map(|key| &own[key]));
    }
    let pair = |of: &str| ["before", "after"].map(|when| &shrinks[format!("{of}_{when}")]);
    check("chi-square per degree of freedom", &pair("chi2_per_dof"));
    check("share of values with |En| <= 1", &pair("within"));
}

/// Compares what the sentences say with the JSON answer.
fn assert_sentences(answer: &Value, text: &str) {
    let after = |words: &str| {
        let rest = text.split_once(words).unwrap_or_else(|| panic!("`{words}` in {text}")).1;
        let rest = rest.trim_start();
        let end = rest.find([' ', ')', ',', ';']).unwrap_or(rest.len());
        rest[..end].trim_end_matches('.').to_owned()
    };
    assert_rounded(&after("explains it (probability"), &answer["verdict"]["probability"]);
    let group = &answer["verdict"]["group_probability"];
    assert_rounded(&after("Together they have the probability"), group);
    assert_rounded(&after("in variances of the repeats with"), &answer["gap"]["dof"]);
    assert_rounded(&after("sum of squares"), &answer["gap"]["chi2"]);
    assert_rounded(&after("degrees of freedom, p ="), &answer["gap"]["p_value"]);
    let shrinks = &answer["shrinks"];
    assert_rounded(&after("of all outputs is between"), &shrinks["rms_after_interval"][0]);
    assert_rounded(&after("and 1"), &serde_json::json!(0.26)); // 1.26, the other end
    assert_rounded(&after("left-out values increases by"), &shrinks["log_density_gain"]);
    assert_rounded(&after("is expected to be"), &shrinks["claimed_fraction"]);
    assert_rounded(&after("without its own block of conditions ("), &shrinks["blocks"]);
    let next = &answer["next_measurement"][0];
    assert_rounded(&after("Most informative next step:"), &next["count"]);
    assert_rounded(&after("rows at f ="), &next["conditions"]["f"]);
    assert_rounded(&after("entropy of their probabilities:"), &answer["entropy"]);
    let noise = &answer["noise"]["ratio"];
    assert_rounded(&after("Estimated noise of ratio:"), &noise["standard_uncertainty"]);
    assert_rounded(&after("proportional to its power"), &noise["power"]);
}
