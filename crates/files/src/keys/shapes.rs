//! The distributions, with the keys that each of them has.

use super::super::codata::MEASURED;
use super::node::{With, object, reference, texts};
use super::{Key, closed, closed_of, described, keys, referenced, text_of};
use serde_json::Value;

/// A distribution as files name it.
#[derive(Debug)]
pub(crate) struct FileShape {
    pub(crate) name: &'static str,
    /// Its other names.
    pub(crate) aliases: &'static [&'static str],
    about: &'static str,
    /// Its own keys.
    pub(crate) fields: &'static [&'static str],
    rule: Rule,
}

/// Which of its keys a distribution needs.
#[derive(Clone, Copy, Debug)]
enum Rule {
    /// An estimate at this key, which a component may leave out, and the others.
    Estimate(&'static str, &'static [&'static str]),
    /// All of these.
    All(&'static [&'static str]),
    /// One of these.
    One(&'static [&'static str]),
    /// Readings, or their number and standard deviation with an estimate.
    Readings,
    /// An estimate, and a standard or an expanded uncertainty.
    Uncertainty,
    /// An estimate and a half-width, or two limits; and the others.
    Limits(&'static [&'static str]),
}

/// The distributions in the order of JCGM 101, Table 1, then the others.
pub(crate) static SHAPES: [FileShape; 27] = [
    FileShape {
        name: "constant",
        aliases: &[],
        about: "Known exactly.",
        fields: &["value"],
        rule: Rule::Estimate("value", &[]),
    },
    FileShape {
        name: "normal",
        aliases: &["gaussian"],
        about: "Normal. With `expanded` the coverage factor `k` or the coverage probability `p` is \
                needed; with `dof` it is drawn as the scaled and shifted t of JCGM 101, 6.4.9.7.",
        fields: &["mean", "std", "expanded", "k", "p", "dof", "resolution", "range", "full_scale"],
        rule: Rule::Uncertainty,
    },
    FileShape {
        name: "rectangular",
        aliases: &["uniform"],
        about: "Rectangular (uniform) within limits; with `dof` it is drawn as the curvilinear \
                trapezoid of inexactness half_width/sqrt(2 dof) (JCGM 101, 6.4.3).",
        fields: &[
            "mean",
            "half_width",
            "semi_range",
            "lower",
            "upper",
            "dof",
            "resolution",
            "range",
            "full_scale",
        ],
        rule: Rule::Limits(&[]),
    },
    FileShape {
        name: "triangular",
        aliases: &[],
        about: "Triangular within limits; with `lower` and `upper` the mode may lie off the \
                middle. With `dof` every trial has a width of its own, which is up to the share \
                1/sqrt(2 dof) off.",
        fields: &[
            "mean",
            "half_width",
            "semi_range",
            "lower",
            "upper",
            "mode",
            "dof",
            "resolution",
            "range",
            "full_scale",
        ],
        rule: Rule::Limits(&[]),
    },
    FileShape {
        name: "trapezoidal",
        aliases: &[],
        about: "Symmetric trapezoidal within limits (JCGM 101, 6.4.4); with `dof` drawn as a \
                triangular one.",
        fields: &[
            "mean",
            "half_width",
            "semi_range",
            "lower",
            "upper",
            "beta",
            "dof",
            "resolution",
            "range",
            "full_scale",
        ],
        rule: Rule::Limits(&["beta"]),
    },
    FileShape {
        name: "curvilinear-trapezoid",
        aliases: &[],
        about: "Rectangular with limits that are not known exactly (JCGM 101, 6.4.3).",
        fields: &["lower", "upper", "inexactness"],
        rule: Rule::All(&["lower", "upper", "inexactness"]),
    },
    FileShape {
        name: "arcsine",
        aliases: &["u-shaped"],
        about: "Arcsine (U-shaped) within limits: a sinusoidal cycle (JCGM 101, 6.4.6).",
        fields: &[
            "mean",
            "half_width",
            "semi_range",
            "lower",
            "upper",
            "resolution",
            "range",
            "full_scale",
        ],
        rule: Rule::Limits(&[]),
    },
    FileShape {
        name: "t",
        aliases: &["student-t"],
        about: "Scaled and shifted t; its standard uncertainty by the GUM is `scale`.",
        fields: &["mean", "scale", "dof", "resolution", "range", "full_scale"],
        rule: Rule::Estimate("mean", &["scale", "dof"]),
    },
    FileShape {
        name: "readings",
        aliases: &[],
        about: "Repeated readings (Type A): mean, s/sqrt(n), n - 1 degrees of freedom; drawn as \
                the scaled and shifted t of JCGM 101, 6.4.9.2.",
        fields: &[
            "values",
            "mean",
            "s",
            "n",
            "paired",
            "file",
            "column",
            "groups",
            "resolution",
            "pooled",
            "evaluation",
        ],
        rule: Rule::Readings,
    },
    FileShape {
        name: "exponential",
        aliases: &[],
        about: "Exponential (JCGM 101, 6.4.10).",
        fields: &["mean"],
        rule: Rule::All(&["mean"]),
    },
    FileShape {
        name: "gamma",
        aliases: &[],
        about: "Gamma.",
        fields: &["shape", "rate"],
        rule: Rule::All(&["shape", "rate"]),
    },
    FileShape {
        name: "lognormal",
        aliases: &[],
        about: "Log-normal; `mean` and `std` belong to the quantity itself.",
        fields: &["mean", "std", "resolution", "range", "full_scale"],
        rule: Rule::All(&["mean", "std"]),
    },
    FileShape {
        name: "beta",
        aliases: &[],
        about: "Beta, between 0 and 1 or between limits.",
        fields: &["alpha", "beta", "lower", "upper"],
        rule: Rule::All(&["alpha", "beta"]),
    },
    FileShape {
        name: "log-uniform",
        aliases: &[],
        about: "Of which the logarithm is rectangular, between limits above 0.",
        fields: &["lower", "upper"],
        rule: Rule::All(&["lower", "upper"]),
    },
    FileShape {
        name: "poisson-count",
        aliases: &[],
        about: "The expectation behind a count: a gamma of shape count + 1 (JCGM 101, 6.4.11).",
        fields: &["count"],
        rule: Rule::All(&["count"]),
    },
    FileShape {
        name: "weibull",
        aliases: &[],
        about: "Weibull, as of strengths and lifetimes; 1 - 1/e of it lies below `scale`.",
        fields: &["shape", "scale"],
        rule: Rule::All(&["shape", "scale"]),
    },
    FileShape {
        name: "gumbel",
        aliases: &[],
        about: "Gumbel, as of the largest of many values; `location` is the most probable value.",
        fields: &["location", "scale"],
        rule: Rule::All(&["location", "scale"]),
    },
    FileShape {
        name: "pareto",
        aliases: &[],
        about: "Pareto: nothing below `scale`, and above x the share (scale/x)^shape; `shape` above 2.",
        fields: &["shape", "scale"],
        rule: Rule::All(&["shape", "scale"]),
    },
    FileShape {
        name: "chi-squared",
        aliases: &[],
        about: "Chi-squared: the sum of `dof` squared standard normal quantities.",
        fields: &["dof"],
        rule: Rule::All(&["dof"]),
    },
    FileShape {
        name: "binomial",
        aliases: &[],
        about: "The number of successes among `trials`, each with `probability`.",
        fields: &["trials", "probability"],
        rule: Rule::All(&["trials", "probability"]),
    },
    FileShape {
        name: "hypergeometric",
        aliases: &[],
        about: "The number of marked ones among `draws` from a `population` with `marked` ones, without \
                putting back.",
        fields: &["population", "marked", "draws"],
        rule: Rule::All(&["population", "marked", "draws"]),
    },
    FileShape {
        name: "samples",
        aliases: &[],
        about: "An empirical distribution: values that are drawn with replacement.",
        fields: &["file", "column", "values"],
        rule: Rule::One(&["file", "values"]),
    },
    FileShape {
        name: "split-normal",
        aliases: &[],
        about: "Two halves of normal distributions, joined at the mode: 5 +0.2 -0.1.",
        fields: &["mode", "std_low", "std_high", "resolution", "range", "full_scale"],
        rule: Rule::All(&["mode", "std_low", "std_high"]),
    },
    FileShape {
        name: "quantiles",
        aliases: &[],
        about: "Stated by quantiles, with a monotone interpolation; with the probabilities 0 and 1 \
                these are limits, without them both tails are normal.",
        fields: &["probabilities", "values"],
        rule: Rule::All(&["probabilities", "values"]),
    },
    FileShape {
        name: "dcc",
        aliases: &[],
        about: "A quantity of a Digital Calibration Certificate (2.4 to 3.3): value, uncertainty, k, \
                p, distribution and unit.",
        fields: &[
            "file",
            "id",
            "ref_type",
            "within",
            "status",
            "quantity",
            "index",
            "at",
            "difference",
            "law",
        ],
        rule: Rule::All(&["file"]),
    },
    FileShape {
        name: "result",
        aliases: &[],
        about: "An output of a saved result.",
        fields: &["file", "output"],
        rule: Rule::All(&["file", "output"]),
    },
    FileShape {
        name: "codata",
        aliases: &[],
        about: "A measured fundamental constant (CODATA 2022), with its correlations to the others of the \
                file; `gumption help functions` lists them.",
        fields: &["constant"],
        rule: Rule::All(&["constant"]),
    },
];

/// What stands at a distribution's own key.
fn field(shape: &str, key: &str) -> Value {
    let referenced = |name, about| referenced(name, about);
    match (shape, key) {
        ("exponential" | "lognormal", "mean") => {
            referenced("positive-estimate", "The expectation of the quantity, above 0.")
        }
        (_, "mean" | "value") => reference("estimate"),
        (_, "std") => referenced("width", "Standard uncertainty."),
        (_, "s") => referenced(
            "width",
            "Standard deviation of one reading, where the readings themselves are not known; with `n` \
             and `mean`.",
        ),
        (_, "n") => described("integer", "The number of readings of `s`.").with("minimum", 1),
        (_, "expanded") => referenced("width", "Expanded uncertainty U = k u."),
        (_, "k") => referenced("positive", "Coverage factor of `expanded`."),
        (_, "p") => referenced("probability", "Coverage probability of `expanded`."),
        ("t" | "chi-squared", "dof") => referenced("positive", "Degrees of freedom."),
        (_, "dof") => object([
            (
                "description",
                Value::from(
                    "Degrees of freedom of the standard uncertainty, or a formula of the conditions.",
                ),
            ),
            (
                "anyOf",
                Value::from(vec![reference("positive"), object([("type", Value::from("string"))])]),
            ),
        ]),
        (_, "half_width") => referenced("width", "Half of the distance of the limits."),
        (_, "semi_range") => referenced("width", "Another name of `half_width`."),
        (_, "lower") => referenced("value", "Lower limit."),
        (_, "upper") => referenced("value", "Upper limit."),
        ("split-normal", "mode") => referenced("value", "The most probable value."),
        (_, "mode") => referenced("value", "The most probable value, from `lower` to `upper`."),
        (_, "inexactness") => {
            referenced("width", "Half of the length of the interval in which each limit lies.")
        }
        ("gumbel", "location") => referenced("value", "The most probable value."),
        ("weibull", "scale") => referenced("value", "The value below which 1 - 1/e lies, above 0."),
        ("pareto", "scale") => referenced("value", "The least value, above 0."),
        ("gumbel", "scale") => {
            referenced("value", "The scale: the standard uncertainty is 1.28 times it.")
        }
        (_, "scale") => referenced("width", "Scale of the t."),
        (_, "probability") => referenced("probability", "The probability of a success."),
        (_, "trials") => described("integer", "The number of trials.").with("minimum", 1),
        (_, "population") => described("integer", "The number of all.").with("minimum", 1),
        (_, "marked") => described("integer", "The number of marked ones.").with("minimum", 1),
        (_, "draws") => described("integer", "The number of those drawn.").with("minimum", 1),
        ("trapezoidal", "beta") => described("number", "Ratio of the top's width to the base's.")
            .with("minimum", 0)
            .with("maximum", 1),
        (_, "shape") => referenced("positive", "Shape."),
        (_, "rate") => referenced("value", "Rate, above 0: a number in 1/unit, or with a unit."),
        (_, "alpha") => referenced("positive", "First shape parameter."),
        (_, "beta") => referenced("positive", "Second shape parameter."),
        (_, "count") => described("integer", "The count.").with("minimum", 0),
        ("readings", "values") => described(
            "array",
            "The readings; or texts, formulas of the conditions, so that every row has its own: \
             `[\"r1\", \"r2\"]` names columns of the conditions' table.",
        )
        .with(
            "items",
            object([(
                "anyOf",
                Value::from(vec![reference("value"), object([("type", Value::from("string"))])]),
            )]),
        )
        .with("minItems", 1),
        ("readings", "file") => {
            referenced("file", "A file with one reading in each line, or a table with `column`.")
        }
        ("samples", "column") => {
            referenced("column", "The column of the file that has the samples.")
        }
        (_, "column") => text_of("The column of the file that has the readings."),
        (_, "groups") => text_of(
            "The column of the file that numbers the groups of a nested design (days, set-ups): the \
             standard uncertainty follows from the means of the groups (JCGM 100, H.5).",
        ),
        ("readings", "resolution") => referenced(
            "width",
            "The step of the indication; where its rectangular half is more than the scatter, that \
             is taken (JCGM 100, F.2.2.1). Equal readings are allowed with it.",
        ),
        (_, "resolution") => {
            referenced("value", "The value of one count, for a width with `counts` or `digits`.")
        }
        (_, "range") => referenced("value", "The range, for a width with `% of range`."),
        (_, "full_scale") => referenced("value", "The full scale, for a width with `% FS`."),
        (_, "pooled") => reference("pooled"),
        (_, "evaluation") => described(
            "string",
            "`bayesian`: the standard uncertainty is the standard deviation of the t distribution, \
             without degrees of freedom (JCGM 101, 6.4.9.4); four readings at least.",
        )
        .with("enum", texts(["frequentist", "bayesian"])),
        (_, "std_low") => referenced("width", "Standard deviation below the mode."),
        (_, "std_high") => referenced("width", "Standard deviation above the mode."),
        (_, "probabilities") => described("array", "Rising probabilities.")
            .with("items", object([("type", Value::from("number"))]))
            .with("minItems", 2),
        ("quantiles", "values") => referenced("values", "The quantiles of these probabilities."),
        (_, "values") => referenced("values", "The samples."),
        (_, "paired") => {
            described("boolean", "Readings that were taken together with readings of other inputs.")
        }
        ("samples", "file") => referenced(
            "file",
            "A file with one number in each line, perhaps below a heading; a table or an array of \
             NumPy (as `--samples` writes them) with `column`.",
        ),
        ("result", "file") => referenced("file", "A result that `gumption run --save` wrote."),
        ("dcc", "file") => referenced("file", "A Digital Calibration Certificate (XML)."),
        (_, "id") => text_of("The `id` of the quantity."),
        (_, "ref_type") => text_of("The `refType` of the quantity, such as `basic_measuredValue`."),
        (_, "within") => text_of(
            "The `id`, a `refType` or a name of what the quantity stands in: a list, a result, an \
             influence condition or all results of a measurement.",
        ),
        (_, "status") => described(
            "string",
            "Before or after what the quantity was measured: an adjustment or a repair.",
        )
        .with("enum", texts(crate::dcc::STATUSES)),
        (_, "quantity") => {
            let place = || object([("type", Value::from("integer")), ("minimum", Value::from(0))]);
            let places = object([("type", Value::from("array")), ("items", place())]);
            let places = places.with("minItems", 1);
            object([
                (
                    "description",
                    Value::from(
                        "The place of the quantity among all of the certificate, counted from 0; or a \
                         list of places, whose quantities are one table.",
                    ),
                ),
                ("anyOf", Value::from(vec![place(), places])),
            ])
        }
        (_, "index") => {
            described("integer", "Which of several values, counted from 0.").with("minimum", 0)
        }
        (_, "difference") => described(
            "boolean",
            "Whether it is a difference of temperatures, such as an error or a correction, which is the \
             same in degC and in K; where the `refType` or the name of the quantity does not say so.",
        ),
        (_, "law") => described(
            "string",
            "The distribution of the values, where the certificate names none that is known.",
        )
        .with("enum", texts(crate::dcc::LAWS)),
        (_, "at") => text_of(
            "The condition over which the quantity is a table, interpolated by straight lines: the \
             quantity of that name beside it, or its reference or nominal value.",
        ),
        (_, "output") => text_of("Name of the output in the saved result."),
        (_, "constant") => described("string", "Name or symbol of the constant.").with(
            "enum",
            texts(MEASURED.iter().flat_map(|constant| [constant.name, constant.symbol])),
        ),
        (_, key) => text_of(key),
    }
}

/// Keys that every input without components has beside those of its distribution.
pub(crate) const INPUT: [&str; 8] =
    ["unit", "distribution", "about", "type", "group", "per", "evidence", "limits"];

/// Keys that every component has beside those of its distribution.
pub(crate) const COMPONENT: [&str; 6] =
    ["name", "distribution", "about", "type", "group", "limits"];

/// Keys of a standard deviation that stands in place of the scatter of readings.
pub(crate) const POOLED: &[Key] = keys![
    "std" => referenced("width", "Standard deviation of one reading, in the unit of the input."),
    "dof" => referenced("positive", "Its degrees of freedom."),
    "fit" => text_of(
        "Instead of both: the calibration function of the file whose residuals have that scatter."
    ),
];

/// Keys of an input with components.
pub(crate) const COMPOSED: [&str; 7] =
    ["unit", "mean", "components", "about", "type", "group", "per"];

/// Keys of a complex input.
pub(crate) const COMPLEX_INPUT: &[Key] = keys![
    "unit" => reference("unit"),
    "complex" => closed("The two parts, each with its distribution.", COMPLEX, &[]),
    "about" => text_of("What it is, in words."),
];

/// A part of a complex input, which may be a text: `"0.012(5)"`.
fn part(about: &str) -> Value {
    object([
        ("description", Value::from(about)),
        ("anyOf", Value::from(vec![reference("input"), described("string", "A stated value.")])),
    ])
}

/// Keys of the parts of a complex input.
pub(crate) const COMPLEX: &[Key] = keys![
    "re" => part("The real part, in the quantity's unit unless it says its own."),
    "im" => part("The imaginary part."),
    "modulus" => part("The modulus, in the quantity's unit unless it says its own."),
    "phase" => part("The phase, in radians unless it says its own unit."),
    "correlation" => described("number", "The correlation coefficient of the two parts.")
                .with("minimum", -1)
                .with("maximum", 1),
];

fn common(key: &str) -> Value {
    match key {
        "unit" => reference("unit"),
        "distribution" => reference("distribution"),
        "about" => text_of("The source of uncertainty, in words."),
        "type" => described("string", "How the uncertainty was evaluated.")
            .with("enum", texts(["A", "B"])),
        "group" => text_of("A group for subtotals of the budget."),
        "per" => text_of(
            "In which rows of the conditions the quantity has a value of its own: `row`, or the \
             name of a condition for one value of each of its values. One value for all rows \
             unless given.",
        ),
        "evidence" => referenced(
            "values-or-file",
            "Readings that the stated distribution is tested against (`gumption assumptions`).",
        ),
        "name" => text_of("Name of the component, unique in its quantity.")
            .with("minLength", 1)
            .with("pattern", "^[^/]*$"),
        "limits" => described(
            "array",
            "Limits that the quantity cannot be beyond, in its unit; `null` for none: the \
             distribution is cut off there.",
        )
        .with(
            "items",
            object([(
                "anyOf",
                Value::from(vec![reference("value"), object([("type", Value::from("null"))])]),
            )]),
        )
        .with("minItems", 2)
        .with("maxItems", 2),
        "mean" => referenced("estimate", "The estimate; the mean of `readings` unless given."),
        "components" => described("array", "Contributions that add up.")
            .with("items", reference("component"))
            .with("minItems", 1),
        _ => text_of(key),
    }
}

/// The quantities that have a distribution.
#[derive(Clone, Copy, PartialEq)]
enum Holder {
    Input,
    Component,
}

impl Holder {
    fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Component => "component",
        }
    }

    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Input => &INPUT,
            Self::Component => &COMPONENT,
        }
    }
}

pub(super) fn definitions() -> Vec<(String, Value)> {
    let names = SHAPES.iter().flat_map(|shape| std::iter::once(&shape.name).chain(shape.aliases));
    let distribution = described(
        "string",
        "The distribution of the quantity. `uniform` is `rectangular`, `gaussian` `normal`, \
         `u-shaped` `arcsine`, `student-t` `t`.",
    )
    .with("enum", texts(names.copied()));
    let composed = COMPOSED.iter().map(|&key| (key, common(key)));
    let composed = closed_of(
        "An input that is the sum of an estimate and of several contributions.",
        composed,
        &["components"],
    );
    let mut definitions = vec![
        ("distribution".to_owned(), distribution),
        ("input".to_owned(), choice(Holder::Input)),
        ("component".to_owned(), choice(Holder::Component)),
        ("input-of-components".to_owned(), composed),
        ("pooled".to_owned(), closed("A pooled standard deviation.", POOLED, &[])),
        ("stated".to_owned(), stated()),
        ("stated-input".to_owned(), stated_in(Holder::Input)),
        ("stated-component".to_owned(), stated_in(Holder::Component)),
        (
            "complex-input".to_owned(),
            closed("A complex input quantity.", COMPLEX_INPUT, &["complex"]),
        ),
    ];
    for holder in [Holder::Input, Holder::Component] {
        for shape in &SHAPES {
            let name = format!("{}-{}", holder.name(), shape.name);
            definitions.push((name, definition(holder, shape)));
        }
    }
    definitions
}

/// A quantity in one text or number.
fn stated() -> Value {
    object([
        (
            "description",
            Value::from(
                "A quantity as people write it: a constant, or `5.0112(23) V` (standard uncertainty \
                 in the last digits), `5.0112 V ± 0.0046 V (k=2)`, `5 +0.2 -0.1 mm`.",
            ),
        ),
        ("type", texts(["string", "number"])),
        ("examples", texts(["5.0112(23) V", "5.0112 V ± 0.0046 V (k=2)", "5 +0.2 -0.1 mm"])),
    ])
}

/// An object with such a value in place of a distribution.
fn stated_in(holder: Holder) -> Value {
    let keys = holder.keys().iter().filter(|key| **key != "distribution");
    let properties = keys.map(|&key| (key, common(key))).chain([("value", reference("stated"))]);
    let required: &[&str] = match holder {
        Holder::Input => &["value"],
        Holder::Component => &["name", "value"],
    };
    closed_of(
        "A quantity as people write it, with its unit or a word about it.",
        properties,
        required,
    )
}

/// The definition by the distribution that is named.
fn choice(holder: Holder) -> Value {
    let chosen = SHAPES.iter().map(|shape| {
        let names = std::iter::once(shape.name).chain(shape.aliases.iter().copied());
        let distribution = object([("enum", texts(names))]);
        let condition = object([
            ("properties", object([("distribution", distribution)])),
            ("required", texts(["distribution"])),
        ]);
        let then = reference(&format!("{}-{}", holder.name(), shape.name));
        object([("if", condition), ("then", then)])
    });
    let chosen: Vec<Value> = chosen.collect();
    let needed = object([("required", texts(["distribution"]))])
        .with("properties", object([("distribution", reference("distribution"))]));
    let about = match holder {
        Holder::Input => "An input quantity with its distribution.",
        Holder::Component => "One of several contributions to a quantity.",
    };
    let choice = described("object", about);
    match holder {
        Holder::Component => {
            choice.with("if", is_stated()).with("then", reference("stated-component")).with(
                "else",
                object([("required", texts(["name", "distribution"]))])
                    .with("properties", object([("distribution", reference("distribution"))]))
                    .with("allOf", chosen),
            )
        }
        Holder::Input => choice
            .with("if", object([("required", texts(["components"]))]))
            .with("then", reference("input-of-components"))
            .with(
                "else",
                object([
                    ("if", object([("required", texts(["complex"]))])),
                    ("then", reference("complex-input")),
                    (
                        "else",
                        object([
                            ("if", is_stated()),
                            ("then", reference("stated-input")),
                            ("else", needed.with("allOf", chosen)),
                        ]),
                    ),
                ]),
            ),
    }
    .with("examples", examples(holder))
}

/// An object with a value and without a distribution.
fn is_stated() -> Value {
    let named = object([("required", texts(["distribution"]))]);
    object([("required", texts(["value"])), ("not", named)])
}

fn examples(holder: Holder) -> Value {
    Value::from(vec![match holder {
        Holder::Input => object([
            ("unit", Value::from("m/s^2")),
            ("distribution", Value::from("normal")),
            ("mean", Value::from(10)),
            ("std", Value::from(0.01)),
        ]),
        Holder::Component => object([
            ("name", Value::from("resolution")),
            ("distribution", Value::from("rectangular")),
            ("half_width", Value::from(0.05)),
        ]),
    }])
}

fn definition(holder: Holder, shape: &FileShape) -> Value {
    let keys = holder.keys().iter().map(|&key| (key, common(key)));
    let own = shape.fields.iter().map(|&key| (key, field(shape.name, key)));
    let properties = keys.chain(own);
    let mut required: Vec<&str> = match holder {
        Holder::Input => vec!["distribution"],
        Holder::Component => vec!["name", "distribution"],
    };
    // the estimate of a component is 0 unless given
    let estimate = |key| (holder == Holder::Input).then_some(key);
    match shape.rule {
        Rule::Estimate(key, others) => {
            required.extend(estimate(key));
            required.extend(others);
        }
        Rule::All(keys) => required.extend(keys),
        Rule::One(_) | Rule::Readings => {}
        Rule::Uncertainty => required.extend(estimate("mean")),
        Rule::Limits(others) => required.extend(others),
    }
    let definition = closed_of(shape.about, properties, &required);
    let needs = |keys: &[&str]| object([("required", texts(keys.iter().copied()))]);
    match shape.rule {
        Rule::Estimate(..) | Rule::All(_) => definition,
        Rule::One(keys) => {
            let alternatives: Vec<Value> = keys.iter().map(|&key| needs(&[key])).collect();
            definition.with("oneOf", alternatives)
        }
        Rule::Readings => {
            let alternatives: Vec<Value> =
                ["values", "file", "n"].into_iter().map(|key| needs(&[key])).collect();
            let needed = ["s", "mean"].map(|key| (key, texts(["n"])));
            let needed =
                object(needed.into_iter().chain(estimate("mean").map(|key| ("n", texts([key])))));
            definition.with("oneOf", alternatives).with("dependentRequired", needed)
        }
        Rule::Uncertainty => {
            let factor = vec![needs(&["k"]), needs(&["p"])];
            let expanded = needs(&["expanded"]).with("oneOf", factor);
            let needed = object(["k", "p"].map(|key| (key, texts(["expanded"]))));
            definition
                .with("oneOf", vec![needs(&["std"]), expanded])
                .with("dependentRequired", needed)
        }
        Rule::Limits(_) => {
            let width = |key: &'static str| {
                needs(&estimate("mean").into_iter().chain([key]).collect::<Vec<_>>())
            };
            let absent = ["mean", "half_width", "semi_range"];
            let absent = object(absent.map(|key| (key, Value::from(false))));
            let limits = needs(&["lower", "upper"]).with("properties", absent);
            let mut definition =
                definition.with("oneOf", vec![width("half_width"), width("semi_range"), limits]);
            if shape.fields.contains(&"mode") {
                let needed = object([("mode", texts(["lower", "upper"]))]);
                definition = definition.with("dependentRequired", needed);
            }
            definition
        }
    }
}
