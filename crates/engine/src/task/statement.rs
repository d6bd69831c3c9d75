//! The measurement model as people read it.

use crate::model::typed::Declaration;

/// The measurement model in words, for the pages that state it.
///
/// A model of formulas has those of its file. A typed model is a function in Rust; its declaration
/// says what the function computes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct ModelStatement {
    /// The name of the typed model; `None` for formulas.
    pub name: Option<String>,
    /// The document that the typed model follows; empty for formulas.
    pub source: String,
    /// Quantities with their equations, in the order in which they are computed.
    pub equations: Vec<(String, String)>,
}

impl ModelStatement {
    /// The statement of formulas: quantities with the formulas as they were written.
    pub fn of_formulas(formulas: impl IntoIterator<Item = (String, String)>) -> Self {
        Self { equations: formulas.into_iter().collect(), ..Self::default() }
    }

    /// What a typed model declares. All of its equations are stated, whichever outputs are asked
    /// for, because the text of one may refer to another.
    pub fn of_declaration(declaration: &Declaration) -> Self {
        let equations = declaration.outputs.iter();
        Self {
            name: Some(declaration.name.to_owned()),
            source: declaration.source.trim().to_owned(),
            equations: equations
                .map(|output| (output.name.to_owned(), output.equation.trim().to_owned()))
                .collect(),
        }
    }
}
