//! The results of a DCC: for each output lists over its rows, and the source files.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::unit::{definition, is_of_the_si, unit};
use super::xml::Xml;
use crate::certificate::functions::{self, At};
use crate::certificate::sentences::SentenceLanguage;
use crate::certificate::stated;
use crate::certificate::stated::{StatedRow, UnitsAre};
use crate::certificate::words::{self, Words, localized};
use crate::certificate::{CertificateReport, file_name, json, sentences};
use crate::fits;
use crate::number::exact;
use crate::printed::with_symbols;
use crate::sheet::Figure;
use crate::table::in_unit;
use gumption_analysis::certificate::Basis;
use gumption_analysis::certificate::contents::{Language, Localized, StatedFunction};
use gumption_engine::model::Quantity;
use gumption_engine::propagate::DifferenceCause;
use gumption_units::Unit;

pub(super) fn write(xml: &mut Xml, report: &CertificateReport<'_>, languages: &[Language]) {
    let of = &report.certificate.administrative;
    xml.element("dcc:measurementResult", |xml| {
        xml.text("dcc:name", &super::title(report), languages);
        xml.element("dcc:usedMethods", |xml| {
            if let Some(method) = &of.method {
                let name = localized(languages, |w| w.method);
                xml.element("dcc:usedMethod", |xml| {
                    xml.text("dcc:name", &name, languages);
                    xml.text("dcc:description", method, languages);
                });
            }
            xml.within(
                "dcc:usedMethod",
                &[("refType", "basic_methodMeasurementUncertainty")],
                |xml| {
                    let name = localized(languages, |w| w.uncertainty);
                    xml.text("dcc:name", &name, languages);
                    for norm in ["JCGM 100:2008", "JCGM 101:2008", "EA-4/02 M:2022"] {
                        xml.leaf("dcc:norm", norm);
                    }
                },
            );
        });
        xml.element("dcc:usedSoftware", super::software);
        if let Some(environment) = &of.environment {
            xml.element("dcc:influenceConditions", |xml| {
                xml.element("dcc:influenceCondition", |xml| {
                    xml.text("dcc:name", &localized(languages, |w| w.environment), languages);
                    xml.element("dcc:data", |xml| xml.text("dcc:text", environment, languages));
                });
            });
        }
        xml.element("dcc:results", |xml| {
            for rows in stated::groups(report) {
                xml.element("dcc:result", |xml| result(xml, report, &rows, languages));
            }
            for of in &report.certificate.functions {
                xml.element("dcc:result", |xml| function(xml, report, of, languages));
            }
            super::regions::write(xml, report, languages);
            xml.element("dcc:result", |xml| attachments(xml, report, languages));
        });
    });
}

fn result(
    xml: &mut Xml,
    report: &CertificateReport<'_>,
    rows: &[StatedRow<'_>],
    languages: &[Language],
) {
    let Some(first) = rows.first() else { return };
    let lists = lists(rows);
    let is_in_lists = |row: &StatedRow<'_>| {
        let mut lists = lists.iter();
        let own = lists.find(|list| list.iter().any(|other| other.number == row.number));
        own.is_some_and(|list| are_in_lists(list))
    };
    xml.text("dcc:name", &Localized::plain(first.quantity.name.clone()), languages);
    let described = |language: &Language| {
        let mut lines: Vec<String> = Vec::new();
        if !first.quantity.about.trim().is_empty() {
            lines.push(first.quantity.about.trim().to_owned());
        }
        lines.extend(rows.iter().map(|row| match is_in_lists(row) {
            true => named(report, row, *language),
            false => named(report, row, *language) + &without_probability(report, row, *language),
        }));
        (Some(*language), lines.join("; "))
    };
    let about = Localized { texts: languages.iter().map(described).collect() };
    xml.text("dcc:description", &about, languages);
    xml.element("dcc:data", |xml| {
        for rows in &lists {
            xml.element("dcc:list", |xml| {
                if lists.len() > 1 {
                    xml.text("dcc:name", &rows_of(rows, languages), languages);
                }
                conditions(xml, report, rows, languages);
                nominal(xml, rows, languages);
                measured(xml, rows, languages);
                intervals(xml, report, rows, languages);
            });
        }
    });
}

/// The rows of each list of a result. A list in D-SI has a number for every row, so rows with and
/// without a nominal value are in two lists; the list of the first row comes first.
fn lists<'a>(rows: &[StatedRow<'a>]) -> Vec<Vec<StatedRow<'a>>> {
    let first = rows.first().map(|row| row.line.nominal.is_some());
    let is_as_first = |row: &StatedRow<'_>| Some(row.line.nominal.is_some()) == first;
    let (as_first, others): (Vec<_>, Vec<_>) = rows.iter().copied().partition(is_as_first);
    [as_first, others].into_iter().filter(|rows| !rows.is_empty()).collect()
}

/// The numbers of these rows on the certificate.
fn rows_of(rows: &[StatedRow<'_>], languages: &[Language]) -> Localized {
    let numbers: Vec<usize> = rows.iter().map(|row| row.number).collect();
    let said = |language: &Language| {
        let said = sentences::about(&numbers, words::of(*language));
        (Some(*language), said.trim_end_matches([':', ' ']).to_owned())
    };
    Localized { texts: languages.iter().map(said).collect() }
}

/// `row 3: a_x, tilt = 35 deg`
pub(super) fn named(
    report: &CertificateReport<'_>,
    row: &StatedRow<'_>,
    language: Language,
) -> String {
    let mut parts = vec![row.name(&[language])];
    let of = SentenceLanguage::by_itself(report, language);
    let circumstances = row.circumstances(report, UnitsAre::Printed);
    parts.extend(circumstances.iter().map(|part| of.in_marks(part)));
    format!("{} {}: {}", words::of(language).row, row.number, parts.join(", "))
}

/// Whether the expanded uncertainties of these rows can be in a list: D-SI has no coverage factor
/// below 1, and none without a probability.
fn are_in_lists(rows: &[StatedRow<'_>]) -> bool {
    let below = rows.iter().any(|row| row.statement.coverage_factor < 1.0);
    !below && stated::reach_something(rows)
}

/// The meaning of an agreed factor for a row without a coverage probability, for which D-SI has no
/// element.
fn without_probability(
    report: &CertificateReport<'_>,
    row: &StatedRow<'_>,
    language: Language,
) -> String {
    let of = SentenceLanguage::by_itself(report, language);
    let [expanded, factor] = [row.expanded().text, row.factor().text].map(|n| of.in_marks(&n));
    format!(", U = {}, k = {factor}", in_unit(&expanded, &with_symbols(&row.quantity.unit)))
}

/// A list of numbers in one unit.
fn list(xml: &mut Xml, values: &[String], of: &Unit, inside: impl FnOnce(&mut Xml)) {
    xml.element("si:realListXMLList", |xml| {
        xml.leaf("si:valueXMLList", &values.join(" "));
        xml.leaf("si:unitXMLList", &unit(of));
        inside(xml);
    });
}

/// The definition of a unit outside the SI, if the list has one.
fn explained(xml: &mut Xml, of: &Unit) {
    if is_of_the_si(of) {
        return;
    }
    xml.element("dcc:measurementMetaData", |xml| {
        xml.element("dcc:metaData", |xml| {
            xml.leaf("dcc:nonSIDefinition", &definition(of));
            xml.leaf("dcc:nonSIUnit", &of.normal_text());
        });
    });
}

/// The conditions that all rows show.
fn conditions(
    xml: &mut Xml,
    report: &CertificateReport<'_>,
    rows: &[StatedRow<'_>],
    languages: &[Language],
) {
    let Some(first) = rows.first() else { return };
    for (condition, _) in first.shown(report) {
        let value = |row: &StatedRow<'_>| {
            let same = |(c, _): &(&Quantity, f64)| {
                c.name == condition.name && c.unit.text() == condition.unit.text()
            };
            row.shown(report).into_iter().find(same).map(|(_, value)| exact(value))
        };
        let Some(values) = rows.iter().map(value).collect::<Option<Vec<String>>>() else {
            continue;
        };
        xml.element("dcc:quantity", |xml| {
            xml.text("dcc:name", &Localized::plain(condition.name.clone()), languages);
            list(xml, &values, &condition.unit, |_| ());
            explained(xml, &condition.unit);
        });
    }
}

fn nominal(xml: &mut Xml, rows: &[StatedRow<'_>], languages: &[Language]) {
    let values: Option<Vec<String>> = rows.iter().map(|row| row.line.nominal.map(exact)).collect();
    let (Some(values), Some(first)) = (values, rows.first()) else { return };
    xml.within("dcc:quantity", &[("refType", "basic_nominalValue")], |xml| {
        xml.text("dcc:name", &localized(languages, |w| w.nominal_value), languages);
        list(xml, &values, &first.quantity.unit, |_| ());
        explained(xml, &first.quantity.unit);
    });
}

/// The measured values with their expanded uncertainties.
fn measured(xml: &mut Xml, rows: &[StatedRow<'_>], languages: &[Language]) {
    let Some(first) = rows.first() else { return };
    let texts = |of: fn(&StatedRow<'_>) -> String| -> Vec<String> { rows.iter().map(of).collect() };
    xml.within("dcc:quantity", &[("refType", "basic_measuredValue")], |xml| {
        xml.text("dcc:name", &localized(languages, |w| w.measured_value), languages);
        list(xml, &texts(|row| row.value().text), &first.quantity.unit, |xml| {
            if !are_in_lists(rows) {
                return;
            }
            xml.element("si:expandedUncXMLList", |xml| {
                let expanded = texts(|row| row.expanded().text);
                xml.leaf("si:uncertaintyXMLList", &expanded.join(" "));
                let factors = texts(|row| row.factor().text);
                xml.leaf("si:coverageFactorXMLList", &factors.join(" "));
                xml.leaf("si:coverageProbabilityXMLList", &texts(probability).join(" "));
                let laws: Option<Vec<&str>> = rows.iter().map(distribution).collect();
                if let Some(laws) = laws {
                    xml.leaf("si:distributionXMLList", &laws.join(" "));
                }
            });
        });
        explained(xml, &first.quantity.unit);
    });
}

/// The coverage probability, which D-SI requires even if only an agreed factor is stated.
fn probability(row: &StatedRow<'_>) -> String {
    match (row.statement.coverage_probability, row.reached()) {
        (Some(stated), _) => exact(stated),
        (None, Some(reached)) => {
            exact(stated::percent(1e-4 * stated::percent_of_coverage(reached)))
        }
        (None, None) => String::new(),
    }
}

/// The distribution to which the factor belongs; `None` if the trials contradict it other than by
/// few degrees of freedom, for which a t distribution allows.
fn distribution(row: &StatedRow<'_>) -> Option<&'static str> {
    let is_refuted = row.found.validation.is_some_and(|v| v.gum_valid == Some(false));
    let allowed = row.asked.task.settings.statement_tolerance;
    let cause = row.found.difference_cause(allowed);
    let is_contradicted = is_refuted && cause != Some(DifferenceCause::DegreesOfFreedom);
    match row.statement.basis {
        Basis::Normal | Basis::Student if is_contradicted && !row.is_raised() => None,
        Basis::Normal => Some("normal"),
        Basis::Student => Some("t"),
        Basis::Fixed if row.reached().is_some() && !row.is_raised() => Some("t"),
        Basis::Fixed | Basis::Shortest => Some("other"),
    }
}

/// The designation of coverage intervals: the good practice of the DKD has no reference type for
/// them, and with that of the measured values they would count as further measured values.
const INTERVAL: &str = "gumption_coverageInterval";

/// The coverage intervals of the rows that have one.
fn intervals(
    xml: &mut Xml,
    report: &CertificateReport<'_>,
    rows: &[StatedRow<'_>],
    languages: &[Language],
) {
    let rows: Vec<(&StatedRow<'_>, [String; 2])> = rows
        .iter()
        .filter_map(|row| Some((row, row.interval(report)?.map(|end| end.text))))
        .collect();
    let Some((first, _)) = rows.first() else { return };
    xml.within("dcc:quantity", &[("refType", INTERVAL)], |xml| {
        let name = localized(languages, |w| w.coverage_interval);
        xml.text("dcc:name", &name, languages);
        let own: Vec<StatedRow<'_>> = rows.iter().map(|(row, _)| **row).collect();
        xml.text("dcc:description", &rows_of(&own, languages), languages);
        let texts = |of: &dyn Fn(&StatedRow<'_>, &[String; 2]) -> String| -> String {
            let texts: Vec<String> = rows.iter().map(|(row, ends)| of(row, ends)).collect();
            texts.join(" ")
        };
        let values: Vec<String> = rows.iter().map(|(row, _)| row.value().text).collect();
        list(xml, &values, &first.quantity.unit, |xml| {
            xml.element("si:coverageIntervalXMLList", |xml| {
                let u = texts(&|row, _| exact(row.statement.standard_uncertainty));
                xml.leaf("si:standardUncXMLList", &u);
                xml.leaf("si:intervalMinXMLList", &texts(&|_, ends| ends[0].clone()));
                xml.leaf("si:intervalMaxXMLList", &texts(&|_, ends| ends[1].clone()));
                xml.leaf("si:coverageProbabilityXMLList", &texts(&|row, _| probability(row)));
                let law = texts(&|row, _| distribution(row).unwrap_or("other").to_owned());
                xml.leaf("si:distributionXMLList", &law);
            });
        });
        explained(xml, &first.quantity.unit);
    });
}

/// A calibration function: values with U over its range, and its parameters.
fn function(
    xml: &mut Xml,
    report: &CertificateReport<'_>,
    of: &StatedFunction,
    languages: &[Language],
) {
    let curve = &*of.curve;
    let each = |text: &dyn Fn(Language) -> String| Localized {
        texts: languages.iter().map(|language| (Some(*language), text(*language))).collect(),
    };
    let title = each(&|language| functions::title(of, &[language]));
    xml.text("dcc:name", &title, languages);
    let said = each(&|language| {
        functions::sentences(of, SentenceLanguage::by_itself(report, language)).join(" ")
    });
    xml.text("dcc:description", &said, languages);
    let probability = exact(of.coverage.probability());
    let dof = curve.fit.degrees_of_freedom();
    let law = if dof.is_finite() { "t" } else { "normal" };
    let uncertain = |xml: &mut Xml, expanded: &[String]| {
        let all = |text: &str| vec![text; expanded.len()].join(" ");
        let k = functions::factor(of);
        // D-SI has no coverage factor below 1
        if fits::factor(curve, of.coverage) < 1.0 {
            return;
        }
        xml.element("si:expandedUncXMLList", |xml| {
            xml.leaf("si:uncertaintyXMLList", &expanded.join(" "));
            xml.leaf("si:coverageFactorXMLList", &all(&k));
            xml.leaf("si:coverageProbabilityXMLList", &all(&probability));
            xml.leaf("si:distributionXMLList", &all(law));
        });
    };
    let stated = functions::stated(report, of);
    let texts = |of: fn(&At) -> &Figure| stated.iter().map(|at| of(at).text.clone()).collect();
    let (x, values): (Vec<String>, Vec<String>) = (texts(|at| &at.x), texts(|at| &at.value));
    let expanded: Vec<String> = texts(|at| &at.expanded);
    xml.element("dcc:data", |xml| {
        xml.element("dcc:list", |xml| {
            xml.element("dcc:quantity", |xml| {
                xml.text("dcc:name", &Localized::plain("x"), languages);
                list(xml, &x, &curve.x, |_| ());
                explained(xml, &curve.x);
            });
            xml.element("dcc:quantity", |xml| {
                let name = format!("{}(x)", curve.fit.name);
                xml.text("dcc:name", &Localized::plain(name), languages);
                list(xml, &values, &curve.y, |xml| uncertain(xml, &expanded));
                explained(xml, &curve.y);
            });
        });
        let k = fits::factor(curve, of.coverage);
        for (number, (name, unit)) in curve.parameters.iter().enumerate() {
            xml.element("dcc:quantity", |xml| {
                xml.text("dcc:name", &Localized::plain(name.clone()), languages);
                let (value, u) =
                    (curve.fit.estimate(number), curve.fit.standard_uncertainty(number));
                list(xml, &[exact(value)], unit, |xml| uncertain(xml, &[exact(k * u)]));
                explained(xml, unit);
            });
        }
    });
}

/// The source files of the certificate, and its answer for programs.
fn attachments(xml: &mut Xml, report: &CertificateReport<'_>, languages: &[Language]) {
    let name = localized(languages, |w| w.files);
    xml.text("dcc:name", &name, languages);
    xml.element("dcc:data", |xml| {
        let answer = json(report);
        let mut add = |about: fn(&Words) -> &'static str, name: &str, kind: &str, bytes: &[u8]| {
            xml.element("dcc:byteData", |xml| {
                xml.text("dcc:name", &localized(languages, about), languages);
                // only the name of the file: the user chooses the folder
                xml.leaf("dcc:fileName", file_name(name));
                xml.leaf("dcc:mimeType", kind);
                xml.leaf("dcc:dataBase64", &STANDARD.encode(bytes));
            });
        };
        const JSON: &str = "application/json";
        add(|w| w.answer, "result.json", JSON, answer.as_bytes());
        add(|w| w.certificate_name, "certificate.json", JSON, report.text.as_bytes());
        for model in report.models {
            add(|w| w.model_file, model.name, JSON, model.text.as_bytes());
            for (name, bytes) in model.tables {
                add(|w| w.table, name, "application/octet-stream", bytes);
            }
        }
    });
}
