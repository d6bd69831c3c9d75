//! Measurement models of published calibrations as typed functions.

#![cfg_attr(test, allow(clippy::disallowed_methods))] // tests compare within tolerances
#![deny(unsafe_code)]

mod catalogue;

pub use catalogue::catalogue;

mod axis_sensitivity;
mod gravity_rotation;
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
mod seismic_response;
mod sensitivity;
mod sensitivity_matrix;
mod spurious_component;
mod triple;
mod wave_interference;

pub use axis_sensitivity::{AxisSensitivities, AxisSensitivity};
pub use gravity_rotation::{GravityRotation, GravityRotationParameters};
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
pub use seismic_response::{SeismicResponse, SeismicSensitivity};
pub use sensitivity::{Sensitivity, SensitivityRatio};
pub use sensitivity_matrix::{SensitivityMatrix, SensitivityMatrixElements};
pub use spurious_component::{
    SpuriousComponent, SpuriousComponentFound, SpuriousComponentInverse, SpuriousComponentModulus,
    SpuriousComponentSolutions, SpuriousComponentSum,
};
pub use wave_interference::{WaveInterference, WaveInterferenceSum};

#[cfg(test)]
mod tests;
