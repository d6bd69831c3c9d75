//! The quantities of a certificate as inputs of a model.

use std::collections::{HashMap, HashSet};

use gumption_engine::model::formula::check_name;
use roxmltree::Document;
use serde_json::{Value, json};

use super::difference;
use super::document::{measured, names, quantities};
use super::missing::QuantityRows;
use super::standing::is_result;

/// The name of a quantity that has none.
const NAMELESS: &str = "q";

/// Name, unit and input of each value of the certificate's results (of all of it, if it has none), in a
/// model that names the certificate as `file`; what is no real quantity is left out.
pub(crate) fn inputs(document: &Document<'_>, file: &str) -> Vec<(String, String, Value)> {
    let all = quantities(document);
    let some = all.iter().any(|node| is_result(*node));
    let mut rows = QuantityRows::new(&all);
    let mut found: Vec<(String, String, Value)> = Vec::new();
    // the names so far, and from which number on one may be free
    let (mut taken, mut numbers) = (HashSet::new(), HashMap::<String, usize>::new());
    for (place, node) in all.iter().enumerate().filter(|(_, node)| !some || is_result(**node)) {
        let Ok(measured) = measured(*node) else { continue };
        let count = measured.values.len();
        let lacking = rows.lacking(*node, &measured);
        let fault =
            |place: usize| lacking.as_ref().and_then(|lacking| lacking.fault(&measured, place));
        let called = names(*node);
        let stem = identifier(called.first().map_or("", String::as_str));
        for index in (0..count).filter(|place| fault(*place).is_none()) {
            let wanted = if count > 1 { format!("{stem}_{}", index + 1) } else { stem.clone() };
            let next = numbers.entry(wanted.clone()).or_insert(1);
            let name = (*next..)
                .map(|n| (n, if n == 1 { wanted.clone() } else { format!("{wanted}_{n}") }))
                .find(|(_, name)| !taken.contains(name));
            let Some((number, name)) = name else { continue };
            *next = number + 1;
            taken.insert(name.clone());
            let mut input = json!({ "distribution": "dcc", "file": file, "quantity": place });
            if count > 1 {
                input["index"] = json!(index);
            }
            if !called.is_empty() {
                input["about"] = json!(called.join(" / "));
            }
            let unit = match difference::kind(*node, &measured, None) {
                Ok(kind) => kind.unit(measured.unit.clone()),
                Err(_) => measured.unit.clone(),
            };
            found.push((name, unit.text().to_owned(), input));
        }
    }
    found
}

/// A text as the name of a quantity.
fn identifier(text: &str) -> String {
    let sign = |c: char| if c.is_alphanumeric() { c } else { '_' };
    let name: String = text.trim().chars().take(40).map(sign).collect();
    let name = name.trim_matches('_').to_owned();
    if name.is_empty() {
        return NAMELESS.to_owned();
    }
    let candidates = [name.clone(), format!("{NAMELESS}_{name}"), format!("{name}_")];
    let right = candidates.into_iter().find(|name| check_name(name).is_ok());
    right.unwrap_or_else(|| NAMELESS.to_owned())
}
