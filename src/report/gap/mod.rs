//! Reports of the gap diagnosis, one file for each format.

mod check_json;
mod json;

pub use check_json::check_json;
pub use json::json;
