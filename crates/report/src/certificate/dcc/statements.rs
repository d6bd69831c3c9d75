//! The statements of a DCC: coverage, traceability, conformity, remarks.

use super::xml::Xml;
use crate::certificate::{CertificateReport, sentences, stated};
use crate::table::comparison;
use gumption_analysis::certificate::contents::{Language, Localized};

pub(super) fn write(xml: &mut Xml, report: &CertificateReport<'_>, languages: &[Language]) {
    let of = &report.certificate.administrative;
    let coverage = languages
        .iter()
        .map(|language| (Some(*language), sentences::coverage(report, *language).join(" ")));
    let norms = ["JCGM 100:2008", "JCGM 101:2008", "EA-4/02 M:2022"];
    statement(xml, &Localized { texts: coverage.collect() }, &norms, languages);
    if let Some(traceability) = &of.traceability {
        statement(xml, traceability, &[], languages);
    }
    for row in stated::rows(report) {
        for said in
            row.found.conformity.iter().flat_map(|of| comparison::conformity(row.quantity, of))
        {
            let said = Localized::plain(format!("{} {}: {said}", "row", row.number));
            statement(xml, &said, &["JCGM 106:2012"], languages);
        }
    }
    for remark in &of.remarks {
        statement(xml, remark, &[], languages);
    }
}

fn statement(xml: &mut Xml, text: &Localized, norms: &[&str], languages: &[Language]) {
    xml.element("dcc:statement", |xml| {
        for norm in norms {
            xml.leaf("dcc:norm", norm);
        }
        xml.text("dcc:declaration", text, languages);
    });
}
