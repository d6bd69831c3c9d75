//! What the data say of their noise, over all hypotheses.

use super::latent::Role;
use super::logarithm::ln_add;
use super::noise_model::{Suspect, Weighing, serial_gain};
use super::parameters::equal_tails;
use super::remainder::Remainder;
use super::setup::Setup;
use super::shared_noise::{Groups, RATIOS, Setting};
use gumption_engine::number::{COLUMN, elementary, smallest_first};

/// Hypotheses below this probability do not contribute to the factor.
const LEAST: f64 = 1e-3;

/// What is known of the noise of the data.
#[derive(Clone, Debug, Default)]
pub(crate) struct WeighedNoise {
    /// Probability that stated uncertainties are off by a factor.
    pub(crate) factor_probability: f64,
    /// For each observed output with stated uncertainties what they are to be multiplied by, if they
    /// are off: draws with weights that sum to one.
    pub(crate) factors: Vec<(usize, Vec<(f64, f64)>)>,
    /// Values that may be off, with their probabilities.
    pub(crate) suspects: Vec<(Suspect, f64)>,
    /// Probability that neighbouring rows share noise, and draws of their coefficient of correlation,
    /// if they do, with weights that sum to one.
    pub(crate) serial: Option<(f64, Vec<(f64, f64)>)>,
    /// For each output the error that the rows of each setting share, where it may have one.
    pub(crate) settings: Vec<Option<WeighedSettings>>,
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
        let mut of = Self::default();
        let with_factor = || weighings.iter().filter(|w| w.setup.data.noise.factor.is_some());
        of.factor_probability = with_factor().map(|w| w.probability).sum::<f64>().min(1.0);
        let all = with_factor().map(Weighing::ln_weight).fold(f64::NEG_INFINITY, ln_add);
        for weighing in with_factor() {
            let share = elementary::exp(weighing.ln_weight() - all);
            for (output, draws) in factors(weighing) {
                let draws = draws.into_iter().map(|(factor, weight)| (factor, share * weight));
                match of.factors.iter_mut().find(|(known, _)| *known == output) {
                    Some((_, known)) => known.extend(draws),
                    None => of.factors.push((output, draws.collect())),
                }
            }
        }
        for (_, draws) in &mut of.factors {
            smallest_first(draws, |a| a.0);
        }
        of.serial = serial(weighings);
        of.settings = settings(weighings);
        for weighing in weighings {
            for &suspect in &weighing.setup.data.noise.suspects {
                let Suspect { id, output, .. } = suspect;
                match of.suspects.iter_mut().find(|(known, ..)| known.is_of(id, output)) {
                    Some((_, known)) => *known = (*known + weighing.probability).min(1.0),
                    None => of.suspects.push((suspect, weighing.probability)),
                }
            }
        }
        of
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
    /// an interval with equal tails.
    pub(crate) fn factor(&self, output: usize, coverage: f64) -> Option<(f64, [f64; 2])> {
        let (_, draws) = self.factors.iter().find(|(of, _)| *of == output)?;
        let ln: f64 = draws.iter().map(|(factor, w)| w * elementary::ln(*factor)).sum();
        Some((elementary::exp(ln), equal_tails(draws, coverage)))
    }
}

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

/// Draws of the factors, over all hypotheses.
fn factors(weighing: &Weighing<'_>) -> Vec<(usize, Vec<(f64, f64)>)> {
    let roles = weighing.setup.roles.iter().enumerate();
    roles
        .filter_map(|(place, role)| match role {
            // of an output that states uncertainties
            Role::Noise { output, map } if weighing.setup.has_factor(*output) => {
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
                (!draws.is_empty()).then_some((*output, draws))
            }
            _ => None,
        })
        .collect()
}
