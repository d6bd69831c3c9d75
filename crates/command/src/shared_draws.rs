//! Draws of a blind test in files: made for a range of them, found in a folder, merged.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::Failure;
use super::parted_run::refused;
use super::parts::{missing, ranges};
use gumption_columns::read_failure;
use gumption_engine::number::smallest_first;
use gumption_files::CaseFile;
use gumption_gap::check::{BlindDraw, CheckedNoise};
use gumption_text::bytes;
use gumption_text::bytes::sha256;

/// The test to which draws belong: everything that they depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SharedCheck {
    /// The version of this program.
    gumption: String,
    /// The digest of the case's text.
    case_sha256: String,
    /// Names and digests of the files that the case names.
    files: Vec<(String, String)>,
    seed: u64,
    /// The number of draws of the whole test.
    draws: u64,
    /// How their noise is drawn.
    #[serde(default)]
    noise: CheckedNoise,
}

/// Some of the draws.
#[derive(Debug, Serialize, Deserialize)]
struct DrawsPart {
    blind_check: SharedCheck,
    /// The first one, and the one after the last.
    range: [u64; 2],
    checked: Vec<BlindDraw>,
}

/// A range of draws, and their results.
type DrawsOfRange = (Range<u64>, Vec<BlindDraw>);

impl SharedCheck {
    pub(super) fn new(file: &CaseFile, seed: u64, draws: u64, noise: CheckedNoise) -> Self {
        let digest = |(name, bytes): &(String, Vec<u8>)| (name.clone(), sha256(bytes));
        Self {
            gumption: env!("CARGO_PKG_VERSION").to_owned(),
            case_sha256: sha256(file.source.text.as_bytes()),
            files: file.files.iter().map(digest).collect(),
            seed,
            draws,
            noise,
        }
    }

    /// The difference between another test and this one, as the end of a sentence.
    fn difference(&self, other: &Self) -> Option<String> {
        Some(if self.gumption != other.gumption {
            format!("were made by gumption {}, not {}", other.gumption, self.gumption)
        } else if self.case_sha256 != other.case_sha256 {
            "are of another case".to_owned()
        } else if self.files != other.files {
            "belong to a case whose files had other contents".to_owned()
        } else if self.seed != other.seed {
            format!("have the seed {}, not {}", other.seed, self.seed)
        } else if self.draws != other.draws {
            format!("belong to a test of {} draws, not {}", other.draws, self.draws)
        } else if self.noise != other.noise {
            "have another kind of noise (`--noise`)".to_owned()
        } else {
            return None;
        })
    }

    /// The file of some draws: a line, and its digest.
    pub(super) fn file(
        &self,
        range: &Range<u64>,
        checked: Vec<BlindDraw>,
    ) -> Result<String, Failure> {
        let range = [range.start, range.end];
        let part = DrawsPart { blind_check: self.clone(), range, checked };
        let line = serde_json::to_string(&part);
        let line = line.map_err(|error| Failure::System(format!("cannot write draws: {error}")))?;
        // numbers that JSON does not have would be lost
        let again =
            serde_json::from_str::<DrawsPart>(&line).is_ok_and(|of| of.checked == part.checked);
        if !again {
            let reason = "a draw has a value that is not finite, so it cannot be stored";
            return Err(Failure::System(reason.to_owned()));
        }
        let digest = sha256(line.as_bytes());
        Ok(format!("{line}\n{digest}\n"))
    }

    /// The draws of a file, with their range; `None` for another kind of file.
    fn read(&self, path: &Path) -> Result<Option<DrawsOfRange>, Failure> {
        let refuse = |reason: &dyn std::fmt::Display| refused(&path.display(), reason);
        let content = bytes::of_file(path, bytes::MOST).map_err(|reason| refuse(&reason))?;
        if !content.starts_with(b"{\"blind_check\":") {
            return Ok(None);
        }
        let text = std::str::from_utf8(&content).unwrap_or_default();
        let whole = text.strip_suffix('\n').and_then(|text| text.split_once('\n'));
        let line = whole.filter(|(line, digest)| sha256(line.as_bytes()) == *digest);
        let Some((line, _)) = line else {
            return Err(refuse(&"its content does not match its SHA-256; make it again"));
        };
        let part: DrawsPart = serde_json::from_str(line).map_err(|error| refuse(&error))?;
        if let Some(difference) = self.difference(&part.blind_check) {
            return Err(refuse(&format!("these draws {difference}")));
        }
        let [start, end] = part.range;
        if start >= end || end > self.draws || part.checked.len() as u64 != end - start {
            return Err(refuse(&format!(
                "it has draws that the test of {} does not have",
                self.draws
            )));
        }
        Ok(Some((start..end, part.checked)))
    }

    /// All draws, from the files in a folder.
    pub(super) fn together(&self, folder: &Path) -> Result<Vec<BlindDraw>, Failure> {
        let failed = |error: std::io::Error| {
            let reason = read_failure::of_folder(folder, &error);
            Failure::Argument(format!("`{}`: {reason}", folder.display()))
        };
        let mut names: Vec<PathBuf> = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            names.push(entry.map_err(failed)?.path());
        }
        // messages are the same every time
        names.sort();
        let mut found: Vec<(PathBuf, Range<u64>)> = Vec::new();
        let mut all: Vec<(u64, Vec<BlindDraw>)> = Vec::new();
        for name in names.into_iter().filter(|name| name.is_file()) {
            if let Some((range, checked)) = self.read(&name)? {
                all.push((range.start, checked));
                found.push((name, range));
            }
        }
        smallest_first(&mut found, |(_, range)| range.start as f64);
        smallest_first(&mut all, |(start, _)| *start as f64);
        for pair in found.windows(2) {
            let [(first, a), (second, b)] = pair else { continue };
            if b.start < a.end {
                let reason = format!(
                    "the draws {}..{} are also in `{}`; remove one of the two",
                    b.start,
                    a.end.min(b.end),
                    first.display()
                );
                return Err(refused(&second.display(), &reason));
            }
        }
        let missing = missing(&found, self.draws);
        if let Some(first) = missing.first() {
            return Err(Failure::Argument(format!(
                "the folder `{}` lacks draws of the check's {}: {}; make them with `gumption \
                 gap-check CASE --draws {}{} --share {}..{} --partial FILE`",
                folder.display(),
                self.draws,
                ranges(&missing),
                self.draws,
                if self.noise == CheckedNoise::Uncertain { " --noise uncertain" } else { "" },
                first.start,
                first.end
            )));
        }
        Ok(all.into_iter().flat_map(|(_, checked)| checked).collect())
    }
}
