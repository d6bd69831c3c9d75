//! The two methods side by side, and the verdict of JCGM 101, clause 8.

use super::{coverage_text, in_unit};
use crate::EvaluationReport;
use crate::document::sentence;
use crate::number::{
    MISSING, Percent, coarser, exact, justified, place_of_ends, position, rounded, significant, to,
};
use crate::printed::grouped;
use crate::sheet::Sheet;
use crate::words::{Language, note};
use gumption_engine::model::{GuardRule, Output, Quantity, Tolerance};
use gumption_engine::propagate::gum::{Dof, Gum};
use gumption_engine::propagate::monte_carlo::{Adaptive, FIRST_STAGE, MonteCarlo};
use gumption_engine::propagate::validate::Validation;
use gumption_engine::propagate::{
    Accuracy, Basis, Conformity, ConformityLevel, DifferenceCause, Noiseless, OutputEvaluation,
    Stated,
};
use gumption_engine::task::{Coverage, Settings, StoppingRule, Warning};

/// What is said of a shortest interval that is not exact.
pub(crate) const NEARLY_SHORTEST: &str =
    "the shortest interval is that of the trials within 1e-5 u";

/// What is said where there is no one shortest interval.
pub(crate) const NOT_UNIQUE: &str = "the shortest interval is not unique: others are as short \
                                     within their numerical error, and the trials chose among them";

/// Position of the last digit of skewness and kurtosis.
const SHAPE_PLACE: i32 = -2;

/// What is said of figures without noise: how far they may be off, or why there are none; nothing where
/// none were asked for.
pub(crate) fn without_noise(output: &Quantity, figures: &OutputEvaluation) -> Option<String> {
    Some(match figures.noiseless.as_ref()? {
        Ok(noiseless) => accuracy(output, noiseless),
        Err(why) => format!("no figures without the noise of trials: {}", crate::plain(why)),
    })
}

/// How far the figures without noise may be off, and how they were found.
fn accuracy(output: &Quantity, noiseless: &Noiseless) -> String {
    let number = |value: f64| in_unit(&significant(value, 1), &output.unit);
    match &noiseless.accuracy {
        Accuracy::Bound(bound) => format!(
            "exact: from the distributions of independent contributions, without trials; no figure \
             is off by more than {}",
            number(*bound)
        ),
        Accuracy::Scatter(scatter) => {
            let [low, high] = scatter.symmetric_interval;
            format!(
                "quasi-random: `{}` integrated exactly, the other inputs over {} scrambled nets of {} \
                 points; numerical standard errors of the ends of the symmetric interval {} and {}",
                crate::plain(&scatter.integrated),
                scatter.randomizations,
                grouped(scatter.points),
                significant(low, 1),
                number(high)
            )
        }
    }
}

/// Digits of the standard uncertainty that figures without noise are shown to, at most.
const NOISELESS_DIGITS: u32 = 6;

/// Notes that say why the two methods differ, or what one of them leaves out.
const DIFFERENCES: [&str; 8] = [
    "few-dof",
    "non-linear",
    "no-variance",
    "heavy-tails",
    "gum-dof-undefined",
    "double-precision",
    "underflow",
    "correlations-by-propagation",
];

/// The note that says what [`capability`] says.
const BELOW_CAPABILITY: &str = "below-cmc";

/// Whether the section of an output says what a note says.
pub(crate) fn is_of_output(note: &Warning, output: &str) -> bool {
    let is_said = DIFFERENCES.contains(&note.code()) || note.code() == BELOW_CAPABILITY;
    note.place == *output && is_said
}

/// Why the two methods differ, where they do: the notes about it, and a factor that is fixed.
pub(crate) fn differences(
    report: &EvaluationReport<'_>,
    output: &Output,
    figures: &OutputEvaluation,
    language: Language,
) -> Vec<String> {
    let name = &output.quantity.name;
    let own = report.warnings.iter().filter(|warning| warning.place == *name);
    let own = own.filter(|warning| DIFFERENCES.contains(&warning.code()));
    let mut said: Vec<String> = own.map(|warning| sentence(&note(warning, language))).collect();
    let settings = &report.evaluation.settings;
    let gum = figures.gum.as_ref();
    if let (Coverage::Factor { factor, fixed: true }, Some(Dof::Finite(_)), Some(_)) =
        (settings.coverage, gum.map(|gum| gum.dof), &figures.monte_carlo)
    {
        said.push(format!(
            "The coverage factor {} is fixed whatever the degrees of freedom; the Monte Carlo \
             intervals have the coverage probability {}.",
            exact(factor),
            coverage_text(settings.coverage)
        ));
    }
    said
}

/// What may be stated beside the laboratory's capability.
pub(crate) fn capability(
    output: &Output,
    figures: &OutputEvaluation,
    digits: u32,
) -> Option<String> {
    let stated = figures.capability.as_deref()?;
    let unit = &output.quantity.unit;
    let cmc = in_unit(&stated.cmc_text(), unit);
    let expanded = match stated.rounded(digits.max(if stated.raised { 1 } else { 3 })) {
        Some(expanded) => expanded.to_string(),
        None => exact(stated.expanded_uncertainty),
    };
    let expanded = in_unit(&expanded, unit);
    Some(if stated.raised {
        format!(
            "U = {} is below the laboratory's capability (CMC) of {cmc} and raised to it: {expanded} is \
             to be stated.",
            in_unit(&significant(stated.evaluated, digits), unit)
        )
    } else if stated.below {
        format!("U = {expanded} is below the laboratory's capability (CMC) of {cmc}.")
    } else {
        format!("The laboratory's capability (CMC) is {cmc}; U = {expanded} can be stated.")
    })
}

/// Conformity with the output's tolerance: its probability, the rule and the decision, the risks.
/// `trials` is how many of them the evaluation has, `coverage` that of U.
pub(crate) fn conformity(
    output: &Quantity,
    found: &Conformity,
    (trials, coverage): (Option<u64>, Coverage),
) -> [String; 3] {
    // an uncertainty that is stated in place of the evaluated one has no trials
    let trials = trials.filter(|_| found.stated_uncertainty.is_none());
    let rule = rule_text(output, found, coverage);
    let risks = risks_text(found, trials) + &ratio_text(found, coverage).unwrap_or_default();
    [conformity_text(output, found, trials), rule, risks]
}

/// The probability of conformity with the output's tolerance.
fn conformity_text(output: &Quantity, found: &Conformity, trials: Option<u64>) -> String {
    let probability = percent_of(found, found.probability, trials).text();
    let side = if found.tolerance.holds(found.estimate) { "within" } else { "outside" };
    // an error that was not estimated is none to be told: trials that all agree have no scatter, and
    // a posterior of the law of propagation has no trials
    let error = 100.0 * found.numerical_standard_error;
    let error =
        (error > 0.0).then(|| format!("numerical standard error {} %", significant(error, 1)));
    let counted = trials.filter(|_| found.without_prior.is_none()).map(|trials| {
        let trials = grouped(trials);
        if found.probability > 0.5 {
            format!("all {trials} trials conform")
        } else {
            format!("none of the {trials} trials conforms")
        }
    });
    let prior = found.without_prior.map(|share| {
        let share = Percent::of(share, 0.0, trials).text();
        format!("with the prior, by JCGM 106, 6.3 and 7.1; without it {share} %")
    });
    let stated = found.stated_uncertainty.map(|u| {
        let u = in_unit(&significant(u, 3), &output.unit);
        format!("with the laboratory's capability, u = {u}")
    });
    let notes: Vec<String> = error.or(counted).into_iter().chain(stated).chain(prior).collect();
    let notes = if notes.is_empty() { String::new() } else { format!(" ({})", notes.join("; ")) };
    format!(
        "Tolerance {}: the estimate lies {side}, and the value conforms with a probability of {probability} \
         %{notes}.",
        limits_text(output, &found.tolerance, None),
    )
}

/// A probability of conformity, or of its contrary, in percent.
pub(crate) fn percent_of(found: &Conformity, share: f64, trials: Option<u64>) -> Percent {
    let trials = trials.filter(|_| found.without_prior.is_none());
    Percent::of(share, found.numerical_standard_error, trials)
}

/// Limits with the unit; to a position if there is one.
pub(super) fn limits_text(output: &Quantity, limits: &Tolerance, position: Option<i32>) -> String {
    let text = |limit: f64| {
        position.map_or_else(|| limit.to_string(), |position| rounded(limit, position))
    };
    let limits = match (limits.lower.map(text), limits.upper.map(text)) {
        (Some(lower), Some(upper)) => format!("from {lower} to {upper}"),
        (Some(lower), None) => format!("from {lower} on"),
        (None, Some(upper)) => format!("up to {upper}"),
        (None, None) => String::new(),
    };
    in_unit(&limits, &output.unit)
}

/// What is decided.
pub(crate) fn decision(found: &Conformity) -> &'static str {
    let binary = if found.conforms { "accepted" } else { "rejected" };
    found.level.map_or(binary, ConformityLevel::name)
}

/// The rule by which it is decided.
pub(super) fn rule(found: &Conformity, coverage: Coverage) -> String {
    if let Some(rule) = found.guard_rule {
        return format!("guarded acceptance ({})", named_text(rule, coverage));
    }
    match (found.wanted_risk, found.guard_factor) {
        (Some(risk), _) => {
            format!("guarded acceptance (JCGM 106, 8.3) for {}", risk_text(found, risk))
        }
        (None, Some(factor)) => format!("guarded acceptance ({})", multiple_text(factor, coverage)),
        (None, None) => "simple acceptance (JCGM 106, 8.2)".to_owned(),
    }
}

/// A guard band in multiples of U, which has approximately 95 % where it is that of ILAC-G8.
fn multiple_text(factor: f64, coverage: Coverage) -> String {
    let factor = exact(factor);
    if coverage.is_about_95() {
        return format!("ILAC-G8, guard band of {factor} U");
    }
    let of_u = coverage_text(coverage);
    format!("guard band of {factor} U, with U for {of_u}; ILAC-G8 has it for approximately 95 %")
}

/// A guard band with a name, which is for U of approximately 95 %.
fn named_text(rule: GuardRule, coverage: Coverage) -> String {
    let (title, band) = (rule.title(), rule.formula());
    let text = format!("{title}, guard band of {band}, T half of the tolerance");
    if coverage.is_about_95() {
        return text;
    }
    format!(
        "{text}, with U for {}; the rule has it for approximately 95 %",
        coverage_text(coverage)
    )
}

/// The test uncertainty ratio, where U is that of approximately 95 %.
fn ratio_text(found: &Conformity, coverage: Coverage) -> Option<String> {
    let ratio = found.test_uncertainty_ratio().filter(|_| coverage.is_about_95())?;
    let side = if is_four_to_one(ratio) { "at least" } else { "below" };
    Some(format!(" Test uncertainty ratio TUR = {}, {side} 4:1.", significant(ratio, 3)))
}

/// Whether a test uncertainty ratio is that of the 4:1 rule, but for the rounding of binary fractions.
pub(crate) fn is_four_to_one(ratio: f64) -> bool {
    ratio >= 4.0 * (1.0 - 1e-12)
}

/// A risk that is wanted at most.
fn risk_text(found: &Conformity, risk: f64) -> String {
    let kind = if found.global.is_some() { "global" } else { "specific" };
    format!("a {kind} risk of false acceptance of at most {} %", percentage(risk))
}

/// The decision rule and the decision.
fn rule_text(output: &Quantity, found: &Conformity, coverage: Coverage) -> String {
    let decision = decision(found);
    let of_u = match (found.guard_rule, found.guard_factor) {
        (Some(rule), _) => Some(named_text(rule, coverage)),
        (None, factor) => factor.map(|factor| multiple_text(factor, coverage)),
    };
    if let (Some(rule), None) = (&of_u, found.guard_band) {
        return format!(
            "Decision rule: guarded acceptance ({rule}), which accepts no value, as U is more than half of \
             the tolerance. Decision: {decision}."
        );
    }
    if let (Some(rule), Some(width)) = (of_u, found.guard_band) {
        let digits = position(width, 3);
        let guard = in_unit(&to(width, digits), &output.unit);
        return match found.acceptance {
            Some(acceptance) => format!(
                "Decision rule: guarded acceptance ({rule}): {guard}, accepted {}. Decision: {decision}.",
                limits_text(output, &acceptance, digits)
            ),
            None => format!(
                "Decision rule: guarded acceptance ({rule}): {guard}, more than half of the tolerance, \
                 so that no value is accepted. Decision: {decision}."
            ),
        };
    }
    let Some(risk) = found.wanted_risk else {
        return format!(
            "Decision rule: simple acceptance (JCGM 106, 8.2), accepted where the estimate lies \
             within the tolerance. Decision: {decision}."
        );
    };
    let wanted = risk_text(found, risk);
    let (Some(width), Some(acceptance)) = (found.guard_band, found.acceptance) else {
        return format!(
            "Decision rule: guarded acceptance (JCGM 106, 8.3) for {wanted}; no value has so small \
             a one. Decision: {decision}."
        );
    };
    let digits = position(width, 3);
    format!(
        "Decision rule: guarded acceptance (JCGM 106, 8.3) for {wanted}: guard band {}, accepted {}. \
         Decision: {decision}.",
        in_unit(&to(width, digits), &output.unit),
        limits_text(output, &acceptance, digits)
    )
}

/// Specific and global risks.
fn risks_text(found: &Conformity, trials: Option<u64>) -> String {
    let wrong =
        if found.states_conformity() { "does not conform" } else { "conforms all the same" };
    let specific = percent_of(found, found.specific_risk(), trials).text();
    let mut text = format!("Specific risk that the value {wrong}: {specific} %.");
    if let Some(risks) = found.global {
        text += &format!(
            " Global risks with the prior, for normally distributed errors: false acceptance {} %, \
             false rejection {} %.",
            significant(100.0 * risks.false_acceptance, 3),
            significant(100.0 * risks.false_rejection, 3)
        );
        if risks.acceptance > 0.0 {
            text += &format!(
                " Of the accepted items {} % do not conform (conditional risk of false acceptance).",
                significant(100.0 * risks.conditional_false_acceptance(), 3)
            );
        }
    }
    text
}

/// A share in percent, as exactly as it was given.
fn percentage(share: f64) -> String {
    exact(100.0 * share)
}

/// How the adaptive procedure ended, after how many trials, and why.
pub(crate) fn stability(output: &Quantity, end: &Adaptive, trials: u64) -> String {
    let Adaptive { rule, block_trials, blocks, tolerance, converged } = *end;
    let tolerance = in_unit(&significant(tolerance, 1), &output.unit);
    let trials = grouped(trials);
    let block = grouped(block_trials);
    let made = format!("{trials} trials, {blocks} blocks of {block}");
    let rule = match rule {
        StoppingRule::Clause79 => "JCGM 101, 7.9",
        StoppingRule::Stein => "Stein's two-stage rule",
    };
    match end.rule {
        _ if blocks == 0 => format!(
            "{rule}: {trials} trials are the most that may be made, and two blocks of {block} would \
             be needed to say how far the figures scatter"
        ),
        StoppingRule::Clause79 if converged => format!(
            "{rule}: all figures of all outputs are stable after {made}, here to {tolerance}"
        ),
        StoppingRule::Clause79 => format!("{rule}: not yet stable to {tolerance} after {made}"),
        StoppingRule::Stein if converged => format!(
            "{rule}: by the scatter of the first {FIRST_STAGE} blocks {made}, are enough for all \
             figures of all outputs, here to {tolerance}, each with a probability of 95 %"
        ),
        StoppingRule::Stein => format!(
            "{rule}: by the scatter of the first blocks more than {made}, would be needed, here for \
             {tolerance}"
        ),
    }
}

/// A figure by all methods.
struct MethodsLine {
    name: &'static str,
    gum: String,
    monte_carlo: String,
    error: String,
    noiseless: [String; 2],
}

/// The figures of all methods, and which methods there are.
struct Lines<'a> {
    lines: Vec<MethodsLine>,
    has_trials: bool,
    noiseless: Option<&'a Noiseless>,
}

impl<'a> Lines<'a> {
    /// Nothing without trials and without figures that have no noise.
    fn of(figures: &'a OutputEvaluation, digits: u32) -> Option<Self> {
        let noiseless = figures.noiseless.as_ref().and_then(|found| found.as_deref().ok());
        let trials = figures.monte_carlo.as_deref();
        (trials.is_some() || noiseless.is_some()).then(|| Self {
            lines: lines(figures.gum.as_ref(), trials, noiseless, digits),
            has_trials: trials.is_some(),
            noiseless,
        })
    }

    /// The columns of numbers with their headings.
    fn columns(&self) -> Vec<(&'static str, Vec<String>)> {
        let of = |text: fn(&MethodsLine) -> &String| {
            self.lines.iter().map(|l| text(l).clone()).collect()
        };
        let mut columns = vec![("GUM", of(|line| &line.gum))];
        if self.has_trials {
            columns.push(("Monte Carlo", of(|line| &line.monte_carlo)));
            columns.push(("numerical\nstandard error", of(|line| &line.error)));
        }
        match self.noiseless.map(|noiseless| &noiseless.accuracy) {
            Some(Accuracy::Bound(_)) => columns.push(("exact", of(|line| &line.noiseless[0]))),
            Some(Accuracy::Scatter(_)) => {
                columns.push(("quasi-\nrandom", of(|line| &line.noiseless[0])));
                columns.push(("its standard\nerror", of(|line| &line.noiseless[1])));
            }
            None => {}
        }
        columns
    }
}

/// The figures of all methods side by side; `None` where there is only the law of propagation.
pub(crate) fn sheet(figures: &OutputEvaluation, digits: u32) -> Option<Sheet> {
    let lines = Lines::of(figures, digits)?;
    let mut sheet = Sheet::default();
    sheet.text("quantity", lines.lines.iter().map(|line| line.name.to_owned()));
    for (heading, texts) in lines.columns() {
        sheet.numbers(heading, texts);
    }
    Some(sheet)
}

/// Figures without noise with their standard errors, in the order of the lines.
fn noiseless_texts(of: &Noiseless, u: Option<f64>) -> [[String; 2]; 7] {
    let place = of.standard_uncertainty.or(u).and_then(|u| position(u, NOISELESS_DIGITS));
    let [low, high] = of.symmetric_interval.map(Some);
    let ends = |ends: Option<[f64; 2]>| ends.map_or([None; 2], |ends| ends.map(Some));
    let [short_low, short_high] = ends(of.shortest_interval);
    let median = Some(of.median);
    let values = [of.estimate, of.standard_uncertainty, median, low, high, short_low, short_high];
    let errors = match &of.accuracy {
        Accuracy::Bound(bound) => [Some(*bound); 7],
        Accuracy::Scatter(scatter) => {
            let [low, high] = scatter.symmetric_interval.map(Some);
            let [short_low, short_high] = ends(scatter.shortest_interval);
            let (u, median) = (scatter.standard_uncertainty, Some(scatter.median));
            [scatter.estimate, u, median, low, high, short_low, short_high]
        }
    };
    std::array::from_fn(|i| {
        let missing = || MISSING.to_owned();
        let value = values[i].map(|value| justified(value, place, errors[i].unwrap_or(f64::NAN)));
        let error = errors[i].filter(|error| !error.is_nan()).map(|error| significant(error, 1));
        [value, error].map(|text| text.unwrap_or_else(missing))
    })
}

fn lines(
    gum: Option<&Gum>,
    trials: Option<&MonteCarlo>,
    noiseless: Option<&Noiseless>,
    digits: u32,
) -> Vec<MethodsLine> {
    let uncertainty = gum.map(|gum| gum.standard_uncertainty);
    let own = trials.and_then(|figures| figures.standard_uncertainty).or(uncertainty);
    let gum_position = uncertainty.and_then(|u| position(u, digits));
    let own_position = own.and_then(|u| position(u, digits)).or(gum_position);
    let end_position =
        trials.and_then(|figures| place_of_ends(figures, own, digits)).or(own_position);
    // its value and error, if there are trials, and where its last digit stands
    type OfTrials = Option<(Option<f64>, Option<f64>)>;
    let missing = || MISSING.to_owned();
    let figure = |place: Option<i32>, name: &'static str, gum: Option<f64>, of_trials: OfTrials| {
        let (value, error) = of_trials.unwrap_or_default();
        MethodsLine {
            name,
            gum: gum.map_or_else(missing, |value| to(value, gum_position)),
            monte_carlo: value
                .map_or_else(missing, |value| justified(value, place, error.unwrap_or(f64::NAN))),
            error: error
                .filter(|error| !error.is_nan())
                .map_or_else(missing, |error| significant(error, 1)),
            noiseless: [MISSING.to_owned(), MISSING.to_owned()],
        }
    };
    let line = |name, gum, of: OfTrials| figure(own_position, name, gum, of);
    let end = |name, gum, of: OfTrials| figure(end_position, name, gum, of);
    let each = |of: fn(&MonteCarlo) -> (Option<f64>, Option<f64>)| trials.map(of);
    let low = |ends: [f64; 2], errors: [f64; 2]| (Some(ends[0]), Some(errors[0]));
    let high = |ends: [f64; 2], errors: [f64; 2]| (Some(ends[1]), Some(errors[1]));
    let symmetric = trials.map(|of| (of.symmetric_interval, of.errors.symmetric_interval));
    let shortest = trials.map(|of| (of.shortest_interval, of.errors.shortest_interval));
    let [gum_low, gum_high] = gum.and_then(Gum::interval).map_or([None; 2], |ends| ends.map(Some));
    let mut lines = vec![
        line("estimate", gum.map(|gum| gum.estimate), each(|of| (of.estimate, of.errors.estimate))),
        line(
            "standard uncertainty",
            uncertainty,
            each(|of| (of.standard_uncertainty, of.errors.standard_uncertainty)),
        ),
        end("median", None, each(|of| (Some(of.median), Some(of.errors.median)))),
        end(
            "coverage interval, symmetric: from",
            gum_low,
            symmetric.map(|(ends, errors)| low(ends, errors)),
        ),
        end(
            "coverage interval, symmetric: to",
            gum_high,
            symmetric.map(|(ends, errors)| high(ends, errors)),
        ),
        end(
            "coverage interval, shortest: from",
            None,
            shortest.map(|(ends, errors)| low(ends, errors)),
        ),
        end(
            "coverage interval, shortest: to",
            None,
            shortest.map(|(ends, errors)| high(ends, errors)),
        ),
    ];
    if let Some(of) = trials {
        let shapes = [
            ("skewness", of.skewness, of.errors.skewness),
            ("excess kurtosis", of.excess_kurtosis, of.errors.excess_kurtosis),
        ];
        let found =
            shapes.into_iter().filter_map(|(name, value, error)| Some(shape(name, value?, error)));
        lines.extend(found);
    }
    if let Some(noiseless) = noiseless {
        for (line, texts) in lines.iter_mut().zip(noiseless_texts(noiseless, own)) {
            line.noiseless = texts;
        }
    }
    lines
}

/// Skewness and kurtosis: two decimals, fewer where the numerical standard error says so.
fn shape(name: &'static str, value: f64, error: Option<f64>) -> MethodsLine {
    let missing = || MISSING.to_owned();
    MethodsLine {
        name,
        gum: missing(),
        monte_carlo: justified(value, Some(SHAPE_PLACE), error.unwrap_or(f64::NAN)),
        error: error.map_or_else(missing, |error| significant(error, 1)),
        noiseless: [missing(), missing()],
    }
}

/// The GUM interval alone, where there are no trials.
pub(crate) fn interval_text(output: &Quantity, gum: &Gum, digits: u32) -> Option<String> {
    let position = position(gum.standard_uncertainty, digits);
    let [low, high] = gum.interval()?.map(|end| to(end, position));
    let high = in_unit(&high, &output.unit);
    Some(format!("coverage interval from {low} to {high}, by GUM alone"))
}

/// What JCGM 101, clause 8 says; where it does not validate the GUM interval, why not, and which
/// interval is stated.
pub(crate) fn verdict(
    output: &Quantity,
    figures: &OutputEvaluation,
    monte_carlo: &MonteCarlo,
    settings: &Settings,
) -> Vec<String> {
    let said = clause_8(output, figures, monte_carlo);
    let gum_valid = figures.validation.map(|validation| validation.gum_valid);
    match gum_valid {
        Some(Some(false)) => {
            let cause = cause(figures, settings.statement_tolerance);
            let taken = taken(figures, monte_carlo, settings);
            std::iter::once(said).chain(cause).chain([taken]).collect()
        }
        _ => vec![said],
    }
}

/// What is doubtful of a result, and which result is stated: one sentence without its subject; `None`
/// if clause 8 of JCGM 101 validates the GUM interval, or without trials.
pub(crate) fn doubt(figures: &OutputEvaluation, settings: &Settings) -> Option<String> {
    let monte_carlo = figures.monte_carlo.as_deref()?;
    let taken = taken(figures, monte_carlo, settings);
    let Some(validation) = &figures.validation else {
        return Some(format!("there is no GUM interval. {taken}"));
    };
    match validation.gum_valid {
        Some(true) => None,
        Some(false) => {
            let cause = figures.agreement.map_or("", |agreement| {
                match agreement.cause(settings.statement_tolerance) {
                    DifferenceCause::DegreesOfFreedom => " because of few degrees of freedom",
                    DifferenceCause::Shape => {
                        " because of the shape of a distribution or a nonlinear model"
                    }
                }
            });
            Some(format!("GUM interval not validated (JCGM 101, clause 8){cause}. {taken}"))
        }
        None => Some(
            "undecided whether the GUM interval is validated (JCGM 101, clause 8); more trials \
             decide."
                .to_owned(),
        ),
    }
}

/// The decision about an output with a tolerance, and the probability that it conforms.
pub(crate) fn decided(
    output: &Quantity,
    found: &Conformity,
    (trials, coverage): (Option<u64>, Coverage),
) -> String {
    let trials = trials.filter(|_| found.stated_uncertainty.is_none());
    format!(
        "{} by {}; tolerance {}, conforms with a probability of {} %.",
        decision(found),
        rule(found, coverage),
        limits_text(output, &found.tolerance, None),
        percent_of(found, found.probability, trials).text()
    )
}

/// The comparison of the two intervals.
fn clause_8(output: &Quantity, figures: &OutputEvaluation, monte_carlo: &MonteCarlo) -> String {
    let Some(validation) = &figures.validation else {
        return "JCGM 101, clause 8: there is no GUM interval to compare; the Monte Carlo interval \
                is stated."
            .to_owned();
    };
    let Validation { digits, tolerance, d_low, d_high, gum_valid } = *validation;
    let [low_error, high_error] = monte_carlo.errors.symmetric_interval;
    if low_error.is_nan() || high_error.is_nan() {
        return format!(
            "JCGM 101, clause 8: undecided whether the GUM interval is validated: with only {} trials \
             the endpoints of the Monte Carlo interval are the extreme trials.",
            grouped(monte_carlo.trials)
        );
    }
    let low = difference(d_low, low_error);
    let high = in_unit(&difference(d_high, high_error), &output.unit);
    let tolerance = in_unit(&significant(tolerance, 1), &output.unit);
    let plural = if digits == 1 { "" } else { "s" };
    let limit = format!("the numerical tolerance δ = {tolerance} ({digits} digit{plural})");
    let ends = format!("its endpoints differ from the Monte Carlo endpoints by {low} and {high}");
    match gum_valid {
        Some(true) => {
            format!("JCGM 101, clause 8: the GUM interval is validated: {ends}, within {limit}.")
        }
        Some(false) => format!(
            "JCGM 101, clause 8: the GUM interval is not validated: {ends}, more than {limit}."
        ),
        None => format!(
            "JCGM 101, clause 8: undecided whether the GUM interval is validated: {ends}, too near to \
             {limit} for {} trials{}.",
            grouped(monte_carlo.trials),
            of_results(figures, monte_carlo)
        ),
    }
}

/// Why clause 8 does not validate the GUM interval, given the difference that is allowed.
fn cause(figures: &OutputEvaluation, allowed: f64) -> Option<String> {
    let agreement = figures.agreement?;
    let difference = significant(100.0 * agreement.difference, 2);
    Some(match agreement.cause(allowed) {
        DifferenceCause::DegreesOfFreedom => format!(
            "The cause is few degrees of freedom: with infinite degrees of freedom the endpoints \
             differ by {difference} % of U."
        ),
        DifferenceCause::Shape if agreement.at_infinite_dof => format!(
            "The cause is the shape of a distribution or a nonlinear model: also with infinite \
             degrees of freedom the endpoints differ by {difference} % of U."
        ),
        DifferenceCause::Shape => format!(
            "The cause is the shape of a distribution or a nonlinear model: the endpoints differ by \
             {difference} % of U."
        ),
    })
}

/// Which interval is stated.
fn taken(figures: &OutputEvaluation, monte_carlo: &MonteCarlo, settings: &Settings) -> String {
    let stated = Stated::of(figures, settings);
    if stated.is_none_or(|stated| stated.basis != Basis::Shortest) {
        return "U is stated by the law of propagation.".to_owned();
    }
    let kind = if monte_carlo.stated_interval().shortest { "shortest" } else { "symmetric" };
    format!("The {kind} Monte Carlo interval is stated.")
}

/// How few the trials of saved results among the inputs are, where there are fewer than here.
fn of_results(figures: &OutputEvaluation, monte_carlo: &MonteCarlo) -> String {
    let results = figures.inherited.iter().flat_map(|inherited| &inherited.results);
    let fewest = results.map(|(_, trials)| *trials).fold(f64::INFINITY, f64::min);
    if fewest < monte_carlo.trials as f64 {
        format!(" and a saved result of {}", grouped(fewest as u64))
    } else {
        String::new()
    }
}

/// The difference of two ends, to the digits that its numerical standard error justifies.
fn difference(value: f64, error: f64) -> String {
    match coarser(position(value, 2), position(error, 1)) {
        Some(position) => rounded(value, position),
        None => "0".to_owned(),
    }
}
