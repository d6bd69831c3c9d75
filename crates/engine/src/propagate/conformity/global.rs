//! Global risks: of accepting an item that does not conform, or rejecting one that does, over all
//! items that come (JCGM 106, 9.5).
//!
//! With the prior distribution g of the items' values and the probability a(eta) that an item of the
//! value eta is measured within the acceptance limits, the risk of false acceptance is the integral
//! of g a outside the tolerance, that of false rejection the integral of g (1 - a) inside. The
//! integrals run over the standard normal scores of the prior, so that any shape will do.

use super::error_law::StudentLaw;
use super::smallest_band;
use crate::distribution::Distribution;
use crate::number::ascending;
use crate::propagate::golden_section;

/// Risks over all items that are inspected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlobalRisks {
    /// That an item is accepted and does not conform (the consumer's risk).
    pub false_acceptance: f64,
    /// That an item is rejected and conforms (the producer's risk).
    pub false_rejection: f64,
    /// That an item is accepted.
    pub acceptance: f64,
}

impl GlobalRisks {
    /// The conditional risk of false acceptance: the share of the accepted items that does not conform
    /// (Bayes' theorem; ANSI/NCSL Z540.3 handbook, CPFA). NaN if no item is accepted.
    pub fn conditional_false_acceptance(&self) -> f64 {
        self.false_acceptance / self.acceptance
    }
}

/// Scores beyond this are left out: 1e-17 of all items.
const FARTHEST: f64 = 8.5;

/// The absolute error of an integral, at most.
const TOLERANCE: f64 = 1e-10;

/// Items of a prior, and how measured values are distributed about theirs.
#[derive(Debug)]
pub(super) struct Inspection<'a> {
    prior: &'a Distribution,
    errors: StudentLaw,
    limits: [f64; 2],
}

impl<'a> Inspection<'a> {
    pub(super) fn new(prior: &'a Distribution, errors: StudentLaw, limits: [f64; 2]) -> Self {
        Self { prior, errors, limits }
    }

    /// The risks with acceptance limits.
    pub(super) fn risks(&self, acceptance: [f64; 2]) -> GlobalRisks {
        let [lower, upper] = self.limits.map(|limit| self.score(limit));
        let accepted = |value: f64| {
            let [low, high] = acceptance.map(|limit| limit - value);
            let errors = self.errors;
            // from the near tail, so that small probabilities keep their digits
            if low > 0.0 {
                errors.above(low) - errors.above(high)
            } else if high < 0.0 {
                errors.below(high) - errors.below(low)
            } else {
                1.0 - errors.below(low) - errors.above(high)
            }
        };
        let density = |z: f64| libm::exp(-0.5 * z * z) / (2.0 * std::f64::consts::PI).sqrt();
        let f = |z: f64| density(z) * accepted(self.prior.at_score(z));
        let rejected = |z: f64| density(z) * (1.0 - accepted(self.prior.at_score(z)));
        let cuts = self.cuts(acceptance);
        let false_acceptance =
            integral(&f, -FARTHEST, lower, &cuts) + integral(&f, upper, FARTHEST, &cuts);
        GlobalRisks {
            false_acceptance,
            false_rejection: integral(&rejected, lower, upper, &cuts),
            acceptance: false_acceptance + integral(&f, lower, upper, &cuts),
        }
    }

    /// The conformance probability of an item that was measured as `value`: the share of the posterior
    /// distribution that lies within the tolerance (JCGM 106, 6.3 and 7.1), by Bayes' theorem from the
    /// prior and the distribution of the errors.
    pub(super) fn conformance(&self, value: f64) -> f64 {
        let [lower, upper] = self.limits.map(|limit| self.score(limit));
        let distance = |z: f64| (value - self.prior.at_score(z)) / self.errors.scale;
        // logarithms, so that a value far from all of the prior does not underflow
        let form = |z: f64| z * z + self.errors.form(distance(z));
        let mut cuts = self.cuts([value, f64::INFINITY]);
        let least = self.least(&form, &cuts);
        // about the peak, which may be narrow
        let peak = 1.0 / (1.0 + self.slope(least).powi(2)).sqrt();
        cuts.extend([-8.0, -4.0, -2.0, 0.0, 2.0, 4.0, 8.0].map(|step| least + step * peak));
        if self.errors.dof.is_finite() {
            let far = [16.0, 64.0, 256.0, 1024.0, 4096.0];
            cuts.extend(
                far.into_iter().flat_map(|step| [least - step * peak, least + step * peak]),
            );
        }
        cuts.extend([lower, upper]);
        ascending(&mut cuts);
        let lowest = form(least);
        let posterior = |z: f64| libm::exp(-0.5 * (form(z) - lowest));
        let within = |from: f64, to: f64| {
            integral_within(&posterior, [from, to], &cuts, TOLERANCE * peak.min(1.0))
        };
        let inside = within(lower, upper);
        let outside = within(-FARTHEST, lower) + within(upper, FARTHEST);
        inside / (inside + outside)
    }

    /// The score at which a form is least, by golden sections between the best of many.
    fn least(&self, form: &impl Fn(f64) -> f64, cuts: &[f64]) -> f64 {
        let steps = 400;
        let even = (0..=steps).map(|i| FARTHEST * (2.0 * f64::from(i) / f64::from(steps) - 1.0));
        let mut all: Vec<f64> = even.chain(cuts.iter().copied()).collect();
        ascending(&mut all);
        let best = (0..all.len()).min_by(|&a, &b| form(all[a]).total_cmp(&form(all[b])));
        let best = best.unwrap_or(0);
        let beside = [all[best.saturating_sub(1)], all[(best + 1).min(all.len() - 1)]];
        golden_section::least(beside, 60, form)
    }

    /// How many standard uncertainties the prior's value moves for each unit of the score.
    fn slope(&self, z: f64) -> f64 {
        let step = 1e-4;
        (self.prior.at_score(z + step) - self.prior.at_score(z - step))
            / (2.0 * step * self.errors.scale)
    }

    /// The guard band with which the risk of false acceptance is at most this; `None` if no band
    /// gives that.
    pub(super) fn guard_band(&self, risk: f64) -> Option<f64> {
        let [lower, upper] = self.limits;
        let at = |width: f64| self.risks([lower + width, upper - width]).false_acceptance;
        smallest_band(upper - lower, self.errors.scale, |width| at(width) <= risk)
    }

    /// The score of a value, within those that are integrated over.
    fn score(&self, value: f64) -> f64 {
        if value.is_infinite() {
            return FARTHEST.copysign(value);
        }
        self.prior.score_of(value).clamp(-FARTHEST, FARTHEST)
    }

    /// Scores about which the integrands change: the acceptance limits, and some standard
    /// uncertainties from them.
    fn cuts(&self, acceptance: [f64; 2]) -> Vec<f64> {
        let steps = [-8.0, -4.0, -2.0, 0.0, 2.0, 4.0, 8.0];
        let finite = acceptance.into_iter().filter(|limit| limit.is_finite());
        let values = finite.flat_map(|limit| steps.map(|step| limit + step * self.errors.scale));
        let mut cuts: Vec<f64> = values.map(|value| self.score(value)).collect();
        cuts.extend([-4.0, -2.0, 0.0, 2.0, 4.0]);
        ascending(&mut cuts);
        cuts
    }
}

/// The integral between two scores, cut at those between them.
fn integral(f: &impl Fn(f64) -> f64, from: f64, to: f64, cuts: &[f64]) -> f64 {
    integral_within(f, [from, to], cuts, TOLERANCE)
}

/// The same with this absolute error for each piece.
fn integral_within(
    f: &impl Fn(f64) -> f64,
    [from, to]: [f64; 2],
    cuts: &[f64],
    tolerance: f64,
) -> f64 {
    let mut sum = 0.0;
    let mut start = from;
    let between = cuts.iter().copied().filter(|cut| *cut > from && *cut < to);
    for end in between.chain([to]) {
        if end > start {
            let (a, b) = (f(start), f(end));
            let (middle, whole) = simpson(f, (start, a), (end, b));
            sum += refined(f, [(start, a), middle, (end, b)], whole, tolerance, 40);
            start = end;
        }
    }
    sum
}

/// Simpson's rule, and the middle point that it took.
fn simpson(f: &impl Fn(f64) -> f64, from: (f64, f64), to: (f64, f64)) -> ((f64, f64), f64) {
    let middle = 0.5 * (from.0 + to.0);
    let value = f(middle);
    ((middle, value), (to.0 - from.0) / 6.0 * (from.1 + 4.0 * value + to.1))
}

/// Simpson's rule on halves of halves, until two of them agree with their whole.
fn refined(
    f: &impl Fn(f64) -> f64,
    [from, middle, to]: [(f64, f64); 3],
    whole: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    let (low, left) = simpson(f, from, middle);
    let (high, right) = simpson(f, middle, to);
    let change = left + right - whole;
    if depth == 0 || change.abs() <= 15.0 * tolerance {
        return left + right + change / 15.0;
    }
    refined(f, [from, low, middle], left, 0.5 * tolerance, depth - 1)
        + refined(f, [middle, high, to], right, 0.5 * tolerance, depth - 1)
}
