//! Reports of the gap diagnosis, one file for each format.
pub mod check;
mod check_json;
mod composed;
mod csv;
mod departure;
mod digits;
mod groups;
mod html;
mod json;
mod markdown;
mod page;
mod residuals;
mod sheets;
mod strength;
mod terminal;
mod words;

pub use check_json::check_json;
pub use csv::csv;
pub use html::html;
pub use json::json;
pub use markdown::markdown;
pub use page::table;
pub use words::note;

#[cfg(test)]
mod tests;
