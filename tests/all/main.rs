//! Tests of the whole program: files in, answers out.
#![cfg(feature = "cli")]
#![allow(clippy::disallowed_methods)] // nothing of this is printed as a result
#![allow(missing_docs)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]
#![allow(clippy::print_stderr)]
// the programs that make data share a module, and the tests run both programs
#![allow(clippy::duplicate_mod)]

mod adaptive;
mod answers;
mod assumptions;
mod benches;
mod cases;
mod catalogue;
mod certificate;
mod certificate_claims;
mod certificate_layout;
mod circles;
mod codata;
mod commands;
mod compare;
mod complex;
mod conformity;
mod contract;
mod diff;
mod errors;
mod figures_beside;
mod first_screen;
mod formulas;
mod fuzz;
mod gap;
mod gap_check;
mod gap_examples;
mod gauge_study;
mod headings;
mod help;
mod integrity;
mod interrupt;
mod intervals;
mod laboratory;
mod manual;
mod manual_pictures;
mod observe;
mod observe_instruments;
mod observe_slips;
mod observe_steps;
mod one_number;
#[cfg(feature = "open")]
mod open;
#[cfg(feature = "open")]
mod open_attacks;
mod other_distributions;
mod outputs;
mod own_case;
mod own_program;
#[cfg(feature = "open")]
mod page_server;
mod pages;
mod parts;
mod phases;
mod planning;
mod process;
mod published;
mod recordings;
mod reports;
mod reproducible;
mod result_trials;
mod results;
mod same_inputs;
mod schema;
mod seeds;
mod seldom_meant;
mod simulator_process;
mod simulators;
mod sizes;
mod stack;
mod strangers;
mod support;
mod temperatures;
mod todays_readings;
mod units;
mod verify;
mod ways_in;
mod words;
mod workspace;
mod wrong_files;
mod wrong_numbers;
mod zeros;
