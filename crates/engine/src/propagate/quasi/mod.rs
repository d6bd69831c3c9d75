//! Figures of an output with much less noise than that of trials: one input, in which the output is
//! monotone whatever the others, is integrated exactly through its distribution function, and the
//! others run over scrambled nets (Griewank, Kuo, Leoevey, Sloan 2018; L'Ecuyer, Puchhammer, Ben Abdellah
//! 2022). An indicator is then a smooth function of the points, and errors fall as their number, not as
//! its root. Standard errors are those of independent scramblings. Where no input has a monotone effect, one
//! whose effect is so in parts is integrated part by part ([`pieces`]).
//!
//! The scramblings are the same whatever the seed of the trials.

mod cdf;
mod directions;
mod net;
mod pieces;
mod points;
#[cfg(test)]
mod tests;

use crate::parallel;

pub use self::net::NetCoordinate;

use self::cdf::Cdf;
use self::pieces::ColumnPieces;
use self::points::NetInputs;
use super::exact::{Accuracy, Noiseless, Problem, Scatter, moments_exist};
use super::shortest::{Interval, Purpose, ShortestSearch};
use crate::model::{Program, Schedule, ScheduledOutput};
use crate::number::{COLUMN, CodePath, Column, largest_first};

/// Randomizations.
pub(super) const RANDOMIZATIONS: u32 = 16;

/// Points of each one, as a power of two.
pub(super) const POINTS_LOG2: u32 = 12;

/// Inputs at most.
const MOST_INPUTS: usize = 1000;

/// Inputs that are tried for the exact integration.
const MOST_CANDIDATES: usize = 6;

/// Probabilities at which the effect of an input is looked at.
const LOOKED: [f64; 9] = [1e-9, 1e-5, 1e-3, 0.1, 0.5, 0.9, 0.999, 0.999_99, 0.999_999_999];

/// Points of each randomization at which it is.
const LOOKED_POINTS: u32 = 512;

/// The figures of an output.
///
/// # Errors
/// Why there are none.
pub(crate) fn evaluate(problem: &Problem<'_>) -> Result<Noiseless, String> {
    evaluate_with(problem, 0x6a09_e667_f3bc_c908, POINTS_LOG2)
}

/// The same with scramblings of another seed and 2^`log2` points each.
pub(super) fn evaluate_with(
    problem: &Problem<'_>,
    seed: u64,
    log2: u32,
) -> Result<Noiseless, String> {
    let output = problem.quantity();
    if output.period.is_some() {
        return Err("a phase is periodic: no input has a monotone effect".to_owned());
    }
    let setup = Setup::new(problem)?;
    let net = |r| setup.net(seed.wrapping_add(u64::from(r)), log2);
    let nets: Vec<Net> = parallel::map(0..RANDOMIZATIONS, net)
        .into_iter()
        .collect::<Option<_>>()
        .ok_or("the output has no finite value at some points")?;
    let Candidate { place, cdf, parts } = setup.candidate(&nets)?;
    let name = problem.task.variables[setup.varying[place]].name.clone();
    let mut solved = Solved::new(&setup, nets, place, cdf, parts);
    solved.figures(problem, name, 1 << log2)
}

/// An output as a function of the inputs that vary.
struct Setup {
    schedule: Schedule,
    /// The variables, in the order of the registers.
    varying: Vec<usize>,
    distributions: Vec<std::sync::Arc<crate::distribution::Distribution>>,
    inputs: NetInputs,
    /// Places of inputs, the most important one first.
    order: Vec<usize>,
    linked: Vec<bool>,
    /// The value at the estimates.
    middle: f64,
}

/// The points of one randomization: inputs by columns, and the outputs there.
struct Net {
    columns: Vec<Vec<Column>>,
    outputs: Vec<Column>,
}

/// The input that is integrated.
struct Candidate {
    place: usize,
    cdf: Cdf,
    /// Where its effect is monotone, in each net; `None` where it is so everywhere.
    parts: Option<Vec<Vec<ColumnPieces>>>,
}

impl Setup {
    fn new(problem: &Problem<'_>) -> Result<Self, String> {
        let program = &problem.task.model.program;
        let row = problem.row;
        let program = Program {
            nodes: program.nodes.clone(),
            variables: program.variables,
            outputs: vec![program.outputs[problem.output]],
            routines: program.routines.clone(),
        };
        let reach = program.reach();
        let linked = problem.joint.linked();
        // what is linked to an input that matters has to be there as well
        let mut wanted: Vec<bool> = reach.first().cloned().unwrap_or_default();
        wanted.truncate(row.distributions.len());
        for set in &linked {
            if set.members.iter().any(|&m| wanted[m]) {
                set.members.iter().for_each(|&m| wanted[m] = true);
            }
        }
        let constant = |v: usize| row.distributions[v].constant();
        let varying: Vec<usize> =
            (0..row.distributions.len()).filter(|&v| wanted[v] && constant(v).is_none()).collect();
        if varying.is_empty() {
            return Err("the output does not vary".to_owned());
        }
        if varying.len() > MOST_INPUTS {
            return Err(format!("{} inputs are too many for nets of points", varying.len()));
        }
        let mut bound: Vec<Option<f64>> = (0..row.distributions.len())
            .map(|v| {
                let constant = constant(v).unwrap_or_else(|| row.distributions[v].mean());
                varying.binary_search(&v).is_err().then_some(constant)
            })
            .collect();
        bound.extend(row.conditions.iter().map(|&value| Some(value)));
        let schedule = Schedule::keeping_variables(&program, &bound);
        let distributions: Vec<_> = varying.iter().map(|&v| row.distributions[v].clone()).collect();
        let estimates = row.estimates();
        let (values, gradients) = program.gradients(&estimates);
        let share = |place: usize| {
            let slope = gradients.first().map_or(0.0, |gradient| gradient[varying[place]]);
            let share = (slope * distributions[place].standard_uncertainty()).abs();
            if share.is_finite() { share } else { 0.0 }
        };
        let mut order: Vec<usize> = (0..varying.len()).collect();
        largest_first(&mut order, |&v| share(v));
        let inputs = NetInputs::new(&distributions, &varying, &linked, &order)?;
        let of_linked = |v: &usize| linked.iter().any(|set| set.members.contains(v));
        let linked = varying.iter().map(of_linked).collect();
        let middle = values.first().copied().filter(|value| value.is_finite()).unwrap_or(0.0);
        Ok(Self { schedule, varying, distributions, inputs, order, linked, middle })
    }

    /// The outputs where the registers hold the inputs.
    fn run(&self, registers: &mut [Column], out: &mut Column) {
        self.schedule.run_on(CodePath::best(), registers);
        match self.schedule.outputs.first() {
            Some(ScheduledOutput::Register(register)) => out.0 = registers[*register].0,
            Some(ScheduledOutput::Constant(value)) => out.0.fill(*value),
            None => {}
        }
    }

    fn registers(&self) -> Vec<Column> {
        vec![Column::ZERO; self.schedule.registers.max(self.varying.len())]
    }

    /// The points of a randomization; `None` if an output is not finite.
    fn net(&self, seed: u64, log2: u32) -> Option<Net> {
        let coordinates = self.inputs.coordinates(seed);
        let count = (1u32 << log2).max(COLUMN as u32);
        let mut registers = self.registers();
        let mut net = Net { columns: Vec::new(), outputs: Vec::new() };
        for first in (0..count).step_by(COLUMN) {
            let mut values = vec![Column::ZERO; self.varying.len()];
            self.inputs.fill(&coordinates, first, &mut values);
            registers[..values.len()].clone_from_slice(&values);
            let mut out = Column::ZERO;
            self.run(&mut registers, &mut out);
            if !out.0.iter().all(|y| y.is_finite()) {
                return None;
            }
            net.columns.push(values);
            net.outputs.push(out);
        }
        Some(net)
    }

    /// The input that is integrated: of those with the largest contributions the first in which the
    /// output is monotone at all points that are looked at, or else monotone in parts.
    fn candidate(&self, nets: &[Net]) -> Result<Candidate, String> {
        let own = self.order.iter().copied().filter(|&place| !self.linked[place]);
        let mut tried = Vec::new();
        for place in own.take(MOST_CANDIDATES) {
            let Some(cdf) = Cdf::of(&self.distributions[place]) else {
                continue;
            };
            let monotone = parallel::map(nets, |net| self.is_monotone(net, place));
            if monotone.into_iter().all(|is| is) {
                return Ok(Candidate { place, cdf, parts: None });
            }
            tried.push((place, cdf));
        }
        if tried.is_empty() {
            return Err(
                "no input of its own has a distribution function that is integrated".to_owned()
            );
        }
        for (place, cdf) in tried {
            let parts = parallel::map(nets, |net| pieces::parts(self, net, place, &cdf));
            if let Some(parts) = parts.into_iter().collect() {
                return Ok(Candidate { place, cdf, parts: Some(parts) });
            }
        }
        Err("no input has an effect that is monotone in a few parts whatever the values of the others"
            .to_owned())
    }

    fn is_monotone(&self, net: &Net, place: usize) -> bool {
        let distribution = &self.distributions[place];
        let values = LOOKED.map(|p| {
            if p < 0.5 { distribution.quantile(p) } else { distribution.quantile_upper(1.0 - p) }
        });
        let mut registers = self.registers();
        let columns = (LOOKED_POINTS as usize).div_ceil(COLUMN);
        net.columns.iter().take(columns).all(|column| {
            let mut before: Option<Column> = None;
            let mut rises: Option<[bool; COLUMN]> = None;
            values.iter().all(|&value| {
                registers[..column.len()].clone_from_slice(column);
                registers[place].0.fill(value);
                let mut out = Column::ZERO;
                self.run(&mut registers, &mut out);
                let Some(before) = before.replace(out.clone()) else {
                    return out.0.iter().all(|y| y.is_finite());
                };
                let steps: [f64; COLUMN] = std::array::from_fn(|i| out.0[i] - before.0[i]);
                if steps.iter().any(|step| step.is_nan() || *step == 0.0) {
                    return false;
                }
                let now = steps.map(|step| step > 0.0);
                *rises.get_or_insert(now) == now
            })
        })
    }
}

/// Points with the values of the integrated input at which the output has a wanted value.
struct Solved<'s> {
    setup: &'s Setup,
    place: usize,
    cdf: Cdf,
    nets: Vec<SolvedNet>,
    /// A width of the integrated input.
    width: f64,
    /// Between which of its values the output was looked at.
    looked: [f64; 2],
}

struct SolvedNet {
    net: Net,
    way: SolvingWay,
    registers: Vec<Column>,
}

/// How the integrated input is solved for.
enum SolvingWay {
    /// The output is monotone in it. Where each point was found last: the value of the input, the
    /// output there, and the slope.
    Whole(Vec<[Column; 3]>),
    /// It is so in parts.
    Parts(Vec<ColumnPieces>),
}

/// Distribution function and density of the output by one randomization.
type OfNet = [f64; 2];

impl<'s> Solved<'s> {
    fn new(
        setup: &'s Setup,
        nets: Vec<Net>,
        place: usize,
        cdf: Cdf,
        parts: Option<Vec<Vec<ColumnPieces>>>,
    ) -> Self {
        let distribution = &setup.distributions[place];
        let width = distribution.quantile_upper(0.16) - distribution.quantile(0.16);
        let middle = distribution.quantile(0.5);
        let starts = |net: &Net, registers: &mut [Column]| {
            let start = |column: &Vec<Column>| {
                let mut at = |value: f64| {
                    registers[..column.len()].clone_from_slice(column);
                    registers[place].0.fill(value);
                    let mut out = Column::ZERO;
                    setup.run(registers, &mut out);
                    out
                };
                let high = middle + 0.25 * width;
                let (a, b) = (at(middle), at(high));
                let slope = std::array::from_fn(|i| (b.0[i] - a.0[i]) / (high - middle));
                [Column([middle; COLUMN]), a, Column(slope)]
            };
            net.columns.iter().map(start).collect()
        };
        let mut parts = parts.map(Vec::into_iter);
        let ways: Vec<Option<Vec<ColumnPieces>>> =
            nets.iter().map(|_| parts.as_mut().and_then(Iterator::next)).collect();
        let nets = parallel::map(nets.into_iter().zip(ways), |(net, parts)| {
            let mut registers = setup.registers();
            let way = match parts {
                Some(parts) => SolvingWay::Parts(parts),
                None => SolvingWay::Whole(starts(&net, &mut registers)),
            };
            SolvedNet { net, way, registers }
        });
        let [least, .., most] = LOOKED;
        let looked = [distribution.quantile(least), distribution.quantile_upper(1.0 - most)];
        Self { setup, place, cdf, nets, width, looked }
    }

    /// Distribution function and density at `y` by each randomization, of which only the first
    /// `columns` columns of points are used.
    fn at(&mut self, y: f64, columns: usize) -> Vec<OfNet> {
        let Self { setup, place, ref cdf, ref mut nets, width, looked } = *self;
        let integrated = Integrated { setup, place, cdf, width, looked };
        let of = |SolvedNet { net, way, registers }: &mut SolvedNet| match way {
            SolvingWay::Whole(last) => integrated.whole(net, last, registers, y, columns),
            SolvingWay::Parts(parts) => integrated.in_parts(net, parts, registers, y, columns),
        };
        parallel::map(nets, of)
    }
}

/// Steps towards the value of the integrated input at most.
const STEPS: u32 = 60;

/// The share of the input's width that the last step may be longer than to end the search: what it leaves
/// is its square.
const ENDED: f64 = 1e-7;

/// What is integrated, how wide it is, and between which values the output was looked at.
struct Integrated<'a> {
    setup: &'a Setup,
    place: usize,
    cdf: &'a Cdf,
    width: f64,
    looked: [f64; 2],
}

impl Integrated<'_> {
    /// Distribution function and density of the output at `y`, over the first `columns` columns, where the
    /// output is monotone.
    fn whole(
        &self,
        net: &Net,
        last: &mut [[Column; 3]],
        registers: &mut [Column],
        y: f64,
        columns: usize,
    ) -> OfNet {
        let Self { setup, place, cdf, width, looked: [least, most] } = *self;
        let (mut sums, mut count) = ([0.0; 2], 0.0);
        for (column, last) in net.columns.iter().zip(last).take(columns) {
            registers[..column.len()].clone_from_slice(column);
            let [at, output, slope] = last;
            let mut out = Column::ZERO;
            // what the places that were looked at leave
            let mut held = [[f64::NEG_INFINITY, f64::INFINITY]; COLUMN];
            for step in 0..STEPS {
                let mut moved: f64 = 0.0;
                let mut next = [0.0; COLUMN];
                for (i, next) in next.iter_mut().enumerate() {
                    let newton = (y - output.0[i]) / slope.0[i];
                    let end = usize::from((output.0[i] > y) == (slope.0[i] > 0.0));
                    held[i][end] = at.0[i];
                    // far steps would leave the range where the slope says anything, and beyond the values
                    // that were looked at the output need not be monotone
                    let limit = 8.0 * width;
                    let mut to = (at.0[i] + newton.clamp(-limit, limit)).clamp(least, most);
                    // beside a steep end steps go to and fro
                    let [from, until] = held[i];
                    let is_far = (to - at.0[i]).abs() > ENDED * width;
                    if is_far && !(to > from && to < until) && (until - from).is_finite() {
                        to = 0.5 * (from + until);
                    }
                    moved = moved.max((to - at.0[i]).abs());
                    *next = to;
                }
                if moved <= 1e-13 * width {
                    break;
                }
                registers[place].0 = next;
                setup.run(registers, &mut out);
                for (i, next) in next.into_iter().enumerate() {
                    let dx = next - at.0[i];
                    let dy = out.0[i] - output.0[i];
                    let secant = dy / dx;
                    if dx.abs() > 1e-9 * width && secant.is_finite() && secant != 0.0 {
                        slope.0[i] = secant;
                    }
                    at.0[i] = next;
                    output.0[i] = out.0[i];
                }
                if moved <= ENDED * width && step > 0 {
                    break;
                }
            }
            for i in 0..COLUMN {
                let steep = slope.0[i];
                // the last step, which is not worth an evaluation
                let x = at.0[i] + ((y - output.0[i]) / steep).clamp(-width, width);
                let [p, density] = cdf.at(x);
                sums[0] += if steep > 0.0 { p } else { 1.0 - p };
                sums[1] += density / steep.abs();
            }
            count += COLUMN as f64;
        }
        sums.map(|sum| sum / count)
    }
}

/// Mean and its standard error.
fn mean(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    let squares: f64 = values.map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (n - 1.0) / n).sqrt()]
}

/// A figure with its standard error.
type FigureWithError = [f64; 2];

/// The distance, in widths of the output, over which the slope of its density is taken.
const SLOPE_STEP: f64 = 0.05;

/// The share of its standard error up to which a difference of densities is none.
const SAME: f64 = 0.1;

/// The share of a density that the search for a quantile may change it by.
const SEARCHED: f64 = 1e-6;

/// The least probability outside whose quantile the points tell.
const RESOLVED: f64 = 1e-6;

/// A shortest interval that may have anything from a range of probabilities below it that is a larger share
/// of the probability outside is one of many.
const FLAT: f64 = 0.1;

/// Steps towards a quantile at most.
const MOST_STEPS: u32 = 60;

/// So many standard errors of a count of independent points a quantile may be off by that count; the nets
/// scatter less.
const AGREES: f64 = 6.0;

impl Solved<'_> {
    /// The quantile of `p`, and its standard error.
    ///
    /// # Errors
    /// Why there is none.
    fn quantile(
        &mut self,
        p: f64,
        start: f64,
        scale: f64,
        columns: usize,
    ) -> Result<FigureWithError, String> {
        let mut y = start;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let found = self.at(y, columns);
            let [cdf, error] = mean(found.iter().map(|net| net[0]));
            let [density, _] = mean(found.iter().map(|net| net[1]));
            if cdf < p {
                low = y;
            } else {
                high = y;
            }
            let step = ((p - cdf) / density).clamp(-scale, scale);
            let step = if step.is_finite() { step } else { (p - cdf).signum() * scale };
            let mut next = y + step;
            if !(next > low && next < high) && next != y {
                next = if low.is_finite() && high.is_finite() { 0.5 * (low + high) } else { next };
            }
            if (next - y).abs() <= 1e-7 * scale {
                return if density > 0.0 {
                    Ok([next, error / density])
                } else {
                    Err(format!("the density is nearly zero at the quantile of {p:?}"))
                };
            }
            y = next;
        }
        Err(format!("the quantile of {p:?} was not found in {MOST_STEPS} steps"))
    }

    fn figures(
        &mut self,
        problem: &Problem<'_>,
        integrated: String,
        points: u64,
    ) -> Result<Noiseless, String> {
        let middle = self.setup.middle;
        // moments, about the value at the estimates
        let sums: Vec<[f64; 2]> = self
            .nets
            .iter()
            .map(|own| {
                let mut sums = [0.0; 2];
                for y in own.net.outputs.iter().flat_map(|column| column.0) {
                    sums[0] += y - middle;
                    sums[1] += (y - middle) * (y - middle);
                }
                sums.map(|sum| sum / (own.net.outputs.len() * COLUMN) as f64)
            })
            .collect();
        let [shift, shift_error] = mean(sums.iter().map(|sums| sums[0]));
        let variance = |of: &[f64; 2]| of[1] - 2.0 * shift * of[0] + shift * shift;
        let [variance, variance_error] = mean(sums.iter().map(variance));
        let u = variance.max(0.0).sqrt();
        let u_error = 0.5 * variance_error / u;
        if u.is_nan() || u <= 0.0 {
            return Err("the output does not vary".to_owned());
        }
        let p = problem.probability();
        let tail = 0.5 * (1.0 - p);
        // a start from the points themselves
        let mut sorted: Vec<f64> =
            self.nets.iter().flat_map(|own| own.net.outputs.iter().flat_map(|c| c.0)).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let rank = |p: f64| sorted[((p * sorted.len() as f64) as usize).min(sorted.len() - 1)];
        let scale = 0.5 * (rank(0.84) - rank(0.16));
        let all = usize::MAX;
        let starts = [0.5, tail, 1.0 - tail].map(|p| (p, rank(p)));
        let [median, low, high] = starts.map(|(p, start)| self.quantile(p, start, scale, all));
        let (median, low, high) = (median?, low?, high?);
        for (p, [found, _]) in [(0.5, median), (tail, low), (1.0 - tail, high)] {
            let below = sorted.partition_point(|&y| y <= found) as f64 / sorted.len() as f64;
            let error = (p * (1.0 - p) / sorted.len() as f64).sqrt();
            let off = (below - p).abs();
            if off.is_nan() || off > AGREES * error {
                return Err(format!(
                    "the quantile of {p:?} that was found has {below} of the points below it"
                ));
            }
        }
        let shortest = self.shortest(p, [low, high], scale);
        let inside = problem.tolerance().map(|tolerance| {
            let mut at = |y: f64, beyond: f64| -> Vec<f64> {
                if y.is_finite() {
                    self.at(y, all).iter().map(|net| net[0]).collect()
                } else {
                    vec![beyond; RANDOMIZATIONS as usize]
                }
            };
            let [lower, upper] = tolerance.ends();
            let (below, up_to) = (at(lower, 0.0), at(upper, 1.0));
            mean(up_to.iter().zip(&below).map(|(high, low)| high - low))
        });
        let [mean_exists, square_exists] = moments_exist(problem);
        let has_mean = problem.drawn_dof > 1.0 && mean_exists;
        let has_deviation = problem.drawn_dof > 2.0 && square_exists;
        // without a variance nothing tells how far the mean scatters
        Ok(Noiseless {
            estimate: has_mean.then_some(middle + shift),
            standard_uncertainty: has_deviation.then_some(u),
            median: median[0],
            symmetric_interval: [low[0], high[0]],
            shortest_interval: shortest.map(|(ends, _)| ends.map(|end| end[0])),
            shortest_unique: shortest.is_some_and(|(_, unique)| unique),
            inside: inside.map(|inside| inside[0].clamp(0.0, 1.0)),
            accuracy: Accuracy::Scatter(Box::new(Scatter {
                estimate: has_deviation.then_some(shift_error),
                standard_uncertainty: (has_deviation && problem.drawn_dof > 4.0).then_some(u_error),
                median: median[1],
                symmetric_interval: [low[1], high[1]],
                shortest_interval: shortest.map(|(ends, _)| ends.map(|end| end[1])),
                inside: inside.map(|inside| inside[1]),
                points,
                randomizations: RANDOMIZATIONS,
                integrated,
            })),
        })
    }

    /// The interval with these probabilities below and above it; to see where about something is from a few of
    /// the points.
    fn interval(
        &mut self,
        tails: [f64; 2],
        starts: [f64; 2],
        scale: f64,
        purpose: Purpose,
    ) -> Option<Interval> {
        if tails[0].min(tails[1]) < RESOLVED {
            return None;
        }
        let columns = match purpose {
            Purpose::Survey => {
                self.nets.first().map_or(1, |own| own.net.columns.len().div_ceil(16))
            }
            Purpose::Find => usize::MAX,
        };
        let low = self.quantile(tails[0], starts[0], scale, columns).ok()?;
        let high = self.quantile(1.0 - tails[1], starts[1], scale, columns).ok()?;
        let ends = [low[0], high[0]];
        let [of_low, of_high] = ends.map(|y| self.at(y, columns));
        let excesses = of_low.iter().zip(&of_high).map(|(low, high)| low[1] - high[1]);
        let [excess, error] = mean(excesses);
        let [density, _] = mean(of_low.iter().map(|net| net[1]));
        // far below the scatter of the randomizations, and above what the search for quantiles leaves
        let off = f64::max(SAME * error, SEARCHED * density);
        let of_length = crate::number::elementary::hypot(low[1], high[1]);
        Some(Interval { tails, ends, off: of_length, excess: [excess, off] })
    }

    /// The shortest interval of probability `p`, and whether it is the only one.
    fn shortest(
        &mut self,
        p: f64,
        symmetric: [FigureWithError; 2],
        scale: f64,
    ) -> Option<([FigureWithError; 2], bool)> {
        let tail = 1.0 - p;
        let mut starts = symmetric.map(|end| end[0]);
        let at = |tails: [f64; 2], purpose| {
            let found = self.interval(tails, starts, scale, purpose)?;
            starts = found.ends;
            Some(found)
        };
        let least = ShortestSearch { tail, at }.least()?;
        let is_flat = least.range[1] - least.range[0] > FLAT * tail;
        let length = symmetric[1][0] - symmetric[0][0];
        if is_flat || least.includes(0.5 * tail) || least.interval.length() >= length {
            let [low, high] = symmetric.map(|end| end[0]);
            let ends =
                if is_flat { symmetric } else { self.balanced_errors(p, [low, high], scale)? };
            return Some((ends, least.alone && !is_flat));
        }
        let ends = least.interval.ends;
        let found = if least.range[0] <= 0.0 || least.range[1] >= tail {
            // it begins or ends where the values do, no farther away than the density takes to hold
            // what is beyond
            let probabilities = [least.interval.tails[0], 1.0 - least.interval.tails[1]];
            let mut found = [[0.0; 2]; 2];
            for (place, (end, p)) in ends.into_iter().zip(probabilities).enumerate() {
                let nets = self.at(end, usize::MAX);
                let [_, error] = mean(nets.iter().map(|net| net[0]));
                let [density, _] = mean(nets.iter().map(|net| net[1]));
                let is_limit = (place == 0) == (least.range[0] <= 0.0);
                let beyond = if is_limit { p.min(1.0 - p) } else { 0.0 };
                found[place] = [end, (error + beyond) / density];
            }
            found
        } else {
            self.balanced_errors(p, ends, scale)?
        };
        Some((found, least.alone))
    }

    /// The ends of an interval at which the density is the same, and their standard errors: each
    /// randomization would move them to F(high) - F(low) = p, and the same density at both.
    fn balanced_errors(
        &mut self,
        p: f64,
        ends: [f64; 2],
        scale: f64,
    ) -> Option<[FigureWithError; 2]> {
        let all = usize::MAX;
        let density = |nets: &[OfNet]| mean(nets.iter().map(|net| net[1]))[0];
        let step = SLOPE_STEP * scale;
        let [rise, fall] = ends.map(|y| {
            let [before, after] =
                [y - 0.5 * step, y + 0.5 * step].map(|y| density(&self.at(y, all)));
            (after - before) / step
        });
        let [of_low, of_high] = ends.map(|y| self.at(y, all));
        let (dense_low, dense_high) = (density(&of_low), density(&of_high));
        let determinant = dense_high * rise - dense_low * fall;
        let moves: Vec<[f64; 2]> = of_low
            .iter()
            .zip(&of_high)
            .map(|(l, h)| {
                let (missing, excess) = (p - (h[0] - l[0]), l[1] - h[1]);
                [
                    (missing * fall - excess * dense_high) / determinant,
                    (missing * rise - excess * dense_low) / determinant,
                ]
            })
            .collect();
        (determinant > 0.0).then(|| {
            [0, 1].map(|end| {
                let [moved, error] = mean(moves.iter().map(|moved| moved[end]));
                [ends[end], crate::number::elementary::hypot(error, moved)]
            })
        })
    }
}
