//! The candidate effects of a case.

use std::ops::Range;

use super::conditions::NoConditions;
use super::input_set::InputSet;
use super::inputs;
use super::keys;
use super::neutral;
use super::results::ResultFiles;
use super::scopes::report_formula;
use gumption_engine::distribution::Distribution;
use gumption_engine::fact;
use gumption_engine::fact::Argument;
use gumption_engine::model::formula;
use gumption_engine::model::formula::{Formula, FormulaError};
use gumption_engine::task::{Trials, Warning};
use gumption_gap::Candidate;
use gumption_gap::{Effect, ModelForm, OverridableModel};
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::{Collector, DiagnosticKind};
use gumption_units::nearest;

/// At most so many effects: their pairs are tried as well.
const MOST_EFFECTS: usize = 200;

/// A candidate, and where the file names it.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    pub(super) candidate: Candidate,
    pub(super) place: Range<usize>,
    /// What makes it absent, of an effect that the simulator does by itself.
    pub(super) neutral: Option<Vec<(usize, f64)>>,
}

/// Reads `effects` for a sim. Without one, because the model has mistakes, what does not depend on it
/// is checked, and nothing is given.
pub(super) fn read(
    log: &Collector,
    member: &Member,
    sim: Option<&OverridableModel>,
    results: &ResultFiles<'_>,
    warnings: &mut Vec<Warning>,
) -> Option<Vec<Placed>> {
    let object = Object::new(log, "`effects`", &member.value, &member.key_span)?;
    let read: Vec<Option<Placed>> = object
        .members()
        .iter()
        .take(MOST_EFFECTS + 1)
        .map(|member| read_one(log, member, sim, results, warnings))
        .collect();
    read.into_iter().collect()
}

/// Reads one effect for a sim, as [`read`] does.
pub(super) fn read_one(
    log: &Collector,
    member: &Member,
    sim: Option<&OverridableModel>,
    results: &ResultFiles<'_>,
    warnings: &mut Vec<Warning>,
) -> Option<Placed> {
    EffectsReader { log, sim, results, warnings }.effect(member)
}

/// What the effects have in common: not too many, and no pair that needs each other.
pub(super) fn check_together(log: &Collector, placed: &[Placed], sim: &OverridableModel) {
    if let Some(excess) = placed.get(MOST_EFFECTS) {
        let found = placed.len();
        log.report(
            &excess.place,
            DiagnosticKind::TooMany { what: "effects", found, most: MOST_EFFECTS },
        );
        return;
    }
    // only overrides that act before the outputs, and read other quantities, can need each other
    let inner: Vec<&Placed> = placed
        .iter()
        .filter(|placed| {
            let effect = &placed.candidate.effect;
            effect.overrides.iter().any(|(name, formula)| {
                let own =
                    |used: &str| used == name || effect.parameters.iter().any(|p| p.name == used);
                !sim.is_output(name) && formula.names().any(|(used, _)| !own(used))
            })
        })
        .collect();
    for (number, second) in inner.iter().enumerate() {
        for first in inner.iter().take(number) {
            let (one, other) = (&first.candidate.effect, &second.candidate.effect);
            if let Err(circular) = sim.program(&[one, other]) {
                let reason = format!(
                    "and the effect `{}` together override quantities that need each other: {}",
                    one.name, circular
                );
                let diagnostic = DiagnosticKind::Effect { name: other.name.clone(), reason };
                log.report(&second.place, diagnostic);
            }
        }
    }
}

struct EffectsReader<'a> {
    log: &'a Collector,
    sim: Option<&'a OverridableModel>,
    results: &'a ResultFiles<'a>,
    warnings: &'a mut Vec<Warning>,
}

impl EffectsReader<'_> {
    fn effect(&mut self, member: &Member) -> Option<Placed> {
        let object = Object::new(self.log, "an effect", &member.value, &member.key_span)?;
        keys::check(&object, keys::EFFECT);
        let diagnostic = |reason: &str| DiagnosticKind::Effect {
            name: member.key.clone(),
            reason: reason.to_owned(),
        };
        if member.key.is_empty() || member.key.contains(['/', '+']) {
            let reason = "cannot be called so: a name is not empty, and `/` and `+` join names in the answer";
            self.log.report(&member.key_span, diagnostic(reason));
        }
        if ["none", "unexplained"].contains(&member.key.as_str()) {
            let reason = "cannot be called so, as a hypothesis of every answer has that name";
            self.log.report(&member.key_span, diagnostic(reason));
        }
        let parameters = object.required("parameters");
        let by_itself = object.truth("simulator").unwrap_or(false);
        let overrides = if by_itself {
            self.of_simulator(&object, diagnostic);
            None
        } else {
            if let Some(neutral) = object.get("neutral") {
                let reason = "has `neutral`, and its formulas say when it is absent; take that out, or \
                              say `\"simulator\": true` where the simulator does the effect by itself";
                self.log.report(&neutral.key_span, diagnostic(reason));
            }
            Some(object.required("overrides"))
        };
        // parameters are always drawn; an effect of known size has none
        let inputs = parameters.and_then(|parameters| {
            inputs::read(
                self.log,
                parameters,
                &NoConditions,
                &[],
                self.results,
                None,
                Trials::Adaptive,
            )
        });
        let overrides = match overrides {
            Some(overrides) => {
                let overrides = &overrides?.value;
                let overrides = Object::new(self.log, "`overrides`", overrides, &member.key_span)?;
                if overrides.members().is_empty() {
                    overrides.report(diagnostic("overrides nothing"));
                }
                Some(overrides)
            }
            None => None,
        };
        let inputs = inputs?;
        self.parameters(parameters, &inputs, diagnostic);
        let mut effect = Effect {
            name: member.key.clone(),
            parameters: inputs.quantities.iter().map(|input| input.quantity.clone()).collect(),
            overrides: Vec::new(),
        };
        for member in overrides.iter().flat_map(Object::members) {
            if self.can_override(&effect, member)
                && let Some(formula) = self.formula(member, &effect)
            {
                effect.overrides.push((member.key.clone(), formula));
            }
        }
        let neutral = match &overrides {
            Some(_) => None,
            None => {
                let parameters: Vec<_> = effect.parameters.iter().zip(priors(&inputs)).collect();
                Some(neutral::read(&object, &parameters, diagnostic)?)
            }
        };
        if let (Err(circular), Some(overrides)) = (self.sim?.program(&[&effect]), &overrides) {
            let reason = format!("overrides quantities that need each other: {}", circular);
            let diagnostic = DiagnosticKind::Effect { name: effect.name.clone(), reason };
            self.log.report(overrides.place(), diagnostic);
        }
        let priors: Vec<Distribution> = priors(&inputs).cloned().collect();
        (priors.len() == effect.parameters.len()).then(|| {
            let candidate = Candidate {
                effect,
                priors,
                about: object.text("about").unwrap_or("").to_owned(),
                source: object.text("source").unwrap_or("").to_owned(),
                simulator: None,
            };
            Placed { candidate, place: member.key_span.clone(), neutral }
        })
    }

    /// What an effect that the simulator does by itself cannot have.
    fn of_simulator(&self, effect: &Object<'_>, diagnostic: impl Fn(&str) -> DiagnosticKind) {
        if let Some(overrides) = effect.get("overrides") {
            let reason = "is said to be one that the simulator does by itself, and overrides quantities; \
                          take out `simulator` or `overrides`";
            self.log.report(&overrides.key_span, diagnostic(reason));
        }
        if self.sim.is_some_and(|sim| !matches!(sim.maker, ModelForm::Simulated)) {
            let reason = "is said to be one that the simulator does by itself, and the file has no \
                          `simulator`; describe that, or give the effect `overrides`";
            effect.report(diagnostic(reason));
        }
    }

    /// What parameters must be beyond inputs: one value each.
    fn parameters(
        &self,
        written: Option<&Member>,
        inputs: &InputSet,
        diagnostic: impl Fn(&str) -> DiagnosticKind,
    ) {
        for (quantity, place) in inputs.quantities.iter().zip(&inputs.quantity_places) {
            let name = &quantity.quantity.name;
            if quantity.parts != 1 {
                let reason = "has a parameter with components; give it one distribution";
                self.log.report(place, diagnostic(reason));
            } else if let Err(error) = formula::check_name(name) {
                let (name, reason) = (name.to_owned(), error.to_string());
                self.log.report(place, DiagnosticKind::BadName { name, reason });
            }
        }
        let written: &[Member] = match written.map(|member| &member.value.value) {
            Some(Json::Object(members)) => members,
            _ => &[],
        };
        for parameter in written {
            let Json::Object(fields) = &parameter.value.value else { continue };
            for field in fields {
                if ["per", "type", "group", "evidence", "paired"].contains(&field.key.as_str()) {
                    let reason = format!(
                        "has a parameter with the key `{}`; a parameter is one unknown value for \
                         all rows, and has `unit`, `about` and a distribution",
                        field.key
                    );
                    self.log.report(&field.key_span, diagnostic(&reason));
                }
            }
        }
    }

    /// Whether the sim has the quantity of an override, and it is none that is known.
    fn can_override(&self, effect: &Effect, member: &Member) -> bool {
        let Some(sim) = self.sim else { return true };
        let (name, known) = (&member.key, sim.overridable());
        if known.contains(&name.as_str()) {
            return true;
        }
        let reason = if sim.conditions.iter().any(|condition| condition.name == *name) {
            format!(
                "overrides the condition `{name}`, which is set and known; override a quantity that \
                 is computed from it"
            )
        } else {
            let hint = match nearest(name, known.iter().copied()) {
                Some(near) => format!("; did you mean `{near}`?"),
                None => format!("; it has {}", known.join(", ")),
            };
            format!("overrides `{name}`, which the sim does not have{hint}")
        };
        let diagnostic = DiagnosticKind::Effect { name: effect.name.clone(), reason };
        self.log.report(&member.key_span, diagnostic);
        false
    }

    /// An override's formula: its names must be known; a dimension that does not fit is a warning.
    fn formula(&mut self, member: &Member, effect: &Effect) -> Option<Formula> {
        let Json::Text(text) = &member.value.value else {
            let diagnostic = DiagnosticKind::WrongType {
                what: format!("`{}`", member.key),
                found: member.value.value.kind(),
                expected: "a formula in quotes",
            };
            self.log.report(&member.value.span, diagnostic);
            return None;
        };
        let report = |error: FormulaError| report_formula(self.log, member, error);
        let formula = self.log.formula(text).map_err(report).ok()?;
        let sim = self.sim?;
        let scope = effect.scope(&sim.scope);
        if let Err(errors) = formula.check_names(&scope) {
            errors.into_iter().for_each(report);
            return None;
        }
        let own = sim.scope.get(&member.key).and_then(|typing| typing.dimension);
        let misfit = match formula.check(&scope) {
            Err(errors) => errors.first().map(|error| Argument::from(error.to_string())),
            Ok(typing) => match (typing.dimension, own) {
                (Some(found), Some(own)) if found != own => {
                    let [found, own] = [found, own].map(|of| of.describe());
                    let quantity = &member.key;
                    Some(fact!("effect-dimension.other", found, quantity, own).into())
                }
                _ => None,
            },
        };
        if let Some(misfit) = misfit {
            let (name, quantity) = (&effect.name, &member.key);
            let fact = fact!("effect-dimension", name, quantity, misfit);
            self.warnings.push(Warning::new(name, fact));
        }
        Some(formula)
    }
}

/// What is known of the parameters beforehand.
fn priors(inputs: &InputSet) -> impl Iterator<Item = &Distribution> {
    (0..inputs.variables.len()).filter_map(|v| inputs.known.get(v, 0).map(|prior| &**prior))
}
