//! Composed effects: what may be missing where no candidate explains the data.
//!
//! A departure of one term, q + k g(c) or q (1 + k g(c)), of an output or of a quantity that the sim
//! computes, with g from a list of functions of a condition or of the quantity's own value. Its size k
//! is integrated out exactly, what else g has on a grid and then about the best point ([`search`]); the
//! sim is linear in its inputs. Where one term does not do, products of two conditions' functions and
//! pairs of terms are tried, and a term beside each leading effect of the list.
//!
//! Quantities, conditions and forms are equally probable beforehand, and all composed effects together
//! are as probable as the smooth departures of [`gumption_inference::discrepancy`], against which their evidence
//! stands: a departure that is none of these forms leaves them improbable.

mod effect;
mod joint;
mod prediction;
mod target;
mod term;
#[cfg(test)]
mod tests;

pub use effect::{ComposedEffect, ComposedParameter, ComposedPrior, ComposedTerm};

use gumption_engine::parallel;

use crate::diagnosis::DepartureKind;
use gumption_engine::linalg::dot;
use gumption_engine::number::{elementary, largest_first};
use gumption_inference::data::by_rows;
use gumption_inference::discrepancy::{Discrepancy, Unexplained};
use gumption_inference::logarithm::{ln_add, ln_sum};
use gumption_inference::metric::{Metric, White};
use gumption_inference::posterior::Posterior;
use gumption_inference::setup::Setup;
use gumption_inference::shape::{ComposedForm, Shape, Values};
use gumption_inference::term_evidence::{Frame, OnGrid};
use target::{Response, Target};
use term::{Argument, DepartureTerm};

/// So many forms of the first grid are looked at closely.
const REFINED: usize = 300;

/// Prior weights of functions of an output's own value, and of those of a quantity within the sim,
/// beside a condition's.
const OWN_VALUE: f64 = 0.5;
const OWN_VALUE_WITHIN: f64 = 0.1;

/// That of all conditions together that follow from the order of the rows.
const HISTORY: f64 = 1.0;

/// Composed effects that are handed over, at most.
const MOST: usize = 8;

/// Those with less than this share of the most probable one are left out.
const LEAST: f64 = 1e-3;

/// Quantities do the same where the cosine between what they do is nearer to 1 than this.
const SAME: f64 = 1e-9;

/// Data with more values than this are not composed for: what departs in them is a matter of more
/// than one term, and the search costs a pass for every form.
const MOST_VALUES: usize = 20_000;

/// A departure composed of terms, with its weight.
#[derive(Clone, Debug)]
pub(crate) struct Composition {
    terms: Vec<DepartureTerm>,
    /// Whether the terms' functions are multiplied by each other rather than added.
    product: bool,
    /// Places of the effects of the list that it acts beside.
    beside: Vec<usize>,
    /// The logarithm of prior times evidence, above that of the data without a departure.
    ln_weight: f64,
    /// The same with the parameters of the functions at their best values.
    best: f64,
    /// Posterior share among all departures.
    pub(crate) share: f64,
}

/// What the composer found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Compositions {
    /// Most probable first.
    pub(crate) all: Vec<Composition>,
    /// Variances of the noise by value, where it is estimated.
    variances: Option<Vec<f64>>,
}

/// A target in the metric: one way of departing.
struct DepartureWay<'m> {
    target: usize,
    kind: DepartureKind,
    frame: Frame<'m>,
    value: Option<Values>,
}

/// A form of a way: what is integrated.
struct Candidate {
    way: usize,
    argument: Argument,
    shape: Shape,
    found: OnGrid,
    ln_prior: f64,
}

/// A shape with its functions at its grid.
struct Tabulated {
    shape: Shape,
    grid: Vec<(Vec<f64>, Vec<Vec<f64>>)>,
}

/// All shapes of values, with the functions at their grids.
fn tabulated(values: &Values) -> Vec<Tabulated> {
    let shapes = Shape::all(values);
    parallel::map(shapes, |shape| {
        let at = |shares: Vec<f64>| {
            let columns = shape.columns(&values.at, &shape.parameters(&shares));
            (shares, columns)
        };
        let grid = shape.grid().into_iter().map(at).collect();
        Tabulated { shape, grid }
    })
}

/// Composes departures for data of a setup that a departure without a name is probable for.
pub(crate) fn compose(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    posterior: &Posterior,
) -> Compositions {
    let departures = posterior.departures();
    if setup.data.len() > MOST_VALUES {
        return Compositions::default();
    }
    let variances = departures.kinds.first().and_then(|kind| kind.variances.clone());
    let variances = variances.map(|variances| variances.to_vec());
    let metric = Metric::new(setup, variances.as_deref());
    let residuals = by_rows(&setup.data.linear_residuals());
    let white = metric.white(&residuals);
    let targets = target::targets(setup);
    let responses: Vec<Response> = parallel::map(&targets, |target| target.in_data(setup));
    let search = ComposedSearch { setup, targets: &targets, responses: &responses };
    let mut found = search.singles(&metric, &white, REFINED);
    let of_process = of_process(setup, discrepancy, &departures, &metric, &residuals);
    let best =
        found.iter().map(|composition| composition.ln_weight).fold(f64::NEG_INFINITY, f64::max);
    if best < of_process || search.misfits(&metric, &residuals, &found) {
        let more = search.joint(&metric, &residuals, &found, posterior);
        let rest = 1.0 - joint::SHARE;
        found.iter_mut().for_each(|composition| composition.ln_weight += elementary::ln(rest));
        found.extend(more);
    }
    weighed(found, of_process, variances)
}

/// What all searches of a case have in common.
struct ComposedSearch<'s> {
    setup: &'s Setup<'s>,
    targets: &'s [Target],
    responses: &'s [Response],
}

/// The logarithm of the evidence of the discrepancies, above that without any, in this metric.
fn of_process(
    setup: &Setup<'_>,
    discrepancy: &Discrepancy,
    departures: &Unexplained,
    metric: &Metric<'_>,
    residuals: &[f64],
) -> f64 {
    let known = departures.kinds.iter().find(|kind| kind.base.is_none());
    if let (true, Some(kind)) = (setup.linear.fitted, known) {
        // of the heaviest form, with the noise as it is taken here, and its share of all
        let form = &discrepancy.forms[kind.form];
        let features = form.features(setup, &discrepancy.axes);
        let columns: Vec<Vec<f64>> = features
            .column_iter()
            .map(|column| column.iter().map(|x| kind.multiplier * x).collect())
            .collect();
        let gain = gain(&metric.with(&columns), metric, residuals);
        let steps = gumption_inference::discrepancy::amplitude_steps(true) as f64;
        return gain + form.ln_weight - elementary::ln(steps) - elementary::ln(kind.weight);
    }
    let whitened = setup.linear.whiten_blocks(residuals);
    departures.ln_evidence - gumption_inference::discrepancy::ln_normal(setup, &whitened)
}

/// By how much the logarithm of the density of residuals is higher in one metric than in another with
/// the same noise.
fn gain(of: &Metric<'_>, over: &Metric<'_>, residuals: &[f64]) -> f64 {
    let ln = |metric: &Metric<'_>| {
        let white = metric.white(residuals);
        -0.5 * white.dot(&white) - metric.half_ln_det()
    };
    ln(of) - ln(over)
}

impl ComposedSearch<'_> {
    /// Departures of one term in a metric; so many forms of the first grid are looked at closely.
    fn singles(&self, metric: &Metric<'_>, white: &White, refined: usize) -> Vec<Composition> {
        let Self { setup, targets, .. } = *self;
        let ways = self.ways(metric, white);
        let conditions = term::conditions(setup);
        let tables: Vec<(Argument, &Values, Vec<Tabulated>)> = conditions
            .iter()
            .map(|(argument, values)| (*argument, values, tabulated(values)))
            .collect();
        let weights: f64 = ways.iter().map(|way| targets[way.target].weight).sum();
        // all that follows from the order of the rows together is so much of one condition
        let is_history = |(argument, _): &&(Argument, Values)| argument.history(setup).is_some();
        let history = HISTORY / conditions.iter().filter(is_history).count().max(1) as f64;
        let of_way = |(number, way): (usize, &DepartureWay<'_>)| {
            let own = way.value.as_ref().filter(|_| way.kind == DepartureKind::Additive);
            let own = own.map(|values| {
                // a departure in proportion to the value itself is a proportional constant
                let mut table = tabulated(values);
                table.retain(|row| row.shape.form() != ComposedForm::Slope);
                (Argument::Value, values, table)
            });
            // what is a function of the value is often one of a condition too, which can be set
            let own_weight = match (&own, targets[way.target].outputs.is_empty()) {
                (None, _) => 0.0,
                (Some(_), false) => OWN_VALUE,
                (Some(_), true) => OWN_VALUE_WITHIN,
            };
            let weight = |argument: Argument| match argument {
                Argument::Value => own_weight,
                Argument::Condition(c) if setup.case.history_of(c).is_some() => history,
                Argument::Nothing | Argument::Condition(_) => 1.0,
            };
            let of_conditions: f64 = tables.iter().map(|(argument, ..)| weight(*argument)).sum();
            let arguments = 1.0 + of_conditions + own_weight;
            let ln_way = elementary::ln(targets[way.target].weight / weights);
            let ln_of = |argument: Argument| ln_way + elementary::ln(weight(argument) / arguments);
            let constant = Shape::constant();
            let points = setup.data.points.len();
            let grid = vec![(Vec::new(), constant.columns(&vec![0.0; points], &[]))];
            let mut found: Vec<Candidate> = Vec::new();
            let mut add = |argument, shape: &Shape, grid: &[_], ln_prior| {
                if let Some(on_grid) = way.frame.on_grid(grid) {
                    let shape = shape.clone();
                    let candidate =
                        Candidate { way: number, argument, shape, found: on_grid, ln_prior };
                    found.push(candidate);
                }
            };
            add(Argument::Nothing, &constant, &grid, ln_of(Argument::Nothing));
            for (argument, _, table) in tables.iter().chain(&own) {
                let forms: Vec<ComposedForm> = table.iter().map(|row| row.shape.form()).collect();
                let is_new = |(n, form): &(usize, &ComposedForm)| !forms[..*n].contains(form);
                let different = forms.iter().enumerate().filter(is_new).count();
                let ln_form = ln_of(*argument) - elementary::ln(different.max(1) as f64);
                for row in table {
                    let form = row.shape.form();
                    let variants = forms.iter().filter(|other| **other == form).count();
                    let ln_prior = ln_form - elementary::ln(variants as f64);
                    add(*argument, &row.shape, &row.grid, ln_prior);
                }
            }
            found
        };
        let mut candidates: Vec<Candidate> =
            parallel::map(ways.iter().enumerate(), of_way).into_iter().flatten().collect();
        largest_first(&mut candidates, |a| a.found.gain + a.ln_prior);
        candidates.truncate(refined);
        parallel::map(candidates, |Candidate { way, argument, shape, found, ln_prior }| {
            let way = &ways[way];
            let nothing = vec![0.0; setup.data.points.len()];
            let at = match argument {
                Argument::Nothing => &nothing,
                Argument::Value => way.value.as_ref().map_or(&nothing, |values| &values.at),
                Argument::Condition(_) => conditions
                    .iter()
                    .find(|(condition, _)| *condition == argument)
                    .map_or(&nothing, |(_, values)| &values.at),
            };
            let found = way.frame.refined(&shape, at, found);
            let term = DepartureTerm {
                target: targets[way.target].clone(),
                kind: way.kind,
                argument,
                shape,
                shares: found.shares,
                widths: found.widths,
            };
            Composition {
                terms: vec![term],
                product: false,
                beside: Vec::new(),
                ln_weight: ln_prior + found.ln_evidence,
                best: ln_prior + found.best,
                share: 0.0,
            }
        })
    }

    /// The ways in which the targets can depart, without those that do the same as one before.
    fn ways<'m>(&'m self, metric: &'m Metric<'m>, white: &'m White) -> Vec<DepartureWay<'m>> {
        let Self { setup, targets, responses } = *self;
        let mut ways: Vec<DepartureWay<'m>> = Vec::new();
        let mut known: Vec<Vec<f64>> = Vec::new();
        for (number, (target, response)) in targets.iter().zip(responses).enumerate() {
            for kind in [DepartureKind::Additive, DepartureKind::Proportional] {
                if kind == DepartureKind::Additive && !target.addable {
                    continue;
                }
                let own = response.of(kind);
                let Some(frame) = Frame::new(metric, setup, own, white) else { continue };
                let own = metric.whiten(own);
                let same = |other: &Vec<f64>| {
                    let cosine = dot(&own, other) / (dot(&own, &own) * dot(other, other)).sqrt();
                    1.0 - cosine.abs() < SAME
                };
                if known.iter().any(same) {
                    continue;
                }
                known.push(own);
                let value = response.value.clone().and_then(Values::new);
                ways.push(DepartureWay { target: number, kind, frame, value });
            }
        }
        ways
    }
}

/// Probabilities from the weights; `of_process` is the evidence of what they compete with.
fn weighed(
    mut all: Vec<Composition>,
    of_process: f64,
    variances: Option<Vec<f64>>,
) -> Compositions {
    all.retain(|composition| composition.ln_weight.is_finite());
    largest_first(&mut all, |a| a.ln_weight);
    let together = ln_sum(all.iter().map(|composition| composition.ln_weight));
    // composed and smooth departures are equally probable beforehand
    let total = ln_add(together, of_process);
    for composition in &mut all {
        composition.share = elementary::exp(composition.ln_weight - total);
    }
    let most = all.first().map_or(0.0, |first| first.share);
    all.retain(|composition| composition.share >= LEAST * most);
    Compositions { all, variances }
}
