//! Conditions that follow from the order in which the rows of the data were taken: whether a condition
//! last rose or fell, what it was before, when it last changed.
//!
//! They are there where they can matter and be told from the conditions themselves. In a single sweep
//! all of them are functions of what is swept, and none is there. Where the file does not say what the
//! order is, that of the rows is taken for it, unless they are sorted by something that was measured.

use std::collections::HashMap;
use std::ops::Range;

use super::conditions::Conditions;
use super::observations::Observations;
use gumption_engine::linalg::dot;
use gumption_engine::model::Quantity;
use gumption_engine::model::formula::is_name;
use gumption_engine::number::{ascending, smallest_first};
use gumption_gap::{History, HistoryKind};
use gumption_text::json::Json;
use gumption_text::object::Object;
use gumption_text::table::Table;
use gumption_text::{DiagnosticKind, column_heading};
use gumption_units::Unit;

/// Fewer rows have no history that can be told from chance; of more, a search over it takes too long.
const ROWS: Range<usize> = 10..20_001;

/// Conditions with a history, at most.
const MOST_CONDITIONS: usize = 3;

/// So much of a condition's variance must be apart from functions of the measured conditions.
const APART: f64 = 0.25;

/// Parts of a condition's values, at most, that each may have a value of its own in these functions.
const MOST_PARTS: usize = 12;

/// One that follows from another but for this share of its variance is the same.
const SAME: f64 = 0.05;

/// Each direction has this share of the rows at least.
const EACH_DIRECTION: f64 = 0.2;

/// A change by less than this share of the range of a condition is none: settings are read with noise.
const CHANGE: f64 = 0.01;

/// Rows as they were taken.
struct Series<'r> {
    rows: &'r [Vec<f64>],
    /// The rows in the order in which they were taken.
    order: Vec<usize>,
    /// For each row when it was taken.
    times: Vec<f64>,
}

impl<'r> Series<'r> {
    /// In the order of a column's values; without one, in their own.
    fn new(rows: &'r [Vec<f64>], column: Option<Vec<f64>>) -> Self {
        let mut order: Vec<usize> = (0..rows.len()).collect();
        let times = match column {
            Some(values) => {
                smallest_first(&mut order, |&row| values[row]);
                values
            }
            None => (1..=rows.len()).map(|number| number as f64).collect(),
        };
        Self { rows, order, times }
    }

    fn condition(&self, condition: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row.get(condition).copied().unwrap_or(f64::NAN)).collect()
    }

    /// The values of a condition that follows from the order, by row.
    fn values(&self, history: History) -> Vec<f64> {
        match history.of {
            Some(condition) => self.of_condition(history.kind, &self.condition(condition)),
            None if history.kind == HistoryKind::Repetition => {
                let mut seen: HashMap<Vec<u64>, f64> = HashMap::new();
                let mut values = vec![0.0; self.rows.len()];
                let mut last: Option<Vec<u64>> = None;
                for &row in &self.order {
                    let key: Vec<u64> =
                        self.rows[row].iter().map(|value| value.to_bits()).collect();
                    let count = seen.entry(key.clone()).or_insert(0.0);
                    *count += f64::from(u8::from(last.as_ref() != Some(&key)));
                    values[row] = *count;
                    last = Some(key);
                }
                values
            }
            None => self.times.clone(),
        }
    }

    fn of_condition(&self, kind: HistoryKind, of: &[f64]) -> Vec<f64> {
        let Some(&first) = self.order.first() else { return Vec::new() };
        let (low, high) = ends(of);
        // the value at the last change, the farthest one since the condition turned round
        let (mut held, mut farthest, mut extreme) = (of[first], of[first], of[first]);
        let (mut direction, mut before, mut changed) = (0.0, of[first], self.times[first]);
        let mut values = vec![0.0; of.len()];
        for &row in &self.order {
            let value = of[row];
            if (value - held).abs() > CHANGE * (high - low) {
                let now = (value - held).signum();
                if now != direction {
                    extreme = farthest;
                    farthest = value;
                }
                (direction, held, changed) = (now, value, self.times[row]);
            }
            if direction * (value - farthest) > 0.0 {
                farthest = value;
            }
            values[row] = match kind {
                HistoryKind::Direction => direction,
                HistoryKind::Previous => before,
                HistoryKind::Extreme => extreme,
                _ => self.times[row] - changed,
            };
            before = value;
        }
        values
    }

    /// Whether values rise from row to row all the time.
    fn is_clock(&self, values: &[f64]) -> bool {
        self.order.windows(2).all(|pair| values[pair[0]] < values[pair[1]])
    }

    /// Whether a condition does.
    fn has_clock(&self, conditions: usize) -> bool {
        (0..conditions).any(|condition| self.is_clock(&self.condition(condition)))
    }

    /// For each condition that does not rise from row to row all the time the part of its values that
    /// each row is in.
    fn parts(&self, conditions: usize) -> Vec<Vec<usize>> {
        let most = (self.rows.len() / (2 * conditions.max(1))).clamp(2, MOST_PARTS);
        let of = |condition: usize| {
            let values = self.condition(condition);
            let mut levels = values.clone();
            ascending(&mut levels);
            levels.dedup();
            if self.is_clock(&values) {
                return None;
            }
            let count = levels.len().min(most);
            let part =
                |value: &f64| levels.partition_point(|level| level < value) * count / levels.len();
            Some(values.iter().map(part).collect())
        };
        (0..conditions).filter_map(of).collect()
    }
}

fn ends(values: &[f64]) -> (f64, f64) {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    values.iter().fold(ends, |(low, high), &value| (low.min(value), high.max(value)))
}

/// Values less their mean.
fn centred(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|value| value - mean).collect()
}

/// What of centred values no sum of functions of the parts makes: the means of the parts of each
/// condition are taken off in turn.
fn apart(mut values: Vec<f64>, parts: &[Vec<usize>]) -> Vec<f64> {
    const ROUNDS: usize = 20;
    for _ in 0..ROUNDS {
        for part_of in parts {
            let mut sums = [(0.0, 0.0); MOST_PARTS];
            for (value, &part) in values.iter().zip(part_of) {
                sums[part].0 += value;
                sums[part].1 += 1.0;
            }
            for (value, &part) in values.iter_mut().zip(part_of) {
                *value -= sums[part].0 / sums[part].1;
            }
        }
    }
    values
}

/// Which columns may tell what: those of the conditions, and of what was measured.
struct HistoryColumns<'k> {
    /// Places of the conditions that may have a history.
    conditions: Vec<usize>,
    /// How many conditions there are.
    all: usize,
    /// What was measured.
    measured: Vec<&'k [f64]>,
    /// Whether the file says what the order is.
    is_stated: bool,
    /// Whether a condition says it.
    is_condition: bool,
}

impl HistoryColumns<'_> {
    /// What of the order of the rows can matter.
    fn matter(&self, series: &Series<'_>) -> Vec<History> {
        let rows = series.rows.len();
        let is_sorted_by =
            |values: &&[f64]| values.is_sorted() || values.is_sorted_by(|a, b| a >= b);
        if !ROWS.contains(&rows) || !self.is_stated && self.measured.iter().any(is_sorted_by) {
            return Vec::new();
        }
        let mut telling = Telling { parts: series.parts(self.all), known: Vec::new() };
        let mut found = Vec::new();
        let mut with_history = 0;
        for &condition in &self.conditions {
            let of = |kind| History { kind, of: Some(condition) };
            let direction = of(HistoryKind::Direction);
            let turns = goes_both_ways(&series.values(direction))
                && telling.adds(&series.values(direction));
            // rows that are sorted by a condition say nothing of what came before
            if !turns && !self.is_stated {
                continue;
            }
            let before = found.len();
            found.extend(turns.then_some(direction));
            let others = [HistoryKind::Previous, HistoryKind::Extreme, HistoryKind::Since];
            let others = others.map(of).into_iter();
            found.extend(others.filter(|history| telling.adds(&series.values(*history))));
            with_history += usize::from(found.len() > before);
            if with_history == MOST_CONDITIONS {
                break;
            }
        }
        // a repetition that goes on with the rows is called by their order
        let order = (!self.is_condition).then_some(HistoryKind::Order);
        let others = order.into_iter().chain([HistoryKind::Repetition]);
        let others = others.map(|kind| History { kind, of: None });
        found.extend(others.filter(|history| telling.adds(&series.values(*history))));
        found
    }
}

/// Whether each direction is that of enough rows.
fn goes_both_ways(directions: &[f64]) -> bool {
    let share = |sign: f64| {
        let count = directions.iter().filter(|direction| **direction == sign).count();
        count as f64 / directions.len() as f64
    };
    share(1.0) >= EACH_DIRECTION && share(-1.0) >= EACH_DIRECTION
}

/// What values must be apart from to tell something new.
struct Telling {
    parts: Vec<Vec<usize>>,
    known: Vec<Vec<f64>>,
}

impl Telling {
    /// Takes values to those that are known, if they tell something new.
    fn adds(&mut self, values: &[f64]) -> bool {
        let values = centred(values);
        let whole = dot(&values, &values);
        let values = apart(values, &self.parts);
        let own = dot(&values, &values);
        let same = |other: &Vec<f64>| {
            let both = dot(&values, other);
            both * both > (1.0 - SAME) * own * dot(other, other)
        };
        let is_new = whole > 0.0 && own >= APART * whole && !self.known.iter().any(same);
        if is_new {
            self.known.push(values);
        }
        is_new
    }
}

/// Adds the conditions that follow from the order of the rows: those that the data give, with their
/// values in the rows of the data or, in their place, of a table to predict `at`, whose first row
/// begins a series of its own.
pub(super) fn add(
    root: &Object<'_>,
    observations: &Observations,
    at: Option<&Table>,
    conditions: &mut Conditions,
) {
    let named = observations.order.as_ref();
    let own = |name: &str| conditions.quantities.iter().position(|quantity| quantity.name == name);
    let bare = named.map(|named| column_heading::bare(&named.name));
    let own_clock = bare.and_then(own);
    let column = |table: &Table| -> Option<Vec<f64>> {
        let place = table.column(&named?.name)?;
        Some(table.rows.iter().map(|row| row.get(place).copied().unwrap_or(f64::NAN)).collect())
    };
    let data = &observations.table;
    let places: Vec<Option<usize>> =
        conditions.quantities.iter().map(|quantity| data.column(&quantity.name)).collect();
    let of_row = |row: &Vec<f64>| {
        let value = |place: &Option<usize>| place.and_then(|place| row.get(place)).copied();
        places.iter().map(|place| value(place).unwrap_or(f64::NAN)).collect()
    };
    let rows: Vec<Vec<f64>> = data.rows.iter().map(of_row).collect();
    let series = Series::new(&rows, column(data));
    let replication = observations.replication.as_ref().map(|(name, _)| name.as_str());
    let count = conditions.quantities.len();
    let is_set = |place: &usize| Some(conditions.quantities[*place].name.as_str()) != replication;
    let known = HistoryColumns {
        conditions: (0..count).filter(is_set).collect(),
        all: count,
        measured: observations
            .columns
            .iter()
            .map(|column| column.observed.values.as_slice())
            .collect(),
        is_stated: named.is_some(),
        is_condition: own_clock.is_some() || series.has_clock(count),
    };
    let found = known.matter(&series);
    let of_time = [HistoryKind::Since, HistoryKind::Order];
    if let (Some(at), Some(of)) = (at, named.filter(|named| named.is_time))
        && at.column(&of.name).is_none()
        && found.iter().any(|history| of_time.contains(&history.kind))
    {
        let reason = format!("to predict at, {}", at.no_column(&of.name));
        root.log.report(&of.place, DiagnosticKind::Table { reason });
    }
    let there = conditions.rows.clone();
    let series = match at {
        None => series,
        Some(at) => Series::new(&there, column(at)),
    };
    let taken = |name: &str| own(name).is_some() || is_quantity(root, name);
    let heading = named.and_then(|named| {
        let place = data.column(&named.name)?;
        column_heading::heading(root.log, data.columns.get(place)?)
    });
    let clock = match (own_clock, &heading) {
        (Some(place), _) => conditions.quantities[place].unit.clone(),
        (None, Some((_, unit))) => unit.clone(),
        (None, None) => Unit::one(),
    };
    let place = named.map_or(0..0, |named| named.place.clone());
    let mut added: Vec<(History, Quantity)> = Vec::new();
    for history in found {
        let of_condition = history.of.map(|condition| &conditions.quantities[condition]);
        let of_clock = |(name, _): &(&str, Unit)| is_name(name) && !taken(name);
        let name = match (history.kind, &heading) {
            (HistoryKind::Order, Some(heading)) if of_clock(heading) => heading.0.to_owned(),
            _ => history.kind.name(of_condition.map_or("", |condition| condition.name.as_str())),
        };
        if taken(&name) {
            continue;
        }
        let unit = match (history.kind, of_condition) {
            (HistoryKind::Previous | HistoryKind::Extreme, Some(of_condition)) => {
                of_condition.unit.clone()
            }
            (HistoryKind::Since | HistoryKind::Order, _) => clock.clone(),
            _ => Unit::one(),
        };
        added.push((history, Quantity { name, unit, about: String::new() }));
    }
    conditions.clock = own_clock;
    for (history, quantity) in added {
        if history.kind == HistoryKind::Order {
            conditions.clock = Some(conditions.quantities.len());
        }
        conditions.quantities.push(quantity);
        conditions.places.push(place.clone());
        conditions.reachable.push(None);
        conditions.history.push(history);
        for (row, value) in conditions.rows.iter_mut().zip(series.values(history)) {
            row.push(value);
        }
    }
    conditions.measured = count;
}

/// Whether a quantity of the file has this name.
fn is_quantity(root: &Object<'_>, name: &str) -> bool {
    ["inputs", "equations", "outputs", "fits"].into_iter().any(|key| {
        let members = root.get(key).map(|member| &member.value.value);
        matches!(members, Some(Json::Object(members)) if members.iter().any(|member| member.key == name))
    })
}

#[cfg(test)]
mod tests;
