//! The reference of files and formulas: tables generated from the reader, the unit parser and the
//! formula parser, so that they always match the version of the program.

mod distributions;
mod functions;
mod keys;
#[cfg(test)]
mod tests;
mod units;

use super::document::{self, Block, Document};

/// The topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topic {
    /// The keys of a model file.
    Model,
    /// The keys that make a model file a case of the gap diagnosis.
    Case,
    /// The keys of a certificate file.
    Certificate,
    /// The keys of a recipe.
    Recipe,
    /// The keys of a file of costs.
    Costs,
    /// The keys of a saved result.
    SavedResult,
    /// The distributions with their keys and standard uncertainties.
    Distributions,
    /// The functions and operators of formulas.
    Functions,
    /// The unit symbols and prefixes.
    Units,
}

impl Topic {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Model,
        Self::Distributions,
        Self::Functions,
        Self::Units,
        Self::Case,
        Self::Certificate,
        Self::Recipe,
        Self::Costs,
        Self::SavedResult,
    ];

    /// Its name on the command line and in the manual.
    pub fn name(self) -> &'static str {
        match self {
            Self::Model => "model",
            Self::Case => "case",
            Self::Certificate => "certificate-file",
            Self::Recipe => "recipe",
            Self::Costs => "costs",
            Self::SavedResult => "saved-result",
            Self::Distributions => "distributions",
            Self::Functions => "functions",
            Self::Units => "units",
        }
    }

    /// Its subject, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Model => "the keys of a model file",
            Self::Case => "the keys that make a model file a case of `gumption gap`",
            Self::Certificate => "the keys of a certificate file",
            Self::Recipe => "the keys of a recipe of `gumption observe`",
            Self::Costs => "the keys of a file of costs of `gumption plan`",
            Self::SavedResult => "the keys of what `run --save` writes",
            Self::Distributions => "the distributions, their keys and standard uncertainties",
            Self::Functions => "the operators, functions and constants of formulas",
            Self::Units => "the unit symbols and prefixes",
        }
    }

    fn document(self) -> Document {
        match self {
            Self::Model => keys::document(
                "Model file",
                "model",
                &["observations", "effects", "catalogue", "prior"],
            ),
            Self::Case => keys::of_case(),
            Self::Certificate => keys::document("Certificate file", "certificate", &[]),
            Self::Recipe => keys::document("Recipe", "recipe", &[]),
            Self::Costs => keys::document("File of costs", "costs", &[]),
            Self::SavedResult => keys::document("Saved result", "result", &[]),
            Self::Distributions => distributions::document(),
            Self::Functions => functions::document(),
            Self::Units => units::document(),
        }
    }
}

/// The topic as a text page for a terminal.
pub fn table(topic: Topic) -> String {
    let mut document = topic.document();
    // code is recognized by its column
    for block in &mut document.blocks {
        if let Block::Table(sheet) = block {
            let cells = sheet.columns.iter_mut().flat_map(|column| &mut column.cells);
            cells.for_each(|cell| cell.retain(|letter| letter != '`'));
        }
    }
    document::text(|| document)
}

/// The topic as Markdown.
pub fn markdown(topic: Topic) -> String {
    document::markdown_with_code(&topic.document())
}
