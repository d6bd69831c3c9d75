//! The answer in sentences.

use super::departure;
use super::digits::{self, condition, p_equals, percent, percent_of, probability, share, tenths};
use crate::number::{degrees_of_freedom, exact, position, rounded, significant, with_uncertainty};
use crate::plain;
use crate::statement::Measurement;
use crate::words::{Language, sentence};
use gumption_gap::{
    Diagnosis, DiagnosisNote, GapPart, GapRegion, Hypothesis, HypothesisKind, LeftBeside,
    NamedQuantity, NoiseEstimate, PriorConflict, ProposalKind, ProposedMeasurement, SettingError,
    Shrunk, UncertaintyFactor, ValueGap,
};
use gumption_units::listed;

/// What a hypothesis is called.
pub(super) fn hypothesis(effects: Option<&[String]>) -> String {
    match effects {
        None => "unexplained".to_owned(),
        Some([]) => "none".to_owned(),
        Some(effects) => effects.iter().map(|name| plain(name)).collect::<Vec<_>>().join(" + "),
    }
}

/// A hypothesis in a table, with what may act beside its effects.
pub(super) fn tabled(hypothesis: &Hypothesis) -> String {
    let beside = if hypothesis.beside { ", and something beside" } else { "" };
    self::hypothesis(hypothesis.effects.as_deref()) + beside
}

/// A hypothesis in a list of several.
fn quoted(effects: &[String]) -> String {
    if effects.is_empty() { "no gap".to_owned() } else { hypothesis(Some(effects)) }
}

/// The title of the page.
pub(super) fn title(diagnosis: &Diagnosis) -> String {
    let title = plain(&diagnosis.title);
    if title.is_empty() { "Diagnosis of the gap between sim and data".to_owned() } else { title }
}

/// The verdict in one plain sentence.
pub(super) fn verdict(diagnosis: &Diagnosis) -> String {
    let verdict = &diagnosis.most_probable;
    let how_sure = format!("(probability {})", probability(verdict.probability));
    if verdict.probability < LIKELY && verdict.kind != HypothesisKind::Unexplained {
        return most_probable_of_several(diagnosis);
    }
    if verdict.kind != HypothesisKind::None && 1.0 - no_gap(diagnosis) < SURE {
        return format!(
            "It is not decided whether there is a gap: the probability that {} is {}, and the \
             probability of no gap is {}.",
            match verdict.kind {
                HypothesisKind::Explained => format!("{} makes a gap", quoted(&verdict.effects)),
                _ => "none of the candidate effects explains the data".to_owned(),
            },
            probability(verdict.probability),
            probability(no_gap(diagnosis))
        );
    }
    match verdict.kind {
        HypothesisKind::None if diagnosis.notes.iter().any(|note| note.code() == "scatter") => {
            format!(
                "There is no gap that an effect or a discrepancy explains {how_sure}, but the data \
             scatter by more than their uncertainties."
            )
        }
        HypothesisKind::None if !noise_verdict(diagnosis).is_empty() => {
            let sure = if noise_is_off(diagnosis) >= SURE { "" } else { "probably " };
            format!(
                "There is no gap that an effect explains {how_sure}, but the noise is {sure}not as \
                 stated."
            )
        }
        HypothesisKind::None => {
            format!("There is no gap: the uncertainties explain the data {how_sure}.")
        }
        HypothesisKind::Unexplained if explained(diagnosis) > verdict.probability => {
            format!(
                "There is a gap. No candidate effect explains it {how_sure}: this is more \
                 probable than any single explanation. All explanations together have the \
                 probability {}.",
                probability(explained(diagnosis))
            )
        }
        HypothesisKind::Unexplained => {
            format!("There is a gap, and none of the candidate effects explains it {how_sure}.")
        }
        HypothesisKind::Explained => {
            let names: Vec<String> = verdict.effects.iter().map(|name| plain(name)).collect();
            if let Some(left) = &verdict.beside {
                return with_something_beside(diagnosis, &names, left);
            }
            match names.as_slice() {
                [name] => format!("There is a gap, and {name} explains it {how_sure}."),
                names => format!(
                    "There is a gap, and {} together explain it {how_sure}.",
                    listed(names, " and ")
                ),
            }
        }
    }
}

/// The verdict where effects are there and something without a name is left beside them.
fn with_something_beside(diagnosis: &Diagnosis, names: &[String], left: &LeftBeside) -> String {
    let effects = &diagnosis.most_probable.effects;
    let holds = |of: &&Hypothesis| {
        let own = of.effects.as_ref();
        own.is_some_and(|own| effects.iter().all(|name| own.contains(name)))
    };
    let there: f64 = diagnosis.hypotheses.iter().filter(holds).map(|of| of.probability).sum();
    let shares = diagnosis.shrinkage.shares.iter();
    let own = shares.filter(|of| matches!(of.what, GapPart::Effect(_)));
    let share = percent_of(own.map(|of| of.share_of_gap).sum());
    let (are, explain) = if names.len() > 1 { ("are", "explain") } else { ("is", "explains") };
    let given = left.probability / diagnosis.most_probable.probability;
    let probably = if given >= SURE { "" } else { "probably " };
    format!(
        "There is a gap. {} {are} present (probability {}) and {explain} {share} of it. Something \
         else {probably}remains (probability {}, {} of the gap): {}.",
        listed(names, " and "),
        probability(there.min(1.0)),
        probability(left.probability),
        percent_of(left.share_of_gap),
        departure::left_beside(diagnosis, left)
    )
}

/// What makes how much of the gap; `None` where there is none.
pub(super) fn shares(diagnosis: &Diagnosis) -> Option<String> {
    let parts: Vec<String> = diagnosis
        .shrinkage
        .shares
        .iter()
        .map(|of| format!("{} {}", part(&of.what), percent_of(of.share_of_gap)))
        .collect();
    (!parts.is_empty()).then(|| {
        format!(
            "Shares of the mean square of the residuals, in standard uncertainties, with the \
             inputs at their posterior estimates: {}.",
            parts.join(", ")
        )
    })
}

/// A part of the gap in a list.
pub(super) fn part(what: &GapPart) -> String {
    match what {
        GapPart::Effect(name) => plain(name),
        GapPart::Departure => "unnamed discrepancy".to_owned(),
        GapPart::Noise => "noise".to_owned(),
    }
}

/// The verdict where all other hypotheses together are more probable, with those that come next.
fn most_probable_of_several(diagnosis: &Diagnosis) -> String {
    let verdict = &diagnosis.most_probable;
    let own = Some(&verdict.effects);
    let of = |h: &Hypothesis| match h.effects.as_ref() {
        None => "no candidate effect".to_owned(),
        Some(effects) => quoted(effects),
    };
    let sure = diagnosis.present.iter().filter(|of| of.probability >= SURE);
    let sure: Vec<String> = sure.map(|of| plain(&of.effect)).collect();
    let start = if !sure.is_empty() {
        format!(
            "There is a gap, and {} {} present. What else acts is not decided: {} is only the \
             most probable of several explanations",
            listed(&sure, " and "),
            if sure.len() > 1 { "are" } else { "is" },
            quoted(&verdict.effects)
        )
    } else if 1.0 - no_gap(diagnosis) >= SURE {
        format!(
            "There is a gap, but what explains it is not decided: {} is only the most probable of \
             several explanations",
            quoted(&verdict.effects)
        )
    } else if verdict.effects.is_empty() {
        "It is not decided whether there is a gap: no gap is only the most probable of several \
         hypotheses"
            .to_owned()
    } else {
        format!(
            "It is not decided whether there is a gap: {} is only the most probable of several \
             hypotheses",
            quoted(&verdict.effects)
        )
    };
    let others = diagnosis.hypotheses.iter().filter(|h| h.effects.as_ref() != own);
    let next: Vec<String> = others
        .filter(|h| h.probability >= WORTH_NAMING)
        .map(|h| format!("{} {}", of(h), probability(h.probability)))
        .collect();
    let own = probability(verdict.probability);
    if next.is_empty() {
        return format!("{start} (probability {own}).");
    }
    format!("{start} (probability {own}; {}).", next.join(", "))
}

/// The probability that there is no gap.
fn no_gap(diagnosis: &Diagnosis) -> f64 {
    let none = diagnosis.hypotheses.iter().find(|h| h.effects.as_ref().is_some_and(Vec::is_empty));
    none.map_or(0.0, |none| none.probability)
}

/// The probability that effects of the case explain the gap, whichever.
fn explained(diagnosis: &Diagnosis) -> f64 {
    let named = |h: &&Hypothesis| h.effects.as_ref().is_some_and(|effects| !effects.is_empty());
    diagnosis.hypotheses.iter().filter(named).map(|h| h.probability).sum()
}

/// The probability of what is most likely wrong with the noise as stated.
fn noise_is_off(diagnosis: &Diagnosis) -> f64 {
    let of = |noise: &NoiseEstimate| {
        let factor = noise.factor.map(|factor| factor.probability);
        let serial = noise.serial.map(|serial| serial.probability);
        let correlations = noise.correlations.iter().map(|of| of.probability);
        let settings = noise.settings.as_ref().map(|settings| settings.probability);
        let suspects = noise.suspects.iter().map(|suspect| suspect.probability);
        let several = suspects.chain(correlations);
        several.chain(factor).chain(serial).chain(settings).fold(0.0, f64::max)
    };
    diagnosis.noise.iter().map(of).fold(0.0, f64::max)
}

/// From this probability on something is said without a "probably".
const SURE: f64 = 0.95;

/// Effects that are there with at least this probability are named in the headline.
const WORTH_NAMING: f64 = 0.1;

/// What is said of the noise in the headline is at least this probable.
const LIKELY: f64 = 0.5;

/// Which effects are part of the truth, whatever else is; `None` where none is likely to be.
pub(super) fn present(diagnosis: &Diagnosis) -> Option<String> {
    let named: Vec<String> = diagnosis
        .present
        .iter()
        .filter(|present| present.probability >= WORTH_NAMING)
        .map(|present| format!("{} {}", plain(&present.effect), probability(present.probability)))
        .collect();
    (!named.is_empty()).then(|| {
        format!(
            "Probability that an effect is present, alone or with others: {}.",
            named.join(", ")
        )
    })
}

/// What the named effect contradicts of its prior.
pub(super) fn conflicts(diagnosis: &Diagnosis) -> Vec<String> {
    let verdict = &diagnosis.most_probable;
    if !verdict.prior_conflict {
        return Vec::new();
    }
    let contradicts = |conflict: &PriorConflict| {
        let parameter = &conflict.parameter;
        let (estimate, u) = with_uncertainty(
            parameter.estimate,
            parameter.standard_uncertainty,
            digits::UNCERTAINTY,
        );
        let unit = unit(&parameter.unit).map(|unit| format!(" {unit}")).unwrap_or_default();
        let distance = significant(conflict.prior_distance, 2);
        let counted_in = sentence(&conflict.counted_in(), Language::English);
        format!(
            "This contradicts its prior: {} = {estimate}{unit} with standard uncertainty {u} is \
             {distance} {counted_in}.",
            plain(&parameter.name)
        )
    };
    diagnosis
        .prior_conflicts
        .iter()
        .filter(|conflict| conflict.effects == verdict.effects)
        .map(contradicts)
        .collect()
}

/// How the noise departs from what is stated, a sentence for each output and value where it is
/// likely to.
pub(super) fn noise_verdict(diagnosis: &Diagnosis) -> Vec<String> {
    let mut said = Vec::new();
    for noise in &diagnosis.noise {
        let Some(named) = diagnosis.outputs.get(noise.output) else { continue };
        let name = plain(&named.name);
        if let Some(factor) = noise.factor.filter(|factor| factor.probability > LIKELY) {
            let [low, high] = factor.interval;
            let (word, [estimate, low, high]) = if factor.estimate >= 1.0 {
                ("small", [factor.estimate, low, high])
            } else {
                ("large", [1.0 / factor.estimate, 1.0 / high, 1.0 / low])
            };
            said.push(format!(
                "The stated standard uncertainties of {name} are too {word} by a factor of {} ({} \
                 to {}; probability {}).",
                significant(estimate, 2),
                significant(low, 2),
                significant(high, 2),
                probability(factor.probability)
            ));
            if factor.is_at_limit() {
                let [least, most] = UncertaintyFactor::LIMITS.map(exact);
                said.push(format!(
                    "This is the limit of the tried factors ({least} to {most}); the true factor \
                     may lie beyond it. Check how the uncertainties were stated."
                ));
            }
        }
        let likely = noise.correlations.iter().filter(|of| of.probability > LIKELY);
        // each pair once
        for correlation in likely.filter(|of| of.other > noise.output) {
            let Some(other) = diagnosis.outputs.get(correlation.other) else { continue };
            let [low, high] = correlation.interval.map(|end| rounded(end, -2));
            said.push(format!(
                "The noise of {name} and {} is correlated within a row: coefficient {} ({low} to \
                 {high}), probability {}. Both may share the error of one reference; an input \
                 with `\"per\": \"row\"` in both equations describes it.",
                plain(&other.name),
                rounded(correlation.estimate, -2),
                probability(correlation.probability)
            ));
        }
        if let Some(serial) = noise.serial.filter(|serial| serial.probability > LIKELY) {
            let [low, high] = serial.interval.map(|end| rounded(end, -2));
            said.push(format!(
                "The noise of neighbouring rows of {name} is correlated: coefficient {} ({low} to \
                 {high}), probability {}.",
                rounded(serial.estimate, -2),
                probability(serial.probability)
            ));
        }
        if let Some(error) = noise.settings.as_ref().filter(|of| of.probability > LIKELY) {
            said.push(error_of_settings(error, named));
            if error.is_at_limit() {
                said.push(format!(
                    "Only factors up to {} are tried, so the probabilities are less certain. \
                     Check how the uncertainties were stated.",
                    exact(SettingError::LIMITS[1])
                ));
            }
        }
        for suspect in noise.suspects.iter().filter(|suspect| suspect.probability > LIKELY) {
            said.push(format!(
                "Row {} of {name} is off by {} standard uncertainties (probability {}).",
                suspect.row + 1,
                significant(suspect.size, 2),
                probability(suspect.probability)
            ));
        }
    }
    said
}

/// That the rows of a setting share an error, and what says so in a model file.
fn error_of_settings(error: &SettingError, output: &NamedQuantity) -> String {
    let [low, high] = error.interval.map(|end| significant(end, 2));
    let size = significant(error.standard_deviation, 2);
    let size = unit(&output.unit).map_or(size.clone(), |unit| format!("{size} {unit}"));
    let set = error.condition.as_deref().map_or_else(|| "the conditions".to_owned(), plain);
    let remedy = match error.is_per_value {
        true => format!("; an input with `\"per\": \"{set}\"` describes it"),
        false => String::new(),
    };
    format!(
        "Readings of {} at one setting of {set} share an error with a standard deviation of \
         {size}, {} ({low} to {high}) times the standard uncertainty of a reading (probability \
         {}){remedy}.",
        plain(&output.name),
        significant(error.estimate, 2),
        probability(error.probability)
    )
}

/// The hypotheses that the data cannot tell from the verdict, if there are any.
pub(super) fn look_alikes(diagnosis: &Diagnosis) -> Option<String> {
    let verdict = &diagnosis.most_probable;
    let others: Vec<String> =
        verdict.indistinguishable.iter().skip(1).map(|effects| quoted(effects)).collect();
    if others.is_empty() {
        return None;
    }
    Some(format!(
        "These data cannot distinguish it from: {}. Together they have the probability {}.",
        others.join("; "),
        probability(verdict.indistinguishable_probability)
    ))
}

/// What the sizes in groups are.
pub(super) const REPLICATION: &str = "Sizes in each group of rows, averaged over all hypotheses \
     with the effect. The probabilities are for one size in all groups and for another size in \
     each group. The spread is the standard deviation between groups in the second case.";

/// What a table of odds means.
pub(super) const ODDS: &str = "Odds: probability of the first hypothesis divided by the \
    probability of this one.";

/// That the diagnosis was interrupted.
pub(super) fn interrupted(diagnosis: &Diagnosis) -> Option<String> {
    let note = diagnosis.notes.iter().find(|note| note.code() == INTERRUPTED);
    note.map(|note| plain(&self::note(note)))
}

/// Rows that repeat others, which the verdict depends on.
pub(super) fn copies(diagnosis: &Diagnosis) -> Option<String> {
    let note = diagnosis.notes.iter().find(|note| note.code() == COPIED_ROWS);
    note.map(|note| plain(&self::note(note)))
}

/// The notes that are printed with the verdict.
const COPIED_ROWS: &str = "copied-rows";
const INTERRUPTED: &str = "interrupted";

/// The title above what the sim computes.
pub(super) const SIM: &str = "Model";

/// What the sim computes.
pub(super) fn sim(diagnosis: &Diagnosis) -> Measurement<'_> {
    Measurement { source: &diagnosis.source, model: &diagnosis.sim }
}

/// What stands above the formulas of an effect.
pub(super) const EQUATIONS: &str = "It changes these quantities of the sim. On the right side, a \
     quantity's own name means its value without the effect:";

/// An effect of the verdict, in words and formulas.
pub(super) struct DescribedInWords {
    pub(super) sentences: Vec<String>,
    /// A line for each quantity that it overrides.
    pub(super) equations: String,
}

/// Named effects are described up to this number.
const MOST_DESCRIBED: usize = 4;

/// What the effects of the verdict are; where it names none, those that are most likely there.
pub(super) fn effects(diagnosis: &Diagnosis) -> Vec<DescribedInWords> {
    let verdict = &diagnosis.most_probable;
    let named: Vec<&str> = if verdict.effects.is_empty() {
        let likely = diagnosis.present.iter().filter(|p| p.probability >= WORTH_NAMING);
        likely.map(|p| p.effect.as_str()).collect()
    } else {
        verdict.effects.iter().map(String::as_str).collect()
    };
    let described = named.into_iter().take(MOST_DESCRIBED).filter_map(|name| {
        let effect = diagnosis.candidates.iter().find(|effect| effect.name == name)?;
        let about = plain(&effect.about);
        let about = if about.is_empty() { "no description in the case".to_owned() } else { about };
        let mut sentences = vec![format!("{}: {}", plain(name), about.trim_end_matches('.')) + "."];
        let parameters = effect.parameters.iter().filter(|[_, _, about]| !about.is_empty());
        let parameters: Vec<String> = parameters
            .map(|[name, _, about]| format!("{} is {}", plain(name), plain(about)))
            .collect();
        if !parameters.is_empty() {
            sentences.push(format!("Parameters: {}.", parameters.join("; ")));
        }
        if !effect.source.is_empty() {
            sentences.push(format!("Source: {}.", plain(&effect.source).trim_end_matches('.')));
        }
        let line = |(of, formula): &(String, String)| format!("{} = {}", plain(of), plain(formula));
        let equations: Vec<String> = effect.overrides.iter().map(line).collect();
        Some(DescribedInWords { sentences, equations: equations.join("\n") })
    });
    described.collect()
}

/// The conditions of the whole page.
pub(super) fn settings(diagnosis: &Diagnosis) -> String {
    format!(
        "{} rows of data; intervals at {}; seed {}",
        diagnosis.row_count,
        percent(diagnosis.probability),
        diagnosis.seed
    )
}

/// Whether the residuals are larger than the uncertainties explain.
pub(super) fn gap(diagnosis: &Diagnosis) -> String {
    let gap = diagnosis.gap;
    let Some(p) = gap.p_value else {
        return "The noise is estimated from the residuals themselves, so the residuals cannot be \
                tested against it."
            .to_owned();
    };
    let (chi2, dof) = (tenths(gap.chi2), degrees_of_freedom(&exact(gap.dof)));
    if diagnosis.noise.iter().all(|noise| noise.estimated.is_none()) {
        format!(
            "Chi-square test of all residuals with their covariance matrix: chi-square {chi2} \
             with {dof}, {}. p is the probability of residuals at least this large without a gap.",
            p_equals(p)
        )
    } else {
        format!(
            "F test of lack of fit (means of repeated rows against their scatter): sum of squares \
             {chi2} in variances of the repeats with {dof}, {}. p is the probability of means at \
             least this far from the sim without a gap.",
            p_equals(p)
        )
    }
}

/// The comparison errors of the sim beside their validation standard uncertainties, in the words of ASME
/// V&V 20-2009; `None` where none is known.
pub(super) fn validation(diagnosis: &Diagnosis) -> Option<String> {
    let values: Vec<&ValueGap> = diagnosis
        .rows
        .iter()
        .flat_map(|row| &row.outputs)
        .filter(|of| of.u_validation > 0.0)
        .collect();
    let within = values.iter().filter(|of| of.comparison_error().abs() <= 2.0 * of.u_validation);
    (!values.is_empty()).then(|| {
        format!(
            "Comparison error E = S - D (sim less measured value) and validation standard uncertainty \
             u_val (u_val^2 = u_num^2 + u_input^2 + u_D^2; ASME V&V 20-2009): |E| is at most 2 u_val for \
             {} of {} values.",
            within.count(),
            values.len()
        )
    })
}

/// What is said where no region is listed.
pub(super) fn no_region(diagnosis: &Diagnosis) -> &'static str {
    if diagnosis.interrupted {
        return "The diagnosis was interrupted before regions of the conditions were looked for.";
    }
    "No region of the conditions differs by more than chance from data without a gap."
}

/// What the p-values of regions are.
pub(super) const REGIONS: &str = "p: probability of an equally surprising region anywhere in data \
     without a gap. Share: share of the excess of the squared residuals. Mean z: mean of the \
     residuals over their standard uncertainties.";

/// The letter of a region, which figures have too.
pub(super) fn letter(number: usize) -> String {
    let letter = u8::try_from(number % 26).unwrap_or(0) + b'A';
    char::from(letter).to_string()
}

/// The output that a region is about.
pub(super) fn output_of(diagnosis: &Diagnosis, region: &GapRegion) -> String {
    let named = region.output.and_then(|output| diagnosis.outputs.get(output));
    named.map_or_else(|| "all outputs".to_owned(), |named| plain(&named.name))
}

/// The range of a region.
pub(super) fn range_of(diagnosis: &Diagnosis, region: &GapRegion) -> String {
    let found = region
        .range
        .and_then(|(position, range)| Some((diagnosis.conditions.get(position)?, range)));
    let Some((named, [from, to])) = found else { return "everywhere".to_owned() };
    let name = plain(&named.name);
    if from == to {
        return format!("{name} = {}", in_unit(&condition(from), named));
    }
    format!("{name} from {} to {}", condition(from), in_unit(&condition(to), named))
}

/// A number with the unit of its quantity, if that has a name.
pub(super) fn in_unit(number: &str, named: &NamedQuantity) -> String {
    match unit(&named.unit) {
        Some(unit) => format!("{number} {unit}"),
        None => number.to_owned(),
    }
}

/// A unit that has a name.
pub(super) fn unit(text: &str) -> Option<String> {
    let text = plain(text);
    (!matches!(text.as_str(), "" | "1")).then_some(text)
}

/// `f in Hz`.
pub(super) fn axis(named: &NamedQuantity) -> String {
    match unit(&named.unit) {
        Some(unit) => format!("{} in {unit}", plain(&named.name)),
        None => plain(&named.name),
    }
}

/// `f = 10 Hz, tilt = 35 deg`.
pub(super) fn at(conditions: &[NamedQuantity], values: &[f64]) -> String {
    let parts = conditions.iter().zip(values).map(|(named, &value)| {
        format!("{} = {}", plain(&named.name), in_unit(&condition(value), named))
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// What the table of shrinkage does not say.
pub(super) fn shrinkage(diagnosis: &Diagnosis) -> Vec<String> {
    let shrinkage = &diagnosis.shrinkage;
    let [low, high] = shrinkage.rms_after_interval;
    let digits = position(0.5 * (high - low), 2).unwrap_or(-2);
    let mut said = Vec::new();
    if diagnosis.most_probable.kind == HypothesisKind::None {
        said.push(
            "There is nothing to correct: before and after differ only in the values of the \
             inputs."
                .to_owned(),
        );
    } else if !shrinkage.meaningful {
        said.push(
            "The gap is below 3 standard uncertainties of the data, so no removed fraction is \
             stated: it would be a ratio of noise to noise."
                .to_owned(),
        );
    }
    said.extend(shares(diagnosis));
    if diagnosis.most_probable.beside.is_some() {
        said.push(
            "The correction consists of the effects and a discrepancy, fitted to the data \
             together."
                .to_owned(),
        );
    }
    if diagnosis.most_probable.kind == HypothesisKind::Unexplained {
        said.push(
            "The correction is a discrepancy fitted to the data, since no effect explains the gap."
                .to_owned(),
        );
    }
    if shrinkage.blocks == 0 {
        let because = if diagnosis.rows.len() < 2 {
            "there is one row only"
        } else {
            "the diagnosis was interrupted"
        };
        said.push(format!(
            "Nothing was left out of the fit, since {because}: the residuals after the correction \
             are too small."
        ));
        return said;
    }
    said.push(format!(
        "Each value was predicted by a fit without its own block of conditions ({} blocks). After \
         the correction the root mean square of all outputs is between {} and {} standard \
         uncertainties ({} interval).",
        shrinkage.blocks,
        rounded(low, digits),
        rounded(high, digits),
        percent(diagnosis.probability),
    ));
    if diagnosis.most_probable.kind != HypothesisKind::None {
        let claim = if shrinkage.meaningful {
            format!(
                " At the case's own conditions the fraction removed is expected to be {}.",
                fraction(shrinkage.claimed_fraction, &shrinkage.all, shrinkage.values)
            )
        } else {
            String::new()
        };
        said.push(format!(
            "The logarithm of the predictive density of the left-out values increases by \
             {}.{claim}",
            tenths(shrinkage.log_density_gain)
        ));
    }
    said
}

/// A hypothesis in a sentence on what to tell apart.
fn rival(effects: Option<&Vec<String>>) -> String {
    effects.map_or_else(|| "an effect that is not on the list".to_owned(), |own| quoted(own))
}

/// Whether all rows have the same conditions.
fn at_one_place(diagnosis: &Diagnosis) -> bool {
    diagnosis.rows.windows(2).all(|pair| pair[0].conditions == pair[1].conditions)
}

/// Which conditions say no range, and how they can; `None` where all do.
fn without_range(diagnosis: &Diagnosis) -> Option<String> {
    let conditions = diagnosis.next.without_range.iter();
    let named = conditions.filter_map(|&place| diagnosis.conditions.get(place));
    let names: Vec<String> = named.map(|named| plain(&named.name)).collect();
    let first = names.first()?;
    Some(format!(
        "No range is stated for {}, so proposals use only the values of the data. If other values \
         can be set, state the range in the case: \"{first}\": {{..., \"range\": [lowest, \
         highest]}}.",
        names.join(", ")
    ))
}

/// What a run of the simulator at the verdict gave, where there is one.
pub(super) fn run_at_verdict(diagnosis: &Diagnosis) -> Option<String> {
    let simulator = diagnosis.simulator.as_ref()?;
    let run = simulator.at_verdict.as_ref()?;
    let error = significant(run.error, 2);
    let residual = run.residual.map(|residual| {
        let residual = significant(residual, 3);
        format!(
            " The data differ from it by {residual} standard uncertainties (root mean \
            square)."
        )
    });
    Some(format!(
        "The simulator itself was run with these parameters.{} The prediction from the {} runs \
         differs from this run by {error} standard uncertainties (norm over all rows).",
        residual.unwrap_or_default(),
        simulator.runs
    ))
}

/// What to measure next, in sentences; the table of proposals says the rest.
pub(super) fn next(diagnosis: &Diagnosis) -> Vec<String> {
    let next = &diagnosis.next;
    if diagnosis.simulator.is_some() {
        let rows = "The rows of a simulator belong together, so no single row is proposed: \
                    measure another motion, or repeat this one.";
        return vec![rows.to_owned()];
    }
    let mut said = Vec::new();
    let without_range = without_range(diagnosis);
    for group in &next.equivalent {
        let names: Vec<String> = group.iter().map(|effects| quoted(effects)).collect();
        let names = names.join("; ");
        said.push(if without_range.is_none() {
            format!(
                "These hypotheses are the same function of all conditions that can be set, so no \
                 measurement of these outputs distinguishes them: {names}."
            )
        } else {
            format!(
                "These hypotheses are the same at the conditions of the data, where no \
                 measurement of these outputs distinguishes them: {names}."
            )
        });
    }
    if !next.equivalent.is_empty() || at_one_place(diagnosis) {
        said.extend(without_range);
    }
    let Some(best) = next.proposals.first() else {
        let open = next.entropy > OPEN;
        said.push(if open {
            "No measurement of these outputs at these conditions is expected to be informative; \
             state the `range` of the conditions if other values can be set."
                .to_owned()
        } else {
            "No other hypothesis is probable enough to justify a measurement.".to_owned()
        });
        return said;
    };
    let part = best.expected_entropy_loss / next.entropy;
    said.push(format!(
        "Most informative next step: {}. It is expected to remove {} of the uncertainty between \
         all {} (entropy of their probabilities: {} nats).",
        proposal(diagnosis, best),
        percent_of(part),
        if next.composed > 0 { "hypotheses and composed effects" } else { "hypotheses" },
        significant(next.entropy, 2)
    ));
    if part < LITTLE {
        said.push(
            "The gain is small: the hypotheses differ only outside these conditions or by less \
             than this noise."
                .to_owned(),
        );
    }
    if let Some([own, other]) = next.separates.as_ref() {
        let probability = |effects: &Option<Vec<String>>| {
            let found = diagnosis.hypotheses.iter().find(|of| of.effects == *effects);
            found.map_or(f64::NAN, |of| of.probability)
        };
        let now = probability(own) / probability(other);
        // one that is the verdict with more effects is no rival where there is another one
        let is_more = own
            .as_ref()
            .zip(other.as_ref())
            .is_some_and(|(own, other)| own.iter().all(|effect| other.contains(effect)));
        let among = if is_more {
            "its strongest rival"
        } else {
            "the strongest hypothesis that does not contain it"
        };
        let [own, other] = [own.as_ref(), other.as_ref()].map(rival);
        if now >= 20.0 {
            said.push(format!(
                "The odds of {own} against {among}, {other}, are already {} to 1.",
                significant(now, 2)
            ));
            return said;
        }
        let fewest = next.proposals.iter().filter_map(|p| Some((p.count_for_20_to_1?, p)));
        said.push(match fewest.min_by_key(|(count, _)| *count) {
            Some((count, p)) => format!(
                "A probability of 50 % of odds of 20 to 1 between {own} and {other}, whichever is \
                 true, takes {}: {}.",
                if count == 1 {
                    "one measurement".to_owned()
                } else {
                    format!("{count} measurements")
                },
                place(diagnosis, p)
            ),
            None => format!(
                "No number of these measurements reaches odds of 20 to 1 between {own} and {other}."
            ),
        });
    }
    said
}

/// A removed fraction, not above what the noise lets be known: the mean square of what is left
/// scatters about the floor by the share of the root of two over the number of values.
pub(super) fn fraction(removed: f64, of: &Shrunk, values: usize) -> String {
    let floor = of.noise_floor * of.noise_floor;
    let removable = of.rms_before * of.rms_before - floor;
    let chance = 2.0 * (2.0 / values.max(1) as f64).sqrt() * floor / removable;
    let most = 1.0 - chance;
    if removed <= most || !(0.0..1.0).contains(&most) {
        return share(removed);
    }
    // one digit of what is left open, so that the bound is not rounded to 1
    let digits = position(chance, 1).unwrap_or(-3).min(-2);
    format!(">{}", rounded(most, digits))
}

/// More entropy than this, in nats, is not decided.
const OPEN: f64 = 0.015;

/// Less than this share of what is left open is little.
const LITTLE: f64 = 0.2;

/// What is to be measured, and how often.
fn proposal(diagnosis: &Diagnosis, proposal: &ProposedMeasurement) -> String {
    match (&proposal.kind, proposal.count) {
        (ProposalKind::Input { .. }, _) => place(diagnosis, proposal),
        (_, 1) => format!("one row at {}", place(diagnosis, proposal)),
        (_, count) => format!("{count} rows at {}", place(diagnosis, proposal)),
    }
}

/// Where it is to be measured, or what.
pub(super) fn place(diagnosis: &Diagnosis, proposal: &ProposedMeasurement) -> String {
    match &proposal.kind {
        ProposalKind::Input { input, standard_uncertainty, stated } => {
            let [wanted, stated] =
                [standard_uncertainty, stated].map(|u| in_unit(&significant(*u, 2), input));
            format!("reduce u({}) from {stated} to {wanted}", plain(&input.name))
        }
        ProposalKind::Output { output, conditions, .. } => {
            format!("{} of {}", at(&diagnosis.conditions, conditions), plain(&output.name))
        }
        ProposalKind::Row { conditions }
        | ProposalKind::Repeats { conditions }
        | ProposalKind::Outside { conditions } => {
            if conditions.is_empty() {
                "the same conditions".to_owned()
            } else {
                at(&diagnosis.conditions, conditions)
            }
        }
    }
}

/// The estimated noise of outputs, a sentence each.
pub(super) fn noise(diagnosis: &Diagnosis) -> Vec<String> {
    let sentence = |noise: &NoiseEstimate| {
        let named = diagnosis.outputs.get(noise.output)?;
        let estimated = noise.estimated?;
        let value = significant(estimated.standard_uncertainty, 2);
        let size = in_unit(&value, named);
        let name = plain(&named.name);
        Some(if estimated.power == 0.0 {
            format!("Estimated noise of {name}: {size}.")
        } else {
            format!(
                "Estimated noise of {name}: {size} at the sim's typical value, proportional to \
                 its power {}.",
                rounded(estimated.power, -2)
            )
        })
    };
    diagnosis.noise.iter().filter_map(sentence).collect()
}

/// A note in sentences.
pub fn note(note: &DiagnosisNote) -> String {
    sentence(&note.fact, Language::English) + "."
}

/// What to bear in mind, without what stands beside the verdict and what the section on shrinkage says
/// by itself.
pub(super) fn notes(diagnosis: &Diagnosis) -> Vec<String> {
    let elsewhere = ["small-gap", COPIED_ROWS, INTERRUPTED];
    let notes = diagnosis.notes.iter().filter(|note| !elsewhere.contains(&note.code()));
    notes.map(|note| plain(&self::note(note))).collect()
}
