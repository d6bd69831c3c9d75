//! The parameters of a simulator: which of them a hypothesis leaves unknown, and what is known of them.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use gumption_engine::distribution::{Distribution, StreamKey};

use crate::axis::{Axis, Coordinate};
use crate::halton::space_filling_scores;

/// Points at which a correction is known without a run, for each effect.
const FREE: usize = 8;

/// A parameter with what is known of it beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its prior distribution, in its unit; one with quantiles.
    pub prior: Distribution,
}

/// What a simulator can do and the plain one leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulatorEffect {
    /// Its name.
    pub name: String,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The places among them of those that make it absent, each with the value at which it is.
    pub neutral: Vec<(usize, f64)>,
}

/// The parameters of a simulator in their declared order: inputs, then those of each effect.
///
/// The unknowns of a hypothesis are the inputs and the parameters of its effects that are not constant. A
/// point is given by their standard normal scores: a parameter's value is the quantile of its prior at the
/// score's probability.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    names: Vec<String>,
    axes: Vec<Axis>,
    inputs: usize,
    effects: Vec<PlacedEffect>,
    /// What each parameter is where its effect is absent.
    absent: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq)]
struct PlacedEffect {
    places: Range<usize>,
    /// By place among all parameters.
    neutral: Vec<(usize, f64)>,
}

/// Why parameters make no space.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpaceError {
    /// Nothing makes this effect absent.
    NoNeutral(String),
    /// A value that should make this effect absent belongs to none of its parameters, or is no finite
    /// number.
    WrongNeutral(String),
    /// The prior of this parameter has no quantiles, or its width is no finite number above 0.
    NoQuantiles(String),
}

impl fmt::Display for SpaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNeutral(name) => write!(f, "nothing makes the effect `{name}` absent"),
            Self::WrongNeutral(name) => {
                write!(f, "what makes the effect `{name}` absent is no value of its parameters")
            }
            Self::NoQuantiles(name) => {
                write!(f, "the distribution of `{name}` has no quantiles or no finite width")
            }
        }
    }
}

impl Error for SpaceError {}

impl Space {
    /// The parameters of a simulator.
    ///
    /// # Errors
    /// An effect that nothing makes absent; a prior without quantiles or without a finite standard
    /// uncertainty.
    pub fn new(inputs: Vec<Parameter>, effects: Vec<SimulatorEffect>) -> Result<Self, SpaceError> {
        let mut space = Self {
            names: Vec::new(),
            axes: Vec::new(),
            inputs: inputs.len(),
            effects: Vec::new(),
            absent: Vec::new(),
        };
        for input in inputs {
            space.add(input)?;
        }
        for effect in effects {
            let first = space.axes.len();
            for parameter in effect.parameters {
                space.add(parameter)?;
            }
            let places = first..space.axes.len();
            if effect.neutral.is_empty() {
                return Err(SpaceError::NoNeutral(effect.name));
            }
            let mut neutral = Vec::new();
            for (place, value) in effect.neutral {
                if place >= places.len() || !value.is_finite() {
                    return Err(SpaceError::WrongNeutral(effect.name));
                }
                space.absent[first + place] = value;
                neutral.push((first + place, value));
            }
            space.effects.push(PlacedEffect { places, neutral });
        }
        Ok(space)
    }

    fn add(&mut self, Parameter { name, prior }: Parameter) -> Result<(), SpaceError> {
        let width = prior.standard_uncertainty();
        let is_known = prior.constant().is_some() || (width > 0.0 && width.is_finite());
        if !prior.has_quantiles() || !is_known {
            return Err(SpaceError::NoQuantiles(name));
        }
        let axis = Axis::of(&prior);
        self.absent.push(axis.value(0.0));
        self.names.push(name);
        self.axes.push(axis);
        Ok(())
    }

    /// The names of all parameters, in their declared order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The places of an effect's parameters among all parameters.
    pub fn parameters(&self, effect: usize) -> Range<usize> {
        self.effects[effect].places.clone()
    }

    /// Number of effects.
    pub fn effects(&self) -> usize {
        self.effects.len()
    }

    /// The places of a hypothesis' unknowns among all parameters: inputs first, then those of its effects.
    pub fn unknowns(&self, effects: &[usize]) -> Vec<usize> {
        let of_effects = effects.iter().flat_map(|&effect| self.effects[effect].places.clone());
        let varies = |place: &usize| !matches!(self.axes[*place], Axis::Fixed(_));
        (0..self.inputs).chain(of_effects).filter(varies).collect()
    }

    /// The places among a hypothesis' unknowns of those that belong to its effects.
    pub fn effect_unknowns(&self, effects: &[usize]) -> Range<usize> {
        self.unknowns(&[]).len()..self.unknowns(effects).len()
    }

    /// What a simulator is given at the scores of a hypothesis' unknowns: values of all parameters, those
    /// of absent effects neutral, and at the medians of their priors what no neutral value is stated for.
    pub fn values(&self, effects: &[usize], scores: &[f64]) -> Vec<f64> {
        let mut values = self.absent.clone();
        for &effect in effects {
            for place in self.effects[effect].places.clone() {
                values[place] = self.axes[place].value(0.0);
            }
        }
        for (place, &score) in self.unknowns(effects).into_iter().zip(scores) {
            values[place] = self.axes[place].value(score);
        }
        values
    }

    /// The scores of a hypothesis' unknowns at values of them. What lies outside of a bounded prior has
    /// about the score 7.
    pub fn scores(&self, effects: &[usize], values: &[f64]) -> Vec<f64> {
        let unknowns = self.unknowns(effects).into_iter().zip(values);
        unknowns.map(|(place, &value)| self.axes[place].score(value)).collect()
    }

    /// The effects that act at values of all parameters: those of which a parameter that makes them absent is
    /// elsewhere.
    pub fn acting(&self, values: &[f64]) -> Vec<usize> {
        let acts = |effect: &PlacedEffect| {
            effect.neutral.iter().any(|&(place, neutral)| values[place] != neutral)
        };
        (0..self.effects.len()).filter(|&effect| acts(&self.effects[effect])).collect()
    }

    /// The scaled coordinates of a point, with slopes by its scores: 2 Φ(z) - 1 where a prior is flat, also
    /// in the logarithm, and a third of the standardized value elsewhere, within 2.5.
    pub fn at_scores(&self, effects: &[usize], scores: &[f64]) -> Vec<Coordinate> {
        let unknowns = self.unknowns(effects).into_iter().zip(scores);
        unknowns.map(|(place, &score)| self.axes[place].of_score(score)).collect()
    }

    /// The same of the values of a hypothesis' unknowns, with slopes by the values.
    pub fn at_values(&self, effects: &[usize], values: &[f64]) -> Vec<Coordinate> {
        let unknowns = self.unknowns(effects).into_iter().zip(values);
        unknowns.map(|(place, &value)| self.axes[place].of_value(value)).collect()
    }

    /// Scaled coordinates of points at which one of the effects is absent, so that what they do together is
    /// known there without a run.
    pub(crate) fn free_points(&self, effects: &[usize]) -> Vec<Vec<f64>> {
        let unknowns = self.unknowns(effects);
        let mut points = Vec::new();
        for &effect in effects {
            let neutral = self.effects[effect].neutral.iter().map(|&(place, value)| {
                let at = self.axes[place].neutral(value)?;
                Some((unknowns.iter().position(|&unknown| unknown == place)?, at))
            });
            let Some(neutral) = neutral.collect::<Option<Vec<_>>>() else { continue };
            let key = StreamKey::new(0, "emulator/free");
            for scores in space_filling_scores(FREE, unknowns.len(), key) {
                let mut point: Vec<f64> =
                    self.at_scores(effects, &scores).iter().map(|c| c.at).collect();
                for &(place, at) in &neutral {
                    point[place] = at;
                }
                points.push(point);
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::{Constant, LogUniform, Normal, Rectangular};

    fn parameter(name: &str, prior: impl Into<Distribution>) -> Parameter {
        Parameter { name: name.to_owned(), prior: prior.into() }
    }

    fn space() -> Space {
        let inputs = vec![
            parameter("length", Normal::new(0.5, 0.001).unwrap()),
            parameter("g", Constant::new(9.8).unwrap()),
        ];
        let overflow = SimulatorEffect {
            name: "overflow".to_owned(),
            parameters: vec![
                parameter("rim", Rectangular::between(12.0, 45.0).unwrap()),
                parameter("caught", Rectangular::between(0.0, 1.0).unwrap()),
            ],
            neutral: vec![(0, 1e6)],
        };
        let drag = SimulatorEffect {
            name: "drag".to_owned(),
            parameters: vec![parameter("drag", LogUniform::new(1e-4, 1e-2).unwrap())],
            neutral: vec![(0, 0.0)],
        };
        Space::new(inputs, vec![overflow, drag]).unwrap()
    }

    #[test]
    fn absent_effects_are_neutral_and_their_shapes_at_the_median() {
        let space = space();
        assert_eq!(space.unknowns(&[1]), [0, 4]);
        assert_eq!(space.effect_unknowns(&[0, 1]), 1..4);
        assert_eq!(space.values(&[], &[1.0]), [0.501, 9.8, 1e6, 0.5, 0.0]);
        let values = space.values(&[0, 1], &[0.0, 0.0, 0.0, 0.0]);
        // the logarithm's middle is rounded twice
        assert_eq!(values[..4], [0.5, 9.8, 28.5, 0.5]);
        assert!((values[4] - 1e-3).abs() < 1e-17, "{}", values[4]);
    }

    #[test]
    fn an_effect_acts_where_what_makes_it_absent_is_elsewhere() {
        let acting = |rim, caught, drag| space().acting(&[0.5, 9.8, rim, caught, drag]);
        assert_eq!(acting(1e6, 0.2, 0.0), [0usize; 0]);
        assert_eq!(acting(20.0, 0.2, 0.0), [0]);
        assert_eq!(acting(20.0, 0.0, 1e-3), [0, 1]);
    }

    #[test]
    fn free_points_have_an_effect_absent() {
        let space = space();
        // nothing is known where the rim cannot be
        assert!(space.free_points(&[0]).is_empty());
        let free = space.free_points(&[0, 1]);
        assert!(free.len() == FREE && free.iter().all(|point| point[3] < -1.0));
    }

    #[test]
    fn effects_that_nothing_makes_absent_are_refused() {
        let effect = |neutral| SimulatorEffect {
            name: "drag".to_owned(),
            parameters: vec![parameter("drag", Rectangular::new(0.0, 1.0).unwrap())],
            neutral,
        };
        let error = |neutral| Space::new(Vec::new(), vec![effect(neutral)]).unwrap_err();
        assert_eq!(error(vec![]), SpaceError::NoNeutral("drag".to_owned()));
        assert_eq!(error(vec![(1, 0.0)]), SpaceError::WrongNeutral("drag".to_owned()));
        assert_eq!(error(vec![(0, f64::NAN)]), SpaceError::WrongNeutral("drag".to_owned()));
    }
}
