//! Correlation coefficients between the outputs.

use super::text;
use crate::number::justified;
use crate::printed::grouped;
use crate::sheet::{Figure, Sheet};
use gumption_engine::propagate::RowEvaluation;
use gumption_engine::task::Task;

/// Decimal place of the coefficients (JCGM 100, 7.2.6).
const PLACE: i32 = -3;

/// Pairs of outputs on a page, at most: those of 45 outputs.
const MOST_PAIRS: usize = 1000;

/// The coefficients of a row, ready for any page.
pub(crate) enum Coefficients {
    /// The upper triangle of their matrix.
    Matrix(Sheet),
    /// How many there are.
    TooMany(String),
}

/// The coefficients of a row; `None` for a single output.
pub(crate) fn found(task: &Task, row: &RowEvaluation) -> Option<Coefficients> {
    let names: Vec<String> =
        task.model.outputs.iter().map(|output| text::plain(&output.quantity.name)).collect();
    if names.len() < 2 {
        return None;
    }
    let pairs = row.correlations.len();
    if pairs > MOST_PAIRS {
        let pairs = grouped(pairs as u64);
        let said = format!("{pairs} correlation coefficients of the outputs: --format json");
        return Some(Coefficients::TooMany(said));
    }
    let trials = row.outputs.first()?.monte_carlo.as_deref().map(|figures| figures.trials);
    let scatters = |i: usize| {
        let figures = row.outputs.get(i).and_then(|output| output.monte_carlo.as_deref());
        figures.is_none_or(|of| of.standard_uncertainty.is_some())
    };
    let places = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
    let errors = row.correlation_errors.iter().copied().chain(std::iter::repeat(None));
    let coefficients: Vec<Figure> = row
        .correlations
        .iter()
        .zip(errors.zip(places))
        .map(|(&r, (error, (i, j)))| {
            // those of outputs without a standard deviation of trials are of the law of propagation
            let trials = trials.filter(|_| scatters(i) && scatters(j));
            Figure::of(r, cell(r, error, trials))
        })
        .collect();
    Some(Coefficients::Matrix(matrix(&names, &coefficients)))
}

fn matrix(names: &[String], coefficients: &[Figure]) -> Sheet {
    let mut sheet = Sheet::default();
    sheet.text("correlation", names[..names.len() - 1].iter().cloned());
    for j in 1..names.len() {
        let cells = (0..names.len() - 1).map(|i| {
            let place = pair(i, j, names.len());
            let blank = Figure { text: String::new(), value: None };
            place.and_then(|place| coefficients.get(place).cloned()).unwrap_or(blank)
        });
        sheet.figures(&names[j], cells);
    }
    sheet
}

/// The place of the pair i < j among all such pairs.
fn pair(i: usize, j: usize, count: usize) -> Option<usize> {
    (i < j).then(|| i * (2 * count - i - 1) / 2 + j - i - 1)
}

/// A coefficient to the digits that its numerical standard error justifies. Where that is not known,
/// it is at least that of jointly normal outputs.
fn cell(coefficient: f64, error: Option<f64>, trials: Option<u64>) -> String {
    let normal = trials.map_or(0.0, |trials| (1.0 - coefficient.powi(2)) / (trials as f64).sqrt());
    justified(coefficient, Some(PLACE), error.unwrap_or(normal))
}
