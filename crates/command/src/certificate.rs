//! `gumption certificate`

mod rounding;

use gumption_engine::fact;
use gumption_engine::fact::Argument;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::exit::say;
use super::options::{self, AnswerOptions, CoverageOption, Interactive, Seed, Threads, Trust};
use super::output::AnswerPlace;
use super::{CommandLine, Exit, Failure, output, progress, run, signals};
use gumption_analysis::certificate::contents::{Certificate as Asked, Line};
use gumption_analysis::certificate::{Basis, Failed, Issued, issue};
use gumption_engine::propagate::warnings;
use gumption_engine::task::{MethodChoice, Trials, Warning};
use gumption_files::{CertificateFile, FileReader};
use gumption_report::certificate::{self as report, CertificateReport, DccVersion, ModelSource};
use gumption_text::{Diagnostic, DiagnosticKind, Diagnostics};

/// Make a calibration certificate.
#[derive(Debug, Args)]
pub(super) struct Certificate {
    /// The certificate file; - for standard input
    file: PathBuf,
    #[command(flatten)]
    trust: Trust,
    #[command(flatten)]
    answer: AnswerOptions<CertificateFormat>,
    #[command(flatten)]
    interactive: Interactive,
    #[command(flatten)]
    seed: Seed,
    /// Number of Monte Carlo trials for each row; 0 for the law of propagation alone
    #[arg(
        long, value_name = "N|adaptive", value_parser = options::trials,
        allow_negative_numbers = true
    )]
    trials: Option<Trials>,
    /// Where the figures come from that are stated in place of those of the law of propagation: exact
    /// ones, or those of quasi-random points, which no seed moves; those of the trials unless the model files say
    /// otherwise; auto takes exact ones where there are any, else quasi-random ones
    #[arg(long, value_name = "METHOD", value_parser = options::method())]
    method: Option<MethodChoice>,
    /// Version of the digital certificate, with `--format dcc`; 3.2.1 unless given
    #[arg(long, value_name = "VERSION")]
    dcc_version: Option<Version>,
    /// Write a stylesheet beside the digital certificate, NAME.xsl, that shows it to people, and name it
    /// in the certificate; with `--format dcc --output NAME.xml`
    #[arg(long)]
    stylesheet: bool,
    #[command(flatten)]
    coverage: CoverageOption,
    #[command(flatten)]
    threads: Threads,
}

/// The format of a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CertificateFormat {
    /// A page of text for people
    Table,
    /// The whole answer for programs
    Json,
    /// One line for each row of the table
    Csv,
    /// A page as GitHub shows it
    Markdown,
    /// A LaTeX file for `article` with `booktabs` and `siunitx`
    Latex,
    /// A page for a browser and for print, in one file
    Html,
    /// A workbook
    Xlsx,
    /// A Digital Calibration Certificate of the PTB
    Dcc,
}

/// The version of a digital certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Version {
    /// The newest version that can be written
    #[value(name = "3.2.1")]
    V3_2_1,
    /// For readers that do not know newer ones
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
        let page = self.interactive.of(&self.answer)?;
        let mut file = self.read(program)?;
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

    /// The path of the stylesheet and its name, where one is asked for.
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
        let files = self.trust.files(program);
        let text = |files: FileReader<'_>, name: &str, text: &str, folder: &Path| {
            files.certificate_text(name, text, folder)
        };
        Ok(options::opened(files, &self.file, text, |path| files.certificate(path))??)
    }

    /// The paths of the file, of its models, and of the tables that these name.
    fn paths(&self, file: &CertificateFile) -> Vec<PathBuf> {
        let mut paths = options::with_named(&self.file, file.models.iter().map(|of| &of.name));
        for (number, model) in file.models.iter().enumerate() {
            let path = paths[number + 1].clone();
            let tables = options::with_named(&path, model.files.iter().map(|(name, _)| name));
            paths.extend(tables.into_iter().skip(1));
        }
        paths
    }

    /// Whether the certificate can be given in the format that was asked for.
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

/// The trials of all evaluations; `None` if an adaptive one is among them.
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

/// What should be known about a certificate that is made all the same: notes of the model files, of
/// their evaluations, and uncertainties below the laboratory's capability.
fn notes(file: &CertificateFile, issued: &Issued) -> Vec<Warning> {
    // said here for each row instead
    const OF_ROWS: [&str; 2] = ["below-cmc", "raised-to-cmc"];
    let mut notes = file.warnings.clone();
    notes.extend(not_stated(&file.certificate));
    notes.extend(rounding::notes(file, issued));
    let evaluations = file.certificate.evaluations.iter().zip(&issued.evaluations);
    for (asked, evaluation) in evaluations {
        let found = warnings(&asked.task, evaluation).into_iter();
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

/// Why there are no figures without the noise of trials, where they were asked for.
fn seeded<'a>(issued: &'a Issued, line: &Line) -> Option<&'a str> {
    let row = issued.evaluations.get(line.evaluation)?.rows.get(line.row)?;
    row.outputs.get(line.output)?.noiseless.as_ref()?.as_ref().err().map(String::as_str)
}

/// What ISO/IEC 17025 asks of a certificate and this one does not say. A file without a number is no
/// certificate that leaves the house.
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

/// A certificate that cannot be made, as a mistake with its place where it is the user's.
fn failure(file: &CertificateFile, failed: Failed) -> Failure {
    let message = failed.to_string();
    let line = match &failed {
        Failed::Evaluation { evaluation, .. } => {
            let of = |line: &Line| line.evaluation == *evaluation;
            file.certificate.lines.iter().position(of)
        }
        Failed::NoResult { line } | Failed::NoUncertainty { line } => Some(*line),
        _ => None,
    };
    let span = line.and_then(|line| file.places.get(line).cloned()).unwrap_or(0..0);
    let kind = DiagnosticKind::Evaluation { message };
    Failure::Diagnostics(Diagnostics(vec![Diagnostic { source: file.source.clone(), span, kind }]))
}
