//! The catalogue: ready-made effects that a case can ask for by name.
//!
//! They stand in `catalogue.json` in the form of a case file's effects. One name may stand there
//! several times, for sims that name their quantities differently; those for any bench come last.
//! `names` says what a quantity may be called in a sim. A key with `{amplitude}` or `{phase}` stands
//! for one such key for each observed output of that kind, and a number of a prior may be a multiple
//! of what was measured ([`Measured`](measured::Measured)). What an effect of what came before may read
//! stands in [`history`].

mod fit;
mod history;
mod listing;
mod measured;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use listing::{EffectListing, ListedEffect, ListedParameter};

use super::effect_context::EffectContext;
use super::effects::{self, Placed};
use super::results::ResultFiles;
use fit::Misfit;
use gumption_engine::fact;
use gumption_engine::fact::Fact;
use gumption_engine::task::Warning;
use gumption_text::json::{self, Json, Member, Node};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind, SourceText};
use gumption_units::nearest;

/// The catalogue's text.
const TEXT: &str = include_str!("catalogue.json");

/// The bench of effects that fit any sim with the quantities that they need.
const ANY_BENCH: &str = "any";

/// The catalogue as it is written.
struct Catalogue {
    source: Arc<SourceText>,
    names: Vec<(String, Vec<String>)>,
    entries: Vec<Entry>,
}

/// One effect as it is written.
#[derive(Clone, Debug)]
struct Entry {
    name: String,
    /// The name that the catalogue has for it.
    listed: String,
    bench: String,
    /// Its members: parameters, overrides, about, source.
    members: Vec<Member>,
}

impl Entry {
    fn text(&self, key: &str) -> &str {
        match self.members.iter().find(|member| member.key == key).map(|m| &m.value.value) {
            Some(Json::Text(text)) => text,
            _ => "",
        }
    }

    /// What it overrides, with the formulas.
    fn overrides(&self) -> impl Iterator<Item = (&str, String)> {
        let formula = |member: &Member| match &member.value.value {
            Json::Text(text) => text.clone(),
            _ => String::new(),
        };
        self.object("overrides").iter().map(move |member| (member.key.as_str(), formula(member)))
    }

    /// The members of one of its objects.
    fn object(&self, key: &str) -> &[Member] {
        match self.members.iter().find(|member| member.key == key).map(|m| &m.value.value) {
            Some(Json::Object(members)) => members,
            _ => &[],
        }
    }
}

impl Catalogue {
    /// The catalogue that ships with gumption; a test makes sure that nothing is left out.
    fn shipped() -> Self {
        let source = SourceText::new("catalogue", TEXT);
        let root = json::parse(&source).ok().map(|node| node.value);
        let mut names = Vec::new();
        let mut entries = Vec::new();
        for member in members(root) {
            match member.key.as_str() {
                "names" => names.extend(
                    members(Some(member.value.value))
                        .into_iter()
                        .map(|member| (member.key, texts(&member.value))),
                ),
                _ => {
                    if let Json::List(list) = member.value.value {
                        entries.extend(list.into_iter().filter_map(entry));
                    }
                }
            }
        }
        Self { source, names, entries }
    }

    /// What a quantity may be called in a sim.
    fn alternatives<'c>(&'c self, name: &'c str) -> Vec<&'c str> {
        match self.names.iter().find(|(known, _)| known == name) {
            Some((_, alternatives)) => alternatives.iter().map(String::as_str).collect(),
            None => vec![name],
        }
    }
}

fn members(value: Option<Json>) -> Vec<Member> {
    match value {
        Some(Json::Object(members)) => members,
        _ => Vec::new(),
    }
}

fn texts(node: &Node) -> Vec<String> {
    let Json::List(list) = &node.value else { return Vec::new() };
    let text = |node: &Node| match &node.value {
        Json::Text(text) => Some(text.clone()),
        _ => None,
    };
    list.iter().filter_map(text).collect()
}

fn entry(node: Node) -> Option<Entry> {
    let mut entry = Entry {
        name: String::new(),
        listed: String::new(),
        bench: String::new(),
        members: Vec::new(),
    };
    for member in members(Some(node.value)) {
        match (member.key.as_str(), &member.value.value) {
            ("name", Json::Text(text)) => {
                entry.name.clone_from(text);
                entry.listed.clone_from(text);
            }
            ("bench", Json::Text(text)) => entry.bench.clone_from(text),
            _ => entry.members.push(member),
        }
    }
    (!entry.name.is_empty()).then_some(entry)
}

/// The catalogue as people and programs see it.
///
/// ```
/// let catalogue = gumption_files::catalogue();
/// assert!(catalogue.effects.iter().any(|effect| effect.name == "lateral-mode"));
/// ```
pub fn catalogue() -> EffectListing {
    EffectListing::of(&Catalogue::shipped())
}

/// The value of `catalogue` that stands for every effect that can act on the sim.
const ALL: &str = "all";

/// Adds the effects that a case asks for after its own; one that does not fit the sim is left out with
/// a note. Without a sim, because the model has mistakes, only their names are checked.
pub(super) fn read(
    log: &Collector,
    root: &Object<'_>,
    sim: Option<EffectContext<'_>>,
    results: &ResultFiles<'_>,
    own: &mut Vec<Placed>,
    warnings: &mut Vec<Warning>,
) -> Option<()> {
    let Some(member) = root.get("catalogue") else { return Some(()) };
    if let Json::Text(text) = &member.value.value {
        let place = &member.value.span;
        if text != ALL {
            let expected =
                "a list of names of effects, or \"all\" for each that can act on the model";
            let (what, found) = ("`catalogue`".to_owned(), member.value.value.kind());
            log.report(place, DiagnosticKind::WrongType { what, found, expected });
            return None;
        }
        let fitting = sim.map(|sim| unlisted(&sim, results, own)).unwrap_or_default();
        let placed = |candidate| Placed { candidate, place: place.clone(), neutral: None };
        own.extend(fitting.into_iter().map(placed));
        return Some(());
    }
    let shipped = Catalogue::shipped();
    let here = sim.as_ref().map(|sim| Catalogue::shipped().with_history(sim));
    let (mut clean, mut notes) = (true, Vec::new());
    for node in root.list("catalogue")? {
        let Json::Text(name) = &node.value else {
            let what = "an element of `catalogue`".to_owned();
            let (found, expected) = (node.value.kind(), "the name of an effect in quotes");
            log.report(&node.span, DiagnosticKind::WrongType { what, found, expected });
            clean = false;
            continue;
        };
        let is_named = |entry: &&Entry| entry.name == *name || entry.listed == *name;
        let all = shipped.entries.iter().chain(here.iter().flat_map(|here| &here.entries));
        if !all.into_iter().any(|entry| is_named(&entry)) {
            let known = shipped.entries.iter().map(|entry| entry.name.as_str());
            let nearest = nearest(name, known).map(str::to_owned);
            log.report(&node.span, DiagnosticKind::UnknownEffect { name: name.clone(), nearest });
            clean = false;
        } else if own.iter().any(|other| other.candidate.effect.name == *name) {
            let reason = "is there already: in `effects`, or a second time in `catalogue`; give \
                          the own effect another name, or take one of them out";
            let (name, reason) = (name.clone(), reason.to_owned());
            log.report(&node.span, DiagnosticKind::Effect { name, reason });
            clean = false;
        } else if let (Some(sim), Some(here)) = (&sim, &here) {
            let mut left_out = |reason: Fact| {
                warnings.push(Warning::new(name, fact!("effect-misfit", name, reason)))
            };
            let mut names: Vec<&str> =
                here.entries.iter().filter(is_named).map(|entry| &*entry.name).collect();
            names.dedup();
            if names.is_empty() {
                left_out(fact!("misfit.history"));
            }
            for name in names {
                match one(here, name, sim, results, &mut notes) {
                    Ok(candidate) => {
                        own.push(Placed { candidate, place: node.span.clone(), neutral: None })
                    }
                    Err(reason) => left_out(reason),
                }
            }
        }
    }
    warnings.extend(notes);
    clean.then_some(())
}

/// The effects of the catalogue that can act on a sim and that a case does not have.
pub(super) fn unlisted(
    sim: &EffectContext<'_>,
    results: &ResultFiles<'_>,
    own: &[Placed],
) -> Vec<gumption_gap::Candidate> {
    let shipped = Catalogue::shipped().with_history(sim);
    let mut names: Vec<&str> = Vec::new();
    for entry in &shipped.entries {
        let listed = own.iter().any(|other| other.candidate.effect.name == entry.name);
        if !listed && !names.contains(&entry.name.as_str()) {
            names.push(&entry.name);
        }
    }
    // what does not fit the sim is not tried, and nobody asked for it
    let of = |name: &&str| one(&shipped, name, sim, results, &mut Vec::new()).ok();
    names.iter().filter_map(of).collect()
}

/// The effect of that name for the sim, or why it cannot act there.
fn one(
    shipped: &Catalogue,
    name: &str,
    sim: &EffectContext<'_>,
    results: &ResultFiles<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<gumption_gap::Candidate, Fact> {
    let member = chosen(shipped, name, sim).map_err(|misfit| misfit.reason(shipped, sim.sim))?;
    let log = Collector::new(shipped.source.clone());
    let read = effects::read_one(&log, &member, Some(sim.sim), results, warnings);
    match read.filter(|_| log.is_clean()) {
        Some(placed) if !sim.is_changed_by(&placed.candidate.effect) => {
            Err(fact!("misfit.no-change"))
        }
        Some(placed) => Ok(placed.candidate),
        None => {
            let diagnostics = log.into_diagnostics();
            let first = diagnostics.0.first().map(|diagnostic| diagnostic.kind.to_string());
            Err(fact!("misfit.refused", error = first.unwrap_or_default()))
        }
    }
}

/// Of the entries of that name, the one that acts on most quantities of the sim; of those that act on
/// as many, that of a bench.
fn chosen(shipped: &Catalogue, name: &str, sim: &EffectContext<'_>) -> Result<Member, Box<Misfit>> {
    let mut best: Option<(usize, bool, Member)> = None;
    let mut nearest: Option<Box<Misfit>> = None;
    for entry in shipped.entries.iter().filter(|entry| entry.name == name) {
        let special = entry.bench != ANY_BENCH;
        match fit::fit(shipped, entry, sim) {
            Ok((count, member)) => {
                let better =
                    |(most, known, _): &(usize, bool, Member)| (count, special) > (*most, *known);
                if best.as_ref().is_none_or(better) {
                    best = Some((count, special, member));
                }
            }
            Err(misfit) => {
                if nearest.as_ref().is_none_or(|other| misfit.count() < other.count()) {
                    nearest = Some(misfit);
                }
            }
        }
    }
    match (best, nearest) {
        (Some((_, _, member)), _) => Ok(member),
        (None, nearest) => Err(nearest.unwrap_or_default()),
    }
}
