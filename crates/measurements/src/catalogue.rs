//! The measurements that files can name.

use std::sync::LazyLock;

use super::*;
use gumption_engine::model::typed::{Catalogue, CatalogueEntry, Measurement};

/// All measurements, in the order of the papers and their equations.
pub fn catalogue() -> &'static Catalogue {
    static ALL: LazyLock<Catalogue> = LazyLock::new(|| {
        Catalogue::from_iter([
            of::<InclinedPlane<()>>(),
            of::<InclinedPlaneSpurious<()>>(),
            of::<InclinedPlaneSpuriousVector<()>>(),
            of::<SpuriousComponent<()>>(),
            of::<SpuriousComponentInverse<()>>(),
            of::<SpuriousComponentModulus<()>>(),
            of::<WaveInterference<()>>(),
            of::<RotatingTable<()>>(),
            of::<RotatingTableInstant<()>>(),
            of::<Sensitivity<()>>(),
            of::<SensitivityMatrix<()>>(),
            of::<MeanOfRepetitions<()>>().any_unit(&[
                "x_1", "x_2", "x_3", "x_4", "x_5", "x_6", "x_7", "x_8", "u_1", "u_2", "u_3", "u_4",
                "u_5", "u_6", "u_7", "u_8", "mean", "u_mean", "s", "u",
            ]),
            of::<NormalizedError<()>>().any_unit(&[
                "x1",
                "U1",
                "x2",
                "U2",
                "difference",
                "U_difference",
            ]),
            of::<Projection45<()>>(),
            of::<AxisSensitivity<()>>(),
            of::<RelativeSensitivity<()>>().any_unit(&["s_f", "s_ref"]),
            of::<PhaseBudget<()>>(),
            of::<MeasuringChain<()>>(),
            of::<SeismicResponse<()>>().any_unit(&["S0", "modulus"]),
            of::<GravityRotation<()>>(),
        ])
    });
    &ALL
}

fn of<M: Measurement>() -> CatalogueEntry {
    CatalogueEntry::of::<M>()
}
