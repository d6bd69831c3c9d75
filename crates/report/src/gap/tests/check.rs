//! Pages of a blind check, and that their numbers are those of its JSON.

use roxmltree::Node;
use serde_json::Value;

use super::super::check::{CheckedDesign, html, table};
use super::super::check_json;
use super::html::{SVG, assert_inside, parsed, text, with_body};
use super::{assert_rounded, named, provenance, strings};
use gumption_gap::check::{
    BesideScores, BlindCheckScores, BlindDraw, CheckedNoise, Confusion, Reliability, SmallestEffect,
};

fn design() -> CheckedDesign {
    CheckedDesign {
        title: "A rotating table".to_owned(),
        rows: 40,
        outputs: strings(&["a_t", "a_r"]),
        conditions: vec![
            (named("f", "Hz"), [0.5, 256.0]),
            (named("tilt", "deg"), [35.0, 35.0]),
            (named("step", ""), [0.0, 3.0]),
        ],
        effects: 3,
        noise: CheckedNoise::AsStated,
    }
}

/// A draw; an effect `*` was withheld, and the verdict `?` is "unexplained".
fn draw(effects: &[&str], named: &[&str], probability: f64, right: bool) -> BlindDraw {
    let label = |names: &[&str]| match names {
        [] => "none".to_owned(),
        ["?" | "*"] => "unexplained".to_owned(),
        names => names.join("+"),
    };
    let withheld = effects == ["*"];
    BlindDraw {
        truth: label(effects),
        withheld: withheld.then(|| "radius-offset".to_owned()),
        listed_present: None,
        said: label(named),
        probability,
        of_truth: if right { probability } else { 0.01 },
        brier: 0.1,
        right,
        held: vec![right],
        gap: 5.0,
        left: 0.25,
        fractions: (!effects.is_empty()).then_some([0.9, 0.92]),
        parameters: Vec::new(),
        effects: if withheld { strings(&["radius-offset"]) } else { strings(effects) },
        named: if named == ["?"] { Vec::new() } else { strings(named) },
    }
}

/// Scores of draws, with other figures that are made up.
fn scores(checked: Vec<BlindDraw>) -> BlindCheckScores {
    let mut confusion: Vec<Confusion> = Vec::new();
    for one in &checked {
        match confusion.iter_mut().find(|c| c.truth == one.truth && c.said == one.said) {
            Some(known) => known.count += 1,
            None => {
                let BlindDraw { truth, said, .. } = one.clone();
                confusion.push(Confusion { truth, said, count: 1 });
            }
        }
    }
    let gap_free = checked.iter().filter(|one| one.truth == "none").count();
    let alarms = checked.iter().filter(|one| one.truth == "none" && one.said != "none").count();
    let smallest = |parameter: &str, unit: &str, value, gap| SmallestEffect {
        parameter: parameter.to_owned(),
        unit: unit.to_owned(),
        value_at_90_percent: value,
        gap_at_90_percent: gap,
    };
    let right = checked.iter().filter(|one| one.right).count();
    BlindCheckScores {
        draws: checked.len(),
        seed: 77,
        top1: right as f64 / checked.len() as f64,
        top1_interval: [0.654_321, 0.912_345],
        brier: 0.123_456,
        mean_log_probability: -0.432_109,
        false_alarms: alarms as f64 / gap_free.max(1) as f64,
        gap_free,
        confusion,
        reliability: vec![
            Reliability { probability: 0.451_234, fraction: 0.5, count: 4 },
            Reliability { probability: 0.987_654, fraction: 12.0 / 13.0, count: 13 },
        ],
        calibration_error: 0.045_678,
        perfect_calibration_error: 0.034_567,
        interval_coverage: 0.944_444,
        intervals: 18,
        left: 0.211_111,
        worse_than_none: 0.066_667,
        claim_bias: -0.012_345,
        smallest: vec![
            smallest("radius-offset/d", "mm", Some(0.345_678), Some(2.345_678)),
            smallest("low-pass/fc", "Hz", None, Some(3.456_789)),
            smallest("gain/k", "", None, None),
        ],
        beside: BesideScores { drawn: 5, listed_effect_named: 4, lost: 1 },
        checked,
    }
}

/// Right and wrong verdicts of all kinds.
fn report() -> BlindCheckScores {
    let mut checked = Vec::new();
    let mut add = |count: usize, one: BlindDraw| (0..count).for_each(|_| checked.push(one.clone()));
    add(5, draw(&[], &[], 0.95, true));
    add(1, draw(&[], &["gain"], 0.55, false));
    add(7, draw(&["gain"], &["gain"], 0.99, true));
    add(3, draw(&["gain"], &["radius-offset"], 0.6, false));
    add(2, draw(&["gain", "low-pass"], &["gain", "low-pass"], 0.9, true));
    add(2, draw(&["gain", "low-pass"], &["gain"], 0.7, false));
    add(1, draw(&["*"], &["?"], 0.8, true));
    add(1, draw(&["*"], &["gain"], 0.8, true));
    add(1, draw(&["*"], &["low-pass"], 0.8, false));
    scores(checked)
}

/// More labels than a figure has room for.
fn crowded() -> BlindCheckScores {
    let pair = |number: usize, other: usize| {
        [format!("effect-{number:02}"), format!("effect-{:02}", number + other)]
    };
    let mut checked = Vec::new();
    for number in 0..24 {
        let (truth, said) = (pair(number, 1), pair(number, 1 + number % 2));
        let [truth, said] = [&truth, &said].map(|names| names.each_ref().map(String::as_str));
        checked.push(draw(&truth, &said, 0.9, truth == said));
        checked.push(draw(&truth, &[said[0]], 0.9, false));
    }
    scores(checked)
}

/// Names that are long and hostile.
fn hostile() -> (CheckedDesign, BlindCheckScores) {
    let name = |text: &str| {
        format!(
            "{text}<script>alert('&amp;')</script>\"\u{1b}[31m\u{202e}{}",
            "long_name_".repeat(9)
        )
    };
    let (mut design, mut report) = (design(), report());
    design.title = name("title");
    design.outputs.iter_mut().for_each(|output| *output = name(output));
    for (named, _) in &mut design.conditions {
        *named = super::named(&name(&named.name), &name("unit"));
    }
    for one in &mut report.checked {
        one.effects.iter_mut().chain(&mut one.named).for_each(|effect| *effect = name(effect));
    }
    for effect in &mut report.smallest {
        effect.parameter = name(&effect.parameter);
        effect.unit = name("unit");
    }
    (design, report)
}

/// One draw that tells nothing.
fn bare() -> (CheckedDesign, BlindCheckScores) {
    let design = CheckedDesign {
        title: String::new(),
        rows: 1,
        outputs: strings(&["y"]),
        conditions: Vec::new(),
        effects: 1,
        noise: CheckedNoise::Uncertain,
    };
    let mut report = scores(vec![draw(&["gain"], &["gain"], 1.0, true)]);
    report.intervals = 0;
    report.smallest.clear();
    report.reliability = vec![Reliability { probability: 1.0, fraction: 1.0, count: 1 }];
    (design, report)
}

fn page(design: &CheckedDesign, report: &BlindCheckScores) -> String {
    let page = table(design, report, &provenance());
    let widest = page.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    assert!(widest <= 100, "{widest} columns:\n{page}");
    assert!(page.lines().all(|line| !line.ends_with(' ')), "{page}");
    assert!(page.chars().all(|c| c == '\n' || !c.is_control()), "{page}");
    assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
    page
}

fn json(report: &BlindCheckScores) -> Value {
    serde_json::from_str(&check_json("", CheckedNoise::AsStated, report)).unwrap()
}

/// Compares the cells of the tables with the JSON; `cells` gives the numbers of the line that begins
/// with a text, without what is missing.
fn assert_agreement(report: &BlindCheckScores, cells: &dyn Fn(&str) -> Vec<String>) {
    let answer = json(report);
    let check = |line: &str, exact: &[&Value]| {
        let cells = cells(line);
        assert_eq!(cells.len(), exact.len(), "{line}: {cells:?}");
        for (printed, exact) in cells.iter().zip(exact) {
            assert_rounded(printed, exact);
        }
    };
    let draws = &answer["draws"];
    let [low, high] = [0, 1].map(|end| &answer["top1_interval"][end]);
    check("right verdicts", &[&answer["top1"], low, high, draws]);
    // Wilson's interval of 1 of 6, worked out with another program
    let [low, high] = [0.030_053, 0.563_503].map(Value::from);
    check(
        "false alarms without a gap",
        &[&answer["false_alarms"], &low, &high, &answer["gap_free"]],
    );
    check("Brier score, mean", &[&answer["brier"], draws]);
    check("ln probability of the truth, mean", &[&answer["mean_log_probability"], draws]);
    check("calibration error", &[&answer["calibration_error"], draws]);
    let perfect = &answer["perfect_calibration_error"];
    check("calibration error, perfect diagnosis", &[perfect]);
    let held = &answer["interval_coverage"];
    check("intervals that hold the true parameter", &[held, &answer["intervals"]]);
    let with_gap = Value::from(17);
    check("gap left, median", &[&answer["gap_left"], &with_gap]);
    check("corrections worse than none", &[&answer["worse_than_none"], &with_gap]);
    check("claimed minus true removed fraction", &[&answer["claim_bias"], &with_gap]);
    for line in answer["reliability"].as_array().unwrap() {
        let [probability, fraction, count] = [0, 1, 2].map(|place| &line[place]);
        let first = format!("{:.3}", probability.as_f64().unwrap());
        let own = cells(&first);
        let [of, low, high, counted] = own.as_slice() else { panic!("{own:?}") };
        assert_rounded(of, fraction);
        assert_rounded(counted, count);
        let [low, high] = [low, high].map(|end| end.parse::<f64>().unwrap());
        assert!((low..=high).contains(&fraction.as_f64().unwrap()));
    }
    let smallest = &answer["smallest_effect"];
    let own = &smallest["radius-offset/d"];
    check("radius-offset/d", &[&own["value_at_90_percent"], &own["gap_at_90_percent"]]);
    check("low-pass/fc", &[&smallest["low-pass/fc"]["gap_at_90_percent"]]);
    check("gain/k", &[]);
}

/// Compares the wrong verdicts, in the order of their frequency, with the JSON's.
fn assert_wrong(report: &BlindCheckScores, lines: &[Vec<String>]) {
    let answer = json(report);
    let printed: Vec<Vec<&str>> =
        lines.iter().map(|line| line.iter().map(String::as_str).collect()).collect();
    let expected = [
        ["gain", "radius-offset", "3", "10"],
        ["gain + low-pass", "gain", "2", "4"],
        ["none", "gain", "1", "6"],
        ["unexplained", "low-pass", "1", "3"],
    ];
    assert_eq!(printed, expected);
    for [truth, said, count, of] in expected {
        let own = |line: &&Value| line[0].as_str() == Some(&truth.replace(" + ", "+"));
        let confusion = answer["confusion"].as_array().unwrap();
        let sum: u64 = confusion.iter().filter(own).map(|line| line[2].as_u64().unwrap()).sum();
        assert_eq!(sum.to_string(), of);
        let found = confusion.iter().filter(own).find(|line| line[1] == said).unwrap();
        assert_eq!(found[2].to_string(), count);
    }
}

fn assert_sentences(text: &str) {
    for needed in [
        "The verdict was right in 16 of 23 draws (share 0.696, interval from 0.654 to 0.912).",
        "In 1 of 6 data sets without a gap it found one (share 0.167,",
        "6 without a gap, 10 with one effect, 4 with two, 3 with an effect that was then removed",
        "40 rows of a_t, a_r, with f from 0.5 to 256 Hz; tilt = 35 deg; step from 0 to 3.",
        "The mean distance from this is 0.046; a perfect diagnosis with as many draws and the same \
         probabilities has 0.035",
        "23 draws; intervals at 95 %; seed 77",
    ] {
        assert!(text.contains(needed), "`{needed}` in {text}");
    }
}

#[test]
fn numbers_of_the_text_are_those_of_the_json() {
    let report = report();
    let page = page(&design(), &report);
    let split = |line: &str| -> Vec<String> {
        line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
    };
    let cells = |name: &str| -> Vec<String> {
        let line = page.lines().map(split).find(|cells| cells.first().is_some_and(|c| c == name));
        let cells = line.unwrap_or_else(|| panic!("{name} in {page}"));
        cells[1..].iter().filter(|cell| cell.parse::<f64>().is_ok()).cloned().collect()
    };
    assert_agreement(&report, &cells);
    let wrong = page.split_once("\nWrong verdicts\n").unwrap().1;
    // behind the rule of the title
    let wrong = wrong.split("\n\n").nth(1).unwrap();
    let lines: Vec<Vec<String>> = wrong.lines().skip(3).map(split).collect();
    assert_wrong(&report, &lines);
    assert_sentences(&page.split_whitespace().collect::<Vec<_>>().join(" "));
}

#[test]
fn numbers_of_the_page_are_those_of_the_json() {
    let report = report();
    let (_, body) = with_body(html(&design(), &report, &provenance()));
    let document = parsed(&body);
    let rows: Vec<Vec<String>> = document
        .descendants()
        .filter(|node| node.has_tag_name("tr"))
        .map(|row| row.children().filter(Node::is_element).map(text).collect())
        .collect();
    let cells = |name: &str| -> Vec<String> {
        let row = rows.iter().find(|row| row[0] == name);
        let row = row.unwrap_or_else(|| panic!("{name} in {rows:?}"));
        row[1..].iter().filter(|cell| cell.parse::<f64>().is_ok()).cloned().collect()
    };
    assert_agreement(&report, &cells);
    let from = rows.iter().position(|row| row[0] == "truth").unwrap();
    assert_wrong(&report, &rows[from + 1..from + 5]);
    assert_sentences(&text(document.root_element()));
    let repeat = |name: &str| rows.iter().find(|row| row[0] == name).unwrap()[1].clone();
    assert_eq!(repeat("program"), format!("gumption {}", env!("CARGO_PKG_VERSION")));
    assert_eq!(repeat("draws"), "23");
    assert_eq!(repeat("seed of the draws"), "77");
    assert_eq!(repeat("case file, SHA-256"), "0123abcd");
    assert_eq!(repeat("data.csv, SHA-256"), "4567");
}

/// The texts of each drawing of a page.
fn drawings(body: &str) -> Vec<Vec<String>> {
    let document = parsed(body);
    let drawings = document.descendants().filter(|node| node.has_tag_name(SVG));
    let wide = drawings.filter(|node| node.attribute("class") == Some("wide"));
    wide.map(|drawing| {
        let texts = drawing.descendants().filter(|node| node.tag_name().name() == "text");
        texts.map(text).collect()
    })
    .collect()
}

#[test]
fn drawings_have_the_counts() {
    let (_, body) = with_body(html(&design(), &report(), &provenance()));
    assert_inside(&body);
    let drawn = drawings(&body);
    assert_eq!(drawn.len(), 2);
    for needed in ["4", "13", "share of right verdicts"] {
        assert!(drawn[0].iter().any(|text| text == needed), "{needed}: {:?}", drawn[0]);
    }
    // a row: its number as a column, its name, its number, its sum, and the counts that are not zero
    let from = drawn[1].iter().position(|text| text == "gain").unwrap();
    assert_eq!(drawn[1][from - 1..from + 5], ["2", "gain", "2", "10", "7", "3"]);
    let from = drawn[1].iter().position(|text| text == "unexplained").unwrap();
    assert_eq!(drawn[1][from..], ["unexplained", "6", "3", "1", "1", "1"]);
    assert!(body.contains("Outside the frame of that row, 1 verdicts count as right"), "{body}");
}

#[test]
fn many_labels_are_taken_together() {
    let report = crowded();
    let (_, body) = with_body(html(&design(), &report, &provenance()));
    assert_inside(&body);
    let drawn = drawings(&body);
    let from = drawn[1].iter().position(|text| text == "two effects or more").unwrap();
    // 24 draws of two effects with a verdict of two, and one for each verdict of one effect
    assert_eq!(drawn[1][from + 2..].iter().filter(|text| *text == "1").count(), 24);
    assert!(drawn[1][from + 2..].contains(&"24".to_owned()), "{:?}", drawn[1]);
    assert!(body.contains("of the 24 verdicts in their frame, 12 name exactly the true ones"));
    let page = page(&design(), &report);
    assert!(page.contains("21 other wrong verdicts are not listed."), "{page}");
}

#[test]
fn names_are_texts_whatever_is_in_them() {
    let (design, report) = hostile();
    let text = page(&design, &report);
    assert!(text.contains("alert('&amp;')") && !text.contains('\u{202e}'), "{text}");
    let (page, body) = with_body(html(&design, &report, &provenance()));
    assert!(page.contains("&lt;script&gt;"));
    assert!(!page.contains(['\u{1b}', '\u{202e}']));
    assert_inside(&body);
}

#[test]
fn what_is_hardly_there_has_a_page() {
    let (design, report) = bare();
    let text = page(&design, &report);
    assert!(text.starts_with("Blind check of the diagnosis\n"), "{text}");
    assert!(text.contains("the rate of false alarms is unknown"), "{text}");
    assert!(text.contains("No verdict was wrong."), "{text}");
    let line = text.lines().find(|line| line.starts_with("false alarms without")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().skip(5).collect();
    assert_eq!(cells, ["-", "-", "-", "0"], "{line}");
    assert!(!text.contains("Smallest effects"), "{text}");
    assert_inside(&with_body(html(&design, &report, &provenance())).1);
}
