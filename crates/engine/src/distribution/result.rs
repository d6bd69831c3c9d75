//! One output of a saved result (JCGM 101, 6.4.12: a distribution known from an earlier
//! evaluation).
//!
//! Trials are drawn through the quantile function of the saved run's trials. It is tabulated over
//! normal scores: entry k is the quantile at the probability Phi(z_k), z_k = from + k step. Equal
//! steps of the score become finer in probability towards the tails, one multiplication gives the
//! position in the table, and a nearly normal result is nearly a straight line. Between entries the
//! function is linear, so it never decreases; beyond them it is constant.
//!
//! To first order a result is a weighted sum of the inputs that its model file names ([`Root`]).
//! Two results with a common root are dependent, and their weights give the correlation.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use super::shape::{Invalid, Shape, finite, positive};
use super::stream::Stream;
use super::{Distribution, normal};
use crate::number::Column;
use crate::special;

/// The normal scores over which a quantile function is tabulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scores {
    /// The first score.
    pub from: f64,
    /// The distance of two scores.
    pub step: f64,
    /// Their number.
    pub count: usize,
}

impl Scores {
    /// The scores in the files that this version writes: six standard deviations on both sides,
    /// with a probability of 1e-9 beyond either end.
    pub const WRITTEN: Self = Self { from: -6.0, step: 0.007_812_5, count: 1537 };

    /// The scores in order.
    pub fn values(self) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |k| self.from + k as f64 * self.step)
    }
}

/// A named input of a model file. Files are distinguished by their content, and evaluations of one
/// file by the values that they used for the input. A value of a certificate is the same in all
/// model files that take it from there, whatever its name and unit.
#[derive(Clone, Debug)]
pub struct RootName {
    /// SHA-256 of the model file, in hexadecimal.
    pub model: Arc<str>,
    /// The input, or `input/component`.
    pub name: Arc<str>,
    /// The values that the evaluation used for it, and its [`Occasion`], as text.
    pub instance: Arc<str>,
    /// For a value of a certificate: the certificate's content, the value's path in it and the row,
    /// as text. It alone decides whether two are the same.
    pub certified: Option<Arc<str>>,
}

/// The context that distinguishes an input from that of the same name and values in another
/// evaluation of the same model file: other data, another row or another value on the command line,
/// which the file's text does not show.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Occasion {
    /// SHA-256 of the data files from which it was read; `None` if the model file contains
    /// everything.
    pub data: Option<Arc<str>>,
    /// The conditions for which it has its own value; `None` if all rows share one.
    pub row: Option<Arc<str>>,
    /// If its values follow the conditions, so that other values do not mean another quantity: the
    /// replacements of the file's values, possibly none.
    pub follows: Option<Arc<str>>,
    /// For a value of a certificate (the file of `data`), its path there; `None` for other values,
    /// and if it was replaced.
    pub certified: Option<Arc<str>>,
}

/// The relative difference of values, in standard uncertainties for estimates, above which two
/// inputs are different. It is far below the difference of two readings, and far above the rounding
/// differences of machines.
const TOLD_APART: f64 = 1e-6;

impl RootName {
    /// The name of an input with these values.
    pub fn new(
        (model, name): (Arc<str>, Arc<str>),
        occasion: &Occasion,
        figures: &RootFigures,
    ) -> Self {
        let mut instance = match &occasion.follows {
            Some(replaced) => format!("follows the conditions, {replaced}"),
            None => figures.text(),
        };
        for (what, of) in [("data", &occasion.data), ("row", &occasion.row)] {
            if let Some(of) = of {
                instance += &format!("; {what} {of}");
            }
        }
        let certified = occasion.certified.as_ref().zip(occasion.data.as_ref());
        let certified = certified.map(|(place, data)| {
            let row = occasion.row.as_ref().map_or(String::new(), |row| format!("; row {row}"));
            format!("{place} of {data}{row}").into()
        });
        Self { model, name, instance: instance.into(), certified }
    }

    /// The parts that are equal for two names of the same input.
    fn identity(&self) -> [&str; 3] {
        match &self.certified {
            Some(certified) => ["", "", certified],
            None => [&self.model, &self.name, &self.instance],
        }
    }
}

impl PartialEq for RootName {
    fn eq(&self, other: &Self) -> bool {
        self.identity() == other.identity()
    }
}

impl Eq for RootName {}

impl Hash for RootName {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.identity().hash(state);
    }
}

impl PartialOrd for RootName {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for RootName {
    fn cmp(&self, other: &Self) -> Ordering {
        self.identity().cmp(&other.identity())
    }
}

/// The values of an input in an evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootFigures {
    /// Its estimate in its unit.
    pub estimate: f64,
    /// Its standard uncertainty in its unit.
    pub standard_uncertainty: f64,
    /// Degrees of freedom of its standard uncertainty.
    pub dof: f64,
}

impl RootFigures {
    /// The values of an input with a distribution.
    pub fn of(known: &Distribution) -> Self {
        Self {
            estimate: known.mean(),
            standard_uncertainty: known.standard_uncertainty(),
            dof: known.dof(),
        }
    }

    fn text(&self) -> String {
        let (u, dof) = (self.standard_uncertainty, self.dof);
        let steps = (self.estimate / (TOLD_APART * u)).round();
        // 0 has one sign
        let steps = if steps.is_finite() { steps + 0.0 } else { self.estimate };
        format!("{steps:e} steps, u {u:.6e}, dof {dof:.6e}")
    }
}

/// An original input of a result, as it was when the result was saved.
#[derive(Clone, Debug, PartialEq)]
pub struct Root {
    /// Which one.
    pub name: RootName,
    /// Its unit, as text.
    pub unit: String,
    /// Name of its distribution.
    pub distribution: String,
    /// Its estimate in its unit.
    pub estimate: f64,
    /// Its standard uncertainty in its unit.
    pub standard_uncertainty: f64,
    /// Standard deviation of its drawn values; infinite if there is none.
    pub standard_deviation: f64,
    /// Degrees of freedom of its standard uncertainty.
    pub dof: f64,
    /// The context that distinguishes it from inputs of the same name.
    pub occasion: Occasion,
}

impl Root {
    /// What was known of it.
    pub fn figures(&self) -> RootFigures {
        let Self { estimate, standard_uncertainty, dof, .. } = *self;
        RootFigures { estimate, standard_uncertainty, dof }
    }
}

/// Two roots with their correlation coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct RootCorrelation {
    /// The first one.
    pub first: RootName,
    /// The second one.
    pub second: RootName,
    /// The coefficient.
    pub coefficient: f64,
}

/// Where a result comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// SHA-256 of the result file, in hexadecimal.
    pub file: Arc<str>,
    /// The output's name in it.
    pub output: String,
    /// The roots with their weights c u(x)/u(y): dimensionless, signed. If the result has no finite
    /// sensitivity coefficients, it is its own only root.
    pub roots: Vec<(Root, f64)>,
    /// Whether the roots come from sensitivity coefficients.
    pub linear: bool,
    /// Correlation coefficients between roots of the file.
    pub correlations: Arc<[RootCorrelation]>,
    /// All roots of the file, including those on which only other outputs depend: results that
    /// depend on them elsewhere may be correlated with this result.
    pub known: Arc<[Root]>,
    /// Correlation coefficients with the other outputs of the file, from its trials.
    pub siblings: Vec<(String, f64)>,
    /// SHA-256 of the model file whose result was saved.
    pub model: Arc<str>,
    /// The effective number of trials behind its values: that of its run, or fewer if the run used
    /// saved results of few trials. Infinite if the file does not say.
    pub trials: f64,
    /// The seed of its random streams.
    pub seed: Option<u64>,
    /// Its ranks, from 0, in some of the trials; entry i belongs to the same trial for all outputs
    /// of the file. `None` if the file has none.
    pub ranks: Option<Arc<[u32]>>,
}

impl Origin {
    /// Whether a root has finite degrees of freedom.
    pub(crate) fn has_finite_dof(&self) -> bool {
        self.roots.iter().any(|(root, _)| root.dof.is_finite())
    }

    /// Whether no root with finite degrees of freedom is correlated with another one, so that the
    /// Welch-Satterthwaite formula holds for them.
    pub(crate) fn has_independent_roots(&self) -> bool {
        let find = |name: &RootName| self.roots.iter().find(|(root, _)| root.name == *name);
        !self.correlations.iter().any(|c| {
            let pair = find(&c.first).zip(find(&c.second));
            pair.is_some_and(|((a, _), (b, _))| a.dof.is_finite() || b.dof.is_finite())
        })
    }
}

/// The values of a saved output, in one unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saved {
    /// The estimate by the law of propagation, or by the trials if there is none.
    pub estimate: f64,
    /// The corresponding standard uncertainty.
    pub standard_uncertainty: f64,
    /// Standard deviation of the trials; infinite if the distribution has none.
    pub standard_deviation: f64,
    /// Effective degrees of freedom; NaN if they are undefined.
    pub dof: f64,
    /// The fewest degrees of freedom of any t distribution that affects the trials.
    pub drawn_dof: f64,
}

/// One output of a saved result as the distribution of an input.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedResult {
    saved: Saved,
    from: f64,
    per_score: f64,
    /// Value and difference to the next entry.
    cells: Arc<[[f64; 2]]>,
    /// Expectation of the drawn values.
    drawn_mean: f64,
    origin: Arc<Origin>,
}

impl SavedResult {
    /// A result with the given values, whose quantiles over `scores` are `quantiles`, in the same
    /// unit.
    ///
    /// # Errors
    /// Numbers that are not finite, a standard uncertainty that is not positive, fewer than two
    /// quantiles or another number than scores, quantiles that decrease.
    pub fn new(
        saved: Saved,
        scores: Scores,
        quantiles: &[f64],
        origin: Origin,
    ) -> Result<Self, Invalid> {
        finite("estimate", saved.estimate)?;
        positive("standard_uncertainty", saved.standard_uncertainty)?;
        positive("step", scores.step)?;
        finite("from", scores.from)?;
        let wrong = |value: f64, range: &'static str| {
            Err(Invalid::OutOfRange { parameter: "quantiles", value, range })
        };
        if quantiles.len() < 2 || quantiles.len() != scores.count {
            return wrong(quantiles.len() as f64, "as many as scores, at least two");
        }
        for &value in quantiles {
            finite("quantiles", value)?;
        }
        if let Some(pair) = quantiles.windows(2).find(|pair| pair[0] > pair[1]) {
            return wrong(pair[1], "not below the one before it");
        }
        let per_score = finite("step", 1.0 / scores.step)?;
        let (cells, origin) = (cells(quantiles.iter().copied()), Arc::new(origin));
        let (drawn_mean, std) = moments(&cells, scores);
        let mut saved = saved;
        if saved.standard_deviation.is_finite() {
            saved.standard_deviation = positive("quantiles", std)?;
        }
        Ok(Self { saved, from: scores.from, per_score, cells, drawn_mean, origin })
    }

    /// The same result in another unit, `factor` of which make one of the present one.
    ///
    /// # Errors
    /// Values beyond the range of `f64`.
    pub fn scaled(&self, factor: f64) -> Result<Self, Invalid> {
        let saved = Saved {
            estimate: finite("estimate", factor * self.saved.estimate)?,
            standard_uncertainty: positive(
                "standard_uncertainty",
                factor * self.saved.standard_uncertainty,
            )?,
            standard_deviation: factor * self.saved.standard_deviation,
            ..self.saved
        };
        let cells = cells(self.cells.iter().map(|cell| factor * cell[0]));
        let drawn_mean = factor * self.drawn_mean;
        Self { saved, cells, drawn_mean, ..self.clone() }.within_range()
    }

    /// The error for tables with ends beyond the range of `f64`.
    fn within_range(self) -> Result<Self, Invalid> {
        for cell in [self.cells.first(), self.cells.last()].into_iter().flatten() {
            finite("quantiles", cell[0])?;
        }
        Ok(self)
    }

    /// The same result with another origin.
    #[must_use]
    pub fn with_origin(&self, origin: Origin) -> Self {
        Self { origin: Arc::new(origin), ..self.clone() }
    }

    /// Where it comes from.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// The scores over which the quantile function is tabulated.
    pub(super) fn scores(&self) -> Scores {
        Scores { from: self.from, step: 1.0 / self.per_score, count: self.cells.len() }
    }

    /// Expectation of the drawn values; it may differ from the estimate, which is that of the law
    /// of propagation.
    pub(crate) fn drawn_mean(&self) -> f64 {
        self.drawn_mean
    }

    /// The value at a normal score. Plain arithmetic, so the bits are the same on every machine.
    #[inline(always)]
    pub(super) fn at(&self, score: f64) -> f64 {
        let last = self.cells.len() - 1;
        let position = ((score - self.from) * self.per_score).clamp(0.0, last as f64);
        let cell = (position as usize).min(last);
        let [start, rise] = self.cells[cell];
        start + rise * (position - cell as f64)
    }

    /// The value at the fraction `share` (from 0 to 1) of the probability interval of the rank
    /// `rank`, counted from 0, out of `count`.
    pub(super) fn in_rank(&self, rank: u32, share: f64, count: u32) -> f64 {
        let (rank, count) = (f64::from(rank), f64::from(count));
        // the tail on the near side keeps its digits
        self.at(if rank < 0.5 * count {
            special::normal::quantile((rank + share) / count)
        } else {
            special::normal::quantile_upper((count - rank - share) / count)
        })
    }

    /// Whether the two results are dependent: outputs of one file, or results with a common root or
    /// with correlated roots.
    pub fn is_linked(&self, other: &Self) -> bool {
        let (a, b) = (&self.origin, &other.origin);
        a.file == b.file || !shared(a, b).is_empty()
    }

    /// Whether correlation coefficients between the roots of the two results determine their
    /// dependence.
    pub(crate) fn is_told_by_roots(&self, other: &Self) -> bool {
        !shared(&self.origin, &other.origin).is_empty()
    }

    /// The correlation coefficient of two dependent results by the law of propagation; `None` if
    /// they are independent, or if one has no sensitivity coefficients.
    pub fn linear_coefficient(&self, other: &Self) -> Option<f64> {
        let (a, b) = (&self.origin, &other.origin);
        let one_file = a.file == b.file;
        if one_file && a.output == b.output {
            return Some(1.0);
        }
        let shared = shared(a, b);
        let told = if one_file { a.linear && b.linear } else { !shared.is_empty() };
        told.then(|| shared.iter().map(|term| term.product).sum::<f64>().clamp(-1.0, 1.0))
    }

    /// The correlation coefficient of the trials of two dependent results: as saved for two outputs
    /// of one file, otherwise that of the weighted sums of the roots as drawn.
    pub fn drawn_coefficient(&self, other: &Self) -> Option<f64> {
        let (a, b) = (&self.origin, &other.origin);
        if a.file == b.file && a.output != b.output {
            let saved = a.siblings.iter().find(|(name, _)| *name == b.output);
            if let Some(&(_, r)) = saved {
                return Some(r);
            }
        }
        let linear = self.linear_coefficient(other)?;
        let product = |a: &Origin, b: &Origin| shared(a, b).iter().map(|t| t.drawn).sum::<f64>();
        let drawn = product(a, b) / (product(a, a) * product(b, b)).sqrt();
        let drawn = drawn.clamp(-1.0, 1.0);
        // a root without a variance contributes none
        Some(if drawn.is_finite() { drawn } else { linear })
    }

    /// Whether the dependence of two results comes only from common roots, so that degrees of
    /// freedom can be counted root by root.
    pub(crate) fn is_by_roots(&self, other: &Self) -> bool {
        let (a, b) = (&self.origin, &other.origin);
        if !a.linear || !b.linear {
            return a.file == b.file && a.output == b.output;
        }
        !shared(a, b).iter().any(|term| !term.same && term.finite_dof)
    }
}

fn cells(values: impl Iterator<Item = f64>) -> Arc<[[f64; 2]]> {
    let values: Vec<f64> = values.collect();
    let next = values.iter().skip(1).chain(values.last());
    values.iter().zip(next).map(|(&value, &next)| [value, next - value]).collect()
}

/// Expectation and standard deviation of the tabulated function of a standard normal quantity:
/// integrals of its linear pieces, of the deviation from the middle entry.
fn moments(cells: &[[f64; 2]], scores: Scores) -> (f64, f64) {
    let density = |z: f64| libm::exp(-0.5 * z * z) / std::f64::consts::TAU.sqrt();
    let (Some(&[first, _]), Some(&[last, _])) = (cells.first(), cells.last()) else {
        return (f64::NAN, f64::NAN);
    };
    let middle = cells[cells.len() / 2][0];
    let end = scores.from + (cells.len() - 1) as f64 * scores.step;
    let (below, above) = (special::normal::cdf(scores.from), special::normal::sf(end));
    let (low, high) = (first - middle, last - middle);
    let (mut sum, mut squares) =
        (below * low + above * high, below * low * low + above * high * high);
    for (k, [start, rise]) in cells.iter().enumerate().take(cells.len() - 1) {
        let left = scores.from + k as f64 * scores.step;
        let right = left + scores.step;
        // tail on the near side, so that small probabilities keep their digits
        let mass = if left < 0.0 {
            special::normal::cdf(right) - special::normal::cdf(left)
        } else {
            special::normal::sf(left) - special::normal::sf(right)
        };
        let slope = rise / scores.step;
        let constant = start - middle - slope * left;
        let linear = density(left) - density(right);
        let square = mass + left * density(left) - right * density(right);
        sum += constant * mass + slope * linear;
        squares +=
            constant * constant * mass + 2.0 * constant * slope * linear + slope * slope * square;
    }
    (middle + sum, (squares - sum * sum).max(0.0).sqrt())
}

/// A product of two weights that contributes to the correlation of two results.
struct Term {
    product: f64,
    /// The same with standard deviations of drawn values instead of standard uncertainties.
    drawn: f64,
    /// Whether both weights belong to one root.
    same: bool,
    /// Whether a root has finite degrees of freedom.
    finite_dof: bool,
}

/// The common part of two results: equal roots, and correlated ones.
fn shared(a: &Origin, b: &Origin) -> Vec<Term> {
    let by_name = |origin: &'_ Origin| -> HashMap<RootName, (f64, Root)> {
        origin.roots.iter().map(|(root, w)| (root.name.clone(), (*w, root.clone()))).collect()
    };
    let (of_a, of_b) = (by_name(a), by_name(b));
    let mut terms = Vec::new();
    let mut add = |first: &RootName, second: &RootName, coefficient: f64| {
        if let (Some((w, x)), Some((v, y))) = (of_a.get(first), of_b.get(second)) {
            let product = w * v * coefficient;
            let wider = |root: &Root| root.standard_deviation / root.standard_uncertainty;
            terms.push(Term {
                product,
                drawn: product * wider(x) * wider(y),
                same: first == second,
                finite_dof: x.dof.is_finite() || y.dof.is_finite(),
            });
        }
    };
    for (root, _) in &a.roots {
        add(&root.name, &root.name, 1.0);
    }
    // both files may state the same coefficient
    let mut coefficients = BTreeMap::new();
    for c in a.correlations.iter().chain(b.correlations.iter()) {
        let names = (c.first.clone().min(c.second.clone()), c.first.clone().max(c.second.clone()));
        coefficients.insert(names, c.coefficient);
    }
    for ((first, second), r) in &coefficients {
        add(first, second, *r);
        add(second, first, *r);
    }
    terms
}

impl Shape for SavedResult {
    const NAME: &'static str = "result";

    fn mean(&self) -> f64 {
        self.saved.estimate
    }

    fn standard_uncertainty(&self) -> f64 {
        self.saved.standard_uncertainty
    }

    fn dof(&self) -> f64 {
        self.saved.dof
    }

    fn drawn_dof(&self) -> f64 {
        self.saved.drawn_dof
    }

    fn standard_deviation(&self) -> f64 {
        self.saved.standard_deviation
    }

    fn quantile(&self, p: f64) -> f64 {
        self.at(special::normal::quantile(p))
    }

    fn quantile_upper(&self, q: f64) -> f64 {
        self.at(special::normal::quantile_upper(q))
    }

    #[inline(always)]
    fn draw(&self, stream: &mut Stream, out: &mut Column) {
        normal::draw(0.0, 1.0, stream, out);
        for value in &mut out.0 {
            *value = self.at(*value);
        }
    }

    fn moved_to(&self, estimate: f64) -> Result<Self, Invalid> {
        let shift = finite("estimate", estimate)? - self.saved.estimate;
        let cells = cells(self.cells.iter().map(|cell| cell[0] + shift));
        let saved = Saved { estimate, ..self.saved };
        Self { saved, cells, drawn_mean: self.drawn_mean + shift, ..self.clone() }.within_range()
    }
}
