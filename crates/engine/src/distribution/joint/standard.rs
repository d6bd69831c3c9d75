//! The parameters of a fit of a joint draw: the shape of a quantity, without its location and width
//! if many rows of a sweep share it.

use std::sync::Arc;

use super::super::{Distribution, Rectangular, StudentT};

/// The shape of which a quantity is a multiple.
#[derive(Clone, Debug)]
pub(super) enum Standard {
    /// Known exactly.
    Constant,
    Normal,
    Rectangular,
    /// A t distribution of these degrees of freedom.
    T(f64),
    /// Itself.
    Own(Arc<Distribution>),
}

impl PartialEq for Standard {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant, Self::Constant)
            | (Self::Normal, Self::Normal)
            | (Self::Rectangular, Self::Rectangular) => true,
            (Self::T(a), Self::T(b)) => a == b,
            // most are the same one
            (Self::Own(a), Self::Own(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => false,
        }
    }
}

impl Standard {
    pub(super) fn of(distribution: &Arc<Distribution>) -> Self {
        let dof = distribution.drawn_dof();
        match &**distribution {
            Distribution::Constant(_) => Self::Constant,
            Distribution::Rectangular(shape) if shape.inexact().is_none() => Self::Rectangular,
            Distribution::Readings(readings) if readings.together() > 1 => {
                Self::Own(Arc::clone(distribution))
            }
            // drawn with the other parameters of its fit
            Distribution::Fitted(_) => Self::Own(Arc::clone(distribution)),
            other if other.is_drawn_normal() => Self::Normal,
            other if dof.is_finite() && other.saved().is_none() => Self::T(dof),
            _ => Self::Own(Arc::clone(distribution)),
        }
    }

    /// A quantity of that shape; `None` for shapes without a table.
    pub(super) fn distribution(&self) -> Option<Arc<Distribution>> {
        match self {
            Self::Constant | Self::Normal => None,
            Self::Rectangular => {
                Rectangular::new(0.0, 1.0).ok().map(|shape| Arc::new(shape.into()))
            }
            Self::T(dof) => StudentT::new(0.0, 1.0, *dof).ok().map(|shape| Arc::new(shape.into())),
            Self::Own(distribution) => Some(Arc::clone(distribution)),
        }
    }

    /// Location and scale for drawn values of a quantity of that shape: the quantity is the first
    /// plus the second times the drawn value.
    pub(super) fn placed(&self, distribution: &Distribution) -> [f64; 2] {
        match (self, distribution) {
            (Self::Own(_), _) => [0.0, 1.0],
            (_, Distribution::Rectangular(shape)) => [distribution.mean(), shape.half_width()],
            _ => plain(distribution),
        }
    }
}

/// Mean and scale of a quantity that is a multiple of a standard normal or standard t quantity.
pub(super) fn plain(distribution: &Distribution) -> [f64; 2] {
    let scale = match distribution {
        Distribution::Readings(readings) => readings.drawn_scale(),
        other => other.standard_uncertainty(),
    };
    [distribution.mean(), scale]
}
