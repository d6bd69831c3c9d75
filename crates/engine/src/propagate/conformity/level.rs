//! Statements of conformity with more than two levels.

use crate::model::{Output, Tolerance};

/// A non-binary statement of conformity with a guard band (ILAC-G8:09/2019, 4.2.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConformityLevel {
    /// Within the acceptance limits.
    Pass,
    /// Within the tolerance, by less than the guard band.
    ConditionalPass,
    /// Outside the tolerance, by at most the guard band.
    ConditionalFail,
    /// Outside the tolerance by more than the guard band.
    Fail,
}

impl ConformityLevel {
    /// The levels, best first.
    pub const ALL: [Self; 4] =
        [Self::Pass, Self::ConditionalPass, Self::ConditionalFail, Self::Fail];

    /// The level of an estimate between limits, with a guard band of this width on either side of each;
    /// `None` where the rule of the output is binary or there is no guard band.
    pub(super) fn of(
        output: &Output,
        limits: [f64; 2],
        guard_band: Option<f64>,
        estimate: f64,
    ) -> Option<Self> {
        let width = guard_band.filter(|_| output.non_binary)?;
        let tolerance = Tolerance::between(limits);
        let within = |width: f64| tolerance.narrowed(width).is_some_and(|to| to.holds(estimate));
        Some(match [width, 0.0, -width].map(within) {
            [true, ..] => Self::Pass,
            [_, true, _] => Self::ConditionalPass,
            [.., true] => Self::ConditionalFail,
            _ => Self::Fail,
        })
    }

    /// Whether it states that the value conforms.
    pub fn is_pass(self) -> bool {
        matches!(self, Self::Pass | Self::ConditionalPass)
    }

    /// Its name in ILAC-G8.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::ConditionalPass => "conditional pass",
            Self::ConditionalFail => "conditional fail",
            Self::Fail => "fail",
        }
    }
}
