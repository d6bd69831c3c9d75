//! The pages of a blind check of the diagnosis.

mod confusion;
mod design;
mod html;
mod label;
mod matrix;
mod reliability;
mod sheets;
mod table;
mod words;

pub use design::CheckedDesign;
pub use html::html;
pub use table::table;
