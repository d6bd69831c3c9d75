//! The measurements that files can name.

use super::{Measurement, Typed};

/// A measurement of a catalogue.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct CatalogueEntry {
    /// The measurement.
    pub typed: Typed,
    /// Names of the inputs and outputs whose unit is free: a file may give them any unit, the same
    /// dimension for all of them, in place of the declared one.
    pub any_unit: &'static [&'static str],
    /// A model file of this measurement, ready to run and to be filled with other numbers.
    pub template: Option<&'static str>,
}

impl CatalogueEntry {
    /// A measurement whose units are those of its declaration, without a template.
    pub fn of<M: Measurement>() -> Self {
        Self { typed: Typed::of::<M>(), any_unit: &[], template: None }
    }

    /// The same with inputs and outputs whose unit is free.
    #[must_use]
    pub fn any_unit(self, names: &'static [&'static str]) -> Self {
        Self { any_unit: names, ..self }
    }

    /// The same with a model file to start from.
    #[must_use]
    pub fn template(self, text: &'static str) -> Self {
        Self { template: Some(text), ..self }
    }

    /// The name that files use.
    pub fn name(&self) -> &'static str {
        self.typed.declaration.name
    }
}

/// Measurements by the names that files use, in the order in which they are listed.
#[derive(Clone, Debug, Default)]
pub struct Catalogue(Vec<CatalogueEntry>);

impl Catalogue {
    /// No measurements.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with one more measurement; it takes the place of one of the same name.
    #[must_use]
    pub fn with(mut self, entry: CatalogueEntry) -> Self {
        match self.0.iter_mut().find(|known| known.name() == entry.name()) {
            Some(known) => *known = entry,
            None => self.0.push(entry),
        }
        self
    }

    /// The measurement of that name.
    pub fn find(&self, name: &str) -> Option<&CatalogueEntry> {
        self.0.iter().find(|entry| entry.name() == name)
    }

    /// All measurements.
    pub fn iter(&self) -> std::slice::Iter<'_, CatalogueEntry> {
        self.0.iter()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<'c> IntoIterator for &'c Catalogue {
    type Item = &'c CatalogueEntry;
    type IntoIter = std::slice::Iter<'c, CatalogueEntry>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl FromIterator<CatalogueEntry> for Catalogue {
    fn from_iter<I: IntoIterator<Item = CatalogueEntry>>(entries: I) -> Self {
        entries.into_iter().fold(Self::default(), Self::with)
    }
}

#[cfg(test)]
mod tests {
    use super::super::example::Projection;
    use super::*;

    #[test]
    fn a_name_stands_for_one_measurement() {
        let entry = CatalogueEntry::of::<Projection<()>>();
        let catalogue = Catalogue::new().with(entry).with(entry.template("{}"));
        assert_eq!(catalogue.len(), 1);
        assert_eq!(catalogue.find("projection").and_then(|entry| entry.template), Some("{}"));
        assert!(catalogue.find("Projection").is_none() && Catalogue::new().is_empty());
    }
}
