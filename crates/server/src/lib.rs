//! The local server of the live page: HTTP on the loopback interface, who may ask, which files, and
//! how much at once. What is asked for it asks an [`Answers`].
//!
//! It takes everything that comes in for an attack: from another site in the same browser, from
//! another user of the machine, from a model file of a stranger.

mod answers;
mod connections;
mod doorkeeper;
mod events;
mod folder;
mod lane;
mod listing;
mod memory;
mod named_file;
mod routes;
mod saving;
mod server;
mod shown_pages;
#[cfg(test)]
mod tests;
mod token;
mod watch;

pub use answers::{Answers, Exported, FileDescription, Refusal, ServedAsset, TextOfFile};
pub use folder::{OpenedFolder, Unopened};
pub use named_file::NamedFiles;
pub use server::{LocalServer, RequestTimes, ServerOptions};
