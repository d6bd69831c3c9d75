//! User files: read, validated, turned into tasks. Every mistake is a [`Problem`] with its place.
//!
//! Reading goes on after a mistake, so that all of a file's mistakes are reported at once; only
//! text that is not JSON stops it.

pub(crate) mod bytes;
mod conditions;
mod correlations;
mod fault;
mod inputs;
mod json;
mod known;
mod links;
mod model_file;
mod nearest;
mod object;
mod outputs;
mod paired;
mod problem;
mod result_file;
mod samples;
mod settings;
mod shapes;
mod size;
mod source;
mod table;
mod width;

pub use fault::Fault;
pub use model_file::{ModelFile, Override, Overrides, read, read_text};
pub use nearest::nearest;
pub use problem::{Problem, Problems};
pub use source::Source;
