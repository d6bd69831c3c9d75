//! The integral over the unknowns of a hypothesis: the search for its modes from many starts, the proposal
//! that is drawn from about them, and the evidence.

pub(crate) mod differential_evolution;
pub mod evidence;
pub(crate) mod evidence_error;
pub(crate) mod exploration;
pub(crate) mod line_profile;
pub mod mixture;
pub(crate) mod profile_path;
pub(crate) mod response_scan;
pub mod search;
