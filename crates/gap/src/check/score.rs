//! Answers compared with the truths that were sealed.

use serde::{Deserialize, Serialize};

use super::truth::{Truth, TruthKind};
use crate::Case;
use crate::ModelSelection;
use crate::diagnosis::{Hypothesis, HypothesisKind};
use gumption_engine::number::{ascending, elementary, median};

/// A correction is within the uncertainties if its errors are, in the root mean square.
const WITHIN: f64 = 1.0;

/// Bins of the reliability curve.
const BINS: usize = 10;

/// Below this gap, in standard uncertainties, no claim of a fraction is made.
const MEANINGFUL: f64 = 3.0;

/// The result of one blind draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlindDraw {
    /// The true label: effects joined by `+`, without one that was withheld; `none`, or `unexplained` where
    /// the only one was withheld.
    pub truth: String,
    /// The effect that was withheld.
    pub withheld: Option<String>,
    /// Where another effect was not withheld, the probability that it was given to be there.
    #[serde(default)]
    pub listed_present: Option<f64>,
    /// The label of the verdict.
    pub said: String,
    /// Probability of the verdict.
    pub probability: f64,
    /// Probability that was given to the true label.
    pub of_truth: f64,
    /// Sum over the hypotheses of squared errors of their probabilities.
    pub brier: f64,
    /// Whether the verdict is the truth, or (where the effect was withheld) a name that predicts
    /// within the uncertainties.
    pub right: bool,
    /// For each parameter of the truth, where the verdict names exactly its effects that were not withheld,
    /// whether the interval holds the true value.
    pub held: Vec<bool>,
    /// Root mean square of what the effects change, in standard uncertainties.
    pub gap: f64,
    /// Root mean square error of the corrected prediction over that of the model, without noise.
    pub left: f64,
    /// Claimed and true removed fraction, where the gap is large enough.
    pub fractions: Option<[f64; 2]>,
    /// The true parameters.
    pub parameters: Vec<(String, f64)>,
    /// The true effects.
    pub effects: Vec<String>,
    /// The effects of the verdict.
    pub named: Vec<String>,
}

/// How often a truth was diagnosed as something.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Confusion {
    /// The true label.
    pub truth: String,
    /// The label of the verdict.
    pub said: String,
    /// How often.
    pub count: usize,
}

/// Verdicts given with about the same probability.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reliability {
    /// Their mean probability.
    pub probability: f64,
    /// The share that was right.
    pub fraction: f64,
    /// How many.
    pub count: usize,
}

impl Reliability {
    /// The 95 % interval of the share (Wilson).
    pub fn interval(&self) -> [f64; 2] {
        wilson((self.fraction * self.count as f64).round() as usize, self.count)
    }
}

/// The size of an effect's parameter at which it is found with 90 % probability.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SmallestEffect {
    /// `effect/parameter`.
    pub parameter: String,
    /// Unit.
    pub unit: String,
    /// The value; `None` where the draws do not tell.
    pub value_at_90_percent: Option<f64>,
    /// The gap that it makes, in standard uncertainties.
    pub gap_at_90_percent: Option<f64>,
}

/// The scores of a blind check.
#[derive(Clone, Debug)]
pub struct BlindCheckScores {
    /// Number of draws.
    pub draws: usize,
    /// Seed of the truths.
    pub seed: u64,
    /// Share of right verdicts.
    pub top1: f64,
    /// Its 95 % interval (Wilson).
    pub top1_interval: [f64; 2],
    /// Mean Brier score.
    pub brier: f64,
    /// Mean logarithm of the probability of the truth.
    pub mean_log_probability: f64,
    /// Share of gap-free data in which a gap was found.
    pub false_alarms: f64,
    /// Number of gap-free data sets.
    pub gap_free: usize,
    /// Truth against verdict.
    pub confusion: Vec<Confusion>,
    /// Reliability of the probabilities of verdicts.
    pub reliability: Vec<Reliability>,
    /// Mean distance of probabilities from shares, over the bins.
    pub calibration_error: f64,
    /// The median of that error for a perfect diagnosis with as many draws and these probabilities.
    pub perfect_calibration_error: f64,
    /// Share of intervals that hold the true parameter.
    pub interval_coverage: f64,
    /// Number of intervals.
    pub intervals: usize,
    /// Median of the gap that is left over the gap before.
    pub left: f64,
    /// Share of corrections that are worse than none.
    pub worse_than_none: f64,
    /// Mean of claimed less true removed fraction.
    pub claim_bias: f64,
    /// For each parameter the smallest size that is found.
    pub smallest: Vec<SmallestEffect>,
    /// Truths of two effects of which one was withheld.
    pub beside: BesideScores,
    /// Every draw.
    pub checked: Vec<BlindDraw>,
}

/// What was said of an effect beside another one that had been taken out of the list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct BesideScores {
    /// How many such truths were drawn.
    pub drawn: usize,
    /// In how many of them the verdict names the effect that is in the list.
    pub listed_effect_named: usize,
    /// In how many it is given a probability below 0.01.
    pub lost: usize,
}

/// An effect with less than this probability is lost.
const LOST: f64 = 0.01;

impl BesideScores {
    fn of(checked: &[BlindDraw]) -> Self {
        let drawn: Vec<(&BlindDraw, f64)> =
            checked.iter().filter_map(|one| Some((one, one.listed_present?))).collect();
        let named = |one: &BlindDraw| {
            let listed = |name: &&String| one.withheld.as_ref() != Some(*name);
            one.effects.iter().filter(listed).all(|name| one.named.contains(name))
        };
        Self {
            drawn: drawn.len(),
            listed_effect_named: drawn.iter().filter(|(one, _)| named(one)).count(),
            lost: drawn.iter().filter(|(_, present)| *present < LOST).count(),
        }
    }
}

impl BlindCheckScores {
    /// Number of gap-free data sets in which a gap was found.
    pub fn alarms(&self) -> usize {
        self.checked.iter().filter(|one| one.truth == "none" && one.said != "none").count()
    }

    /// The 95 % interval of the share of false alarms (Wilson).
    pub fn false_alarms_interval(&self) -> [f64; 2] {
        wilson(self.alarms(), self.gap_free)
    }
}

/// The label of a list of effects.
fn label(effects: &[String]) -> String {
    if effects.is_empty() {
        return "none".to_owned();
    }
    let mut sorted = effects.to_vec();
    sorted.sort();
    sorted.join("+")
}

impl BlindDraw {
    /// Compares a selection with the truth; `sim` and `noise` are what the model says and the standard
    /// deviations of the noise, output by output.
    pub fn new(
        truth: &Truth,
        selected: &ModelSelection,
        sim: &[Vec<f64>],
        noise: &[Vec<f64>],
    ) -> Self {
        let withheld = truth.withheld();
        let listed: Vec<String> =
            truth.effects.iter().filter(|name| Some(name.as_str()) != withheld).cloned().collect();
        let of_truth = match truth.kind {
            TruthKind::Withheld => "unexplained".to_owned(),
            _ => label(&listed),
        };
        let said = match selected.most_probable.kind {
            HypothesisKind::Unexplained => "unexplained".to_owned(),
            _ => label(&selected.most_probable.effects),
        };
        let name = |effects: &Option<Vec<String>>| {
            effects.as_deref().map_or_else(|| "unexplained".to_owned(), label)
        };
        let mut brier = 0.0;
        let mut probability_of_truth = 0.0;
        for hypothesis in &selected.hypotheses {
            let true_one = name(&hypothesis.effects) == of_truth;
            brier += (hypothesis.probability - f64::from(u8::from(true_one))).powi(2);
            if true_one {
                probability_of_truth = hypothesis.probability;
            }
        }
        let (mut before, mut after, mut normalized, mut count) = (0.0, 0.0, 0.0, 0usize);
        for (output, values) in truth.values.iter().enumerate() {
            for (row, &value) in values.iter().enumerate() {
                let (predicted, u) = selected.predicted[row].outputs[output];
                let noise = noise[output][row];
                before += ((value - sim[output][row]) / noise).powi(2);
                after += ((value - predicted) / noise).powi(2);
                normalized += (value - predicted).powi(2) / (u * u + noise * noise);
                count += 1;
            }
        }
        let n = count.max(1) as f64;
        let within = (normalized / n).sqrt() <= WITHIN;
        let right = said == of_truth || withheld.is_some() && within;
        let held = if said == of_truth && !listed.is_empty() {
            let own = selected.hypotheses.iter().find(|h| name(&h.effects) == of_truth);
            let interval = |parameter: &String| {
                own?.parameters.iter().find(|p| p.name == *parameter).map(|p| p.interval)
            };
            truth
                .parameters
                .iter()
                .filter_map(|(parameter, value)| {
                    interval(parameter).map(|[lower, upper]| lower <= *value && *value <= upper)
                })
                .collect()
        } else {
            Vec::new()
        };
        let large = before / n >= MEANINGFUL * MEANINGFUL && truth.kind != TruthKind::None;
        Self {
            withheld: withheld.map(str::to_owned),
            listed_present: (truth.kind == TruthKind::Beside).then(|| {
                let holds = |h: &&Hypothesis| {
                    let own = h.effects.as_ref();
                    own.is_some_and(|own| listed.iter().all(|name| own.contains(name)))
                };
                let holding = selected.hypotheses.iter().filter(holds);
                holding.map(|h| h.probability).sum::<f64>().min(1.0)
            }),
            truth: of_truth,
            said,
            probability: selected.most_probable.probability,
            of_truth: probability_of_truth,
            brier,
            right,
            held,
            gap: truth.gap,
            left: if before > 0.0 { (after / before).sqrt() } else { 0.0 },
            fractions: large.then(|| [selected.claimed_fraction, 1.0 - after / before]),
            parameters: truth.parameters.clone(),
            effects: truth.effects.clone(),
            named: selected.most_probable.effects.clone(),
        }
    }
}

/// The scores of all draws.
pub fn score(case: &Case, checked: Vec<BlindDraw>, seed: u64) -> BlindCheckScores {
    let draws = checked.len();
    let n = draws.max(1) as f64;
    let mean = |values: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = values.fold((0.0, 0usize), |(sum, count), v| (sum + v, count + 1));
        if count == 0 { 0.0 } else { sum / count as f64 }
    };
    let right = checked.iter().filter(|c| c.right).count();
    let free: Vec<&BlindDraw> = checked.iter().filter(|c| c.truth == "none").collect();
    let mut confusion: Vec<Confusion> = Vec::new();
    for one in &checked {
        match confusion.iter_mut().find(|c| c.truth == one.truth && c.said == one.said) {
            Some(known) => known.count += 1,
            None => confusion.push(Confusion {
                truth: one.truth.clone(),
                said: one.said.clone(),
                count: 1,
            }),
        }
    }
    confusion.sort_by(|a, b| (&a.truth, b.count, &a.said).cmp(&(&b.truth, a.count, &b.said)));
    let verdicts: Vec<(f64, bool)> = checked.iter().map(|c| (c.probability, c.right)).collect();
    let reliability = reliability(&verdicts);
    let held: Vec<bool> = checked.iter().flat_map(|c| c.held.clone()).collect();
    let with_gap: Vec<&BlindDraw> = checked.iter().filter(|c| c.truth != "none").collect();
    BlindCheckScores {
        draws,
        seed,
        top1: right as f64 / n,
        top1_interval: wilson(right, draws),
        brier: mean(&mut checked.iter().map(|c| c.brier)),
        mean_log_probability: mean(
            &mut checked.iter().map(|c| elementary::ln(c.of_truth.max(1e-6))),
        ),
        false_alarms: mean(&mut free.iter().map(|c| f64::from(u8::from(c.said != "none")))),
        gap_free: free.len(),
        calibration_error: calibration_error(&reliability, draws),
        perfect_calibration_error: perfect(&verdicts, seed),
        reliability,
        interval_coverage: mean(&mut held.iter().map(|held| f64::from(u8::from(*held)))),
        intervals: held.len(),
        left: median(with_gap.iter().map(|c| c.left).collect()).unwrap_or(0.0),
        worse_than_none: mean(&mut with_gap.iter().map(|c| f64::from(u8::from(c.left > 1.0)))),
        claim_bias: mean(&mut checked.iter().filter_map(|c| c.fractions).map(|[a, b]| a - b)),
        smallest: smallest(case, &checked),
        beside: BesideScores::of(&checked),
        confusion,
        checked,
    }
}

/// The interval of Wilson (1927) for a share, at 95 %.
fn wilson(count: usize, of: usize) -> [f64; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    if of == 0 {
        return [0.0, 1.0];
    }
    let (n, p) = (of as f64, count as f64 / of as f64);
    let middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt() / (1.0 + Z * Z / n);
    [(middle - half).max(0.0), (middle + half).min(1.0)]
}

fn reliability(verdicts: &[(f64, bool)]) -> Vec<Reliability> {
    (0..BINS)
        .filter_map(|bin| {
            let inside: Vec<&(f64, bool)> = verdicts
                .iter()
                .filter(|(p, _)| ((p * BINS as f64) as usize).min(BINS - 1) == bin)
                .collect();
            let count = inside.len();
            (count > 0).then(|| Reliability {
                probability: inside.iter().map(|(p, _)| p).sum::<f64>() / count as f64,
                fraction: inside.iter().filter(|(_, right)| *right).count() as f64 / count as f64,
                count,
            })
        })
        .collect()
}

fn calibration_error(reliability: &[Reliability], draws: usize) -> f64 {
    let of_bin = |bin: &Reliability| bin.count as f64 * (bin.probability - bin.fraction).abs();
    reliability.iter().map(of_bin).sum::<f64>() / draws.max(1) as f64
}

/// The median calibration error if every verdict were right with its probability.
fn perfect(verdicts: &[(f64, bool)], seed: u64) -> f64 {
    const REPEATS: usize = 400;
    let mut stream =
        gumption_engine::distribution::StreamKey::new(seed, "gap-check/perfect").block(0);
    let mut uniform = [0.0; 128];
    let mut left = 0;
    let mut errors: Vec<f64> = (0..REPEATS)
        .map(|_| {
            let drawn: Vec<(f64, bool)> = verdicts
                .iter()
                .map(|(p, _)| {
                    if left == 0 {
                        stream.uniform(&mut uniform);
                        left = uniform.len();
                    }
                    left -= 1;
                    (*p, uniform[left] < *p)
                })
                .collect();
            calibration_error(&reliability(&drawn), drawn.len())
        })
        .collect();
    ascending(&mut errors);
    errors.get(REPEATS / 2).copied().unwrap_or(0.0)
}

/// For each effect the gap at which it is found with 90 % probability, by logistic regression on the
/// logarithm of the gap, and the size of each parameter that makes such a gap.
fn smallest(case: &Case, checked: &[BlindDraw]) -> Vec<SmallestEffect> {
    let mut smallest = Vec::new();
    for candidate in &case.candidates {
        let name = &candidate.effect.name;
        let own: Vec<&BlindDraw> = checked
            .iter()
            .filter(|c| c.withheld.is_none() && c.effects == [name.clone()] && c.gap > 0.0)
            .collect();
        let found: Vec<(f64, bool)> =
            own.iter().map(|c| (elementary::ln(c.gap), c.named.contains(name))).collect();
        let ln_gap = at_ninety_percent(&found);
        for quantity in &candidate.effect.parameters {
            let parameter = format!("{name}/{}", quantity.name);
            let value = |c: &BlindDraw| {
                c.parameters.iter().find(|(known, _)| *known == parameter).map(|(_, value)| *value)
            };
            let sizes: Vec<(f64, f64)> = own
                .iter()
                .filter_map(|c| {
                    Some((
                        elementary::ln(value(c)?.abs().max(f64::MIN_POSITIVE)),
                        elementary::ln(c.gap),
                    ))
                })
                .collect();
            smallest.push(SmallestEffect {
                unit: quantity.unit.text().to_owned(),
                value_at_90_percent: ln_gap.and_then(|ln_gap| inverse(&sizes, ln_gap)),
                gap_at_90_percent: ln_gap.map(elementary::exp),
                parameter,
            });
        }
    }
    smallest
}

/// Where a logistic curve reaches 0.9. A weak normal prior on its two coefficients keeps it finite
/// where all draws are found or none.
fn at_ninety_percent(found: &[(f64, bool)]) -> Option<f64> {
    let (yes, no) = (found.iter().filter(|f| f.1).count(), found.iter().filter(|f| !f.1).count());
    if yes < 3 || no < 1 {
        return None;
    }
    let (mut a, mut b) = (0.0, 1.0);
    for _ in 0..100 {
        let (mut ga, mut gb) = (-a / 100.0, -(b - 1.0) / 9.0);
        let (mut haa, mut hab, mut hbb) = (0.01, 0.0, 1.0 / 9.0);
        for &(x, yes) in found {
            let p = 1.0 / (1.0 + elementary::exp(-(a + b * x)));
            let error = f64::from(u8::from(yes)) - p;
            let weight = p * (1.0 - p);
            ga += error;
            gb += error * x;
            haa += weight;
            hab += weight * x;
            hbb += weight * x * x;
        }
        let det = haa * hbb - hab * hab;
        let (da, db) = ((hbb * ga - hab * gb) / det, (haa * gb - hab * ga) / det);
        a += da.clamp(-2.0, 2.0);
        b += db.clamp(-2.0, 2.0);
        if da.abs() + db.abs() < 1e-10 {
            break;
        }
    }
    let ln_gap = (elementary::ln(9f64) - a) / b;
    (b > 0.0 && ln_gap.is_finite()).then_some(ln_gap)
}

/// The size at which a gap is made, by a straight line through logarithms; `None` where the size says
/// little of the gap.
fn inverse(sizes: &[(f64, f64)], ln_gap: f64) -> Option<f64> {
    let n = sizes.len() as f64;
    if sizes.len() < 5 {
        return None;
    }
    let (mx, my) =
        (sizes.iter().map(|s| s.0).sum::<f64>() / n, sizes.iter().map(|s| s.1).sum::<f64>() / n);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in sizes {
        xx += (x - mx).powi(2);
        xy += (x - mx) * (y - my);
        yy += (y - my).powi(2);
    }
    let coefficient = xy / (xx * yy).sqrt();
    if coefficient.is_nan() || coefficient.abs() <= 0.7 {
        return None;
    }
    let value = elementary::exp(mx + (ln_gap - my) * xx / xy);
    value.is_finite().then_some(value)
}
