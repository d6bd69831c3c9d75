//! The recordings of a recipe.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::keys;
use super::check_name;
use super::column::column;
use super::quantity::{positive, quantity, unit};
use gumption_columns::recording::{Bytes, ColumnName, Conversion, Reading, Wanted};
use gumption_signal::Measured;
use gumption_text::json::{Json, Member};
use gumption_text::object::Object;
use gumption_text::value_text::ValueOf;
use gumption_text::{DiagnosticKind, Folder, column_heading};
use gumption_units::Unit;

/// The search for a sampling rate, as the recipe describes it.
#[derive(Clone, Debug)]
pub(super) struct SearchFile {
    /// The channel that has the oscillation.
    pub(super) channel: String,
    /// Where it is named.
    pub(super) place: Range<usize>,
    pub(super) frequency: Option<Measured>,
    pub(super) between: [f64; 2],
    pub(super) step: f64,
}

/// A recording, as the recipe describes it.
#[derive(Clone, Debug)]
pub(super) struct RecordingFile {
    pub(super) name: String,
    pub(super) place: Range<usize>,
    /// The file and where it is named, where it is the same for all rows.
    pub(super) file: Option<(String, Range<usize>)>,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    /// The rms deviation of instants, in seconds.
    pub(super) jitter: f64,
    folder: PathBuf,
    /// Other folders that its files may lie in.
    allowed: Vec<PathBuf>,
    /// The folder above which nothing is looked for.
    within: Option<PathBuf>,
    /// Files in memory, by their names.
    held: Vec<(String, Arc<[u8]>)>,
    /// How the sampling rate is found, where it is.
    pub(super) search: Option<SearchFile>,
    rate: Option<Measured>,
    time: Option<(ColumnName, Unit)>,
}

pub(super) fn read(root: &Object<'_>, folder: Folder<'_>) -> Option<Vec<RecordingFile>> {
    let member = root.required("recordings")?;
    let object = Object::new(root.log, "`recordings`", &member.value, &member.key_span)?;
    let mut recordings = Vec::new();
    let held =
        folder.memory().iter().map(|(name, bytes)| (name.clone(), Arc::from(bytes.as_slice())));
    let held: Vec<(String, Arc<[u8]>)> = held.collect();
    for member in object.members() {
        check_name(root.log, &member.key, &member.key_span);
        let Some(object) = Object::new(root.log, "a recording", &member.value, &member.key_span)
        else {
            continue;
        };
        keys::check(&object, keys::RECORDING);
        let search = search(&object);
        let found = search.as_ref().map(|search| Measured {
            value: f64::midpoint(search.between[0], search.between[1]),
            standard_uncertainty: 0.0,
            degrees_of_freedom: f64::INFINITY,
        });
        let rate = if searched(&object).is_some() {
            None
        } else {
            quantity(&object, "sampling_rate", "Hz")
        };
        let rate =
            rate.filter(|rate| positive(&object, "sampling_rate", rate)).map(|rate| Measured {
                value: rate.si(),
                standard_uncertainty: rate.si_uncertainty(),
                degrees_of_freedom: f64::INFINITY,
            });
        let seconds = |key| quantity(&object, key, "s").map(|quantity| quantity.si());
        let jitter = quantity(&object, "jitter", "s")
            .filter(|jitter| jitter.value == 0.0 || positive(&object, "jitter", jitter));
        let unit = unit(&object, "time_unit", "s");
        if let (Some(unit), Some(member)) = (&unit, object.get("time_unit")) {
            let second = super::quantity::own_unit("s");
            super::quantity::same_dimension(&object, member, unit, &second);
            if object.get("time").is_none() {
                let diagnostic = DiagnosticKind::OnlyWith { key: "time_unit", with: "time" };
                root.log.report(&member.key_span, diagnostic);
            }
        }
        let time = object.get("time").and_then(|member| column(root.log, member));
        if let (Some(member), Some(ColumnName::Name(name)), Some(unit)) =
            (object.get("time"), &time, &unit)
        {
            let of = (unit, ValueOf::Quantity);
            column_heading::check(root.log, &member.value.span, name, of);
        }
        let (from, to) = (seconds("from"), seconds("to"));
        check_part(&object, from, to);
        recordings.push(RecordingFile {
            name: member.key.clone(),
            place: member.key_span.clone(),
            file: object
                .text("file")
                .zip(object.get("file").map(|m| m.value.span.clone()))
                .map(|(name, place)| (name.to_owned(), place)),
            from,
            to,
            jitter: jitter.map_or(0.0, |jitter| jitter.si()),
            folder: folder.path().to_owned(),
            allowed: folder.allowed().to_vec(),
            within: folder.limit().map(Path::to_owned),
            held: held.clone(),
            rate: rate.or(found),
            search,
            time: time.zip(unit),
        });
    }
    if recordings.is_empty() && object.members().is_empty() {
        root.log.report(&member.key_span, DiagnosticKind::NoValues { name: "recordings".into() });
    }
    (recordings.len() == object.members().len()).then_some(recordings)
}

/// Steps of a search at most: each looks at a hundred thousand values.
const MOST_STEPS: f64 = 5000.0;

/// The search within `sampling_rate`, if there is one.
fn searched<'a>(of: &Object<'a>) -> Option<(&'a Member, &'a Member)> {
    let whole = of.get("sampling_rate")?;
    match &whole.value.value {
        Json::Object(members) => {
            members.iter().find(|member| member.key == "search").map(|search| (whole, search))
        }
        _ => None,
    }
}

fn search(of: &Object<'_>) -> Option<SearchFile> {
    let (whole, member) = searched(of)?;
    let whole =
        Object::new(of.log, "a sampling rate that is searched", &whole.value, &whole.key_span)?;
    keys::check(&whole, keys::SEARCHED);
    let object = Object::new(of.log, "a search", &member.value, &member.key_span)?;
    keys::check(&object, keys::SEARCH);
    let place = object.required("channel").map(|member| member.value.span.clone());
    let channel = object.text("channel")?.to_owned();
    let hertz = |key: &'static str| {
        let found = quantity(&object, key, "Hz")?;
        positive(&object, key, &found).then_some(found)
    };
    let frequency = match object.get("frequency") {
        Some(_) => {
            let found = hertz("frequency")?;
            Some(Measured {
                value: found.si(),
                standard_uncertainty: found.si_uncertainty(),
                degrees_of_freedom: f64::INFINITY,
            })
        }
        None => None,
    };
    let step = if object.get("step").is_some() { hertz("step")?.si() } else { 1.0 };
    object.required("from")?;
    object.required("to")?;
    let (from, to) = (hertz("from")?.si(), hertz("to")?.si());
    if to <= from {
        let reason = format!(
            "`to` is {} Hz, but must be above `from`, {} Hz",
            gumption_engine::number::Shortest(to),
            gumption_engine::number::Shortest(from)
        );
        object.log.report(&object.get("to")?.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    let steps = (to - from) / step;
    if steps > MOST_STEPS {
        let reason = format!(
            "the search from {} Hz to {} Hz has {steps:.0} steps, but at most {MOST_STEPS} are made; \
             a step much narrower than the maximum gains nothing, as its place is then refined",
            gumption_engine::number::Shortest(from),
            gumption_engine::number::Shortest(to),
        );
        let place = object.get("step").unwrap_or(object.get("to")?);
        object.log.report(&place.value.span, DiagnosticKind::Recipe { reason });
        return None;
    }
    Some(SearchFile { channel, place: place?, frequency, between: [from, to], step })
}

/// The part that is used must have a length.
pub(super) fn check_part(object: &Object<'_>, from: Option<f64>, to: Option<f64>) {
    if let (Some(from), Some(to)) = (from, to)
        && to <= from
        && let Some(member) = object.get("to")
    {
        let found = gumption_engine::number::Shortest(to);
        let reason = format!(
            "`to` is {found} s, but must be after `from`, {} s",
            gumption_engine::number::Shortest(from)
        );
        object.log.report(&member.value.span, DiagnosticKind::Recipe { reason });
    }
}

impl RecordingFile {
    /// Where the bytes of one of its files are.
    ///
    /// # Errors
    /// It may not be read, or there is none.
    pub(super) fn bytes(&self, name: &str) -> Result<Bytes, DiagnosticKind> {
        if let Some((_, bytes)) = self.held.iter().find(|(held, _)| held == name) {
            return Ok(Bytes::Held(Arc::clone(bytes)));
        }
        let folder = Folder::new(&self.folder, &self.allowed).within(self.within.as_deref());
        folder.existing(name).map(Bytes::OnDisk)
    }

    /// How to read one of its files, by its bytes and its name.
    pub(super) fn reading(
        &self,
        bytes: Bytes,
        name: &str,
        channels: Vec<(Wanted, Conversion)>,
        slowest: Option<f64>,
        from: Option<f64>,
        to: Option<f64>,
    ) -> Reading {
        Reading {
            bytes,
            name: name.to_owned(),
            channels,
            time: self.time.clone(),
            rate: self.rate,
            searched: self.search.is_some(),
            from,
            to,
            slowest,
        }
    }
}
