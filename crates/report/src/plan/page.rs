//! The pages for a terminal, for a browser, and for GitHub.

use super::{PlanReport, figure, sheets, words};
use crate::document::{self, Block, Document};
use crate::printed::on_terminal;
use crate::{Grid, statement, table::width, wrapped};

/// The plan as a text page.
pub fn table(report: &PlanReport<'_>) -> String {
    on_terminal(|| {
        let plan = report.plan;
        let head = wrapped(&words::title(report)) + &wrapped(&words::target(report));
        let mut parts = vec![head];
        parts.push(Grid::of(&sheets::inputs(report)).render(width()) + &wrapped(words::ALONE));
        if let Some(cheapest) = &plan.cheapest {
            let heading = wrapped("Cheapest plan");
            parts.push(heading + &Grid::of(&sheets::cheapest(report, cheapest)).render(width()));
        }
        let notes: String = words::notes(report).iter().map(|said| wrapped(said)).collect();
        parts.push(notes);
        parts.extend(plan.interval.as_ref().map(|found| wrapped(&words::interval(report, found))));
        parts.retain(|part| !part.is_empty());
        parts.join("\n")
    })
}

fn document(report: &PlanReport<'_>) -> Document {
    let plan = report.plan;
    let mut document = Document { title: words::title(report), ..Document::default() };
    document.subtitle.extend(statement::sources(report.task.into()));
    document.blocks.push(Block::Verdict(vec![document::sentence(&words::target(report))]));
    document.section("One input alone");
    document.table(sheets::inputs(report));
    document.text(words::ALONE);
    document.figure(figure::inputs(report));
    if let Some(cheapest) = &plan.cheapest {
        document.section("Cheapest plan");
        document.table(sheets::cheapest(report, cheapest));
    }
    for said in words::notes(report) {
        document.text(said);
    }
    if let Some(found) = &plan.interval {
        document.section("Calibration interval");
        document.text(words::interval(report, found));
        document.figure(figure::interval(report, found));
    }
    if let Some(sheet) = statement::sheet(report.task.into()) {
        document.section("Measurement model");
        document.table(sheet);
    }
    if !report.warnings.is_empty() {
        document.section("Notes");
        document.blocks.push(Block::List(crate::words::lines(report.warnings)));
    }
    document
}

/// The plan as Markdown, as GitHub shows it.
pub fn markdown(report: &PlanReport<'_>) -> String {
    document::markdown(|| document(report))
}

/// The plan as one self-contained HTML file with figures.
pub fn html(report: &PlanReport<'_>) -> String {
    document::html(|| document(report))
}
