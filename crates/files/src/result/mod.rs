//! The result file: what `gumption run --save` writes and the distribution `result` reads.

mod check;
mod form;
mod named;
mod reader;
pub(crate) mod seal;
mod siblings;

pub(crate) use form::definitions;
pub use form::{DofStatus, InputForm, OutputForm, ProvenanceForm, ResultForm, ScoresForm};
pub use reader::{ResultFile, SavedOutput};
pub(crate) use reader::{is_meant, read_text};
