//! `gumption plan`

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{
    self, AnswerOptions, CoverageOption, Interactive, ModelArguments, Seed, Threads,
};
use super::{CommandLine, Exit, Failure, progress, run, signals};
use gumption_analysis::plan::{Costs, DriftLaw, NoPlan, Plan, PlanQuestion, plan};
use gumption_engine::number::Shortest;
use gumption_engine::task::{Task, Trials};
use gumption_files as file;
use gumption_files::{CostFile, ModelFile};
use gumption_report::plan as report;
use gumption_text::bytes::sha256;

/// Find the cheapest improvement of the inputs that meets a target uncertainty.
#[derive(Debug, Args)]
pub(super) struct Planning {
    #[command(flatten)]
    model: ModelArguments,
    /// The target: "U(y) <= 0.01 m/s^2", "U(y)/y <= 0.5 %", or "u(y) <= ..." for the standard
    /// uncertainty; without a unit in the unit of the output
    #[arg(long, value_name = "TARGET")]
    target: String,
    /// Costs of improving the inputs; by default halving any of them costs the same
    #[arg(long, value_name = "FILE")]
    cost: Option<PathBuf>,
    /// Also compute the longest calibration interval: the input or component whose uncertainty is
    /// the drift over this time ("reference/drift=365 d")
    #[arg(long, value_name = "NAME=TIME")]
    drift: Option<String>,
    /// How the drift's uncertainty grows: in proportion to time, or with its square root
    #[arg(long, value_name = "LAW", default_value = "linear", value_parser = law(), requires = "drift")]
    drift_law: DriftLaw,
    #[command(flatten)]
    answer: AnswerOptions<PlanFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials for checking the plan, 0 for none
    #[arg(long, value_name = "N", value_parser = options::trials, allow_negative_numbers = true)]
    trials: Option<Trials>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    coverage: CoverageOption,
}

/// The format of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PlanFormat {
    /// A text page
    Table,
    /// A Markdown page, as GitHub shows it; with `--output` its figures are SVG files beside it
    Markdown,
    /// The whole answer for programs
    Json,
    /// One line for each input
    Csv,
    /// An HTML page with figures, in one file
    Html,
}

fn law() -> impl TypedValueParser<Value = DriftLaw> {
    PossibleValuesParser::new(DriftLaw::ALL.map(DriftLaw::name)).try_map(|name| {
        let named = DriftLaw::ALL.into_iter().find(|law| law.name() == name);
        named.ok_or("there is no law with this name")
    })
}

impl Planning {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let page = self.interactive.of(&self.answer)?;
        let file = self.model.read(program)?;
        let mut task = file.task.clone();
        task.settings.seed = self.seed.or(task.settings.seed);
        task.settings.coverage = self.coverage.or(task.settings.coverage);
        task.settings.trials = self.trials.unwrap_or(task.settings.trials);
        let target = file::read_target(&self.target, &task).map_err(Failure::Argument)?;
        let drift =
            self.drift.as_deref().map(|drift| file::read_drift(drift, self.drift_law, &task));
        let (drift, time_unit) = drift.transpose().map_err(Failure::Argument)?.unzip();
        let costs = self.costs(&task)?;
        let mut read = self.model.paths(&file);
        read.extend(self.cost.clone());
        let place = self.answer.open(&read)?;
        let stop = signals::stop_flag();
        let (costs, cost_text) =
            costs.map_or((Costs::Equal, None), |CostFile { costs, text }| (costs, Some(text)));
        let question = PlanQuestion { target, costs, drift };
        let Some(found) = self.plan(&file, &task, &question, &stop)? else {
            say("gumption: interrupted; an incomplete plan gives no answer\n");
            return Ok(Exit::Interrupted);
        };
        let mut provenance = run::provenance(&file.source.text, &file.files);
        if let (Some(path), Some(text)) = (&self.cost, cost_text) {
            let name =
                path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
            provenance.files.push((name, sha256(text.as_bytes())));
        }
        let report = report::PlanReport {
            task: &task,
            plan: &found,
            costs: &question.costs,
            time_unit: time_unit.as_deref().unwrap_or(""),
            warnings: &file.warnings,
            provenance: &provenance,
        };
        let answer = || match self.answer.format {
            PlanFormat::Table => report::table(&report),
            PlanFormat::Markdown => report::markdown(&report),
            PlanFormat::Json => report::json(&report),
            PlanFormat::Csv => report::csv(&report),
            PlanFormat::Html => page(report::html(&report)),
        };
        self.answer.say(&file.warnings);
        self.answer.write_page(place, answer)?;
        Ok(Exit::Done)
    }

    fn costs(&self, task: &Task) -> Result<Option<CostFile>, Failure> {
        let Some(path) = &self.cost else { return Ok(None) };
        let text = |text: &str| file::read_costs_text("<stdin>", text, task);
        let read = options::given(path, text, |path: &Path| file::read_costs(path, task))?;
        Ok(Some(read?))
    }

    fn plan(
        &self,
        file: &ModelFile,
        task: &Task,
        question: &PlanQuestion,
        stop: &AtomicBool,
    ) -> Result<Option<Plan>, Failure> {
        let bar = progress::bar(None, self.answer.quiet);
        let advance = |trials: u64| bar.inc(trials);
        let control = self.threads.control(stop).with_progress(&advance);
        let result = plan(task, question, &control);
        bar.finish_and_clear();
        match result {
            Ok(found) => Ok(Some(found).filter(|_| !stop.load(Ordering::Relaxed))),
            Err(NoPlan::Evaluation(error)) => Err(run::failure(file, error)),
            Err(error) => Err(Failure::Argument(said(&error, task, question))),
        }
    }
}

/// Why there is no plan, with the unit of the output.
fn said(error: &NoPlan, task: &Task, question: &PlanQuestion) -> String {
    let target = question.target;
    let output = task.model.outputs.get(target.output).map(|output| &output.quantity);
    let (name, unit) = output.map_or(("", ""), |of| (of.name.as_str(), of.unit.text()));
    let kind = if target.expanded { "U" } else { "u" };
    let value = |value: f64| {
        let digits = gumption_engine::decimal::to_digits(value, 4);
        let of_unit = if unit == "1" { "" } else { unit };
        format!("{} {of_unit}", Shortest(digits)).trim_end().to_owned()
    };
    let most = report::wanted(&target, output);
    match error {
        NoPlan::Met(now) => format!(
            "the target {kind}({name}) <= {most} is already met: {kind}({name}) is {} now",
            value(*now)
        ),
        NoPlan::MetByPropagation { figure, by_trials, instead, excess } => {
            let advice = match excess {
                Some(excess) => report::excess_text(excess, task, target),
                None => format!(
                    "plan for {kind}({name}) <= {}, for which the trials approximately meet the \
                     target",
                    value(*instead)
                ),
            };
            format!(
                "the target {kind}({name}) <= {most} is met by the law of propagation ({}), which \
                 is used for planning, but the trials give {}, as `gumption run` shows; {advice}",
                value(*figure),
                value(*by_trials)
            )
        }
        NoPlan::Unreachable(least) => {
            let said = format!(
                "the target {kind}({name}) <= {most} cannot be reached: {kind}({name}) is still \
                 {1} with every improvement that {0}",
                match question.costs {
                    Costs::Equal => "can be planned",
                    _ => "the file of costs has",
                },
                value(*least)
            );
            let worse = report::worse_offers(task, &question.costs);
            if worse.is_empty() { said } else { format!("{said}. {}", worse.join(" ")) }
        }
        error => error.to_string(),
    }
}
