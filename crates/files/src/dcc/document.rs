//! The quantities of a Digital Calibration Certificate, versions 2.4 to 3.3.
//!
//! Elements are told by their local names, because the versions differ in namespaces and in where
//! they put things. Only what is asked for is read, so that an element that this program does not
//! know, or that is damaged, matters where it is wanted.

use std::ops::Range;

use crate::implied_dof::last_digit;
use crate::named_shape::NamedShape;
use gumption_units::Unit;
use roxmltree::{Document, Node};

/// What is wrong, and where in the text.
pub(crate) type Fault = (Range<usize>, String);

/// The values of a quantity, with what is stated of their uncertainty.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// Where the quantity stands.
    pub(super) span: Range<usize>,
    pub(super) unit: Unit,
    pub(super) values: Vec<f64>,
    pub(super) uncertainty: Option<Stated>,
}

/// Uncertainties of the values, in their unit.
#[derive(Clone, Debug, Default)]
pub(super) struct Stated {
    pub(super) expanded: Option<Vec<f64>>,
    pub(super) standard: Option<Vec<f64>>,
    pub(super) factors: Option<Vec<f64>>,
    pub(super) probabilities: Option<Vec<f64>>,
    pub(super) distributions: Option<Vec<String>>,
    /// What one in the last written digit of each expanded uncertainty, factor and probability is.
    pub(super) last_digits: [Option<Vec<f64>>; 3],
    /// The standard uncertainties of values whose coverage intervals stand in a quantity of their own.
    pub(super) of_interval: Vec<Option<f64>>,
}

impl Measured {
    /// The standard uncertainty of a coverage interval that is taken for a value, or for any of them.
    pub(super) fn interval_taken(&self, place: Option<usize>) -> Option<f64> {
        let stated = self.uncertainty.as_ref().filter(|stated| stated.standard.is_none())?;
        let mut places = stated.of_interval.iter().enumerate();
        places.find_map(|(at, u)| u.filter(|_| place.is_none_or(|place| place == at)))
    }

    /// What the distribution of a value, or of any of them, is called where that is not known.
    pub(super) fn unknown_distribution(&self, place: Option<usize>) -> Option<String> {
        let called = self.uncertainty.as_ref()?.distributions.as_ref()?.iter().enumerate();
        let mut of_place = called.filter(|(at, _)| place.is_none_or(|place| place == *at));
        let unknown = |text: &str| NamedShape::of(text) == Some(NamedShape::Unknown);
        of_place.find(|(_, text)| unknown(text)).map(|(_, text)| text.clone())
    }
}

/// Reads a text as a certificate.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Fault> {
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let line: usize = text
            .split_inclusive('\n')
            .take((at.row as usize).saturating_sub(1))
            .map(str::len)
            .sum();
        let rest = text.get(line..).unwrap_or_default();
        let column = rest.char_indices().nth((at.col as usize).saturating_sub(1));
        let at = line + column.map_or(0, |(at, _)| at);
        (at..at, format!("it is no well-formed XML: {error}"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "digitalCalibrationCertificate" {
        let reason = format!(
            "it is no Digital Calibration Certificate: its root is `{}`, not \
             `digitalCalibrationCertificate`",
            root.tag_name().name()
        );
        return Err((tag(root), reason));
    }
    let version = root.attribute("schemaVersion").unwrap_or_default();
    let mut numbers = version.split('.').map(|part| part.trim().parse::<u32>().unwrap_or(0));
    let version_number = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    if !((2, 4)..=(3, u32::MAX)).contains(&version_number) {
        let reason = format!("its schema version is `{version}`; 2.4 to 3.3 can be read");
        return Err((tag(root), reason));
    }
    Ok(document)
}

/// The start tag of an element.
pub(crate) fn tag(node: Node<'_, '_>) -> Range<usize> {
    let range = node.range();
    let text = node.document().input_text();
    let inside = text.get(range.clone()).unwrap_or_default();
    let length = inside.find('>').map_or(inside.len(), |at| at + 1);
    range.start..range.start + length
}

/// All quantities, in the order of the text.
pub(super) fn quantities<'d>(document: &'d Document<'d>) -> Vec<Node<'d, 'd>> {
    document.descendants().filter(|node| node.tag_name().name() == "quantity").collect()
}

/// Whether one of an element's reference types is this one.
pub(super) fn has_ref_type(node: Node<'_, '_>, wanted: &str) -> bool {
    node.attribute("refType").is_some_and(|all| all.split_whitespace().any(|of| of == wanted))
}

/// The names of a quantity, in all languages.
pub(super) fn names<'d>(node: Node<'d, 'd>) -> Vec<&'d str> {
    let named = node.children().filter(|child| child.tag_name().name() == "name");
    let contents = named.flat_map(|name| name.children());
    contents.filter_map(|content| content.text()).map(str::trim).collect()
}

/// What a message calls a quantity.
pub(super) fn called(node: Node<'_, '_>) -> String {
    let id = node.attribute("id").map(|id| format!("id `{id}`"));
    let kind = node.attribute("refType").map(|kind| format!("ref_type `{kind}`"));
    id.or(kind).unwrap_or_else(|| "one without id and ref_type".to_owned())
}

/// Reads the values of a quantity.
pub(super) fn measured(quantity: Node<'_, '_>) -> Result<Measured, Fault> {
    let fault = |reason: &str| (tag(quantity), format!("this quantity {reason}"));
    let mut holders = Vec::new();
    find_holders(quantity, &mut holders);
    let Some(&first) = holders.first() else {
        return Err(fault("has no real value (`si:real`, `si:constant` or a list of such)"));
    };
    let mut all: Option<Measured> = None;
    for holder in holders {
        let next = of_holder(holder, tag(quantity))?;
        match &mut all {
            None => all = Some(next),
            Some(all) if all.unit.text() == next.unit.text() => join(all, next),
            // a hybrid repeats the values in other units
            Some(_) if holder.parent().is_some_and(|p| p.tag_name().name() == "hybrid") => {}
            Some(_) => {
                return Err((tag(holder), "the values of a list have different units".to_owned()));
            }
        }
        if first.parent().is_some_and(|parent| parent.tag_name().name() == "hybrid") {
            break;
        }
    }
    let all = all.ok_or_else(|| fault("has no value"))?;
    if all.values.is_empty() {
        return Err(fault("has no value"));
    }
    Ok(all)
}

/// The elements that hold values, without those of data about the measurement.
fn find_holders<'d>(node: Node<'d, 'd>, found: &mut Vec<Node<'d, 'd>>) {
    for child in node.children().filter(Node::is_element) {
        match child.tag_name().name() {
            "real" | "constant" | "realListXMLList" => found.push(child),
            "hybrid" | "list" => find_holders(child, found),
            _ => {}
        }
    }
}

fn join(all: &mut Measured, next: Measured) {
    all.values.extend(next.values);
    let both = all.uncertainty.as_mut().zip(next.uncertainty);
    let Some((all, next)) = both else {
        all.uncertainty = None;
        return;
    };
    let numbers = |all: &mut Option<Vec<f64>>, next: Option<Vec<f64>>| match (all.as_mut(), next) {
        (Some(all), Some(next)) => all.extend(next),
        _ => *all = None,
    };
    numbers(&mut all.expanded, next.expanded);
    numbers(&mut all.standard, next.standard);
    numbers(&mut all.factors, next.factors);
    numbers(&mut all.probabilities, next.probabilities);
    for (all, next) in all.last_digits.iter_mut().zip(next.last_digits) {
        numbers(all, next);
    }
    match (all.distributions.as_mut(), next.distributions) {
        (Some(all), Some(next)) => all.extend(next),
        _ => all.distributions = None,
    }
}

/// Reads a `real`, a `constant` or a list in one element.
fn of_holder(holder: Node<'_, '_>, span: Range<usize>) -> Result<Measured, Fault> {
    let values = numbers(holder, &["value", "valueXMLList"], None)?
        .ok_or_else(|| (tag(holder), "this has no value".to_owned()))?;
    let units = texts(holder, &["unit", "unitXMLList"]);
    let Some((element, units)) = units else {
        return Err((tag(holder), "this has no unit".to_owned()));
    };
    let written = units.first().copied().unwrap_or_default();
    if units.iter().any(|unit| *unit != written) {
        return Err((tag(element), "the values of a list have different units".to_owned()));
    }
    let unit = Unit::parse_dsi(written)
        .or_else(|| defined(holder, written))
        .ok_or_else(|| (element.range(), format!("`{written}` is no unit of D-SI")))?;
    let count = Some(values.len());
    let expanded = ["uncertainty", "valueExpandedMU", "uncertaintyXMLList"];
    let expanded = [&expanded[..], &["valueExpandedMUXMLList"]].concat();
    let standard = ["standardUnc", "valueStandardMU", "standardUncXMLList"];
    let standard = [&standard[..], &["valueStandardMUXMLList"]].concat();
    let factors = ["coverageFactor", "coverageFactorXMLList"];
    let probabilities = ["coverageProbability", "coverageProbabilityXMLList"];
    let last_digits = |names: &[&str]| {
        let (_, words) = texts(holder, names)?;
        Some(spread(words.into_iter().map(last_digit).collect(), count))
    };
    let stated = Stated {
        last_digits: [&expanded[..], &factors, &probabilities].map(last_digits),
        expanded: numbers(holder, &expanded, count)?,
        standard: numbers(holder, &standard, count)?,
        factors: numbers(holder, &factors, count)?,
        probabilities: numbers(holder, &probabilities, count)?,
        distributions: distributions(holder, count),
        of_interval: Vec::new(),
    };
    let uncertain = stated.expanded.is_some() || stated.standard.is_some();
    Ok(Measured { span, unit, values, uncertainty: uncertain.then_some(stated) })
}

/// A unit that D-SI does not have, `|tex`, by its definition in the quantity, `tex = 1e-6 kg m^-1`.
fn defined(holder: Node<'_, '_>, written: &str) -> Option<Unit> {
    let name = written.strip_prefix('|')?;
    let quantity = holder.ancestors().find(|of| of.tag_name().name() == "quantity")?;
    let definition = quantity.descendants().find(|of| of.tag_name().name() == "nonSIDefinition")?;
    let (_, size) = definition.text()?.split_once('=')?;
    let size = Unit::parse(size.trim()).ok()?;
    // a product of units has no name of its own
    Some(Unit::defined(name, &size).unwrap_or(size))
}

/// One value for all, where a list has one.
fn spread<T: Clone>(all: Vec<T>, count: Option<usize>) -> Vec<T> {
    match (all.as_slice(), count) {
        ([one], Some(count)) => vec![one.clone(); count],
        _ => all,
    }
}

/// What the distributions of values are called: one name, which may have several words, or a list.
fn distributions(holder: Node<'_, '_>, count: Option<usize>) -> Option<Vec<String>> {
    let (element, words) = texts(holder, &["distribution", "distributionXMLList"])?;
    let all = match element.tag_name().name() {
        "distribution" => vec![words.join(" ")],
        _ => words.into_iter().map(str::to_owned).collect(),
    };
    Some(spread(all, count))
}

/// The words of the first element below with one of these names.
fn texts<'d>(holder: Node<'d, 'd>, names: &[&str]) -> Option<(Node<'d, 'd>, Vec<&'d str>)> {
    let element = holder.descendants().find(|node| names.contains(&node.tag_name().name()))?;
    Some((element, element.text().unwrap_or_default().split_whitespace().collect()))
}

fn numbers(
    holder: Node<'_, '_>,
    names: &[&str],
    count: Option<usize>,
) -> Result<Option<Vec<f64>>, Fault> {
    let Some((element, words)) = texts(holder, names) else { return Ok(None) };
    let name = element.tag_name().name();
    let number = |word: &str| {
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| {
            let shown: String = word.chars().take(40).collect();
            (element.range(), format!("`{shown}` in `{name}` is not a finite number"))
        })
    };
    let found: Vec<f64> = words.into_iter().map(number).collect::<Result<_, Fault>>()?;
    let found = spread(found, count);
    if found.is_empty() {
        return Err((element.range(), format!("`{name}` is empty")));
    }
    match count {
        Some(count) if found.len() != count => {
            let reason = format!("`{name}` has {} numbers for {count} values", found.len());
            Err((element.range(), reason))
        }
        _ => Ok(Some(found)),
    }
}
