//! Published values recomputed, in the formats of the answer.

mod words;

use std::fmt::Write;

use serde::Serialize;

pub use words::words;

use crate::answer::pretty;
use crate::csv::of_records;
use crate::document::{self, Block, Document};
use crate::number::{MISSING, align, exact, position, rounded, significant};
use crate::sheet::Sheet;
use crate::table::{Grid, text_width, width};
use gumption_analysis::verification::{PublishedVerdict, RecomputedExample, RecomputedValue};
use gumption_engine::task::Trials;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Significant digits of a tolerance; recomputed values are rounded to match.
const TOLERANCE_DIGITS: u32 = 2;

#[derive(Serialize)]
struct VerificationAnswer<'a> {
    gumption: &'static str,
    rows: Vec<VerificationLine<'a>>,
    pass: usize,
    diff: usize,
}

#[derive(Serialize)]
struct VerificationLine<'a> {
    example: &'a str,
    output: Option<&'a str>,
    quantity: &'a str,
    published: f64,
    tolerance: f64,
    got: Option<f64>,
    verdict: &'static str,
}

impl<'a> VerificationLine<'a> {
    fn of(example: &'a str, row: &'a RecomputedValue) -> Self {
        Self {
            example,
            output: row.published.output.as_deref(),
            quantity: &row.published.path,
            published: row.published.value,
            tolerance: row.published.tolerance,
            got: row.got,
            verdict: row.verdict.text(),
        }
    }
}

fn lines(found: &[RecomputedExample]) -> impl Iterator<Item = VerificationLine<'_>> {
    found.iter().flat_map(|e| e.rows.iter().map(|row| VerificationLine::of(&e.name, row)))
}

/// The numbers of values that agree and that do not.
fn counts(found: &[RecomputedExample]) -> (usize, usize) {
    let verdicts = || found.iter().flat_map(|e| &e.rows).map(|row| row.verdict);
    let pass = verdicts().filter(|v| *v == PublishedVerdict::Pass).count();
    (pass, verdicts().count() - pass)
}

/// The answer for programs: indented JSON that ends in a newline.
pub fn json(found: &[RecomputedExample]) -> String {
    let (pass, diff) = counts(found);
    let answer = VerificationAnswer { gumption: VERSION, rows: lines(found).collect(), pass, diff };
    pretty(&answer)
}

/// The values as comma-separated values, one line for each.
pub fn csv(found: &[RecomputedExample]) -> String {
    of_records(|writer| lines(found).try_for_each(|line| writer.serialize(line)))
}

/// Published value, tolerance and recomputed value as text.
fn figures(row: &RecomputedValue) -> [String; 3] {
    let RecomputedValue { published, got, .. } = row;
    let got = match (got, position(published.tolerance, TOLERANCE_DIGITS)) {
        (None, _) => MISSING.to_owned(),
        (Some(got), Some(position)) => rounded(*got, position),
        (Some(got), None) => exact(*got),
    };
    [exact(published.value), significant(published.tolerance, TOLERANCE_DIGITS), got]
}

/// The page for a terminal: a block for each example, with aligned columns.
pub fn table(found: &[RecomputedExample]) -> String {
    let header = ["output", "quantity", "published", "tolerance", "recomputed", ""];
    let blocks: Vec<Vec<[String; 6]>> = found.iter().map(cells).collect();
    let mut widths = header.map(str::len);
    for cells in blocks.iter().flatten() {
        for (width, cell) in widths.iter_mut().zip(cells) {
            *width = (*width).max(cell.chars().count());
        }
    }
    let line = |cells: [&str; 6]| {
        let mut line = String::from(" ");
        for (position, (cell, width)) in cells.iter().zip(widths).enumerate() {
            // numbers are right-aligned in their column
            let _ = match position {
                2..=4 => write!(line, " {cell:>width$} "),
                _ => write!(line, " {cell:width$} "),
            };
        }
        line.trim_end().to_owned() + "\n"
    };
    let whole = widths.iter().map(|width| width + 2).sum::<usize>();
    if whole > width() {
        return folded(found, (&header, &blocks));
    }
    let mut page = line(header);
    let _ = writeln!(page, "{}", "─".repeat(widths.iter().map(|w| w + 2).sum::<usize>() - 1));
    for (example, block) in found.iter().zip(&blocks) {
        page += &wrapped(&format!("{}: {}", example.name, example.source), "");
        for cells in block {
            page += &line(cells.each_ref().map(String::as_str));
        }
        page += &reasons(example);
        if let Some(failure) = &example.failure {
            page += &wrapped(failure, "  ");
        }
    }
    page.push('\n');
    page += &wrapped(&summary(found), "");
    page
}

/// The page for a terminal that is too narrow for all columns: every example has its own table.
fn folded(
    found: &[RecomputedExample],
    (header, blocks): (&[&str; 6], &[Vec<[String; 6]>]),
) -> String {
    let mut page = String::new();
    for (example, block) in found.iter().zip(blocks) {
        page += &wrapped(&format!("{}: {}", example.name, example.source), "");
        let mut grid = Grid::default();
        for (place, name) in header.iter().enumerate() {
            let cells = block.iter().map(|cells| cells[place].clone());
            match place {
                2..=4 => grid.numbers(name, cells.map(|cell| cell.trim().to_owned())),
                _ => grid.text(name, cells),
            }
        }
        if !block.is_empty() {
            page += &grid.render(width());
        }
        page += &reasons(example);
        if let Some(failure) = &example.failure {
            page += &wrapped(failure, "  ");
        }
        page.push('\n');
    }
    page + &wrapped(&summary(found), "")
}

/// A tolerance of more than this fraction of the published value is wide: not even one digit of it
/// is certain.
const WIDE: f64 = 0.05;

/// The reasons for wide tolerances, each once.
fn reasons(example: &RecomputedExample) -> String {
    let mut said: Vec<String> = Vec::new();
    let is_wide = |row: &&RecomputedValue| {
        row.published.tolerance > WIDE * row.published.value.abs() && !row.published.why.is_empty()
    };
    for row in example.rows.iter().filter(is_wide) {
        let reason = line(&row.published.why);
        if !said.contains(&reason) {
            said.push(reason);
        }
    }
    said.iter().map(|reason| wrapped(&format!("tolerance from: {reason}"), "   ")).collect()
}

/// The lines of an example, with aligned decimal points.
fn cells(example: &RecomputedExample) -> Vec<[String; 6]> {
    let figures: Vec<[String; 3]> = example.rows.iter().map(figures).collect();
    let column =
        |position: usize| align(&figures.iter().map(|row| &row[position]).collect::<Vec<_>>());
    let numbers = [column(0), column(1), column(2)];
    let rows = example.rows.iter().enumerate().map(|(position, row)| {
        let [published, tolerance, got] = numbers.each_ref().map(|column| column[position].clone());
        let output = row.published.output.clone().unwrap_or_default();
        let verdict = row.verdict.text().to_owned();
        [output, row.words.clone(), published, tolerance, got, verdict]
    });
    rows.collect()
}

/// A paragraph with lines of limited length.
fn wrapped(text: &str, indent: &str) -> String {
    let mut page = String::new();
    let mut line = indent.to_owned();
    for word in text.split_whitespace() {
        let begun = line.len() > indent.len();
        if begun && line.chars().count() + 1 + word.chars().count() > text_width() {
            page += &line;
            page.push('\n');
            line = format!("{indent}  ");
        } else if begun {
            line.push(' ');
        }
        line += word;
    }
    page + &line + "\n"
}

fn summary(found: &[RecomputedExample]) -> String {
    let (pass, diff) = counts(found);
    let examples = found.len();
    let verdict = match diff {
        0 => "all agree".to_owned(),
        1 => format!("{pass} agree, 1 differs"),
        _ => format!("{pass} agree, {diff} differ"),
    };
    let values = pass + diff;
    format!("gumption {VERSION}: {values} published values of {examples} examples, {verdict}.")
}

/// A page for the records, in Markdown.
pub fn markdown(found: &[RecomputedExample]) -> String {
    document::markdown(|| page(found))
}

/// The same page as one self-contained HTML file.
pub fn html(found: &[RecomputedExample]) -> String {
    document::html(|| page(found))
}

fn page(found: &[RecomputedExample]) -> Document {
    let title = "Published examples, recomputed".to_owned();
    let mut page = Document { title, subtitle: vec![summary(found)], ..Document::default() };
    page.text(
        "Each published value is compared with what gumption computes from the example's model \
         file: PASS if the difference is within the tolerance, DIFF otherwise. The command verify \
         repeats this on any machine (ISO/IEC 17025, 7.11).",
    );
    for example in found {
        page.section(&example.name);
        page.sentence(&line(&example.source));
        page.blocks.extend(trials(example).map(Block::Text));
        if let Some(failure) = &example.failure {
            page.text(format!("Not evaluated: {}.", line(failure)));
        }
        let rows = || example.rows.iter();
        let figures: Vec<[String; 3]> = rows().map(figures).collect();
        let column = |place: usize| figures.iter().map(move |row| row[place].clone());
        let mut sheet = Sheet::default();
        let output = |row: &RecomputedValue| row.published.output.clone().unwrap_or_default();
        sheet.text("output", rows().map(output));
        sheet.text("quantity", rows().map(|row| row.words.clone()));
        sheet.numbers("published", column(0));
        sheet.numbers("tolerance", column(1));
        sheet.numbers("recomputed", column(2));
        sheet.text("verdict", rows().map(|row| row.verdict.text().to_owned()));
        sheet.text("tolerance comes from", rows().map(|row| line(&row.published.why)));
        page.table(sheet);
        if !example.notes.is_empty() {
            page.text(line(&example.notes));
        }
    }
    page
}

fn trials(example: &RecomputedExample) -> Option<String> {
    let (trials, seed) = example.trials?;
    Some(match trials {
        Trials::Fixed(count) => format!("{count} Monte Carlo trials, seed {seed}."),
        Trials::Adaptive => format!("Adaptive Monte Carlo (JCGM 101, 7.9), seed {seed}."),
    })
}

/// A text in one line.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
