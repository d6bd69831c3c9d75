//! Parts of a run in files: made for a range of blocks, found in a folder, put together.

use std::fs::{self, File};
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::exit::say;
use super::output::{self, Destination};
use super::{Exit, Failure, progress, run};
use gumption_engine::propagate::parts::{Merged, Merging, SharedPass, blocks as blocks_of};
use gumption_engine::propagate::{Control, Evaluation, EvaluationError};
use gumption_engine::task::Task;
use gumption_files::{
    ModelFile, SharedFileError, SharedFileHeader, SharedFileKind, SharedRun, shared_file,
    shared_file_bytes,
};
use gumption_report::plain;

/// The file that says what the next pass is to count.
pub(super) const NEXT_PASS: &str = "next-pass";

/// Into how many parts a run that can be resumed is cut: what a signal may cost is one of them.
const KEPT_PARTS: u64 = 64;

/// Ranges of blocks that a message lists, at most.
const MOST_LISTED: usize = 8;

/// Which blocks a part is to make.
#[derive(Clone, Debug)]
pub(super) enum Blocks {
    /// From the first to before the second.
    Range(u64, u64),
    /// One of so many parts of equal length, from 1.
    Share(u64, u64),
}

/// Blocks as they are written: `A..B` or `K/N`.
pub(super) fn blocks(text: &str) -> Result<Blocks, String> {
    let pair = |by: &str| {
        let (first, second) = text.split_once(by)?;
        Some((first.trim().parse::<u64>().ok()?, second.trim().parse::<u64>().ok()?))
    };
    match (pair(".."), pair("/")) {
        (Some((from, to)), _) if from < to => Ok(Blocks::Range(from, to)),
        (_, Some((part, of))) if (1..=of).contains(&part) => Ok(Blocks::Share(part, of)),
        _ => {
            Err("a range such as 0..500 (the blocks 0 to 499) is needed, or a share such as 3/16 \
                  (the third of sixteen parts)"
                .to_owned())
        }
    }
}

impl Blocks {
    /// The range among so many blocks; a range that reaches beyond the last block ends with it.
    fn of(&self, all: u64) -> Result<Range<u64>, Failure> {
        match *self {
            Self::Range(from, _) if from >= all => Err(Failure::Argument(format!(
                "`--blocks`: the run has {all} blocks (0..{all}), none of them from {from} on"
            ))),
            Self::Range(from, to) => Ok(from..to.min(all)),
            Self::Share(part, of) if of > all => Err(Failure::Argument(format!(
                "`--blocks {part}/{of}`: the run has no more than {all} blocks to share"
            ))),
            Self::Share(part, of) => {
                let at = |k: u64| (u128::from(all) * u128::from(k) / u128::from(of)) as u64;
                Ok(at(part - 1)..at(part))
            }
        }
    }
}

/// A part that is asked for.
pub(super) struct Asked<'a> {
    pub(super) blocks: &'a Blocks,
    pub(super) partial: &'a Path,
    /// The file of the pass; the first one where there is none.
    pub(super) pass: Option<&'a Path>,
    /// The files that it is made from.
    pub(super) read: Vec<PathBuf>,
    pub(super) quiet: bool,
}

/// A pass, and its bytes.
struct CurrentPass {
    pass: SharedPass,
    bytes: Vec<u8>,
}

impl CurrentPass {
    fn of(pass: SharedPass) -> Self {
        let bytes = pass.to_bytes();
        Self { pass, bytes }
    }

    fn first(file: &ModelFile, task: &Task, control: &Control<'_>) -> Result<Self, Failure> {
        let pass = SharedPass::first(task, control).map_err(|error| run::failure(file, error))?;
        Ok(Self::of(pass))
    }

    /// From a file, which must be of this run.
    fn read(path: &Path, task: &Task, run: &SharedRun) -> Result<Self, Failure> {
        let bytes = shared_file_bytes(path).map_err(|error| refused(path, &error))?;
        let (header, content) = shared_file(&bytes).map_err(|error| refused(path, &error))?;
        if header.kind != SharedFileKind::Pass {
            return Err(refused(path, &"it is a part of a run, not the file `next-pass`"));
        }
        if let Some(difference) = run.difference(&header.run) {
            return Err(refused(path, &format!("this file {difference}")));
        }
        let pass = SharedPass::from_bytes(content, task).map_err(|error| refused(path, &error))?;
        Ok(Self { pass, bytes: content.to_owned() })
    }

    /// The header of a file of this pass.
    fn header(&self, run: SharedRun, kind: SharedFileKind) -> SharedFileHeader {
        SharedFileHeader::new(run, self.pass.number(), &self.bytes, kind)
    }
}

/// Why a file is not taken.
fn refused(path: &Path, reason: &dyn std::fmt::Display) -> Failure {
    Failure::Argument(format!("{}: {reason}", path.display()))
}

fn shared_blocks(task: &Task) -> Result<u64, Failure> {
    blocks_of(task).map_err(|reason| Failure::Argument(reason.to_string()))
}

/// `gumption run --blocks`
pub(super) fn make(
    file: &ModelFile,
    task: &Task,
    run: SharedRun,
    asked: Asked<'_>,
    control: &Control<'_>,
) -> Result<Exit, Failure> {
    let range = asked.blocks.of(shared_blocks(task)?)?;
    let mut read = asked.read;
    read.extend(asked.pass.map(Path::to_owned));
    let [destination] = output::open([("--partial", Some(asked.partial))], &read)?;
    let current = match asked.pass {
        Some(path) => CurrentPass::read(path, task, &run)?,
        None => CurrentPass::first(file, task, control)?,
    };
    let bar = progress::bar(None, asked.quiet);
    let advance = |trials: u64| bar.inc(trials);
    let found = current.pass.part(task, range.clone(), &control.with_progress(&advance));
    bar.finish_and_clear();
    let Some(part) = found.map_err(|error| run::failure(file, error))? else {
        say("gumption: interrupted, the part is not written\n");
        return Ok(Exit::Interrupted);
    };
    let content = current.header(run, SharedFileKind::Part(range)).file(&part);
    if let Some(destination) = destination {
        destination.write_with(|out| out.write_all(&content).map(|()| true))?;
    }
    Ok(Exit::Done)
}

/// The parts of a run that are in a folder.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// Whether there is a file that says what the pass is to count.
    has_pass: bool,
    parts: Vec<(PathBuf, SharedFileHeader)>,
    /// Files that are none.
    others: usize,
}

/// An evaluation with the quantiles that a result file holds, where they took passes.
pub(super) type WithQuantiles = (Box<Evaluation>, Option<Vec<Vec<f64>>>);

/// What was made of the parts.
pub(super) enum Together {
    /// With the quantiles that a result file holds, where they took passes.
    Evaluation(Box<Evaluation>, Option<Vec<Vec<f64>>>),
    /// The next pass.
    Again(SharedPass),
}

impl Folder {
    /// Looks at the headers of all files in a folder.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let failed = |error: std::io::Error| {
            Failure::Argument(format!("cannot read the folder `{}`: {error}", path.display()))
        };
        let mut names: Vec<PathBuf> = Vec::new();
        for entry in fs::read_dir(path).map_err(failed)? {
            names.push(entry.map_err(failed)?.path());
        }
        // messages are the same every time
        names.sort();
        let mut found =
            Self { path: path.to_owned(), has_pass: false, parts: Vec::new(), others: 0 };
        for name in names.into_iter().filter(|name| name.is_file()) {
            let file = File::open(&name).map_err(|error| refused(&name, &error))?;
            match SharedFileHeader::read(&mut BufReader::new(file)) {
                Ok(header) if header.kind == SharedFileKind::Pass => {
                    found.has_pass |= name.ends_with(NEXT_PASS);
                }
                Ok(header) => found.parts.push((name, header)),
                Err(SharedFileError::Other) => found.others += 1,
                Err(error) => return Err(refused(&name, &error)),
            }
        }
        Ok(found)
    }

    /// The run that the folder is of.
    pub(super) fn run(&self) -> Result<SharedRun, Failure> {
        if self.has_pass {
            let path = self.next_pass();
            let bytes = shared_file_bytes(&path).map_err(|error| refused(&path, &error))?;
            let (header, _) = shared_file(&bytes).map_err(|error| refused(&path, &error))?;
            return Ok(header.run);
        }
        let Some((_, header)) = self.parts.first() else {
            let others = match self.others {
                0 => String::new(),
                others => format!(" ({others} other files)"),
            };
            return Err(Failure::Argument(format!(
                "the folder `{}` holds no part of a run{others}; make them with `gumption run MODEL \
                 --blocks A..B --partial FILE`",
                self.path.display()
            )));
        };
        Ok(header.run.clone())
    }

    /// The files that an answer is made from.
    pub(super) fn files(&self) -> impl Iterator<Item = PathBuf> + '_ {
        self.parts.iter().map(|(path, _)| path.clone()).chain([self.next_pass()])
    }

    fn next_pass(&self) -> PathBuf {
        self.path.join(NEXT_PASS)
    }

    /// The pass that is under way.
    fn current(
        &self,
        file: &ModelFile,
        task: &Task,
        run: &SharedRun,
        control: &Control<'_>,
    ) -> Result<CurrentPass, Failure> {
        if self.has_pass {
            CurrentPass::read(&self.next_pass(), task, run)
        } else {
            CurrentPass::first(file, task, control)
        }
    }

    /// The parts of that pass in the order of their blocks; those of passes before it are not needed.
    fn parts_of(
        &self,
        current: &CurrentPass,
        run: &SharedRun,
        all: u64,
    ) -> Result<Vec<(&Path, Range<u64>)>, Failure> {
        let number = current.pass.number();
        let digest = current.header(run.clone(), SharedFileKind::Pass).pass_digest;
        let mut found: Vec<(&Path, Range<u64>)> = Vec::new();
        for (path, header) in &self.parts {
            if let Some(difference) = run.difference(&header.run) {
                return Err(refused(path, &format!("this part {difference}")));
            }
            let SharedFileKind::Part(range) = &header.kind else { continue };
            if header.pass < number {
                continue;
            }
            if header.pass != number || header.pass_digest != digest {
                let reason = format!(
                    "this part is of another pass over the blocks (number {}, and the folder is at \
                     number {number}); make it again with `--pass {}`",
                    header.pass,
                    self.next_pass().display()
                );
                return Err(refused(path, &reason));
            }
            if range.is_empty() || range.end > all {
                return Err(refused(path, &format!("it has blocks that the run of {all} has not")));
            }
            found.push((path, range.clone()));
        }
        found.sort_by_key(|(_, range)| range.start);
        for pair in found.windows(2) {
            let [(first, a), (second, b)] = pair else { continue };
            if b.start < a.end {
                let reason = format!(
                    "the blocks {}..{} are in `{}` too; leave one of the two",
                    b.start,
                    a.end.min(b.end),
                    first.display()
                );
                return Err(refused(second, &reason));
            }
        }
        Ok(found)
    }

    /// Puts the parts together.
    pub(super) fn merge(
        &self,
        file: &ModelFile,
        task: &Task,
        run: &SharedRun,
        with_quantiles: bool,
        control: &Control<'_>,
    ) -> Result<Together, Failure> {
        let all = shared_blocks(task)?;
        let current = self.current(file, task, run, control)?;
        let parts = self.parts_of(&current, run, all)?;
        let missing = missing(&parts, all);
        if !missing.is_empty() {
            return Err(self.incomplete(&missing, all, current.pass.number()));
        }
        let evaluated = |error: EvaluationError| run::failure(file, error);
        // half an answer would be none
        let mut whole = *control;
        whole.stop = None;
        let mut merging = Merging::new(task, &current.pass, whole).map_err(evaluated)?;
        for (path, range) in parts {
            let bytes = shared_file_bytes(path).map_err(|error| refused(path, &error))?;
            let (_, content) = shared_file(&bytes).map_err(|error| refused(path, &error))?;
            merging.add(range, content).map_err(|error| refused(path, &error))?;
        }
        Ok(match merging.finish(with_quantiles).map_err(evaluated)? {
            Merged::Evaluation(evaluation, quantiles) => {
                Together::Evaluation(evaluation, quantiles)
            }
            Merged::Again(next) => Together::Again(next),
            other => {
                return Err(Failure::System(format!("parts gave what is not known: {other:?}")));
            }
        })
    }

    /// Says which blocks are missing.
    fn incomplete(&self, missing: &[Range<u64>], all: u64, number: u64) -> Failure {
        let listed: Vec<String> = missing
            .iter()
            .take(MOST_LISTED)
            .map(|range| format!("{}..{}", range.start, range.end))
            .collect();
        let more = match missing.len().saturating_sub(MOST_LISTED) {
            0 => String::new(),
            more => format!(" and {more} more ranges"),
        };
        let pass = if self.has_pass {
            format!(" --pass {}", self.next_pass().display())
        } else {
            String::new()
        };
        Failure::Argument(format!(
            "the folder `{}` lacks blocks of pass {number} over the run's {all}: {}{more}; make them \
             with `gumption run MODEL --blocks {} --partial FILE{pass}`",
            self.path.display(),
            listed.join(", "),
            listed.first().map_or("", String::as_str)
        ))
    }

    /// Writes what the next pass is to count.
    pub(super) fn write_next(&self, run: SharedRun, next: SharedPass) -> Result<(), Failure> {
        let next = CurrentPass::of(next);
        let content = next.header(run, SharedFileKind::Pass).file(&next.bytes);
        write(&self.next_pass(), &content)
    }
}

/// Which of all blocks no part has; the parts are in order.
fn missing(parts: &[(&Path, Range<u64>)], all: u64) -> Vec<Range<u64>> {
    let mut missing = Vec::new();
    let mut next = 0;
    for (_, range) in parts {
        if range.start > next {
            missing.push(next..range.start);
        }
        next = range.end;
    }
    if next < all {
        missing.push(next..all);
    }
    missing
}

/// Writes a file that is there whole or not at all.
fn write(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let destination = Destination::open(path)?;
    destination.write_with(|out| out.write_all(content).map(|()| true))
}

/// Makes a run in parts that are kept in a folder, from those that are there on; `None` if it was
/// stopped.
pub(super) fn resume(
    file: &ModelFile,
    task: &Task,
    run: SharedRun,
    (path, with_quantiles): (&Path, bool),
    control: &Control<'_>,
    quiet: bool,
) -> Result<Option<WithQuantiles>, Failure> {
    let all = shared_blocks(task)?;
    fs::create_dir_all(path).map_err(|error| {
        let path = plain(&path.display().to_string());
        Failure::System(format!("cannot make the folder `{path}`: {error}"))
    })?;
    loop {
        let folder = Folder::open(path)?;
        let current = folder.current(file, task, &run, control)?;
        let number = current.pass.number();
        let missing = missing(&folder.parts_of(&current, &run, all)?, all);
        let length = all.div_ceil(KEPT_PARTS).max(1);
        let pieces: Vec<Range<u64>> =
            missing.into_iter().flat_map(|range| pieces(range, length)).collect();
        let bar = progress::counted(pieces.len() as u64, "parts", quiet);
        for range in pieces {
            let part = current.pass.part(task, range.clone(), control);
            let Some(part) = part.map_err(|error| run::failure(file, error))? else {
                bar.finish_and_clear();
                let path = plain(&path.display().to_string());
                say(&format!("gumption: interrupted; what was made is in `{path}`\n"));
                return Ok(None);
            };
            let name = path.join(format!("part-{number}-{}-{}", range.start, range.end));
            let header = current.header(run.clone(), SharedFileKind::Part(range));
            write(&name, &header.file(&part))?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        match Folder::open(path)?.merge(file, task, &run, with_quantiles, control)? {
            Together::Evaluation(evaluation, quantiles) => {
                return Ok(Some((evaluation, quantiles)));
            }
            Together::Again(next) => {
                let folder = Folder::open(path)?;
                folder.write_next(run.clone(), next)?;
                folder.remove_made_before(number)?;
            }
        }
    }
}

impl Folder {
    /// Removes the parts that [`resume`] made for a pass that is merged.
    fn remove_made_before(&self, number: u64) -> Result<(), Failure> {
        let prefix = format!("part-{number}-");
        for (path, header) in &self.parts {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if header.pass == number && name.starts_with(&prefix) {
                fs::remove_file(path).map_err(|error| {
                    Failure::System(format!("cannot remove `{}`: {error}", path.display()))
                })?;
            }
        }
        Ok(())
    }
}

/// A range cut at the multiples of a length.
fn pieces(range: Range<u64>, length: u64) -> impl Iterator<Item = Range<u64>> {
    let mut next = range.start;
    std::iter::from_fn(move || {
        let start = next;
        next = ((start / length + 1) * length).min(range.end);
        (start < range.end).then_some(start..next)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_ranges_or_shares() {
        let of = |text: &str| blocks(text).unwrap().of(977).ok();
        assert_eq!(of("0..500"), Some(0..500));
        assert_eq!(of("500..2000"), Some(500..977));
        assert_eq!(of("977..978"), None);
        assert_eq!(of("1/3"), Some(0..325));
        assert_eq!(of("3/3"), Some(651..977));
        assert_eq!(of("1/978"), None);
        for wrong in ["", "5", "5..5", "7..3", "0/3", "4/3", "1/0", "-1..3", "a..b", "1..2..3"] {
            assert!(blocks(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn missing_blocks_are_cut_at_the_same_places_every_time() {
        let path = Path::new("p");
        let parts = [(path, 2..5), (path, 5..7), (path, 30..40)];
        assert_eq!(missing(&parts, 42), [0..2, 7..30, 40..42]);
        assert_eq!(pieces(7..30, 10).collect::<Vec<_>>(), [7..10, 10..20, 20..30]);
        assert_eq!(pieces(3..3, 10).count(), 0);
    }
}
