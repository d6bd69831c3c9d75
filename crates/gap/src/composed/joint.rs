//! Two at once where one term does not do: pairs of terms, products of functions of two conditions, and
//! a term beside an effect of the list.

use gumption_engine::parallel;

use super::term::{self, Argument};
use super::{ComposedSearch, Composition, DepartureTerm};
use crate::HistoryKind;
use gumption_engine::linalg::dot;
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::special;
use gumption_inference::discrepancy::Base;
use gumption_inference::metric::{Metric, White};
use gumption_inference::posterior::{Posterior, WeighedHypothesis};
use gumption_inference::shape::{Function, Shape};
use gumption_inference::term_evidence::{Frame, solved};
use nalgebra::{DMatrix, DVector};

/// Prior share of two at once, where one term does not do.
pub(super) const SHARE: f64 = 0.3;

/// Terms, and effects of the list, to which another term is added.
const FIRST: usize = 3;

/// Terms that are multiplied with each other.
const MULTIPLIED: usize = 12;

/// Forms that are looked at closely beside each of these.
const REFINED: usize = 60;

/// Of those so many are kept.
const KEPT: usize = 12;

/// One term does not do where it leaves residuals as large as these with less than this probability.
const DOUBTFUL: f64 = 0.01;

impl ComposedSearch<'_> {
    /// Whether the best of the terms leaves more than the noise.
    pub(super) fn misfits(
        &self,
        metric: &Metric<'_>,
        residuals: &[f64],
        found: &[Composition],
    ) -> bool {
        let best = found.iter().max_by(|a, b| a.ln_weight.total_cmp(&b.ln_weight));
        let Some(best) = best.filter(|_| !self.setup.linear.fitted) else { return false };
        let (with, _) = self.beside_term(metric, best);
        let white = with.white(residuals);
        let square = white.dot(&white).max(0.0);
        let dof = residuals.len() as f64;
        special::gamma::ln_sf(0.5 * square, 0.5 * dof) < elementary::ln(DOUBTFUL)
    }

    /// The metric with a term integrated out, and the logarithm of the density that it has of the
    /// residuals less that without.
    fn beside_term<'m>(
        &self,
        metric: &Metric<'m>,
        term: &Composition,
    ) -> (Metric<'m>, Vec<Vec<f64>>) {
        let columns = term.in_data(self.setup, &term.shares());
        let scaled: Vec<Vec<f64>> = columns
            .iter()
            .map(|column| {
                let white = metric.whiten(column);
                let touched = white.iter().filter(|x| **x != 0.0).count().max(1) as f64;
                let rms = (dot(&white, &white) / touched).sqrt().max(f64::MIN_POSITIVE);
                column.iter().map(|x| WIDE * x / rms).collect()
            })
            .collect();
        (metric.with(&scaled), scaled)
    }

    /// All that is found of two at once.
    pub(super) fn joint(
        &self,
        metric: &Metric<'_>,
        residuals: &[f64],
        singles: &[Composition],
        posterior: &Posterior,
    ) -> Vec<Composition> {
        let white = metric.white(residuals);
        let mut ranked: Vec<&Composition> = singles.iter().collect();
        largest_first(&mut ranked, |a| a.ln_weight);
        let ln_each = elementary::ln(SHARE / 3.0);
        let mut found = self.products(metric, &white, &ranked, ln_each);
        found.extend(self.pairs(metric, &white, &ranked, ln_each));
        found.extend(self.beside_listed(metric, residuals, posterior, ln_each));
        found
    }

    /// Sums of a leading term and another one.
    fn pairs(
        &self,
        metric: &Metric<'_>,
        white: &White,
        ranked: &[&Composition],
        ln_share: f64,
    ) -> Vec<Composition> {
        let mut leading: Vec<&Composition> = Vec::new();
        for composition in ranked {
            let same = |other: &&Composition| {
                let (own, other) = (&composition.terms[0], &other.terms[0]);
                own.target.names == other.target.names && own.argument == other.argument
            };
            if leading.len() < FIRST && !leading.iter().any(same) {
                leading.push(composition);
            }
        }
        let square = white.dot(white);
        let of_first = |first: &Composition| {
            let (with, _) = self.beside_term(metric, first);
            // the residuals in the new metric, whitened by the same blocks
            let again = with.rewhitened(white);
            let gain =
                0.5 * (square - again.dot(&again)) - (with.half_ln_det() - metric.half_ln_det());
            // what the parameters of its functions cost, and its size in the place of that here
            let occam = first.ln_weight - first.best;
            let ln_first = first.best - first.gain_at(self.setup, metric, white);
            let mut others = self.singles(&with, &again, REFINED);
            largest_first(&mut others, |a| a.ln_weight);
            others.truncate(KEPT);
            let joined = others.into_iter().filter_map(move |other| {
                let mut terms = vec![first.terms[0].clone()];
                terms.extend(other.terms);
                let two = terms.len() == 2 && !terms[0].is_same_as(&terms[1]);
                let ln_weight = ln_share + ln_first + occam + gain + other.ln_weight;
                two.then(|| Composition { terms, ln_weight, best: ln_weight, ..first.clone() })
            });
            joined.collect::<Vec<Composition>>()
        };
        let mut found = parallel::map(leading, of_first).concat();
        // the same two terms are found from either of them
        largest_first(&mut found, |composition| composition.ln_weight);
        let mut distinct: Vec<Composition> = Vec::new();
        for composition in found {
            let [one, other] = [&composition.terms[0], &composition.terms[1]];
            let same = |known: &Composition| {
                known.terms[0].is_same_as(other) && known.terms[1].is_same_as(one)
            };
            if !distinct.iter().any(same) {
                distinct.push(composition);
            }
        }
        distinct
    }

    /// Products of functions of two conditions.
    fn products(
        &self,
        metric: &Metric<'_>,
        white: &White,
        ranked: &[&Composition],
        ln_share: f64,
    ) -> Vec<Composition> {
        let single: Vec<&&Composition> = ranked
            .iter()
            .filter(|composition| {
                let term = &composition.terms[0];
                matches!(term.argument, Argument::Condition(_)) && term.shape.count() == 1
            })
            .collect();
        // the best of every quantity, way and condition
        let mut leading: Vec<&&Composition> = Vec::new();
        for composition in single {
            let own = &composition.terms[0];
            let alike = leading.iter().filter(|other| {
                let other = &other.terms[0];
                own.is_way_of(other) && own.argument == other.argument
            });
            if alike.count() < 3 && leading.len() < MULTIPLIED {
                leading.push(composition);
            }
        }
        let mut found = self.loops(metric, white, &leading, ln_share);
        for (number, first) in leading.iter().enumerate() {
            for second in &leading[number + 1..] {
                let (one, other) = (&first.terms[0], &second.terms[0]);
                if !one.is_way_of(other) || one.argument == other.argument {
                    continue;
                }
                let product = Composition {
                    terms: vec![one.clone(), other.clone()],
                    product: true,
                    beside: Vec::new(),
                    ln_weight: 0.0,
                    best: 0.0,
                    share: 0.0,
                };
                let gain = product.gain_at(self.setup, metric, white);
                // half of the prior of each, and what its parameters cost
                let costs =
                    [first, second].map(|composition| composition.ln_weight - composition.best);
                let prior = [first, second].map(|composition| {
                    composition.best - composition.gain_at(self.setup, metric, white)
                });
                let prior = prior[0].max(prior[1]);
                let ln_weight = ln_share + prior + costs[0] + costs[1] + gain
                    - elementary::ln(leading.len() as f64);
                found.push(Composition { ln_weight, best: ln_weight, ..product });
            }
        }
        found
    }

    /// Functions of a condition that have one sign while it rises and the other while it falls, of
    /// leading terms that are proportional to its direction.
    fn loops(
        &self,
        metric: &Metric<'_>,
        white: &White,
        leading: &[&&Composition],
        ln_share: f64,
    ) -> Vec<Composition> {
        let setup = self.setup;
        let of_direction = |composition: &&Composition| {
            let DepartureTerm { argument, shape, .. } = &composition.terms[0];
            let history = argument.history(setup);
            history.is_some_and(|of| of.kind == HistoryKind::Direction)
                && shape.function == Function::Linear
        };
        let of_first = |first: &Composition| {
            let direction = &first.terms[0];
            let condition = Argument::Condition(direction.argument.history(setup)?.of?);
            let conditions = term::conditions(setup);
            let (_, values) = conditions.iter().find(|(argument, _)| *argument == condition)?;
            let column = first.in_data(setup, &first.shares()).swap_remove(0);
            let frame = Frame::new(metric, setup, &column, white)?;
            let mut shapes = Shape::all(values);
            shapes.retain(|shape| shape.count() == 1);
            let ln_shape = -elementary::ln(shapes.len().max(1) as f64);
            let of_shape = |shape: Shape| {
                let at = |shares: Vec<f64>| {
                    let columns = shape.columns(&values.at, &shape.parameters(&shares));
                    (shares, columns)
                };
                let grid: Vec<_> = shape.grid().into_iter().map(at).collect();
                let on_grid = frame.on_grid(&grid)?;
                let found = frame.refined(&shape, &values.at, on_grid);
                let term = DepartureTerm {
                    argument: condition,
                    shape,
                    shares: found.shares,
                    widths: found.widths,
                    ..direction.clone()
                };
                let terms = vec![term, direction.clone()];
                // that it is a function of the direction has been weighed with the first term
                let prior = first.best - first.gain_at(setup, metric, white);
                let ln_prior = ln_share + ln_shape + prior;
                let (ln_weight, best) = (ln_prior + found.ln_evidence, ln_prior + found.best);
                let product = true;
                Some(Composition { terms, product, ln_weight, best, ..first.clone() })
            };
            Some(parallel::map(shapes, of_shape).into_iter().flatten().collect::<Vec<_>>())
        };
        let leading = leading.iter().map(|composition| **composition);
        leading.filter(of_direction).filter_map(of_first).flatten().collect()
    }

    /// A term beside the leading effects of the list, each with its parameters free about its best
    /// point.
    fn beside_listed(
        &self,
        metric: &Metric<'_>,
        residuals: &[f64],
        posterior: &Posterior,
        ln_share: f64,
    ) -> Vec<Composition> {
        let mut listed: Vec<&WeighedHypothesis> =
            posterior.hypotheses.iter().filter(|h| h.effects.len() == 1).collect();
        largest_first(&mut listed, |a| a.ln_weight());
        let ln_effect = -elementary::ln(listed.len().max(1) as f64);
        // first those that a departure of any form goes with, as they are beside it
        let mut beside: Vec<&WeighedHypothesis> =
            posterior.beside.iter().map(|weighed| &weighed.named).collect();
        largest_first(&mut beside, |a| a.ln_weight());
        listed.retain(|h| posterior.beside(&h.effects).is_none());
        beside.extend(listed);
        beside.truncate(FIRST);
        let white = metric.white(residuals);
        let square = white.dot(&white);
        let of_effects = |hypothesis: &WeighedHypothesis| {
            // as if the effects were linear about their best point, their scores standard normal
            let mode = hypothesis.evidence.modes.first()?;
            let base = Base::at(self.setup, &hypothesis.effects, mode)?;
            let with = metric.with(&base.slopes);
            let again = with.white(&base.residuals(self.setup));
            let gain =
                0.5 * (square - again.dot(&again)) - (with.half_ln_det() - metric.half_ln_det());
            let mut others = self.singles(&with, &again, REFINED);
            largest_first(&mut others, |a| a.ln_weight);
            others.truncate(KEPT);
            for composition in &mut others {
                composition.beside.clone_from(&hypothesis.effects);
                composition.ln_weight += ln_share + ln_effect + gain;
            }
            Some(others)
        };
        parallel::map(beside, of_effects).into_iter().flatten().flatten().collect()
    }
}

/// The standard deviation of a first term's size, in standard uncertainties, beside a second one.
const WIDE: f64 = 300.0;

impl Composition {
    /// The gain of its functions with their parameters as they are.
    fn gain_at(
        &self,
        setup: &gumption_inference::setup::Setup<'_>,
        metric: &Metric<'_>,
        residuals: &White,
    ) -> f64 {
        let columns: Vec<White> =
            self.in_data(setup, &self.shares()).iter().map(|column| metric.white(column)).collect();
        let d = columns.len();
        let scales: Vec<f64> = columns
            .iter()
            .map(|white| {
                let touched = white.values.iter().filter(|x| **x != 0.0).count().max(1) as f64;
                (dot(&white.values, &white.values) / touched).sqrt()
            })
            .collect();
        let gram = DMatrix::from_fn(d, d, |i, j| columns[i].dot(&columns[j]));
        let products = DVector::from_fn(d, |i, _| columns[i].dot(residuals));
        solved(&gram, &products, &scales).map_or(f64::NEG_INFINITY, |fit| fit.gain)
    }
}

impl DepartureTerm {
    /// Whether it makes the same quantity depart in the same way.
    fn is_way_of(&self, other: &Self) -> bool {
        self.target.names == other.target.names && self.kind == other.kind
    }

    fn is_same_as(&self, other: &Self) -> bool {
        self.is_way_of(other)
            && self.argument == other.argument
            && self.shape.form() == other.shape.form()
    }
}
