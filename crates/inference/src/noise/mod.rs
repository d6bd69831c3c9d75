//! What the noise of the data may be, other than stated, and the hypotheses weighed with each of these noises.

pub(crate) mod beside_departure;
pub mod common_noise;
pub(crate) mod common_noise_search;
pub mod copies;
pub(crate) mod influence;
pub(crate) mod needless;
pub mod noise_model;
pub mod over_noises;
pub mod prior_widths;
pub mod remainder;
pub mod resolution;
pub mod shared_noise;
pub mod shared_noise_search;
pub(crate) mod suspects;
pub mod weighing;
pub mod weighings;
