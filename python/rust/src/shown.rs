//! What notebooks and constructors take from the pages and from the keys of files.

use std::collections::HashMap;
use std::sync::LazyLock;

use gumption::file::schema;
use gumption::report;
use pyo3::prelude::*;

/// A formula as MathML; a text that is no formula, as it is.
#[pyfunction]
pub(crate) fn equation_html(formula: &str) -> String {
    report::equation_html(formula)
}

/// A formula in the mathematical mode of LaTeX, without the `$`; a text that is no formula, as text.
#[pyfunction]
pub(crate) fn equation_latex(formula: &str) -> String {
    report::equation_latex(formula)
}

/// An estimate and its standard uncertainty as pages print them: the uncertainty to two significant
/// digits, the estimate to the same position.
#[pyfunction]
pub(crate) fn printed(estimate: f64, uncertainty: f64) -> (String, String) {
    report::number::with_uncertainty(estimate, uncertainty, 2)
}

/// The keys that an input of a distribution has in files; without a distribution those of an input
/// with components. `None` for a distribution that there is not.
#[pyfunction]
#[pyo3(signature = (distribution=None))]
pub(crate) fn input_keys(distribution: Option<&str>) -> Option<Vec<String>> {
    static KEYS: LazyLock<HashMap<&'static str, Vec<String>>> = LazyLock::new(keys);
    KEYS.get(distribution.unwrap_or(OF_COMPONENTS)).cloned()
}

/// What stands for the name of a distribution of inputs with components, as in the schema.
const OF_COMPONENTS: &str = "of-components";

/// The keys by the distributions of the schema and their other names.
fn keys() -> HashMap<&'static str, Vec<String>> {
    let schema = schema::value();
    let keys_of = |name: &str| {
        let definition = schema.get("$defs")?.get(format!("input-{name}"))?;
        Some(definition.get("properties")?.as_object()?.keys().cloned().collect::<Vec<String>>())
    };
    let mut keys: HashMap<&'static str, Vec<String>> = HashMap::new();
    keys.extend(keys_of(OF_COMPONENTS).map(|own| (OF_COMPONENTS, own)));
    for distribution in schema::distributions() {
        let Some(own) = keys_of(distribution.name) else { continue };
        for name in std::iter::once(&distribution.name).chain(distribution.aliases) {
            keys.insert(name, own.clone());
        }
    }
    keys
}
