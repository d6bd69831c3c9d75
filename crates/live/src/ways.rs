//! The ways in which an input is known, as the form offers them, and the keys that each of them begins
//! with.

use gumption_engine::number::Shortest;
use gumption_files::schema;
use gumption_text::value_text::with_unit;
use gumption_units::Unit;
use jsonc_parser::ast::{Object, Value};
use serde_json::{Value as Json, json};

use crate::tree::{self, raw};

/// The meaning of a key of a distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Role {
    /// Where it lies.
    Centre,
    /// Its width: whatever the parameter, the typed number is kept.
    Width,
    /// Its limits.
    Lower,
    Upper,
    /// A share of the width.
    Share(f64),
    /// A number to begin with.
    Number(f64),
    /// A text to be filled in.
    Text,
    /// Numbers to be filled in.
    List,
}

impl Role {
    /// The initial value of a key, from the location and the width of the input.
    pub(crate) fn value(self, centre: Option<f64>, width: Option<f64>) -> Json {
        let both = centre.zip(width);
        let figure = match self {
            Self::Text => return json!(""),
            Self::List => return json!([]),
            Self::Centre => centre,
            Self::Width => width,
            Self::Lower => both.map(|(centre, width)| centre - width),
            Self::Upper => both.map(|(centre, width)| centre + width),
            Self::Share(share) => width.map(|width| share * width),
            Self::Number(value) => Some(value),
        };
        figure.map_or(Json::Null, plain_number)
    }
}

/// The keys that a new distribution gets.
fn needed(name: &str) -> &'static [(&'static str, Role)] {
    use Role::{Centre, List, Lower, Number, Share, Text, Upper, Width};
    match name {
        "constant" => &[("value", Centre)],
        "normal" | "lognormal" => &[("mean", Centre), ("std", Width)],
        "rectangular" | "triangular" | "arcsine" => &[("mean", Centre), ("half_width", Width)],
        "trapezoidal" => &[("mean", Centre), ("half_width", Width), ("beta", Number(0.5))],
        "curvilinear-trapezoid" => {
            &[("lower", Lower), ("upper", Upper), ("inexactness", Share(0.1))]
        }
        "t" => &[("mean", Centre), ("scale", Width), ("dof", Number(9.0))],
        "readings" | "samples" => &[("values", List)],
        "exponential" => &[("mean", Centre)],
        "gamma" => &[("shape", Number(2.0)), ("rate", Number(1.0))],
        "beta" => &[("alpha", Number(2.0)), ("beta", Number(2.0))],
        "log-uniform" => &[("lower", Lower), ("upper", Upper)],
        "poisson-count" => &[("count", Centre)],
        "weibull" | "pareto" => &[("shape", Number(3.0)), ("scale", Centre)],
        "gumbel" => &[("location", Centre), ("scale", Width)],
        "chi-squared" => &[("dof", Number(9.0))],
        "binomial" => &[("trials", Number(100.0)), ("probability", Number(0.5))],
        "hypergeometric" => {
            &[("population", Number(100.0)), ("marked", Number(50.0)), ("draws", Number(10.0))]
        }
        "split-normal" => &[("mode", Centre), ("std_low", Width), ("std_high", Width)],
        "quantiles" => &[("probabilities", List), ("values", List)],
        "dcc" => &[("file", Text), ("id", Text)],
        "result" => &[("file", Text), ("output", Text)],
        "codata" => &[("constant", Text)],
        _ => &[],
    }
}

/// Keys for the location and the width of a distribution.
pub(crate) const CENTRES: [&str; 4] = ["mean", "value", "mode", "count"];
pub(crate) const WIDTHS: [&str; 6] =
    ["std", "half_width", "semi_range", "scale", "expanded", "std_low"];

/// A way in which an input is known: a distribution with certain of its keys.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) name: &'static str,
    pub(crate) distribution: &'static str,
    /// The keys that it begins with.
    pub(crate) needed: &'static [(&'static str, Role)],
    /// Further keys that the form has fields for.
    pub(crate) offered: &'static [&'static str],
}

/// The ways that have names of their own; every other distribution is a way as well.
pub(crate) static WAYS: [Way; 7] = {
    use Role::{Centre, Lower, Number, Text, Upper, Width};
    let way = Way { name: "", distribution: "normal", needed: &[], offered: &["dof"] };
    let rectangular = Way { distribution: "rectangular", ..way };
    [
        Way { name: "standard", needed: &[("mean", Centre), ("std", Width)], ..way },
        Way {
            name: "expanded",
            needed: &[("mean", Centre), ("expanded", Width), ("k", Number(2.0))],
            ..way
        },
        Way {
            name: "expanded-p",
            needed: &[("mean", Centre), ("expanded", Width), ("p", Number(0.95))],
            ..way
        },
        Way { name: "limits", needed: &[("mean", Centre), ("half_width", Width)], ..rectangular },
        Way { name: "bounds", needed: &[("lower", Lower), ("upper", Upper)], ..rectangular },
        Way {
            name: "datasheet",
            needed: &[("mean", Centre), ("half_width", Text)],
            offered: &["resolution", "range", "full_scale"],
            ..rectangular
        },
        Way {
            name: "readings",
            distribution: "readings",
            needed: &[("values", Role::List)],
            offered: &["resolution"],
        },
    ]
};

/// The way of that name, or of the distribution of that name.
pub(crate) fn way(name: &str) -> Option<Way> {
    if let Some(way) = WAYS.iter().find(|way| way.name == name) {
        return Some(*way);
    }
    let shapes = schema::distributions();
    let shape = shapes.iter().find(|of| of.name == name || of.aliases.contains(&name))?;
    let offered: &[&str] = if shape.keys.contains(&"dof") { &["dof"] } else { &[] };
    let own = WAYS.iter().find(|way| way.name == shape.name);
    Some(own.copied().unwrap_or(Way {
        name: shape.name,
        distribution: shape.name,
        needed: needed(shape.name),
        offered,
    }))
}

/// Whether a key goes with a distribution, so that another one does not need it.
pub(crate) fn is_of_distribution(key: &str) -> bool {
    schema::distributions().iter().any(|of| of.keys.contains(&key))
}

/// The way in which an input of a file is known; its distribution where that is no way of its own.
pub(crate) fn way_of(text: &str, object: &Object<'_>) -> Option<&'static str> {
    let member = |key: &str| tree::member(object, key).map(|of| &of.value);
    let has = |key: &str| member(key).is_some();
    let Some(name) = member("distribution").map(|of| raw(text, of)) else {
        return has("value").then_some("constant");
    };
    Some(match way(&name)?.distribution {
        "normal" if has("expanded") && has("p") && !has("k") => "expanded-p",
        "normal" if has("expanded") => "expanded",
        "normal" => "standard",
        "rectangular" if has("lower") || has("upper") => "bounds",
        "rectangular" if ["range", "full_scale", "resolution"].into_iter().any(has) => "datasheet",
        "rectangular" => match member("half_width") {
            Some(Value::StringLit(width)) if !is_quantity(&width.value) => "datasheet",
            _ => "limits",
        },
        other => other,
    })
}

/// Whether a width is a quantity with a unit, not a specification of several terms.
fn is_quantity(width: &str) -> bool {
    with_unit(width).is_some_and(|(_, unit)| Unit::parse(unit).is_ok())
}

/// The ways for the form.
pub(crate) fn listed() -> Vec<Json> {
    let own = WAYS.iter().map(|way| way.name);
    let others = schema::distributions().into_iter().map(|of| of.name);
    let others = others.filter(|name| !["normal", "rectangular", "readings"].contains(name));
    let listed = |name: &str| {
        let way = way(name)?;
        let needed: Vec<&str> = way.needed.iter().map(|(key, _)| *key).collect();
        Some(json!({
            "name": way.name,
            "distribution": way.distribution,
            "needed": needed,
            "offered": way.offered,
        }))
    };
    own.chain(others).filter_map(listed).collect()
}

/// A number without the last digits due to rounding.
fn plain_number(value: f64) -> Json {
    let text = gumption_engine::decimal::significant(value, 12);
    let short = text.parse::<f64>().ok().unwrap_or(value);
    serde_json::from_str(&Shortest(short).to_string()).unwrap_or(Json::Null)
}
