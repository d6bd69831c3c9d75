//! What the data say of their noise, over all hypotheses.

use super::parameters::equal_tails;
use crate::UncertaintyFactor;
use gumption_engine::number::{COLUMN, elementary, smallest_first};
use gumption_inference::latent::Role;
use gumption_inference::logarithm::ln_add;
use gumption_inference::noise::noise_model::Suspect;
use gumption_inference::noise::remainder::Remainder;
use gumption_inference::noise::shared_noise::{RATIOS, Setting};
use gumption_inference::noise::shared_noise_search::Groups;
use gumption_inference::noise::weighing::Weighing;
use gumption_inference::noise::weighings::serial_gain;
use gumption_inference::setup::Setup;

/// Hypotheses below this probability do not contribute to the factor.
const LEAST: f64 = 1e-3;

/// What is known of the noise of the data.
#[derive(Clone, Debug, Default)]
pub(crate) struct WeighedNoise {
    /// What the stated uncertainties of outputs are to be multiplied by.
    pub(crate) factors: Vec<WeighedFactor>,
    /// Which outputs of a row share noise.
    pub(crate) correlations: Vec<WeighedCorrelation>,
    /// Values that may be off, with their probabilities.
    pub(crate) suspects: Vec<(Suspect, f64)>,
    /// Probability that neighbouring rows share noise, and draws of their coefficient of correlation,
    /// if they do, with weights that sum to one.
    pub(crate) serial: Option<(f64, Vec<(f64, f64)>)>,
    /// For each output the error that the rows of each setting share, where it may have one.
    pub(crate) settings: Vec<Option<WeighedSettings>>,
}

/// What is known of a factor on the stated uncertainties of an observed output.
#[derive(Clone, Debug)]
pub(crate) struct WeighedFactor {
    pub(crate) output: usize,
    /// Probability that they are off by a factor.
    pub(crate) probability: f64,
    /// Draws of it, if they are, with weights that sum to one, smallest first.
    pub(crate) draws: Vec<(f64, f64)>,
}

/// What is known of the correlation of the noise of two observed outputs of a row.
#[derive(Clone, Debug)]
pub(crate) struct WeighedCorrelation {
    pub(crate) outputs: [usize; 2],
    /// Probability that they are correlated.
    pub(crate) probability: f64,
    /// Draws of the coefficient, if they are, with weights that sum to one, smallest first.
    pub(crate) draws: Vec<(f64, f64)>,
}

/// What is known of an error that the rows of each setting share.
#[derive(Clone, Debug)]
pub(crate) struct WeighedSettings {
    /// What is set, most probably.
    pub(crate) setting: Setting,
    /// Probability that there is such an error, whatever is set.
    pub(crate) probability: f64,
    /// Draws of its standard deviation in standard uncertainties of the noise, if there is one, with
    /// weights that sum to one.
    pub(crate) ratios: Vec<(f64, f64)>,
    /// The root mean square of those, in the output's unit.
    pub(crate) typical: f64,
}

impl WeighedNoise {
    pub(crate) fn of(weighings: &[Weighing<'_>]) -> Self {
        let mut weighed = Self::default();
        let outputs = weighings.first().map_or(0, |w| w.setup.data.outputs.len());
        for output in 0..outputs {
            if let Some((probability, draws)) = joined(weighings, |w| factor(w, output)) {
                weighed.factors.push(WeighedFactor { output, probability, draws });
            }
            for other in output + 1..outputs {
                let found = joined(weighings, |w| correlation(w, [output, other]));
                if let Some((probability, draws)) = found {
                    let outputs = [output, other];
                    weighed.correlations.push(WeighedCorrelation { outputs, probability, draws });
                }
            }
        }
        weighed.serial = serial(weighings);
        weighed.settings = settings(weighings);
        for weighing in weighings {
            for &suspect in &weighing.setup.data.noise.suspects {
                let Suspect { id, output, .. } = suspect;
                match weighed.suspects.iter_mut().find(|(known, ..)| known.is_of(id, output)) {
                    Some((_, known)) => *known = (*known + weighing.probability).min(1.0),
                    None => weighed.suspects.push((suspect, weighing.probability)),
                }
            }
        }
        weighed
    }

    /// For each output the expected variance of noise that neighbouring rows or those of a setting
    /// share; `variances` are those of the noise by value. Nobody can tell it from a departure of the
    /// model itself, so that a prediction is uncertain by it.
    pub(crate) fn shared(&self, setup: &Setup<'_>, variances: &[f64]) -> Vec<f64> {
        let serial = self.serial.as_ref().map_or(0.0, |(probability, draws)| {
            probability * draws.iter().map(|(r, weight)| r * weight).sum::<f64>()
        });
        let outputs = setup.data.outputs.len();
        let of = |output: usize| {
            let own: Vec<f64> = variances.iter().skip(output).step_by(outputs).copied().collect();
            let neighbours = serial * own.iter().sum::<f64>() / own.len().max(1) as f64;
            let settings = self.settings.get(output).and_then(Option::as_ref);
            neighbours + settings.map_or(0.0, WeighedSettings::variance)
        };
        (0..outputs).map(of).collect()
    }

    /// The factor of an output's stated uncertainties, given that they are off: its geometric mean and
    /// an interval with equal tails; and the probability that they are.
    pub(crate) fn factor(&self, output: usize, coverage: f64) -> Option<UncertaintyFactor> {
        let WeighedFactor { probability, draws, .. } =
            self.factors.iter().find(|factor| factor.output == output)?;
        let ln: f64 = draws.iter().map(|(factor, w)| w * elementary::ln(*factor)).sum();
        let interval = equal_tails(draws, coverage);
        Some(UncertaintyFactor {
            estimate: elementary::exp(ln),
            interval,
            probability: *probability,
        })
    }
}

/// The probability of the weighings that have something, and draws of it in all of them, with weights that
/// sum to one.
fn joined(
    weighings: &[Weighing<'_>],
    of: impl Fn(&Weighing<'_>) -> Option<Vec<(f64, f64)>>,
) -> Option<(f64, Vec<(f64, f64)>)> {
    let with: Vec<(&Weighing<'_>, Vec<(f64, f64)>)> =
        weighings.iter().filter_map(|weighing| Some((weighing, of(weighing)?))).collect();
    let all = with.iter().map(|(w, _)| w.ln_weight()).fold(f64::NEG_INFINITY, ln_add);
    let probability = with.iter().map(|(w, _)| w.probability).sum::<f64>().min(1.0);
    let mut draws = Vec::new();
    for (weighing, own) in &with {
        let share = elementary::exp(weighing.ln_weight() - all);
        draws.extend(own.iter().map(|(value, weight)| (*value, share * weight)));
    }
    smallest_first(&mut draws, |a| a.0);
    (!draws.is_empty()).then_some((probability, draws))
}

/// Draws of the coefficient of correlation of the noise of two outputs of a row.
fn correlation(weighing: &Weighing<'_>, [one, other]: [usize; 2]) -> Option<Vec<(f64, f64)>> {
    let common = weighing.setup.data.noise.common.as_ref()?;
    let between = common.between(one, other);
    let of = |shift: f64| elementary::tanh(elementary::atanh(between) + shift);
    (between != 0.0).then(|| normal_draws(common.spread, of))
}

/// Draws of a function of a normal quantity with mean 0 and this standard deviation, with weights that sum to
/// one.
fn normal_draws(deviation: f64, of: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let score = |n: usize| FARTHEST * ((2 * n + 1) as f64 / GRID as f64 - 1.0);
    let scores: Vec<f64> = (0..GRID).map(score).collect();
    let ln: Vec<f64> = scores.iter().map(|score| -0.5 * score * score).collect();
    normalized(scores.into_iter().map(|score| of(deviation * score)).collect(), &ln)
}

/// Scores of a normal quantity that are drawn.
const FARTHEST: f64 = 5.0;

impl WeighedSettings {
    /// The expected variance of the error in a setting.
    fn variance(&self) -> f64 {
        let squares: f64 = self.ratios.iter().map(|(ratio, weight)| weight * ratio * ratio).sum();
        self.probability * squares * self.typical * self.typical
    }
}

/// For each output the probability that the rows of a setting share an error, and the density of its
/// standard deviation on a grid, of equal steps of its logarithm: that of the residuals of the leading
/// hypothesis with it, at its best mode.
fn settings(weighings: &[Weighing<'_>]) -> Vec<Option<WeighedSettings>> {
    let Some(stated) = weighings.first() else { return Vec::new() };
    let shared = |w: &Weighing<'_>, output: usize| {
        let noise = w.setup.data.noise.shared.clone();
        noise.filter(|noise| noise.ratios.get(output).is_some_and(|ratio| *ratio > 0.0))
    };
    let of = |output: usize| {
        let own = || weighings.iter().filter(|w| shared(w, output).is_some());
        let leading = own().max_by(|a, b| a.probability.total_cmp(&b.probability))?;
        let noise = shared(leading, output)?;
        let best = leading.posterior.leading()?;
        let left = Remainder::of(&stated.setup, best);
        let groups = Groups::of(&stated.setup, noise.setting);
        let [least, most] = [0.5 * RATIOS[0], 2.0 * RATIOS[RATIOS.len() - 1]];
        let step = elementary::ln(most / least) / GRID as f64;
        let ratio = |n: usize| least * elementary::exp(step * (n as f64 + 0.5));
        let grid: Vec<f64> = (0..GRID).map(ratio).collect();
        let ln: Vec<f64> = grid.iter().map(|&r| groups.gain(&left, output, r)).collect();
        Some(WeighedSettings {
            setting: noise.setting,
            probability: own().map(|w| w.probability).sum::<f64>().min(1.0),
            ratios: normalized(grid, &ln),
            typical: noise.typical(&stated.setup.data, output),
        })
    };
    (0..stated.setup.data.outputs.len()).map(of).collect()
}

/// Values with weights that sum to one, from the logarithms of their weights.
fn normalized(values: Vec<f64>, ln: &[f64]) -> Vec<(f64, f64)> {
    let most = ln.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let density: Vec<f64> = ln.iter().map(|ln| elementary::exp(ln - most)).collect();
    let total: f64 = density.iter().sum();
    values.into_iter().zip(density).map(|(value, density)| (value, density / total)).collect()
}

/// The probability that neighbouring rows share noise, and the density of their coefficient of
/// correlation on a grid: that of the residuals of the leading hypothesis with it, at its best mode.
fn serial(weighings: &[Weighing<'_>]) -> Option<(f64, Vec<(f64, f64)>)> {
    let stated = weighings.first()?;
    if stated.setup.linear.fitted {
        return None;
    }
    let correlated = weighings.iter().filter(|w| w.setup.data.noise.serial.is_some());
    let probability = correlated.clone().map(|w| w.probability).sum();
    let leading = correlated.max_by(|a, b| a.probability.total_cmp(&b.probability))?;
    let hypotheses = leading.posterior.hypotheses.iter();
    let best = hypotheses.max_by(|a, b| a.probability.total_cmp(&b.probability))?;
    let residuals = Remainder::of(&stated.setup, best).residuals;
    let grid: Vec<f64> = (0..GRID).map(|n| (n as f64 + 0.5) / GRID as f64).collect();
    let ln: Vec<f64> = grid.iter().map(|&r| serial_gain(&stated.setup, &residuals, r)).collect();
    Some((probability, normalized(grid, &ln)))
}

/// Points of a grid of coefficients of correlation, or of standard deviations.
const GRID: usize = 200;

/// Draws of the factor on an output's stated uncertainties, over all hypotheses.
fn factor(weighing: &Weighing<'_>, output: usize) -> Option<Vec<(f64, f64)>> {
    if let Some(common) = &weighing.setup.data.noise.common {
        let (factor, deviation) = common.factors.get(output).copied().flatten()?;
        return Some(normal_draws(deviation, |shift| factor * elementary::exp(shift)));
    }
    // of an output that states uncertainties
    if !weighing.setup.has_factor(output) {
        return None;
    }
    let mut roles = weighing.setup.roles.iter().enumerate();
    let (place, map) = roles.find_map(|(place, role)| match role {
        Role::Noise { output: of, map } if *of == output => Some((place, map)),
        _ => None,
    })?;
    let mut draws: Vec<(f64, f64)> = Vec::new();
    for hypothesis in &weighing.posterior.hypotheses {
        if hypothesis.probability < LEAST {
            continue;
        }
        let evidence = &hypothesis.evidence;
        let weighted = evidence.weights.iter().enumerate().filter(|(_, w)| **w > 0.0);
        draws.extend(weighted.map(|(n, w)| {
            let score = evidence.columns[n / COLUMN][place].0[n % COLUMN];
            (elementary::exp(map.value(score)), w * hypothesis.probability)
        }));
    }
    let total: f64 = draws.iter().map(|(_, w)| w).sum();
    draws.iter_mut().for_each(|(_, w)| *w /= total);
    (!draws.is_empty()).then_some(draws)
}
