//! One term of a composed departure: a quantity, whether it is added or a share, a function of
//! something.

use super::target::Target;
use crate::History;
use crate::diagnosis::{DepartureKind, DepartureOver};
use gumption_engine::task::Row;
use gumption_inference::setup::Setup;
use gumption_inference::shape::{Shape, Values};

/// What a function is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Argument {
    Nothing,
    Condition(usize),
    Value,
}

impl Argument {
    /// What of the order of the rows it is.
    pub(super) fn history(self, setup: &Setup<'_>) -> Option<History> {
        match self {
            Self::Condition(c) => setup.case.history_of(c),
            Self::Nothing | Self::Value => None,
        }
    }

    pub(super) fn over(self, setup: &Setup<'_>) -> DepartureOver {
        match self {
            Self::Nothing => DepartureOver::Nothing,
            Self::Condition(c) => {
                DepartureOver::Condition(setup.case.model.conditions[c].name.clone())
            }
            Self::Value => DepartureOver::Value,
        }
    }
}

/// The conditions that vary and whose numbers have a zero of their own or are counted in degrees
/// Celsius, with their values by point.
pub(super) fn conditions(setup: &Setup<'_>) -> Vec<(Argument, Values)> {
    let case = setup.case;
    (0..case.described())
        .filter(|&c| !case.model.conditions[c].unit.has_reference())
        .filter_map(|c| {
            let rows = setup.data.points.iter().map(|point| {
                let first = point.rows.first().copied().unwrap_or(0);
                setup.row(first).conditions[c]
            });
            Some((Argument::Condition(c), Values::new(rows.collect())?))
        })
        .collect()
}

/// A term with its parameters.
#[derive(Clone, Debug)]
pub(super) struct DepartureTerm {
    pub(super) target: Target,
    pub(super) kind: DepartureKind,
    pub(super) argument: Argument,
    pub(super) shape: Shape,
    /// Shares of the parameters' ranges, and their standard deviations.
    pub(super) shares: Vec<f64>,
    pub(super) widths: Vec<f64>,
}

impl DepartureTerm {
    /// The functions in rows, of which `values` are the target's own values there.
    pub(super) fn functions(
        &self,
        rows: &[Row],
        values: Option<&[f64]>,
        shares: &[f64],
    ) -> Vec<Vec<f64>> {
        let at: Vec<f64> = match self.argument {
            Argument::Nothing => vec![0.0; rows.len()],
            Argument::Condition(c) => rows.iter().map(|row| row.conditions[c]).collect(),
            Argument::Value => values.map_or_else(|| vec![f64::NAN; rows.len()], <[f64]>::to_vec),
        };
        self.shape.columns(&at, &self.shape.parameters(shares))
    }

    /// What each of its functions, multiplied by those of the `others`, does in rows: by value.
    pub(super) fn columns(
        &self,
        setup: &Setup<'_>,
        rows: &[Row],
        nominal: &[Vec<f64>],
        shares: &[f64],
        others: &[(&Self, &[f64])],
    ) -> Vec<Vec<f64>> {
        let response = self.target.response(setup, rows, nominal);
        let mut functions = self.functions(rows, response.value.as_deref(), shares);
        for (other, shares) in others {
            let factors = other.functions(rows, response.value.as_deref(), shares);
            for (own, factor) in functions.iter_mut().flatten().zip(factors.iter().flatten()) {
                *own *= factor;
            }
        }
        let outputs = setup.data.outputs.len();
        let of = |function: &Vec<f64>| {
            let own = response.of(self.kind).iter().enumerate();
            own.map(|(value, s)| if *s == 0.0 { 0.0 } else { s * function[value / outputs] })
                .collect()
        };
        functions.iter().map(of).collect()
    }
}
