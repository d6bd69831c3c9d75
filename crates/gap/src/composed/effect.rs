//! A composed departure as an effect that a case can have: its overrides and parameters as text.

use nalgebra::{DMatrix, DVector};

use super::target::{fresh, of_differences};
use super::term::{Argument, DepartureTerm};
use super::{Composition, Compositions, MOST};
use crate::diagnosis::{DepartureKind, DepartureOver, Shrunk};
use crate::{HistoryKind, OverridableModel};
use gumption_engine::decimal::to_digits;
use gumption_engine::model::formula::Formula;
use gumption_engine::model::{NumberForm, Quantity};
use gumption_engine::number::{elementary, largest_first};
use gumption_engine::task::Row;
use gumption_inference::data::by_rows;
use gumption_inference::metric::{Metric, White};
use gumption_inference::model::Effect;
use gumption_inference::setup::Setup;
use gumption_inference::shape::{ComposedForm, Function, RangeOf};
use gumption_inference::term_evidence::{Fit, solved};
use gumption_units::Unit;

/// The prior of a size is as wide as so many times what was found.
const PRIOR_WIDTH: f64 = 2.0;

/// A departure in the form of a case's effect.
#[derive(Clone, Debug)]
pub struct ComposedEffect {
    /// A name that no effect of the case has.
    pub name: String,
    /// What it is made of, the first term first.
    pub terms: Vec<ComposedTerm>,
    /// Whether the functions of the terms are multiplied by each other.
    pub product: bool,
    /// What quantities become, by their names.
    pub overrides: Vec<(String, String)>,
    /// Its parameters.
    pub parameters: Vec<ComposedParameter>,
    /// The effects of the list that it acts beside.
    pub beside: Vec<String>,
    /// Posterior probability.
    pub probability: f64,
    /// How far the gap shrinks with it, on rows that were not used to fit its size, in standard
    /// uncertainties.
    pub shrunk: Shrunk,
}

/// A term of a composed departure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ComposedTerm {
    /// The quantity, or outputs that depart alike.
    pub quantities: Vec<String>,
    /// Whether it is added or a share.
    pub kind: DepartureKind,
    /// What it is a function of.
    pub over: DepartureOver,
    /// The function.
    pub form: ComposedForm,
}

/// A parameter of a composed departure.
#[derive(Clone, Debug)]
pub struct ComposedParameter {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// What a case may take to be known of it beforehand.
    pub prior: ComposedPrior,
    /// Posterior estimate.
    pub estimate: f64,
    /// Posterior standard uncertainty.
    pub standard_uncertainty: f64,
}

/// A prior distribution of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ComposedPrior {
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        std: f64,
    },
    /// Rectangular.
    Rectangular {
        /// Lower end.
        lower: f64,
        /// Upper end.
        upper: f64,
    },
    /// Rectangular in its logarithm.
    LogUniform {
        /// Lower end.
        lower: f64,
        /// Upper end.
        upper: f64,
    },
}

impl Compositions {
    /// The leading ones as effects; `unexplained` is the probability that they share, and `taken` are
    /// names that effects have.
    pub(crate) fn effects(&self, setup: &Setup<'_>, unexplained: f64) -> Vec<ComposedEffect> {
        let metric = Metric::new(setup, self.variances.as_deref());
        let residuals = by_rows(&setup.data.linear_residuals());
        let white = metric.white(&residuals);
        let mut taken: Vec<String> =
            setup.case.candidates.iter().map(|c| c.effect.name.clone()).collect();
        let mut effects = Vec::new();
        for composition in &self.all {
            if effects.len() == MOST {
                break;
            }
            let Some(mut effect) = composition.effect(setup, &metric, &white) else { continue };
            // a variant of the same terms says nothing new
            let same = |other: &ComposedEffect| {
                other.terms == effect.terms
                    && other.product == effect.product
                    && other.beside == effect.beside
            };
            if let Some(known) = effects.iter_mut().find(|other| same(other)) {
                known.probability += composition.share * unexplained;
                continue;
            }
            effect.probability = composition.share * unexplained;
            let mut name = effect.name.clone();
            let mut number = 2;
            while taken.contains(&name) {
                name = format!("{}-{number}", effect.name);
                number += 1;
            }
            taken.push(name.clone());
            effect.name = name;
            effect.shrunk = self.shrunk(setup, composition);
            effects.push(effect);
        }
        largest_first(&mut effects, |a| a.probability);
        effects
    }
}

/// The rows of the points of the data.
pub(super) fn rows_of_points(setup: &Setup<'_>) -> Vec<Row> {
    let first = |point: &gumption_inference::data::Point| point.rows.first().copied().unwrap_or(0);
    let rows = setup.data.points.iter().map(first);
    rows.map(|row| setup.row(row).clone()).collect()
}

impl Composition {
    /// What its functions do to the data: by value, with the shares of its terms' parameters.
    pub(super) fn in_data(&self, setup: &Setup<'_>, shares: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let rows = rows_of_points(setup);
        let nominal: Vec<Vec<f64>> =
            setup.data.points.iter().map(|point| point.tangent.touching.clone()).collect();
        let by_point = self.columns(setup, &rows, &nominal, shares);
        let outputs = setup.data.outputs.len();
        let spread = |column: Vec<f64>| -> Vec<f64> {
            let of =
                |&point: &usize| column[point * outputs..(point + 1) * outputs].iter().copied();
            setup.data.point_of.iter().flat_map(of).collect()
        };
        by_point.into_iter().map(spread).collect()
    }

    /// What its functions do in rows: by value.
    pub(super) fn columns(
        &self,
        setup: &Setup<'_>,
        rows: &[Row],
        nominal: &[Vec<f64>],
        shares: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let mut terms = self.terms.iter().zip(shares).map(|(term, own)| (term, own.as_slice()));
        if self.product {
            let first = terms.next();
            let others: Vec<(&DepartureTerm, &[f64])> = terms.collect();
            let of = |(term, own): (&DepartureTerm, &[f64])| {
                term.columns(setup, rows, nominal, own, &others)
            };
            return first.map(of).unwrap_or_default();
        }
        terms.flat_map(|(term, own)| term.columns(setup, rows, nominal, own, &[])).collect()
    }

    pub(super) fn shares(&self) -> Vec<Vec<f64>> {
        self.terms.iter().map(|term| term.shares.clone()).collect()
    }

    /// The sizes of its functions with these parameters.
    fn fit(
        &self,
        setup: &Setup<'_>,
        metric: &Metric<'_>,
        residuals: &White,
        shares: &[Vec<f64>],
    ) -> Option<Fit> {
        let columns: Vec<White> =
            self.in_data(setup, shares).iter().map(|column| metric.white(column)).collect();
        let d = columns.len();
        let touched = |white: &White| white.values.iter().filter(|x| **x != 0.0).count() as f64;
        let scale = |white: &White| {
            let squares: f64 = white.values.iter().map(|x| x * x).sum();
            (squares / touched(white)).sqrt()
        };
        let gram = DMatrix::from_fn(d, d, |i, j| columns[i].dot(&columns[j]));
        let products = DVector::from_fn(d, |i, _| columns[i].dot(residuals));
        solved(&gram, &products, &columns.iter().map(scale).collect::<Vec<f64>>())
    }

    fn effect(
        &self,
        setup: &Setup<'_>,
        metric: &Metric<'_>,
        residuals: &White,
    ) -> Option<ComposedEffect> {
        let best = self.shares();
        let fit = self.fit(setup, metric, residuals, &best)?;
        let sim = &setup.case.model;
        let mut written = EffectText { sim, parameters: Vec::new(), overrides: Vec::new() };
        // what the sizes become one standard deviation off in each parameter
        let moved = |number: usize| -> Vec<[Option<Fit>; 2]> {
            let term = &self.terms[number];
            (0..term.shares.len())
                .map(|n| {
                    [1.0, -1.0].map(|sign| {
                        let mut shares = best.clone();
                        let share = &mut shares[number][n];
                        *share = (*share + sign * term.widths[n]).clamp(0.0, 1.0);
                        self.fit(setup, metric, residuals, &shares)
                    })
                })
                .collect()
        };
        if self.product {
            let all: Vec<_> = (0..self.terms.len()).flat_map(moved).collect();
            let terms: Vec<&DepartureTerm> = self.terms.iter().collect();
            written.term(&terms, &fit, &all, 0)?;
        } else {
            let mut place = 0;
            for (number, term) in self.terms.iter().enumerate() {
                written.term(&[term], &fit, &moved(number), place)?;
                place += term.shape.count();
            }
        }
        let EffectText { parameters, overrides, .. } = written;
        let effect = ComposedEffect {
            name: self.name(setup),
            terms: self.terms.iter().map(|term| term.described(setup)).collect(),
            product: self.product,
            overrides,
            parameters,
            beside: setup.effect_names(&self.beside),
            probability: 0.0,
            shrunk: Shrunk {
                rms_before: 0.0,
                rms_after: 0.0,
                noise_floor: 1.0,
                removed_fraction: 0.0,
            },
        };
        effect.is_sound(sim).then_some(effect)
    }

    fn name(&self, setup: &Setup<'_>) -> String {
        // a loop is one whatever its shape
        let history = |term: &&DepartureTerm| term.argument.history(setup).is_some();
        if self.product
            && let Some(term) = self.terms.iter().find(history)
            && let Some(name) = term.cause(setup)
        {
            return name;
        }
        let of = |term: &DepartureTerm| {
            if let Some(name) = term.cause(setup) {
                return name;
            }
            let form = term.shape.form().name();
            let quantity = term.target.names.join("-");
            match term.argument.over(setup) {
                DepartureOver::Nothing | DepartureOver::AllConditions => {
                    format!("{quantity}-{form}")
                }
                DepartureOver::Value => format!("{quantity}-{form}-over-value"),
                DepartureOver::Condition(name) => format!("{quantity}-{form}-over-{name}"),
            }
        };
        self.terms.iter().map(of).collect::<Vec<_>>().join("-and-")
    }
}

impl DepartureTerm {
    /// The name of what does this on benches, of a function of the order of the rows.
    fn cause(&self, setup: &Setup<'_>) -> Option<String> {
        let history = self.argument.history(setup)?;
        let name = match (history.kind, self.shape.form()) {
            (HistoryKind::Direction | HistoryKind::Extreme, _) => "hysteresis",
            (HistoryKind::Since, _) => "creep",
            (HistoryKind::Previous, _) => "memory",
            (HistoryKind::Order, ComposedForm::Exponential | ComposedForm::FirstOrder) => "warm-up",
            (HistoryKind::Order, ComposedForm::Slope) => "drift",
            (HistoryKind::Order | HistoryKind::Repetition, _) => return None,
        };
        Some(format!("{}-{name}", self.target.names.join("-")))
    }

    pub(super) fn described(&self, setup: &Setup<'_>) -> ComposedTerm {
        ComposedTerm {
            quantities: self.target.names.clone(),
            kind: self.kind,
            over: self.argument.over(setup),
            form: self.shape.form(),
        }
    }
}

/// The text of an effect while it is written.
struct EffectText<'s> {
    sim: &'s OverridableModel,
    parameters: Vec<ComposedParameter>,
    overrides: Vec<(String, String)>,
}

impl EffectText<'_> {
    /// A name for a parameter.
    fn named(&self, wanted: &str) -> String {
        let known = |name: &str| self.parameters.iter().any(|parameter| parameter.name == name);
        let mut name = fresh(self.sim, wanted);
        let mut number = 2;
        while known(&name) {
            name = fresh(self.sim, &format!("{wanted}{number}"));
            number += 1;
        }
        name
    }

    fn add(&mut self, wanted: &str, unit: &Unit, prior: ComposedPrior, found: [f64; 2]) -> String {
        let name = self.named(wanted);
        let unit = match unit.text() {
            "" => "1".to_owned(),
            text => text.to_owned(),
        };
        let [estimate, standard_uncertainty] = found;
        self.parameters.push(ComposedParameter {
            name: name.clone(),
            unit,
            prior,
            estimate,
            standard_uncertainty,
        });
        name
    }

    /// Adds a term, or several whose functions are multiplied, which stand at `place` among those of a
    /// fit.
    fn term(
        &mut self,
        terms: &[&DepartureTerm],
        fit: &Fit,
        moved: &[[Option<Fit>; 2]],
        place: usize,
    ) -> Option<()> {
        let term = *terms.first()?;
        let size_unit = match term.kind {
            DepartureKind::Additive => of_differences(&term.target.unit),
            DepartureKind::Proportional => Unit::one(),
        };
        // the size with its uncertainty, and what a change of the parameters makes of it
        let factor = |fit: &Fit, n: usize| fit.factors[place + n];
        let spread = |figure: &dyn Fn(&Fit) -> f64| -> f64 {
            let squares = moved.iter().map(|[up, down]| match (up, down) {
                (Some(up), Some(down)) => (0.5 * (figure(up) - figure(down))).powi(2),
                _ => 0.0,
            });
            squares.sum()
        };
        let variance = |n: usize| fit.covariance[(place + n, place + n)];
        let wave = term.shape.function == Function::Wave;
        let (size, u) = if wave {
            let of = |fit: &Fit| elementary::hypot(factor(fit, 0), factor(fit, 1));
            let size = of(fit);
            (size, (0.5 * (variance(0) + variance(1)) + spread(&of)).sqrt())
        } else {
            let of = |fit: &Fit| factor(fit, 0);
            (of(fit), (variance(0) + spread(&of)).sqrt())
        };
        let wide = |size: f64, u: f64| {
            let std = to_digits(PRIOR_WIDTH * size.abs().max(3.0 * u), 2);
            ComposedPrior::Normal { mean: 0.0, std }
        };
        let mut phase = String::new();
        let mut size = size;
        let mut turned = None;
        if wave {
            let angle = elementary::atan2(factor(fit, 1), factor(fit, 0)).to_degrees();
            // sizes of either sign, so half a turn of phases
            let (angle, sign) = match angle {
                angle if angle > 90.0 => (angle - 180.0, -1.0),
                angle if angle < -90.0 => (angle + 180.0, -1.0),
                angle => (angle, 1.0),
            };
            size *= sign;
            turned = Some((angle, (u / size.abs()).to_degrees()));
        }
        let k = self.add("k", &size_unit, wide(size, u), [size, u]);
        if let Some(found) = turned {
            let degrees = Unit::parse("deg").ok()?;
            let prior = ComposedPrior::Rectangular { lower: -100.0, upper: 100.0 };
            phase = self.add("phase", &degrees, prior, [found.0, found.1]);
        }
        let mut sum = k;
        for term in terms {
            if let Some(function) = self.function(term, &phase) {
                sum = format!("{sum}*{function}");
            }
        }
        if term.shape.offset {
            let last = term.shape.count() - 1;
            let of = |fit: &Fit| factor(fit, last);
            let (value, u) = (of(fit), (variance(last) + spread(&of)).sqrt());
            let name = self.add("k0", &size_unit, wide(value, u), [value, u]);
            sum = format!("{sum} + {name}");
        }
        for quantity in &term.target.names {
            let known = self.overrides.iter().position(|(name, _)| name == quantity);
            let before =
                known.map_or_else(|| quantity.clone(), |at| format!("({})", self.overrides[at].1));
            let text = match term.kind {
                DepartureKind::Additive => format!("{before} + {sum}"),
                DepartureKind::Proportional => format!("{before}*(1 + {sum})"),
            };
            match known {
                Some(at) => self.overrides[at].1 = text,
                None => self.overrides.push((quantity.clone(), text)),
            }
        }
        Some(())
    }
}

impl EffectText<'_> {
    /// The function of a term as a formula; its parameters are added.
    fn function(&mut self, term: &DepartureTerm, phase: &str) -> Option<String> {
        let sim = self.sim;
        let (argument, unit) = match term.argument {
            Argument::Nothing => return None,
            Argument::Condition(c) => {
                let condition = &sim.conditions[c];
                (condition.name.clone(), condition.unit.clone())
            }
            Argument::Value => (term.target.names[0].clone(), term.target.unit.clone()),
        };
        // formulas compute with plain numbers of the argument's unit
        let number = |text: &str, unit: &Unit| match sim.numbers {
            NumberForm::Declared => text.to_owned(),
            NumberForm::Coherent if unit.dimension().is_none() && unit.factor() == 1.0 => {
                text.to_owned()
            }
            NumberForm::Coherent => format!("{text}/[{}]", unit.text()),
        };
        let mut texts = Vec::new();
        for (n, range) in term.shape.ranges.iter().enumerate() {
            let own = match range.of {
                RangeOf::Place => unit.clone(),
                RangeOf::Width => of_differences(&unit),
                RangeOf::Number => Unit::one(),
            };
            let [lower, upper] = range.ends;
            let prior = if range.logarithmic {
                ComposedPrior::LogUniform { lower, upper }
            } else {
                ComposedPrior::Rectangular { lower, upper }
            };
            let share = term.shares[n];
            let width = match term.shape.function {
                // between two levels a step may be anywhere
                Function::Step => term.shape.gap_about(range.value(share)),
                _ => term.widths[n] * range.slope(share).abs(),
            };
            let wanted = match range.of {
                RangeOf::Place => {
                    let stem = argument.trim_end_matches(')').replace('(', "_");
                    format!("{stem}_{}", range.name)
                }
                RangeOf::Width | RangeOf::Number => range.name.to_owned(),
            };
            let name = self.add(&wanted, &own, prior, [range.value(share), width]);
            texts.push(number(&name, &own));
        }
        term.shape.text(&number(&argument, &unit), &texts, phase)
    }
}

impl ComposedEffect {
    /// The effect that the text stands for; `None` where it is no formula.
    pub(super) fn parsed(&self) -> Option<Effect> {
        let parameter = |parameter: &ComposedParameter| {
            let unit = Unit::parse(&parameter.unit).ok()?;
            Some(Quantity { name: parameter.name.clone(), unit, about: String::new() })
        };
        let formula =
            |(name, text): &(String, String)| Some((name.clone(), Formula::parse(text).ok()?));
        Some(Effect {
            name: self.name.clone(),
            parameters: self.parameters.iter().map(parameter).collect::<Option<_>>()?,
            overrides: self.overrides.iter().map(formula).collect::<Option<_>>()?,
        })
    }

    /// Whether its formulas have the dimensions of what they override and can act on the sim.
    fn is_sound(&self, sim: &OverridableModel) -> bool {
        let Some(effect) = self.parsed() else { return false };
        let scope = effect.scope(&sim.scope);
        let fits = |(name, formula): &(String, Formula)| {
            let own = sim.scope.get(name).and_then(|typing| typing.dimension);
            match sim.numbers {
                NumberForm::Declared => formula.check_names(&scope).is_ok(),
                NumberForm::Coherent => {
                    formula.check(&scope).is_ok_and(|typing| own.is_none_or(|own| typing.fits(own)))
                }
            }
        };
        effect.overrides.iter().all(fits) && sim.program(&[&effect]).is_ok()
    }
}
