//! Pages for a terminal.

use super::super::table;
use super::*;
use gumption_gap::{RunAtVerdict, SimulatorReport};

fn page(diagnosis: &Diagnosis) -> String {
    let page = table(diagnosis, &provenance());
    let widest = page.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    assert!(widest <= 100, "{widest} columns:\n{page}");
    assert!(page.lines().all(|line| !line.ends_with(' ')), "{page}");
    assert!(page.chars().all(|c| c == '\n' || !c.is_control()), "{page}");
    page
}

#[test]
fn numbers_are_those_of_the_json() {
    let diagnosis = diagnosis();
    let page = page(&diagnosis);
    let answer = json(&diagnosis);
    // a line's cells that are numbers, behind its name
    let cells = |name: &str| -> Vec<String> {
        let line = page
            .lines()
            // the hypothesis stands below the effect of the same name
            .rfind(|line| line.strip_prefix(name).is_some_and(|rest| rest.starts_with("  ")));
        let rest = line.unwrap_or_else(|| panic!("{name} in {page}")).strip_prefix(name).unwrap();
        // a range of conditions has numbers in its words, parted by single spaces
        let cells = rest.split("  ").map(str::trim).filter(|cell| cell.parse::<f64>().is_ok());
        cells.map(str::to_owned).collect()
    };
    assert_agreement(&answer, &cells);
    let running = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_sentences(&answer, &running);
    assert!(page.contains("\na_x in m/s^2:\n\n    f    tilt  corrected "), "{page}");
    // what was not measured has no mean
    assert!(page.contains("\n  400      35  1561           13         1580         -\n"), "{page}");
}

#[test]
fn long_and_hostile_names_stay_on_the_page() {
    let page = page(&hostile());
    assert!(page.contains("alert('&amp;')"), "{page}");
    assert!(!page.contains('\u{202e}'));
}

#[test]
fn what_is_hardly_there_has_a_page() {
    let text = page(&bare());
    assert!(text.contains("There is no gap"), "{text}");
    assert!(text.contains("so the residuals cannot be tested"), "{text}");
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    let text = page(&unexplained());
    assert!(
        text.contains("none of the candidate effects explains it (probability 0.990)"),
        "{text}"
    );
    assert!(!text.contains("Parameters of the verdict"), "{text}");
    page(&many());
}

/// The headline does not say that nothing explains the gap where something more probably does, and not
/// that the noise is off where that is not sure.
#[test]
fn headlines_are_no_surer_than_their_probabilities() {
    let mut unsure = unexplained();
    unsure.most_probable.probability = 0.454;
    let explained: f64 = unsure
        .hypotheses
        .iter()
        .filter(|of| of.effects.as_ref().is_some_and(|effects| !effects.is_empty()))
        .map(|of| of.probability)
        .sum();
    assert!(explained > 0.454, "{explained}");
    let text = page(&unsure).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("No candidate effect explains it (probability 0.454): this is more probable"),
        "{text}"
    );
    let mut off = bare();
    off.outputs = vec![named("a_x", "m/s^2")];
    for (probability, said) in
        [(0.7, "the noise is probably not as"), (0.97, "the noise is not as")]
    {
        let mut noise = NoiseEstimate::new(0);
        let factor = UncertaintyFactor { estimate: 0.26, interval: [0.25, 0.28], probability };
        noise.factor = Some(factor);
        off.noise = vec![noise];
        let text = page(&off).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(said), "{text}");
        assert!(text.contains("limit of the tried factors (0.25 to 1000)"), "{text}");
    }
}

#[test]
fn a_small_gap_has_no_fraction() {
    let mut small = diagnosis();
    small.shrinkage.meaningful = false;
    let text = page(&small);
    let line = text.lines().find(|line| line.starts_with("rms residual, all")).unwrap();
    assert!(line.ends_with(" -"), "{line}");
    assert!(text.contains("below 3 standard uncertainties"), "{text}");
    assert!(!text.contains("the fraction removed is expected"), "{text}");
}

#[test]
fn plot_of_the_residuals() {
    let page = page(&diagnosis());
    let plot = page.split_once("\na_x: residual ").unwrap().1;
    let plot = plot.split_once("ratio: residual").unwrap().0;
    insta::assert_snapshot!(plot, @"
    / u against f in Hz; x before, o after, * both, ┄ ±2; compressed far from zero
           │                                                                                  x
        10 ┤                                                                         x
           │                                                                x        x
           │            *                *                          x       o        o
         2 ┤┄┄┄*┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄*┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄*┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄
           │                     *                         x                o
         0 ┤                             *                                                    o
           │            x                                  o
        -2 ┤┄┄┄┄┄┄┄┄┄┄┄┄o┄┄┄┄┄┄┄┄*┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄x┄┄┄┄┄┄┄┄x┄┄┄┄┄┄┄┄o┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄o┄┄┄┄┄┄┄┄┄┄┄┄
           │   *                                  o        o                                  o
           │
       -10 ┤
           │
           └───┬────────┬────────┬──────────┬────────┬────────┬──────────┬────────┬────────┬──────
              0.5       1        2          5       10       20         50       100      200
    ");
}

/// What lies below the noise floor was not removed in full: the bound is what the scatter of the mean
/// square of 20 values about the floor lets be known, two standard deviations of it.
#[test]
fn a_fraction_is_not_above_what_the_noise_allows() {
    let mut below = diagnosis();
    below.shrinkage.values = 20;
    below.shrinkage.all.removed_fraction = 1.0;
    let page = table(&below, &provenance());
    // 2 sqrt(2/20) 1.053^2/(4.489^2 - 1.053^2) = 0.0368
    let line = page.lines().find(|line| line.starts_with("rms residual, all outputs")).unwrap();
    assert!(line.trim_end().ends_with(">0.96"), "{line}");
}

/// A verdict that is less probable than all others together is not said like one that is sure, and what
/// comes next stands beside it; whether there is a gap is said where no gap has less than 0.05.
#[test]
fn a_headline_below_one_half_says_that_it_is_not_decided() {
    let mut unsure = diagnosis();
    unsure.most_probable.effects = strings(&["offset"]);
    unsure.most_probable.probability = 0.247;
    unsure.present.clear();
    let of = |effects: Option<&[&str]>, p| hypothesis(effects, [0.2, p, 0.0, 0.0, 100.0], vec![]);
    let mut with = |none: f64| {
        unsure.hypotheses = vec![
            of(Some(&["offset"]), 0.247),
            of(Some(&["gain"]), 0.24),
            of(None, 0.2),
            of(Some(&["offset", "gain"]), 0.05),
            of(Some(&[]), none),
        ];
        page(&unsure).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let text = with(0.2);
    assert!(
        text.contains(
            "It is not decided whether there is a gap: offset is only the most probable of several \
             hypotheses (probability 0.247; gain 0.240, no candidate effect 0.200, no gap \
             0.200)."
        ),
        "{text}"
    );
    let text = with(0.01);
    assert!(
        text.contains(
            "There is a gap, but what explains it is not decided: offset is only the most probable of \
             several explanations (probability 0.247; gain 0.240, no candidate effect 0.200)."
        ),
        "{text}"
    );
}

/// A hypothesis that is more probable than all others together does not make a gap sure: that there is none
/// must have less than 0.05.
#[test]
fn a_headline_above_one_half_says_where_no_gap_is_possible() {
    let mut unsure = diagnosis();
    unsure.most_probable.effects = strings(&["offset"]);
    unsure.most_probable.probability = 0.64;
    let of = |effects: Option<&[&str]>, p| hypothesis(effects, [0.2, p, 0.0, 0.0, 100.0], vec![]);
    let mut with = |none: f64| {
        unsure.hypotheses = vec![of(Some(&["offset"]), 0.64), of(Some(&[]), none)];
        page(&unsure).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let text = with(0.3);
    let said = "It is not decided whether there is a gap: the probability that offset makes a gap is 0.640, \
                and the probability of no gap is 0.300.";
    assert!(text.contains(said), "{text}");
    let text = with(0.04);
    assert!(text.contains("There is a gap, and offset explains it (probability 0.640)."), "{text}");
}

/// Without a range nothing is said about where the conditions could be set.
#[test]
fn a_condition_without_a_range_is_told() {
    let mut without = diagnosis();
    let text_of = |of: &_| page(of).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text_of(&without).contains("the same function of all conditions"));
    without.next.without_range = vec![0];
    let text = text_of(&without);
    assert!(!text.contains("the same function of all conditions"), "{text}");
    assert!(
        text.contains(
            "No range is stated for f, so proposals use only the values of the data. If other values can \
             be set, state the range in the case: \"f\": {..., \"range\": [lowest, highest]}."
        ),
        "{text}"
    );
}

/// Rows that repeat others are told beside the verdict, and not once more below.
#[test]
fn copied_rows_stand_beside_the_verdict() {
    let mut copied = diagnosis();
    let said = fact!("copies-unknown.one");
    let fact = fact!("copied-rows.one", copy = 8_usize, first = 7_usize, said);
    copied.notes.push(DiagnosisNote { fact });
    let page = page(&copied);
    assert_eq!(page.matches("Row 8 repeats the conditions and").count(), 1);
    assert!(page.find("Row 8 repeats").unwrap() < page.find("\nModel\n").unwrap(), "{page}");
}

/// The run at the verdict stands on the page and in JSON, and no row is proposed.
#[test]
fn a_simulator_is_shown_at_the_verdict() {
    let mut diagnosis = diagnosis();
    diagnosis.simulator = Some(SimulatorReport {
        runs: 139,
        failed: 2,
        error: Some(0.071),
        at_verdict: Some(RunAtVerdict {
            parameters: vec![(named("length", "m"), 0.500_123_4)],
            error: 0.034,
            residual: Some(0.958),
        }),
    });
    let page = page(&diagnosis);
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "The data differ from it by 0.958 standard uncertainties (root mean square).",
        "The prediction from the 139 runs differs from this run by 0.034 standard uncertainties",
        "length m 0.500123",
        "The rows of a simulator belong together, so no single row is proposed",
    ] {
        assert!(page.contains(said), "{said}\n{page}");
    }
    let answer = json(&diagnosis);
    let expected = serde_json::json!({
        "runs": 139, "failed": 2, "error": 0.071,
        "at_verdict": {"parameters": {"length": 0.500_123_4}, "error": 0.034, "rms_residual": 0.958},
    });
    assert_eq!(answer["simulator"], expected);
}
