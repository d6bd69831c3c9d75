//! The emulator as a whole.

mod layers;
mod pendulum;
mod plan;
