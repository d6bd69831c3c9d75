//! Histograms of trials, and their look in a terminal.

use super::*;
use gumption_engine::propagate::histograms;
use gumption_engine::special::normal;

fn counted(
    case: &Case,
    control: &Control<'_>,
) -> Vec<Option<gumption_engine::propagate::monte_carlo::Histogram>> {
    histograms(&case.task, &case.evaluation, 0, control).unwrap().unwrap()
}

/// Trials of a quantity that is nearly linear in one normal input against that distribution: with
/// six standard deviations of each of 80 binomial counts a correct program fails in less than
/// 2e-7 of all seeds.
#[test]
fn trials_lie_where_the_distribution_has_them() {
    let mut task = plane_at(90.0, 300_000);
    let distributions = [Input::normal(10.0, 0.01, "m/s^2"), Input::constant(90.0, "deg")];
    let mut row: Vec<_> = task.rows[0].distributions.to_vec();
    for (place, input) in row.iter_mut().zip(distributions) {
        *place = std::sync::Arc::new(input.unwrap().distribution);
    }
    task.rows[0].distributions = row.into();
    let case = Case::new(task);
    let all = counted(&case, &Control::default());
    let histogram = all[0].as_ref().unwrap();
    assert_eq!(histogram.trials(), 300_000);
    assert_eq!(histogram.counts.len(), 80);
    let below = |x: f64| normal::cdf((x - 10.0) / 0.01);
    for (bin, &count) in histogram.counts.iter().enumerate() {
        let from = histogram.low + bin as f64 * histogram.width;
        let p = below(from + histogram.width) - below(from);
        let wanted = 300_000.0 * p;
        let scatter = 6.0 * (wanted * (1.0 - p)).sqrt() + 1.0;
        assert!((count as f64 - wanted).abs() < scatter, "bin {bin}: {count} for {wanted}");
    }
    // a_z is a constant of rounding size, a_y is zero
    assert!(all[1].is_none());
}

#[test]
fn counts_do_not_depend_on_threads_or_memory() {
    let case = Case::new(plane_at(35.0, 150_000));
    let one = counted(&case, &Control::default().with_threads(1));
    let three = counted(&case, &Control::default().with_threads(3).with_memory(1 << 20));
    assert_eq!(one, three);
    let histogram = one[0].as_ref().unwrap();
    let figures = case.evaluation.rows[0].outputs[0].monte_carlo.as_deref().unwrap();
    assert!(histogram.low < figures.symmetric_interval[0]);
    assert!(histogram.high() > figures.symmetric_interval[1]);
}
#[test]
fn a_terminal_shows_bars_and_both_intervals() {
    use crate::{Shown, table as page};

    let case = only_z(Case::new(plane_at(35.0, 100_000)));
    let all = [counted(&Case::new(plane_at(35.0, 100_000)), &Control::default()).split_off(2)];
    let shown = Shown { histograms: &all, ..Shown::default() };
    let text = page(&case.report(), &shown);
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(!text.contains('\u{1b}'), "no colours");
    let text = text.split_once("\na_z in m/s^2: 100 000 trials\n").expect("a histogram").1;
    let text = text.split_once("\n\n").map_or(text, |(histogram, _)| histogram);
    insta::assert_snapshot!(text, @"
                                                       ▁▄▅▄█▇▅▃
                                                    ▄▆██████████▆▂
                                                  ▃███████████████▇▂
                                                ▄███████████████████▇▂
                                              ▃▇██████████████████████▅▁
                                            ▄▇██████████████████████████▃▁
                                          ▄███████████████████████████████▅▂
                                       ▁▄███████████████████████████████████▆▃
                                    ▂▄▆███████████████████████████████████████▇▅▃▁
                           ▁▁▁▂▃▄▄▆████████████████████████████████████████████████▆▅▃▂▂▁▁
                   ─────┬──────────┬──────────┬──────────┬─────────┬──────────┬──────────┬─────────
                      8.16       8.17       8.18       8.19      8.20       8.21       8.22
              GUM                    ├──────────────────────────────────────────┤
    MC, symmetric                    ├──────────────────────────────────────────┤
     MC, shortest                    ├──────────────────────────────────────────┤
    ");
}

#[test]
fn without_trials_there_is_none() {
    let case = Case::new(plane_at(35.0, 0));
    let found = histograms(&case.task, &case.evaluation, 0, &Control::default());
    assert_eq!(found, Ok(None));
}
