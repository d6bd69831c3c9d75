//! Noise that is not as stated, drawn as the diagnosis weighs it.

use serde::{Deserialize, Serialize};

use super::truth::Scores;
use crate::{Case, Prior};
use gumption_engine::number::elementary;
use gumption_inference::noise::noise_model::{DrawnNoise, Factor, NoiseModel};

/// What the noise of blind draws is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CheckedNoise {
    /// As it is stated.
    #[default]
    AsStated,
    /// Drawn as well, from what the diagnosis weighs: as stated, stated uncertainties off by a factor,
    /// rows that are off, noise that neighbouring rows share. Errors of settings are not drawn: without
    /// an effect they would be a gap.
    Uncertain,
}

/// The noise of one draw, in standard uncertainties as they are stated.
pub(super) struct NoiseOfDraw {
    kind: DrawnNoise,
    /// For each output the factor on its uncertainties.
    factors: Vec<f64>,
    /// For each output the noise of the row before that neighbours share.
    before: Vec<Option<f64>>,
    /// Values that are off, as rows and outputs, by so many standard uncertainties.
    off: Vec<(usize, usize, f64)>,
}

impl NoiseOfDraw {
    pub(super) fn as_stated(outputs: usize) -> Self {
        Self {
            kind: DrawnNoise::AsStated,
            factors: vec![1.0; outputs],
            before: vec![None; outputs],
            off: Vec::new(),
        }
    }

    /// Draws it for so many rows; without stated uncertainties there is no factor on them and no
    /// correlation to be found.
    pub(super) fn drawn(rows: usize, outputs: usize, stated: bool, scores: &mut Scores) -> Self {
        let kind = NoiseModel::drawn(stated, scores.uniform());
        let mut of = Self { kind, ..Self::as_stated(outputs) };
        match kind {
            DrawnNoise::AsStated => {}
            DrawnNoise::Factor => {
                let [lower, upper] = Factor::Usual.limits();
                for factor in &mut of.factors {
                    *factor = lower * elementary::pow(upper / lower, scores.uniform());
                }
            }
            DrawnNoise::Off => {
                let (most, another) = NoiseModel::suspects();
                loop {
                    let place = (scores.choice(rows), scores.choice(outputs));
                    if !of.off.iter().any(|&(row, output, _)| (row, output) == place) {
                        let size = NoiseModel::suspect_size(scores.uniform());
                        of.off.push((place.0, place.1, size * scores.next()));
                    }
                    if of.off.len() >= most.min(rows * outputs) || scores.uniform() >= another {
                        break;
                    }
                }
            }
            DrawnNoise::Serial(_) => {}
        }
        of
    }

    /// The prior probabilities of a case's hypotheses with it.
    pub(super) fn hypotheses(&self, case: &Case) -> Prior {
        match self.kind {
            DrawnNoise::AsStated => NoiseModel::default().hypotheses(case),
            _ => NoiseModel::other_than_stated(case.prior),
        }
    }

    /// The noise of a value, of which `score` is a standard normal draw; rows in their order.
    pub(super) fn at(&mut self, row: usize, output: usize, score: f64) -> f64 {
        let own = match (self.kind, self.before[output]) {
            (DrawnNoise::Serial(lag), Some(before)) => {
                lag * before + (1.0 - lag * lag).sqrt() * score
            }
            _ => score,
        };
        self.before[output] = Some(own);
        let here = |&&(of, at, _): &&(usize, usize, f64)| (of, at) == (row, output);
        let off = self.off.iter().filter(here).map(|(.., size)| size).sum::<f64>();
        self.factors[output] * own + off
    }

    /// In words, for the sealed truth.
    pub(super) fn words(&self) -> String {
        match self.kind {
            DrawnNoise::AsStated => "as stated".to_owned(),
            DrawnNoise::Factor => {
                let factors: Vec<String> = self.factors.iter().map(|f| format!("{f:.2}")).collect();
                format!("stated uncertainties times {}", factors.join(", "))
            }
            DrawnNoise::Off => {
                let rows: Vec<String> =
                    self.off.iter().map(|(row, ..)| (row + 1).to_string()).collect();
                format!("off in row {}", rows.join(", "))
            }
            DrawnNoise::Serial(lag) => format!("neighbouring rows correlated by {lag}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CheckedNoise;
    use crate::check::truth;
    use crate::tests::cases::line;

    #[test]
    fn the_noise_of_draws_is_as_probable_as_in_the_diagnosis() {
        let case = line();
        let noise = vec![vec![0.1; 6]; 2];
        let of = |noise_of, number| truth(&case, &noise, noise_of, 7, number).unwrap();
        const DRAWS: u64 = 1000;
        let words: Vec<String> =
            (0..DRAWS).map(|number| of(CheckedNoise::Uncertain, number).0.noise).collect();
        let share =
            |word: &str| words.iter().filter(|of| of.contains(word)).count() as f64 / DRAWS as f64;
        // 0.35, 0.2, 0.15 and 0.25 of 0.95; five standard errors are 0.08 at most
        for (word, wanted) in
            [("as stated", 0.35), ("times", 0.2), ("off in row", 0.15), ("correlated", 0.25)]
        {
            assert!((share(word) - wanted / 0.95).abs() < 0.08, "{word} {}", share(word));
        }
        // with the noise as stated, nothing else is drawn
        for number in 0..20 {
            assert_eq!(of(CheckedNoise::AsStated, number).0.noise, "as stated");
        }
    }

    #[test]
    fn noise_has_the_size_that_its_kind_has() {
        let case = line();
        let noise = vec![vec![0.1; 6]; 2];
        let mut squares: Vec<(bool, f64)> = Vec::new();
        for number in 0..600 {
            let (truth, measured) =
                truth(&case, &noise, CheckedNoise::Uncertain, 7, number).unwrap();
            let of = truth.values.iter().flatten().zip(measured.iter().flatten());
            let square = of.map(|(y, x)| ((x - y) / 0.1).powi(2)).sum::<f64>() / 12.0;
            if truth.noise == "as stated" || truth.noise.contains("correlated") {
                squares.push((truth.noise == "as stated", square));
            } else if let Some(factors) = truth.noise.strip_prefix("stated uncertainties times ") {
                let factors: Vec<f64> =
                    factors.split(", ").map(|factor| factor.parse().unwrap()).collect();
                assert!(factors.iter().all(|factor| (0.25..=10.0).contains(factor)), "{factors:?}");
            }
        }
        // correlated noise has the variance that is stated; some 200 sets of twelve values with an
        // effective number of two at least have a standard error of 0.07
        for kind in [true, false] {
            let own: Vec<f64> =
                squares.iter().filter(|(stated, _)| *stated == kind).map(|(_, s)| *s).collect();
            let mean = own.iter().sum::<f64>() / own.len() as f64;
            assert!((mean - 1.0).abs() < 0.3, "{kind} {mean} of {}", own.len());
        }
    }
}
