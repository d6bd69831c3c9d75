//! Names of units that files define.

use std::collections::HashSet;
use std::sync::{Mutex, PoisonError};

use super::names;

/// The longest name, in bytes.
const LONGEST: usize = 40;

/// Maximum number of different names in one process: they are kept forever, because factors of
/// units are copied by the million.
const MOST: usize = 1000;

static NAMES: Mutex<Option<HashSet<&'static str>>> = Mutex::new(None);

/// The name, kept for ever.
///
/// # Errors
/// Why it cannot be the name of a unit.
pub(super) fn intern(name: &str) -> Result<&'static str, &'static str> {
    let has_form = name.starts_with(char::is_alphabetic)
        && name.chars().all(|c| c.is_alphanumeric() || c == '_')
        && name.len() <= LONGEST;
    if !has_form {
        return Err("a name of a unit has letters, digits and `_`, and a letter in front");
    }
    if names::read(name).is_some() {
        return Err("there is a unit of that name");
    }
    let mut known = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_with(HashSet::new);
    if let Some(found) = known.get(name) {
        return Ok(found);
    }
    if known.len() >= MOST {
        return Err("there are more than 1000 names of units");
    }
    let kept: &'static str = Box::leak(name.to_owned().into_boxed_str());
    known.insert(kept);
    Ok(kept)
}
