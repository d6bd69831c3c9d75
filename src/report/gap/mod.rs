//! Reports of the gap diagnosis, one file for each format.

#[cfg(feature = "cli")]
pub mod check;
mod check_json;
mod csv;
#[cfg(feature = "cli")]
mod digits;
#[cfg(feature = "cli")]
mod html;
mod json;
#[cfg(feature = "cli")]
mod residuals;
#[cfg(feature = "cli")]
mod sheets;
#[cfg(feature = "cli")]
mod table;
#[cfg(feature = "cli")]
mod terminal;
#[cfg(feature = "cli")]
mod words;

pub use check_json::check_json;
pub use csv::csv;
#[cfg(feature = "cli")]
pub use html::html;
pub use json::json;
#[cfg(feature = "cli")]
pub use table::table;

#[cfg(test)]
#[cfg(feature = "cli")]
mod tests;
