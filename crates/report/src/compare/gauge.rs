//! Repeatability and reproducibility of a gauge in each format.

use super::sheets::{has_name, in_unit};
use crate::answer::{list, object, pretty};
use crate::csv::{number, text};
use crate::number::{MISSING, significant};
use crate::plain;
use crate::sheet::Sheet;
use gumption_analysis::compare::GaugeStudy;
use gumption_analysis::compare::gauge::{LIMITS, ProcessIndices, StudyComponent};
use gumption_engine::task::Warning;
use serde_json::{Value, json};

/// Components that a reading has beside those of the part, with their names in budgets: for one reading
/// of any operator their squares add up.
fn of_budget(study: &GaugeStudy) -> impl Iterator<Item = &StudyComponent> {
    let named =
        |one: &&StudyComponent| ["repeatability", "operators", "interaction"].contains(&one.name);
    study.components.iter().filter(named).filter(|one| one.variance > 0.0)
}

fn percent(share: f64) -> String {
    significant(100.0 * share, 3)
}

/// The components in full precision, below the names of the columns.
pub(super) fn records(study: &GaugeStudy, unit: &str) -> Vec<Vec<String>> {
    let names = ["component", "symbol", "standard_deviation", "dof", "share_of_total"];
    let names = names.into_iter().chain(["share_of_tolerance", "unit"]).map(str::to_owned);
    let record = |one: &StudyComponent| {
        let (of_total, of_tolerance) = study.shares(one);
        let numbers = [Some(one.deviation()), Some(one.dof), Some(of_total), of_tolerance];
        let mut record = vec![text(one.name), text(one.symbol)];
        record.extend(numbers.map(number));
        record.push(text(unit));
        record
    };
    [names.collect()].into_iter().chain(study.components.iter().map(record)).collect()
}

/// The components as a table.
pub(super) fn sheet(study: &GaugeStudy, unit: &str) -> Sheet {
    let all = &study.components;
    let mut sheet = Sheet::default();
    sheet.text("component", all.iter().map(|one| format!("{} ({})", one.name, one.symbol)));
    sheet.numbers("standard deviation", all.iter().map(|one| significant(one.deviation(), 4)));
    if has_name(unit) {
        sheet.units("unit", all.iter().map(|_| plain(unit)));
    }
    let dof = |one: &StudyComponent| match one.variance > 0.0 {
        true => significant(one.dof, 3),
        false => MISSING.to_owned(),
    };
    sheet.numbers("degrees of freedom", all.iter().map(dof));
    let total = all.last().map_or(f64::NAN, |total| total.variance);
    sheet.numbers("% of variance", all.iter().map(|one| percent(one.variance / total)));
    sheet.numbers("% of TV", all.iter().map(|one| percent(study.shares(one).0)));
    if study.tolerance().is_some() {
        let share = |one| study.shares(one).1.map_or_else(|| MISSING.to_owned(), percent);
        sheet.numbers("% of tolerance", all.iter().map(share));
    }
    sheet
}

/// The analysis of variance as a table.
pub(super) fn squares(study: &GaugeStudy) -> Sheet {
    let all = &study.table;
    let mut sheet = Sheet::default();
    let or_missing = |value: Option<f64>| {
        value.map_or_else(|| MISSING.to_owned(), |value| significant(value, 4))
    };
    sheet.text("source", all.iter().map(|line| line.source.to_owned()));
    sheet.numbers("sum of squares", all.iter().map(|line| significant(line.sum, 5)));
    sheet.numbers("degrees of freedom", all.iter().map(|line| format!("{}", line.dof)));
    sheet.numbers("mean square", all.iter().map(|line| significant(line.mean(), 5)));
    sheet.numbers("F", all.iter().map(|line| or_missing(line.f)));
    sheet.numbers("p", all.iter().map(|line| or_missing(line.p)));
    sheet
}

/// The components as they stand in a model file.
pub(super) fn inputs(study: &GaugeStudy, unit: &str) -> String {
    let lines: Vec<String> = of_budget(study)
        .map(|one| {
            let (std, dof) = (significant(one.deviation(), 4), significant(one.dof, 3));
            let value = if has_name(unit) { format!("\"{std} {}\"", plain(unit)) } else { std };
            format!(
                "{{\"name\": \"{}\", \"distribution\": \"normal\", \"std\": {value}, \"dof\": {dof}, \
                 \"type\": \"A\"}}",
                one.name
            )
        })
        .collect();
    format!("As components of an input, for one reading by any operator: {}", lines.join(", "))
}

/// The result.
pub(super) fn verdict(study: &GaugeStudy, unit: &str) -> Vec<String> {
    let [parts, operators, readings] = study.counts;
    let gauge = study.component("gauge");
    let deviation = gauge.map_or(f64::NAN, StudyComponent::deviation);
    let (of_total, of_tolerance) = gauge.map_or((f64::NAN, None), |gauge| study.shares(gauge));
    let shares = match of_tolerance {
        Some(share) => {
            format!("{} % of TV and {} % of the tolerance", percent(of_total), percent(share))
        }
        None => format!("{} % of TV", percent(of_total)),
    };
    let deciding = study.deciding_share();
    let said = match LIMITS.map(|limit| deciding <= limit) {
        [true, _] => "acceptable",
        [_, true] => "may be acceptable, depending on the application",
        _ => "not acceptable",
    };
    let categories = study.categories().map_or_else(String::new, |count| {
        format!(" Number of distinct categories ndc = {count} (at least 5 are needed).")
    });
    let mut all = vec![format!(
        "GRR = {} ({shares}) from {parts} parts, {operators} operators and {readings} readings each: \
         {said} (AIAG).{categories}",
        in_unit(&significant(deviation, 4), unit)
    )];
    let indices = |names: [&str; 2], of: Option<ProcessIndices>| {
        let of = of?;
        let potential =
            of.potential.map(|value| format!("{} = {}", names[0], significant(value, 3)));
        let centred = format!("{} = {}", names[1], significant(of.centred, 3));
        Some(potential.into_iter().chain([centred]).collect::<Vec<_>>().join(", "))
    };
    let process: Vec<String> =
        [indices(["Cp", "Cpk"], study.of_parts()), indices(["Pp", "Ppk"], study.of_total())]
            .into_iter()
            .flatten()
            .collect();
    if !process.is_empty() {
        let ratio = study.capability_ratio().map_or_else(String::new, |ratio| {
            format!(
                " Capability ratio of the measurement process (VDA 5) Q_MP = {} %.",
                percent(ratio)
            )
        });
        all.push(format!("Process: {}.{ratio}", process.join(", ")));
    }
    all
}

/// What the numbers are.
pub(super) fn explained(study: &GaugeStudy) -> String {
    let model = match study.has_interaction {
        true => "with the interaction of operators and parts",
        false => "with the interaction pooled with repeatability",
    };
    format!(
        "By analysis of variance of two crossed random factors {model} (AIAG, Measurement Systems Analysis, \
         4th ed.): repeatability EV, operators AV, gauge GRR, parts PV, total TV; a negative estimate of a \
         variance is 0. Degrees of freedom are by Welch and Satterthwaite. Shares of the tolerance are those \
         of six standard deviations. Up to 10 % the gauge is acceptable, above 30 % it is not. Cp and Cpk \
         have the standard deviation PV of the parts alone, Pp and Ppk that of all that is seen, TV. Q_MP = \
         2 U/tolerance with U = 2 GRR lacks the calibration and the bias."
    )
}

/// The study as JSON, ending in a newline.
pub(super) fn json(study: &GaugeStudy, unit: &str, said: &[Warning]) -> String {
    let [parts, operators, readings] = study.counts;
    let lines = study.table.iter().map(|line| {
        json!({
            "source": line.source, "sum_of_squares": line.sum, "dof": line.dof,
            "mean_square": line.mean(), "f": line.f, "p": line.p,
        })
    });
    let components = study.components.iter().map(|one| {
        let (of_total, of_tolerance) = study.shares(one);
        json!({
            "name": one.name, "symbol": one.symbol, "standard_deviation": one.deviation(),
            "dof": one.dof, "share_of_total": of_total, "share_of_tolerance": of_tolerance,
        })
    });
    let (process, seen) = (study.of_parts(), study.of_total());
    let unit = if has_name(unit) { Value::from(unit) } else { Value::Null };
    pretty(&object([
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("scheme", "gauge-rr".into()),
        ("unit", unit),
        ("parts", (parts as u64).into()),
        ("operators", (operators as u64).into()),
        ("readings", (readings as u64).into()),
        ("mean", study.mean.into()),
        ("anova", list(lines)),
        ("interaction", study.has_interaction.into()),
        ("components", list(components)),
        ("ndc", study.categories().into()),
        ("acceptable", study.is_acceptable().into()),
        ("cp", process.and_then(|of| of.potential).into()),
        ("cpk", process.map(|of| of.centred).into()),
        ("pp", seen.and_then(|of| of.potential).into()),
        ("ppk", seen.map(|of| of.centred).into()),
        ("q_mp", study.capability_ratio().into()),
        ("warnings", crate::words::listed(said)),
    ]))
}
