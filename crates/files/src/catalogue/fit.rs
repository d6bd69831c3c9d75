//! From an effect of the catalogue to one in the names of a sim.

use super::super::effect_context::EffectContext;
use super::measured::Measured;
use super::{ANY_BENCH, Catalogue, Entry};
use gumption_engine::fact;
use gumption_engine::fact::{Argument, Fact};
use gumption_engine::model::Output;
use gumption_engine::model::formula::Formula;
use gumption_gap::OverridableModel;
use gumption_text::json::{Json, Member, Node};

/// Why an entry does not fit a sim.
#[derive(Clone, Debug, Default)]
pub(super) struct Misfit {
    bench: String,
    /// Quantities that its formulas read, in the catalogue's names.
    reads: Vec<String>,
    /// Those of them that the sim does not have.
    missing: Vec<String>,
    /// Quantities that it would override, in the catalogue's names.
    overrides: Vec<String>,
    /// Whether the sim has one of them.
    acts: bool,
    /// A number of a prior that the data do not give.
    unsized_prior: Option<String>,
}

impl Misfit {
    /// How far the entry is from fitting; of two as far, the one for any bench is told about.
    pub(super) fn count(&self) -> usize {
        2 * self.missing.len() + 2 * usize::from(!self.acts) + usize::from(self.bench != ANY_BENCH)
    }

    /// What is missing and what would be needed, after "it".
    pub(super) fn reason(&self, shipped: &Catalogue, sim: &OverridableModel) -> Fact {
        let called = |name: &String| {
            let names = shipped.alternatives(name).into_iter().map(|name| fact!("quoted", name));
            Argument::from(names.reduce(|parts, last| fact!("one-of", parts, last)))
        };
        let all = |names: &[String]| names.iter().map(called).collect::<Vec<_>>();
        let overrides = self.overrides.iter().map(|key| match key.as_str() {
            "{amplitude}" => fact!("observed.amplitudes").into(),
            "{phase}" => fact!("observed.phases").into(),
            _ => called(key),
        });
        let overrides: Vec<Argument> = overrides.collect();
        let mut needs = Vec::new();
        if !self.reads.is_empty() {
            needs.push(fact!("misfit.needs", quantities = all(&self.reads)));
        }
        let why = if !self.missing.is_empty() {
            needs.push(fact!("misfit.changes", quantities = overrides));
            fact!("misfit.missing", quantities = all(&self.missing))
        } else if let Some(prior) = &self.unsized_prior {
            fact!("misfit.prior", prior)
        } else {
            fact!("misfit.unchanged", quantities = overrides)
        };
        let conditions = &sim.conditions;
        let known = |name: &&str| conditions.iter().any(|condition| condition.name == *name);
        let mut targets = self.overrides.iter().flat_map(|name| shipped.alternatives(name));
        let condition = targets.find(known).filter(|_| !self.acts);
        let condition = condition.map(|name| fact!("misfit.condition", name));
        let needs = (!needs.is_empty()).then(|| {
            let needs = Argument::all_of(needs);
            match self.bench.as_str() {
                ANY_BENCH => fact!("misfit.anywhere", needs),
                bench => fact!("misfit.on-bench", bench, needs),
            }
        });
        fact!("misfit", why, condition, needs)
    }
}

/// The entry in the sim's names, with the number of quantities that it overrides. Overrides of
/// quantities that the sim does not have are left out, as long as one is left.
pub(super) fn fit(
    shipped: &Catalogue,
    entry: &Entry,
    sim: &EffectContext<'_>,
) -> Result<(usize, Member), Box<Misfit>> {
    let parameters = expanded(entry.object("parameters"), sim);
    let own: Vec<&str> = parameters.iter().map(|member| member.key.as_str()).collect();
    let overrides = expanded(entry.object("overrides"), sim);
    let mut misfit = Misfit {
        bench: entry.bench.clone(),
        overrides: entry.object("overrides").iter().map(|m| m.key.clone()).collect(),
        ..Misfit::default()
    };
    let overridable = sim.sim.overridable();
    let called = |name: &str| {
        let alternatives = shipped.alternatives(name);
        // what can be overridden is meant, rather than a condition of another name
        let mut by_rank = alternatives.iter().filter(|name| overridable.contains(name));
        let known = || alternatives.iter().find(|name| sim.sim.scope.get(name).is_some());
        by_rank.next().or_else(known).map(|name| (*name).to_owned())
    };
    let mut kept = Vec::new();
    for member in &overrides {
        let Json::Text(text) = &member.value.value else { continue };
        let target = called(&member.key).filter(|name| overridable.contains(&name.as_str()));
        let Some(formula) = renamed(text, &own, &called, &mut misfit, target.is_some()) else {
            continue;
        };
        if let Some(target) = target {
            misfit.acts = true;
            let value = Node { span: member.value.span.clone(), value: Json::Text(formula) };
            kept.push(Member { key: target, key_span: member.key_span.clone(), value });
        }
    }
    let mut sized = Vec::new();
    for parameter in parameters {
        sized.push(with_numbers(parameter, sim, &called, &mut misfit));
    }
    if kept.is_empty() || !misfit.missing.is_empty() || misfit.unsized_prior.is_some() {
        misfit.acts = !kept.is_empty();
        return Err(Box::new(misfit));
    }
    let count = kept.len();
    let members = entry.members.iter().map(|member| {
        let value = match member.key.as_str() {
            "parameters" => Json::Object(sized.clone()),
            "overrides" => Json::Object(kept.clone()),
            _ => member.value.value.clone(),
        };
        Member { value: Node { span: member.value.span.clone(), value }, ..member.clone() }
    });
    let value = Json::Object(members.collect());
    let span = entry.members.first().map_or(0..0, |member| member.key_span.clone());
    let node = Node { span: span.clone(), value };
    Ok((count, Member { key: entry.name.clone(), key_span: span, value: node }))
}

/// The formula in the sim's names. What it reads and the sim does not have is noted; a formula of a
/// quantity that the sim does not have needs nothing.
fn renamed(
    text: &str,
    own: &[&str],
    called: &impl Fn(&str) -> Option<String>,
    misfit: &mut Misfit,
    acts: bool,
) -> Option<String> {
    let formula = Formula::parse(text).ok()?;
    let mut renamed = String::new();
    let mut end = 0;
    for (name, span) in formula.names() {
        if own.contains(&name) {
            continue;
        }
        if !misfit.reads.iter().any(|read| read == name)
            && !misfit.overrides.contains(&name.to_owned())
        {
            misfit.reads.push(name.to_owned());
        }
        let found = called(name);
        if found.is_none() && acts && !misfit.missing.iter().any(|missing| missing == name) {
            misfit.missing.push(name.to_owned());
        }
        renamed.push_str(text.get(end..span.start).unwrap_or(""));
        renamed.push_str(found.as_deref().unwrap_or(name));
        end = span.end;
    }
    renamed.push_str(text.get(end..).unwrap_or(""));
    Some(renamed)
}

/// The members with those for each amplitude or phase written out.
fn expanded(members: &[Member], sim: &EffectContext<'_>) -> Vec<Member> {
    let mut expanded = Vec::new();
    for member in members {
        let kind = ["{amplitude}", "{phase}"].into_iter().find(|kind| member.key.contains(kind));
        let Some(kind) = kind else {
            expanded.push(member.clone());
            continue;
        };
        for (output, observed) in sim.sim.outputs.iter().zip(sim.observed) {
            if observed.is_none() || is_phase(output) != (kind == "{phase}") {
                continue;
            }
            let text = |text: &str| {
                text.replace(kind, &output.quantity.name)
                    .replace("{unit}", one_if_empty(output.quantity.unit.text()))
            };
            expanded.push(written(member, &text));
        }
    }
    expanded
}

/// Whether an output is an angle of a turn: periodic, or in a unit of angle.
fn is_phase(output: &Output) -> bool {
    const ANGLES: [&str; 9] = ["deg", "°", "rad", "mrad", "arcmin", "arcsec", "gon", "rev", "turn"];
    output.period.is_some() || ANGLES.contains(&output.quantity.unit.text().trim())
}

fn one_if_empty(unit: &str) -> &str {
    if unit.trim().is_empty() { "1" } else { unit }
}

/// The member with all its texts rewritten.
pub(super) fn written(member: &Member, text: &impl Fn(&str) -> String) -> Member {
    let value = match &member.value.value {
        Json::Text(value) => Json::Text(text(value)),
        Json::Object(members) => {
            Json::Object(members.iter().map(|member| written(member, text)).collect())
        }
        other => other.clone(),
    };
    let value = Node { span: member.value.span.clone(), value };
    Member { key: text(&member.key), key_span: member.key_span.clone(), value }
}

/// The parameter with numbers for the multiples of what was measured.
fn with_numbers(
    parameter: Member,
    sim: &EffectContext<'_>,
    called: &impl Fn(&str) -> Option<String>,
    misfit: &mut Misfit,
) -> Member {
    let Json::Object(fields) = parameter.value.value else { return parameter };
    let fields = fields.into_iter().map(|field| {
        let measured = match &field.value.value {
            Json::Object(members) => Measured::of(members),
            _ => None,
        };
        let Some(measured) = measured else { return field };
        let name = match called(&measured.name) {
            Some(name) if measured.of_condition() => name,
            _ => measured.name.clone(),
        };
        let value = measured.value(sim, &name);
        if value.is_none() && misfit.missing.is_empty() {
            misfit.unsized_prior.get_or_insert_with(|| measured.words());
        }
        let number = Json::Number(value.unwrap_or(1.0).to_string().into());
        Member { value: Node { span: field.value.span.clone(), value: number }, ..field }
    });
    let value = Json::Object(fields.collect());
    Member { value: Node { span: parameter.value.span.clone(), value }, ..parameter }
}
