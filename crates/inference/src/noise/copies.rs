//! Rows that repeat others to all digits.
//!
//! Every row counts with noise of its own. Rows of which conditions, values and uncertainties repeat
//! exactly have none: two independent readings with the standard uncertainty u, read to the digit d,
//! are the same with the probability d/(2 sqrt(pi) u) at most, the density of their difference (normal,
//! of standard deviation sqrt(2) u) at zero times d. Where so many rows repeat that chance does not do
//! it, they were copied, or their uncertainty is one that they share; either way they tell what one row
//! tells, and count as one. Where chance may do it (a coarse digit, few rows), and where no uncertainty
//! is stated, they stay.

use std::collections::HashMap;
use std::f64::consts::PI;

use crate::Case;
use gumption_engine::decimal::Decimal;
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::number::{ascending, elementary};

/// Repeated rows count once where chance makes so many of them with less than this probability.
const NO_CHANCE: f64 = 1e-6;

/// They are told where it makes them with less than this.
const HARDLY_CHANCE: f64 = 0.01;

/// A value with up to so many digits fewer than others of its output ends in zeros by chance.
const CHANCE_ZEROS: i32 = 2;

/// Two readings of so many digits are hardly ever the same, whatever their uncertainty.
const TELLING_DIGITS: i32 = 5;

/// Without uncertainties, and with fewer digits, so many repeated rows are told where no other rows
/// share their conditions.
const TELLING_ROWS: usize = 3;

/// Rows that repeat others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Copies {
    /// Rows of the case, the first of its kind and the one that repeats it, by the latter.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// The probability of so many by chance, or a bound above it; `None` where no uncertainty is
    /// stated.
    pub chance: Option<f64>,
    /// Whether they are worth telling.
    pub told: bool,
}

impl Copies {
    /// The repeated rows of a case.
    pub fn of(case: &Case) -> Self {
        let rows = case.task.rows.len();
        let observed: Vec<_> = case.observed.iter().flatten().collect();
        let mut known: HashMap<Vec<u64>, usize> = HashMap::with_capacity(rows);
        let mut pairs = Vec::new();
        for row in 0..rows {
            let of_output = |output: &&crate::ObservedOutput| {
                let u = output.standard_uncertainties.as_ref().map_or(0.0, |u| u[row]);
                [output.values[row].to_bits(), u.to_bits()]
            };
            let conditions = case.setting(row).into_iter();
            let key = conditions.chain(observed.iter().flat_map(of_output)).collect();
            match known.get(&key) {
                Some(&first) => pairs.push((first, row)),
                None => {
                    known.insert(key, row);
                }
            }
        }
        if pairs.is_empty() || observed.is_empty() {
            return Self::default();
        }
        let digits = Digits::of(case);
        let places = places(case);
        let not_first: usize = places.iter().map(|rows| rows.len() - 1).sum();
        let many = pairs.len() >= TELLING_ROWS && pairs.len() == not_first;
        if observed.iter().any(|output| output.standard_uncertainties.is_none()) {
            let told = many || pairs.iter().any(|(_, copy)| digits.are_telling(*copy));
            return Self { pairs, chance: None, told };
        }
        let expected: f64 = places.iter().map(|rows| digits.expected_repeats(case, rows)).sum();
        let chance = at_least(pairs.len(), expected);
        Self { pairs, chance: Some(chance), told: chance < HARDLY_CHANCE }
    }

    /// Whether the repeated rows count once, with the rows that they repeat.
    pub(crate) fn count_once(&self) -> bool {
        self.chance.is_some_and(|chance| chance < NO_CHANCE)
    }

    /// The rows of a case that count.
    pub fn counted(&self, case: &Case) -> Vec<usize> {
        let mut counts = vec![true; case.task.rows.len()];
        if self.count_once() {
            self.pairs.iter().for_each(|(_, copy)| counts[*copy] = false);
        }
        (0..counts.len()).filter(|row| counts[*row]).collect()
    }

    /// What is to be said of them.
    pub fn note(&self, case: &Case) -> Option<Fact> {
        let (first, copy) = self.pairs.first().filter(|_| self.told)?;
        let one = self.pairs.len() == 1;
        let said = if self.count_once() {
            let below = Argument::Number(bound(self.chance.unwrap_or(NO_CHANCE)));
            let all = case.task.rows.len();
            let counted = all - self.pairs.len();
            match one {
                true => fact!("copies-count-once.one", below, counted, all),
                false => fact!("copies-count-once", below, counted, all),
            }
        } else {
            match (self.chance, one) {
                (None, true) => fact!("copies-unknown.one"),
                (None, false) => fact!("copies-unknown"),
                (Some(_), true) => fact!("copies-by-chance.one"),
                (Some(_), false) => fact!("copies-by-chance"),
            }
        };
        if one {
            return Some(fact!("copied-rows.one", copy = copy + 1, first = first + 1, said));
        }
        let mut firsts: Vec<usize> = self.pairs.iter().map(|(first, _)| *first).collect();
        firsts.sort_unstable();
        firsts.dedup();
        let copies: Vec<usize> = self.pairs.iter().map(|(_, copy)| *copy).collect();
        let [rows, more] = named(&copies);
        let firsts_of = match firsts[..] {
            [row] => fact!("one-row", row = row + 1),
            _ => {
                let [rows, more] = named(&firsts);
                fact!("several-rows", rows, more)
            }
        };
        Some(fact!("copied-rows", rows, more, firsts = firsts_of, said))
    }
}

/// Rows at the same conditions.
fn places(case: &Case) -> Vec<Vec<usize>> {
    let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
    let mut places: Vec<Vec<usize>> = Vec::new();
    for number in 0..case.task.rows.len() {
        let place = *known.entry(case.setting(number)).or_insert(places.len());
        if place == places.len() {
            places.push(Vec::new());
        }
        places[place].push(number);
    }
    places
}

/// A bound above the probability of at least so many of independent events, of which so many are
/// expected (Chernoff).
fn at_least(count: usize, expected: f64) -> f64 {
    let count = count as f64;
    if expected >= count {
        return 1.0;
    }
    elementary::exp(count * (1.0 + elementary::ln(expected / count)) - expected)
}

/// The last digits of the values of every observed output, as powers of ten.
struct Digits {
    last: Vec<Vec<i32>>,
    leading: Vec<Vec<i32>>,
    finest: Vec<i32>,
}

impl Digits {
    fn of(case: &Case) -> Self {
        let observed = case.observed.iter().flatten();
        let of = |value: &f64| {
            let decimal = Decimal::shortest(*value);
            let last = decimal.map_or(0, Decimal::position);
            (last, decimal.and_then(Decimal::leading).unwrap_or(last))
        };
        let digits: Vec<Vec<(i32, i32)>> =
            observed.map(|observed| observed.values.iter().map(of).collect()).collect();
        let last =
            |digits: &Vec<(i32, i32)>| digits.iter().map(|(last, _)| *last).collect::<Vec<i32>>();
        let leading = |digits: &Vec<(i32, i32)>| digits.iter().map(|(_, first)| *first).collect();
        let last: Vec<Vec<i32>> = digits.iter().map(last).collect();
        let finest = last.iter().map(|digits| digits.iter().copied().min().unwrap_or(0)).collect();
        Self { leading: digits.iter().map(leading).collect(), last, finest }
    }

    /// Whether a value of a row has so many digits that it is not the same twice.
    fn are_telling(&self, row: usize) -> bool {
        let mut outputs = self.last.iter().zip(&self.leading);
        outputs.any(|(last, leading)| leading[row] - last[row] + 1 >= TELLING_DIGITS)
    }

    /// To what an output is read in a row.
    fn read_to(&self, output: usize, row: usize) -> f64 {
        let (own, finest) = (self.last[output][row], self.finest[output]);
        // of a whole number the zeros at its end are digits
        let own = if finest <= 0 { own.min(0) } else { own };
        elementary::pow(10.0, f64::from(if own - finest <= CHANCE_ZEROS { finest } else { own }))
    }

    /// How many of some rows at the same conditions are expected to repeat one of them by chance, at
    /// most.
    fn expected_repeats(&self, case: &Case, rows: &[usize]) -> f64 {
        let observed: Vec<_> = case.observed.iter().flatten().collect();
        // values that differ at the same conditions tell a step that is coarser than the last digit
        let steps: Vec<f64> = observed
            .iter()
            .map(|output| {
                let mut values: Vec<f64> = rows.iter().map(|&row| output.values[row]).collect();
                ascending(&mut values);
                let apart = values.windows(2).map(|pair| pair[1] - pair[0]);
                let least = apart.filter(|apart| *apart > 0.0).fold(f64::INFINITY, f64::min);
                if least.is_finite() { least } else { 0.0 }
            })
            .collect();
        let same = |row: usize| -> f64 {
            let of_output = |(output, observed_output): (usize, &&crate::ObservedOutput)| {
                let u = observed_output.standard_uncertainties.as_ref().map_or(0.0, |u| u[row]);
                let step = self.read_to(output, row).max(steps[output]);
                (step / (2.0 * PI.sqrt() * u)).min(1.0)
            };
            observed.iter().enumerate().map(of_output).product()
        };
        rows.iter().enumerate().map(|(before, &row)| (before as f64 * same(row)).min(1.0)).sum()
    }
}

/// A power of ten above a probability.
fn bound(probability: f64) -> String {
    let power = elementary::log10(probability.max(f64::MIN_POSITIVE)).ceil().max(-15.0);
    format!("1e{power}")
}

/// Rows as a user counts them, neighbours as ranges, and how many more there are.
fn named(rows: &[usize]) -> [Argument; 2] {
    const MOST: usize = 8;
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for &row in rows {
        match ranges.last_mut() {
            Some([_, last]) if *last + 1 == row => *last = row,
            _ => ranges.push([row, row]),
        }
    }
    let range = |[first, last]: &[usize; 2]| -> Argument {
        let [first, last] = [first + 1, last + 1];
        match last - first {
            0 => first.into(),
            1 => vec![first, last].into(),
            _ => fact!("range-of-rows", first, last).into(),
        }
    };
    let said: Vec<Argument> = ranges.iter().take(MOST).map(range).collect();
    let count: usize = ranges.iter().skip(MOST).map(|[first, last]| last - first + 1).sum();
    let more = (count > 0).then(|| fact!("and-more", count));
    [said.into(), more.into()]
}
