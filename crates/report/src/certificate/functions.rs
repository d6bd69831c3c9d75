//! Calibration functions on a certificate: parameters, and values with U over the range.

use super::CertificateReport;
use super::sentences::SentenceLanguage;
use super::words::{beside, stacked};
use crate::document::{Block, Document};
use crate::fits::{self, STATED};
use crate::number::{exact, rounded, with_uncertainty};
use crate::plain;
use crate::printed::with_symbols;
use crate::sheet::{Figure, Sheet};
use gumption_analysis::certificate::contents::{Language, StatedFunction};
use gumption_analysis::certificate::rounding;
use gumption_engine::decimal::{Decimal, Direction, to_digits};

/// Decimal place of coverage factors.
const FACTOR: i32 = -2;

/// A line of the table: abscissa, value and expanded uncertainty, as printed.
pub(super) struct At {
    pub(super) x: Figure,
    pub(super) value: Figure,
    pub(super) expanded: Figure,
}

/// Value and expanded uncertainty over the range, rounded by the certificate's rule.
pub(super) fn stated(report: &CertificateReport<'_>, of: &StatedFunction) -> Vec<At> {
    let (curve, certificate) = (&*of.curve, report.certificate);
    let k = fits::factor(curve, of.coverage);
    let figure = |of: Decimal| Figure::of(of.value(), of.to_string());
    let at = |x: f64| {
        let x = to_digits(x, 6);
        let (value, expanded) = (curve.fit.at(x), k * curve.fit.uncertainty_at(x));
        let u = rounding::expanded(expanded, certificate.digits, certificate.rounding);
        let value = match (u, Decimal::shortest(value)) {
            (Some(u), Some(exact)) => figure(exact.round(u.position(), Direction::Nearest)),
            _ => Figure::of(value, exact(value)),
        };
        At {
            x: Figure::of(x, exact(x)),
            value,
            expanded: u.map_or_else(|| Figure::of(expanded, exact(expanded)), figure),
        }
    };
    fits::places(curve, STATED).map(at).collect()
}

/// The coverage factor as printed.
pub(super) fn factor(of: &StatedFunction) -> String {
    rounded(fits::factor(&of.curve, of.coverage), FACTOR)
}

pub(super) fn title(of: &StatedFunction, languages: &[Language]) -> String {
    let name = match &of.label {
        Some(label) => plain(&label.all(languages).join(" / ")),
        None => plain(&of.curve.fit.name),
    };
    beside(languages, |w| w.function).replace("{name}", &name)
}

/// The equation with its range, and the meaning of U.
pub(super) fn sentences(of: &StatedFunction, said: SentenceLanguage) -> [String; 2] {
    let words = said.words();
    let [low, high] = of.curve.fit.points.range().map(|end| said.in_marks(&exact(end)));
    let equation = fits::equation(&of.curve);
    let range = words.in_range.replace("{equation}", &equation).replace("{low}", &low);
    let range = range.replace("{high}", &high).replace("{name}", &plain(&of.curve.fit.name));
    [range, words.band.replace("{k}", &said.in_marks(&factor(of)))]
}

/// Parameters with their standard uncertainties, to one digit more than usual on a certificate, so
/// that the function can be computed from them.
pub(super) fn parameters(report: &CertificateReport<'_>, of: &StatedFunction) -> Sheet {
    let languages = &report.certificate.languages;
    let (fit, digits) = (&*of.curve.fit, report.certificate.digits + 1);
    let texts: Vec<(String, String)> = (0..fit.count())
        .map(|k| with_uncertainty(fit.estimate(k), fit.standard_uncertainty(k), digits))
        .collect();
    let mut sheet = Sheet::default();
    let names = of.curve.parameters.iter().map(|(name, _)| plain(name));
    sheet.text(&stacked(languages, |w| w.parameter), names);
    let values = texts.iter().enumerate();
    sheet.figures(
        &stacked(languages, |w| w.value),
        values.clone().map(|(k, t)| Figure::of(fit.estimate(k), t.0.clone())),
    );
    sheet.figures(
        &stacked(languages, |w| w.standard),
        values.map(|(k, t)| Figure::of(fit.standard_uncertainty(k), t.1.clone())),
    );
    let units = of.curve.parameters.iter().map(|(_, unit)| plain(with_symbols(unit).text()));
    sheet.units(&stacked(languages, |w| w.unit), units);
    sheet
}

/// Values with U over the range.
pub(super) fn values(report: &CertificateReport<'_>, of: &StatedFunction) -> Sheet {
    let stated = stated(report, of);
    let unit = |name: &str, unit: &gumption_units::Unit| match with_symbols(unit).text().trim() {
        "" | "1" => name.to_owned(),
        text => format!("{name}\n{}", plain(text)),
    };
    let curve = &*of.curve;
    let mut sheet = Sheet::default();
    sheet.figures(&unit("x", &curve.x), stated.iter().map(|at| at.x.clone()));
    let name = format!("{}(x)", plain(&curve.fit.name));
    sheet.figures(&unit(&name, &curve.y), stated.iter().map(|at| at.value.clone()));
    sheet.figures(&unit("U", &curve.y), stated.iter().map(|at| at.expanded.clone()));
    sheet
}

/// A section for each function.
pub(super) fn sections(document: &mut Document, report: &CertificateReport<'_>) {
    let languages = report.certificate.languages.as_slice();
    for of in &report.certificate.functions {
        document.section(title(of, languages));
        for said in SentenceLanguage::on_page(report) {
            document.text_in(said.language.code(), sentences(of, said).join(" "));
        }
        document.table(values(report, of));
        document.table(parameters(report, of));
        document.blocks.extend(fits::correlations(&of.curve).map(Block::Table));
    }
}
