//! The statements of a DCC: coverage, traceability, conformity, remarks.

use super::xml::Xml;
use crate::certificate::sentences::{SentenceLanguage, SentencePlace};
use crate::certificate::words::{self, Words};
use crate::certificate::{CertificateReport, conformity, sentences};
use gumption_analysis::certificate::contents::{Language, Localized};
use gumption_engine::propagate::{Conformity, ConformityLevel};

pub(super) fn write(xml: &mut Xml, report: &CertificateReport<'_>, languages: &[Language]) {
    let of = &report.certificate.administrative;
    let own = |language: &Language| SentenceLanguage::by_itself(report, *language);
    let coverage = languages.iter().map(|language| {
        (Some(*language), sentences::coverage(report, own(language), SentencePlace::Dsi).join(" "))
    });
    let norms = ["JCGM 100:2008", "JCGM 101:2008", "EA-4/02 M:2022"];
    statement(xml, &Localized { texts: coverage.collect() }, (None, &norms, None), languages);
    if let Some(traceability) = &of.traceability {
        statement(
            xml,
            traceability,
            (Some("basic_metrologicallyTraceableToSI"), &[], None),
            languages,
        );
    }
    let decided: Vec<Vec<String>> =
        languages.iter().map(|language| conformity::statements(report, own(language))).collect();
    for (place, found) in conformity::decisions(report).into_iter().enumerate() {
        let texts = languages
            .iter()
            .zip(&decided)
            .filter_map(|(language, said)| Some((Some(*language), said.get(place)?.clone())));
        let said = Localized { texts: texts.collect() };
        let of = (Some("basic_conformity"), &["JCGM 106:2012"][..], Some(status(&found)));
        statement(xml, &said, of, languages);
    }
    if let Some(number) = &report.certificate.letterhead.accreditation_number {
        let text = report.certificate.letterhead.accreditation.as_ref();
        let said = |language: &Language| {
            let text = text.map_or(words::of(*language).accreditation, |text| text.get(*language));
            (Some(*language), format!("{text} {number}"))
        };
        let said = Localized { texts: languages.iter().map(said).collect() };
        statement(xml, &said, (None, &[], None), languages);
    }
    let asked: [fn(&Words) -> &'static str; 2] = [|w| w.relates, |w| w.copies];
    let asked = asked.map(|word| words::localized(languages, word));
    for remark in of.remarks.iter().chain(&asked) {
        statement(xml, remark, (None, &[], None), languages);
    }
}

/// The status of a statement of conformity, as the schema names it.
fn status(found: &Conformity) -> &'static str {
    match found.level {
        Some(ConformityLevel::ConditionalPass) => "conditionalPass",
        Some(ConformityLevel::ConditionalFail) => "conditionalFail",
        _ if found.conforms => "pass",
        _ => "fail",
    }
}

/// The reference type of a statement in the good practice, the norms that it follows, and the status
/// of a conformity.
type StatementKind<'a> = (Option<&'a str>, &'a [&'a str], Option<&'static str>);

fn statement(
    xml: &mut Xml,
    text: &Localized,
    (name, norms, status): StatementKind<'_>,
    languages: &[Language],
) {
    let attributes: Vec<(&str, &str)> = name.iter().map(|name| ("refType", *name)).collect();
    xml.within("dcc:statement", &attributes, |xml| {
        for norm in norms {
            xml.leaf("dcc:norm", norm);
        }
        xml.text("dcc:declaration", text, languages);
        status.into_iter().for_each(|status| xml.leaf("dcc:conformity", status));
    });
}
