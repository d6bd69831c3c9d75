//! The statistics of the diagnosis against exact values and independent computations.

mod beside;
mod by_hand;
#[path = "../../../inference/src/tests/cases.rs"]
pub(crate) mod cases;
mod composed;
mod copies;
#[path = "../../../../examples/departures/mod.rs"]
mod departures;
mod estimates;
#[path = "../../../../examples/generator/mod.rs"]
mod generator;
mod interrupted;
mod next;
mod noise;
mod one_row;
mod regions;
mod replication;
mod simulated;
