//! A calibration function in formulas.

use std::sync::Arc;

use super::result::Regression;
use crate::model::formula::Typing;
use crate::model::{NumberForm, in_si, in_unit};
use crate::number::Number;
use gumption_units::Unit;

/// A fitted curve with the units of both sides: `line(x)` and `inverse(line, y)`.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct CurveFunction {
    /// The fit.
    pub fit: Arc<Regression>,
    /// Unit of x.
    pub x: Unit,
    /// Unit of y.
    pub y: Unit,
    /// The parameters' names, `line.a`, with their units.
    pub parameters: Vec<(String, Unit)>,
    /// The numbers with which formulas compute.
    pub form: NumberForm,
    /// Whether the units of x and of y are stated; without a stated unit they are plain numbers.
    pub is_stated: [bool; 2],
}

impl PartialEq for CurveFunction {
    fn eq(&self, other: &Self) -> bool {
        self.fit == other.fit && self.x == other.x && self.y == other.y
    }
}

impl CurveFunction {
    /// A fit with points in these units.
    pub fn new(
        fit: Arc<Regression>,
        (x, y): (Unit, Unit),
        parameters: Vec<(String, Unit)>,
        form: NumberForm,
    ) -> Self {
        Self { fit, x, y, parameters, form, is_stated: [true; 2] }
    }

    /// The same with flags for x and y whether their units are stated.
    #[must_use]
    pub fn stating(self, is_stated: [bool; 2]) -> Self {
        Self { is_stated, ..self }
    }

    /// The curve's value, or with `inverse` the x that gives a value, as a number of formulas; the
    /// parameters are such numbers too, and `argument` is already in the unit of its side.
    pub(crate) fn value<T: Number>(&self, argument: T, parameters: &[T], inverse: bool) -> T {
        let own: Vec<T> = parameters
            .iter()
            .zip(&self.parameters)
            .map(|(value, (_, unit))| match self.form {
                // temperatures and levels count from their zero
                NumberForm::Coherent => in_unit(*value, unit, Typing::in_unit(unit)),
                NumberForm::Declared => *value,
            })
            .collect();
        let (value, unit) = if inverse {
            let sign = self.fit.direction().unwrap_or(f64::NAN);
            (self.fit.curve.inverse(argument, &own, self.fit.points.range(), sign), &self.x)
        } else if self.fit.curve.is_complex() {
            let [re, im] = self.fit.curve.parts(argument, &own);
            (T::complex(re, im), &self.y)
        } else {
            (self.fit.curve.value(argument, &own), &self.y)
        };
        match self.form {
            NumberForm::Coherent => in_si(value, unit),
            NumberForm::Declared => value,
        }
    }
}
