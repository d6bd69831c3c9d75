//! User files: read, validated, turned into tasks. Every mistake is a [`Diagnostic`] with its place.
//!
//! Reading goes on after a mistake, so that all of a file's mistakes are reported at once; only
//! text that is not JSON stops it.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

mod angle_branches;
mod answer;
pub mod bytes;
mod carried;
mod case;
mod catalogue;
mod certificate;
mod checked;
mod column_heading;
mod comparison;
mod condition_values;
mod conditions;
mod constant_inputs;
mod correlations;
mod costs;
mod counted_twice;
mod coverage_slips;
mod dcc;
mod deviation_words;
mod diagnostic_kind;
mod diagnostics;
mod difference;
mod effect_context;
mod effects;
mod either;
mod fits;
mod folder;
mod formula_notes;
mod history;
mod implied_dof;
mod import;
mod input_set;
mod inputs;
mod interpolated;
mod json;
mod keys;
mod known;
mod links;
mod loose_files;
mod model_checks;
mod model_file;
mod model_reader;
mod named_shape;
mod notation;
mod number_format;
mod numbers_alone;
mod object;
mod observations;
mod occasions;
mod open;
mod output_limits;
mod outputs;
mod overrides;
mod paired;
mod prior;
mod reader;
mod readings;
mod recipe;
mod regions;
mod result_consistency;
mod result_file;
mod result_outputs;
mod results;
mod samples;
pub mod schema;
mod scopes;
mod settings;
mod sexagesimal;
mod shapes;
mod share;
mod shared_run;
mod sharing;
mod simulated;
mod size;
mod soundness;
mod source;
mod table;
mod target;
mod text_table;
mod value_text;
mod variant;
mod width;
mod workbook;
mod xml_limits;

pub use carried::{CarriedModel, carried_models};
pub use case::CaseFile;
pub use catalogue::{EffectListing, ListedEffect, ListedParameter, catalogue};
pub use certificate::{CertificateFile, CertifiedModel};
pub use checked::TextKind;
pub use comparison::{
    ComparisonOptions, ComparisonTable, ReadComparison, read_comparison, read_comparison_text,
};
pub use costs::{CostFile, read_costs, read_costs_text};
pub use dcc::{
    CertificateListing, ListedPart, ListedQuantity, listing as certificate_listing,
    listing_text as certificate_listing_text,
};
pub use diagnostic_kind::DiagnosticKind;
pub use diagnostics::{Diagnostic, Diagnostics, is_obeyed, printable};
pub use difference::difference;
pub use either::ModelOrResult;
pub use folder::FileSource;
pub use gumption_columns::recording::Recording;
pub use import::{
    Coefficients, ImportOptions, ImportedBudget, Question, RefusedBudget, import_budget,
    import_budget_bytes,
};
pub use loose_files::named_in;
pub use model_file::ModelFile;
pub use overrides::{Override, Overrides};
pub use reader::{
    FileReader, check, check_text, read, read_case, read_certificate, read_recipe,
    read_recipe_text, read_result, read_text,
};
pub use recipe::{OpenedRow, RecipeCondition, RecipeFile, RecipeRow};
pub use result_file::{ResultFile, SavedOutput};
pub use shared_run::{
    SharedFileError, SharedFileHeader, SharedFileKind, SharedModelError, SharedRun, shared_file,
    shared_file_bytes,
};
pub use source::SourceText;
pub use target::{read_drift, read_target};
pub use variant::NotCopied;
