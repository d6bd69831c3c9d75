//! The cheapest combination of improvements.
//!
//! For inputs that can be improved continuously, the cost is minimal if one unit of cost buys the
//! same share of the combined variance for each of them. With the cost C_i (u_i0/u_i)^p_i and the
//! share D_i = (d u^2/d u_i) u_i/2 of input i (c_i^2 u_i^2 without correlations), the condition is
//! p_i C_i (u_i0/u_i)^p_i = lambda D_i, between the smallest possible u_i and u_i0. lambda is
//! determined so that the target just holds. With a fixed coverage factor and no negative
//! correlations the problem is convex in ln u_i, and this is its minimum. The dependence of k on
//! the shares is taken into account when the target is checked, not in the condition.
//!
//! Numbers of readings are first real (their cost has that form, with power 2), then all integers
//! near the solution are tried. Offers are tried in all combinations.

use super::NoPlan;
use super::cost::{Costs, Improvement, Offer};
use super::trial_budget::{Change, Changes, Plannable, TrialBudget};
use gumption_engine::propagate::gum::Gum;

/// Combinations of offers, at most.
const MOST_COMBINATIONS: usize = 2000;

/// Maximum number of combinations of integer numbers of readings.
const MOST_WHOLE: usize = 400;

/// Number of iterations for the shares of correlated inputs.
const SETTLING: usize = 25;

/// An input in a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedInput {
    /// Place of the variable in the task.
    pub variable: usize,
    /// Its standard uncertainty now.
    pub from: f64,
    /// Its planned standard uncertainty.
    pub to: f64,
    /// The planned number of readings, if that is changed.
    pub readings: Option<u64>,
    /// The chosen offer, in words.
    pub offer: Option<String>,
    /// Its cost.
    pub cost: f64,
}

/// A plan.
#[derive(Clone, Debug)]
pub struct CheapestPlan {
    /// The inputs that can be improved, in the order of the task.
    pub inputs: Vec<PlannedInput>,
    /// The total cost.
    pub cost: f64,
    /// The output as planned.
    pub gum: Gum,
}

impl CheapestPlan {
    /// The changed inputs with their changes.
    pub(super) fn changes(&self) -> Changes {
        let changed = self.inputs.iter().filter(|input| input.to != input.from);
        changed
            .map(|input| match input.readings {
                Some(count) => (input.variable, Change::Readings(count as f64)),
                None => (input.variable, Change::Width(input.to)),
            })
            .collect()
    }
}

/// An input that can be improved continuously.
#[derive(Clone, Copy, Debug)]
struct Smooth {
    variable: usize,
    now: f64,
    cost: f64,
    power: f64,
    least: f64,
    /// The present number of readings, if u depends on it.
    readings: Option<f64>,
}

impl Smooth {
    fn change(&self, u: f64) -> Change {
        match self.readings {
            Some(now) => Change::Readings(now * (self.now / u).powi(2)),
            None => Change::Width(u),
        }
    }

    fn cost(&self, u: f64) -> f64 {
        self.cost * (libm::pow(self.now / u, self.power) - 1.0)
    }
}

/// An input that is improved by more readings.
#[derive(Clone, Copy, Debug)]
struct Counted {
    variable: usize,
    now: u64,
    most: u64,
    each: f64,
}

/// The problem without its offers.
#[derive(Debug)]
struct Problem<'a> {
    budget: &'a TrialBudget<'a>,
    smooth: Vec<Smooth>,
    counted: Vec<Counted>,
}

/// A solution and its cost.
type Solution = (Changes, f64);

pub(super) fn cheapest(budget: &TrialBudget<'_>, costs: &Costs) -> Result<CheapestPlan, NoPlan> {
    let mut problem = Problem { budget, smooth: Vec::new(), counted: Vec::new() };
    let mut offers: Vec<(usize, Vec<Offer>)> = Vec::new();
    let mut improved = Vec::new();
    for variable in 0..budget.task.variables.len() {
        let Some(improvement) = costs.improvement(budget, variable) else { continue };
        improved.push(variable);
        let now = budget.uncertainty(variable);
        match improvement {
            Improvement::Continuous { cost, power, least } => {
                let least = least.min(now);
                let readings = None;
                problem.smooth.push(Smooth { variable, now, cost, power, least, readings });
            }
            Improvement::Readings { each, most } => {
                if let Plannable::Readings(count) = budget.plannable(variable) {
                    let most = most.max(count);
                    problem.counted.push(Counted { variable, now: count, most, each });
                }
            }
            Improvement::Offers(of) => offers.push((variable, of)),
        }
    }
    let sizes = offers.iter().map(|(_, choices)| choices.len() + 1);
    let combinations = sizes.clone().fold(1_usize, usize::saturating_mul);
    if combinations > MOST_COMBINATIONS {
        return Err(NoPlan::TooManyOffers { found: combinations, most: MOST_COMBINATIONS });
    }
    let mut best: Option<Solution> = None;
    for number in 0..combinations {
        let (mut rest, mut taken, mut cost) = (number, Changes::new(), 0.0);
        for (variable, choices) in &offers {
            let choice = rest % (choices.len() + 1);
            rest /= choices.len() + 1;
            if let Some(offer) = choice.checked_sub(1).and_then(|choice| choices.get(choice)) {
                taken.push((*variable, Change::Width(offer.standard_uncertainty)));
                cost += offer.cost;
            }
        }
        if best.as_ref().is_some_and(|(_, least)| cost >= *least) {
            continue;
        }
        if let Some((mut changes, more)) = problem.solve(&taken)
            && best.as_ref().is_none_or(|(_, least)| cost + more < *least)
        {
            changes.extend(taken);
            best = Some((changes, cost + more));
        }
    }
    let Some((changes, cost)) = best else {
        return Err(NoPlan::Unreachable(problem.least(&offers)));
    };
    let gum = budget.gum(&changes).ok_or(NoPlan::Undefined)?;
    let inputs = improved.into_iter().map(|variable| {
        let change = changes.iter().find(|(changed, _)| *changed == variable);
        problem.planned(variable, change.map(|(_, change)| *change), &offers)
    });
    Ok(CheapestPlan { inputs: inputs.collect(), cost, gum })
}

impl Problem<'_> {
    /// The cheapest solution for the chosen offers; `None` if the target cannot be reached with
    /// them.
    fn solve(&self, taken: &Changes) -> Option<Solution> {
        if self.counted.is_empty() {
            return self.balanced(taken, &self.smooth);
        }
        // readings as real numbers: their cost is each * now * ((u0/u)^2 - 1)
        let relaxed = self.counted.iter().map(|counted| {
            let now = self.budget.uncertainty(counted.variable);
            Smooth {
                variable: counted.variable,
                now,
                cost: counted.each * counted.now as f64,
                power: 2.0,
                least: now * (counted.now as f64 / counted.most as f64).sqrt(),
                readings: Some(counted.now as f64),
            }
        });
        let all: Vec<Smooth> = self.smooth.iter().copied().chain(relaxed).collect();
        let (found, _) = self.balanced(taken, &all)?;
        let middle: Vec<u64> = self
            .counted
            .iter()
            .map(|counted| {
                let count = found.iter().find_map(|(variable, change)| match change {
                    Change::Readings(count) if *variable == counted.variable => Some(*count),
                    _ => None,
                });
                (count.map_or(counted.now, |count| count.floor() as u64))
                    .clamp(counted.now, counted.most)
            })
            .collect();
        // the widest range that can be tried
        let count = u32::try_from(self.counted.len()).unwrap_or(u32::MAX);
        let width = (2..=12_usize)
            .rev()
            .find(|w| w.checked_pow(count).is_some_and(|combinations| combinations <= MOST_WHOLE));
        let (width, below) = width.map_or((1, 0), |width| (width, (width / 2 - 1) as u64));
        let combinations = width.saturating_pow(count).min(MOST_WHOLE);
        let mut best: Option<Solution> = None;
        let mut upper = None;
        for number in 0..=combinations {
            let (mut rest, mut fixed, mut cost) = (number, taken.clone(), 0.0);
            for (counted, &middle) in self.counted.iter().zip(&middle) {
                // the last attempt rounds all of them up
                let step = if number == combinations { below + 1 } else { (rest % width) as u64 };
                rest /= width;
                let whole = (middle + step).saturating_sub(below).clamp(counted.now, counted.most);
                fixed.push((counted.variable, Change::Readings(whole as f64)));
                cost += counted.each * (whole - counted.now) as f64;
            }
            if number == combinations {
                upper = Some(fixed.clone());
            }
            if best.as_ref().is_some_and(|(_, least)| cost >= *least) {
                continue;
            }
            if let Some((smooth, more)) = self.balanced(&fixed, &self.smooth)
                && best.as_ref().is_none_or(|(_, least)| cost + more < *least)
            {
                let own = fixed.into_iter().skip(taken.len());
                best = Some((smooth.into_iter().chain(own).collect(), cost + more));
            }
        }
        best.or_else(|| self.further(taken, upper?))
    }

    /// If no integers near the real numbers suffice, because k changes: more readings of all inputs
    /// until the target holds.
    fn further(&self, taken: &Changes, mut fixed: Changes) -> Option<Solution> {
        for _ in 0..10_000 {
            let mut moved = false;
            for counted in &self.counted {
                for (variable, change) in fixed.iter_mut().skip(taken.len()) {
                    if let Change::Readings(count) = change
                        && *variable == counted.variable
                        && *count < counted.most as f64
                    {
                        *count += 1.0;
                        moved = true;
                    }
                }
            }
            if let Some((smooth, more)) = self.balanced(&fixed, &self.smooth) {
                let own: Changes = fixed.into_iter().skip(taken.len()).collect();
                let cost = |counted: &Counted| {
                    let count = own.iter().find_map(|(variable, change)| match change {
                        Change::Readings(count) if *variable == counted.variable => Some(*count),
                        _ => None,
                    });
                    count.map_or(0.0, |count| counted.each * (count - counted.now as f64))
                };
                let cost = more + self.counted.iter().map(cost).sum::<f64>();
                return Some((smooth.into_iter().chain(own).collect(), cost));
            }
            if !moved {
                return None;
            }
        }
        None
    }

    /// The cheapest standard uncertainties of the continuous inputs, with the others fixed.
    fn balanced(&self, fixed: &Changes, smooth: &[Smooth]) -> Option<Solution> {
        let with = |u: &[f64]| -> Changes {
            let own = smooth.iter().zip(u).filter(|(width, u)| **u != width.now);
            own.map(|(width, &u)| (width.variable, width.change(u)))
                .chain(fixed.iter().copied())
                .collect()
        };
        let now: Vec<f64> = smooth.iter().map(|width| width.now).collect();
        let solution = |u: &[f64]| -> Solution {
            let cost = smooth.iter().zip(u).map(|(width, &u)| width.cost(u)).sum();
            let own = with(u).into_iter().filter(|(v, _)| fixed.iter().all(|(f, _)| f != v));
            (own.collect(), cost)
        };
        if self.budget.holds(&with(&now)) {
            return Some(solution(&now));
        }
        let least: Vec<f64> = smooth.iter().map(|width| width.least).collect();
        // the share of each input in the variance, divided by the square of its standard
        // uncertainty
        let slopes = |u: &[f64]| self.slopes(&with(u), smooth, u);
        let at = |lambda: f64| -> Option<Vec<f64>> {
            let mut u = now.clone();
            for _ in 0..SETTLING {
                let slopes = slopes(&u)?;
                let next: Vec<f64> = smooth
                    .iter()
                    .zip(&slopes)
                    .map(|(width, &slope)| {
                        if slope <= 0.0 {
                            return width.now;
                        }
                        // p C u0^p / (lambda d) = u^(p + 2), in logarithms so that nothing overflows
                        let ln = (libm::log(width.power * width.cost / slope)
                            + width.power * libm::log(width.now)
                            - lambda)
                            / (width.power + 2.0);
                        libm::exp(ln).clamp(width.least, width.now)
                    })
                    .collect();
                let settled =
                    next.iter().zip(&u).all(|(a, b)| (a - b).abs() <= 1e-14 * f64::max(*a, *b));
                u = next;
                if settled {
                    break;
                }
            }
            Some(u)
        };
        // the logarithm of lambda at which the first input begins to change
        let first = smooth
            .iter()
            .zip(slopes(&now)?)
            .filter(|(_, slope)| *slope > 0.0)
            .map(|(width, slope)| {
                libm::log(width.power * width.cost / slope) - 2.0 * libm::log(width.now)
            })
            .fold(f64::INFINITY, f64::min);
        if !first.is_finite() {
            return None;
        }
        let holds = |lambda: f64| at(lambda).is_some_and(|u| self.budget.holds(&with(&u)));
        let mut step = 1.0;
        let (mut outside, mut inside) = (first, first + step);
        while !holds(inside) {
            if at(inside)? == least || step > 1e4 {
                return None;
            }
            step *= 2.0;
            (outside, inside) = (inside, inside + step);
        }
        let lambda = super::search::boundary(inside, outside, holds);
        Some(solution(&at(lambda)?))
    }

    /// For each continuous input D_i/u_i^2 = c_i^2 + sum_j r_ij c_i c_j u_j/u_i.
    fn slopes(&self, changes: &Changes, smooth: &[Smooth], u: &[f64]) -> Option<Vec<f64>> {
        let gum = self.budget.gum(changes)?;
        let variance = gum.standard_uncertainty.powi(2);
        let lines: Vec<_> = gum.budget().collect();
        let links: Vec<_> = gum.correlations().collect();
        let of = |(width, &u): (&Smooth, &f64)| {
            let own = lines.iter().find(|line| line.variable == width.variable);
            let own = own.map_or(0.0, |line| line.sensitivity * line.sensitivity);
            let linked = links.iter().filter(|link| link.variables.contains(&width.variable));
            // the share belongs to both
            let joint: f64 = linked.map(|link| 0.5 * link.share * variance).sum();
            if u > 0.0 && joint != 0.0 { own + joint / (u * u) } else { own }
        };
        Some(smooth.iter().zip(u).map(of).collect())
    }

    /// The smallest reachable value, for the message.
    fn least(&self, offers: &[(usize, Vec<Offer>)]) -> f64 {
        let smooth = self.smooth.iter().map(|width| (width.variable, Change::Width(width.least)));
        let counted = self
            .counted
            .iter()
            .map(|counted| (counted.variable, Change::Readings(counted.most as f64)));
        let offered = offers.iter().map(|(variable, choices)| {
            let now = self.budget.uncertainty(*variable);
            let least = choices.iter().map(|offer| offer.standard_uncertainty).fold(now, f64::min);
            (*variable, Change::Width(least))
        });
        let changes = smooth.chain(counted).chain(offered).collect();
        self.budget.figure(&changes).unwrap_or(f64::NAN)
    }

    /// The change of an input.
    fn planned(
        &self,
        variable: usize,
        change: Option<Change>,
        offers: &[(usize, Vec<Offer>)],
    ) -> PlannedInput {
        let from = self.budget.uncertainty(variable);
        let to = change.map_or(from, |change| self.budget.changed_uncertainty(variable, change));
        let counted = self.counted.iter().find(|counted| counted.variable == variable);
        let readings = counted.map(|counted| match change {
            Some(Change::Readings(count)) => count as u64,
            _ => counted.now,
        });
        let offer = offers
            .iter()
            .find(|(offered, _)| *offered == variable)
            .filter(|_| change.is_some())
            .and_then(|(_, choices)| {
                let same = choices.iter().filter(|offer| offer.standard_uncertainty == to);
                same.min_by(|a, b| a.cost.total_cmp(&b.cost))
            });
        let smooth = self.smooth.iter().find(|width| width.variable == variable);
        let cost = match (smooth, counted, readings, offer) {
            (Some(of), ..) => of.cost(to),
            (_, Some(of), Some(count), _) => of.each * (count - of.now) as f64,
            (.., Some(offer)) => offer.cost,
            _ => 0.0,
        };
        let to = match (counted, readings) {
            (Some(of), Some(count)) if count == of.now => from,
            _ => to,
        };
        PlannedInput {
            variable,
            from,
            to,
            readings,
            offer: offer.map(|offer| offer.about.clone()),
            cost,
        }
    }
}
