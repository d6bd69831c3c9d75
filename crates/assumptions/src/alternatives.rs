//! Other distributions that could have been assumed instead of a Type B distribution.

use gumption_engine::distribution::{
    Arcsine, Distribution, Invalid, Normal, Rectangular, StudentT, Trapezoidal, Triangular,
};

/// What an alternative shares with the stated distribution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// The standard uncertainty; for a t distribution its scale.
    StandardUncertainty,
    /// The limits; for a normal or t distribution two standard deviations or scales on each side of
    /// its mean.
    Limits,
}

impl Kept {
    /// The name that answers use.
    pub fn name(self) -> &'static str {
        match self {
            Self::StandardUncertainty => "standard_uncertainty",
            Self::Limits => "limits",
        }
    }
}

/// The ratio of top to base of the alternative trapezoid.
const BETA: f64 = 0.5;

/// A reasonable shape.
#[derive(Clone, Copy, Debug, PartialEq)]
enum AlternativeShape {
    Normal,
    Rectangular,
    Triangular,
    Arcsine,
    Trapezoidal,
    T(f64),
}

impl AlternativeShape {
    /// The distribution with this standard deviation (for a t distribution: scale) and mean.
    fn with_std(self, mean: f64, std: f64) -> Result<Distribution, Invalid> {
        let half_width = match self {
            Self::Normal | Self::T(_) => 2.0 * std,
            Self::Rectangular => 3f64.sqrt() * std,
            Self::Triangular => 6f64.sqrt() * std,
            Self::Arcsine => 2f64.sqrt() * std,
            Self::Trapezoidal => (6.0 / (1.0 + BETA * BETA)).sqrt() * std,
        };
        self.with_limits(mean, half_width)
    }

    /// The distribution with limits `half_width` from their middle.
    fn with_limits(self, middle: f64, half_width: f64) -> Result<Distribution, Invalid> {
        Ok(match self {
            Self::Normal => Normal::new(middle, 0.5 * half_width)?.into(),
            Self::Rectangular => Rectangular::new(middle, half_width)?.into(),
            Self::Triangular => Triangular::new(middle, half_width)?.into(),
            Self::Arcsine => Arcsine::new(middle, half_width)?.into(),
            Self::Trapezoidal => Trapezoidal::new(middle, half_width, BETA)?.into(),
            Self::T(dof) => StudentT::new(middle, 0.5 * half_width, dof)?.into(),
        })
    }

    /// The shape of a stated distribution; `None` for a distribution that is not listed or whose
    /// width is not known exactly.
    fn of(stated: &Distribution) -> Option<Self> {
        match stated {
            Distribution::Rectangular(_)
            | Distribution::Triangular(_)
            | Distribution::Trapezoidal(_)
                if stated.drawn_as().is_some() =>
            {
                None
            }
            Distribution::Normal(_) if stated.is_drawn_normal() => Some(Self::Normal),
            Distribution::Normal(_) | Distribution::StudentT(_) => Some(Self::T(stated.dof())),
            Distribution::Rectangular(_) => Some(Self::Rectangular),
            Distribution::Triangular(_) => stated.divisor().map(|_| Self::Triangular),
            Distribution::Arcsine(_) => Some(Self::Arcsine),
            Distribution::Trapezoidal(_) => Some(Self::Trapezoidal),
            _ => None,
        }
    }
}

/// The limits that a distribution states, between which all values lie; `None` for one without
/// limits.
pub(super) fn limits(stated: &Distribution) -> Option<[f64; 2]> {
    let bounded = matches!(
        stated,
        Distribution::Rectangular(_)
            | Distribution::Triangular(_)
            | Distribution::Trapezoidal(_)
            | Distribution::CurvilinearTrapezoid(_)
            | Distribution::Arcsine(_)
            | Distribution::Beta(_)
            | Distribution::LogUniform(_)
    );
    // inexact limits are stated about the middle
    if let (Some(_), Some(divisor), true) = (stated.drawn_as(), stated.divisor(), bounded) {
        let half_width = divisor * stated.standard_uncertainty();
        return Some([stated.mean() - half_width, stated.mean() + half_width]);
    }
    // the ends of the support, to rounding
    let end = f64::MIN_POSITIVE;
    bounded.then(|| [stated.quantile(end), stated.quantile_upper(end)])
}

/// Every other reasonable shape, once with the standard uncertainty kept and once with the limits
/// kept, if there are limits. A normal distribution with degrees of freedom is drawn as a t
/// distribution, so the normal distribution is among its alternatives. Data (samples, saved
/// results) have no limits to keep.
pub(super) fn alternatives(stated: &Distribution) -> Vec<(Kept, Distribution)> {
    let own = AlternativeShape::of(stated);
    let dof = stated.dof();
    let mut shapes = vec![
        AlternativeShape::Normal,
        AlternativeShape::Rectangular,
        AlternativeShape::Triangular,
        AlternativeShape::Arcsine,
        AlternativeShape::Trapezoidal,
    ];
    if dof.is_finite() {
        shapes.push(AlternativeShape::T(dof));
    }
    shapes.retain(|shape| own != Some(*shape));
    let (mean, std) = (stated.mean(), stated.standard_uncertainty());
    let kept_limits = match own {
        Some(AlternativeShape::Normal | AlternativeShape::T(_)) => Some((mean, 2.0 * std)),
        _ => limits(stated).map(|[low, high]| (0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low)),
    };
    let mut found = Vec::new();
    for shape in shapes {
        // a width that is lost in the rounding of the estimate has no alternatives
        if let Ok(other) = shape.with_std(mean, std) {
            found.push((Kept::StandardUncertainty, other));
        }
        if let Some(Ok(other)) = kept_limits.map(|(mid, half)| shape.with_limits(mid, half)) {
            found.push((Kept::Limits, other));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use gumption_engine::distribution::Exponential;

    fn names(stated: &Distribution) -> Vec<(&'static str, Kept)> {
        alternatives(stated).iter().map(|(kept, other)| (other.name(), *kept)).collect()
    }

    /// Widths by hand: a rectangle of half-width 3 has the standard deviation sqrt(3).
    #[test]
    fn widths_follow_from_what_is_kept() {
        let stated: Distribution = Rectangular::new(10.0, 3.0).unwrap().into();
        let found = alternatives(&stated);
        assert_eq!(found.len(), 8);
        for (kept, other) in &found {
            assert!((other.mean() - 10.0).abs() < 1e-14);
            let expected = match (kept, other.name()) {
                (Kept::StandardUncertainty, _) => 3f64.sqrt(),
                (_, "normal") => 1.5,
                (_, "triangular") => 3.0 / 6f64.sqrt(),
                (_, "arcsine") => 3.0 / 2f64.sqrt(),
                (_, "trapezoidal") => 3.0 * (1.25f64 / 6.0).sqrt(),
                (_, name) => panic!("{name}"),
            };
            let got = other.standard_uncertainty();
            assert!((got - expected).abs() < 1e-14 * expected, "{} {got}", other.name());
        }
    }

    #[test]
    fn every_other_shape_and_a_t_where_there_are_degrees_of_freedom() {
        let normal: Distribution = Normal::new(0.0, 1.0).unwrap().into();
        assert!(names(&normal).iter().all(|(name, _)| !["normal", "t"].contains(name)));
        let with_dof: Distribution =
            Rectangular::new(0.0, 1.0).unwrap().with_dof(5.0).unwrap().into();
        assert!(names(&with_dof).contains(&("t", Kept::Limits)));
        let t: Distribution = StudentT::new(0.0, 1.0, 5.0).unwrap().into();
        assert!(names(&t).contains(&("normal", Kept::StandardUncertainty)));
        assert!(!names(&t).iter().any(|(name, _)| *name == "t"));
        // no limits to keep
        let exponential: Distribution = Exponential::new(2.0).unwrap().into();
        assert!(names(&exponential).iter().all(|(_, kept)| *kept == Kept::StandardUncertainty));
        assert_eq!(names(&exponential).len(), 5);
        // a triangle whose mode is not in the middle could have been a symmetric one
        let skew: Distribution = Triangular::between(0.0, 4.0, Some(1.0)).unwrap().into();
        assert!(names(&skew).contains(&("triangular", Kept::Limits)));
        let limits = limits(&skew).unwrap();
        assert!(limits[0].abs() < 1e-12 && (limits[1] - 4.0).abs() < 1e-12);
    }
}
