//! What a run prints first: the answer, what is doubtful, and the budgets on one screen.

use std::fs;

use gumption::file::FileReader;
use gumption::propagate::{Control, evaluate};
use gumption::report::{EvaluationReport, Provenance, Screen, Shown, table, within_screen};

use crate::support::{gumption, output, root};

/// The model of the first command of the README.
const MODEL: &str = "models/inclined_plane.json";

/// A sweep whose intervals are those of the trials.
const SWEEP: &str = "models/measuring_chain_frequencies.json";

/// The page of the model on a terminal of 80 columns that shows the letters of print.
fn first_screen() -> String {
    let catalogue = gumption::catalogue();
    let file = FileReader::new(catalogue).model(&root().join(MODEL), &[]).expect("a model");
    let evaluation = evaluate(&file.task, &Control::default()).expect("an evaluation");
    let provenance = Provenance::default();
    let report = EvaluationReport {
        task: &file.task,
        evaluation: &evaluation,
        warnings: &[],
        provenance: &provenance,
    };
    let screen = Screen { columns: 80, shows_print: true };
    within_screen(screen, || table(&report, &Shown::default()))
}

/// A terminal of 30 lines shows all of the first command's page with the prompt below it.
#[test]
fn the_first_command_fits_a_screen() {
    let page = first_screen();
    assert!(page.lines().count() <= 29, "{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    assert!(page.starts_with("a_x = (4.967 ± 0.018) m/s², k = 1.96"), "{page}");
}

/// README shows lines of this page, in order.
#[test]
fn the_readme_shows_the_first_screen() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md");
    let (_, block) = readme.split_once("```text\n").expect("a block of text");
    let (block, _) = block.split_once("```").expect("its end");
    let page = first_screen();
    let mut lines = page.lines();
    for shown in block.lines().filter(|line| !line.is_empty() && *line != "...") {
        assert!(lines.any(|line| line == shown), "`{shown}` is not in\n{page}");
    }
}

/// Each output has a line; value and U are those of the JSON answer, rounded to the digits of the line.
#[test]
fn the_answer_stands_on_the_first_lines() {
    let page = output(&["run", MODEL, "--quiet"]);
    let answer: serde_json::Value =
        serde_json::from_str(&output(&["run", MODEL, "--quiet", "--format", "json"]))
            .expect("JSON");
    for (line, name) in page.lines().zip(["a_x", "a_y", "a_z"]) {
        let of = &answer["outputs"][name];
        let rest = line.strip_prefix(&format!("{name} = (")).expect("the name");
        let (numbers, rest) = rest.split_once(") ").expect("a unit");
        assert!(rest.starts_with("m/s^2, k = 1.96, coverage probability 95 %"), "{line}");
        let (value, expanded) = numbers.split_once(" ± ").expect("an uncertainty");
        for (text, exact) in
            [(value, &of["gum"]["estimate"]), (expanded, &of["gum"]["expanded_uncertainty"])]
        {
            let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            let exact = exact.as_f64().expect("a number");
            // half a unit of the last digit that is printed
            let half = 0.5 * 10_f64.powi(-(decimals as i32)) * (1.0 + 1e-9);
            assert!((text.parse::<f64>().unwrap() - exact).abs() <= half, "{line}: {exact}");
        }
    }
}

#[test]
fn brief_is_the_answer_alone_and_full_is_everything() {
    let run =
        |more: &[&str]| output(&[&["run", MODEL, "--trials", "20000", "--quiet"], more].concat());
    let (brief, usual, full) = (run(&["--brief"]), run(&[]), run(&["--full"]));
    assert_eq!(brief.lines().count(), 3);
    for page in [&usual, &full] {
        assert!(page.starts_with(&brief), "{page}");
    }
    for title in ["Measurement model", "Quantities", "Reproducing this result"] {
        assert!(full.contains(title) && !usual.contains(title), "{title}");
    }
    assert!(full.contains('█') && full.contains("numerical"), "{full}");
    // the order of the parts of a page
    let places = ["a_x = (", "sensitivity", "Measurement model", "Reproducing this result"]
        .map(|part| full.find(part).expect(part));
    assert!(places.is_sorted(), "{full}");
    let sweep = output(&["run", SWEEP, "--trials", "2000", "--quiet", "--brief"]);
    assert_eq!(sweep.matches("expanded").count(), 3, "{sweep}");
    assert!(!sweep.contains("Shares"), "{sweep}");
}

#[test]
fn brief_and_full_are_of_the_text_page() {
    let arguments = ["run", MODEL, "--full", "--format", "html"];
    let refused = gumption().args(arguments).assert().code(2);
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(said.contains("`--brief` and `--full` are for the text page"), "{said}");
    gumption().args(["run", MODEL, "--brief", "--full"]).assert().code(2);
}
