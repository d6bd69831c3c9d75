//! The extension module of the Python package `gumption`: the engine, the files, the reports and the
//! command line of this workspace as Python objects. What is only Python stands in
//! `python/gumption`.

mod argument_place;
mod arrow;
mod budgets;
mod call;
mod columns;
mod coverage;
mod diagnosis;
mod draws;
mod errors;
mod function;
mod model;
mod parts;
mod run;
mod shown;
mod supervised;
mod units;

use pyo3::prelude::*;

/// The command line with the built-in measurements, made once.
fn application() -> &'static gumption::Application {
    static ALL: std::sync::LazyLock<gumption::Application> =
        std::sync::LazyLock::new(gumption::Application::new);
    &ALL
}

/// Everything here is safe without the global lock: objects do not change after they are made.
#[pymodule(gil_used = false)]
fn _gumption(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    let error = module.py().get_type::<errors::ModelError>();
    // what Python raises itself is about an argument, and has none
    error.setattr("errors", pyo3::types::PyList::empty(module.py()))?;
    module.add("ModelError", error)?;
    module.add_class::<diagnosis::SimulatedGap>()?;
    module.add_class::<diagnosis::SimulatorGap>()?;
    module.add_class::<model::Model>()?;
    module.add_class::<parts::Parts>()?;
    module.add_class::<run::Run>()?;
    module.add_function(wrap_pyfunction!(arrow::arrow_array, module)?)?;
    module.add_function(wrap_pyfunction!(arrow::arrow_stream, module)?)?;
    module.add_function(wrap_pyfunction!(budgets::budgets, module)?)?;
    module.add_function(wrap_pyfunction!(budgets::in_rows, module)?)?;
    module.add_function(wrap_pyfunction!(call::call, module)?)?;
    module.add_function(wrap_pyfunction!(call::carried_models, module)?)?;
    module.add_function(wrap_pyfunction!(call::case_source, module)?)?;
    module.add_function(wrap_pyfunction!(units::convert, module)?)?;
    module.add_function(wrap_pyfunction!(call::main, module)?)?;
    module.add_function(wrap_pyfunction!(units::unit_of_differences, module)?)?;
    module.add_function(wrap_pyfunction!(units::unit_product, module)?)?;
    module.add_function(wrap_pyfunction!(shown::equation_html, module)?)?;
    module.add_function(wrap_pyfunction!(shown::equation_latex, module)?)?;
    module.add_function(wrap_pyfunction!(shown::input_keys, module)?)?;
    module.add_function(wrap_pyfunction!(shown::printed, module)?)?;
    module.add_function(wrap_pyfunction!(units::unit_scale, module)?)?;
    module.add_function(wrap_pyfunction!(units::unit_within, module)?)?;
    module.add_function(wrap_pyfunction!(units::units_fit, module)?)?;
    Ok(())
}
