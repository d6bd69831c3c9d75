//! The keys of an object held against those that are known there.

use super::Key;
use super::homes::homes;
use gumption_text::DiagnosticKind;
use gumption_text::object::Object;
use gumption_text::other_names::other_name;
use gumption_units::nearest;

/// Reports every key that is not among `known`, and returns whether there was none; keys that begin
/// with `$` belong to editors.
pub(crate) fn check(object: &Object<'_>, known: &[Key]) -> bool {
    check_names(object, &known.iter().map(|key| key.name).collect::<Vec<_>>())
}

/// As [`check`], for keys that are put together.
pub(crate) fn check_names(object: &Object<'_>, known: &[&'static str]) -> bool {
    let mut are_known = true;
    for member in object.members() {
        if !known.contains(&member.key.as_str()) && !member.key.starts_with('$') {
            are_known = false;
            object.log.report(
                &member.key_span,
                DiagnosticKind::UnknownKey {
                    key: member.key.clone(),
                    what: object.what(),
                    nearest: other_name(&member.key, known)
                        .map(|other| other.key)
                        .or_else(|| nearest(&member.key, known.iter().copied()))
                        .map(str::to_owned),
                    homes: homes(&member.key, object.what()),
                    known: known.to_vec(),
                },
            );
        }
    }
    are_known
}
