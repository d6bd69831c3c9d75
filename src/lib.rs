//! Measurement uncertainty: the law of propagation (JCGM 100) and the Monte Carlo method
//! (JCGM 101) side by side.
//!
//! # Evaluating a measurement
//!
//! A measurement that is built in takes what is known about its inputs and is evaluated in one
//! call:
//!
//! ```
//! use gumption::distribution::Input;
//! use gumption::model::typed::InclinedPlane;
//! use gumption::propagate::{Control, evaluate};
//! use gumption::task::{Settings, Task};
//!
//! let plane = InclinedPlane {
//!     a_ref: Input::normal(10.0, 0.01, "m/s^2")?,
//!     tilt: Input::rectangular(35.0, 0.1, "deg")?,
//!     rotation: Input::rectangular(30.0, 0.1, "deg")?,
//! };
//! let evaluation = evaluate(&Task::of(plane, Settings::default())?, &Control::default())?;
//! let a_x = &evaluation.rows[0].outputs[0];
//! let (gum, trials) = (a_x.gum.as_ref().unwrap(), a_x.monte_carlo.as_ref().unwrap());
//! // 10 sin(35 deg) cos(30 deg) m/s^2; u from the three contributions
//! assert!((gum.estimate - 4.967_318).abs() < 1e-6);
//! assert!((gum.standard_uncertainty - 0.009_172).abs() < 1e-6);
//! assert!(trials.symmetric_interval[0] > gum.interval().unwrap()[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A measurement of your own
//!
//! Declare its quantities with [`measurement!`] and write its equations once, generic over the
//! [`Number`](number::Number):
//!
//! ```
#![doc = include_str!("../examples/own_measurement.rs")]
//! ```
//!
//! # Rooms
//!
//! Data flows one way: [`mod@file`] -> [`task`] -> [`propagate`] -> [`report`]; [`number`], [`mod@unit`],
//! [`distribution`] and [`model`] are what tasks are made of. The library prints nothing and starts
//! nothing by itself; progress, stopping, threads and memory are the caller's
//! ([`propagate::Control`]).
//!
//! # Crate features
//!
//! `cli` (default): the command line, with what it needs to read arguments, draw tables and show
//! progress.

#![deny(unsafe_code)]

pub use gumption_analysis::{assumptions, certificate, compare};
#[cfg(feature = "cli")]
pub use gumption_command as command;
pub use gumption_diff as diff;
pub use gumption_engine::{decimal, distribution, measurement, model, number, propagate, task};
pub use gumption_files as file;
pub use gumption_files::schema;
pub use gumption_gap as gap;
pub use gumption_measurements as measurements;
pub use gumption_report as report;
pub use gumption_signal as observe;
pub use gumption_units as unit;
