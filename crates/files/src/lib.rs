//! User files: read, validated, turned into tasks. Every mistake is a
//! [`Diagnostic`](gumption_text::Diagnostic) with its place.
//!
//! Reading goes on after a mistake, so that all of a file's mistakes are reported at once; only
//! text that is not JSON stops it.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances

pub mod carried;
mod case;
mod catalogue;
mod certificate;
mod checked;
mod codata;
mod condition_formula;
mod condition_values;
mod conditions;
mod constant_inputs;
mod context;
mod correlations;
mod costs;
mod counted_twice;
mod coverage_slips;
mod dates;
mod dcc;
mod difference;
mod effect_context;
mod effects;
mod either;
mod fits;
mod formula_notes;
mod history;
mod input_set;
mod inputs;
mod instrument;
mod interpolated;
mod keys;
mod known;
mod links;
mod loose_files;
mod model_checks;
mod model_file;
mod model_reader;
mod model_readings;
mod neutral;
mod numbers_alone;
mod observations;
mod occasions;
pub mod open;
mod output_limits;
mod outputs;
mod overrides;
mod paired;
mod prior;
mod reader;
mod reading_columns;
mod readings;
mod readings_file;
mod readings_of_models;
mod recipe;
mod regions;
pub mod result;
mod results;
mod samples;
pub mod schema;
mod scopes;
mod settings;
mod shapes;
mod shared_run;
mod sharing;
mod simulated;
mod simulator;
mod simulator_case;
mod size;
mod soundness;
mod target;
mod variant;

pub use carried::{CarriedModel, carried_models};
pub use case::CaseFile;
pub use catalogue::{EffectListing, ListedEffect, ListedParameter, catalogue};
pub use certificate::{CertificateFile, CertifiedModel};
pub use checked::TextKind;
pub use codata::{MEASURED, MeasuredConstant};
pub use costs::{CostFile, read_costs, read_costs_text};
pub use dcc::{
    CertificateListing, ListedPart, ListedQuantity, listing as certificate_listing,
    listing_text as certificate_listing_text,
};
pub use difference::difference;
pub use either::ModelOrResult;
pub use gumption_columns::recording::Recording;
pub use loose_files::named_in;
pub use model_file::ModelFile;
pub use model_readings::ModelReadings;
pub use overrides::{Override, Overrides};
pub use reader::{
    FileReader, check, check_text, read, read_case, read_certificate, read_recipe,
    read_recipe_text, read_result, read_text,
};
pub use readings_file::ReadingsFile;
pub use recipe::{OpenedRow, RecipeCondition, RecipeFile, RecipeRow};
pub use result::{ResultFile, SavedOutput};
pub use shared_run::{
    SharedFileError, SharedFileHeader, SharedFileKind, SharedModelError, SharedRun, shared_file,
    shared_file_bytes,
};
pub use target::{read_drift, read_target};
pub use variant::NotCopied;
