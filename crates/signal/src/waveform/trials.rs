//! Trials of a corrected record (JCGM 102, 7): each has noise, a response, a delay, a scale and a missing part of its
//! own, and is divided anew.

use super::corrected::Divided;
use super::quantity::ascending;
use crate::normals::Normals;
use crate::phasor::at_turns;
use crate::{Phasor, Signal};
use gumption_engine::distribution::StreamKey;
use gumption_engine::parallel;

/// Values that are drawn in all, at most: fewer trials of a longer record.
const MOST_VALUES: u64 = 50_000_000;

/// Trials of any record, at least.
const FEWEST: u64 = 30;

/// Trials that are in memory at a time.
const AT_A_TIME: u64 = 8;

/// The share of trials that lie wholly within the simultaneous band.
const COVERED: f64 = 0.95;

/// What trials say of a corrected record.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveformTrials {
    /// How many there were.
    pub count: u64,
    /// The standard deviation of each value.
    pub standard_uncertainties: Vec<f64>,
    /// The factor of the standard uncertainties by the law of propagation with which 95 % of the trials lie within the
    /// band at all instants; none where fewer than 100 trials cannot tell.
    pub simultaneous_factor: Option<f64>,
}

/// Errors that are the same at all instants of a trial.
#[derive(Clone, Copy)]
pub(super) struct Constant<'a> {
    /// The half-width of what is missing at each instant, and of its effect on each figure.
    pub(super) missing: f64,
    pub(super) half_widths: &'a [f64],
    /// How many additional standard uncertainties each figure changes by.
    pub(super) additional_sizes: &'a [f64],
}

type Found = (WaveformTrials, Vec<Vec<f64>>);

/// Draws trials; none for none. Beside what they say, the values of each quantity.
pub(super) fn run(
    divided: &Divided<'_>,
    (found, uncertainties): (&Signal, &[f64]),
    constant: Constant<'_>,
    (name, seed, wanted): (&str, u64, u64),
) -> Option<Found> {
    let samples = found.values.len();
    let count = wanted.min((MOST_VALUES / samples as u64).max(FEWEST));
    if count < 2 {
        return None;
    }
    let mut squares = vec![0.0; samples];
    let mut sums = vec![0.0; samples];
    let mut quantities: Vec<Vec<f64>> = vec![Vec::new(); constant.half_widths.len()];
    let mut farthest = Vec::new();
    for first in (0..count).step_by(AT_A_TIME as usize) {
        let some = first..count.min(first + AT_A_TIME);
        let drawn = parallel::map(some, |trial| {
            let key = StreamKey::new(seed, &format!("{name}, trial {trial}"));
            one(divided, constant, &mut Normals::new(key))
        });
        for (values, figures) in drawn {
            let mut most = 0.0_f64;
            for (at, value) in values.iter().enumerate() {
                let change = value - found.values[at];
                sums[at] += change;
                squares[at] += change * change;
                if uncertainties[at] > 0.0 {
                    most = most.max(change.abs() / uncertainties[at]);
                }
            }
            farthest.push(most);
            quantities.iter_mut().zip(figures).for_each(|(all, figure)| all.push(figure));
        }
    }
    let many = count as f64;
    let spread = sums.iter().zip(&squares);
    let standard_uncertainties =
        spread.map(|(sum, squares)| ((squares - sum * sum / many) / (many - 1.0)).max(0.0).sqrt());
    let place = (COVERED * many).ceil() as usize;
    let simultaneous_factor = (count >= 100)
        .then(|| ascending(&farthest).get(place.saturating_sub(1)).copied())
        .flatten();
    let trials = WaveformTrials {
        count,
        standard_uncertainties: standard_uncertainties.collect(),
        simultaneous_factor,
    };
    Some((trials, quantities))
}

/// One trial: the values, and the figures; a figure that a trial's signal does not have is not a number.
fn one(
    divided: &Divided<'_>,
    Constant { missing, half_widths, additional_sizes }: Constant<'_>,
    normals: &mut Normals,
) -> (Vec<f64>, Vec<f64>) {
    let Divided { step, lines, record, passed, densities, start, rate } = divided;
    let mut inverse = step.response.drawn(lines, &mut || normals.next());
    let delay = step.delay.standard_uncertainty * normals.next();
    let scale = step.factor / (1.0 + step.of_scale * normals.next());
    let place = 2.0 * normals.next_uniform() - 1.0;
    let additional = step.additional * normals.next();
    for (line, value) in inverse.iter_mut().enumerate() {
        let turned = at_turns(lines.hertz(line) * delay);
        // of a line that is its own image all of the variance is in the real part
        let of_line = densities[line] * lines.samples as f64;
        let noise = match lines.is_real(line) {
            true => Phasor::new(of_line.sqrt() * normals.next(), 0.0),
            false => Phasor::new(normals.next(), normals.next()) * (0.5 * of_line).sqrt(),
        };
        *value *= (record[line] + noise) * passed[line] * turned * scale;
    }
    let values = lines.inverse(inverse);
    let rate = rate * (1.0 + step.of_rate * normals.next());
    let mut signal = Signal { values, rate, start: *start };
    let sizes = half_widths.iter().zip(additional_sizes);
    let figures = step.quantities.iter().zip(sizes).map(|((_, quantity), (half_width, size))| {
        let error = place * half_width + additional * size;
        quantity.of(&signal).map_or(f64::NAN, |of| of.value + error)
    });
    let figures = figures.collect();
    signal.values.iter_mut().for_each(|value| *value += place * missing + additional);
    (signal.values, figures)
}
