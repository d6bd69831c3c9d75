//! The measurements that files can name.

use super::*;
use gumption_engine::model::typed::{Measurement, Typed};

/// A measurement of the catalogue.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The measurement.
    pub typed: Typed,
    /// A model file of this measurement, ready to run and to be filled with other numbers.
    pub example: &'static str,
    /// Names of the inputs and outputs whose unit is free: a file may give them any unit, the same
    /// dimension for all of them, in place of the declared one.
    pub any_unit: &'static [&'static str],
}

impl Entry {
    fn of<M: Measurement>(example: &'static str) -> Self {
        Self { typed: Typed::of::<M>(), example, any_unit: &[] }
    }

    fn with_any_unit(self, any_unit: &'static [&'static str]) -> Self {
        Self { any_unit, ..self }
    }
}

macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../models/", $name, ".json"))
    };
}

/// All measurements, in the order of the papers and their equations.
pub fn all() -> Vec<Entry> {
    vec![
        Entry::of::<InclinedPlane<()>>(example!("inclined_plane")),
        Entry::of::<InclinedPlaneSpurious<()>>(example!("inclined_plane_spurious")),
        Entry::of::<InclinedPlaneSpuriousVector<()>>(example!("inclined_plane_spurious_vector")),
        Entry::of::<SpuriousComponent<()>>(example!("spurious_component")),
        Entry::of::<SpuriousComponentInverse<()>>(example!("spurious_component_inverse")),
        Entry::of::<SpuriousComponentModulus<()>>(example!("spurious_component_modulus")),
        Entry::of::<WaveInterference<()>>(example!("wave_interference")),
        Entry::of::<RotatingTable<()>>(example!("rotating_table")),
        Entry::of::<RotatingTableInstant<()>>(example!("rotating_table_instant")),
        Entry::of::<Sensitivity<()>>(example!("sensitivity")),
        Entry::of::<SensitivityMatrix<()>>(example!("sensitivity_matrix")),
        Entry::of::<MeanOfRepetitions<()>>(example!("mean_of_repetitions")).with_any_unit(&[
            "x_1", "x_2", "x_3", "x_4", "x_5", "x_6", "x_7", "x_8", "u_1", "u_2", "u_3", "u_4",
            "u_5", "u_6", "u_7", "u_8", "mean", "u_mean", "s", "u",
        ]),
        Entry::of::<NormalizedError<()>>(example!("normalized_error")).with_any_unit(&[
            "x1",
            "U1",
            "x2",
            "U2",
            "difference",
            "U_difference",
        ]),
        Entry::of::<Projection45<()>>(example!("projection_45")),
        Entry::of::<AxisSensitivity<()>>(example!("axis_sensitivity")),
        Entry::of::<RelativeSensitivity<()>>(example!("relative_sensitivity"))
            .with_any_unit(&["s_f", "s_ref"]),
        Entry::of::<PhaseBudget<()>>(example!("phase_budget")),
        Entry::of::<MeasuringChain<()>>(example!("measuring_chain")),
    ]
}

/// The measurement that files call `name`.
pub fn find(name: &str) -> Option<Entry> {
    all().into_iter().find(|entry| entry.typed.declaration.name == name)
}
