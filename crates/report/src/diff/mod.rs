//! Two compared files in the formats of the answer.

mod figure;

use serde::Serialize;

use crate::answer::{in_order, pretty};
use crate::document::{self, Document};
use crate::number::{
    MISSING, degrees_of_freedom, exact, justified, position, rounded, significant, to,
    with_uncertainty,
};
use crate::printed::on_terminal;
use crate::sheet::Sheet;
use crate::table::unit_text;
use crate::{Grid, plain, table::width, wrapped};
use gumption_analysis::diff::{
    ByTrials, ChangeCause, ChangePart, Difference, InputState, OutputDifference, RowDifference,
};
use gumption_units::Unit;

/// Significant digits of uncertainties.
const DIGITS: u32 = 2;

#[derive(Serialize)]
struct DiffAnswer<'a> {
    gumption: &'static str,
    a: &'a str,
    b: &'a str,
    changes: &'a [String],
    #[serde(flatten)]
    results: DiffResults<'a>,
}

type Outputs<'a> = Vec<(&'a str, DiffOutput<'a>)>;

#[derive(Serialize)]
#[serde(untagged)]
enum DiffResults<'a> {
    Single {
        #[serde(serialize_with = "in_order")]
        outputs: Outputs<'a>,
    },
    Swept {
        rows: Vec<DiffRow<'a>>,
    },
}

#[derive(Serialize)]
struct DiffRow<'a> {
    #[serde(serialize_with = "in_order")]
    conditions: Vec<(&'a str, f64)>,
    #[serde(serialize_with = "in_order")]
    outputs: Outputs<'a>,
}

#[derive(Serialize)]
struct DiffOutput<'a> {
    unit: &'a str,
    #[serde(rename = "U")]
    expanded: [Option<f64>; 2],
    /// Half the lengths of the trials' symmetric intervals.
    #[serde(rename = "U_by_trials")]
    by_trials: [Option<f64>; 2],
    /// Whether clause 8 says that U is valid.
    gum_valid: [Option<bool>; 2],
    inputs: Vec<InputChange<'a>>,
}

#[derive(Serialize)]
struct InputChange<'a> {
    /// The input; null for what is none.
    input: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    what: Option<&'static str>,
    from: Option<InputEntry<'a>>,
    to: Option<InputEntry<'a>>,
    #[serde(rename = "change_of_U")]
    change: Option<f64>,
    share_of_change: Option<f64>,
}

#[derive(Serialize)]
struct InputEntry<'a> {
    estimate: f64,
    standard_uncertainty: f64,
    distribution: &'a str,
    dof: Option<f64>,
    unit: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    sensitivity: Option<f64>,
}

impl<'a> From<&'a InputState> for InputEntry<'a> {
    fn from(state: &'a InputState) -> Self {
        Self {
            estimate: state.estimate,
            standard_uncertainty: state.standard_uncertainty,
            distribution: &state.distribution,
            dof: state.dof.is_finite().then_some(state.dof),
            unit: &state.unit,
            sensitivity: state.sensitivity,
        }
    }
}

/// The name of an input, or what else a part is due to.
fn due(part: &ChangePart) -> (Option<&str>, Option<&'static str>) {
    match &part.due {
        ChangeCause::Input(name) => (Some(name), None),
        ChangeCause::Correlations => (None, Some("correlations")),
        ChangeCause::Coverage => (None, Some("coverage")),
        ChangeCause::Model => (None, Some("model")),
        ChangeCause::Rest => (None, Some("other")),
    }
}

impl<'a> InputChange<'a> {
    fn of(part: &'a ChangePart) -> Self {
        let (input, what) = due(part);
        let [from, to] = part.states.each_ref().map(|state| state.as_ref().map(InputEntry::from));
        Self { input, what, from, to, change: part.change, share_of_change: part.share }
    }
}

fn outputs(row: &RowDifference) -> Outputs<'_> {
    let outputs = row.outputs.iter().map(|output| {
        let inputs = output.parts.iter().map(InputChange::of).collect();
        let (unit, expanded) = (output.unit.as_str(), output.expanded);
        let by_trials = output.by_trials.map(|of| of.map(|of| of.half_length));
        let gum_valid = output.by_trials.map(|of| of?.gum_valid);
        (output.name.as_str(), DiffOutput { unit, expanded, by_trials, gum_valid, inputs })
    });
    outputs.collect()
}

/// The answer for programs.
pub fn json([a, b]: [&str; 2], difference: &Difference) -> String {
    let results = match difference.rows.as_slice() {
        [row] if !difference.swept => DiffResults::Single { outputs: outputs(row) },
        rows => {
            let rows = rows.iter().map(|row| {
                let conditions = row.conditions.iter().map(|(n, value, _)| (n.as_str(), *value));
                DiffRow { conditions: conditions.collect(), outputs: outputs(row) }
            });
            DiffResults::Swept { rows: rows.collect() }
        }
    };
    let gumption = env!("CARGO_PKG_VERSION");
    let answer = DiffAnswer { gumption, a, b, changes: &difference.changes, results };
    pretty(&answer)
}

/// The same in GitHub Flavored Markdown.
pub fn markdown(names: [&str; 2], difference: &Difference) -> String {
    document::markdown(|| paper(names, difference))
}

/// The same as one HTML file that needs nothing else.
pub fn html(names: [&str; 2], difference: &Difference) -> String {
    document::html(|| paper(names, difference))
}

/// What changed as a document.
fn paper([a, b]: [&str; 2], difference: &Difference) -> Document {
    let mut paper = Document {
        title: plain(&format!("From {a} to {b}")),
        subtitle: difference.changes.iter().map(|change| plain(change)).collect(),
        ..Document::default()
    };
    for row in &difference.rows {
        for output in &row.outputs {
            paper.section(plain(&heading(output, &place(difference, row))));
            if let Some(said) = by_trials(output) {
                paper.text(said);
            }
            match changes(output) {
                Some(sheet) => {
                    paper.figure(figure::waterfall(output));
                    paper.table(sheet);
                }
                None => paper.text(NONE_CHANGED),
            }
            if is_not_shared_out(output) {
                paper.text(NOT_SHARED_OUT);
            }
        }
    }
    if difference.rows.iter().all(|row| row.outputs.is_empty()) {
        paper.text(NOTHING_IN_COMMON);
    }
    paper
}

const NONE_CHANGED: &str = "No input changed.";
const NOTHING_IN_COMMON: &str = "The files have no output in common, or no row of conditions.";
const NOT_SHARED_OUT: &str =
    "The change cannot be shared out: between the two files U is not defined everywhere.";

/// " at f = 80 Hz"
fn place(difference: &Difference, row: &RowDifference) -> String {
    let at: Vec<String> = row
        .conditions
        .iter()
        .map(|(name, value, unit)| format!("{name} = {} {unit}", exact(*value)))
        .collect();
    if difference.swept { format!(" at {}", at.join(", ")) } else { String::new() }
}

/// The page for a terminal. Inputs that did not change are left out.
pub fn table([a, b]: [&str; 2], difference: &Difference) -> String {
    on_terminal(|| {
        let mut page = vec![wrapped(&format!("from {a} to {b}"))];
        if !difference.changes.is_empty() {
            page.push(difference.changes.iter().map(|change| wrapped(change)).collect());
        }
        for row in &difference.rows {
            let at = place(difference, row);
            page.extend(row.outputs.iter().map(|output| section(output, &at)));
        }
        if difference.rows.iter().all(|row| row.outputs.is_empty()) {
            page.push(wrapped(NOTHING_IN_COMMON));
        }
        page.join("\n")
    })
}

fn section(output: &OutputDifference, at: &str) -> String {
    let mut text = wrapped(&heading(output, at));
    if let Some(said) = by_trials(output) {
        text += &wrapped(&said);
    }
    let Some(sheet) = changes(output) else { return text + &wrapped(NONE_CHANGED) };
    text += &Grid::of(&sheet).render(width());
    if is_not_shared_out(output) {
        text += &wrapped(NOT_SHARED_OUT);
    }
    text
}

fn is_not_shared_out(output: &OutputDifference) -> bool {
    output.parts.iter().any(|part| part.is_changed() && part.change.is_none())
}

/// The inputs that changed; `None` if none did.
fn changes(output: &OutputDifference) -> Option<Sheet> {
    let changed = || output.parts.iter().filter(|part| part.is_changed());
    changed().next()?;
    // all to the position that the largest change deserves
    let largest = changed().filter_map(|part| part.change).map(f64::abs).fold(0.0, f64::max);
    let last = position(largest, DIGITS + 1);
    let change = |part: &ChangePart| part.change.map_or_else(missing, |change| to(change, last));
    let share =
        |part: &ChangePart| part.share.map_or_else(missing, |share| rounded(100.0 * share, -1));
    let mut sheet = Sheet::default();
    sheet.text("what changed", changed().map(|part| cause(part).to_owned()));
    sheet.text("from", changed().map(|part| known(part, 0)));
    sheet.text("to", changed().map(|part| known(part, 1)));
    let header = match unit_of(output).as_str() {
        "" => "change\nof U".to_owned(),
        unit => format!("change of\nU in {unit}"),
    };
    sheet.numbers(&header, changed().map(change));
    sheet.numbers("share\nin %", changed().map(share));
    Some(sheet)
}

/// Degrees of freedom to three digits.
fn three_digits(dof: f64) -> String {
    if dof.fract() == 0.0 { exact(dof) } else { significant(dof, 3) }
}

fn missing() -> String {
    MISSING.to_owned()
}

/// The unit behind a number; nothing of plain numbers.
fn unit_of(output: &OutputDifference) -> String {
    match Unit::parse(&output.unit) {
        Ok(unit) if !unit.has_name() => String::new(),
        Ok(unit) => unit_text(&unit.of_differences()),
        Err(_) => plain(&output.unit),
    }
}

/// The input, or what else a part of the change is due to.
fn cause(part: &ChangePart) -> &str {
    let (input, what) = due(part);
    input.or(what).unwrap_or("")
}

/// A change in per cent, in brackets; nothing where it is none of a number above zero.
fn relative(change: [Option<f64>; 2]) -> String {
    match change {
        [Some(from), Some(to)] if from > 0.0 => {
            let percent = 100.0 * (to / from - 1.0);
            let sign = if percent < 0.0 { "" } else { "+" };
            format!(" ({sign}{} %)", rounded(percent, -1))
        }
        _ => String::new(),
    }
}

/// Name, U before and after, and its relative change.
fn heading(output: &OutputDifference, at: &str) -> String {
    let expanded = output.expanded.map(|u| u.map_or_else(missing, |u| significant(u, 3)));
    let [from, to] = expanded;
    let (name, unit) = (&output.name, unit_of(output));
    let change = format!("{name}{at}: U from {from} to {to} {unit}").trim_end().to_owned();
    change + &relative(output.expanded) + ", by the law of propagation"
}

/// The half-lengths of the trials if clause 8 does not validate U.
fn by_trials(output: &OutputDifference) -> Option<String> {
    let refuted = output.by_trials.map(|of| of.is_some_and(|of| of.gum_valid == Some(false)));
    let files = match refuted {
        [true, true] => "in either file",
        [true, false] => "in the first file",
        [false, true] => "in the second file",
        [false, false] => return None,
    };
    let figure = |of: ByTrials| {
        justified(of.half_length, position(of.half_length, 3), of.numerical_standard_error)
    };
    let [from, to] = output.by_trials.map(|of| of.map_or_else(missing, figure));
    let change = relative(output.by_trials.map(|of| of.map(|of| of.half_length)));
    let goes = format!("from {from} to {to} {}", unit_of(output)).trim_end().to_owned() + &change;
    Some(format!(
        "U is not validated {files} (JCGM 101, clause 8): half the length of the trials' coverage interval \
         goes {goes}. The changes below are changes of U."
    ))
}

/// What is known of an input in one of the files.
fn known(part: &ChangePart, side: usize) -> String {
    if !matches!(part.due, ChangeCause::Input(_)) {
        return String::new();
    }
    let Some(state) = part.states.get(side).and_then(Option::as_ref) else {
        return "absent".to_owned();
    };
    let unit = if matches!(state.unit.trim(), "" | "1") { "" } else { &state.unit };
    let InputState { estimate, standard_uncertainty: u, distribution, dof, .. } = state;
    if *u == 0.0 {
        return format!("{} {unit}", exact(*estimate)).trim_end().to_owned() + ", known exactly";
    }
    let (estimate, u) = with_uncertainty(*estimate, *u, DIGITS);
    let dof = if dof.is_finite() {
        format!(", {}", degrees_of_freedom(&three_digits(*dof)))
    } else {
        String::new()
    };
    // where it moved, as it is then a reason
    let sensitivities = part.states.each_ref().map(|s| s.as_ref().and_then(|s| s.sensitivity));
    let sensitivity = match (state.sensitivity, sensitivities) {
        (Some(c), [Some(from), Some(to)]) if from != to => {
            format!(", sensitivity {}", significant(c, 4))
        }
        _ => String::new(),
    };
    format!("{estimate} {unit}").trim_end().to_owned()
        + &format!(", u {u}, {distribution}{dof}{sensitivity}")
}
