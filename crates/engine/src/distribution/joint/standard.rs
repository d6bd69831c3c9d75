//! What a fit of a joint draw depends on: the shape of a quantity, without its location and width
//! where many rows of a sweep share it.

use std::sync::Arc;

use super::super::{Distribution, Rectangular, StudentT};

/// The shape that a quantity is a multiple of.
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

    /// A quantity of that shape; `None` for those that have no table of their own.
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

    /// Where a drawn value of a quantity of that shape lies: the quantity is the first of these
    /// plus the second times what is drawn.
    pub(super) fn placed(&self, distribution: &Distribution) -> [f64; 2] {
        match (self, distribution) {
            (Self::Own(_), _) => [0.0, 1.0],
            (_, Distribution::Rectangular(shape)) => [distribution.mean(), shape.half_width()],
            _ => plain(distribution),
        }
    }
}

/// Mean and scale of a quantity that is a multiple of a standard normal one or of a standard t.
pub(super) fn plain(distribution: &Distribution) -> [f64; 2] {
    let scale = match distribution {
        Distribution::Readings(readings) => readings.drawn_scale(),
        other => other.standard_uncertainty(),
    };
    [distribution.mean(), scale]
}
