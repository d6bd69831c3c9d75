//! What is known of a departure that no effect of the list makes, beside some of them or by itself: the
//! posterior over the forms of the discrepancy, and what the discrepancy looks like.

use super::diagnosis::{DepartureForm, DepartureKind, DepartureOver, DepartureShape};
use super::shrink;
use gumption_engine::number::{elementary, largest_first, smallest_first};
use gumption_engine::task::Row;
use gumption_inference::discrepancy::{Of, Term, Weighted};
use gumption_inference::noise::shared_noise::Setting;
use gumption_inference::noise::weighing::Weighing;

/// Forms are told where a departure has more than this probability.
pub(crate) const WORTH_TELLING: f64 = 0.05;

/// Forms below this share of that are left out.
const LEAST_SHARE: f64 = 0.01;

/// A turn of the departure of less than this share of its range is a wiggle.
const WIGGLE: f64 = 0.2;

/// The departure jumps where so much of its change lies within so much of the range.
const JUMP: [f64; 2] = [0.75, 0.12];

/// The probability of a departure over all noises, beside effects of the list or not.
fn departs(weighings: &[Weighing<'_>]) -> f64 {
    weighings.iter().map(|w| w.probability * w.posterior.departs()).sum()
}

/// The probability of a departure over all noises, of what has a pattern.
pub(crate) fn probability(weighings: &[Weighing<'_>]) -> f64 {
    weighings.iter().map(share).sum()
}

/// The probability of a noise with a departure that has a pattern.
fn share(weighing: &Weighing<'_>) -> f64 {
    let posterior = &weighing.posterior;
    weighing.probability * (posterior.departs() - posterior.of_settings).max(0.0)
}

/// The probability that the departure is an error of each setting.
fn of_settings(weighing: &Weighing<'_>) -> f64 {
    weighing.probability * weighing.posterior.of_settings
}

/// The place of the noise with which such a departure is most probable.
pub(crate) fn leading(weighings: &[Weighing<'_>]) -> usize {
    let all = 0..weighings.len();
    all.max_by(|&a, &b| share(&weighings[a]).total_cmp(&share(&weighings[b]))).unwrap_or(0)
}

/// The forms, most probable first; their probabilities sum to that of a departure, of which those that
/// are left out have no part.
pub(crate) fn forms(weighings: &[Weighing<'_>]) -> Vec<DepartureForm> {
    let in_all = departs(weighings);
    if in_all <= WORTH_TELLING {
        return Vec::new();
    }
    let mut forms = with_pattern(weighings);
    forms.extend(errors_of_settings(weighings));
    let told: f64 = forms.iter().map(|form| form.probability).sum();
    for form in &mut forms {
        form.probability *= in_all / told;
    }
    largest_first(&mut forms, |form| form.probability);
    forms
}

/// Errors of each setting of a condition, or of all together.
fn errors_of_settings(weighings: &[Weighing<'_>]) -> Vec<DepartureForm> {
    let mut forms: Vec<(Setting, DepartureForm)> = Vec::new();
    for weighing in weighings {
        let setup = &weighing.setup;
        let Some(shared) = &setup.data.noise.shared else { continue };
        let probability = of_settings(weighing);
        let acts: Vec<usize> =
            (0..shared.ratios.len()).filter(|&output| shared.ratios[output] > 0.0).collect();
        let output = |place: usize| &setup.case.model.outputs[setup.data.outputs[place]].quantity;
        let Some(&first) = acts.first() else { continue };
        let size = shared.deviation(&setup.data, first);
        let outputs: Vec<String> = acts.iter().map(|&place| output(place).name.clone()).collect();
        let same = |(setting, form): &&mut (Setting, DepartureForm)| {
            *setting == shared.setting && form.outputs == outputs
        };
        if let Some((_, known)) = forms.iter_mut().find(same) {
            let both = known.probability + probability;
            if both > 0.0 {
                known.size = (known.size * known.probability + size * probability) / both;
            }
            known.probability = both;
            continue;
        }
        let form = DepartureForm {
            outputs,
            kind: DepartureKind::Additive,
            common: false,
            over: match shared.setting {
                Setting::Condition(c) => {
                    DepartureOver::Condition(setup.case.model.conditions[c].name.clone())
                }
                Setting::All => DepartureOver::AllConditions,
            },
            shape: DepartureShape::Settings,
            scale: None,
            logarithmic: false,
            scale_unit: String::new(),
            size,
            unit: output(first).unit.text().to_owned(),
            beside: Vec::new(),
            probability,
        };
        forms.push((shared.setting, form));
    }
    let total = departs(weighings);
    forms
        .into_iter()
        .map(|(_, form)| form)
        .filter(|form| form.probability >= LEAST_SHARE * total)
        .collect()
}

/// Those that are functions of the conditions or of the sim.
fn with_pattern(weighings: &[Weighing<'_>]) -> Vec<DepartureForm> {
    let departs = probability(weighings);
    let Some(weighing) = weighings.get(leading(weighings)) else { return Vec::new() };
    let kinds = &weighing.posterior.kinds();
    let total: f64 = kinds.iter().map(|kind| kind.weight).sum();
    let mut groups: Vec<Vec<&Weighted>> = Vec::new();
    for kind in kinds {
        let same = |group: &&mut Vec<&Weighted>| {
            group.first().is_some_and(|first| {
                term(weighing, first) == term(weighing, kind) && beside(first) == beside(kind)
            })
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.push(kind),
            None => groups.push(vec![kind]),
        }
    }
    let weight = |group: &[&Weighted]| group.iter().map(|kind| kind.weight).sum::<f64>() / total;
    groups.retain(|group| weight(group) >= LEAST_SHARE);
    groups.iter().map(|group| form(weighing, group, departs * weight(group))).collect()
}

fn term<'w>(weighing: &'w Weighing<'_>, kind: &Weighted) -> &'w Term {
    &weighing.discrepancy.forms[kind.form].term
}

fn beside(kind: &Weighted) -> &[usize] {
    kind.base.as_ref().map_or(&[], |base| &base.effects)
}

fn form(weighing: &Weighing<'_>, group: &[&Weighted], probability: f64) -> DepartureForm {
    let Weighing { setup, discrepancy, .. } = weighing;
    let case = setup.case;
    let first = group[0];
    let term = term(weighing, first);
    let output = |place: usize| &case.model.outputs[setup.data.outputs[place]].quantity;
    let over = match term.of {
        Of::Constant => DepartureOver::Nothing,
        Of::Condition(c) | Of::Level(c) | Of::WithHistory(_, c) => {
            DepartureOver::Condition(case.model.conditions[c].name.clone())
        }
        Of::Sim => DepartureOver::Value,
        Of::Together => DepartureOver::AllConditions,
    };
    let weight: f64 = group.iter().map(|kind| kind.weight).sum();
    let length = group
        .iter()
        .map(|kind| kind.weight * elementary::ln(discrepancy.forms[kind.form].length))
        .sum::<f64>()
        / weight;
    let length = elementary::exp(length);
    let scale = match term.of {
        Of::Condition(c) => Some(discrepancy.axes.length(c, length)),
        Of::Sim => Some((discrepancy.axes.sim_length(&term.outputs, length), false)),
        Of::Constant | Of::Level(_) | Of::WithHistory(..) | Of::Together => None,
    };
    let departures = departures(weighing, group, term);
    let squares = departures.iter().map(|(_, d)| d * d);
    let size = (squares.sum::<f64>() / departures.len().max(1) as f64).sqrt();
    let (size, unit) = if term.relative {
        (size, String::new())
    } else {
        (size, output(term.outputs[0]).unit.text().to_owned())
    };
    let scale_unit = match term.of {
        Of::Condition(c) => case.model.conditions[c].unit.text().to_owned(),
        Of::Sim => output(term.outputs[0]).unit.text().to_owned(),
        _ => String::new(),
    };
    DepartureForm {
        outputs: term.outputs.iter().map(|&place| output(place).name.clone()).collect(),
        kind: if term.relative { DepartureKind::Proportional } else { DepartureKind::Additive },
        common: term.common,
        over,
        shape: match term.of {
            Of::Constant => DepartureShape::Constant,
            Of::Level(_) => DepartureShape::Levels,
            Of::Together => DepartureShape::Varying,
            Of::WithHistory(..) => DepartureShape::Loop,
            Of::Condition(_) | Of::Sim => shape(&departures),
        },
        scale: scale.map(|(scale, _)| scale),
        logarithmic: scale.is_some_and(|(_, logarithmic)| logarithmic),
        scale_unit,
        size,
        unit,
        beside: setup.effect_names(beside(first)),
        probability,
    }
}

/// The departure of the first output that it acts on: coordinates in order with what the data say of
/// it there, as a share of the sim where it is proportional.
fn departures(weighing: &Weighing<'_>, group: &[&Weighted], term: &Term) -> Vec<(f64, f64)> {
    let Weighing { setup, discrepancy, .. } = weighing;
    let output = term.outputs[0];
    let outputs = setup.data.outputs.len();
    let ids: Vec<usize> =
        setup.data.points.iter().filter_map(|point| point.rows.first().copied()).collect();
    let rows: Vec<Row> = ids.iter().map(|&row| setup.row(row).clone()).collect();
    let mut kinds: Vec<Weighted> = group.iter().map(|kind| (*kind).clone()).collect();
    largest_first(&mut kinds, |a| a.weight);
    let predicted = discrepancy.predict(setup, shrink::top(&kinds), &rows, &[]);
    let mut found: Vec<(f64, f64)> = Vec::new();
    for ((row, of), &id) in rows.iter().zip(&predicted).zip(&ids) {
        let nominal = setup.data.points[setup.data.point_of[id]].nominal[output];
        let sim = match &group[0].base {
            Some(base) => base.values[id * outputs + output],
            None => nominal,
        };
        let departure = of[output].0 - sim;
        let departure = if term.relative { departure / sim } else { departure };
        let coordinate = match term.of {
            Of::Condition(c) | Of::Level(c) => row.conditions[c],
            // up and down a loop are no mean of each other
            Of::WithHistory(..) => id as f64,
            _ => nominal,
        };
        if departure.is_finite() {
            found.push((coordinate, departure));
        }
    }
    smallest_first(&mut found, |a| a.0);
    // the mean of what shares a coordinate
    let mut means: Vec<(f64, f64, f64)> = Vec::new();
    for (coordinate, departure) in found {
        match means.last_mut().filter(|(x, ..)| *x == coordinate) {
            Some((_, sum, count)) => {
                *sum += departure;
                *count += 1.0;
            }
            None => means.push((coordinate, departure, 1.0)),
        }
    }
    means.into_iter().map(|(x, sum, count)| (x, sum / count)).collect()
}

/// What a function looks like.
fn shape(departures: &[(f64, f64)]) -> DepartureShape {
    let values: Vec<f64> = departures.iter().map(|(_, d)| *d).collect();
    let (low, high) = ends(&values);
    let range = high - low;
    let (Some(first), Some(last)) = (departures.first(), departures.last()) else {
        return DepartureShape::Varying;
    };
    // turning points, those of wiggles left out
    let mut turns: Vec<(f64, bool)> = Vec::new();
    let mut extreme = *first;
    let mut rising: Option<bool> = None;
    for &(x, d) in departures {
        let up = match rising {
            None if (d - first.1).abs() > WIGGLE * range => {
                rising = Some(d > first.1);
                extreme = (x, d);
                continue;
            }
            None => continue,
            Some(up) => up,
        };
        if (d > extreme.1) == up || d == extreme.1 {
            extreme = (x, d);
        } else if (d - extreme.1).abs() > WIGGLE * range {
            turns.push((extreme.0, up));
            rising = Some(!up);
            extreme = (x, d);
        }
    }
    match turns.as_slice() {
        [] => {
            let up = last.1 > first.1;
            match jump(departures, range) {
                Some(at) => DepartureShape::Step { at, up },
                None if up => DepartureShape::Rising,
                None => DepartureShape::Falling,
            }
        }
        [(at, true)] => DepartureShape::Peak { at: *at },
        [(at, false)] => DepartureShape::Dip { at: *at },
        _ => DepartureShape::Varying,
    }
}

/// Where nearly all of the change lies within a small part of the range.
fn jump(departures: &[(f64, f64)], range: f64) -> Option<f64> {
    let pairs = departures.windows(2);
    let widest =
        pairs.max_by(|a, b| (a[1].1 - a[0].1).abs().total_cmp(&(b[1].1 - b[0].1).abs()))?;
    let whole = departures.last()?.0 - departures.first()?.0;
    let [change, within] = JUMP;
    let near = widest[1].0 - widest[0].0 <= within * whole;
    (near && (widest[1].1 - widest[0].1).abs() > change * range)
        .then(|| 0.5 * (widest[0].0 + widest[1].0))
}

/// The least and the greatest of values.
pub(crate) fn ends(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)))
}
