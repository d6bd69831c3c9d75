//! What the benches share: the tasks that they evaluate and the clock that they read.
#![allow(dead_code, unreachable_pub)] // every bench is a crate of its own and uses a part

pub mod columns;
pub mod cpu_time;
pub mod difference;
pub mod generated;
pub mod median;
pub mod plain;
pub mod workloads;
