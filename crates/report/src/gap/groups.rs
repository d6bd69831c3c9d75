//! Rows of the data told apart by a second condition, or by what came before.

use super::{digits, residuals, words};
use crate::plot::Groups;
use gumption_gap::Diagnosis;

/// The groups for figures over a condition, or over the number of the row.
pub(super) fn groups(diagnosis: &Diagnosis, over: residuals::Over) -> Groups {
    let others = residuals::varying(diagnosis).into_iter();
    let others = others.filter(|&other| over != residuals::Over::Condition(other));
    let levels = |condition: usize| residuals::levels(diagnosis, condition);
    // the one with the fewest levels, of equals the first; what came before where there is none
    let fewest = others.min_by_key(|&other| levels(other).len());
    let history = || diagnosis.history.clone().min_by_key(|&other| levels(other).len());
    let Some(condition) = fewest.or_else(history) else {
        return Groups::default();
    };
    let named = &diagnosis.conditions[condition];
    let name = crate::plain(&named.name);
    Groups::of_levels(condition, &levels(condition), |low, high| {
        let last = words::in_unit(&digits::condition(high), named);
        match low == high {
            true => format!("{name} = {last}"),
            false => format!("{name} {} to {last}", digits::condition(low)),
        }
    })
}

/// The sentences for all panels of a figure.
pub(super) fn captions<'g>(
    diagnosis: &Diagnosis,
    panels: impl Iterator<Item = (residuals::Over, &'g Groups)>,
) -> String {
    let caption = |(over, groups): (residuals::Over, &Groups)| match over {
        residuals::Over::Condition(place) => {
            groups.caption(&crate::plain(&diagnosis.conditions[place].name))
        }
        residuals::Over::Row => groups.caption(&over.in_sentence(diagnosis)),
    };
    panels.map(caption).collect()
}
