//! The certificate for programs.

use super::functions::At;
use super::layout::{self, TitledSheet};
use super::sentences::{SentenceLanguage, SentencePlace};
use super::stated::{self, StatedRow};
use super::{
    CertificateReport, administrative, functions, measurement, regions, sentences, trials_made,
};
use crate::answer::{list, object, pretty};
use crate::fits::{self, FitSide};
use crate::json::decision_value;
use crate::sheet::Figure;
use gumption_analysis::certificate::contents::StatedFunction;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::task::Trials;
use serde_json::Value;

/// The certificate as JSON, keys in a fixed order; `null` means infinite or undefined. `stated` has
/// the texts that every format prints, the other numbers have all digits. It ends in a newline.
pub fn json(report: &CertificateReport<'_>) -> String {
    let CertificateReport { certificate, issued, .. } = report;
    let languages = &certificate.languages;
    let title = administrative::title(report);
    let rows = stated::rows(report);
    let about = administrative::lines(report);
    let statements = SentenceLanguage::on_page(report).into_iter().map(|of| {
        let said = sentences::coverage(report, of, SentencePlace::Table);
        (of.language.code(), list(said.iter().map(|said| Value::from(said.as_str()))))
    });
    let matrix = issued.correlations.iter();
    let matrix = matrix.map(|row| list(row.iter().map(|r| Value::from(*r))));
    let mut answer = vec![
        ("gumption", Value::from(env!("CARGO_PKG_VERSION"))),
        ("title", title.as_str().into()),
        (
            "particulars",
            object(about.iter().map(|(name, text)| (name.as_str(), Value::from(text.as_str())))),
        ),
        ("administrative", administrative::for_programs(report)),
        ("language", list(languages.iter().map(|language| language.code()))),
        ("rounding", certificate.rounding.name().into()),
        ("digits", u64::from(certificate.digits).into()),
        ("rows", list(rows.iter().map(|row| one(report, row)))),
        ("correlations", list(matrix)),
        ("statements", object(statements)),
        ("measurement", measured(report)),
        ("warnings", crate::words::listed(report.warnings)),
        ("provenance", provenance(report)),
    ];
    if !certificate.layout.is_empty() {
        answer.push(("tables", list(layout::tables(report).iter().map(laid_out))));
    }
    let covered: Vec<Value> = regions::covered(report).iter().map(|of| of.json()).collect();
    if !covered.is_empty() {
        answer.push(("regions", covered.into()));
    }
    if !certificate.functions.is_empty() {
        let functions = certificate.functions.iter().map(|of| function(report, of));
        answer.insert(8, ("functions", list(functions)));
    }
    pretty(&object(answer))
}

/// A table of the layout as every page shows it, with decimal points.
fn laid_out(table: &TitledSheet) -> Value {
    let columns = table.sheet.columns.iter().map(|column| {
        object([
            ("heading", Value::from(column.header.replace('\n', " "))),
            ("cells", list(column.cells.iter().map(|cell| Value::from(cell.as_str())))),
        ])
    });
    object([("title", Value::from(table.title.as_str())), ("columns", list(columns))])
}

/// The equations of the models and their symbols.
fn measured(report: &CertificateReport<'_>) -> Value {
    let models = measurement::stated(report).into_iter().map(|(place, of)| {
        let model = report.models.get(place).map_or("", |model| model.name);
        let equations = of.equations.iter();
        let equations = equations.map(|[name, text]| (name.as_str(), Value::from(text.as_str())));
        let symbols = of.symbols.iter().map(|[name, meaning, unit]| {
            let about = object([
                ("meaning", Value::from(meaning.as_str())),
                ("unit", unit.as_str().into()),
            ]);
            (name.as_str(), about)
        });
        object([
            ("model", Value::from(model)),
            ("equations", object(equations)),
            ("symbols", object(symbols)),
        ])
    });
    list(models)
}

/// A calibration function: its parameters with all digits, and the stated values.
fn function(report: &CertificateReport<'_>, of: &StatedFunction) -> Value {
    let languages = &report.certificate.languages;
    let stated = functions::stated(report, of);
    let text = |of: &Figure| Value::from(of.text.as_str());
    let texts = |each: fn(&At) -> &Figure| list(stated.iter().map(|at| text(each(at))));
    object([
        ("name", Value::from(of.curve.fit.name.as_str())),
        ("title", functions::title(of, languages).as_str().into()),
        ("model", report.models.get(of.file).map_or("", |model| model.name).into()),
        ("fit", serde_json::to_value(FitSide::of(&of.curve)).unwrap_or(Value::Null)),
        ("coverage_factor", fits::factor(&of.curve, of.coverage).into()),
        (
            "stated",
            object([
                ("x", texts(|at| &at.x)),
                ("value", texts(|at| &at.value)),
                ("expanded_uncertainty", texts(|at| &at.expanded)),
                ("coverage_factor", functions::factor(of).as_str().into()),
            ]),
        ),
    ])
}

fn one(report: &CertificateReport<'_>, row: &StatedRow<'_>) -> Value {
    let languages = &report.certificate.languages;
    let StatedRow { statement, asked, quantity, .. } = row;
    let names = asked.task.model.conditions.iter().map(|condition| condition.name.as_str());
    let conditions = names.zip(row.conditions.iter().map(|value| Value::from(*value)));
    let set = asked.set.iter().map(|(name, value)| (name.as_str(), Value::from(value.as_str())));
    let pair = |ends: Option<[f64; 2]>| ends.map_or(Value::Null, list);
    let (dof, status) = match statement.dof {
        Dof::Finite(dof) => (Some(dof), "finite"),
        Dof::Infinite => (None, "infinite"),
        Dof::Undefined => (None, "undefined"),
    };
    let stated_ends = row
        .interval(report)
        .map_or(Value::Null, |ends| list(ends.iter().map(|end| end.text.as_str())));
    let limit = statement.limit.map_or(Value::Null, |limit| {
        object([
            ("cmc", Value::from(limit.cmc)),
            ("below", limit.below.into()),
            ("raised", limit.raised.into()),
        ])
    });
    let [name, value] = [row.name(languages), row.value().text];
    let [expanded, factor] = [row.expanded().text, row.factor().text];
    let spread = report.issued.spreads.get(row.number - 1).copied().flatten();
    let mut members = vec![
        ("row", Value::from(row.number as u64)),
        ("name", name.as_str().into()),
        ("model", asked.model.as_str().into()),
        ("output", quantity.name.as_str().into()),
        ("conditions", object(conditions)),
        ("set", object(set)),
        ("unit", quantity.unit.text().into()),
        ("nominal", row.line.nominal.into()),
        ("value", statement.value.into()),
        ("standard_uncertainty", statement.standard_uncertainty.into()),
        ("expanded_uncertainty", statement.expanded_uncertainty.into()),
        ("coverage_factor", statement.coverage_factor.into()),
        ("correlated_standard_uncertainty", spread.into()),
        ("dof", dof.into()),
        ("dof_status", status.into()),
        ("coverage_probability", statement.coverage_probability.into()),
        ("basis", statement.basis.name().into()),
        ("interval", pair(statement.interval)),
        ("limit", limit),
        (
            "stated",
            object([
                ("value", Value::from(value.as_str())),
                ("expanded_uncertainty", expanded.as_str().into()),
                ("coverage_factor", factor.as_str().into()),
                ("interval", stated_ends),
                ("dof", row.dof().text.as_str().into()),
            ]),
        ),
    ];
    members.extend(
        row.conformity()
            .map(|found| ("conformity", decision_value(&found, row.asked.task.settings.coverage))),
    );
    object(members)
}

fn provenance(report: &CertificateReport<'_>) -> Value {
    let evaluations = &report.certificate.evaluations;
    let models = report.models.iter().enumerate().map(|(number, model)| {
        let files = model.files.iter();
        let files = files.map(|(name, digest)| (name.as_str(), Value::from(digest.as_str())));
        let settings = evaluations.iter().find(|asked| asked.file == number);
        let settings = settings.map(|asked| asked.task.settings);
        let trials = settings.map_or(Value::Null, |settings| match settings.trials {
            Trials::Fixed(trials) => trials.into(),
            Trials::Adaptive => "adaptive".into(),
        });
        let made = trials_made::of_file(report, number);
        object([
            ("model", Value::from(model.name)),
            ("model_sha256", model.digest.as_str().into()),
            ("seed", settings.map_or(Value::Null, |settings| settings.seed.into())),
            ("trials", trials),
            ("trials_made", made.map_or(Value::Null, |made| list(made.map(Value::from)))),
            ("files", object(files)),
        ])
    });
    object([("certificate_sha256", Value::from(report.digest)), ("models", list(models))])
}
