//! Which inputs of a model have readings, and what of a file of readings it has taken.

/// The readings of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ModelReadings {
    /// Inputs and components whose shape is `readings`: their names with components, `V/scatter`.
    pub inputs: Vec<String>,
    /// Conditions that are readings themselves: columns of their table that `values` names.
    pub columns: Vec<String>,
    /// Columns that say to which group a reading belongs.
    pub groups: Vec<String>,
    /// The file that replaced readings of the model, by its name among the files that were read.
    pub file: Option<String>,
    /// Headings of a file of readings that were taken for readings and for their groups.
    pub(super) taken: Vec<String>,
    /// Headings of that file that are conditions.
    pub(super) conditions: Vec<String>,
}
