//! Diagnoses a case for programs that show its page and offer what it proposes.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::exported::stopped_early;
use super::{CommandLine, GivenFile, NotExported, run};
use gumption_gap::{DiagnosisOptions, diagnose_until};
use gumption_report::gap;

/// A diagnosis as a page and as an answer for programs.
#[derive(Clone, PartialEq, Eq)]
pub struct DiagnosedCase {
    /// The page of `gumption gap --format html`.
    pub html: String,
    /// The answer of `gumption gap --format json`.
    pub json: String,
}

impl fmt::Debug for DiagnosedCase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "DiagnosedCase({} bytes, {} bytes)", self.html.len(), self.json.len())
    }
}

impl CommandLine {
    /// The diagnosis of a case, which is made once. `told` is told the share that is done; when `stop`
    /// becomes true, there is none.
    ///
    /// # Errors
    /// Why there is no diagnosis.
    pub fn diagnosed(
        &self,
        given: &GivenFile,
        told: &(dyn Fn(f64) + Sync),
        stop: &Arc<AtomicBool>,
    ) -> Result<DiagnosedCase, NotExported> {
        let GivenFile { name, text, folder, within, held } = given;
        let files = self.files().holding(held).within(within.as_deref());
        let file = files.case_text(name, text, folder).map_err(NotExported::Mistakes)?;
        if file.case.simulator.is_some() {
            let message = "a program gives the outputs of this case; `gumption gap` on the command \
                           line runs it (`--simulator`)";
            return Err(NotExported::Content(message.to_owned()));
        }
        let options = DiagnosisOptions::new(file.case.task.settings.seed);
        let diagnosis = diagnose_until(&file.case, None, options, told, stop)
            .map_err(|error| NotExported::Content(error.to_string()))?;
        if diagnosis.interrupted {
            return Err(stopped_early());
        }
        let provenance = run::provenance(&file.source.text, &file.files);
        Ok(DiagnosedCase { html: gap::html(&diagnosis, &provenance), json: gap::json(&diagnosis) })
    }
}
