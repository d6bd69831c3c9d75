//! From the fields of an input to its distribution.

use std::ops::Range;

use super::codata::MeasuredConstant;
use super::condition_values::ConditionValues;
use super::coverage_slips;
use super::dcc::FromCertificate;
use super::instrument;
use super::keys::{self, FileShape, SHAPES};
use super::readings::{self, FileReadings, Pooled};
use super::results::ResultFiles;
use gumption_engine::distribution::{
    Arcsine, Beta, Constant, CurvilinearTrapezoid, Distribution, Exponential, External, Fitted,
    Gamma, Invalid, LogUniform, Lognormal, Normal, PoissonCount, Quantiles, Readings, Rectangular,
    Samples, SplitNormal, StudentT, Trapezoidal, Triangular, Truncated,
};
use gumption_engine::model::formula::Formula;
use gumption_engine::special;
use gumption_text::json::{Json, Node};
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::width::{Width, is_bare_share, is_combined, terms, without_plus_minus};
use gumption_text::{DiagnosticKind, WIDTHS};
use gumption_units::Unit;
use gumption_units::nearest;

/// The distribution, if its standard uncertainty is a number: widths near the largest and the least
/// doubles have squares beyond them.
fn with_uncertainty(distribution: Distribution) -> Result<Distribution, Invalid> {
    let (parameter, value) = ("the standard uncertainty", distribution.standard_uncertainty());
    if !value.is_finite() {
        Err(Invalid::NotFinite { parameter, value })
    } else if value <= 0.0 && distribution.constant().is_none() {
        Err(Invalid::NotPositive { parameter, value })
    } else {
        Ok(distribution)
    }
}

/// The largest count of events; one more is still a whole number in double precision.
const MOST_COUNT: u64 = 999_999_999_999_999;

impl FileShape {
    /// Whether a component of this shape is about 0 unless it says otherwise. Shapes of positive
    /// quantities and those without a field for their estimate are where their fields put them.
    pub(super) fn is_about_zero(&self) -> bool {
        let located = ["mean", "value"].iter().any(|key| self.fields.contains(key));
        let has_own = matches!(self.name, "exponential" | "lognormal" | "readings");
        self.name == "result" || (located && !has_own)
    }
}

/// Keys of inputs and components that do not belong to a shape.
const KEYS: [&str; 10] = [
    "name",
    "distribution",
    "about",
    "type",
    "group",
    "unit",
    "per",
    "evidence",
    "components",
    "limits",
];

/// The shape that an object names.
pub(super) fn kind(object: &Object<'_>) -> Option<&'static FileShape> {
    let Some(member) = object.get("distribution") else {
        let own =
            || object.members().iter().map(|m| &m.key).filter(|k| !KEYS.contains(&k.as_str()));
        let has_all = |kind: &&FileShape| own().all(|key| kind.fields.contains(&key.as_str()));
        let fitting: Vec<_> = SHAPES.iter().filter(has_all).map(|kind| kind.name).collect();
        object.report(match own().next() {
            None => DiagnosticKind::NoDistribution { what: object.what(), fitting: Vec::new() },
            Some(_) if fitting.is_empty() => {
                DiagnosticKind::MissingKey { key: "distribution", what: object.what() }
            }
            Some(_) => DiagnosticKind::NoDistribution { what: object.what(), fitting },
        });
        // it may be misspelt; nothing else can be said of the keys
        let fields = SHAPES.iter().flat_map(|kind| kind.fields).copied();
        keys::check_names(object, &KEYS.into_iter().chain(fields).collect::<Vec<_>>());
        return None;
    };
    let name = object.text("distribution")?;
    let found = SHAPES.iter().find(|kind| kind.name == name || kind.aliases.contains(&name));
    if found.is_none() {
        let known = SHAPES.iter().flat_map(|k| std::iter::once(&k.name).chain(k.aliases)).copied();
        let nearest = nearest(name, known).map(str::to_owned);
        let diagnostic = DiagnosticKind::UnknownDistribution {
            name: name.to_owned(),
            nearest,
            known: SHAPES.iter().map(|kind| kind.name).collect(),
        };
        object.log.report(&member.value.span, diagnostic);
    }
    found
}

/// Where an input's estimate comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Estimate {
    /// From its own fields.
    Own,
    /// From elsewhere: a formula of the conditions, an override, or 0 for a component.
    Given(f64),
}

/// What reading a distribution needs to know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fields<'a> {
    pub(super) object: Object<'a>,
    pub(super) name: &'a str,
    pub(super) unit: &'a Unit,
    pub(super) estimate: Estimate,
    /// Whether the estimate replaces the own one, so that limits of the values move along.
    pub(super) replaces: bool,
    /// What a relative width is a share of, if not of the own estimate.
    pub(super) share_of: Option<f64>,
    /// The samples, where the shape has any: read once for all rows.
    pub(super) samples: Option<&'a Samples>,
    /// The readings of a file, read once for all rows.
    pub(super) read: Option<&'a FileReadings>,
    /// What is taken from a certificate, read once for all rows.
    pub(super) certificate: Option<&'a FromCertificate>,
    /// Whether other components stand beside it, so that readings may be equal.
    pub(super) beside_others: bool,
    /// The saved results that inputs name.
    pub(super) results: &'a ResultFiles<'a>,
    /// The conditions and the row of them that this is for, where a width may be a formula of them.
    pub(super) at: Option<(&'a dyn ConditionValues, usize)>,
}

/// The formula of conditions that a width is: a text that begins with a name, as no specification
/// does, or one with names, products or functions that can be read as a formula and not as a
/// specification.
fn formula_of_width(object: &Object<'_>, key: &str, unit: &Unit) -> Option<String> {
    let member = object.get(key)?;
    let Json::Text(text) = &member.value.value else { return None };
    if is_combined(text) {
        return None;
    }
    let begins_with_name = text.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '_');
    let is_formula = || {
        let computes =
            |formula: &Formula| formula.names().next().is_some() || text.contains(['*', '/', '(']);
        object.log.formula(text).is_ok_and(|formula| computes(&formula))
            && Width::read(object.log, &member.value, "", key, unit, None).is_err()
    };
    (begins_with_name || is_formula()).then(|| text.clone())
}

/// Whether a width of the object is a formula of conditions, so that it differs from row to row.
pub(super) fn has_width_of_row(
    object: &Object<'_>,
    kind: &FileShape,
    unit: &Unit,
    read: Option<&FileReadings>,
) -> bool {
    let is_text = |key: &str| {
        let member = object.get(key);
        member.is_some_and(|member| matches!(member.value.value, Json::Text(_)))
    };
    if kind.name == "readings" && readings::are_of_rows(object, read)
        || kind.fields.contains(&"dof") && is_text("dof")
        || kind.name == "dcc" && object.get("at").is_some()
    {
        return true;
    }
    let mut widths = WIDTHS.iter().filter(|key| kind.fields.contains(key));
    widths.any(|key| formula_of_width(object, key, unit).is_some())
}

/// Whether a width of the quantity has a share of its estimate and something beside it, so that of an
/// estimate of 0 the share is lost without a trace.
pub(super) fn has_share_beside_value(object: &Object<'_>, kind: &FileShape, unit: &Unit) -> bool {
    if kind.name == "readings" {
        return false;
    }
    let own = object.log.own_units();
    let Some(instrument) = instrument::stated(object, unit) else { return false };
    let mut widths = WIDTHS.iter().filter(|key| kind.fields.contains(key));
    widths.any(|key| {
        let Some(Json::Text(text)) = object.get(key).map(|member| &member.value.value) else {
            return false;
        };
        without_plus_minus(text, key)
            .and_then(|text| Width::specification(&text, unit, &own, Some(&instrument)))
            .is_ok_and(|width| width.at(1.0) > width.at(0.0) && width.at(0.0) > 0.0)
    })
}

/// Keys of readings that are stated by a summary.
const SUMMARY: [&str; 3] = ["n", "s", "mean"];

/// A Type A evaluation, which may lack what a distribution needs.
struct TypeA {
    mean: f64,
    /// Number of readings.
    count: usize,
    readings: Result<Readings, Invalid>,
}

impl<'a> Fields<'a> {
    /// The fields of a quantity that has nothing beside them: no file read for it, no conditions.
    pub(super) fn new(
        object: Object<'a>,
        name: &'a str,
        unit: &'a Unit,
        estimate: Estimate,
        results: &'a ResultFiles<'a>,
    ) -> Self {
        Self {
            object,
            name,
            unit,
            estimate,
            replaces: false,
            share_of: None,
            samples: None,
            read: None,
            certificate: None,
            beside_others: false,
            results,
            at: None,
        }
    }

    /// The distribution, with what cannot be reported.
    pub(super) fn distribution(&self, kind: &FileShape) -> Option<Distribution> {
        if let (true, Estimate::Given(_), Some(_)) =
            (self.replaces, self.estimate, self.object.get("limits"))
        {
            let share_of = self.share_of.or(self.given());
            let own = Self { estimate: Estimate::Own, replaces: false, share_of, ..*self };
            return self.moved(Ok(own.distribution(kind)?));
        }
        let shape = self.whole(kind)?;
        let Some(list) = self.object.get("limits").and(self.object.list("limits")) else {
            return self.object.get("limits").is_none().then_some(shape);
        };
        let place = self.place_of("limits");
        let [lower, upper] = list else {
            let (what, found) = ("`limits`".to_owned(), "another number of values");
            let expected = "two values, or `null` for no limit";
            self.object.log.report(&place, DiagnosticKind::WrongType { what, found, expected });
            return None;
        };
        let end = |node: &Node, none: f64| match node.value {
            Json::Null => Some(none),
            _ => self.object.value_at("limits", node, self.unit, self.of()),
        };
        let (lower, upper) = (end(lower, f64::NEG_INFINITY), end(upper, f64::INFINITY));
        self.made(Truncated::cut(shape, lower?, upper?))
    }

    /// The distribution without regard to limits.
    fn whole(&self, kind: &FileShape) -> Option<Distribution> {
        match kind.name {
            "constant" => {
                let value = self.estimate("value")?;
                self.made(Constant::new(value))
            }
            "normal" => self.normal(),
            "rectangular" => {
                let (mean, half_width, _) = self.limits()?;
                let dof = self.dof();
                let Some(half_width) = half_width else {
                    return self.made(Constant::new(mean));
                };
                self.made(Rectangular::new(mean, half_width).and_then(|shape| match dof {
                    Some(dof) => shape.with_dof(dof),
                    None => Ok(shape),
                }))
            }
            "triangular" => self.triangular(),
            "trapezoidal" => {
                let beta = self.number("beta");
                let dof = self.dof();
                let (mean, half_width, _) = self.limits()?;
                match half_width {
                    Some(half_width) => {
                        let shape = Trapezoidal::new(mean, half_width, beta?);
                        self.made(shape.and_then(|shape| match dof {
                            Some(dof) => shape.with_dof(dof),
                            None => Ok(shape),
                        }))
                    }
                    None => self.made(Constant::new(mean)),
                }
            }
            "arcsine" => match self.limits()? {
                (mean, Some(half_width), _) => self.made(Arcsine::new(mean, half_width)),
                (mean, None, _) => self.made(Constant::new(mean)),
            },
            "curvilinear-trapezoid" => {
                let (lower, upper) = (self.limit("lower"), self.limit("upper"));
                let inexactness = self.difference("inexactness");
                self.moved(CurvilinearTrapezoid::new(lower?, upper?, inexactness?))
            }
            "t" => {
                let mean = self.estimate("mean");
                let scale = self.width("scale", mean?)?;
                let dof = self.object.required("dof").and_then(|_| self.object.number("dof"));
                match scale {
                    Some(scale) => self.made(StudentT::new(mean?, scale, dof?)),
                    None => self.made(Constant::new(mean?)),
                }
            }
            "exponential" => {
                let mean = self.estimate("mean")?;
                self.made(Exponential::new(mean))
            }
            "gamma" => {
                let (shape, rate) = (self.number("shape"), self.rate());
                self.moved(Gamma::new(shape?, rate?))
            }
            "lognormal" => {
                let mean = self.estimate("mean")?;
                match self.width("std", mean)? {
                    Some(std) => self.made(Lognormal::new(mean, std)),
                    None => self.made(Constant::new(mean)),
                }
            }
            "beta" => {
                let (alpha, beta) = (self.number("alpha"), self.number("beta"));
                if self.unit.has_name() {
                    // 0 and 1 in mm, or 0 and 1 m
                    self.object.required("lower");
                    self.object.required("upper")?;
                }
                let (lower, upper) = (self.limit_or("lower", 0.0), self.limit_or("upper", 1.0));
                self.moved(Beta::between(alpha?, beta?, lower?, upper?))
            }
            "log-uniform" => {
                let (lower, upper) = (self.limit("lower"), self.limit("upper"));
                self.moved(LogUniform::new(lower?, upper?))
            }
            "poisson-count" => self.moved(PoissonCount::new(self.counted("count", 0)?)),
            "weibull" => {
                let (shape, scale) = (self.number("shape"), self.limit("scale"));
                self.moved(External::weibull(shape?, scale?))
            }
            "gumbel" => {
                let (location, scale) = (self.limit("location"), self.difference("scale"));
                self.moved(External::gumbel(location?, scale?))
            }
            "pareto" => {
                let (shape, scale) = (self.number("shape"), self.limit("scale"));
                self.moved(External::pareto(shape?, scale?))
            }
            "chi-squared" => self.moved(External::chi_squared(self.number("dof")?)),
            "binomial" => {
                let (trials, probability) = (self.counted("trials", 1), self.number("probability"));
                self.moved(External::binomial(trials?, probability?))
            }
            "hypergeometric" => {
                let [population, marked, draws] =
                    ["population", "marked", "draws"].map(|key| self.counted(key, 1));
                self.moved(External::hypergeometric(population?, marked?, draws?))
            }
            "samples" => self.moved(Ok(self.samples?.clone())),
            "result" => {
                let component = self.share_of.is_some();
                let results = self.results;
                let saved = results.distribution(&self.object, self.name, self.unit, component)?;
                self.moved(Ok(saved))
            }
            "dcc" => {
                let taken = self.certificate?;
                let shape = taken.distribution(&self.object, self.name, self.unit, self.at)?;
                self.moved(Ok(shape))
            }
            "codata" => {
                // another name has been reported
                let constant = MeasuredConstant::named(self.object.text("constant")?)?;
                self.moved(constant.distribution(&self.object, self.name, self.unit)?)
            }
            "split-normal" => {
                self.object.required("mode")?;
                let mode = self.limit("mode")?;
                let (low, high) = (self.width("std_low", mode), self.width("std_high", mode));
                match (low?, high?) {
                    (Some(low), Some(high)) => self.moved(SplitNormal::new(mode, low, high)),
                    _ => self.made(Constant::new(mode)),
                }
            }
            "quantiles" => {
                self.object.required("probabilities")?;
                self.object.required("values")?;
                let probabilities = self.object.numbers("probabilities");
                let values = self.object.values("values", self.unit, self.of());
                self.moved(Quantiles::new(&probabilities?, &values?))
            }
            _ => self.readings(),
        }
    }

    /// Readings, or what stands in place of their scatter.
    fn readings(&self) -> Option<Distribution> {
        let object = &self.object;
        let TypeA { mean, count, readings } = self.type_a()?;
        for key in ["pooled", "resolution", "evaluation", "groups", "n"] {
            if let (Some(paired), Some(_)) = (object.get("paired"), object.get(key)) {
                let diagnostic = DiagnosticKind::Exclusive { first: key, second: "paired" };
                object.log.report(&paired.key_span, diagnostic);
                return None;
            }
        }
        let bayesian = match object.text("evaluation") {
            Some("bayesian") => true,
            Some("frequentist") => false,
            None if object.get("evaluation").is_none() => false,
            None => return None,
            Some(found) => {
                let (key, found) = ("evaluation".to_owned(), found.to_owned());
                let allowed = vec!["frequentist".to_owned(), "bayesian".to_owned()];
                let place = self.place_of("evaluation");
                object.log.report(&place, DiagnosticKind::NotOneOf { key, found, allowed });
                return None;
            }
        };
        let pooled = readings::pooled(object, self.unit, &self.results.curves)?;
        let root = (count as f64).sqrt();
        let resolution = match object.get("resolution") {
            Some(_) => self.width("resolution", mean)?,
            None => None,
        };
        let half = resolution.map(|step| 0.5 * step);
        let of_scatter: Result<Distribution, Invalid> = match pooled {
            Some(Pooled::Stated(std, dof)) if count > 0 => {
                Normal::with_dof(mean, std / root, dof).map(Into::into)
            }
            Some(Pooled::Residuals(curve)) if count > 0 => {
                let factor = match Unit::conversion_factor(&curve.y, self.unit) {
                    Ok(factor) => factor,
                    Err(_) => {
                        let reason = format!(
                            "the readings are in `{}`, but `{}` has its scatter in `{}`",
                            self.unit, curve.fit.name, curve.y
                        );
                        object
                            .log
                            .report(&self.place_of("pooled"), DiagnosticKind::Table { reason });
                        return None;
                    }
                };
                let std = factor * curve.fit.factor.unwrap_or(f64::NAN);
                Fitted::reading(&curve.fit, mean, std / root).map(Into::into)
            }
            _ if bayesian => readings.and_then(Readings::bayesian).map(Into::into),
            _ => readings.map(Into::into),
        };
        match (of_scatter, half) {
            (Ok(scatter), Some(half))
                if half / 3.0_f64.sqrt() <= scatter.standard_uncertainty() =>
            {
                self.moved(Ok(scatter))
            }
            (Ok(_) | Err(Invalid::NoScatter { .. }), Some(half)) => {
                self.moved(Rectangular::new(mean, half))
            }
            (Err(Invalid::TooFewReadings { count: 1 }), Some(half)) => {
                self.moved(Rectangular::new(mean, half))
            }
            (Err(Invalid::NoScatter { .. }), None) if self.beside_others => {
                self.moved(Constant::new(mean))
            }
            (scatter, _) => self.moved(scatter),
        }
    }

    /// The Type A evaluation of `values` or of a file, or of the summary `mean`, `s` and `n`.
    fn type_a(&self) -> Option<TypeA> {
        let object = &self.object;
        let summary = SUMMARY.into_iter().find_map(|key| Some((key, object.get(key)?)));
        if let Some((second, member)) = summary {
            let first = ["values", "file"].into_iter().find(|key| object.get(key).is_some());
            if let Some(first) = first {
                let diagnostic = DiagnosticKind::Exclusive { first, second };
                object.log.report(&member.key_span, diagnostic);
                return None;
            }
        }
        let values = match (self.read, summary) {
            // those of the day stand in place of a summary as well
            (Some(read), _) => read.in_row(self.at.map_or(0, |(_, row)| row)).to_vec(),
            (None, Some(_)) => return self.summary(),
            (None, None) => self.listed_readings()?,
        };
        let count = values.len();
        let origin = values.first().copied().unwrap_or(f64::NAN);
        let mean = origin + values.iter().map(|value| value - origin).sum::<f64>() / count as f64;
        Some(TypeA { mean, count, readings: Readings::new(values) })
    }

    /// The readings of which only mean, standard deviation and number are stated.
    fn summary(&self) -> Option<TypeA> {
        let object = &self.object;
        let count = self.counted("n", 1);
        let is_component = self.share_of.is_some();
        let mean = match object.get("mean") {
            // of a component only the scatter
            None if is_component => 0.0,
            _ => self.estimate("mean")?,
        };
        let std = match (object.get("s"), object.get("pooled")) {
            (Some(member), Some(_)) => {
                let diagnostic = DiagnosticKind::Exclusive { first: "pooled", second: "s" };
                object.log.report(&member.key_span, diagnostic);
                return None;
            }
            (None, Some(_)) => 0.0,
            // equal readings have no scatter
            (Some(member), None) if member.value.number() == Some(0.0) => 0.0,
            _ => self.width("s", mean)?.unwrap_or(0.0),
        };
        let count = usize::try_from(count?).unwrap_or(usize::MAX);
        Some(TypeA { mean, count, readings: Readings::of_summary(mean, std, count) })
    }

    /// The readings of `values`: numbers, or formulas of the conditions in this row.
    fn listed_readings(&self) -> Option<Vec<f64>> {
        let object = &self.object;
        object.required("values")?;
        let at = self.at.filter(|_| readings::are_of_rows(object, None));
        let Some((conditions, row)) = at else {
            return object.values("values", self.unit, self.of());
        };
        if conditions.are_unreadable() {
            return None;
        }
        let mut values = Vec::new();
        for node in object.list("values")? {
            let Json::Text(text) = &node.value else {
                values.push(object.value_at("values", node, self.unit, self.of())?);
                continue;
            };
            if !readings::is_formula(node) {
                values.push(object.value_at("values", node, self.unit, self.of())?);
                continue;
            }
            let formula = object.log.formula(text);
            let formula = formula.map_err(|error| DiagnosticKind::Formula { error });
            let formula = object.log.value(&node.span, formula)?;
            if row == 0
                && let Err(kinds) = conditions.check(&formula, self.unit, self.of())
            {
                for kind in kinds {
                    object.log.report(&node.span, kind.of_key("values"));
                }
                return None;
            }
            values.push(conditions.value(&formula, row, self.unit, self.of()));
        }
        Some(values)
    }

    /// The shape, moved to an estimate that comes from elsewhere.
    fn moved<S: Into<Distribution>>(&self, shape: Result<S, Invalid>) -> Option<Distribution> {
        let shape = self.made(shape)?;
        match self.estimate {
            Estimate::Own => Some(shape),
            Estimate::Given(estimate) => self.made(shape.moved_to(estimate)),
        }
    }

    /// A number that must be there.
    fn number(&self, key: &'static str) -> Option<f64> {
        self.object.required(key)?;
        self.object.number(key)
    }

    /// A rate: a number in the reciprocal of the unit, or a value with a unit.
    fn rate(&self) -> Option<f64> {
        let member = self.object.required("rate")?;
        if let Json::Number(_) = member.value.value {
            return self.object.number("rate");
        }
        let unit = match self.unit.text().trim() {
            "" | "1" => "1".to_owned(),
            text => format!("1/({text})"),
        };
        let unit = self.object.log.unit(&unit);
        let kind = |error| DiagnosticKind::Unit { unit: self.unit.to_string(), error };
        let unit = self.object.log.value(&member.value.span, unit.map_err(kind))?;
        self.object.value("rate", &unit, ValueOf::Difference)
    }

    /// What values of the object are about: a component is a difference.
    fn of(&self) -> ValueOf {
        if self.share_of.is_some() { ValueOf::Difference } else { ValueOf::Quantity }
    }

    /// A value that must be there.
    fn limit(&self, key: &'static str) -> Option<f64> {
        self.object.required(key)?;
        self.object.value(key, self.unit, self.of())
    }

    /// A value that is a difference of two.
    fn difference(&self, key: &'static str) -> Option<f64> {
        self.object.required(key)?;
        self.object.value(key, self.unit, ValueOf::Difference)
    }

    /// A whole number that is not below `least`.
    fn counted(&self, key: &'static str, least: u64) -> Option<u64> {
        self.object.required(key)?;
        self.object.whole(key, least, MOST_COUNT)
    }

    /// A value that may be left out.
    fn limit_or(&self, key: &'static str, default: f64) -> Option<f64> {
        if self.object.get(key).is_some() { self.limit(key) } else { Some(default) }
    }

    fn normal(&self) -> Option<Distribution> {
        let mean = self.estimate("mean");
        let dof = self.dof();
        let mut divisor = 1.0;
        for key in ["k", "p"] {
            if let (Some(member), None) = (self.object.get(key), self.object.get("expanded")) {
                let diagnostic = DiagnosticKind::OnlyWith { key, with: "expanded" };
                self.object.log.report(&member.key_span, diagnostic);
            }
        }
        let std = match (self.object.get("std"), self.object.get("expanded")) {
            (Some(_), Some(second)) => {
                let diagnostic = DiagnosticKind::Exclusive { first: "std", second: "expanded" };
                self.object.log.report(&second.key_span, diagnostic);
                return None;
            }
            (_, Some(_)) => {
                let factor = self.coverage_factor(dof);
                divisor = factor.unwrap_or(1.0);
                self.width("expanded", mean?)?.zip(factor).map(|(expanded, k)| expanded / k)
            }
            _ => self.width("std", mean?)?,
        };
        match std {
            Some(std) => {
                let normal = Normal::with_dof(mean?, std, dof.unwrap_or(f64::INFINITY));
                self.made(normal.and_then(|normal| normal.stated_with(divisor)))
            }
            None => self.made(Constant::new(mean?)),
        }
    }

    /// The k of an expanded uncertainty: given, or from p and the degrees of freedom.
    fn coverage_factor(&self, dof: Option<f64>) -> Option<f64> {
        match (self.object.get("k"), self.object.get("p")) {
            (Some(_), Some(second)) => {
                let diagnostic = DiagnosticKind::Exclusive { first: "k", second: "p" };
                self.object.log.report(&second.key_span, diagnostic);
                None
            }
            (Some(member), None) => {
                let found = self.object.number("k")?;
                let key = "k".to_owned();
                let diagnostic = match coverage_slips::of_factor(found) {
                    Some(range) => DiagnosticKind::OutOfRange { key, found, range },
                    None if found > 0.0 => return Some(found),
                    None => DiagnosticKind::NotPositive { key, found },
                };
                self.object.log.report(&member.value.span, diagnostic);
                None
            }
            (None, Some(member)) => {
                let found = self.object.number("p")?;
                let key = "p".to_owned();
                let diagnostic = match coverage_slips::of_probability(found) {
                    Some(range) => DiagnosticKind::OutOfRange { key, found, range },
                    None if found > 0.0 && found < 1.0 => {
                        let dof = dof.unwrap_or(f64::INFINITY);
                        return Some(special::student::two_sided_factor(found, dof));
                    }
                    None => DiagnosticKind::NotProbability { key, found, below: 1.0 },
                };
                self.object.log.report(&member.value.span, diagnostic);
                None
            }
            (None, None) => {
                let place =
                    self.object.get("expanded").map_or(self.object.place(), |m| &m.key_span);
                self.object
                    .log
                    .report(place, DiagnosticKind::NoCoverage { name: self.name.to_owned() });
                None
            }
        }
    }

    fn triangular(&self) -> Option<Distribution> {
        let dof = self.dof();
        let inexact = |shape: Triangular| match dof {
            Some(dof) => shape.with_dof(dof),
            None => Ok(shape),
        };
        let (mean, half_width, limits) = self.limits()?;
        let Some(half_width) = half_width else {
            return self.made(Constant::new(mean));
        };
        let Some([lower, upper]) = limits else {
            if let Some(mode) = self.object.get("mode") {
                let diagnostic =
                    DiagnosticKind::MissingKey { key: "lower", what: "an input with a `mode`" };
                self.object.log.report(&mode.key_span, diagnostic);
            }
            return self.made(Triangular::new(mean, half_width).and_then(inexact));
        };
        let mode = self.object.value("mode", self.unit, self.of());
        self.moved(Triangular::between(lower, upper, mode).and_then(inexact))
    }

    /// Middle, half-width (`None` where a specification became 0) and, if given so, the limits.
    #[allow(clippy::type_complexity)]
    fn limits(&self) -> Option<(f64, Option<f64>, Option<[f64; 2]>)> {
        let object = &self.object;
        if object.get("lower").is_none() && object.get("upper").is_none() {
            let key = if object.get("semi_range").is_some() { "semi_range" } else { "half_width" };
            if let (Some(_), Some(second)) = (object.get("half_width"), object.get("semi_range")) {
                let diagnostic =
                    DiagnosticKind::Exclusive { first: "half_width", second: "semi_range" };
                object.log.report(&second.key_span, diagnostic);
            }
            let mean = self.estimate("mean")?;
            return Some((mean, self.width(key, mean)?, None));
        }
        for key in ["mean", "half_width", "semi_range"] {
            if let Some(second) = object.get(key) {
                let diagnostic = DiagnosticKind::Exclusive { first: "lower", second: key };
                object.log.report(&second.key_span, diagnostic);
                return None;
            }
        }
        let (lower, upper) = (self.limit("lower"), self.limit("upper"));
        let (lower, upper) = (lower?, upper?);
        if lower >= upper {
            return self.made(Rectangular::between(lower, upper)).and(None);
        }
        let middle = match self.estimate {
            Estimate::Own => 0.5 * lower + 0.5 * upper,
            Estimate::Given(estimate) => estimate,
        };
        Some((middle, Some(0.5 * upper - 0.5 * lower), Some([lower, upper])))
    }

    /// The estimate from `key`, or from elsewhere.
    fn estimate(&self, key: &'static str) -> Option<f64> {
        self.given().or_else(|| self.limit(key))
    }

    /// The estimate that is given, if one is.
    fn given(&self) -> Option<f64> {
        match self.estimate {
            Estimate::Given(estimate) => Some(estimate),
            Estimate::Own => None,
        }
    }

    /// The width at `key`; inside, `None` where a specification becomes 0 at this estimate.
    #[allow(clippy::option_option)]
    fn width(&self, key: &'static str, estimate: f64) -> Option<Option<f64>> {
        let member = self.object.required(key)?;
        if let (Some(text), Some(at)) = (formula_of_width(&self.object, key, self.unit), self.at) {
            let formula = self.object.log.formula(&text).ok();
            let name = formula
                .as_ref()
                .and_then(|formula| formula.names().next())
                .map(|(name, _)| name.to_owned());
            if !at.0.names().is_empty() || formula.is_some() && name.is_none() {
                return self.width_of_row(key, &text, at.0, at.1);
            }
            // a mistake among the conditions, told already, is why there are none
            if name.is_some() && at.0.are_unreadable() {
                return None;
            }
            if let Some(condition) = name.filter(|name| name != text.trim()) {
                let reason = format!(
                    "as a formula it needs the value of `{condition}`: a width is a formula of \
                     conditions, and there are none; what depends on other inputs stands in an \
                     equation",
                );
                let (name, found) = (self.name.to_owned(), text);
                let kind = DiagnosticKind::Width { name, found, reason };
                self.object.log.report(&member.value.span, kind);
                return None;
            }
        }
        let log = self.object.log;
        // the resolution of readings is a width itself
        let instrument = match key {
            "resolution" | "s" => None,
            _ => Some(instrument::stated(&self.object, self.unit)?),
        };
        let read = Width::read(log, &member.value, self.name, key, self.unit, instrument.as_ref())
            .and_then(|width| self.share_beside_share(key).map_or(Ok(width), Err));
        let width = log.value(&member.value.span, read)?;
        let value = width.at(self.share_of.unwrap_or(estimate));
        if value == 0.0 && width.is_relative_only() { Some(None) } else { Some(Some(value)) }
    }

    /// Why a width in per cent or the like is refused: the estimate is written so as well, and nothing
    /// tells whether the width is a share of it.
    fn share_beside_share(&self, key: &str) -> Option<DiagnosticKind> {
        let text = |key: &str| match &self.object.get(key)?.value.value {
            Json::Text(text) => Some(text.trim()),
            _ => None,
        };
        let found = text(key)?;
        let is_share = |text: &&str| !self.unit.is_relative() && is_bare_share(text);
        let estimate = ["mean", "mode", "value"].into_iter().filter_map(text).find(is_share)?;
        terms(found).into_iter().any(is_bare_share).then(|| DiagnosticKind::Width {
            name: self.name.to_owned(),
            found: found.to_owned(),
            reason: format!(
                "the estimate `{estimate}` is a share as well, so that this can be a share of it or be \
                 counted as it is: write `{found} of reading`, or both in `{}`",
                self.unit
            ),
        })
    }

    /// The width that a formula of conditions gives in a row; inside, `None` where it is 0.
    #[allow(clippy::option_option)]
    fn width_of_row(
        &self,
        key: &'static str,
        text: &str,
        conditions: &dyn ConditionValues,
        row: usize,
    ) -> Option<Option<f64>> {
        let (log, place) = (self.object.log, self.place_of(key));
        let formula = log.formula(text).map_err(|error| DiagnosticKind::Formula { error });
        let formula = log.value(&place, formula)?;
        if row == 0
            && let Err(kinds) = conditions.check(&formula, self.unit, ValueOf::Difference)
        {
            for kind in kinds {
                log.report(&place, kind.of_key(key));
            }
            return None;
        }
        let width = conditions.value(&formula, row, self.unit, ValueOf::Difference);
        if width == 0.0 {
            return Some(None);
        }
        if width > 0.0 && width.is_finite() {
            return Some(Some(width));
        }
        let (name, found) = (self.name.to_owned(), text.to_owned());
        let reason = format!(
            "it is {} in row {} of the conditions",
            gumption_engine::number::Shortest(width),
            row + 1
        );
        log.report(&place, DiagnosticKind::Width { name, found, reason });
        None
    }

    /// The degrees of freedom: a number, or a formula of conditions.
    fn dof(&self) -> Option<f64> {
        let member = self.object.get("dof")?;
        let (Json::Text(text), Some((conditions, row))) = (&member.value.value, self.at) else {
            return self.object.number("dof");
        };
        let (log, span) = (self.object.log, &member.value.span);
        if ["inf", "infinity", "infinite", "∞"].contains(&text.trim().to_lowercase().as_str()) {
            let diagnostic = DiagnosticKind::WrongType {
                what: "`dof`".to_owned(),
                found: "the word for infinity",
                expected: "a number above 0; leave the key out where they are infinite",
            };
            if row == 0 {
                log.report(span, diagnostic);
            }
            return None;
        }
        let formula = log.formula(text).map_err(|error| DiagnosticKind::Formula { error });
        let formula = log.value(span, formula)?;
        if conditions.are_unreadable() {
            return None;
        }
        let (unit, of) = (Unit::one(), ValueOf::Quantity);
        if let Err(kinds) = conditions.check(&formula, &unit, of) {
            if row == 0 {
                kinds.into_iter().for_each(|kind| log.report(span, kind));
            }
            return None;
        }
        Some(conditions.value(&formula, row, &unit, of))
    }

    fn made<S: Into<Distribution>>(&self, shape: Result<S, Invalid>) -> Option<Distribution> {
        match shape.map(S::into).and_then(with_uncertainty) {
            Ok(distribution) => Some(distribution),
            Err(error) => {
                let place = self.place_of(error.parameter());
                let name = match self.at {
                    Some((_, row)) if readings::are_of_rows(&self.object, self.read) => {
                        format!("{} in row {}", self.name, row + 1)
                    }
                    _ => self.name.to_owned(),
                };
                let replacing = self.read.and_then(|read| read.replacing.as_ref());
                let of_file = replacing.filter(|_| error.parameter() == "values");
                let kind = DiagnosticKind::Distribution { name, error };
                match of_file {
                    Some((_, place)) => self.object.log.report_at(place.clone(), kind),
                    None => self.object.log.report(&place, kind),
                }
                None
            }
        }
    }

    /// The place of a parameter's value, or of the input's name.
    fn place_of(&self, parameter: &str) -> Range<usize> {
        let other = match parameter {
            "std" => "expanded",
            "half_width" => "semi_range",
            other => other,
        };
        let member = self.object.get(parameter).or_else(|| self.object.get(other));
        member.map_or_else(|| self.object.place().clone(), |m| m.value.span.clone())
    }
}

#[cfg(test)]
mod tests;
