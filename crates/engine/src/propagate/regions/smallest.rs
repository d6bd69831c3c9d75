//! Volume of the smallest coverage region of a few outputs (JCGM 102, 7.7.4).
//!
//! Where the fullest cells of a mesh are taken, their own noise chooses them: of three outputs and more
//! most cells hold one trial or none, and the volume is too small by as much as one likes. Here one half
//! of the trials makes an estimate g of the density, and the other half says at which level c the region
//! {g >= c} holds the probability p, so that no trial is counted in a region that it helped to choose; the
//! volume of that region is then integrated at the points of a net. Then the halves change places. No
//! region that holds p is smaller than the smallest; the excess of {g >= c} is of second order in the
//! error of g. What smoothing makes of it is told by three widths of the kernel, and the noise of g by
//! its variance at the edge of the region.
//!
//! Densities are estimated in coordinates in which the trials are nearly normal, see [`Coordinates`]:
//! limits and long tails of the outputs are then far out or near by as those of a normal distribution
//! are. Of several such coordinates those with the smallest region are taken.

mod components;
mod coordinates;
mod density;
#[cfg(test)]
mod tests;

use super::SmallestRegion;
use crate::linalg::packed;
use crate::number::elementary::{exp, hypot, pow};
use crate::parallel;
use crate::propagate::NetCoordinate;
use crate::special;
use coordinates::Coordinates;
use density::{Density, Mesh};

/// Outputs whose density trials tell, at most: of five, a million trials leave less than twenty in a
/// cube of one standard deviation at the edge of a region of 95 %.
pub(super) const MOST_OUTPUTS: usize = 4;

/// Trials that the volume is from, at most.
pub(super) const MOST_TRIALS: usize = 1 << 20;

/// The fewest trials, and the fewest of them outside of the region, in each half.
const LEAST_TRIALS: usize = 5000;
const LEAST_OUTSIDE: f64 = 50.0;

/// The largest share of the volume that its numerical standard error may have.
const LARGEST_ERROR: f64 = 0.1;

/// Places of a trial in as many coordinates as there are outputs; the others are not used.
pub(super) type TrialPlace = [f64; MOST_OUTPUTS];

/// Trials that one thread works on before it takes others.
const TOGETHER: usize = 8192;

/// Nets of points that a volume is integrated with, and how many points each has.
const NETS: u64 = 4;
const POINTS: u32 = 1 << 14;

/// The square of the relative noise of the density at the edge of the region that the narrowest kernel
/// leaves; and the widest one that is narrowest.
const NOISE: f64 = 0.005;
const WIDEST: f64 = 0.45;

/// The narrowest kernel, in steps of the mesh.
const STEPS: f64 = 1.4;

/// How far the mesh reaches beyond the region of a normal distribution.
const BEYOND: f64 = 1.5;

/// Cells of the mesh along each coordinate of 2, 3 and 4 outputs.
const CELLS: [usize; 3] = [400, 110, 40];

/// The smallest region that holds the probability. The trials are places in coordinates without
/// correlation, of variance 1 about 0; `to_outputs` is the lower triangle that makes the outputs'
/// deviations of them, packed.
///
/// # Errors
/// Why the trials do not carry it.
pub(super) fn smallest(
    trials: &[TrialPlace],
    to_outputs: &[f64],
    probability: f64,
) -> Result<SmallestRegion, String> {
    let (first, second) = trials.split_at(trials.len() / 2);
    let count = first.len();
    let outside = (1.0 - probability) * count as f64;
    if count < LEAST_TRIALS || outside < LEAST_OUTSIDE {
        return Err(format!(
            "it takes {} trials, {} of them outside of the region: there are {}, {:.0} of them outside",
            2 * LEAST_TRIALS,
            2.0 * LEAST_OUTSIDE,
            trials.len(),
            2.0 * outside
        ));
    }
    let smoothing = Smoothing::of(count, packed::rows(to_outputs).len(), probability);
    let both = [(first, second), (second, first)];
    let found = of_halves(both, to_outputs, probability, &smoothing)?;
    let excess = found.excess();
    let volume = found.volumes[2] - excess;
    let noise = smoothing.excess_of_noise * volume;
    let terms = [found.scatter, found.integration, excess, noise];
    let error = terms.iter().map(|term| term * term).sum::<f64>().sqrt();
    let size = exp(packed::ln_diagonal(to_outputs));
    // what is not a number is no volume either
    if volume > 0.0 && error <= LARGEST_ERROR * volume {
        return Ok(SmallestRegion { volume: volume * size, error: error * size });
    }
    Err(format!(
        "the trials do not give the density accurately enough: the numerical standard error would \
         be more than {:.0} % of the volume, because the density has edges or the outputs lie on \
         a curved surface",
        100.0 * LARGEST_ERROR
    ))
}

/// How densities are smoothed: from the widest kernel to the narrowest.
struct Smoothing {
    mesh: Mesh,
    widths: [f64; 3],
    /// The share of the volume by which the noise of the density makes a region too large with the
    /// narrowest kernel.
    excess_of_noise: f64,
}

impl Smoothing {
    /// For half of the trials.
    fn of(count: usize, order: usize, probability: f64) -> Self {
        use std::f64::consts::{PI, SQRT_2};
        let square = 2.0 * special::gamma::quantile(probability, 0.5 * order as f64);
        let power = |x: f64| (0..order).fold(1.0, |product, _| product * x);
        // of a normal density at the edge of the region
        let trials = count as f64 * exp(-0.5 * square) / power((2.0 * PI).sqrt());
        // the square of the relative noise is that of the kernel over it
        let noise = |width: f64| 1.0 / (trials * power(2.0 * PI.sqrt() * width));
        let mesh = Mesh::new(order, CELLS[order.clamp(2, 4) - 2], square.sqrt() + BEYOND);
        let wanted = pow(noise(1.0) / NOISE, 1.0 / order as f64);
        let narrowest = wanted.max(STEPS * mesh.step()).min(WIDEST);
        // a relative error e of a normal density moves the edge at the radius r by e/r, and the volume
        // grows by half the mean square of that, times order/r^2
        let excess_of_noise = 0.5 * noise(narrowest) * order as f64 / square;
        Self { mesh, widths: [2.0, SQRT_2, 1.0].map(|times| times * narrowest), excess_of_noise }
    }
}

/// Volumes with the three widths, as means of both halves, and their scatter with the narrowest.
struct FoundVolumes {
    volumes: [f64; 3],
    /// What the finite number of trials leaves of the level.
    scatter: f64,
    /// What the finite number of points leaves.
    integration: f64,
}

impl FoundVolumes {
    /// What the narrowest kernel still adds to the volume: differences of the three are continued as
    /// a geometric series, at the slowest as if the excess were proportional to the width, which it is
    /// where a density has edges; a smooth one has an excess of fourth order.
    fn excess(&self) -> f64 {
        let [wide, middle, narrow] = self.volumes;
        let (first, last) = (wide - middle, (middle - narrow).max(0.0));
        let slowest = std::f64::consts::FRAC_1_SQRT_2;
        let ratio = if first > 0.0 { (last / first).min(slowest) } else { slowest };
        last * ratio / (1.0 - ratio)
    }
}

/// What makes coordinates of trials and the triangle of the outputs.
type CoordinatesOf = fn(&[TrialPlace], &[f64]) -> Option<Coordinates>;

/// The volumes in the coordinates in which they are the smallest; of each half those that make the
/// density, and those that judge it.
fn of_halves(
    both: [(&[TrialPlace], &[TrialPlace]); 2],
    to_outputs: &[f64],
    probability: f64,
    smoothing: &Smoothing,
) -> Result<FoundVolumes, String> {
    let volumes = |way: CoordinatesOf, widths: &[f64]| -> Option<[Volumes; 2]> {
        let of = |(maker, judge): (&[TrialPlace], &[TrialPlace])| {
            let side = Side::new(way(maker, to_outputs)?, maker, judge, &smoothing.mesh);
            Some(side.volumes(widths, probability))
        };
        let [first, second] = both.map(of);
        Some([first?, second?])
    };
    let mean = |of: &[Volumes; 2], width: usize| {
        0.5 * of.iter().map(|side| side.volumes[width]).sum::<f64>()
    };
    let narrowest = |way: CoordinatesOf| Some((way, volumes(way, &smoothing.widths[2..])?));
    // an output that takes single values has no density, which mixed with others would not show
    let mut best = narrowest(Coordinates::outputs)
        .ok_or_else(|| "an output takes single values with a probability".to_owned())?;
    for way in [Coordinates::components, Coordinates::radial] {
        let others = narrowest(way).filter(|(_, others)| mean(others, 0) < mean(&best.1, 0));
        best = others.unwrap_or(best);
    }
    let (way, found) = best;
    let wider = volumes(way, &smoothing.widths[..2]).ok_or("no density can be estimated")?;
    let [first, second] = &found;
    Ok(FoundVolumes {
        volumes: [mean(&wider, 0), mean(&wider, 1), mean(&found, 0)],
        scatter: 0.5 * hypot(first.scatter, second.scatter),
        integration: 0.5 * hypot(first.integration, second.integration),
    })
}

/// Coordinates from one half of the trials, and both halves in them.
struct Side<'m> {
    mesh: &'m Mesh,
    coordinates: Coordinates,
    maker: Vec<TrialPlace>,
    /// Each with the density of its coordinates.
    judge: Vec<(TrialPlace, f64)>,
}

/// Volumes with some widths of the kernel, and how far the last one scatters.
struct Volumes {
    volumes: Vec<f64>,
    scatter: f64,
    integration: f64,
}

impl<'m> Side<'m> {
    fn new(
        coordinates: Coordinates,
        maker: &[TrialPlace],
        judge: &[TrialPlace],
        mesh: &'m Mesh,
    ) -> Self {
        let places = |trials: &[TrialPlace]| -> Vec<(TrialPlace, f64)> {
            let some = |chunk: &[TrialPlace]| -> Vec<(TrialPlace, f64)> {
                chunk.iter().map(|place| coordinates.of(place)).collect()
            };
            parallel::map(trials.chunks(TOGETHER), some).concat()
        };
        let maker = places(maker).into_iter().map(|(place, _)| place).collect();
        let judge = places(judge);
        Self { mesh, coordinates, maker, judge }
    }

    fn volumes(&self, widths: &[f64], probability: f64) -> Volumes {
        let order = self.mesh.order();
        let densities: Vec<Density<'_>> =
            widths.iter().map(|width| Density::of(self.mesh, &self.maker, *width)).collect();
        let levels: Vec<Levels> =
            densities.iter().map(|density| self.levels(density, probability)).collect();
        let bounds = self.bounds(&densities, &levels);
        let box_volume: f64 = bounds[..order].iter().map(|[low, high]| high - low).product();
        let net = |seed: u64| {
            let nets: Vec<NetCoordinate> =
                (0..order).map(|i| NetCoordinate::new(i, seed)).collect();
            let some = |first: u32| {
                let mut sums = vec![[0.0; 3]; densities.len()];
                for point in first..(first + TOGETHER as u32).min(POINTS) {
                    let mut place = TrialPlace::default();
                    for (i, net) in nets.iter().enumerate() {
                        let [low, high] = bounds[i];
                        place[i] = low + (high - low) * net.at(point);
                    }
                    let own = self.coordinates.density_at(&place);
                    let weight = box_volume / (own * f64::from(POINTS));
                    for ((density, levels), sums) in densities.iter().zip(&levels).zip(&mut sums) {
                        let found = density.at(&place) * own;
                        for (sum, level) in sums.iter_mut().zip(levels) {
                            *sum += if found >= *level { weight } else { 0.0 };
                        }
                    }
                }
                sums
            };
            (0..POINTS).step_by(TOGETHER).map(some).fold(
                vec![[0.0; 3]; densities.len()],
                |mut all, sums| {
                    for (all, sums) in all.iter_mut().flatten().zip(sums.iter().flatten()) {
                        *all += sums;
                    }
                    all
                },
            )
        };
        let by_net: Vec<Vec<[f64; 3]>> = parallel::map(0..NETS, net);
        let count = NETS as f64;
        let mean = |width: usize, level: usize| {
            by_net.iter().map(|sums| sums[width][level]).sum::<f64>() / count
        };
        let last = densities.len() - 1;
        let volume = mean(last, 1);
        let squares = by_net.iter().map(|sums| (sums[last][1] - volume).powi(2)).sum::<f64>();
        Volumes {
            volumes: (0..densities.len()).map(|width| mean(width, 1)).collect(),
            scatter: 0.25 * (mean(last, 2) - mean(last, 0)),
            integration: (squares / (count * (count - 1.0))).sqrt(),
        }
    }

    /// The level of the density that the probability lies above, between those of two standard
    /// deviations of the rank less and more.
    fn levels(&self, density: &Density<'_>, probability: f64) -> Levels {
        let some = |chunk: &[(TrialPlace, f64)]| -> Vec<f64> {
            chunk.iter().map(|(place, own)| density.at(place) * own).collect()
        };
        let mut found = parallel::map(self.judge.chunks(TOGETHER), some).concat();
        let count = found.len();
        let rank = probability * count as f64;
        let spread = (rank * (1.0 - probability)).sqrt();
        let mut at = |rank: f64| {
            let rank = (rank.ceil() as usize).clamp(1, count) - 1;
            *found.select_nth_unstable_by(rank, |a, b| b.total_cmp(a)).1
        };
        [-2.0, 0.0, 2.0].map(|times| at(rank + times * spread))
    }

    /// A box about all trials within a region, and a cell of the mesh.
    fn bounds(&self, densities: &[Density<'_>], levels: &[Levels]) -> [[f64; 2]; MOST_OUTPUTS] {
        let none = [[f64::INFINITY, f64::NEG_INFINITY]; MOST_OUTPUTS];
        let wider = |mut bounds: [[f64; 2]; MOST_OUTPUTS], place: &TrialPlace| {
            for ([low, high], x) in bounds.iter_mut().zip(place) {
                (*low, *high) = (low.min(*x), high.max(*x));
            }
            bounds
        };
        let some = |chunk: &[(TrialPlace, f64)]| {
            let is_inside = |(place, own): &&(TrialPlace, f64)| {
                densities
                    .iter()
                    .zip(levels)
                    .any(|(density, [_, _, least])| density.at(place) * own >= *least)
            };
            chunk.iter().filter(is_inside).fold(none, |bounds, (place, _)| wider(bounds, place))
        };
        let found = parallel::map(self.judge.chunks(TOGETHER), some);
        let ends = found.iter().fold(none, |all, range| {
            let [low, high] = [0, 1].map(|end| range.map(|ends| ends[end]));
            wider(wider(all, &low), &high)
        });
        let reach = self.mesh.reach();
        ends.map(|[low, high]| {
            [(low - self.mesh.step()).max(-reach), (high + self.mesh.step()).min(reach)]
        })
    }
}

/// Levels of the density, from that of less probability to that of more.
type Levels = [f64; 3];
