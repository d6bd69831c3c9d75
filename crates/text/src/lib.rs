//! Texts with positions: what was read, where an error lies, and the message about it. The crate
//! holds JSON whose members know their positions, values and widths as people write them, tables,
//! and the sheets of workbooks. The crates that read files decide what a text means for a
//! measurement.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

pub mod angle_branches;
pub mod bytes;
pub mod column_heading;
pub mod date;
pub mod deviation_words;
mod diagnostic_kind;
mod diagnostics;
mod folder;
pub mod implied_dof;
pub mod json;
pub mod named_shape;
pub mod notation;
mod number_format;
pub mod object;
pub mod other_names;
mod sexagesimal;
pub mod share;
mod source;
pub mod table;
pub mod text_table;
pub mod value_text;
pub mod width;
pub mod workbook;
pub mod xml_limits;

pub use diagnostic_kind::{DiagnosticKind, WIDTHS};
pub use diagnostics::{Collector, Diagnostic, Diagnostics, is_obeyed, printable};
pub use folder::{FileSource, Folder};
pub use source::{Place, SourceText};
