//! The tables of a diagnosis.

use super::digits::{self, p_value, probability, share, tenths};
use super::{residuals, words};
use crate::number::{MISSING, position, rounded, significant, to, with_uncertainty};
use crate::plain;
use crate::sheet::Sheet;
use gumption_gap::{
    DescribedEffect, Diagnosis, EffectParameter, Hypothesis, HypothesisKind, NamedQuantity,
    Predicted, PresentEffect, ProposalKind, ProposedMeasurement, ReplicatedEffect, Shrunk,
};

/// So much of the probability is shown by name, in so many lines at most.
const SHOWN_PROBABILITY: f64 = 0.999;
const SHOWN: usize = 8;

fn missing() -> String {
    MISSING.to_owned()
}

/// Where the gap lies; `None` where no region stands out.
pub(super) fn regions(diagnosis: &Diagnosis) -> Option<Sheet> {
    let regions = &diagnosis.regions;
    if regions.is_empty() {
        return None;
    }
    let mut sheet = Sheet::default();
    sheet.text("", (0..regions.len()).map(words::letter));
    sheet.text("output", regions.iter().map(|region| words::output_of(diagnosis, region)));
    sheet.text("conditions", regions.iter().map(|region| words::range_of(diagnosis, region)));
    sheet.numbers("p", regions.iter().map(|region| p_value(region.p_value)));
    sheet.numbers("share", regions.iter().map(|region| share(region.share_of_gap)));
    sheet.numbers("mean z", regions.iter().map(|region| tenths(region.mean_z)));
    Some(sheet)
}

/// Effects less probable than this are not shown.
const PRESENT: f64 = 0.01;

/// The probability that each effect is part of the truth, with its parameters over all hypotheses;
/// `None` where no effect is worth a line.
pub(super) fn present(diagnosis: &Diagnosis) -> Option<Sheet> {
    let shown: Vec<&PresentEffect> =
        diagnosis.present.iter().filter(|p| p.probability >= PRESENT).take(SHOWN).collect();
    if shown.is_empty() {
        return None;
    }
    // a line for each parameter; the effect stands in the first
    let mut lines: Vec<[String; 7]> = Vec::new();
    for present in shown {
        let head = [plain(&present.effect), probability(present.probability)];
        let mut heads =
            std::iter::once(head).chain(std::iter::repeat([String::new(), String::new()]));
        if present.parameters.is_empty() {
            let [effect, p] = heads.next().unwrap_or_default();
            lines.push([effect, p, missing(), String::new(), missing(), missing(), missing()]);
        }
        for of in &present.parameters {
            let [effect, p] = heads.next().unwrap_or_default();
            let [estimate, u, low, high] = parameter(of);
            let name = of.name.rsplit('/').next().unwrap_or(&of.name);
            let unit = words::unit(&of.unit).unwrap_or_default();
            let name =
                if unit.is_empty() { plain(name) } else { format!("{} in {unit}", plain(name)) };
            lines.push([effect, p, name, estimate, u, low, high]);
        }
    }
    let column = |position: usize| lines.iter().map(move |line| line[position].clone());
    let mut sheet = Sheet::default();
    sheet.text("effect", column(0));
    sheet.numbers("present with\nprobability", column(1));
    sheet.text("parameter", column(2));
    sheet.numbers("estimate", column(3));
    sheet.numbers("standard\nuncertainty", column(4));
    sheet.numbers("interval\nfrom", column(5));
    sheet.numbers("\nto", column(6));
    Some(sheet)
}

/// The hypotheses that are shown by name: the most probable ones.
pub(super) fn shown(diagnosis: &Diagnosis) -> &[Hypothesis] {
    let mut sum = 0.0;
    let before = diagnosis.hypotheses.iter().take(SHOWN).take_while(|hypothesis| {
        let wanted = sum < SHOWN_PROBABILITY;
        sum += hypothesis.probability;
        wanted
    });
    let count = before.count();
    diagnosis.hypotheses.get(..count).unwrap_or_default()
}

/// The most probable hypotheses.
pub(super) fn hypotheses(diagnosis: &Diagnosis) -> Sheet {
    let shown = shown(diagnosis);
    let evidence = |hypothesis: &Hypothesis| {
        let Hypothesis { log_evidence, standard_error: error, effective_sample_size, .. } =
            *hypothesis;
        if error > 0.0 && error.is_finite() {
            let (value, error) = with_uncertainty(log_evidence, error, digits::UNCERTAINTY);
            [value, error, rounded(effective_sample_size, 0)]
        } else {
            [rounded(log_evidence, -2), missing(), missing()]
        }
    };
    let evidence: Vec<[String; 3]> = shown.iter().map(evidence).collect();
    let column = |position: usize| evidence.iter().map(move |cells| cells[position].clone());
    let mut sheet = Sheet::default();
    sheet.text("hypothesis", shown.iter().map(words::tabled));
    sheet.numbers("prior", shown.iter().map(|h| significant(h.prior, 2)));
    sheet.numbers("probability", shown.iter().map(|h| probability(h.probability)));
    let first = shown.first().map_or(0.0, |first| first.probability);
    let odds = |hypothesis: &Hypothesis| {
        let odds = first / hypothesis.probability;
        if odds > 1.0 && odds.is_finite() {
            format!("{} to 1", significant(odds, 2))
        } else {
            missing()
        }
    };
    sheet.text("odds", shown.iter().map(odds));
    sheet.numbers("ln evidence", column(0));
    sheet.numbers("standard\nerror", column(1));
    sheet.numbers("effective\ndraws", column(2));
    sheet
}

/// How many hypotheses the table leaves out, in words.
pub(super) fn left_out(diagnosis: &Diagnosis) -> Option<String> {
    let rest = diagnosis.hypotheses.get(shown(diagnosis).len()..).unwrap_or_default();
    if rest.is_empty() {
        return None;
    }
    let sum = rest.iter().map(|hypothesis| hypothesis.probability).sum();
    let they = if rest.len() == 1 { "other hypothesis has" } else { "other hypotheses have" };
    Some(format!("{} {they} the probability {} together.", rest.len(), probability(sum)))
}

/// The hypothesis of the verdict.
pub(super) fn winner(diagnosis: &Diagnosis) -> Option<&Hypothesis> {
    let verdict = &diagnosis.most_probable;
    let explained = verdict.kind != HypothesisKind::Unexplained;
    let wanted = explained.then_some(&verdict.effects);
    diagnosis.hypotheses.iter().find(|hypothesis| hypothesis.effects.as_ref() == wanted)
}

/// A parameter as it is printed: estimate, standard uncertainty and the ends of the interval.
pub(super) fn parameter(parameter: &EffectParameter) -> [String; 4] {
    let EffectParameter { estimate, standard_uncertainty: u, interval: [low, high], .. } =
        *parameter;
    let position = position(u, digits::UNCERTAINTY);
    [to(estimate, position), to(u, position), to(low, position), to(high, position)]
}

/// The parameters of the verdict's effects; `None` where there are none.
pub(super) fn parameters(diagnosis: &Diagnosis) -> Option<Sheet> {
    let parameters = &winner(diagnosis)?.parameters;
    if parameters.is_empty() {
        return None;
    }
    let figures: Vec<[String; 4]> = parameters.iter().map(parameter).collect();
    let column = |position: usize| figures.iter().map(move |cells| cells[position].clone());
    let mut sheet = Sheet::default();
    sheet.text("parameter", parameters.iter().map(|parameter| plain(&parameter.name)));
    let unit = |parameter: &EffectParameter| words::unit(&parameter.unit).unwrap_or_default();
    let about = |parameter: &EffectParameter| {
        let (effect, name) = parameter.name.rsplit_once('/')?;
        let effect = diagnosis.candidates.iter().find(|known| known.name == effect)?;
        let [.., about] = effect.parameters.iter().find(|[known, ..]| known == name)?;
        Some(plain(about))
    };
    if parameters.iter().any(|parameter| about(parameter).is_some_and(|text| !text.is_empty())) {
        let about = |parameter: &EffectParameter| about(parameter).unwrap_or_default();
        sheet.text("description", parameters.iter().map(about));
    }
    sheet.text("unit", parameters.iter().map(unit));
    sheet.numbers("estimate", column(0));
    sheet.numbers("standard\nuncertainty", column(1));
    sheet.numbers("interval\nfrom", column(2));
    sheet.numbers("\nto", column(3));
    Some(sheet)
}

/// What the simulator was run with at the verdict, where it was.
pub(super) fn run_at_verdict(diagnosis: &Diagnosis) -> Option<Sheet> {
    let run = diagnosis.simulator.as_ref()?.at_verdict.as_ref()?;
    let parameters = || run.parameters.iter();
    let mut sheet = Sheet::default();
    sheet.text("parameter", parameters().map(|(named, _)| plain(&named.name)));
    let unit = |named: &NamedQuantity| words::unit(&named.unit).unwrap_or_default();
    sheet.text("unit", parameters().map(|(named, _)| unit(named)));
    sheet.numbers("value", parameters().map(|(_, value)| significant(*value, 6)));
    Some(sheet)
}

/// The effects that were looked for; `None` where there were none.
pub(super) fn candidates(diagnosis: &Diagnosis) -> Option<Sheet> {
    let candidates = &diagnosis.candidates;
    if candidates.is_empty() {
        return None;
    }
    let presence = |name: &str| {
        let found = diagnosis.present.iter().find(|present| present.effect == name);
        found.map_or_else(missing, |present| probability(present.probability))
    };
    let parameters = |of: &DescribedEffect| {
        let each = of.parameters.iter().map(|[name, unit, _]| match words::unit(unit) {
            Some(unit) => format!("{} in {unit}", plain(name)),
            None => plain(name),
        });
        each.collect::<Vec<_>>().join(", ")
    };
    let mut sheet = Sheet::default();
    sheet.text("effect", candidates.iter().map(|of| plain(&of.name)));
    sheet.text("description", candidates.iter().map(|of| plain(&of.about)));
    sheet.text("parameters", candidates.iter().map(parameters));
    sheet.numbers("present with\nprobability", candidates.iter().map(|of| presence(&of.name)));
    Some(sheet)
}

/// Sizes of effects in each group of rows; `None` where nothing groups them.
pub(super) fn replication(diagnosis: &Diagnosis) -> Option<Sheet> {
    let replication = diagnosis.replication.as_ref()?;
    let present = |of: &&ReplicatedEffect| of.probability_shared + of.probability_own >= PRESENT;
    let mut lines: Vec<[String; 8]> = Vec::new();
    for of in replication.effects.iter().filter(present).take(SHOWN) {
        let head = [
            plain(&of.effect),
            probability(of.probability_shared),
            probability(of.probability_own),
        ];
        let mut heads =
            std::iter::once(head).chain(std::iter::repeat([missing(), missing(), missing()]));
        let group = |group: f64| {
            let named = &replication.condition;
            format!("{} = {}", plain(&named.name), digits::condition(group))
        };
        let spread = if of.by_ratios { "spread of the logarithm" } else { "spread" };
        let labels = replication.groups.iter().map(|&value| group(value));
        let sizes = labels.zip(&of.sizes).chain(of.spread.iter().map(|of| (spread.to_owned(), of)));
        for (label, size) in sizes {
            let [effect, shared, own] = heads.next().unwrap_or_default();
            let [estimate, u, low, high] = parameter(size);
            let name = NamedQuantity { name: size.name.clone(), unit: size.unit.clone() };
            let label = format!("{}, {label}", words::axis(&name));
            lines.push([effect, shared, own, label, estimate, u, low, high]);
        }
    }
    if lines.is_empty() {
        return None;
    }
    let column = |position: usize| lines.iter().map(move |line| line[position].clone());
    let mut sheet = Sheet::default();
    sheet.text("effect", column(0));
    sheet.numbers("one size\nfor all", column(1));
    sheet.numbers("another size\nin each", column(2));
    sheet.text("size", column(3));
    for (place, header) in
        ["estimate", "standard\nuncertainty", "interval\nfrom", "\nto"].iter().enumerate()
    {
        sheet.numbers(header, column(4 + place));
    }
    Some(sheet)
}

/// How far the gap shrinks.
pub(super) fn shrinkage(diagnosis: &Diagnosis) -> Sheet {
    let shrinkage = &diagnosis.shrinkage;
    let fraction = |shrunk: &Shrunk| {
        if shrinkage.meaningful {
            words::fraction(shrunk.removed_fraction, shrunk, shrinkage.values)
        } else {
            missing()
        }
    };
    let rms = |name: String, unit: String, shrunk: &Shrunk| {
        let floor = shrunk.noise_floor;
        let [before, after] =
            [shrunk.rms_before, shrunk.rms_after].map(|value| digits::beside(value, floor));
        [name, unit, before, after, digits::beside(floor, floor), fraction(shrunk)]
    };
    let mut lines = vec![rms("rms residual, all outputs".into(), "u".into(), &shrinkage.all)];
    for (named, shrunk) in diagnosis.outputs.iter().zip(&shrinkage.outputs) {
        let unit = words::unit(&named.unit).unwrap_or_default();
        lines.push(rms(format!("rms residual of {}", plain(&named.name)), unit, shrunk));
    }
    let pair = |name: &str, [before, after]: [f64; 2], digits: fn(f64) -> String| {
        let name = name.to_owned();
        [name, String::new(), digits(before), digits(after), missing(), missing()]
    };
    let hundredths = |value: f64| rounded(value, -2);
    lines.push(pair("chi-square per degree of freedom", shrinkage.chi2_per_dof, hundredths));
    lines.push(pair("share of values with |En| <= 1", shrinkage.within, share));
    let column = |position: usize| lines.iter().map(move |line| line[position].clone());
    let mut sheet = Sheet::default();
    sheet.text("", column(0));
    sheet.text("unit", column(1));
    sheet.numbers("before", column(2));
    sheet.numbers("after", column(3));
    sheet.numbers("noise\nfloor", column(4));
    sheet.numbers("fraction\nremoved", column(5));
    sheet
}

/// What to measure next, best first; `None` where nothing is proposed.
pub(super) fn next(diagnosis: &Diagnosis) -> Option<Sheet> {
    let proposals = &diagnosis.next.proposals;
    if proposals.is_empty() {
        return None;
    }
    let what = |proposal: &ProposedMeasurement| match proposal.kind {
        ProposalKind::Row { .. } => "one more row",
        ProposalKind::Repeats { .. } => "repeats",
        ProposalKind::Outside { .. } => "outside the data",
        ProposalKind::Input { .. } => "calibrate an input",
        _ => "another output",
    };
    let fall = |proposal: &ProposedMeasurement| {
        digits::percent_of(proposal.expected_entropy_loss / diagnosis.next.entropy)
    };
    let wanted = |proposal: &ProposedMeasurement| {
        proposal.count_for_20_to_1.map_or_else(missing, |count| count.to_string())
    };
    let mut sheet = Sheet::default();
    sheet.text("what", proposals.iter().map(|p| what(p).to_owned()));
    sheet.text("where", proposals.iter().map(|p| words::place(diagnosis, p)));
    sheet.numbers("how\noften", proposals.iter().map(|p| p.count.to_string()));
    sheet.numbers("removes of the\nuncertainty", proposals.iter().map(fall));
    sheet.numbers("for odds\nof 20 to 1", proposals.iter().map(wanted));
    Some(sheet)
}

/// Corrected predictions of one output. Conditions that would not fit stand in one column.
pub(super) fn prediction(
    diagnosis: &Diagnosis,
    rows: &[Predicted],
    output: usize,
    joined: bool,
) -> Sheet {
    let conditions = &diagnosis.conditions;
    let mut sheet = Sheet::default();
    if joined {
        sheet.text("conditions", rows.iter().map(|row| words::at(conditions, &row.conditions)));
    } else {
        for (position, named) in conditions.iter().enumerate() {
            let value = |row: &Predicted| {
                row.conditions.get(position).map_or_else(missing, |&value| digits::condition(value))
            };
            sheet.numbers(&header(named), rows.iter().map(value));
        }
    }
    let figures: Vec<(String, String)> = rows
        .iter()
        .map(|row| match row.outputs.get(output) {
            Some(&(value, u)) => with_uncertainty(value, u, digits::UNCERTAINTY),
            None => (missing(), missing()),
        })
        .collect();
    let digits = |row: &Predicted| {
        let (_, u) = row.outputs.get(output)?;
        position(*u, digits::UNCERTAINTY)
    };
    let number = |value: Option<f64>, row: &Predicted| match value {
        Some(value) => to(value, digits(row)),
        None => missing(),
    };
    let sims = rows.iter().map(|row| number(row.model.get(output).copied(), row));
    let measured = |row: &Predicted| residuals::measured_at(diagnosis, output, &row.conditions);
    let any = rows.iter().any(|row| measured(row).is_some());
    sheet.numbers("corrected\nestimate", figures.iter().map(|(value, _)| value.clone()));
    sheet.numbers("standard\nuncertainty", figures.into_iter().map(|(_, u)| u));
    sheet.numbers("sim\nuncorrected", sims);
    if any {
        sheet.numbers("measured\n(mean)", rows.iter().map(|row| number(measured(row), row)));
    }
    sheet
}

fn header(named: &NamedQuantity) -> String {
    let name = plain(&named.name);
    words::unit(&named.unit).map_or(name.clone(), |unit| format!("{name}\nin {unit}"))
}
