//! Parts of a run in files: made for a range of blocks, found in a folder, merged.

use std::fs::{self, File};
use std::io::BufReader;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::exit::say;
use super::output::{self, Destination};
use super::parted_run::{MergedRun, PartedRun, PassOfRun, refused};
use super::{Exit, Failure, progress};
use gumption_columns::read_failure;
use gumption_engine::number::smallest_first;
use gumption_engine::propagate::{Control, Evaluation};
use gumption_files::{
    SharedFileError, SharedFileHeader, SharedFileKind, SharedRun, shared_file, shared_file_bytes,
};
use gumption_report::plain;

/// The file that describes the next pass.
pub(super) const NEXT_PASS: &str = "next-pass";

/// Number of parts of a run that can be resumed: a signal loses at most one of them.
const KEPT_PARTS: u64 = 64;

/// Maximum number of ranges of blocks that a message lists.
const MOST_LISTED: usize = 8;

/// The blocks, or other counted things, that a part contains.
#[derive(Clone, Debug)]
pub(super) enum Blocks {
    /// From the first up to, but not including, the second.
    Range(u64, u64),
    /// One of several parts of equal length, from 1.
    Share(u64, u64),
}

/// Parses blocks: `A..B` or `K/N`.
pub(super) fn blocks(text: &str) -> Result<Blocks, String> {
    let pair = |by: &str| {
        let (first, second) = text.split_once(by)?;
        Some((first.trim().parse::<u64>().ok()?, second.trim().parse::<u64>().ok()?))
    };
    match (pair(".."), pair("/")) {
        (Some((from, to)), _) if from < to => Ok(Blocks::Range(from, to)),
        (_, Some((part, of))) if (1..=of).contains(&part) => Ok(Blocks::Share(part, of)),
        _ => Err("a range such as 0..500 (the first 500) is needed, or a share such as 3/16 \
                  (the third of sixteen parts)"
            .to_owned()),
    }
}

impl Blocks {
    /// The range among `all`; a range beyond the last one is cut. The option and the word for the
    /// counted things are for messages.
    pub(super) fn of(&self, all: u64, (option, what): (&str, &str)) -> Result<Range<u64>, Failure> {
        match *self {
            Self::Range(from, _) if from >= all => Err(Failure::Argument(format!(
                "`{option}`: the run has only {all} {what} (0..{all}), none from {from} on"
            ))),
            Self::Range(from, to) => Ok(from..to.min(all)),
            Self::Share(part, of) if of > all => Err(Failure::Argument(format!(
                "`{option} {part}/{of}`: the run has only {all} {what} to share"
            ))),
            Self::Share(part, of) => {
                let at = |k: u64| (u128::from(all) * u128::from(k) / u128::from(of)) as u64;
                Ok(at(part - 1)..at(part))
            }
        }
    }
}

/// A requested part.
pub(super) struct AskedPart<'a> {
    pub(super) blocks: &'a Blocks,
    pub(super) partial: &'a Path,
    /// The file of the pass; `None` for the first pass.
    pub(super) pass: Option<&'a Path>,
    /// The files from which it is made.
    pub(super) read: Vec<PathBuf>,
    pub(super) quiet: bool,
}

/// `gumption run --blocks`
pub(super) fn make(
    run: PartedRun<'_>,
    asked: AskedPart<'_>,
    control: &Control<'_>,
) -> Result<Exit, Failure> {
    let range = asked.blocks.of(run.blocks()?, ("--blocks", "blocks"))?;
    let mut read = asked.read;
    read.extend(asked.pass.map(Path::to_owned));
    let [destination] = output::open([("--partial", Some(asked.partial))], &read)?;
    let pass = match asked.pass {
        Some(path) => pass_of(&run, path)?,
        None => run.first(control)?,
    };
    let bar = progress::bar(None, asked.quiet);
    let advance = |trials: u64| bar.inc(trials);
    let found = run.part(&pass, range, &control.with_progress(&advance));
    bar.finish_and_clear();
    let Some(part) = found? else {
        say("gumption: interrupted, the part is not written\n");
        return Ok(Exit::Interrupted);
    };
    if let Some(destination) = destination {
        destination.write_with(|out| out.write_all(&part).map(|()| true))?;
    }
    Ok(Exit::Done)
}

/// The content of a file of a shared run.
fn content(path: &Path) -> Result<Vec<u8>, Failure> {
    shared_file_bytes(path).map_err(|error| refused(&path.display(), &error))
}

/// The pass in a file, which must belong to this run.
fn pass_of(run: &PartedRun<'_>, path: &Path) -> Result<PassOfRun, Failure> {
    run.pass(&path.display(), &content(path)?)
}

/// The parts of a run in a folder.
#[derive(Debug)]
pub struct PartsFolder {
    path: PathBuf,
    /// Whether there is a file that describes the pass.
    has_pass: bool,
    parts: Vec<(PathBuf, SharedFileHeader)>,
    /// The number of files that are not parts.
    others: usize,
}

/// An evaluation with the quantiles for a result file, if they needed passes.
pub(super) type WithQuantiles = (Box<Evaluation>, Option<Vec<Vec<f64>>>);

impl PartsFolder {
    /// Reads the headers of all files in a folder.
    ///
    /// # Errors
    /// A folder or one of its files cannot be read; damaged parts.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        if path.is_file() {
            return Err(Failure::Argument(format!(
                "`{0}` is a file, but the parts of a run are in a folder, into which `gumption \
                 run MODEL --blocks … --partial FILE` writes them; `gumption check {0}` describes \
                 the file",
                path.display()
            )));
        }
        let failed = |error: std::io::Error| {
            let reason = read_failure::of_folder(path, &error);
            Failure::Argument(format!("`{}`: {reason}", path.display()))
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
            let unread = |error| refused(&name.display(), &read_failure::of_file(&name, &error));
            let file = File::open(&name).map_err(unread)?;
            match SharedFileHeader::read(&mut BufReader::new(file)) {
                Ok(header) if header.kind == SharedFileKind::Pass => {
                    found.has_pass |= name.ends_with(NEXT_PASS);
                }
                Ok(header) => found.parts.push((name, header)),
                Err(SharedFileError::Other) => found.others += 1,
                Err(error) => return Err(refused(&name.display(), &error)),
            }
        }
        Ok(found)
    }

    /// The same for a folder that is created if it does not exist.
    ///
    /// # Errors
    /// The errors of [`PartsFolder::open`], or the folder cannot be created.
    pub fn made(path: &Path) -> Result<Self, Failure> {
        fs::create_dir_all(path).map_err(|error| {
            let path = plain(&path.display().to_string());
            let reason = read_failure::in_words(&error);
            Failure::System(format!("cannot create the folder `{path}`: {reason}"))
        })?;
        Self::open(path)
    }

    /// The run to which the folder belongs.
    pub(super) fn run(&self) -> Result<SharedRun, Failure> {
        if self.has_pass {
            let path = self.next_pass();
            let bytes =
                shared_file_bytes(&path).map_err(|error| refused(&path.display(), &error))?;
            let (header, _) =
                shared_file(&bytes).map_err(|error| refused(&path.display(), &error))?;
            return Ok(header.run);
        }
        let Some((_, header)) = self.parts.first() else {
            let others = match self.others {
                0 => String::new(),
                others => format!(" ({others} other files)"),
            };
            return Err(Failure::Argument(format!(
                "the folder `{}` contains no part of a run{others}; make parts with `gumption run \
                 MODEL \
                 --blocks A..B --partial FILE`",
                self.path.display()
            )));
        };
        Ok(header.run.clone())
    }

    /// The files from which an answer is computed.
    pub(super) fn files(&self) -> impl Iterator<Item = PathBuf> + '_ {
        self.parts.iter().map(|(path, _)| path.clone()).chain([self.next_pass()])
    }

    fn next_pass(&self) -> PathBuf {
        self.path.join(NEXT_PASS)
    }

    /// The current pass.
    ///
    /// # Errors
    /// A file `next-pass` of another run.
    pub fn pass(&self, run: &PartedRun<'_>, control: &Control<'_>) -> Result<PassOfRun, Failure> {
        if self.has_pass { pass_of(run, &self.next_pass()) } else { run.first(control) }
    }

    /// The parts of the current pass in the order of their blocks; parts of earlier passes are not
    /// needed.
    ///
    /// # Errors
    /// Parts of another run, or blocks that occur twice.
    pub fn parts(
        &self,
        run: &PartedRun<'_>,
        pass: &PassOfRun,
    ) -> Result<Vec<(&Path, Range<u64>)>, Failure> {
        let again = format!(" with `--pass {}`", self.next_pass().display());
        let mut found: Vec<(&Path, Range<u64>)> = Vec::new();
        for (path, header) in &self.parts {
            let range = run.range(pass, &path.display(), header, &again)?;
            found.extend(range.map(|range| (path.as_path(), range)));
        }
        smallest_first(&mut found, |(_, range)| range.start as f64);
        for pair in found.windows(2) {
            let [(first, a), (second, b)] = pair else { continue };
            if b.start < a.end {
                let reason = format!(
                    "the blocks {}..{} are also in `{}`; remove one of the two",
                    b.start,
                    a.end.min(b.end),
                    first.display()
                );
                return Err(refused(&second.display(), &reason));
            }
        }
        Ok(found)
    }

    /// Puts the parts together.
    pub(super) fn merge(
        &self,
        run: &PartedRun<'_>,
        with_quantiles: bool,
        control: &Control<'_>,
    ) -> Result<MergedRun, Failure> {
        let pass = self.pass(run, control)?;
        let parts = self.parts(run, &pass)?;
        let all = run.blocks()?;
        let missing = missing(&parts, all);
        if missing.is_empty() {
            return self.merge_pass(run, (&pass, parts), with_quantiles, control);
        }
        // a further pass may be needed only for `--save`
        if self.has_pass && !with_quantiles {
            let first = run.first(control)?;
            if let Ok(parts) = self.parts(run, &first)
                && self::missing(&parts, all).is_empty()
                && let found @ MergedRun::Evaluation(..) =
                    self.merge_pass(run, (&first, parts), with_quantiles, control)?
            {
                return Ok(found);
            }
        }
        Err(self.incomplete(&missing, all, pass.number()))
    }

    /// Merges all parts of a pass.
    fn merge_pass(
        &self,
        run: &PartedRun<'_>,
        (pass, parts): (&PassOfRun, Vec<(&Path, Range<u64>)>),
        with_quantiles: bool,
        control: &Control<'_>,
    ) -> Result<MergedRun, Failure> {
        // half an answer would be useless
        let mut whole = *control;
        whole.stop = None;
        let mut merging = run.merging(pass, whole)?;
        for (path, _) in parts {
            merging.add(&path.display(), &content(path)?)?;
        }
        merging.finish(with_quantiles)
    }

    /// Says which blocks are missing.
    fn incomplete(&self, missing: &[Range<u64>], all: u64, number: u64) -> Failure {
        let first =
            missing.first().map_or_else(String::new, |of| format!("{}..{}", of.start, of.end));
        let pass = if self.has_pass {
            format!(" --pass {}", self.next_pass().display())
        } else {
            String::new()
        };
        Failure::Argument(format!(
            "the folder `{}` lacks blocks of pass {number} over the run's {all}: {}; make them with \
             `gumption run MODEL --blocks {first} --partial FILE{pass}`",
            self.path.display(),
            ranges(missing),
        ))
    }

    /// Writes the description of the next pass.
    ///
    /// # Errors
    /// The error of the system.
    pub fn write_next(&self, run: &SharedRun, next: &PassOfRun) -> Result<(), Failure> {
        write(&self.next_pass(), &next.file(run))
    }

    /// Removes the parts that were kept for a merged pass.
    ///
    /// # Errors
    /// The error of the system.
    pub fn remove_kept(&self, number: u64) -> Result<(), Failure> {
        let prefix = kept_prefix(number);
        for (path, header) in &self.parts {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if header.pass == number && name.starts_with(&prefix) {
                fs::remove_file(path).map_err(|error| {
                    let reason = read_failure::in_words(&error);
                    Failure::System(format!("cannot remove `{}`: {reason}", path.display()))
                })?;
            }
        }
        Ok(())
    }
}

impl PartedRun<'_> {
    /// Stores the file of a part in a folder, under a name that identifies it.
    ///
    /// # Errors
    /// The file is not a part, or the system reports an error.
    pub fn keep(&self, folder: &Path, part: &[u8]) -> Result<(), Failure> {
        let header = SharedFileHeader::read(&mut &*part);
        let header = header.map_err(|error| refused(&"a part", &error))?;
        let SharedFileKind::Part(range) = &header.kind else {
            return Err(refused(&"a part", &"it is a pass"));
        };
        let name = format!("{}{}-{}", kept_prefix(header.pass), range.start, range.end);
        write(&folder.join(name), part)
    }
}

/// The prefix of the names of parts that are kept for a pass.
fn kept_prefix(pass: u64) -> String {
    format!("part-{pass}-")
}

/// The blocks that no part contains; the parts are in order.
pub(super) fn missing<T>(parts: &[(T, Range<u64>)], all: u64) -> Vec<Range<u64>> {
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

/// Ranges as a message lists them.
pub(super) fn ranges(of: &[Range<u64>]) -> String {
    let shown = |range: &Range<u64>| format!("{}..{}", range.start, range.end);
    let listed: Vec<String> = of.iter().take(MOST_LISTED).map(shown).collect();
    let more = match of.len().saturating_sub(MOST_LISTED) {
        0 => String::new(),
        more => format!(" and {more} more ranges"),
    };
    listed.join(", ") + &more
}

/// Writes a file completely or not at all.
pub(super) fn write(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let destination = Destination::open(path)?;
    destination.write_with(|out| out.write_all(content).map(|()| true))
}

/// Makes a run in parts that are kept in a folder, and continues from the parts in it; `None` if it
/// was stopped.
pub(super) fn resume(
    run: PartedRun<'_>,
    (path, with_quantiles): (&Path, bool),
    control: &Control<'_>,
    quiet: bool,
) -> Result<Option<WithQuantiles>, Failure> {
    let all = run.blocks()?;
    loop {
        let folder = PartsFolder::made(path)?;
        let pass = folder.pass(&run, control)?;
        let missing = missing(&folder.parts(&run, &pass)?, all);
        let length = all.div_ceil(KEPT_PARTS).max(1);
        let pieces: Vec<Range<u64>> =
            missing.into_iter().flat_map(|range| pieces(range, length)).collect();
        let bar = progress::counted(pieces.len() as u64, "parts", quiet);
        for range in pieces {
            let Some(part) = run.part(&pass, range, control)? else {
                bar.finish_and_clear();
                let path = plain(&path.display().to_string());
                say(&format!("gumption: interrupted; the parts made so far are in `{path}`\n"));
                return Ok(None);
            };
            run.keep(path, &part)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        let folder = PartsFolder::open(path)?;
        match folder.merge(&run, with_quantiles, control)? {
            MergedRun::Evaluation(evaluation, quantiles) => {
                return Ok(Some((evaluation, quantiles)));
            }
            MergedRun::Again(next) => {
                folder.write_next(run.run, &next)?;
                folder.remove_kept(pass.number())?;
            }
        }
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
        let of = |text: &str| blocks(text).unwrap().of(977, ("--blocks", "blocks")).ok();
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
