//! The distributions: keys, standard uncertainty, divisor.

use gumption_engine::distribution::{
    Arcsine, Beta, CurvilinearTrapezoid, Distribution, Exponential, External, Gamma, Invalid,
    LogUniform, Lognormal, Normal, PoissonCount, Readings, Rectangular, SplitNormal, StudentT,
    Trapezoidal, Triangular,
};
use gumption_files::schema;
use serde_json::Value;

use super::keys::{self, Definitions};
use crate::document::Document;
use crate::plot::bars;
use crate::sheet::Sheet;

/// The standard uncertainty of a distribution as a formula of its keys, and the divisor of its
/// width if there is one.
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
        "weibull" => ("scale*sqrt(Γ(1 + 2/shape) - Γ(1 + 1/shape)^2)", ""),
        "gumbel" => ("pi*scale/sqrt(6)", ""),
        "pareto" => ("scale/(shape - 1)*sqrt(shape/(shape - 2))", ""),
        "chi-squared" => ("sqrt(2*dof)", ""),
        "binomial" => ("sqrt(trials*probability*(1 - probability))", ""),
        "hypergeometric" => (
            "sqrt(draws*p*(1 - p)*(population - draws)/(population - 1)), p = marked/population",
            "",
        ),
        "samples" => ("the standard deviation of the values", ""),
        "split-normal" => ("sqrt((1 - 2/pi)*(std_high - std_low)^2 + std_high*std_low)", ""),
        "quantiles" => ("the standard deviation of the interpolated quantiles", ""),
        "dcc" => ("that of the certificate: U/k", "k"),
        "result" => ("that of the saved result", ""),
        "codata" => ("that of CODATA 2022", ""),
        _ => return None,
    })
}

/// A distribution of each shape for the picture; `None` for shapes without a fixed form.
fn drawn(name: &str) -> Option<Distribution> {
    let readings = vec![1.0, 2.0, 3.0, 4.0];
    let made: Result<Distribution, Invalid> = match name {
        "normal" => Normal::new(0.0, 1.0).map(Into::into),
        "rectangular" => Rectangular::new(0.0, 1.0).map(Into::into),
        "triangular" => Triangular::new(0.0, 1.0).map(Into::into),
        "trapezoidal" => Trapezoidal::new(0.0, 1.0, 0.5).map(Into::into),
        "curvilinear-trapezoid" => CurvilinearTrapezoid::new(-1.0, 1.0, 0.3).map(Into::into),
        "arcsine" => Arcsine::new(0.0, 1.0).map(Into::into),
        "t" => StudentT::new(0.0, 1.0, 3.0).map(Into::into),
        "readings" => Readings::new(readings).map(Into::into),
        "exponential" => Exponential::new(1.0).map(Into::into),
        "gamma" => Gamma::new(2.0, 1.0).map(Into::into),
        "lognormal" => Lognormal::new(1.0, 0.6).map(Into::into),
        "beta" => Beta::new(2.0, 4.0).map(Into::into),
        "log-uniform" => LogUniform::new(1.0, 6.0).map(Into::into),
        "poisson-count" => PoissonCount::new(3).map(Into::into),
        "weibull" => External::weibull(2.0, 1.0).map(Into::into),
        "gumbel" => External::gumbel(0.0, 1.0).map(Into::into),
        "pareto" => External::pareto(3.0, 1.0).map(Into::into),
        "chi-squared" => External::chi_squared(4.0).map(Into::into),
        "split-normal" => SplitNormal::new(0.0, 0.5, 1.5).map(Into::into),
        _ => return None,
    };
    made.ok()
}

/// Characters of a picture.
const WIDE: usize = 15;

/// The density over the middle 99 % in characters, from the probabilities of equal cells.
fn picture(of: &Distribution) -> String {
    let (low, high) = (of.quantile(0.005), of.quantile(0.995));
    // shapes with limits are drawn up to these, so that their ends are visible
    let (first, last) = (of.quantile(1e-9), of.quantile(1.0 - 1e-9));
    let is_cut = last - first < 1.3 * (high - low);
    let (low, high) = if is_cut { (first, last) } else { (low, high) };
    let below = |x: f64| {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for _ in 0..50 {
            let middle = 0.5 * (from + to);
            if of.quantile(middle) < x {
                from = middle;
            } else {
                to = middle;
            }
        }
        0.5 * (from + to)
    };
    let margin = if is_cut { 1 } else { 0 };
    let cells = WIDE - 2 * margin;
    let edge = |cell: usize| below(low + (high - low) * (cell as f64 / cells as f64));
    let mut heights = vec![0.0; WIDE];
    for cell in 0..cells {
        heights[cell + margin] = edge(cell + 1) - edge(cell);
    }
    bars(&heights)
}

pub(super) fn document() -> Document {
    let definitions = Definitions::new();
    let mut document = Document { title: "Distributions".to_owned(), ..Document::default() };
    document.text(
        "What is known about an input or a component stands at its `distribution`, in the order of \
         JCGM 101, Table 1, then the others. Widths are in the quantity's unit unless they say \
         otherwise. The divisor is what a width is divided by to give the standard uncertainty u. The pictures are densities of one example each.",
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
    let pictures = shapes.iter().map(|shape| match drawn(shape.name) {
        // as code, so that the characters keep their positions
        Some(of) => format!("`{}`", picture(&of)),
        None => String::new(),
    });
    sheet.text("density", pictures);
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
        document.table(definitions.table(own.clone(), &required));
        if let Some(said) = definitions.rules(node) {
            document.sentence(&said);
        }
        for (key, node) in own {
            definitions.inside(&mut document, key, definitions.object_at(node).unwrap_or(node));
        }
    }
    document
}
