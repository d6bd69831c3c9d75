//! A case of the gap diagnosis as a whole: a model file with observations and candidate effects.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

use super::context::Context;
use super::effect_context::EffectContext;
use super::effects;
use super::formula_notes::UNUSED_INPUT;
use super::model_reader::{FoundModel, ModelOptions, ModelReader, read_with};
use super::results::ResultFiles;
use super::{catalogue, prior, simulator_case, soundness};
use gumption_engine::task::{Row, Warning};
use gumption_gap::Case;
use gumption_text::{DiagnosticKind, Diagnostics, SourceText};

/// The keys that only cases have; a file with one of them is meant as a case.
pub(super) const KEYS: [&str; 5] = ["observations", "effects", "catalogue", "prior", "simulator"];

/// A case that was read and found right.
#[derive(Debug)]
pub struct CaseFile {
    /// The case.
    pub case: Case,
    /// Notes on what was read.
    pub warnings: Vec<Warning>,
    /// The file's text.
    pub source: Arc<SourceText>,
    /// The content of the tables that were read, by name.
    pub files: Vec<(String, Vec<u8>)>,
}

/// What a case's sim has in the rows of a table of conditions, which stands in the current folder.
pub(super) fn read_at(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
    conditions: &Path,
) -> Result<Vec<Row>, Diagnostics> {
    let options = ModelOptions { at: Some(conditions), ..ModelOptions::with(files) };
    read_with(name, text, folder, options, |reader| {
        reader.found_with_history().map(|found| found.file.task.rows)
    })
}

/// Reads and checks a case's text.
pub(super) fn read_text(
    files: Context<'_>,
    name: &str,
    text: &str,
    folder: &Path,
) -> Result<CaseFile, Diagnostics> {
    read_with(name, text, folder, ModelOptions::with(files), |reader| reader.case())
}

impl FoundModel {
    fn for_effects(&self) -> EffectContext<'_> {
        EffectContext {
            sim: &self.sim,
            task: &self.file.task,
            observed: &self.observed,
            history: &self.history,
            clock: self.clock,
        }
    }
}

impl ModelReader<'_> {
    /// The notes on the file as a case where it has a key that only cases have, else as a model;
    /// `None` after a mistake.
    pub(super) fn checked(&self) -> Option<Vec<Warning>> {
        if KEYS.iter().any(|key| self.root.get(key).is_some()) {
            self.case().map(|case| case.warnings)
        } else {
            self.found().map(|found| found.file.warnings)
        }
    }

    /// The case, unless the file has mistakes.
    fn case(&self) -> Option<CaseFile> {
        let found = self.found_with_history();
        let prior = prior::read(&self.root);
        if self.root.get("observations").is_none() {
            let what = "a case of the gap diagnosis";
            self.root.report(DiagnosticKind::MissingKey { key: "observations", what });
        }
        let results = ResultFiles::new(self.folder, self.options.files);
        let mut warnings = Vec::new();
        let sim = found.as_ref().map(|found| &found.sim);
        let own = match self.root.get("effects") {
            Some(member) => effects::read(self.root.log, member, sim, &results, &mut warnings),
            None => Some(Vec::new()),
        };
        let complete = own.is_some();
        let mut placed = own.unwrap_or_default();
        let read = found.as_ref().map(FoundModel::for_effects);
        let shipped =
            catalogue::read(self.root.log, &self.root, read, &results, &mut placed, &mut warnings);
        let read = read?;
        effects::check_together(self.root.log, &placed, read.sim);
        if let Some(data) = found.as_ref().and_then(|found| found.data.as_ref()) {
            soundness::check(self.root.log, &read, &placed, data);
        }
        let simulator = simulator_case::read(&self.root, read.sim, read.task, &mut placed);
        shipped.filter(|()| complete && self.root.log.is_clean())?;
        let unlisted = catalogue::unlisted(&read, &results, &placed);
        let FoundModel { file, sim, observed, simulated, history, reachable, replication, .. } =
            found?;
        let of = |name: String| sim.conditions.iter().position(|condition| condition.name == name);
        let groups = replication.and_then(of);
        let by_effects: HashSet<&str> = placed
            .iter()
            .flat_map(|placed| &placed.candidate.effect.overrides)
            .flat_map(|(_, formula)| formula.names())
            .map(|(name, _)| name)
            .collect();
        let of_file = file.warnings.into_iter().filter(|note| {
            note.code() != UNUSED_INPUT || !by_effects.contains(note.place.as_str())
        });
        warnings.splice(0..0, of_file.collect::<Vec<_>>());
        let candidates = placed.into_iter().map(|placed| placed.candidate).collect();
        let case = Case {
            task: file.task,
            model: sim,
            observed,
            simulated,
            simulator: simulator.map(Arc::new),
            history: history.into_iter().map(|(_, history)| history).collect(),
            reachable,
            candidates,
            shipped: unlisted,
            replication: None,
            prior: prior?,
        };
        let case = match groups {
            Some(condition) => case.replicated(condition),
            None => case,
        };
        prior::check_possible(&self.root, &case.prior, case.candidates.len())?;
        Some(CaseFile { case, warnings, source: file.source, files: file.files })
    }
}
