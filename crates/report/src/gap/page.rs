//! The page of a diagnosis as a document, which all looks draw.

use super::{composed, departure, digits, html, sheets, strength, terminal, words};
use crate::document::{self, Block, Document};
use crate::sheet::Sheet;
use crate::statement;
use crate::table::width;
use crate::{Grid, Provenance, plain};
use gumption_gap::Diagnosis;

/// The diagnosis as a page for a terminal of at most 100 columns, or as many as it has
/// ([`crate::within_width`]).
pub fn table(diagnosis: &Diagnosis, provenance: &Provenance) -> String {
    document::text(|| document(diagnosis, provenance, true))
}

/// All that the page says, with figures; where it `is_terminal` they are in characters.
pub(super) fn document(
    diagnosis: &Diagnosis,
    provenance: &Provenance,
    is_terminal: bool,
) -> Document {
    let mut page = Document {
        title: words::title(diagnosis),
        subtitle: vec![words::settings(diagnosis)],
        terminal: is_terminal,
        ..Document::default()
    };
    let mut verdict = vec![words::verdict(diagnosis)];
    verdict.extend(words::interrupted(diagnosis));
    verdict.extend(words::conflicts(diagnosis));
    verdict.extend(words::noise_verdict(diagnosis));
    verdict.extend(words::present(diagnosis));
    verdict.extend(words::look_alikes(diagnosis));
    verdict.extend(words::copies(diagnosis));
    page.blocks.push(Block::Verdict(verdict));
    statement::section(&mut page, words::SIM, words::sim(diagnosis));
    page.section("Measured and predicted values");
    for output in 0..diagnosis.outputs.len() {
        let in_characters = || terminal::overlay(diagnosis, output);
        page.picture(|| html::overlay(diagnosis, output), in_characters);
    }
    effect(&mut page, diagnosis);
    page.section("Is there a gap?");
    page.text(words::gap(diagnosis));
    words::validation(diagnosis).into_iter().for_each(|said| page.text(said));
    page.section("Where?");
    match sheets::regions(diagnosis) {
        Some(sheet) => {
            page.table(sheet);
            page.text(words::REGIONS);
            strength::sentences(diagnosis).into_iter().for_each(|said| page.text(said));
        }
        None => page.text(words::no_region(diagnosis)),
    }
    page.picture(|| html::where_map(diagnosis), || None);
    if let Some(sheet) = sheets::present(diagnosis) {
        page.section("Probability of each effect");
        page.table(sheet);
    }
    if let Some(sheet) = sheets::replication(diagnosis) {
        page.section("Sizes in each group");
        page.text(words::REPLICATION);
        page.table(sheet);
    }
    page.section("Combinations of effects");
    page.table(sheets::hypotheses(diagnosis));
    page.text(words::ODDS);
    if let Some(said) = sheets::left_out(diagnosis) {
        page.text(said);
    }
    page.picture(|| Some(html::bars(diagnosis)), || None);
    page.picture(|| html::intervals(diagnosis), || None);
    let departure = departure::sentences(diagnosis);
    if !departure.is_empty() {
        page.section("Form of the departure");
        page.blocks.push(Block::List(departure));
    }
    let composed = composed::sentences(diagnosis);
    if !composed.is_empty() {
        page.section("Composed effects that would explain the gap");
        page.blocks.push(Block::List(composed));
        page.text(composed::HOW_TO_USE);
        composed::unlisted(diagnosis).into_iter().for_each(|said| page.text(said));
    }
    page.section("Reduction of the gap");
    page.table(sheets::shrinkage(diagnosis));
    words::shrinkage(diagnosis).into_iter().for_each(|said| page.text(said));
    words::noise(diagnosis).into_iter().for_each(|said| page.text(said));
    page.picture(|| html::shares(diagnosis), || None);
    page.picture(|| html::shrinkage(diagnosis), || None);
    for output in 0..diagnosis.outputs.len() {
        let in_characters = || terminal::residuals(diagnosis, output);
        page.picture(|| html::residuals(diagnosis, output), in_characters);
    }
    page.section("What to measure next");
    words::next(diagnosis).into_iter().for_each(|said| page.text(said));
    if let Some(sheet) = sheets::next(diagnosis) {
        page.table(sheet);
    }
    predictions(&mut page, diagnosis);
    let notes = words::notes(diagnosis);
    if !notes.is_empty() {
        page.section("Notes");
        page.blocks.push(Block::List(notes));
    }
    let settings = [
        ("seed", diagnosis.seed.to_string()),
        ("coverage probability", digits::percent(diagnosis.probability)),
    ];
    repeat(&mut page, &settings, provenance);
    page
}

/// What the effects of the verdict are, and what else was looked for.
fn effect(page: &mut Document, diagnosis: &Diagnosis) {
    let described = words::effects(diagnosis);
    if !described.is_empty() {
        page.section("Description of the effects");
    }
    for words::DescribedInWords { sentences, equations } in described {
        sentences.into_iter().for_each(|said| page.text(said));
        if !equations.is_empty() {
            let about = words::EQUATIONS.to_owned();
            page.blocks.push(Block::Listing { about, text: equations });
        }
    }
    if let Some(sheet) = sheets::parameters(diagnosis) {
        page.section("Parameters of the verdict");
        page.table(sheet);
    }
    if let Some((said, sheet)) =
        words::run_at_verdict(diagnosis).zip(sheets::run_at_verdict(diagnosis))
    {
        page.section("Simulator run at the verdict");
        page.text(said);
        page.table(sheet);
    }
    if let Some(sheet) = sheets::candidates(diagnosis) {
        page.section("Candidate effects");
        page.table(sheet);
    }
}

fn predictions(page: &mut Document, diagnosis: &Diagnosis) {
    let Some(rows) = &diagnosis.prediction else { return };
    page.section("Corrected prediction");
    for output in 0..diagnosis.outputs.len() {
        page.text(format!("{}:", words::axis(&diagnosis.outputs[output])));
        let sheet = |joined: bool| sheets::prediction(diagnosis, rows, output, joined);
        let too_wide = page.terminal && Grid::of(&sheet(false)).natural_width() > width();
        page.table(sheet(too_wide));
        page.picture(|| html::predictions(diagnosis, rows, output), || None);
    }
}

/// Everything that is needed to get the same answer again; `settings` are those of the command, with
/// their names.
pub(super) fn repeat(page: &mut Document, settings: &[(&str, String)], provenance: &Provenance) {
    let mut lines = vec![("program".to_owned(), format!("gumption {}", env!("CARGO_PKG_VERSION")))];
    lines.extend(settings.iter().map(|(name, value)| ((*name).to_owned(), value.clone())));
    lines.push(("case file, SHA-256".to_owned(), provenance.model_sha256.clone()));
    let files = provenance.files.iter();
    lines.extend(files.map(|(name, digest)| (format!("{}, SHA-256", plain(name)), digest.clone())));
    let (names, values): (Vec<_>, Vec<_>) = lines.into_iter().unzip();
    let mut sheet = Sheet::default();
    sheet.text("what", names);
    sheet.text("value", values);
    page.section("Reproducing this result");
    page.table(sheet);
    page.text("The same program, files and seed give the same numbers on any number of threads.");
}
