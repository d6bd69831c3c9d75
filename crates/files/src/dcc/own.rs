//! A certificate that this program has made says in its attached answer how its results vary together;
//! the certificate itself has no place for it.

use std::sync::Arc;

use roxmltree::{Document, Node};
use serde_json::Value;

use super::intervals;
use crate::carried;

/// How the results of a certificate vary together.
#[derive(Debug)]
pub(super) struct OwnCertificate {
    /// The rows of each `dcc:result`, in order: one result for each output and unit.
    groups: Vec<RowGroup>,
    /// Correlation coefficients of the rows.
    rows: Vec<Vec<Option<f64>>>,
    /// Covariance matrix of the parameters of each calibration function.
    functions: Vec<Vec<Vec<f64>>>,
}

/// The rows of a `dcc:result`, in order.
#[derive(Debug, Default)]
struct RowGroup {
    rows: Vec<CertificateRow>,
}

/// A row of the certificate.
#[derive(Clone, Copy, Debug)]
struct CertificateRow {
    number: usize,
    /// Whether its coverage interval stands in a quantity of its own.
    has_interval: bool,
    /// Whether it has a nominal value. Rows with one and rows without are in two lists, that of the
    /// first row before the other.
    has_nominal: bool,
}

impl RowGroup {
    /// The rows of a list of the result, of which there are so many.
    fn list(&self, place: usize, count: usize) -> Vec<CertificateRow> {
        let first = self.rows.first().is_some_and(|row| row.has_nominal);
        let is_in = |row: &&CertificateRow| count < 2 || (row.has_nominal == first) == (place == 0);
        self.rows.iter().filter(is_in).copied().collect()
    }
}

/// What an input is of such a certificate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum InputOrigin {
    Row(usize),
    /// A parameter of a calibration function.
    Parameter(usize, usize),
}

/// A result of such a certificate.
#[derive(Clone, Debug)]
pub(crate) struct Certified {
    of: Arc<OwnCertificate>,
    part: InputOrigin,
}

impl Certified {
    /// The correlation coefficient with another result; `None` where nothing is known of it.
    pub(crate) fn correlation(&self, other: &Self) -> Option<f64> {
        if !Arc::ptr_eq(&self.of, &other.of) {
            return None;
        }
        match (self.part, other.part) {
            (InputOrigin::Row(a), InputOrigin::Row(b)) => *self.of.rows.get(a)?.get(b)?,
            (InputOrigin::Parameter(of, a), InputOrigin::Parameter(with, b)) if of == with => {
                let covariance = self.of.functions.get(of)?;
                let at = |i: usize, j: usize| covariance.get(i)?.get(j).copied();
                Some((at(a, b)? / (at(a, a)? * at(b, b)?).sqrt()).clamp(-1.0, 1.0))
            }
            _ => None,
        }
    }
}

impl OwnCertificate {
    /// What the attached answer says; `None` for certificates of others.
    pub(super) fn of(document: &Document<'_>) -> Option<Self> {
        let name = |node: &Node<'_, '_>| node.tag_name().name() == "byteData";
        let attached = document.descendants().filter(name).filter_map(carried::attachment);
        let answer = attached
            .filter(|(name, _)| name == "result.json")
            .find_map(|(_, bytes)| serde_json::from_slice::<Value>(&bytes).ok())?;
        answer.get("gumption")?;
        let mut groups: Vec<([&str; 2], RowGroup)> = Vec::new();
        for (number, row) in answer.get("rows")?.as_array()?.iter().enumerate() {
            let of = [row.get("output")?.as_str()?, row.get("unit")?.as_str()?];
            let place = groups.iter().position(|(known, _)| *known == of);
            let place = place.unwrap_or_else(|| {
                groups.push((of, RowGroup::default()));
                groups.len() - 1
            });
            let Some((_, group)) = groups.get_mut(place) else { continue };
            let has_interval = row.pointer("/stated/interval").is_some_and(Value::is_array);
            let has_nominal = row.get("nominal").is_some_and(Value::is_number);
            group.rows.push(CertificateRow { number, has_interval, has_nominal });
        }
        let matrix = |value: &Value| -> Option<Vec<Vec<Option<f64>>>> {
            let row = |row: &Value| Some(row.as_array()?.iter().map(Value::as_f64).collect());
            value.as_array()?.iter().map(row).collect()
        };
        let functions = answer.get("functions").and_then(Value::as_array);
        let functions = functions.into_iter().flatten().map(|function| {
            let covariance = matrix(function.get("fit")?.get("covariance")?)?;
            covariance.into_iter().map(|row| row.into_iter().collect()).collect()
        });
        Some(Self {
            groups: groups.into_iter().map(|(_, group)| group).collect(),
            rows: matrix(answer.get("correlations")?)?,
            functions: functions.collect::<Option<_>>()?,
        })
    }

    /// The result that a value of a quantity is.
    pub(super) fn part(self: &Arc<Self>, node: Node<'_, '_>, place: usize) -> Option<Certified> {
        let is = |node: &Node<'_, '_>, name: &str| node.tag_name().name() == name;
        let result = node.ancestors().find(|ancestor| is(ancestor, "result"))?;
        let before = result
            .prev_siblings()
            .filter(|sibling| is(sibling, "result") && *sibling != result)
            .count();
        let part = match self.groups.get(before) {
            Some(group) => {
                let is_interval = intervals::is_interval(node);
                let list = node.parent().filter(|parent| is(parent, "list"))?;
                // conditions and nominal values have other values
                let quantities = list.children().filter(|child| is(child, "quantity"));
                let mut measured = quantities.filter(|quantity| {
                    super::document::has_ref_type(*quantity, "basic_measuredValue")
                });
                let is_row = measured.next() == Some(node) || is_interval;
                is_row.then_some(())?;
                let lists: Vec<_> =
                    result.descendants().filter(|descendant| is(descendant, "list")).collect();
                let own = lists.iter().position(|other| *other == list)?;
                let rows = group.list(own, lists.len()).into_iter();
                let mut rows = rows.filter(|row| !is_interval || row.has_interval);
                InputOrigin::Row(rows.nth(place)?.number)
            }
            None => {
                let function = before - self.groups.len();
                let count = self.functions.get(function)?.len();
                // behind the list of x and of values
                let data = node.parent().filter(|parent| is(parent, "data"))?;
                let mut own = data.children().filter(|child| is(child, "quantity"));
                let number = own.position(|quantity| quantity == node)?;
                (number < count).then_some(InputOrigin::Parameter(function, number))?
            }
        };
        Some(Certified { of: Arc::clone(self), part })
    }
}
