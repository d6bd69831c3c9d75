//! Rows that repeat others to all digits.

use super::cases::{candidate, case, normal, observed};
use crate::{Case, Diagnosis, DiagnosisOptions, HypothesisKind, diagnose};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::task::Sharing;
use gumption_inference::noise::copies::Copies;

const VALUES: [f64; 10] = [100.9, 199.2, 300.4, 398.7, 501.3, 600.2, 699.1, 801.1, 900.3, 998.9];

/// Readings at 0, 1, 2, ... of a line, the whole table so many times, read to 0.1.
fn table(times: usize, u: Option<f64>) -> Case {
    let values = VALUES.repeat(times);
    let mut case = case(
        normal(100.0, 0.1),
        Sharing::All,
        &[("y", "a*(x + 1)")],
        vec![observed(&values, u.map(|u| vec![u; values.len()]).as_deref())],
        vec![
            candidate("offset", "o", normal(0.0, 20.0), &[("y", "y + o")]),
            candidate("gain", "g", normal(0.0, 0.03), &[("y", "y*(1 + g)")]),
        ],
    );
    for (number, row) in case.task.rows.iter_mut().enumerate() {
        row.conditions = vec![(number % VALUES.len()) as f64];
    }
    case
}

fn diagnosed(case: &Case) -> Diagnosis {
    diagnose(case, None, DiagnosisOptions::new(1), &|_| {}).unwrap()
}

fn note(found: &Diagnosis) -> Option<&Fact> {
    let note = found.notes.iter().find(|note| note.code() == "copied-rows");
    note.map(|note| &note.fact)
}

/// Rows that follow each other, as a note has them.
fn rows(first: usize, last: usize) -> Argument {
    vec![fact!("range-of-rows", first, last)].into()
}

/// The note that all rows of the first table repeat, of which this is said.
fn repeated(last: usize, said: Fact) -> Fact {
    let none = || Argument::List(Vec::new());
    let firsts = fact!("several-rows", rows = rows(1, 10), more = none());
    fact!("copied-rows", rows = rows(11, last), more = none(), firsts, said)
}

/// Ten rows twice and thrice tell what ten rows tell, to the last bit. Two readings with u = 1, read to
/// 0.1, are the same with the probability 0.1/(2 sqrt(pi)) = 0.0282: 0.282 of ten are expected, ten have
/// a probability below exp(10 - 0.282) (0.0282)^10 = 5.3e-12; twenty, where 0.846 are expected, one below
/// exp(20 - 0.846) (0.0423)^20 = 7e-20, which is said as below 1e-15.
#[test]
fn a_table_that_is_repeated_counts_once() {
    let once = diagnosed(&table(1, Some(1.0)));
    assert_eq!(once.most_probable.kind, HypothesisKind::None);
    assert_eq!(note(&once), None);
    for (times, below) in [(2, "1e-11"), (3, "1e-15")] {
        let found = diagnosed(&table(times, Some(1.0)));
        assert_eq!(found.most_probable.kind, once.most_probable.kind);
        assert_eq!(found.gap.chi2.to_bits(), once.gap.chi2.to_bits());
        assert_eq!(found.rows.len(), 10);
        let pairs = found.hypotheses.iter().zip(&once.hypotheses);
        for (found, once) in pairs {
            assert_eq!(found.effects, once.effects);
            assert_eq!(found.probability.to_bits(), once.probability.to_bits());
        }
        let (below, counted, all) = (Argument::number(below), 10_usize, 10 * times);
        let said = fact!("copies-count-once", below, counted, all);
        assert_eq!(note(&found), Some(&repeated(all, said)));
    }
}

/// Readings with u = 0.1 that are read to 0.1 repeat by chance: 0.1/(2 sqrt(pi) 0.1) = 0.28 of them; ten
/// of ten with exp(10 - 2.8) 0.28^10 = 0.004 at most, which may be, and is told beside the verdict.
#[test]
fn honest_repeats_are_kept() {
    // two of three pairs are the same: nothing to tell
    let mut some = table(2, Some(0.1));
    let values = &mut some.observed[0].as_mut().unwrap().values;
    for row in 12..20 {
        values[row] += if row % 2 == 0 { 0.1 } else { -0.1 };
    }
    assert!(!Copies::of(&some).told, "{:?}", Copies::of(&some));
    assert_eq!(Copies::of(&some).counted(&some).len(), 20);
    let all = table(2, Some(0.1));
    let copies = Copies::of(&all);
    assert!((copies.chance.unwrap() - 0.0041).abs() < 1e-4, "{copies:?}");
    assert_eq!(copies.counted(&all).len(), 20);
    assert_eq!(copies.note(&all), Some(repeated(20, fact!("copies-by-chance"))));
    // a step of 0.1 is told by the values that differ, whatever their digits: three of four rows at each
    // place are the same, as a converter's are
    let mut coarse = table(4, Some(0.05));
    let values = &mut coarse.observed[0].as_mut().unwrap().values;
    for (row, value) in values.iter_mut().enumerate() {
        *value = 1.000_001 * (*value + if row / 10 == row % 4 { 0.1 } else { 0.0 });
    }
    assert_eq!(Copies::of(&coarse).counted(&coarse).len(), 40);
    // without uncertainties nobody can tell
    let unknown = table(2, None);
    assert_eq!(Copies::of(&unknown).counted(&unknown).len(), 20);
    let said = Copies::of(&unknown).note(&unknown);
    assert_eq!(said, Some(repeated(20, fact!("copies-unknown"))));
}

/// Rows that differ in an uncertainty or a condition are none, and a zero at the end of a number is a
/// digit.
#[test]
fn only_what_repeats_to_all_digits_is_a_copy() {
    let mut other = table(2, Some(1.0));
    other.observed[0].as_mut().unwrap().standard_uncertainties.as_mut().unwrap()[10..].fill(1.1);
    assert_eq!(Copies::of(&other), Copies::default());
    let mut whole = table(2, Some(1.0));
    let values = &mut whole.observed[0].as_mut().unwrap().values;
    (values[5], values[15]) = (600.0, 600.0);
    assert_eq!(Copies::of(&whole), Copies::of(&table(2, Some(1.0))));
}
