//! Gauge repeatability and reproducibility by analysis of variance: parts measured several times by
//! several operators, both drawn at random and crossed (AIAG, Measurement Systems Analysis, 4th ed.,
//! chapter III and appendix A).

use std::fmt;

use gumption_engine::special;

/// The interaction is kept where its F test has a probability of at most this; otherwise it is pooled
/// with repeatability.
const SIGNIFICANT: f64 = 0.05;

/// The width of a study in standard deviations (AIAG, 4th ed.; 5.15 in the editions before).
pub const WIDTH: f64 = 6.0;

/// Distinct categories for each ratio of PV and GRR (AIAG, 4th ed.: the 97 % interval, sqrt 2).
const CATEGORIES: f64 = 1.41;

/// A share of GRR up to which a measuring system is acceptable, and up to which it may be (AIAG, 4th
/// ed., chapter II, section D).
pub const LIMITS: [f64; 2] = [0.1, 0.3];

/// A reading of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyReading {
    /// The part.
    pub part: String,
    /// Who measured it.
    pub operator: String,
    /// The value.
    pub value: f64,
}

/// What is done with the interaction of operators and parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interaction {
    /// It is kept where it is significant.
    #[default]
    Tested,
    /// It is kept.
    Kept,
    /// It is pooled with repeatability.
    Pooled,
}

/// A line of the analysis of variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanSquare {
    /// What varies: `part`, `operator`, `interaction` or `repeatability`.
    pub source: &'static str,
    /// Sum of squares.
    pub sum: f64,
    /// Degrees of freedom.
    pub dof: f64,
    /// The ratio to the mean square that it is tested against; none for repeatability.
    pub f: Option<f64>,
    /// The probability of a larger ratio if there is no effect.
    pub p: Option<f64>,
}

impl MeanSquare {
    /// The mean square.
    pub fn mean(&self) -> f64 {
        self.sum / self.dof
    }
}

/// A standard deviation of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyComponent {
    /// `repeatability` (EV), `operators` (AV), `gauge` (GRR), `parts` (PV), `total` (TV); with an
    /// interaction also `interaction` (INT) and `reproducibility` (AV and INT together).
    pub name: &'static str,
    /// Its symbol.
    pub symbol: &'static str,
    /// The variance; 0 where its estimate is negative.
    pub variance: f64,
    /// Effective degrees of freedom of the variance (Satterthwaite; JCGM 100, G.4.1); 0 where it is 0.
    pub dof: f64,
}

impl StudyComponent {
    /// The standard deviation.
    pub fn deviation(&self) -> f64 {
        self.variance.sqrt()
    }
}

/// The capability of the process against two limits or one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessIndices {
    /// The width of the tolerance over six standard deviations; none with one limit.
    pub potential: Option<f64>,
    /// The distance of the mean from the nearer limit over three standard deviations.
    pub centred: f64,
}

/// The result of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct GaugeStudy {
    /// Numbers of parts, operators, and readings of each part by each operator.
    pub counts: [usize; 3],
    /// The mean of all readings.
    pub mean: f64,
    /// The table with the interaction.
    pub table: Vec<MeanSquare>,
    /// Whether the interaction is kept.
    pub has_interaction: bool,
    /// The components, from repeatability to the total.
    pub components: Vec<StudyComponent>,
    /// The lower and the upper limit of the tolerance.
    pub limits: [Option<f64>; 2],
}

/// Why a table is no study.
#[derive(Clone, Debug, PartialEq)]
pub enum NoStudy {
    /// Fewer than two parts, operators, or readings of each.
    Few(&'static str, usize),
    /// A part has another number of readings of an operator.
    Unbalanced {
        /// The part.
        part: String,
        /// The operator.
        operator: String,
        /// Its number of readings.
        found: usize,
        /// That of the first part and operator.
        expected: usize,
    },
    /// All readings are equal.
    NoVariation,
}

impl fmt::Display for NoStudy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Few(what, found) => {
                write!(f, "a gauge study needs at least two {what}, and the table has {found}")
            }
            Self::Unbalanced { part, operator, found, expected } => write!(
                f,
                "the part `{part}` has {found} readings of `{operator}`, and the first part has \
                 {expected} of the first operator: every operator measures every part equally often"
            ),
            Self::NoVariation => {
                write!(f, "all readings are equal, so nothing can be said of them")
            }
        }
    }
}

impl GaugeStudy {
    /// The component of that name.
    pub fn component(&self, name: &str) -> Option<&StudyComponent> {
        self.components.iter().find(|component| component.name == name)
    }

    fn deviation(&self, name: &str) -> f64 {
        self.component(name).map_or(f64::NAN, StudyComponent::deviation)
    }

    /// The width of the tolerance.
    pub fn tolerance(&self) -> Option<f64> {
        self.limits[0].zip(self.limits[1]).map(|(lower, upper)| upper - lower)
    }

    /// A component as a share of the total variation TV, and of the tolerance (six standard deviations).
    pub fn shares(&self, component: &StudyComponent) -> (f64, Option<f64>) {
        let deviation = component.deviation();
        let of_tolerance = self.tolerance().map(|tolerance| WIDTH * deviation / tolerance);
        (deviation / self.deviation("total"), of_tolerance)
    }

    /// The share that GRR is judged by: of the tolerance where there are two limits, else of TV.
    pub fn deciding_share(&self) -> f64 {
        let Some(gauge) = self.component("gauge") else { return f64::NAN };
        let (of_total, of_tolerance) = self.shares(gauge);
        of_tolerance.unwrap_or(of_total)
    }

    /// Whether the measuring system is not refused: GRR is at most 30 %.
    pub fn is_acceptable(&self) -> bool {
        self.deciding_share() <= LIMITS[1]
    }

    /// Number of distinct categories, cut to a whole number; none without a variation of the gauge.
    pub fn categories(&self) -> Option<f64> {
        let ratio = CATEGORIES * self.deviation("parts") / self.deviation("gauge");
        ratio.is_finite().then(|| ratio.floor().max(1.0))
    }

    /// Cp and Cpk, with the standard deviation of the parts (PV).
    pub fn of_parts(&self) -> Option<ProcessIndices> {
        self.indices(self.deviation("parts"))
    }

    /// Pp and Ppk, with that of all that is seen (TV).
    pub fn of_total(&self) -> Option<ProcessIndices> {
        self.indices(self.deviation("total"))
    }

    fn indices(&self, deviation: f64) -> Option<ProcessIndices> {
        let ends = [self.limits[0].map(|l| self.mean - l), self.limits[1].map(|u| u - self.mean)];
        let nearer = ends.into_iter().flatten().reduce(f64::min)?;
        (deviation > 0.0).then(|| ProcessIndices {
            potential: self.tolerance().map(|tolerance| tolerance / (6.0 * deviation)),
            centred: nearer / (3.0 * deviation),
        })
    }

    /// The capability ratio of the measurement process by VDA 5 (3rd ed.), Q_MP = 2 U_MP/TOL with
    /// U_MP = 2 GRR: what the study has seen of it, without calibration and bias.
    pub fn capability_ratio(&self) -> Option<f64> {
        self.tolerance().map(|tolerance| 4.0 * self.deviation("gauge") / tolerance)
    }
}

/// Groups of readings by part and operator, in the order in which they come.
fn cells(readings: &[StudyReading]) -> Result<Vec<Vec<Vec<f64>>>, NoStudy> {
    let in_order = |name: fn(&StudyReading) -> &str| {
        let mut known: Vec<&str> = Vec::new();
        for reading in readings {
            if !known.contains(&name(reading)) {
                known.push(name(reading));
            }
        }
        known
    };
    let (parts, operators) = (in_order(|r| &r.part), in_order(|r| &r.operator));
    for (what, found) in [("parts", parts.len()), ("operators", operators.len())] {
        if found < 2 {
            return Err(NoStudy::Few(what, found));
        }
    }
    let of = |part: &str, operator: &str| -> Vec<f64> {
        let own = readings.iter().filter(|r| r.part == part && r.operator == operator);
        own.map(|reading| reading.value).collect()
    };
    let all =
        parts.iter().map(|part| operators.iter().map(|operator| of(part, operator)).collect());
    let all: Vec<Vec<Vec<f64>>> = all.collect();
    let expected = all[0][0].len();
    for (part, row) in parts.iter().zip(&all) {
        for (operator, cell) in operators.iter().zip(row) {
            if cell.len() != expected {
                let (part, operator) = ((*part).to_owned(), (*operator).to_owned());
                return Err(NoStudy::Unbalanced { part, operator, found: cell.len(), expected });
            }
        }
    }
    if expected < 2 {
        return Err(NoStudy::Few("readings of each part by each operator", expected));
    }
    Ok(all)
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The probability of an F ratio above this.
fn beyond(f: f64, [above, below]: [f64; 2]) -> f64 {
    special::beta::cdf(below / (below + above * f), 0.5 * below, 0.5 * above)
}

/// Mean squares with their weights in a variance.
type Terms = Vec<(f64, MeanSquare)>;

/// The variance that they add up to.
fn variance(terms: &Terms) -> f64 {
    terms.iter().map(|(weight, square)| weight * square.mean()).sum()
}

/// The sum of variances, each of which counts only where it is above 0.
fn component(name: &'static str, symbol: &'static str, parts: &[&Terms]) -> StudyComponent {
    let mut merged: Terms = Vec::new();
    for &(weight, square) in parts.iter().filter(|part| variance(part) > 0.0).copied().flatten() {
        match merged.iter_mut().find(|(_, known)| *known == square) {
            Some((known, _)) => *known += weight,
            None => merged.push((weight, square)),
        }
    }
    let variance = variance(&merged);
    if variance <= 0.0 {
        return StudyComponent { name, symbol, variance: 0.0, dof: 0.0 };
    }
    let spread =
        merged.iter().map(|(weight, square)| (weight * square.mean()).powi(2) / square.dof);
    StudyComponent { name, symbol, variance, dof: variance * variance / spread.sum::<f64>() }
}

/// Evaluates a study; `limits` are those of the tolerance of the parts, of which each may be missing.
///
/// # Errors
/// A table that is not of two factors, crossed and balanced, or without any variation.
pub fn study(
    readings: &[StudyReading],
    interaction: Interaction,
    limits: [Option<f64>; 2],
) -> Result<GaugeStudy, NoStudy> {
    let all = cells(readings)?;
    let counts = [all.len(), all[0].len(), all[0][0].len()];
    let [n, k, r] = counts.map(|count| count as f64);
    let of_cell = |i: usize, j: usize| mean(all[i][j].iter().copied());
    let of_part: Vec<f64> =
        (0..counts[0]).map(|i| mean((0..counts[1]).map(|j| of_cell(i, j)))).collect();
    let of_operator: Vec<f64> =
        (0..counts[1]).map(|j| mean((0..counts[0]).map(|i| of_cell(i, j)))).collect();
    let grand = mean(of_part.iter().copied());
    let squares =
        |deviations: &mut dyn Iterator<Item = f64>| deviations.map(|d| d * d).sum::<f64>();
    let parts = k * r * squares(&mut of_part.iter().map(|m| m - grand));
    let operators = n * r * squares(&mut of_operator.iter().map(|m| m - grand));
    let mut crossed = 0.0;
    let mut within = 0.0;
    for (i, row) in all.iter().enumerate() {
        for (j, cell) in row.iter().enumerate() {
            crossed += (of_cell(i, j) - of_part[i] - of_operator[j] + grand).powi(2);
            within += squares(&mut cell.iter().map(|value| value - of_cell(i, j)));
        }
    }
    let line = |source, sum, dof| MeanSquare { source, sum, dof, f: None, p: None };
    let repeatability = line("repeatability", within, n * k * (r - 1.0));
    let tested = |line: MeanSquare, against: &MeanSquare| {
        let f = line.mean() / against.mean();
        let f = f.is_finite().then_some(f);
        MeanSquare { f, p: f.map(|f| beyond(f, [line.dof, against.dof])), ..line }
    };
    let interacting =
        tested(line("interaction", r * crossed, (n - 1.0) * (k - 1.0)), &repeatability);
    let operators = tested(line("operator", operators, k - 1.0), &interacting);
    let parts = tested(line("part", parts, n - 1.0), &interacting);
    if parts.sum + operators.sum + interacting.sum + repeatability.sum <= 0.0 {
        return Err(NoStudy::NoVariation);
    }
    let has_interaction = match interaction {
        Interaction::Kept => true,
        Interaction::Pooled => false,
        Interaction::Tested => interacting.p.is_none_or(|p| p <= SIGNIFICANT),
    };
    let pooled = line(
        "repeatability",
        repeatability.sum + interacting.sum,
        repeatability.dof + interacting.dof,
    );
    let (error, below) = match has_interaction {
        true => (&repeatability, &interacting),
        false => (&pooled, &pooled),
    };
    let per = |above: MeanSquare, below: MeanSquare, count: f64| -> Terms {
        vec![(1.0 / count, above), (-1.0 / count, below)]
    };
    let repeating = vec![(1.0, *error)];
    let between = per(operators, *below, n * r);
    let crossing = if has_interaction { per(interacting, *error, r) } else { Vec::new() };
    let of_parts = per(parts, *below, k * r);
    let mut components = vec![
        component("repeatability", "EV", &[&repeating]),
        component("operators", "AV", &[&between]),
    ];
    if has_interaction {
        components.push(component("interaction", "INT", &[&crossing]));
        components.push(component("reproducibility", "AV + INT", &[&between, &crossing]));
    }
    components.push(component("gauge", "GRR", &[&repeating, &between, &crossing]));
    components.push(component("parts", "PV", &[&of_parts]));
    components.push(component("total", "TV", &[&repeating, &between, &crossing, &of_parts]));
    let table = vec![parts, operators, interacting, repeatability];
    Ok(GaugeStudy { counts, mean: grand, table, has_interaction, components, limits })
}

#[cfg(test)]
mod tests;
