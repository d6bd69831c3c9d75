//! The page for a terminal.

use super::{composed, departure, sheets, strength, terminal, words};
use crate::{Grid, plain, statement, table::width, wrapped};
use gumption_gap::{Diagnosis, Predicted};

/// The diagnosis as a page of at most 100 columns: the verdict, whether there is a gap, where, which
/// hypotheses there are, the parameters of the verdict, how far the gap shrinks, what to measure
/// next, predictions if there are any, notes, and a plot of the residuals before and after for each
/// output.
pub fn table(diagnosis: &Diagnosis) -> String {
    let mut page = vec![heading(diagnosis)];
    let sim: String =
        statement::lines(words::sim(diagnosis)).iter().map(|said| wrapped(said)).collect();
    if !sim.is_empty() {
        page.push(section(words::SIM) + &sim);
    }
    let overlays = terminal::overlays(diagnosis);
    if !overlays.is_empty() {
        page.push(section("What was measured, and what the sim says") + &overlays.join("\n"));
    }
    let described = words::effects(diagnosis);
    if !described.is_empty() {
        page.push(section("What the effect is") + &effects(described));
    }
    page.push(section("Is there a gap?") + &wrapped(&words::gap(diagnosis)));
    page.push(section("Where?") + &regions(diagnosis));
    if let Some(present) = sheets::present(diagnosis) {
        page.push(section("Which effects are there?") + &Grid::of(&present).render(width()));
    }
    if let Some(sheet) = sheets::replication(diagnosis) {
        let table = Grid::of(&sheet).render(width());
        page.push(section("Is it the same for all?") + &wrapped(words::REPLICATION) + &table);
    }
    page.push(section("Which together?") + &hypotheses(diagnosis));
    if let Some(parameters) = sheets::parameters(diagnosis) {
        page.push(section("Parameters of the verdict") + &Grid::of(&parameters).render(width()));
    }
    if !diagnosis.candidates.is_empty() {
        let names: Vec<String> = diagnosis.candidates.iter().map(|of| plain(&of.name)).collect();
        page.push(section("What was looked for") + &wrapped(&(names.join(", ") + ".")));
    }
    let departure = paragraphs(departure::sentences(diagnosis));
    if !departure.is_empty() {
        page.push(section("What the departure looks like") + &departure);
    }
    let composed = paragraphs(composed::sentences(diagnosis));
    if !composed.is_empty() {
        let title = section("What would explain it: composed, not from your list");
        let unlisted = composed::unlisted(diagnosis).map(|said| wrapped(&said));
        let unlisted = unlisted.unwrap_or_default();
        page.push(title + &composed + &wrapped(composed::HOW_TO_USE) + &unlisted);
    }
    page.push(section("How far does it shrink?") + &shrinkage(diagnosis));
    page.push(section("What to measure next") + &next(diagnosis));
    if let Some(rows) = &diagnosis.prediction {
        page.push(section("Corrected prediction") + &predictions(diagnosis, rows));
    }
    let plots = terminal::plots(diagnosis);
    if !plots.is_empty() {
        page.push(
            section("Residuals over their uncertainty u, before and after") + &plots.join("\n"),
        );
    }
    let notes = paragraphs(words::notes(diagnosis));
    if !notes.is_empty() {
        page.push(section("Notes") + &notes);
    }
    page.join("\n")
}

/// Title, settings and the verdict.
fn heading(diagnosis: &Diagnosis) -> String {
    let mut heading = wrapped(&words::title(diagnosis)) + &wrapped(&words::settings(diagnosis));
    heading.push('\n');
    heading += &wrapped(&words::verdict(diagnosis));
    heading += &words::interrupted(diagnosis).map(|said| wrapped(&said)).unwrap_or_default();
    heading += &paragraphs(words::conflicts(diagnosis));
    heading += &paragraphs(words::noise_verdict(diagnosis));
    heading += &words::present(diagnosis).map(|said| wrapped(&said)).unwrap_or_default();
    heading += &words::look_alikes(diagnosis).map(|said| wrapped(&said)).unwrap_or_default();
    heading += &words::copies(diagnosis).map(|said| wrapped(&said)).unwrap_or_default();
    heading
}

fn effects(described: Vec<words::DescribedInWords>) -> String {
    let one = |of: words::DescribedInWords| {
        let mut text = paragraphs(of.sentences);
        if !of.equations.is_empty() {
            text += &wrapped(words::EQUATIONS);
            text +=
                &of.equations.lines().map(|line| wrapped(&format!("  {line}"))).collect::<String>();
        }
        text
    };
    described.into_iter().map(one).collect()
}

/// The title of a section, underlined.
pub(super) fn section(title: &str) -> String {
    format!("{title}\n{}\n", "═".repeat(title.chars().count()))
}

fn paragraphs(sentences: Vec<String>) -> String {
    sentences.iter().map(|sentence| wrapped(sentence)).collect()
}

fn regions(diagnosis: &Diagnosis) -> String {
    match sheets::regions(diagnosis) {
        Some(sheet) => {
            let along = paragraphs(strength::sentences(diagnosis));
            Grid::of(&sheet).render(width()) + &wrapped(words::REGIONS) + &along
        }
        None => wrapped(words::no_region(diagnosis)),
    }
}

fn hypotheses(diagnosis: &Diagnosis) -> String {
    let mut text = Grid::of(&sheets::hypotheses(diagnosis)).render(width());
    text += &wrapped(words::ODDS);
    text += &sheets::left_out(diagnosis).map(|said| wrapped(&said)).unwrap_or_default();
    text
}

fn shrinkage(diagnosis: &Diagnosis) -> String {
    let mut text = Grid::of(&sheets::shrinkage(diagnosis)).render(width());
    text += &paragraphs(words::shrinkage(diagnosis));
    text += &paragraphs(words::noise(diagnosis));
    text
}

fn next(diagnosis: &Diagnosis) -> String {
    let proposals = sheets::next(diagnosis).map(|sheet| Grid::of(&sheet).render(width()));
    paragraphs(words::next(diagnosis)) + &proposals.unwrap_or_default()
}

/// One table for each output.
fn predictions(diagnosis: &Diagnosis, rows: &[Predicted]) -> String {
    let one = |output: usize| {
        let title = wrapped(&words::axis(&diagnosis.outputs[output]));
        let mut table = Grid::of(&sheets::prediction(diagnosis, rows, output, false));
        if table.natural_width() > width() {
            table = Grid::of(&sheets::prediction(diagnosis, rows, output, true));
        }
        title + &table.render(width())
    };
    let tables: Vec<String> = (0..diagnosis.outputs.len()).map(one).collect();
    tables.join("\n")
}
