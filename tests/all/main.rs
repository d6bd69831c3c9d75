//! Tests of the whole program: files in, answers out.
#![allow(missing_docs)]

mod cases;
mod commands;
mod errors;
mod intervals;
mod mutations;
mod reproducible;
mod support;
