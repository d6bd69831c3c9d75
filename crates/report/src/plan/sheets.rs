//! The tables of a plan.

use super::PlanReport;
use crate::number::{MISSING, significant, to};
use crate::plain;
use crate::sheet::Sheet;
use gumption_analysis::plan::{CheapestPlan, InputNeed, PlannedInput};
use gumption_engine::decimal::to_position;

/// Significant digits of standard uncertainties: one more than pages have elsewhere, because the
/// answer is a limit.
pub(super) const DIGITS: u32 = 3;

/// An upper limit, rounded down: the rounded limit is safe.
pub(super) fn at_most(value: f64) -> String {
    let position = crate::number::position(value, DIGITS);
    let Some(place) = position else { return to(value, position) };
    let unit = libm::pow(10.0, f64::from(place));
    let rounded = to_position(value, place);
    let below = if rounded > value { to_position(value - 0.5 * unit, place) } else { rounded };
    to(below, Some(place))
}

/// The required uncertainty of every input alone.
pub(super) fn inputs(report: &PlanReport<'_>) -> Sheet {
    let needs = &report.plan.inputs;
    let mut sheet = Sheet::default();
    sheet.text("quantity", needs.iter().map(|need| plain(report.name(need.variable))));
    sheet.numbers("u now", needs.iter().map(|need| significant(need.standard_uncertainty, DIGITS)));
    let missing = || MISSING.to_owned();
    sheet.numbers("u needed", needs.iter().map(|need| need.needed.map_or_else(missing, at_most)));
    sheet.units("unit", needs.iter().map(|need| plain(report.unit(need.variable))));
    let share = |need: &InputNeed| {
        let share = need.needed.map(|needed| 100.0 * needed / need.standard_uncertainty);
        share.filter(|share| share.is_finite()).map_or_else(missing, at_most)
    };
    sheet.numbers("of u now\nin %", needs.iter().map(share));
    if needs.iter().any(|need| need.readings.is_some()) {
        let count = |value: Option<u64>| value.map_or_else(missing, |value| value.to_string());
        sheet.numbers("readings\nnow", needs.iter().map(|need| count(need.readings)));
        sheet.numbers("readings\nneeded", needs.iter().map(|need| count(need.readings_needed)));
    }
    let why = |need: &InputNeed| match (need.fixed, need.needed) {
        (Some(why), _) => why.to_owned(),
        (None, None) if need.readings_needed.is_none() => "not sufficient alone".to_owned(),
        _ => String::new(),
    };
    sheet.text("", needs.iter().map(why));
    sheet
}

/// A cost that can be added up: in whole units of the currency from 100 on.
fn cost(of: f64) -> String {
    match of.abs() {
        0.0 => "0".to_owned(),
        large if large >= 100.0 => to(of, Some(0)),
        _ => significant(of, DIGITS),
    }
}

/// The cheapest combination.
pub(super) fn cheapest(report: &PlanReport<'_>, plan: &CheapestPlan) -> Sheet {
    let inputs = &plan.inputs;
    let currency = plain(report.costs.currency());
    let mut sheet = Sheet { footer: true, ..Sheet::default() };
    let with = |cells: Vec<String>, last: &str| cells.into_iter().chain([last.to_owned()]);
    let names = inputs.iter().map(|of| plain(report.name(of.variable))).collect();
    sheet.text("quantity", with(names, "all"));
    let from = inputs.iter().map(|of| significant(of.from, DIGITS)).collect();
    sheet.numbers("u now", with(from, ""));
    let planned = |of: &PlannedInput| {
        if of.to == of.from { significant(of.to, DIGITS) } else { at_most(of.to) }
    };
    sheet.numbers("u planned", with(inputs.iter().map(planned).collect(), ""));
    let units = inputs.iter().map(|of| plain(report.unit(of.variable))).collect();
    sheet.units("unit", with(units, ""));
    let how = |of: &PlannedInput| match (of.readings, &of.offer) {
        _ if of.to == of.from => "unchanged".to_owned(),
        (Some(count), _) => format!("{count} readings"),
        (None, Some(offer)) if !offer.trim().is_empty() => plain(offer),
        _ => String::new(),
    };
    sheet.text("how", with(inputs.iter().map(how).collect(), ""));
    let header =
        if currency.is_empty() { "cost".to_owned() } else { format!("cost\nin {currency}") };
    let costs = inputs.iter().map(|of| cost(of.cost)).collect();
    sheet.numbers(&header, with(costs, &cost(plan.cost)));
    sheet
}

#[cfg(test)]
mod tests {
    use super::cost;

    /// 1500 and 104 make 1604, not 1600.
    #[test]
    fn costs_add_up() {
        assert_eq!(
            [1500.0, 104.0, 1604.0, 99.5, 0.125].map(cost),
            ["1500", "104", "1604", "99.5", "0.125"]
        );
    }
}
