//! Effects that depend on what came before: entries for the conditions whose history a sim knows.
//!
//! In such an entry `{condition}` stands for a condition, `{direction}` for the direction of its last
//! change, and numbers from 0 to 1 for where it is in the range of the data (`{share}`), what it was in
//! the row before (`{previous}`, of the largest modulus), how long it has not changed (`{since}`, of the
//! longest time) and when the row was taken (`{passed}`, from the first row to the last).

use super::super::effect_context::EffectContext;
use super::fit::written;
use super::{Catalogue, Entry};
use gumption_engine::model::NumberForm;
use gumption_gap::HistoryKind;
use gumption_text::json::Member;

impl Catalogue {
    /// The catalogue for a sim: an entry that depends on what came before once for each condition whose
    /// history has what it needs, with the condition in its name where there are several.
    pub(super) fn with_history(mut self, sim: &EffectContext<'_>) -> Self {
        self.entries = self.entries.iter().flat_map(|entry| of_sim(entry, sim)).collect();
        self
    }
}

fn of_sim(entry: &Entry, sim: &EffectContext<'_>) -> Vec<Entry> {
    let texts: Vec<String> = entry.overrides().map(|(_, formula)| formula).collect();
    let needs = |placeholder: &str| texts.iter().any(|text| text.contains(placeholder));
    if needs("{passed}") {
        let passed = sim.clock.and_then(|clock| range(sim, clock, &sim.sim.conditions[clock].name));
        let passed = passed.map(|passed| with(entry, &entry.name, &[("{passed}", passed)]));
        return passed.into_iter().collect();
    }
    let kinds = [
        ("{direction}", HistoryKind::Direction),
        ("{previous}", HistoryKind::Previous),
        ("{since}", HistoryKind::Since),
    ];
    let Some((placeholder, kind)) = kinds.into_iter().find(|(text, _)| needs(text)) else {
        return vec![entry.clone()];
    };
    let of_kind = sim.history.iter().filter(|(_, history)| history.kind == kind);
    let found: Vec<(usize, usize)> =
        of_kind.filter_map(|(place, history)| Some((*place, history.of?))).collect();
    let several = found.len() > 1;
    let of_condition = |(place, of): (usize, usize)| {
        let condition = &sim.sim.conditions[of].name;
        let own = &sim.sim.conditions[place].name;
        let value = match kind {
            HistoryKind::Direction => own.clone(),
            _ => part(sim, place, own, |values| (0.0, largest(values)))?,
        };
        let name = match several {
            true => format!("{} of {condition}", entry.name),
            false => entry.name.clone(),
        };
        let mut texts = vec![(placeholder, value), ("{condition}", condition.clone())];
        if needs("{share}") {
            texts.push(("{share}", range(sim, of, condition)?));
        }
        Some(with(entry, &name, &texts))
    };
    found.into_iter().filter_map(of_condition).collect()
}

/// The entry under a name, with texts in place of others.
fn with(entry: &Entry, name: &str, texts: &[(&str, String)]) -> Entry {
    let text = |words: &str| {
        texts.iter().fold(words.to_owned(), |text, (from, to)| text.replace(from, to))
    };
    let members: Vec<Member> = entry.members.iter().map(|member| written(member, &text)).collect();
    Entry { name: name.to_owned(), members, ..entry.clone() }
}

/// Where a condition is within the range of the data, from 0 to 1, as a formula.
fn range(sim: &EffectContext<'_>, place: usize, name: &str) -> Option<String> {
    part(sim, place, name, |values| {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        (low, values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low)
    })
}

/// A condition from some value on, as a share of another one, which `of` gives for the data.
fn part(
    sim: &EffectContext<'_>,
    place: usize,
    name: &str,
    of: impl Fn(&[f64]) -> (f64, f64),
) -> Option<String> {
    let unit = &sim.sim.conditions.get(place)?.unit;
    let rows = sim.task.rows.iter();
    let values: Vec<f64> = rows.filter_map(|row| row.conditions.get(place).copied()).collect();
    let (low, whole) = of(&values);
    if unit.has_reference() || !(whole > 0.0 && whole.is_finite()) {
        return None;
    }
    let number = match sim.sim.numbers {
        NumberForm::Coherent if unit.dimension().is_none() && unit.factor() == 1.0 => name.into(),
        NumberForm::Coherent => format!("{name}/[{}]", unit.text()),
        NumberForm::Declared => name.to_owned(),
    };
    Some(match low == 0.0 {
        true => format!("({number}/{whole:?})"),
        false => format!("(({number} - {low:?})/{whole:?})"),
    })
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}
