//! Measurements written as Rust functions.
//!
//! A measurement is a struct of named quantities, generic over the number, and one function:
//!
//! ```
//! use gumption::model::typed::Equations;
//! use gumption::number::Number;
//!
//! gumption::measurement! {
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
mod measurement;

pub use catalogue::{Entry, all, find};
pub use complex::Complex;
pub use measurement::{Declaration, DeclaredInput, DeclaredOutput, Equations, Measurement, Typed};

mod axis_sensitivity;
mod inclined_plane;
mod inclined_plane_spurious;
mod inclined_plane_spurious_vector;
mod mean_of_repetitions;
mod measuring_chain;
mod normalized_error;
mod phase_budget;
mod projection_45;
mod relative_sensitivity;
mod rotating_table;
mod rotating_table_instant;
mod sensitivity;
mod sensitivity_matrix;
mod spurious_component;
mod wave_interference;

pub use axis_sensitivity::{AxisSensitivities, AxisSensitivity};
pub use inclined_plane::{InclinedPlane, InclinedPlaneAccelerations};
pub use inclined_plane_spurious::{InclinedPlaneSpurious, InclinedPlaneSpuriousAccelerations};
pub use inclined_plane_spurious_vector::{
    InclinedPlaneSpuriousVector, InclinedPlaneVectorAccelerations,
};
pub use mean_of_repetitions::{MeanOfRepetitions, MeanOfRepetitionsResult};
pub use measuring_chain::{MeasuringChain, MeasuringChainResponse};
pub use normalized_error::{NormalizedError, NormalizedErrorResult};
pub use phase_budget::{PhaseBudget, PhaseBudgetResult};
pub use projection_45::{Projection45, Projection45Accelerations};
pub use relative_sensitivity::{RelativeSensitivity, RelativeSensitivityDifference};
pub use rotating_table::{RotatingTable, RotatingTableAccelerations};
pub use rotating_table_instant::{RotatingTableInstant, RotatingTableInstantMotion};
pub use sensitivity::{Sensitivity, SensitivityRatio};
pub use sensitivity_matrix::{SensitivityMatrix, SensitivityMatrixElements};
pub use spurious_component::{
    SpuriousComponent, SpuriousComponentFound, SpuriousComponentInverse, SpuriousComponentModulus,
    SpuriousComponentSolutions, SpuriousComponentSum,
};
pub use wave_interference::{WaveInterference, WaveInterferenceSum};

#[cfg(test)]
mod tests;
