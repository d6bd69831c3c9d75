//! `gumption certificate`

mod each;
mod rounding;

use gumption_engine::fact;
use gumption_engine::fact::Argument;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{
    self, AnswerOptions, CoverageOption, Interactive, Seed, StatementOption, Threads,
    TodaysReadings, Trust,
};
use super::output::AnswerPlace;
use super::{CommandLine, Exit, Failure, output, progress, run, signals};
use gumption_analysis::certificate::contents::{Certificate as Asked, Line};
use gumption_analysis::certificate::{Basis, Failed, Issued, issue};
use gumption_engine::propagate::{statement_notes, warnings};
use gumption_engine::task::{MethodChoice, Trials, Warning};
use gumption_files::{CertificateFile, FileReader};
use gumption_report::certificate::{self as report, CertificateReport, DccVersion, ModelSource};
use gumption_text::{Diagnostic, DiagnosticKind, Diagnostics};

/// Make a calibration certificate from a certificate file and its models.
#[derive(Clone, Debug, Args)]
pub(super) struct Certificate {
    /// The certificate file; - for standard input
    file: PathBuf,
    #[command(flatten)]
    readings: TodaysReadings,
    #[command(flatten)]
    each: each::EachFile,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    answer: AnswerOptions<CertificateFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials for each row; 0 for only the law of propagation
    #[arg(
        long, value_name = "N|adaptive", value_parser = options::trials,
        allow_negative_numbers = true
    )]
    trials: Option<Trials>,
    /// Source of the stated values that do not come from the law of propagation: exact values,
    /// values of quasi-random points (independent of the seed), or values of the trials, which are
    /// the default unless the model files say otherwise; auto takes exact values if available, else
    /// quasi-random ones
    #[arg(long, value_name = "METHOD", value_parser = options::method())]
    method: Option<MethodChoice>,
    /// Version of the digital certificate, with `--format dcc` [default: 3.2.1]
    #[arg(long, value_name = "VERSION")]
    dcc_version: Option<Version>,
    /// Also write NAME.xsl, a stylesheet that displays the digital certificate in a browser, and
    /// refer to it in the certificate; with `--format dcc --output NAME.xml`
    #[arg(long)]
    stylesheet: bool,
    #[command(flatten)]
    coverage: CoverageOption,
    #[command(flatten)]
    statement: StatementOption,
    #[command(flatten)]
    threads: Threads,
}

/// The format of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CertificateFormat {
    /// A text page
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each row of the table
    Csv,
    /// A Markdown page, as GitHub shows it
    Markdown,
    /// A LaTeX file for `article` with `booktabs` and `siunitx`
    Latex,
    /// An HTML page, in one file
    Html,
    /// A workbook
    Xlsx,
    /// A Digital Calibration Certificate (PTB)
    Dcc,
}

/// The version of a digital certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Version {
    /// The newest version that can be written
    #[value(name = "3.2.1")]
    V3_2_1,
    /// For software that cannot read newer versions
    #[value(name = "3.1.2")]
    V3_1_2,
}

impl From<Version> for DccVersion {
    fn from(version: Version) -> Self {
        match version {
            Version::V3_2_1 => Self::V3_2_1,
            Version::V3_1_2 => Self::V3_1_2,
        }
    }
}

impl Certificate {
    pub(super) fn execute(&self, program: &CommandLine) -> Result<Exit, Failure> {
        if self.each.is_asked() {
            return self.of_each_file(program);
        }
        let page = self.interactive.of(&self.answer)?;
        let mut file = self.read(program)?;
        if let Some(key) = file.certificate.administrative.without_readings() {
            let name = key.rsplit_once('.').map_or(key, |(_, name)| name);
            let reason = format!(
                "`{name}` is the name of the file of readings, but there is none; give one by \
                 `--readings` or `--each`"
            );
            let kind = DiagnosticKind::Certificate { reason };
            return Err(Failure::Diagnostics(file.diagnostic_at(key, kind)));
        }
        self.check_format(&file)?;
        let beside = self.beside()?;
        let [place, view] = output::open(
            [
                ("--output", output::to_file(self.answer.output.as_deref())),
                ("--stylesheet", beside.as_ref().map(|(path, _)| path.as_path())),
            ],
            &self.paths(&file),
        )?;
        let page_or_pipe = if self.answer.format == CertificateFormat::Table {
            AnswerPlace::Page
        } else {
            AnswerPlace::StandardOutput
        };
        let place = place.map_or(page_or_pipe, AnswerPlace::File);
        for asked in &mut file.certificate.evaluations {
            let settings = &mut asked.task.settings;
            settings.seed = self.seed.or(settings.seed);
            settings.coverage = self.coverage.or(settings.coverage);
            settings.method = self.method.or(settings.method);
            settings.statement = self.statement.requested().unwrap_or(settings.statement);
            if let Some(trials) = self.trials {
                settings.trials = trials;
                settings.decide_up_to = 0;
            }
        }
        let provenance = run::provenance(&file.source.text, &[]);
        let models: Vec<ModelSource<'_>> = file
            .models
            .iter()
            .map(|model| {
                let of = run::provenance(&model.source.text, &model.files);
                (model, of)
            })
            .map(|(model, of)| ModelSource {
                name: &model.name,
                text: &model.source.text,
                digest: of.model_sha256,
                tables: &model.files,
                files: of.files,
            })
            .collect();
        let stop = signals::stop_flag();
        let issued = self.issue(&file, &models, &stop)?;
        let warnings = notes(&file, &issued);
        self.answer.say(&warnings);
        let report = CertificateReport {
            certificate: &file.certificate,
            issued: &issued,
            models: &models,
            text: &file.source.text,
            digest: &provenance.model_sha256,
            warnings: &warnings,
        };
        if issued.stopped || stop.load(Ordering::Relaxed) {
            say("gumption: interrupted; no certificate is issued from part of the trials\n");
            return Ok(Exit::Interrupted);
        }
        if self.answer.format == CertificateFormat::Dcc {
            let names = report::attached(&report).join(", ");
            self.answer.note([format!("attached to the certificate: {names}").as_str()]);
        }
        let answer = match self.answer.format {
            CertificateFormat::Table => report::table(&report),
            CertificateFormat::Json => report::json(&report),
            CertificateFormat::Csv => report::csv(&report),
            CertificateFormat::Markdown => report::markdown(&report),
            CertificateFormat::Latex => report::latex(&report),
            CertificateFormat::Html => page(report::html(&report)),
            CertificateFormat::Dcc => {
                let version = self.dcc_version.map_or_else(Default::default, Into::into);
                let made = report::dcc(&report, version);
                match &beside {
                    Some((_, name)) => report::with_stylesheet(&made, name),
                    None => made,
                }
            }
            CertificateFormat::Xlsx => {
                let bytes = report::xlsx(&report)
                    .map_err(|error| Failure::System(format!("no workbook: {error}")))?;
                place.write_with(|out| out.write_all(&bytes))?;
                return Ok(Exit::Done);
            }
        };
        if let Some(view) = view {
            AnswerPlace::File(view).write(&report::dcc_stylesheet())?;
        }
        place.write(&answer)?;
        Ok(Exit::Done)
    }

    /// The path of the stylesheet and its name, if one is requested.
    fn beside(&self) -> Result<Option<(PathBuf, String)>, Failure> {
        let refuse = |reason: &str| Err(Failure::Argument(reason.to_owned()));
        if !self.stylesheet {
            return Ok(None);
        }
        let Some(output) = output::to_file(self.answer.output.as_deref())
            .filter(|_| self.answer.format == CertificateFormat::Dcc)
        else {
            return refuse("`--stylesheet` goes with `--format dcc --output NAME.xml`");
        };
        let path = output.with_extension("xsl");
        match path.file_name().and_then(|name| name.to_str()) {
            Some(name) => Ok(Some((path.clone(), name.to_owned()))),
            None => refuse("`--stylesheet` needs a name of the certificate that is Unicode text"),
        }
    }

    fn read(&self, program: &CommandLine) -> Result<CertificateFile, Failure> {
        let readings = self.readings.read()?;
        let files = self.trust.files(program).with_readings(readings.as_ref());
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.certificate_text(name, text, folder)
        };
        Ok(options::opened(files, &self.file, text, |path| files.certificate(path))??)
    }

    /// The paths of the file, of its models, and of the tables that they name.
    fn paths(&self, file: &CertificateFile) -> Vec<PathBuf> {
        let mut paths = options::with_named(&self.file, file.models.iter().map(|of| &of.name));
        for (number, model) in file.models.iter().enumerate() {
            let path = paths[number + 1].clone();
            let tables = options::with_named(&path, model.files.iter().map(|(name, _)| name));
            paths.extend(tables.into_iter().skip(1));
        }
        paths.extend(self.readings.file.clone());
        paths
    }

    /// Checks that the certificate can be written in the requested format.
    fn check_format(&self, file: &CertificateFile) -> Result<(), Failure> {
        if self.answer.format == CertificateFormat::Xlsx && self.answer.is_terminal() {
            return Err(options::workbook_in_terminal());
        }
        if self.dcc_version.is_some() && self.answer.format != CertificateFormat::Dcc {
            let said = "`--dcc-version` goes with `--format dcc`".to_owned();
            return Err(Failure::Argument(said));
        }
        if self.answer.format == CertificateFormat::Dcc {
            let needed = report::needed(&file.certificate);
            if !needed.is_empty() {
                let what = "a digital calibration certificate (`--format dcc`)";
                return Err(Failure::Diagnostics(file.missing(&needed, what)));
            }
        }
        Ok(())
    }

    fn issue(
        &self,
        file: &CertificateFile,
        models: &[ModelSource<'_>],
        stop: &AtomicBool,
    ) -> Result<Issued, Failure> {
        let bar = progress::bar(trials_to_make(&file.certificate), self.answer.quiet);
        let advance = |trials: u64| bar.inc(trials);
        let control = self.threads.control(stop).with_progress(&advance);
        let digests: Vec<Arc<str>> =
            models.iter().map(|model| Arc::from(model.digest.as_str())).collect();
        let result = issue(&file.certificate, &digests, &control);
        bar.finish_and_clear();
        result.map_err(|failed| failure(file, failed))
    }
}

/// The total number of trials of all evaluations; `None` if one of them is adaptive.
fn trials_to_make(certificate: &Asked) -> Option<u64> {
    let of = |asked: &gumption_analysis::certificate::contents::Asked| match asked
        .task
        .settings
        .trials
    {
        Trials::Fixed(trials) => Some(trials.saturating_mul(asked.task.rows.len() as u64)),
        Trials::Adaptive => None,
    };
    certificate.evaluations.iter().map(of).sum()
}

/// Warnings about a certificate that can still be issued: notes of the model files and of their
/// evaluations, and uncertainties below the laboratory's capability.
fn notes(file: &CertificateFile, issued: &Issued) -> Vec<Warning> {
    // reported here for each row instead
    const OF_ROWS: [&str; 2] = ["below-cmc", "raised-to-cmc"];
    let mut notes = file.warnings.clone();
    notes.extend(not_stated(&file.certificate));
    notes.extend(rounding::notes(file, issued));
    let evaluations = file.certificate.evaluations.iter().zip(&issued.evaluations);
    for (asked, evaluation) in evaluations {
        let found = warnings(&asked.task, evaluation).into_iter();
        let found = found.chain(statement_notes(&asked.task, evaluation));
        for warning in found.filter(|warning| !OF_ROWS.contains(&warning.code())) {
            let note = warning.within(fact!("of-model", model = &asked.model));
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
    }
    for (number, (statement, line)) in
        issued.statements.iter().zip(&file.certificate.lines).enumerate()
    {
        if statement.basis == Basis::Shortest
            && let Some(why) = seeded(issued, line)
        {
            let row = number + 1;
            notes.push(Warning::new(format!("row {row}"), fact!("digits-of-trials", row, why)));
        }
        let Some(limit) = statement.limit.filter(|limit| limit.below) else { continue };
        let task = file.certificate.evaluations.get(line.evaluation).map(|asked| &asked.task);
        let Some(output) = task.and_then(|task| task.model.outputs.get(line.output)) else {
            continue;
        };
        let in_unit = |number: String| output.quantity.unit.after(&number);
        let row = number + 1;
        let cmc = in_unit(gumption_engine::decimal::significant(limit.cmc, 3));
        let cmc = Argument::Number(cmc);
        let fact = if limit.raised {
            fact!("raised-to-cmc.certificate", row, cmc)
        } else {
            let expanded = in_unit(statement.rounded.map_or("0".to_owned(), |to| to.to_string()));
            fact!("below-cmc.certificate", row, expanded = Argument::Number(expanded), cmc)
        };
        notes.push(Warning::new(format!("row {row}"), fact));
    }
    notes
}

/// Why there are no values without the noise of trials although they were requested.
fn seeded<'a>(issued: &'a Issued, line: &Line) -> Option<&'a str> {
    let row = issued.evaluations.get(line.evaluation)?.rows.get(line.row)?;
    row.outputs.get(line.output)?.noiseless.as_ref()?.as_ref().err().map(String::as_str)
}

/// The items required by ISO/IEC 17025 that this certificate does not state. A file without a
/// number is a draft and not issued.
fn not_stated(certificate: &Asked) -> Option<Warning> {
    let of = &certificate.administrative;
    of.number.as_ref()?;
    let stated = [
        ("laboratory", of.laboratory.is_some()),
        ("customer", of.customer.is_some()),
        ("device", of.device.is_some()),
        ("method", of.method.is_some()),
        ("calibration_date", of.calibrated.is_some()),
        ("issue_date", of.issued.is_some()),
        ("responsible", of.responsible.is_some()),
        ("environment", of.environment.is_some()),
        ("traceability", of.traceability.is_some()),
    ];
    let missing: Vec<String> = stated
        .into_iter()
        .filter(|(_, stated)| !stated)
        .map(|(key, _)| format!("`{key}`"))
        .collect();
    (!missing.is_empty()).then(|| Warning::new("certificate", fact!("not-stated", missing)))
}

/// A certificate that cannot be issued, as an error with its position if the user caused it.
fn failure(file: &CertificateFile, failed: Failed) -> Failure {
    let message = failed.to_string();
    let line = match &failed {
        Failed::Evaluation { evaluation, .. } => {
            let of = |line: &Line| line.evaluation == *evaluation;
            file.certificate.lines.iter().position(of)
        }
        Failed::NoResult { line } | Failed::NoUncertainty { line, .. } => Some(*line),
        _ => None,
    };
    let span = line.and_then(|line| file.places.get(line).cloned()).unwrap_or(0..0);
    let kind = DiagnosticKind::Evaluation { message };
    Failure::Diagnostics(Diagnostics(vec![Diagnostic { source: file.source.clone(), span, kind }]))
}
