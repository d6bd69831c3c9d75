//! What to measure next: what is expected to lower the entropy of the probabilities of all hypotheses
//! most.
//!
//! Proposals are compared at the same number of rows, the smallest that is expected to halve the
//! entropy at the best place. What is measured at one place is told by its mean, so that a proposal of
//! many rows costs no more than one of a single row.

use gumption_engine::parallel;

use super::composed::Compositions;
use super::diagnosis::{NamedQuantity, NextMeasurements, ProposalKind, ProposedMeasurement};
use super::shrink;
use gumption_engine::number::{elementary, largest_first, median, smallest_first};
use gumption_engine::special::normal;
use gumption_engine::task::Sharing;
use gumption_inference::beside::Beside;
use gumption_inference::discrepancy::{Discrepancy, Unexplained};
use gumption_inference::equivalent;
use gumption_inference::expected_entropy::{Detail, Normals, Outlook, expected_loss, ln_odds};
use gumption_inference::posterior::Posterior;
use gumption_inference::predict::{self, Predictor, Values};
use gumption_inference::reachable::{self, Place};
use gumption_inference::setup::Setup;

/// Draws of each hypothesis.
const DRAWS: usize = 64;

/// Hypotheses that are told apart, at most, and the least probability of one.
const MOST_HYPOTHESES: usize = 12;
const LEAST_PROBABILITY: f64 = 2e-3;

/// Places that are looked at closely for each of the roughly tried numbers of rows.
const FINALISTS: usize = 4;
const ROUGHLY: [usize; 3] = [1, 8, 64];

/// Numbers of rows that a proposal may have.
const COUNTS: [usize; 13] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 100];

/// Below this entropy, in nats, there is nothing to decide: odds of 500 to 1.
const DECIDED: f64 = 0.015;

/// Wanted odds.
const ODDS: f64 = 20.0;

/// No number of rows above this is proposed.
const MOST_ROWS: usize = 1_000_000;

/// A calibration lowers the standard uncertainty of an input to this share.
const CALIBRATED: f64 = 0.2;

/// What lowers the entropy by a smaller share is no proposal.
const WORTH_PROPOSING: f64 = 0.01;

/// Calibrations and other outputs that are proposed, at most.
const MOST_OTHERS: usize = 3;

/// A hypothesis as what it says of measurements not yet made.
pub(crate) struct PredictiveHypothesis {
    /// Its effects; `None` for a departure without any.
    pub(crate) effects: Option<Vec<String>>,
    /// Its probability.
    pub(crate) probability: f64,
    /// For each place and observed output draws of the value.
    pub(crate) values: Values,
    /// For each place the same of the outputs that were not observed; none where it says nothing of
    /// them.
    pub(crate) unobserved: Option<Values>,
    /// For each input that is an unknown quantity draws of its score, in standard deviations of what
    /// is stated.
    pub(crate) inputs: Vec<Vec<f64>>,
}

/// Everything that proposals are made from. `rivals` are places of hypotheses: the verdict (`None` for
/// "unexplained") and the one to tell it from; `variances` are those of the noise by value.
pub(crate) fn next(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    compositions: &Compositions,
    rivals: Option<[Option<usize>; 2]>,
    variances: &[f64],
    seed: u64,
) -> NextMeasurements {
    let separates = rivals.map(|pair| {
        pair.map(|place| {
            let hypothesis = posterior.hypotheses.get(place?)?;
            Some(setup.effect_names(&hypothesis.effects))
        })
    });
    let places = reachable::places(setup);
    let (departures, composed) = departures(setup, discrepancy, posterior, compositions, &places);
    let entropy = match &departures[..] {
        [] => entropy_of(posterior),
        parts => {
            let alone = posterior.hypotheses.iter().map(|h| h.probability);
            entropy_of_parts(alone.chain(parts.iter().map(|part| part.probability)))
        }
    };
    let equivalent = equivalent::groups(setup, posterior, &places, variances);
    let mut proposals = Vec::new();
    if entropy > DECIDED && !places.is_empty() {
        let hypotheses = predictive(setup, posterior, departures, &places);
        let same = separates.as_ref().is_some_and(|pair| {
            let of = |one: &Option<Vec<String>>| {
                equivalent.iter().position(|group| one.as_ref().is_some_and(|e| group.contains(e)))
            };
            of(&pair[0]).is_some() && of(&pair[0]) == of(&pair[1])
        });
        let pair = separates.as_ref().filter(|_| !same);
        let prospects = Prospects::new(setup, &places, &hypotheses, pair, variances, seed);
        proposals = prospects.proposals(entropy);
    }
    let without_range = reachable::without_range(setup);
    NextMeasurements { entropy, composed, separates, proposals, equivalent, without_range }
}

/// Entropy of the probabilities of all hypotheses, in nats; what is composed is not told apart.
pub(crate) fn entropy_of(posterior: &Posterior) -> f64 {
    let probabilities = posterior.named().map(|h| h.probability);
    entropy_of_parts(probabilities.chain([posterior.probability]))
}

fn entropy_of_parts(probabilities: impl Iterator<Item = f64>) -> f64 {
    probabilities.map(|p| if p > 0.0 { -p * elementary::ln(p) } else { 0.0 }).sum()
}

/// A part of what a departure without a name may be.
struct DeparturePart {
    /// The effects that it acts beside; `None` where there are none.
    effects: Option<Vec<String>>,
    probability: f64,
    /// What it says at the places.
    normals: predict::Normals,
}

/// What a departure without a name may be: the composed ones one by one, of which the number is given as
/// well, and then all that is only known to be smooth, without effects and beside those that it acts
/// beside.
fn departures(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
    compositions: &Compositions,
    places: &[Place],
) -> (Vec<DeparturePart>, usize) {
    let departs = posterior.departs();
    if departs <= LEAST_PROBABILITY {
        return (Vec::new(), 0);
    }
    let rows: Vec<_> = places.iter().map(|place| place.row.clone()).collect();
    let composed = compositions.predictions(setup, &rows).into_iter();
    let part = |(share, normals): (f64, predict::Normals)| {
        (share * departs > LEAST_PROBABILITY).then_some(DeparturePart {
            effects: None,
            probability: share * departs,
            normals,
        })
    };
    let mut parts: Vec<DeparturePart> = composed.filter_map(part).collect();
    let composed = parts.len();
    let smooth = 1.0 - parts.iter().map(|part| part.probability).sum::<f64>() / departs;
    let beside = posterior.beside.iter().map(|Beside { named, departure }| {
        (Some(setup.effect_names(&named.effects)), named.probability, departure)
    });
    let alone = (None, posterior.probability, &posterior.unexplained);
    for (effects, probability, Unexplained { kinds, .. }) in [alone].into_iter().chain(beside) {
        let probability = smooth * probability;
        if probability > LEAST_PROBABILITY && !kinds.is_empty() {
            let normals = discrepancy.predict(setup, shrink::top(kinds), &rows, &[]);
            parts.push(DeparturePart { effects, probability, normals });
        }
    }
    (parts, composed)
}

/// The outputs of the model that were not observed.
fn unobserved(setup: &Setup<'_>) -> Vec<usize> {
    let observed = setup.case.observed.iter().enumerate();
    observed.filter(|(_, observed)| observed.is_none()).map(|(output, _)| output).collect()
}

/// The hypotheses of a posterior, and the departures without a name, with what they say at some places.
fn predictive(
    setup: &Setup<'_>,
    posterior: &Posterior,
    departures: Vec<DeparturePart>,
    places: &[Place],
) -> Vec<PredictiveHypothesis> {
    let rows: Vec<_> = places.iter().map(|place| place.row.clone()).collect();
    let others = unobserved(setup);
    let mut leading: Vec<usize> = (0..posterior.hypotheses.len())
        .filter(|&h| {
            let hypothesis = &posterior.hypotheses[h];
            hypothesis.probability > LEAST_PROBABILITY && hypothesis.evidence.has_draws()
        })
        .collect();
    largest_first(&mut leading, |&a| posterior.hypotheses[a].probability);
    leading.truncate(MOST_HYPOTHESES);
    let mut hypotheses = parallel::map(leading, |h| {
        let hypothesis = &posterior.hypotheses[h];
        let draws = hypothesis.evidence.resampled(DRAWS);
        let of = |outputs: &[usize]| {
            Predictor::new(setup, &hypothesis.effects, &rows, outputs).values(&draws)
        };
        let input = |place: usize| draws.iter().map(|draw| draw[place]).collect();
        PredictiveHypothesis {
            effects: Some(setup.effect_names(&hypothesis.effects)),
            probability: hypothesis.probability,
            values: of(&setup.data.outputs),
            unobserved: (!others.is_empty()).then(|| of(&others)),
            inputs: (0..setup.unknown_inputs.len()).map(input).collect(),
        }
    });
    let scores: Vec<f64> =
        (0..DRAWS).map(|n| normal::quantile((n as f64 + 0.5) / DRAWS as f64)).collect();
    let draws = |&(mean, variance): &(f64, f64)| -> Vec<f64> {
        scores.iter().map(|score| mean + variance.sqrt() * score).collect()
    };
    hypotheses.extend(departures.into_iter().map(|part| PredictiveHypothesis {
        effects: part.effects,
        probability: part.probability,
        values: part.normals.iter().map(|row| row.iter().map(draws).collect()).collect(),
        unobserved: None,
        // what a departure says of inputs is no more than was known of them
        inputs: vec![scores.clone(); setup.unknown_inputs.len()],
    }));
    let turns = &setup.data.turns;
    unwrap(&mut hypotheses, turns);
    hypotheses
}

/// Phases within half a turn of the first hypothesis, so that their means mean something.
fn unwrap(hypotheses: &mut [PredictiveHypothesis], turns: &[Option<f64>]) {
    let reference: Vec<Vec<f64>> = match hypotheses.first() {
        Some(first) => first
            .values
            .iter()
            .map(|row| row.iter().map(|draws| draws.first().copied().unwrap_or(0.0)).collect())
            .collect(),
        None => return,
    };
    for hypothesis in hypotheses {
        for (row, reference) in hypothesis.values.iter_mut().zip(&reference) {
            for ((draws, reference), turn) in row.iter_mut().zip(reference).zip(turns) {
                let Some(turn) = turn else { continue };
                for value in draws {
                    *value -= turn * ((*value - reference) / turn).round();
                }
            }
        }
    }
}

/// Variances of what is measured at a place, by output.
#[derive(Clone, Debug)]
struct NoiseAt {
    /// What every row has of its own.
    own: Vec<f64>,
    /// What all rows at the place share.
    shared: Vec<f64>,
}

impl NoiseAt {
    /// Of the mean of so many rows.
    fn of_mean(&self, count: usize) -> Vec<f64> {
        self.own.iter().zip(&self.shared).map(|(own, shared)| own / count as f64 + shared).collect()
    }
}

/// What can be measured.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Target {
    /// All observed outputs at a place.
    Place(usize),
    /// One that was not observed, by its number among them.
    Output(usize, usize),
    /// An input, by its number among the unknown ones.
    Input(usize),
}

/// The hypotheses and what can be measured.
struct Prospects<'p> {
    setup: &'p Setup<'p>,
    places: &'p [Place],
    hypotheses: &'p [PredictiveHypothesis],
    /// The verdict and its rival among the hypotheses.
    pair: Option<[usize; 2]>,
    noise: Vec<NoiseAt>,
    /// The same for outputs that were not observed.
    other_noise: Vec<NoiseAt>,
    others: Vec<usize>,
    normals: Normals,
}

impl<'p> Prospects<'p> {
    fn new(
        setup: &'p Setup<'p>,
        places: &'p [Place],
        hypotheses: &'p [PredictiveHypothesis],
        pair: Option<&[Option<Vec<String>>; 2]>,
        variances: &[f64],
        seed: u64,
    ) -> Self {
        let others = unobserved(setup);
        let find = |effects: &Option<Vec<String>>| {
            hypotheses.iter().position(|hypothesis| hypothesis.effects == *effects)
        };
        let pair = pair.and_then(|[own, rival]| Some([find(own)?, find(rival)?]));
        let noise = places.iter().map(|place| noise_at(setup, place, variances)).collect();
        let relative = relative_uncertainty(setup, variances);
        let other_noise =
            places.iter().map(|place| other_noise_at(setup, place, &others, relative)).collect();
        let normals = Normals::new(seed, setup.data.outputs.len());
        Self { setup, places, hypotheses, pair, noise, other_noise, others, normals }
    }

    /// What a hypothesis says of a target; `None` where it says nothing.
    fn outlook(&self, of: &'p PredictiveHypothesis, target: Target) -> Option<Outlook<'p>> {
        let draws = match target {
            Target::Place(place) => of.values.get(place)?.as_slice(),
            Target::Output(output, place) => {
                std::slice::from_ref(of.unobserved.as_ref()?.get(place)?.get(output)?)
            }
            Target::Input(input) => std::slice::from_ref(of.inputs.get(input)?),
        };
        let finite = draws.iter().flatten().all(|value| value.is_finite());
        finite.then_some(Outlook { probability: of.probability, draws })
    }

    /// Variances of the noise of a target after so many measurements.
    fn noise(&self, target: Target, count: usize) -> Vec<f64> {
        match target {
            Target::Place(place) => self.noise[place].of_mean(count),
            Target::Output(output, place) => {
                vec![self.other_noise[place].of_mean(count)[output]]
            }
            Target::Input(_) => vec![CALIBRATED * CALIBRATED / count as f64],
        }
    }

    fn loss(&self, target: Target, count: usize, detail: Detail) -> f64 {
        let outlooks: Vec<Outlook<'p>> = self
            .hypotheses
            .iter()
            .filter_map(|hypothesis| self.outlook(hypothesis, target))
            .collect();
        let noise = self.noise(target, count);
        if outlooks.len() < 2 || noise.iter().any(|v| v.is_nan() || *v <= 0.0 || v.is_infinite()) {
            return 0.0;
        }
        expected_loss(&outlooks, &noise, &self.normals, detail)
    }

    /// The most promising of some targets.
    fn finalists(&self, targets: &[Target]) -> Vec<Target> {
        let mut chosen: Vec<Target> = Vec::new();
        for count in ROUGHLY {
            let loss = |&target: &Target| (self.loss(target, count, Detail::Normal), target);
            let mut ranked = parallel::map(targets, loss);
            ranked.retain(|(loss, _)| loss.is_finite());
            largest_first(&mut ranked, |a| a.0);
            for (_, target) in ranked.into_iter().take(FINALISTS) {
                if !chosen.contains(&target) {
                    chosen.push(target);
                }
            }
        }
        chosen
    }

    /// The best of some targets with so many measurements.
    fn best(&self, targets: &[Target], count: usize) -> Option<(f64, Target)> {
        let loss = |&target: &Target| (self.loss(target, count, Detail::Kernels), target);
        parallel::map(targets, loss).into_iter().rev().max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// After how many measurements odds of 20 to 1 for the truth are as likely as not.
    fn count_for_odds(&self, target: Target) -> Option<usize> {
        let [own, rival] = self.pair?;
        let reached = |count: usize| {
            let outlook = |place: usize| self.outlook(self.hypotheses.get(place)?, target);
            let outlooks = [outlook(own)?, outlook(rival)?];
            let noise = self.noise(target, count);
            if noise.iter().any(|v| v.is_nan() || *v <= 0.0) {
                return None;
            }
            let odds = ln_odds(outlooks, &noise, &self.normals);
            let wanted = elementary::ln(ODDS);
            let share: f64 =
                odds.iter().filter(|(ln, _)| *ln >= wanted).map(|(_, weight)| weight).sum();
            Some(share >= 0.5)
        };
        if matches!(target, Target::Input(_)) {
            return reached(1)?.then_some(1);
        }
        let mut high = 1;
        while !reached(high)? {
            if high >= MOST_ROWS {
                return None;
            }
            high = (2 * high).min(MOST_ROWS);
        }
        let mut low = high / 2;
        while high - low > 1 && high - low > low / 50 {
            let middle = low + (high - low) / 2;
            if reached(middle)? {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high)
    }

    /// Everything worth proposing, best first; `entropy` is what there is to learn.
    fn proposals(&self, entropy: f64) -> Vec<ProposedMeasurement> {
        let of_places = |outside: bool| -> Vec<Target> {
            let places = self.places.iter().enumerate();
            places.filter(|(_, p)| p.outside == outside).map(|(n, _)| Target::Place(n)).collect()
        };
        let inside = self.finalists(&of_places(false));
        let outside = self.finalists(&of_places(true));
        let others: Vec<Vec<Target>> = (0..self.others.len().min(MOST_OTHERS))
            .map(|output| {
                let all = (0..self.places.len()).map(|place| Target::Output(output, place));
                self.finalists(&all.collect::<Vec<_>>())
            })
            .collect();
        let count = self.halving(&[inside.clone(), outside.clone()].concat(), entropy);
        let mut found: Vec<(f64, Target, usize)> = Vec::new();
        let mut add = |targets: &[Target], count: usize| {
            found.extend(self.best(targets, count).map(|(loss, target)| (loss, target, count)));
        };
        add(&inside, 1);
        if count > 1 {
            add(&inside, count);
        }
        add(&outside, count);
        for targets in &others {
            add(targets, count);
        }
        let inputs = 0..self.setup.unknown_inputs.len();
        let mut inputs: Vec<(f64, Target, usize)> = inputs
            .map(Target::Input)
            .map(|target| (self.loss(target, 1, Detail::Kernels), target, 1))
            .collect();
        largest_first(&mut inputs, |a| a.0);
        found.extend(inputs.into_iter().take(MOST_OTHERS));
        found.retain(|(loss, ..)| *loss > WORTH_PROPOSING * entropy);
        smallest_first(&mut found, |(_, _, count)| *count as f64);
        largest_first(&mut found, |(loss, ..)| *loss);
        found
            .into_iter()
            .filter_map(|(loss, target, count)| {
                Some(ProposedMeasurement {
                    kind: self.kind(target, count)?,
                    count,
                    expected_entropy_loss: loss,
                    count_for_20_to_1: self.count_for_odds(target),
                })
            })
            .collect()
    }

    /// The smallest number of rows at one place that is expected to halve the entropy; where none
    /// does, the one from which on more rows teach little.
    fn halving(&self, targets: &[Target], entropy: f64) -> usize {
        let most = COUNTS[COUNTS.len() - 1];
        let loss = |count: usize| self.best(targets, count).map_or(0.0, |(loss, _)| loss);
        let wanted = (0.5 * entropy).min(0.75 * loss(most));
        let enough = COUNTS.partition_point(|&count| count < most && loss(count) < wanted);
        COUNTS.get(enough).copied().unwrap_or(most)
    }

    fn kind(&self, target: Target, count: usize) -> Option<ProposalKind> {
        let measured = self.setup.case.measured();
        let conditions = |place: usize| {
            let of_row = self.places[place].row.conditions.iter();
            of_row.take(measured).copied().collect::<Vec<f64>>()
        };
        Some(match target {
            Target::Place(place) if self.places[place].outside => {
                ProposalKind::Outside { conditions: conditions(place) }
            }
            Target::Place(place) if count == 1 => {
                ProposalKind::Row { conditions: conditions(place) }
            }
            Target::Place(place) => ProposalKind::Repeats { conditions: conditions(place) },
            Target::Output(output, place) => {
                let of = &self.setup.case.model.outputs[self.others[output]].quantity;
                ProposalKind::Output {
                    output: named(&of.name, &of.unit),
                    conditions: conditions(place),
                    standard_uncertainty: self.other_noise[place].own[output].sqrt(),
                }
            }
            Target::Input(input) => {
                let variable = *self.setup.unknown_inputs.get(input)?;
                let of = &self.setup.case.task.variables[variable];
                let stated =
                    self.places.first()?.row.distributions[variable].standard_uncertainty();
                ProposalKind::Input {
                    input: named(&of.name, &of.unit),
                    standard_uncertainty: CALIBRATED * stated,
                    stated,
                }
            }
        })
    }
}

fn named(name: &str, unit: &gumption_units::Unit) -> NamedQuantity {
    NamedQuantity { name: name.to_owned(), unit: unit.text().to_owned() }
}

/// The noise of the observed outputs at a place: that of the nearest measured points, and of inputs
/// that are not unknown quantities of their own.
fn noise_at(setup: &Setup<'_>, place: &Place, variances: &[f64]) -> NoiseAt {
    let NoiseAt { own, shared } = of_inputs(setup, place, &setup.data.outputs);
    let of_rows = |output: usize| place.noise(setup, variances, output);
    let own = own.into_iter().enumerate().map(|(output, own)| own + of_rows(output)).collect();
    NoiseAt { own, shared }
}

/// What inputs that are not unknown quantities of their own add to outputs at a place.
fn of_inputs(setup: &Setup<'_>, place: &Place, outputs: &[usize]) -> NoiseAt {
    let known = |v: usize| !setup.unknown_inputs.contains(&v);
    let of_row = |v: usize| matches!(setup.case.task.variables[v].sharing, Sharing::Row);
    NoiseAt {
        own: predict::variances_of(setup, &place.row, outputs, |v| known(v) && of_row(v)),
        shared: predict::variances_of(setup, &place.row, outputs, |v| known(v) && !of_row(v)),
    }
}

/// The least relative standard uncertainty of the observed outputs: what an output that was not
/// observed is taken to be measured with.
fn relative_uncertainty(setup: &Setup<'_>, variances: &[f64]) -> f64 {
    let data = &setup.data;
    let outputs = data.outputs.len();
    let of = |output: usize| {
        let relative = (0..data.rows()).map(|row| {
            let size = data.points[data.point_of[row]].nominal[output].abs();
            variances[row * outputs + output].sqrt() / size
        });
        median(relative.filter(|relative| relative.is_finite()).collect()).unwrap_or(f64::NAN)
    };
    (0..outputs).map(of).filter(|relative| *relative > 0.0).fold(f64::INFINITY, f64::min)
}

/// The noise that outputs which were not observed are taken to have at a place.
fn other_noise_at(setup: &Setup<'_>, place: &Place, outputs: &[usize], relative: f64) -> NoiseAt {
    if outputs.is_empty() {
        return NoiseAt { own: Vec::new(), shared: Vec::new() };
    }
    let variables = place.row.estimates();
    let (values, _) = setup.case.gradients(&variables);
    let NoiseAt { own, shared } = of_inputs(setup, place, outputs);
    let own =
        outputs.iter().zip(own).map(|(&output, own)| own + (relative * values[output]).powi(2));
    NoiseAt { own: own.collect(), shared }
}
