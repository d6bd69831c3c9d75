//! The distribution of a sum of independent quantities from the product of their characteristic
//! functions (Gil-Pelaez 1951): F(x) = 1/2 - 1/pi int_0^inf Im(e^(-itx) phi(t))/t dt.
//!
//! Where every summand stays within a reach, or leaves it with a probability that does not matter, the
//! integral is a sum over midpoints (j + 1/2) step: with a period 2 pi/step of twice the reach what is
//! left out is below the probability beyond it (Davies 1973). Heavy tails make phi singular at 0, and no
//! grid holds them: there the integral is taken over panels that shrink towards 0.
//!
//! A wide rectangle beside narrow quantities has a characteristic function that decays slowly. It is
//! taken out of the product: with H(z) = E max(z - Z, 0) of the other ones, the distribution function is
//! (H(x + w) - H(x - w))/2w, and the integrand of H falls by one power of t faster than that of their
//! own distribution function.

use std::f64::consts::{FRAC_1_PI, PI};

use super::term::Term;
use crate::distribution::characteristic::{Characteristic, NEGLIGIBLE, Reach, product};
use crate::number::elementary;
use crate::special::{self, legendre};

/// Distribution function, density and its slope at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct At {
    pub(super) cdf: f64,
    pub(super) density: f64,
    pub(super) slope: f64,
}

/// A sum of independent quantities about the sum of their means.
#[derive(Debug)]
pub(super) struct Inversion {
    /// Arguments, and real and imaginary part of the characteristic function there times the weight
    /// over pi.
    nodes: Vec<[f64; 3]>,
    /// The distance of the arguments, where they are midpoints.
    step: Option<f64>,
    /// Beyond this there is nothing.
    reach: f64,
    /// Beyond this the distribution function is not known.
    pub(super) known: f64,
    /// Half-width of a rectangle that is not among the nodes.
    rectangle: Option<f64>,
    /// Half-width of another one, where there is nothing else.
    second: Option<f64>,
    /// How far the distribution function may be off.
    pub(super) error: f64,
    /// How far the density may be off.
    pub(super) density_error: f64,
    /// What the nodes are multiplied by to fade them out towards a part of the largest argument, and towards
    /// all of it; none where the density is known without.
    fades: Vec<[f64; 2]>,
    /// What rounding leaves of a density that is faded out.
    rounding: f64,
    /// A measure of the sum's width.
    pub(super) width: f64,
}

/// Errors of the distribution function that are tried, the least first, and for how many arguments.
const WANTED: [(f64, usize); 6] = [
    (1e-16, 12_000),
    (1e-15, 8_000),
    (1e-14, 8_000),
    (1e-13, 8_000),
    (1e-12, 24_000),
    (1e-11, 131_072),
];

/// A density that is known to this share of its height is not improved.
const FINE: f64 = 1e-13;

/// The part up to which nothing is faded out.
const UNFADED: f64 = 0.25;

/// The part of the largest argument towards which a coarser mean is faded out.
const COARSE: f64 = 0.75;

/// Products of arguments and points at most: some tenths of a second.
const MOST_WORK: f64 = 2e7;

/// The phase that turns over a panel at the farthest place that is asked for, and the one up to which twenty
/// points of Gauss are exact to 1e-16.
const PHASE: f64 = 18.0;
const KNOWN: f64 = 24.0;

/// The ratio of two neighbours in a sum over a geometric series of arguments.
const RATIO_LN: f64 = std::f64::consts::LN_2 / 8.0;

/// How the characteristic function of a quantity that is known by points falls.
#[derive(Clone, Debug)]
pub(super) struct Decay {
    /// Arguments in ascending order, and what the modulus does not exceed from there to the next, or
    /// beyond the last.
    pub(super) bounds: Vec<[f64; 2]>,
    pub(super) width: f64,
    /// How far the points lie from their mean.
    pub(super) reach: f64,
    pub(super) points: usize,
}

impl Decay {
    fn at(&self, t: f64) -> f64 {
        let before = self.bounds.iter().take_while(|[from, _]| *from <= t).last();
        before.map_or(1.0, |[_, bound]| *bound)
    }
}

/// What is known of the sum before its characteristic function is computed.
pub(super) struct Sum<'t> {
    /// Terms in closed form.
    pub(super) closed: &'t [Term],
    /// What is known of the other ones.
    pub(super) open: &'t [Decay],
    /// The smaller of the probabilities beyond which the distribution is asked for.
    pub(super) tail: f64,
}

/// A way to the distribution: up to which argument, at how many of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct InversionPlan {
    /// The largest argument.
    pub(super) last: f64,
    /// What is left out of the distribution function beyond it, and of the density.
    error: f64,
    density_error: f64,
    step: Option<f64>,
    /// The length of a panel, where arguments are not midpoints.
    panel: f64,
    reach: f64,
    /// The closed term that is taken out.
    peeled: Option<usize>,
    width: f64,
}

impl Sum<'_> {
    fn terms(&self, without: Option<usize>) -> impl Iterator<Item = &Term> {
        let closed = self.closed.iter().enumerate().filter(move |(i, _)| Some(*i) != without);
        closed.map(|(_, term)| term)
    }

    /// What the modulus of the characteristic function does not exceed at `t` and beyond; of points
    /// about.
    fn bound(&self, t: f64, without: Option<usize>) -> f64 {
        let mut bound = 1.0;
        for term in self.terms(without) {
            bound *= term.bound(t);
        }
        for open in self.open {
            bound *= open.at(t);
        }
        bound.min(1.0)
    }

    /// 1/pi times the integral of the bound over t^-`power` from `t` on; infinite once it is above
    /// `most`.
    fn left_out(&self, t: f64, power: i32, without: Option<usize>, most: f64) -> f64 {
        let mut sum = 0.0;
        let mut last = f64::INFINITY;
        for k in 0..160 {
            let at = t * elementary::exp(RATIO_LN * f64::from(k));
            let bound = self.bound(at, without);
            last = bound / at.powi(power - 1);
            sum += last * RATIO_LN;
            if sum * FRAC_1_PI > most {
                return f64::INFINITY;
            }
            if last < 1e-3 * sum.min(1e-13) {
                return sum * FRAC_1_PI;
            }
        }
        // the rest of a series whose members fall by powers
        if last < 1e-4 * sum { (sum + 64.0 * last) * FRAC_1_PI } else { f64::INFINITY }
    }

    fn width(&self, without: Option<usize>) -> f64 {
        let widths = self.terms(without).map(|term| term.width());
        let widths = widths.chain(self.open.iter().map(|open| open.width));
        widths.map(|width| width * width).sum::<f64>().sqrt()
    }

    /// How far the sum is from its mean, but for a probability that does not matter; and whether some
    /// term has tails that no reach holds.
    fn reach(&self, without: Option<usize>) -> (f64, bool) {
        let (mut bounded, mut squares, mut normal, mut light) = (0.0, 0.0, 0.0, 0.0);
        let mut heavy = false;
        for open in self.open {
            bounded += open.reach;
            squares += open.reach * open.reach;
        }
        for term in self.terms(without) {
            match term.reach() {
                Reach::Bounded(reach) => {
                    bounded += reach;
                    squares += reach * reach;
                }
                Reach::Light(reach) if matches!(term.law, Characteristic::Normal { .. }) => {
                    normal += reach * reach;
                }
                Reach::Light(reach) => light += reach,
                Reach::Heavy(_) => heavy = true,
            }
        }
        // Hoeffding 1963: beyond x with at most 2 exp(-x^2/(2 sum of squares))
        (f64::min(bounded, 9.0 * squares.sqrt()) + normal.sqrt() + light, heavy)
    }

    /// How far the places are that are asked for, where tails are heavy.
    fn farthest(&self) -> f64 {
        let count = self.closed.len() + self.open.len();
        let tail = self.tail / count.max(1) as f64;
        let far = self.terms(None).map(|term| match (term.reach(), &term.law) {
            (Reach::Heavy(scale), Characteristic::Student(student)) => {
                -scale * special::student::quantile(tail, student.dof())
            }
            (Reach::Bounded(reach) | Reach::Light(reach) | Reach::Heavy(reach), _) => reach,
        });
        far.sum::<f64>() + self.open.iter().map(|open| open.reach).sum::<f64>()
    }

    /// The least costly way that is exact enough.
    ///
    /// # Errors
    /// Why there is none.
    pub(super) fn plan(&self) -> Result<InversionPlan, String> {
        let whole = self.try_plan(None);
        if let Some((plan, 0..=2)) = whole {
            return Ok(plan);
        }
        let rectangles = self.closed.iter().enumerate().filter_map(|(i, term)| match term.law {
            Characteristic::Trapezoid { share, narrow, .. } if share == 0.0 && narrow == 0.0 => {
                Some((i, term.width()))
            }
            _ => None,
        });
        let widest = rectangles.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i);
        let several = self.closed.len() + self.open.len() > 1;
        let peeled = widest.filter(|_| several).and_then(|i| self.try_plan(Some(i)));
        let best = match (whole, peeled) {
            (Some(whole), Some(peeled)) => Some(if peeled.1 < whole.1 { peeled } else { whole }),
            (whole, peeled) => whole.or(peeled),
        };
        best.map(|(plan, _)| plan).ok_or_else(|| {
            "the characteristic function decays too slowly: narrow contributions beside wide ones \
             without a smooth one"
                .to_owned()
        })
    }

    /// The first wanted error that can be had, and which one it is.
    fn try_plan(&self, without: Option<usize>) -> Option<(InversionPlan, usize)> {
        let width = self.width(without);
        let (reach, heavy) = self.reach(without);
        if without.is_some() && heavy || width.is_nan() || width <= 0.0 {
            return None;
        }
        let power = if without.is_some() { 2 } else { 1 };
        // errors of H are divided by the half-width
        let scale = without.map_or(1.0, |i| 1.0 / (self.closed[i].width() * 3f64.sqrt()));
        let costs = self.terms(without).map(|term| term.law.cost());
        let work: usize = costs.chain(self.open.iter().map(|open| open.points)).sum();
        for (number, (wanted, most)) in WANTED.into_iter().enumerate() {
            let left_out = |t: f64| scale * self.left_out(t, power, without, wanted / scale);
            let enough = |t: f64| left_out(t) <= wanted;
            let farthest = if heavy { self.farthest() + reach } else { 0.0 };
            let period = if heavy { 0.0 } else { 2.02 * reach * f64::from(power) };
            let step = std::f64::consts::TAU / period;
            let panel = PHASE / farthest;
            let count = |t: f64| {
                if heavy { legendre::COUNT as f64 * (t / panel + 30.0) } else { t / step }
            };
            let possible = |t: f64| {
                let count = count(t);
                count <= most as f64 && (number == 0 || count * work as f64 <= MOST_WORK)
            };
            let mut last = 1.0 / width;
            while possible(last) && !enough(last) {
                last *= 2.0;
            }
            if !possible(last) {
                let before = 0.5 * last;
                // the last doubling may be too much, and less of it enough
                let between = [1.25, 1.5, 1.75].map(|f| f * before);
                match between.into_iter().find(|&t| possible(t) && enough(t)) {
                    Some(t) => last = t,
                    None => continue,
                }
            } else {
                for factor in [0.55, 0.65, 0.75, 0.85] {
                    if last > 1.0 / width && enough(factor * last) {
                        last *= factor;
                        break;
                    }
                }
            }
            let error = left_out(last);
            let step = (!heavy).then_some(step);
            let density_error = scale * self.left_out(last, power - 1, without, f64::INFINITY);
            let plan = InversionPlan {
                last,
                error,
                density_error,
                step,
                panel,
                reach,
                peeled: without,
                width,
            };
            return Some((plan, number));
        }
        None
    }
}

/// Points of a quadrature at equal steps: a rotation for each point and step, made anew now and then.
fn rotate_points(term: &Term, step: f64, values: &mut [[f64; 2]]) {
    const ANEW: usize = 64;
    let Characteristic::Points(points) = &term.law else {
        return;
    };
    let moved: Vec<[f64; 2]> = points.iter().map(|[v, w]| [v * term.factor, *w]).collect();
    let steps: Vec<[f64; 2]> = moved
        .iter()
        .map(|[value, _]| {
            let (sin, cos) = elementary::sin_cos(step * value);
            [cos, sin]
        })
        .collect();
    let mut state = vec![[0.0; 2]; moved.len()];
    for (chunk, values) in values.chunks_mut(ANEW).enumerate() {
        let first = ((chunk * ANEW) as f64 + 0.5) * step;
        for (state, [value, weight]) in state.iter_mut().zip(&moved) {
            let (sin, cos) = elementary::sin_cos(first * value);
            *state = [weight * cos, weight * sin];
        }
        for value in values {
            let mut sum = [[0.0; 2]; 4];
            for (state, steps) in state.chunks_mut(4).zip(steps.chunks(4)) {
                for ((sum, state), step) in sum.iter_mut().zip(state).zip(steps) {
                    sum[0] += state[0];
                    sum[1] += state[1];
                    *state = product(*state, *step);
                }
            }
            let [a, b, c, d] = sum;
            *value = product(*value, [a[0] + b[0] + (c[0] + d[0]), a[1] + b[1] + (c[1] + d[1])]);
        }
    }
}

/// From 1 at and below a part smoothly to 0 at 1.
fn fade(share: f64) -> f64 {
    let s = (share - UNFADED) / (1.0 - UNFADED);
    if s <= 0.0 {
        return 1.0;
    }
    if s >= 1.0 {
        return 0.0;
    }
    1.0 / (1.0 + elementary::exp(1.0 / (1.0 - s) - 1.0 / s))
}

impl Inversion {
    /// The sum of all terms, by a plan made from those of them that are closed, which come first.
    pub(super) fn new(terms: &[Term], plan: InversionPlan) -> Self {
        let kept = || terms.iter().enumerate().filter(|(i, _)| Some(*i) != plan.peeled);
        let mut arguments: Vec<[f64; 2]> = Vec::new();
        if let Some(step) = plan.step {
            let count = (plan.last / step).ceil().max(8.0) as usize;
            arguments.extend((0..count).map(|j| [(j as f64 + 0.5) * step, step]));
        } else {
            let rule = legendre::nodes();
            let mut panels = Vec::new();
            let first = plan.panel.min(plan.last);
            let mut end = first;
            for _ in 0..26 {
                panels.push([0.25 * end, end]);
                end *= 0.25;
            }
            panels.reverse();
            let more = ((plan.last - first) / plan.panel).ceil() as usize;
            panels.extend((0..more).map(|k| {
                let start = first + k as f64 * plan.panel;
                [start, start + plan.panel]
            }));
            for [start, end] in panels {
                let width = end - start;
                arguments.extend(rule.iter().map(|[x, w]| [start + width * x, w * width]));
            }
        }
        let mut values = vec![[1.0, 0.0]; arguments.len()];
        for (_, term) in kept() {
            match plan.step {
                Some(step) if matches!(term.law, Characteristic::Points(_)) => {
                    rotate_points(term, step, &mut values);
                }
                _ => {
                    for (value, [t, _]) in values.iter_mut().zip(&arguments) {
                        *value = product(*value, term.at(*t));
                    }
                }
            }
        }
        let mut weights = 0.0;
        let mut first_moment = 0.0;
        let nodes: Vec<[f64; 3]> = arguments
            .iter()
            .zip(&values)
            .map(|([t, weight], [re, im])| {
                let weight = weight * FRAC_1_PI;
                let modulus = elementary::hypot(*re, *im);
                weights += weight / t * modulus.max(1e-3);
                first_moment += weight * modulus;
                [*t, weight * re, weight * im]
            })
            .collect();
        let numeric: f64 = terms.iter().map(|term| term.error).sum();
        let count = terms.len() as f64;
        // rounding of every factor, of the argument of sine and cosine, and of the sum
        let relative = 4e-16 * (count + 4.0) + numeric;
        let lumps = 2.0 * (count + 1.0) * NEGLIGIBLE;
        let peeled = plan.peeled.map_or(0.0, |i| terms[i].width());
        let width = elementary::hypot(plan.width, peeled);
        let rounding = relative * first_moment + lumps / width;
        let density_error = plan.density_error + rounding;
        let of_all = |[t, _, _]: &[f64; 3]| [COARSE, 1.0].map(|part| fade(t / (part * plan.last)));
        let fades = if density_error * width > FINE {
            nodes.iter().map(of_all).collect()
        } else {
            Vec::new()
        };
        Self {
            nodes,
            step: plan.step,
            reach: plan.reach,
            known: if plan.step.is_some() { f64::INFINITY } else { KNOWN / plan.panel },
            rectangle: plan.peeled.map(|i| terms[i].width() * 3f64.sqrt()),
            second: None,
            error: plan.error + relative * weights.max(1.0) + lumps,
            density_error,
            fades,
            rounding,
            width,
        }
    }

    /// Calls with the argument of each node in turn and with e^(-itx) phi there, times its weight.
    fn each(&self, x: f64, mut of: impl FnMut(f64, [f64; 2])) {
        const ANEW: usize = 8;
        let mut add = |[t, re, im]: [f64; 3], sin: f64, cos: f64| {
            of(t, [re * cos + im * sin, im * cos - re * sin]);
        };
        let Some(step) = self.step else {
            for &node in &self.nodes {
                let (sin, cos) = elementary::sin_cos(node[0] * x);
                add(node, sin, cos);
            }
            return;
        };
        let (sin, cos) = elementary::sin_cos(step * x);
        let turn = [cos, sin];
        for nodes in self.nodes.chunks(ANEW) {
            let (sin, cos) = elementary::sin_cos(nodes[0][0] * x);
            let mut state = [cos, sin];
            for &node in nodes {
                add(node, state[1], state[0]);
                state = product(state, turn);
            }
        }
    }

    /// The sums over all nodes at a place: of Im/t, of Re, of t Im, and of Re/t^2, of e^(-itx) phi.
    fn sums(&self, x: f64) -> [f64; 4] {
        let mut sums = [0.0; 4];
        self.each(x, |t, [real, imaginary]| {
            let inverse = 1.0 / t;
            sums[0] += imaginary * inverse;
            sums[1] += real;
            sums[2] += imaginary * t;
            sums[3] += real * inverse * inverse;
        });
        sums
    }

    /// The density at a place, counted from the mean, and how far it may be off. What is left out beyond
    /// the largest argument is up to ten powers of ten more than what it changes: away from the places where
    /// the density has kinks it averages out where the characteristic function is faded out smoothly, which
    /// replaces the density by a mean over a neighbourhood that has all moments of a point
    /// (Vandeven 1991). Two such means tell how far the finer one may be off.
    pub(super) fn density(&self, x: f64) -> [f64; 2] {
        let plain = [self.at(x).density, self.density_error];
        if self.fades.is_empty() {
            return plain;
        }
        let [coarse, fine] = match self.rectangle {
            None => self.faded(x).map(|[_, density]| density),
            Some(half) => {
                let [low, high] = [self.faded(x - half), self.faded(x + half)];
                [0, 1].map(|i| (high[i][0] - low[i][0]) / (2.0 * half))
            }
        };
        let off = (fine - coarse).abs() + self.rounding;
        if off < plain[1] { [fine, off] } else { plain }
    }

    /// Distribution function and density of the nodes, faded out towards a part of the largest argument and
    /// towards all of it.
    fn faded(&self, x: f64) -> [[f64; 2]; 2] {
        if x.abs() >= self.reach && self.step.is_some() {
            return [[if x < 0.0 { 0.0 } else { 1.0 }, 0.0]; 2];
        }
        let mut sums = [[0.5, 0.0]; 2];
        let mut fades = self.fades.iter();
        self.each(x, |t, [real, imaginary]| {
            for (sums, weight) in sums.iter_mut().zip(fades.next().into_iter().flatten()) {
                sums[0] -= weight * imaginary / t;
                sums[1] += weight * real;
            }
        });
        sums
    }

    /// A sum of two rectangular quantities.
    pub(super) fn of_rectangles(terms: &[Term]) -> Option<Self> {
        let half = |term: &Term| match term.law {
            Characteristic::Trapezoid { wide, narrow, share } if share == 0.0 && narrow == 0.0 => {
                Some(wide * term.factor.abs())
            }
            _ => None,
        };
        let [a, b] = terms else {
            return None;
        };
        let (a, b) = (half(a)?, half(b)?);
        let (wide, narrow) = (a.max(b), a.min(b));
        Some(Self {
            nodes: Vec::new(),
            step: None,
            reach: narrow,
            known: f64::INFINITY,
            rectangle: Some(wide),
            second: Some(narrow),
            error: 4e-16,
            density_error: 4e-16 / wide,
            fades: Vec::new(),
            rounding: 0.0,
            width: elementary::hypot(wide, narrow) / 3f64.sqrt(),
        })
    }

    /// Of the terms without a rectangle that was taken out: H, distribution function and density.
    fn rest(&self, z: f64) -> [f64; 3] {
        if z <= -self.reach {
            return [0.0, 0.0, 0.0];
        }
        if z >= self.reach {
            return [z, 1.0, 0.0];
        }
        if let Some(half) = self.second {
            let inside = z + half;
            return [0.25 * inside * inside / half, 0.5 * inside / half, 0.5 / half];
        }
        let sums = self.sums(z);
        let modulus = self.step.map_or(f64::NAN, |step| PI / step) - 2.0 * sums[3];
        [0.5 * (z + modulus), 0.5 - sums[0], sums[1]]
    }

    /// The distribution at a place, counted from the mean.
    pub(super) fn at(&self, x: f64) -> At {
        let Some(half) = self.rectangle else {
            if self.step.is_some() && x.abs() >= self.reach {
                let cdf = if x < 0.0 { 0.0 } else { 1.0 };
                return At { cdf, density: 0.0, slope: 0.0 };
            }
            let sums = self.sums(x);
            return At { cdf: 0.5 - sums[0], density: sums[1], slope: sums[2] };
        };
        let (low, high) = (self.rest(x - half), self.rest(x + half));
        let difference = |i: usize| (high[i] - low[i]) / (2.0 * half);
        At { cdf: difference(0), density: difference(1), slope: difference(2) }
    }
}
