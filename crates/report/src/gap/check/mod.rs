//! The pages of a blind check of the diagnosis.

mod confusion;
mod design;
mod label;
mod matrix;
mod page;
mod reliability;
mod sheets;
mod words;

pub use design::CheckedDesign;
pub use page::{html, table};
