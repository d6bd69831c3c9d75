//! What was true or said, as pages order and name it.

use super::super::words::hypothesis;
use gumption_gap::check::BlindDraw;

/// A truth or a verdict; no gap comes first, what is unexplained last.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Label {
    /// No gap.
    None,
    /// One effect.
    One(String),
    /// Several effects, in order.
    Several(Vec<String>),
    /// All that are several effects, taken together.
    Together,
    /// An effect that was taken out of the list, or the verdict that none of the list explains the gap.
    Unexplained,
}

impl Label {
    /// The truth of a draw, without an effect that was taken out of the list.
    pub(super) fn truth(checked: &BlindDraw) -> Self {
        let listed = |name: &&String| checked.withheld.as_ref() != Some(*name);
        let listed: Vec<String> = checked.effects.iter().filter(listed).cloned().collect();
        if checked.withheld.is_some() && listed.is_empty() {
            return Self::Unexplained;
        }
        Self::of(&listed)
    }

    /// The verdict on a draw.
    pub(super) fn said(checked: &BlindDraw) -> Self {
        if checked.named.is_empty() && checked.said == "unexplained" {
            return Self::Unexplained;
        }
        Self::of(&checked.named)
    }

    fn of(effects: &[String]) -> Self {
        match effects {
            [] => Self::None,
            [one] => Self::One(one.clone()),
            several => {
                let mut sorted = several.to_vec();
                sorted.sort();
                Self::Several(sorted)
            }
        }
    }

    /// The same with several effects taken together.
    pub(super) fn together(self) -> Self {
        if matches!(self, Self::Several(_)) { Self::Together } else { self }
    }

    /// What it is called on a page.
    pub(super) fn name(&self) -> String {
        match self {
            Self::None => hypothesis(Some(&[])),
            Self::One(effect) => hypothesis(Some(std::slice::from_ref(effect))),
            Self::Several(effects) => hypothesis(Some(effects)),
            Self::Together => "two effects or more".to_owned(),
            Self::Unexplained => hypothesis(None),
        }
    }
}
