//! Reports of the gap diagnosis, one file for each format.

mod json;

pub use json::json;
