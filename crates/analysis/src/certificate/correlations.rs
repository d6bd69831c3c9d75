//! Correlations between the rows of a certificate.
//!
//! Two rows share an input if it has the same name in the same model file, whatever the conditions
//! and replacements of the rows. Results that go back to the same input through saved results share
//! it too. An input of a row or of one condition (`per`), and an input that the certificate
//! declares separate, is shared only if its value is the same unknown one. The covariance of two
//! rows is then the sum over the shared inputs of c_i u_i in both (JCGM 100, F.1.2.3).

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::certificate::contents::{Asked, Certificate};
use gumption_engine::distribution::RootName;
use gumption_engine::propagate::gum::Gum;
use gumption_engine::propagate::{Evaluation, Origins, linear, origins, own_roots};
use gumption_engine::task::{Row, Sharing};

/// An unknown value: model file, input, and a text that distinguishes values of the same input.
type Key = (Arc<str>, Arc<str>, String);

/// How the rows of a certificate vary together.
pub(super) struct RowCorrelations {
    /// The matrix of the coefficients.
    pub(super) coefficients: Vec<Vec<Option<f64>>>,
    /// The standard uncertainties to which they belong.
    pub(super) spreads: Vec<Option<f64>>,
    /// The names of the inputs with one unknown value for several rows.
    pub(super) shared_inputs: Vec<String>,
}

/// The matrix of the correlation coefficients between all rows, and the standard uncertainties to
/// which they belong. A row that is `raised` to the laboratory's capability has the standard
/// uncertainty of the capability if that is larger; no other row shares the added part.
pub(super) fn between(
    certificate: &Certificate,
    evaluations: &[Evaluation],
    digests: &[Arc<str>],
    raised: &[Option<f64>],
) -> RowCorrelations {
    let own = own_roots_of(certificate, digests);
    let (places, links) = Default::default();
    let mut unknowns = Unknowns { certificate, own, places, links };
    let mut found: BTreeMap<(usize, usize), Vec<Option<ContributionsByValue>>> = BTreeMap::new();
    let parts: Vec<Option<ContributionsByValue>> = certificate
        .lines
        .iter()
        .map(|line| {
            let (number, row) = (line.evaluation, line.row);
            let of_row = found.entry((number, row)).or_insert_with(|| {
                unknowns.of_row(number, row, evaluations, digests).unwrap_or_default()
            });
            of_row.get(line.output).cloned().flatten()
        })
        .collect();
    let covariance = |a: &ContributionsByValue, b: &ContributionsByValue| unknowns.covariance(a, b);
    let spread: Vec<Option<f64>> = parts
        .iter()
        .map(|part| part.as_ref().map(|p| covariance(p, p).sqrt()).filter(|u| *u > 0.0))
        .zip(raised)
        .map(|(evaluated, raised)| Some(evaluated?.max(raised.unwrap_or(0.0))))
        .collect();
    let coefficient = |i: usize, j: usize| {
        let (a, b) = (parts[i].as_ref()?, parts[j].as_ref()?);
        let (u, v) = (spread[i]?, spread[j]?);
        Some(if i == j { 1.0 } else { (covariance(a, b) / u / v).clamp(-1.0, 1.0) })
    };
    let count = parts.len();
    // both halves of the matrix from the same sum
    let row = |i: usize| (0..count).map(|j| coefficient(i.min(j), i.max(j))).collect();
    let coefficients = (0..count).map(row).collect();
    let shared_inputs = unknowns.shared_by(&parts);
    RowCorrelations { coefficients, spreads: spread, shared_inputs }
}

/// Contributions c u to a result, by unknown value.
type ContributionsByValue = BTreeMap<usize, f64>;

/// The unknown values behind all rows.
struct Unknowns<'a> {
    certificate: &'a Certificate,
    /// The inputs of the certificate's own evaluations, as saved results name them.
    own: BTreeSet<RootName>,
    places: BTreeMap<Key, usize>,
    /// Declared correlation coefficients, in both orders.
    links: BTreeMap<usize, BTreeMap<usize, f64>>,
}

impl Unknowns<'_> {
    /// The contributions to each output of a row of conditions.
    fn of_row(
        &mut self,
        number: usize,
        row: usize,
        evaluations: &[Evaluation],
        digests: &[Arc<str>],
    ) -> Option<Vec<Option<ContributionsByValue>>> {
        let asked = self.certificate.evaluations.get(number)?;
        let outputs = &evaluations.get(number)?.rows.get(row)?.outputs;
        let digest = digests.get(asked.file)?;
        let conditions = asked.task.rows.get(row)?;
        let gums: Vec<Option<&Gum>> = outputs.iter().map(linear).collect();
        let Origins { roots, sensitivities, correlations } =
            origins(&asked.task, conditions, &gums, digest);
        let mut place = |name: &RootName| {
            let own = &self.own;
            let key = key(self.certificate, own, number, asked, conditions, name, digest);
            let next = self.places.len();
            *self.places.entry(key).or_insert(next)
        };
        let places: Vec<usize> = roots.iter().map(|root| place(&root.name)).collect();
        for link in &correlations {
            let (a, b) = (place(&link.first), place(&link.second));
            for (a, b) in [(a, b), (b, a)] {
                self.links.entry(a).or_default().insert(b, link.coefficient);
            }
        }
        let parts = sensitivities.into_iter().map(|sensitivities| {
            let mut parts = ContributionsByValue::new();
            for ((place, root), c) in places.iter().zip(&roots).zip(sensitivities?) {
                *parts.entry(*place).or_insert(0.0) += c * root.standard_uncertainty;
            }
            Some(parts)
        });
        Some(parts.collect())
    }

    /// The names of the inputs to which several rows owe a contribution.
    fn shared_by(&self, parts: &[Option<ContributionsByValue>]) -> Vec<String> {
        let owe = |place: usize| {
            let parts = parts.iter().flatten();
            parts.filter(|part| part.get(&place).is_some_and(|part| *part != 0.0)).count()
        };
        let shared = self.places.iter().filter(|(_, place)| owe(**place) > 1);
        let names: BTreeMap<usize, &str> =
            shared.map(|((_, name, _), place)| (*place, &**name)).collect();
        let mut found: Vec<String> = Vec::new();
        for name in names.into_values().filter(|name| !name.is_empty()) {
            if !found.iter().any(|known| known == name) {
                found.push(name.to_owned());
            }
        }
        found
    }

    fn covariance(&self, a: &ContributionsByValue, b: &ContributionsByValue) -> f64 {
        let mut sum = 0.0;
        for (place, part) in a {
            sum += part * b.get(place).copied().unwrap_or(0.0);
            for (other, r) in self.links.get(place).into_iter().flatten() {
                sum += r * part * b.get(other).copied().unwrap_or(0.0);
            }
        }
        sum
    }
}

/// The inputs of the certificate's evaluations that are shared by all rows of their model file.
fn own_roots_of(certificate: &Certificate, digests: &[Arc<str>]) -> BTreeSet<RootName> {
    let mut own = BTreeSet::new();
    let rows: BTreeSet<(usize, usize)> =
        certificate.lines.iter().map(|line| (line.evaluation, line.row)).collect();
    for (number, row) in rows {
        let Some(asked) = certificate.evaluations.get(number) else { continue };
        if let (Some(digest), Some(row)) = (digests.get(asked.file), asked.task.rows.get(row)) {
            own.extend(own_roots(&asked.task, row, digest));
        }
    }
    own
}

/// The key of an input's value: the same for the same unknown value.
fn key(
    certificate: &Certificate,
    own: &BTreeSet<RootName>,
    number: usize,
    asked: &Asked,
    row: &Row,
    name: &RootName,
    digest: &Arc<str>,
) -> Key {
    let listed = |names: &[String]| {
        names.iter().any(|listed| {
            let rest = name.name.strip_prefix(listed.as_str());
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        })
    };
    // a value of another certificate is the same in all model files
    let (of, called) = match &name.certified {
        Some(certified) => (certified.clone(), Arc::from("")),
        None => (name.model.clone(), name.name.clone()),
    };
    if name.model != *digest {
        // an input of another model file, behind a saved result; if the certificate evaluates that
        // file itself with the same values and data, it is the input that its rows share
        let is_told = own.contains(name) || name.certified.is_some();
        let told = if is_told { String::new() } else { format!("result {}", name.instance) };
        return (of, called, told);
    }
    let variable = asked.task.variables.iter().find(|v| *v.name == *name.name);
    let own = match variable.map(|variable| &variable.sharing) {
        _ if listed(&certificate.separate) => format!("{number}{:?}", row.conditions),
        Some(Sharing::Row) => format!("{number}{:?}", row.conditions),
        Some(Sharing::Condition(place)) => format!("{place}{:?}", row.conditions.get(*place)),
        Some(Sharing::All) | None => String::new(),
    };
    if listed(&certificate.shared) {
        return (Arc::from(""), name.name.clone(), own);
    }
    (of, called, own)
}
