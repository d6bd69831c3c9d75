//! The distributions: keys, standard uncertainty, divisor.

use gumption_files::schema;
use serde_json::Value;

use super::keys::{self, Definitions};
use crate::document::Document;
use crate::sheet::Sheet;

/// The standard uncertainty of a distribution as a formula of its keys, and the divisor of its width
/// where it has one.
pub(super) fn uncertainty(name: &str) -> Option<(&'static str, &'static str)> {
    Some(match name {
        "constant" => ("0", ""),
        "normal" => ("std, or expanded/k", "1, or k"),
        "rectangular" => ("half_width/sqrt(3)", "√3 ≈ 1.732"),
        "triangular" => ("half_width/sqrt(6)", "√6 ≈ 2.449"),
        "trapezoidal" => ("half_width*sqrt((1 + beta^2)/6)", "√(6/(1 + beta²))"),
        "curvilinear-trapezoid" => ("sqrt((upper - lower)^2/12 + inexactness^2/9)", ""),
        "arcsine" => ("half_width/sqrt(2)", "√2 ≈ 1.414"),
        "t" => ("scale", "1"),
        "readings" => ("s/sqrt(n)", "√n"),
        "exponential" => ("mean", "1"),
        "gamma" => ("sqrt(shape)/rate", ""),
        "lognormal" => ("std", "1"),
        "beta" => ("(upper - lower)*sqrt(alpha*beta/(alpha + beta + 1))/(alpha + beta)", ""),
        "log-uniform" => (
            "sqrt((upper^2 - lower^2)/(2*ln(upper/lower)) - ((upper - lower)/ln(upper/lower))^2)",
            "",
        ),
        "poisson-count" => ("sqrt(count + 1)", ""),
        "samples" => ("the standard deviation of the values", ""),
        "split-normal" => ("sqrt((1 - 2/pi)*(std_high - std_low)^2 + std_high*std_low)", ""),
        "quantiles" => ("the standard deviation of the interpolated quantiles", ""),
        "dcc" => ("that of the certificate: U/k", "k"),
        "result" => ("that of the saved result", ""),
        _ => return None,
    })
}

pub(super) fn document() -> Document {
    let definitions = Definitions::new();
    let mut document = Document { title: "Distributions".to_owned(), ..Document::default() };
    document.text(
        "What is known about an input or a component stands at its `distribution`, in the order of \
         JCGM 101, Table 1, then the others. Widths are in the quantity's unit unless they say \
         otherwise. The divisor is what a width is divided by to give the standard uncertainty u.",
    );
    let shapes = schema::distributions();
    let mut sheet = Sheet::default();
    sheet.text("distribution", shapes.iter().map(|shape| format!("`{}`", shape.name)));
    let said = |which: fn((&'static str, &'static str)) -> &'static str, code: bool| {
        let of = move |name: &str| uncertainty(name).map_or("", which).to_owned();
        shapes.iter().map(move |shape| {
            let text = of(shape.name);
            // a formula, not words
            let is_code =
                code && !text.contains("the ") && !text.contains("that ") && !text.is_empty();
            if is_code { format!("`{text}`") } else { text }
        })
    };
    sheet.text("u", said(|(u, _)| u, true));
    sheet.text("divisor", said(|(_, divisor)| divisor, false));
    document.table(sheet);
    for shape in &shapes {
        let Some(node) = definitions.get(&format!("input-{}", shape.name)) else { continue };
        document.section(shape.name);
        let names: Vec<String> = shape.aliases.iter().map(|name| format!("`{name}`")).collect();
        let also = if names.is_empty() {
            String::new()
        } else {
            format!(" Also called {}.", names.join(", "))
        };
        document.text(format!("{}{also}", keys::text(node, "description").unwrap_or_default()));
        let required = keys::required(node);
        let own = node.get("properties").and_then(Value::as_object);
        let own = own.into_iter().flatten().filter(|(key, _)| shape.keys.contains(&key.as_str()));
        document.table(definitions.table(own, &required));
        if let Some(said) = definitions.rules(node) {
            document.sentence(&said);
        }
    }
    document
}
