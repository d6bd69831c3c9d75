//! Sobol indices: the share of the output's variance due to an input alone (first-order), and due
//! to the input including all its interactions (total). By Jansen's estimators (M. J. W. Jansen,
//! Computer Physics Communications 117 (1999) 35; Saltelli et al., ibid. 181 (2010) 259, Table 2):
//! with samples A and B, and AB_i, which is A with input i from B,
//!
//! S_i = 1 - mean((f(B) - f(AB_i))^2) / 2V,  ST_i = mean((f(A) - f(AB_i))^2) / 2V
//!
//! Quantities that are drawn together are taken from B together: they have one index as a set.
//!
//! Both samples are the points of one net in twice as many dimensions. A fixed number of nets,
//! scrambled independently, gives the indices; their scatter gives the numerical standard errors.

use gumption_engine::parallel;

use super::lanes::{LANES, in_lanes, with_deviations};
use super::sampler::{NET_POINTS, NETS, Outputs, PreparedSet, Sampler, Taker};
use super::spread::standard_error;
use gumption_engine::number::{CodePath, Column, Kernel};
use gumption_engine::propagate::Control;

/// The indices of one set of quantities for one output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sobol {
    /// First-order index.
    pub first: f64,
    /// Total index.
    pub total: f64,
    /// Numerical standard errors of both.
    pub standard_error: [f64; 2],
}

/// Sums of one batch for one output.
#[derive(Clone, Debug, Default)]
struct BatchSums {
    count: f64,
    /// Sums over both samples of deviations from the reference, and of their squares.
    sum: f64,
    squares: f64,
    /// For each set the squared differences from B and from A.
    differences: Vec<[f64; 2]>,
}

impl BatchSums {
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.differences.resize(other.differences.len(), [0.0; 2]);
        for (mine, theirs) in self.differences.iter_mut().zip(&other.differences) {
            mine[0] += theirs[0];
            mine[1] += theirs[1];
        }
    }

    /// First-order and total index of a set; `None` if the variance is zero.
    fn indices(&self, set: usize) -> Option<[f64; 2]> {
        let mean = self.sum / (2.0 * self.count);
        let variance = (self.squares - 2.0 * self.count * mean * mean) / (2.0 * self.count - 1.0);
        let [to_b, to_a] = *self.differences.get(set)?;
        let share = |squares: f64| squares / (2.0 * self.count * variance);
        (variance > 0.0 && to_a.is_finite() && to_b.is_finite())
            .then(|| [1.0 - share(to_b), share(to_a)])
    }
}

/// The squared differences of one set from B and from A, in lanes.
type Differences = [[f64; LANES]; 2];

/// The sums of one output in lanes.
#[derive(Clone, Debug)]
struct Lanes {
    /// Sums over both samples of deviations from the reference, and of their squares.
    samples: [[f64; LANES]; 2],
    differences: Vec<Differences>,
}

impl Lanes {
    fn sums(&self, count: f64) -> BatchSums {
        let sum = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
        BatchSums {
            count,
            sum: sum(&self.samples[0]),
            squares: sum(&self.samples[1]),
            differences: self
                .differences
                .iter()
                .map(|difference| [sum(&difference[0]), sum(&difference[1])])
                .collect(),
        }
    }
}

/// Takes the samples into sums.
struct Samples<'a> {
    references: &'a [f64],
    /// A column of the outputs of both samples. The first sample gives the sets: it is B.
    both: [Vec<Column>; 2],
    lanes: Vec<Lanes>,
}

impl Taker for Samples<'_> {
    fn take(&mut self, path: CodePath, number: usize, outputs: Outputs<'_>, count: usize) {
        path.run(AddSample { samples: self, number, outputs, count });
        if let Some(sample) = self.both.get_mut(number) {
            sample.iter_mut().zip(outputs.columns()).for_each(|(kept, found)| kept.0 = found.0);
        }
    }
}

/// Adds a column of a sample, or of the second one with a set of the first, to the sums.
struct AddSample<'a, 's> {
    samples: &'a mut Samples<'s>,
    number: usize,
    outputs: Outputs<'a>,
    count: usize,
}

impl Kernel for AddSample<'_, '_> {
    type Output = ();

    // evaluating the model takes most of the time
    const WIDEST: bool = false;

    #[inline(always)]
    fn run(self) {
        let Self { samples, number, outputs, count } = self;
        let Samples { references, both: [b, a], lanes } = samples;
        for (output, (column, lanes)) in outputs.columns().zip(lanes).enumerate() {
            let values: &[f64] = &column.0[..count];
            let [mut first, mut second] = match number.checked_sub(2) {
                None => lanes.samples,
                Some(set) => lanes.differences[set],
            };
            if number < 2 {
                [first, second] = with_deviations([first, second], values, references[output]);
            } else {
                let (a, b) = (&a[output].0[..count], &b[output].0[..count]);
                in_lanes(count, |trial, lane| {
                    let (to_b, to_a) = (b[trial] - values[trial], a[trial] - values[trial]);
                    first[lane] += to_b * to_b;
                    second[lane] += to_a * to_a;
                });
            }
            let found = [first, second];
            match number.checked_sub(2) {
                None => lanes.samples = found,
                Some(set) => lanes.differences[set] = found,
            }
        }
    }
}

/// For each output the indices of each set of variables; `None` for an output that does not vary or
/// has values that are not finite. `None` altogether if stopped.
pub(super) fn indices(
    sampler: &Sampler,
    sets: &[Vec<usize>],
    control: &Control<'_>,
) -> Option<Vec<Vec<Option<Sobol>>>> {
    // the sums of all sets that are evaluated at a time
    let set = size_of::<Differences>() * sampler.outputs() + sampler.prepared_bytes();
    let at_a_time = (control.memory / set).max(1);
    let mut all = vec![Vec::with_capacity(sets.len()); sampler.outputs()];
    for sets in sets.chunks(at_a_time) {
        let found = indices_of(sampler, sets, control)?;
        all.iter_mut().zip(found).for_each(|(all, found)| all.extend(found));
    }
    Some(all)
}

/// The number of points at which the indices of so many quantities evaluate the model.
pub(super) fn evaluations(quantities: usize) -> u64 {
    NETS * NET_POINTS as u64 * (2 + quantities as u64)
}

/// The indices of some of the sets.
fn indices_of(
    sampler: &Sampler,
    sets: &[Vec<usize>],
    control: &Control<'_>,
) -> Option<Vec<Vec<Option<Sobol>>>> {
    let outputs = sampler.outputs();
    let sets: Vec<PreparedSet<'_>> = sets.iter().map(|set| sampler.prepared_set(set)).collect();
    let batch = |net: u64| {
        if control.is_stopped() {
            return None;
        }
        let none =
            Lanes { samples: [[0.0; LANES]; 2], differences: vec![[[0.0; LANES]; 2]; sets.len()] };
        let mut samples = Samples {
            references: sampler.middles(),
            both: [vec![Column::ZERO; outputs], vec![Column::ZERO; outputs]],
            lanes: vec![none; outputs],
        };
        sampler.mixed(control.path, net, &sets, &mut sampler.buffers(), &mut samples);
        control.advance((NET_POINTS * (2 + sets.len())) as u64);
        Some(samples.lanes.iter().map(|lanes| lanes.sums(NET_POINTS as f64)).collect())
    };
    let batches: Option<Vec<Vec<BatchSums>>> = parallel::map(0..NETS, batch).into_iter().collect();
    let batches = batches?;
    let of = |output: usize, set: usize| {
        let parts = || batches.iter().filter_map(|batch| batch.get(output));
        let mut all = BatchSums::default();
        parts().for_each(|part| all.add(part));
        let [first, total] = all.indices(set)?;
        let own: Option<Vec<[f64; 2]>> = parts().map(|part| part.indices(set)).collect();
        let errors = own.map_or([f64::NAN; 2], |own| {
            [0, 1].map(|which| {
                let values: Vec<f64> = own.iter().map(|indices| indices[which]).collect();
                standard_error(&values)
            })
        });
        Some(Sobol { first, total, standard_error: errors })
    };
    Some((0..outputs).map(|o| (0..sets.len()).map(|set| of(o, set)).collect()).collect())
}
