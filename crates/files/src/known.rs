//! What is known about the variables in every row of conditions: one distribution for all rows where
//! nothing changes, one for each row else.

use std::sync::Arc;

use gumption_engine::distribution::Distribution;

/// The distributions of all variables, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct KnownVariables {
    variables: Vec<Option<OfVariable>>,
}

#[derive(Clone, Debug)]
enum OfVariable {
    Always(Arc<Distribution>),
    InRow(Vec<Arc<Distribution>>),
}

impl KnownVariables {
    /// A variable that has the same distribution in all rows.
    pub(super) fn always(&mut self, variable: usize, distribution: Distribution) {
        self.put(variable, OfVariable::Always(Arc::new(distribution)));
    }

    /// A variable with its distribution in each row.
    pub(super) fn in_rows(&mut self, variable: usize, distributions: Vec<Distribution>) {
        let distributions = distributions.into_iter().map(Arc::new).collect();
        self.put(variable, OfVariable::InRow(distributions));
    }

    fn put(&mut self, variable: usize, known: OfVariable) {
        if self.variables.len() <= variable {
            self.variables.resize(variable + 1, None);
        }
        if let Some(place) = self.variables.get_mut(variable) {
            *place = Some(known);
        }
    }

    /// What is known about a variable in a row; `None` after a mistake that was reported.
    pub(super) fn get(&self, variable: usize, row: usize) -> Option<&Arc<Distribution>> {
        match self.variables.get(variable)?.as_ref()? {
            OfVariable::Always(distribution) => Some(distribution),
            OfVariable::InRow(distributions) => distributions.get(row),
        }
    }

    /// Whether what is known of a variable is stated for each row.
    pub(super) fn is_of_rows(&self, variable: usize) -> bool {
        matches!(self.variables.get(variable), Some(Some(OfVariable::InRow(_))))
    }

    /// Whether a variable is not a constant in every row.
    pub(super) fn varies(&self, variable: usize) -> bool {
        let varies = |distribution: &Arc<Distribution>| distribution.constant().is_none();
        match self.variables.get(variable) {
            Some(Some(OfVariable::Always(distribution))) => varies(distribution),
            Some(Some(OfVariable::InRow(distributions))) => distributions.iter().any(varies),
            _ => false,
        }
    }

    /// Changes what is known about a variable, in every row.
    pub(super) fn change(&mut self, variable: usize, change: impl Fn(&mut Distribution)) {
        match self.variables.get_mut(variable) {
            Some(Some(OfVariable::Always(distribution))) => change(Arc::make_mut(distribution)),
            Some(Some(OfVariable::InRow(distributions))) => {
                distributions.iter_mut().for_each(|d| change(Arc::make_mut(d)));
            }
            _ => {}
        }
    }

    /// Whether there is something known about each of so many variables.
    pub(super) fn is_complete(&self, variables: usize) -> bool {
        self.variables.len() == variables && self.variables.iter().all(Option::is_some)
    }

    /// The rows, so many of them, of variables about which something is known. Where nothing
    /// changes they are one and the same.
    pub(super) fn rows(&self, rows: usize) -> impl Iterator<Item = Arc<[Arc<Distribution>]>> + '_ {
        let row = |row: usize| -> Arc<[Arc<Distribution>]> {
            (0..self.variables.len()).filter_map(|v| self.get(v, row).cloned()).collect()
        };
        let changes = |v: &Option<OfVariable>| matches!(v, Some(OfVariable::InRow(_)));
        let first = (!self.variables.iter().any(changes)).then(|| row(0));
        (0..rows).map(move |number| first.as_ref().map_or_else(|| row(number), Arc::clone))
    }
}
