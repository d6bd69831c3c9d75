//! Coverage regions in D-SI: a complex quantity with its region, or a list of real ones.

use super::results::named;
use super::unit::unit;
use super::xml::Xml;
use crate::certificate::CertificateReport;
use crate::certificate::regions::{Covered, covered};
use crate::certificate::sentences::SentenceLanguage;
use crate::certificate::stated::StatedRow;
use crate::certificate::words::{self, Words, localized};
use crate::number::{exact, rounded, significant};
use crate::printed::with_symbols;
use gumption_analysis::certificate::contents::{Language, Localized};
use gumption_engine::propagate::JointRegion;
use gumption_units::Unit;

/// Decimal place of coverage factors.
const FACTOR: i32 = -3;

/// An element with its designation, and the coverage factor in it.
type RegionForm = (&'static str, fn(&Words) -> &'static str, f64);

/// A result for each region.
pub(super) fn write(xml: &mut Xml, report: &CertificateReport<'_>, languages: &[Language]) {
    for of in covered(report) {
        let Some(joint) = of.joint() else { continue };
        let factors: Vec<RegionForm> = [
            joint.ellipsoid_k.map(|k| ("si:ellipsoidalRegion", (|w: &Words| w.ellipsoid) as _, k)),
            joint.box_k.map(|k| ("si:rectangularRegion", (|w: &Words| w.cuboid) as _, k)),
        ]
        .into_iter()
        .flatten()
        // D-SI has no coverage factor below 1
        .filter(|(_, _, k): &RegionForm| *k >= 1.0)
        .collect();
        if factors.is_empty() {
            continue;
        }
        xml.element("dcc:result", |xml| {
            xml.text("dcc:name", &localized(languages, |w| w.region), languages);
            let said = |language: &Language| (Some(*language), about(report, &of, *language));
            let said = Localized { texts: languages.iter().map(said).collect() };
            xml.text("dcc:description", &said, languages);
            xml.element("dcc:data", |xml| {
                for (element, name, k) in &factors {
                    xml.element("dcc:quantity", |xml| {
                        xml.text("dcc:name", &localized(languages, *name), languages);
                        quantity(xml, &of.rows, joint, |xml| {
                            region(xml, element, &of.rows, joint, [*k, of.region.probability]);
                        });
                    });
                }
            });
        });
    }
}

/// The rows that the region covers, and its smallest size.
fn about(report: &CertificateReport<'_>, of: &Covered<'_>, language: Language) -> String {
    let mut said: Vec<String> = of.rows.iter().map(|row| named(report, row, language)).collect();
    let found = of.region.monte_carlo.as_ref();
    if let Some(smallest) = found.and_then(|found| found.smallest.as_ref().ok()) {
        let units =
            of.rows.iter().map(|row| with_symbols(&row.quantity.unit).text().trim().to_owned());
        let units: Vec<String> = units.filter(|unit| !matches!(unit.as_str(), "" | "1")).collect();
        let number = SentenceLanguage::by_itself(report, language)
            .in_marks(&significant(smallest.volume, 3));
        let volume = format!("{number} {}", units.join("*"));
        said.push(words::of(language).smallest.replace("{volume}", volume.trim_end()));
    }
    said.push("JCGM 102:2011, 6.5".to_owned());
    said.join("; ")
}

/// The values: a complex number if the two outputs are the parts of one, else a list.
fn quantity(
    xml: &mut Xml,
    rows: &[StatedRow<'_>],
    joint: &JointRegion,
    inside: impl FnOnce(&mut Xml),
) {
    let value = |place: usize| joint.estimates.get(place).map_or_else(String::new, |v| exact(*v));
    if let [first, second] = rows
        && let Some(parts) = ComplexCoordinates::of(first, second)
    {
        xml.element("si:complex", |xml| {
            let names = match parts {
                ComplexCoordinates::Cartesian => ["si:valueReal", "si:valueImag"],
                ComplexCoordinates::Polar => ["si:valueMagnitude", "si:valuePhase"],
            };
            names.into_iter().enumerate().for_each(|(at, name)| xml.leaf(name, &value(at)));
            xml.leaf("si:unit", &unit(&first.quantity.unit));
            if parts == ComplexCoordinates::Polar {
                xml.leaf("si:unitPhase", &unit(&second.quantity.unit));
            }
            inside(xml);
        });
        return;
    }
    xml.element("si:list", |xml| {
        xml.element("si:realList", |xml| {
            for (place, row) in rows.iter().enumerate() {
                xml.element("si:real", |xml| {
                    xml.leaf("si:label", &row.quantity.name);
                    xml.leaf("si:value", &value(place));
                    xml.leaf("si:unit", &unit(&row.quantity.unit));
                });
            }
            inside(xml);
        });
    });
}

/// The meaning of the two outputs of a complex quantity.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ComplexCoordinates {
    Cartesian,
    Polar,
}

impl ComplexCoordinates {
    fn of(first: &StatedRow<'_>, second: &StatedRow<'_>) -> Option<Self> {
        let (whole, part) = first.quantity.name.rsplit_once('.')?;
        let (other, second_part) = second.quantity.name.rsplit_once('.')?;
        let units = [first, second].map(|row| row.quantity.unit.text());
        match (part, second_part) {
            _ if whole != other => None,
            ("re", "im") if units[0] == units[1] => Some(Self::Cartesian),
            ("abs", "arg") => Some(Self::Polar),
            _ => None,
        }
    }
}

/// The covariance matrix, and its factor.
fn region(
    xml: &mut Xml,
    element: &str,
    rows: &[StatedRow<'_>],
    joint: &JointRegion,
    [k, probability]: [f64; 2],
) {
    xml.element(element, |xml| {
        xml.element("si:covarianceMatrix", |xml| {
            for (j, column) in rows.iter().enumerate() {
                xml.element("si:column", |xml| {
                    for (i, row) in rows.iter().enumerate() {
                        let value = joint.covariance.get(i * rows.len() + j).copied();
                        xml.element("si:covariance", |xml| {
                            xml.leaf("si:value", &exact(value.unwrap_or(f64::NAN)));
                            let both = [row, column].map(|of| &of.quantity.unit);
                            xml.leaf("si:unit", &product(both));
                        });
                    }
                });
            }
        });
        xml.leaf("si:coverageFactor", &rounded(k, FACTOR));
        xml.leaf("si:coverageProbability", &exact(probability));
    });
}

/// The product of two units.
fn product([a, b]: [&Unit; 2]) -> String {
    let text = |of: &Unit| match of.text().trim() {
        "" => "1".to_owned(),
        text => format!("({text})"),
    };
    let written = match (text(a), text(b)) {
        (a, b) if a == b => format!("{a}^2"),
        (a, b) => format!("{a}*{b}"),
    };
    Unit::parse(&written).map_or_else(|_| format!("|{written}"), |both| unit(&both))
}
