//! The worksheet of an output's budget: contributions, combined standard uncertainty, effective
//! degrees of freedom, coverage factor and expanded uncertainty as formulas.

use std::ops::Range;

use rust_xlsxwriter::{Chart, ChartType, XlsxError};

use super::inputs::{Places, RowPlaces};
use super::model::ModelPlaces;
use crate::number::position;
use crate::table::budget::COMPOSED;
use crate::table::conditions_text;
use crate::table::rows::{InputRow, input_rows};
use crate::workbook::{Cached, Leaf, Look, SHARE as PER_CENT, here};
use crate::{EvaluationReport, plain, table};
use gumption_engine::distribution::paired;
use gumption_engine::model::Quantity;
use gumption_engine::propagate::gum::{BudgetLine, CorrelationLine, Dof, Gum};
use gumption_engine::propagate::{InputFigures, RowEvaluation};
use gumption_engine::task::{Coverage, Row, Settings};

const NAME: u16 = 0;
const ESTIMATE: u16 = 1;
const UNCERTAINTY: u16 = 2;
const UNIT: u16 = 3;
const DISTRIBUTION: u16 = 4;
const DOF: u16 = 5;
const SENSITIVITY: u16 = 6;
const CONTRIBUTION: u16 = 7;
const SHARE: u16 = 8;
const VARIANCE: u16 = 9;
const WELCH: u16 = 10;

const HEADERS: [&str; 11] = [
    "quantity",
    "estimate",
    "standard uncertainty",
    "unit",
    "distribution",
    "dof",
    "sensitivity coefficient",
    "contribution",
    "share",
    "variance",
    "(u_i/u)^4 / dof",
];

/// Places of the figures below a budget.
const FIGURES: [&str; 7] = [
    "estimate y",
    "combined standard uncertainty u",
    "effective degrees of freedom",
    "coverage factor k",
    "expanded uncertainty U",
    "coverage interval, from",
    "coverage interval, to",
];

/// Digits of variances.
const VARIANCE_DIGITS: u32 = 3;

/// The column of a figure, how many rows it covers, and its width and height in pixels.
const CHART: u16 = 6;
const CHART_ROWS: u32 = 16;
const CHART_SIZE: (u32, u32) = (520, 300);

/// More degrees of freedom than this are taken for so many: the factor is the same.
const MOST_DOF: &str = "1E9";

/// Where the formulas find what they need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Live<'a> {
    pub(super) inputs: &'a Places,
    /// The models of all rows; empty where the sensitivity coefficients are numbers.
    pub(super) model: &'a [ModelPlaces],
}

/// The cells of the figures of an output in all rows; `None` where there is no budget.
pub(super) type Totals = Vec<Option<[String; 7]>>;

/// A budget that is being written.
struct Block<'a> {
    settings: &'a Settings,
    row: &'a Row,
    gum: &'a Gum,
    cells: &'a RowPlaces,
    probability: &'a str,
    /// Lines of the inputs and of the coefficients.
    lines: Vec<BudgetLine>,
    links: Vec<CorrelationLine>,
    /// The sets of paired readings.
    ensembles: Vec<Vec<usize>>,
    /// The first line.
    top: u32,
    /// The lines of the inputs, among which those of sums of components stand.
    places: Vec<u32>,
    /// The quantities that are made of components, with their lines.
    sums: Vec<(u32, &'a Quantity, InputFigures)>,
    /// Position of the last digit of the output's figures.
    position: Option<i32>,
}

pub(super) fn write(
    leaf: &mut Leaf,
    report: &EvaluationReport<'_>,
    output: usize,
    live: &Live<'_>,
) -> Result<Totals, XlsxError> {
    let EvaluationReport { task, evaluation, .. } = *report;
    let Some(declared) = task.model.outputs.get(output) else { return Ok(Vec::new()) };
    leaf.title(0, &table::title_text(&declared.quantity))?;
    let mut at = 2;
    let mut totals = Vec::new();
    let rows = task.rows.iter().zip(&evaluation.rows).zip(&live.inputs.rows);
    for (number, ((row, found), cells)) in rows.enumerate() {
        if task.swept {
            leaf.line(at, &conditions_text(&task.model.conditions, &found.conditions))?;
            at += 1;
        }
        let Some(gum) = found.outputs.get(output).and_then(|output| output.gum.as_ref()) else {
            leaf.line(at, table::NO_BUDGET)?;
            totals.push(None);
            at += 2;
            continue;
        };
        let (mut places, mut sums) = (Vec::new(), Vec::new());
        for (line, input) in (at + 1..).zip(input_rows(task, gum)) {
            match input {
                InputRow::Composed(quantity, figures) => sums.push((line, quantity, figures)),
                InputRow::Variable(..) => places.push(line),
            }
        }
        let block = Block {
            settings: &evaluation.settings,
            row,
            gum,
            cells,
            probability: &live.inputs.probability,
            lines: gum.budget().collect(),
            links: gum.correlations().collect(),
            ensembles: paired::ensembles(&row.distributions)
                .into_iter()
                .map(|ensemble| ensemble.members)
                .collect(),
            top: at + 1,
            places,
            sums,
            position: position(gum.standard_uncertainty, evaluation.settings.digits_on_pages()),
        };
        leaf.headers(at, HEADERS)?;
        let model = live.model.get(number);
        block.inputs(leaf, report, output, model)?;
        block.sums(leaf)?;
        block.coefficients(leaf, report)?;
        let figures = block.figures(leaf, output, model)?;
        block.as_evaluated(leaf, (found, output), live.inputs)?;
        at = block.below() + FIGURES.len() as u32 + 3;
        totals.push(Some(figures));
        if number == 0 && !task.swept {
            leaf.chart((block.below(), CHART), &block.chart(leaf))?;
            at = at.max(block.below() + CHART_ROWS);
        }
    }
    // nothing here is computed
    if totals.iter().all(Option::is_none) {
        return Ok(totals);
    }
    leaf.line(
        at,
        "Figures \"as evaluated\" are those of gumption; the others are computed by this workbook \
         and follow what is changed under Inputs.",
    )?;
    if live.model.is_empty() {
        leaf.line(
            at + 1,
            "The model is too large for formulas, or has numbers that they cannot hold: the \
             sensitivity coefficients are numbers, and y follows them linearly.",
        )?;
    }
    Ok(totals)
}

impl Block<'_> {
    /// The line behind the last one of the budget.
    fn below(&self) -> u32 {
        self.first_link() + self.links.len() as u32 + 1
    }

    /// The line of the first correlation coefficient, below those of the inputs.
    fn first_link(&self) -> u32 {
        self.top + (self.lines.len() + self.sums.len()) as u32
    }

    /// The shares of the variance as bars, which follow the cells.
    fn chart(&self, leaf: &Leaf) -> Chart {
        let last = self.below().saturating_sub(2).max(self.top);
        let mut chart = Chart::new(ChartType::Bar);
        chart
            .add_series()
            .set_categories(leaf.range((self.top, NAME), (last, NAME)).as_str())
            .set_values(leaf.range((self.top, SHARE), (last, SHARE)).as_str());
        chart.title().set_name("Shares of the combined variance");
        chart.legend().set_hidden();
        // the first line on top
        chart.x_axis().set_num_format("0%");
        chart.y_axis().set_reverse();
        chart.set_width(CHART_SIZE.0).set_height(CHART_SIZE.1);
        chart
    }

    fn line_of(&self, variable: usize) -> Option<u32> {
        let position = self.lines.iter().position(|line| line.variable == variable)?;
        self.places.get(position).copied()
    }

    /// The cells of a column from the first to the last line of the inputs.
    fn range(&self, column: u16) -> String {
        let last = self.places.last().copied().unwrap_or(self.top);
        format!("{}:{}", here(self.top, column), here(last, column))
    }

    /// The combined standard uncertainty, which stands below the budget.
    fn combined(&self) -> String {
        here(self.below() + 1, 1)
    }

    fn inputs(
        &self,
        leaf: &mut Leaf,
        report: &EvaluationReport<'_>,
        output: usize,
        model: Option<&ModelPlaces>,
    ) -> Result<(), XlsxError> {
        let u = self.combined();
        for (&at, line) in self.places.iter().zip(&self.lines) {
            let Some(variable) = report.task.variables.get(line.variable) else { continue };
            let Some(cells) = self.cells.variables.get(line.variable) else { continue };
            let own = position(line.standard_uncertainty, self.settings.digits_on_pages());
            leaf.text(at, NAME, &plain(&variable.name))?;
            let now = Cached::Number(line.estimate);
            leaf.formula((at, ESTIMATE), &cells[0], &now, own, Look::Plain)?;
            let now = Cached::Number(line.standard_uncertainty);
            leaf.formula((at, UNCERTAINTY), &cells[1], &now, own, Look::Plain)?;
            leaf.text(at, UNIT, &plain(variable.unit.text()))?;
            leaf.text(at, DISTRIBUTION, line.distribution)?;
            let now = match line.dof {
                dof if dof.is_finite() => Cached::Number(dof),
                _ => Cached::Text("∞".to_owned()),
            };
            leaf.formula((at, DOF), &cells[2], &now, None, Look::Plain)?;
            let known = model.and_then(|model| model.sensitivities.get(output));
            let cell = known.and_then(|cells| cells.get(line.variable)).cloned().flatten();
            let slope = position(line.sensitivity, 4);
            match cell {
                Some(cell) => {
                    let now = Cached::Number(line.sensitivity);
                    leaf.formula((at, SENSITIVITY), &cell, &now, slope, Look::Plain)?;
                }
                None => leaf.number((at, SENSITIVITY), line.sensitivity, slope, Look::Plain)?,
            }
            let contribution = format!("ABS({})*{}", here(at, SENSITIVITY), here(at, UNCERTAINTY));
            let now = Cached::Number(line.contribution);
            let digits = position(line.contribution, self.settings.digits_on_pages());
            leaf.formula((at, CONTRIBUTION), &contribution, &now, digits, Look::Plain)?;
            let variance = format!("{}^2", here(at, CONTRIBUTION));
            let now = line.contribution.powi(2);
            let digits = position(now, VARIANCE_DIGITS);
            leaf.formula((at, VARIANCE), &variance, &Cached::Number(now), digits, Look::Plain)?;
            let share = format!("IF({u}>0,{}/{u}^2,0)", here(at, VARIANCE));
            leaf.share_formula((at, SHARE), &share, line.share, PER_CENT)?;
            if !matches!(self.gum.dof, Dof::Undefined) && !self.has_results() {
                let (term, now) = self.welch(at, line);
                let digits = position(now, VARIANCE_DIGITS);
                leaf.formula((at, WELCH), &term, &Cached::Number(now), digits, Look::Plain)?;
            }
        }
        Ok(())
    }

    /// The quantities that are made of components: their estimates and combined standard
    /// uncertainties. What they contribute stands in the lines of the components.
    fn sums(&self, leaf: &mut Leaf) -> Result<(), XlsxError> {
        for (at, quantity, figures) in &self.sums {
            let of = figures.variables.clone();
            leaf.text(*at, NAME, &plain(&quantity.name))?;
            leaf.text(*at, UNIT, &plain(quantity.unit.text()))?;
            leaf.text(*at, DISTRIBUTION, COMPOSED)?;
            let own = position(figures.standard_uncertainty, self.settings.digits_on_pages());
            let correlated = self.links.iter().any(|link| {
                let [a, b] = link.variables;
                of.contains(&a) && of.contains(&b)
            });
            let live = [("SUM", ESTIMATE, 0, figures.estimate)].into_iter().chain(
                // the products of correlated components are not in the cells of the inputs
                (!correlated).then_some((
                    "SQRT(SUMSQ",
                    UNCERTAINTY,
                    1,
                    figures.standard_uncertainty,
                )),
            );
            for (function, column, which, now) in live {
                let Some(cells) = self.cells_of(of.clone(), which) else { continue };
                let close = ")".repeat(function.matches('(').count() + 1);
                let formula = format!("{function}({cells}{close}");
                leaf.formula((*at, column), &formula, &Cached::Number(now), own, Look::Plain)?;
            }
            if correlated {
                leaf.number((*at, UNCERTAINTY), figures.standard_uncertainty, own, Look::Plain)?;
            }
            match figures.dof {
                Dof::Finite(dof) => leaf.number((*at, DOF), dof, Some(-2), Look::Plain)?,
                Dof::Infinite => leaf.text(*at, DOF, "∞")?,
                Dof::Undefined => leaf.text(*at, DOF, "undefined")?,
            }
        }
        Ok(())
    }

    /// The cells of consecutive variables among the inputs, which stand below each other.
    fn cells_of(&self, variables: Range<usize>, which: usize) -> Option<String> {
        let cells = self.cells.variables.get(variables)?;
        let (first, last) = (&cells.first()?[which], &cells.last()?[which]);
        let last = last.rsplit_once('!').map_or(last.as_str(), |(_, cell)| cell);
        Some(format!("{first}:{last}"))
    }

    /// The term of the Welch-Satterthwaite formula of a line. Paired readings are one term, which
    /// stands in the line of the first of them.
    fn welch(&self, at: u32, line: &BudgetLine) -> (String, f64) {
        let u = self.combined();
        let dof = here(at, DOF);
        let set = self.ensembles.iter().find(|set| set.contains(&line.variable));
        let Some(set) = set else {
            let term = format!(
                "IF(AND(ISNUMBER({dof}),{u}>0),({}/{u})^4/{dof},0)",
                here(at, CONTRIBUTION)
            );
            let share = line.contribution / self.gum.standard_uncertainty;
            let now = if line.dof.is_finite() && share.is_finite() {
                share.powi(4) / line.dof
            } else {
                0.0
            };
            return (term, now);
        };
        if set.first() != Some(&line.variable) {
            return ("0".to_owned(), 0.0);
        }
        let within = |variable: usize| set.contains(&variable);
        let lines = self.lines.iter().filter(|line| within(line.variable));
        let own: f64 = lines.map(|line| line.share).sum();
        let pairs = self.links.iter().enumerate();
        let pairs = pairs.filter(|(_, link)| link.variables.iter().all(|&v| within(v)));
        let (places, shares): (Vec<u32>, Vec<f64>) =
            pairs.map(|(position, link)| (self.first_link() + position as u32, link.share)).unzip();
        let members = set.iter().filter_map(|&member| self.line_of(member));
        let cells: Vec<String> = members.chain(places).map(|at| here(at, VARIANCE)).collect();
        let term =
            format!("IF(AND(ISNUMBER({dof}),{u}>0),(MAX(0,{})/{u}^2)^2/{dof},0)", cells.join("+"));
        let share = (own + shares.iter().sum::<f64>()).max(0.0);
        (term, if line.dof.is_finite() { share.powi(2) / line.dof } else { 0.0 })
    }

    fn coefficients(
        &self,
        leaf: &mut Leaf,
        report: &EvaluationReport<'_>,
    ) -> Result<(), XlsxError> {
        let first = self.first_link();
        let u = self.combined();
        for (number, (at, link)) in (first..).zip(&self.links).enumerate() {
            let name = |v: usize| report.task.variables.get(v).map_or("", |v| v.name.as_str());
            let [a, b] = link.variables;
            leaf.text(at, NAME, &format!("r({}, {})", plain(name(a)), plain(name(b))))?;
            let now = Cached::Number(link.coefficient);
            match self.cells.coefficients.get(number) {
                Some(cell) => leaf.formula((at, ESTIMATE), cell, &now, None, Look::Plain)?,
                None => leaf.number((at, ESTIMATE), link.coefficient, None, Look::Plain)?,
            }
            leaf.text(at, DISTRIBUTION, "correlation")?;
            let Some((a, b)) = self.line_of(a).zip(self.line_of(b)) else { continue };
            let signed = |at: u32| format!("{}*{}", here(at, SENSITIVITY), here(at, UNCERTAINTY));
            let term = format!("2*{}*{}*{}", here(at, ESTIMATE), signed(a), signed(b));
            let now = link.share * self.gum.standard_uncertainty.powi(2);
            let digits = position(now, VARIANCE_DIGITS);
            leaf.formula((at, VARIANCE), &term, &Cached::Number(now), digits, Look::Plain)?;
            let share = format!("IF({u}>0,{}/{u}^2,0)", here(at, VARIANCE));
            leaf.share_formula((at, SHARE), &share, link.share, PER_CENT)?;
        }
        Ok(())
    }

    /// Whether an input is a saved result, whose degrees of freedom go back to other inputs.
    fn has_results(&self) -> bool {
        self.row.distributions.iter().any(|distribution| distribution.saved().is_some())
    }

    /// The figures that follow; their cells.
    fn figures(
        &self,
        leaf: &mut Leaf,
        output: usize,
        model: Option<&ModelPlaces>,
    ) -> Result<[String; 7], XlsxError> {
        let gum = self.gum;
        let first = self.below();
        let at = |figure: usize| first + figure as u32;
        let here_is = |figure: usize| here(at(figure), 1);
        for (figure, name) in FIGURES.iter().enumerate() {
            leaf.text(at(figure), NAME, name)?;
        }
        let look = Look::Stressed;
        // y
        let y = self.estimate(output, model);
        leaf.formula((at(0), 1), &y, &Cached::Number(gum.estimate), self.position, look)?;
        // u
        let links = (!self.links.is_empty()).then(|| {
            let from = self.first_link();
            let to = from + self.links.len() as u32 - 1;
            format!("+SUM({}:{})", here(from, VARIANCE), here(to, VARIANCE))
        });
        let squares = format!("SUMSQ({})", self.range(CONTRIBUTION));
        let u = format!("SQRT(MAX(0,{squares}{}))", links.unwrap_or_default());
        let now = Cached::Number(gum.standard_uncertainty);
        leaf.formula((at(1), 1), &u, &now, self.position, look)?;
        self.dof(leaf, at(2))?;
        self.factor(leaf, at(3), &here_is(2))?;
        // U
        let factor = here_is(3);
        let guarded = |formula: String| format!("IF(ISNUMBER({factor}),{formula},\"-\")");
        let number = |value: Option<f64>| match value {
            Some(value) => Cached::Number(value),
            None => Cached::Text("-".to_owned()),
        };
        let expanded = guarded(format!("{factor}*{}", here_is(1)));
        let known = gum.expanded_uncertainty();
        let digits = known.and_then(|known| position(known, self.settings.digits_on_pages()));
        leaf.formula((at(4), 1), &expanded, &number(known), digits, look)?;
        for (figure, sign, end) in [(5, '-', 0), (6, '+', 1)] {
            let formula = guarded(format!("{}{sign}{}", here_is(0), here_is(4)));
            let now = number(gum.interval().map(|interval| interval[end]));
            leaf.formula((at(figure), 1), &formula, &now, self.position, look)?;
        }
        Ok(std::array::from_fn(|figure| leaf.cell(at(figure), 1)))
    }

    /// The estimate: the model's, or linear in the inputs' estimates where it has no formulas.
    fn estimate(&self, output: usize, model: Option<&ModelPlaces>) -> String {
        let known = model.and_then(|model| model.outputs.get(output));
        match known {
            Some(cell) => cell.clone(),
            None if self.lines.is_empty() => format!("{:?}", self.gum.estimate),
            None => {
                let linear: f64 =
                    self.lines.iter().map(|line| line.sensitivity * line.estimate).sum();
                let rest = self.gum.estimate - linear;
                let products = format!("{},{}", self.range(SENSITIVITY), self.range(ESTIMATE));
                format!("SUMPRODUCT({products})+({rest:?})")
            }
        }
    }

    /// The effective degrees of freedom (JCGM 100, G.2b).
    fn dof(&self, leaf: &mut Leaf, at: u32) -> Result<(), XlsxError> {
        match self.gum.dof {
            Dof::Undefined => leaf.word((at, 1), "undefined", Look::Stressed),
            // by the inputs that saved results go back to, which are not here
            Dof::Finite(dof) if self.has_results() => {
                leaf.number((at, 1), dof, None, Look::Stressed)
            }
            Dof::Infinite if self.has_results() => leaf.word((at, 1), "∞", Look::Stressed),
            dof => {
                let sum = format!("SUM({})", self.range(WELCH));
                let formula = format!("IF({sum}>0,1/{sum},\"∞\")");
                let now = match dof {
                    Dof::Finite(dof) => Cached::Number(dof),
                    _ => Cached::Text("∞".to_owned()),
                };
                let digits = Some(-2).filter(|_| matches!(dof, Dof::Finite(_)));
                leaf.formula((at, 1), &formula, &now, digits, Look::Stressed)
            }
        }
    }

    /// The coverage factor (JCGM 100, G.4.1): t at the integer part of the degrees of freedom.
    fn factor(&self, leaf: &mut Leaf, at: u32, dof: &str) -> Result<(), XlsxError> {
        let Some(factor) = self.gum.coverage_factor else {
            return leaf.word((at, 1), "-", Look::Stressed);
        };
        let fixed = matches!(self.settings.coverage, Coverage::Factor { fixed: true, .. });
        let few = matches!(self.gum.dof, Dof::Finite(dof) if dof < 1.0);
        let real = self.settings.real_dof && matches!(self.gum.dof, Dof::Finite(_));
        if fixed || real || few || matches!(self.gum.dof, Dof::Undefined) {
            // a spreadsheet has the t distribution at whole degrees of freedom only
            return leaf.number((at, 1), factor, Some(-2), Look::Stressed);
        }
        let p = self.probability;
        let whole = format!("MAX(1,MIN(INT({dof}*(1+1E-9)),{MOST_DOF}))");
        let formula = format!(
            "IF(ISNUMBER({dof}),_xlfn.T.INV.2T(1-{p},{whole}),_xlfn.NORM.S.INV((1+{p})/2))"
        );
        leaf.formula((at, 1), &formula, &Cached::Number(factor), Some(-2), Look::Stressed)
    }

    /// The same figures as gumption computed them, and how far the workbook's are from them.
    fn as_evaluated(
        &self,
        leaf: &mut Leaf,
        (found, output): (&RowEvaluation, usize),
        inputs: &Places,
    ) -> Result<(), XlsxError> {
        let first = self.below();
        leaf.text(first - 1, 2, "as evaluated")?;
        let gum = self.gum;
        let interval = gum.interval();
        let dof = match gum.dof {
            Dof::Finite(dof) => Some(dof),
            Dof::Infinite | Dof::Undefined => None,
        };
        let values = [
            Some(gum.estimate),
            Some(gum.standard_uncertainty),
            dof,
            gum.coverage_factor,
            gum.expanded_uncertainty(),
            interval.map(|ends| ends[0]),
            interval.map(|ends| ends[1]),
        ];
        let expanded =
            gum.expanded_uncertainty().and_then(|u| position(u, self.settings.digits_on_pages()));
        let own = self.position;
        let shown = [own, own, Some(-2), Some(-2), expanded, own, own];
        for (at, (value, shown)) in (first..).zip(values.into_iter().zip(shown)) {
            let word = match gum.dof {
                Dof::Infinite => "∞",
                Dof::Finite(_) | Dof::Undefined => "undefined",
            };
            match value {
                None if at == first + 2 => leaf.word((at, 2), word, Look::Plain)?,
                _ => leaf.number((at, 2), value.unwrap_or(f64::NAN), shown, Look::Plain)?,
            }
        }
        let figures = found.outputs.get(output).and_then(|output| output.monte_carlo.as_deref());
        let Some(figures) = figures else { return Ok(()) };
        inputs.marked(leaf, (first - 1, 4), "Monte Carlo")?;
        let values = [
            (0, figures.estimate),
            (1, figures.standard_uncertainty),
            (5, Some(figures.symmetric_interval[0])),
            (6, Some(figures.symmetric_interval[1])),
        ];
        for (figure, value) in values {
            leaf.number((first + figure, 4), value.unwrap_or(f64::NAN), own, Look::Plain)?;
        }
        Ok(())
    }
}
