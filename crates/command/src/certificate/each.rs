//! One certificate for each file of readings in a folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use super::{Certificate, CertificateFormat};
use crate::exit::say;
use crate::options::{AnswerOptions, TodaysReadings};
use crate::{CommandLine, Exit, Failure};
use gumption_analysis::certificate::contents::NAME_OF_READINGS;
use gumption_columns::read_failure;
use gumption_report::plain;

/// A folder of files of readings, and the folder of their certificates.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct EachFile {
    /// Make one certificate for each file of readings (.csv, .xlsx) in this folder
    #[arg(
        long = "each",
        value_name = "FOLDER",
        requires = "output_folder",
        conflicts_with_all = ["file_of_readings", "output"]
    )]
    folder: Option<PathBuf>,
    /// Write the certificates to this folder, each under the name of its file of readings
    #[arg(long, value_name = "DIR", requires = "folder")]
    output_folder: Option<PathBuf>,
}

impl EachFile {
    pub(super) fn is_asked(&self) -> bool {
        self.folder.is_some()
    }
}

impl CertificateFormat {
    /// The end of the name of a file in this format.
    fn extension(self) -> &'static str {
        match self {
            Self::Table => "txt",
            Self::Json => "json",
            Self::Csv => "csv",
            Self::Markdown => "md",
            Self::Latex => "tex",
            Self::Html => "html",
            Self::Xlsx => "xlsx",
            Self::Dcc => "xml",
        }
    }
}

impl Certificate {
    /// Makes the certificates one after the other. Errors of a file are printed below its name, and the
    /// other files go on.
    pub(super) fn of_each_file(&self, program: &CommandLine) -> Result<Exit, Failure> {
        let (Some(folder), Some(out)) = (&self.each.folder, &self.each.output_folder) else {
            return Err(Failure::Argument("`--each` needs `--output-folder DIR`".to_owned()));
        };
        if self.file == Path::new("-") {
            let reason = "`--each` reads the certificate file for each certificate, and standard input can \
                          be read once; name the file";
            return Err(Failure::Argument(reason.to_owned()));
        }
        let named = files_in(folder)?;
        if named.len() > 1 {
            self.tells_certificates_apart(program)?;
        }
        fs::create_dir_all(out).map_err(|error| {
            let reason = read_failure::in_words(&error);
            Failure::System(format!("cannot make the folder `{}`: {reason}", out.display()))
        })?;
        let (mut failed, mut is_of_system) = (Vec::new(), false);
        for (stem, path) in &named {
            let mut name = PathBuf::from(stem).into_os_string();
            name.push(format!(".{}", self.answer.format.extension()));
            let output = out.join(name);
            let one = Self {
                readings: TodaysReadings { file: Some(path.clone()) },
                each: EachFile::default(),
                answer: AnswerOptions { output: Some(output.clone()), ..self.answer.clone() },
                ..self.clone()
            };
            let shown = path.display();
            match one.execute(program) {
                Ok(Exit::Done) => {
                    self.answer.note([format!("`{shown}`: `{}` is written", output.display())]);
                }
                Ok(other) => return Ok(other),
                Err(failure) => {
                    is_of_system |= matches!(failure, Failure::System(_));
                    say(&format!(
                        "gumption: no certificate of `{}`:\n{failure}",
                        plain(&shown.to_string())
                    ));
                    failed.push(format!("`{shown}`"));
                }
            }
        }
        if failed.is_empty() {
            return Ok(Exit::Done);
        }
        let message = format!(
            "{} of {} certificates were not made: {}",
            failed.len(),
            named.len(),
            failed.join(", ")
        );
        Err(if is_of_system { Failure::System(message) } else { Failure::Argument(message) })
    }
}

impl Certificate {
    /// Checks that no two certificates have the same number or serial number: each stated one names
    /// its file of readings.
    fn tells_certificates_apart(&self, program: &CommandLine) -> Result<(), Failure> {
        // errors of the files are reported where their certificates are made
        let Ok(file) = self.read(program) else { return Ok(()) };
        let of = file.certificate.administrative;
        let serial_number = of.device.and_then(|device| device.serial_number);
        for (key, stated) in [("number", of.number), ("device.serial_number", serial_number)] {
            if let Some(stated) = stated.filter(|stated| !stated.contains(NAME_OF_READINGS)) {
                let stated = plain(&stated);
                return Err(Failure::Argument(format!(
                    "`--each` makes several certificates, and `{key}` of all of them is \
                     `{stated}`; write `{NAME_OF_READINGS}` at the place of the name of the file \
                     of readings, such as `{stated}-{NAME_OF_READINGS}`"
                )));
            }
        }
        Ok(())
    }
}

/// The files of readings in a folder by their names without the end, in the order of these names.
fn files_in(folder: &Path) -> Result<BTreeMap<PathBuf, PathBuf>, Failure> {
    let unreadable = |error| {
        let reason = read_failure::of_folder(folder, &error);
        Failure::Argument(format!("`{}`: {reason}", folder.display()))
    };
    let mut named: BTreeMap<PathBuf, PathBuf> = BTreeMap::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let end = path.extension().map(|end| end.to_string_lossy().to_lowercase());
        let is_table = matches!(end.as_deref(), Some("csv" | "xlsx"));
        let Some(stem) = path.file_stem().filter(|_| is_table && path.is_file()) else { continue };
        if let Some(other) = named.insert(stem.into(), path.clone()) {
            return Err(Failure::Argument(format!(
                "`{}` and `{}` would be one certificate; give one of them another name",
                other.display(),
                path.display()
            )));
        }
    }
    if named.is_empty() {
        return Err(Failure::Argument(format!(
            "the folder `{}` has no files of readings (.csv, .xlsx)",
            folder.display()
        )));
    }
    Ok(named)
}
