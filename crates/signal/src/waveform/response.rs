//! What a signal came through, at the lines of a spectrum, with its errors.

use std::fmt::Debug;
use std::sync::Arc;

use super::errors::LineErrors;
use super::spectrum::Lines;
use crate::phasor::{at_turns, wrapped};
use crate::{Measured, Phasor};
use gumption_engine::linalg::Eigen;
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// In what coordinates a calibration states a response. It is interpolated in these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Real and imaginary part.
    Cartesian,
    /// Modulus and phase, in radians.
    Polar,
}

/// What one standard uncertainty of an error changes: coordinates of some points.
#[derive(Clone, Debug, PartialEq)]
pub struct PointError {
    /// The first of the points.
    pub first: usize,
    /// The changes of their coordinates.
    pub changes: Vec<[f64; 2]>,
}

/// Which lines have an error in common.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Errors {
    /// All between two points of the calibration, as the interpolation has it; where a point is held, all of these.
    #[default]
    OfPoints,
    /// None: each line has its own, with the variance that the interpolation gives.
    OfLines,
}

/// What is done where the points of a calibration end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The last point is held, and its error.
    Hold,
    /// The signal is taken to have nothing there.
    Cut,
}

/// A response known at some frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibratedResponse {
    /// The frequencies, rising, in hertz.
    pub frequencies: Vec<f64>,
    /// The coordinates of the values.
    pub coordinates: Coordinates,
    /// The response at each frequency.
    pub values: Vec<[f64; 2]>,
    /// Independent errors of the points.
    pub errors: Vec<PointError>,
    /// What the errors of lines have in common.
    pub shared: Errors,
    /// What is done below the first and above the last point; none: a line there is an error.
    pub beyond: [Option<Beyond>; 2],
}

/// A formula for a response with parameters.
pub trait ResponseModel: Debug + Send + Sync {
    /// The response at a frequency in hertz.
    fn value(&self, hertz: f64, parameters: &[f64]) -> Phasor;

    /// Its derivatives with respect to the parameters, at their estimates.
    fn gradient(&self, hertz: f64) -> Vec<Phasor>;
}

/// A response that a model has, with fitted parameters.
#[derive(Clone, Debug)]
pub struct ModelledResponse {
    /// The model.
    pub model: Arc<dyn ResponseModel>,
    /// The estimates of the parameters.
    pub estimates: Vec<f64>,
    /// Their covariance matrix, row by row.
    pub covariance: Vec<f64>,
    /// What the model leaves of the points that it was fitted to: a factor about one.
    pub misfit: Option<CalibratedResponse>,
}

/// What a signal came through.
#[derive(Clone, Debug)]
pub enum LineResponse {
    /// Nothing that is known: the response is one.
    Flat,
    /// A response known at some frequencies.
    Calibrated(CalibratedResponse),
    /// A fitted model.
    Modelled(ModelledResponse),
}

/// A response at lines. Where lines are cut, its inverse is zero.
pub(super) struct AtLines {
    pub(super) inverse: Vec<Phasor>,
    /// Of the response.
    pub(super) errors: LineErrors,
    /// Of a model's misfit.
    pub(super) misfit: LineErrors,
}

impl LineResponse {
    /// The inverse of the response at each line, and its errors.
    ///
    /// # Errors
    /// A sentence on where it cannot be had.
    pub(super) fn at(&self, lines: &Lines) -> Result<AtLines, String> {
        match self {
            Self::Flat => Ok(AtLines {
                inverse: vec![Phasor::new(1.0, 0.0); lines.count()],
                errors: LineErrors::default(),
                misfit: LineErrors::default(),
            }),
            Self::Calibrated(of) => {
                of.check(lines)?;
                let inverse = of.inverse(&of.values, lines);
                let errors = of.line_errors(lines);
                let found = AtLines { inverse, errors, misfit: LineErrors::default() };
                found.checked(lines)
            }
            Self::Modelled(of) => {
                let inverse = of.inverse(&of.estimates, lines);
                let errors = of.line_errors(lines);
                let misfit = match &of.misfit {
                    Some(misfit) => misfit.line_errors(lines),
                    None => LineErrors::default(),
                };
                AtLines { inverse, errors, misfit }.checked(lines)
            }
        }
    }

    /// The inverse of a response with errors that are drawn; `normal` gives standard normal numbers.
    pub(super) fn drawn(&self, lines: &Lines, normal: &mut dyn FnMut() -> f64) -> Vec<Phasor> {
        match self {
            Self::Flat => vec![Phasor::new(1.0, 0.0); lines.count()],
            Self::Calibrated(of) => of.drawn(lines, normal),
            Self::Modelled(of) => {
                let mut parameters = of.estimates.clone();
                for root in of.roots() {
                    let size = normal();
                    parameters.iter_mut().zip(root).for_each(|(p, r)| *p += size * r);
                }
                let mut inverse = of.inverse(&parameters, lines);
                if let Some(misfit) = &of.misfit {
                    let factors = misfit.drawn(lines, normal);
                    inverse.iter_mut().zip(factors).for_each(|(value, factor)| *value *= factor);
                }
                inverse
            }
        }
    }
}

impl AtLines {
    /// The same, if no line is divided by zero.
    fn checked(self, lines: &Lines) -> Result<Self, String> {
        match self.inverse.iter().position(|value| !(value.re.is_finite() && value.im.is_finite()))
        {
            Some(line) => Err(format!(
                "the response is zero or undefined at {} Hz, so that the signal cannot be divided by it there",
                lines.hertz(line)
            )),
            None => Ok(self),
        }
    }
}

/// Where a frequency lies: the point before it, and the share of the next.
#[derive(Clone, Copy)]
struct Place {
    point: usize,
    share: f64,
}

impl CalibratedResponse {
    /// The relative errors of points with these relative standard uncertainties of modulus and phase (in radians), each
    /// independent: a factor about one.
    pub fn about_one(frequencies: Vec<f64>, relative: [f64; 2]) -> Self {
        let values = vec![[1.0, 0.0]; frequencies.len()];
        let [of_modulus, of_phase] = relative;
        let errors = (0..frequencies.len()).flat_map(|first| {
            [[of_modulus, 0.0], [0.0, of_phase]]
                .map(|change| PointError { first, changes: vec![change] })
        });
        Self {
            errors: errors.collect(),
            frequencies,
            coordinates: Coordinates::Polar,
            values,
            shared: Errors::OfPoints,
            beyond: [Some(Beyond::Hold); 2],
        }
    }

    /// Whether every line has a point on each side, or what is done there is stated.
    fn check(&self, lines: &Lines) -> Result<(), String> {
        let (Some(first), Some(last)) = (self.frequencies.first(), self.frequencies.last()) else {
            return Err("the response has no points".to_owned());
        };
        let top = lines.hertz(lines.count() - 1);
        let ends = [("below", *first, *first > 0.0, 0.0), ("above", *last, *last < top, top)];
        for ((key, end, is_beyond, to), beyond) in ends.into_iter().zip(self.beyond) {
            if is_beyond && beyond.is_none() {
                return Err(format!(
                    "the response is known {} {end} Hz, and the record has lines to {to} Hz: write `\"{key}\": \"hold\"` \
                     to take the response of that point there, with its error, or `\"{key}\": \"cut\"` if the signal has \
                     nothing there",
                    if key == "below" { "from" } else { "up to" },
                ));
            }
        }
        Ok(())
    }

    /// Where lines lie; none where they are cut.
    fn places(&self, lines: &Lines) -> impl Iterator<Item = Option<Place>> {
        let last = self.frequencies.len() - 1;
        let mut point = 0;
        (0..lines.count()).map(move |line| {
            let hertz = lines.hertz(line);
            if hertz <= self.frequencies[0] {
                let is_cut = hertz < self.frequencies[0] && self.beyond[0] == Some(Beyond::Cut);
                return (!is_cut).then_some(Place { point: 0, share: 0.0 });
            }
            if hertz >= self.frequencies[last] {
                let is_cut = hertz > self.frequencies[last] && self.beyond[1] == Some(Beyond::Cut);
                return (!is_cut).then_some(Place { point: last, share: 0.0 });
            }
            while self.frequencies[point + 1] < hertz {
                point += 1;
            }
            let [from, to] = [self.frequencies[point], self.frequencies[point + 1]];
            Some(Place { point, share: (hertz - from) / (to - from) })
        })
    }

    /// The coordinates at a place. Between two points the phase takes the shorter way.
    fn coordinates_at(&self, values: &[[f64; 2]], place: Place) -> [f64; 2] {
        let from = values[place.point];
        if place.share == 0.0 {
            return from;
        }
        let to = values[place.point + 1];
        let turned = match self.coordinates {
            Coordinates::Cartesian => to[1] - from[1],
            Coordinates::Polar => wrapped(to[1] - from[1]),
        };
        [from[0] + place.share * (to[0] - from[0]), from[1] + place.share * turned]
    }

    fn phasor(&self, [first, second]: [f64; 2]) -> Phasor {
        match self.coordinates {
            Coordinates::Cartesian => Phasor::new(first, second),
            Coordinates::Polar => at_turns(second / TAU) * first,
        }
    }

    /// One over the response at each line.
    fn inverse(&self, values: &[[f64; 2]], lines: &Lines) -> Vec<Phasor> {
        let places = self.places(lines).enumerate();
        places
            .map(|(line, place)| match place {
                None => Phasor::new(0.0, 0.0),
                Some(place) => {
                    inverted(self.phasor(self.coordinates_at(values, place)), lines, line)
                }
            })
            .collect()
    }

    /// The relative changes of lines by each error.
    fn line_errors(&self, lines: &Lines) -> LineErrors {
        let places: Vec<Option<Place>> = self.places(lines).collect();
        // the lines that a point has a part in: those about it, and where it is held all beyond
        let line_after =
            |hertz: f64| places.len().min((hertz / lines.spacing).floor() as usize + 1);
        let mut errors = LineErrors::default();
        for PointError { first, changes } in &self.errors {
            let last = first + changes.len().saturating_sub(1);
            let start = match first.checked_sub(1) {
                Some(before) => line_after(self.frequencies[before]),
                None => 0,
            };
            let end = match self.frequencies.get(last + 1) {
                Some(after) => line_after(*after),
                None => places.len(),
            };
            let of = |point: usize| {
                point
                    .checked_sub(*first)
                    .and_then(|own| changes.get(own))
                    .copied()
                    .unwrap_or([0.0; 2])
            };
            let at = |line: usize| {
                let Some(place) = places[line] else { return Phasor::new(0.0, 0.0) };
                let from = of(place.point);
                let to = if place.share == 0.0 { from } else { of(place.point + 1) };
                let change = [0, 1].map(|c| from[c] + place.share * (to[c] - from[c]));
                let [size, phase] = self.coordinates_at(&self.values, place);
                match self.coordinates {
                    // dH/H
                    Coordinates::Polar => Phasor::new(change[0] / size, change[1]),
                    Coordinates::Cartesian => {
                        let mut value = Phasor::new(size, phase);
                        if lines.is_real(line) {
                            value.im = 0.0;
                        }
                        Phasor::new(change[0], change[1]) / value
                    }
                }
            };
            errors.push(start, (start..end.max(start)).map(at));
        }
        match self.shared {
            Errors::OfPoints => errors,
            Errors::OfLines => errors.of_lines(lines),
        }
    }

    /// One over a response with errors that are drawn.
    fn drawn(&self, lines: &Lines, normal: &mut dyn FnMut() -> f64) -> Vec<Phasor> {
        if self.shared == Errors::OfLines {
            let mut inverse = self.inverse(&self.values, lines);
            for (line, changes) in self.line_errors(lines).each() {
                let size = normal();
                let change: Phasor = changes.iter().sum();
                inverse[line] /= Phasor::new(1.0, 0.0) + change * size;
            }
            return inverse;
        }
        let mut values = self.values.clone();
        for PointError { first, changes } in &self.errors {
            let size = normal();
            for (value, change) in values.iter_mut().skip(*first).zip(changes) {
                value[0] += size * change[0];
                value[1] += size * change[1];
            }
        }
        self.inverse(&values, lines)
    }
}

impl ModelledResponse {
    fn inverse(&self, parameters: &[f64], lines: &Lines) -> Vec<Phasor> {
        let at = |line| inverted(self.model.value(lines.hertz(line), parameters), lines, line);
        (0..lines.count()).map(at).collect()
    }

    /// Changes of the parameters by errors that are independent, each one standard uncertainty.
    fn roots(&self) -> Vec<Vec<f64>> {
        let count = self.estimates.len();
        // in units of the standard uncertainties, so that no parameter's size decides what is rounding
        let size = |i: usize| self.covariance[i * count + i].max(0.0).sqrt();
        let scaled = |i: usize, j: usize| {
            let product = size(i) * size(j);
            if product > 0.0 { self.covariance[i * count + j] / product } else { 0.0 }
        };
        let eigen = Eigen::of(&DMatrix::from_fn(count, count, scaled));
        let roots = eigen.pairs().filter(|(value, _)| *value > 1e-14).map(|(value, vector)| {
            vector.iter().enumerate().map(|(i, v)| v * value.sqrt() * size(i)).collect()
        });
        roots.collect()
    }

    fn line_errors(&self, lines: &Lines) -> LineErrors {
        let roots = self.roots();
        let mut changes = vec![Vec::with_capacity(lines.count()); roots.len()];
        for line in 0..lines.count() {
            let hertz = lines.hertz(line);
            let value = self.model.value(hertz, &self.estimates);
            let gradient = self.model.gradient(hertz);
            for (changes, root) in changes.iter_mut().zip(&roots) {
                let change: Phasor = gradient.iter().zip(root).map(|(g, r)| g * *r).sum();
                changes.push(change / value);
            }
        }
        let mut errors = LineErrors::default();
        changes.into_iter().for_each(|changes| errors.push(0, changes));
        errors
    }
}

/// One over a response; at lines that are their own mirror image the response of a real signal is real.
fn inverted(value: Phasor, lines: &Lines, line: usize) -> Phasor {
    match lines.is_real(line) {
        true => Phasor::new(1.0 / value.re, 0.0),
        false => value.conj() / value.norm_sqr(),
    }
}

/// A delay and a scale as errors of lines, each with one standard uncertainty.
pub(super) fn of_delay(delay: Measured, lines: &Lines) -> LineErrors {
    let mut errors = LineErrors::default();
    if delay.standard_uncertainty > 0.0 {
        let change = |line| Phasor::new(0.0, -TAU * lines.hertz(line) * delay.standard_uncertainty);
        errors.push(0, (0..lines.count()).map(change));
    }
    errors
}

/// A relative standard uncertainty that all lines have in common.
pub(super) fn of_scale(relative: f64, lines: &Lines) -> LineErrors {
    let mut errors = LineErrors::default();
    if relative > 0.0 {
        errors.push(0, std::iter::repeat_n(Phasor::new(relative, 0.0), lines.count()));
    }
    errors
}
