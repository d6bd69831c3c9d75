//! A truth drawn from the hypotheses, and data that it makes at a case's design.

use serde::{Deserialize, Serialize};

use super::drawn_noise::{CheckedNoise, NoiseOfDraw};
use crate::Prior;
use crate::{Case, OverrideError};
use gumption_engine::distribution::StreamKey;
use gumption_engine::number::{COLUMN, Column};
use gumption_inference::data::{Data, Spread};
use gumption_inference::integral::mixture::standard_normals;
use gumption_inference::latent::Map;
use gumption_inference::{correlated, setup};

/// What makes the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TruthKind {
    /// The model alone.
    None,
    /// Effects of the catalogue.
    Catalogue,
    /// An effect that is then taken out of the catalogue.
    Withheld,
    /// Two effects, of which the second is then taken out of the catalogue.
    Beside,
}

/// A sealed truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Its kind.
    pub kind: TruthKind,
    /// Names of the effects.
    pub effects: Vec<String>,
    /// Their parameters, `effect/parameter`, in the parameters' units.
    pub parameters: Vec<(String, f64)>,
    /// For each observed output and row the value without noise.
    pub values: Vec<Vec<f64>>,
    /// Root mean square of what the effects change, in standard uncertainties of the data.
    pub gap: f64,
    /// What the noise is, in words.
    #[serde(default)]
    pub noise: String,
}

impl Truth {
    /// The effect that is taken out of the catalogue, if one is.
    pub fn withheld(&self) -> Option<&str> {
        match self.kind {
            TruthKind::None | TruthKind::Catalogue => None,
            TruthKind::Withheld | TruthKind::Beside => self.effects.last().map(String::as_str),
        }
    }
}

/// Normal scores, one at a time.
pub(super) struct Scores {
    key: StreamKey,
    block: u64,
    column: Column,
    left: usize,
}

impl Scores {
    fn new(seed: u64, number: u64) -> Self {
        let key = StreamKey::new(seed, &format!("gap-check/{number}"));
        Self { key, block: 0, column: Column::ZERO, left: 0 }
    }

    pub(super) fn next(&mut self) -> f64 {
        if self.left == 0 {
            standard_normals(&mut self.key.block(self.block), &mut self.column);
            self.block += 1;
            self.left = COLUMN;
        }
        self.left -= 1;
        self.column.0[self.left]
    }

    /// A number uniform on (0, 1).
    pub(super) fn uniform(&mut self) -> f64 {
        gumption_engine::special::normal::cdf(self.next())
    }

    pub(super) fn choice(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count.saturating_sub(1))
    }
}

/// Draws a truth of a case and the data that it makes; `noise` is the standard deviation of every
/// measured value as it is stated, output by output, and `of_noise` what the noise is drawn as.
///
/// # Errors
/// Effects that cannot act on the model.
pub fn truth(
    case: &Case,
    noise: &[Vec<f64>],
    of_noise: CheckedNoise,
    seed: u64,
    number: u64,
) -> Result<(Truth, Vec<Vec<f64>>), OverrideError> {
    case.check()?;
    if case.simulator.is_some() {
        let reason = "data of a simulator cannot be drawn without running it".to_owned();
        return Err(OverrideError::Case { reason });
    }
    let mut scores = Scores::new(seed, number);
    let drawn = match of_noise {
        CheckedNoise::AsStated => NoiseOfDraw::as_stated(noise.len()),
        CheckedNoise::Uncertain => {
            let observed = || case.observed.iter().flatten();
            let stated = observed().any(|observed| observed.standard_uncertainties.is_some());
            // numbers of its own, so that effects and sizes are those without it
            let mut own = Scores::new(seed, u64::MAX - number);
            NoiseOfDraw::drawn(case.task.rows.len(), noise.len(), stated, &mut own)
        }
    };
    let (kind, effects) = choose(case, drawn.hypotheses(case), &mut scores);
    Ok(make(case, noise, drawn, kind, &effects, scores))
}

/// Data that certain effects make.
#[cfg(test)]
pub(crate) fn truth_with(
    case: &Case,
    noise: &[Vec<f64>],
    effects: &[usize],
    seed: u64,
    number: u64,
) -> (Truth, Vec<Vec<f64>>) {
    let drawn = NoiseOfDraw::as_stated(noise.len());
    make(case, noise, drawn, TruthKind::Catalogue, effects, Scores::new(seed, number))
}

fn make(
    case: &Case,
    noise: &[Vec<f64>],
    mut drawn_noise: NoiseOfDraw,
    kind: TruthKind,
    effects: &[usize],
    mut scores: Scores,
) -> (Truth, Vec<Vec<f64>>) {
    let data = Data::new(case);
    let spread = Spread::new(case, &data);
    let chosen: Vec<_> = effects.iter().map(|&e| &case.candidates[e]).collect();
    let mut parameters = Vec::new();
    for candidate in &chosen {
        for (quantity, prior) in candidate.effect.parameters.iter().zip(&candidate.priors) {
            let name = format!("{}/{}", candidate.effect.name, quantity.name);
            parameters.push((name, drawn(&Map::of(prior), scores.next())));
        }
    }
    let inputs = inputs(case, &data, &spread, &mut scores);
    let with = case.program(effects);
    let without = &case.task.model.program;
    let mut values = vec![Vec::with_capacity(data.rows()); data.outputs.len()];
    let mut measured = values.clone();
    let (mut squares, mut count) = (0.0, 0usize);
    for row in 0..data.rows() {
        let mut variables = inputs[row].clone();
        variables.extend(&case.task.rows[row].conditions);
        let plain = without.evaluate(&variables);
        variables.extend(parameters.iter().map(|(_, value)| *value));
        let changed = with.evaluate(&variables);
        for (place, &output) in data.outputs.iter().enumerate() {
            let u = noise[place][row];
            values[place].push(changed[output]);
            let own = drawn_noise.at(row, place, scores.next());
            measured[place].push(changed[output] + u * own);
            squares += ((changed[output] - plain[output]) / u).powi(2);
            count += 1;
        }
    }
    let names = chosen.iter().map(|candidate| candidate.effect.name.clone()).collect();
    let gap = (squares / count.max(1) as f64).sqrt();
    let noise = drawn_noise.words();
    (Truth { kind, effects: names, parameters, values, gap, noise }, measured)
}

/// The value at the probability of a standard normal score.
fn drawn(map: &Map, normal: f64) -> f64 {
    map.value(map.score_of(normal))
}

/// The hypothesis that is true.
fn choose(case: &Case, prior: Prior, scores: &mut Scores) -> (TruthKind, Vec<usize>) {
    let count = case.candidates.len();
    let explained = prior.none + prior.one + prior.two;
    let place = scores.uniform() * (explained + prior.unexplained);
    let one = scores.choice(count);
    let two = scores.choice(count.saturating_sub(1));
    let other = if two >= one { two + 1 } else { two };
    if count == 0 || place < prior.none {
        (TruthKind::None, Vec::new())
    } else if place < prior.none + prior.one {
        (TruthKind::Catalogue, vec![one])
    } else if place < explained && count > 1 {
        (TruthKind::Catalogue, vec![one.min(other), one.max(other)])
    } else if place < explained + (1.0 - BESIDE) * prior.unexplained || count < 2 {
        (TruthKind::Withheld, vec![one])
    } else {
        (TruthKind::Beside, vec![one, other])
    }
}

/// Of truths with an effect that is taken out so many have another one that is not.
const BESIDE: f64 = 0.5;

/// The inputs' true values in every row.
fn inputs(case: &Case, data: &Data, spread: &Spread, scores: &mut Scores) -> Vec<Vec<f64>> {
    let variables = case.task.variables.len();
    let shared = (0..variables).filter(|&v| spread.shared[v].is_none());
    let mut independent = vec![Vec::new(); variables];
    for v in shared {
        independent[v] = vec![scores.next(); data.rows()];
    }
    for (v, groups) in spread.shared.iter().enumerate() {
        if let Some(groups) = groups {
            let levels = groups.iter().max().map_or(0, |most| most + 1);
            let of_level: Vec<f64> = (0..levels).map(|_| scores.next()).collect();
            independent[v] = groups.iter().map(|&group| of_level[group]).collect();
        }
    }
    // correlated variables have their values in common over the same rows
    let all: Vec<usize> = (0..variables).collect();
    let root = correlated::root(case, &all);
    let mixed = |v: usize, row: usize| match &root {
        Some(root) => (0..=v).map(|j| root[(v, j)] * independent[j][row]).sum(),
        None => independent[v][row],
    };
    let mut inputs = vec![vec![0.0; variables]; data.rows()];
    for v in 0..variables {
        let maps = setup::maps(case, data, v);
        let own: Vec<f64> = (0..data.rows()).map(|row| mixed(v, row)).collect();
        for (row, score) in own.into_iter().enumerate() {
            let map = if maps.len() > 1 { &maps[data.point_of[row]] } else { &maps[0] };
            inputs[row][v] = drawn(map, score);
        }
    }
    inputs
}
