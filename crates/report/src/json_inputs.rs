//! The inputs in the answer for programs: what the measurement was evaluated with.

use std::ops::Range;
use std::sync::Arc;

use serde::{Serialize, Serializer};

use gumption_engine::distribution::Distribution;
use gumption_engine::propagate::InputFigures;
use gumption_engine::propagate::gum::Dof;
use gumption_engine::task::{Row, Task, Variable};

/// All input quantities, made one by one. What differs between the rows of a sweep is null here and
/// stands in the rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct InputsSide<'a> {
    pub(super) task: &'a Task,
}

impl Serialize for InputsSide<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let task = self.task;
        let first = task.rows.first();
        let figures = first.map(|row| InputFigures::of_row(task, row)).unwrap_or_default();
        let inputs = task.model.inputs.iter().zip(&figures);
        serializer.collect_seq(inputs.map(|(input, figures)| {
            let variables = figures.variables.clone();
            let varies = varies(task, variables.clone());
            let own = task.variables.get(variables.start).filter(|_| !figures.composed);
            let part = |variable: usize| ComponentSide::of(task, first?, variable, varies);
            let parts = || variables.clone().filter_map(part);
            InputSide {
                name: &input.quantity.name,
                unit: input.quantity.unit.text(),
                figures: (!varies).then_some(figures).into(),
                known: own.and_then(|_| parts().next()).map(|part| part.known).unwrap_or(COMPOSED),
                source: source(&input.quantity.about),
                components: parts().filter(|part| figures.composed && part.shown).collect(),
            }
        }))
    }
}

/// The inputs of a row whose figures differ between rows, made one by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowInputs<'a> {
    pub(super) task: &'a Task,
    pub(super) row: usize,
    /// For each input whether its figures differ.
    pub(super) varying: &'a [bool],
}

impl RowInputs<'_> {
    pub(super) fn is_empty(&self) -> bool {
        !self.varying.contains(&true)
    }
}

/// For each input whether what is known about it differs between the rows.
pub(super) fn varying(task: &Task) -> Vec<bool> {
    let mut first = 0;
    let inputs = task.model.inputs.iter();
    inputs
        .map(|input| {
            let variables = first..first + input.parts;
            first = variables.end;
            varies(task, variables)
        })
        .collect()
}

impl Serialize for RowInputs<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { task, row, varying } = *self;
        let row = task.rows.get(row);
        let figures = row.map(|row| InputFigures::of_row(task, row)).unwrap_or_default();
        let inputs = task.model.inputs.iter().zip(figures).zip(varying);
        let differing = inputs.filter(|(_, varies)| **varies);
        serializer.collect_seq(differing.map(|((input, figures), _)| RowInput {
            name: &input.quantity.name,
            figures: Some(&figures).into(),
        }))
    }
}

#[derive(Serialize)]
struct RowInput<'a> {
    name: &'a str,
    #[serde(flatten)]
    figures: FigureSide,
}

#[derive(Serialize)]
struct InputSide<'a> {
    name: &'a str,
    unit: &'a str,
    #[serde(flatten)]
    figures: FigureSide,
    #[serde(flatten)]
    known: DistributionSide<'a>,
    source: Option<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    components: Vec<ComponentSide<'a>>,
}

#[derive(Serialize)]
struct FigureSide {
    estimate: Option<f64>,
    standard_uncertainty: Option<f64>,
    dof: Option<f64>,
}

impl From<Option<&InputFigures>> for FigureSide {
    fn from(figures: Option<&InputFigures>) -> Self {
        Self {
            estimate: figures.map(|figures| figures.estimate),
            standard_uncertainty: figures.map(|figures| figures.standard_uncertainty),
            dof: figures.and_then(|figures| match figures.dof {
                Dof::Finite(dof) => Some(dof),
                Dof::Infinite | Dof::Undefined => None,
            }),
        }
    }
}

#[derive(Serialize)]
struct DistributionSide<'a> {
    distribution: Option<&'static str>,
    r#type: Option<&'static str>,
    group: Option<&'a str>,
}

/// Of a quantity that is made of components: they have distributions of their own.
const COMPOSED: DistributionSide<'static> =
    DistributionSide { distribution: None, r#type: None, group: None };

/// A component.
#[derive(Serialize)]
struct ComponentSide<'a> {
    name: &'a str,
    #[serde(flatten)]
    figures: FigureSide,
    #[serde(flatten)]
    known: DistributionSide<'a>,
    source: Option<&'a str>,
    #[serde(skip)]
    shown: bool,
}

impl<'a> ComponentSide<'a> {
    fn of(task: &'a Task, row: &Row, variable: usize, varies: bool) -> Option<Self> {
        let distribution: &Distribution = row.distributions.get(variable)?;
        let of: &Variable = task.variables.get(variable)?;
        let here = |value: f64| (!varies && value.is_finite()).then_some(value);
        Some(Self {
            name: &of.name,
            figures: FigureSide {
                estimate: here(distribution.mean()),
                standard_uncertainty: here(distribution.standard_uncertainty()),
                dof: here(distribution.dof()),
            },
            known: DistributionSide {
                distribution: Some(distribution.name()),
                r#type: Some(of.evaluation.letter()),
                group: of.group.as_deref(),
            },
            source: source(&of.about),
            shown: of.shown,
        })
    }
}

fn source(about: &str) -> Option<&str> {
    Some(about.trim()).filter(|about| !about.is_empty())
}

/// Whether what is known about some variables differs between the rows.
fn varies(task: &Task, variables: Range<usize>) -> bool {
    let Some(first) = task.rows.first() else { return false };
    let same = |a: &Arc<Distribution>, b: &Arc<Distribution>| {
        let figures = |d: &Distribution| [d.mean(), d.standard_uncertainty(), d.dof()];
        Arc::ptr_eq(a, b) || figures(a).map(f64::to_bits) == figures(b).map(f64::to_bits)
    };
    let of_first = &first.distributions;
    task.rows.iter().skip(1).any(|row| {
        !Arc::ptr_eq(&row.distributions, of_first)
            && variables.clone().any(|variable| {
                let pair = of_first.get(variable).zip(row.distributions.get(variable));
                pair.is_some_and(|(a, b)| !same(a, b))
            })
    })
}
