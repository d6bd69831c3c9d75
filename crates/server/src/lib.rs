//! The local server of the live page: HTTP on the loopback interface, access control, file access,
//! and limits. An [`Answers`] computes the answers.
//!
//! It treats every request as a possible attack: from another site in the same browser, from
//! another user of the machine, or from a stranger's model file.

mod answers;
mod connections;
mod doorkeeper;
mod events;
mod folder;
mod lane;
mod listing;
mod memory;
mod named_file;
mod progress;
mod routes;
mod saving;
mod server;
mod shown_pages;
#[cfg(test)]
mod tests;
mod token;
mod watch;

pub use answers::{
    Answers, EvaluatedPage, Exported, FileDescription, Refusal, ServedAsset, TextOfFile,
};
pub use folder::{OpenedFolder, Unopened};
pub use named_file::NamedFiles;
pub use server::{LocalServer, RequestTimes, ServerOptions};
