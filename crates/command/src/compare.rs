//! `gumption compare`

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::options::{self, AnswerOptions, Interactive};
use super::{Exit, Failure};
use gumption_analysis::compare::{
    Estimator, GaugeStudy, Impossible, Interaction, Participant, ProficiencyTest, ResultPair,
    StudyReading, gauge, laboratories, proficiency,
};
use gumption_engine::task::Warning;
use gumption_foreign::{ComparisonOptions, ComparisonTable, ReadComparison};
use gumption_report::compare::{self as report, Compare as ComparedPair};
use gumption_units::{Unit, nearest};

/// Compare results in pairs (normalized errors), or results of many laboratories.
#[derive(Debug, Args)]
pub(super) struct Compare {
    /// The table, CSV or XLSX: columns label, x1, U1, x2, U2 and optionally k1, k2, r; for
    /// laboratories label, x, U and optionally k; for a proficiency test label, x and optionally U,
    /// k; for a gauge study part, operator, value; - for CSV on standard input
    table: PathBuf,
    /// The sheet of the workbook, if several contain a table
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Take the second results from the JSON answer of a run: the label names the output
    #[arg(long, value_name = "RUN.json")]
    against: Option<PathBuf>,
    /// Correlation coefficients between laboratories: a header with their names, then the rows in
    /// the same order, or each row with its name first; half of the symmetric matrix is enough
    #[arg(long, value_name = "FILE")]
    correlations: Option<PathBuf>,
    /// How to compute the reference value of laboratories; the default is the weighted mean, or
    /// that of the largest consistent subset if they are not consistent
    #[arg(long, value_name = "NAME", value_parser = estimator)]
    estimator: Option<Estimator>,
    /// Score the results as those of a proficiency test by this standard, or evaluate the readings of
    /// a gauge study (repeatability and reproducibility)
    #[arg(
        long,
        value_name = "NAME",
        conflicts_with_all = ["against", "correlations", "estimator", "rounding"]
    )]
    scheme: Option<Scheme>,
    /// The assigned value: algorithm-a (the default), median, or a value in the unit of the results
    #[arg(long, value_name = "VALUE", requires = "scheme", allow_hyphen_values = true)]
    assigned: Option<String>,
    /// The standard uncertainty of a stated assigned value
    #[arg(long, value_name = "U", requires = "assigned", allow_hyphen_values = true)]
    assigned_u: Option<String>,
    /// The standard deviation for proficiency assessment: algorithm-a (the default), niqr, a value
    /// in the unit of the results, or a percentage of the assigned value
    #[arg(long, value_name = "VALUE", requires = "scheme", allow_hyphen_values = true)]
    sigma: Option<String>,
    /// Lower limit of the tolerance of the parts, for a gauge study
    #[arg(long, value_name = "VALUE", requires = "scheme", allow_hyphen_values = true)]
    lower: Option<String>,
    /// Upper limit of the tolerance of the parts, for a gauge study
    #[arg(long, value_name = "VALUE", requires = "scheme", allow_hyphen_values = true)]
    upper: Option<String>,
    /// The interaction of operators and parts in a gauge study
    #[arg(long, value_name = "NAME", requires = "scheme")]
    interaction: Option<KeptInteraction>,
    /// Show the range of the normalized error that the printed digits allow
    #[arg(long)]
    rounding: bool,
    /// Exit with code 3 if results are not compatible, laboratories not consistent, a participant has
    /// an action signal or no score, or a gauge has a GRR above 30 %
    #[arg(long)]
    fail: bool,
    #[command(flatten)]
    answer: AnswerOptions<CompareFormat>,
    #[command(flatten)]
    interactive: Interactive,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CompareFormat {
    /// A text page
    Table,
    /// An HTML page with a figure, in one file
    Html,
    /// A Markdown page, for GitHub and notebooks; with `--output` its figure is an SVG file beside it
    Markdown,
    /// The whole answer for programs
    Json,
    /// One line for each pair, laboratory or participant
    Csv,
}

/// The standard by which a proficiency test is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Scheme {
    /// ISO 13528:2022
    Iso13528,
    /// AIAG, Measurement Systems Analysis, 4th ed.: gauge R&R by analysis of variance
    GaugeRr,
}

/// What is done with the interaction of operators and parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum KeptInteraction {
    /// Keep it if its F test has a probability of at most 5 % (the default)
    Tested,
    /// Keep it
    Kept,
    /// Pool it with repeatability
    Pooled,
}

/// The estimators by name, and by short forms for two of them.
fn estimator(text: &str) -> Result<Estimator, String> {
    let short = match text {
        "weighted" => Some(Estimator::WeightedMean),
        "lcs" => Some(Estimator::LargestConsistentSubset),
        _ => None,
    };
    let named = || Estimator::ALL.into_iter().find(|estimator| estimator.name() == text);
    short.or_else(named).ok_or_else(|| {
        let names = Estimator::ALL.map(Estimator::name);
        let near = nearest(text, names).map(|name| format!("; did you mean {name}?"));
        format!("one of {} is needed{}", names.join(", "), near.unwrap_or_default())
    })
}

impl Compare {
    pub(super) fn execute(&self) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let options = ComparisonOptions {
            against: self.against.as_deref(),
            correlations: self.correlations.as_deref(),
            sheet: self.sheet.as_deref(),
            is_proficiency_test: self.scheme == Some(Scheme::Iso13528),
            is_gauge_study: self.scheme == Some(Scheme::GaugeRr),
        };
        self.check_options()?;
        let text = |text: &str| gumption_foreign::read_comparison_text("<stdin>", text, options);
        let table = options::given(&self.table, text, |path| {
            gumption_foreign::read_comparison(path, options)
        });
        let ReadComparison { table, units, mut warnings } = table??;
        let read = [Some(&self.table), self.against.as_ref(), self.correlations.as_ref()];
        let read: Vec<PathBuf> = read.into_iter().flatten().cloned().collect();
        let place = self.answer.open(&read)?;
        let found = match table {
            ComparisonTable::Pairs(_) if self.estimator.is_some() => {
                let message = "`--estimator` is for laboratories: a table with columns label, x, \
                               U; this one has pairs of results";
                return Err(Failure::Argument(message.to_owned()));
            }
            ComparisonTable::Laboratories { .. } if self.rounding => {
                let message = "`--rounding` is for pairs of results: a table with columns label, \
                               x1, U1, x2, U2; this one has laboratories";
                return Err(Failure::Argument(message.to_owned()));
            }
            ComparisonTable::Pairs(pairs) => {
                // pairs without an uncertainty are errors of the table
                let compared = pairs.iter().filter_map(ResultPair::compare).collect();
                ComparedPair::Pairs { pairs, compared, units, rounding: self.rounding }
            }
            ComparisonTable::Laboratories { laboratories, correlations } => {
                let found = laboratories::compare_by(&laboratories, &correlations, self.estimator);
                let of_file = |error: Impossible| match &self.correlations {
                    Some(path) => format!("{}: {error}", path.display()),
                    None => error.to_string(),
                };
                ComparedPair::Laboratories {
                    comparison: found.map_err(|error| Failure::Argument(of_file(error)))?,
                    unit: units.into_iter().next().unwrap_or_default(),
                }
            }
            ComparisonTable::Proficiency(participants) => {
                let unit = units.into_iter().next().unwrap_or_default();
                let test = self.scored(participants, &unit)?;
                warnings.extend(test.notes.iter().cloned().map(|fact| Warning::new("", fact)));
                ComparedPair::Proficiency { test, unit }
            }
            ComparisonTable::Gauge(readings) => {
                let unit = units.into_iter().next().unwrap_or_default();
                ComparedPair::Gauge { study: self.studied(&readings, &unit)?, unit }
            }
        };
        self.answer.say(&warnings);
        let answer = || match self.answer.format {
            CompareFormat::Table => report::table(&found),
            CompareFormat::Html => page(report::html(&found, &warnings)),
            CompareFormat::Markdown => report::markdown(&found, &warnings),
            CompareFormat::Json => report::json(&found, &warnings),
            CompareFormat::Csv => report::csv(&found),
        };
        self.answer.write_page(place, answer)?;
        Ok(if self.fail && !found.is_compatible() { Exit::No } else { Exit::Done })
    }

    /// That options are those of the scheme.
    fn check_options(&self) -> Result<(), Failure> {
        let is_there = |of: &Option<String>| of.is_some();
        let of_scores =
            [("--assigned", is_there(&self.assigned)), ("--sigma", is_there(&self.sigma))];
        let of_study = [
            ("--lower", is_there(&self.lower)),
            ("--upper", is_there(&self.upper)),
            ("--interaction", self.interaction.is_some()),
        ];
        let (others, wanted) = match self.scheme {
            Some(Scheme::GaugeRr) => (&of_scores[..], "iso13528"),
            _ => (&of_study[..], "gauge-rr"),
        };
        match others.iter().find(|(_, is_there)| *is_there) {
            Some((option, _)) => {
                Err(Failure::Argument(format!("`{option}` is for `--scheme {wanted}`")))
            }
            None => Ok(()),
        }
    }

    /// The study of a gauge whose readings are in `unit`; an empty text if none is stated.
    fn studied(&self, readings: &[StudyReading], unit: &str) -> Result<GaugeStudy, Failure> {
        let unit = if unit.is_empty() { None } else { Unit::parse(unit).ok() };
        let limit = |option: &str, text: &Option<String>| {
            gumption_foreign::limit_of(option, text.as_deref(), unit.as_ref())
                .map_err(Failure::Argument)
        };
        let limits = [limit("--lower", &self.lower)?, limit("--upper", &self.upper)?];
        if let [Some(lower), Some(upper)] = limits
            && lower >= upper
        {
            let message = "`--lower` must be below `--upper`";
            return Err(Failure::Argument(message.to_owned()));
        }
        let interaction = match self.interaction {
            Some(KeptInteraction::Kept) => Interaction::Kept,
            Some(KeptInteraction::Pooled) => Interaction::Pooled,
            Some(KeptInteraction::Tested) | None => Interaction::Tested,
        };
        gauge::study(readings, interaction, limits)
            .map_err(|error| Failure::Argument(format!("{}: {error}", self.table.display())))
    }

    /// The scores of participants whose results are in `unit`; an empty text if none is stated.
    fn scored(
        &self,
        participants: Vec<Participant>,
        unit: &str,
    ) -> Result<ProficiencyTest, Failure> {
        let unit = if unit.is_empty() { None } else { Unit::parse(unit).ok() };
        let [assigned, of_assigned, sigma] =
            [&self.assigned, &self.assigned_u, &self.sigma].map(|text| text.as_deref());
        let assigned = gumption_foreign::assigned_by(assigned, of_assigned, unit.as_ref());
        let sigma = gumption_foreign::sigma_by(sigma, unit.as_ref());
        let choice = assigned.and_then(|assigned| Ok((assigned, sigma?)));
        let (assigned, sigma) = choice.map_err(Failure::Argument)?;
        proficiency::score(participants, assigned, sigma)
            .map_err(|error| Failure::Argument(format!("{}: {error}", self.table.display())))
    }
}
