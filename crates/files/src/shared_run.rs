//! Parts of a run in files: what `gumption run --partial` writes, and the file `next-pass` that says
//! what the next pass is to count.
//!
//! A file is a line that says what it is, the version of the form, a header in JSON, the part or the
//! pass as the engine wrote it, and the SHA-256 of all of that. The header says which run it belongs
//! to: the model file with the digests of the files that it names, what the command line put in its
//! place, the version of this program. Parts of different runs are never put together.

use std::fmt;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use serde_json::{Map, Value, json};

use super::model_file::ModelFile;
use super::overrides::Override;
use super::reader::FileReader;
use super::readings_file::ReadingsFile;
use gumption_engine::task::{
    Coverage, MethodChoice, Settings, StatementMethod, StoppingRule, Trials,
};
use gumption_text::bytes::sha256;
use gumption_text::{Diagnostics, bytes};

/// The first bytes of every such file.
const MAGIC: &[u8] = b"gumption part\n";

/// The version of the form.
const FORM: u8 = 3;

/// Bytes of a header, at most: a model file and the names of those that it names.
const MOST_HEADER: u32 = 80_000_000;

/// Bytes of a file, at most.
const MOST: u64 = 1 << 40;

/// Hexadecimal digits of a digest.
const DIGEST: usize = 64;

/// The folder of a model that names no files.
const NOWHERE: &str = "/dev/null";

/// The run that parts belong to: all that its figures depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedRun {
    /// The version of this program that made it.
    pub version: String,
    /// Where the model file was; `None` of standard input.
    pub model_path: Option<String>,
    /// The text of the model file.
    pub text: String,
    /// The digests of the files that it names, by their names as it has them.
    pub files: Vec<(String, String)>,
    /// The file of readings that replace those of the model: its name among `files` and its content.
    pub readings: Option<(String, Vec<u8>)>,
    /// Values in place of some of the file's, as they were given.
    pub set: Vec<String>,
    /// The settings, those of the command line included.
    pub settings: Settings,
    /// Bytes of trial values that may be kept at a time.
    pub memory: usize,
}

/// What a file of a shared run is.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SharedFileKind {
    /// The part of a range of the run's blocks.
    Part(Range<u64>),
    /// What a pass is to count.
    Pass,
}

/// The header of a file of a shared run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SharedFileHeader {
    /// The run.
    pub run: SharedRun,
    /// The number of the pass, from 1.
    pub pass: u64,
    /// The digest of the pass as bytes.
    pub pass_digest: String,
    /// What it is.
    pub kind: SharedFileKind,
}

/// Why a file is no part of a shared run, or of none that can be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum SharedFileError {
    /// The system cannot read it.
    Io(io::Error),
    /// It is another kind of file.
    Other,
    /// It is not whole, or was changed.
    Damaged(&'static str),
    /// It was written by a newer version of this program.
    Newer,
}

impl fmt::Display for SharedFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => error.fmt(f),
            Self::Other => f.write_str("it is no part of a run"),
            Self::Damaged(what) => write!(f, "it is damaged: {what}; make it again"),
            Self::Newer => f.write_str("it was written by a newer version of gumption"),
        }
    }
}

impl std::error::Error for SharedFileError {}

impl From<io::Error> for SharedFileError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::Damaged("it ends too early"),
            _ => Self::Io(error),
        }
    }
}

/// Why the model of a shared run cannot be read again.
#[derive(Debug)]
#[non_exhaustive]
pub enum SharedModelError {
    /// Its file has mistakes, or is gone.
    Model(Diagnostics),
    /// It is not what it was; the sentence says what.
    Changed(String),
}

impl fmt::Display for SharedModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Model(diagnostics) => diagnostics.fmt(f),
            Self::Changed(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for SharedModelError {}

impl SharedRun {
    /// The run of a model file with these settings in place of its own; `path` is `None` of standard
    /// input.
    pub fn new(
        file: &ModelFile,
        path: Option<&Path>,
        set: &[Override],
        settings: &Settings,
        memory: usize,
    ) -> Self {
        let path = path.map(|path| path.canonicalize().unwrap_or_else(|_| path.to_owned()));
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            model_path: path.map(|path| path.to_string_lossy().into_owned()),
            text: file.source.text.clone(),
            files: digests(&file.files),
            readings: file
                .readings
                .file
                .as_ref()
                .and_then(|name| file.files.iter().find(|(known, _)| known == name).cloned()),
            set: set.iter().map(|set| set.text.clone()).collect(),
            settings: *settings,
            memory,
        }
    }

    /// The model of the run, read again, with the run's settings: from `at`, from where it was, or,
    /// if it names no files, from what the parts have of it.
    ///
    /// # Errors
    /// A model that is not there or not what it was.
    pub fn model(
        &self,
        files: FileReader<'_>,
        at: Option<&Path>,
    ) -> Result<ModelFile, SharedModelError> {
        let set = self.set.iter().map(|text| Override::parse(text));
        let set: Option<Vec<Override>> = set.collect();
        let changed = |what: &str| SharedModelError::Changed(what.to_owned());
        let set = set.ok_or_else(|| changed("the parts replace what is no input"))?;
        let readings = self.readings.as_ref();
        let is_named = |(name, _): &(String, String)| readings.is_none_or(|(own, _)| own != name);
        let path = self.model_path.as_deref().map(Path::new);
        let path = path.filter(|_| self.files.iter().any(is_named));
        let readings = readings.map(|(name, content)| ReadingsFile::of(name, content.clone()));
        let readings = readings.transpose().map_err(SharedModelError::Model)?;
        let files = files.with_readings(readings.as_ref());
        let found = match at.or(path) {
            Some(path) => files.model(path, &set),
            None => files.model_text("<model of the parts>", &self.text, Path::new(NOWHERE), &set),
        };
        let mut found = found.map_err(SharedModelError::Model)?;
        if found.source.text != self.text {
            return Err(SharedModelError::Changed(format!(
                "the model file `{}` is not the one that the parts were made of",
                found.source.name
            )));
        }
        let now = digests(&found.files);
        if let Some((name, _)) = now.iter().find(|file| !self.files.contains(file)) {
            return Err(SharedModelError::Changed(format!(
                "the file `{name}`, which the model names, is not the one that the parts were made \
                 with"
            )));
        }
        found.task.settings = self.settings;
        Ok(found)
    }

    /// What tells another run from this one, as the end of a sentence about a part of the other;
    /// `None` if they are the same.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let (ours, theirs) = (&self.settings, &other.settings);
        let trials = |settings: &Settings| match settings.trials {
            Trials::Fixed(trials) => trials.to_string(),
            Trials::Adaptive => "adaptive".to_owned(),
        };
        Some(if self.version != other.version {
            format!("was made by gumption {}, not {}", other.version, self.version)
        } else if self.text != other.text {
            "is of another model file".to_owned()
        } else if self.files != other.files {
            "is of a model whose files had other contents".to_owned()
        } else if self.set != other.set {
            format!("has other values set ({})", listed(&other.set))
        } else if ours.seed != theirs.seed {
            format!("has the seed {}, not {}", theirs.seed, ours.seed)
        } else if ours.trials != theirs.trials || ours.decide_up_to != theirs.decide_up_to {
            format!("is of a run of {} trials, not {}", trials(theirs), trials(ours))
        } else if ours != theirs {
            "has other settings (coverage, digits)".to_owned()
        } else if self.memory != other.memory {
            format!("has another `--memory` ({} bytes, not {})", other.memory, self.memory)
        } else {
            return None;
        })
    }

    fn to_json(&self) -> Value {
        let settings = &self.settings;
        let coverage = match settings.coverage {
            Coverage::Usual => Value::Null,
            Coverage::Probability(p) => json!({ "probability": p }),
            Coverage::Factor { factor, fixed } => json!({ "factor": factor, "fixed": fixed }),
        };
        let trials = match settings.trials {
            Trials::Fixed(trials) => Value::from(trials),
            Trials::Adaptive => Value::from("adaptive"),
        };
        json!({
            "gumption": self.version,
            "model": self.model_path,
            "model_sha256": sha256(self.text.as_bytes()),
            "files": self.files,
            "readings": self.readings.as_ref().map(|(name, content)| [name.clone(), BASE64.encode(content)]),
            "set": self.set,
            "settings": {
                "coverage": coverage,
                "trials": trials,
                "rule": settings.rule.name(),
                "method": settings.method.map(MethodChoice::name),
                "decide_up_to": settings.decide_up_to,
                "max_trials": settings.max_trials,
                "for_validation": settings.for_validation,
                "seed": settings.seed,
                "digits": settings.digits,
                "own_digits": settings.own_digits,
                "shown_digits": settings.shown_digits,
                "real_dof": settings.real_dof,
                "statement": settings.statement.name(),
                "statement_tolerance": settings.statement_tolerance,
                "allowed_undefined": settings.allowed_undefined,
            },
            "memory": self.memory,
            "text": self.text,
        })
    }

    fn from_json(header: &Map<String, Value>) -> Option<Self> {
        let text = |key: &str| Some(header.get(key)?.as_str()?.to_owned());
        let pair = |pair: &Value| match pair.as_array()?.as_slice() {
            [name, digest] => Some((name.as_str()?.to_owned(), digest.as_str()?.to_owned())),
            _ => None,
        };
        let each = |key: &str| header.get(key)?.as_array();
        let readings = match header.get("readings")? {
            Value::Null => None,
            given => {
                let (name, content) = pair(given)?;
                Some((name, BASE64.decode(content).ok()?))
            }
        };
        let model_path = match header.get("model")? {
            Value::Null => None,
            path => Some(path.as_str()?.to_owned()),
        };
        Some(Self {
            version: text("gumption")?,
            model_path,
            text: text("text")?,
            files: each("files")?.iter().map(pair).collect::<Option<_>>()?,
            readings,
            set: each("set")?
                .iter()
                .map(|set| Some(set.as_str()?.to_owned()))
                .collect::<Option<_>>()?,
            settings: settings(header.get("settings")?.as_object()?)?,
            memory: usize::try_from(header.get("memory")?.as_u64()?).ok()?,
        })
    }
}

/// The settings of a header.
fn settings(found: &Map<String, Value>) -> Option<Settings> {
    let number = |key: &str| found.get(key)?.as_u64();
    let flag = |key: &str| found.get(key)?.as_bool();
    let mut settings = Settings::default();
    settings.coverage = match found.get("coverage")? {
        Value::Null => Coverage::Usual,
        of => match of.get("probability") {
            Some(p) => Coverage::Probability(p.as_f64().filter(|p| *p > 0.0 && *p < 1.0)?),
            None => Coverage::Factor {
                factor: of.get("factor")?.as_f64().filter(|k| *k > 0.0 && *k <= 8.0)?,
                fixed: of.get("fixed")?.as_bool()?,
            },
        },
    };
    settings.trials = match found.get("trials")? {
        Value::String(word) if word == "adaptive" => Trials::Adaptive,
        trials => Trials::Fixed(trials.as_u64().filter(|n| *n <= super::settings::MOST_TRIALS)?),
    };
    settings.rule = StoppingRule::named(found.get("rule")?.as_str()?)?;
    settings.method = match found.get("method")? {
        Value::Null => None,
        method => Some(MethodChoice::named(method.as_str()?)?),
    };
    settings.decide_up_to =
        number("decide_up_to").filter(|n| *n <= super::settings::MOST_TRIALS)?;
    settings.max_trials = number("max_trials").filter(|n| *n <= super::settings::MOST_TRIALS)?;
    settings.for_validation = flag("for_validation")?;
    settings.seed = number("seed")?;
    let digits = |key: &str| u32::try_from(number(key)?).ok().filter(|n| (1..=15).contains(n));
    settings.digits = digits("digits")?;
    settings.own_digits = flag("own_digits")?;
    settings.shown_digits = match found.get("shown_digits") {
        None | Some(Value::Null) => None,
        Some(_) => Some(digits("shown_digits")?),
    };
    settings.real_dof = flag("real_dof")?;
    settings.statement = StatementMethod::named(found.get("statement")?.as_str()?)?;
    settings.statement_tolerance =
        found.get("statement_tolerance")?.as_f64().filter(|share| *share > 0.0 && *share < 1.0)?;
    settings.allowed_undefined =
        found.get("allowed_undefined")?.as_f64().filter(|p| (0.0..=1.0).contains(p))?;
    Some(settings)
}

fn digests(files: &[(String, Vec<u8>)]) -> Vec<(String, String)> {
    files.iter().map(|(name, content)| (name.clone(), sha256(content))).collect()
}

fn listed(set: &[String]) -> String {
    if set.is_empty() { "none".to_owned() } else { set.join(", ") }
}

impl SharedFileHeader {
    /// Of a part, or of the pass itself, of which the bytes are `pass`.
    pub fn new(run: SharedRun, number: u64, pass: &[u8], kind: SharedFileKind) -> Self {
        Self { run, pass: number, pass_digest: sha256(pass), kind }
    }

    /// The file, with what the engine wrote as its content.
    pub fn file(&self, content: &[u8]) -> Vec<u8> {
        let mut header = self.run.to_json();
        header["pass"] = Value::from(self.pass);
        header["pass_sha256"] = Value::from(self.pass_digest.as_str());
        if let SharedFileKind::Part(blocks) = &self.kind {
            header["blocks"] = json!([blocks.start, blocks.end]);
        }
        let header = header.to_string();
        let mut file = Vec::with_capacity(MAGIC.len() + header.len() + content.len() + 80);
        file.extend_from_slice(MAGIC);
        file.push(FORM);
        file.extend_from_slice(&(header.len() as u32).to_le_bytes());
        file.extend_from_slice(header.as_bytes());
        file.extend_from_slice(content);
        let digest = sha256(&file);
        file.extend_from_slice(digest.as_bytes());
        file
    }

    /// Reads the header alone, which is not checked against the digest.
    ///
    /// # Errors
    /// Another kind of file, or a damaged one.
    pub fn read(from: &mut impl Read) -> Result<Self, SharedFileError> {
        let mut magic = Vec::new();
        from.take(MAGIC.len() as u64).read_to_end(&mut magic)?;
        if magic != MAGIC {
            return Err(SharedFileError::Other);
        }
        let (mut form, mut length) = ([0], [0; 4]);
        from.read_exact(&mut form)?;
        if form[0] != FORM {
            return Err(SharedFileError::Newer);
        }
        from.read_exact(&mut length)?;
        let length = u32::from_le_bytes(length);
        if length > MOST_HEADER {
            return Err(SharedFileError::Damaged("its header is too long"));
        }
        let mut header = Vec::new();
        from.take(u64::from(length)).read_to_end(&mut header)?;
        if header.len() as u64 != u64::from(length) {
            return Err(SharedFileError::Damaged("it ends too early"));
        }
        let header = serde_json::from_slice::<Map<String, Value>>(&header);
        let header = header.ok().and_then(|header| Self::from_json(&header));
        header.ok_or(SharedFileError::Damaged("its header cannot be read"))
    }

    fn from_json(header: &Map<String, Value>) -> Option<Self> {
        let kind = match header.get("blocks") {
            None => SharedFileKind::Pass,
            Some(blocks) => match blocks.as_array()?.as_slice() {
                [start, end] => SharedFileKind::Part(start.as_u64()?..end.as_u64()?),
                _ => return None,
            },
        };
        Some(Self {
            run: SharedRun::from_json(header)?,
            pass: header.get("pass")?.as_u64()?,
            pass_digest: header.get("pass_sha256")?.as_str()?.to_owned(),
            kind,
        })
    }
}

/// The header and the content of a file of a shared run, its digest checked.
///
/// # Errors
/// Another kind of file, or a damaged one.
pub fn shared_file(bytes: &[u8]) -> Result<(SharedFileHeader, &[u8]), SharedFileError> {
    let mut rest = bytes;
    let header = SharedFileHeader::read(&mut rest)?;
    let Some((content, digest)) = rest.split_last_chunk::<DIGEST>() else {
        return Err(SharedFileError::Damaged("it ends too early"));
    };
    let hashed = &bytes[..bytes.len() - DIGEST];
    if sha256(hashed).as_bytes() != digest {
        return Err(SharedFileError::Damaged("its content does not match its SHA-256"));
    }
    Ok((header, content))
}

/// The bytes of a file of a shared run.
///
/// # Errors
/// What the system says.
pub fn shared_file_bytes(path: &Path) -> Result<Vec<u8>, SharedFileError> {
    bytes::of_file(path, MOST).map_err(|error| SharedFileError::Io(io::Error::other(error)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_text;

    const MODEL: &str = r#"{"inputs": {"x": {"distribution": "normal", "mean": 1, "std": 0.1}},
        "equations": {"y": "x*x"}, "outputs": {"y": {}}, "coverage_probability": 0.9}"#;

    fn run() -> SharedRun {
        let file = read_text("m.json", MODEL, Path::new(""), &[]).unwrap();
        SharedRun::new(&file, None, &[], &file.task.settings, 64 << 20)
    }

    fn part() -> (SharedFileHeader, Vec<u8>) {
        let kind = SharedFileKind::Part(3..977);
        let header = SharedFileHeader::new(run(), 2, b"a pass", kind);
        let file = header.file(b"what was counted");
        (header, file)
    }

    #[test]
    fn files_come_back() {
        let (header, file) = part();
        let (found, content) = shared_file(&file).unwrap();
        assert_eq!((found, content), (header.clone(), &b"what was counted"[..]));
        assert_eq!(SharedFileHeader::read(&mut file.as_slice()).unwrap(), header);
        let pass = SharedFileHeader { kind: SharedFileKind::Pass, ..header };
        assert_eq!(shared_file(&pass.file(b"")).unwrap().0, pass);
        // the model of a run without files is in its parts
        let model = run().model(FileReader::default(), None).unwrap();
        assert_eq!(model.task.settings, run().settings);
    }

    /// The parts carry the readings that replaced those of the model.
    #[test]
    fn readings_come_back() {
        let text = MODEL
            .replace(r#""normal", "mean": 1, "std": 0.1"#, r#""readings", "values": [1, 2, 4]"#);
        let today = ReadingsFile::of("today.csv", b"x\n3\n5\n7\n".to_vec()).unwrap();
        let reader = FileReader::default().with_readings(Some(&today));
        let file = reader.model_text("m.json", &text, Path::new(""), &[]).unwrap();
        let run = SharedRun::new(&file, None, &[], &file.task.settings, 64 << 20);
        let kind = SharedFileKind::Pass;
        let part = SharedFileHeader::new(run, 1, b"a pass", kind).file(b"");
        let found = shared_file(&part).unwrap().0.run;
        let model = found.model(FileReader::default(), None).unwrap();
        assert_eq!(model.task.rows[0].distributions[0].mean(), 5.0);
        assert_eq!(model.files, file.files);
    }

    /// Every byte and every length counts.
    #[test]
    fn a_changed_file_is_refused() {
        let (_, file) = part();
        for at in 0..file.len() {
            let mut changed = file.clone();
            changed[at] ^= 1;
            assert!(shared_file(&changed).is_err(), "byte {at}");
            assert!(shared_file(&file[..at]).is_err(), "{at} bytes");
        }
        let longer = [&file[..], b"0"].concat();
        assert!(matches!(shared_file(&longer), Err(SharedFileError::Damaged(_))));
        assert!(matches!(shared_file(b"{}"), Err(SharedFileError::Other)));
        let newer = [MAGIC, &[FORM + 1]].concat();
        assert!(matches!(shared_file(&newer), Err(SharedFileError::Newer)));
        let huge = [MAGIC, &[FORM, 0xff, 0xff, 0xff, 0xff]].concat();
        assert!(matches!(shared_file(&huge), Err(SharedFileError::Damaged(_))));
    }

    #[test]
    fn other_runs_are_told_apart() {
        let ours = run();
        let differs = |change: &dyn Fn(&mut SharedRun)| {
            let mut other = run();
            change(&mut other);
            ours.difference(&other)
        };
        assert_eq!(differs(&|_| {}), None);
        assert_eq!(differs(&|run| run.model_path = Some("elsewhere".into())), None);
        let told = differs(&|run| run.settings.seed = 2).unwrap();
        assert_eq!(told, "has the seed 2, not 1");
        assert!(differs(&|run| run.version = "0.0.0".into()).unwrap().contains("0.0.0"));
        assert!(differs(&|run| run.text.push(' ')).unwrap().contains("another model"));
        assert!(differs(&|run| run.settings.trials = Trials::Fixed(5)).unwrap().contains("of 5"));
        assert!(differs(&|run| run.settings.digits = 1).unwrap().contains("digits"));
        assert!(differs(&|run| run.settings.shown_digits = Some(1)).unwrap().contains("digits"));
        assert!(differs(&|run| run.memory = 1).unwrap().contains("--memory"));
        assert!(differs(&|run| run.set.push("x=2".into())).unwrap().contains("x=2"));
    }
}
