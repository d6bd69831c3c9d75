//! Measurements written as Rust functions.
//!
//! A measurement is a struct of named quantities, generic over the number, and one function:
//!
//! ```
//! use gumption_engine::model::typed::Equations;
//! use gumption_engine::number::Number;
//!
//! gumption_engine::measurement! {
//!     /// Mean acceleration of a body that falls from rest.
//!     pub FreeFall as "free-fall" from "kinematics, s = a t^2 / 2";
//!     inputs {
//!         /// Height of the fall.
//!         height: "m",
//!         /// Duration of the fall.
//!         duration: "s",
//!     }
//!     outputs FreeFallResult {
//!         /// Acceleration.
//!         a: "m/s^2" = "2 height / duration^2",
//!     }
//! }
//!
//! impl<T: Number> Equations<T> for FreeFall<T> {
//!     type Outputs = FreeFallResult<T>;
//!     fn equations(self) -> FreeFallResult<T> {
//!         FreeFallResult { a: self.height * 2.0 / self.duration.square() }
//!     }
//! }
//!
//! let result = FreeFall { height: 4.903_325, duration: 1.0 }.equations();
//! assert_eq!(result.a, 9.806_65);
//! ```
//!
//! The quantities inside the function are in coherent SI units (angles in radians); the units of
//! the declaration are those in which values are given and reported unless a file says otherwise.

mod catalogue;
mod complex;
#[cfg(test)]
#[allow(unreachable_pub, reason = "the macro writes public structs")]
pub(crate) mod example;
mod measurement;

pub use catalogue::{Catalogue, CatalogueEntry};
pub use complex::Complex;
pub use measurement::{Declaration, DeclaredInput, DeclaredOutput, Equations, Measurement, Typed};
